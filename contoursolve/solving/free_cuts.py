"""Points that only cut a straight line, or an arc, of the path in two: nothing says where, and wherever they lie the
path is the same."""

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import groupby, pairwise, product
from math import atan2, cos, degrees, dist, sin, tau

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Coordinate,
    Fact,
    Figure,
    Given,
    Layout,
    Line,
    Profile,
    Ray,
    Unit,
    assemble,
    both,
    scalar,
)
from contoursolve.solving.alternatives import find_alternatives
from contoursolve.solving.ambiguity import restrict, settle
from contoursolve.solving.determinacy import analyse
from contoursolve.solving.events import Status
from contoursolve.solving.numbers import sizes_of
from contoursolve.solving.solution import Alternatives, Point
from contoursolve.tolerance import LENGTH

_SHIFTS = (-0.25, 0.25, 0.0)
"""The places where a cut is tried, as parts of the way to the next one: the middle last."""

_SAME = 1e-7
"""mm. How far the other points of a path may move where only a cut does."""

_NEAR = 2**-6
"""mm. How far behind the point before it a cut is tried, where what is behind it is known through it alone."""


MOST_ON_CIRCLES, MOST_SINGULAR = 24, 12
"""Points between arcs of one sense up to which cuts are looked for: each takes searches over the whole chain, about so
many more of them where only values tell that they are open. Some seconds."""


class _Element(Struct, frozen=True):
    """An element of the path that a joint cuts; `known` are the scalars of its ends, and of the circle of an arc."""

    path: Line | Arc
    known: Mapping[str, float]

    def between(self, first: Point, last: Point, part: float) -> Point:
        """The point at this part of the way between two of its points."""
        if isinstance(self.path, Line):
            return first[0] + part * (last[0] - first[0]), first[1] + part * (last[1] - first[1])
        begin, end = self._direction(first), self._direction(last)
        sign = self.path.turn.sign
        # An arc that ends where it begins is a full circle.
        swept = sign * (end - begin) % tau if dist(first, last) > LENGTH else tau
        return self._on_circle(begin + sign * part * swept)

    def near(self) -> Iterator[tuple[Point, int]]:
        """The places where a point a little way behind its begin may be, and the axis along which it is put: both ways
        along both axes, for a line whose direction is not known yet."""
        first = _at(self.known, self.path.tail)
        if isinstance(self.path, Line):
            for axis, sign in product((FIRST, SECOND), (1, -1)):
                yield (first[0] + sign * _NEAR, first[1] + sign * _NEAR), axis
        elif self.known.keys() >= {*both(self.path.center), self.path.radius}:
            step = self.path.turn.sign * _NEAR / self.known[self.path.radius]
            yield self._on_circle(self._direction(first) + step), FIRST

    def put(self, profile: Profile, point: str, place: Point, axis: int) -> Profile:
        """The profile with a point put in a place: on a line by its coordinate along an axis, on an arc by its
        direction from the centre."""
        name = f"{point} somewhere"
        if isinstance(self.path, Line):
            fact: Fact = Coordinate(name, point, axis)
            given = Given(name, Decimal(repr(place[axis])), Unit.MM, None)
        else:
            fact = Ray(name, self.path.center, point)
            given = Given(name, Decimal(repr(degrees(self._direction(place)))), Unit.DEGREE, None)
        return replace(
            profile,
            layout=Layout(profile.figure, (fact, *profile.facts)),
            givens={**profile.givens, name: given},
        )

    def _direction(self, at: Point) -> float:
        """From the centre of an arc to a point, radians."""
        assert isinstance(self.path, Arc)
        center = _at(self.known, self.path.center)
        return atan2(at[1] - center[1], at[0] - center[0])

    def _on_circle(self, angle: float) -> Point:
        assert isinstance(self.path, Arc)
        center, radius = _at(self.known, self.path.center), self.known[self.path.radius]
        return center[0] + radius * cos(angle), center[1] + radius * sin(angle)


def place_cuts(profile: Profile, open_: Sequence[str]) -> tuple[Profile, tuple[str, ...]]:
    """The profile with each such point put in the middle, and these points; the profile itself and none where
    something else is open, too. `open_` are the unknowns that are not determined.

    A cut is free if it may be put in several places between its neighbours, and no other point moves.
    """
    found = _cuts(profile, open_) if profile.start.is_known and not _has_open_corner(profile) else None
    if found is None:
        return profile, ()
    cuts, known = found
    runs = list(_runs(profile, cuts))
    if not all(_has(known, end) for first, _, last, _ in runs for end in (first, last)):
        return profile, ()
    placed = profile
    for shift in _SHIFTS:
        places: dict[str, Point] = {}
        placed = profile
        for tail, points, head, path in runs:
            element, first, last = _Element(path, known), _at(known, tail), _at(known, head)
            axis = FIRST if abs(last[FIRST] - first[FIRST]) >= abs(last[SECOND] - first[SECOND]) else SECOND
            for number, point in enumerate(points, 1):
                places[point] = element.between(first, last, (number + shift) / (len(points) + 1))
                placed = element.put(placed, point, places[point], axis)
        if not _is_path(placed, places, known):
            return profile, ()
    return placed, tuple(cuts)


def _has_open_corner(profile: Profile) -> bool:
    """Whether nothing states, or asks for by a fact, how large a corner is."""
    sizes, unknowns = sizes_of(profile), assemble(profile).unknowns
    return any(each.size not in sizes and each.radius not in unknowns for each in profile.figure.corners)


