"""The path of a tool's centre beside a contour, and what of the contour it cannot cut."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from itertools import pairwise
from math import atan2, cos, degrees, dist, hypot, pi, radians, tan
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import FIRST, SECOND, Circle, Line, Turn, Values, dot, make_tangent
from contoursolve.solving import (
    ArcSegment,
    LineSegment,
    Point,
    Segment,
    along,
    foot_on,
    is_on,
    largest_fitting,
    middle,
    way_to,
)
from contoursolve.tolerance import AGREEMENT, INCREMENT, LENGTH, REGULAR
from contoursolve.tool_radius.clearance import (
    crossings,
    gaps_below,
    split,
    square_to,
)
from contoursolve.tool_radius.faults import ToolFault, ToolFaultKind
from contoursolve.tool_radius.joint import STRAY, TANGENT, direction, join, meet_outside, turn_of
from contoursolve.tool_radius.tool import OutsideCorner, Tool
from contoursolve.tool_radius.tool_settings import ToolSettings

GOUGE = 1e-6
"""mm. Nearer than the radius by less than this is no gouge: a thousandth of the controls' least increment."""

_SLACK = 0.7 * LENGTH
"""mm. By so much a tool may be too large and still counts as one that fits: the limit itself lies below."""

_ASIDE = (10 * LENGTH, GOUGE, INCREMENT)
"""mm. How far beyond a limit a tool is tried, until one does not fit."""

_LOOKED = 500
"""Elements among which the largest radius is looked for where a tool cuts into others; of more, none is told."""

NOTICED = 0.005
"""mm. Smaller errors and rests are not told (assumed)."""

_FASTER = 2.0
"""Times as fast as its centre an edge may be before that is told (derived: r/r')."""

_FLANKS = (ToolFaultKind.BACK_FLANK, ToolFaultKind.FRONT_FLANK)
_FLANK = 1e-6
"""deg. Rounding of an angle."""

_CLEAR = 1e-3
"""d.N. By more than this the tip points away from the surface (assumed)."""


class OffsetElement(Struct, frozen=True):
    """A line or an arc of the centre's path, and the number of the element with whose block it is written; its `own`
    offset, or a part of the way around the corner behind it."""

    segment: Segment
    element: int
    is_own: bool = True


class Gouge(Struct, frozen=True):
    """A cut of a tool into a wall (mm deep) while it works on another element, and where."""

    depth: float
    wall: int
    working: int
    at: Point

    def is_like(self, other: "Gouge", radius: float) -> bool:
        """Whether it is one fault with another: near it, on the same wall, or seen from the other side."""
        is_turned = abs(self.wall - other.working) <= 1 and abs(self.working - other.wall) <= 1
        return is_turned or self.wall == other.wall or dist(self.at, other.at) <= 2 * radius


_USUAL = ToolSettings()


class RunsCrossing(Struct, frozen=True):
    """The place where the straight run-in and the straight run-off of a contour cross in an outside corner, or would if
    they went on; the numbers of their elements; and the least radius (mm) of a tool that reaches from one to the
    other."""

    at: Point
    coming: tuple[int, ...]
    going: tuple[int, ...]
    least: float


class UncutRest(Struct, frozen=True):
    """The rest that a tool leaves where its centre goes on from one element to a later one: how deep (mm), beside which
    elements (their numbers), and by how much of the first and the last one it does not cut (mm)."""

    center: Point
    first: int
    last: int
    depth: float
    lost: tuple[float, float]


