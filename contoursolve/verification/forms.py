"""The forms that can be checked: one row a form, by its name in the result."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from contoursolve.verification import circle_line, circle_line_standing, circle_line_stated, g111, g111_standing, ties
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedDiagnosis
from contoursolve.verification.drawing import Drawing
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.standing import Standing


@dataclass(frozen=True, slots=True)
class FormChecker:
    """How contours of one form are checked.

    `reads` are the names of the givens that this looks at, `choosing` those whose sign chooses between solutions.
    `elements` and `points` may be mentioned by facts. `redo` makes the contour of the words alone near the claimed
    one, None if they fix none there. `stand` tells how a contour of words alone stands, None where it cannot.
    `diagnose` checks what a diagnosis says of such a contour.
    """

    check: Callable[[Case, Ledger], None]
    redo: Callable[[Case], Drawing | None]
    reads: frozenset[str]
    choosing: tuple[str, ...]
    stand: Callable[[Case], Standing | None]
    diagnose: Callable[[Case, ClaimedDiagnosis, Ledger], None]
    elements: tuple[str, ...]
    points: tuple[str, ...]


CHECKERS: Mapping[str, FormChecker] = {
    "G111": FormChecker(
        check=g111.check,
        redo=g111.redo,
        reads=g111.READ,
        choosing=(),
        stand=g111_standing.stand,
        diagnose=ties.check_linear,
        elements=("line 1", "line 2", "corner 1", "corner 2"),
        points=("S", "V1", "V2"),
    ),
    "circle-line": FormChecker(
        check=circle_line.check,
        redo=circle_line_stated.redo,
        reads=circle_line.READ,
        choosing=circle_line.CHOOSING,
        stand=circle_line_standing.stand,
        diagnose=circle_line_standing.check_ties,
        elements=("arc", "line"),
        points=("S", "C", "N1", "P1", "N2"),
    ),
}
