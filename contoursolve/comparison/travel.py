"""The elements of a program's path in space, and the geometry of their parts.

A part of an element is told by two fractions of its way, 0 where it starts and 1 where it ends.
"""

from collections.abc import Sequence
from enum import Enum
from math import atan2, ceil, cos, hypot, inf, radians, sin, sqrt, tau

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import Length, Plane

Place = tuple[float | None, ...]
"""Coordinates in mm (X of a lathe as radius), None where not known, in the order of the path's axes."""

_SAMPLES = radians(10)
"""Radians of an arc from one point that is compared to the next."""
_PARTS = 8


class Motion(Enum):
    """Kind of the tool's motion."""

    RAPID = "rapid"
    FEED = "feed"
    THREAD = "thread"
    PRESET = "coordinate setting"
    """It stays where it is; the coordinates change."""


class Bend(Struct, frozen=True):
    """Arc of an element: the indices of its plane's axes, its centre in them (mm), and directions from there. It begins
    at `begin` and turns by `sweep` (rad), counter-clockwise positive."""

    axes: tuple[int, int]
    center: tuple[float, float]
    begin: float
    sweep: float
    radii: tuple[float, float]
    """At the start and at the end, mm; they differ by the rounding of the words."""


class Travel(Struct, frozen=True):
    """One line or arc of a program, and how its block is written: `unit` and, by axis, whether as diameter."""

    line: int
    text: str
    motion: Motion
    start: Place
    end: Place
    bend: Bend | None
    compensation: int
    is_skippable: bool
    unit: Length
    doubled: tuple[bool, ...]
    file: str = ""
    """The name of the file of the line, if it is that of a subprogram."""
    plane: Plane | None = None
    """The plane in force."""
    element: str = ""
    """The name of the element of a contour that it is."""
    number: int = 0
    """The place of its block among those that run, from 0."""
    called_at: int = 0
    """The line of the main program that calls its file, if it has one."""
    free: tuple[str, ...] = ()
    """The axes on which only steps are known: its coordinates count from a place that nobody knows."""

    def at(self, fraction: float) -> Place:
        """The point that lies at a fraction of the way."""
        if fraction in (0, 1):
            return self.end if fraction else self.start
        place = [_between(start, end, fraction) for start, end in zip(self.start, self.end, strict=True)]
        if self.bend:
            angle = self.bend.begin + self.bend.sweep * fraction
            radius = self.bend.radii[0] + (self.bend.radii[1] - self.bend.radii[0]) * fraction
            for axis, center, part in zip(self.bend.axes, self.bend.center, (cos(angle), sin(angle)), strict=True):
                place[axis] = center + radius * part
        return tuple(place)

    def moved(self, by: Sequence[float]) -> "Travel":
        """The same, some mm further along each axis."""
        start, end = (
            tuple(None if at is None else at + way for at, way in zip(place, by, strict=True))
            for place in (self.start, self.end)
        )
        bend = self.bend
        if bend is not None:
            first, second = (at + by[axis] for axis, at in zip(bend.axes, bend.center, strict=True))
            bend = replace(bend, center=(first, second))
        return replace(self, start=start, end=end, bend=bend)

    def length(self, begin: float = 0.0) -> float:
        """The length from a fraction of the way to the end, mm; infinite if the start is not known."""
        if not self.is_bounded:
            return inf
        straight = [
            end - start
            for axis, (start, end) in enumerate(zip(self.start, self.end, strict=True))
            if start is not None and end is not None and not (self.bend and axis in self.bend.axes)
        ]
        turned = abs(self.bend.sweep) * max(self.bend.radii) if self.bend else 0.0
        return hypot(turned, *straight) * (1 - begin)

    @property
    def is_bounded(self) -> bool:
        """Whether its start is known in every axis in which its end is."""
        return all(start is not None or end is None for start, end in zip(self.start, self.end, strict=True))

    @property
    def is_divisible(self) -> bool:
        """Whether several blocks in its place could make the same path. A thread would begin anew, and a rapid in
        several axes need not be straight: then every point where it stops counts."""
        moving = sum(start != end for start, end in zip(self.start, self.end, strict=True))
        return self.is_bounded and (self.motion is Motion.FEED or (self.motion is Motion.RAPID and moving == 1))

    def fraction(self, place: Place) -> float:
        """The fraction of the way at which a point lies, or its nearest point of the line or of the circle."""
        if self.bend:
            first, second = (place[axis] for axis in self.bend.axes)
            if first is None or second is None:
                return inf
            angle = atan2(second - self.bend.center[1], first - self.bend.center[0]) - self.bend.begin
            turn = 1 if self.bend.sweep > 0 else -1
            return (angle * turn) % tau / abs(self.bend.sweep)
        along, square = 0.0, 0.0
        for start, end, value in zip(self.start, self.end, place, strict=True):
            if start is not None and end is not None and value is not None:
                along += (value - start) * (end - start)
                square += (end - start) ** 2
        return along / square if square else inf

    def away(self, place: Place) -> float:
        """The distance from a point to the nearest one of the way, mm; infinite if the same axes are not known."""
        near = self.fraction(place)
        points = (self.start, self.end, *([self.at(near)] if 0 < near < 1 else []))
        return min(distance(each, place) for each in points)

    @property
    def samples(self) -> int:
        """Into how many parts its way is divided where it is compared point by point."""
        return max(_PARTS, ceil(abs(self.bend.sweep) / _SAMPLES)) if self.bend else _PARTS


class Unfollowed(Struct, frozen=True):
    """A block whose effect on the path is not followed, and why; `words` are what it says of the path."""

    line: int
    text: str
    words: tuple[str, ...]
    reason: str
    file: str = ""
    number: int = 0
    """The place of its block among those that run, from 0."""


Step = Travel | Unfollowed


def distance(one: Place, other: Place) -> float:
    """Between two points, mm; infinite where an axis is known in one of them only."""
    square = 0.0
    for first, second in zip(one, other, strict=True):
        if (first is None) != (second is None):
            return inf
        if first is not None and second is not None:
            square += (first - second) ** 2
    return sqrt(square)


def deviation(one: Travel, other: Travel, ways: Sequence[tuple[float, float]]) -> float:
    """The largest distance between two parts, mm; `ways` are the fractions at which each begins and ends.

    Arcs are compared point by point, at most 10 degrees apart: their distance changes too slowly to hide between.
    """
    parts = 1
    for travel, (begin, end) in zip((one, other), ways, strict=True):
        if travel.bend:
            parts = max(parts, ceil(abs(travel.bend.sweep) * (end - begin) / _SAMPLES), 2)
    (first, last), (begin, end) = ways
    return max(
        distance(
            one.at(last if part == parts else first + (last - first) * part / parts),
            other.at(end if part == parts else begin + (end - begin) * part / parts),
        )
        for part in range(parts + 1)
    )


def _between(start: float | None, end: float | None, fraction: float) -> float | None:
    return None if start is None or end is None else start + (end - start) * fraction