class OffsetPath:
    """The path of the centre of a tool of a radius (mm) to the left (`side` +1) or right (-1) of elements, square to
    the first and the last one at its ends. `levels` are the numbers of the pass of each, from 1, negative for what is
    no surface, into which nothing can cut. Of a part of a path, `walls` are those of the whole one."""

    def __init__(
        self,
        elements: Sequence[Segment],
        radius: float,
        side: int,
        settings: ToolSettings = _USUAL,
        levels: Sequence[int] | None = None,
        walls: Mapping[int, Segment] | None = None,
    ) -> None:
        self.elements, self.radius, self.side, self.settings = elements, radius, side, settings
        self.levels = levels or [1] * len(elements)
        self.joints = [join(one, two, radius, side) for one, two in pairwise(elements)]
        self.walls = self._walls() if walls is None else walls

    def _stated(self) -> tuple[Any, ...]:
        return tuple(self.elements), self.radius, self.side, self.settings, tuple(self.levels), dict(self.walls)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, OffsetPath) and self._stated() == other._stated()

    def __hash__(self) -> int:
        return hash((tuple(self.elements), self.radius, self.side))

    @cached_property
    def stops(self) -> tuple[ToolFault, ...]:
        """The faults that keep the tool from the path: of neighbours, or else of our own check, or else of any
        elements."""
        return () if self.settings.leaves and self.shortcut else self._stops

    @cached_property
    def _stops(self) -> tuple[ToolFault, ...]:
        return tuple(self._local()) or tuple(self._unverified(self._pieces)) or tuple(self._interferences())

    @cached_property
    def faults(self) -> tuple[ToolFault, ...]:
        """The same, each with the largest radius that fits at its place."""
        return tuple(self._with_largest(self.stops))

    def _walls(self) -> Mapping[int, Segment]:
        """The surface of the part, by the numbers of elements. Where the run-in and the run-off cross, each is part of
        it up to there."""
        found = {number: each for number, each in enumerate(self.elements) if self.levels[number] > 0}
        crossing = self.crossing
        if crossing is None or self.radius < crossing.least:
            return found
        for number in (*crossing.coming, *crossing.going):
            own, is_first = self.elements[number], number in crossing.coming
            way = way_to(own, crossing.at)
            if 0 < way < own.length:
                found[number] = replace(own, start=crossing.at) if is_first else replace(own, end=crossing.at)
            elif (way > 0) is is_first:
                del found[number]
        return found

    @cached_property
    def crossing(self) -> RunsCrossing | None:
        """The place where straight run-in and run-off cross in an outside corner, or would if they went on; None where
        there is none, or where one of them ends there."""
        every = range(len(self.elements))
        coming, going = self._straight(every), self._straight(every[::-1])
        if not coming or not going or coming[-1] + 1 >= going[-1] or self.levels[0] != self.levels[-1]:
            return None
        one = LineSegment("", self.elements[0].start, self.elements[coming[-1]].end)
        other = LineSegment("", self.elements[going[-1]].start, self.elements[-1].end)
        turn, at = self.side * turn_of(other, one), next(crossings(one, other), None)
        if at is None or turn >= 0 or one.length - way_to(one, at) <= AGREEMENT or way_to(other, at) <= AGREEMENT:
            return None
        beyond = max(0.0, -way_to(one, at), way_to(other, at) - other.length)
        # A tool that is the least one but for rounding reaches, too.
        return RunsCrossing(at, tuple(coming), tuple(going), max(0.0, beyond * tan(-turn / 2) - LENGTH))

    def _straight(self, numbers: Sequence[int]) -> list[int]:
        """The first of some elements that follow one another, as far as they are one straight line of the surface."""
        found = list[int]()
        for number in numbers:
            is_bent = bool(found) and abs(self.joints[min(number, found[-1])].turn) > TANGENT
            is_wall = isinstance(self.elements[number], LineSegment) and self.levels[number] > 0
            if is_bent or not is_wall or self.levels[number] != self.levels[numbers[0]]:
                break
            found.append(number)
        return found

    @cached_property
    def pieces(self) -> tuple[OffsetElement, ...] | None:
        """The path; None where it does not fit."""
        return None if self.stops else self.shortcut if self._stops else self._pieces

    # What fits --------------------------------------------------------------------------------------------------

    def _local(self) -> Iterator[ToolFault]:
        """The faults that each element has with its neighbours."""
        small = set[int]()
        for number, element in enumerate(self.elements):
            if not isinstance(element, ArcSegment) or element.turn.sign != self.side:
                continue
            short = self.radius - element.radius
            if short > LENGTH:
                yield ToolFault(ToolFaultKind.ARC_TOO_SMALL, number, short, element.radius, element.length)
                small |= {number - 1, number, number + 1}
            elif short >= -LENGTH and self.settings.refuses_point:
                yield ToolFault(ToolFaultKind.EQUAL_RADIUS, number, short, None, element.length)
        for number, joint in enumerate(self.joints):
            if joint.is_lost and number not in small:
                yield ToolFault(ToolFaultKind.NO_INTERSECTION, number, length=self.elements[number].length)
                small |= {number, number + 1}
        for number in range(len(self.elements)):
            if (room := self._room(number)) < -LENGTH and number not in small:
                yield ToolFault(ToolFaultKind.ELEMENT_VANISHES, number, -room, length=self.elements[number].length)

    def _with_largest(self, faults: Sequence[ToolFault]) -> Iterator[ToolFault]:
        """Faults, each with the largest radius with which what is near it can be cut; unless too much is."""
        looked = 0
        for each in faults:
            first, last = sorted((each.element, each.element if each.working is None else each.working))
            is_joint = each.kind is ToolFaultKind.NO_INTERSECTION
            looked += last - first
            largest = each.largest
            if largest is None and each.kind is not ToolFaultKind.NOT_VERIFIED and looked <= _LOOKED:
                largest = self._largest(slice(max(first - (not is_joint), 0), last + 2))
            short = self.radius - largest if is_joint and largest is not None else each.short
            yield replace(each, largest=largest, short=short)

    def _largest(self, near: slice) -> float:
        walls = {number - near.start: each for number, each in self.walls.items() if near.start <= number < near.stop}

        def stops(size: float) -> Sequence[ToolFault]:
            return OffsetPath(self.elements[near], size, self.side, self.settings, self.levels[near], walls)._stops

        return largest_radius(stops, self.radius)[0]

    def _room(self, number: int) -> float:
        """The length that the corners at both ends leave of an element, mm."""
        before = self.joints[number - 1].meeting if number else None
        behind = self.joints[number].meeting if number < len(self.joints) else None
        taken = (before.ahead if before else 0.0) + (behind.back if behind else 0.0)
        return self.elements[number].length - taken

    # The path ---------------------------------------------------------------------------------------------------

    @cached_property
    def _pieces(self) -> tuple[OffsetElement, ...]:
        return self._offsets(is_trimmed=True)

    def _offsets(self, *, is_trimmed: bool) -> tuple[OffsetElement, ...]:
        """The offsets of all elements, and the ways around outside corners; in inside corners trimmed, or not."""
        moved = [self._moved(element) for element in self.elements]
        found = list[OffsetElement]()
        for number, element in enumerate(self.elements):
            around: list[Segment] = []
            turn = self.joints[number].turn if number < len(self.joints) else 0.0
            # Beyond an inside corner that hardly turns, the offsets are no gouge.
            if number < len(self.joints) and (is_trimmed or turn <= 0 or self.radius * turn * turn <= 100 * GOUGE):
                moved[number], around, moved[number + 1] = self._joined(number, moved[number], moved[number + 1])
            own = moved[number]
            # An arc of the tool's radius is a point; a full circle ends where it begins.
            is_point = isinstance(own, ArcSegment) and own.radius <= LENGTH
            is_full = isinstance(own, ArcSegment) and dist(element.start, element.end) <= LENGTH
            is_there = (is_full or dist(own.start, own.end) > LENGTH) and not is_point
            found += [OffsetElement(own, number)] if is_there else []
            found += [
                OffsetElement(each, number, is_own=False) for each in around if dist(each.start, each.end) > LENGTH
            ]
        return tuple(found)

    def _moved(self, element: Segment) -> Segment:
        """An element moved to the side: a line as it is, an arc about the same centre, beyond which one that is too
        small comes out turned around."""
        if isinstance(element, ArcSegment):
            reach = element.radius - self.side * element.turn.sign * self.radius
            base, share, ends = element.center, reach / element.radius, (element.start, element.end)
            start, end = (along(base, (at[0] - base[0], at[1] - base[1]), share) for at in ends)
            return replace(element, start=start, end=end, radius=abs(reach))
        normal = normal_of(element, self.side, at_end=False)
        start, end = (along(at, normal, self.radius) for at in (element.start, element.end))
        return replace(element, start=start, end=end)

    def _joined(self, number: int, before: Segment, after: Segment) -> tuple[Segment, list[Segment], Segment]:
        """The offsets of an element and the next one, and the way around the corner between them."""
        joint, here, there = self.joints[number], before.end, after.start
        one, other = self.elements[number], self.elements[number + 1]
        if joint.meeting is not None:
            return replace(before, end=joint.meeting.center), [], replace(after, start=joint.meeting.center)
        if joint.turn >= 0:
            return before, [], replace(after, start=here)
        if self.settings.outside is OutsideCorner.ROLL:
            turn = Turn.CW if self.side > 0 else Turn.CCW
            return before, [ArcSegment("", here, there, one.end, self.radius, turn)], after
        way, on = direction(one, at_end=True), direction(other, at_end=False)
        is_met = dot(way, on) >= cos(radians(self.settings.limit)) - REGULAR
        found = meet_outside(one, other, self.radius) if is_met else None
        places = [along(here, way, self.radius), along(there, on, -self.radius)]
        places = [found.center] if found is not None else places
        # A line goes on to where the way around begins; beside an arc, its tangent does.
        if isinstance(before, LineSegment):
            before = replace(before, end=places[0])
        if isinstance(after, LineSegment):
            after = replace(after, start=places[-1])
        places = [before.end, *places, after.start]
        return before, [LineSegment("", a, b) for a, b in pairwise(places)], after

    # What is left out --------------------------------------------------------------------------------------------

    @cached_property
    def shortcut(self) -> tuple[OffsetElement, ...] | None:
        """The path that leaves out what the tool does not reach: what is free of the offsets of all elements, from
        crossing to crossing; None where that is no way from the first to the last."""
        whole = self._offsets(is_trimmed=False)
        segments = [each.segment for each in whole]
        back = OffsetPath(self.elements, self.radius, -self.side, self.settings)._offsets(is_trimmed=False)
        bounds = [*segments, *(each.segment for each in back), *self._circles()]
        parts = list[tuple[int, Segment]]()
        for number, segment in enumerate(segments):
            near = (bounds[gap.wall] for gap in gaps_below([segment], bounds, AGREEMENT) if gap.wall != number)
            cuts = (at for other in near for at in crossings(segment, other) if is_on(segment, at) and is_on(other, at))
            parts += [(number, part) for part in split(segment, cuts)]
        places = [(whole[number], middle(part)[0]) for number, part in parts]
        middles = [replace(piece, segment=LineSegment("", at, at)) for piece, at in places]
        cut = {place for place, _ in self._cuts(middles)}
        found, here = list[OffsetElement](), self._moved(self.elements[0]).start
        for place, (number, part) in enumerate(parts):
            if place in cut or dist(here, part.start) > STRAY:
                continue
            here, own = part.end, whole[number]
            if found and found[-1].element == own.element and found[-1].is_own is own.is_own and own.is_own:
                found[-1] = replace(own, segment=replace(part, start=found[-1].segment.start))
            else:
                found.append(replace(own, segment=part))
        is_whole = bool(found) and dist(here, segments[-1].end) <= STRAY
        return None if not is_whole or any(self._cuts(found)) or any(self._unverified(found)) else tuple(found)

    def _circles(self) -> Iterator[ArcSegment]:
        """The places from which the tool touches an end of the contour."""
        for center in (self.elements[0].start, self.elements[-1].end):
            begin = along(center, (1.0, 0.0), self.radius)
            yield ArcSegment("", begin, begin, center, self.radius, Turn.CCW)

    def rests(self, pieces: Sequence[OffsetElement]) -> Iterator[UncutRest]:
        """The rests in the inside corners of a path, and beside what it leaves out."""
        for one, two in pairwise(pieces):
            center, first, last = one.segment.end, one.element, two.element + (not two.is_own)
            between = range(first + 1, last)
            # An element that has just no length left is touched.
            touched = [each for each in between if self._is_touched(each, center)]
            for before, behind in pairwise([first, *touched, last]):
                is_round = behind - before == 1 and self.joints[before].turn <= 0
                if before < behind and not is_round and min(self.levels[before : behind + 1]) > 0:
                    yield self._rest(center, before, behind)

    def _is_touched(self, number: int, center: Point) -> bool:
        return dist(center, foot_on(self.elements[number], center)) <= self.radius + STRAY

    def _rest(self, center: Point, first: int, last: int) -> UncutRest:
        before, *left, behind = self.elements[first : last + 1]
        depths = [dist(center, each.end) for each in ([before], left[:-1])[bool(left)]]
        depths += [
            max(dist(center, at) for at in [*square_to(each, center)] or (each.start, each.end)) for each in left
        ]
        parts = replace(before, start=foot_on(before, center)), replace(behind, end=foot_on(behind, center))
        back, on = (each.length if dist(each.start, each.end) > LENGTH else 0.0 for each in parts)
        return UncutRest(center, first, last, max(depths) - self.radius, (back, on))

    # Our own check ----------------------------------------------------------------------------------------------

    def _unverified(self, pieces: Sequence[OffsetElement]) -> Iterator[ToolFault]:
        """The elements along which the centre is not at the radius, by the equation of a circle that touches them."""
        for piece in pieces:
            ends = (piece.segment.start, piece.segment.end) if piece.is_own else ()
            off = max((abs(self._touching(self.elements[piece.element], at)) for at in ends), default=0.0)
            if not off <= 2 * STRAY:
                yield ToolFault(ToolFaultKind.NOT_VERIFIED, piece.element, off)

    def _touching(self, element: Segment, at: Point) -> float:
        """By how much (mm) a circle of the radius about a place does not touch an element on the tool's side."""
        scalars = {"P.0": at[0] - element.start[0], "P.1": at[1] - element.start[1], "R": self.radius}
        nose, side = Circle("nose", "P", "R"), self.side
        if isinstance(element, ArcSegment):
            scalars |= {f"C.{axis}": element.center[axis] - element.start[axis] for axis in (FIRST, SECOND)}
            scalars["r"], side = element.radius, -side * element.turn.sign
            fact = make_tangent(Circle("C", "C", "r"), nose, side)
        else:
            scalars["L.off"], (scalars["L.cos"], scalars["L.sin"]) = 0.0, direction(element, at_end=False)
            fact = make_tangent(Line("L", "A", "B"), nose, side)
        return float(fact.residual(Values(scalars, {}, {})))

    def _cuts(self, pieces: Sequence[OffsetElement]) -> Iterator[tuple[int, Gouge]]:
        """The cuts into walls of the pass of each piece, with the number of the piece."""
        for level in sorted({each for each in self.levels if each > 0}):
            walls = [number for number in self.walls if self.levels[number] == level]
            places = [place for place, piece in enumerate(pieces) if abs(self.levels[piece.element]) == level]
            paths, parts = [pieces[place].segment for place in places], [self.walls[number] for number in walls]
            for gap in gaps_below(paths, parts, self.radius - GOUGE):
                place, depth = places[gap.piece], self.radius - gap.distance
                yield place, Gouge(depth, walls[gap.wall], pieces[place].element, gap.at)

    def _interferences(self) -> Iterator[ToolFault]:
        """Walls into which the tool cuts beside another element: of each place, the deepest."""
        told = list[Gouge]()
        gouges = (gouge for _, gouge in self._cuts(self._pieces))
        for each in sorted(gouges, key=lambda gouge: (-round(gouge.depth, 6), -gouge.wall)):
            if any(each.is_like(other, self.radius) for other in told):
                continue
            told.append(each)
            length = self.elements[each.wall].length
            yield ToolFault(ToolFaultKind.INTERFERENCE, each.wall, each.depth, None, length, each.working, each.at)


