"""The exact lines that bound a region of two words, each named by what fails beyond it, and the picture of a region."""

from collections.abc import Iterator, Sequence
from itertools import product

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.families import Boundary, Region
from contoursolve.numeric.columns import Array
from contoursolve.pictures.page import (
    PAD,
    SIZE,
    WIDTH,
    Anchor,
    Box,
    Dot,
    Item,
    Sheet,
    Spot,
    Stroke,
    Text,
    TextRun,
    visible,
    width_of,
    wrap,
)
from contoursolve.pictures.theme import Role
from contoursolve.pictures.value_axes import BELOW, HIGH, LEFT, TOP, WIDE, ValuePlane, axis_text, over_range, page_of

_GAP = (3.0, 3.0)
"""Pixels on and off of a line on which alone there is no contour."""

_TEETH, _TOOTH = 13.0, 7.0
"""Pixels from one tooth on the failing side to the next, and of its length."""

_ASIDE = 4.0
"""Pixels between a line and its name."""

_ALONG = (0.5, 0.35, 0.65, 0.2, 0.8, 0.08, 0.92)
"""Shares of a line at which its name is tried."""

_HIGHER = 15.0
"""Pixels from one line of a name to the next."""

_LEAST = 40.0
"""Pixels. A shorter line goes without a name where another of that name has one."""


class Curve(Struct, frozen=True, eq=False):
    """A boundary on the page: its points, places on it a pixel apart, and the unit directions to its failing side there
    (to either side for a gap)."""

    boundary: Boundary
    points: Array
    spots: Array
    ways: Array

    @property
    def length(self) -> float:
        """Pixels."""
        return float(numpy.hypot(*numpy.diff(self.spots, axis=0).T).sum())


def curves_of(region: Region, chart: ValuePlane) -> list[Curve]:
    """The boundaries of a region as they run on the page, the longest first."""
    found = [_curve(each, chart) for each in region.boundaries]
    return sorted((each for each in found if each.length > 0), key=lambda each: -each.length)


