"""Facts about lines as a whole: their direction, what they pass through, what they touch, how far points lie apart."""

from collections.abc import Collection, Iterator
from math import atan2, degrees, hypot
from typing import Any

from msgspec import Struct

from contoursolve.geometry.fact import Fact, Incidence, Lookup, apart, cross, dot, place, rotate, step
from contoursolve.geometry.figure import FIRST, SECOND, Arc, Line, Round, Turn, line_scalars, scalar
from contoursolve.geometry.points import OnCircle
from contoursolve.tolerance import RADIUS_DIFFERENCE


class UnitDirection(Fact, Struct, frozen=True):
    """The direction of a line has the length 1."""

    line: str
    given: str = ""

    def equation(self, at: Lookup) -> Any:
        cosine, sine = at.bearing(self.line)
        return cosine * cosine + sine * sine - 1

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / 2


class Directed(Fact, Struct, frozen=True):
    """The line runs at the given angle."""

    given: str
    line: str

    def residual(self, at: Lookup) -> Any:
        return cross(at.bearing(self.line), at.direction(self.given))

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (dot(at.bearing(self.line), at.direction(self.given)),)

    def implied(self, at: Lookup) -> float | None:
        cosine, sine = at.bearing(self.line)
        return degrees(atan2(float(sine), float(cosine)))

    @property
    def directed(self) -> str:
        return self.line

    @property
    def is_ray(self) -> bool:
        return True


class Through(Fact, Struct, frozen=True):
    """The line passes through `point`; the residual is how far to the left of it the point lies."""

    line: str
    point: str
    given: str = ""

    def residual(self, at: Lookup) -> Any:
        return left_of(at, self.line, self.point)

    def places(self, at: Lookup) -> Iterator[tuple[str, tuple[float, float]]]:
        yield self.line, place(at, self.point)

    @property
    def from_line(self) -> str:
        return self.point

    @property
    def passes(self) -> tuple[str, str]:
        return self.line, self.point

    def phrase(self, _axes: tuple[str, str], _sought: Collection[str]) -> str:
        return f"{self.line} passes through {self.point}"


class Parallel(Fact, Struct, frozen=True):
    """The line is parallel to `axis` and runs the way that a path advances along it: the first in `advance` that moves
    along the axis tells, each of these a line whose direction is stated, or a pair of points."""

    line: str
    axis: int
    advance: tuple[tuple[str, ...], ...]
    given: str = ""

    def residual(self, at: Lookup) -> Any:
        return at.scalar(line_scalars(self.line)[1 - self.axis])

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (at.bearing(self.line)[self.axis] * way(at, self.advance, self.axis),)

    def phrase(self, axes: tuple[str, str], _sought: Collection[str]) -> str:
        return f"{self.line} parallel to {axes[self.axis]}"


class ParallelLines(Fact, Struct, frozen=True):
    """Two lines are parallel, in the same direction or against each other."""

    first: str
    second: str
    given: str = ""
    part_of: str = ""
    """The given of a statement that says more than this: if only this repeats others, the statement does not."""

    def residual(self, at: Lookup) -> Any:
        return cross(at.bearing(self.first), at.bearing(self.second))

    @property
    def statement(self) -> str:
        return self.given or self.part_of

    @property
    def parallel(self) -> tuple[str, str]:
        return self.first, self.second


class Extent(Fact, Struct, frozen=True):
    """From `tail` to `head`, both on the line, it goes the given length along the line, whose direction a word states
    if it `is_headed`."""

    given: str
    line: str
    tail: str
    head: str
    is_headed: bool = False

    @property
    def is_affine(self) -> bool:
        return self.is_headed

    def residual(self, at: Lookup) -> Any:
        return self._extent(at) - at.amount(self.given)

    def _extent(self, at: Lookup) -> Any:
        return dot(at.bearing(self.line), step(at, self.tail, self.head))

    def implied(self, at: Lookup) -> float | None:
        return float(self._extent(at))

    def follows(self, known: Incidence, at: Lookup) -> Iterator[Any]:
        if {self.tail, self.head} <= known.on_line(self.line):
            # From end to end is the length along the direction.
            along, bearing = step(at, self.tail, self.head), at.bearing(self.line)
            yield from (along[axis] - at.amount(self.given) * bearing[axis] for axis in (FIRST, SECOND))

    @property
    def span(self) -> tuple[str, str]:
        return self.tail, self.head


class ChamferLeg(Fact, Struct, frozen=True):
    """A 45 degree chamfer from `begin` to `end` extends as far as a share of its size along `axis`, to one side.

    The side is the way in which a path advances, see `Parallel`; or the way between the directions of the two lines
    `between`, where these are given.
    """

    begin: str
    end: str
    size: str
    side: str
    axis: int
    advance: tuple[tuple[str, ...], ...]
    between: tuple[str, ...] = ()
    given: str = ""
    share: float = 1

    def residual(self, at: Lookup) -> Any:
        extent = at.coordinate(self.end, self.axis) - at.coordinate(self.begin, self.axis)
        return extent - self.share * at.side(self.side) * at.radius(self.size)

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        if self.between:
            return (at.side(self.side) * sum(at.bearing(line)[self.axis] for line in self.between),)
        return (at.side(self.side) * way(at, self.advance, self.axis),) if self.advance else ()


class Along(Struct, frozen=True):
    """The direction of a line."""

    line: str

    def is_unit(self, _known: Incidence) -> bool:
        """Whether the vector is as long as its length says, as facts tell."""
        return True

    def vector(self, at: Lookup) -> tuple[Any, Any]:
        """A vector in the direction, 1 mm long."""
        return at.bearing(self.line)

    def length(self, _at: Lookup) -> Any:
        """The length of the vector."""
        return 1


