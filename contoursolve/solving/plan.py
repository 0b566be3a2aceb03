"""The construction of a contour: a list of small steps in closed form, found from structure alone."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

from msgspec import Struct

from contoursolve.geometry import (
    Arc,
    Collinear,
    Coordinate,
    Fact,
    Heading,
    Level,
    Offset,
    OnCircle,
    System,
    both,
)
from contoursolve.numeric import Tape, is_affine
from contoursolve.solving.determinacy import analyse, basis_of, groups_of, spare_of
from contoursolve.solving.inputs import input_values
from contoursolve.solving.partition import Group


class AffineStep(Struct, frozen=True):
    """One or two unknowns from as many facts that are affine in them (Cramer's rule)."""

    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]


class DistanceStep(Struct, frozen=True):
    """An unknown radius as the distance from a known centre to a known point of the circle."""

    circle: OnCircle


class LineCircleStep(Struct, frozen=True):
    """An unknown point on a circle and on a line that is known otherwise: nearer or farther along the line."""

    circle: OnCircle
    line: Heading | Collinear


class TwoCirclesStep(Struct, frozen=True):
    """An unknown point of two known circles, or the unknown centre of a circle through two known points (which lies
    on the circles of its radius about them): left or right of the way from the first centre to the second."""

    first: OnCircle
    second: OnCircle
    point: str

    @property
    def centers(self) -> tuple[str, str]:
        """The known points at known distances from which the unknown one lies."""
        return self._other(self.first), self._other(self.second)

    @property
    def is_equal(self) -> bool:
        """Whether both distances are the same radius."""
        return self.first.radius == self.second.radius

    def _other(self, circle: OnCircle) -> str:
        return circle.center if circle.point == self.point else circle.point


Step = AffineStep | DistanceStep | LineCircleStep | TwoCirclesStep


def lines_through(step: Step) -> Iterator[tuple[str, str]]:
    """The two known points of each line through two points of which a step finds a third."""
    facts = step.facts if isinstance(step, AffineStep) else (step.line,) if isinstance(step, LineCircleStep) else ()
    for fact in facts:
        if isinstance(fact, Collinear):
            is_found = isinstance(step, AffineStep) and not set(step.unknowns).isdisjoint(both(fact.through))
            yield fact.tail, fact.point if is_found else fact.through


class NoClosedFormError(Exception):
    """A group of facts for which no step exists, or facts that hold on either side; names the facts or the sides."""


class Plan(Struct, frozen=True):
    """Steps in order, and the facts that are left over as checks."""

    steps: tuple[Step, ...]
    basis: tuple[Fact, ...]
    checks: tuple[Fact, ...]


@lru_cache(maxsize=8192)
def make_plan(system: System) -> Plan:
    """The plan of a determined system.

    Raises NoClosedFormError if a group of facts has no step or a fact holds on either side, ValueError if the system
    is not determined.
    """
    verdict = analyse(system)
    if not verdict.is_determined:
        raise ValueError(f"not determined: {', '.join(verdict.free)}")
    sides = [side for fact in system.facts for side in fact.sides()]
    if sides:
        raise NoClosedFormError(f"nothing states {', '.join(dict.fromkeys(sides))}")
    groups = _starts_first(groups_of(system), system)
    return Plan(tuple(_step(group, system) for group in groups), basis_of(system), spare_of(system))


def _starts_first(groups: Sequence[Group], system: System) -> Sequence[Group]:
    """The groups in such an order that the start of an arc is known where an intersection is counted from it.

    Raises NoClosedFormError if there is none.
    """
    arcs = [element for element in system.figure.path if isinstance(element, Arc)]
    starts = {second.tail: first.tail for first, second in pairwise(arcs) if second.counts_clockwise}
    if not starts:
        return groups
    rest, found, known = list(groups), [], {*system.unknowns} - {name for each in groups for name in each.unknowns}
    while rest:
        for group in rest:
            needed = {name for fact in group.facts for name in system.unknowns_of(fact)}
            counted = [start for point, start in starts.items() if {*both(point)} == {*group.unknowns}]
            needed |= {name for start in counted for name in both(start) if name in system.unknowns}
            if needed - {*group.unknowns} <= known:
                break
        else:
            raise NoClosedFormError("an intersection is counted from the start of an arc that depends on it")
        rest.remove(group)
        found.append(group)
        known |= {*group.unknowns}
    return found


def _step(group: Group, system: System) -> Step:
    circles = [fact for fact in group.facts if isinstance(fact, OnCircle)]
    lines = [fact for fact in group.facts if isinstance(fact, Heading | Collinear)]
    unknowns = set(group.unknowns)
    if not circles:
        # Cramer's rule is written out for two.
        if len(group.facts) <= 2 and all(_is_affine(fact, unknowns, system) for fact in group.facts):  # noqa: PLR2004
            return AffineStep(group.facts, group.unknowns)
    elif len(group.facts) == 1 and unknowns == {circles[0].radius}:
        return DistanceStep(circles[0])
    elif len(circles) == len(lines) == 1 and unknowns == {*both(circles[0].point)}:
        return LineCircleStep(circles[0], lines[0])
    elif len(circles) == len(group.facts) == 2:  # noqa: PLR2004
        for point in (circles[0].center, circles[0].point):
            if unknowns == {*both(point)} and point in (circles[1].center, circles[1].point):
                return TwoCirclesStep(circles[0], circles[1], point)
    raise NoClosedFormError(f"{', '.join(map(str, group.facts))} for {', '.join(group.unknowns)}")


def _is_affine(fact: Fact, unknowns: set[str], system: System) -> bool:
    """Whether a fact is affine in unknowns while everything else is known."""
    if isinstance(fact, Coordinate | Offset | Level | Heading):
        return True
    if isinstance(fact, Collinear):
        # Affine in either of two points, at which the line may be taken to end.
        return unknowns.isdisjoint(both(fact.tail)) and not all(
            not unknowns.isdisjoint(both(point)) for point in (fact.through, fact.point)
        )
    tape = Tape()
    return is_affine([fact.residual(input_values(system, tape, {}))], [tape.input(name) for name in sorted(unknowns)])


@lru_cache(maxsize=8192)
def is_closed(system: System) -> bool:
    """Whether a determined system has a plan of steps in closed form."""
    try:
        make_plan(system)
    except NoClosedFormError:
        return False
    return True


@lru_cache(maxsize=8192)
def points_with_two_solutions(system: System) -> tuple[str, ...]:
    """The points of a determined system for which somebody must choose between two solutions."""
    points = []
    for step in make_plan(system).steps:
        if isinstance(step, LineCircleStep):
            points.append(step.circle.point)
        elif isinstance(step, TwoCirclesStep):
            points.append(step.point)
    return tuple(points)
