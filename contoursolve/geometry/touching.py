"""Facts about arcs, circles and corners: how they touch, how long they are, where they begin and end."""

from collections.abc import Collection, Iterator
from math import atan2, degrees, hypot, tau
from typing import Any

from msgspec import Struct

from contoursolve.geometry.fact import (
    Clearance,
    Fact,
    Incidence,
    Lookup,
    Radial,
    cross,
    dot,
    place,
    rotate,
    side_of,
    step,
)
from contoursolve.geometry.figure import FIRST, SECOND, Arc, Corner, Line, Round, Turn
from contoursolve.geometry.lines import Along, TurnBetween, left_of
from contoursolve.tolerance import AGREEMENT


class EqualRadii(Fact, Struct, frozen=True):
    """Two circles have the same radius."""

    given: str
    first: str
    second: str

    def residual(self, at: Lookup) -> Any:
        return at.radius(self.first) - at.radius(self.second)


class RadiusStep(Fact, Struct, frozen=True):
    """A radius is larger than another one by the given length."""

    given: str
    radius: str
    origin: str

    def residual(self, at: Lookup) -> Any:
        return at.radius(self.radius) - at.radius(self.origin) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.radius(self.radius) - at.radius(self.origin))

    @property
    def radius_step(self) -> tuple[str, str]:
        return self.radius, self.origin


class Spoke(Fact, Struct, frozen=True):
    """A radius leads from the centre to `point` in the given direction turned by quarters; its part along `axis`."""

    given: str
    center: str
    point: str
    radius: str
    axis: int
    quarters: int = 0

    def direction(self, at: Lookup) -> tuple[Any, Any]:
        """From the centre to the point."""
        first, second = at.direction(self.given)
        for _ in range(self.quarters % 4):
            first, second = -second, first
        return first, second

    def residual(self, at: Lookup) -> Any:
        part = self.direction(at)[self.axis]
        off = at.coordinate(self.point, self.axis) - at.coordinate(self.center, self.axis)
        return off - part * at.radius(self.radius)

    def implied(self, at: Lookup) -> float | None:
        first, second = map(float, step(at, self.center, self.point))
        if abs(hypot(first, second) - float(at.radius(self.radius))) > AGREEMENT:
            return None  # no direction puts the point on the circle
        return degrees(atan2(second, first)) - 90 * self.quarters

    @property
    def is_half(self) -> bool:
        return True

    @property
    def radial(self) -> Radial | None:
        return Radial(self.center, self.radius, self.point, self.direction) if self.axis == FIRST else None

    @property
    def spoke(self) -> tuple[str, str] | None:
        return (self.center, self.point) if not self.quarters and self.axis == FIRST else None

    @property
    def vertex(self) -> str:
        # The direction of a radius is that of the arc a quarter of a turn from it, where it begins.
        return self.point if self.quarters else self.center


class TangentLine(Fact, Struct, frozen=True):
    """The line touches the circle about `center`, which lies to its left (`side` +1) or right (-1)."""

    line: str
    center: str
    radius: str
    side: str | int
    given: str = ""

    def residual(self, at: Lookup) -> Any:
        return left_of(at, self.line, self.center) - side_of(self.side, at) * at.radius(self.radius)

    def places(self, at: Lookup) -> Iterator[tuple[str, tuple[float, float]]]:
        (first, second), (cosine, sine, offset) = place(at, self.center), at.line(self.line)
        left = cosine * second - sine * first - offset
        foot = first + left * sine, second - left * cosine
        yield self.line, foot
        yield self.center, foot

    @property
    def from_line(self) -> str:
        return self.center

    @property
    def beside(self) -> Clearance:
        return Clearance(self.center, self.radius, self.line, ("", ""), self.side)

    def follows(self, known: Incidence, at: Lookup) -> Iterator[Any]:
        touched, bearing = known.touched(self.line, self.center), at.bearing(self.line)
        radius = side_of(self.side, at) * at.radius(self.radius)
        for point in known.points(self.line):
            spoke = step(at, point, self.center)
            if point in touched:
                # From where the line touches the circle to its centre is the radius, square to the line.
                yield spoke[FIRST] + radius * bearing[SECOND]
                yield spoke[SECOND] - radius * bearing[FIRST]
            else:
                yield cross(bearing, spoke) - radius

    def phrase(self, _axes: tuple[str, str], _sought: Collection[str]) -> str:
        return f"{self.line} touches the circle about {self.center}"


