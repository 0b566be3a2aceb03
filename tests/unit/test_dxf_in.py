"""Drawings for CAD as sketches: their lines and arcs, their dimensions, and what is told of all else."""

import io
import math
from decimal import Decimal
from functools import partial
from pathlib import Path

import calling
import ezdxf
import pytest
from ezdxf import units

from contoursolve import ArcSegment, read_dxf
from contoursolve.errors import DxfError
from contoursolve.sketches import SketchCorner

ROOT = Path(__file__).parents[2]


def drawing(unit=units.MM, version="R2010"):
    document = ezdxf.new(version, setup=True)
    if version != "R12":
        document.units = unit
    for style in document.dimstyles:
        style.dxf.dimlfac = 1
    return document, document.modelspace()


def data(document) -> bytes:
    stream = io.StringIO()
    document.write(stream)
    return document.encode(stream.getvalue())


def path_of(found):
    """The lines and arcs that a sketch comes to, mm."""
    answer = found.sketch.solve().answer
    return answer.contour.elements


def rounded(elements):
    """Lines and arcs without their names; they compare as equal within a hundredth of the least increment."""
    return [pytest.approx(each, abs=1e-5) for each in plain(elements)]


def plain(elements):
    """The same to compare with: ends, and of arcs the radius, positive counterclockwise."""
    return [
        [*one.start, *one.end, *([one.radius * one.turn.sign] if isinstance(one, ArcSegment) else [])]
        for one in elements
    ]


def refused(document, **options) -> str:
    with pytest.raises(DxfError) as error:
        read_dxf(document if isinstance(document, bytes) else data(document), **options)
    return str(error.value)


# What we write is read back -----------------------------------------------------------------------------------------


# Dimensions ---------------------------------------------------------------------------------------------------------


def fields(found):
    """The fields of each element, as text."""
    return [
        {
            **{name: str(value) for name, value in each.words.items()},
            **({"tangent": True} if each.tangent else {}),
            **({"corner": f"{each.corner.shape} {each.corner.size}"} if each.corner else {}),
            **({"facts": each.facts} if each.facts else {}),
        }
        for each in found.sketch.elements
    ]


def plate():
    """A plate with a rounding and a slope."""
    document, space = drawing()
    space.add_lwpolyline(
        [(0, 0), (80, 0), (80, 40, math.tan(math.pi / 8)), (70, 50), (30, 50), (0, 20)], format="xyb", close=True
    )
    return document, space


def test_dimensions_become_the_given_numbers_and_nothing_that_follows_from_them():
    document, space = plate()
    space.add_linear_dim(base=(0, -10), p1=(0, 0), p2=(80, 0)).render()
    space.add_linear_dim(base=(-10, 0), p1=(0, 0), p2=(0, 20), angle=90).render()
    space.add_linear_dim(base=(90, 0), p1=(80, 0), p2=(70, 50), angle=90).render()
    space.add_radius_dim(center=(70, 40), radius=10, angle=45).render()
    space.add_angular_dim_2l(base=(20, 60), line1=((30, 50), (0, 20)), line2=((70, 50), (30, 50))).render()
    space.add_linear_dim(base=(0, 70), p1=(0, 20), p2=(30, 50)).render()
    found = read_dxf(data(document), part="milled")
    assert fields(found) == [
        {"AN": "0", "X": "80"},
        {"AN": "90", "Y": "50", "corner": "rounding 10"},
        {"AN": "180"},
        {"Y": "20", "AN": "225"},
        {"AN": "270"},
    ]
    assert [each.partition(": ")[2] for each in found.given] == ["10", "80", "20", "50", "45"]
    assert any(": 30: it follows from others" in each for each in found.notes)
    assert found.sketch.closed
    assert rounded(path_of(found))[2] == [80, 40, 70, 50, 10]


def whole_shaft():
    """A shaft drawn whole around Y100, with an undercut radius, an axis and the edges that are seen."""
    document, space = drawing()
    for side in (1, -1):
        upper = [(0, 9), (-1, 10), (-28, 10), (-30, 12), (-30, 20), (-60, 25)]
        points = [(along, 100 + side * radius) for along, radius in upper]
        bulge = -side * math.tan(math.pi / 8)
        space.add_lwpolyline([(*at, bulge if place == 2 else 0) for place, at in enumerate(points)], format="xyb")
    for along, radius in ((0, 9), (-1, 10), (-30, 20), (-60, 25)):
        space.add_line((along, 100 - radius), (along, 100 + radius))
    space.add_line((5, 100), (-65, 100), dxfattribs={"layer": "axis"})
    return document, space


