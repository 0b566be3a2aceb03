"""Statements of words and facts about unknown coordinates: do they hold, and do they fix the coordinates?

Solving for the residuals tells how far the claimed points are from those that the statements fix, however weakly
they fix them: exactly for words, which are linear in the unknowns, and to first order for facts.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from contoursolve.tolerance import AGREEMENT, REGULAR
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedStatus
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import ROUNDING

NUMERICAL = 1e-6
"""1. A determinant below this is zero where slopes were found by differences."""


@dataclass(frozen=True, slots=True)
class Statement:
    """What one word or fact says: `gradient` is how its residual (mm) changes with each unknown (mm).

    `degrees` is by how much an angle is off; None for words that are no angles. `at_unknowns` is the residual (mm)
    at the unknowns themselves, where `residual` is that of the claimed elements. `against` (mm) is how far
    something runs the opposite way. `is_numerical` tells that the gradient was made by differences.
    """

    name: str
    word: str
    gradient: tuple[float, ...]
    residual: float
    degrees: float | None = None
    at_unknowns: float | None = None
    against: float = 0.0
    is_numerical: bool = False

    @property
    def agrees(self) -> bool:
        """Whether the word holds within the least increment."""
        return abs(self.residual) <= AGREEMENT or (self.degrees is not None and abs(self.degrees) <= AGREEMENT)


@dataclass(frozen=True, slots=True)
class Displacement:
    """How far the unknowns are from where statements fix them.

    `rank` is the number of unknowns that are fixed; `moves` (mm) are their corrections, to be taken off;
    `amplification` (1) by how much an error of the words' values becomes larger in the unknowns.
    """

    rank: int
    moves: tuple[float, ...]
    amplification: float

    @property
    def distance(self) -> float:
        """The largest correction of one unknown, mm."""
        return max(map(abs, self.moves), default=0.0)


def displacement(statements: Sequence[Statement], unknowns: int) -> Displacement:
    """Gauss-Jordan elimination with the largest pivot first."""
    regular = NUMERICAL if any(each.is_numerical for each in statements) else REGULAR
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
        moves=tuple(rows[fixed[column]][unknowns] if column in fixed else 0.0 for column in range(unknowns)),
        amplification=max((sum(map(abs, rows[at][unknowns + 1 :])) for at in fixed.values()), default=0.0),
    )


def check_statements(case: Case, ledger: Ledger, statements: Sequence[Statement], unknowns: int) -> None:
    """Each word holds; together they fix the unknowns, just so or with words that agree; the points are there.

    Where a contour is claimed overdetermined, the words that are not needed hold within the least increment
    only, and those that hold exactly must fix the points.
    """
    words, is_over = (
        [each.word for each in statements if each.word],
        case.claimed.status is ClaimedStatus.OVERDETERMINED,
    )
    for each in statements:
        stated = [each.word] if each.word else []
        if is_over and abs(each.residual) > case.limit:
            unit, off = ("mm", each.residual) if abs(each.residual) <= AGREEMENT else ("deg", each.degrees)
            ledger.measure(f"{each.name} (agrees)", stated, off or each.residual, AGREEMENT, unit)
        else:
            ledger.measure(each.name, stated, each.residual, case.limit)
        if each.against:
            ledger.measure(f"{each.name} in its direction", stated, each.against, case.limit)
    surplus = len(statements) - unknowns
    name, found = "as many words as the status says", f"{len(statements)} words for {unknowns} unknowns"
    ledger.require(name, words, surplus > 0 if is_over else surplus == 0, found)
    holding = [each for each in statements if not is_over or abs(each.residual) <= case.limit]
    moved = displacement(holding, unknowns)
    if moved.rank < unknowns and case.claimed.certificate.double:
        ledger.omit("how far the points may be off", "two solutions have become one, so that words fix them weakly")
        return
    found = f"they fix {moved.rank} of {unknowns} coordinates"
    if ledger.require("the words fix the points", words, moved.rank == unknowns, found):
        # What a shift of the start, or the rounding of this very calculation, does to the points.
        unsure = moved.amplification * (ROUNDING * case.reach + case.start_error)
        case.compare(ledger, "the points are where the words put them", words, moved.distance, unsure)
