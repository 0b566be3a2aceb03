"""The path between points: every element and corner drawn anew, what speaks against it, and which side a point is on.

Points are complex numbers in mm from the start point: real is the plane's first axis, imaginary its second.
"""

from cmath import rect
from collections.abc import Mapping
from itertools import pairwise
from math import asin, atan2, copysign, inf, tau

from msgspec import Struct

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Choice,
    Coordinate,
    Corner,
    CornerShape,
    Line,
    Offset,
    OnCircle,
    Side,
    line_scalars,
    scalar,
)
from contoursolve.tolerance import LARGEST, LENGTH, REGULAR
from contoursolve.verification.residuals import ResidualSystem

Values = Mapping[str, float]


class Circle(Struct, frozen=True):
    """The circle of an arc; `turn` is +1 for counter-clockwise, -1 for clockwise."""

    center: complex
    radius: float
    turn: int


class Move(Struct, frozen=True):
    """An element of a path; `circle` is None for a line."""

    name: str
    start: complex
    end: complex
    circle: Circle | None = None


class Path(Struct, frozen=True):
    """The moves of a path without those of no length, and what speaks against it."""

    moves: tuple[Move, ...]
    against: tuple[str, ...]


class _Edge(Struct, frozen=True):
    """How an element passes a point: there, in this direction, and along this circle, if it is an arc."""

    at: complex
    along: complex
    circle: Circle | None = None

    def off(self, at: complex) -> float:
        """How far a point is to the left of the line, or within the circle where that turns left, mm."""
        if self.circle is None:
            return _cross(self.along, at - self.at)
        return self.circle.turn * (self.circle.radius - abs(at - self.circle.center))

    def normal(self, at: complex) -> complex:
        """The direction in which `off` grows."""
        return 1j * self.along if self.circle is None else self.circle.turn * _unit(self.circle.center - at)

    def ahead(self, at: complex) -> float:
        """How far a point of it is ahead, mm; on a circle by the shorter way."""
        if self.circle is None:
            return _dot(self.along, at - self.at)
        return self.circle.radius * self.circle.turn * _angle(self.at - self.circle.center, at - self.circle.center)

    def beside(self, at: complex) -> complex:
        """The point of it that is nearest."""
        return at - self.off(at) * self.normal(at)

    def away(self, distance: float, way: int) -> complex | None:
        """The point of it at a distance, ahead or behind; None where a circle is too small for that."""
        if self.circle is None:
            return self.at + way * distance * self.along
        if distance > 2 * self.circle.radius:
            return None
        angle = way * self.circle.turn * 2 * asin(distance / (2 * self.circle.radius))
        return self.circle.center + (self.at - self.circle.center) * rect(1, angle)


