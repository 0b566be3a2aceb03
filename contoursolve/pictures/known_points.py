"""The points of a contour that can be drawn without its solution: from its words one by one, and by completions.

A contour whose words leave something free is completed: that is put somewhere, and the rest solved as any other block.
"""

from collections.abc import Iterable, Mapping, Sequence, Set
from math import isfinite
from typing import TYPE_CHECKING

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.gcode import Word
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Fact,
    Layout,
    Profile,
    assemble,
    line_scalars,
    scalar,
)
from contoursolve.solving import (
    SAME,
    CornerSolution,
    Point,
    Refusal,
    SystemSolution,
    affine_facts,
    analyse,
    basis_of,
    distance,
    drawings,
    drawn_at,
    is_affine,
    points_with_two_solutions,
    told_by,
)
from contoursolve.tolerance import LARGEST

if TYPE_CHECKING:
    from contoursolve.solving import Alternative

MOST_GHOSTS = 3
"""Completions that are shown."""


class Known(Struct, frozen=True):
    """`points` (mm) and `radii` by name, `corners` whether they fit or not; `placed` are the points that words leave
    free. `others` are further completions."""

    points: Mapping[str, Point] = field(default_factory=dict)
    radii: Mapping[str, float] = field(default_factory=dict)
    corners: Mapping[str, CornerSolution] = field(default_factory=dict)
    refusals: tuple[Refusal, ...] = ()
    placed: frozenset[str] = frozenset()
    others: tuple[SystemSolution, ...] = ()
    ways: Mapping[str, Point | None] = field(default_factory=dict)
    """The directions in which points can still slide; None for one that lies anywhere."""
    scalars: Mapping[str, float] = field(default_factory=dict)
    """Coordinates of which the other one is not known."""

    several: frozenset[str] = frozenset()
    """The points that lie elsewhere in `variants`."""
    variants: tuple["Known", ...] = ()
    """The other ways in which what is determined can be."""

    def coordinate(self, point: str, axis: int) -> float | None:
        """One coordinate of a point, mm."""
        return self.points[point][axis] if point in self.points else self.scalars.get(scalar(point, axis))

    def shared(self) -> "Known":
        """Only what is the same in all variants."""
        values = [each._values() for each in (self, *self.variants)]
        same = {
            name: value
            for name, value in values[0].items()
            if all(name in other and abs(other[name] - value) <= SAME for other in values[1:])
        }
        points, rest = by_point(self.points, same)
        corners = {
            name: each
            for name, each in self.corners.items()
            if all(name in other.corners and _is_at(each, other.corners[name]) for other in self.variants)
        }
        radii = {name: each for name, each in self.radii.items() if name in same}
        rest |= {name: each for name, each in self.scalars.items() if name in same}
        return Known(points, radii, corners, self.refusals, self.placed, scalars=rest)

    def _values(self) -> dict[str, float]:
        """All numbers by name."""
        places = {scalar(name, axis): at[axis] for name, at in self.points.items() for axis in (FIRST, SECOND)}
        return {**places, **self.radii, **self.scalars}


def _is_at(one: CornerSolution, other: CornerSolution) -> bool:
    return max(distance(one.begin, other.begin), distance(one.end, other.end)) <= SAME


def known_of(solution: SystemSolution) -> Known:
    """All that a solution says."""
    corners = {name: each for name, each in solution.corners.items() if each.begin != each.end}
    return Known(solution.points, solution.radii, corners)


def place_of(profile: Profile, name: str) -> Point | None:
    """A point whose coordinates are given."""
    given = [profile.givens.get(scalar(name, axis)) for axis in (FIRST, SECOND)]
    values = [float(each.value) for each in given if each is not None]
    return (values[0], values[1]) if len(values) == len(given) else None


def place_beside(profile: Profile, fact: Fact) -> Point | None:
    """The place that an element passes at a distance; None for any other fact."""
    name = fact.beside.center if fact.beside else ""
    is_circle = name in {each.center for each in profile.figure.circles}
    return place_of(profile, name) if name in profile.figure.places and not is_circle else None


def start_of(profile: Profile) -> Point:
    """The start point of a contour, with 0 for a coordinate that is not known."""
    first, second = (float(value or 0) for value in profile.start.values)
    return first, second


def with_facts(profile: Profile, facts: Iterable[Fact]) -> Profile:
    """The profile with these facts only."""
    return replace(profile, layout=Layout(profile.figure, tuple(facts)))


def is_usable(value: float) -> bool:
    """Whether a number is a coordinate that can be drawn."""
    return isfinite(value) and abs(value) <= 10 * LARGEST


def is_chosen(profile: Profile) -> bool:
    """Whether every point that may lie in two places has a choice."""
    chosen = {choice.point for choice in profile.choices}
    return chosen.issuperset(points_with_two_solutions(assemble(profile)))


