"""The page of the workbench in a real browser, on a real server process. Nothing leaves the machine."""

import json
import re

import pytest
from click.testing import CliRunner
from served_page import expect, said
from test_server import Served

from contoursolve.cli import main
from contoursolve.controls import CONTROLS
from contoursolve.workbench import Desk
from contoursolve.workbench.desk import MOST_PROGRAMS

pytestmark = [pytest.mark.browser, pytest.mark.needs("starlette", "uvicorn")]
SHAFT = "%\r\nG00 X40. Z0.\r\nG111 X100. A180. K-30. B120. P6.\r\nG00 X150. Z10.\r\nM30\r\n"


def text_of(page) -> str:
    """The text of a short program, all of which is in sight."""
    return "\n".join(line.removesuffix("\n") for line in page.locator(".cm-line").all_inner_texts())


def wait_for_text(page, text) -> None:
    page.wait_for_function(
        "text => [...document.querySelectorAll('.cm-line')].some(line => line.innerText.trim() === text)", arg=text
    )


def show(page, view) -> None:
    page.get_by_role("tab", name=view, exact=True).click()


def do(page, command) -> None:
    page.get_by_role("button", name="Do", exact=True).click()
    page.get_by_role("menuitem", name=command).click()


@pytest.mark.parametrize("control", ["yasnac-lx3", "fanuc-mill", "heidenhain"])
def test_an_example_is_mended_and_saved_as_the_desk_does_it(control, opened, folder) -> None:
    page = opened(CONTROLS[control].title)
    desk = Desk()
    view = desk.answer({"do": "open", "example": control})
    while view["examined"] < view["lines"]:
        view |= desk.answer({"do": "go_on", "program": view["id"]})
    finding = next(number for number, each in enumerate(view["findings"]) if each["fixes"])
    rows = page.locator(".view.program .findings li")
    told = [each["message"] for each in view["findings"]]
    expect(rows.locator(".go > span:last-child")).to_have_text(told)
    rows.nth(finding).locator(".fixes button").first.click()
    fixed = desk.answer({"do": "fix", "program": view["id"], "seq": view["seq"], "finding": finding, "fix": 0})
    (edit,) = fixed["edits"]
    wanted = f"{view['text'][: edit['from']]}{edit['text']}{view['text'][edit['to'] :]}"
    page.locator(".programs button", has_text="•").wait_for()
    page.keyboard.press("Control+Shift+s")
    page.get_by_label("Name in the folder").fill(f"{control}.nc")
    page.keyboard.press("Enter")
    said(page, f"Saved as {control}.nc.")
    assert (folder / f"{control}.nc").read_bytes() == wanted.encode()
    assert text_of(page) == wanted


def test_a_word_with_a_variable_is_shown_and_not_moved(opened, folder) -> None:
    text = "#100=100.\nG00 X40. Z0.\nG111 X#100 A180. K-30. B120. P6. Q5.\nM30\n"
    (folder / "shaft.nc").write_text(text)
    page = opened("shaft.nc")
    show(page, "Contour")
    row = page.locator('.contour .row[data-word="X"]')
    assert row.locator(".range").inner_text() == "X#100 takes its value from #100; change that in the program"
    assert (row.locator(".word").inner_text(), row.locator("input.value").input_value()) == ("X#100", "100")
    assert row.locator("input[type=range]").is_disabled()
    assert not row.locator("input.value").is_editable()
    assert not row.locator("button.free").is_visible()
    number = page.locator('.contour .row[data-word="P"] input.value')
    number.fill("4,25")
    number.press("Tab")
    wait_for_text(page, "G111 X#100 A180. K-30. B120. P4.25 Q5.")


