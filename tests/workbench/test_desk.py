"""The desk of the workbench: every action through its one door, without a server."""

import gc
import json
from base64 import b64decode, b64encode
from pathlib import Path

import pytest
from click.testing import CliRunner
from workbench_page import Page

import contoursolve
from contoursolve.cli import main
from contoursolve.controls import CONTROLS
from contoursolve.gcode import decode
from contoursolve.notebook import Conversation, begin
from contoursolve.pictures import Theme
from contoursolve.workbench import Desk

ROOT = Path(__file__).parents[2]
START = "G00 X40. Z0.\n"
TAPER = f"{START}G111 X100. A180. K-30. B120. P5. Q5.\nM30\n"
BROKEN = TAPER.replace("P5.", "P60.")


def opened(text: str, control: str | None = None, name: str = "part.nc", folder: Path | None = None) -> Page:
    """A window with a program that a page has, and no file."""
    page = Page(Desk(folder))
    page.ask("open", name=name, text=text, control=control)
    return page


@pytest.mark.parametrize("control", CONTROLS)
def test_the_broken_program_of_every_control_is_opened_mended_and_saved(control, tmp_path):
    page = Page(Desk(tmp_path))
    seen = page.ask("open", example=control)
    assert (seen["control"]["name"], seen["control_from"]) == (control, "choice")
    assert seen["counts"] == {"contours": 1, "solved": 0, "errors": seen["counts"]["errors"], "warnings": 0}
    number = next(number for number, finding in enumerate(seen["findings"]) if finding["fixes"])
    wanted = page.text.split("\n")
    for each in reversed(seen["findings"][number]["fixes"][0]["lines"]):
        wanted[each["line"] - 1 : each["line"]] = [] if each["text"] is None else [each["text"]]
    fixed = page.ask("fix", finding=number, fix=0)
    assert page.text == "\n".join(wanted)
    assert (fixed["counts"]["errors"], fixed["counts"]["solved"]) == (0, 1)
    again = Page(page.desk)
    assert again.ask("open", name="x", text=page.text, control=control)["findings"] == page.view["findings"]
    saved = page.ask("save", name="new.nc")
    assert (tmp_path / saved["saved"]).read_bytes() == page.text.encode()
    assert not page.ask("view")["has_changes"]


FIX = {"kind": "changes-contour", "effect": ""}  # where no contour is, none is changed
ENDS = "the contour ends at Z-50.207 mm X100.000 mm"
SOURCE = "YASNAC LX3 Instruction Manual, 2.8.30; the family's alarms (derived)"
FOUND = {"severity": "error", "line": 3, "from": 29, "to": 33, "source": SOURCE, "alarm": "alarm 146 (assumed)"}


