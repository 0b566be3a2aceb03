"""The desk of the workbench: every action through its one door, without a server."""

import json
from base64 import b64decode, b64encode
from pathlib import Path

import pytest
from click.testing import CliRunner
from workbench_page import Page

import contoursolve
from contoursolve.cli import main
from contoursolve.controls import DIALECTS
from contoursolve.gcode import decode
from contoursolve.notebook import Conversation, begin
from contoursolve.pictures import Theme
from contoursolve.workbench import Desk
from contoursolve.workbench.desk import MOST_EXAMINED
from contoursolve.workbench.open_view import ProgramView

ROOT = Path(__file__).parents[2]
BROKEN = b"%\r\nO1\r\n\r\nG00 X40. Z0.\r\n  G111 X100. A180. K-30. B120. P60. \r\nM30\n"


@pytest.mark.parametrize("control", DIALECTS)
def test_the_broken_program_of_every_control_is_opened_mended_and_saved(control, tmp_path):
    page = Page(Desk(tmp_path))
    opened = page.ask("open", example=control)
    assert opened["control"]["name"] == control
    assert opened["counts"]["errors"] > 0
    for number, finding in enumerate(opened["findings"]):
        if finding["fixes"]:
            fixed = page.ask("fix", finding=number, fix=0)
            break
    assert fixed["counts"]["errors"] < opened["counts"]["errors"]
    again = Page(page.desk)
    assert again.ask("open", name="x", text=page.text, control=control)["findings"] == page.view["findings"]
    saved = page.ask("save", name="new.nc")
    assert (tmp_path / saved["saved"]).read_bytes() == page.text.encode()
    assert not page.ask("view")["has_changes"]


def test_a_saved_program_keeps_every_byte_that_nobody_changed(tmp_path):
    data = "(Ø, Bohrung 😀)\r\n".encode() + BROKEN
    (tmp_path / "part.nc").write_bytes(data)
    page = Page(Desk(tmp_path))
    page.ask("open", name="part.nc")
    assert page.text == data.decode().replace("\r\n", "\n")
    page.type("P60.", "P5.\nG01 Z-60.")
    page.ask("look", line=6)
    page.ask("act", line=6, action={"do": "move", "values": {"P": 6}})
    assert "P6. " not in page.text
    assert page.text == data.decode().replace("\r\n", "\n").replace("P60.", "P6.\nG01 Z-60.")
    page.ask("save")
    assert (tmp_path / "part.nc").read_bytes() == data.replace(b"P60.", b"P6.\r\nG01 Z-60.")


def test_an_edit_of_a_long_program_says_only_what_it_changed(monkeypatch):
    """How many findings are put into words, and how much is sent, does not depend on the length of the program."""
    counts = []
    for contours in (20, 80):
        wrong = "G111 X100. A180. K-30. B120. P60.\nG00 X40. Z0.\n"
        page = Page(Desk())
        page.ask(
            "open", name="a.nc", text="G00 X40. Z0.\n" + wrong * 3 + wrong.replace("P60.", "P5.") * contours + "M30"
        )
        assert page.view["counts"]["errors"] == 3
        told, shown = [], ProgramView.told

        def count(view, finding, lines, told=told, shown=shown):
            told.append(finding)
            return shown(view, finding, lines)

        monkeypatch.setattr(ProgramView, "told", count)
        same = page.type("M30", "M30 (END)")
        assert not {"findings", "contours", "text"} & same.keys()
        assert told == []
        broken = page.type("P5.\nG00 X40. Z0.\nM30", "P60.\nG00 X40. Z0.\nM30")
        assert (len(told), len(broken["findings"])) == (1, 4)
        counts.append((len(told), len(json.dumps(same))))
        monkeypatch.undo()
    assert counts[0][0] == counts[1][0]
    assert abs(counts[0][1] - counts[1][1]) < 20