class Foot(Fact, Struct, frozen=True):
    """`point` is the foot of the perpendicular from `center` onto the line.

    With a `corner`, the point must lie before it on the line (`way` +1) or beyond it (-1).
    """

    line: str
    point: str
    center: str
    given: str = ""
    corner: str = ""
    way: int = 1
    part_of: str = ""
    """The given of a statement that says more than this, see `Parallel`."""

    def __repr__(self) -> str:
        """Without what it is a part of, which is no part of the equation: equations are told apart by their texts."""
        stated = f"line={self.line!r}, point={self.point!r}, center={self.center!r}, given={self.given!r}"
        return f"Foot({stated}, corner={self.corner!r}, way={self.way!r})"

    def residual(self, at: Lookup) -> Any:
        return dot(at.bearing(self.line), step(at, self.center, self.point))

    @property
    def statement(self) -> str:
        return self.given or self.part_of

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        if not self.corner:
            return ()
        return (self.way * dot(at.bearing(self.line), step(at, self.point, self.corner)),)

    @property
    def foot(self) -> tuple[str, str, str]:
        return self.line, self.center, self.point

    @property
    def contact(self) -> str:
        return self.point

    def phrase(self, _axes: tuple[str, str], _sought: Collection[str]) -> str:
        return f"{self.point} where the circle touches {self.line}"


class Leaving(Fact, Struct, frozen=True):
    """The line begins at `point`, which lies on a circle, in the direction in which the circle is travelled there."""

    line: str
    point: str
    center: str
    turn: Turn
    given: str = ""

    def residual(self, at: Lookup) -> Any:
        return dot(at.bearing(self.line), step(at, self.center, self.point))

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (self.turn.sign * cross(step(at, self.center, self.point), at.bearing(self.line)),)


class ParallelTangent(Fact, Struct, frozen=True):
    """The line is parallel to the tangent of a circle about `center` at `point`, whichever way it runs."""

    line: str
    point: str
    center: str
    given: str = ""

    def residual(self, at: Lookup) -> Any:
        return dot(at.bearing(self.line), step(at, self.center, self.point))


class TangentCircles(Fact, Struct, frozen=True):
    """Two circles touch: from outside (`side` +1) or one inside the other (-1).

    `side` is the name of an open side, or the side itself. To first order the residual is the gap.
    """

    first: tuple[str, str]
    """Center and radius."""
    second: tuple[str, str]
    side: str | int
    given: str = ""

    def equation(self, at: Lookup) -> Any:
        between, side = step(at, self.first[0], self.second[0]), side_of(self.side, at)
        first, second = at.radius(self.first[1]), at.radius(self.second[1])
        # Expanded with side**2 = 1, so that a difference of two such equations has no squares at all.
        return dot(between, between) - first * first - second * second - 2 * side * first * second

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * (at.radius(self.first[1]) + at.radius(self.second[1])))

    def follows(self, _known: Incidence, at: Lookup) -> Iterator[Any]:
        between = step(at, self.first[0], self.second[0])
        reach = at.radius(self.first[1]) + side_of(self.side, at) * at.radius(self.second[1])
        yield dot(between, between) - reach * reach

    def places(self, at: Lookup) -> Iterator[tuple[str, tuple[float, float]]]:
        (center, radius), (other, other_radius) = self.first, self.second
        here, there = place(at, center), place(at, other)
        between = hypot(there[0] - here[0], there[1] - here[1])
        # Of two circles one in the other, the smaller one touches on the side away from the larger one's centre.
        is_inner = at.radius(radius) < at.radius(other_radius) and between < at.radius(other_radius)
        way = float(at.radius(radius)) / between * (-1 if is_inner else 1)
        contact = here[0] + way * (there[0] - here[0]), here[1] + way * (there[1] - here[1])
        yield center, contact
        yield other, contact

    @property
    def side_names(self) -> tuple[str, str]:
        return "outside", "inside"

    def phrase(self, _axes: tuple[str, str], _sought: Collection[str]) -> str:
        return f"the circles about {self.first[0]} and {self.second[0]} touch"


class PointBeside(TangentCircles, frozen=True):
    """A point, about which `first` is a circle, lies as far beside the circle `second` as that has for its radius:
    outside (`side` +1) or inside (-1). A circle whose radius is less than that has no such point inside."""

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        side, inside = side_of(self.side, at), at.radius(self.second[1]) - at.radius(self.first[1])
        return (1 + side + (1 - side) * inside,)

    @property
    def beside(self) -> Clearance:
        return Clearance(*self.first, "", self.second, self.side)


