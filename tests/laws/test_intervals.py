"""Intervals in doubles: nothing that is true is ever excluded, and what is proven to be the only solution is."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from random import Random
from typing import Any

import casadi
import mpmath
import numpy
import pytest
from mpmath import mp, mpf

from contoursolve.numeric import intervals
from contoursolve.numeric.hc4 import Boxes, Narrower, approach, contract
from contoursolve.numeric.interpreter import Replay
from contoursolve.numeric.intervals import Intervals, constant

COUNT = 300
"""Results of each part."""

ENDS = (0.0, 0.5, 1.0, 2.0, 1e-9, 3.7e5, 1e-200)


def random_interval(random: Random) -> tuple[float, float]:
    ends = [random.choice((random.uniform(-9, 9), random.choice(ENDS), -random.choice(ENDS))) for _ in range(2)]
    return min(ends), max(ends)


def inside(random: Random, ends: tuple[float, float]) -> float:
    return random.choice((*ends, random.uniform(*ends)))


def as_intervals(ends: Sequence[tuple[float, float]]) -> Intervals:
    return Intervals(numpy.array([low for low, _ in ends]), numpy.array([high for _, high in ends]))


OPERATIONS: dict[str, tuple[Callable[..., Any], Callable[..., Any]]] = {
    "sum": (lambda x, y: x + y, lambda x, y: Fraction(x) + Fraction(y)),
    "difference": (lambda x, y: x - y, lambda x, y: Fraction(x) - Fraction(y)),
    "product": (lambda x, y: x * y, lambda x, y: Fraction(x) * Fraction(y)),
    "quotient": (lambda x, y: x / y, lambda x, y: Fraction(x) / Fraction(y) if y else None),
    "square": (lambda x, _: intervals.square(x), lambda x, _: Fraction(x) ** 2),
    "inverse": (lambda x, _: intervals.inverse(x), lambda x, _: 1 / Fraction(x) if x else None),
    "root": (lambda x, _: intervals.root(x), lambda x, _: mpmath.sqrt(x) if x >= 0 else None),
    "magnitude": (lambda x, _: intervals.magnitude(x), lambda x, _: abs(Fraction(x))),
    "sine": (lambda x, _: intervals.sine(x), lambda x, _: mpmath.sin(x)),
    "cosine": (lambda x, _: intervals.cosine(x), lambda x, _: mpmath.cos(x)),
}


@pytest.mark.parametrize("part", range(10))
@pytest.mark.parametrize("name", OPERATIONS)
def test_the_interval_of_a_result_holds_every_result(part: int, name: str) -> None:
    of_intervals, exact = OPERATIONS[name]
    random = Random(f"{name} {part}")
    first, second = ([random_interval(random) for _ in range(COUNT)] for _ in range(2))
    with numpy.errstate(all="ignore"):
        found = of_intervals(as_intervals(first), as_intervals(second))
    with mp.workdps(400):
        for number, ends in enumerate(zip(first, second, strict=True)):
            value = exact(*(inside(random, each) for each in ends))
            if value is not None:
                value = mpf(value.numerator) / value.denominator if isinstance(value, Fraction) else value
                assert found.low[number] <= value <= found.high[number], ends


EQUATIONS: dict[str, Callable[..., Any]] = {
    "sum": lambda x, y: x + y,
    "difference": lambda x, y: x - y,
    "product": lambda x, y: x * y,
    "quotient": lambda x, y: x / y,
    "squares": lambda x, y: x * x - 2 * y * y,
    "inverse": lambda x, y: 1 / x + y,
    "mixed": lambda x, y: (x - y) * (x + 2 * y) - x,
    "wave": lambda x, y: casadi.cos(x) * y if isinstance(x, casadi.SX) else mpmath.cos(x) * y,
}


@pytest.mark.parametrize("part", range(10))
@pytest.mark.parametrize("name", EQUATIONS)
def test_what_satisfies_an_equation_stays_in_the_box(part: int, name: str) -> None:
    """The right side is an input that holds the exact value at a point of the box."""
    random = Random(f"{name} {part}")
    x, y, right = (casadi.SX.sym(each) for each in "xyr")
    equation = casadi.Function("f", [casadi.vertcat(x, y, right)], [EQUATIONS[name](x, y) - right])
    boxes, points, values = [], [], []
    with mp.workdps(60):
        while len(boxes) < COUNT:
            box = [random_interval(random) for _ in range(2)]
            point = [inside(random, each) for each in box]
            try:
                value = float(EQUATIONS[name](*map(mpf, point)))
            except ZeroDivisionError:
                continue
            boxes.append(box)
            points.append(point)
            values.append(value)
    sides = Intervals(numpy.nextafter(values, -numpy.inf), numpy.nextafter(values, numpy.inf))
    columns = [as_intervals(each) for each in zip(*boxes, strict=True)]
    with numpy.errstate(all="ignore"):
        found, is_possible = Narrower(equation, 1).narrowed([*columns, sides], len(boxes))
    assert is_possible.all()
    for column, at in zip(found[:2], zip(*points, strict=True), strict=True):
        assert ((column.low <= at) & (at <= column.high)).all()


def circles() -> Replay:
    """A circle of the radius 5 about 0 and one of the radius r about (6, 0), with their derivatives."""
    x, y, r = (casadi.SX.sym(each) for each in "xyr")
    outputs = casadi.vertcat(x * x + y * y - 25, (x - 6) ** 2 + y * y - r * r)
    slopes = casadi.jacobian(outputs, casadi.vertcat(x, y))
    rows = casadi.vertcat(outputs, casadi.reshape(slopes.T, 4, 1))
    return Replay(casadi.Function("f", [casadi.vertcat(x, y, r)], [casadi.densify(rows)]), intervals, constant)


def test_boxes_about_both_crossings_of_two_circles_are_proven_and_no_crossing_is_lost() -> None:
    """They cross at (3, 4) and (3, -4)."""
    random, equations, radius = Random(5), circles(), [as_intervals([(5.0, 5.0)] * 2)]
    crossings = numpy.array([[3.0, 4.0], [3.0, -4.0]])
    sizes = numpy.array([[10 ** random.uniform(-9, 1) for _ in range(2)] for _ in range(4_000)])
    shares = numpy.array([[random.uniform(-1.3, 0.3) for _ in range(2)] for _ in range(4_000)])
    low = crossings[numpy.arange(4_000) % 2] + shares * sizes
    boxes = Boxes(low, low + sizes, numpy.arange(4_000) % 2)

    def held(each: Boxes) -> Any:
        at = crossings[None]
        return ((each.low[:, None] <= at) & (at <= each.high[:, None])).all(axis=2)

    with numpy.errstate(all="ignore"):
        found = contract(equations, boxes, radius, 2.0**-43)
        ends = approach(equations, boxes.middle, radius, 25)
        none = contract(equations, boxes, [as_intervals([(0.5, 0.5)] * 2)], 2.0**-43)
    # A crossing in a box is in what is left of it; the boxes left are fewer, so they are counted.
    assert held(found.boxes).sum() >= held(boxes).sum()
    assert found.is_proven.sum() > 500
    assert (held(found.boxes)[found.is_proven].sum(axis=1) == 1).all()
    assert not none.is_proven.any()
    assert sorted(set(map(tuple, numpy.round(ends.low, 9)))) == [(3.0, -4.0), (3.0, 4.0)]
