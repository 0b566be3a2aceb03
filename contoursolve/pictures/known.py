"""What can be known of a contour without solving it: points, and the circles about known centres through them."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import hypot, isfinite

from contoursolve.analysis import judge
from contoursolve.analysis.identities import is_affine
from contoursolve.constraints import Coordinate, Level, Offset, OnCircle, Radius, assemble
from contoursolve.model import FIRST, SECOND, Fact, Layout, Profile, scalar
from contoursolve.solving import Point, Refusal, Solution
from contoursolve.solving.affine import affine_facts
from contoursolve.solving.solution import CornerSolution
from contoursolve.tolerance import LARGEST


@dataclass(frozen=True, slots=True)
class Known:
    """`points` (mm) and `radii` by name, `corners` whether they fit or not; `placed` are the points that words leave
    free. `others` are further completions."""

    points: Mapping[str, Point] = field(default_factory=dict)
    radii: Mapping[str, float] = field(default_factory=dict)
    corners: Mapping[str, CornerSolution] = field(default_factory=dict)
    refusals: tuple[Refusal, ...] = ()
    placed: frozenset[str] = frozenset()
    others: tuple[Solution, ...] = ()
    scalars: Mapping[str, float] = field(default_factory=dict)
    """Coordinates of which the other one is not known."""

    def coordinate(self, point: str, axis: int) -> float | None:
        """One coordinate of a point, mm."""
        if point in self.points:
            return self.points[point][axis]
        return self.scalars.get(scalar(point, axis))


def known_of(solution: Solution) -> Known:
    """All that a solution says."""
    return Known(solution.points, solution.radii, solution.corners)


def place_of(profile: Profile, name: str) -> Point | None:
    """A point whose coordinates are given."""
    given = [profile.givens.get(scalar(name, axis)) for axis in (FIRST, SECOND)]
    values = [float(each.value) for each in given if each is not None]
    return (values[0], values[1]) if len(values) == len(given) else None


def is_usable(value: float) -> bool:
    """Whether a number is a coordinate that can be drawn."""
    return isfinite(value) and abs(value) <= 10 * LARGEST


def in_part(profile: Profile) -> Known:
    """What the facts say one after the other, without solving anything: coordinates, and the circles about known
    centres through known points."""
    system = assemble(profile)
    basis = [system.facts[index] for index in judge(system).basis]
    plain = [fact for fact in basis if is_affine([fact])]
    values = _fixed(profile, plain)
    for _ in basis:
        before = len(values)
        for fact in basis:
            _derive(fact, profile, values)
        if len(values) == before:
            break
    start = {scalar(system.figure.start, axis): float(v or 0) for axis, v in enumerate(profile.start.values)}
    everything = {**values, **start}
    points: dict[str, Point] = {}
    rest: dict[str, float] = {}
    for name in (system.figure.start, *system.figure.points, *system.figure.places):
        pair = [everything.get(scalar(name, axis)) for axis in (FIRST, SECOND)]
        if pair[0] is not None and pair[1] is not None:
            points[name] = pair[0], pair[1]
        else:
            rest |= {scalar(name, axis): value for axis, value in enumerate(pair) if value is not None}
    radii = {name: values[name] for name in system.figure.radii if name in values}
    return Known(points, radii, scalars=rest)


def _fixed(profile: Profile, facts: list[Fact]) -> dict[str, float]:
    """The coordinates that plain facts fix."""
    part = replace(profile, layout=Layout(profile.figure, tuple(facts)))
    affine = affine_facts(part, facts) if facts else None
    return {name: value for name, value in affine.fixed_by(facts).items() if is_usable(value)} if affine else {}


def _derive(fact: Fact, profile: Profile, values: dict[str, float]) -> None:
    """What one fact adds to the values that are known."""
    figure, amounts = profile.figure, profile.givens

    def get(point: str, axis: int) -> float | None:
        if point == figure.start:
            return float(profile.start.values[axis] or 0)
        if point in figure.places:
            return float(amounts[scalar(point, axis)].value)
        return values.get(scalar(point, axis))

    if isinstance(fact, Radius):
        values.setdefault(fact.radius, abs(float(amounts[fact.given].value)))
    elif isinstance(fact, Coordinate):
        values.setdefault(scalar(fact.point, fact.axis), float(amounts[fact.given].value))
    elif isinstance(fact, Offset):
        origin = get(fact.origin, fact.axis)
        if origin is not None and fact.point != figure.start:
            values.setdefault(scalar(fact.point, fact.axis), origin + float(amounts[fact.given].value))
    elif isinstance(fact, Level):
        level = get(fact.origin, fact.axis)
        if level is not None and fact.point != figure.start:
            values.setdefault(scalar(fact.point, fact.axis), level)
    elif isinstance(fact, OnCircle) and fact.radius not in values:
        pairs = [(get(fact.point, axis), get(fact.center, axis)) for axis in (FIRST, SECOND)]
        steps = [at - center for at, center in pairs if at is not None and center is not None]
        if len(steps) == len(pairs) and hypot(*steps) > 0:
            values[fact.radius] = hypot(*steps)