class Contact(Fact, Struct, frozen=True):
    """`point`, which lies on two circles, is where they touch: in line with their centres.

    It lies between the centres for a contact from outside (`side` +1), beyond them for one from inside (-1).
    """

    point: str
    first: str
    second: str
    """The centres."""
    side: int
    given: str = ""

    def equation(self, at: Lookup) -> Any:
        return cross(step(at, self.first, self.point), step(at, self.first, self.second))

    def residual(self, at: Lookup) -> Any:
        between = step(at, self.first, self.second)
        if at.vanishes(dot(between, between)):
            # Both circles are about one point, as far as numbers tell: they touch wherever they meet.
            between = step(at, self.first, self.point)
        return self.equation(at) / at.root(dot(between, between))

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (self.side * dot(step(at, self.first, self.point), step(at, self.point, self.second)),)

    def follows(self, known: Incidence, at: Lookup) -> Iterator[Any]:
        radii = [known.radius_of(center, self.point) for center in (self.first, self.second)]
        if known.read >= {*radii}:
            # From one centre to the point is r1, from there to the other in the same direction r2, or back.
            first, second = map(at.radius, radii)
            part, rest = step(at, self.first, self.point), step(at, self.point, self.second)
            yield from (self.side * second * part[axis] - rest[axis] * first for axis in (FIRST, SECOND))

    @property
    def contact(self) -> str:
        return self.point

    @property
    def centers(self) -> tuple[str, str]:
        return self.first, self.second


class ArcLength(Fact, Struct, frozen=True):
    """The arc from `tail` to `head` about `center` has the given length.

    The residual is how far `head` lies off the ray at which the arc must end.
    """

    given: str
    tail: str
    head: str
    center: str
    radius: str
    turn: Turn

    def _spokes(self, at: Lookup) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
        cosine, sine = at.rotation(at.amount(self.given) / at.radius(self.radius))
        begin = rotate(step(at, self.center, self.tail), (cosine, self.turn.sign * sine))
        return begin, step(at, self.center, self.head)

    def equation(self, at: Lookup) -> Any:
        return cross(*self._spokes(at))

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / at.radius(self.radius)

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        # 710 / 113 is 2 pi and a little more: an arc is no longer than its circle.
        circle = at.radius(self.radius) * 710 / 113
        return dot(*self._spokes(at)), circle - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        begin, end = step(at, self.center, self.tail), step(at, self.center, self.head)
        sweep = atan2(float(cross(begin, end)) * self.turn.sign, float(dot(begin, end))) % tau
        return float(at.radius(self.radius)) * sweep

    def follows(self, known: Incidence, at: Lookup) -> Iterator[Any]:
        if known.is_on(self.center, self.radius, self.tail, self.head):
            # Its end is its begin turned about the centre; its chord twice the radius times the sine of half the sweep.
            begin, end = self._spokes(at)
            yield from (begin[axis] - end[axis] for axis in (FIRST, SECOND))
            chord, radius = step(at, self.tail, self.head), at.radius(self.radius)
            half = 2 * radius * at.rotation(at.amount(self.given) / (2 * radius))[1]
            yield dot(chord, chord) - half * half


class TangentArc(Fact, Struct, frozen=True):
    """The circle about `center` touches the circle of an arc, and lies to the left of its travel (`side` +1) or to
    the right (-1). To first order the residual is the gap."""

    arc: tuple[str, str]
    """Center and radius."""
    turn: Turn
    center: str
    radius: str
    side: str | int
    given: str = ""

    def equation(self, at: Lookup) -> Any:
        between, own, radius = step(at, self.arc[0], self.center), at.radius(self.arc[1]), at.radius(self.radius)
        # Expanded with side**2 = 1, as in `TangentCircles`.
        inward = 2 * self.turn.sign * side_of(self.side, at) * own * radius
        return dot(between, between) - own * own - radius * radius + inward

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * (at.radius(self.arc[1]) + at.radius(self.radius)))


