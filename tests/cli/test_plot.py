"""Drawings for CAD: what was written is read back with ezdxf and held against the contours."""

import io
import sys
from math import cos, hypot, radians, sin
from pathlib import Path

import pytest
from click.testing import CliRunner
from ezdxf import recover

import contoursolve
from contoursolve.cli import main
from contoursolve.geometry import Turn
from contoursolve.output.dxf import CONSTRUCTION, layer_name, to_dxf
from contoursolve.solving.contour import ArcSegment

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
INCH = "G20 G00 X2. Z0.\nG111 X4. A180. K-1. B120. P.2 Q.2"


def plot(*arguments, **options):
    done = CliRunner().invoke(main, ["plot", *map(str, arguments)], **options)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.exit_code, done.output


def read(data: bytes):
    """The drawing, as a program reads it that repairs nothing."""
    document, auditor = recover.read(io.BytesIO(data))
    assert auditor.errors == [] == auditor.fixes
    return document


def ends(entity):
    if entity.dxftype() == "LINE":
        return [tuple(entity.dxf.start)[:2], tuple(entity.dxf.end)[:2]]
    center, radius = entity.dxf.center, entity.dxf.radius
    angles = radians(entity.dxf.start_angle), radians(entity.dxf.end_angle)
    return [(center.x + radius * cos(angle), center.y + radius * sin(angle)) for angle in angles]


def close(one, other):
    return hypot(one[0] - other[0], one[1] - other[1]) < 1e-9


@pytest.mark.parametrize(
    ("text", "mm"),
    [(PROGRAMS.joinpath("shaft.nc").read_text(), 1.0), (PROGRAMS.joinpath("plate.nc").read_text(), 1.0), (INCH, 25.4)],
    ids=["lathe", "mill", "inches"],
)
def test_the_drawing_holds_every_element_on_its_layer_to_1e_9(text, mm):
    result = contoursolve.solve(text)
    document = read(to_dxf(result.answers))
    assert document.header["$INSUNITS"] == (4 if mm == 1.0 else 1)
    page = document.modelspace()
    is_split = len({answer.plane for answer in result.answers}) > 1
    drawn = [entity for entity in page if not entity.dxf.layer.endswith(CONSTRUCTION)]
    elements = [
        (layer_name(number, answer, element, is_split=is_split), element)
        for number, answer in enumerate(result.answers, 1)
        for element in answer.contour.elements
    ]
    assert len(elements) == len(drawn) > 1
    for (layer, element), entity in zip(elements, drawn, strict=True):
        assert entity.dxf.layer == layer
        assert layer in document.layers
        want = [tuple(value / mm for value in place) for place in (element.start, element.end)]
        if isinstance(element, ArcSegment):
            assert entity.dxftype() == "ARC"
            assert close(entity.dxf.center, [value / mm for value in element.center])
            assert entity.dxf.radius == pytest.approx(element.radius / mm, abs=1e-9)
            assert (entity.dxf.end_angle - entity.dxf.start_angle) % 360 == pytest.approx(element.sweep, abs=1e-9)
            want = want if element.turn is Turn.CCW else want[::-1]
        else:
            assert entity.dxftype() == "LINE"
        assert all(map(close, ends(entity), want))
    points = [tuple(value / mm for value in at) for each in result.answers for at in each.contour.points.values()]
    marks = [entity.dxf.location for entity in page.query("POINT")]
    assert all(map(close, marks, points))
    assert len(marks) == len(points) > 0


def test_what_is_not_in_the_drawing_is_named_with_its_lines(tmp_path):
    block = "G00 X40. Z0.\nG111 X100. A180. K-30. B{}. P{}.\nG00 X150. Z10.\n"
    (tmp_path / "three.nc").write_text("".join(map(block.format, (120, 120, 180), (6, 60, 6))) + "M30\n")
    status, output = plot(tmp_path / "three.nc", "-o", tmp_path / "three.dxf")
    left = "left out, cannot be cut: 2 contours (program lines 5 and 8)"
    assert (status, f"three.dxf: 3 elements of 1 contour; {left}\n" in output) == (1, True)


@pytest.mark.parametrize(
    ("output", "said"), [("part.jpg", "drawings end in .svg, .png or .dxf"), ("program.dxf", "is the program itself")]
)
def test_a_target_that_makes_no_sense_is_named(tmp_path, output, said):
    program = tmp_path / "program.dxf"
    program.write_text(INCH)
    status, printed = plot(program, "-o", tmp_path / output, "--force")
    assert status == 2
    assert said in printed
    assert program.read_text() == INCH


def test_a_turned_part_is_drawn_whole_or_by_its_half(tmp_path):
    shaft = PROGRAMS / "shaft.nc"
    for option in ("--whole", "--half"):
        assert plot(shaft, option, "-o", tmp_path / f"{option}.svg")[0] == 0
    whole, half = (tmp_path.joinpath(f"{option}.svg").read_text(encoding="utf-8") for option in ("--whole", "--half"))
    assert whole != half
    for other in (["--each"], ["--line", "53"], ["-o", tmp_path / "a.dxf"]):
        status, output = plot(shaft, "--half", *other)
        assert (status, "--whole and --half are for a picture of all contours" in output) == (2, True)


def test_without_ezdxf_the_message_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.delattr("contoursolve.output.drawing_for_cad")
    monkeypatch.delitem(sys.modules, "contoursolve.output.dxf")
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    status, output = plot(PROGRAMS / "shaft.nc", "-o", tmp_path / "part.dxf")
    assert status == 2
    assert f'{sys.executable} -m pip install "contoursolve[dxf]"' in output


def test_where_nothing_is_solved_nothing_is_written(tmp_path):
    target = tmp_path / "part.dxf"
    status, output = plot("--block", "G111 A180. B120. X100.", "--start", "X40. Z0.", "-o", target)
    assert status == 1
    assert "g111-line-1" in output
    assert "part.dxf: not written" in output
    assert not target.exists()
    status, output = plot(PROGRAMS / "shaft_broken.nc", "-o", target)
    assert status == 1
    assert "2 elements of 1 contour" in output
    assert len(read(target.read_bytes()).modelspace().query("LINE ARC")) == 2
