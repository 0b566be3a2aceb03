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


def exact_rank(matrix: Sequence[Sequence[int]], columns: int) -> ExactRank:
    """Rank and null spaces of a matrix of residues."""
    kept: list[tuple[int, list[int], dict[int, int]]] = []
    """Pivot column, reduced row, and of which rows it is made."""
    dependent: set[int] = set()
    independent: list[int] = []
    for number, entries in enumerate(matrix):
        row, made_of = [each % PRIME for each in entries], {number: 1}
        for pivot, other, others in kept:
            if row[pivot]:
                factor = row[pivot]
                row = [(a - factor * b) % PRIME for a, b in zip(row, other, strict=True)]
                for index, share in others.items():
                    made_of[index] = (made_of.get(index, 0) - factor * share) % PRIME
        lead = next((column for column, value in enumerate(row) if value), None)
        if lead is None:
            dependent |= {index for index, share in made_of.items() if share}
            continue
        scale = pow(row[lead], -1, PRIME)
        row = [value * scale % PRIME for value in row]
        made_of = {index: share * scale % PRIME for index, share in made_of.items()}
        kept = [
            (
                pivot,
                [(a - other[lead] * b) % PRIME for a, b in zip(other, row, strict=True)],
                _less(others, other[lead], made_of),
            )
            for pivot, other, others in kept
        ]
        kept.append((lead, row, made_of))
        independent.append(number)
    pivots = {pivot for pivot, _, _ in kept}
    free = set(range(columns)) - pivots
    # An unknown with a pivot is determined unless its row holds a free one as well.
    loose = {pivot for pivot, row, _ in kept if any(row[column] for column in free)}
    return ExactRank(len(kept), tuple(independent), tuple(sorted(dependent)), tuple(sorted(free | loose)))


def _less(row: dict[int, int], factor: int, other: dict[int, int]) -> dict[int, int]:
    return {index: (row.get(index, 0) - factor * other.get(index, 0)) % PRIME for index in row.keys() | other.keys()}
