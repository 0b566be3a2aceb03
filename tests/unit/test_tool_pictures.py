"""The tool in pictures, pages, drawings for CAD and the explorer: what is drawn against the numbers of the JSON."""

import json
import re
from math import dist
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner

from contoursolve.cli import main
from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration import begin
from contoursolve.pictures import LIGHT_COLORS, Role

SVG = "{http://www.w3.org/2000/svg}"
TAPER = "G00 X20. Z2.\nG01 G42 X20. Z0. F0.2\nZ-10.\nX30. Z-20.\nZ-30.\nG40 X40."
NECK = "G17\nG00 X-4. Y40.\nG01 G41 Y20. F300.\nY9.1652\nG03 X4. Y9.1652 I4. J-9.1652\nG01 Y20.\nG40 Y40."
SMALL = "G00 X20. Z2.\nG01 G42 X20. Z0. F0.2\nZ-14.6\nG02 X20.8 Z-15. R0.4\nG01 X40.\nG40 X44."
NOSE = ("fanuc-lathe", "--tool", "R0.8", "--tip", "3")
BLOCK = "G111 X100. A180. K-30. B120. P5. Q5."


def call(*words: str | Path) -> str:
    done = CliRunner().invoke(main, [*map(str, words)])
    assert done.exit_code in (0, 1), done.output
    return done.stdout


class Drawn:
    """The picture that `plot` draws of a program with a tool, and its JSON."""

    def __init__(self, folder: Path, text: str, words: tuple[str, ...]) -> None:
        (folder / "a.nc").write_text(text)
        asked = ("--control", *words)
        call("plot", folder / "a.nc", "-o", folder / "a.svg", "--force", "--theme", "page", *asked)
        self.contours = json.loads(call("solve", folder / "a.nc", "--format", "json", *asked))["contours"]
        self.svg = (folder / "a.svg").read_text()
        self.tree = ElementTree.fromstring(self.svg)

    def strokes(self, role: Role) -> list[list[tuple[float, ...]]]:
        """The lines and arcs of a role in the drawing itself: each start, then each end (px); an end of an arc has its
        radius, too."""
        group = next(each for each in self.tree.iter(f"{SVG}g") if each.get("clip-path"))
        paths = [each.get("d") for each in group.iter(f"{SVG}path") if _is_of(each, role)]
        return [[_end(*step) for step in re.findall(r"([MLA])([^MLA]+)", path)] for path in paths]


def _is_of(path: ElementTree.Element, role: Role) -> bool:
    """Whether a stroke is of a role, and no leader of a text."""
    return path.get("class") == f"s-{role.value}" and path.get("stroke-width") != "0.9"


def _end(kind: str, numbers: str) -> tuple[float, ...]:
    found = [float(each) for each in re.split(r"[ ,]", numbers)]
    return (*found[-2:], found[0]) if kind == "A" else tuple(found)


def circles(drawn: Drawn, role: Role, scale: float, across: float, down: float) -> list[tuple[float, float, float]]:
    """The centres and the radii (mm) of the whole circles in the colour of a role."""
    found = [each for each in drawn.strokes(role) if len(each) == 3 and each[0] == each[2][:2] and len(each[1]) == 3]
    middles = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, b[2]) for a, b, _ in found]
    return [((x - across) / scale, (down - y) / scale, radius / scale) for x, y, radius in middles]


@pytest.mark.parametrize(
    ("text", "words", "at", "told", "stays"),
    [
        # TR-22: the tool rests between both neighbours, 0.1657 from the arc.
        (SMALL, NOSE, (-14.2, 10.8), "arc too small: 0.4 mm", True),
        # TR-25: beside one wall of the neck, 4 mm in the other one.
        (NECK, ("fanuc-mill", "--tool", "R6"), (2.0, 9.1652), "interference: 4 mm", False),
    ],
)
def test_what_does_not_fit_is_red_at_its_place_with_the_amount(tmp_path, text, words, at, told, stays):
    drawn = Drawn(tmp_path, text, words)
    assert drawn.contours[-1]["tool"]["elements"] is None
    assert not drawn.strokes(Role.TRACK)
    assert not drawn.strokes(Role.TOOL)
    (part,) = [each for each in drawn.strokes(Role.INK) if len(each) == len(drawn.contours[-1]["elements"]) + 1]
    places = [drawn.contours[-1]["start"], *(each["end"] for each in drawn.contours[-1]["elements"])]
    low, high = (pick(range(len(places)), key=lambda number: places[number][0]) for pick in (min, max))
    scale = (part[high][0] - part[low][0]) / (places[high][0] - places[low][0])
    across, down = part[0][0] - scale * places[0][0], part[0][1] + scale * places[0][1]
    ((*center, radius),) = circles(drawn, Role.CONFLICTING, scale, across, down)
    assert dist(center, at) < 0.01
    assert abs(radius - drawn.contours[-1]["tool"]["radius"]) < 0.01
    texts = [
        "".join(each.itertext())
        for each in drawn.tree.iter(f"{SVG}text")
        if each.get("fill") == LIGHT_COLORS[Role.CONFLICTING]
    ]
    assert told in texts
    assert any(each.startswith("error: ") for each in texts)
    assert bool(drawn.strokes(Role.REST)) is stays


