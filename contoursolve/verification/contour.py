"""One contour of a result against its block: where it stands, its path if it claims one, and all its solutions."""

from collections import Counter
from collections.abc import Iterable, Sequence

from contoursolve.reading import Claim
from contoursolve.tolerance import RESIDUAL
from contoursolve.verification.claimed import ClaimedAsked, ClaimedContour
from contoursolve.verification.examination import examine
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import ROUNDING
from contoursolve.verification.solutions import check_solutions
from contoursolve.verification.status import check_diagnosis, check_status
from contoursolve.verification.walk import Found


def check_contour(found: Found, claimed: ClaimedContour) -> tuple[Ledger, bool]:
    """The checks of one contour, and whether a path was among what was checked."""
    ledger, claim = Ledger(), found.claim
    _check_place(claim, claimed, ledger)
    _check_start(claim, claimed, ledger)
    _check_facts(claim, claimed, ledger)
    _check_conventions(claim, claimed, ledger)
    if claimed.has_path:
        is_checked = examine(found, claimed, ledger)
    else:
        is_checked, status = False, claimed.status.value
        ledger.require(
            "a contour with this status has no path", (), claimed.path.is_empty, f"it is {status}, with a path"
        )
        ledger.omit("the path", f"claimed {status}: there is none to check")
        given = (claimed.certificate.radius, claimed.certificate.gap, claimed.branch, claimed.branches or None)
        is_bare = all(each is None for each in given)
        ledger.require("without a path nothing is certified or chosen", (), is_bare, "the result does so")
        values = [each.word for each in claimed.asked or () if each.value is not None]
        ledger.require("without a path no value is known", values, not values, "the result answers what is asked for")
        ledger.require("without a path nothing is filled in", (), claimed.filled is None, "there are filled blocks")
    for asked in (claimed.asked, *(each.asked for each in claimed.solutions or ())):
        _check_questions(claim, asked or (), ledger)
    is_checked |= check_status(found, claimed, ledger)
    check_diagnosis(found, claimed, ledger)
    return ledger, check_solutions(found, claimed, ledger) or is_checked


def _check_place(claim: Claim, claimed: ClaimedContour, ledger: Ledger) -> None:
    lines = tuple(block.line for block in claim.blocks)
    shown = ", ".join(map(str, lines))
    ledger.require(
        "the lines are those of its blocks",
        (),
        claimed.lines == lines,
        f"they are lines {shown}, and the result has {_list(map(str, claimed.lines))}",
    )
    form, axes = claim.form.name, claim.after.plane.axes
    ledger.require(
        "the form is that of its blocks",
        (),
        claimed.form == form,
        f"it is {form}, and the result has {ascii(claimed.form)[:60]}",
    )
    remark = f"it is {' '.join(axes)}, and the result has {' '.join(map(ascii, claimed.plane))[:60]}"
    ledger.require("the plane is the one in force", (), claimed.plane == axes, remark)


def _check_start(claim: Claim, claimed: ClaimedContour, ledger: Ledger) -> None:
    """Where the program stands before the contour: known on the same axes, and the same place."""
    for axis, known, value in zip(claim.before.plane.axes, claim.before.start().values, claimed.start, strict=True):
        name = f"{axis} of the start is the program's position"
        if known is None or value is None:
            remark = f"the program is at {known} mm, and the result has none"
            if known is None and value is not None:
                remark = (
                    f"the program does not tell it, and the result has {value:g} mm; if it was solved with --start, "
                    "verify with the same --start"
                )
            ledger.require(name, (), known is None and value is None, remark)
        else:
            limit = RESIDUAL + ROUNDING * abs(float(known))
            ledger.measure(name, (), value - float(known), limit)


def _check_questions(claim: Claim, asked: Sequence[ClaimedAsked], ledger: Ledger) -> None:
    """Every answer is to a question that the program asks there."""
    places = [(word.text, word.span.line) for word in claim.words.values() if word.is_asked]
    places += [(each.text, each.span.line) for each in claim.directives]
    for each in asked:
        is_known = (each.word, each.line) in places
        ledger.require("what is answered is asked there", [each.word], is_known, f"it is not on line {each.line}")


def _check_conventions(claim: Claim, claimed: ClaimedContour, ledger: Ledger) -> None:
    """The result names the conventions on which the reading of these blocks rests, and their values."""
    if claimed.conventions is not None:
        known = [(each.setting.name, each.value) for each in claim.conventions]
        shown, other = (_list(f"{name}={value}" for name, value in each) for each in (known, claimed.conventions))
        is_same = sorted(claimed.conventions) == sorted(known)
        ledger.require(
            "the conventions are those in force", (), is_same, f"they are {shown}, and the result has {other}"
        )


def _list(texts: Iterable[str]) -> str:
    return ", ".join(texts) or "none"


def _check_facts(claim: Claim, claimed: ClaimedContour, ledger: Ledger) -> None:
    """The result lists every fact of the program."""
    if claimed.facts is not None:
        missing = Counter(each.text for each in claim.directives) - Counter(claimed.facts)
        texts = list(missing.elements())
        if claim.directives:
            ledger.require("the result lists the facts of the program", texts, not texts, "it does not")