def test_a_word_is_changed_by_its_row_or_in_the_text_and_taken_back(opened, folder) -> None:
    (folder / "shaft.nc").write_bytes(SHAFT.encode())
    page = opened("shaft.nc")
    show(page, "Contour")
    number = page.locator('.contour [data-word="K"] input.value')
    number.fill("-22,5")
    # A word, its row and its dimension are one, also in the text.
    number.focus()
    assert page.locator(".cm-lit").inner_text() == "K-30."
    page.locator(".cm-line").nth(2).click()
    page.keyboard.press("Home")
    for _ in range(len("G111 X100. A1")):
        page.keyboard.press("ArrowRight")
    page.locator('.contour .row.lit[data-word="A"]').wait_for()
    number.fill("-22,5")
    number.press("Enter")
    wait_for_text(page, "G111 X100. A180. K-22.5 B120. P6.")
    # A drag leaves the steps of undo before it as they were.
    page.locator('.contour [data-word="K"] input[type=range]').focus()
    page.keyboard.press("ArrowRight")
    wait_for_text(page, "G111 X100. A180. K-22.4 B120. P6.")
    page.locator(".cm-line").nth(2).click()
    page.keyboard.press("Control+z")
    wait_for_text(page, "G111 X100. A180. K-22.5 B120. P6.")
    page.keyboard.press("Control+z")
    wait_for_text(page, "G111 X100. A180. K-30. B120. P6.")
    # What is typed in the text is what the explorer shows.
    page.locator(".cm-line").nth(2).click()
    page.keyboard.press("End")
    page.keyboard.press("Backspace")
    page.keyboard.type("5")
    page.locator('.contour [data-word="P"] .word', has_text="P65").wait_for()
    page.keyboard.press("Control+s")
    said(page, "Saved as shaft.nc.")
    # Ends of lines are those of the file.
    assert (folder / "shaft.nc").read_bytes() == SHAFT.replace("P6.", "P65").encode()
    assert not page.locator(".programs button", has_text="•").count()


def test_by_keyboard_alone_a_finding_is_mended_at_its_word(opened, folder) -> None:
    (folder / "wrong.nc").write_bytes(SHAFT.replace("P6.", "P60.").encode())
    page = opened("wrong.nc")
    page.locator(".cm-finding").first.wait_for()
    page.keyboard.press("F8")
    page.locator(".at-word").wait_for()
    page.keyboard.press("Control+.")
    page.locator(".at-word button:focus").wait_for()
    page.keyboard.press("Enter")
    wait_for_text(page, "G111 X100. A180. K-30. B120. P6.")
    page.locator(".findings h2", has_text="No findings").wait_for()


STUB = """%
O2201 (STUB SHAFT)
G21 G40 G99
T0101
G96 S180 M03
G00 X64. Z3.
G00 G42 X16.
G01 Z0. F0.15
X20. ,C1.
Z-25. R3.
X30. ,C1.
Z-60. ,R8.
X50. ,C1.
Z-75
X56. Z-80. ,A160.
X62.
M30
%
"""
HEADINGS = """() => {
  const heading = document.querySelector(".findings h2");
  window.said = [];
  new MutationObserver(() => said.push(heading.textContent)).observe(heading, { childList: true });
}"""


def checked(text, control, folder) -> list[tuple[str, str]]:
    """Severity and message of each finding, as the command line has them."""
    (folder / "checked").write_text(text)
    command = ["check", "--control", control, "--format", "json", str(folder / "checked")]
    found = json.loads(CliRunner().invoke(main, command).output)["diagnostics"]
    return [(each["severity"], each["message"]) for each in found]


def test_nothing_is_called_right_before_all_lines_are_examined(opened, folder, tmp_path) -> None:
    (folder / "stub.nc").write_text(STUB)
    page = opened("stub.nc")
    page.evaluate(HEADINGS)
    page.get_by_label("Control", exact=True).select_option("fanuc-lathe")
    rows = page.locator(".view.program .findings li")

    def settles(text, control) -> None:
        """The page comes to what the command line finds, and never said before that there is nothing."""
        wanted = checked(text, control, tmp_path)
        kinds = [kind for kind, _ in wanted]
        told = ", ".join(f"{n} {name}{'s' * (n > 1)}" for name in ("error", "warning") if (n := kinds.count(name)))
        expect(page.locator(".findings h2")).to_have_text(told or "No findings")
        expect(rows.locator(".go > span:last-child")).to_have_text([message for _, message in wanted])
        seen = page.evaluate("window.said.splice(0)")
        assert "No findings" not in seen[: None if wanted else -1]
        assert any(re.search(r"(?i)still checking, \d+ of \d+ lines", each) for each in seen)

    settles(STUB, "fanuc-lathe")
    rows.get_by_role("button", name="write Z-75. for Z-75").first.click()
    text = STUB.replace("Z-75\n", "Z-75.\n")
    settles(text, "fanuc-lathe")
    for control in ("haas-lathe", "fanuc-lathe"):
        page.get_by_label("Control", exact=True).select_option(control)
        settles(text, control)
    rows.get_by_role("button", name="delete ,A160.").first.click()
    settles(text.replace(" ,A160.", ""), "fanuc-lathe")


