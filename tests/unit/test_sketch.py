"""`contoursolve.Sketch`: names, closed paths, values that are asked for, and calls that make no sense."""

import pickle
from decimal import Decimal
from typing import Any

import numpy
import pytest

from contoursolve import Drawings, Sketch, Status
from contoursolve.geometry import RadiusIs


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


def test_nothing_follows_a_closed_path() -> None:
    sketch = path(("a",), ("b",))
    with pytest.raises(ValueError, match=r"line 'c': the path is closed at its start P0; nothing can follow"):
        sketch.line("c")
    with pytest.raises(ValueError, match=r"an element from P0 to P0 has no length"):
        Sketch().arc("a", "cw", to="P0")


# --- Its equations ----------------------------------------------------------------------------------


def test_the_system_of_a_sketch_is_its_drawing_also_with_other_values_and_with_fewer_facts() -> None:
    def drawn(values: dict[str, float]) -> Sketch:
        sketch = path(("a",), ("k", "ccw"), ("b",), closes=False)
        stated(sketch, "a tangent to k", "k tangent to b", *(f"{name} = {value}" for name, value in values.items()))
        return sketch

    facts = {"length of a": 20.0, "direction of a": 30.0, "radius of k": 5.0, "direction of b": 90.0}
    facts["length of b"] = 10.0
    system = drawn(facts).system()
    assert (system.dof, system.ties, pickle.loads(pickle.dumps(system))) == (0, (), system)
    for changed in ({}, {"length of a": 31.5, "direction of b": 60.0}):
        again, (drawing,) = system.subs(changed), drawn(facts | changed).solve()
        found = {str(symbol): value for symbol, value in again.solution.items()}
        assert (found["X_P3"], found["Y_P3"]) == pytest.approx(drawing.points["P3"], abs=1e-9)
        assert numpy.array(again.function()()["points"])[-1] == pytest.approx(drawing.points["P3"], abs=1e-9)
    assert system.free("radius of k").dof == 1
    (conflict,) = drawn(facts | {"X of k.center": 16.0}).system().conflicts
    used = [f"{name} = {value}" for name, value in facts.items() if name.endswith((" a", " k"))]
    assert set(conflict.words) == {"a tangent to k", "X of k.center = 16.0", *used}
    with pytest.raises(ValueError, match="c is no word of the contour; its words are "):
        system.subs(c=3)


# --- Distances, parallels and arcs from their centres -----------------------------------------------


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


# --- What comes out ---------------------------------------------------------------------------------


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
        "<Drawing k tangent to a outside: k.center X10.0000 Y0.0000 mm, k.radius 7.0000 mm, radius of k = 7.0000 mm>"
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
            )
        ),
    ]


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
