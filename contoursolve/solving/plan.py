"""The construction of a contour: a list of small steps in closed form, found from structure alone."""

from dataclasses import dataclass
from functools import lru_cache

from contoursolve.analysis import Group, judge, order
from contoursolve.constraints import Heading, OnCircle, System
from contoursolve.model import FIRST, SECOND, Fact, scalar


@dataclass(frozen=True, slots=True)
class AffineStep:
    """One or two unknowns from as many facts that are affine in them (Cramer's rule)."""

    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class DistanceStep:
    """An unknown radius as the distance from a known centre to a known point of the circle."""

    circle: OnCircle


@dataclass(frozen=True, slots=True)
class LineCircleStep:
    """An unknown end of a line of known direction, on a circle and on the line: nearer or farther."""

    circle: OnCircle
    heading: Heading


@dataclass(frozen=True, slots=True)
class TwoPointsStep:
    """The unknown centre of a circle of known radius through two known points: left or right of them."""

    first: OnCircle
    second: OnCircle


Step = AffineStep | DistanceStep | LineCircleStep | TwoPointsStep


class NoClosedFormError(Exception):
    """A group of facts for which no step exists; names the facts."""


@dataclass(frozen=True, slots=True)
class Plan:
    """Steps in order, and the facts that are left over as checks."""

    steps: tuple[Step, ...]
    basis: tuple[Fact, ...]
    checks: tuple[Fact, ...]


@lru_cache(maxsize=8192)
def make_plan(system: System) -> Plan:
    """The plan of a determined system.

    Raises NoClosedFormError if a group of facts has no step, ValueError if the system is not determined.
    """
    verdict = judge(system)
    if not verdict.is_determined:
        raise ValueError(f"not determined: {', '.join(verdict.free)}")
    basis = tuple(system.facts[index] for index in verdict.basis)
    checks = tuple(fact for index, fact in enumerate(system.facts) if index not in verdict.basis)
    return Plan(tuple(_step(group) for group in order(system, basis)), basis, checks)


def _step(group: Group) -> Step:
    circles = [fact for fact in group.facts if isinstance(fact, OnCircle)]
    headings = [fact for fact in group.facts if isinstance(fact, Heading)]
    unknowns = set(group.unknowns)
    if not circles:
        if len(group.facts) <= 2:  # noqa: PLR2004 - Cramer's rule is written out for two
            return AffineStep(group.facts, group.unknowns)
    elif len(group.facts) == 1 and unknowns == {circles[0].radius}:
        return DistanceStep(circles[0])
    elif len(circles) == len(headings) == 1 and unknowns == _both(circles[0].point):
        return LineCircleStep(circles[0], headings[0])
    elif len(circles) == len(group.facts) == 2 and unknowns == _both(circles[0].center):  # noqa: PLR2004
        return TwoPointsStep(circles[0], circles[1])
    raise NoClosedFormError(f"{', '.join(map(str, group.facts))} for {', '.join(group.unknowns)}")


def _both(point: str) -> set[str]:
    return {scalar(point, FIRST), scalar(point, SECOND)}


def points_with_two_solutions(system: System) -> tuple[str, ...]:
    """The points of a determined system for which somebody must choose between two solutions."""
    points = []
    for step in make_plan(system).steps:
        if isinstance(step, LineCircleStep):
            points.append(step.circle.point)
        elif isinstance(step, TwoPointsStep):
            points.append(step.first.center)
    return tuple(points)