class Drawing:
    """The path of a figure at values of all its scalars."""

    def __init__(self, system: ResidualSystem, values: Values) -> None:
        self.system, self.values, self.figure = system, values, system.figure
        self.room: dict[str, float] = {}
        self.against: list[str] = []

    def draw(self, increments: tuple[float, float]) -> Path:
        """The moves; `increments` are those of coordinates, mm."""
        here, moves = self.point(self.figure.start), list[Move]()
        away = max((max(abs(at.real), abs(at.imag)) for at in map(self.point, self.figure.points)), default=0.0)
        self.against += [f"a point is {away:.6g} mm away"] if away > LARGEST else []
        self.room = {element.name: self.length(element) for element in self.figure.path}
        corners = {corner.at: corner for corner in self.figure.corners}
        for number, element in enumerate(self.figure.path):
            corner, drawn = corners.get(element.head), None
            if corner and not self.against:
                drawn = self.corner(corner, number, increments)
            end = drawn.start if drawn else self.point(element.head)
            moves.append(Move(element.name, here, end, self.circle(element) if isinstance(element, Arc) else None))
            moves += [drawn] if drawn else []
            here = drawn.end if drawn else end
        full = {
            each.name
            for each in self.figure.path
            if isinstance(each, Arc) and each.may_be_full and self.room[each.name] >= self.length(each) - LENGTH
        }
        for name, room in self.room.items():
            if room < -LENGTH and not self.against:
                self.against.append(f"the corners on {name} overlap by {-room:.6g} mm")
        return Path(
            tuple(move for move in moves if abs(move.end - move.start) > LENGTH or move.name in full),
            tuple(self.against),
        )

    def point(self, name: str) -> complex:
        return complex(self.values[scalar(name, FIRST)], self.values[scalar(name, SECOND)])

    def circle(self, arc: Arc) -> Circle:
        return Circle(self.point(arc.center), self.values[arc.radius], arc.turn.sign)

    def direction(self, line: Line) -> complex:
        if line.heading is not None:
            return complex(*self.system.directions[line.heading])
        head = line.toward or line.head
        step = self.point(head) - self.point(line.tail) if head else 0j
        return self.own_direction(line) or _unit(step) if abs(step) <= LENGTH else _unit(step)

    def own_direction(self, line: Line) -> complex | None:
        """The direction of a line that has one as an unknown."""
        cosine, sine, _ = line_scalars(line.name)
        return complex(self.values[cosine], self.values[sine]) if cosine in self.values else None

    def length(self, element: Line | Arc) -> float:
        tail, head = self.point(element.tail), self.point(element.head)
        if isinstance(element, Line):
            length = _dot(self.own_direction(element) or self.direction(element), head - tail)
            if length < -LENGTH:
                self.against.append(f"{element.name} runs {-length:.6g} mm against its direction")
            return length
        center = self.point(element.center)
        if abs(head - tail) <= LENGTH:
            if element.may_be_full:
                return abs(head - center) * tau
            self.against.append(f"{element.name} has no length")
        swept = element.turn.sign * _angle(tail - center, head - center)
        return abs(head - center) * (swept if swept > 0 else swept + tau)

    def edge(self, element: Line | Arc, at: str) -> _Edge:
        here = self.point(at)
        if isinstance(element, Line):
            return _Edge(here, self.direction(element))
        center, turn = self.point(element.center), element.turn.sign
        # A point may be off its circle by what the control allows: the corner there is cut from the arc as it ends.
        return _Edge(here, turn * 1j * _unit(here - center), Circle(center, abs(here - center), turn))

    def corner(self, corner: Corner, number: int, increments: tuple[float, float]) -> Move | None:
        """The corner, with what it takes of the elements beside it; None where there is none."""
        path = self.figure.path
        arriving, follower = self.edge(path[number], corner.at), None
        if corner.after is not None:
            follower = path[number + 1]
            leaving = self.edge(follower, corner.at)
        elif corner.lands_on is not None:
            follower = self.figure.line(corner.lands_on)
            leaving = _Edge(arriving.at, self.direction(follower))
            if follower.head and corner.lands_on.endswith(".landing"):
                self.room[follower.name] = abs(self.point(follower.head) - arriving.at)
            else:
                self.room.setdefault(follower.name, inf)
        else:
            leaving = _Edge(arriving.at, self.landing(corner, number))
        turn = _cross(arriving.along, leaving.along)
        is_ahead = _dot(arriving.along, leaving.along) > 0
        is_left_out = is_ahead and corner.guard > 0 and abs(turn) <= corner.guard
        if min(self.room[path[number].name], self.room[corner.after] if corner.after else inf) <= LENGTH:
            self.against.append(f"{corner.name} is on an element of no length")
        elif not is_left_out and not abs(turn) > max(REGULAR, corner.least * is_ahead):
            self.against.append(f"{corner.name} is between elements of one direction")
        elif corner.shape.share and self.is_outside(corner, number, increments):
            self.against.append(f"{corner.name} is outside of the rectangle that its lines span")
        if self.against or is_left_out:
            return None
        size = self.values.get(f"{corner.name}.radius", self.system.amounts.get(corner.size, 0.0))
        move = _cut(corner, arriving, leaving, size, self.quadrant(arriving, leaving, number, corner))
        if move is None:
            self.against.append(f"{corner.name} does not fit")
            return None
        taken = {
            path[number].name: -arriving.ahead(move.start),
            follower.name if follower else "": leaving.ahead(move.end),
        }
        for name, part in taken.items():
            if part < -LENGTH:
                self.against.append(f"{corner.name} ends {-part:.6g} mm beyond its elements")
            if name:
                self.room[name] -= part
        return move

    def landing(self, corner: Corner, number: int) -> complex:
        """The direction of an axis-parallel line that a last corner lands on: the way that the path advances."""
        axis = corner.lands_parallel_to
        for element in reversed(self.figure.path[max(0, number - 1) : number + 1]) if axis is not None else ():
            along = self.edge(element, element.head).along
            part = along.imag if axis else along.real
            if part:
                return (1j if axis else 1) * copysign(1, part)
        return 0j

    def quadrant(self, arriving: _Edge, leaving: _Edge, number: int, corner: Corner) -> complex:
        """The signs of a 45 degree segment."""
        path, otherwise = self.figure.path, arriving.along
        way, least = arriving.along + leaving.along, REGULAR
        if corner.after is None and corner.lands_on is None:
            earlier = path[max(0, number - 1)]
            way, least, otherwise = arriving.along, 0.0, self.edge(earlier, earlier.head).along
        elif corner.after is not None and arriving.circle is None and leaving.circle is None:
            way, least = self.point(path[number + 1].head) - self.point(path[number].tail), 0.0
        real, imag = (part if abs(part) > least else 0.0 for part in (way.real, way.imag))
        return complex(_sign(real) or _sign(otherwise.real), _sign(imag) or _sign(otherwise.imag))

    def is_outside(self, corner: Corner, number: int, increments: tuple[float, float]) -> bool:
        """Whether a corner is outside of the rectangle that the ends of its two lines span."""
        path = self.figure.path
        if corner.after is None or isinstance(path[number], Arc) or isinstance(path[number + 1], Arc):
            return False
        at, low, high = map(self.point, (corner.at, path[number].tail, path[number + 1].head))
        parts = (at.real, low.real, high.real), (at.imag, low.imag, high.imag)
        return any(
            not min(one, other) - give - LENGTH <= here <= max(one, other) + give + LENGTH
            for (here, one, other), give in zip(parts, increments, strict=True)
        )


