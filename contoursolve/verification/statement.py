"""Statements of words and facts about unknown coordinates, and how far they move the unknowns that they fix.

Solving for the residuals tells how far the claimed points are from those that the statements fix, however weakly
they fix them: exactly for words, which are linear in the unknowns, and to first order for facts.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from contoursolve.tolerance import AGREEMENT, REGULAR

NUMERICAL = 1e-6
"""1. A determinant below this is zero where slopes were found by differences."""


@dataclass(frozen=True, slots=True)
class Statement:
    """What one word or fact says: `gradient` is how its residual (mm) changes with each unknown (mm).

    `degrees` is by how much an angle is off; None for words that are no angles. `allowed` (mm) is how far a word that
    is not needed may miss what the others say, each coordinate and the word being exact to half its increment.
    `at_unknowns` is the residual (mm)
    at the unknowns themselves, where `residual` is that of the claimed elements. `against` (mm) is how far
    something runs the opposite way. `value` is the residual (mm) at any unknowns where it is no linear function; the
    gradient was then made by differences.
    """

    name: str
    word: str
    gradient: tuple[float, ...]
    residual: float
    degrees: float | None = None
    at_unknowns: float | None = None
    against: float = 0.0
    value: Callable[[Sequence[float]], float] | None = None
    allowed: float = AGREEMENT

    @property
    def agrees(self) -> bool:
        """Whether the word holds within the least increment."""
        return abs(self.residual) <= self.allowed


@dataclass(frozen=True, slots=True)
class Displacement:
    """How far the unknowns are from where statements fix them.

    `rank` is the number of unknowns that are fixed, `free` are the indices of the others. `moves` (mm) are the
    corrections of all, to be taken off; `amplification` (1) by how much an error of the words' values becomes
    larger in the unknowns.
    """

    rank: int
    free: tuple[int, ...]
    moves: tuple[float, ...]
    amplification: float

    @property
    def distance(self) -> float:
        """The largest correction of one unknown, mm."""
        return max(map(abs, self.moves), default=0.0)


def displacement(statements: Sequence[Statement], unknowns: int) -> Displacement:
    """Gauss-Jordan elimination with the largest pivot first."""
    regular = NUMERICAL if any(each.value for each in statements) else REGULAR
    rows = [
        [
            *each.gradient,
            each.residual if each.at_unknowns is None else each.at_unknowns,
            *(float(number == other) for other in range(len(statements))),
        ]
        for number, each in enumerate(statements)
    ]
    open_rows, open_columns = set(range(len(rows))), set(range(unknowns))
    fixed: dict[int, int] = {}
    while open_rows and open_columns:
        at, column = max(
            ((row, column) for row in sorted(open_rows) for column in sorted(open_columns)),
            key=lambda place: abs(rows[place[0]][place[1]]),
        )
        pivot = rows[at][column]
        if not abs(pivot) > regular:  # true for NaN
            break
        rows[at] = [entry / pivot for entry in rows[at]]
        for other in range(len(rows)):
            factor = rows[other][column]
            if other != at and factor:
                rows[other] = [a - factor * b for a, b in zip(rows[other], rows[at], strict=True)]
        open_rows.discard(at)
        open_columns.discard(column)
        fixed[column] = at
    return Displacement(
        rank=len(fixed),
        free=tuple(sorted(open_columns)),
        moves=tuple(rows[fixed[column]][unknowns] if column in fixed else 0.0 for column in range(unknowns)),
        amplification=max((sum(map(abs, rows[at][unknowns + 1 :])) for at in fixed.values()), default=0.0),
    )