def test_each_product_is_that_of_the_command_of_its_name(tmp_path):
    page, text = Page(Desk(tmp_path)), "G00 X40. Z0.\r\nG111 X100. A180. K-30. B120. P5.\r\n"
    page.ask("open", name="part.nc", base64=b64encode(text.encode()).decode())
    drawn = page.ask("drawing")
    assert drawn["svg"] == contoursolve.pictures.draw(contoursolve.solve(text), theme=Theme.PAGE).svg
    plain = b64decode(page.ask("expand", comments=False)["base64"])
    assert plain == contoursolve.expand(text, comments=False).text.encode()
    assert page.ask("convert", to="siemens-840d")["name"].endswith("-siemens-840d.mpf")
    other = b64decode(page.ask("convert", to="fanuc-lathe")["base64"])
    assert other == contoursolve.convert(text, "fanuc-lathe").text.encode()
    many = "".join(f"G{code}\r\n" for code in (65, 66, 43.4, 68.2, 5.1))
    page.ask("open", name="many.nc", base64=b64encode(("G21 G40 G18\r\n" + text + many).encode()).decode())
    left = page.ask("convert", to="siemens-840d")
    count = len(left["details"].split("\n"))
    assert left["message"].endswith(f"; and {count - 3} more: contoursolve convert lists all")
    page.ask("open", name="part.nc", base64=b64encode(text.encode()).decode())
    verified = page.ask("verify")
    assert verified["verdict"] == "verified"
    assert verified["message"] == "Checked again without the solver: the contour is as shown."
    assert "SHA-256" in verified["details"]
    again = "G00 X40. Z0.\r\nG111 A180. K-30. {}\r\n"
    mixed = text + again.format("") + again.format("B120. X100. P500.")
    page.ask("open", name="mixed.nc", base64=b64encode(mixed.encode()).decode())
    told = page.ask("verify")
    assert told["message"] == (
        "Checked again without the solver: 1 of 3 contours has a path that agrees with its words. "
        "2 of 3 contours without a path to check: 1 without a solution, 1 refused."
    )
    assert "mixed.nc:4: G111: said to be refused: not checked" in told["details"]
    page.ask("open", name="part.nc", base64=b64encode(text.encode()).decode())
    for kind, beginning in (("report", b"<!doctype html>"), ("dxf", b"  0\nSECTION"), ("png", b"\x89PNG")):
        assert b64decode(page.ask(kind)["base64"]).startswith(beginning)
    cut = page.ask("tool", tool="R6., tip 3", side="right")
    assert not cut["runs"][0]["fits"]
    assert cut["largest_mm"] == pytest.approx(5.0)
    assert {each["code"] for each in cut["findings"]} != set()
    for wrong in (
        {"do": "tool", "tool": "R-1"},
        {"do": "tool", "tool": 5},
        {"do": "convert", "to": "heidenhain"},
        {"do": "convert"},
        {"do": "expand", "post": "none"},
        {"do": "expand", "decimals": True},
        {"do": "variables", "values": {"Q": "x"}},
        {"do": "variables", "values": {"#1": float("nan")}},
        {"do": "variables", "values": {"#1": 10**400}},
    ):
        assert [*page.ask(**wrong)] == ["trouble"]


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
    page.ask("open", name="a.nc", control="fanuc-lathe")
    assert "0 to 9; state it, as in R0.8, tip 3" in page.ask("expand", tool="R1")["trouble"]
    assert "the radius of the tool is R-1" in page.ask("expand", tool="R-1")["trouble"]


def test_the_way_around_outside_corners_is_that_of_the_program():
    page, drawn = Page(Desk()), {}
    for code in ("G450", "G451"):
        text = f"G17 G90 G71 G40 {code}\nG0 X-20 Y0\nG41 G1 X0 Y0 F500\nY30 RND=1\nX40\nY0\nX50\nG40 G0 Y-20\nM30\n"
        page.ask("open", name=f"{code}.mpf", control="siemens-840d", text=text)
        drawn[code] = {each: page.ask("tool", tool="R5", **of)["svg"] for each, of in WAYS.items()}
    assert drawn["G450"]["stated"] == drawn["G450"]["roll"] != drawn["G450"]["intersect"]
    assert drawn["G451"]["stated"] == drawn["G451"]["intersect"] != drawn["G451"]["roll"]


