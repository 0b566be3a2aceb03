"""Whole numbers modulo a large prime: what is zero here at random values is zero for all values.

The chance that something else is zero by accident is about its degree / PRIME, 1e-17 (Schwartz 1980).
"""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from heapq import heapify, heappop, heappush

from msgspec import Struct

from contoursolve.numeric.functions import Functions

PRIME = 2**61 - 1


class Residue:
    """A number modulo `PRIME`, and its derivatives by unknowns, by name."""

    __slots__ = ("slopes", "value")

    def __init__(self, value: int, slopes: Mapping[str, int]) -> None:
        self.value = value % PRIME
        self.slopes = slopes

    def __add__(self, other: "Residue | float") -> "Residue":
        second = _constant(other)
        return Residue(self.value + second.value, _sum(self, 1, second, 1))

    def __sub__(self, other: "Residue | float") -> "Residue":
        second = _constant(other)
        return Residue(self.value - second.value, _sum(self, 1, second, -1))

    def __mul__(self, other: "Residue | float") -> "Residue":
        second = _constant(other)
        return Residue(self.value * second.value, _sum(self, second.value, second, self.value))

    def __truediv__(self, other: "Residue | float") -> "Residue":
        second = _constant(other)
        inverse = pow(second.value, -1, PRIME)
        value = self.value * inverse
        return Residue(value, _sum(self, inverse, second, -value * inverse))

    def __radd__(self, other: float) -> "Residue":
        return _constant(other) + self

    def __rsub__(self, other: float) -> "Residue":
        return _constant(other) - self

    def __rmul__(self, other: float) -> "Residue":
        return _constant(other) * self

    def __rtruediv__(self, other: float) -> "Residue":
        return _constant(other) / self

    def __pow__(self, exponent: int) -> "Residue":
        return Residue(pow(self.value, exponent, PRIME), self.chain(exponent * pow(self.value, exponent - 1, PRIME)))

    def __neg__(self) -> "Residue":
        return Residue(-self.value, self.chain(-1))

    def chain(self, factor: int) -> Mapping[str, int]:
        """The derivatives of a function that has this derivative here."""
        return {name: slope * factor % PRIME for name, slope in self.slopes.items()}


def _constant(value: Residue | float) -> Residue:
    return value if isinstance(value, Residue) else Residue(rational(value), {})


def _sum(first: Residue, one: int, second: Residue, other: int) -> Mapping[str, int]:
    """The derivatives of both, each times a factor."""
    slopes = dict(first.chain(one))
    for name, slope in second.chain(other).items():
        slopes[name] = (slopes.get(name, 0) + slope) % PRIME
    return slopes


EXPONENT = 0x1E3779B97F4A7C15
"""Prime to PRIME - 1: powers of different numbers differ, and tell nothing of each other."""


def rational(value: float) -> int:
    """The rational number that a float is, as a residue."""
    numerator, denominator = value.as_integer_ratio()
    return numerator * pow(denominator, -1, PRIME) % PRIME


@lru_cache(maxsize=65536)
def draw(name: str) -> int:
    """A residue that has nothing to do with that of any other name."""
    return pow(int.from_bytes(b"\1" + name.encode(), "big"), EXPONENT, PRIME)


@lru_cache(maxsize=65536)
def draw_direction(name: str) -> tuple[int, int]:
    """Cosine and sine of a direction: their squares add up to 1."""
    parameter = draw(name)
    scale = pow(1 + parameter**2, -1, PRIME)
    return (1 - parameter**2) * scale % PRIME, 2 * parameter * scale % PRIME


def _root(value: Residue) -> Residue:
    """A number that has nothing to do with any other."""
    root = draw(f"root {value.value}")
    return Residue(root, value.chain(pow(2 * root, -1, PRIME)))


def _cosine(angle: Residue) -> Residue:
    """The cosine that belongs to an angle."""
    cosine, sine = draw_direction(str(angle.value))
    return Residue(cosine, angle.chain(-sine))


