"""Isolation of the zeros of a function of one word: pieces of an interval that are proven to be free of any, by
interval arithmetic with outward rounding, and in the narrow rest the zeros themselves, each to neighbouring doubles.
"""

from collections.abc import Iterator, Sequence
from typing import Protocol

import numpy
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve.numeric import SECTIONS, Array, Intervals, section

Bits = NDArray[numpy.bool_]
Signs = NDArray[numpy.int8]
"""1 above zero, -1 below, `VOID` where no zero counts; 0 is not decided."""

VOID = 2


class Fineness(Struct, frozen=True):
    """Parts into which each cell that is not decided is divided, how often at most, and the share of the word's value
    (at least of 1) below which a cell is left as it is."""

    parts: int
    rounds: int
    narrowest: float


class Function(Protocol):
    """Function of one word, with bounds that hold for whole cells of its values."""

    fineness: Fineness
    finer: Fineness
    """The fineness for what is not decided, by itself."""

    def at(self, places: Array) -> Array:
        """Values; NaN for none. Zero counts as above."""

    def signs(self, cells: Intervals) -> Signs:
        """Signs that the values have in all of each cell, for certain."""

    def ways(self, cells: Intervals) -> Signs:
        """1 for cells in which the values only rise and do not jump, -1 where they only fall, for certain; else 0."""

    def part(self, low: float, high: float) -> "Function":
        """The function for what is not decided between two values."""


class Piece(Struct, frozen=True):
    """Part of an interval: proven to be free of zeros, with the sign there, or not decided (0)."""

    low: float
    high: float
    sign: int


class Zero(Struct, frozen=True):
    """Zero, or a place where one may be: with `way` 1 the function rises through it, with -1 it falls. `width` is that
    of the piece that is not decided around it; 0 where the zero is proven to be the only one of its cell.

    `value` is the double nearest to it, `before` and `after` are doubles on its two sides. With `way` 0 nothing is
    found but the value at which the function is nearest to zero.
    """

    value: float
    way: int
    before: float
    after: float
    width: float = 0.0


class Isolation(Struct, frozen=True):
    """Pieces of an interval in order, neighbours of one sign joined, and its zeros in order: outside of what is not
    decided there is no other."""

    pieces: tuple[Piece, ...]
    zeros: tuple[Zero, ...]


FIRST, WIDE = 64, 2_000.0
"""Cells into which an interval is divided first; by decades about zero where it is wider than this."""

MOST = 2048
"""Cells that are looked at together; where more are not decided, the search is given up."""

FEW_PARTS = 64
"""Of no more parts that are not decided it is worth while to divide each by itself."""

SAMPLES = 33
"""Values at which a part that is not decided is looked at."""

BISECTIONS = 64
"""From any cell to neighbouring doubles."""


def isolate(function: Function, low: float, high: float, *, near: Sequence[float] = ()) -> Isolation:
    """The zeros of a function between two values, and the pieces that are free of any. `near` are values at which to
    divide first."""
    search = _Search()
    with numpy.errstate(all="ignore"):
        edges = _first(low, high, near)
        left = search.divide(function, Intervals(edges[:-1], edges[1:]), function.fineness)
        parts = _clusters(left)
        for begin, end in parts:
            rest = Intervals(numpy.array([begin]), numpy.array([end]))
            is_many = len(parts) > FEW_PARTS and end - begin <= (high - low) / FIRST
            if not is_many and _is_wide(rest.low, rest.high, function.finer).any():
                rest = search.divide(function.part(begin, end), rest, function.finer)
            search.note(rest, numpy.zeros(rest.low.size, numpy.int8))
        pieces = search.pieces()
        for before, piece, after in zip([None, *pieces], pieces, [*pieces[1:], None], strict=False):
            if not piece.sign:
                search.zeros += _approach(function, piece, before, after)
    return Isolation(tuple(pieces), tuple(sorted(search.zeros, key=lambda each: each.value)))


