"""Where on a range of one word all checks of a contour are passed, by division into stretches that are proven."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy
from numpy.typing import NDArray

from contoursolve.backends.intervals import Array, Intervals
from contoursolve.families.margins import Margins

NARROWEST = 1e-8
"""Share of the word's value (at least of 1). A stretch this narrow that is not decided lies at an end."""

CELLS, PARTS, ROUNDS = 64, 64, 20
"""Into how many stretches a range is divided first, and each one that is not decided then, and how often."""

MOST = 2048
"""Stretches that are looked at together; where more are not decided, each is halved only."""

FEW = 12
"""Of no more stretches it is quicker to divide them than to bound them better."""

DEPTH = 1
"""How often what is left is tried by itself."""

WIDE = 2_000.0
"""A range wider than this is divided by decades about zero."""

PLACES, LEVEL = 64, 1e-10
"""A margin of less than this, mm, at so many places drawn at random is zero for all values of the word: the checks are
analytic between the few places where a direction turns."""


@dataclass(frozen=True, slots=True)
class Stretch:
    """Part of a range: all checks are passed (True), or one fails everywhere (False), or that is not decided."""

    low: float
    high: float
    is_passed: bool | None


def divide(
    margins: Margins, fixed: Sequence[float], low: float, high: float, *, near: Sequence[float] = (), depth: int = 0
) -> list[Stretch]:
    """Stretches from `low` to `high` in order, neighbours of one kind joined. Those that are not decided are narrow,
    unless the search was given up. `near` are values at which to divide first."""
    cells = _first(low, high, near)
    lows, highs = cells[:-1], cells[1:]
    is_level = find_level(margins, fixed, low, high)
    done: list[tuple[Array, Array, NDArray[numpy.int8]]] = []
    for number in range(ROUNDS + 1):
        kinds = _judged(margins, fixed, Intervals(lows, highs), is_level)
        sizes = numpy.maximum(1.0, numpy.maximum(numpy.abs(lows), numpy.abs(highs)))
        is_left = (kinds < 0) & (highs - lows > NARROWEST * sizes) & (number < ROUNDS)
        if is_left.sum() > MOST:
            is_left[:] = False
        done.append((lows[~is_left], highs[~is_left], kinds[~is_left]))
        lows, highs = lows[is_left], highs[is_left]
        if not lows.size:
            break
        parts = max(2, min(PARTS, MOST // lows.size))
        grid = lows[:, None] + (highs - lows)[:, None] * numpy.linspace(0.0, 1.0, parts + 1)
        grid[:, -1] = highs
        lows, highs = grid[:, :-1].ravel(), grid[:, 1:].ravel()
    found = _joined(*(numpy.concatenate(each) for each in zip(*done, strict=True)))
    if depth == DEPTH or len(found) == 1:
        return found
    # What is zero everywhere may be so on a part only.
    return [
        part
        for each in found
        for part in (
            divide(margins, fixed, each.low, each.high, depth=depth + 1)
            if each.is_passed is None and each.high - each.low > (high - low) / CELLS
            else [each]
        )
    ]


def find_level(margins: Margins, fixed: Sequence[float], low: float, high: float) -> NDArray[numpy.bool_]:
    """Which margins are zero for all values of a range."""
    places = numpy.random.default_rng(PLACES).uniform(low, high, PLACES)
    found: NDArray[numpy.bool_] = numpy.max(numpy.abs(margins.chart.at([places], fixed)), axis=1) <= LEVEL
    return found


def _judged(
    margins: Margins, fixed: Sequence[float], cells: Intervals, is_level: NDArray[numpy.bool_]
) -> NDArray[numpy.int8]:
    """1 where all checks are passed, 0 where one fails, -1 where that is open."""
    bounds = margins.chart.between([cells], fixed)
    passes, fails = margins.verdicts(bounds, is_level)
    kinds = numpy.where(passes, 1, numpy.where(fails, 0, -1)).astype(numpy.int8)
    is_open = (kinds < 0) & bounds.is_smooth
    if is_open.sum() > FEW:
        part = Intervals(cells.low[is_open], cells.high[is_open])
        passes, fails = margins.verdicts(margins.chart.narrowed(bounds[is_open], [part], fixed), is_level)
        kinds[is_open] = numpy.where(passes, 1, numpy.where(fails, 0, -1))
    return kinds


def _first(low: float, high: float, near: Sequence[float]) -> Array:
    """Where a range is divided first."""
    if high - low <= WIDE:
        cells = numpy.linspace(low, high, CELLS + 1)
    else:
        decades = numpy.logspace(-2, 6, CELLS + 1)
        cells = numpy.concatenate([-decades[::-1], [0.0], decades])
    cells = numpy.concatenate([cells, near])
    inner = cells[(cells > low) & (cells < high)]
    return numpy.unique(numpy.concatenate([[low], inner, [high]]))


def _joined(lows: Array, highs: Array, kinds: NDArray[numpy.int8]) -> list[Stretch]:
    order = numpy.argsort(lows, kind="stable")
    lows, highs, kinds = lows[order], highs[order], kinds[order]
    begins = numpy.flatnonzero(numpy.concatenate([[True], kinds[1:] != kinds[:-1]]))
    ends = numpy.append(begins[1:], kinds.size) - 1
    return [
        Stretch(float(lows[begin]), float(highs[end]), {1: True, 0: False}.get(int(kinds[begin])))
        for begin, end in zip(begins, ends, strict=True)
    ]