def largest_radius(stops: Callable[[float], Sequence[ToolFault]], most: float) -> tuple[float, float]:
    """The largest radius (mm) that nothing stops, below one that something does; and one beyond that is stopped.

    A smaller tool is taken to fit wherever a larger one does, which holds along the same walls (see `fitting_radii`).
    """
    largest = largest_fitting(lambda size: -1.0 if stops(size + _SLACK) else 1.0, most)
    # Two corners take the slack twice: the decimal that they miss by it fits.
    decimal = round(largest, 6)
    largest = decimal if 0 < decimal - largest <= _ASIDE[0] and not stops(decimal) else largest
    beyond = next((size for size in (largest + each for each in _ASIDE) if stops(size)), most)
    gap = any(each.kind is ToolFaultKind.INTERFERENCE for each in stops(beyond)[:1])
    return max(largest - GOUGE * gap, 0.0), beyond


class FittingRadii(Struct, frozen=True):
    """Radii (mm) that fit, from one to another; and one beyond the other that is stopped, None where none is known."""

    low: float
    high: float
    beyond: float | None


def fitting_radii(
    stops: Callable[[float], Sequence[ToolFault]], crossing: RunsCrossing | None, most: float
) -> list[FittingRadii]:
    """All radii up to `most` that nothing stops, 0 alone where none fits.

    Where a tool reaches from the run-in to the run-off, less of them is wall, so that a larger tool may fit where a
    smaller one does not.
    """
    least = crossing.least if crossing is not None else 0.0
    parts = [(0.0, least * (1 - _BELOW)), (least, most)] if 0 < least < most else [(0.0, most)]
    found = list[FittingRadii]()
    for low, high in parts:
        if low and stops(low):
            continue
        end, beyond = high, None
        if stops(high):
            # What is smaller belongs to the part before.
            end, beyond = largest_radius(partial(_not_below, stops, low), high)
        if found and found[-1].beyond is None:
            found[-1] = FittingRadii(found[-1].low, end, beyond)
        else:
            found.append(FittingRadii(low, max(low, end), beyond))
    return found


