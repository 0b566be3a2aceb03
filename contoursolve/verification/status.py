"""The status of a contour, and the number of its solutions, worked out again from its words."""

from collections.abc import Mapping
from dataclasses import replace
from decimal import Decimal

from contoursolve.dialects import DIALECTS
from contoursolve.tolerance import LARGEST
from contoursolve.verification.case import Case, make_case
from contoursolve.verification.claimed import (
    ClaimedCertificate,
    ClaimedContour,
    ClaimedPath,
    ClaimedStatus,
    Rules,
)
from contoursolve.verification.examination import examine, signs_of
from contoursolve.verification.facts import read_facts
from contoursolve.verification.forms import CHECKERS, FormChecker, foreign
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.refusals import refused, unaskable, unreadable
from contoursolve.verification.standing import Candidate, Standing
from contoursolve.verification.walk import Found

_NOT_ASKED = "with further facts or values that are asked for it was not worked out"


def check_status(found: Found, claimed: ClaimedContour, ledger: Ledger) -> bool:
    """Whether the status could be worked out; if it could, it is held against the claimed one."""
    is_settled = _check_rejected(found, claimed, ledger)
    if is_settled is not None:
        return is_settled
    claim = found.claim
    checker = CHECKERS.get(claim.form.name)
    has_list = claimed.has_path or claimed.status is ClaimedStatus.AMBIGUOUS
    if claim.directives or any(word.is_asked for word in claim.words.values()) or checker is None:
        why = _NOT_ASKED if checker else foreign(claim.form.name)
        if not has_list:
            ledger.omit("the status", why)
        ledger.omit("whether these are all solutions", why)
        return False
    standing = _stand(found, claimed, checker)
    if standing is None:
        ledger.omit("the status", "rounding, or the order in which words are solved for, decides it")
        return False
    feasible = [each for each in standing.candidates or () if _is_path(found, claimed, each, standing)]
    expected = _expected(standing, feasible, signs_of(claim, checker.choosing(claim)))
    words = [word.text for word in claim.words.values()]
    remark = f"the result says {claimed.status.value}, and by the words it is {expected.value}"
    ledger.require("the status is the one that the words give", words, claimed.status is expected, remark)
    if not standing.is_all:
        ledger.omit("whether these are all solutions", "there are too many to go through, or a half circle is rounded")
    elif claimed.count is not None and standing.candidates is not None:
        count, there = claimed.count, (len(standing.candidates), len(feasible))
        remark = (
            f"the result has {count.solutions}, of which {count.contours} can be made, and by the words there are "
            f"{there[0]}, of which {there[1]} can be made"
        )
        is_all = (count.solutions, count.contours) == there
        ledger.require("the solutions are all that there are", words, is_all, remark)
    return True


def _check_rejected(found: Found, claimed: ClaimedContour, ledger: Ledger) -> bool | None:
    """Whether a block had to be rejected; None if it had not, and was not."""
    claim, is_rejected = found.claim, claimed.status is ClaimedStatus.REJECTED
    checker = CHECKERS.get(claim.form.name)
    facts = read_facts(claim, checker.elements(claim), checker.points(claim), found.apart) if checker else ()
    reasons = [*unreadable(claim), *(each.text for each in facts if each.fact is None)]
    if checker and not claim.directives:
        reasons += unaskable(claim, checker.reads(claim))
    is_extended = bool(claim.directives) or any(word.is_asked for word in claim.words.values())
    has_sheet = checker is not None and found.dialect.name in DIALECTS
    if is_rejected and not reasons and not has_sheet:
        ledger.omit("the status", f"what the manual of {found.dialect.name} refuses is known to its tables alone")
        return False
    # What states or asks more than the control reads is not a block for the control yet: its rules only warn.
    if has_sheet and not is_extended and (found.rules is Rules.ENFORCE or (found.rules is None and is_rejected)):
        reasons += refused(claim)
    name = "a block that cannot be read, or that the sheet refuses, is rejected, and no other"
    if reasons or (is_rejected and not claim.directives):
        against = "; ".join(reasons) or "nothing was found against it"
        remark = f"the result says {claimed.status.value}, and {against}"
        ledger.require(name, [word.text for word in claim.words.values()], is_rejected and bool(reasons), remark)
        return True
    if is_rejected:
        ledger.omit("the status", "whether the facts say something about this contour was not examined")
        return False
    return None


