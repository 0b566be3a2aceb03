"""Entries that would finish a sketch: which fields help, with which numbers, and one example of each that was tried."""

import re
from collections.abc import Iterable, Mapping, Sequence
from decimal import Decimal
from itertools import product

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import NUMBERS, Answer, Depth, absent_words, either, helping_words
from contoursolve.diagnostics import NumberRange, OpenNumber
from contoursolve.gcode import parse
from contoursolve.geometry import Arc, Unit, assemble
from contoursolve.program import Run, SolveOptions
from contoursolve.sketches.as_program import Field, SketchProgram, as_program
from contoursolve.sketches.sketch import ASKED, ContourSketch, SketchElement, Value
from contoursolve.solving import NaturalDrawing, Point, Status, analyse


class SketchEntry(Struct, frozen=True):
    """A field that would help to finish a sketch: the number of its element (0 for the sketch), its name, its meaning.

    With `example` the sketch has a contour, where one was tried; `ranges` are the numbers with which it is, as they are
    written, all of them if `is_complete`. `beside` are further fields that it needs then, each with its example.
    """

    number: int
    field: str
    meaning: str
    example: str = ""
    ranges: tuple[NumberRange, ...] = ()
    is_complete: bool = False
    beside: tuple[tuple[Field, str], ...] = ()


def examined(sketch: ContourSketch, depth: Depth = Depth.VERDICT, picks: Mapping[int, int] = {}) -> Answer | None:
    """The answer about the program of a sketch; `picks` choose among its solutions."""
    program = as_program(sketch, picks)
    asked = SolveOptions(start=program.start, units=sketch.unit, depth=depth.value)
    run = Run(parse(program.text, "sketch"), asked.request("sketch", sketch.control))
    return next(iter(run.collect().answers), None)


def written_place(answer: Answer, at: Point, decimals: int = 4) -> dict[str, Decimal]:
    """A place (mm) as words of a sketch have it."""
    axes = zip(answer.plane.axes, at, answer.plane.diameters, strict=True)
    return {axis: _written(answer, value, is_turned, decimals) for axis, value, is_turned in axes}


def _written(answer: Answer, value: float, is_diameter: bool, decimals: int) -> Decimal:
    number = value * (2 if is_diameter else 1) / float(answer.unit.in_mm)
    return Decimal(f"{number:z.{decimals}f}")


def asked_values(program: SketchProgram, answer: Answer) -> dict[Field, Decimal | None]:
    """The values of fields that ask for one, to three decimals, as they are written; None where nothing tells it."""
    found: dict[Field, Decimal | None] = {}
    for each in answer.asked:
        field, value, question = program.field_at(each.question.word.span), each.value, each.question
        if field is not None and value is not None and question.unit is Unit.MM:
            found[field] = _written(answer, value, question.is_diameter, 3)
        elif field is not None:
            found[field] = None if value is None else Decimal(f"{value:z.3f}")
    return found


def sketch_exactly(answer: Answer, sketch: ContourSketch, loose: NaturalDrawing) -> ContourSketch:
    """A sketch with each end, and each centre, where it is in a loose drawing, and nothing else but its corners."""
    elements = list[SketchElement]()
    for given, element in zip(sketch.elements, answer.profile.figure.path, strict=False):
        words: dict[str, Value] = {**written_place(answer, loose.points[element.head], _EXACT)}
        if isinstance(element, Arc):
            center = written_place(answer, loose.points[element.center], _EXACT)
            words |= {f"CC{axis}": value for axis, value in center.items()}
        turn = given.turn or "ccw" if given.kind == "arc" else None
        elements.append(SketchElement(given.kind, words, turn, corner=given.corner))
    return replace(sketch, elements=tuple(elements), facts=(), closed=False)


_EXACT = 10
"""Decimals of a number that stands for one of a drawing."""


def missing_fields(answer: Answer, loose: NaturalDrawing | None) -> tuple[int, Sequence[Field]]:
    """The number of entries that are missing, and the fields that help."""
    claim, profile = answer.claim, answer.profile
    system = assemble(profile)
    verdict = analyse(system)
    names = helping_words(claim, profile, absent_words(claim, profile, verdict.free))
    fields = [(int(number), field) for number, _, field in (name.partition(":") for name in names)]
    count = loose.dimension if loose is not None and loose.dimension else len(system.unknowns) - verdict.rank
    return count, fields


_MOST_NAMED = 8
"""Fields that the line about what is missing names."""


