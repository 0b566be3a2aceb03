"""Sparse rows in echelon form, one after the other: which follow from those before, how, and what columns they fix."""

from collections.abc import Iterable, Mapping
from heapq import heapify, heappop, heappush

Row = Mapping[int, float]
"""Row without its zeros, by column. A number below zero is no column: it goes along, as `CONSTANT` does in a row that
is zero as an equation. No row is solved for it."""

CONSTANT = -1

_ROUNDING = 1e-14
"""1 (share of what is subtracted, or of a row's largest). What is smaller is rounding: 50 times that of one number."""


class _Kept:
    """A row less multiples of rows before it, 1 in its pivot's column, which `row` leaves out; what was taken from it,
    and by what the rest was multiplied."""

    __slots__ = ("number", "pivot", "row", "scale", "taken")

    def __init__(
        self, number: int, pivot: int, row: dict[int, float], scale: float, taken: list[tuple[int, float]]
    ) -> None:
        self.number, self.pivot, self.row, self.scale, self.taken = number, pivot, row, scale, taken


class Echelon:
    """Rows of a matrix, of which each is kept that does not follow from those kept before it.

    A row whose largest rest is at most `least` follows. A row is reduced by earlier ones alone, and what it is made of
    is worked out when somebody asks: in a chain, where a row has to do with a few others, each takes as long as in a
    short one. Each row is solved for its largest column, the last of several: what is subtracted does not grow.
    """

    def __init__(self, least: float) -> None:
        self._least = least
        self._kept: list[_Kept] = []
        self._of_pivot: dict[int, int] = {}
        self.size = 0
        """How many numbers the kept rows hold beside their pivots."""

    def add(self, number: int, entries: Row) -> dict[int, float] | None:
        """Keep a row by a number, and give None; or else give the multiples of kept rows, by their numbers, that it is
        the sum of."""
        row, taken = self._reduce(entries)
        lead = max((column for column in row if column >= 0), key=lambda each: (abs(row[each]), each), default=0)
        if abs(row.get(lead, 0.0)) <= self._least:
            return self._made_of(taken)
        scale = 1 / row.pop(lead)
        rest = {column: value * scale for column, value in row.items()}
        present = {column: value for column, value in rest.items() if column < 0 or abs(value) > _ROUNDING}
        self.size += len(present)
        self._of_pivot[lead] = len(self._kept)
        self._kept.append(_Kept(number, lead, present, scale, taken))
        return None

    @property
    def rank(self) -> int:
        """The number of rows that are kept."""
        return len(self._kept)

    def rest(self, entries: Row) -> Row:
        """A row less multiples of kept rows, zero in all columns that these are solved for."""
        return self._reduce(entries)[0]

    def _reduce(self, entries: Row) -> tuple[dict[int, float], list[tuple[int, float]]]:
        """A row less multiples of kept rows, and which of these and how often."""
        row, taken = dict(entries), list[tuple[int, float]]()
        # A kept row holds pivots of later ones alone: from the first on, each is looked at once.
        ahead = [self._of_pivot[column] for column in row if column in self._of_pivot]
        heapify(ahead)
        while ahead:
            place = heappop(ahead)
            kept = self._kept[place]
            factor = row.pop(kept.pivot, 0.0)
            if not factor:
                continue
            taken.append((place, factor))
            for column, value in kept.row.items():
                before = row.get(column, 0.0)
                rest = _less(before, factor * value)
                if rest:
                    row[column] = rest
                    if not before and column in self._of_pivot:
                        heappush(ahead, self._of_pivot[column])
                elif before:
                    del row[column]
        return row, taken

    def _made_of(self, taken: Iterable[tuple[int, float]]) -> dict[int, float]:
        """Multiples of reduced rows as multiples of the rows themselves."""
        weights, found = dict(taken), dict[int, float]()
        rest = [-place for place in weights]
        heapify(rest)
        while rest:
            place = -heappop(rest)
            kept, weight = self._kept[place], weights.pop(place)
            if not weight:
                continue
            weight *= kept.scale
            found[kept.number] = weight
            for other, factor in kept.taken:
                if other not in weights:
                    heappush(rest, -other)
                weights[other] = _less(weights.get(other, 0.0), weight * factor)
        return found

    def solved(self, columns: Iterable[int]) -> dict[int, dict[int, float]]:
        """Some columns by those that are free: the multiples of these, and the `CONSTANT`, that make the kept rows, as
        equations, true; a free one by itself."""
        wanted = [*columns]
        met = {self._of_pivot[column] for column in wanted if column in self._of_pivot}
        ahead = [*met]
        while ahead:
            for other in self._kept[ahead.pop()].row:
                place = self._of_pivot.get(other)
                if place is not None and place not in met:
                    met.add(place)
                    ahead.append(place)
        found: dict[int, dict[int, float]] = {}
        for place in sorted(met, reverse=True):
            value = found[self._kept[place].pivot] = {}
            for column, factor in self._kept[place].row.items():
                for free, share in found.get(column, {column: 1.0}).items():
                    value[free] = _less(value.get(free, 0.0), factor * share)
        return {column: found.get(column, {column: 1.0}) for column in wanted}

    def fixed(self, columns: Iterable[int]) -> dict[int, float]:
        """Of some columns, those that the kept rows, as equations, give one value, with it."""
        return {
            column: value.get(CONSTANT, 0.0)
            for column, value in self.solved(columns).items()
            if all(abs(share) <= self._least for free, share in value.items() if free >= 0)
        }


def _less(value: float, other: float) -> float:
    """A difference; zero where only rounding is left."""
    rest = value - other
    return rest if abs(rest) > _ROUNDING * abs(value) else 0.0