def check_diagnosis(found: Found, claimed: ClaimedContour, ledger: Ledger) -> None:
    """What the diagnosis says of the equations, where they are those of words alone."""
    claim, diagnosis = found.claim, claimed.diagnosis
    checker = CHECKERS.get(claim.form.name)
    if diagnosis is None or checker is None:
        return
    is_known = None not in claim.before.start().values and not any(block.faults for block in claim.blocks)
    is_extended = bool(claim.directives) or any(word.is_asked for word in claim.words.values())
    is_whole = diagnosis.ties_complete == (is_known and not is_extended)
    ledger.require(
        "ties are complete where the block can be read and has no further facts", (), is_whole, "it says the opposite"
    )
    if is_extended:
        ledger.omit("the ties and freedoms of the diagnosis", "with further facts they were not worked out")
    elif is_known:
        checker.diagnose(_nowhere(found, claimed, checker), diagnosis, ledger)
    else:
        ledger.omit(
            "the ties and freedoms of the diagnosis", "without a start, or with errors, they were not worked out"
        )


def _nowhere(found: Found, claimed: ClaimedContour, checker: FormChecker) -> Case:
    """The contour without a path, from where it starts; from zero if that is not known."""
    first, second = found.claim.before.start().values
    at = (first or Decimal(0), second or Decimal(0))
    case = make_case(found.claim, replace(claimed, path=ClaimedPath(None, {}, ())), at, 0.0)
    return replace(case, rules=found.rules, choices=signs_of(found.claim, checker.choosing(found.claim)))


def _stand(found: Found, claimed: ClaimedContour, checker: FormChecker) -> Standing | None:
    claim = found.claim
    if any(word.number is None for word in claim.words.values()):
        return Standing(is_loose=True)  # a variable
    standing = checker.stand(_nowhere(found, claimed, checker))
    if None not in claim.before.start().values:
        return standing
    return Standing(disagrees=standing.disagrees if standing and standing.is_twice else "", is_loose=True)


def _expected(standing: Standing, feasible: list[Candidate], chosen: Mapping[str, int]) -> ClaimedStatus:
    """The first that holds, in the order of precedence."""
    eligible = [each for each in feasible if all(each.signs.get(name, sign) == sign for name, sign in chosen.items())]
    statuses = (
        (bool(standing.disagrees), ClaimedStatus.CONFLICTING),
        (standing.is_loose, ClaimedStatus.UNDERDETERMINED),
        (standing.is_over, ClaimedStatus.OVERDETERMINED),
        (len(eligible) > 1, ClaimedStatus.AMBIGUOUS),
        (not eligible, ClaimedStatus.NO_SOLUTION),
    )
    return next((status for holds, status in statuses if holds), ClaimedStatus.SOLVED)


def _is_path(found: Found, claimed: ClaimedContour, candidate: Candidate, standing: Standing) -> bool:
    """Whether the checks of the form find nothing against a path that was made here."""
    if candidate.path is None:
        return False
    start = found.claim.before.start().values
    pairs = (pair for at in candidate.path.points.values() for pair in zip(at, start, strict=True))
    if any(abs(value - float(origin or 0)) > LARGEST for value, origin in pairs):
        return False  # no word reaches it
    alone = replace(
        claimed,
        status=ClaimedStatus.OVERDETERMINED if standing.is_over else ClaimedStatus.SOLVED,
        path=candidate.path,
        branch=None,
        certificate=ClaimedCertificate("unknown", None),
        filled=None,
        asked=None,
        solutions=None,
        count=None,
    )
    ledger = Ledger()
    examine(found, alone, ledger, candidate.signs)
    return not ledger.failures
