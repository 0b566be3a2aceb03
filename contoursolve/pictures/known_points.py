"""The points of a contour that can be drawn without its solution: from its words one by one, and by completions.

A contour whose words leave something free is completed: that is put somewhere, and the rest solved as any other block.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from decimal import Decimal
from itertools import product
from math import hypot, isfinite
from typing import TYPE_CHECKING

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.gcode import Word
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Coordinate,
    Fact,
    Given,
    Layout,
    Profile,
    Radius,
    Unit,
    assemble,
    line_scalars,
    scalar,
)
from contoursolve.solving import (
    SAME,
    CornerSolution,
    Point,
    Refusal,
    Status,
    SystemSolution,
    affine_facts,
    analyse,
    basis_of,
    distance,
    is_affine,
    is_closed,
    points_with_two_solutions,
    solve,
)
from contoursolve.tolerance import LARGEST

if TYPE_CHECKING:
    from contoursolve.solving import Alternative

MOST_FREE = 6
"""Free coordinates that are put somewhere; of a contour with more, only what is known is drawn."""

MOST_TRIED = 24
"""Places that are tried for what is free, each a solve of well under a millisecond."""

MOST_GHOSTS = 3
"""Completions that are shown."""

_STEPS = (0.6, 1.0, 0.35, 1.5, -0.6, -1.0, -0.35, -1.5)
"""Trial positions of a free coordinate, from the beginning of its line, in lengths of the drawing."""

_TURNED = (0.6, -0.6, 1.0, -1.0)
"""The same, with backwards as likely as onwards: a line at 180 deg leads to lower Z."""


class Known(Struct, frozen=True):
    """`points` (mm) and `radii` by name, `corners` whether they fit or not; `placed` are the points that words leave
    free. `others` are further completions."""

    points: Mapping[str, Point] = field(default_factory=dict)
    radii: Mapping[str, float] = field(default_factory=dict)
    corners: Mapping[str, CornerSolution] = field(default_factory=dict)
    refusals: tuple[Refusal, ...] = ()
    placed: frozenset[str] = frozenset()
    others: tuple[SystemSolution, ...] = ()
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
    for _ in basis:
        before = len(values)
        for fact in basis:
            _derive(fact, profile, stated, values)
        if len(values) == before:
            break
    points, rest = by_point((figure.start, *figure.points, *figure.places), {**values, **start})
    return Known(points, {name: values[name] for name in figure.radii if name in values}, scalars=rest)


def _derive(fact: Fact, profile: Profile, stated: Mapping[str, float], values: dict[str, float]) -> None:
    """Add to `values` those that one fact gives; the start and the places have theirs in `stated`."""

    def get(point: str, axis: int) -> float | None:
        name = scalar(point, axis)
        return stated.get(name, values.get(name))

    placed, circle = fact.placed, fact.circle
    if fact.sizes:
        values.setdefault(fact.sizes, abs(float(profile.givens[fact.given].value)))
    elif placed is not None:
        origin = get(placed.origin, placed.axis) if placed.origin else 0.0
        if origin is not None:
            step = float(profile.givens[fact.given].value) if placed.is_stepped else 0.0
            values.setdefault(scalar(placed.point, placed.axis), origin + step)
    elif circle is not None and circle.radius not in values:
        pairs = [(get(circle.point, axis), get(circle.center, axis)) for axis in (FIRST, SECOND)]
        steps = [at - center for at, center in pairs if at is not None and center is not None]
        if len(steps) == len(pairs) and hypot(*steps) > 0:
            values[circle.radius] = hypot(*steps)


def in_chain(profile: Profile, items: Sequence["Alternative"] = (), blamed: Set[Word] = frozenset()) -> Known:
    """The determined part of a chain without a contour; `items` are the solutions that it has. With too few data it is
    the part that they fix. Without a solution it is the part before the words that are `blamed`."""
    from contoursolve.solving import (  # noqa: PLC0415 - as above
        before,
        find_alternatives,
        restrict,
    )

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


def complete(profile: Profile, singular: Sequence[str] = ()) -> Known:
    """A contour with what its words leave free put somewhere, so that the control would make it if that can be;
    `singular` is what they leave free at their values only."""
    known = in_part(profile)
    free = analyse(assemble(profile)).free
    if len(free) > MOST_FREE:
        return known
    size = _drawing_size(profile)
    found: list[SystemSolution] = []
    placed: frozenset[str] = frozenset()
    # All onwards first; the ways in which some turn back only where that gives no contour.
    for full, names in (
        each for steps in (_STEPS, _TURNED) if not found for each in _completions(profile, known, size, singular, steps)
    ):
        if len(found) > MOST_GHOSTS:
            break
        placed = names
        if is_closed(assemble(full)) and is_chosen(full):
            solution = solve(full, is_proven=False)
            if solution.status in (Status.SOLVED, Status.OVERDETERMINED) and solution.points:
                found.append(solution)
    if not found:
        return known
    first, *others = found
    open_ = {point for point, _, axis in (name.rpartition(".") for name in free) if axis.isdigit()}
    apart = size / 1_000_000
    moved = {n for n, at in first.points.items() for other in others if distance(at, other.points[n]) > apart}
    return replace(known_of(first), placed=placed | open_ | moved, others=tuple(others))


def _completions(
    profile: Profile, known: Known, size: float, singular: Sequence[str], steps: Sequence[float]
) -> Iterator[tuple[Profile, frozenset[str]]]:
    """The profile with further facts that determine it, and the points that these are about."""
    names = [name for name in singular if _is_placeable(name, profile)]
    extended, moves = _with(profile, dict.fromkeys(names, 0.0)), _moves(profile)
    while free := analyse(assemble(extended)).free:
        open_ = [
            name for name in free if name not in names and name not in known.scalars and _is_placeable(name, profile)
        ]
        if not open_ or len(names) >= MOST_FREE:
            return
        names.append(max(open_, key=lambda name: round(moves.get(name, 1.0), 6)))
        extended = _with(profile, dict.fromkeys(names, 0.0))
    points = frozenset(name.rpartition(".")[0] for name in names if name not in profile.figure.radii)
    tried = sorted(product(steps, repeat=len(names)), key=lambda each: sum(map(steps.index, each)))[:MOST_TRIED]
    for lengths in tried:
        values: dict[str, float] = {}
        for name, step in zip(names, lengths, strict=True):
            if name in profile.figure.radii:
                values[name] = abs(step) * size
                continue
            point, _, axis = name.rpartition(".")
            base, lead = _lead(profile, known, values, point, int(axis))
            values[name] = base + lead * step * size
        yield _with(profile, values), points


def _is_placeable(name: str, profile: Profile) -> bool:
    return name in profile.figure.radii or name.rpartition(".")[2] in (str(FIRST), str(SECOND))


def _moves(profile: Profile) -> dict[str, float]:
    """Change of each coordinate of a freedom that moves by 1 in its direction, by name, without sign."""
    affine = affine_facts(profile, profile.facts)
    freedoms = affine.freedoms() if affine is not None else ()
    return {
        scalar(freedom.point, axis): abs(freedom.direction[axis])
        for freedom in freedoms
        if freedom.direction is not None
        for axis in (FIRST, SECOND)
    }


def _lead(profile: Profile, known: Known, values: Mapping[str, float], point: str, axis: int) -> tuple[float, float]:
    """The coordinate, on an axis, from which the element to a point comes, and the sign with which the path leads
    on."""

    def get(name: str) -> float | None:
        return values.get(scalar(name, axis), known.coordinate(name, axis))

    comes = {element.head: element.tail for element in profile.figure.path}
    before = comes.get(point, profile.figure.start)
    base = get(before)
    earlier = get(comes[before]) if before in comes else None
    if base is None:
        return start_of(profile)[axis], 1.0
    return base, -1.0 if earlier is not None and base < earlier else 1.0


def _with(profile: Profile, values: Mapping[str, float]) -> Profile:
    """The profile with unknowns at values."""
    givens, facts = dict(profile.givens), list(profile.facts)
    for name, value in values.items():
        given = f"put {name}"
        point, _, axis = name.rpartition(".")
        givens[given] = Given(given, Decimal(repr(round(value, 6))), Unit.MM, None)
        facts.append(Coordinate(given, point, int(axis)) if axis.isdigit() else Radius(given, name))
    return replace(with_facts(profile, facts), givens=givens)


def _drawing_size(profile: Profile) -> float:
    """Size of a drawing, by its words alone, mm."""
    start, sizes = start_of(profile), []
    for fact in profile.facts:
        if fact.sizes or (fact.placed and fact.placed.is_stepped):
            origin = start[fact.placed.axis] if fact.placed and not fact.placed.origin else 0.0
            sizes.append(abs(float(profile.givens[fact.given].value) - origin))
    return max((size for size in sizes if size > 0), default=10.0)
