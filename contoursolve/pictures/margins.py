"""How large a drawing is on its page, and what stands around it: distances in rows, coordinates at the edges."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from contoursolve.model import FIRST, SECOND
from contoursolve.pictures.canvas import SIZE, Canvas
from contoursolve.pictures.frame import WIDTH
from contoursolve.pictures.metrics import width_of
from contoursolve.pictures.rows import (
    FIRST_ROW,
    PITCH,
    Side,
    draw_coordinates,
    draw_distances,
    is_nothing,
    side_of,
    stack,
)
from contoursolve.pictures.scene import Linear, Ordinate, Scene
from contoursolve.pictures.sheet import Box
from contoursolve.pictures.view import Span, View, span_of

_TALLEST, _LOWEST = 350.0, 110.0
"""Pixels of the drawing itself, without what stands in its margins."""

_MARGIN_X, _MARGIN_Y = 84.0, 40.0
"""Pixels around the drawing for labels of points."""

_COORDINATES = 18.0
"""Pixels that coordinates take beyond the rows."""

_UNDER_AXIS = 16.0
"""Pixels under the axis about which the work turns, where all else stands above it."""

_SIDES = (Side(FIRST, -1), Side(FIRST, 1), Side(SECOND, -1), Side(SECOND, 1))

Stacked = Mapping[Side, Sequence[tuple[Linear, int]]]


@dataclass(frozen=True, slots=True)
class Plan:
    """Where the drawing is, its rows of distances, and its coordinates with the edges at which they are written.

    `outer` is where each edge of the drawing is on the page.
    """

    view: View
    frame: Box
    stacked: Stacked
    coordinates: Mapping[Side, Sequence[Ordinate]]
    outer: Mapping[Side, float]

    def rows(self, side: Side) -> int:
        """How many rows stand along an edge."""
        return _count(self.stacked, side)


def arrange(scene: Scene, top: float) -> Plan:
    """The plan of a drawing that begins at `top` on its page."""
    own = span_of(scene)
    span = _with_turning_axis(scene, own)
    linear = [each for each in scene.dimensions if isinstance(each, Linear) and not is_nothing(each)]
    by_side = {side: [each for each in linear if side_of(each, own) == side] for side in _SIDES}
    coordinates = _edges([each for each in scene.dimensions if isinstance(each, Ordinate)], by_side, own)
    wide = {sign: _wide(by_side, coordinates, Side(SECOND, sign)) for sign in (-1, 1)}
    room = WIDTH - wide[-1] - wide[1]
    scale = min(
        room / span.size[FIRST] if span.size[FIRST] > 0 else float("inf"),
        _TALLEST / span.size[SECOND] if span.size[SECOND] > 0 else float("inf"),
    )
    scale = scale if scale < float("inf") else 1.0
    flat = View((0.0, 0.0), scale, (0.0, 0.0))
    stacked = {side: stack(each, flat) for side, each in by_side.items()}
    high = {sign: _high(stacked, coordinates, Side(FIRST, sign)) for sign in (-1, 1)}
    # Above the axis there may be room for the rows below the path.
    is_above = (own.low[SECOND] - span.low[SECOND]) * scale >= high[-1]
    low = own.low[SECOND] if is_above else span.low[SECOND]
    below = _UNDER_AXIS if is_above else high[-1]
    tall = max(span.size[SECOND] * scale, _LOWEST) if scene.trails or scene.dimensions else 0.0
    view = View(span.middle, scale, (wide[-1] + room / 2, top + high[1] + tall / 2))
    left, bottom = view.place((span.low[FIRST], low))
    right, upper = view.place(span.high)
    return Plan(
        view,
        Box(4.0, top, WIDTH - 4.0, top + high[1] + tall + below),
        stacked,
        coordinates,
        {Side(FIRST, 1): upper, Side(FIRST, -1): bottom, Side(SECOND, -1): left, Side(SECOND, 1): right},
    )


def draw_margins(canvas: Canvas, plan: Plan) -> None:
    """Distances and coordinates along all edges."""
    for side in _SIDES:
        draw_distances(canvas, plan.stacked[side], side, plan.outer[side])
    for side in _SIDES:
        # Up on the page is less.
        outward = side.sign if side.axis != FIRST else -side.sign
        rows = plan.rows(side)
        level = plan.outer[side] + outward * (FIRST_ROW + PITCH * rows - (0.0 if rows else 4.0))
        draw_coordinates(canvas, plan.coordinates[side], side.axis, side.sign, level)


def _with_turning_axis(scene: Scene, span: Span) -> Span:
    """The rectangle with the axis about which the work turns, where that is near."""
    low = span.low[SECOND]
    reach = max(*span.size, 1e-9) * 0.3
    if scene.has_turning_axis and 0 < low <= reach:
        return Span((span.low[FIRST], 0.0), span.high)
    return span


def _edges(
    ordinates: Sequence[Ordinate], by_side: Mapping[Side, Sequence[Linear]], span: Span
) -> dict[Side, list[Ordinate]]:
    """Coordinates by the edge at which they are written: where there are fewer distances, else where the points are."""
    found: dict[Side, list[Ordinate]] = {side: [] for side in _SIDES}
    for axis in (FIRST, SECOND):
        own = [each for each in ordinates if each.axis == axis]
        less, more = (len(by_side[Side(axis, sign)]) for sign in (-1, 1))
        mean = sum(each.at[1 - axis] for each in own) / len(own) if own else 0.0
        is_upper = mean > span.middle[1 - axis] if less == more else less > more
        found[Side(axis, 1 if is_upper else -1)] = own
    return found


def _wide(
    by_side: Mapping[Side, Sequence[Linear]], coordinates: Mapping[Side, Sequence[Ordinate]], side: Side
) -> float:
    """Pixels to the left or right of a drawing."""
    columns = PITCH * len(by_side[side])
    texts = [width_of(each.text, SIZE) for each in coordinates[side]]
    return max(_MARGIN_X + (columns + 16.0 if columns else 0.0), max(texts, default=0.0) + 34.0 + columns)


def _high(stacked: Stacked, coordinates: Mapping[Side, Sequence[Ordinate]], side: Side) -> float:
    """Pixels above or below a drawing."""
    high = max(_MARGIN_Y, FIRST_ROW + PITCH * _count(stacked, side) + 4.0)
    return high + (_COORDINATES if coordinates[side] else 0.0)


def _count(stacked: Stacked, side: Side) -> int:
    return max((row for _, row in stacked[side]), default=-1) + 1