def test_a_page_is_told_all_that_it_shows_of_a_program_and_later_only_what_changes():
    text = f"(\N{GRINNING FACE})\n{BROKEN}"
    page = opened(text)
    block, fixes = "G111 X100. A180. K-30. B120. {}Q5.", []
    for title, word in (
        (f"write P6. for P60. (a zero too many) -> {ENDS}, the first corner with radius 6.000 mm", "P6. "),
        (f"write P51.961 for P60. -> {ENDS}, the first corner with radius 51.961 mm", "P51.961 "),
        (f"delete P60. -> {ENDS}, without the first corner", ""),
    ):
        fixes.append({"title": title, **FIX, "lines": [{"line": 3, "text": block.format(word)}]})
    shown = {
        "id": page.program,
        "name": "part.nc",
        "seq": 0,
        "base": "",
        "encoding": "utf-8",
        "has_order_mark": False,
        "line_end": "\n",
        "has_changes": True,
        "control": {"name": "yasnac-lx3", "title": "YASNAC LX3 lathe control", "machines": ["lathe"]},
        "control_from": "program",
        "trouble_control": "",
        "unit": "mm",
        "lines": 5,
        "examined": 5,
        "counts": {"contours": 1, "solved": 0, "errors": 2, "warnings": 0},
    }
    first = {
        "code": "g111-corner-too-large",
        **FOUND,
        "fixes": fixes,
        "message": "the rounding P60. does not fit: P60. is 60.000 mm, "
        "at most 51.961 mm fits on the diameter X40 from Z0 to Z-30",
        "notes": ["the diameter X40 from Z0 to Z-30 is 30.000 mm long; the rounding P60. takes 34.641 mm of it"],
        "help": "write at most 51.961 mm, or make the lines longer",
        "labels": [{"line": 3, "from": 29, "to": 33, "text": "at most 51.961 mm"}],
    }
    second = {
        "code": "g111-corners-overlap",
        **FOUND,
        "fixes": [],
        "notes": [],
        "message": "P60. and Q5. overlap on the second straight: they need 37.528 mm, the line has 34.641 mm",
        "help": "write at most 51.961 mm for P60.",
        "labels": [{"line": 3, "from": 29, "to": 33, "text": "at most 51.961 mm beside Q5."}],
    }
    contour = {"line": 3, "last": 3, "status": "no-solution", "told": "cannot be cut", "title": "G111"}
    lists = {"text": text, "findings": [first, second], "more_findings": 0, "contours": [contour]}
    assert page.ask("view") == {**shown, **lists}
    assert page.ask("go_on") == shown
    # Behind the contour nothing else is found; above it, its lines are others.
    assert page.type("M30", "M30 (END)") == {**shown, "seq": 1}
    assert {*page.type("(\N{GRINNING FACE})", "\n")} == {*shown, "findings", "contours"}
    assert [each["line"] for each in (*page.view["findings"], *page.view["contours"])] == [4, 4, 4]
    mended = page.type("P60.", "P6.")
    assert mended == {
        **shown,
        "seq": 3,
        "lines": 6,
        "examined": 6,
        "findings": [],
        "counts": {"contours": 1, "solved": 1, "errors": 0, "warnings": 0},
        "contours": [{**contour, "line": 4, "last": 4, "status": "solved", "told": "solved"}],
    }


GONE = {"trouble": "the workbench does not have this program any more; open it again", "is_gone": True}
OLD = {"trouble": "this was meant for another text of the program; nothing was changed", "is_old": True}


