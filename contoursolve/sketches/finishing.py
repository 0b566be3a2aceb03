"""Entries that would finish a sketch: which fields help, with which numbers, and one example of each that was tried."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import product
from math import dist

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import NUMBERS, Answer, AskedValue, Depth, absent_words, either, helping_words
from contoursolve.diagnostics import OpenNumber
from contoursolve.gcode import parse
from contoursolve.geometry import Arc, Profile, Unit, assemble
from contoursolve.program import Run, SolveOptions
from contoursolve.sketches.as_program import Field, as_program
from contoursolve.sketches.sketch import ASKED, ContourSketch, SketchElement, Value
from contoursolve.sketches.sliding import Loose
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, Status, analyse
from contoursolve.tolerance import LENGTH


class EntryRange(Struct, frozen=True):
    """A range of numbers, as they are written; empty where it has no end."""

    low: str
    high: str


class SketchEntry(Struct, frozen=True):
    """A field that would help to finish a sketch: the number of its element (0 for the sketch), its name, its meaning.

    With `example` the sketch has a contour, where one was tried; `ranges` are the numbers with which it is, all of them
    if `is_complete`. `beside` are further fields that it needs then, each with its example.
    """

    number: int
    field: str
    meaning: str
    example: str = ""
    ranges: tuple[EntryRange, ...] = ()
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


def asked_number(asked: AskedValue, answer: Answer) -> Decimal:
    """A value that was asked for, to three decimals, as it is written."""
    value, question = asked.value or 0.0, asked.question
    is_length = question.unit is Unit.MM
    return _written(answer, value, question.is_diameter, 3) if is_length else Decimal(f"{value:z.3f}")


def drawn_plainly(profile: Profile, loose: Loose) -> Iterator[Segment]:
    """The lines and arcs of a loose drawing, without its corners."""
    for element in profile.figure.path:
        tail, head = loose.points[element.tail], loose.points[element.head]
        if isinstance(element, Arc):
            center, radius = loose.points[element.center], loose.radii[element.radius]
            yield ArcSegment(element.name, tail, head, center, radius, element.turn)
        elif dist(tail, head) > LENGTH:
            yield LineSegment(element.name, tail, head)


def sketch_exactly(answer: Answer, sketch: ContourSketch, loose: Loose) -> ContourSketch:
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


def missing_fields(answer: Answer, loose: Loose | None) -> tuple[int, Sequence[Field]]:
    """The number of entries that are missing, and the fields that help."""
    claim, profile = answer.claim, answer.profile
    system = assemble(profile)
    verdict = analyse(system)
    names = helping_words(claim, profile, absent_words(claim, profile, verdict.free))
    fields = [(int(number), field) for number, _, field in (name.partition(":") for name in names)]
    count = loose.missing if loose is not None and loose.missing else len(system.unknowns) - verdict.rank
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
    rows = sketch.control.modes.lexicon.addresses
    found = dict.fromkeys(fields, SketchEntry(0, "", ""))
    for fix in (fix for finding in answer.diagnostics for fix in finding.fixes):
        places = [_place_of(each) for each in fix.numbers]
        if places and (places[0] not in found or not found[places[0]].example):
            first, beside = fix.numbers[0], zip(places[1:], fix.numbers[1:], strict=True)
            ranges = tuple(EntryRange(_number_in(each.low), _number_in(each.high)) for each in first.ranges)
            told = tuple((place, _number_in(each.example)) for place, each in beside)
            found[places[0]] = SketchEntry(0, "", "", _number_in(first.example), ranges, first.is_complete, told)
    return tuple(
        replace(
            entry, number=number, field=field, meaning=rows[field].meaning if field in rows else "size of the corner"
        )
        for (number, field), entry in sorted(found.items(), key=lambda each: not each[1].example)
    )


def with_examples(
    sketch: ContourSketch, answer: Answer, loose: Loose, entries: Iterable[SketchEntry]
) -> tuple[SketchEntry, ...]:
    """The same with a number near the loose drawing for each field that has none yet, where it makes a contour."""
    whole = sketch_exactly(answer, sketch, loose)
    # A corner that does not fit there would leave no value to tell.
    whole = replace(whole, elements=tuple(replace(each, corner=None) for each in whole.elements))
    open_ = [each for each in entries if not each.example and each.number]
    for each in open_:
        if each.field not in whole.elements[each.number - 1].words:
            whole = _with_word(whole, each.number, each.field, ASKED)
    program, found = as_program(whole), examined(whole)
    values: dict[Field, Decimal] = {}
    for asked in found.answers if found is not None else ():
        field = program.field_at(asked.question.word.span)
        if field is not None and asked.value is not None:
            values[field] = asked_number(asked, answer)
    told = list[SketchEntry]()
    for each in entries:
        value = values.get((each.number, each.field))
        if value is None and each.number:
            stated = whole.elements[each.number - 1].words.get(each.field)
            value = stated if isinstance(stated, Decimal) else None
        example = "" if each.example or value is None else _example(sketch, each, value)
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
    elements = list(sketch.elements)
    element = elements[number - 1]
    elements[number - 1] = replace(element, words={**element.words, field: value})
    return replace(sketch, elements=tuple(elements))


def _place_of(number: OpenNumber) -> Field:
    """The field of a number that a fix leaves open."""
    address = number.word.strip().rstrip("?").strip()
    return number.line, "corner" if address in ("RND R", "CHF") else address


def _number_in(word: str) -> str:
    """The number of a word."""
    found = _NUMBER.search(word)
    return found[0] if found else ""


_NUMBER = re.compile(r"[+-]?[\d.]+$")
