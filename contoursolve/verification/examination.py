"""A claimed path against the words and facts of its blocks."""

from collections.abc import Mapping
from dataclasses import replace

from contoursolve.reading import Claim
from contoursolve.verification.case import Case, make_case
from contoursolve.verification.claimed import ClaimedContour
from contoursolve.verification.facts import check_readable, read_facts
from contoursolve.verification.filled import check_filled
from contoursolve.verification.forms import CHECKERS, foreign
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.path import check_certificate, check_path
from contoursolve.verification.refusals import HARMLESS, too_large
from contoursolve.verification.walk import Found


def examine(found: Found, claimed: ClaimedContour, ledger: Ledger, selected: Mapping[str, int] | None = None) -> bool:
    """Check a claimed path; whether there was anything to check it by.

    `selected` are the signs of the words that choose, for a solution that is listed beside the contour.
    """
    claim = found.claim
    first, second = claim.before.start().values
    checker = CHECKERS.get(claim.form.name)
    if first is None or second is None:
        ledger.omit("the path", "the program does not tell where it starts")
        return False
    if checker is None:
        ledger.omit("the path", foreign(claim.form.name))
        return False
    case = make_case(claim, claimed, (first, second), found.start_error)
    case = replace(
        case,
        facts=read_facts(claim, checker.elements(claim), checker.points(claim), found.apart),
        choices=signs_of(claim, checker.choosing(claim)) if selected is None else selected,
        is_listed=selected is not None,
        selecting=_selecting(claimed),
        next_end=case.place(found.next_end) if found.next_end else None,
        rules=found.rules,
    )
    check_path(case, ledger, case.slack if checker.has_slack else 0.0)
    check_certificate(claimed.certificate, case.limit, ledger)
    why_not = checker.why_not(case)
    if why_not:
        ledger.omit("the path", why_not)
        return False
    if _check_words(case, ledger, checker.reads(claim)) and check_readable(case.facts, ledger):
        checker.check(case, ledger)
        check_filled(case, ledger, checker, found.dialect)
    return True


def _selecting(claimed: ClaimedContour) -> int:
    """How many words and facts the result names because a solution that it lists is none by them."""
    reasons = [reason.partition(" ") for each in claimed.solutions or () for reason in each.reasons if not each.is_path]
    return len({about for kind, _, about in reasons if kind in ("words-disagree", "fact-disagrees")})


def signs_of(claim: Claim, names: tuple[str, ...]) -> dict[str, int]:
    """The signs of words that have a value other than zero."""
    numbers = {name: claim.words[name].number for name in names if name in claim.words}
    return {name: 1 if number > 0 else -1 for name, number in numbers.items() if number}


def _check_words(case: Case, ledger: Ledger, reads: frozenset[str]) -> bool:
    """Whether the blocks can be read at all; words that the form's checker does not look at are listed."""
    claim = case.claim
    faults = [fault.text for block in claim.blocks for fault in block.faults if fault.kind not in HARMLESS]
    variables = [word.text for word in claim.words.values() if word.number is None and not word.is_asked]
    unreadable = [*faults, *variables, *too_large(claim), *(word.text for word in (*claim.repeated, *claim.unknown))]
    for name, word in claim.words.items():
        if name not in reads:
            ledger.omit(word.text, "what it does to a contour of this form is not checked")
    remark = "they have no value or no meaning, or are too large"
    return ledger.require("every word can be read", unreadable, not unreadable, remark)
