"""The lines of every record that shows itself, and their tables."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from itertools import islice
from math import isnan
from typing import Any

from contoursolve.comparison import Comparison, Receipt
from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import Answer, Derivation, EquationSystem, axis_labels, count, join, states_in
from contoursolve.diagnostics import Diagnosis, Diagnostic, Shown, Tie
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
from contoursolve.gcode import Block, Program, Word
from contoursolve.notebook.exercises import Exercise, exercise_lines
from contoursolve.output import (
    Folded,
    RecordView,
    Table,
    check_table,
    closing_lines,
    finding_lines,
    found_view,
    listing_lines,
    path_table,
    plain,
    printable,
    range_view,
    receipt_lines,
    region_view,
    rest_lines,
    rule_view,
    tolerances_view,
    word_tolerance_view,
)
from contoursolve.program import Result
from contoursolve.reading import Rule
from contoursolve.solving import Contour, Sketch
from contoursolve.tolerance import AGREEMENT

MOST_ROWS = 200
"""Rows of a table."""

MAP_WORDS = 2
"""Free words of a family that a map shows."""

MOST_LINES, WIDEST = 400, 400
"""Lines of text, and characters of a line."""


def bounded(lines: Iterable[str]) -> str:
    """Lines as one text of a bounded size."""
    first = list(islice(lines, MOST_LINES + 1))
    shown = [line if len(line) <= WIDEST else f"{line[:WIDEST]} ..." for line in first[:MOST_LINES]]
    if len(first) > MOST_LINES:
        shown.append("...")
    return "\n".join(shown).rstrip()


def text_of(record: Shown) -> Iterable[str]:
    """The lines of a record."""
    view = view_of(record)
    if view is not None:
        return view.lines()
    lines = next((lines for kind, lines in _LINES.items() if isinstance(record, kind)), None)
    return str(record).split("\n") if lines is None else lines(record)


def view_of(record: Shown) -> RecordView | None:
    """The text and the page of a record as one; None for a record whose page is laid out by itself."""
    return next((view(record) for kind, view in _VIEWS.items() if isinstance(record, kind)), None)


def result_of(answer: Answer) -> Result:
    """A result that holds one contour and its own blocks."""
    blocks = answer.claim.blocks
    program = Program("<block>", "\n".join(block.text for block in blocks), blocks)
    return Result(program, answer.read_by.control.name, (answer,), answer.diagnostics)


def _result(result: Result) -> Iterator[str]:
    yield from listing_lines(result, plain)
    yield from closing_lines(result)


def _answer(answer: Answer) -> Iterator[str]:
    return listing_lines(result_of(answer), plain)


def _finding(finding: Diagnostic) -> list[str]:
    return finding_lines(finding, "<program>", {})


def _diagnosis(diagnosis: Diagnosis) -> RecordView:
    """The checks; each point that is not fixed, and how it can move; each set of words that say the same, the formula
    that ties them, and by how much they disagree."""
    freedoms = [(each.point, each.how) for each in diagnosis.freedoms]
    ties = [(" ".join(tie.addresses), tie.identity, _disagreement(tie)) for tie in diagnosis.ties]
    open_points = Table("What can still move", ("point", "how"), freedoms, left=(0, 1), is_headed=False)
    header = ("words", "formula", "disagreement")
    return RecordView(
        "",
        [
            check_table(diagnosis),
            open_points,
            Table("What says the same", header, ties, left=(0, 1, 2), is_headed=False),
        ],
    )


def _disagreement(tie: Tie) -> str:
    """By how much words that say the same disagree."""
    if not tie.is_conflict:
        return "they agree"
    return "opposite directions" if tie.off_by_mm <= AGREEMENT else f"{tie.off_by_mm:.4f} mm apart"


def _contour(contour: Contour) -> list[str]:
    return path_table(contour).lines("")


def _block(block: Block) -> RecordView:
    """Each word and each stretch that is none, where it stands, and its value."""
    rows = [(each.span.column, printable(each.text), "?" if each.is_asked else _number(each)) for each in block.words]
    rows += [(each.span.column, printable(each.text), each.kind.value) for each in block.faults]
    shown = [(str(column), text, value) for column, text, value in sorted(rows)[:MOST_ROWS]]
    return RecordView(printable(block.text), [Table("Words", ("column", "word", "value"), shown, left=(1,))])


def _number(word: Word) -> str:
    return "variable" if word.number is None else str(word.number)


def _program(program: Program) -> Iterator[str]:
    yield f"{printable(program.name)}: {count(len(program.blocks), 'line')}"
    width = len(str(len(program.blocks)))
    yield from (f"{block.line:>{width}} | {printable(block.text)}" for block in islice(program.blocks, 1_000))


def _rule(rule: Rule) -> RecordView:
    return rule_view(rule, controls_of(rule))


def controls_of(rule: Rule) -> list[str]:
    """The controls that have a rule."""
    return _names_by_rule().get(rule, [])


@cache
def _names_by_rule() -> dict[Rule, list[str]]:
    names = defaultdict[Rule, list[str]](list)
    for name, control in CONTROLS.items():
        for rule in dict.fromkeys((*control.rules, *control.catalogue)):
            names[rule].append(name)
    return names


def _family(family: Family) -> RecordView:
    """The number and the range of each free word's values, the number of contours in each state, the arrays, and what
    the family depends on."""
    words = []
    for word, values in family.ranges.values.items():
        ends = (f"{values.min():.6g}", f"{values.max():.6g}") if values.size else ("", "")
        words.append((word, f"{values.size:,}", *ends))
    states = [
        (state.value, f"{number:,}", f"{number / family['status'].size:.1%}")
        for state, number in states_in(family.summary()).items()
    ]
    title = f"{count(len(family), 'contour')}, shape {' x '.join(map(str, family.shape))}"
    several = [values for values in family.ranges.values.values() if values.size > 1]
    is_fan = len(several) == 1 and TOOL not in family.ranges.values and family.has_contour.any()
    is_drawn = (is_fan or len(words) == MAP_WORDS) and not (family.ranges.is_paired or family.solutions)
    parts: list[str | Table | Folded] = [f"solutions: {join(list(family.solutions))}"] if family.solutions else []
    parts += ["", Table("Free words", ("word", "values", "least", "largest"), words)]
    parts += ["", Table("What becomes of them", ("state", "contours", "share"), states)]
    parts += ["", Folded(count(len(family.names), "array"), [", ".join(family.names)])]
    notes = [*filter(None, [family.remark]), *rest_lines(family)]
    return RecordView(title, [*parts, *notes], family if is_drawn else None)


def _sensitivity(found: Sensitivity) -> RecordView:
    """A row for each result: by how much each word moves it, as the control writes it; `none` where no derivative
    exists."""
    words, plane = next(iter(found.slopes.values()), {}), found.plane
    labels = dict(zip(plane.axes, axis_labels(plane), strict=True))

    def row(result: str, slopes: Mapping[str, float]) -> tuple[str, ...]:
        head, blank, axis = result.rpartition(" ")
        label = f"{head}{blank}{labels.get(axis, axis)}"
        return (label, *("none" if isnan(each) else f"{each + 0.0:.4f}" for each in slopes.values()))

    rows = [row(*each) for each in islice(found.slopes.items(), MOST_ROWS)]
    told = "how far each result moves, mm for each unit of a word as it is written"
    return RecordView(told, [Table("Slopes", ("result", *words), rows)])


def _sketch(sketch: Sketch) -> Iterator[str]:
    """Every way to draw it, or why there is none."""
    try:
        yield from str(sketch.solve()).split("\n")
    except ValueError as error:
        yield str(error)


def _system(system: EquationSystem) -> RecordView:
    from contoursolve.output import system_view  # noqa: PLC0415 - sympy is slow to import

    return system_view(system)


def _derivation(derivation: Derivation) -> Iterator[str]:
    from contoursolve.output import derivation_lines  # noqa: PLC0415 - sympy is slow to import

    yield from derivation_lines(derivation)


def _comparison(comparison: Comparison) -> Iterator[str]:
    from contoursolve.output import differences  # noqa: PLC0415 - few compare

    return differences.comparison_lines(comparison)


_LINES: dict[type, Callable[[Any], Iterable[str]]] = {
    Result: _result,
    Answer: _answer,
    Diagnostic: _finding,
    Contour: _contour,
    Program: _program,
    Sketch: _sketch,
    Derivation: _derivation,
    Exercise: exercise_lines,
    Comparison: _comparison,
    Receipt: receipt_lines,
}

_VIEWS: dict[type, Callable[[Any], RecordView]] = {
    Diagnosis: _diagnosis,
    Block: _block,
    Rule: _rule,
    Family: _family,
    FeasibleRange: range_view,
    FeasibleRegion: region_view,
    FoundValues: found_view,
    Tolerances: tolerances_view,
    ToleranceRange: word_tolerance_view,
    Sensitivity: _sensitivity,
    EquationSystem: _system,
}