def _curve(boundary: Boundary, chart: ValuePlane) -> Curve:
    rough = chart.spots(numpy.array(boundary.points))
    steps = numpy.concatenate([[0.0], numpy.cumsum(numpy.hypot(*numpy.diff(rough, axis=0).T))])
    along = numpy.linspace(0.0, steps[-1], max(2, int(steps[-1]) + 1))
    spots = numpy.stack([numpy.interp(along, steps, rough[:, axis]) for axis in (0, 1)], axis=1)
    ways = numpy.gradient(spots, axis=0)
    sizes = numpy.hypot(ways[:, 0], ways[:, 1])
    ways = ways / numpy.where(sizes > 0, sizes, 1.0)[:, None]
    normals = numpy.stack([-ways[:, 1], ways[:, 0]], axis=1)
    if boundary.inside is not None and boundary.outside is not None and not boundary.is_gap:
        # Both are too close to the line to be told apart on the page, so that values are compared instead.
        middle = numpy.array(boundary.points[len(boundary.points) // 2])
        away = numpy.array(boundary.outside) - numpy.array(boundary.inside)
        size = numpy.ptp(numpy.stack([chart.across.values[[0, -1]], chart.up.values[[0, -1]]]), axis=1)
        away = 1e-3 * size * away / max(float(numpy.max(numpy.abs(away / size))), 1e-300)
        there = chart.spots(numpy.stack([middle, middle + away]))
        nearest = int(numpy.argmin(numpy.hypot(*(spots - there[0]).T)))
        if float((there[1] - there[0]) @ normals[nearest]) < 0:
            normals = -normals
    return Curve(boundary, rough, spots, normals)


def strokes(curves: Sequence[Curve], width: float) -> list[Stroke]:
    """The lines, so many pixels wide."""
    return [
        Stroke(
            _spot(each.points[0]),
            tuple(map(_spot, each.points[1:])),
            Role.INK,
            width,
            _GAP if each.boundary.is_gap else (),
        )
        for each in curves
    ]


def _teeth(curves: Sequence[Curve]) -> list[Stroke]:
    """Short strokes on the side of each line on which there is no contour, where nothing else tells it."""
    items = []
    for curve in curves:
        count = 0 if curve.boundary.is_gap or curve.boundary.outside is None else max(1, round(curve.length / _TEETH))
        for number in range(count):
            place = int((number + 0.5) / count * (len(curve.spots) - 1))
            end = curve.spots[place] + _TOOTH * curve.ways[place]
            items.append(Stroke(_spot(curve.spots[place]), (_spot(end),), Role.INK, 1.0))
    return items


def names_of(
    curves: Sequence[Curve], chart: ValuePlane, taken: Sequence[Box], others: Sequence[Stroke] = ()
) -> tuple[list[Text], list[str]]:
    """The names of lines beside them, where there is room, clear of texts that are there, and if it goes of other
    strokes; and the names that are nowhere."""
    everywhere = _spots_of(curves)
    crowded = numpy.concatenate([everywhere, *map(_along, others)])
    texts: list[Text] = []
    boxes = list(taken)
    missing: list[str] = []
    for curve in curves:
        name = visible(curve.boundary.reason.text)
        if any(name == each.words for each in texts) and curve.length < _LEAST:
            continue
        tried = (
            each
            for spots in (crowded, everywhere)
            for each in _places(curve, name)
            if _is_free(each, chart, boxes, spots)
        )
        found = next(tried, None)
        if found is None:
            missing.append(name)
            continue
        texts += found
        boxes += [each.box for each in found]
    return texts, list(dict.fromkeys(missing))


def _spots_of(curves: Sequence[Curve]) -> Array:
    """Places a pixel apart on all lines."""
    return numpy.concatenate([numpy.empty((0, 2)), *(curve.spots for curve in curves)])


def _along(stroke: Stroke) -> Array:
    """Places on a straight stroke, a few pixels apart."""
    end = stroke.steps[-1]
    ends = numpy.array([stroke.start, end if isinstance(end, tuple) else end.end])
    shares = numpy.linspace(0.0, 1.0, 2 + int(numpy.hypot(*(ends[1] - ends[0])) / _ASIDE))[:, None]
    found: Array = ends[0] * (1 - shares) + ends[1] * shares
    return found


def _places(curve: Curve, name: str) -> Iterator[list[Text]]:
    """The name of a line on its failing side, else on the other, in one line or two, at several places."""
    halves = wrap(name, 0.6 * width_of(name, SIZE), SIZE, 2)
    # Both sides of a gap are alike, so that there the middle comes first.
    orders = [(side, share) for share in _ALONG for side in (1.0, -1.0)]
    for lines, farther, (side, share) in sorted(
        product(([name], halves), (0.0, _HIGHER), orders), key=lambda each: not curve.boundary.is_gap and each[2][0] < 0
    ):
        wide = max(width_of(each, SIZE) for each in lines)
        high = _HIGHER * len(lines)
        place = int(share * (len(curve.spots) - 1))
        way = side * curve.ways[place]
        off = abs(way[0]) * wide / 2 + abs(way[1]) * high / 2 + _ASIDE + farther
        x, y = (float(each) for each in curve.spots[place] + off * way)
        yield [
            Text((x, y - high / 2 + SIZE + _HIGHER * number), (TextRun(each, Role.INK),), SIZE, Anchor.MIDDLE)
            for number, each in enumerate(lines)
        ]


def _is_free(texts: Sequence[Text], chart: ValuePlane, boxes: Sequence[Box], spots: Array) -> bool:
    """Whether texts lie in the plane, clear of other texts and of every line."""
    for box in (each.box.grow(2.0) for each in texts):
        if not chart.box.holds(box) or any(box.meets(other) for other in boxes):
            return False
        inside = (spots[:, 0] > box.left) & (spots[:, 0] < box.right) & (spots[:, 1] > box.top)
        if bool((inside & (spots[:, 1] < box.bottom)).any()):
            return False
    return True


def near(curves: Sequence[Curve], rows: int, columns: int) -> NDArray[numpy.bool_]:
    """Which cells of a plane that is divided into some are on a line, or beside one that is."""
    mask = numpy.zeros((rows + 2, columns + 2), dtype=bool)
    for curve in curves:
        row = numpy.clip(((curve.spots[:, 1] - TOP) / HIGH * rows).astype(int), 0, rows - 1)
        column = numpy.clip(((curve.spots[:, 0] - LEFT) / WIDE * columns).astype(int), 0, columns - 1)
        for down, right in ((1, 1), (0, 1), (2, 1), (1, 0), (1, 2)):
            mask[row + down, column + right] = True
    return mask[1:-1, 1:-1]


def _spot(place: Array) -> Spot:
    return float(place[0]), float(place[1])


# Regions -----------------------------------------------------------------------------------------------------

_LINE = 2.0
"""Pixels of a line that bounds the region."""


def _title(region: Region) -> str:
    """What a region shows."""
    words = " and ".join(region.words)
    if not region.boundaries:
        return f"{words}: {'a' if region.exists else 'no'} contour everywhere"
    proof = "" if region.is_complete else " (that these are all lines is not proven)"
    return f"{words}: where the contour exists{proof}"


def lay_out_region(region: Region, title: str | None) -> Sheet:
    """The page of a region."""
    first, second = map(axis_text, region.words, region.units)
    chart = ValuePlane((first, second), *(over_range(low, high) for low, high in region.within))
    curves = curves_of(region, chart)
    rough = _teeth(curves)
    stated = _stated(region, chart, curves)
    names, missing = names_of(curves, chart, [each.box for each in stated if isinstance(each, Text)], rough)
    items: list[Item] = [*strokes(curves, _LINE), *rough, *chart.axes(), *stated, *names]
    remarks = ["teeth: there is no contour on this side"] if any(not e.boundary.is_gap for e in curves) else []
    if any(each.boundary.is_gap for each in curves):
        remarks.append("dotted: there is none on the line alone")
    if missing:
        remarks.append(f"lines without room for a name: {', '.join(missing)}")
    told = [(each, Role.MUTED) for each in wrap("; ".join(remarks), WIDTH - 2 * PAD, SIZE, 3)]
    return page_of(title if title is not None else _title(region), items, told, TOP + HIGH + BELOW, 4.0)


def _stated(region: Region, chart: ValuePlane, curves: Sequence[Curve]) -> list[Item]:
    """The values that the block has, where they are in the plane."""
    if not all(low <= value <= high for value, (low, high) in zip(region.stated, region.within, strict=True)):
        return []
    ((x, y),) = chart.spots(numpy.array([region.stated])).tolist()
    words = " ".join(f"{word}{value:g}" for word, value in zip(region.words, region.stated, strict=True))
    told = (TextRun(visible(words), Role.GIVEN),)
    places = [
        Text((x + side, y + down), told, SIZE, anchor)
        for down in (-7.0, 16.0)
        for side, anchor in ((7.0, Anchor.START), (-7.0, Anchor.END))
    ]
    spots = _spots_of(curves)
    label = next((each for each in places if _is_free([each], chart, (), spots)), places[0])
    return [Dot((x, y), 4.0, Role.GIVEN), label]
