"""Distances of elements that need not be neighbours: where a path comes nearest to the walls of a part."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import dist, inf, sqrt

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import cross
from contoursolve.solving import (
    ArcSegment,
    LineSegment,
    Point,
    Segment,
    along,
    direction,
    extremes,
    foot,
    foot_on,
    is_on,
    minus,
    way_to,
)
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
    pairs = [(here, foot_on(other, here)) for here in _salient(one, other)]
    pairs += [(foot_on(one, there), there) for there in _salient(other, one)]
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
        unit = direction(segment.center, center)
        places = [along(segment.center, unit, reach) for reach in (segment.radius, -segment.radius)]
    else:
        places = [foot(center, segment.start, direction(segment.start, segment.end))]
    yield from (at for at in places if is_on(segment, at))


def split(segment: Segment, places: Iterable[Point]) -> Iterator[Segment]:
    """The parts of an element between places on it."""
    inner = sorted(places, key=lambda at: way_to(segment, at))
    if not inner:
        yield segment
        return
    for start, end in pairwise((segment.start, *inner, segment.end)):
        if dist(start, end) > LENGTH:
            yield replace(segment, start=start, end=end)


def crossings(one: Segment, other: Segment) -> Iterator[Point]:
    """The places where the lines or circles of two elements cross."""
    if isinstance(one, LineSegment) and isinstance(other, LineSegment):
        unit, way = direction(one.start, one.end), direction(other.start, other.end)
        sine = cross(unit, way)
        if sine:
            yield along(one.start, unit, cross(minus(other.start, one.start), way) / sine)
        return
    if isinstance(one, LineSegment):
        yield from crossings(other, one)
        return
    if isinstance(other, LineSegment):
        unit = direction(other.start, other.end)
        at = foot(one.center, other.start, unit)
        square = one.radius**2 - dist(at, one.center) ** 2
    else:
        apart, way = dist(one.center, other.center), direction(one.center, other.center)
        reach = (apart**2 + one.radius**2 - other.radius**2) / (2 * apart) if apart else inf
        at, unit, square = along(one.center, way, reach), (-way[1], way[0]), one.radius**2 - reach**2
    if square >= 0:
        yield from (along(at, unit, sign * sqrt(square)) for sign in (1, -1))


def _box(segment: Segment) -> tuple[float, float, float, float]:
    """The least and the largest coordinates of an element."""
    firsts, seconds = zip(*extremes(segment, 0, 1), strict=True)
    return min(firsts), min(seconds), max(firsts), max(seconds)
