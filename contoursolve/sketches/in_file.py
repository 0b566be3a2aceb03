"""Findings about a sketch, in the lines of its file."""

import re
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import (
    DRAWN,
    Applicability,
    Basis,
    Diagnostic,
    Fix,
    Label,
    LineChange,
    Severity,
    Span,
)
from contoursolve.gcode import Program
from contoursolve.program import Result
from contoursolve.sketches.as_program import Field
from contoursolve.sketches.known_part import SketchAnswer, SketchFinding, SketchFix, solve_sketch
from contoursolve.sketches.sketch import ASKED, ContourSketch, SketchElement, SketchError
from contoursolve.sketches.sketch_file import read_sketch

_HEADER = re.compile(r"\s*\[\[\s*element\s*\]\]")
_TABLE = re.compile(r"\s*\[\s*element\s*\.\s*(?P<name>\w+)\s*\]")
_KEY = re.compile(r"\s*(?P<name>\w+)\s*=\s*(?P<value>[^#]*[^#\s])")
_KIND = re.compile(r"\bkind\b[\"']?\s*[=:]")


class SketchFile(Struct, frozen=True):
    """A sketch's file: its text as lines, and the place of each field in it. Field `""` is the head of an element."""

    program: Program
    sketch: ContourSketch
    places: Mapping[Field, Span]

    def place(self, field: Field) -> Span:
        """The place of a field; else of its element, else of the file."""
        number, name = field
        names = ((number, name), (number, name.partition(".")[0]), (number, "kind"), (number, ""))
        return next((self.places[each] for each in names if each in self.places), Span(1, 1, 2))

    def text_of(self, line: int) -> str:
        """The text of a line."""
        return self.program.blocks[line - 1].text


def read_sketch_file(program: Program) -> SketchFile:
    """The sketch of a file whose text was read. Raises SketchError, which names the file."""
    try:
        sketch = read_sketch(program.text)
    except SketchError as error:
        raise SketchError(f"{program.name}: {error}") from None
    return SketchFile(program, sketch, dict(_places([block.text for block in program.blocks])))


def _places(lines: Sequence[str]) -> Iterator[tuple[Field, Span]]:
    """The place of each field. In JSON, and where elements stand in one list, only elements have one."""
    number, inside, has_headers = 0, "", any(map(_HEADER.match, lines))
    for line, written in enumerate(lines, 1):
        if _HEADER.match(written):
            number, inside = number + 1, ""
            yield (number, ""), _span(line, written)
        elif table := _TABLE.match(written):
            inside = table["name"]
            yield (number, inside), _span(line, written)
        elif has_headers or not number:
            found = _KEY.match(written)
            if found and not inside:
                yield (number, found["name"]), Span(line, found.start("name") + 1, found.end("value") + 1)
        if not has_headers:
            for _ in _KIND.finditer(written):
                number += 1
                yield (number, ""), _span(line, written)


def _span(line: int, text: str) -> Span:
    return Span(line, len(text) - len(text.lstrip()) + 1, len(text.rstrip()) + 1)


def sketch_result(file: SketchFile) -> tuple[SketchAnswer, Result]:
    """All that is known of the sketch of a file, and the same as a result whose findings are in the file's lines."""
    found = solve_sketch(file.sketch, with_ranges=True)
    findings = tuple(_diagnostic(file, each) for each in _findings(found))
    answers = (replace(found.answer, diagnostics=findings),) if found.answer is not None else ()
    return found, Result(file.program, file.sketch.control.name, answers, findings)


def _findings(found: SketchAnswer) -> Iterator[SketchFinding]:
    """The findings; what is missing, if none of them says so; and solutions, each with the guess that chooses it."""
    if found.missing and not any(each.severity is Severity.ERROR for each in found.findings):
        fields = tuple((each.number, each.field) for each in found.entries) or ((0, "start"),)
        yield SketchFinding("drawing-open", Severity.ERROR, found.missing, "add it", fields[:1])
    are_several = bool(found.solutions) and not found.is_finished
    # Which guess chooses one says more than that some word could.
    yield from (each for each in found.findings if not (are_several and each.code == "several-contours"))
    if are_several:
        fixes = tuple(_chooses(found.sketch, name, *guess) for name, guess in _guesses(found))
        message = f"{len(found.solutions)} contours fit"
        number = found.solutions[0].guess[0]
        yield SketchFinding(
            "drawing-several", Severity.ERROR, message, "guess where an element ends", ((number, ""),), None, fixes
        )


def _guesses(found: SketchAnswer) -> Iterator[tuple[str, tuple[int, Mapping[str, Decimal]]]]:
    yield from ((each.name, each.guess) for each in found.solutions)


def _chooses(sketch: ContourSketch, name: str, number: int, guess: Mapping[str, Decimal]) -> SketchFix:
    told = ", ".join(f"{axis} = {at}" for axis, at in guess.items())
    title = f"{name}: guess = {{ {told} }} in {sketch.name_of(number)}"
    return SketchFix(title, {number: replace(sketch.elements[number - 1], guess=guess)})


def _diagnostic(file: SketchFile, finding: SketchFinding) -> Diagnostic:
    spans = dict.fromkeys(file.place(field) for field in finding.fields) or {Span(1, 1, 2): None}
    values = {"off_by_mm": finding.off_mm} if finding.off_mm is not None else {}
    return Diagnostic(
        finding.code,
        finding.severity,
        Basis.NUMERICAL if values else Basis.STRUCTURAL,
        next(iter(spans)),
        finding.message,
        DRAWN,
        tuple(Label(span, "") for span in spans),
        values=values,
        help=finding.help,
        fixes=tuple(_fix(file, each) for each in finding.fixes),
    )


def _fix(file: SketchFile, fix: SketchFix) -> Fix:
    """A fix as changes of lines; where a number is open, or lines are not those of one field each, in words alone."""
    changes = list[LineChange]()
    for number, now in fix.elements.items():
        changes += _changes(file, number, file.sketch.elements[number - 1], now)
    is_open = any(ASKED in each.words.values() for each in fix.elements.values())
    applicability = Applicability.PLACEHOLDER if is_open else Applicability.CHANGES_CONTOUR
    return Fix(fix.title, "", applicability, beside=() if is_open else tuple(changes))


def _changes(file: SketchFile, number: int, old: SketchElement, now: SketchElement) -> Iterator[LineChange]:
    """The changed lines of an element: entries that go, that become others, and that are new."""
    before, after = _entries(old), _entries(now)
    for name in before:
        span = file.places.get((number, name))
        if span is not None and after.get(name) != before[name]:
            text = file.text_of(span.line)
            told = f"{name} = {after[name]}" if name in after else ""
            yield LineChange(span, told and text[: span.column - 1] + told + text[span.end_column - 1 :], text)
    new = [f"{name} = {after[name]}" for name in after if name not in before]
    span = file.places.get((number, "kind"))
    if new and span is not None:
        text = file.text_of(span.line)
        yield LineChange(span, "\n".join([text, *new]), text)


def _entries(element: SketchElement) -> dict[str, str]:
    """The entries of an element that fixes change, as its file has them."""
    found = {
        name: f"{value:f}" if isinstance(value, Decimal) else f'"{value}"' for name, value in element.words.items()
    }
    if element.corner is not None:
        found["corner"] = f"{{ {element.corner.shape} = {element.corner.size} }}"
    if element.turn is not None:
        found["turn"] = f'"{element.turn}"'
    if element.tangent:
        found["tangent"] = "true"
    if element.guess:
        found["guess"] = "{ " + ", ".join(f"{axis} = {at}" for axis, at in element.guess.items()) + " }"
    return found
