"""The lines that bound where a contour exists in two words, as they run on the page."""

from collections.abc import Iterable, Sequence

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.families import Boundary
from contoursolve.numeric import Array
from contoursolve.pictures.page import Box, Spot, Stroke, Text
from contoursolve.pictures.theme import Role
from contoursolve.pictures.value_axes import HIGH, LEFT, TOP, WIDE, ValuePlane

_LINE = 3.0
"""Pixels of a line; it covers the steps of the cells under it."""


_GIVE = 0.3
"""Pixels by which a point may be off a line that leaves it out."""


class PageLine(Struct, frozen=True, eq=False):
    """A line on the page: its points, and places on it a pixel apart."""

    points: Array
    spots: Array

    @property
    def length(self) -> float:
        """Pixels."""
        return float(numpy.hypot(*numpy.diff(self.spots, axis=0).T).sum())

    def stroke(self, role: Role, width: float) -> Stroke:
        """The line as it is drawn."""
        return Stroke(_spot(self.points[0]), tuple(map(_spot, self.points[1:])), role, width)


class Curve(PageLine, frozen=True, eq=False):
    """A boundary on the page, with the unit directions to its failing side at its places."""

    boundary: Boundary
    ways: Array


def curves_of(boundaries: Iterable[Boundary], chart: ValuePlane) -> list[Curve]:
    """Boundaries as they run on the page, the longest first."""
    found = [_curve(each, chart) for each in boundaries]
    return sorted((each for each in found if each.length > 0), key=lambda each: -each.length)


def line_on_page(points: Array, chart: ValuePlane) -> PageLine:
    """A line through values of both words, of shape (n, 2), as it runs on the page."""
    rough = _thinned(chart.spots(points))
    steps = numpy.concatenate([[0.0], numpy.cumsum(numpy.hypot(*numpy.diff(rough, axis=0).T))])
    along = numpy.linspace(0.0, steps[-1], max(2, int(steps[-1]) + 1))
    spots = numpy.stack([numpy.interp(along, steps, rough[:, axis]) for axis in (0, 1)], axis=1)
    return PageLine(rough, spots)


def _curve(boundary: Boundary, chart: ValuePlane) -> Curve:
    line = line_on_page(numpy.array(boundary.points), chart)
    spots = line.spots
    ways = numpy.gradient(spots, axis=0)
    sizes = numpy.hypot(ways[:, 0], ways[:, 1])
    ways = ways / numpy.where(sizes > 0, sizes, 1.0)[:, None]
    normals = numpy.stack([-ways[:, 1], ways[:, 0]], axis=1)
    middle = numpy.array(boundary.points[len(boundary.points) // 2])
    there = chart.spots(numpy.stack([middle, numpy.array(boundary.outside)]))
    nearest = int(numpy.argmin(numpy.hypot(*(spots - there[0]).T)))
    if float((there[1] - there[0]) @ normals[nearest]) < 0:
        normals = -normals
    return Curve(line.points, spots, boundary, normals)


def _thinned(points: Array) -> Array:
    """A line on the page without the points that are as good as on it."""
    kept, pending = {0, len(points) - 1}, [(0, len(points) - 1)]
    while pending:
        first, last = pending.pop()
        along, away = points[last] - points[first], points[first + 1 : last] - points[first]
        size = float(numpy.hypot(*along))
        # Of a closed line, how far from where it begins.
        off = numpy.abs(away[:, 0] * along[1] - away[:, 1] * along[0]) / size if size else numpy.hypot(*away.T)
        if off.size and off.max() > _GIVE:
            middle = first + 1 + int(off.argmax())
            kept.add(middle)
            pending += [(first, middle), (middle, last)]
    return points[sorted(kept)]


def strokes(curves: Sequence[Curve]) -> list[Stroke]:
    """The lines."""
    return [each.stroke(Role.INK, _LINE) for each in curves]


def spots_of(curves: Sequence[PageLine]) -> Array:
    """Places a pixel apart on all lines."""
    return numpy.concatenate([numpy.empty((0, 2)), *(curve.spots for curve in curves)])


def is_free(texts: Sequence[Text], boxes: Sequence[Box], spots: Array) -> bool:
    """Whether texts are clear of others and of every line."""
    for box in (each.box.grow(2.0) for each in texts):
        inside = (spots[:, 0] > box.left) & (spots[:, 0] < box.right) & (spots[:, 1] > box.top)
        if any(box.meets(other) for other in boxes) or bool((inside & (spots[:, 1] < box.bottom)).any()):
            return False
    return True


def near(curves: Sequence[Curve], rows: int, columns: int) -> NDArray[numpy.bool_]:
    """Mask of the cells of a divided plane that lie on a curve or beside such a cell, shape (rows, columns)."""
    mask = numpy.zeros((rows + 2, columns + 2), dtype=bool)
    for curve in curves:
        row = numpy.clip(((curve.spots[:, 1] - TOP) / HIGH * rows).astype(int), 0, rows - 1)
        column = numpy.clip(((curve.spots[:, 0] - LEFT) / WIDE * columns).astype(int), 0, columns - 1)
        for down, right in ((1, 1), (0, 1), (2, 1), (1, 0), (1, 2)):
            mask[row + down, column + right] = True
    return mask[1:-1, 1:-1]


def _spot(place: Array) -> Spot:
    return float(place[0]), float(place[1])