class Tangent(Struct, frozen=True):
    """The direction of an arc where it passes `point`."""

    point: str
    center: str
    radius: str
    turn: Turn

    def is_unit(self, known: Incidence) -> bool:
        """Whether the vector is as long as its length says, as facts tell."""
        return known.is_on(self.center, self.radius, self.point)

    def vector(self, at: Lookup) -> tuple[Any, Any]:
        """A vector in the direction, as long as the radius."""
        first, second = step(at, self.center, self.point)
        return -self.turn.sign * second, self.turn.sign * first

    def length(self, at: Lookup) -> Any:
        """The length of the vector."""
        return at.radius(self.radius)


class Chord(Struct, frozen=True):
    """The direction from one point to another."""

    tail: str
    head: str

    def is_unit(self, _known: Incidence) -> bool:
        """Whether the vector is as long as its length says, as facts tell."""
        return False  # its length is a root of the vector itself

    def vector(self, at: Lookup) -> tuple[Any, Any]:
        """A vector in the direction, as long as the distance."""
        return step(at, self.tail, self.head)

    def length(self, at: Lookup) -> Any:
        """The length of the vector."""
        vector = self.vector(at)
        return at.root(dot(vector, vector))


class TurnBetween(Fact, Struct, frozen=True):
    """The direction of travel turns by the given angle from the first element to the second."""

    given: str
    first: Along | Tangent | Chord
    second: Along | Tangent | Chord

    def _vectors(self, at: Lookup) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
        return rotate(self.first.vector(at), at.direction(self.given)), self.second.vector(at)

    def equation(self, at: Lookup) -> Any:
        return cross(*self._vectors(at))

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (self.first.length(at) * self.second.length(at))

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (dot(*self._vectors(at)),)

    def implied(self, at: Lookup) -> float | None:
        first, second = self.first.vector(at), self.second.vector(at)
        return degrees(atan2(float(cross(first, second)), float(dot(first, second))))

    def follows(self, known: Incidence, at: Lookup) -> Iterator[Any]:
        if self.first.is_unit(known) and self.second.is_unit(known):
            # The second direction is the first one turned, both of the length 1.
            first, second = self._vectors(at)
            for axis in (FIRST, SECOND):
                yield first[axis] * self.second.length(at) - second[axis] * self.first.length(at)

    @property
    def turn_between(self) -> tuple[Along | Tangent | Chord, Along | Tangent | Chord]:
        return self.first, self.second


def _ends(advance: tuple[tuple[str, ...], ...], axis: int) -> Iterator[str]:
    """The coordinates by which lines advance."""
    return (scalar(point, axis) for each in advance if len(each) > 1 for point in each)


def moves_of(at: Lookup, advance: tuple[tuple[str, ...], ...], axis: int) -> list[Any]:
    """The distances by which the parts of a path advance along an axis, mm, or that part of a line's direction."""
    found = []
    for name, *head in advance:
        found.append(at.coordinate(head[0], axis) - at.coordinate(name, axis) if head else at.bearing(name)[axis])
    return found


def way(at: Lookup, advance: tuple[tuple[str, ...], ...], axis: int) -> Any:
    """The advance of a path along an axis, by the first of its lines that moves along it at all."""
    return at.first_that_moves(moves_of(at, advance, axis))


def left_of(at: Lookup, line: str, point: str) -> Any:
    """The distance of a point to the left of a line, mm."""
    cosine, sine, offset = at.line(line)
    return cosine * at.coordinate(point, SECOND) - sine * at.coordinate(point, FIRST) - offset


class Distance(Fact, Struct, frozen=True):
    """`tail` and `head` lie the given distance apart; to first order the residual is the excess."""

    given: str
    tail: str
    head: str

    def equation(self, at: Lookup) -> Any:
        between = step(at, self.tail, self.head)
        return dot(between, between) - at.amount(self.given) * at.amount(self.given)

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * at.amount(self.given))

    def implied(self, at: Lookup) -> float | None:
        return hypot(*map(float, step(at, self.tail, self.head)))

    @property
    def span(self) -> tuple[str, str]:
        return self.tail, self.head

    def excess(self, at: Lookup) -> Any:
        return apart(at, self.tail, self.head) - at.amount(self.given)


class EqualDistances(Fact, Struct, frozen=True):
    """Two pairs of points lie equally far apart."""

    given: str
    first: tuple[str, str]
    second: tuple[str, str]

    def equation(self, at: Lookup) -> Any:
        first, second = step(at, *self.first), step(at, *self.second)
        return dot(first, first) - dot(second, second)

    def residual(self, at: Lookup) -> Any:
        first, second = step(at, *self.first), step(at, *self.second)
        return at.root(dot(first, first)) - at.root(dot(second, second))


def direction_at(element: Line | Arc, point: str) -> Along | Tangent:
    """The direction in which an element of a path is travelled at one of its ends."""
    if isinstance(element, Arc):
        return Tangent(point, element.center, element.radius, element.turn)
    return Along(element.name)


def put_on(element: Line | Round, point: str, given: str = "", slack: float = RADIUS_DIFFERENCE) -> Fact:
    """The fact that an element, or the line or circle that it is part of, passes through a point."""
    if isinstance(element, Line):
        return Through(element.name, point, given)
    return OnCircle(point, element.center, element.radius, given, slack)


def carry(line: Line) -> tuple[Fact, ...]:
    """The facts of a line whose direction and place are unknowns of their own."""
    return UnitDirection(line.name), *(Through(line.name, end) for end in (line.tail, line.head) if end)
