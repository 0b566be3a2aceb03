"""Statements of words about unknown coordinates: do they hold, and do they fix the coordinates?

Every statement is linear in the unknowns, so that solving for the residuals tells exactly how far the
claimed point is from the one that the words fix, however weakly they fix it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from contoursolve.tolerance import AGREEMENT, REGULAR
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedStatus
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import ROUNDING


@dataclass(frozen=True, slots=True)
class Statement:
    """What one word says: `gradient` is how its residual (mm) changes with each unknown (mm).

    `degrees` is by how much an angle is off; None for words that are no angles.
    """

    name: str
    word: str
    gradient: tuple[float, ...]
    residual: float
    degrees: float | None = None

    @property
    def agrees(self) -> bool:
        """Whether the word holds within the least increment."""
        return abs(self.residual) <= AGREEMENT or (self.degrees is not None and abs(self.degrees) <= AGREEMENT)


@dataclass(frozen=True, slots=True)
class Displacement:
    """How far the unknowns are from where statements fix them.

    `rank` is the number of unknowns that are fixed; `distance` (mm) the largest correction of one of them;
    `amplification` (1) by how much an error of the words' values becomes larger in the unknowns.
    """

    rank: int
    distance: float
    amplification: float


def displacement(statements: Sequence[Statement], unknowns: int) -> Displacement:
    """Gauss-Jordan elimination with the largest pivot first."""
    rows = [
        [*each.gradient, each.residual, *(float(number == other) for other in range(len(statements)))]
        for number, each in enumerate(statements)
    ]
    open_rows, open_columns, fixed = set(range(len(rows))), set(range(unknowns)), []
    while open_rows and open_columns:
        at, column = max(
            ((row, column) for row in sorted(open_rows) for column in sorted(open_columns)),
            key=lambda place: abs(rows[place[0]][place[1]]),
        )
        pivot = rows[at][column]
        if abs(pivot) <= REGULAR:
            break
        rows[at] = [entry / pivot for entry in rows[at]]
        for other in range(len(rows)):
            factor = rows[other][column]
            if other != at and factor:
                rows[other] = [a - factor * b for a, b in zip(rows[other], rows[at], strict=True)]
        open_rows.discard(at)
        open_columns.discard(column)
        fixed.append(at)
    return Displacement(
        rank=len(fixed),
        distance=max((abs(rows[at][unknowns]) for at in fixed), default=0.0),
        amplification=max((sum(map(abs, rows[at][unknowns + 1 :])) for at in fixed), default=0.0),
    )


def check_statements(case: Case, ledger: Ledger, statements: Sequence[Statement], unknowns: int) -> None:
    """Each word holds; together they fix the unknowns, just so or with words that agree; the points are there.

    Where a contour is claimed overdetermined, the words that are not needed hold within the least increment
    only, and those that hold exactly must fix the points.
    """
    words, is_over = [each.word for each in statements], case.claimed.status is ClaimedStatus.OVERDETERMINED
    for each in statements:
        if is_over and abs(each.residual) > case.limit:
            unit, off = ("mm", each.residual) if abs(each.residual) <= AGREEMENT else ("deg", each.degrees)
            ledger.measure(f"{each.name} (agrees)", [each.word], off or each.residual, AGREEMENT, unit)
        else:
            ledger.measure(each.name, [each.word], each.residual, case.limit)
    surplus = len(statements) - unknowns
    name, found = "as many words as the status says", f"{len(statements)} words for {unknowns} unknowns"
    ledger.require(name, words, surplus > 0 if is_over else surplus == 0, found)
    holding = [each for each in statements if not is_over or abs(each.residual) <= case.limit]
    moved = displacement(holding, unknowns)
    found = f"they fix {moved.rank} of {unknowns} coordinates"
    if ledger.require("the words fix the points", words, moved.rank == unknowns, found):
        # What a shift of the start, or the rounding of this very calculation, does to the points.
        unsure = moved.amplification * (ROUNDING * case.reach + case.start_error)
        case.compare(ledger, "the points are where the words put them", words, moved.distance, unsure)
