"""Records as HTML for an output of a notebook, in the notebook's theme and without anything from a network."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import htpy as h
from markupsafe import Markup

from contoursolve.contour import Contour
from contoursolve.diagnostic import Diagnosis, Diagnostic
from contoursolve.examine import Answer
from contoursolve.markup.answers import (
    checks_table,
    cut,
    path_table,
    remarks,
    solutions_table,
    words_table,
)
from contoursolve.markup.figure import figure
from contoursolve.markup.findings import finding_element
from contoursolve.markup.style import notebook_style
from contoursolve.markup.tables import short, table
from contoursolve.notebook.families import FAMILY_PARTS
from contoursolve.notebook.text import (
    contour_rows,
    controls_of,
    freedom_rows,
    result_of,
    text_of,
    tie_rows,
    word_rows,
)
from contoursolve.output.contours import check_rows
from contoursolve.output.layout import count
from contoursolve.output.listing import listed, sources_of, summary_line
from contoursolve.pipeline import Result
from contoursolve.rules import Rule
from contoursolve.shown import Shown
from contoursolve.syntax import Block

MOST_ITEMS = 20
"""Contours and findings that one output shows."""


def html_of(record: Shown) -> str:
    """A record as one element with its style."""
    parts = next((parts for kind, parts in _PARTS.items() if isinstance(record, kind)), _text)
    return str(h.div(".contoursolve")[h.style[Markup(notebook_style())], parts(record)])


def _text(record: Shown) -> Iterator[h.Node]:
    from contoursolve.notebook.bundle import bounded  # noqa: PLC0415 - it calls this module by name

    yield h.pre[bounded(text_of(record))]


def _result(result: Result) -> Iterator[h.Node]:
    items = listed(result)
    if len(result.answers) > 1:
        yield figure(result)
    for item in items[:MOST_ITEMS]:
        if isinstance(item, Answer):
            yield from _contour_of(item, result)
        else:
            yield finding_element(item, result.program.name, sources_of(result, item))
    if len(items) > MOST_ITEMS:
        rest = f"and {len(items) - MOST_ITEMS} more: 'answers' and 'diagnostics' of the result hold all of them, "
        yield h.p[f"{rest}and 'contoursolve report' makes a page"]
    yield h.p[summary_line([result])]


def _answer(answer: Answer) -> Iterator[h.Node]:
    return _contour_of(answer, result_of(answer))


def _contour_of(answer: Answer, result: Result) -> Iterator[h.Node]:
    """The picture, the path, what was given, and the findings of one contour."""
    form = answer.claim.form
    yield h.h3[short(f"{result.program.name}:{answer.lines[0]}: {form.name} ({form.title}): {answer.status.value}")]
    yield figure(answer)
    yield path_table(answer)
    yield from remarks(answer, result.control or "")
    for finding in answer.diagnostics[:MOST_ITEMS]:
        yield finding_element(finding, result.program.name, sources_of(result, finding))
    if len(answer.diagnostics) > MOST_ITEMS:
        yield h.p[f"and {count(len(answer.diagnostics) - MOST_ITEMS, 'finding')} more"]
    yield from solutions_table(answer)
    yield h.details[h.summary["What was given"], words_table(answer)]
    checks = checks_table(answer)
    if checks:
        yield h.details[h.summary["What was checked"], checks]


def _finding(finding: Diagnostic) -> h.Node:
    return finding_element(finding, "<program>", {})


def _diagnosis(diagnosis: Diagnosis) -> Iterator[h.Node]:
    header, *rows = check_rows(diagnosis)
    yield table("Checks", header, rows)
    if diagnosis.freedoms:
        yield table("What can still move", ("point", "how"), cut(freedom_rows(diagnosis)))
    if diagnosis.ties:
        yield table("What says the same", ("words", "formula", "disagreement"), cut(tie_rows(diagnosis)))


def _contour(contour: Contour) -> h.Node:
    header, *rows = contour_rows(contour)
    return table("The path", header, cut(rows), numbers=range(2, len(header)))


def _block(block: Block) -> Iterator[h.Node]:
    yield h.pre[short(block.text)]
    yield table("Words", ("column", "word", "value"), word_rows(block), numbers=(0, 2))


def _rule(rule: Rule) -> Iterator[h.Node]:
    yield h.h3[f"{rule.code} ({rule.severity.value}): {rule.title}"]
    alarm = f"alarm {rule.alarm.number} ({rule.alarm.evidence.value})" if rule.alarm else "no alarm known"
    facts = [
        ("what to do", rule.advice),
        ("source", str(rule.source)),
        ("control", alarm),
        ("applies to", ", ".join(controls_of(rule))),
    ]
    yield table("The rule", ("", ""), facts)
    yield from _examples("Wrong", rule.rejected)
    yield from _examples("Right", rule.accepted)


def _examples(title: str, examples: Iterable[str]) -> Iterator[h.Node]:
    for example in examples:
        yield h.h4[title]
        yield h.pre["\n".join(map(short, example.split("\n")))]


_PARTS: dict[type, Callable[[Any], h.Node]] = {
    Result: _result,
    Answer: _answer,
    Diagnostic: _finding,
    Diagnosis: _diagnosis,
    Contour: _contour,
    Block: _block,
    Rule: _rule,
    **FAMILY_PARTS,
}
