"""The forms that can be checked: one row a form, by its name in the result."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from contoursolve.verification import circle_line, g111
from contoursolve.verification.case import Case
from contoursolve.verification.ledger import Ledger


@dataclass(frozen=True, slots=True)
class FormChecker:
    """How contours of one form are checked, and the names of the givens that this looks at."""

    check: Callable[[Case, Ledger], None]
    reads: frozenset[str]


CHECKERS: Mapping[str, FormChecker] = {
    "G111": FormChecker(g111.check, g111.READ),
    "circle-line": FormChecker(circle_line.check, circle_line.READ),
}
