"""Do the words and facts of a contour hold, and do they fix its points where they are claimed?"""

from collections.abc import Sequence

from contoursolve.tolerance import AGREEMENT
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedStatus
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import ROUNDING
from contoursolve.verification.statement import Statement, displacement


def check_statements(case: Case, ledger: Ledger, statements: Sequence[Statement], unknowns: int) -> None:
    """Each word holds; together they fix the unknowns, just so or with words that agree; the points are there.

    Where a contour is claimed overdetermined, the words that are not needed hold within the least increment
    only, and those that hold exactly must fix the points. So it is where a word selects the contour from other
    solutions of the words that are needed.
    """
    words = [each.word for each in statements if each.word]
    is_over = case.claimed.status is ClaimedStatus.OVERDETERMINED
    if case.is_selected and len(statements) > unknowns:
        is_over = True
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