@pytest.mark.parametrize(
    ("action", "reply"),
    [
        ({}, "nothing is called None here"),
        ({"do": 3}, "nothing is called 3 here"),
        ({"do": "none"}, "nothing is called 'none' here"),
        ({"do": "view", "program": "x"}, GONE),
        ({"do": "open", "control": "abacus"}, "'abacus' is no control here"),
        ({"do": "open", "example": "abacus"}, "'abacus' is no control here"),
        ({"do": "open", "example": 3}, "open needs a text for example; nothing was changed"),
        ({"do": "open", "base64": "!"}, "the file did not arrive whole; drop it again"),
        *(
            (
                {"do": "open", "text": "", **wrong},
                "programs are in utf-8 or latin-1, with lines that end in LF, CRLF or CR",
            )
            for wrong in ({"encoding": "utf-16"}, {"line_end": "\n\n"})
        ),
        ({"do": "edit", "edits": 3}, "edits are a list of {from, to, text}; nothing was changed"),
        ({"do": "edit", "edits": [], "seq": 1}, {**OLD, "text": BROKEN, "seq": 0}),
        ({"do": "fix", "finding": 0, "fix": 0, "seq": 1}, {**OLD, "text": BROKEN, "seq": 0}),
        ({"do": "fix", "finding": True, "fix": 0}, "fix needs a whole number for finding; nothing was changed"),
        ({"do": "fix", "finding": -1, "fix": 0}, "there is no finding 0 here; nothing was changed"),
        pytest.param(
            *({"do": "fix", "finding": 2, "fix": 0}, "there is no finding 3 here; nothing was changed"),
            marks=pytest.mark.boundary,
        ),
        ({"do": "fix", "finding": 0, "fix": -1}, "there is no fix 0 of this finding; nothing was changed"),
        pytest.param(
            *({"do": "fix", "finding": 0, "fix": 3}, "there is no fix 4 of this finding; nothing was changed"),
            marks=pytest.mark.boundary,
        ),
        ({"do": "fix_all", "kind": "all"}, "all fixes are applied by kind: safe, or likely"),
        ({"do": "look", "line": "2"}, "look needs a whole number for line; nothing was changed"),
        ({"do": "look", "line": 1}, {"line": None, "last": None}),
        ({"do": "act", "line": 1, "action": {"do": "undo"}}, {"line": None, "last": None}),
        ({"do": "convert", "to": "abacus"}, "'abacus' is no control here"),
        ({"do": "convert"}, "convert needs a text for to; nothing was changed"),
        ({"do": "dxf"}, "no contour is solved, so that nothing can be drawn"),
        ({"do": "tool", "tool": 5}, "tool needs a text for tool; nothing was changed"),
        ({"do": "tool", "tool": "R-1"}, "the radius of the tool is R-1; it must not be less than 0"),
        ({"do": "expand", "post": "none"}, "unknown post 'none'; choose from same, linuxcnc, fanuc"),
        ({"do": "expand", "decimals": True}, "expand needs a whole number for decimals; nothing was changed"),
        *(
            (
                {"do": "variables", "values": {"#1": value}},
                "values of variables are numbers up to 1,000,000,000",
            )
            for value in ("x", float("nan"), 10**400, -1_000_000_001)
        ),
        ({"do": "variables", "values": {"nothing": 1}}, "there is no variable NOTHING; variables are called #100"),
    ],
    ids=str,
)
def test_what_cannot_be_done_is_one_sentence_and_changes_nothing(action, reply):
    page = opened(BROKEN)
    wanted = {"trouble": reply} if isinstance(reply, str) else reply
    assert page.desk.answer({"window": "a", "program": page.program, "seq": 0, **action}) == wanted
    assert (page.ask("view")["text"], page.view["seq"]) == (BROKEN, 0)


def test_without_a_word_of_a_control_nothing_is_made():
    page = opened("X1\nM30")
    assert (page.view["control"], page.view["control_from"], page.view["unit"]) == (None, "none", "")
    assert page.ask("drawing") == {"trouble": "no word tells the control; choose it, or write the program first"}


def test_fixes_of_a_kind_are_applied_at_once_and_those_left_are_told():
    page = opened(BROKEN)
    assert (page.ask("fix_all")["edits"], page.view["applied"], page.view["left"]) == ([], 0, [])
    likely = page.ask("fix_all", kind="likely")
    assert likely["edits"] == [{"from": 44, "to": 45, "text": ""}]
    assert (likely["applied"], likely["left"], likely["seq"]) == (1, [], 1)
    assert page.ask("view")["text"] == page.text


@pytest.mark.parametrize("most", [pytest.param(each, marks=pytest.mark.boundary) for each in (16, 17)])
def test_a_window_has_the_last_sixteen_programs(most):
    page = Page(Desk())
    numbers = [page.ask("open", name=f"{number}.nc", text="M30")["id"] for number in range(most)]
    gone = [number for number in numbers if page.ask("view", program=number) == GONE]
    assert gone == numbers[: most - 16]
    # What is asked for is the newest; what is closed is gone.
    page.ask("open", name="more.nc", text="M30")
    assert page.ask("view", program=numbers[-16]) == GONE
    assert page.ask("close", program=numbers[-1]) == {}
    assert page.ask("view", program=numbers[-1]) == GONE