def test_a_file_that_another_program_changed_is_replaced_only_when_its_user_says_so(opened, folder) -> None:
    (folder / "both.nc").write_bytes(SHAFT.encode())
    page = opened("both.nc")
    (folder / "both.nc").write_bytes(b"(OTHER)\r\n")
    page.locator(".cm-line").nth(3).click()
    page.keyboard.press("Home")
    page.keyboard.type("N5 ")
    page.keyboard.press("Control+s")
    page.get_by_role("dialog").wait_for()
    assert (folder / "both.nc").read_bytes() == b"(OTHER)\r\n"
    page.get_by_role("button", name="Replace it").click()
    said(page, "Saved as both.nc.")
    assert (folder / "both.nc").read_bytes() == SHAFT.replace("G00 X150.", "N5 G00 X150.").encode()


def test_on_a_full_disk_the_page_says_one_sentence_and_keeps_the_text(opened, small_disk) -> None:
    (small_disk.folder / "part.nc").write_bytes(SHAFT.encode())
    server = Served(small_disk.folder)
    page = opened("part.nc", server=server)
    page.locator(".cm-line").nth(1).click()
    page.keyboard.press("End")
    page.keyboard.type(" M08")
    small_disk.fill()
    page.keyboard.press("Control+s")
    full = "part.nc was not saved: it cannot be written: No space left on device; your text is still here"
    page.locator(".notice .trouble", has_text=full).wait_for()
    assert page.locator(".programs button", has_text="•").count() == 1
    # It is still so, whatever else works.
    page.keyboard.type(" M09")
    wait_for_text(page, "G00 X40. Z0. M08 M09")
    show(page, "Contour")
    page.locator('.contour .row[data-word="X"]').wait_for()
    assert page.locator(".notice .trouble").inner_text() == full
    assert (small_disk.folder / "part.nc").read_bytes() == SHAFT.encode()
    small_disk.make_room()
    page.keyboard.press("Control+s")
    said(page, "Saved as part.nc.")
    assert page.locator(".notice .trouble").inner_text() == ""
    assert (small_disk.folder / "part.nc").read_bytes() == SHAFT.replace("Z0.", "Z0. M08 M09").encode()
    server.end()


def test_where_the_server_is_gone_the_text_stays_and_can_be_taken_along(browser, tmp_path) -> None:
    (tmp_path / "part.nc").write_bytes(SHAFT.encode())
    server = Served(tmp_path)
    page = browser.new_page()
    page.goto(f"http://{server.host}:{server.port}/?token={server.token}")
    page.get_by_role("button", name="part.nc").click()
    page.locator(".cm-line").nth(1).click()
    server.end()
    page.keyboard.press("End")
    page.keyboard.type(" M08")
    page.locator(".trouble", has_text="Start it again").wait_for()
    wait_for_text(page, "G00 X40. Z0. M08")
    with page.expect_download() as loaded:
        page.get_by_role("button", name="Download the text").click()
    assert loaded.value.path().read_text() == SHAFT.replace("\r\n", "\n").replace("Z0.", "Z0. M08")
    assert (tmp_path / "part.nc").read_bytes() == SHAFT.encode()
    page.close()


def test_files_are_chosen_or_dropped_and_keep_their_bytes_when_saved(opened, folder) -> None:
    page = opened()
    page.locator("input[type=file]").set_input_files(
        [{"name": "a.nc", "mimeType": "text/plain", "buffer": "(Ø 40)\r\n".encode("latin-1") + SHAFT.encode()}]
    )
    wait_for_text(page, "(Ø 40)")
    dropped = page.evaluate_handle(
        """() => { const data = new DataTransfer();
        for (const name of ["b.nc", "c.nc"]) data.items.add(new File([`(${name})\\n`], name)); return data; }"""
    )
    page.locator(".workbench").dispatch_event("drop", {"dataTransfer": dropped})
    page.get_by_role("tab", name="c.nc").wait_for()
    assert page.locator(".programs button").all_inner_texts() == ["a.nc •", "b.nc •", "c.nc •"]
    page.get_by_role("tab", name="a.nc").click()
    page.keyboard.press("Control+s")
    page.get_by_label("Name in the folder").press("Enter")
    said(page, "Saved as a.nc.")
    assert (folder / "a.nc").read_bytes() == "(Ø 40)\r\n".encode("latin-1") + SHAFT.encode()


