"""The path of a tool's centre beside a contour, and what of the contour it cannot cut."""

from collections.abc import Iterator, Sequence
from enum import Enum
from itertools import pairwise
from math import dist, nan

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import TangentArc, TangentLine, Turn, Values, dot
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, largest_fitting
from contoursolve.tolerance import LENGTH, REGULAR
from contoursolve.tool_radius.clearance import ahead, gaps_below
from contoursolve.tool_radius.joint import STRAY, Joint, direction, join, meet_outside
from contoursolve.tool_radius.tool import Outside

GOUGE = 1e-6
"""mm. Nearer than the radius by less than this is no gouge: a thousandth of the controls' least increment."""

_CLEAR = 1e-3
"""d.N. By more than this the tip points away from the surface (assumed)."""


class FaultKind(Enum):
    """What a tool cannot do on a contour."""

    ARC_TOO_SMALL = "arc_too_small"
    """An inside arc has a smaller radius than the tool."""
    ELEMENT_VANISHES = "element_vanishes"
    """The tool needs more of an element for the corners at its ends than there is."""
    NO_INTERSECTION = "no_intersection"
    """The offsets of two elements do not meet in the inside corner between them."""
    INTERFERENCE = "interference"
    """Beside one element, the tool cuts into another one."""
    NOT_VERIFIED = "not_verified"
    """A path that does not pass our own check."""
    ENTRY_BY_ARC = "entry_by_arc"
    EXIT_BY_ARC = "exit_by_arc"
    ENTRY_TOO_SHORT = "entry_too_short"
    TIP_AGAINST_SIDE = "tip_against_side"
    """The tip points away from the surface."""


class Fault(Struct, frozen=True):
    """A fault at an element (its number, from 0): by how much it misses (mm), the largest radius that fits (mm), the
    element on which the tool works, and where, mm."""

    kind: FaultKind
    element: int
    short: float | None = None
    largest: float | None = None
    length: float = 0.0
    """Of the element, mm."""
    working: int | None = None
    at: Point | None = None


class Piece(Struct, frozen=True):
    """A line or an arc of the centre's path, and the number of the element with whose block it is written; its `own`
    offset, or a part of the way around the corner behind it."""

    segment: Segment
    element: int
    is_own: bool = True


class Offset(Struct, frozen=True):
    """The path of a tool's centre beside elements, None where it does not fit, its faults, and the joints."""

    pieces: tuple[Piece, ...] | None
    faults: tuple[Fault, ...]
    joints: tuple[Joint, ...]


def offset(
    elements: Sequence[Segment],
    radius: float,
    side: int,
    outside: Outside = Outside.ROLL,
    is_wall: Sequence[bool] | None = None,
) -> Offset:
    """The path of the centre of a tool of a radius (mm) to the left (`side` +1) or right (-1) of elements, square to
    the first and the last one at its ends; those that are no wall are rapids, into which nothing cuts."""
    joints = [join(one, two, radius, side) for one, two in pairwise(elements)]
    faults = list(_local_faults(elements, joints, radius, side))
    if faults:
        return Offset(None, tuple(faults), tuple(joints))
    pieces = tuple(_pieces(elements, joints, radius, side, outside))
    faults += _check(elements, pieces, radius, side)
    if not faults:
        faults += _interferences(elements, pieces, radius, side, outside, is_wall)
    return Offset(None if faults else pieces, tuple(faults), tuple(joints))


def tip_faults(elements: Sequence[Segment], side: int, radius: float, tip: Point) -> Iterator[Fault]:
    """The elements from whose surface the tip of a tool points away, each with how deep the nose would lie."""
    for number, element in enumerate(elements):
        normals = [normal_of(element, side, at_end=at_end) for at_end in (False, True)]
        # An arc over the top of a ball begins towards the tip; the flanks decide how far it may go.
        along = min(tip[0] * normal[0] + tip[1] * normal[1] for normal in normals)
        if along > _CLEAR:
            yield Fault(FaultKind.TIP_AGAINST_SIDE, number, radius * (1 + along))


def normal_of(element: Segment, side: int, *, at_end: bool) -> Point:
    """The unit normal from the surface to the tool at an end of an element."""
    first, second = direction(element, at_end=at_end)
    return -second * side, first * side