@pytest.mark.parametrize("most", [pytest.param(each, marks=pytest.mark.boundary) for each in (32, 33)])
def test_a_desk_has_the_last_thirty_two_windows_and_each_its_own_programs(most):
    desk = Desk()
    pages = [Page(desk, f"window {number}") for number in range(most)]
    for page in pages:
        page.ask("open", name="a.nc", text="M30")
    assert pages[1].ask("view", program=pages[2].program) == GONE
    assert pages[1].ask("view")["text"] == "M30"
    assert (pages[0].ask("view") == GONE) == (most > 32)


def examined() -> int:
    """How many programs are open and examined in this process."""
    gc.collect()
    return sum(isinstance(each, contoursolve.OpenProgram) for each in gc.get_objects())


def test_eight_programs_stay_examined_and_the_others_come_back_as_they_were():
    desk, before = Desk(), examined()
    pages = [Page(desk, f"window {number}") for number in range(9)]
    for number, page in enumerate(pages, 1):
        page.ask("open", name="a.nc", text=BROKEN if number == 1 else "M30")
        page.type("M30", "M30 (END)")
        if number >= 8:
            assert examined() - before == 8
    # A page need not ask again for what it shows before it takes a fix.
    assert pages[0].ask("fix", finding=0, fix=0)["counts"]["errors"] == 0
    for page in pages:
        seen = page.ask("view")
        assert (seen["text"], seen["has_changes"]) == (page.text, True)
    assert [page.seq for page in pages] == [2, *[1] * 8]


@pytest.mark.parametrize("lines", [pytest.param(each, marks=pytest.mark.boundary) for each in (100_000, 100_001)])
@pytest.mark.slow
def test_two_hundred_thousand_lines_stay_examined(lines):
    desk, before = Desk(), examined()
    for each in (100_000, lines):
        desk.answer({"window": str(each), "do": "open", "name": "a.nc", "text": "\n" * (each - 1)})
    assert examined() - before == (2 if lines == 100_000 else 1)


def test_an_edit_of_a_long_program_says_only_what_it_changed(monkeypatch):
    """How much is sent does not depend on the length of the program."""
    # However busy the machine is, it is examined at once.
    monkeypatch.setattr("contoursolve.workbench.open_view.MOMENT", 600)
    sizes = []
    for contours in (20, 80):
        wrong = "G111 X100. A180. K-30. B120. P60.\nG00 X40. Z0.\n"
        page = opened(START + wrong * 3 + wrong.replace("P60.", "P5.") * contours + "M30")
        assert page.view["counts"]["errors"] == 3
        same = page.type("M30", "M30 (END)")
        assert not {"findings", "contours", "text"} & same.keys()
        broken = page.type("P5.\nG00 X40. Z0.\nM30", "P60.\nG00 X40. Z0.\nM30")
        assert len(broken["findings"]) == 4
        sizes.append(len(json.dumps(same)))
    assert abs(sizes[0] - sizes[1]) < 20


def test_no_more_than_500_findings_are_shown():
    for lines, shown, more in ((250, 499, 0), (251, 500, 1)):
        page = opened("G00 X0 Y0\n" + "G01 X1. Q=2\n" * lines, "fanuc-mill")
        assert (len(page.view["findings"]), page.view["more_findings"]) == (shown, more)


def test_each_product_is_that_of_the_command_of_its_name():
    text = TAPER.replace("\n", "\r\n")
    page = Page(Desk())
    page.ask("open", name="part.nc", base64=b64encode(text.encode()).decode())
    result = contoursolve.solve(text)
    drawn = contoursolve.pictures.draw(result, theme=Theme.PAGE)
    shown = page.ask("drawing")
    assert [shown[key] for key in ("svg", "title", "description")] == [drawn.svg, drawn.title, drawn.description]
    assert b64decode(page.ask("expand", comments=False)["base64"]) == (
        contoursolve.expand(text, comments=False).text.encode()
    )
    for control, ending in (("siemens-840d", ".mpf"), ("fanuc-lathe", ".nc")):
        made = page.ask("convert", to=control)
        assert made["name"] == f"part-{control}{ending}"
        assert b64decode(made["base64"]) == contoursolve.convert(text, control, name="part.nc").text.encode()
    for kind, beginning, message in (
        ("report", b"<!doctype html>", ""),
        ("dxf", b"  0\nSECTION", "4 elements of 1 contour"),
        ("png", b"\x89PNG", "G111 (taper multiple cornering), program line 2: solved"),
    ):
        made = page.ask(kind)
        assert (made["name"], made["message"]) == (f"part.{'html' if kind == 'report' else kind}", message)
        assert b64decode(made["base64"]).startswith(beginning)
    # A file without a name or an ending gets one.
    for name, wanted in (("part", "part-plain.nc"), (".h", ".h-plain.nc"), ("a.b.mpf", "a.b-plain.mpf")):
        assert opened(text, name=name).ask("expand")["name"] == wanted


