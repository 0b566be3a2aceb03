"""Division of a range of one word until each part is decided: where all checks of a contour are passed, and where a
function is zero.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

import numpy
from numpy.typing import NDArray

from contoursolve.backends.intervals import Array, Intervals
from contoursolve.families.targets import TargetCurve

Bits = NDArray[numpy.bool_]


@dataclass(frozen=True, slots=True)
class Fineness:
    """Into how many parts each cell that is not decided is divided, how often, and the share of the word's value (at
    least of 1) below which it is left as it is."""

    parts: int
    rounds: int
    narrowest: float


STRETCHES, STRETCHES_FIRST = Fineness(64, 20, 1e-8), 64
"""For stretches, and into how many a range is divided first. One so narrow that is not decided lies at an end."""

ZEROS, FINEST, ZEROS_FIRST = Fineness(16, 24, 1e-9), Fineness(4, 24, 1e-13), 32
"""For zeros: those that are closer than the first tells apart count as one; what is not decided in a part so narrow is
divided by itself, as the second says. Into how many parts a range is divided first."""

MOST = 2048
"""Cells that are looked at together; where more are not decided, the search is given up."""

FEW = 12
"""Of no more stretches it is quicker to divide them than to bound them better."""

FEW_PARTS = 64
"""Of no more parts that are not decided it is worth while to divide each by itself."""

BISECTIONS = 64
"""From any part to neighbouring numbers."""

SAMPLES, SECTIONS = 33, 12
"""Values at which a part that is not decided is looked at, and how often what lies between two is divided so."""


def size_of(value: Array | float) -> Array:
    """The size of values, at least 1: of which shares are taken."""
    found: Array = numpy.maximum(1.0, numpy.abs(value))
    return found


def subdivide(cells: Intervals, decide: Callable[[Intervals], Intervals], fineness: Fineness) -> Intervals:
    """The narrow cells that remain of some when those that are not decided are divided again and again; `decide` gives
    those of its cells that it leaves open."""
    left = [cells[:0]]
    for number in range(fineness.rounds + 1):
        cells = decide(cells)
        widths, sizes = cells.high - cells.low, size_of(numpy.maximum(abs(cells.low), abs(cells.high)))
        is_wide = (widths > fineness.narrowest * sizes) & (number < fineness.rounds)
        if is_wide.sum() > MOST:
            is_wide[:] = False
        left.append(cells[~is_wide])
        cells = cells[is_wide]
        if not cells.low.size:
            break
        count = max(2, min(fineness.parts, MOST // cells.low.size))
        grid = cells.low[:, None] + (cells.high - cells.low)[:, None] * numpy.linspace(0.0, 1.0, count + 1)
        grid[:, -1] = cells.high
        cells = Intervals(grid[:, :-1].ravel(), grid[:, 1:].ravel())
    return Intervals(*(numpy.concatenate([getattr(each, side) for each in left]) for side in ("low", "high")))


def bisect(low: Array, high: Array, is_before: Callable[[Array], Bits], steps: int) -> tuple[Array, Array]:
    """Places on the two sides of where something ceases to hold, from those where it does and those where it does not;
    all at once."""
    for _ in range(steps if len(low) else 0):
        middle = (low + high) / 2
        here = is_before(middle)
        low, high = numpy.where(here, middle, low), numpy.where(here, high, middle)
    return low, high


def section(low: float, high: float, is_beyond: Callable[[Array], Bits]) -> tuple[float, float]:
    """Neighbouring numbers between which something first holds that does not at the lower value, but at the higher."""
    for _ in range(SECTIONS):
        places = numpy.linspace(low, high, SAMPLES)
        changed = is_beyond(places)
        changed[0], changed[-1] = False, True
        number = int(changed.argmax())
        low, high = float(places[number - 1]), float(places[number])
        if high - low <= 4 * numpy.spacing(max(abs(low), abs(high))):
            break
    return low, high


@dataclass(frozen=True, slots=True)
class Zero:
    """A zero, and whether the function rises there (1) or falls (-1); both are proven.

    With 0, nothing is proven: it is the best value of a part of this width in which the function may cross or touch
    zero, or jumps, or does neither.
    """

    value: float
    way: int
    width: float = 0.0


def find_zeros(curve: TargetCurve, low: float, high: float) -> list[Zero]:
    """The zeros between two values in order, each to the last digit of a double, and one for each part that could not
    be decided: there is no other."""
    edges, found = numpy.linspace(low, high, ZEROS_FIRST + 1), list[Zero]()
    with numpy.errstate(all="ignore"):
        left = _without_zeros(curve, Intervals(edges[:-1], edges[1:]), ZEROS, found)
        parts = _clusters(left)
        for begin, end in parts:
            rest = Intervals(numpy.array([begin]), numpy.array([end]))
            if len(parts) <= FEW_PARTS:
                rest = _without_zeros(curve, rest, FINEST, found)
            found += [Zero(_best(curve, *part), 0, part[1] - part[0]) for part in _clusters(rest)]
    return sorted(found, key=lambda each: each.value)


def _without_zeros(curve: TargetCurve, cells: Intervals, fineness: Fineness, found: list[Zero]) -> Intervals:
    """The narrow parts of cells that cannot be decided; the zeros in the others are `found`."""

    def decide(cells: Intervals) -> Intervals:
        values, is_smooth = curve.between(cells)
        may = ~((values.low > 0) | (values.high < 0))
        cells, is_smooth = cells[may], is_smooth[may]
        if not cells.low.size:
            return cells
        slopes = curve.slopes(cells)
        ways = numpy.where(is_smooth, numpy.where(slopes.low > 0, 1, numpy.where(slopes.high < 0, -1, 0)), 0)
        zeros, is_done = _crossings(curve, cells, ways)
        found.extend(zeros)
        if fineness is FINEST:
            is_done |= curve.is_void(cells)
        return cells[~is_done]

    return subdivide(cells, decide, fineness)


def _crossings(curve: TargetCurve, cells: Intervals, ways: NDArray[numpy.int64]) -> tuple[list[Zero], Bits]:
    """The zeros in cells in which the function only rises (1) or only falls (-1), by bisection of all of them at once;
    and which cells are decided. One without a value at an end is not."""
    first, last = ways * curve.at(cells.low), ways * curve.at(cells.high)
    is_done = (ways != 0) & numpy.isfinite(first) & numpy.isfinite(last)
    # A zero on the edge of two parts belongs to the left one, where both see it.
    has = is_done & ((first < 0) & (last >= 0) | (first == 0))
    ways = ways[has]
    low, high = bisect(cells.low[has], cells.high[has], lambda places: ways * curve.at(places) < 0, BISECTIONS)
    if low.size:
        high = numpy.where(numpy.abs(curve.at(low)) < numpy.abs(curve.at(high)), low, high)
    return [Zero(float(value), int(way)) for value, way in zip(high, ways, strict=True)], is_done


def _clusters(cells: Intervals) -> list[tuple[float, float]]:
    """Cells that touch, as one part."""
    parts: list[tuple[float, float]] = []
    for low, high in sorted(zip(cells.low.tolist(), cells.high.tolist(), strict=True)):
        if parts and low <= parts[-1][1]:
            parts[-1] = parts[-1][0], max(parts[-1][1], high)
        else:
            parts.append((low, high))
    return parts


def _best(curve: TargetCurve, low: float, high: float) -> float:
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
