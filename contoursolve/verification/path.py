"""The path between points: every element and corner drawn anew, what speaks against it, and which side a point is on.

Points are complex numbers in mm from the start point: real is the plane's first axis, imaginary its second.
"""

from cmath import rect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import asin, atan2, copysign, inf, pi

from contoursolve.constraints import Coordinate, Offset, OnCircle
from contoursolve.model import FIRST, SECOND, Arc, Choice, Corner, CornerShape, Figure, Line, Side, line_scalars, scalar
from contoursolve.tolerance import LARGEST, LENGTH, REGULAR
from contoursolve.verification.residuals import Sheet

Values = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Circle:
    """The circle of an arc; `turn` is +1 for counter-clockwise, -1 for clockwise."""

    center: complex
    radius: float
    turn: int


@dataclass(frozen=True, slots=True)
class Move:
    """An element of a path; `circle` is None for a line."""

    name: str
    start: complex
    end: complex
    circle: Circle | None = None


@dataclass(frozen=True, slots=True)
class Edge:
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
        begin, end = self.at - self.circle.center, at - self.circle.center
        return self.circle.radius * self.circle.turn * atan2(_cross(begin, end), _dot(begin, end))

    def beside(self, at: complex) -> complex:
        """The point of it that is nearest."""
        return at - self.off(at) * self.normal(at)


@dataclass(frozen=True, slots=True)
class Path:
    """The moves of a path without those of no length, all lengths (mm) by name, and what speaks against it."""

    moves: tuple[Move, ...]
    against: tuple[str, ...]


def draw(sheet: Sheet, values: Values, sizes: Mapping[str, float], increments: tuple[float, float]) -> Path:
    """The path at values of all scalars; `sizes` are those of the corners by their names, `increments` those of
    coordinates, mm."""
    return _Pen(sheet, values, sizes, increments).draw()


