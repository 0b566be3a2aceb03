"""`contoursolve.Sketch`: names, closed paths, values that are asked for, and calls that make no sense."""

from decimal import Decimal
from math import cos, hypot, pi, radians, sqrt, tan
from typing import Any

import numpy as np
import pytest

from contoursolve import Drawings, Sketch, Status
from contoursolve.geometry import LengthIs, RadiusIs


def stated(sketch: Sketch, *facts: Any) -> Drawings:
    for fact in facts:
        sketch.state(fact)
    return sketch.solve()


def path(*elements: tuple[str, ...], closes: bool = True, start: tuple[float, float] = (0, 0)) -> Sketch:
    """A path of lines (name) and arcs (name, turn), which ends where it began."""
    sketch = Sketch(start)
    for number, (name, *turn) in enumerate(elements, 1):
        to = "P0" if closes and number == len(elements) else ""
        if turn:
            sketch.arc(name, turn[0], to=to)
        else:
            sketch.line(name, to=to)
    return sketch


# --- Closed paths -----------------------------------------------------------------------------------


def test_a_triangle_closes_and_its_angles_are_those_of_its_sides() -> None:
    sketch = path(("a",), ("b",), ("c",), start=(10, 20))
    drawings = stated(
        sketch, "length of a = 8", "length of b = 7", "length of c = 5", "direction of a = 0", "direction of c = ?"
    )
    assert (drawings.status, drawings.is_complete, len(drawings)) == (Status.AMBIGUOUS, True, 2)
    # The law of cosines, sides of 5, 7 and 8 mm: 60 degrees between 5 and 8.
    for drawn, sign in zip(sorted(drawings, key=lambda each: -each.points["P2"][1]), (1, -1), strict=True):
        assert drawn.points["P2"] == pytest.approx((10 + 2.5, 20 + sign * 5 * sqrt(3) / 2), abs=1e-9)
        (asked,) = drawn.asked
        assert (asked.fact, asked.unit.value) == ("direction of c = ?", "deg")
        assert asked.value == pytest.approx(sign * (60 - 180), abs=1e-9)
        assert drawn.contour is not None
        assert drawn.contour.start == drawn.contour.end == (10.0, 20.0)
        assert [element.name for element in drawn.contour.elements] == ["a", "b", "c"]


def test_a_slot_closes_smoothly() -> None:
    sketch = path(("bottom",), ("right", "ccw"), ("top",), ("left", "ccw"))
    drawings = stated(
        sketch,
        *("direction of bottom = 0", "length of bottom = 30", "direction of top = 180", "radius of right = 4"),
        *("bottom tangent to right", "right tangent to top", "top tangent to left", "left tangent to bottom"),
        *("length of left = ?", "Y of center of left = ?"),
    )
    assert [drawn.points["P3"] for drawn in drawings] == [pytest.approx((0, 8), abs=1e-9)]
    assert [asked.value for asked in drawings[0].asked] == pytest.approx([4 * pi, 4], abs=1e-9)


def test_a_pie_slice_of_a_line_an_arc_and_a_line() -> None:
    sketch = path(("out",), ("rim", "ccw"), ("back",))
    facts = ("direction of out = 0", "length of out = 10", "X of center of rim = 0", "Y of center of rim = 0")
    (drawn,) = stated(sketch, *facts, "direction of back = 240", "angle from out to rim = ?", "length of rim = ?")
    assert drawn.points["P2"] == pytest.approx((10 * 0.5, 10 * sqrt(0.75)), abs=1e-9)
    assert [asked.value for asked in drawn.asked] == pytest.approx([90, 10 * radians(60)], abs=1e-9)


def test_nothing_follows_a_closed_path() -> None:
    sketch = path(("a",), ("b",))
    with pytest.raises(ValueError, match=r"line 'c': the path is closed at its start P0; nothing can follow"):
        sketch.line("c")
    with pytest.raises(ValueError, match=r"an element from P0 to P0 has no length"):
        Sketch().arc("a", "cw", to="P0")


# --- Distances, parallels and arcs from their centres -----------------------------------------------


def test_a_plate_is_drawn_from_the_distance_of_its_sides() -> None:
    sketch = path(("a",), ("b",), ("c",), ("d",))
    facts = ("direction of a = 10", "length of a = 30", "c parallel to a at 12", "d is parallel to b")
    drawings = stated(sketch, *facts, "angle from a to b = 80", "length of b = ?")
    (drawn,) = drawings
    assert (drawings.is_complete, drawings.ties) == (True, ())
    assert drawn.asked[0].value == pytest.approx(12 / cos(radians(10)), abs=1e-9)
    assert drawn.points["P3"] == pytest.approx((0, 12 / cos(radians(10))), abs=1e-9)


