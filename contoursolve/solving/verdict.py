"""The verdict on each of many rows, by the table of checks."""

from collections.abc import Mapping, Sequence
from enum import IntEnum

import numpy
from numpy.typing import NDArray

from contoursolve.backends.columns import Array
from contoursolve.solving.checks import Check, Role, Test
from contoursolve.solving.solution import RefusalKind, Status

Mask = NDArray[numpy.bool_]
Codes = NDArray[numpy.uint8]
Places = NDArray[numpy.int64]
Out = Mapping[str, Array]


class Code(IntEnum):
    """A status in a column of numbers."""

    SOLVED = 0
    OVERDETERMINED = 1
    REJECTED = 2
    CONFLICTING = 3
    UNDERDETERMINED = 4
    AMBIGUOUS = 5
    NO_SOLUTION = 6
    UNDECIDED = 7

    @property
    def status(self) -> Status:
        """The status that it stands for."""
        return Status[self.name]


REASONS: tuple[RefusalKind | None, ...] = (None, *RefusalKind)
"""What a number in the column `reason` stands for."""

_REASON = {kind: number for number, kind in enumerate(REASONS)}


def code_of(status: Status) -> Code:
    """The number of a status."""
    return Code[status.name]


def reason_of(kind: RefusalKind | None) -> int:
    """The number of a reason."""
    return _REASON[kind]


class Verdict:
    """What the checks found, row by row: `status` and `reason` as numbers; and the rows `again` that need the exact
    arithmetic of a single solve: a step that is singular, a line that touches its circle.

    The outputs hold the margins of the checks, by number. With `among`, the other rows are known to pass all checks.
    """

    def __init__(self, checks: Sequence[Check], out: Out, rows: int, among: Places | None = None) -> None:
        self.out = out
        self.reason: Codes = numpy.zeros(rows, numpy.uint8)
        self.again: Mask = numpy.zeros(rows, bool)
        self.agreeing: dict[str, Mask] = {}
        """Where a fact that was not needed agrees, by the value that it states."""
        self.differing: dict[str, Mask] = {}
        self._conflicts: Mask = numpy.zeros(rows, bool)
        self._open: Places = numpy.arange(rows) if among is None else among
        """The rows against which nothing was found until here."""
        self._wrong: Mask = numpy.zeros(rows, bool)
        with numpy.errstate(invalid="ignore"):
            for number, check in enumerate(checks):
                if check.role is Role.FACT:
                    self._compare(check, numpy.broadcast_to(out[f"margin:{number}"], rows))
                elif self._open.size:
                    self._examine(check, self._of(f"margin:{number}"))

    @property
    def status(self) -> Codes:
        """The statuses; of several, the first in the order of `Status`."""
        status: Codes = (self.reason != 0).view(numpy.uint8) * numpy.uint8(Code.NO_SOLUTION)
        for agrees in self.agreeing.values():
            status[agrees] = Code.OVERDETERMINED
        status[self._conflicts] = Code.CONFLICTING
        return status

    def _of(self, name: str) -> Array:
        """An output in the rows that are open."""
        column = self.out[name]
        if column.size == 1:
            return numpy.broadcast_to(column, self._open.size)
        return column if self._open.size == self.reason.size else column[self._open]

    def _examine(self, check: Check, margin: Array) -> None:
        fails = _fails(check, margin)
        if not fails.any():
            return
        rows = self._open[fails]
        if check.is_doubtful:
            self.again[rows] = True
        elif check.opposite is not None:
            is_straight = self._of(f"cosine:{check.subject}")[fails] > 0
            self.reason[rows] = numpy.where(is_straight, reason_of(check.kind), reason_of(check.opposite))
        else:
            self.reason[rows] = reason_of(check.kind)
        if check.role is Role.EQUATION:
            self._wrong[rows] = True
        self._open = self._open[~fails]

    def _compare(self, check: Check, margin: Array) -> None:
        """A fact that was not needed, at the points that the others give."""
        fails, is_known = _fails(check, margin), numpy.isfinite(margin) & ~self._wrong
        differs = fails & is_known
        if check.fact:
            # A fact may have several checks.
            agrees = ~fails & is_known
            self.differing[check.fact] = self.differing.get(check.fact, False) | differs
            self.agreeing[check.fact] = self.agreeing.get(check.fact, True) & agrees
        self._conflicts |= differs
        is_new = differs & (self.reason == 0)
        if check.is_doubtful:
            self.again |= is_new
        self.reason[is_new] = reason_of(check.kind)
        self._open = self._open[~differs[self._open]]


def _fails(check: Check, margin: Array) -> Mask:
    """Where a check is not passed; `checks.is_passed` says the same of expressions."""
    match check.test:
        case Test.AT_LEAST:
            return ~(margin >= check.limit)
        case Test.ABOVE:
            return ~(margin > check.limit)
        case Test.NOT_BELOW:
            return margin < check.limit
        case Test.APART:
            return ~(numpy.abs(margin) > check.limit)
