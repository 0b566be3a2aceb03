"""A whole result as text: contours with their findings in the order of the program, and what was examined in all."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from heapq import heappop, heappush
from typing import Any, TypeVar

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.controls import DIALECTS
from contoursolve.diagnosis.examine import Answer, rank
from contoursolve.diagnosis.wording import count, statuses_text
from contoursolve.diagnostics.finding import Diagnostic, Fix, Severity
from contoursolve.output.contours import contour_lines
from contoursolve.output.findings import Style, finding_lines
from contoursolve.program.pipeline import Result, Run, without_contour
from contoursolve.program.recognise import what_shows
from contoursolve.solving import Status


def listed(result: Result) -> list[Diagnostic | Answer]:
    """Contours in order, between the findings about other blocks; a contour has its own findings."""
    own = {id(finding) for answer in result.answers for finding in answer.diagnostics}
    items: list[Diagnostic | Answer] = [finding for finding in result.diagnostics if id(finding) not in own]
    items += result.answers
    return sorted(items, key=lambda each: each.lines[0] if isinstance(each, Answer) else each.span.line)


def listing_lines(result: Result, style: Style, *, is_explained: bool = False) -> Iterator[str]:
    """Everything about a result."""
    return _listing_lines(listed(result), result, style, is_explained=is_explained)


def stream_listing(run: Run, tally: "Totals", style: Style, *, is_explained: bool = False) -> Iterator[str]:
    """The same of a stream."""

    def key(item: Answer | Diagnostic) -> Any:
        tally.count(item)
        return (item.lines[0], True) if isinstance(item, Answer) else (item.span.line, False, rank(item))

    return _listing_lines(_in_order((key(item), item) for item in run), run.frame, style, is_explained=is_explained)


def stream_findings(run: Run, tally: "Totals", style: Style) -> Iterator[str]:
    """The findings of a stream, as `check` reports them."""

    def items() -> Iterator[tuple[Any, Diagnostic]]:
        for item in run:
            tally.count(item, is_check=True)
            for finding in findings_of(item):
                yield (rank(finding), isinstance(item, Answer)), without_contour(finding)

    return lines_of_findings(run.frame, _in_order(items()), style)


def findings_of(item: Answer | Diagnostic) -> tuple[Diagnostic, ...]:
    """The findings about a contour; a finding itself."""
    return item.diagnostics if isinstance(item, Answer) else (item,)


_Item = TypeVar("_Item")

_HELD = 1_000
"""Contours and findings that wait for others that belong before them: what is told late may be about an early line."""


def _in_order(items: Iterable[tuple[Any, _Item]]) -> Iterator[_Item]:
    """Items by their keys, as far as so many at a time allow."""
    held: list[tuple[Any, int, _Item]] = []
    for number, (key, item) in enumerate(items):
        heappush(held, (key, number, item))
        if len(held) > _HELD:
            yield heappop(held)[2]
    while held:
        yield heappop(held)[2]


def _listing_lines(
    items: Iterable[Diagnostic | Answer], result: Result, style: Style, *, is_explained: bool
) -> Iterator[str]:
    for item in items:
        if isinstance(item, Answer):
            yield from contour_lines(item, result, is_explained=is_explained)
        yield from lines_of_findings(result, findings_of(item), style)


def lines_of_findings(result: Result, findings: Iterable[Diagnostic], style: Style) -> Iterator[str]:
    """The lines of findings, each with the program's lines that it marks."""
    told: tuple[Fix, ...] = ()
    for finding in findings:
        shown = finding
        if told and finding.fixes == told:
            shown = replace(finding, fixes=(), notes=(*finding.notes, "fixes: those above mend this, too"))
        told = finding.fixes or told
        yield from finding_lines(shown, result.program.name, sources_of(result, finding), style)


def sources_of(result: Result, finding: Diagnostic) -> dict[int, str]:
    """The texts of the lines that a finding marks, by number."""
    blocks = result.program.blocks
    first = blocks[0].line if blocks else 1
    numbers = {label.span.line for label in finding.labels}
    sources = {number: blocks[number - first].text for number in numbers if 0 <= number - first < len(blocks)}
    if result.start:
        sources[0] = result.start.text
    return sources | {fact.span.line: fact.text for fact in result.facts}


def closing_lines(result: Result, tally: "Totals | None" = None) -> Iterator[str]:
    """For which control a program was read and what shows that, and what was found in all: of a result that is only
    the frame of a stream, as it was counted."""
    if result.control is not None:
        own = DIALECTS.get(result.control)
        sign = what_shows(result.program.blocks, own) if own else ""
        yield f"read as {result.control}" + (f": {sign} shows it" if sign else ", as was asked for")
    yield (tally or _tally([result])).line(1)


def summary_line(results: Sequence[Result]) -> str:
    """What was examined and what was found; nothing examined is not the same as nothing found."""
    return _tally(results).line(len(results))


class Totals(Struct, frozen=True):
    """How many contours have each status, and how many findings each severity."""

    statuses: Counter[Status] = field(default_factory=Counter)
    severities: Counter[Severity] = field(default_factory=Counter)

    def count(self, item: Answer | Diagnostic, *, is_check: bool = False) -> None:
        """Count a contour with its findings, or a finding, for `check` as it reports them."""
        if isinstance(item, Answer):
            self.statuses[item.status] += 1
        self.severities.update((without_contour(f) if is_check else f).severity for f in findings_of(item))

    def line(self, programs: int) -> str:
        """What was examined in some programs, and what was found."""
        total, solved = self.statuses.total(), statuses_text(self.statuses)
        found = ", ".join(count(self.severities[each], each.value) for each in Severity if self.severities[each])
        examined = f"{count(total, 'contour')} ({solved})" if total else "no contour examined"
        several = f"{count(programs, 'program')}, " if programs > 1 else ""
        return f"{several}{examined}; {found or 'nothing found'}"


def _tally(results: Sequence[Result]) -> Totals:
    return Totals(
        Counter(answer.status for result in results for answer in result.answers),
        Counter(finding.severity for result in results for finding in result.diagnostics),
    )