class ArcContact(Fact, Struct, frozen=True):
    """`point`, which lies on the circle of an arc, is where a circle about `center` touches it: in line with both
    centres. It comes before the `corner` on the arc (`way` +1) or after it (-1), by less than half a turn."""

    point: str
    arc: tuple[str, str]
    """Center and radius."""
    turn: Turn
    center: str
    radius: str
    side: str | int
    corner: str
    way: int
    given: str = ""

    def equation(self, at: Lookup) -> Any:
        return cross(step(at, self.arc[0], self.point), step(at, self.arc[0], self.center))

    def residual(self, at: Lookup) -> Any:
        spoke = step(at, self.arc[0], self.point)
        return self.equation(at) / at.root(dot(spoke, spoke))

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        spoke, between = step(at, self.arc[0], self.point), step(at, self.arc[0], self.center)
        # A circle that turns the same way and is larger than the arc's has its centre beyond the arc's.
        reach = at.radius(self.arc[1]) - self.turn.sign * side_of(self.side, at) * at.radius(self.radius)
        ahead = cross(spoke, step(at, self.arc[0], self.corner))
        return reach * dot(spoke, between), self.way * self.turn.sign * ahead


class Setback(Fact, Struct, frozen=True):
    """`point`, which lies on the line, is `size` before the `corner` (`way` +1) or after it (-1)."""

    line: str
    point: str
    corner: str
    size: str
    way: int
    given: str = ""

    def residual(self, at: Lookup) -> Any:
        ahead = dot(at.bearing(self.line), step(at, self.point, self.corner))
        return self.way * ahead - at.radius(self.size)


class ChordSetback(Fact, Struct, frozen=True):
    """`point`, which lies on the circle of an arc, is `size` away from the `corner`, along the chord: before it on
    the arc (`way` +1) or after it (-1)."""

    center: str
    turn: Turn
    point: str
    corner: str
    size: str
    way: int
    given: str = ""

    def equation(self, at: Lookup) -> Any:
        chord, size = step(at, self.point, self.corner), at.radius(self.size)
        return dot(chord, chord) - size * size

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * at.radius(self.size))

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (
            self.way * self.turn.sign * cross(step(at, self.center, self.point), step(at, self.center, self.corner)),
        )


def put_beside(element: Line | Round, point: str, distance: str, side: str, given: str = "") -> Fact:
    """The fact that an element, or the line or circle that it is part of, passes a point at a distance, which is the
    name of a radius, on an open side."""
    if isinstance(element, Line):
        return TangentLine(element.name, point, distance, side, given)
    return PointBeside((point, distance), (element.center, element.radius), side, given)


def make_tangent(element: Line | Round, circle: Round, side: str | int, given: str = "") -> Fact:
    """The fact that an element, or the line or circle that it is part of, touches a circle."""
    if isinstance(element, Line):
        return TangentLine(element.name, circle.center, circle.radius, side, given)
    return TangentCircles((element.center, element.radius), (circle.center, circle.radius), side, given)


def make_smooth(before: Line | Arc, after: Line | Arc, at: str, given: str = "") -> tuple[Fact, ...]:
    """The facts that a path goes on in its direction at a point: the first says so, and another where they touch."""
    if isinstance(before, Arc) and isinstance(after, Arc):
        return (Contact(at, before.center, after.center, -1 if before.turn is after.turn else 1, given),)
    if isinstance(before, Arc):
        before, after = after, before
    if isinstance(before, Arc) or isinstance(after, Line):
        return (TurnBetween(given, Along(before.name), Along(after.name)),)
    foot = Foot(before.name, at, after.center, part_of=given)
    return make_tangent(before, after, after.turn.sign, given), foot


def round_off(corner: Corner, element: Line | Arc, point: str, way: int) -> tuple[Fact, ...]:
    """The facts that a rounding touches an element in a point before its corner (`way` +1) or after it (-1)."""
    center, size, side = (f"{corner.name}.{part}" for part in ("center", "radius", "side"))
    if isinstance(element, Line):
        foot = Foot(element.name, point, center, corner=corner.at, way=way)
        return TangentLine(element.name, center, size, side), foot
    arc, turn = (element.center, element.radius), element.turn
    contact = ArcContact(point, arc, turn, center, size, side, corner.at, way)
    return TangentArc(arc, turn, center, size, side), contact


def set_back(corner: Corner, element: Line | Arc, point: str, way: int) -> Fact:
    """The fact that a chamfer ends on an element, its size before its corner (`way` +1) or after it (-1)."""
    size = f"{corner.name}.radius"
    if isinstance(element, Line):
        return Setback(element.name, point, corner.at, size, way)
    return ChordSetback(element.center, element.turn, point, corner.at, size, way)