def whole_lines(*facts: Any) -> Drawings:
    sketch = Sketch()
    sketch.circle("a", (0, 0), 10)
    sketch.infinite_line("m")
    sketch.infinite_line("n")
    return stated(sketch, "m tangent to a", "direction of m = 0", *facts)


def test_whole_lines_lie_at_a_distance_on_either_side_and_on_one_line_at_none() -> None:
    drawings = whole_lines("n parallel to m at 4")
    assert sorted(drawn.lines["n"][2] for drawn in drawings) == pytest.approx([-14, -6, 6, 14], abs=1e-9)
    assert {drawn.name.split(", ")[1] for drawn in drawings} == {
        f"n parallel to m at 4 {side}" for side in ("left", "right")
    }
    assert all(drawn.points["n.foot"] == pytest.approx((0, drawn.lines["n"][2]), abs=1e-9) for drawn in drawings)
    assert sorted(drawn.lines["n"][2] for drawn in whole_lines("m parallel to n at 0")) == pytest.approx([-10, 10])
    assert whole_lines("n parallel to m").free == ("n.off",)
    assert (
        whole_lines("n parallel to m", "direction of n = 20", "n passes through [X0 Y0]").status is Status.CONFLICTING
    )


def test_a_circle_passes_beside_a_place_outside_or_inside_and_a_small_one_only_outside() -> None:
    def radii(place: int, distance: int) -> list[float]:
        sketch = Sketch()
        sketch.circle("k")
        facts = ("X of center of k = 0", "Y of center of k = 0", f"k passes beside [X{place} Y0] at {distance}")
        return sorted(drawn.radii["k.radius"] for drawn in stated(sketch, *facts))

    assert radii(20, 5) == pytest.approx([15, 25])
    assert radii(3, 5) == pytest.approx([8])  # the nearest place of a circle of radius 2 is 1 mm away, and not 5
    assert radii(20, 0) == pytest.approx([20])


def test_an_arc_is_drawn_from_its_ends_seen_from_its_centre_and_from_its_chord() -> None:
    sketch = path(("b", "ccw"), closes=False)
    asked = ("chord of b = ?", "polar angle of begin of b = ?", "X of center of b = ?")
    (drawn,) = stated(sketch, "radius of b = 5", "polar angle of begin of b = -90", "polar angle of b = 30", *asked)
    assert drawn.points["P1"] == pytest.approx((5 * cos(radians(30)), 7.5), abs=1e-9)
    assert [each.value for each in drawn.asked] == pytest.approx([5 * sqrt(3), -90, 0], abs=1e-9)
    assert [each.unit.value for each in drawn.asked] == ["mm", "deg", "mm"]
    sketch.state("polar angle of b = 210")
    assert len(sketch.solve()) == 0  # the opposite direction


# --- What comes out ---------------------------------------------------------------------------------


def test_what_is_asked_for_is_answered_in_the_order_in_which_it_was_stated() -> None:
    sketch = Sketch((1, 2))
    sketch.line("a")
    sketch.circle("k")
    facts = ("Y of P1 = ?", "direction of a = 30", LengthIs("a", Decimal(4)), "radius of k = ?", LengthIs("a", None))
    place = ("X of center of k = 0", "Y of center of k = 0", "k tangent to a")
    (drawn,) = stated(sketch, *facts, *place)
    # The distance of the origin from a line through (1, 2) at 30 degrees.
    expected = [4.0, abs(2 - tan(radians(30))) / hypot(1, tan(radians(30))), 4.0]
    assert [asked.value for asked in drawn.asked] == pytest.approx(expected, abs=1e-9)
    assert [asked.fact for asked in drawn.asked][:2] == ["Y of P1 = ?", "radius of k = ?"]


def test_what_is_not_determined_is_not_complete() -> None:
    drawings = stated(path(("a",), closes=False), "length of a = 3", "X of P1 = ?")
    assert (drawings.status, len(drawings), drawings.is_complete) == (Status.UNDERDETERMINED, 0, False)
    assert repr(drawings) == "<Drawings underdetermined: still open: X of P1, Y of P1>"


def test_a_drawing_says_what_it_is() -> None:
    sketch = Sketch()
    sketch.circle("a", (0, 0), 3)
    sketch.circle("k")
    drawings = stated(sketch, "k tangent to a", "X of center of k = 10", "Y of center of k = 0", "radius of k = ?")
    assert repr(drawings) == "<Drawings ambiguous: 2 drawings; these are all (by closed form)>"
    assert repr(drawings[0]) == (
        "<Drawn k tangent to a outside: k.center X10.0000 Y0.0000 mm, k.radius 7.0000 mm, radius of k = 7.0000 mm>"
    )
    assert str(drawings).split("\n") == [
        "ambiguous: 2 drawings; these are all (by closed form)",
        *(
            line
            for side, radius in (("outside", 7), ("inside", 13))
            for line in (
                f"k tangent to a {side}",
                "  k.center: X10.0000 Y0.0000 mm",
                f"  k.radius: {radius}.0000 mm",
                f"  radius of k = {radius}.0000 mm",
                "  certificate: exact",
            )
        ),
    ]