def test_a_shaft_that_is_drawn_whole_is_halved():
    document, space = whole_shaft()
    space.add_linear_dim(base=(5, 0), p1=(0, 91), p2=(0, 109), angle=90, text="%%c18").render()
    space.add_linear_dim(base=(5, 0), p1=(-30, 80), p2=(-30, 120), angle=90, text="41").render()
    space.add_linear_dim(base=(0, 140), p1=(0, 109), p2=(-60, 125)).render()
    for options in ({}, {"layer": "0", "zero": (0, 100)}):
        found = read_dxf(data(document), part="turned", **options)
        assert found.sketch.start == {"Z": 0, "X": 0}
        assert found.sketch.elements[0].words == {"X": 18, "AN": 90}
        assert rounded(path_of(found))[3] == [-28, 10, -30, 12, -2]
        assert rounded(path_of(found))[-1] == [-60, 25, -60, 0]
        assert any("it shows '41', and measures 40" in each for each in found.notes)
        assert sum("an edge that is seen" in each for each in found.notes) >= 1
    assert (
        "the profile is drawn whole: the half above the axis Y100 is taken"
        in read_dxf(data(document), part="turned").notes
    )


@pytest.mark.parametrize("factor", [1, -1])
def test_a_profile_beside_the_axis_is_taken_above_it(factor):
    document, space = drawing()
    space.add_lwpolyline([(0, 0), (0, 10 * factor), (-20, 10 * factor), (-20, 0)], close=True)
    found = read_dxf(data(document), part="turned")
    assert rounded(path_of(found)) == [[0, 0, 0, 10], [0, 10, -20, 10], [-20, 10, -20, 0]]
    assert ("the profile lies below the axis: it is taken above it" in found.notes) == (factor < 0)
    assert any("on the axis" in each for each in found.notes)


def test_a_ball_is_cut_at_the_axis():
    document, space = drawing()
    space.add_circle((0, 0), 10)
    found = read_dxf(data(document), part="turned")
    assert rounded(path_of(found)) == [[10, 0, -10, 0, 10]]
    whole = read_dxf(data(document), part="milled")
    assert rounded(path_of(whole)) == [[10, 0, -10, 0, 10], [-10, 0, 10, 0, 10]]


@pytest.mark.parametrize(
    ("unit", "end", "words", "said"),
    [
        (units.IN, (2, 0.5), {"X": Decimal(2), "Y": Decimal("0.5")}, "inch"),
        (units.CM, (2, 0.5), {"X": Decimal(20), "Y": Decimal(5)}, "mm"),
        (units.MM, (20, 5), {"X": Decimal(20), "Y": Decimal(5)}, "mm"),
    ],
)
def test_units_are_those_of_the_drawing_or_asked(unit, end, words, said):
    document, space = drawing(unit)
    space.add_line((0, 0), end)
    found = read_dxf(data(document), part="milled")
    assert (found.sketch.unit, found.sketch.elements[0].words) == (said, words)
    document, space = drawing(0)
    space.add_line((0, 0), (2, 1))
    assert "does not tell its unit; say mm or inch" in refused(document, part="milled")
    assert read_dxf(data(document), part="milled", unit="inch").sketch.unit == "inch"


@pytest.mark.parametrize(("end", "unit", "mm"), [(60, None, 60), (60, "mm", 60), (60, "m", 60_000), (9, None, 9_000)])
def test_metres_of_a_header_are_not_believed_of_a_part_longer_than_ten(end, unit, mm):
    document, space = drawing(units.M)
    space.add_line((0, 0), (end, 1))
    found = read_dxf(data(document), part="milled", unit=unit)
    assert found.sketch.elements[0].words["X"] == mm
    assert any("60 m long: it is read in mm; --unit mm" in each for each in found.notes) == (end == 60 and unit is None)


@pytest.mark.parametrize(
    ("corner", "size"),
    [([(50, 26), (46, 30)], 4), ([(50, 26), (45, 30)], None), ([(50, 10), (30, 30)], 20), ([(50, 30)], None)],
)
def test_a_line_that_cuts_as_much_from_both_its_neighbours_is_a_chamfer(corner, size):
    document, space = drawing()
    space.add_lwpolyline([(0, 0), (50, 0), *corner, (0, 30)], close=True)
    found = read_dxf(data(document), part="milled")
    second = found.sketch.elements[1].corner
    assert second == (SketchCorner("chamfer", Decimal(str(size))) if size else None)
    assert [*path_of(found)[1].end] == pytest.approx([*corner[0]])


# What is refused, and what is told ----------------------------------------------------------------------------------


