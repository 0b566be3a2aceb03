"""Further facts that a user may state about a drawing: one small class each, with its values.

Lengths are in mm, angles in degrees, coordinates in the plane's axes with X of a lathe as radius. A value that
is None is asked for instead of stated. `state` adds the equations to a draft under a name.
"""

from decimal import Decimal

from msgspec import Struct
from msgspec.structs import astuple, replace

from contoursolve.geometry.fact import Fact
from contoursolve.geometry.figure import Arc, Corner, CornerShape, Line
from contoursolve.geometry.lines import (
    Directed,
    Distance,
    EqualDistances,
    Extent,
    ParallelLines,
    TurnBetween,
    put_on,
)
from contoursolve.geometry.points import Coordinate, Radius, Ray
from contoursolve.geometry.profile import Unit
from contoursolve.geometry.statements.draft import Draft, DraftCircle, StatementError
from contoursolve.geometry.touching import ArcLength, EqualRadii, make_smooth, make_tangent, put_beside

Place = tuple[Decimal, Decimal]


class CircleAt(Struct, frozen=True):
    """A given circle."""

    center: Place
    radius: Decimal


class LineAt(Struct, frozen=True):
    """A given line through a place, running at an angle."""

    place: Place
    angle: Decimal


class Statement(Struct, frozen=True):
    """A fact that a user states or asks about a drawing."""

    def state(self, draft: Draft, name: str) -> Fact:
        """Add the equations, and return the one that the statement amounts to.

        Raises StatementError if it makes no sense for this drawing. A value that is asked for adds no given;
        the fact that is returned tells it (`implied`).
        """
        raise NotImplementedError


class PointIs(Statement, frozen=True):
    """A coordinate of a point: a virtual intersection, or where an element begins, ends or has its centre."""

    part: str
    """`begin`, `end` or `center`; empty where `of` is a point itself."""
    of: str
    axis: int
    value: Decimal | None

    def state(self, draft: Draft, name: str) -> Fact:
        point = draft.point(self.part, self.of) if self.part else self.of
        if not self.part and point not in (*draft.figure.points, draft.figure.start):
            raise StatementError(f"there is no point {point!r} here; points are {', '.join(draft.figure.points)}")
        return _stated(draft, Coordinate(name, point, self.axis), self.value, Unit.MM)


class LengthIs(Statement, frozen=True):
    """The length of a line (between the virtual intersections at its ends), of an arc, or of a corner."""

    element: str
    value: Decimal | None

    def state(self, draft: Draft, name: str) -> Fact:
        _check_size(self.value, "a length")
        element = draft.element(self.element)
        if isinstance(element, Line):
            _check_ends(element)
            if element.heading is None and element.name not in draft.figure.carriers:
                return _stated(draft, Distance(name, element.tail, element.head), self.value, Unit.MM)
            return _stated(draft, Extent(name, element.name, element.tail, element.head), self.value, Unit.MM)
        if isinstance(element, Corner) and element.shape is not CornerShape.FILLET:
            draft.corner(element.name)
            ends = f"{element.name}.begin", f"{element.name}.end"
            return _stated(draft, Distance(name, *ends), self.value, Unit.MM)
        form = _arc(draft, self.element)
        turn = element.turn if isinstance(element, Arc) else None
        if turn is None:
            raise StatementError(
                f"the length of {self.element} depends on its sense; state the angle between its lines"
            )
        return _stated(
            draft, ArcLength(name, form.begin, form.end, form.center, form.radius, turn), self.value, Unit.MM
        )


class StraightIs(Statement, frozen=True):
    """The length of a line's straight part, between the corners at its ends."""

    line: str
    value: Decimal | None

    def state(self, draft: Draft, name: str) -> Fact:
        line = draft.line(self.line)
        _check_ends(line)
        ends = [line.tail, line.head]
        for corner in draft.figure.corners:
            for number, (at, part) in enumerate(((line.tail, "end"), (line.head, "begin"))):
                if corner.at == at:
                    ends[number] = draft.point(part, corner.name)
        return _stated(draft, Extent(name, self.line, ends[0], ends[1]), self.value, Unit.MM)


