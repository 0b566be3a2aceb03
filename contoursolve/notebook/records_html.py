"""Records as HTML for an output of a notebook, in the notebook's theme and without anything from a network."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import htpy as h
from markupsafe import Markup
from msgspec.structs import replace

from contoursolve.comparison import Comparison
from contoursolve.diagnosis import Answer, Derivation, EquationSystem, count, join
from contoursolve.diagnostics import Diagnosis, Diagnostic, Shown
from contoursolve.families import (
    TOOL,
    Family,
    FeasibleRange,
    FeasibleRegion,
    FoundValues,
    Sensitivity,
    ToleranceRange,
    Tolerances,
)
from contoursolve.gcode import Block
from contoursolve.notebook.exercises import Exercise
from contoursolve.notebook.records import (
    bounded,
    controls_of,
    diagnosis_tables,
    family_tables,
    result_of,
    slope_table,
    text_of,
    word_table,
)
from contoursolve.output import (
    check_table,
    checks_table,
    contribution_table,
    figure,
    finding_element,
    found_table,
    found_title,
    html_text,
    listed,
    notebook_style,
    path_element,
    path_table,
    range_notes,
    range_table,
    range_title,
    region_notes,
    region_table,
    region_title,
    remarks,
    rest_lines,
    short,
    solutions_table,
    sources_of,
    spread_lines,
    summary_line,
    table,
    table_of,
    tolerances_title,
    word_tolerance_notes,
    word_tolerance_table,
    word_tolerance_title,
    words_table,
)
from contoursolve.program import Result
from contoursolve.reading import Rule
from contoursolve.solving import Contour, Drawing, Drawings, Sketch

MOST_ITEMS = 20
"""Contours and findings that one output shows."""

MAP_WORDS = 2
"""Free words of a family that a map shows."""


def html_of(record: Shown) -> str:
    """A record as one element with its style."""
    parts = next((parts for kind, parts in _PARTS.items() if isinstance(record, kind)), _text)
    return html_text(h.div(".contoursolve")[h.style[Markup(notebook_style())], parts(record)])


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


def _diagnosis(diagnosis: Diagnosis) -> Iterator[h.Node]:
    yield table_of(check_table(diagnosis))
    yield from map(table_of, diagnosis_tables(diagnosis))


def _contour(contour: Contour) -> h.Node:
    return table_of(path_table(contour))


def _block(block: Block) -> Iterator[h.Node]:
    yield h.pre[short(block.text)]
    yield table_of(word_table(block))


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
    yield from _examples("Wrong", rule.told.rejected)
    yield from _examples("Right", rule.told.accepted)


def _examples(title: str, examples: Iterable[str]) -> Iterator[h.Node]:
    for example in examples:
        yield h.h4[title]
        yield h.pre["\n".join(map(short, example.split("\n")))]


# Families ----------------------------------------------------------------------------------------------------


def _family(family: Family) -> Iterator[h.Node]:
    several = [values for values in family.ranges.values.values() if values.size > 1]
    is_fan = len(several) == 1 and TOOL not in family.ranges.values and family.has_contour.any()
    is_drawn = is_fan or len(family.ranges.values) == MAP_WORDS
    if is_drawn and not (family.ranges.is_paired or family.solutions):
        yield figure(family)
    yield from map(table_of, family_tables(family))
    title = f"{count(len(family.names), 'array')} of shape {' x '.join(map(str, family.shape))}"
    yield h.details[h.summary[title], ", ".join(family.names)]
    if family.solutions:
        yield h.p[short(f"Solutions: {join(list(family.solutions))}.")]
    yield from (h.p[short(note)] for note in (*filter(None, [family.remark]), *rest_lines(family)))


def _range(found: FeasibleRange) -> Iterator[h.Node]:
    yield figure(found)
    yield h.p[short(range_title(found))]
    if found.intervals:
        yield table_of(range_table(found))
    yield from (h.p[short(note)] for note in range_notes(found))


def _region(found: FeasibleRegion) -> Iterator[h.Node]:
    yield figure(found)
    yield h.p[short(region_title(found))]
    if found.boundaries:
        yield table_of(region_table(found))
    yield from (h.p[short(note)] for note in region_notes(found))


def _found(found: FoundValues) -> Iterator[h.Node]:
    yield h.p[short(found_title(found))]
    if found.remark:
        yield h.p[short(f"{found.remark}.")]
    if found.hits:
        yield table_of(found_table(found).without_empty())
    yield from (h.p[short(note)] for note in rest_lines(found))


def _tolerances(found: Tolerances) -> Iterator[h.Node]:
    yield h.p[short(tolerances_title(found))]
    yield table_of(contribution_table(found))
    yield from (h.p[short(f"{line}.")] for line in spread_lines(found))


def _word_tolerance(found: ToleranceRange) -> Iterator[h.Node]:
    yield h.p[short(word_tolerance_title(found))]
    yield table_of(word_tolerance_table(found))
    yield from (h.p[short(f"{note}.")] for note in word_tolerance_notes(found))


def _sketch(record: Sketch | Drawings | Drawing) -> Iterator[h.Node]:
    yield figure(record)
    yield from _text(record)


def _sensitivity(found: Sensitivity) -> h.Node:
    slopes = slope_table(found)
    return table_of(replace(slopes, caption=slopes.caption.capitalize()))


def _system(system: EquationSystem) -> Iterator[h.Node]:
    from contoursolve.output import system_element  # noqa: PLC0415 - sympy is slow to import

    yield from system_element(system)


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
    Diagnosis: _diagnosis,
    Contour: _contour,
    Block: _block,
    Rule: _rule,
    Family: _family,
    FeasibleRange: _range,
    FeasibleRegion: _region,
    FoundValues: _found,
    Tolerances: _tolerances,
    ToleranceRange: _word_tolerance,
    Sensitivity: _sensitivity,
    Sketch: _sketch,
    Drawings: _sketch,
    Drawing: _sketch,
    EquationSystem: _system,
    Derivation: _derivation,
    Exercise: _exercise,
    Comparison: _comparison,
}