def test_a_gap_is_told_with_its_size_its_lines_and_its_place():
    document, space = drawing()
    first = space.add_line((0, 0), (40, 0))
    second = space.add_line((40.02, 0), (40.02, 30))
    told = refused(document, part="milled")
    assert f"a gap of 0.02 mm between LINE {first.dxf.handle} and LINE {second.dxf.handle} at (40, 0)" in told
    assert "chain 1: 1 open, 40 x 0 mm, layer '0'" in told
    found = read_dxf(data(document), part="milled", join=0.05)
    assert len(found.sketch.elements) == 2
    assert "ends are joined that lie up to 0.02 apart" in found.notes


def test_several_chains_are_listed_and_chosen():
    document, space = plate()
    space.add_circle((40, 25), 8, dxfattribs={"layer": "bore"})
    told = refused(document, part="milled")
    assert "chain 1: 6 closed, 80 x 50 mm, layer '0'\n  chain 2: 1 closed, 16 x 16 mm, layer 'bore'" in told
    with pytest.raises(DxfError) as error:
        read_dxf(data(document), part="milled")
    assert error.value.layers == {"0": 6, "bore": 1}
    assert [len(each.elements) for each in error.value.chains] == [6, 1]
    for options in ({"chain": 2}, {"layer": "bore"}, {"layer": "BO*"}):
        assert len(read_dxf(data(document), part="milled", **options).sketch.elements) == 2
    assert "chain" in refused(document, part="milled", chain=3)
    assert "no layer 'drill' has lines or arcs; there are '0' with 6" in refused(document, part="milled", layer="drill")


def test_what_is_no_line_and_no_arc_is_told_and_never_taken_for_the_end():
    document, space = drawing()
    space.add_line((0, 0), (40, 0))
    space.add_text("R5")
    curve = space.add_spline([(90, 0), (95, 5), (100, 0)])
    found = read_dxf(data(document), part="milled")
    assert f"left out, no line and no arc: SPLINE {curve.dxf.handle}" in found.notes
    assert "left out, beside the contour: 1 TEXT" in found.notes
    space.add_ellipse((40, 10), (0, -10), ratio=0.5, start_param=0, end_param=1)
    assert "goes on from the chain at (40, 0), and is no line and no arc" in refused(document, part="milled")
    # A circle may be written as an ellipse, and a block be stretched into one.
    document, space = drawing()
    space.add_ellipse((40, 10), (0, -10), ratio=1, start_param=0, end_param=math.pi / 2)
    assert rounded(path_of(read_dxf(data(document), part="milled"))) == [[40, 0, 50, 10, 10]]
    document, space = drawing()
    document.blocks.new("slot").add_arc((0, 0), 10, 0, 90)
    space.add_blockref("slot", (0, 0), dxfattribs={"xscale": 2})
    assert "only ELLIPSE in block slot" in refused(document, part="milled")


def test_what_branches_or_is_not_flat_is_refused():
    document, space = plate()
    line = space.add_line((80, 0), (90, 0))
    told = refused(document, part="milled")
    assert "3 lines and arcs meet at (80, 0)" in told
    assert f"LINE {line.dxf.handle}" in told
    document, space = drawing()
    space.add_line((0, 0, 0), (10, 0, 0))
    space.add_line((10, 0, 5), (20, 0, 5))
    assert "not flat: the chain lies from Z0 to Z5" in refused(document, part="milled")
    document, space = drawing()
    space.add_arc((0, 0), 5, 0, 90, dxfattribs={"extrusion": (1, 0, 0)})
    assert "the drawing has no lines and arcs, only ARC" in refused(document, part="milled")


def test_an_axis_is_never_guessed():
    document, space = drawing()
    space.add_lwpolyline([(0, 20), (-30, 20), (-30, 30), (0, 30)], close=True)
    assert "it may be a whole part, or the half of a ring; say where the axis is, Y25 or Y0" in refused(
        document, part="turned"
    )
    assert len(read_dxf(data(document), part="turned", zero=(0, 0)).sketch.elements) == 4
    assert len(read_dxf(data(document), part="turned", zero=(0, 25)).sketch.elements) == 3
    # A ring that differs on both sides of its middle can be no whole part.
    document, space = drawing()
    space.add_lwpolyline([(0, 20), (-30, 20), (-30, 30), (-5, 30), (0, 25)], close=True)
    found = read_dxf(data(document), part="turned")
    assert ("the axis is Y0 of the drawing" in found.notes, len(found.sketch.elements)) == (True, 4)
    document, space = drawing()
    space.add_line((0, -5), (-30, 30))
    assert "lies on both sides of Y0, from Y-5 to Y30, and is not the same on both" in refused(document, part="turned")