def test_a_drawing_for_cad_has_the_path_of_the_tool_on_its_layer(tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    (tmp_path / "a.nc").write_text(TAPER)
    told = call("plot", tmp_path / "a.nc", "-o", tmp_path / "a.dxf", "--control", *NOSE)
    assert "a.dxf: 0 elements of 0 contours, 1 path of the tool" in told
    page = ezdxf.readfile(tmp_path / "a.dxf").modelspace()
    lines = [each for each in page if each.dxf.layer == "tool - program line 3" and each.dxftype() == "LINE"]
    assert [round(each, 4) for each in lines[0].dxf.end][:2] == [-10.6111, 10.0]
    assert sum(each.dxf.layer == "part - program line 3" for each in page) == 3


def test_the_explorer_moves_the_radius_of_the_tool():
    talk = Conversation(begin(BLOCK, start="X40. Z0.", tool="R0.8, tip 3", side="right"))
    field = next(each for each in talk.state["view"]["fields"] if each["key"] == "tool")
    assert (field["word"], field["value"], field["unit"]) == ("R0.8", 0.8, "mm")
    assert 'class="s-track"' in talk.state["view"]["picture"]
    talk.answer({"do": "range", "key": "tool", "number": 1})
    assert talk.state["ranges"]["tool"]["intervals"] == [[0.0, 5.0]]
    view = talk.answer({"do": "move", "values": {"tool": 6.0}, "number": 2})["view"]
    assert view["text"].endswith("(contoursolve tool: R6, tip 3)")
    assert view["findings"][0]["lines"][0][0][0] == "error[tool-arc-too-small]"
    assert view["findings"][0]["fixes"][0]["text"] == "write P6. for P5."
    assert "arc too small: 1 mm" in view["picture"]
    assert 'class="s-track"' not in view["picture"]
    view = talk.answer({"do": "fix", "finding": view["findings"][0]["fixes"][0]["finding"], "fix": 0, "number": 3})[
        "view"
    ]
    assert 'class="s-track"' in view["picture"]
    talk.answer({"do": "undo", "number": 4})
    assert "R6, tip 3" in talk.answer({"do": "move", "values": {"tool": -1.0}, "number": 5})["view"]["text"]
    assert "must not be less than 0" in talk.state["view"]["trouble"]
    assert "tool needs a number" in talk.answer({"do": "move", "values": {"tool": "x"}, "number": 6})["view"]["trouble"]


def test_a_second_click_on_a_fix_and_a_move_that_is_given_up_leave_nothing_behind():
    talk = Conversation(begin("G111 X100 A180 K-30 B120 P5 Q5", start="X40. Z0."))
    first = talk.state["view"]["findings"][0]["fixes"][0]
    action = {"do": "fix", "finding": first["finding"], "fix": first["number"], "of": talk.state["view"]["mark"]}
    talk.answer({**action, "number": 1})
    once = talk.exploration.text
    talk.answer({**action, "number": 2})
    assert talk.exploration.text == once
    talk.answer({"do": "undo", "number": 3})
    talk.answer({"do": "move", "values": {"K": -20}, "is_held": True, "number": 4})
    talk.answer({"do": "cancel", "number": 5})
    assert (talk.state["view"]["can_redo"], talk.state["view"]["can_undo"]) == (True, False)
    assert talk.answer({"number": 6})["view"]["trouble"]


@pytest.mark.parametrize(("tool", "side"), [("R0.8", "right"), ("R0.8, tip 3", None), ("8 mm", "right")])
def test_an_explorer_of_what_is_no_tool_says_what_to_write(tool, side):
    with pytest.raises(ValueError, match=r"write|give|state"):
        begin("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.", tool=tool, side=side)
