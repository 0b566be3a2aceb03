"""Whole numbers modulo a large prime: what is zero here at random values is zero for all values.

The chance that something else is zero by accident is about its degree / PRIME, 1e-17 (Schwartz 1980).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

PRIME = 2**61 - 1


class Residue:
    """A number modulo `PRIME`."""

    __slots__ = ("value",)

    def __init__(self, value: int) -> None:
        self.value = value % PRIME

    def __add__(self, other: "Residue") -> "Residue":
        return Residue(self.value + other.value)

    def __sub__(self, other: "Residue") -> "Residue":
        return Residue(self.value - other.value)

    def __mul__(self, other: "Residue") -> "Residue":
        return Residue(self.value * other.value)

    def __truediv__(self, other: "Residue") -> "Residue":
        return Residue(self.value * pow(other.value, -1, PRIME))

    def __rtruediv__(self, one: int) -> "Residue":
        return Residue(one * pow(self.value, -1, PRIME))

    def __pow__(self, exponent: "int | Residue") -> "Residue":
        return Residue(pow(self.value, exponent if isinstance(exponent, int) else exponent.value, PRIME))

    def __neg__(self) -> "Residue":
        return Residue(-self.value)


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


class Drawn:
    """What is not arithmetic, for `Replay`: a root is any number; cosine and sine belong together."""

    @staticmethod
    def root(value: Residue) -> Residue:
        """A number that has nothing to do with any other."""
        return Residue(draw(f"root {value.value}"))

    @staticmethod
    def cosine(value: Residue) -> Residue:
        """The cosine that belongs to an angle."""
        return Residue(draw_direction(str(value.value))[0])

    @staticmethod
    def sine(value: Residue) -> Residue:
        """The sine that belongs to an angle."""
        return Residue(draw_direction(str(value.value))[1])


@dataclass(frozen=True, slots=True)
class ExactRank:
    """Rank of a matrix with its two null spaces, as indices of their non-zero entries."""

    rank: int
    independent_rows: tuple[int, ...]
    """The first rows, in order, that raise the rank."""
    dependent_rows: tuple[int, ...]
    """Rows that take part in some dependency."""
    free_columns: tuple[int, ...]
    """Columns whose unknown is not determined."""


Row = dict[int, int]
"""What is not zero of a row, by column."""


def exact_rank(matrix: Sequence[Row], columns: int) -> ExactRank:
    """Rank and null spaces of a matrix of residues."""
    kept: dict[int, tuple[Row, Row]] = {}
    """By its pivot, each reduced row, and of which rows it is made."""
    dependent: set[int] = set()
    independent: list[int] = []
    for number, entries in enumerate(matrix):
        row, made_of = entries, {number: 1}
        # A row that is kept is zero at the pivots of all others.
        for pivot in [column for column in row if column in kept]:
            factor, (other, others) = row[pivot], kept[pivot]
            row, made_of = _less(row, factor, other), _less(made_of, factor, others)
        if not row:
            dependent |= made_of.keys()
            continue
        lead = min(row)
        scale = pow(row[lead], -1, PRIME)
        row, made_of = _times(row, scale), _times(made_of, scale)
        for pivot, (other, others) in kept.items():
            if lead in other:
                kept[pivot] = _less(other, other[lead], row), _less(others, other[lead], made_of)
        kept[lead] = row, made_of
        independent.append(number)
    free = set(range(columns)) - kept.keys()
    # An unknown with a pivot is determined unless its row holds a free one as well.
    loose = {pivot for pivot, (row, _) in kept.items() if not free.isdisjoint(row)}
    return ExactRank(len(kept), tuple(independent), tuple(sorted(dependent)), tuple(sorted(free | loose)))


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
