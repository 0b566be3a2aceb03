"""Records as the terminal prints them."""

from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from math import isnan
from typing import Any

from contoursolve.contour import ArcSegment, Contour
from contoursolve.diagnostic import Diagnosis, Diagnostic
from contoursolve.dialects import DIALECTS
from contoursolve.examine import Answer
from contoursolve.families import Family, Feasible, Found, Region, Sensitivity, Tolerances
from contoursolve.output.catalogue import rule_lines
from contoursolve.output.contours import check_rows
from contoursolve.output.findings import finding_lines, plain
from contoursolve.output.inverse import found_lines
from contoursolve.output.layout import columns, count, printable
from contoursolve.output.listing import closing_lines, listing_lines
from contoursolve.output.ranges import range_lines, region_lines
from contoursolve.output.tolerances import tolerances_lines
from contoursolve.pipeline import Result
from contoursolve.rules import Rule
from contoursolve.shown import Shown
from contoursolve.syntax import Block, Program, Word

MOST_ROWS = 200
"""Rows of a table."""


def text_of(record: Shown) -> Iterable[str]:
    """The lines of a record."""
    for kind, lines in _LINES.items():
        if isinstance(record, kind):
            return lines(record)
    return str(record).split("\n")


def control_of(answer: Answer) -> str | None:
    """The control whose words a contour was read with, if it is one that is built in."""
    lexicon = answer.claim.lexicon
    return next((name for name, each in DIALECTS.items() if each.modes.lexicon is lexicon), None)


def result_of(answer: Answer) -> Result:
    """A result that holds one contour and its own blocks."""
    blocks = answer.claim.blocks
    program = Program("<block>", "\n".join(block.text for block in blocks), blocks)
    return Result(program, control_of(answer), (answer,), answer.diagnostics)


def _result(result: Result) -> Iterator[str]:
    yield from listing_lines(result, plain)
    yield from closing_lines(result)


def _answer(answer: Answer) -> Iterator[str]:
    return listing_lines(result_of(answer), plain)


def _finding(finding: Diagnostic) -> list[str]:
    return finding_lines(finding, "<program>", {})


def _diagnosis(diagnosis: Diagnosis) -> Iterator[str]:
    yield from columns(check_rows(diagnosis), left=(0, 1, 2), indent="")
    for title, rows in (("what can still move", freedom_rows(diagnosis)), ("what says the same", tie_rows(diagnosis))):
        if rows:
            yield from ("", f"{title}:", *columns(rows, left=(0, 1, 2)))


def freedom_rows(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    """Each point that is not fixed, and how it can move."""
    return [
        (each.point, "lies anywhere" if each.angle is None else f"slides along {each.angle:.4f} deg")
        for each in diagnosis.freedoms
    ]


def tie_rows(diagnosis: Diagnosis) -> list[tuple[str, str, str]]:
    """Each set of words that say the same, the formula that ties them, and by how much they disagree."""
    return [
        (" ".join(tie.addresses), tie.identity, f"{tie.off_by_mm:.4f} mm apart" if tie.is_conflict else "they agree")
        for tie in diagnosis.ties
    ]


def _contour(contour: Contour) -> list[str]:
    header, *rows = contour_rows(contour)
    return columns([header, *rows], left=(0, 1), indent="")


def contour_rows(contour: Contour) -> list[tuple[str, ...]]:
    """A header, the named points and the elements with their end points, in mm, X of a lathe as radius."""
    names = [
        f"{axis} radius" if is_diameter else axis
        for axis, is_diameter in zip(contour.plane.axes, contour.plane.diameters, strict=True)
    ]
    header = ("element", "kind", *(f"{name} [mm]" for name in names), *(f"center {name}" for name in names), "radius")

    def row(name: str, kind: str, *values: float) -> tuple[str, ...]:
        return (name, kind, *(f"{value:.4f}" for value in values), *[""] * (len(header) - 2 - len(values)))

    rows = [row(name, "point", *at) for name, at in contour.points.items()]
    rows.append(row("start", "", *contour.start))
    for each in contour.elements:
        if isinstance(each, ArcSegment):
            rows.append(row(each.name, f"arc {each.turn.value}", *each.end, *each.center, each.radius))
        else:
            rows.append(row(each.name, "line", *each.end))
    return [header, *rows]


def _block(block: Block) -> Iterator[str]:
    yield printable(block.text)
    yield from columns([("column", "word", "value"), *word_rows(block)], left=(1,))


def word_rows(block: Block) -> list[tuple[str, str, str]]:
    """Each word and each stretch that is none, where it stands, and its value."""
    rows = [(each.span.column, printable(each.text), "?" if each.is_asked else _number(each)) for each in block.words]
    rows += [(each.span.column, printable(each.text), each.kind.value) for each in block.faults]
    return [(str(column), text, value) for column, text, value in sorted(rows)[:MOST_ROWS]]


def _number(word: Word) -> str:
    return "variable" if word.number is None else str(word.number)


def _program(program: Program) -> Iterator[str]:
    yield f"{printable(program.name)}: {count(len(program.blocks), 'line')}"
    width = len(str(len(program.blocks)))
    yield from (f"{block.line:>{width}} | {printable(block.text)}" for block in islice(program.blocks, 1_000))


def _rule(rule: Rule) -> list[str]:
    return rule_lines(rule, controls_of(rule))


def controls_of(rule: Rule) -> list[str]:
    """The controls that have a rule."""
    return [name for name, dialect in DIALECTS.items() if rule in dialect.rules]


def _family(family: Family) -> Iterator[str]:
    yield f"{count(len(family), 'contour')}, shape {' x '.join(map(str, family.shape))}"
    for rows in (family_rows(family), status_rows(family)):
        yield from ("", *columns(rows, left=(0,)))
    yield ""
    yield f"  arrays: {', '.join(family.names)}"


def family_rows(family: Family) -> list[tuple[str, ...]]:
    """A header, and for each free word how many values it has and how far they go."""
    rows: list[tuple[str, ...]] = [("word", "values", "least", "largest")]
    for word, values in family.ranges.values.items():
        ends = (f"{values.min():.6g}", f"{values.max():.6g}") if values.size else ("", "")
        rows.append((word, f"{values.size:,}", *ends))
    return rows


def status_rows(family: Family) -> list[tuple[str, ...]]:
    """A header, and how many contours have each status."""
    counts = family.summary()
    rows = [(status.value, f"{number:,}", f"{number / len(family):.1%}") for status, number in counts.items()]
    return [("status", "contours", "share"), *rows]


def _sensitivity(found: Sensitivity) -> Iterator[str]:
    yield SLOPES
    yield from columns(slope_rows(found))


SLOPES = "how far each result moves, mm for each unit of a word as it is written"


def slope_rows(found: Sensitivity) -> list[tuple[str, ...]]:
    """A header, and by how much each word moves each result; `none` where no derivative exists."""
    words = next(iter(found.slopes.values()), {})
    rows = [
        (result, *("none" if isnan(slope) else f"{slope + 0.0:.4f}" for slope in slopes.values()))
        for result, slopes in islice(found.slopes.items(), MOST_ROWS)
    ]
    return [("result", *words), *rows]


_LINES: dict[type, Callable[[Any], Iterable[str]]] = {
    Result: _result,
    Answer: _answer,
    Diagnostic: _finding,
    Diagnosis: _diagnosis,
    Contour: _contour,
    Block: _block,
    Program: _program,
    Rule: _rule,
    Family: _family,
    Feasible: range_lines,
    Region: region_lines,
    Found: found_lines,
    Tolerances: tolerances_lines,
    Sensitivity: _sensitivity,
}
