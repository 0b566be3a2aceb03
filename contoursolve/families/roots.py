"""All zeros of a function of one word in a range: isolated by interval arithmetic, so that none is overlooked."""

from dataclasses import dataclass
from typing import Protocol

import numpy
from numpy.typing import NDArray

from contoursolve.backends.intervals import Array, Intervals

CELLS, PARTS, ROUNDS, MOST = 32, 16, 24, 2048
"""Into how many parts a range is divided first, and each part that is not decided then, how often, and of how many."""

NARROWEST = 1e-9
"""Share of the word's value (at least of 1). Zeros that are closer than this count as one."""

BISECTIONS = 64
"""From any part to neighbouring numbers."""


class Curve(Protocol):
    """A function of one word, and what it and its derivative lie between."""

    def at(self, places: Array) -> Array:
        """The values."""

    def between(self, cells: Intervals) -> tuple[Intervals, NDArray[numpy.bool_]]:
        """What the values lie between, and where nothing jumps."""

    def slopes(self, cells: Intervals) -> Intervals:
        """What the derivatives lie between."""


@dataclass(frozen=True, slots=True)
class Zero:
    """A zero, and whether the function rises there (1) or falls (-1).

    With 0, it is the middle of a part of this width in which the function touches zero, or jumps, or does neither.
    """

    value: float
    way: int
    width: float = 0.0


def find_zeros(curve: Curve, low: float, high: float) -> tuple[list[Zero], bool]:
    """The zeros between two values in order, and whether these are proven to be all."""
    edges = numpy.linspace(low, high, CELLS + 1)
    cells = Intervals(edges[:-1], edges[1:])
    found: list[Zero] = []
    is_complete = True
    with numpy.errstate(all="ignore"):
        for number in range(ROUNDS + 1):
            values, is_smooth = curve.between(cells)
            may = ~((values.low > 0) | (values.high < 0))
            cells, is_smooth = Intervals(cells.low[may], cells.high[may]), is_smooth[may]
            if not cells.low.size:
                break
            slopes = curve.slopes(cells)
            is_steady = is_smooth & ((slopes.low > 0) | (slopes.high < 0))
            steady = Intervals(cells.low[is_steady], cells.high[is_steady])
            found += _crossings(curve, steady, numpy.where(slopes.low[is_steady] > 0, 1, -1))
            cells = Intervals(cells.low[~is_steady], cells.high[~is_steady])
            sizes = numpy.maximum(1.0, numpy.maximum(numpy.abs(cells.low), numpy.abs(cells.high)))
            is_small = cells.high - cells.low <= NARROWEST * sizes
            if number == ROUNDS or (~is_small).sum() > MOST:
                is_complete, is_small = False, is_small | True
            rest = zip(cells.low[is_small], cells.high[is_small], strict=True)
            found += [Zero(float(begin + end) / 2, 0, float(end - begin)) for begin, end in rest]
            cells = Intervals(cells.low[~is_small], cells.high[~is_small])
            if not cells.low.size:
                break
            parts = max(2, min(PARTS, MOST // cells.low.size))
            grid = cells.low[:, None] + (cells.high - cells.low)[:, None] * numpy.linspace(0.0, 1.0, parts + 1)
            grid[:, -1] = cells.high
            cells = Intervals(grid[:, :-1].ravel(), grid[:, 1:].ravel())
    return sorted(found, key=lambda each: each.value), is_complete


def _crossings(curve: Curve, cells: Intervals, ways: NDArray[numpy.int64]) -> list[Zero]:
    """The zeros in parts in which the function only rises or only falls, by bisection of all of them at once."""
    low, high = cells.low.copy(), cells.high.copy()
    if not low.size:
        return []
    # A zero on the edge of two parts belongs to the left one, where both see it.
    has = (ways * curve.at(low) < 0) & (ways * curve.at(high) >= 0) | (ways * curve.at(low) == 0)
    low, high, ways = low[has], high[has], ways[has]
    for _ in range(BISECTIONS if low.size else 0):
        middle = (low + high) / 2
        is_before = ways * curve.at(middle) < 0
        low, high = numpy.where(is_before, middle, low), numpy.where(is_before, high, middle)
    return [Zero(float(value), int(way)) for value, way in zip(high, ways, strict=True)]
