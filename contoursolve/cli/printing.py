"""Lines on the terminal: findings with their places, and what was examined in all."""

import os
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Any

import click

from contoursolve.diagnostic import Diagnostic, Severity
from contoursolve.output.findings import Style, finding_lines, plain
from contoursolve.output.layout import count
from contoursolve.pipeline import Result
from contoursolve.solving import Status

_COLORS: dict[str, dict[str, Any]] = {
    "error": {"fg": "red", "bold": True},
    "warning": {"fg": "yellow", "bold": True},
    "info": {"fg": "cyan", "bold": True},
    "frame": {"fg": "blue", "bold": True},
    "bold": {"bold": True},
}


def style_of_output() -> Style:
    """Colours, unless NO_COLOR asks for none; click leaves them out where there is no terminal."""
    if os.environ.get("NO_COLOR"):
        return plain
    return lambda text, role: click.style(text, **_COLORS[role]) if text else text


def print_lines(lines: Iterable[str]) -> None:
    """Print lines in batches: a call of click for each would take longer than solving."""
    for batch in _batched(lines, 1_000):
        click.echo("\n".join(batch))


def _batched(lines: Iterable[str], size: int) -> Iterator[list[str]]:
    """Lists of up to `size` lines (itertools.batched is in Python 3.12)."""
    iterator = iter(lines)
    while batch := list(islice(iterator, size)):
        yield batch


def lines_of_findings(result: Result, findings: Iterable[Diagnostic], style: Style) -> Iterator[str]:
    """The lines of findings, each with the program's lines that it marks."""
    blocks = result.program.blocks
    first = blocks[0].line if blocks else 1
    for finding in findings:
        numbers = {label.span.line for label in finding.labels}
        sources = {number: blocks[number - first].text for number in numbers if 0 <= number - first < len(blocks)}
        if result.start:
            sources[0] = result.start.text
        sources |= {fact.span.line: fact.text for fact in result.facts}
        yield from finding_lines(finding, result.program.name, sources, style)


def print_summary(results: Sequence[Result]) -> None:
    """What was examined and what was found; nothing examined is not the same as nothing found."""
    answers = [answer for result in results for answer in result.answers]
    findings = [finding for result in results for finding in result.diagnostics]
    statuses = Counter(answer.status for answer in answers)
    solved = ", ".join(f"{statuses[status]} {status.value}" for status in reversed(Status) if statuses[status])
    severities = Counter(finding.severity for finding in findings)
    found = ", ".join(count(severities[each], each.value) for each in Severity if severities[each])
    examined = f"{count(len(answers), 'contour')} ({solved})" if answers else "no contour examined"
    programs = f"{count(len(results), 'program')}, " if len(results) > 1 else ""
    click.echo(f"{programs}{examined}; {found or 'nothing found'}")
