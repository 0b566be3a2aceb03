"""A whole result as text: contours with their findings in the order of the program, and what was examined in all."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from contoursolve.diagnostic import Diagnostic, Fix, Severity
from contoursolve.dialects import DIALECTS
from contoursolve.examine import Answer
from contoursolve.output.contours import contour_lines
from contoursolve.output.findings import Style, finding_lines
from contoursolve.output.layout import count
from contoursolve.pipeline import Result
from contoursolve.recognise import what_shows
from contoursolve.solving import Status


def listed(result: Result) -> list[Diagnostic | Answer]:
    """Contours in order, between the findings about other blocks; a contour has its own findings."""
    own = {id(finding) for answer in result.answers for finding in answer.diagnostics}
    items: list[Diagnostic | Answer] = [finding for finding in result.diagnostics if id(finding) not in own]
    items += result.answers
    return sorted(items, key=lambda each: each.lines[0] if isinstance(each, Answer) else each.span.line)


def listing_lines(result: Result, style: Style, *, is_explained: bool = False) -> Iterator[str]:
    """Everything about a result."""
    for item in listed(result):
        if isinstance(item, Answer):
            yield from contour_lines(item, result, is_explained=is_explained)
            yield from lines_of_findings(result, item.diagnostics, style)
        else:
            yield from lines_of_findings(result, [item], style)


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


def closing_lines(result: Result) -> Iterator[str]:
    """For which control a program was read and what shows that, and what was found in all."""
    if result.control is not None:
        own = DIALECTS.get(result.control)
        sign = what_shows(result.program.blocks, own) if own else ""
        yield f"read as {result.control}" + (f": {sign} shows it" if sign else ", as was asked for")
    yield summary_line([result])


def summary_line(results: Sequence[Result]) -> str:
    """What was examined and what was found; nothing examined is not the same as nothing found."""
    answers = [answer for result in results for answer in result.answers]
    findings = [finding for result in results for finding in result.diagnostics]
    statuses = Counter(answer.status for answer in answers)
    solved = ", ".join(f"{statuses[status]} {status.value}" for status in reversed(Status) if statuses[status])
    severities = Counter(finding.severity for finding in findings)
    found = ", ".join(count(severities[each], each.value) for each in Severity if severities[each])
    examined = f"{count(len(answers), 'contour')} ({solved})" if answers else "no contour examined"
    programs = f"{count(len(results), 'program')}, " if len(results) > 1 else ""
    return f"{programs}{examined}; {found or 'nothing found'}"