def by_point(names: Iterable[str], values: Mapping[str, float]) -> tuple[dict[str, Point], dict[str, float]]:
    """The points of which both coordinates are known, and the coordinates of the others."""
    points: dict[str, Point] = {}
    rest: dict[str, float] = {}
    for name in names:
        first, second = (values.get(scalar(name, axis)) for axis in (FIRST, SECOND))
        if first is not None and second is not None:
            points[name] = first, second
        else:
            rest |= {scalar(name, axis): each for axis, each in enumerate((first, second)) if each is not None}
    return points, rest


# One after the other -----------------------------------------------------------------------------------------


def in_part(profile: Profile) -> Known:
    """Values that follow from one fact after the other, without solving. They are coordinates, and circles about known
    centres through known points."""
    system = assemble(profile)
    figure = system.figure
    basis = basis_of(system)
    plain = [fact for fact in basis if is_affine([fact])]
    affine = affine_facts(with_facts(profile, plain), plain) if plain else None
    values = {name: value for name, value in affine.fixed_by(plain).items() if is_usable(value)} if affine else {}
    start = {scalar(figure.start, axis): value for axis, value in enumerate(start_of(profile))}
    places = [scalar(name, axis) for name in figure.places for axis in (FIRST, SECOND)]
    stated = {**{name: float(profile.givens[name].value) for name in places if name in profile.givens}, **start}
    amounts = {name: float(given.value) for name, given in profile.givens.items()}
    values = told_by(basis, amounts, stated, values)
    points, rest = by_point((figure.start, *figure.points, *figure.places), {**values, **start})
    return Known(points, {name: values[name] for name in figure.radii if name in values}, scalars=rest)


def in_chain(profile: Profile, items: Sequence["Alternative"] = (), blamed: Set[Word] = frozenset()) -> Known:
    """The determined part of a chain without a contour; `items` are the solutions that it has. With too few data it is
    the part that they fix. Without a solution it is the part before the words that are `blamed`."""
    from contoursolve.solving import before, find_alternatives, restrict  # noqa: PLC0415 - few contours need it

    system = assemble(profile)
    fixed = frozenset(system.unknowns).difference(analyse(system).free)
    if not items and fixed:
        part = restrict(profile, fixed) if len(fixed) < len(system.unknowns) else before(profile, blamed)
        if part is None or not analyse(assemble(part)).is_determined:
            return in_part(profile)
        items, fixed = find_alternatives(part).items, fixed.intersection(assemble(part).unknowns)
    ways = [_known_at(profile, item, fixed) for item in items]
    if not ways:
        return in_part(profile)
    first, *others = ways
    moved = {n for n, at in first.points.items() for other in others if distance(at, other.points[n]) > SAME}
    return replace(first, several=frozenset(moved), variants=tuple(others))


def _known_at(profile: Profile, item: "Alternative", fixed: frozenset[str]) -> Known:
    """The part of a solution of which everything is determined."""
    figure, solution = profile.figure, item.solution
    values = {name: value for name, value in item.scalars.items() if name in fixed and is_usable(value)}
    values |= {scalar(figure.start, axis): value for axis, value in enumerate(start_of(profile))}
    points, rest = by_point((figure.start, *figure.points), values)
    radii = {name: values[name] for name in figure.radii if name in values}
    lines = {name: values[name] for line in figure.carriers for name in line_scalars(line) if name in values}
    return Known(points, radii, known_of(solution).corners, solution.refusals, scalars={**rest, **lines})


# Completions -------------------------------------------------------------------------------------------------


def complete(profile: Profile) -> Known:
    """A contour with what its words leave free where it lies in a natural drawing, such that the control would make it
    if that can be."""
    lines = {each.name for each in (*profile.figure.path, *profile.figure.lines)}
    if not lines.issuperset(each.lands_on for each in profile.figure.corners if each.lands_on):
        return in_part(profile)
    for drawing in drawings(profile):
        solution = drawn_at(profile, drawing.scalars)
        if not solution.refusals:
            break
    else:
        return in_part(profile)
    others = list[SystemSolution]()
    for each in (each for each in drawing.beside() if drawing.goes_back or not each.goes_back):
        other = drawn_at(profile, each.scalars)
        if not other.refusals:
            others.append(other)
        if len(others) == MOST_GHOSTS:
            break
    ways = {each.point: each.direction for each in drawing.freedoms()}
    sized = {
        each.name for each in profile.figure.corners if f"{each.name}.radius" in {*drawing.scalars} - drawing.fixed
    }
    return replace(known_of(solution), placed=frozenset(ways) | sized, others=tuple(others), ways=ways)
