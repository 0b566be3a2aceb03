"""A contour whose words are all increments has the same shape from wherever it begins, known or not."""

import json
import re
from pathlib import Path

import pytest

import contoursolve
from contoursolve.controls import CONTROLS

VECTORS = Path(__file__).parents[2] / "docs" / "vectors"
LETTERS = {
    **{name: {"X": "U", "Z": "W"} for name in ("fanuc-lathe", "haas-lathe", "yasnac-lx3")},
    "cnc-pilot": {"X": "XI", "Z": "ZI"},
    "heidenhain": {"X": "IX", "Y": "IY"},
}
"""The increments of controls on which no code switches them."""
FEWEST = {"heidenhain": 30, "yasnac-lx3": 25, "cnc-pilot": 15, "haas-mill": 10, "siemens-808d": 10, "haas-lathe": 10}
"""Contours of a control that have a shape without a place; 20 of the others."""


def in_steps(control: str, program: list[str]) -> str:
    """The lines of a worked example with each coordinate as an increment."""
    letters = LETTERS.get(control)
    if letters is None:
        return "\n".join(["G91", *(re.sub(r"G90\b ?", "", line) for line in program)])
    swap = re.compile(rf"(?<![A-Z,]){'([' + ''.join(letters) + '])'}(?=[ ]?[-+.\d])")
    return "\n".join(swap.sub(lambda found: letters[found[1]], line) for line in program)


def examples(control):
    return json.loads((VECTORS / f"{control}.json").read_text())["vectors"]


def codes(answer):
    return sorted(each.code for each in answer.diagnostics if each.code not in ("start-relative", "axis-crossed"))


@pytest.mark.parametrize("control", CONTROLS)
def test_a_shape_is_the_same_without_its_place(control):
    count = 0
    for vector in examples(control):
        settings = {f"{control}.{name}": value for name, value in vector.get("settings", {}).items()}
        text, options = in_steps(control, vector["program"]), {"settings": settings, "depth": "verdict"}
        alone = contoursolve.solve(text, control=control, **options)
        first, second = alone.answers[0].plane.axes if alone.answers else "XY"
        placed = contoursolve.solve(text, control=control, start=f"{first}84.2 {second}317.4", **options)
        assert [each.lines for each in alone.answers] == [each.lines for each in placed.answers], vector["id"]
        for one, other in zip(alone.answers, placed.answers, strict=True):
            if not one.start.is_relative:
                assert not one.start.is_known or one.start == other.start, vector["id"]
                continue
            count += 1
            assert one.start.values == (0, 0)
            assert (one.status, codes(one)) == (other.status, codes(other)), vector["id"]
            if one.contour is not None:
                at = other.contour.start
                assert_same(one.contour, other.contour, at, vector["id"])
    assert count >= FEWEST.get(control, 20)


def assert_same(one, other, at, name):
    assert [each.name for each in one.elements] == [each.name for each in other.elements], name
    for mine, its in zip(one.elements, other.elements, strict=True):
        for part in ("start", "end", "center"):
            if hasattr(mine, part):
                a, b = getattr(mine, part), getattr(its, part)
                assert a == pytest.approx((b[0] - at[0], b[1] - at[1]), abs=1e-8), (name, part)
        assert getattr(mine, "turn", None) is getattr(its, "turn", None), name