def test_a_program_that_the_workbench_forgot_keeps_the_ends_of_its_lines(opened, folder) -> None:
    page = opened()
    file = {"mimeType": "text/plain", "buffer": b"M30\r\n"}
    files = [{"name": f"{each}.nc", **file} for each in range(MOST_PROGRAMS + 1)]
    page.locator("input[type=file]").set_input_files(files)
    page.locator(".programs button").nth(MOST_PROGRAMS).wait_for()
    page.get_by_role("tab", name="0.nc", exact=False).first.click()
    page.locator(".cm-content").focus()
    page.keyboard.press("Control+Home")
    page.keyboard.type("M05\n")
    page.keyboard.press("Control+s")
    page.get_by_label("Name in the folder").press("Enter")
    said(page, "Saved as 0.nc.")
    assert (folder / "0.nc").read_bytes() == b"M05\r\nM30\r\n"


def test_variables_and_the_start_point_are_followed_while_they_are_typed(opened, folder) -> None:
    (folder / "groove.nc").write_text("O9\n#18=0.5\nN10 G01 X#24\nN20 X[#24-#4*2.] ,A251. ,R#18\nN30 W-3.\nM99\n")
    page = opened("groove.nc")
    show(page, "Variables")
    contour = page.locator(".view.variables .contours button").first
    page.locator(".view.variables .contours button", has_text="not enough given").wait_for()
    assert page.get_by_label("#18").get_attribute("placeholder") == "0.5"
    page.get_by_role("textbox", name="#24").fill("60")
    page.get_by_label("#4").fill("8,5")
    page.get_by_role("textbox", name="Start point").fill("X60. Z2.")
    page.locator(".view.variables .contours button", has_text="solved").wait_for()
    assert "solved" in contour.inner_text()
    page.get_by_label("#4").fill("abc")
    page.locator(".view.variables [role=status]", has_text="#4: abc is no number").wait_for()


def test_a_file_that_was_changed_meanwhile_can_be_looked_at(opened, folder) -> None:
    (folder / "twice.nc").write_text(SHAFT)
    page = opened("twice.nc")
    page.locator(".cm-line").nth(3).click()
    page.keyboard.type("(MINE)")
    (folder / "twice.nc").write_text(SHAFT.replace("P6.", "P7."))
    page.keyboard.press("Control+s")
    page.get_by_role("button", name="Open that file beside").click()
    page.get_by_role("tab", name="twice.nc (2)").wait_for()
    wait_for_text(page, "G111 X100. A180. K-30. B120. P7.")
    page.get_by_role("tab", name="twice.nc •").click()
    wait_for_text(page, "G111 X100. A180. K-30. B120. P6.")
    assert "(MINE)" in text_of(page)


def test_the_tool_shows_the_contour_before_its_side_is_chosen(opened, folder) -> None:
    (folder / "side.nc").write_text(SHAFT)
    page = opened("side.nc")
    show(page, "Tool")
    page.locator(".view.tool input[type=text]").fill("0,8")
    page.keyboard.press("Tab")
    page.locator(".view.tool [role=status]", has_text="state the side: left or right").wait_for()
    page.locator(".view.tool svg").first.wait_for()
    page.locator(".view.tool select").nth(1).select_option("right")
    page.locator(".view.tool select").first.select_option("3")
    page.locator(".view.tool [role=status]", has_text="The largest radius").wait_for()
    assert "↙" in page.locator(".view.tool select").first.inner_text()
    # A cutter has no tip, and another program a tool of its own.
    (folder / "slot.nc").write_text("G00 X0 Y0\nG01 X30. ,R5.\nX40. Y40.\nM30\n")
    page.get_by_role("button", name="File").click()
    page.get_by_role("menuitem", name="Open from the folder").click()
    page.get_by_role("button", name="slot.nc").click()
    page.get_by_label("Control").select_option("fanuc-mill")
    page.get_by_label("Tip of the turning tool").wait_for(state="hidden")
    assert page.get_by_label("Side").input_value() == page.locator(".view.tool input[type=text]").input_value() == ""