class DirectionIs(Statement, frozen=True):
    """The direction in which a line runs."""

    line: str
    value: Decimal | None

    def state(self, draft: Draft, name: str) -> Fact:
        line = draft.element(self.line)
        if not isinstance(line, Line) or line.heading is None:
            draft.line(self.line)
        # Of a line whose word states its direction, this says something about the word and nothing about points.
        return _stated(draft, Directed(name, self.line), self.value, Unit.DEGREE)


class TurnIs(Statement, frozen=True):
    """By how much the direction of travel turns from one element to another, counter-clockwise."""

    first: str
    second: str
    value: Decimal | None

    def state(self, draft: Draft, name: str) -> Fact:
        first, second = draft.element(self.first), draft.element(self.second)
        if isinstance(first, Line) and isinstance(second, Line):
            vectors: tuple[object, object] = (draft.travel(self.first, ""), draft.travel(self.second, ""))
        else:
            at = draft.junction(self.first, self.second)
            vectors = (draft.travel(self.first, at), draft.travel(self.second, at))
        return _stated(draft, TurnBetween(name, *vectors), self.value, Unit.DEGREE)  # type: ignore[arg-type]


class PassesThrough(Statement, frozen=True):
    """An element, or the line or circle that it is part of, passes through a place."""

    element: str
    place: Place

    def state(self, draft: Draft, name: str) -> Fact:
        place = draft.place(f"{name}.place", self.place)
        return _named(draft, put_on(_whole(draft, self.element), place, name))


class PassesBeside(Statement, frozen=True):
    """An element, or the line or circle that it is part of, passes a place at a distance, on either side of it.

    A distance of 0 says that it passes through the place.
    """

    element: str
    place: Place
    distance: Decimal

    def state(self, draft: Draft, name: str) -> Fact:
        _check_distance(self.distance)
        if not self.distance:
            return PassesThrough(self.element, self.place).state(draft, name)
        element = _whole(draft, self.element)
        around = draft.around(name, draft.place(f"{name}.place", self.place), self.distance)
        return _named(draft, put_beside(element, around.center, around.radius, f"{name}.side", name))


class LiesOn(Statement, frozen=True):
    """The begin, the end or the center of an element lies on another element, or on the line or circle that it is part
    of: a line that is drawn as far as another one."""

    part: str
    """`begin`, `end` or `center`."""
    of: str
    on: str | CircleAt | LineAt

    def state(self, draft: Draft, name: str) -> Fact:
        point = draft.point(self.part, self.of)
        if isinstance(self.on, CircleAt):
            return _named(draft, put_on(draft.circle(name, self.on.center, self.on.radius), point, name))
        if isinstance(self.on, LineAt):
            return _named(draft, put_on(draft.line(draft.given_line(f"{name}.line", *astuple(self.on))), point, name))
        element = draft.element(self.on)
        if point in (getattr(element, "tail", ""), getattr(element, "head", "")):
            raise StatementError(f"the {self.part} of {self.of} lies on {self.on} whatever the drawing gives")
        return _named(draft, put_on(_whole(draft, self.on), point, name))


class ParallelTo(Statement, frozen=True):
    """A line is parallel to another one, in the same direction or against it, and may be at a distance from it.

    With a distance it lies on either side. A distance of 0 says that both lie on one line.
    """

    line: str
    other: str
    distance: Decimal | None = None

    def state(self, draft: Draft, name: str) -> Fact:
        if self.line == self.other:
            raise StatementError(f"{self.line} is one line, and parallel to itself")
        line, other = draft.line(self.line), draft.line(self.other)
        if self.distance is None:
            return _named(draft, ParallelLines(self.line, self.other, name))
        _check_distance(self.distance)
        meeting = {line.tail, line.head} & {other.tail, other.head} - {""}
        if self.distance and meeting:
            raise StatementError(
                f"{self.line} and {self.other} meet in {meeting.pop()}, so that there is no distance between them"
            )
        parallel = draft.give(f"{name}.parallel", Decimal(0), Unit.SIGN)
        draft.add(ParallelLines(self.line, self.other, part_of=parallel))
        point = draft.point_on(self.line)
        if not self.distance:
            return _named(draft, put_on(other, point, name))
        around = draft.around(name, point, self.distance)
        return _named(draft, put_beside(other, around.center, around.radius, f"{name}.side", name))