def test_what_a_product_leaves_out_is_told_in_few_words():
    many = "".join(f"G{code}\n" for code in (65, 66, 43.4, 68.2, 5.1))
    left = opened(f"G21 G40 G18\n{TAPER}{many}").ask("convert", to="siemens-840d")
    more = left["details"].count("\n") - 2
    assert left["message"].endswith(f"; and {more} more: contoursolve convert lists all")
    assert [each["line"] for each in left["not_converted"]] == sorted(each["line"] for each in left["not_converted"])
    assert {*left["not_converted"][0]} == {"line", "text", "reason"}
    assert opened(BROKEN).ask("expand")["trouble"].startswith("program line 2: g111-corner-too-large: ")
    assert (
        "a program is converted for the same kind of machine"
        in opened(TAPER).ask("convert", to="heidenhain")["trouble"]
    )


def test_a_program_is_verified_without_the_solver_in_a_sentence():
    page = opened(TAPER)
    verified = page.ask("verify")
    told = "Checked again without the solver: the contour is as shown."
    assert (verified["verdict"], verified["message"], verified["name"]) == ("verified", told, "")
    assert verified["details"].startswith(
        "part.nc:2: G111: the result says solved: verified (64 checks, off by less than"
    )
    again = "G00 X40. Z0.\nG111 A180. K-30. {}\n"
    mixed = opened(TAPER + again.format("") + again.format("B120. X100. P500.")).ask("verify")
    assert mixed["message"] == (
        "Checked again without the solver: 1 of 3 contours has a path that agrees with its words. "
        "2 of 3 contours without a path to check: 2 cannot be cut."
    )
    assert "\npart.nc:5: G111: the result says cannot be cut: not checked" in mixed["details"]


def test_a_tool_is_shown_beside_the_contour_with_the_largest_that_fits():
    page = opened(TAPER)
    for tool, fits, codes in (
        ("R6., tip 3", False, ["tool-arc-too-small", *["tool-uncompensated"] * 3]),
        ("R2., tip 3", True, ["tool-uncompensated"] * 3),
    ):
        cut = page.ask("tool", tool=tool, side="right")
        title = f"path of the tip for nose {tool.replace('.,', ',')}, right of the contour"
        assert [each["code"] for each in cut["findings"]] == codes
        assert cut["runs"] == [{"line": 2, "last": 2, "title": title, "fits": fits, "largest_mm": 5.0}]
        assert (cut["largest_mm"], [each["fixes"] for each in cut["findings"]]) == (5.0, [[]] * len(codes))


