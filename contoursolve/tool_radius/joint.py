"""Joints of a tool's path: where its centre stands when it touches an element and the next one.

In an inside corner that is the centre of a fillet of the tool's radius, as for a corner word: the same system in closed
form. Where both offsets meet beyond an outside corner, it is that of the corner between both tangents prolonged.
"""

from functools import lru_cache
from math import atan2, hypot, isfinite, radians
from typing import Any

from msgspec import Struct

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Corner,
    CornerShape,
    Figure,
    Line,
    Turn,
    build_system,
    cross,
    put_on,
    scalar,
)
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, compile_system
from contoursolve.tolerance import LENGTH, RESIDUAL

STRAY = 1e-7
"""mm. What straight on strays from the way around an outside corner where that is left out: words are rounded."""

TANGENT = radians(0.01)
"""rad. Up to this turn, elements are tangent whose offsets do not meet (assumed)."""


class CornerCenter(Struct, frozen=True):
    """Centre of a tool that touches two elements, and the length (mm) that it leaves of each at their common end."""

    center: Point
    back: float
    ahead: float


class Joint(Struct, frozen=True):
    """Joint of two elements: the turn between them (rad, to the side of the tool positive), and where the centre
    stands, if the offsets meet there."""

    turn: float
    meeting: CornerCenter | None

    @property
    def is_lost(self) -> bool:
        """Whether the tool does not come into the corner, in which it would have to stand."""
        return self.turn > 0 and self.meeting is None


def direction(segment: Segment, *, at_end: bool) -> Point:
    """Unit direction of travel at the start or the end of an element."""
    if isinstance(segment, ArcSegment):
        at = segment.end if at_end else segment.start
        first, second = at[0] - segment.center[0], at[1] - segment.center[1]
        sign = segment.turn.sign / hypot(first, second)
        return -second * sign, first * sign
    first, second = segment.end[0] - segment.start[0], segment.end[1] - segment.start[1]
    length = hypot(first, second)
    return first / length, second / length


def turn_of(before: Segment, after: Segment) -> float:
    """The turn from the end of an element to the start of the next one, rad, to the left positive."""
    one, two = direction(before, at_end=True), direction(after, at_end=False)
    return atan2(cross(one, two), one[0] * two[0] + one[1] * two[1])


def join(before: Segment, after: Segment, radius: float, side: int) -> Joint:
    """The joint of two elements for a tool of a radius (mm) to the left (`side` +1) or right (-1) of them; up to
    `TANGENT` they are tangent if their offsets do not meet: words are rounded."""
    turn = side * turn_of(before, after)
    if abs(turn) * max(radius, 1.0) <= LENGTH or (turn < 0 and radius * turn * turn / 2 <= STRAY):
        return Joint(0.0, None)
    if turn > 0:
        found = meet(before, after, radius)
        return Joint(0.0 if found is None and turn <= TANGENT else turn, found)
    return Joint(turn, None)


def meet(before: Segment, after: Segment, radius: float) -> CornerCenter | None:
    """The place of a tool of a radius (mm) that touches both elements in the corner between them; None without one."""
    function, names = _function(_turn(before), _turn(after))
    origin = before.start
    values = {"R": radius, **_scalars("S", origin, origin), **_scalars("V", before.end, origin)}
    values |= _scalars("E", after.end, origin)
    for number, each in (("1", before), ("2", after)):
        if isinstance(each, ArcSegment):
            values |= _scalars(f"C{number}", each.center, origin)
    out = function({name: values[name] for name in function.inputs})
    first, second, back, ahead, *residuals = (out[name] for name in names)
    if not all(abs(each) <= RESIDUAL for each in residuals) or not all(map(isfinite, (first, second, back, ahead))):
        return None
    return CornerCenter((origin[0] + first, origin[1] + second), back, ahead)


def meet_outside(before: Segment, after: Segment, radius: float) -> CornerCenter | None:
    """The place where the offsets of the tangents at an outside corner meet: in the corner beyond their end."""
    at, one, two = before.end, direction(before, at_end=True), direction(after, at_end=False)
    ends = (at[0] + one[0], at[1] + one[1]), (at[0] - two[0], at[1] - two[1])
    return meet(LineSegment("", ends[0], at), LineSegment("", at, ends[1]), radius)


def _turn(segment: Segment) -> Turn | None:
    return segment.turn if isinstance(segment, ArcSegment) else None


def _scalars(point: str, at: Point, origin: Point) -> dict[str, float]:
    return {scalar(point, FIRST): at[0] - origin[0], scalar(point, SECOND): at[1] - origin[1]}


@lru_cache(maxsize=9)
def _function(before: Turn | None, after: Turn | None) -> tuple[Any, tuple[str, ...]]:
    """The function of a corner of size R between elements of these kinds, and the names of what is read of it."""
    ways = (("1", before, "S", "V"), ("2", after, "V", "E"))
    path = tuple(
        Line(name, tail, head) if turn is None else Arc(name, tail, head, f"C{name}", f"r{name}", turn)
        for name, turn, tail, head in ways
    )
    arcs = [each for each in path if isinstance(each, Arc)]
    corner = Corner("tool", "V", CornerShape.FILLET, "R", "1", "2")
    radii, places = tuple(each.radius for each in arcs), ("V", "E", *(each.center for each in arcs))
    figure = Figure("S", (), radii, path, (corner,), places)
    machine = compile_system(build_system(figure, tuple(put_on(each, "V") for each in arcs)))
    built = machine.path.corners["tool"]
    if built.center is None:
        raise TypeError("a fillet has a centre")
    return machine.function, (*built.center, built.setback_in, built.setback_out, *built.residuals)