def _not_below(stops: Callable[[float], Sequence[ToolFault]], low: float, size: float) -> Sequence[ToolFault]:
    return stops(max(size, low))


_BELOW = 1e-9
"""The share by which a radius is smaller that does not reach what a radius does."""

_GROOVE = 4
"""Elements from one wall of a groove to the other, with its floor and two roundings."""


def without_short(pieces: Sequence[OffsetElement]) -> Iterator[OffsetElement]:
    """A path without pieces shorter than the increment: the line behind begins where they do."""
    here = None
    for number, each in enumerate(pieces):
        part = each.segment if here is None else replace(each.segment, start=here)
        is_next_line = number + 1 < len(pieces) and isinstance(pieces[number + 1].segment, LineSegment)
        here = part.start if is_next_line and each.segment.length < INCREMENT else None
        if here is None:
            yield replace(each, segment=part)


def tip_faults(elements: Sequence[Segment], side: int, radius: float, tip: Point) -> Iterator[ToolFault]:
    """The elements from whose surface the tip of a tool points away, each with how deep the nose would lie."""
    for number, element in enumerate(elements):
        normals = [normal_of(element, side, at_end=at_end) for at_end in (False, True)]
        # An arc over the top of a ball begins towards the tip; the flanks decide how far it may go.
        toward = min(float(dot(tip, normal)) for normal in normals)
        # Between the walls of a groove, the tip is the corner at which the tool is set.
        near = elements[max(number - _GROOVE, 0) : number + _GROOVE + 1]
        if toward > _CLEAR and not any(are_walls(element, other, side, 0.0) for other in near):
            yield ToolFault(ToolFaultKind.TIP_AGAINST_SIDE, number, radius * (1 + toward))


