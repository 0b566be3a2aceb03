"""All zeros of a function of one word in a range: isolated by interval arithmetic, so that none is overlooked, and
each then brought to the last digit of a double."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Protocol

import numpy
from numpy.typing import NDArray

from contoursolve.backends.intervals import Array, Intervals

CELLS, PARTS, ROUNDS, MOST = 32, 16, 24, 2048
"""Into how many parts a range is divided first, and each part that is not decided then, how often, and of how many."""

NARROWEST, FINEST = 1e-9, 1e-13
"""Share of the word's value (at least of 1). Zeros that are closer than the first count as one; what is not decided
in a part so narrow is divided by itself, down to the second."""

FINER = 4
"""Into how many parts each part of what is so narrow is divided."""

FEW = 64
"""Of no more parts that are not decided it is worth while to divide each by itself."""

BISECTIONS = 64
"""From any part to neighbouring numbers."""

SAMPLES, SECTIONS = 33, 12
"""Values at which a part that is not decided is looked at, and how often what lies about the least of them is."""


class Curve(Protocol):
    """A function of one word, and what it and its derivative lie between."""

    def at(self, places: Array) -> Array:
        """The values."""

    def between(self, cells: Intervals) -> tuple[Intervals, NDArray[numpy.bool_]]:
        """What the values lie between, and where nothing jumps."""

    def slopes(self, cells: Intervals) -> Intervals:
        """What the derivatives lie between."""

    def is_void(self, cells: Intervals) -> NDArray[numpy.bool_]:
        """Where there is no contour for certain, so that no zero counts."""


@dataclass(frozen=True, slots=True)
class Zero:
    """A zero, and whether the function rises there (1) or falls (-1); both are proven.

    With 0, nothing is proven: it is the best value of a part of this width in which the function may cross or touch
    zero, or jumps, or does neither.
    """

    value: float
    way: int
    width: float = 0.0


def find_zeros(curve: Curve, low: float, high: float) -> list[Zero]:
    """The zeros between two values in order, and one for each part that could not be decided: there is no other."""
    edges = numpy.linspace(low, high, CELLS + 1)
    with numpy.errstate(all="ignore"):
        found, left = _divided(curve, Intervals(edges[:-1], edges[1:]), PARTS, NARROWEST)
        parts = list(_clusters(left))
        for begin, end in parts:
            rest = Intervals(numpy.array([begin]), numpy.array([end]))
            if len(parts) <= FEW:
                zeros, rest = _divided(curve, rest, FINER, FINEST)
                found += zeros
            found += [Zero(_best(curve, *part), 0, part[1] - part[0]) for part in _clusters(rest)]
    return sorted(found, key=lambda each: each.value)


def size_of(value: Array | float) -> Array:
    """The size of values, at least 1: of which shares are taken."""
    found: Array = numpy.maximum(1.0, numpy.abs(value))
    return found


def _divided(curve: Curve, cells: Intervals, parts: int, narrowest: float) -> tuple[list[Zero], Intervals]:
    """The zeros in cells that can be decided, and the parts that cannot, as narrow as they are made."""
    found: list[Zero] = []
    left = [Intervals(cells.low[:0], cells.high[:0])]
    for number in range(ROUNDS + 1):
        values, is_smooth = curve.between(cells)
        may = ~((values.low > 0) | (values.high < 0))
        cells, is_smooth = Intervals(cells.low[may], cells.high[may]), is_smooth[may]
        if not cells.low.size:
            break
        slopes = curve.slopes(cells)
        ways = numpy.where(is_smooth, numpy.where(slopes.low > 0, 1, numpy.where(slopes.high < 0, -1, 0)), 0)
        zeros, is_done = _crossings(curve, cells, ways)
        found += zeros
        if narrowest == FINEST:
            is_done |= curve.is_void(cells)
        cells = Intervals(cells.low[~is_done], cells.high[~is_done])
        is_small = cells.high - cells.low <= narrowest * size_of(numpy.maximum(abs(cells.low), abs(cells.high)))
        if number == ROUNDS or (~is_small).sum() > MOST:
            is_small = is_small | True
        left.append(Intervals(cells.low[is_small], cells.high[is_small]))
        cells = Intervals(cells.low[~is_small], cells.high[~is_small])
        if not cells.low.size:
            break
        count = max(2, min(parts, MOST // cells.low.size))
        grid = cells.low[:, None] + (cells.high - cells.low)[:, None] * numpy.linspace(0.0, 1.0, count + 1)
        grid[:, -1] = cells.high
        cells = Intervals(grid[:, :-1].ravel(), grid[:, 1:].ravel())
    return found, Intervals(*(numpy.concatenate([getattr(each, side) for each in left]) for side in ("low", "high")))


def _crossings(curve: Curve, cells: Intervals, ways: NDArray[numpy.int64]) -> tuple[list[Zero], NDArray[numpy.bool_]]:
    """The zeros in cells in which the function only rises (1) or only falls (-1), by bisection of all of them at once;
    and which cells are decided. One without a value at an end is not."""
    low, high = cells.low.copy(), cells.high.copy()
    first, last = ways * curve.at(low), ways * curve.at(high)
    is_done = (ways != 0) & numpy.isfinite(first) & numpy.isfinite(last)
    # A zero on the edge of two parts belongs to the left one, where both see it.
    has = is_done & ((first < 0) & (last >= 0) | (first == 0))
    low, high, ways = low[has], high[has], ways[has]
    for _ in range(BISECTIONS if low.size else 0):
        middle = (low + high) / 2
        is_before = ways * curve.at(middle) < 0
        low, high = numpy.where(is_before, middle, low), numpy.where(is_before, high, middle)
    if low.size:
        high = numpy.where(numpy.abs(curve.at(low)) < numpy.abs(curve.at(high)), low, high)
    return [Zero(float(value), int(way)) for value, way in zip(high, ways, strict=True)], is_done


def _clusters(cells: Intervals) -> Iterator[tuple[float, float]]:
    """Cells that touch, as one part."""
    begin = end = None
    for low, high in sorted(zip(cells.low.tolist(), cells.high.tolist(), strict=True)):
        if begin is not None and end is not None and low <= end:
            end = max(end, high)
            continue
        if begin is not None and end is not None:
            yield begin, end
        begin, end = low, high
    if begin is not None and end is not None:
        yield begin, end


def _best(curve: Curve, low: float, high: float) -> float:
    """Where the function changes its sign between two values, or else is nearest to zero; the middle where it has no
    value."""
    found = (low + high) / 2
    for _ in range(SECTIONS):
        places = numpy.linspace(low, high, SAMPLES)
        values = curve.at(places)
        if not numpy.isfinite(values).any():
            break
        signs = numpy.sign(values)
        changes = numpy.flatnonzero(signs[1:] * signs[:-1] < 0)
        least = int(numpy.nanargmin(numpy.where(numpy.isfinite(values), numpy.abs(values), numpy.nan)))
        found = float(places[least])
        around = (changes[0], changes[0] + 1) if changes.size else (max(least - 1, 0), min(least + 1, SAMPLES - 1))
        low, high = float(places[around[0]]), float(places[around[1]])
        if not isfinite(high - low) or high <= low:
            break
    return found
