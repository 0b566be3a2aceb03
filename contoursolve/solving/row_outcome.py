"""The verdict on each of many rows, by the table of checks."""

from collections.abc import Mapping, Sequence

import numpy
from numpy.typing import NDArray

from contoursolve.numeric import Array
from contoursolve.solving.checks import Check, CheckOutputs, Stage
from contoursolve.solving.events import RefusalKind, Status
from contoursolve.solving.path_outputs import PathOutputs

Mask = NDArray[numpy.bool_]
Codes = NDArray[numpy.uint8]
Places = NDArray[numpy.intp]
Out = Mapping[str, Array]


REASONS: tuple[RefusalKind | None, ...] = (None, *RefusalKind)
"""The meaning of a number in the column `reason`."""

_REASON = {kind: number for number, kind in enumerate(REASONS)}


def reason_of(kind: RefusalKind | None) -> int:
    """The number of a reason."""
    return _REASON[kind]


UNVERIFIED = reason_of(RefusalKind.NOT_VERIFIED)
"""The number of the reason that rounding keeps equations from holding."""


class RowOutcome:
    """The findings of the checks, row by row: `status` and `reason` as numbers; and the rows `again` that need the
    exact arithmetic of a single solve: a step that is singular, a line that touches its circle.

    `out` has the outputs of the checks, and the cosines at the corners.
    """

    def __init__(self, outputs: CheckOutputs, out: Out, rows: int) -> None:
        checks, passed = outputs.checks, numpy.broadcast_to(out[outputs.passed], rows)
        self.is_clear: Mask = passed == len(checks)
        """Where every check is passed."""
        self.reason: Codes = numpy.zeros(rows, numpy.uint8)
        self.again: Mask = numpy.zeros(rows, bool)
        self.agreeing: dict[str, Mask] = {}
        """Where a fact that was not needed agrees, by the value that it states."""
        self.differing: dict[str, Mask] = {}
        self._conflicts: Mask = numpy.zeros(rows, bool)
        rest = numpy.flatnonzero(~self.is_clear)
        if rest.size:
            self._note_first(checks, rest, passed[rest].astype(numpy.intp), outputs.path.read(out.get))
        if outputs.margins:
            # The first such check is about the points; that of the corners comes last.
            points = next(number for number, check in enumerate(checks) if check.stage is Stage.EQUATIONS)
            is_solved = passed != points
            for number, margin in outputs.margins.items():
                self._compare(checks[number], out[margin], is_solved)

    @property
    def status(self) -> Codes:
        """The statuses; of several, the first in the order of `Status`."""
        status: Codes = (self.reason != 0).view(numpy.uint8) * numpy.uint8(Status.NO_SOLUTION.code)
        for agrees in self.agreeing.values():
            status[agrees] = Status.OVERDETERMINED.code
        status[self._conflicts] = Status.CONFLICTING.code
        return status

    def _note_first(self, checks: Sequence[Check], rows: Places, failed: Places, path: PathOutputs) -> None:
        """Rows with the first check that each fails."""
        self.again[rows] = numpy.array([check.is_doubtful for check in checks])[failed]
        self.reason[rows] = numpy.array([_reason_where(check) for check in checks], numpy.uint8)[failed]
        for number, check in enumerate(checks):
            if check.opposite is not None:
                bent = rows[failed == number]
                cosine = numpy.broadcast_to(path.corners[check.subject].cosine, self.reason.size)[bent]
                self.reason[bent[~(cosine > 0)]] = reason_of(check.opposite)

    def _compare(self, check: Check, margin: Array, is_solved: Mask) -> None:
        """A fact that was not needed, at the points that the others give."""
        is_known = numpy.isfinite(margin) & is_solved
        agrees = (margin >= check.limit) & is_known
        differs = is_known & ~agrees
        if check.fact:
            # A fact may have several checks.
            self.differing[check.fact] = self.differing.get(check.fact, False) | differs
            self.agreeing[check.fact] = self.agreeing.get(check.fact, True) & agrees
        self._conflicts |= differs


def _reason_where(check: Check) -> int:
    """The reason against rows of which it is the first check that fails."""
    return reason_of(None if check.is_doubtful and check.stage is not Stage.FACTS else check.kind)