# What fits ------------------------------------------------------------------------------------------------------


def _local_faults(elements: Sequence[Segment], joints: Sequence[Joint], radius: float, side: int) -> Iterator[Fault]:
    """The faults that each element has with its neighbours."""
    small = set[int]()
    for number, element in enumerate(elements):
        if isinstance(element, ArcSegment) and element.turn.sign == side and radius - element.radius > LENGTH:
            yield Fault(FaultKind.ARC_TOO_SMALL, number, radius - element.radius, element.radius, element.length)
            small |= {number - 1, number, number + 1}
    for number, joint in enumerate(joints):
        if joint.is_inside and joint.meeting is None and number not in small:
            one, two = elements[number], elements[number + 1]

            def meets(size: float, one: Segment = one, two: Segment = two) -> float:
                return -1.0 if join(one, two, size, side).meeting is None else 1.0

            largest = largest_fitting(meets, radius)
            yield Fault(FaultKind.NO_INTERSECTION, number, radius - largest, largest, one.length, at=one.end)
            small |= {number, number + 1}
    for number, element in enumerate(elements):
        room = _room(elements, number, joints)
        if room < -LENGTH and number not in small:
            near = elements[max(0, number - 1) : number + 2]
            place = min(number, 1)

            def left(size: float, near: Sequence[Segment] = near, place: int = place) -> float:
                several = [join(one, two, size, side) for one, two in pairwise(near)]
                is_lost = any(each.is_inside and each.meeting is None for each in several)
                return nan if is_lost else _room(near, place, several)

            largest = largest_fitting(left, radius)
            yield Fault(FaultKind.ELEMENT_VANISHES, number, -room, largest, element.length)


def _room(elements: Sequence[Segment], number: int, joints: Sequence[Joint]) -> float:
    """What the corners at both ends leave of an element, mm."""
    room = elements[number].length
    if number and (before := joints[number - 1].meeting) is not None:
        room -= before.ahead
    if number < len(joints) and (behind := joints[number].meeting) is not None:
        room -= behind.back
    return room


# The path -------------------------------------------------------------------------------------------------------


def _moved(element: Segment, radius: float, side: int) -> Segment:
    """An element moved to the side: a line as it is, an arc about the same centre."""
    if isinstance(element, ArcSegment):
        reach = max(element.radius - side * element.turn.sign * radius, 0.0)
        start, end = (
            (
                element.center[0] + (at[0] - element.center[0]) * reach / element.radius,
                element.center[1] + (at[1] - element.center[1]) * reach / element.radius,
            )
            for at in (element.start, element.end)
        )
        return replace(element, start=start, end=end, radius=reach)
    normal = normal_of(element, side, at_end=False)
    start, end = (ahead(at, normal, radius) for at in (element.start, element.end))
    return replace(element, start=start, end=end)


def _pieces(
    elements: Sequence[Segment], joints: Sequence[Joint], radius: float, side: int, outside: Outside
) -> Iterator[Piece]:
    moved = [_moved(element, radius, side) for element in elements]
    for number, joint in enumerate(joints):
        if joint.meeting is not None:
            moved[number] = replace(moved[number], end=joint.meeting.center)
            moved[number + 1] = replace(moved[number + 1], start=joint.meeting.center)
        elif joint.turn >= 0:
            moved[number + 1] = replace(moved[number + 1], start=moved[number].end)
    for number, element in enumerate(elements):
        around: list[Segment] = []
        if number < len(joints) and joints[number].turn < 0:
            ends, around = _around(element, elements[number + 1], moved[number : number + 2], radius, side, outside)
            moved[number : number + 2] = ends
        own = moved[number]
        is_full = isinstance(own, ArcSegment) and own.radius > LENGTH and dist(element.start, element.end) <= LENGTH
        if is_full or dist(own.start, own.end) > LENGTH:
            yield Piece(own, number)
        yield from (Piece(each, number, is_own=False) for each in around if dist(each.start, each.end) > LENGTH)