class ChordIs(Statement, frozen=True):
    """The length of the chord of an arc or a rounding: straight from its begin to its end."""

    arc: str
    value: Decimal | None

    def state(self, draft: Draft, name: str) -> Fact:
        _check_size(self.value, "a chord")
        form = _arc(draft, self.arc)
        return _stated(draft, Distance(name, form.begin, form.end), self.value, Unit.MM)


class PolarAngleIs(Statement, frozen=True):
    """The angle from the plane's first axis to the ray from the centre of an arc or a rounding to one of its ends."""

    arc: str
    value: Decimal | None
    part: str = "end"
    """`begin` or `end`."""

    def state(self, draft: Draft, name: str) -> Fact:
        form = _arc(draft, self.arc)
        end = form.begin if self.part == "begin" else form.end
        return _stated(draft, Ray(name, form.center, end), self.value, Unit.DEGREE)


class RadiusIs(Statement, frozen=True):
    """The radius of an arc, a circle or a rounding, or the size of a chamfer."""

    element: str
    value: Decimal | None

    def state(self, draft: Draft, name: str) -> Fact:
        _check_size(self.value, "a radius")
        element = draft.element(self.element)
        if isinstance(element, Corner):
            draft.corner(element.name)
            return _stated(draft, Radius(name, f"{element.name}.radius"), self.value, Unit.MM)
        return _stated(draft, Radius(name, draft.round(self.element).radius), self.value, Unit.MM)


class Touches(Statement, frozen=True):
    """Two elements are tangent. Neighbours go on smoothly; others touch from any side."""

    first: str
    second: str | CircleAt | LineAt

    def state(self, draft: Draft, name: str) -> Fact:
        if isinstance(self.second, str):
            try:
                at = draft.junction(self.first, self.second)
            except StatementError:
                return self._touch(draft, name, self.second)
            return self._join(draft, name, at)
        if isinstance(self.second, CircleAt):
            return self._touch(draft, name, draft.circle(name, self.second.center, self.second.radius))
        return self._touch(draft, name, draft.given_line(f"{name}.line", self.second.place, self.second.angle))

    def _join(self, draft: Draft, name: str, at: str) -> Fact:
        """Neighbours: the sense of both says on which side they touch."""
        first, second = draft.part(self.first), draft.part(str(self.second))
        arcs = [each for each in (first, second) if isinstance(each, Arc)]
        if len(arcs) == 1:
            draft.leave(at, arcs[0])
        fact, *more = make_smooth(first, second, at, name)
        draft.add(*more)
        draft.give(name, Decimal(0), Unit.SIGN if arcs else Unit.DEGREE)
        draft.add(fact)
        return fact

    def _touch(self, draft: Draft, name: str, other: str | DraftCircle) -> Fact:
        """Elements that are not neighbours: the side is open."""
        elements = (self.first, other)
        lines = [each for each in elements if isinstance(each, str) and isinstance(draft.element(each), Line)]
        if len(lines) > 1:
            raise StatementError("two lines cannot be tangent unless they are neighbours")
        rounds = [draft.round(each) if isinstance(each, str) else each for each in elements if each not in lines]
        element = draft.line(lines[0]) if lines else rounds[0]
        return _named(draft, make_tangent(element, rounds[-1], f"{name}.side", name))


class EqualLengths(Statement, frozen=True):
    """Two lines are equally long."""

    first: str
    second: str

    def state(self, draft: Draft, name: str) -> Fact:
        ends = []
        for each in (self.first, self.second):
            line = draft.element(each)
            if not isinstance(line, Line):
                raise StatementError(f"{each} is not a line")
            _check_ends(line)
            ends.append((line.tail, line.head))
        return _named(draft, EqualDistances(name, *ends))