WAYS = {"stated": {}, "roll": {"outside": "roll"}, "intersect": {"outside": "intersect"}}


def test_the_variables_of_a_subprogram_have_fields_and_their_values_show_what_it_does():
    page = Page(Desk())
    page.ask("open", name="q.nc", control="fanuc-lathe", text="#5=10\nG00 X40. Z0.\nG01 Z-30. ,R#5\nX#1 ,A#2 F#5041\n")
    asked = page.ask("variables")
    assert [(each["name"], each["set_on"]) for each in asked["fields"]] == [("#1", None), ("#2", None), ("#5", 1)]
    assert [each["number"] for each in asked["fields"]] == [None, None, 10.0]
    # The drawing names its state so.
    assert [asked["contours"][0][each] for each in ("status", "told")] == ["underdetermined", "incomplete"]
    assert page.ask("variables", values={"#1": 100.0, "#2": 120})["contours"][0]["status"] == "solved"
    assert "there is no variable" in page.ask("variables", values={"nothing": 1})["trouble"]
    page.ask("open", name="o.nc", control="fanuc-lathe", text="O9\nG01 X#24\nX[#24-#4*2.] ,A251. ,R0.5\nW-3.\nM99\n")
    given = {"#24": 60, "#4": 8}
    assert page.ask("variables", values=given)["contours"][0]["status"] == "underdetermined"
    assert page.ask("variables", values=given, start="X60. Z2.")["contours"][0]["status"] == "solved"


@pytest.mark.slow
def test_programs_that_nobody_has_used_lately_rest_and_come_back_as_they_were(monkeypatch):
    desk = Desk()
    pages = [Page(desk, f"window {number}") for number in range(2 * MOST_EXAMINED)]
    for page in pages:
        page.ask("open", name="a.nc", text=BROKEN.decode())
        page.type("P60.", "P5.")
    resting = [each for window in desk._windows.values() for each in window.programs.values() if not each.line_count]
    assert len(resting) == MOST_EXAMINED
    for page in pages:
        seen = page.ask("view")
        assert (seen["text"], seen["has_changes"], seen["seq"]) == (page.text, True, 1)
        assert page.type("P5.", "P60.")["counts"]["errors"] == 1
    # A page that comes back has its own programs, and never one of another desk.
    other = Page(Desk())
    other.ask("open", name="b.nc", text="M30")
    assert Page(other.desk).ask("view", program=pages[0].program)["is_gone"]


def test_a_project_file_that_is_wrong_is_told_and_keeps_no_program_closed(tmp_path):
    (tmp_path / "contoursolve.toml").write_text('control = "none"\n')
    (tmp_path / "a.nc").write_bytes(BROKEN)
    page = Page(Desk(tmp_path))
    assert "none" in page.ask("open", name="a.nc")["trouble_control"]
    assert page.ask("control", control="yasnac-lx3")["counts"]["errors"] == 1
    (tmp_path / "contoursolve.toml").write_text('control = "yasnac-lx3"\n')
    assert page.ask("control", control=None)["control_from"] == "project file"
    (tmp_path / "contoursolve.toml").write_text("nothing = [")
    assert page.ask("open", name="a.nc")["trouble_control"]


PROGRAMS = [*(ROOT / "docs" / "programs").glob("*.*"), *(ROOT / "notebooks" / "programs").glob("*.nc")]
READ = sorted(each for each in PROGRAMS if each.suffix != ".dxf")
CONTROLS = {"plate.nc": "nct-99m", "cover.nc": "nct-99m", "bracket.nc": "isg", "flange.mpf": "siemens-840d"}


@pytest.mark.parametrize("path", READ, ids=lambda path: path.name)
def test_a_contour_in_the_explorer_is_that_of_the_whole_program(path):
    """The desk examines only what a move makes necessary; the explorer of a notebook solves all of it each time."""
    text, control = decode(path.read_bytes(), path.name), CONTROLS.get(path.name)
    page = Page(Desk())
    contours = page.ask("open", name=path.name, text=text, control=control)["contours"]
    for contour in contours[:2]:
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