def test_a_new_program_is_empty_and_quiet_until_something_is_asked_of_it(opened) -> None:
    page = opened()
    page.get_by_role("button", name="New program").click()
    for view in ("Contour", "Tool", "Variables", "Drawing"):
        show(page, view)
    assert not page.locator(".trouble:not(:empty)").count()
    assert not page.locator(".findings .scroll > button:visible").count()
    do(page, "Expand into")
    page.locator(".result .wrong", has_text="no word tells the control").wait_for()
    show(page, "Drawing")
    page.locator(".cm-content").focus()
    page.keyboard.type("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5.")
    page.locator(".drawing svg").first.wait_for()
    assert not page.locator(".trouble:not(:empty)").count()
    # Nothing is found where the controls differ, for nothing is checked.
    page.keyboard.press("Control+a")
    page.keyboard.type("G90\nG00 X0 Y0\nG01 X40 ,R4\nY30\nX9 Y90\n")
    page.get_by_role("heading", name="Not checked").wait_for()
    page.locator(".findings .scroll", has_text="differently").wait_for()
    page.get_by_label("Control").select_option("fanuc-lathe")
    page.get_by_role("heading", name="error").wait_for()


def test_a_result_is_marked_after_an_edit_and_gives_way_to_a_failure(opened, folder) -> None:
    (folder / "two.nc").write_text(SHAFT + SHAFT.replace("P6.", "P60."))
    page = opened("two.nc")
    do(page, "Drawing as DXF")
    result, older = page.locator(".result"), page.get_by_text("Of the program before the last change.")
    expect(result.locator(".said")).to_contain_text("left out, cannot be cut: 1 contour (program line 8)")
    expect(older).to_be_hidden()
    page.locator(".cm-content").focus()
    page.keyboard.press("Control+End")
    page.keyboard.type("(A)")
    expect(older).to_be_visible()
    page.get_by_label("Control").select_option("siemens-808d")
    do(page, "Drawing as DXF")
    expect(result.get_by_role("heading")).to_have_text("Nothing was made")
    expect(result.get_by_role("button")).to_have_count(0)
    expect(older).to_be_hidden()
    # Read for another control, it is another program.
    page.get_by_label("Control").select_option("yasnac-lx3")
    expect(older).to_be_visible()


def test_what_was_saved_is_said_over_its_own_tab_alone(opened, folder) -> None:
    page = opened()
    page.locator("input[type=file]").set_input_files(
        [{"name": name, "mimeType": "text/plain", "buffer": SHAFT.encode()} for name in ("own.nc", "other.nc")]
    )
    page.get_by_role("tab", name="other.nc").wait_for()
    page.keyboard.press("Control+s")
    page.get_by_label("Name in the folder").press("Enter")
    said(page, "Saved as other.nc.")
    page.get_by_role("tab", name="own.nc").click()
    expect(page.locator(".head .said")).to_be_empty()


def test_converted_for_the_controls_of_the_same_machine_and_verified_in_a_sentence(opened) -> None:
    page = opened()
    page.get_by_role("button", name="New program").click()
    page.locator(".cm-content").click()
    page.keyboard.type("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5.")
    page.locator(".drawing svg").first.wait_for()
    do(page, "Convert")
    dialog = page.get_by_role("dialog")
    offered = dialog.locator("option").evaluate_all("(all) => all.map((each) => each.value)")
    assert {"siemens-808d", "fanuc-lathe"} < {*offered}
    assert not {"yasnac-lx3", "heidenhain", "nct-99m"} & {*offered}
    expect(dialog).to_contain_text("The program is for a lathe")
    dialog.get_by_role("button", name="Cancel").click()
    do(page, "Verify")
    expect(page.locator(".result .said")).to_contain_text("Checked again without the solver: the contour is as shown.")
    expect(page.get_by_text("SHA-256")).to_be_hidden()
    page.locator("summary", has_text="Details").click()
    expect(page.get_by_text("SHA-256")).to_be_visible()