def test_a_program_along_the_path_of_its_tool_is_that_of_the_command_line(tmp_path):
    text = "G21 G40 G18\nG00 X40. Z5.\n{}G42 G00 X20. Z2. D1\nG01 Z-10. F0.2\nX30. Z-20.\nZ-30.\nG40 X50.\nM30\n"
    for name, tool, words in (("a.nc", {"tool": "R0.8", "tip": 3}, ("R0.8", "--tip", "3")), ("b.nc", {}, ("program",))):
        stated = "" if tool else "(contoursolve tool: R0.4, tip 3)\n"
        (tmp_path / name).write_text(text.format(stated))
        page = Page(Desk(tmp_path))
        page.ask("open", name=name, control="fanuc-lathe")
        command = ["expand", str(tmp_path / name), "--control", "fanuc-lathe", "--tool", *words]
        plain = CliRunner().invoke(main, command).stdout
        made = page.ask("expand", **(tool or {"tool": "program"}))
        assert b64decode(made["base64"]).decode() == plain != text.format(stated)
        assert made["name"] == f"{name[0]}-tool.nc"
        # A drawing has the tool that the program itself states.
        assert ("nose R0.4, tip 3" in page.ask("drawing")["description"]) == (name == "b.nc")
    page.ask("open", name="a.nc", control="fanuc-lathe")
    assert "0 to 9; state it, as in R0.8, tip 3" in page.ask("expand", tool="R1")["trouble"]


def test_the_way_around_outside_corners_is_that_of_the_program():
    drawn = {}
    for code in ("G450", "G451"):
        text = f"G17 G90 G71 G40 {code}\nG0 X-20 Y0\nG41 G1 X0 Y0 F500\nY30 RND=1\nX40\nY0\nX50\nG40 G0 Y-20\nM30\n"
        page = opened(text, "siemens-840d")
        drawn[code] = [page.ask("tool", tool="R5", outside=way)["svg"] for way in ("", "roll", "intersect")]
    assert drawn["G450"][0] == drawn["G450"][1] != drawn["G450"][2]
    assert drawn["G451"][0] == drawn["G451"][2] != drawn["G451"][1]


def test_the_variables_of_a_subprogram_have_fields_and_their_values_show_what_it_does():
    page = opened("#10=7.\n#5=10\nG00 X40. Z0.\nG01 Z-30. ,R#5\nX#1 ,A#2 F#5041\n", "fanuc-lathe")
    asked = page.ask("variables")
    fields = [("#1", 5, None, None), ("#2", 5, None, None), ("#5", 2, 2, 10.0), ("#10", 1, 1, 7.0)]
    assert [tuple(each[name] for name in ("name", "line", "set_on", "number")) for each in asked["fields"]] == fields
    contour = {"line": 4, "last": 5, "status": "underdetermined", "told": "not enough given", "title": "corners"}
    assert asked["contours"] == [contour]
    assert ([each["fixes"] for each in asked["findings"]], asked["left_out"]) == ([[]], 0)
    given = page.ask("variables", values={"#1": 100.0, "#2": 120})
    assert given["contours"] == [{**contour, "status": "solved", "told": "solved"}]
    assert [each["value"] for each in given["fields"]] == [100.0, 120, None, None]
    page.ask("open", name="o.nc", control="fanuc-lathe", text="O9\nG01 X#24\nX[#24-#4*2.] ,A251. ,R0.5\nW-3.\nM99\n")
    for start, status in ((None, "underdetermined"), (" ", "underdetermined"), (" X60. Z2.", "solved")):
        found = page.ask("variables", values={"#24": 60, "#4": 8}, start=start)
        assert [each["status"] for each in found["contours"]] == [status]
    page.ask("open", name="many.nc", control="fanuc-lathe", text="".join(f"#{each}=1\n" for each in range(100, 302)))
    many = page.ask("variables", values={"#100": 1_000_000_000})
    assert (len(many["fields"]), many["left_out"]) == (200, 2)


