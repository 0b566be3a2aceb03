"""The forms that can be checked: one row a form, by its name in the result."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from contoursolve.model import Arc
from contoursolve.reading import Claim
from contoursolve.verification import g111, g111_standing, lathe, nct, nct_standing, nct_words, ties
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedDiagnosis
from contoursolve.verification.drawing import Drawing
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.standing import Standing


def _never(_case: Case) -> str:
    return ""


@dataclass(frozen=True, slots=True)
class FormChecker:
    """How contours of one form are checked.

    `reads` are the names of the givens that this looks at, `choosing` those whose sign chooses between solutions.
    `elements` and `points` may be mentioned by facts. `redo` makes the contour of the words alone near the claimed
    one, None if they fix none there. `stand` tells how a contour of words alone stands, None where it cannot.
    `diagnose` checks what a diagnosis says of such a contour. `has_slack` tells whether an arc may end off its circle.
    """

    check: Callable[[Case, Ledger], None]
    redo: Callable[[Case], Drawing | None]
    reads: Callable[[Claim], frozenset[str]]
    choosing: Callable[[Claim], tuple[str, ...]]
    stand: Callable[[Case], Standing | None]
    diagnose: Callable[[Case, ClaimedDiagnosis, Ledger], None]
    has_slack: bool = False
    why_not: Callable[[Case], str] = _never
    """Why a contour is not checked; empty if it is."""

    def elements(self, claim: Claim) -> tuple[str, ...]:
        """The elements that facts may mention, and the corners."""
        return (*(each.name for each in claim.form.path), *(corner.name for corner in claim.form.corners))

    def points(self, claim: Claim) -> tuple[str, ...]:
        """The points that facts may mention."""
        centers = [each.center for each in claim.form.path if isinstance(each, Arc)]
        heads = [each.head for each in claim.form.path]
        return tuple(dict.fromkeys((claim.form.start, *centers, *claim.form.points, *heads)))


def _g111_words(_claim: Claim) -> frozenset[str]:
    return g111.READ


def _none(_claim: Claim) -> tuple[str, ...]:
    return ()


def _lathe_words(_claim: Claim) -> frozenset[str]:
    return lathe.READ


_G111 = FormChecker(
    check=g111.check,
    redo=g111.redo,
    reads=_g111_words,
    choosing=_none,
    stand=g111_standing.stand,
    diagnose=ties.check_linear,
)

_NCT = FormChecker(
    check=nct.check,
    redo=nct.redo,
    reads=nct_words.reads,
    choosing=nct_words.choosing,
    stand=nct_standing.stand,
    diagnose=nct_standing.check_ties,
    has_slack=True,
)

_LATHE = FormChecker(
    check=lathe.check,
    redo=lathe.redo,
    reads=_lathe_words,
    choosing=_none,
    stand=lathe.stand,
    diagnose=lathe.check_ties,
    why_not=lathe.why_not,
)

CHECKERS: Mapping[str, FormChecker] = {
    "G111": _G111,
    **dict.fromkeys(("line-angle", "corners", "line-line", "line-circle", "circle-line", "circle-circle"), _NCT),
    "chain": _NCT,
    **dict.fromkeys(("G112", "G11", "G12", "G01"), _LATHE),
}


def foreign(form: str) -> str:
    """Why a contour of a form that has no row is not checked."""
    return f"there are formulas for the forms of the controls that are built in, and {form!a} is none of them"
