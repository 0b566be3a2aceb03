"""Which way a point is free that a block leaves open: along a line, told by the direction of its larger part."""

from math import cos, radians, sin

import pytest

from contoursolve import solve


@pytest.mark.parametrize(
    "angle", [5, 44.9, 45, 45.1, 60, 120, 134.9, 135, 135.1, 170, 185, 225, 226, 290, 315, 330, 350]
)
def test_the_end_of_a_line_without_its_length_is_free_along_the_line(angle):
    """The larger part of the way is forwards; of two equal ones, the first. V2, at a known X, is free along Z."""
    (answer,) = solve(
        f"G111 A{angle}. B90. X100." if angle % 1 == 0 else f"G111 A{angle} B90. X100.", start="X40. Z0."
    ).answers
    way = cos(radians(angle)), sin(radians(angle))
    larger = way[0] if abs(way[0]) > abs(way[1]) - 1e-9 else way[1]
    free = {each.point: each.direction for each in answer.diagnosis.freedoms}
    assert free["V1"] == pytest.approx(tuple(each if larger > 0 else -each for each in way), abs=1e-9)
    assert free["V2"] == pytest.approx((1, 0), abs=1e-9)
    assert {each.point: each.angle for each in answer.diagnosis.freedoms}["V2"] == 0


@pytest.mark.parametrize(
    ("words", "free"),
    [
        ("A180. K-30. B120.", {"V2": (-0.5, 0.75**0.5)}),
        ("A180. K-30. X100.", {"V2": (1, 0)}),
        ("A180. K-30. Z-60.", {"V2": (0, 1)}),
        ("A180. B90.", {"V1": (1, 0), "V2": None}),
    ],
)
def test_points_are_free_along_a_line_or_in_the_plane(words, free):
    (answer,) = solve(f"G111 {words}", start="X40. Z0.").answers
    found = {
        each.point: each.direction and pytest.approx(each.direction, abs=1e-9) for each in answer.diagnosis.freedoms
    }
    assert found == free