@pytest.mark.parametrize("screen", ["desktop", "phone, dark"])
def test_every_view_can_be_reached_and_read(screen, axe, opened, folder, artefacts) -> None:
    (folder / "axe.nc").write_bytes(SHAFT.replace("P6.", "P60.").encode())
    page = opened(screen=screen)
    page.get_by_role("button", name="axe.nc").wait_for()
    assert axe(page) == []
    page.get_by_role("button", name="axe.nc").click()
    page.locator(".findings li").first.wait_for()
    for tab in page.locator(".pane:not(.chain) .views [role=tab]").all():
        tab.click()
        name = tab.inner_text().lower()
        page.locator(f".view.{name} figure svg" if name == "contour" else f".view.{name}").first.wait_for()
        assert axe(page) == []
        page.screenshot(path=artefacts / f"workbench-{re.sub('[^a-z]', '', screen)}-{name}.png")
    page.get_by_role("button", name="File").click()
    assert axe(page) == []
    page.keyboard.press("Escape")
    # Nothing stands out of the screen.
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


COVER = """N10 G17 G21 G40 G90
N40 G0 X-70 Y-60
N100 G1 G42 D1 X-60 Y-40 F600
N110 G1 X60 ,R60
N120 Y-10 ,C4
N130 G1 Y20 ,A120
N140 G1 ,A90
N150 X20 Y60 ,A150 Q1
N160 G1 X-30
N170 G1 ,A180 ,R3
N180 G3 X-85 Y50 I-60 J50 R25
N190 G1 X-75 Y0 ,A-90 Q1
N300 G40 G0 X-90 Y-60
N320 M30
"""


def test_a_program_opens_at_its_first_error_and_two_solutions_are_told_apart(opened, folder, tmp_path) -> None:
    (folder / "cover.nc").write_text(COVER)
    page = opened("cover.nc")
    page.get_by_label("Control", exact=True).select_option("nct-99m")
    wanted = [message for _, message in checked(COVER, "nct-99m", tmp_path)]
    rows = page.locator(".view.program .findings li")
    # One finding, one card.
    expect(rows.locator(".go > span:last-child")).to_have_text(wanted)
    expect(page.locator(".cm-activeLine")).to_have_text("N110 G1 X60 ,R60")
    rows.filter(has_text="Q is missing").locator(".go").click()
    expect(page.locator(".cm-content")).to_be_focused()
    expect(page.locator(".cm-activeLine")).to_have_text("N180 G3 X-85 Y50 I-60 J50 R25")
    # Where there is no contour, none is changed.
    assert "changes the contour" not in " ".join(rows.locator(".fix").all_inner_texts())
    page.locator(".over .way").first.wait_for()
    expect(page.locator(".over .way")).to_have_text(["A", "B"])
    rows.locator(".fix[data-solution=B]").hover()
    expect(page.locator(".over .way.lit")).to_have_text("B")
    expect(page.locator(".over .way.pale")).to_have_text("A")


PLAIN = "G00 X40. Z0.\nG01 X60. F0.2\nZ-20. R2.\nX80.\nM30\n"


def test_the_path_is_played_by_keys_and_measured_and_two_programs_are_compared(opened, folder) -> None:
    for name, text in (("first.nc", PLAIN), ("second.nc", PLAIN.replace("Z-20.", "Z-20.5"))):
        (folder / name).write_text(text)
    page = opened("first.nc")
    page.get_by_label("Control", exact=True).select_option("fanuc-lathe")
    place, output = page.get_by_label("Place on the path"), page.locator(".player output")
    place.wait_for()
    place.focus()
    seen = []
    for _ in range(4):
        page.keyboard.press("ArrowRight")
        seen.append(output.inner_text().split(" ", 2)[1])
        expect(page.locator(".cm-played")).to_have_text(PLAIN.splitlines()[int(seen[-1]) - 1])
    assert seen == ["2", "3", "3", "4"]
    expect(output).to_contain_text("X80.000")
    # From the end of the path to the end of the block before it.
    page.get_by_role("button", name="Measure").click()
    place.focus()
    page.keyboard.press("Enter")
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("Enter")
    # Beside the radius R2.: X64 on the face, a diameter.
    expect(page.locator(".readout dl")).to_contain_text("8.000 mm")
    expect(page.locator(".readout dl")).to_contain_text("-16.000 mm")
    page.get_by_role("button", name="File").click()
    page.get_by_role("menuitem", name="Open from the folder").click()
    page.get_by_role("button", name="second.nc").click()
    page.get_by_label("Control", exact=True).select_option("fanuc-lathe")
    do(page, "Compare with first.nc")
    expect(page.locator(".result .said")).to_contain_text(
        "different: 1 difference, the largest 0.5".replace(", the largest", ",")
    )
    expect(page.locator(".result pre")).to_contain_text("Z-20. becomes Z-20.5")