def test_the_control_comes_from_a_choice_a_comment_the_project_file_or_the_words(tmp_path):
    settings = tmp_path / "contoursolve.toml"
    (tmp_path / "a.nc").write_text(BROKEN)
    page = Page(Desk(tmp_path))
    for text, told in (
        ('control = "none"\n', f"{settings}, line 1: there is no control 'none'; choose from {', '.join(CONTROLS)}"),
        ("nothing = [", f"{settings} cannot be read: Invalid value (at end of document)"),
    ):
        settings.write_text(text)
        seen = page.ask("open", name="a.nc")
        assert (seen["control_from"], seen["trouble_control"], seen["counts"]["errors"]) == ("program", told, 2)
    settings.write_text('control = "haas-lathe"\n')
    assert page.ask("control", control="yasnac-lx3")["counts"]["errors"] == 2
    assert (page.view["control_from"], page.view["trouble_control"]) == ("choice", "")
    assert page.ask("control", control=None)["control_from"] == "project file"
    assert page.view["control"]["name"] == "haas-lathe"
    settings.unlink()
    (tmp_path / "b.nc").write_text("(contoursolve control: fanuc-lathe)\nM30")
    assert page.ask("open", name="b.nc")["control_from"] == "comment"


def test_the_words_of_a_contour_in_the_explorer_have_their_places():
    page = opened(f"(\N{GRINNING FACE})\n{TAPER}")
    looked = page.ask("look", line=3)
    places = {"X": [3, 5, 10], "A": [3, 11, 16], "K": [3, 17, 22], "B": [3, 23, 28], "P": [3, 29, 32], "Q": [3, 33, 36]}
    assert {**looked, "state": None} == {"line": 3, "last": 3, "seq": 0, "state": None, "words": places}
    moved = page.ask("act", line=3, action={"do": "move", "values": {"P": 4.75}})
    assert moved["edits"] == [{"from": 48, "to": 50, "text": "4.75"}]
    assert (moved["words"]["Q"], moved["seq"], moved["changed"]["view"]["text"].split()[5]) == ([3, 35, 38], 1, "P4.75")
    assert page.ask("view")["text"] == page.text
    # After the text was changed by hand, all of its state is told.
    page.type("P4.75", "P3.")
    again = page.ask("act", line=3, action={"do": "undo"})
    assert ("state" in again, "edits" in again, again["words"]["Q"]) == (True, False, [3, 33, 36])


PROGRAMS = [*(ROOT / "docs" / "programs").glob("*.*"), *(ROOT / "notebooks" / "programs").glob("*.nc")]
READ = sorted(each for each in PROGRAMS if each.suffix != ".dxf")[::2]
NAMED = {"plate.nc": "nct-99m", "cover.nc": "nct-99m", "bracket.nc": "isg", "flange.mpf": "siemens-840d"}


@pytest.mark.parametrize("path", READ, ids=lambda path: path.name)
def test_a_contour_in_the_explorer_is_that_of_the_whole_program(path):
    """The desk examines only what a move makes necessary; the explorer of a notebook solves all of it each time."""
    text, control = decode(path.read_bytes(), path.name), NAMED.get(path.name)
    page = Page(Desk())
    contours = page.ask("open", name=path.name, text=text, control=control)["contours"]
    for contour in contours[: 1 if len(contours) > 3 else 2]:  # each move solves all of them
        line = contour["line"]
        looked = page.ask("look", line=line)
        if "state" not in looked:
            assert "one each time it runs" in looked["trouble"]
            continue
        alone = Conversation(begin(page.text, line=line, control=page.view["control"]["name"]))
        assert looked["state"]["view"]["findings"] == alone.state["view"]["findings"]
        keys = [each["key"] for each in alone.state["view"]["fields"][:2]]
        fix = {"do": "fix", "finding": 0, "fix": 0}
        for action in (*({"do": "move", "values": {key: 7.5}} for key in keys), {"do": "undo"}, fix):
            wanted = alone.answer(dict(action))["view"]
            found = page.ask("act", line=looked["line"], action=dict(action))
            if wanted["text"]:
                assert found["changed"]["view"]["findings"] == wanted["findings"]
            assert page.text == alone.exploration.text.replace("\r\n", "\n")
            assert page.ask("view")["text"] == page.text
            if found["line"] is None or alone.exploration.answer is None:
                break
            looked = found
        page.text = text.replace("\r\n", "\n")
        page.ask("edit", text=page.text)
