"""Points that only cut a straight line of the path in two: nothing says where, and wherever they lie the path is the
same."""

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import groupby, pairwise
from math import dist

from msgspec.structs import replace

from contoursolve.analysis import analyse
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Coordinate,
    Figure,
    Given,
    Layout,
    Line,
    Profile,
    Unit,
    assemble,
    both,
    line_scalars,
    scalar,
)
from contoursolve.solving.alternatives import find_alternatives
from contoursolve.solving.ambiguity import restrict, settle
from contoursolve.solving.solution import Point, Status
from contoursolve.tolerance import LENGTH

_SHIFTS = (-0.25, 0.25, 0.0)
"""Where a cut is tried, as parts of the way to the next one: the middle last."""

_SAME = 1e-7
"""mm. How far the other points of a path may move where only a cut does."""


def place_cuts(profile: Profile, open_: Sequence[str]) -> tuple[Profile, tuple[str, ...]]:
    """The profile with each such point put in the middle, and these points; the profile itself and none where
    something else is open, too. `open_` are the unknowns that are not determined.

    A cut is free if it may be put in several places between its neighbours, and no other point moves.
    """
    joints, loose = joints_among(profile.figure, open_), {name.rpartition(".")[0] for name in open_}
    if not joints or not profile.start.is_known:
        return profile, ()
    known = _known(profile, joints, loose)
    runs = list(_runs(profile, joints))
    if any(end not in known for first, _, last in runs for end in (first, last)):
        return profile, ()
    placed = profile
    for shift in _SHIFTS:
        places = {
            point: _between(known[first], known[last], (number + shift) / (len(points) + 1))
            for first, points, last in runs
            for number, point in enumerate(points, 1)
        }
        placed = _put(
            profile, places, {point: (known[first], known[last]) for first, own, last in runs for point in own}
        )
        if not _is_path(placed, places, known):
            return profile, ()
    return placed, tuple(joints)


def joints_among(figure: Figure, open_: Sequence[str]) -> list[str]:
    """The points between two lines, without a corner, of which unknowns are open; each may be a cut, by its values."""
    loose, sharp = {name.rpartition(".")[0] for name in open_}, {corner.at for corner in figure.corners}
    return [
        first.head
        for first, second in pairwise(figure.path)
        if isinstance(first, Line) and isinstance(second, Line) and first.head in loose - sharp
    ]


def _known(profile: Profile, joints: Sequence[str], loose: set[str]) -> Mapping[str, Point]:
    """Where the other points are, without all that is stated of these; none where that is not determined."""
    system, figure = assemble(profile), profile.figure
    out = {name for point in joints for name in both(point)}
    out |= {name for line in figure.carriers if line in loose for name in line_scalars(line)}
    kept = [name for name in system.unknowns if name not in out]
    part = restrict(profile, kept)
    if kept and not part.facts:
        return {}
    if not analyse(assemble(part)).is_determined:
        return {}
    start = profile.start.values
    places = [
        {
            point: (item.scalars[scalar(point, FIRST)], item.scalars[scalar(point, SECOND)])
            for point in part.figure.points
        }
        for item in find_alternatives(part).items
    ]
    # A line without points of its own may run either way.
    first = places[0] if places else {}
    if any(dist(at, first[point]) > _SAME for place in places for point, at in place.items()):
        return {}
    return {**first, figure.start: (float(start[FIRST] or 0), float(start[SECOND] or 0))}


def _runs(profile: Profile, joints: Sequence[str]) -> Iterator[tuple[str, list[str], str]]:
    """Joints in a row, with the point before them and the one behind."""
    path = profile.figure.path
    ends = [path[0].tail, *(each.head for each in path)]
    for is_joint, run in groupby(range(len(ends)), lambda number: ends[number] in joints):
        numbers = list(run)
        if is_joint:
            yield ends[numbers[0] - 1], [ends[number] for number in numbers], ends[numbers[-1] + 1]


def _between(first: Point, last: Point, part: float) -> Point:
    return first[0] + part * (last[0] - first[0]), first[1] + part * (last[1] - first[1])


def _put(profile: Profile, places: Mapping[str, Point], runs: Mapping[str, tuple[Point, Point]]) -> Profile:
    """The profile with points put in places along the line from one point to another."""
    facts, givens = list(profile.facts), dict(profile.givens)
    for point, place in places.items():
        first, last = runs[point]
        axis = FIRST if abs(last[FIRST] - first[FIRST]) >= abs(last[SECOND] - first[SECOND]) else SECOND
        name = f"{point} somewhere along {axis}"
        givens[name] = Given(name, Decimal(repr(place[axis])), Unit.MM, None)
        facts.insert(0, Coordinate(name, point, axis))
    return replace(profile, layout=Layout(profile.figure, tuple(facts)), givens=givens)


def _is_path(profile: Profile, places: Mapping[str, Point], known: Mapping[str, Point]) -> bool:
    """Whether there is a path with points in these places and all others where they are known to be."""
    if not analyse(assemble(profile)).is_determined:
        return False
    solution = settle(profile, is_blaming=False).solution
    if solution.status not in (Status.SOLVED, Status.OVERDETERMINED):
        return False
    meant = {**known, **places}
    return all(dist(at, meant[point]) <= _SAME for point, at in solution.points.items() if point in meant) and all(
        dist(solution.points[each.tail], solution.points[each.head]) > LENGTH for each in profile.figure.path
    )