def _cut(corner: Corner, arriving: _Edge, leaving: _Edge, size: float, quadrant: complex) -> Move | None:
    """What replaces a corner; None where it cannot be made."""
    if corner.shape is CornerShape.FILLET:
        side = _sign(_cross(arriving.along, leaving.along))
        center = _grown(arriving, leaving, size, side, 0j)
        if center is None:
            return None
        return Move(corner.name, arriving.beside(center), leaving.beside(center), Circle(center, size, side))
    if corner.shape in (CornerShape.CHAMFER_SETBACK, CornerShape.CHAMFER_FACE):
        leg = size if corner.shape is CornerShape.CHAMFER_SETBACK else _leg(arriving, leaving, size)
        ends = arriving.away(leg, -1), leaving.away(leg, 1)
        return None if None in ends else Move(corner.name, ends[0] or 0j, ends[1] or 0j)
    step = corner.shape.share * quadrant
    begin = _grown(arriving, leaving, size, 0, step)
    return None if begin is None else Move(corner.name, begin, begin + step * size)


def _leg(arriving: _Edge, leaving: _Edge, face: float) -> float:
    """How far the ends of a chamfer are from the intersection when its face first has this length: found by halving."""

    def is_short(leg: float) -> bool:
        begin, end = arriving.away(leg, -1), leaving.away(leg, 1)
        return begin is not None and end is not None and abs(end - begin) < face

    low, step = face / 2, face / 64
    while is_short(low + step) and step < LARGEST:
        low, step = low + step, step * 1.02
    for _ in range(60):
        low, step = low + (step / 2 if is_short(low + step / 2) else 0.0), step / 2
    return low


_STEPS = 16
"""In how many steps a corner grows beside an arc: its place is the one that it grows to."""


