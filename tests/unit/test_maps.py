"""Maps of a result over two words: each line of equal value is where single solves have that value."""

import re

import numpy
import pytest

import contoursolve
from contoursolve.pictures import Theme, draw_family_map, draw_region
from contoursolve.pictures.page import Stroke, Text
from contoursolve.pictures.theme import LEVELS

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
CHAIN = """\
G17 G41 D0 G0 X-30 Y60
G1 ,A180 ,R3
G3 X-85 Y50 I-60 J50 R25 Q-1
G1 X-75 Y0 ,A-90 Q1"""
CHAMFER = "G17 G0 X0 Y0\nG1 X40 Y0 ,C3\nG1 X60 Y30"
BOXES = {
    "a taper": (BLOCK, {"A": (150.0, 210.0), "P": (1.0, 60.0)}, {"start": START}),
    "a chain with a boss": (CHAIN, {"2:,A": (120.0, 200.0), ",R": (1.0, 20.0)}, {}),
    "a chamfer": (CHAMFER, {"3:X": (30.0, 80.0), ",C": (0.5, 40.0)}, {"control": "nct-99m"}),
    "a question": (
        "G111 X100. A180. K-30. B120. P?",
        {"A": (150.0, 210.0), "straight part of line 2": (1.0, 40.0)},
        {"start": START, "facts": ["straight part of line 2 = 20"]},
    ),
}


def family_of(name, count=25):
    block, box, options = BOXES[name]
    return contoursolve.family(
        block, vary={word: numpy.linspace(*ends, count) for word, ends in box.items()}, **options
    )


def solved_alone(family, values):
    return family.spec.template().solve(dict(zip(family.ranges.values, map(float, values), strict=True))).contour


@pytest.mark.parametrize("name", BOXES)
def test_the_length_and_the_end_of_each_row_are_those_of_its_contour(name):
    family = family_of(name, 5)
    axes = list(family.ranges.values.values())
    length, ends = family.result("length"), [family.result(f"end.{axis}") for axis in plane_axes(family)]
    assert family.has_contour.any()
    for row in numpy.ndindex(*family.shape):
        contour = solved_alone(family, [axis[place] for axis, place in zip(axes, row, strict=True)])
        assert (contour is None) == numpy.isnan(length[row])
        if contour is not None:
            assert length[row] == pytest.approx(sum(each.length for each in contour.elements), abs=1e-9)
            assert [each[row] for each in ends] == pytest.approx(contour.end, abs=1e-9)


def plane_axes(family):
    return [name.removeprefix("end.") for name in family.results if name.startswith("end.")]


SHOWN = (("a taper", "line 1.room"), ("a chain with a boss", "length"), ("a question", "asked.P"))


@pytest.mark.parametrize(("name", "result"), SHOWN)
def test_a_line_of_equal_value_runs_where_single_solves_have_its_value(name, result):
    block, box, options = BOXES[name]
    words = tuple(box)
    region = contoursolve.region(block, words, tuple(box.values()), **options)
    picture = draw_region(region, result=result)
    lines = [each for each in picture.sheet.drawing if isinstance(each, Stroke) and each.width == 1.2 and each.steps]
    texts = {each.words: each.at for each in picture.sheet.drawing if isinstance(each, Text)}
    assert f"{words[0]} and {words[1]}: {result} [mm" in picture.title
    labels = {float(told): at for told, at in texts.items() if re.fullmatch(r"-?\d+(\.\d+)?", told) and on_plane(at)}
    assert len(labels) >= 2
    checked = 0
    for level, (x, y) in labels.items():
        # The value stands on its line: where its middle is, single solves have it, but for the width of a cell.
        here = values_at((x, y - 4.0), box)
        around = [values_at((x + right, y - 4.0 + down), box) for right in (-4, 0, 4) for down in (-4, 0, 4)]
        found = [alone(region, words, each, result) for each in (here, *around)]
        assert min(found) <= level <= max(found)
        checked += 1
    assert checked == len(labels)
    assert len(lines) >= len(labels)


def on_plane(at):
    return 92 < at[0] < 702 and 56 < at[1] < 456


def values_at(spot, box):
    (a, b), (c, d) = box.values()
    return a + (b - a) * (spot[0] - 92) / 610, c + (d - c) * (456 - spot[1]) / 400


def alone(region, words, values, result):
    vary = dict(zip(words, ([each] for each in values), strict=True))
    spec = region.spec
    family = contoursolve.family(spec.block, vary=vary, start=spec.start, facts=spec.facts)
    return float(family.result(result).item())


def test_a_map_of_a_result_says_what_it_shows_and_only_then_has_its_colours():
    family = family_of("a taper", 40)
    shown = draw_family_map(family, result="v2.z", theme=Theme.PAGE)
    assert "V2.Z [mm]: " in shown.title
    assert "level-8" in shown.svg
    assert not any(role.value in draw_family_map(family, theme=Theme.PAGE).svg for role in LEVELS)
    told = [each.words for each in shown.sheet.texts]
    low, high = numpy.nanmin(family.result("V2.Z")), numpy.nanmax(family.result("V2.Z"))
    (remark,) = [each for each in told if each.startswith("V2.Z [mm]: from")]
    assert [float(each) for each in re.findall(r"-?\d+\.\d+", remark)[:2]] == pytest.approx([low, high], abs=0.01)
    assert "solved" not in told
    fixed = draw_family_map(family, result="V1.Z")
    assert "V1.Z [mm]: -30.000 wherever there is a contour" in [each.words for each in fixed.sheet.texts]
    assert "V2.X [mm, radius]" in draw_family_map(family, result="V2.X").title


def test_an_unknown_result_is_refused_with_those_that_are_like_it():
    family = family_of("a taper", 4)
    for wrong, said in (
        ("V3.Z", "there is no result V3.Z; did you mean V2.Z or V1.Z? the results are end.Z, "),
        ("lenght", "did you mean length?"),
        ("status", "there is no result status"),
        (" ", "a result has a name"),
    ):
        with pytest.raises(contoursolve.FamilyError, match=re.escape(said)):
            draw_family_map(family, result=wrong)
    with pytest.raises(contoursolve.FamilyError, match="take 2 or more"):
        contoursolve.region(BLOCK, ("A", "P"), ((170, 190), (1, 9)), start=START).family(1, 5)
