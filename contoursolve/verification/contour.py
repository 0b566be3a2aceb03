"""One contour of a result against its block: where it stands, and if it claims a path, the whole path."""

from contoursolve.reading import Claim
from contoursolve.syntax import FaultKind
from contoursolve.tolerance import LARGEST, RESIDUAL
from contoursolve.verification.case import Case, make_case
from contoursolve.verification.claimed import ClaimedContour
from contoursolve.verification.forms import CHECKERS
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import ROUNDING
from contoursolve.verification.path import check_certificate, check_path
from contoursolve.verification.walk import Found


def check_contour(found: Found, claimed: ClaimedContour) -> tuple[Ledger, bool]:
    """The checks of one contour, and whether a path was among what was checked."""
    ledger, claim = Ledger(), found.claim
    _check_place(claim, claimed, ledger)
    _check_start(claim, claimed, ledger)
    if not claimed.has_path:
        status = claimed.status.value
        ledger.require("a contour with this status has no path", (), claimed.is_empty, f"{status}, with a path")
        ledger.omit("the path", f"claimed {status}: there is none to check")
        ledger.omit("the status", "whether the block can be solved was not examined")
        return ledger, False
    first, second = claim.before.start().values
    checker = CHECKERS.get(claim.form.name)
    if first is None or second is None:
        ledger.omit("the path", "the program does not tell where it starts")
        return ledger, False
    if checker is None:
        ledger.omit("the path", f"contours of the form {claim.form.name} cannot be checked yet")
        return ledger, False
    case = make_case(claim, claimed, (first, second), found.start_error)
    check_path(case, ledger)
    check_certificate(case, ledger)
    if _check_words(case, ledger, checker.reads):
        checker.check(case, ledger)
    return ledger, True


def _check_place(claim: Claim, claimed: ClaimedContour, ledger: Ledger) -> None:
    lines = tuple(block.line for block in claim.blocks)
    shown = ", ".join(map(str, lines))
    ledger.require("the lines are those of its blocks", (), claimed.lines == lines, f"lines {shown} in the program")
    form, axes = claim.form.name, claim.after.plane.axes
    ledger.require("the form is that of its blocks", (), claimed.form == form, f"{form} in the program")
    remark = f"{' '.join(axes)} in the program"
    ledger.require("the plane is the one in force", (), claimed.plane == axes, remark)


def _check_start(claim: Claim, claimed: ClaimedContour, ledger: Ledger) -> None:
    """Where the program stands before the contour: known on the same axes, and the same place."""
    for axis, known, value in zip(claim.before.plane.axes, claim.before.start().values, claimed.start, strict=True):
        name = f"{axis} of the start is the program's position"
        if known is None or value is None:
            remark = "only the result knows it" if known is None else "only the program knows it"
            ledger.require(name, (), known is None and value is None, remark)
        else:
            limit = RESIDUAL + ROUNDING * abs(float(known))
            ledger.measure(name, (), value - float(known), limit)


def _check_words(case: Case, ledger: Ledger, reads: frozenset[str]) -> bool:
    """Whether the blocks can be read at all; words that the form's checker does not look at are listed."""
    claim = case.claim
    faults = [fault.text for block in claim.blocks for fault in block.faults if fault.kind not in _HARMLESS]
    variables = [word.text for word in claim.words.values() if word.number is None]
    # Beyond all travel, and beyond what decimals of 28 digits can reduce to one turn.
    large = [given.word.text for given in claim.givens.values() if given.word and abs(given.value) > LARGEST]
    unreadable = [*faults, *variables, *large, *(word.text for word in (*claim.repeated, *claim.unknown))]
    for name, word in claim.words.items():
        if name not in reads:
            ledger.omit(word.text, "what it does to a contour of this form is not checked")
    remark = "they have no value or no meaning, or are too large"
    return ledger.require("every word can be read", unreadable, not unreadable, remark)


_HARMLESS = (FaultKind.COMMENT_NOT_CLOSED,)