class _Pen:
    def __init__(
        self, sheet: Sheet, values: Values, sizes: Mapping[str, float], increments: tuple[float, float]
    ) -> None:
        self.sheet, self.values, self.sizes, self.increments = sheet, values, sizes, increments
        self.figure: Figure = sheet.figure
        self.room: dict[str, float] = {}
        self.against: list[str] = []

    def draw(self) -> Path:
        start, path = self.point(self.figure.start), self.figure.path
        away = max((max(abs(at.real), abs(at.imag)) for at in map(self.point, self.figure.points)), default=0.0)
        self.against += [f"a point is {away:.6g} mm away"] if away > LARGEST else []
        for element in path:
            self.room[element.name] = self.length(element)
        moves, here = [], start
        corners = {corner.at: corner for corner in self.figure.corners}
        for number, element in enumerate(path):
            corner = corners.get(element.head)
            drawn = self.corner(corner, number) if corner and not self.against else None
            end = drawn.start if drawn else self.point(element.head)
            circle = self.circle(element) if isinstance(element, Arc) else None
            moves.append(Move(element.name, here, end, circle))
            moves += [drawn] if drawn else []
            here = drawn.end if drawn else end
        for name, room in self.room.items():
            if room < -LENGTH and not self.against:
                self.against.append(f"the corners on {name} overlap by {-room:.6g} mm")
        return Path(tuple(move for move in moves if abs(move.end - move.start) > LENGTH), tuple(self.against))

    def point(self, name: str) -> complex:
        return complex(self.values[scalar(name, FIRST)], self.values[scalar(name, SECOND)])

    def circle(self, arc: Arc) -> Circle:
        return Circle(self.point(arc.center), self.values[arc.radius], arc.turn.sign)

    def direction(self, line: Line) -> complex:
        if line.heading is not None:
            return complex(*self.sheet.directions[line.heading])
        cosine, sine, _ = line_scalars(line.name)
        head = line.toward or line.head
        step = self.point(head) - self.point(line.tail) if head else 0j
        if cosine in self.values and abs(step) <= LENGTH:
            return complex(self.values[cosine], self.values[sine])
        return _unit(step)

    def length(self, element: Line | Arc) -> float:
        tail, head = self.point(element.tail), self.point(element.head)
        if isinstance(element, Line):
            cosine, sine, _ = line_scalars(element.name)
            along = self.direction(element)
            if cosine in self.values:
                along = complex(self.values[cosine], self.values[sine])
            length = _dot(along, head - tail)
            if length < -LENGTH:
                self.against.append(f"{element.name} runs {-length:.6g} mm against its direction")
            return length
        if abs(head - tail) <= LENGTH:
            self.against.append(f"{element.name} has no length")
        center = self.point(element.center)
        swept = element.turn.sign * atan2(_cross(tail - center, head - center), _dot(tail - center, head - center))
        return abs(head - center) * (swept if swept > 0 else swept + 2 * pi)

    def edge(self, element: Line | Arc, at: str) -> Edge:
        here = self.point(at)
        if isinstance(element, Line):
            return Edge(here, self.direction(element))
        circle = self.circle(element)
        # A point may be off its circle by what the control allows: the corner there is cut from the arc as it ends.
        circle = Circle(circle.center, abs(here - circle.center), circle.turn)
        return Edge(here, circle.turn * 1j * _unit(here - circle.center), circle)

    def corner(self, corner: Corner, number: int) -> Move | None:
        """The corner, with what it takes of the elements beside it; None where it cannot be made."""
        path = self.figure.path
        arriving, follower = self.edge(path[number], corner.at), None
        if corner.after is not None:
            follower = path[number + 1]
            leaving = self.edge(follower, corner.at)
        elif corner.lands_on is not None:
            follower = self.figure.line(corner.lands_on)
            leaving = Edge(arriving.at, self.direction(follower))
            if follower.head and corner.lands_on.endswith(".landing"):
                self.room[follower.name] = abs(self.point(follower.head) - arriving.at)
            elif follower.name not in self.room:
                self.room[follower.name] = inf
        else:
            leaving = Edge(arriving.at, self.landing(corner, number))
        quadrant, size = self.quadrant(arriving, leaving, number, corner), self.sizes[corner.name]
        turn = _cross(arriving.along, leaving.along)
        if min(self.room[path[number].name], self.room[corner.after] if corner.after else inf) <= LENGTH:
            self.against.append(f"{corner.name} is on an element of no length")
        elif abs(turn) <= REGULAR or not abs(leaving.along) > 0:
            self.against.append(f"{corner.name} is between elements of one direction")
        elif corner.shape.share and self.is_outside(corner, number):
            self.against.append(f"{corner.name} is outside of the rectangle that its lines span")
        if self.against:
            return None
        move = _CORNERS[corner.shape](corner, arriving, leaving, size, quadrant)
        if move is None:
            self.against.append(f"{corner.name} does not fit")
            return None
        taken = -arriving.ahead(move.start), leaving.ahead(move.end)
        names = [path[number].name, *([follower.name] if follower else [])]
        lengths = [self.length(path[number]), self.length(follower) if corner.after and follower else inf]
        for part, length in zip(taken, lengths, strict=True):
            if not -LENGTH <= part <= length + LENGTH:
                self.against.append(f"{corner.name} takes {part:.6g} mm of {length:.6g} mm")
        for name, part in zip(names, taken, strict=False):
            self.room[name] -= part
        return move

    def landing(self, corner: Corner, number: int) -> complex:
        """The direction of an axis-parallel line that a last corner lands on: the way that the path advances."""
        if corner.lands_parallel_to is None:
            return 0j
        for element in reversed(self.figure.path[max(0, number - 1) : number + 1]):
            along = self.edge(element, element.head).along
            part = (along.real, along.imag)[corner.lands_parallel_to]
            if part:
                return (1, 1j)[corner.lands_parallel_to] * copysign(1, part)
        return 0j

    def quadrant(self, arriving: Edge, leaving: Edge, number: int, corner: Corner) -> complex:
        """The signs of a 45 degree segment."""
        path = self.figure.path
        if corner.after is None and corner.lands_on is None:
            earlier = self.edge(path[max(0, number - 1)], path[max(0, number - 1)].head).along
            here = arriving.along
            return complex(_sign(here.real) or _sign(earlier.real), _sign(here.imag) or _sign(earlier.imag))
        way, least = arriving.along + leaving.along, REGULAR
        if corner.after is not None and arriving.circle is None and leaving.circle is None:
            way, least = self.point(path[number + 1].head) - self.point(path[number].tail), 0.0
        real, imag = (part if abs(part) > least else 0.0 for part in (way.real, way.imag))
        return complex(_sign(real) or _sign(arriving.along.real), _sign(imag) or _sign(arriving.along.imag))

    def is_outside(self, corner: Corner, number: int) -> bool:
        """Whether a corner is outside of the rectangle that the ends of its two lines span."""
        path = self.figure.path
        if corner.after is None or isinstance(path[number], Arc) or isinstance(path[number + 1], Arc):
            return False
        at, ends = self.point(corner.at), (self.point(path[number].tail), self.point(path[number + 1].head))
        parts = [[(each.real, each.imag)[axis] for each in (at, *ends)] for axis in (FIRST, SECOND)]
        return any(
            not min(low, high) - give - LENGTH <= here <= max(low, high) + give + LENGTH
            for (here, low, high), give in zip(parts, self.increments, strict=True)
        )


def _newton(equations: Callable[[complex], tuple[tuple[float, complex], ...]], at: complex) -> complex | None:
    """The point where two functions with these gradients vanish, near a point; None if there is none."""
    for _ in range(60):
        (one, first), (two, second) = equations(at)
        turn = _cross(first, second)
        if not abs(turn) > REGULAR:
            return None
        step = complex(two * first.imag - one * second.imag, one * second.real - two * first.real) / turn
        at += step
        if abs(step) <= 1e-14 * (1 + abs(at)):
            break
    worst = max(abs(value) for value, _ in equations(at))
    return at if worst <= LENGTH * (1 + abs(at) * 1e-3) else None


_STEPS = 16
"""In how many steps a corner grows beside an arc: its place is the one that it grows to."""