@pytest.mark.parametrize(
    ("file", "told"),
    [
        (b"AC1032\0\0", "this is a DWG drawing; save it as DXF"),
        (b"G00 X40. Z0.", "is no DXF drawing"),
        (b"", "is no DXF drawing"),
        (b"0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nx\n", "drawing"),
        (b"0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n", "nothing in its model space"),
        (b"AutoCAD Binary DXF\r\n\x1a\0", "is no DXF drawing"),
    ],
)
def test_a_file_that_is_no_drawing_is_refused_in_one_sentence(file, told):
    assert told in refused(file, part="milled")


def test_a_dimension_that_is_not_of_the_chain_or_of_another_scale_is_told():
    document, space = plate()
    far = space.add_linear_dim(base=(0, -90), p1=(200, 0), p2=(220, 0)).render().dimension
    scaled = space.add_linear_dim(base=(0, -10), p1=(0, 0), p2=(80, 0), override={"dimlfac": 0.5}).render().dimension
    found = read_dxf(data(document), part="milled")
    assert not found.given
    assert found.notes[1:] == (
        f"DIMENSION {far.dxf.handle} is left out: its points are no points of the chain, or no field says it",
        f"DIMENSION {scaled.dxf.handle} is left out: it is shown 0.5 times as large as it is drawn",
        "no dimension gives a number: the coordinates of the drawing are given",
    )


def test_what_a_drawing_may_have_else_is_told():
    document, space = drawing()
    document.layers.add("off").off()
    space.add_line((0, 0), (10, 0), dxfattribs={"layer": "off"})
    space.add_line((0, 0), (0, 5))
    space.add_blockref("lost", (0, 0))
    notes = read_dxf(data(document), part="milled").notes
    assert "left out, beside the contour: 1 LINE on a layer that is off" in notes
    assert any(each.endswith("block lost is not in the file") for each in notes)
    block = document.blocks.new("lost")
    block.add_blockref("lost", (1, 0))
    assert "block lost of the drawing contains itself" in refused(document, part="milled")
    for end, told in ((1e12, "farther away than a control can travel"), (0, "no lines and arcs with a length")):
        document, space = drawing()
        space.add_line((0, 0), (end, 0))
        assert told in refused(document, part="milled")
    document, space = drawing()
    document.layout("Layout1").add_line((0, 0), (1, 0))
    assert "it has something on paper" in refused(document, part="milled")
    for options in ({"part": "round"}, {"part": "milled", "unit": "cm"}):
        with pytest.raises(ValueError, match="part is turned or milled, and unit mm or inch"):
            read_dxf(data(document), **options)


# On the command line ------------------------------------------------------------------------------------------------

SHAFT = ROOT / "docs" / "programs" / "shaft.dxf"


run = partial(calling.run, "write")


def test_write_takes_a_drawing_and_keeps_its_sketch(tmp_path):
    kept = tmp_path / "shaft.toml"
    status, program, told = run(SHAFT, "--to", "fanuc-lathe", "--layer", "contour", "--sketch", kept)
    assert status == 0
    assert "G01 X18.\nX20. Z-1.\nZ-30. ,R2.\nX40.\nX50. Z-60.\nX0\n" in program
    assert "the profile is drawn whole" in told
    assert told.count("given: DIMENSION") == 8
    assert run(kept, "--to", "fanuc-lathe")[:2] == (0, program)
    assert run(SHAFT, "--to", "fanuc-lathe", "--layer", "contour", "--sketch", kept)[0] == 2
    assert run(SHAFT, "--part", "turned", "--layer", "contour", "--reverse", "--to", "siemens-840d")[0] == 0


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ([SHAFT], "add --part turned or --part milled"),
        ([SHAFT, "--to", "fanuc-mill"], "chain 1: 12 closed, 60 x 50 mm, layer 'contour'"),
        ([SHAFT, "--to", "fanuc-lathe", "--chain", "3"], "there is no chain 3"),
        ([SHAFT, "--to", "fanuc-lathe", "--zero", "1"], "write two numbers"),
        ([ROOT / "tests" / "sketches" / "no.toml"], "no.toml"),
    ],
)
def test_write_refuses_a_drawing_in_one_sentence(arguments, told):
    status, output, errors = run(*arguments)
    assert (status, output) == (2, "")
    assert told in errors


def test_options_for_a_drawing_are_for_drawings(tmp_path):
    sketch = tmp_path / "a.toml"
    sketch.write_text('sketch = 1\npart = "milled"\nstart = { X = 0, Y = 0 }\n', encoding="utf-8")
    for options in (["--layer", "a"], ["--sketch", "b.toml"], ["--reverse"]):
        status, _, told = run(sketch, *options)
        assert (status, f"{options[0]} is for a DXF drawing" in told) == (2, True)