def _grown(arriving: _Edge, leaving: _Edge, size: float, inset: int, shift: complex) -> complex | None:
    """The point that is `inset` sizes to the left of the one element, and of the other where it is shifted by so many
    sizes; None if there is none."""
    count = 1 if arriving.circle is None and leaving.circle is None else _STEPS
    at, worst = arriving.at, inf
    for number in range(1, count + 1):
        part = size * number / count
        for _ in range(60):
            first, second = arriving.normal(at), leaving.normal(at + shift * part)
            turn = _cross(first, second)
            if not abs(turn) > REGULAR:
                return None
            one, two = arriving.off(at) - inset * part, leaving.off(at + shift * part) - inset * part
            step = complex(two * first.imag - one * second.imag, one * second.real - two * first.real) / turn
            at += step
            if abs(step) <= 1e-14 * (1 + abs(at)):
                break
        worst = max(abs(arriving.off(at) - inset * part), abs(leaving.off(at + shift * part) - inset * part))
        if not worst <= LENGTH * (1 + abs(at) * 1e-3):
            return None
    return at


def side_of(system: ResidualSystem, values: Values, choice: Choice) -> tuple[float, float] | None:
    """On which side of a choice its point is: the number is positive on the side that is meant, and next to zero where
    there is one place; with how much (mm) that leaves between the circle and what it meets. None where the figure does
    not tell."""
    drawing, figure, side = Drawing(system, values), system.figure, choice.side
    at, circles = drawing.point(choice.point), [fact for fact in system.facts if isinstance(fact, OnCircle)]
    pairs = [pair for pair in pairwise(figure.path) if pair[0].head == choice.point]
    arcs = next(((one, two) for one, two in pairs if isinstance(one, Arc) and isinstance(two, Arc)), None)
    # The other place is the mirror image: about a line through this point in that direction.
    if side in (Side.NEARER, Side.FARTHER, Side.SHORTER, Side.LONGER):
        lines = [each for each in (*figure.path, *figure.lines) if isinstance(each, Line)]
        line = next((each for each in lines if choice.point in (each.tail, each.head)), None)
        circle = next((each for each in circles if each.point == choice.point), None)
        if line is None or circle is None:
            return None
        through, along, radius = drawing.point(circle.center), -1j * drawing.direction(line), values[circle.radius]
        begin = drawing.point(line.head if choice.point == line.tail else line.tail) if line.head else 0j
    elif arcs:
        through, begin = drawing.point(arcs[0].center), drawing.point(arcs[0].tail)
        along = _unit(drawing.point(arcs[1].center) - through)
        radius = min(values[each.radius] for each in arcs)
    else:
        arc = next((each for each in figure.path if isinstance(each, Arc) and each.center == choice.point), None)
        on_it = [each.point for each in circles if arc and each.center == arc.center and each.point != arc.tail]
        if arc is None or not on_it:
            return None
        stated = {fact.point for fact in system.facts if isinstance(fact, Coordinate | Offset)}
        through = begin = drawing.point(arc.tail)
        along = _unit(drawing.point(min(on_it, key=lambda point: point not in stated)) - through)
        radius = values[arc.radius]
    own = beside = _cross(along, at - through)
    other = at - 2j * beside * along
    if side in (Side.SHORTER, Side.LONGER):
        own = abs(at - begin) - abs(other - begin)
    elif side in (Side.FIRST, Side.SECOND):
        here, there = (-_angle(begin - through, each - through) % tau for each in (at, other))
        own = copysign(beside, there - here)
    return own * side.sign, beside**2 / (2 * radius)


def _cross(a: complex, b: complex) -> float:
    return a.real * b.imag - a.imag * b.real


def _dot(a: complex, b: complex) -> float:
    return a.real * b.real + a.imag * b.imag


def _angle(a: complex, b: complex) -> float:
    return atan2(_cross(a, b), _dot(a, b))


def _unit(a: complex) -> complex:
    return a / abs(a) if abs(a) > 0 else 0j


def _sign(value: float) -> int:
    return (value > 0) - (value < 0)
