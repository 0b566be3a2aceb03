"""Distances of elements that need not be neighbours: where a path comes nearest to the walls of a part."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import cos, dist, inf, radians, sin, sqrt

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import cross
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, extremes, is_on, way_to
from contoursolve.tolerance import LENGTH


class Gap(Struct, frozen=True):
    """The nearest places of an element of a path and of a wall, by their numbers, and their distance, mm."""

    piece: int
    wall: int
    distance: float
    at: Point
    """On the wall."""


def gaps_below(pieces: Sequence[Segment], walls: Sequence[Segment], limit: float) -> Iterator[Gap]:
    """Every pair that comes nearer than a limit, mm."""
    if not pieces or not walls:
        return
    boxes = numpy.array([_box(each) for each in walls])
    for number, piece in enumerate(pieces):
        low_one, low_two, high_one, high_two = _box(piece)
        first = numpy.maximum(boxes[:, 0] - high_one, low_one - boxes[:, 2]).clip(0)
        second = numpy.maximum(boxes[:, 1] - high_two, low_two - boxes[:, 3]).clip(0)
        for wall in numpy.flatnonzero(first * first + second * second < limit * limit):
            distance, at = nearest(piece, walls[int(wall)])
            if distance < limit:
                yield Gap(number, int(wall), distance, at)


def nearest(one: Segment, other: Segment) -> tuple[float, Point]:
    """The distance of two elements, mm, and the place on the other one: a crossing, an end, or square to both."""
    pairs = [(here, foot(other, here)) for here in _salient(one, other)]
    pairs += [(foot(one, there), there) for there in _salient(other, one)]
    pairs += [(at, at) for at in crossings(one, other) if is_on(one, at) and is_on(other, at)]
    return min((dist(here, there), there) for here, there in pairs)


def _salient(one: Segment, other: Segment) -> Iterator[Point]:
    """The places of an element that may be nearest to another one: its ends, and where it is square to the way to a
    centre."""
    yield from (one.start, one.end)
    if isinstance(other, ArcSegment):
        yield from square_to(one, other.center)


def square_to(segment: Segment, center: Point) -> Iterator[Point]:
    """The places of an element where it is square to the way to a centre."""
    if isinstance(segment, ArcSegment):
        base, unit, places = segment.center, _unit(segment.center, center), [segment.radius, -segment.radius]
    else:
        base, unit = segment.start, _unit(segment.start, segment.end)
        places = [_along(base, center, unit)]
    yield from (at for at in (ahead(base, unit, place) for place in places) if is_on(segment, at))


def split(segment: Segment, places: Iterable[Point]) -> Iterator[Segment]:
    """The parts of an element between places on it."""
    inner = sorted(places, key=lambda at: way_to(segment, at))
    if not inner:
        yield segment
        return
    for start, end in pairwise((segment.start, *inner, segment.end)):
        if dist(start, end) > LENGTH:
            yield replace(segment, start=start, end=end)


def middle_of(segment: Segment) -> LineSegment:
    """The place halfway along an element, as a line without length."""
    at = (segment.start[0] + segment.end[0]) / 2, (segment.start[1] + segment.end[1]) / 2
    if isinstance(segment, ArcSegment):
        angle = segment.turn.sign * radians(segment.sweep) / 2
        (a, b), (c, d) = segment.start, segment.center
        at = (
            c + (a - c) * cos(angle) - (b - d) * sin(angle),
            d + (a - c) * sin(angle) + (b - d) * cos(angle),
        )
    return LineSegment("", at, at)


def crossings(one: Segment, other: Segment) -> Iterator[Point]:
    """The places where the lines or circles of two elements cross."""
    if isinstance(one, ArcSegment) and isinstance(other, ArcSegment):
        apart, unit = dist(one.center, other.center), _unit(one.center, other.center)
        along = (apart**2 + one.radius**2 - other.radius**2) / (2 * apart) if apart else inf
        foot, unit, square = ahead(one.center, unit, along), (-unit[1], unit[0]), one.radius**2 - along**2
    elif isinstance(one, LineSegment) and isinstance(other, LineSegment):
        u, v = _unit(one.start, one.end), _unit(other.start, other.end)
        sine, way = cross(u, v), (other.start[0] - one.start[0], other.start[1] - one.start[1])
        foot, unit, square = ahead(one.start, u, cross(way, v) / sine) if sine else one.start, u, 0.0 if sine else -1.0
    else:
        arc, line = (one, other) if isinstance(one, ArcSegment) else (other, one)
        unit = _unit(line.start, line.end)
        foot = (
            ahead(line.start, unit, _along(line.start, arc.center, unit)) if isinstance(arc, ArcSegment) else line.end
        )
        square = arc.radius**2 - dist(foot, arc.center) ** 2 if isinstance(arc, ArcSegment) else -1.0
    if square >= 0:
        yield from (ahead(foot, unit, sign * sqrt(square)) for sign in (1, -1))


def _unit(start: Point, end: Point) -> Point:
    length = dist(start, end)
    return ((end[0] - start[0]) / length, (end[1] - start[1]) / length) if length else (1.0, 0.0)


def _along(start: Point, at: Point, unit: Point) -> float:
    return (at[0] - start[0]) * unit[0] + (at[1] - start[1]) * unit[1]


def ahead(at: Point, unit: Point, length: float) -> Point:
    """The place so far from another one in a direction."""
    return at[0] + length * unit[0], at[1] + length * unit[1]


def foot(segment: Segment, at: Point) -> Point:
    """The place of an element that is nearest to a point."""
    if isinstance(segment, ArcSegment):
        foot = ahead(segment.center, _unit(segment.center, at), segment.radius)
    else:
        unit = _unit(segment.start, segment.end)
        foot = ahead(segment.start, unit, _along(segment.start, at, unit))
    return foot if is_on(segment, foot) else min(segment.start, segment.end, key=lambda end: dist(end, at))


def _box(segment: Segment) -> tuple[float, float, float, float]:
    """The least and the largest coordinates of an element."""
    firsts, seconds = zip(*extremes(segment, 0, 1), strict=True)
    return min(firsts), min(seconds), max(firsts), max(seconds)
