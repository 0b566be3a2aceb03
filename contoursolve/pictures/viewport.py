"""From mm to pixels: which part of a drawing is shown, and how large."""

from collections.abc import Iterable
from dataclasses import dataclass

from contoursolve.pictures.page import Spot
from contoursolve.pictures.scene import (
    Aligned,
    LinearDimension,
    Mark,
    MarkKind,
    Ring,
    Scene,
    Slide,
    Thin,
    Trail,
    Weight,
)
from contoursolve.pictures.theme import Role
from contoursolve.pictures.vectors import ALONG_AXIS, along, extent
from contoursolve.solving import Point

MOST_TIMES = 3.0
"""How many times as large as what it is about a picture may become for the sake of what stands beside."""

MOST_TIMES_WRONG = 12.0
"""The same for the sake of what is wrong, which is what such a picture is about."""

_ROUNDING = 1.001


@dataclass(frozen=True, slots=True)
class Viewport:
    """The rectangle of the plane that is shown (mm), pixels in a mm, and where its middle is on the page."""

    middle: Point
    scale: float
    spot: Spot

    def place(self, at: Point) -> Spot:
        """Where a point is on the page."""
        return (
            self.spot[0] + (at[0] - self.middle[0]) * self.scale,
            self.spot[1] - (at[1] - self.middle[1]) * self.scale,
        )


@dataclass(frozen=True, slots=True)
class Rectangle:
    """An upright rectangle in mm."""

    low: Point
    high: Point

    @property
    def size(self) -> Point:
        """Width and height."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]

    @property
    def middle(self) -> Point:
        """Its middle."""
        return (self.low[0] + self.high[0]) / 2, (self.low[1] + self.high[1]) / 2


def bounds_of(scene: Scene) -> Rectangle:
    """What a picture must show: the path and its points, and as much else as does not make the path small."""
    must: list[Point] = []
    more: list[Point] = []
    wrong: list[Point] = []
    for part in scene.parts:
        if isinstance(part, Trail):
            points = [at for segment in part.segments for at in extent(segment)]
            (more if part.weight is Weight.GHOST else must).extend(points)
        elif isinstance(part, Mark):
            (more if part.kind in (MarkKind.CENTER, MarkKind.OTHER) else must).append(part.at)
        elif isinstance(part, Ring):
            ends = (along(part.center, way, sign * part.radius) for way in ALONG_AXIS for sign in (1, -1))
            (wrong if part.role is Role.CONFLICTING else more).extend(ends)
        elif isinstance(part, Thin | LinearDimension | Aligned):
            more += [part.start] if isinstance(part, Thin) and part.is_endless else [part.start, part.end]
            if isinstance(part, Aligned) and part.role is Role.CONFLICTING:
                wrong += [part.start, part.end]
        elif not isinstance(part, Slide):
            more.append(part.at)
    everything = [*must, *more, *wrong] or [(0.0, 0.0)]
    own = _around(must or more or everything)
    reach = max(*(own if max(own.size) > 0 else _around(everything)).size, 1e-9)
    near = [*_near(more, own, reach, MOST_TIMES), *_near(wrong, own, reach, MOST_TIMES_WRONG)]
    return _around([*must, *near] or [(0.0, 0.0)])


def _near(points: Iterable[Point], own: Rectangle, reach: float, times: float) -> list[Point]:
    """The points in a rectangle that is so many times as large."""
    room = reach * (times - 1) / 2 * _ROUNDING
    return [at for at in points if all(own.low[n] - room <= at[n] <= own.high[n] + room for n in (0, 1))]


def _around(points: Iterable[Point]) -> Rectangle:
    across, up = zip(*points, strict=True)
    return Rectangle((min(across), min(up)), (max(across), max(up)))