def _grown(
    size: float, arriving: Edge, leaving: Edge, at: Callable[[float, complex], complex | None]
) -> complex | None:
    count = 1 if arriving.circle is None and leaving.circle is None else _STEPS
    found: complex | None = arriving.at
    for number in range(1, count + 1):
        found = at(size * number / count, found) if found is not None else None
    return found


def _rounding(corner: Corner, arriving: Edge, leaving: Edge, size: float, _: complex) -> Move | None:
    """An arc of a radius that touches both elements, to the side to which they turn."""
    side = _sign(_cross(arriving.along, leaving.along))

    def center(radius: float, near: complex) -> complex | None:
        return _newton(lambda at: tuple((e.off(at) - side * radius, e.normal(at)) for e in (arriving, leaving)), near)

    # From the circle that touches the tangents.
    found = _grown(size, arriving, leaving, center)
    if found is None:
        return None
    circle = Circle(found, size, side)
    return Move(corner.name, arriving.beside(found), leaving.beside(found), circle)


def _bevel(corner: Corner, arriving: Edge, leaving: Edge, size: float, quadrant: complex) -> Move | None:
    """A segment at 45 degrees to the axes between both elements."""

    def begin(extent: float, near: complex) -> complex | None:
        step = corner.shape.share * extent * quadrant
        return _newton(
            lambda at: ((arriving.off(at), arriving.normal(at)), (leaving.off(at + step), leaving.normal(at + step))),
            near,
        )

    found = _grown(size, arriving, leaving, begin)
    return None if found is None else Move(corner.name, found, found + corner.shape.share * size * quadrant)


def _setback(corner: Corner, arriving: Edge, leaving: Edge, size: float, _: complex) -> Move | None:
    """A segment whose ends are as far from the corner as its size, on arcs along the chord."""
    ends = [_away(arriving, size, -1), _away(leaving, size, 1)]
    return None if None in ends else Move(corner.name, ends[0] or 0j, ends[1] or 0j)


def _away(edge: Edge, distance: float, way: int) -> complex | None:
    if edge.circle is None:
        return edge.at + way * distance * edge.along
    if distance > 2 * edge.circle.radius:
        return None
    angle = way * edge.circle.turn * 2 * asin(distance / (2 * edge.circle.radius))
    return edge.circle.center + (edge.at - edge.circle.center) * rect(1, angle)


_CORNERS: Mapping[CornerShape, Callable[[Corner, Edge, Edge, float, complex], Move | None]] = {
    CornerShape.FILLET: _rounding,
    CornerShape.CHAMFER_AXIS_45: _bevel,
    CornerShape.CHAMFER_LENGTH_45: _bevel,
    CornerShape.CHAMFER_SETBACK: _setback,
}


def side_of(sheet: Sheet, values: Values, choice: Choice) -> tuple[float, float] | None:
    """On which side of a choice its point is: the number is positive on the side that is meant, and next to zero where
    there is one place; with how much (mm) that leaves between the circle and what it meets. None where the figure does
    not tell."""
    pen = _Pen(sheet, values, {}, (0.0, 0.0))
    at, path = pen.point(choice.point), sheet.figure.path
    circles = [fact for fact in sheet.facts if isinstance(fact, OnCircle)]
    if choice.side in (Side.NEARER, Side.FARTHER):
        lines = [each for each in (*path, *sheet.figure.lines) if isinstance(each, Line)]
        line = next((each for each in lines if choice.point in (each.tail, each.head)), None)
        circle = next((each for each in circles if each.point == choice.point), None)
        if line is None or circle is None:
            return None
        ahead = _dot(pen.direction(line), at - pen.point(circle.center))
        return ahead * (1 if choice.side is Side.FARTHER else -1), ahead**2 / (2 * values[circle.radius])
    arcs = [each for each in path if isinstance(each, Arc)]
    for first, second in pairwise(path):
        if first.head == choice.point and isinstance(first, Arc) and isinstance(second, Arc):
            one, two = pen.point(first.center), pen.point(second.center)
            beside = _cross(_unit(two - one), at - one)
            gap = beside**2 / (2 * min(values[first.radius], values[second.radius]))
            if choice.side in (Side.LEFT, Side.RIGHT):
                return beside * (1 if choice.side is Side.LEFT else -1), gap
            other = at - 2 * beside * 1j * _unit(two - one)
            begin = pen.point(first.tail) - one
            own, else_ = ((-_angle(begin, each - one)) % (2 * pi) for each in (at, other))
            return abs(beside) * (1 if (own < else_) == (choice.side is Side.FIRST) else -1), gap
    arc = next((each for each in arcs if each.center == choice.point), None)
    if arc is None:
        return None
    on_it = [each.point for each in circles if each.center == arc.center and each.point != arc.tail]
    stated = {fact.point for fact in sheet.facts if isinstance(fact, Coordinate | Offset)}
    on_it.sort(key=lambda point: point not in stated)
    if not on_it:
        return None
    chord = pen.point(on_it[0]) - pen.point(arc.tail)
    beside = _cross(_unit(chord), at - pen.point(arc.tail))
    return beside * (1 if choice.side is Side.LEFT else -1), beside**2 / (2 * values[arc.radius])


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