def are_walls(one: Segment, other: Segment, side: int, least: float = 1 - LENGTH) -> bool:
    """Whether two lines are the walls of a groove, each before the other; parallel, or so far (`least`, a cosine)."""
    if isinstance(one, ArcSegment) or isinstance(other, ArcSegment):
        return False
    (a, b), (c, d) = normal_of(one, side, at_end=True), normal_of(other, side, at_end=True)
    first, second = (
        end + start - far - near
        for end, start, far, near in zip(other.end, other.start, one.end, one.start, strict=True)
    )
    return a * c + b * d < -least and a * first + b * second > LENGTH


def flank_faults(elements: Sequence[Segment], side: int, tool: Tool) -> Iterator[ToolFault]:
    """The elements into which the flank behind or before a tip 1 to 4 cuts: the nose would touch them farther around
    than where its straight edge begins."""
    (first, second), stated = tool.vector(), (tool.back, tool.front)
    for number, element in enumerate(elements if first and second else ()):
        normals = [normal_of(element, side, at_end=at_end) for at_end in (False, True)]
        around = [(-first * one, -second * two) for one, two in normals]
        needs = (
            [degrees(max(atan2(-one, two), -pi / 2)) for one, two in around],
            [degrees(max(atan2(-two, one), -pi / 2)) for one, two in around],
        )
        for kind, needed, has in zip(_FLANKS, map(max, needs), stated, strict=True):
            if has is not None and needed > has + _FLANK:
                yield ToolFault(kind, number, rest=(needed, has))


