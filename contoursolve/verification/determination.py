"""Do the words and facts of a contour hold, and do they fix its points where they are claimed?"""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

from contoursolve.tolerance import RESIDUAL
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedStatus
from contoursolve.verification.drawing import UnmeasurableError
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import ROUNDING
from contoursolve.verification.statement import Statement, displacement


def check_statements(case: Case, ledger: Ledger, statements: Sequence[Statement], unknowns: Sequence[float]) -> None:
    """Each word holds; together they fix the unknowns, just so or with words that agree; the points are there.

    Where a contour is claimed overdetermined, the words that are not needed hold within the least increment
    only, and those that hold exactly must fix the points. So it is where a word selects the contour from other
    solutions of the words that are needed; such a word is not one too many.
    """
    words = [each.word for each in statements if each.word]
    surplus = len(statements) - len(unknowns)
    is_claimed_over = case.claimed.status is ClaimedStatus.OVERDETERMINED
    is_over = is_claimed_over or (case.selecting > 0 and surplus > 0)
    for each in statements:
        stated = [each.word] if each.word else []
        if is_over and abs(each.residual) > case.limit:
            ledger.measure(f"{each.name} (agrees)", stated, each.residual, each.allowed)
        else:
            ledger.measure(each.name, stated, each.residual, case.limit)
        if each.against:
            ledger.measure(f"{each.name} in its direction", stated, each.against, case.limit)
    name, found = "as many words as the status says", f"there are {len(statements)} for {len(unknowns)} unknowns"
    is_right = surplus > case.selecting if is_claimed_over else 0 <= surplus <= case.selecting
    ledger.require(name, words, is_right, found)
    holding = [each for each in statements if not is_over or abs(each.residual) <= case.limit]
    moved = displacement(holding, len(unknowns))
    is_fixed = moved.rank == len(unknowns)
    is_double = not is_fixed and all(_is_alone(holding, unknowns, index, case.reach) for index in moved.free)
    found = f"they fix {moved.rank} of {len(unknowns)} coordinates"
    ledger.require("the words fix the points", words, is_fixed or is_double, found)
    if is_double:
        ledger.omit("how far the points may be off", "two solutions have become one, so that words fix them weakly")
    if is_fixed:
        # What a shift of the start, or the rounding of this very calculation, does to the points.
        unsure = moved.amplification * (ROUNDING * case.reach + case.start_error)
        case.compare(ledger, "the points are where the words put them", words, moved.distance, unsure)


def _is_alone(statements: Sequence[Statement], unknowns: Sequence[float], free: int, reach: float) -> bool:
    """Whether no solutions lie beside one where an unknown is not fixed to first order: where two have become one,
    as where a line touches a circle, steps to either side leave no solution."""
    return all(any(_is_off(statements, unknowns, free, way * step * reach, reach) for step in ASIDE) for way in (1, -1))


def _is_off(statements: Sequence[Statement], unknowns: Sequence[float], free: int, step: float, reach: float) -> bool:
    """Whether there is no solution with one unknown so far aside."""
    others = [index for index in range(len(unknowns)) if index != free]
    at = [value + (step if index == free else 0.0) for index, value in enumerate(unknowns)]
    for _ in range(ITERATIONS):
        here = [_moved(each, unknowns, at) for each in statements]
        moves = displacement([_without(each, free) for each in here], len(others)).moves
        for index, move in zip(others, moves, strict=True):
            at[index] -= move
        if max(map(abs, moves), default=0.0) > reach:
            break
    return any(abs(_moved(each, unknowns, at).residual) > RESIDUAL + ROUNDING * reach for each in statements)


ASIDE = (1e-3, 5e-3)
"""1 (share of the reach). How far aside neighbouring solutions are looked for; where two doubles meet, the nearest are
hardly off."""

ITERATIONS = 10


def _moved(statement: Statement, unknowns: Sequence[float], at: Sequence[float]) -> Statement:
    """A statement at other unknowns."""
    if statement.value is not None:
        try:
            return replace(statement, residual=statement.value(at), at_unknowns=None)
        except UnmeasurableError:
            return replace(statement, residual=inf, at_unknowns=None)
    steps = (other - value for other, value in zip(at, unknowns, strict=True))
    off = sum(slope * step for slope, step in zip(statement.gradient, steps, strict=True))
    return replace(statement, residual=statement.residual + off, at_unknowns=None)


def _without(statement: Statement, index: int) -> Statement:
    return replace(statement, gradient=(*statement.gradient[:index], *statement.gradient[index + 1 :]))