def _around(
    one: Segment, other: Segment, moved: Sequence[Segment], radius: float, side: int, outside: Outside
) -> tuple[tuple[Segment, Segment], list[Segment]]:
    """The offsets of two elements at an outside corner, and the way around it between them."""
    before, after = moved
    here, there = before.end, after.start
    if outside is Outside.ROLL:
        return (before, after), [ArcSegment("", here, there, one.end, radius, Turn.CW if side > 0 else Turn.CCW)]
    way, on = direction(one, at_end=True), direction(other, at_end=False)
    found = meet_outside(one, other, radius) if dot(way, on) >= -REGULAR else None
    places = [found.center] if found is not None else [ahead(here, way, radius), ahead(there, on, -radius)]
    # A line goes on to where the way around begins; beside an arc, its tangent does.
    if isinstance(before, LineSegment):
        before = replace(before, end=places[0])
    else:
        places.insert(0, here)
    if isinstance(after, LineSegment):
        after = replace(after, start=places[-1])
    else:
        places.append(there)
    return (before, after), [LineSegment("", a, b) for a, b in pairwise(places)]


# Our own check --------------------------------------------------------------------------------------------------


def _check(elements: Sequence[Segment], pieces: Sequence[Piece], radius: float, side: int) -> Iterator[Fault]:
    """The elements along which the centre is not at the radius, by the equation of a circle that touches them."""
    for piece in pieces:
        if piece.is_own:
            ends = piece.segment.start, piece.segment.end
            off = max(abs(_touching(elements[piece.element], at, radius, side)) for at in ends)
            if not off <= 2 * STRAY:
                yield Fault(FaultKind.NOT_VERIFIED, piece.element, off)


def _touching(element: Segment, at: Point, radius: float, side: int) -> float:
    """By how much (mm) a circle of the radius about a place does not touch an element on that side."""
    scalars = {"P.0": at[0] - element.start[0], "P.1": at[1] - element.start[1], "R": radius}
    if isinstance(element, ArcSegment):
        scalars |= {"C.0": element.center[0] - element.start[0], "C.1": element.center[1] - element.start[1]}
        fact = TangentArc(("C", "r"), element.turn, "P", "R", side)
        return float(fact.residual(Values({**scalars, "r": element.radius}, {}, {})))
    first, second = direction(element, at_end=False)
    scalars |= {"L.cos": first, "L.sin": second, "L.off": 0.0}
    return float(TangentLine("L", "P", "R", side).residual(Values(scalars, {}, {})))


def _interferences(
    elements: Sequence[Segment],
    pieces: Sequence[Piece],
    radius: float,
    side: int,
    outside: Outside,
    is_wall: Sequence[bool] | None,
) -> Iterator[Fault]:
    """Walls into which the tool cuts beside another element: of each place, the deepest."""
    walls = [number for number in range(len(elements)) if is_wall is None or is_wall[number]]

    def found(path: Sequence[Piece], size: float) -> list[tuple[float, int, int, Point]]:
        paths, parts = [piece.segment for piece in path], [elements[number] for number in walls]
        gaps = gaps_below(paths, parts, size - GOUGE)
        return [(size - gap.distance, walls[gap.wall], path[gap.piece].element, gap.at) for gap in gaps]

    def left(size: float) -> float:
        joints = [join(one, two, size, side) for one, two in pairwise(elements)]
        if any(_local_faults(elements, joints, size, side)):
            return nan
        path = tuple(_pieces(elements, joints, size, side, outside))
        return -max((depth for depth, *_ in found(path, size)), default=-GOUGE)

    told: list[tuple[Point, int, int]] = []
    largest = 0.0
    for depth, wall, working, at in sorted(found(pieces, radius), key=lambda each: (-round(each[0], 6), -each[1])):
        # What is seen from the other side, too, or at the end of the same wall, is one fault.
        if any(
            dist(at, place) <= 2 * radius or wall == known or (abs(wall - other) <= 1 and abs(working - known) <= 1)
            for place, known, other in told
        ):
            continue
        largest = largest if told else largest_fitting(left, radius)
        told.append((at, wall, working))
        yield Fault(FaultKind.INTERFERENCE, wall, depth, largest, elements[wall].length, working, at)
