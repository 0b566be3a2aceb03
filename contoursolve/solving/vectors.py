"""Plane geometry of drawings and pages: directions, feet of perpendiculars, how far arcs reach."""

from math import atan2, cos, hypot, pi, sin, tau

from contoursolve.solving.contour import ArcSegment, Segment, is_on
from contoursolve.solving.solution import Point
from contoursolve.tolerance import LENGTH

SAME = 1e-6
"""mm. Points nearer to each other are one on a drawing."""

ALONG_AXIS = ((1.0, 0.0), (0.0, 1.0))
"""The directions of both axes."""

DIAGONAL = (0.5**0.5, 0.5**0.5)
"""To the right and up."""


def minus(a: Point, b: Point) -> Point:
    """From b to a."""
    return a[0] - b[0], a[1] - b[1]


def along(at: Point, way: Point, by: float) -> Point:
    """The place so far from another along a direction."""
    return at[0] + by * way[0], at[1] + by * way[1]


def distance(a: Point, b: Point) -> float:
    """The distance between two points."""
    return hypot(a[0] - b[0], a[1] - b[1])


def unit(vector: Point) -> Point:
    """The direction of a vector; to the right for one of no length."""
    length = hypot(*vector)
    return (vector[0] / length, vector[1] / length) if length > 0 else (1.0, 0.0)


def direction(a: Point, b: Point) -> Point:
    """The unit direction from one place to another; to the right if they are one."""
    return unit(minus(b, a))


def toward(degrees_: float) -> Point:
    """The direction at an angle from the first axis."""
    return cos(degrees_ * pi / 180), sin(degrees_ * pi / 180)


def foot(at: Point, on: Point, way: Point) -> Point:
    """The foot of the perpendicular from a point onto the line through another along a unit direction."""
    step = minus(at, on)
    return along(on, way, step[0] * way[0] + step[1] * way[1])


def foot_on(segment: Segment, at: Point) -> Point:
    """The place of an element that is nearest to a point."""
    if isinstance(segment, ArcSegment):
        there = along(segment.center, direction(segment.center, at), segment.radius)
    else:
        there = foot(at, segment.start, direction(segment.start, segment.end))
    return there if is_on(segment, there) else min(segment.start, segment.end, key=lambda end: distance(end, at))


def with_coordinate(at: Point, axis: int, value: float) -> Point:
    """A place with another coordinate on one axis."""
    return (value, at[1]) if axis == 0 else (at[0], value)


def _begin(arc: ArcSegment) -> float:
    return atan2(arc.start[1] - arc.center[1], arc.start[0] - arc.center[0])


def sweep_of(arc: ArcSegment) -> float:
    """The angle travelled, radians, positive counter-clockwise; a whole turn where it ends as it begins."""
    if distance(arc.end, arc.start) <= LENGTH:
        return tau * arc.turn.sign
    end = atan2(arc.end[1] - arc.center[1], arc.end[0] - arc.center[0])
    return (((end - _begin(arc)) * arc.turn.sign) % tau or tau) * arc.turn.sign


def middle(segment: Segment) -> tuple[Point, Point]:
    """The place halfway along an element, and the direction of travel there."""
    if isinstance(segment, ArcSegment):
        return on_arc(segment, 0.5)
    between = minus(segment.end, segment.start)
    return along(segment.start, between, 0.5), unit(between)


def on_arc(arc: ArcSegment, share: float) -> tuple[Point, Point]:
    """The place after a share of an arc, and the direction of travel there."""
    angle = _begin(arc) + sweep_of(arc) * share
    spoke = cos(angle), sin(angle)
    return along(arc.center, spoke, arc.radius), (-spoke[1] * arc.turn.sign, spoke[0] * arc.turn.sign)