def _cuts(profile: Profile, open_: Sequence[str]) -> tuple[list[str], Mapping[str, float]] | None:
    """The joints of which each, put somewhere on its line or arc, leaves less open, in the order of the path, until
    nothing is; and where all else is then. None where that leaves something open."""
    figure, cuts, placed = profile.figure, list[str](), profile
    system = assemble(profile)
    if len(system.unknowns) - len(analyse(system).basis) > len(joints_among(figure, open_)):
        return None
    elements = {each.head: each for each in figure.path}
    is_arc = [isinstance(elements[each], Arc) for each in joints_among(figure, open_)]
    arcs = [each for each in joints_among(figure, system.unknowns) if isinstance(elements[each], Arc)]
    if any(is_arc) and len(arcs) > (MOST_ON_CIRCLES if analyse(system).free else MOST_SINGULAR):
        return None
    bent = _bent(profile)
    while open_:
        point = next((each for each in joints_among(figure, open_) if each not in cuts), None)
        if point is None or point in bent:
            return None
        known = _known(placed, open_)
        if not _has(known, elements[point].tail):
            return None
        element = _Element(elements[point], known)
        for place, axis in element.near():
            tried = element.put(placed, point, place, axis)
            left = analyse(assemble(tried)).free or _singular(find_alternatives(tried))
            if point not in _points_of(left) and _has(_known(tried, left), point):
                break
        else:
            return None
        cuts, placed, open_ = [*cuts, point], tried, left
    known = _known(placed, ())
    return cuts, {name: value for name, value in known.items() if name.rpartition(".")[0] not in cuts}


def _bent(profile: Profile) -> frozenset[str]:
    """The points between lines whose stated directions differ: what moves such a point moves the next one, too."""
    headings = {
        fact.heading: profile.givens[fact.given].value
        for fact in profile.facts
        if fact.heading and fact.given in profile.givens
    }
    ways = [(each.head, headings.get((each.tail, each.head))) for each in profile.figure.path]
    return frozenset(
        point
        for (point, before), (_, behind) in pairwise(ways)
        if before is not None and behind is not None and (before - behind) % 180
    )


def _singular(found: Alternatives) -> list[str]:
    """The unknowns that its equations do not fix at their values: two arcs on one circle meet in no point."""
    doubts = () if found.items else found.doubts
    return [name for doubt in doubts for name in doubt.unknowns]


def _points_of(scalars: Sequence[str]) -> set[str]:
    """The points and lines to which scalars belong; radii are by themselves."""
    return {name.rpartition(".")[0] or name for name in scalars}


def joints_among(figure: Figure, open_: Sequence[str]) -> list[str]:
    """The points between two lines, or two arcs of one sense, without a corner, of which unknowns are open; each may be
    a cut, by its values."""
    loose, sharp = _points_of(open_), {corner.at for corner in figure.corners}
    return [
        first.head
        for first, second in pairwise(figure.path)
        if first.head in loose - sharp
        and (
            (isinstance(first, Line) and isinstance(second, Line))
            or (isinstance(first, Arc) and isinstance(second, Arc) and first.turn is second.turn)
        )
    ]


def _at(known: Mapping[str, float], point: str) -> Point:
    return known[scalar(point, FIRST)], known[scalar(point, SECOND)]


def _has(known: Mapping[str, float], point: str) -> bool:
    return known.keys() >= {*both(point)}


def _known(profile: Profile, open_: Sequence[str]) -> Mapping[str, float]:
    """The places of points, and the radii, as far as that is determined without what is open."""
    system, figure = assemble(profile), profile.figure
    start = {scalar(figure.start, axis): float(profile.start.values[axis] or 0) for axis in (FIRST, SECOND)}
    out = _points_of([*open_, *analyse(system).free])
    while True:
        kept = [name for name in system.unknowns if (name.rpartition(".")[0] or name) not in out]
        part = restrict(profile, kept)
        if not part.facts or not analyse(assemble(part)).is_determined:
            return start
        found = find_alternatives(part)
        more = _points_of(_singular(found)) - out
        if not more:
            break
        out |= more
    shown = {name for point in part.figure.points for name in both(point)} | {*part.figure.radii}
    places = [{name: value for name, value in item.scalars.items() if name in shown} for item in found.items]
    # A line without points of its own may run either way.
    if not places or any(abs(place[name] - value) > _SAME for place in places for name, value in places[0].items()):
        return start
    return {**places[0], **start}


def _runs(profile: Profile, joints: Sequence[str]) -> Iterator[tuple[str, list[str], str, Line | Arc]]:
    """Joints in a row, with the point before them, the one behind, and the element that they cut."""
    path = profile.figure.path
    ends = [path[0].tail, *(each.head for each in path)]
    for is_joint, run in groupby(range(len(ends)), lambda number: ends[number] in joints):
        numbers = list(run)
        if is_joint:
            element = path[numbers[0] - 1]
            yield element.tail, [ends[number] for number in numbers], ends[numbers[-1] + 1], element


def _is_path(profile: Profile, places: Mapping[str, Point], known: Mapping[str, float]) -> bool:
    """Whether there is a path with points in these places and all others where they are known to be."""
    if not analyse(assemble(profile)).is_determined:
        return False
    solution = settle(profile, is_blaming=False).solution
    if solution.status not in (Status.SOLVED, Status.OVERDETERMINED):
        return False
    meant = {point: _at(known, point) for point in solution.points if _has(known, point)} | dict(places)
    return all(dist(at, meant[point]) <= _SAME for point, at in solution.points.items() if point in meant) and all(
        dist(solution.points[each.tail], solution.points[each.head]) > LENGTH or isinstance(each, Arc)
        for each in profile.figure.path
    )