def missing_text(sketch: ContourSketch, count: int, fields: Sequence[Field]) -> str:
    """The line about what is missing."""
    lines: dict[int, list[str]] = {}
    # Of a sketch that lacks much, its first elements count: who draws goes on from there.
    named = fields[:_MOST_NAMED] if count == 1 else sorted(fields, key=lambda each: each[0])[:_MOST_NAMED]
    for number, field in sorted(named, key=lambda each: each[0]):
        lines.setdefault(number, []).append(field)
    told = [f"{either(own)} of {sketch.name_of(number)}" for number, own in lines.items()]
    amount = f"{NUMBERS.get(count, count)} {'entry is' if count == 1 else 'entries are'} missing"
    return f"{amount}: {', or '.join(told)}" if told else amount


def tried_entries(sketch: ContourSketch, answer: Answer, fields: Iterable[Field]) -> tuple[SketchEntry, ...]:
    """The fields that help, with the numbers that findings have tried."""
    fixes = (fix.numbers for finding in answer.diagnostics for fix in finding.fixes if fix.numbers)
    tried = dict[Field, Sequence[OpenNumber]]()
    for numbers in fixes:
        place = _place_of(numbers[0])
        if place not in tried or not tried[place][0].example:
            tried[place] = numbers
    entries = [_entry(sketch, *field, tried.get(field, ())) for field in dict.fromkeys((*fields, *tried))]
    return tuple(sorted(entries, key=lambda each: not each.example))


def _entry(sketch: ContourSketch, number: int, field: str, numbers: Sequence[OpenNumber]) -> SketchEntry:
    """An entry with the numbers that a fix tells, its own first."""
    row = sketch.control.modes.lexicon.addresses.get(field)
    bare = SketchEntry(number, field, row.meaning if row else "size of the corner")
    if not numbers:
        return bare
    first, *others = numbers
    ranges = tuple(NumberRange(_number_in(each.low), _number_in(each.high)) for each in first.ranges)
    beside = tuple((_place_of(each), _number_in(each.example)) for each in others)
    return replace(bare, example=_number_in(first.example), ranges=ranges, is_complete=first.is_complete, beside=beside)


def with_examples(
    sketch: ContourSketch, answer: Answer, loose: NaturalDrawing, entries: Iterable[SketchEntry]
) -> tuple[SketchEntry, ...]:
    """The same with a number near the loose drawing for each field that has none yet, where it makes a contour."""
    whole = sketch_exactly(answer, sketch, loose)
    for number in range(1, len(whole.elements) + 1):
        # A corner that does not fit there would leave no value to tell.
        whole = whole.changed(number, corner=None)
    for each in entries:
        if not each.example and each.number and each.field not in whole.elements[each.number - 1].words:
            whole = _with_word(whole, each.number, each.field, ASKED)
    found, told = examined(whole), list[SketchEntry]()
    values: dict[Field, Value | None] = {
        (number, name): value for number, each in enumerate(whole.elements, 1) for name, value in each.words.items()
    }
    values |= asked_values(as_program(whole), found) if found is not None else {}
    for each in entries:
        value = values.get((each.number, each.field))
        example = _example(sketch, each, value) if isinstance(value, Decimal) and not each.example else ""
        told.append(replace(each, example=example) if example else each)
    return tuple(sorted(told, key=lambda each: not each.example))


def _example(sketch: ContourSketch, entry: SketchEntry, value: Decimal) -> str:
    """The roundest number near a value, or else half or twice that, with which a field makes a contour, or several of
    which a guess chooses; empty if none does."""
    for factor, step in product(
        (Decimal(1), Decimal("0.5"), Decimal(2)), (Decimal(1), Decimal("0.1"), Decimal("0.001"))
    ):
        number = (value * factor).quantize(step)
        found = examined(_with_word(sketch, entry.number, entry.field, number))
        if found is not None and (found.contour is not None or found.status is Status.AMBIGUOUS):
            return f"{number:f}"
    return ""


def _with_word(sketch: ContourSketch, number: int, field: str, value: Value) -> ContourSketch:
    return sketch.changed(number, words={**sketch.elements[number - 1].words, field: value})


def _place_of(number: OpenNumber) -> Field:
    """The field of a number that a fix leaves open."""
    address = number.word.strip().rstrip("?").strip()
    return number.line, "corner" if address in ("RND R", "CHF") else address


def _number_in(word: str) -> str:
    """The number of a word."""
    found = _NUMBER.search(word)
    return found[0] if found else ""


_NUMBER = re.compile(r"[+-]?[\d.]+$")
