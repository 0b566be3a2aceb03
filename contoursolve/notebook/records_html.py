"""Records as HTML for an output of a notebook, in the notebook's theme and without anything from a network."""

from collections.abc import Callable, Iterator
from typing import Any

import htpy as h
from markupsafe import Markup

from contoursolve.comparison import Comparison
from contoursolve.diagnosis import Answer, Derivation, count
from contoursolve.diagnostics import Diagnostic, Shown
from contoursolve.notebook.exercises import Exercise
from contoursolve.notebook.records import bounded, result_of, text_of, view_of
from contoursolve.output import (
    checks_table,
    figure,
    finding_element,
    html_text,
    listed,
    notebook_style,
    path_element,
    path_table,
    remarks,
    short,
    solutions_table,
    sources_of,
    summary_line,
    table,
    table_of,
    view_element,
    words_table,
)
from contoursolve.program import Result
from contoursolve.solving import Contour, Drawing, Drawings, Sketch

MOST_ITEMS = 20
"""Contours and findings that one output shows."""


def html_of(record: Shown) -> str:
    """A record as one element with its style."""
    view = view_of(record)
    parts = next((parts for kind, parts in _PARTS.items() if isinstance(record, kind)), _text)
    shown = parts(record) if view is None else view_element(view)
    return html_text(h.div(".contoursolve")[h.style[Markup(notebook_style())], shown])


def _text(record: Shown) -> Iterator[h.Node]:
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
    yield h.p[summary_line(result, is_explained=True)]


def _answer(answer: Answer) -> Iterator[h.Node]:
    return _contour_of(answer, result_of(answer))


def _contour_of(answer: Answer, result: Result) -> Iterator[h.Node]:
    """The picture, the path, what was given, and the findings of one contour."""
    yield h.h3[short(f"{result.program.name}:{answer.lines[0]}: {answer.form_text}: {answer.state}")]
    yield figure(answer)
    yield path_element(answer)
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


def _contour(contour: Contour) -> h.Node:
    return table_of(path_table(contour))


def _sketch(record: Sketch | Drawings | Drawing) -> Iterator[h.Node]:
    yield figure(record)
    yield from _text(record)


def _derivation(derivation: Derivation) -> Iterator[h.Node]:
    from contoursolve.output import derivation_element  # noqa: PLC0415 - sympy is slow to import

    yield from derivation_element(derivation)


def _exercise(made: Exercise) -> Iterator[h.Node]:
    yield h.p[f"The tool stands at {made.start}"]
    yield h.pre[made.block]
    yield h.p[made.question]
    yield h.ul[(h.li[f"{letter}: {choice.value:.3f}"] for letter, choice in made.letters)]
    wrong = [(letter, f"{choice.value:.3f}", choice.why) for letter, choice in made.letters if choice.why]
    told = table("Why the others come out", ("answer", "value", "because"), wrong, numbers=(1,))
    yield h.details[h.summary["Solution"], h.p[f"{made.right} is right."], _derivation(made.solution), told]


def _comparison(comparison: Comparison) -> Iterator[h.Node]:
    yield figure(comparison)
    yield from _text(comparison)


_PARTS: dict[type, Callable[[Any], h.Node]] = {
    Result: _result,
    Answer: _answer,
    Diagnostic: _finding,
    Contour: _contour,
    Sketch: _sketch,
    Drawings: _sketch,
    Drawing: _sketch,
    Derivation: _derivation,
    Exercise: _exercise,
    Comparison: _comparison,
}
