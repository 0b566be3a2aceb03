"""A contour whose words leave something free, with that put somewhere: each completion is solved as any other block."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from itertools import product
from math import hypot

from contoursolve.analysis import judge
from contoursolve.constraints import Coordinate, Offset, Radius, assemble
from contoursolve.model import FIRST, SECOND, Given, Layout, Profile, Unit, scalar
from contoursolve.pictures.known import Known, in_part, known_of
from contoursolve.solving import Point, Solution, Status, is_closed, points_with_two_solutions, solve
from contoursolve.solving.affine import affine_facts

MOST_FREE = 6
"""Free coordinates that are put somewhere; of a contour with more, only what is known is drawn."""

MOST_TRIED = 24
"""Places that are tried for what is free, each a solve of well under a millisecond."""

MOST_GHOSTS = 3
"""Completions that are shown."""

_STEPS = (0.6, 1.0, 0.35, 1.5, -0.6, -1.0, -0.35, -1.5)
"""Where a free coordinate is put, from where the line begins, in lengths of the drawing."""

_TURNED = (0.6, -0.6, 1.0, -1.0)
"""The same, with backwards as likely as onwards: a line at 180 deg leads to lower Z."""


def complete(profile: Profile, singular: Sequence[str] = ()) -> Known:
    """A contour with what its words leave free put somewhere, so that the control would make it if that can be;
    `singular` is what they leave free at their values only."""
    known = in_part(profile)
    free = judge(assemble(profile)).free
    if len(free) > MOST_FREE:
        return known
    size = drawing_size(profile)
    found: list[Solution] = []
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
    moved = (
        placed
        | open_
        | {name for name, at in first.points.items() for other in others if _is_apart(at, other.points[name], size)}
    )
    return replace(known_of(first), placed=frozenset(moved), others=tuple(others))


def _is_apart(one: Point, other: Point, size: float) -> bool:
    return hypot(one[0] - other[0], one[1] - other[1]) > size / 1_000_000


def _completions(
    profile: Profile, known: Known, size: float, singular: Sequence[str], steps: Sequence[float]
) -> Iterator[tuple[Profile, frozenset[str]]]:
    """The profile with further facts that determine it, and the points that these are about."""
    names = [name for name in singular if _is_placeable(name, profile)]
    extended, moves = _with(profile, dict.fromkeys(names, 0.0)), _moves(profile)
    while free := judge(assemble(extended)).free:
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
    """How much each coordinate changes when what is free moves by 1; 1 for what is not known."""
    affine = affine_facts(profile, profile.facts)
    freedoms = affine.freedoms() if affine is not None else ()
    return {
        scalar(freedom.point, axis): abs(freedom.direction[axis])
        for freedom in freedoms
        if freedom.direction is not None
        for axis in (FIRST, SECOND)
    }


def _lead(profile: Profile, known: Known, values: Mapping[str, float], point: str, axis: int) -> tuple[float, float]:
    """Where the element to a point comes from, on an axis, and the way (+1 or -1) in which the path leads on."""

    def get(name: str) -> float | None:
        return values.get(scalar(name, axis), known.coordinate(name, axis))

    comes = {element.head: element.tail for element in profile.figure.path}
    before = comes.get(point, profile.figure.start)
    base = get(before)
    earlier = get(comes[before]) if before in comes else None
    if base is None:
        return float(profile.start.values[axis] or 0), 1.0
    return base, -1.0 if earlier is not None and base < earlier else 1.0


def _with(profile: Profile, values: Mapping[str, float]) -> Profile:
    """The profile with unknowns at values."""
    givens, facts = dict(profile.givens), list(profile.facts)
    for name, value in values.items():
        given = f"put {name}"
        point, _, axis = name.rpartition(".")
        givens[given] = Given(given, Decimal(repr(round(value, 6))), Unit.MM, None)
        facts.append(Coordinate(given, point, int(axis)) if axis.isdigit() else Radius(given, name))
    return replace(profile, givens=givens, layout=Layout(profile.figure, tuple(facts)))


def drawing_size(profile: Profile) -> float:
    """How large a drawing is, by its words alone, mm."""
    start = [float(value or 0) for value in profile.start.values]
    sizes = []
    for fact in profile.facts:
        if isinstance(fact, Coordinate):
            sizes.append(abs(float(profile.givens[fact.given].value) - start[fact.axis]))
        elif isinstance(fact, Offset | Radius):
            sizes.append(abs(float(profile.givens[fact.given].value)))
    return max((size for size in sizes if size > 0), default=10.0)


def is_chosen(profile: Profile) -> bool:
    """Whether every point that may lie in two places has a choice."""
    chosen = {choice.point for choice in profile.choices}
    return chosen.issuperset(points_with_two_solutions(assemble(profile)))
