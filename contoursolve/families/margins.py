"""What must hold of a contour, as numbers: each check of `solving.solve` and `solving.path` as a margin that ends where
the check fails."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from math import pi
from typing import Any

import numpy
from numpy.typing import NDArray

from contoursolve.backends.chart import Bounds, Chart
from contoursolve.backends.inputs import COSINE, SINE
from contoursolve.backends.intervals import Array
from contoursolve.backends.numeric import angle, larger, magnitude, sqrt
from contoursolve.constraints import Heading, OnCircle, System
from contoursolve.families.kinds import Follows
from contoursolve.model import FIRST, SECOND, Arc, Corner, CornerShape, Fact, Line, scalar
from contoursolve.solving import RefusalKind
from contoursolve.solving.compile import Machine, compile_system
from contoursolve.solving.plan import AffineStep, DistanceStep, Step, TwoCirclesStep
from contoursolve.tolerance import AGREEMENT, LENGTH, RADIUS_DIFFERENCE, REGULAR, TOUCHING


class Test(Enum):
    """When a check is passed."""

    AT_LEAST = "at least"
    """The margin is at least the limit."""
    APART = "apart"
    """The margin is farther from zero than the limit, on either side."""


@dataclass(frozen=True, slots=True)
class Margin:
    """One check: what is refused where it fails, about which point, element or corner, and on which element."""

    kind: RefusalKind
    subject: str
    element: str
    test: Test
    limit: float
    givens: tuple[str, ...] = ()
    """The values of the facts that it is about."""


@dataclass(frozen=True, slots=True, eq=False)
class Margins:
    """All checks of a system in their order, and their margins as functions of the free words."""

    checks: tuple[Margin, ...]
    chart: Chart

    @property
    def limits(self) -> Array:
        """The limits by check, as a column."""
        return numpy.array([[each.limit] for each in self.checks])

    @property
    def is_apart(self) -> NDArray[numpy.bool_]:
        """Which checks are about being apart from zero, as a column."""
        return numpy.array([[each.test is Test.APART] for each in self.checks])

    def failing(self, values: Array) -> NDArray[numpy.bool_]:
        """Which checks fail, by (check, place). NaN fails."""
        size = numpy.where(self.is_apart, numpy.abs(values), values)
        return ~numpy.where(self.is_apart, size > self.limits, size >= self.limits)

    def first_failing(self, values: Array) -> NDArray[numpy.int64]:
        """The number of the first check that fails, place by place; -1 where none does."""
        fails = self.failing(values)
        found: NDArray[numpy.int64] = numpy.where(fails.any(axis=0), fails.argmax(axis=0), -1)
        return found

    def verdicts(
        self, bounds: Bounds, is_level: NDArray[numpy.bool_]
    ) -> tuple[NDArray[numpy.bool_], NDArray[numpy.bool_]]:
        """In which boxes all checks are passed for certain, and in which one of them fails everywhere; `is_level` are
        the margins that are zero everywhere."""
        limits, is_apart = self.limits, self.is_apart
        bounds.low[is_level], bounds.high[is_level] = 0.0, 0.0
        passes = bounds.low >= limits
        passes = numpy.where(is_apart, (bounds.low > limits) | (bounds.high < -limits), passes)
        fails = numpy.where(is_apart, numpy.maximum(-bounds.low, bounds.high) <= limits, bounds.high < limits)
        return passes.all(axis=0) & bounds.is_defined, fails.any(axis=0) | bounds.is_undefined


@lru_cache(maxsize=256)
def compile_margins(system: System, words: int, follows: Follows) -> Margins:
    """The margins of a system that has a closed form as functions of some words."""
    machine = compile_system(system)
    found = list(_Margins(system, machine).all())
    outputs = {str(number): expression for number, (_, expression) in enumerate(found)}
    return Margins(tuple(each for each, _ in found), Chart(machine.tape, outputs, words, dict(follows)))


@lru_cache(maxsize=256)
def compile_results(
    system: System, words: int, follows: Follows, names: tuple[str, ...], *, is_rate: bool = False
) -> Chart:
    """Some outputs of a system, or their derivatives by the first word, as functions of some words."""
    tape = compile_system(system).tape
    return Chart(tape, {name: tape.expression(name) for name in names}, words, dict(follows), is_rate=is_rate)


_Found = Iterator[tuple[Margin, Any]]


class _Margins:
    """The checks of one system in the order of the verdict, each with its margin as an expression."""

    def __init__(self, system: System, machine: Machine) -> None:
        self.figure, self.plan, self.tape = system.figure, machine.plan, machine.tape
        self.out: Callable[[str], Any] = machine.tape.expression
        self.outputs = frozenset(machine.tape.outputs)

    def all(self) -> _Found:
        for number, step in enumerate(self.plan.steps):
            yield from self._step(number, step)
        for number, fact in enumerate(self.plan.checks, len(self.plan.basis)):
            yield from self._check(number, fact)
        for element in self.figure.path:
            yield self._element(element)
        for corner in self.figure.corners:
            yield from self._corner(corner)
        for corner in self.figure.corners:
            yield from self._fit(corner)
        for element in self.figure.path if self.figure.corners else ():
            room = self.out(f"room:{element.name}")
            yield _least(RefusalKind.CORNERS_OVERLAP, element.name, -LENGTH, element.name), room

    def _step(self, number: int, step: Step) -> _Found:
        out = self.out
        if isinstance(step, AffineStep):
            subject = ",".join(step.unknowns)
            givens = tuple(fact.given for fact in step.facts if fact.given)
            yield _apart(RefusalKind.LINES_PARALLEL, subject, REGULAR, givens), out(f"determinant:{number}")
            return
        if isinstance(step, DistanceStep):
            yield _least(RefusalKind.CIRCLE_UNDEFINED, step.circle.center, LENGTH), out(step.circle.radius)
            return
        kind, subject = RefusalKind.CIRCLE_MISSED, ""
        if isinstance(step, TwoCirclesStep):
            subject = step.point
            kind = RefusalKind.RADIUS_TOO_SMALL if step.is_equal else RefusalKind.CIRCLES_APART
            undefined = RefusalKind.CIRCLE_UNDEFINED if step.is_equal else kind
            yield _least(undefined, subject, LENGTH), out(f"distance:{number}")
        else:
            subject = step.circle.point
        offset, radius = out(f"offset:{number}"), out(f"radius:{number}")
        give = out(f"scale:{number}") * TOUCHING
        yield _least(kind, subject, 0.0), radius - offset + give
        yield _least(kind, subject, 0.0), radius + offset + give

    def _check(self, number: int, fact: Fact) -> _Found:
        """A fact that was not needed, at the points that the others give."""
        off, limit = self.out(f"residual:{number}"), AGREEMENT
        kind = RefusalKind.WORDS_DISAGREE if fact.given else RefusalKind.FACT_DISAGREES
        subject = fact.given
        if isinstance(fact, OnCircle) and not fact.given:
            first, second = self._way(fact.center, fact.point)
            off = sqrt(first**2 + second**2) - self.out(fact.radius)
            kind, limit, subject = RefusalKind.RADIUS_DIFFERENCE, RADIUS_DIFFERENCE, fact.point
        elif isinstance(fact, Heading):
            first, second = self._way(fact.tail, fact.head)
            cosine, sine = self.tape.input(fact.given + COSINE), self.tape.input(fact.given + SINE)
            turned = angle(cosine * second - sine * first, cosine * first + sine * second) * (180 / pi)
            margin = larger(limit - magnitude(off), limit - magnitude(turned))
            yield _least(kind, subject, 0.0), margin
            return
        yield _least(kind, subject, 0.0), limit - off
        yield _least(kind, subject, 0.0), limit + off

    def _element(self, element: Line | Arc) -> tuple[Margin, Any]:
        if isinstance(element, Arc):
            first, second = self._way(element.tail, element.head)
            return _least(RefusalKind.ARC_EMPTY, element.name, LENGTH, element.name), sqrt(first**2 + second**2)
        kind = RefusalKind.LINE_BACKWARDS if element.heading is None else RefusalKind.LINE_REVERSED
        return _least(kind, element.name, -LENGTH, element.name), self.out(f"length:{element.name}")

    def _corner(self, corner: Corner) -> _Found:
        out, name = self.out, corner.name
        for element in self._elements(corner):
            yield _least(RefusalKind.CORNER_TOO_LARGE, name, LENGTH, element), out(f"length:{element}")
        if f"landing:{name}" in self.outputs:
            yield _apart(RefusalKind.LANDING_UNKNOWN, name, 0.5), out(f"landing:{name}")
        yield _apart(RefusalKind.CORNER_STRAIGHT, name, REGULAR), out(f"turn:{name}")
        if corner.shape is CornerShape.CHAMFER_AXIS_45:
            for margin in self._inside(corner):
                yield _least(RefusalKind.BEVEL_OUTSIDE, name, -LENGTH), margin
            for way in ("in", "out"):
                yield _least(RefusalKind.BEVEL_IN_BAND, name, -LENGTH), out(f"setback-{way}:{name}")

    def _inside(self, corner: Corner) -> Iterator[Any]:
        """How far a corner lies inside the rectangle spanned by the ends of its two lines, mm."""
        path = {element.name: element for element in self.figure.path}
        before, after = path[corner.before], path.get(corner.after or "")
        if after is None or isinstance(before, Arc) or isinstance(after, Arc):
            return
        tail, head, at = self._point(before.tail), self._point(after.head), self._point(corner.at)
        for axis in (FIRST, SECOND):
            yield larger(at[axis] - tail[axis], at[axis] - head[axis])
            yield larger(tail[axis] - at[axis], head[axis] - at[axis])

    def _fit(self, corner: Corner) -> _Found:
        for element, way in zip(self._elements(corner), ("in", "out"), strict=False):
            setback = self.out(f"setback-{way}:{corner.name}")
            yield _least(RefusalKind.CORNER_TOO_LARGE, corner.name, -LENGTH, element), setback
            room = self.out(f"length:{element}") - setback
            yield _least(RefusalKind.CORNER_TOO_LARGE, corner.name, -LENGTH, element), room

    def _elements(self, corner: Corner) -> list[str]:
        """The elements that a corner joins, as far as they have two ends."""
        after = corner.after or corner.lands_on
        return [corner.before, *([after] if after and f"length:{after}" in self.outputs else [])]

    def _way(self, tail: str, head: str) -> tuple[Any, Any]:
        """From one point to another, mm."""
        (a, b), (c, d) = self._point(tail), self._point(head)
        return c - a, d - b

    def _point(self, name: str) -> tuple[Any, Any]:
        """A point, counted from the start."""
        if name == self.figure.start:
            return 0.0, 0.0
        return self.out(scalar(name, FIRST)), self.out(scalar(name, SECOND))


def _least(kind: RefusalKind, subject: str, limit: float, element: str = "") -> Margin:
    return Margin(kind, subject, element, Test.AT_LEAST, limit)


def _apart(kind: RefusalKind, subject: str, limit: float, givens: tuple[str, ...] = ()) -> Margin:
    return Margin(kind, subject, "", Test.APART, limit, givens)
