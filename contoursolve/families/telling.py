"""Why no row of a family has a contour: the reason of most rows, with one of them."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy
from numpy.typing import NDArray

from contoursolve.diagnostic import Severity
from contoursolve.families.examples import weights_of
from contoursolve.families.prepared import Sweep, Table
from contoursolve.solving import Status
from contoursolve.solving.verdict import REASONS, Code


@dataclass(frozen=True, slots=True)
class Telling:
    """The reason that most rows have: how many, the values of one of them as written, and the first error that `solve`
    finds in that one."""

    count: int
    values: Mapping[str, float]
    code: str
    message: str


@dataclass(slots=True)
class Tally:
    """How many rows have each status and reason, and the values of the first of each."""

    words: tuple[str, ...]
    counts: NDArray[numpy.int64] = field(default_factory=lambda: numpy.zeros((len(Code), len(REASONS)), numpy.int64))
    firsts: dict[tuple[int, int], dict[str, float]] = field(default_factory=dict)

    def add(self, table: Table) -> None:
        """Count some rows, in their order."""
        status, reason = table["status"], table["reason"]
        known = self.counts > 0
        numpy.add.at(self.counts, (status, reason), 1)
        for code, number in numpy.argwhere((self.counts > 0) & ~known).tolist():
            row = int(numpy.argmax((status == code) & (reason == number)))
            self.firsts[code, number] = {word: float(table[word][row]) for word in self.words}


def telling_of(ready: Sweep, tally: Tally) -> Telling | None:
    """Why no row has a contour; None where rows have different statuses, or a contour."""
    totals = tally.counts.sum(axis=1)
    code = int(totals.argmax())
    if totals[code] != totals.sum() or Code(code).status in (Status.SOLVED, Status.OVERDETERMINED):
        return None
    if all(kind.status is not None for kind in ready.kinds):
        return _by_kinds(ready)
    number = int(tally.counts[code].argmax())
    values = tally.firsts[code, number]
    return Telling(int(tally.counts[code, number]), values, *_error(ready, values))


def _by_kinds(ready: Sweep) -> Telling:
    """The same where rules tell of all rows: `reason` does not say which."""
    counts, firsts = dict[str, int](), dict[str, tuple[dict[str, float], str]]()
    for (_, numbers), weight in zip(ready.examples.rows, weights_of(ready.examples, ready.ranges), strict=True):
        values = dict(zip(ready.ranges.values, numbers, strict=True))
        code, message = _error(ready, values)
        counts[code] = counts.get(code, 0) + weight
        firsts.setdefault(code, (values, message))
    most = max(counts, key=lambda code: counts[code])
    return Telling(counts[most], firsts[most][0], most, firsts[most][1])


def _error(ready: Sweep, values: Mapping[str, float]) -> tuple[str, str]:
    findings = ready.found.template.solve(values).diagnostics
    return next(((each.code, each.message) for each in findings if each.severity is Severity.ERROR), ("", ""))
