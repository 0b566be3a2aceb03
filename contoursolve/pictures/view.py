"""From mm to pixels: which part of a drawing is shown, and how large."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf

from contoursolve.pictures.scene import Aligned, Angle, Kind, Leader, Linear, Ordinate, Scene, Weight
from contoursolve.pictures.sheet import Spot
from contoursolve.pictures.theme import Role
from contoursolve.pictures.vectors import extent
from contoursolve.solving import Point

MOST_TIMES = 3.0
"""How many times as large as what it is about a picture may become for the sake of what stands beside."""

MOST_TIMES_WRONG = 12.0
"""The same for the sake of what is wrong, which is what such a picture is about."""

_ROUNDING = 1.001


@dataclass(frozen=True, slots=True)
class View:
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
class Span:
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


def span_of(scene: Scene) -> Span:
    """What a picture must show: the path and its points, and as much else as does not make the path small."""
    must: list[Point] = []
    for trail in scene.trails:
        if trail.weight is not Weight.GHOST:
            must += [at for segment in trail.segments for at in extent(segment)]
    must += [mark.at for mark in scene.marks if mark.kind not in (Kind.CENTER, Kind.OTHER)]
    more: list[Point] = [mark.at for mark in scene.marks]
    wrong: list[Point] = []
    for dimension in scene.dimensions:
        if isinstance(dimension, Aligned | Linear):
            more += [dimension.start, dimension.end]
        elif isinstance(dimension, Ordinate | Angle | Leader):
            more.append(dimension.at)
        if isinstance(dimension, Aligned) and dimension.role is Role.CONFLICTING:
            wrong += [dimension.start, dimension.end]
    for thin in scene.thins:
        more += [thin.start] if thin.is_endless else [thin.start, thin.end]
    for trail in scene.trails:
        more += [at for segment in trail.segments for at in extent(segment)]
    for ring in scene.rings:
        (wrong if ring.role is Role.CONFLICTING else more).extend(
            (ring.center[0] + ring.radius * x, ring.center[1] + ring.radius * y)
            for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))
        )
    own = _around(must or more or wrong or [(0.0, 0.0)])
    reach = max(*own.size, 1e-9)
    if max(own.size) <= 0:
        reach = max(*_around([*must, *more, *wrong]).size, 1e-9)
    near = [*_near(more, own, reach, MOST_TIMES), *_near(wrong, own, reach, MOST_TIMES_WRONG)]
    return _around([*(must or more[:1] or wrong[:1] or [(0.0, 0.0)]), *near])


def _near(points: Iterable[Point], own: Span, reach: float, times: float) -> list[Point]:
    """The points in a rectangle that is so many times as large."""
    room = reach * (times - 1) / 2 * _ROUNDING
    return [
        at
        for at in points
        if own.low[0] - room <= at[0] <= own.high[0] + room and own.low[1] - room <= at[1] <= own.high[1] + room
    ]


def _around(points: Iterable[Point]) -> Span:
    low, high = [inf, inf], [-inf, -inf]
    for at in points:
        for axis in (0, 1):
            low[axis], high[axis] = min(low[axis], at[axis]), max(high[axis], at[axis])
    return Span((low[0], low[1]), (high[0], high[1]))
