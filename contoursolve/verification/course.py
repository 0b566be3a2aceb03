"""A path from its virtual intersections: elements on lines and circles, and the corners between them.

Points count from the start point, in mm; real is the plane's first axis, imaginary its second.
"""

from cmath import rect
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from math import asin

from contoursolve.model import Turn
from contoursolve.tolerance import LENGTH, REGULAR
from contoursolve.verification.measure import cross, dot, sign, unit
from contoursolve.verification.rails import (
    Rail,
    Ray,
    Ring,
    UnmakeableError,
    beside,
    heading,
    meet,
    side_of,
    travel,
)


class Shape(Enum):
    """What a corner is made of."""

    ROUNDING = "rounding"
    SETBACK = "chamfer"
    """A segment whose ends are equally far from the virtual intersection."""
    BEVEL = "45 degree bevel"
    """A segment with the same extent along both axes."""


@dataclass(frozen=True, slots=True)
class Bend:
    """A corner: its size in mm, and the words that state it."""

    name: str
    shape: Shape
    size: float
    words: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Course:
    """Elements by name, each on its rail from one joint to the next, and the corners by the number of the element
    before them. `landing` is what a last corner goes on to; the path ends there.

    `unsure` (mm) is what rounding does to each joint. `touching` are the joints where rails may just touch: None
    where rounding hides it. `moot` are the words that choose nothing, `gaps` (mm) by how much the words of an
    element disagree on its radius.
    """

    names: tuple[str, ...]
    rails: tuple[Rail, ...]
    joints: tuple[complex, ...]
    bends: Mapping[int, Bend]
    landing: tuple[Rail, complex] | None = None
    unsure: tuple[float, ...] = ()
    touching: Mapping[int, bool | None] = field(default_factory=dict)
    moot: frozenset[str] = frozenset()
    gaps: Mapping[int, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Piece:
    """An element of a path as it is cut: `arc` holds its centre, radius (mm) and turn."""

    name: str
    begin: complex
    end: complex
    arc: tuple[complex, float, Turn] | None
    words: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Trace:
    """The elements of a path; `room` (mm) is what is left of each after its corners, `condition` (1) by how much an
    error of the joints becomes larger in the corners."""

    pieces: tuple[Piece, ...]
    room: Mapping[str, float]
    condition: float


def length(rail: Rail, begin: complex, end: complex) -> float:
    """How long an element is, mm: a line against its direction is negative, an arc is less than a full turn."""
    way = travel(rail, begin, end)
    if isinstance(rail, Ring) and way < 0:
        way += rail.radius * _TURN
    return way


_TURN = 6.283185307179586


def trace(course: Course) -> Trace:
    """The elements of a course with its corners. Raises UnmakeableError for what cannot be made."""
    begins, ends = list(course.joints[:-1]), list(course.joints[1:])
    room = {}
    for name, rail, begin, end in zip(course.names, course.rails, begins, ends, strict=True):
        if isinstance(rail, Ring) and abs(end - begin) <= LENGTH:
            raise UnmakeableError(f"{name} ends where it begins")
        room[name] = length(rail, begin, end)
    full, made, condition = dict(room), dict[int, Piece](), 1.0
    for number, bend in sorted(course.bends.items()):
        at, before, name = course.joints[number + 1], course.rails[number], course.names[number]
        is_last = number + 1 == len(course.names)
        if is_last and course.landing is None:
            raise UnmakeableError(f"{bend.name} has no line to land on")
        after = course.landing[0] if is_last and course.landing else course.rails[number + 1]
        beyond = None if is_last else course.names[number + 1]
        if full[name] <= LENGTH or (beyond and full[beyond] <= LENGTH):
            raise UnmakeableError(f"{bend.name} joins an element of no length")
        turn = cross(heading(before, at), heading(after, at))
        if abs(turn) <= REGULAR:
            raise UnmakeableError(f"{bend.name} joins two elements of the same direction, or of opposite ones")
        before = _through(before, at)
        piece = make(bend, at, before, after)
        back, ahead = travel(before, piece.begin, at), travel(after, at, piece.end)
        if not (back >= -LENGTH and ahead >= -LENGTH):
            raise UnmakeableError(f"{bend.name} cannot be made")
        room[name] -= back
        if beyond:
            room[beyond] -= ahead
            begins[number + 1] = piece.end
        ends[number], made[number] = piece.begin, piece
        condition = max(condition, 4 / abs(turn), *(1 + far / full[at] for far, at in ((back, name),)))
        condition = max(condition, _condition(piece, before, after))
    pieces = []
    for number, (name, rail) in enumerate(zip(course.names, course.rails, strict=True)):
        arc = (rail.center, rail.radius, rail.turn) if isinstance(rail, Ring) else None
        pieces.append(Piece(name, begins[number], ends[number], arc))
        pieces += [made[number]] if number in made else []
    return Trace(tuple(pieces), room, condition)


def _through(rail: Rail, at: complex) -> Rail:
    """An arc's circle through the end that its words give it, which may be off it by what the control allows."""
    if isinstance(rail, Ray) or abs(abs(at - rail.center) - rail.radius) <= LENGTH:
        return rail
    return Ring(rail.center, abs(at - rail.center), rail.turn)


def _condition(piece: Piece, before: Rail, after: Rail) -> float:
    """By how much an error of two rails becomes larger at the ends of the corner between them."""
    if piece.arc is None:
        return 1.0
    turn = abs(cross(heading(before, piece.begin), heading(after, piece.end)))
    return 4 / max(turn, REGULAR)


def make(bend: Bend, at: complex, before: Rail, after: Rail) -> Piece:
    """The corner itself. Raises UnmakeableError if there is none of this size."""
    if bend.shape is Shape.ROUNDING:
        side = 1 if cross(heading(before, at), heading(after, at)) > 0 else -1
        try:
            moved = beside(before, side * bend.size), beside(after, side * bend.size)
            meeting = meet(*moved, 0.0)
        except UnmakeableError as error:
            raise UnmakeableError(f"{bend.name} does not fit: {error}") from None
        center = meeting.places[side_of(before, after, at)]
        arc = center, bend.size, Turn.CCW if side > 0 else Turn.CW
        return Piece(bend.name, _contact(before, center), _contact(after, center), arc, bend.words)
    if bend.shape is Shape.SETBACK:
        ends = _step(before, at, -bend.size, bend.name), _step(after, at, bend.size, bend.name)
        return Piece(bend.name, *ends, None, bend.words)
    begin, end = _bevel(bend, at, before, after)
    return Piece(bend.name, begin, end, None, bend.words)


def _contact(rail: Rail, center: complex) -> complex:
    """The point of a rail that is closest to a place."""
    if isinstance(rail, Ray):
        return rail.at + dot(rail.along, center - rail.at) * rail.along
    return rail.center + rail.radius * unit(center - rail.center)


def _step(rail: Rail, at: complex, by: float, name: str) -> complex:
    """The point of a rail at a distance from another one, ahead of it or behind it."""
    if isinstance(rail, Ray):
        return at + by * rail.along
    share = by / (2 * rail.radius)
    if abs(share) > 1:
        raise UnmakeableError(f"{name} does not fit on its circle")
    return rail.center + (at - rail.center) * rect(1.0, 2 * asin(share) * rail.turn.sign)


def _bevel(bend: Bend, at: complex, before: Rail, after: Rail) -> tuple[complex, complex]:
    """The ends of a segment of 45 degrees that goes on as the element before it does, or else the one after."""
    arriving, leaving = heading(before, at), heading(after, at)
    way = complex(
        sign(arriving.real, REGULAR) or sign(leaving.real), sign(arriving.imag, REGULAR) or sign(leaving.imag)
    )
    extent = bend.size * way
    if isinstance(before, Ray) and isinstance(after, Ray):
        turn = cross(arriving, leaving)
        return at - cross(extent, leaving) / turn * arriving, at + cross(arriving, extent) / turn * leaving
    # One end on the line, the other on the circle: on the line where it meets the circle moved by the extent.
    ray, ring, shift = (before, after, -extent) if isinstance(before, Ray) else (after, before, extent)
    if not isinstance(ray, Ray) or not isinstance(ring, Ring):
        raise UnmakeableError(f"{bend.name} would join two arcs by 45 degrees")
    moved = Ring(ring.center + shift, ring.radius, ring.turn)
    try:
        place = meet(ray, moved, 0.0).places[side_of(ray, ring, at)]
    except UnmakeableError as error:
        raise UnmakeableError(f"{bend.name} does not fit: {error}") from None
    return (place, place + extent) if ray is before else (place - extent, place)