def _sine(angle: Residue) -> Residue:
    """The sine that belongs to an angle."""
    cosine, sine = draw_direction(str(angle.value))
    return Residue(sine, angle.chain(cosine))


RESIDUES = Functions(_root, _cosine, _sine)
"""Functions beyond arithmetic, modulo the prime: a root is any number; cosine and sine belong together."""


class ExactRank(Struct, frozen=True):
    """Rank of a matrix with its two null spaces, as indices of their non-zero entries."""

    rank: int
    independent_rows: tuple[int, ...]
    """The first rows, in order, that raise the rank."""
    dependent_rows: tuple[int, ...]
    """Rows that take part in some dependency."""
    free_columns: tuple[int, ...]
    """Columns whose unknown is not determined."""
    circuits: Mapping[int, tuple[int, ...]] = {}
    """For each row that does not raise the rank: the independent rows that it is a combination of."""


Row = dict[int, int]
"""Row without its zeros, by column."""


def exact_rank(matrix: Sequence[Row], columns: int) -> ExactRank:
    """Rank and null spaces of a matrix of residues."""
    kept: dict[int, tuple[Row, int]] = {}
    """By its pivot, each reduced row, and its number among those that were made."""
    made: list[Row] = []
    """Each row that was made, of earlier ones by their numbers, and of rows of the matrix, as -1 less theirs."""
    holding: dict[int, set[int]] = {}
    """By column, the pivots of all rows that hold it, and of some that did."""
    circuits: dict[int, tuple[int, ...]] = {}
    independent: list[int] = []
    for number, entries in enumerate(matrix):
        row, made_of = entries, {-1 - number: 1}
        # A row that is kept is zero at the pivots of all others.
        for pivot in [column for column in row if column in kept]:
            factor, (other, own) = row[pivot], kept[pivot]
            row, made_of = _less(row, factor, other), _less(made_of, factor, {own: 1})
        if not row:
            circuits[number] = tuple(sorted(_rows_of(made_of, made) - {number}))
            continue
        lead = min(row)
        scale = pow(row[lead], -1, PRIME)
        row, new = _times(row, scale), len(made)
        made.append(_times(made_of, scale))
        for pivot in holding.pop(lead, ()):
            other, own = kept[pivot]
            if lead in other:
                kept[pivot] = _less(other, other[lead], row), len(made)
                made.append(_less({own: 1}, other[lead], {new: 1}))
                for column in row:
                    holding.setdefault(column, set()).add(pivot)
        kept[lead] = row, new
        for column in row:
            holding.setdefault(column, set()).add(lead)
        independent.append(number)
    free = set(range(columns)) - kept.keys()
    # An unknown with a pivot is determined unless its row holds a free one as well.
    loose = {pivot for pivot, (row, _) in kept.items() if not free.isdisjoint(row)}
    dependent = sorted({*circuits, *(row for rows in circuits.values() for row in rows)})
    return ExactRank(len(kept), tuple(independent), tuple(dependent), tuple(sorted(free | loose)), circuits)


def _rows_of(terms: Row, made: Sequence[Row]) -> set[int]:
    """The rows of the matrix of which a row is made."""
    left, waiting = dict(terms), [-each for each in terms]
    heapify(waiting)
    while waiting and waiting[0] <= 0:
        # What was made last is made of earlier ones.
        own = -heappop(waiting)
        factor = left.pop(own, 0)
        for term, value in made[own].items() if factor else ():
            if term not in left:
                heappush(waiting, -term)
            left[term] = (left.get(term, 0) + factor * value) % PRIME
    return {-1 - each for each, value in left.items() if value}


def _less(row: Row, factor: int, other: Row) -> Row:
    """A row less a multiple of another."""
    less = row.copy()
    for index, value in other.items():
        left = (less.get(index, 0) - factor * value) % PRIME
        if left:
            less[index] = left
        else:
            less.pop(index, None)
    return less


def _times(row: Row, factor: int) -> Row:
    """A multiple of a row."""
    return {index: value * factor % PRIME for index, value in row.items()}