def uncompensated(elements: Sequence[Segment], side: int, radius: float, tip: Point) -> Iterator[ToolFault]:
    """The excess (mm; below 0: too deep) of elements along which the tip runs without compensation, square to the
    surface; of an arc, where it is most. A centre has it the same on all of them."""
    for number, element in enumerate(elements):
        normals = [normal_of(element, side, at_end=at_end) for at_end in (False, True)]
        for sign in (1, -1) if any(tip) and isinstance(element, ArcSegment) else ():
            normal = sign * tip[0] / hypot(*tip), sign * tip[1] / hypot(*tip)
            if isinstance(element, ArcSegment) and is_on(
                element, along(element.center, normal, -side * element.turn.sign)
            ):
                normals.append(normal)
        off = max((-radius * (1 + float(dot(tip, normal))) for normal in normals), key=abs)
        if abs(off) >= NOTICED and (any(tip) or not number):
            yield ToolFault(ToolFaultKind.UNCOMPENSATED, number, off)


def stub(elements: Sequence[Segment], side: int, radius: float, tip: Point) -> Iterator[ToolFault]:
    """The stub (its diameter) that stands on the axis of a lathe where the tip does not go far enough past it."""
    found = list[tuple[float, int]]()
    for number, element in enumerate(elements):
        for at_end, at in enumerate((element.start, element.end)):
            onward, away = normal_of(element, side, at_end=bool(at_end))
            if at[1] <= LENGTH and abs(onward) > _CLEAR and tip[1] < 0:
                found.append((2 * (at[1] - radius * (tip[1] + away)), number))
    size, number = min(found, default=(0.0, 0))
    if size >= NOTICED:
        yield ToolFault(ToolFaultKind.STUB, number, size)


