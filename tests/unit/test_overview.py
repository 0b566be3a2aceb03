"""The picture of a whole program: its part around the axis, how large it is, and what cannot be seen without a word."""

import re
from math import hypot
from pathlib import Path

import pytest

import contoursolve
from contoursolve.pictures import draw_answer, draw_result
from contoursolve.pictures.page import WIDTH, Box, Stroke
from contoursolve.pictures.theme import Role, Theme

SHAFT = Path(__file__).parents[2] / "notebooks" / "programs" / "shaft.nc"
BROKEN = SHAFT.with_stem("shaft_broken")
SMALL = """G00 X400. Z5.
G01 Z0 F0.2
G111 A180. K-300. B90. X402. P0.5 Q0.3
G01 Z-301.
G111 A180. K-0.5 B90. U1. P0.1
G00 X-20. Z0.
G111 A90. I60. B180. Z-100. X80. P1.
M30"""
"""A long contour, a tiny one, and one across the axis."""


def texts(picture):
    return [text.words for text in picture.sheet.texts]


def strokes(picture, role):
    return [item for item in picture.sheet.drawing if isinstance(item, Stroke) and item.role is role]


def spots(stroke):
    return [stroke.start, *(step if isinstance(step, tuple) else step.end for step in stroke.steps)]


def small(**options):
    return contoursolve.solve(SMALL, control="yasnac-lx3", **options)


def check(picture):
    """Texts stand on the page, and none over another."""
    page, boxes = Box(0.0, 0.0, WIDTH, picture.sheet.height), [text.box for text in picture.sheet.texts]
    for number, box in enumerate(boxes):
        assert page.grow(0.5).holds(box)
        assert not any(box.meets(other) for other in boxes[:number])


def test_a_bar_says_how_large_the_drawing_is():
    picture = draw_result(contoursolve.solve_file(SHAFT))
    (told,) = (re.fullmatch(r"(\S+) mm", text).group(1) for text in texts(picture) if text.endswith(" mm"))
    lengths = [
        abs(item.steps[0][0] - item.start[0])
        for item in picture.sheet.around
        if isinstance(item, Stroke) and item.role is Role.INK and item.width == 1.6
    ]
    assert max(lengths) == pytest.approx(float(told) * picture.sheet.placement.view.scale)
    inches = contoursolve.solve("G20 G00 X2. Z0.\nG111 X4. A180. K-1. B120.\nG111 A180. K-1. B90. X5.")
    assert any(text.endswith(" inch") for text in texts(draw_result(inches)))


def test_a_turned_part_has_both_halves_and_its_diameters():
    result = contoursolve.solve_file(SHAFT)
    whole, half = (draw_result(result, is_whole=is_whole) for is_whole in (True, False))
    assert draw_result(result).svg == whole.svg
    for picture in (whole, half):
        check(picture)
        assert {text for text in texts(picture) if text.startswith("Ø")} == {"Ø18", "Ø30", "Ø60", "Ø80", "Ø84", "Ø90"}
    axis = whole.sheet.placement.view.place((0.0, 0.0))[1]
    others = [each for each in strokes(whole, Role.MUTED) if each.width == 1.4]
    assert len(others) == 2  # the outside and the bore
    assert not any(each.dash for each in others)
    assert not [each for each in strokes(half, Role.MUTED) if each.width == 1.4]
    ends = {spot for each in strokes(whole, Role.INK) for spot in spots(each)}
    assert all(min(hypot(x - u, y + v - 2 * axis) for u, v in ends) < 1e-6 for each in others for x, y in spots(each))
    assert half.height < whole.height


def test_the_other_half_is_left_out_where_it_would_make_contours_small():
    far = "G00 X400. Z0.\nG111 X420. A180. K-10. B120.\nG111 A180. K-5. B90. X430."
    result = contoursolve.solve(far, control="yasnac-lx3")
    assert draw_result(result).svg == draw_result(result, is_whole=False).svg
    assert draw_result(result).svg != draw_result(result, is_whole=True).svg


def test_a_contour_without_a_path_has_its_message():
    picture = draw_result(contoursolve.solve_file(BROKEN))
    shown = "\n".join(texts(picture))
    assert (
        "3, program line 21, without a solution: corner 1 does not fit: P4. is 4.000 mm, at most 2.500 mm fits on"
        in shown
    )
    assert "at most 2.500 mm fits on line 2" in picture.description
    check(picture)


def test_a_contour_that_is_too_small_is_shown_enlarged():
    picture = draw_result(small())
    check(picture)
    assert {"A: 2  program line 5", "3, program line 7: the path crosses the turning axis"} <= set(texts(picture))
    (told,) = (text for text in texts(picture) if text.endswith("times as large"))
    times = float(told.split()[0])
    arcs = [
        step.radius
        for item in (*picture.sheet.drawing, *picture.sheet.around)
        if isinstance(item, Stroke) and item.role is Role.INK
        for step in item.steps
        if not isinstance(step, tuple)
    ]
    wanted = times * 0.1 * picture.sheet.placement.view.scale
    assert any(radius == pytest.approx(wanted) for radius in arcs)
    assert not [text for text in texts(draw_result(contoursolve.solve_file(SHAFT))) if text.endswith("times as large")]


def test_small_corners_of_a_long_contour_have_a_detail_with_their_words():
    picture = draw_answer(small().answers[0])
    check(picture)
    assert {"A: corner 1, corner 2", "20 times as large"} <= set(texts(picture))
    assert texts(picture).count("P0.5") == texts(picture).count("Q0.3") == 2
    large = draw_answer(contoursolve.solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").answers[0])
    assert not any("times as large" in text for text in texts(large))


def test_of_very_many_small_contours_none_is_enlarged_and_the_picture_says_how_many():
    text = "G00 X40. Z0.\n" + "G111 A180. K-20. B120. U10. P1.\nG01 U2.\n" * 60
    picture = draw_result(contoursolve.solve(text, control="yasnac-lx3"))
    check(picture)
    shown = texts(picture)
    assert not [told for told in shown if told.endswith("times as large") or told.startswith("0 words")]
    names = ", ".join(f"{number}  program line {2 * number}" for number in range(1, 7))
    assert f"too small to be read here: {names} and 54 more".replace("  ", " ") in " ".join(shown)


PROFILE = """G00 X64. Z2.
G71 U2. R1.
G71 P10 Q60 U0.5 W0.1 F0.3
N10 G00 X16.
G01 Z0.
X24. ,C1.5
Z-30. ,R3.
X36. ,A120.
Z-50. ,R2.
X60. ,C1.
Z-60.
N60 X64.
G70 P10 Q60
M30"""


@pytest.mark.parametrize("theme", list(Theme))
def test_dashed_lines_lead_from_the_start_of_a_cycle_to_its_profile_and_back(theme):
    found = contoursolve.solve(PROFILE, control="fanuc-lathe")
    picture = draw_result(found, theme=theme)
    assert "G71, program line 3; G70, program line 13" in texts(picture)
    ways = {frozenset(spots(stroke)) for stroke in strokes(picture, Role.RAPID)}
    assert len(ways) == 2
    assert len(frozenset.intersection(*ways)) == 1
    told = "G71, program line 3: dashed lines lead to its profile and back."
    assert told in picture.svg
