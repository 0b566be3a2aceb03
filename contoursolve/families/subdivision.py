"""Division of a range of one word until each part is decided, and bisection to neighbouring numbers."""

from collections.abc import Callable

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.numeric import Array, Intervals

Bits = NDArray[numpy.bool_]


class Fineness(Struct, frozen=True):
    """Into how many parts each cell that is not decided is divided, how often, and the share of the word's value (at
    least of 1) below which it is left as it is."""

    parts: int
    rounds: int
    narrowest: float


STRETCHES, STRETCHES_FIRST = Fineness(64, 20, 1e-8), 64
"""For stretches, and into how many a range is divided first. One so narrow that is not decided lies at an end."""

MOST = 2048
"""Cells that are looked at together; where more are not decided, the search is given up."""

FEW = 12
"""Of no more stretches it is quicker to divide them than to bound them better."""

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