class EqualSizes(Statement, frozen=True):
    """Two arcs, circles or corners have the same radius."""

    first: str
    second: str

    def state(self, draft: Draft, name: str) -> Fact:
        radii = []
        for each in (self.first, self.second):
            element = draft.element(each)
            if isinstance(element, Corner):
                draft.corner(each)
                radii.append(f"{each}.radius")
            else:
                radii.append(draft.round(each).radius)
        return _named(draft, EqualRadii(name, *radii))


class Meeting(Struct, frozen=True):
    """A line from the corner's virtual intersection: to a place, or at an angle; neither where the next block tells."""

    to: Place | None
    angle: Decimal | None


class MeetsLine(Statement, frozen=True):
    """A last corner joins its line to this one.

    A 45 degree chamfer runs in the quadrant of the direction midway between the two lines: of the four, the one
    that is nearest to equal setbacks, and the only one that fits unless the path turns by more than 90 degrees. For a
    line parallel to an axis this is what the manual's tables say. Where the two directions cancel along an axis, so
    that two quadrants are equally near, it goes on there as the line before it; if the size is asked for, that stays
    undecided. A line to a place must be long
    enough for the corner.
    """

    corner: str
    line: Meeting

    def state(self, draft: Draft, name: str) -> Fact:
        corner = draft.element(self.corner)
        if not isinstance(corner, Corner) or corner.after is not None:
            raise StatementError(f"{self.corner} is no last corner")
        line = f"{self.corner}.landing"
        if any(each.name == line for each in draft.figure.lines):
            raise StatementError(f"the line that {self.corner} meets is stated twice")
        if self.line.angle is not None:
            heading = draft.give(name, self.line.angle, Unit.DEGREE)
            added = Line(line, corner.at, "", heading)
        elif self.line.to is not None:
            draft.give(name, Decimal(0), Unit.SIGN)
            added = Line(line, corner.at, draft.place(f"{name}.place", self.line.to))
        else:
            raise StatementError("there is no next block with a line whose end is known")
        corners = tuple(
            replace(each, lands_on=line, lands_parallel_to=None) if each.name == self.corner else each
            for each in draft.figure.corners
        )
        draft.figure = replace(draft.figure, lines=(*draft.figure.lines, added), corners=corners)
        return put_on(draft.line(line), corner.at, name)


ANGLES = (DirectionIs, PolarAngleIs, TurnIs)
"""Statements whose value is an angle."""


def _whole(draft: Draft, name: str) -> Line | DraftCircle:
    """An element as the line or circle that it is part of, of which facts can speak."""
    return draft.line(name) if isinstance(draft.element(name), Line) else draft.round(name)


def _arc(draft: Draft, name: str) -> DraftCircle:
    form = draft.round(name)
    if not form.begin:
        raise StatementError(f"{name} is a whole circle and has no ends")
    return form


def _stated(draft: Draft, fact: Fact, value: Decimal | None, unit: Unit) -> Fact:
    """A fact with its value; one that is asked for is not added."""
    if value is not None:
        draft.give(fact.given, value, unit)
        draft.add(fact)
    return fact


def _named(draft: Draft, fact: Fact) -> Fact:
    """A fact without a value of its own; the given keeps the words that state it."""
    draft.give(fact.given, Decimal(0), Unit.SIGN)
    draft.add(fact)
    return fact


def _check_size(value: Decimal | None, what: str) -> None:
    if value is not None and value <= 0:
        raise StatementError(f"{what} is larger than 0, not {value:f}")


def _check_distance(value: Decimal) -> None:
    if value < 0:
        raise StatementError(f"a distance is not negative, as {value:f} is")


def _check_ends(line: Line) -> None:
    if not (line.tail and line.head):
        raise StatementError(f"{line.name} is a whole line and has no ends")