def told_of_path(made: OffsetPath) -> Iterator[ToolFault]:
    """The rest that a tool leaves in the inside corners of a contour that it cuts, and of what it leaves out; and arcs
    along which its edge is much faster than its centre."""
    noticed = GOUGE if made.settings.refuses_corner else NOTICED
    for each in made.rests(made.pieces or ()):
        if each.last - each.first > 1 and each.depth > GOUGE:
            yield ToolFault(ToolFaultKind.LEFT_OUT, each.first + 1, each.depth, working=each.last - 1, rest=each.lost)
        elif each.last - each.first == 1 and each.depth >= noticed:
            yield ToolFault(ToolFaultKind.INSIDE_CORNER, each.first, each.depth, rest=each.lost)
    ratios = [
        (own.radius / way.radius, -piece.element)
        for piece in made.pieces or ()
        if isinstance(own := made.elements[piece.element], ArcSegment)
        and isinstance(way := piece.segment, ArcSegment)
        and piece.is_own
        and made.levels[piece.element] > 0
    ]
    ratio, number = max(ratios, default=(0.0, 0))
    if ratio > _FASTER:
        yield ToolFault(ToolFaultKind.FASTER_EDGE, -number, rest=(ratio, 0.0))


def normal_of(element: Segment, side: int, *, at_end: bool) -> Point:
    """The unit normal from the surface to the tool at an end of an element."""
    first, second = direction(element, at_end=at_end)
    return -second * side, first * side