class _Search:
    """Cells that were decided, with their signs, and proven zeros."""

    def __init__(self) -> None:
        self.zeros: list[Zero] = []
        self._done: list[tuple[Array, Array, Signs]] = []

    def note(self, cells: Intervals, signs: Signs) -> None:
        """Remember the signs of some cells."""
        self._done.append((cells.low, cells.high, signs))

    def divide(self, function: Function, cells: Intervals, fineness: Fineness) -> Intervals:
        """The narrow cells that remain of some when those that are not decided are divided again and again."""
        left = [cells[:0]]
        for number in range(fineness.rounds + 1):
            cells = self._undecided(function, cells)
            is_wide = _is_wide(cells.low, cells.high, fineness) & (number < fineness.rounds)
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

    def _undecided(self, function: Function, cells: Intervals) -> Intervals:
        """The cells that neither have one sign nor rise or fall through one zero."""
        signs = function.signs(cells)
        self.note(cells[signs != 0], signs[signs != 0])
        cells = cells[signs == 0]
        if not cells.low.size:
            return cells
        ways = function.ways(cells)
        is_done = ways != 0
        if is_done.any():
            steady, ways = cells[is_done], ways[is_done]
            first, last = ways * function.at(steady.low), ways * function.at(steady.high)
            is_known = numpy.isfinite(first) & numpy.isfinite(last)
            # A zero on the edge of two cells belongs to the left one, where both see it.
            has_zero = is_known & ((first < 0) & (last >= 0) | (first == 0))
            alone = is_known & ~has_zero
            self.note(steady[alone], numpy.where(first > 0, ways, -ways)[alone])
            self._cross(function, steady[has_zero], ways[has_zero])
            is_done[is_done] = is_known
        return cells[~is_done]

    def _cross(self, function: Function, cells: Intervals, ways: Signs) -> None:
        """Note the zeros of cells through which the function rises or falls, by bisection of all of them at once."""
        low, high = cells.low, cells.high
        for _ in range(BISECTIONS if low.size else 0):
            middle = (low + high) / 2
            is_before = ways * function.at(middle) < 0
            low, high = numpy.where(is_before, middle, low), numpy.where(is_before, high, middle)
        if low.size:
            values = numpy.where(numpy.abs(function.at(low)) < numpy.abs(function.at(high)), low, high)
            found = zip(values.tolist(), ways.tolist(), low.tolist(), high.tolist(), strict=True)
            self.zeros += [Zero(*each) for each in found]
            self.note(Intervals(cells.low, values), -ways)
            self.note(Intervals(values, cells.high), ways)

    def pieces(self) -> list[Piece]:
        """All cells in order, neighbours of one sign joined."""
        lows, highs, signs = (numpy.concatenate(each) for each in zip(*self._done, strict=True))
        order = numpy.lexsort((highs, lows))
        lows, highs, signs = lows[order], highs[order], signs[order]
        begins = numpy.flatnonzero(numpy.concatenate([[True], signs[1:] != signs[:-1]]))
        ends = numpy.append(begins[1:], signs.size) - 1
        return [
            Piece(float(lows[begin]), float(highs[end]), int(signs[begin]))
            for begin, end in zip(begins, ends, strict=True)
        ]


def _first(low: float, high: float, near: Sequence[float]) -> Array:
    """Values at which an interval is divided first."""
    if high - low <= WIDE:
        cells = numpy.linspace(low, high, FIRST + 1)
    else:
        decades = numpy.logspace(-2, 6, FIRST + 1)
        cells = numpy.concatenate([-decades[::-1], [0.0], decades])
    cells = numpy.concatenate([cells, near])
    inner = cells[(cells > low) & (cells < high)]
    return numpy.unique(numpy.concatenate([[low], inner, [high]]))


def _clusters(cells: Intervals) -> list[tuple[float, float]]:
    """Cells that touch, as one part."""
    parts: list[tuple[float, float]] = []
    for low, high in sorted(zip(cells.low.tolist(), cells.high.tolist(), strict=True)):
        if parts and low <= parts[-1][1]:
            parts[-1] = parts[-1][0], max(parts[-1][1], high)
        else:
            parts.append((low, high))
    return parts


def _is_wide(low: Array, high: Array, fineness: Fineness) -> Bits:
    """Mask of the cells that are wide enough to be divided."""
    return high - low > fineness.narrowest * numpy.maximum(1.0, numpy.maximum(abs(low), abs(high)))


def _approach(function: Function, piece: Piece, before: Piece | None, after: Piece | None) -> list[Zero]:
    """Zeros in a piece that is not decided, as far as samples between its neighbours tell: changes of the sign, or else
    the value nearest to zero."""
    ends = [None if each is None or each.sign == VOID else each.sign for each in (before, after)]
    places = numpy.linspace(piece.low, piece.high, SAMPLES)
    found = list(_changes(function, places, ends))
    if not found:
        nearest = _nearest(function, piece)
        if _is_wide(places[:1], places[-1:], function.finer).any():
            # The search was given up there, and a sample may stand to either side of two zeros.
            found = list(_changes(function, numpy.unique([*places, nearest]), ends))
        found = found or [Zero(nearest, 0, piece.low, piece.high)]
    return [replace(each, width=piece.high - piece.low) for each in found]


def _changes(function: Function, places: Array, ends: Sequence[int | None]) -> Iterator[Zero]:
    """Changes of the sign between places, of which the outer ones may have signs that are known."""
    values = function.at(places)
    for number, sign in zip((0, -1), ends, strict=True):
        values[number] = values[number] if sign is None else sign
    is_above = values >= 0
    for number in numpy.flatnonzero((is_above[1:] != is_above[:-1]) & ~numpy.isnan(values[1:] + values[:-1])).tolist():
        is_rising = bool(is_above[number + 1])

        def is_beyond(finer: Array, is_rising: bool = is_rising) -> Bits:
            return numpy.asarray((function.at(finer) >= 0) == is_rising)

        low, high = section(places[number], places[number + 1], is_beyond)
        nearer = numpy.abs(function.at(numpy.array([low, high])))
        yield Zero(low if nearer[0] < nearer[1] else high, 1 if is_rising else -1, low, high)


def _nearest(function: Function, piece: Piece) -> float:
    """The value of a piece at which a function is nearest to zero; the middle where it has no values."""
    low, high = piece.low, piece.high
    found = (low + high) / 2
    for _ in range(SECTIONS):
        places = numpy.linspace(low, high, SAMPLES)
        sizes = numpy.abs(function.at(places))
        if not numpy.isfinite(sizes).any():
            break
        least = int(numpy.nanargmin(numpy.where(numpy.isfinite(sizes), sizes, numpy.nan)))
        found = float(places[least])
        low, high = float(places[max(least - 1, 0)]), float(places[min(least + 1, SAMPLES - 1)])
        if high - low <= 4 * numpy.spacing(max(abs(low), abs(high))):
            break
    return found