def test_numbers_of_every_kind_are_read_as_they_are_printed() -> None:
    sketch = Sketch((np.float64(0.1), "0.2"))
    sketch.circle("k", (np.int64(3), Decimal("4.5")), 1)
    assert sketch.profile().start.values == (Decimal("0.1"), Decimal("0.2"))
    assert sketch.profile().givens["k.center.0"].value == 3


# --- Calls that make no sense -----------------------------------------------------------------------


def taken() -> Sketch:
    sketch = path(("a",), ("b", "cw"), closes=False)
    sketch.circle("k")
    sketch.infinite_line("m")
    return sketch


@pytest.mark.parametrize(
    ("call", "message"),
    [
        *((lambda s, n=n: s.line(n), f"line '{n}': there is an element of the name '{n}' already") for n in "abkm"),
        (lambda s: s.arc("K", "cw"), "arc 'K': there is an element of the name 'K' already ('k': capitals do not"),
        (lambda s: s.infinite_line("b"), "infinite_line 'b': there is an element of the name 'b' already"),
        (lambda s: s.line("c", to="P1"), "line 'c': there is a point of the name 'P1' already"),
        (lambda s: s.line("c", to=3), "line 'c': the name of a point is a text, not 3"),
        (lambda s: s.line("c", to="begin of a"), "no fact could mention a point of the name 'begin of a'"),
        (lambda s: s.line("k.center"), "line 'k.center': 'k.center' has a dot"),
        (lambda s: s.circle("length of"), "no fact could mention an element of the name 'length of'"),
        (lambda s: s.circle("fact 1"), "no fact could mention an element of the name 'fact 1'"),
        (lambda s: s.circle("FACT 12"), "no fact could mention an element of the name 'FACT 12'"),
        (lambda s: s.line("c", to="fact 2"), "no fact could mention a point of the name 'fact 2'"),
        (lambda s: s.circle("c", (0, 0), "abc"), "circle 'c': radius is a number, not 'abc'"),
        (lambda s: s.circle("c", (0, 0), -3), "circle 'c': radius is larger than 0, not -3"),
        (lambda s: s.circle("c", (0, 0), float("nan")), "circle 'c': radius is a finite number, not nan"),
        (lambda s: s.circle("c", (0, 0), 10**9), "circle 'c': radius is 1000000000; the largest number"),
        (lambda s: s.circle("c", 5, 3), "circle 'c': center is a pair of numbers such as (10, 20), not 5"),
        (lambda s: s.circle("c", (1, "1,5"), 3), "circle 'c': Y of center is a number, not '1,5'"),
        (lambda s: s.circle("c", radius=3), "circle 'c': give both center and radius"),
        (lambda s: s.state(5), "state: a fact is a text or a statement, not 5"),
        (lambda s: stated(s, "radius of b = 3", "length of x = 3"), "fact 2 `length of x = 3`: expected an element"),
        (lambda s: stated(s, "length of k = 3"), "fact 1 `length of k = 3`: k is a whole circle and has no ends"),
        (lambda s: stated(s, "polar angle of a = 3"), "a is not round"),
        (lambda s: stated(s, "m parallel to k"), "k is not a line"),
        (lambda s: stated(s, "k passes beside [X0 Y0] at -1"), "a distance is not negative"),
        (lambda s: stated(s, "radius of b = -3"), "fact 1 `radius of b = -3`: a radius is larger than 0"),
        (lambda s: stated(s, RadiusIs("x", Decimal(3))), "there is no element 'x' here; elements are a, b, m, k"),
        (lambda s: stated(s, "a meets line at 30"), "fact 1 `a meets line at 30`: a is no last corner"),
        (lambda _: Sketch((0, "x")), "Sketch: Y of start is a number, not 'x'"),
        (lambda _: Sketch(name=""), "Sketch: the name of a point is a text, not ''"),
    ],
)
def test_a_call_that_makes_no_sense_names_the_call_and_the_value(call: Any, message: str) -> None:
    sketch = taken()
    with pytest.raises(ValueError) as found:  # noqa: PT011 - the message is looked at below
        call(sketch)
    assert message in str(found.value)
    assert "\n" not in str(found.value)


def test_a_call_that_was_refused_leaves_nothing_behind() -> None:
    sketch = taken()
    before = sketch.profile()
    for call in (lambda: sketch.line("c", to="P1"), lambda: sketch.arc("c", "left"), lambda: sketch.circle("c", 5, 5)):
        with pytest.raises(ValueError):  # noqa: PT011 - see above
            call()
    assert sketch.profile().figure == before.figure
    sketch.line("c")
