"""The picture of a whole program: its part around the axis, how large it is, and what cannot be seen without a word."""

from pathlib import Path

import pytest
from test_pictures import check, labels, strokes

import contoursolve
from contoursolve.pictures import Role, draw_answer, draw_result

SHAFT = Path(__file__).parents[2] / "notebooks" / "programs" / "shaft.nc"
SMALL = """G00 X400. Z5.
G01 Z0 F0.2
G111 A180. K-300. B90. X402. P0.5 Q0.3
G01 Z-301.
G111 A180. K-0.5 B90. U1. P0.1
G00 X-20. Z0.
G111 A90. I60. B180. Z-100. X80. P1.
M30"""
"""A long contour, a tiny one, and one across the axis."""


def test_a_contour_without_a_path_has_its_message():
    picture = draw_result(contoursolve.solve(SHAFT.with_stem("shaft_broken")))
    told = "cannot be cut: the rounding P4. does not fit: P4. is 4.000 mm, at most 2.500 mm fits on"
    assert f"3, program line 21, {told}" in "\n".join(labels(picture))
    assert f"Contour 3, program line 21, G111: {told} the face Z-75 from X60 to X66." in picture.description
    check(picture)


def test_a_contour_that_is_too_small_is_shown_enlarged():
    result = contoursolve.solve(SMALL, control="yasnac-lx3")
    picture = draw_result(result)
    check(picture)
    assert "3, program line 7: the path crosses the turning axis" in labels(picture)
    assert any(text.startswith("A: 2  program line 5") for text in labels(picture))
    told, *_ = (text for text in labels(picture) if text.endswith("times as large"))
    steps = [step for item in strokes((*picture.sheet.drawing, *picture.sheet.around), Role.INK) for step in item.steps]
    wanted = float(told.split()[0]) * 0.1 * picture.sheet.placement.view.scale
    assert any(step.radius == pytest.approx(wanted) for step in steps if not isinstance(step, tuple))
    # Small corners of a long contour have a detail with their words.
    details = draw_answer(result.answers[0])
    check(details)
    assert {"A: rounding P0.5, rounding Q…", "20 times as large"} <= set(labels(details))
    assert labels(details).count("P0.5") == labels(details).count("Q0.3") == 2
    block = contoursolve.solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.")
    assert not any("times as large" in text for text in labels(draw_answer(block.answers[0])))


def test_of_very_many_small_contours_none_is_enlarged_and_the_picture_says_how_many():
    text = "G00 X40. Z0.\n" + "G111 A180. K-20. B120. U10. P1.\nG01 U2.\n" * 60
    picture = draw_result(contoursolve.solve(text, control="yasnac-lx3"))
    check(picture)
    assert not [told for told in labels(picture) if told.endswith("times as large") or told.startswith("0 words")]
    names = ", ".join(f"{number}  program line {2 * number}" for number in range(1, 7))
    assert f"too small to be read here: {names} and ".replace("  ", " ") in " ".join(labels(picture))
