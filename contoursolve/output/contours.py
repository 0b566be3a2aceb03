"""A solved contour as text: what was given, the virtual intersections, every element of the path."""

from collections.abc import Sequence
from dataclasses import replace

from contoursolve.contour import ArcSegment
from contoursolve.diagnostic import Diagnosis, Verdict
from contoursolve.examine import Answer, AskedValue, list_alternatives
from contoursolve.model import Length, Turn, Unit
from contoursolve.output.layout import columns, count, length_of, printable
from contoursolve.output.solutions import Listed, Listing, list_solutions, printed_certificate
from contoursolve.pipeline import Result
from contoursolve.reading import Convention, Form, Lexicon
from contoursolve.solving import Point
from contoursolve.syntax import FACT, Word

_VERDICT = {Verdict.PASSED: "passed", Verdict.FOUND: "see finding", Verdict.NOT_RUN: "not run"}

SMALLEST = 0.0001
"""mm. What a listing with four decimals can show."""


def contour_lines(answer: Answer, result: Result, *, is_explained: bool = False) -> list[str]:
    """The listing of one contour, in the unit and the axes of its program; explained with its construction."""
    alternatives = list_alternatives(answer)
    if alternatives is not answer.alternatives:
        # Found here once, for the construction and for the list.
        answer = replace(answer, alternatives=alternatives)
    form = answer.claim.form
    lines = [f"{printable(result.program.name)}:{answer.lines[0]}: {form.name} ({form.title}): {answer.status.value}"]
    lines += [f"  {printable(block.text.strip())[:160]}" for block in answer.profile.blocks]
    lines += ["", *columns(given_rows(answer), left=(0, 3))]
    if is_explained:
        from contoursolve.output.construction import construction_lines  # noqa: PLC0415 - only on demand

        lines += ["", *construction_lines(answer)]
        if answer.contour and answer.profile.figure.corners and answer.claim.form.corner_note:
            lines.append(f"    {answer.claim.form.corner_note}")
    if answer.contour:
        lines += ["", *columns(path_rows(answer), left=(0, 1))]
    if answer.contour:
        lines += [
            line
            for each in answer.claim.conventions
            for line in ("", f"  {convention_text(each, result.control or '')}")
        ]
        lines += [line for text in assumptions_text(answer) for line in ("", f"  {text}")]
    if answer.filled:
        lines += ["", f"  filled in (the contour moves by {small(answer.filled.deviation)}):"]
        lines += [f"    {printable(text.strip())}" for text in answer.filled.blocks]
    lines += _solution_lines(answer)
    if answer.contour is None and answer.diagnosis:
        lines += ["", *columns(check_rows(answer.diagnosis), left=(0, 1, 2))]
    return [*lines, ""]


def convention_text(convention: Convention, control: str) -> str:
    """What the manual does not say and a contour rests on."""
    setting = convention.setting
    name = f"{control}.{setting.name}" if control else setting.name
    return f"{convention.evidence.value}: {convention.meaning} (--set {name}={convention.value})"


def assumptions_text(answer: Answer) -> list[str]:
    """What the control is taken to accept and a contour rests on, in one line, if there is anything."""
    by_grade: dict[str, list[str]] = {}
    for each in answer.assumptions:
        by_grade.setdefault(each.source.evidence.value, []).append(each.meaning)
    told = [f"{'; '.join(meanings)} ({grade})" for grade, meanings in by_grade.items()]
    return [f"rests on: {'; '.join(told)}"] if told else []


def check_rows(diagnosis: Diagnosis) -> list[tuple[str, str, str]]:
    """A header, and the checks that a contour went through."""
    rows = [(layer.name, _VERDICT[layer.verdict], layer.remark) for layer in diagnosis.layers]
    return [("check", "verdict", "what was checked"), *rows]


def small(mm: float) -> str:
    """A deviation, as far as a listing can show it."""
    return "less than 0.0001 mm" if mm < SMALLEST else f"{mm:.4f} mm"


def _solution_lines(answer: Answer) -> list[str]:
    """The certificate, and where there are several solutions, all of them."""
    listing = list_solutions(answer)
    if listing is None:
        return []
    if len(listing.solutions) == 1 and listing.is_complete:
        return ["", f"  certificate: {printed_certificate(answer.certificate)}"] if answer.contour else []
    lines = ["", f"  {count_text(listing)}"]
    lines += [f"  not decided: {doubt}" for doubt in listing.doubts]
    rows = [("->" if each.is_chosen else "", *row) for each, row in solution_rows(answer, listing)]
    lines += columns(rows, left=(0, 1, 2, 3, 4, 5))
    if listing.chosen_by:
        lines.append(f"  -> chosen by {listing.chosen_by}")
    return lines


def count_text(listing: Listing) -> str:
    """How many solutions there are, and whether these are all."""
    number, shown = len(listing.solutions), f"by {listing.method}"
    known = f"these are all ({shown})" if listing.is_complete else f"there may be more ({shown})"
    return f"{'' if listing.is_complete else 'at least '}{count(number, 'solution')}; {known}"


def solution_rows(answer: Answer, listing: Listing) -> list[tuple[Listed, tuple[str, str, str, str, str]]]:
    """Each solution with its name, whether it is no contour, where it differs from the others or why there is none,
    what selects it, and its certificate."""
    contours = [each.contour for each in listing.solutions if each.contour]
    points = contours[0].points if contours else ()
    differing = [point for point in points if len({contour.points[point] for contour in contours}) > 1]
    rows = []
    for each in listing.solutions:
        where = ", ".join(each.reasons)
        if each.contour:
            places = (f"{point} {place_text(answer, each.contour.points[point])}" for point in differing)
            where = "  ".join((*places, *(_asked_text(asked, answer) for asked in each.asked)))
        label = "" if each.contour else "no contour:"
        row = (each.name or "only solution", label, where, " ".join(each.selects), str(each.certificate))
        rows.append((each, row))
    return rows


def _asked_text(asked: AskedValue, answer: Answer) -> str:
    """A value that was asked for, in one solution."""
    question, name = asked.question, asked.question.word.text.rstrip(" =?")
    if asked.value is None:
        return ""
    if question.unit is Unit.DEGREE:
        return f"{name} = {asked.value:.4f}"
    return f"{name} = {length_of(asked.value * (2 if question.is_diameter else 1), answer.unit)}"


def place_text(answer: Answer, at: Point) -> str:
    """A place as words, in the unit and the axes of the program."""
    plane = answer.plane
    return " ".join(
        f"{axis}{length_of(value * (2 if is_diameter else 1), answer.unit)}"
        for axis, value, is_diameter in zip(plane.axes, at, plane.diameters, strict=True)
    )


def given_rows(answer: Answer) -> list[tuple[str, str, str, str]]:
    """Word, value, unit and meaning of everything that was given."""
    form, rows = answer.claim.form, []
    for axis, value, is_diameter in zip(answer.plane.axes, answer.start.values, answer.plane.diameters, strict=True):
        shown = "unknown" if value is None else length_of(float(value) * (2 if is_diameter else 1), answer.unit)
        rows.append(
            ("start " + axis, shown, _unit(answer.unit) if value is not None else "", _axis_meaning(is_diameter))
        )
    ignored = {fact.given for fact in answer.profile.ignored}
    words = {given.name: given.word for given in answer.profile.givens.values() if given.word}
    seen: set[int] = set()
    for name, word in sorted(words.items(), key=lambda item: item[1].span):
        if id(word) in seen:
            continue
        seen.add(id(word))
        row = answer.claim.lexicon.addresses.get(word.address)
        meaning = form.meanings.get(name) or (row.meaning if row else "")
        meaning += " - ignored" if name in ignored else ""
        if word.address == FACT:
            rows.append((printable(word.text), "", "", "further fact"))
        else:
            rows.append((word.text, *_value(word, answer.claim.lexicon, answer.unit), meaning))
    rows += [_asked_row(each, answer, form) for each in answer.answers]
    by_point = {choice.point: words[choice.given].text for choice in answer.profile.choices if choice.given in words}
    for point, side in answer.sides.items():
        rows.append((f"choice {point}", side.value, "", f"of two intersections, by {by_point[point]}"))
    return rows


def _asked_row(asked: AskedValue, answer: Answer, form: Form) -> tuple[str, str, str, str]:
    """A value that was asked for."""
    question = asked.question
    row = answer.claim.lexicon.addresses.get(question.word.address)
    meaning = form.meanings.get(question.name) or (row.meaning if row else "")
    text = printable(question.word.text)
    if asked.value is None:
        return text, "?", "", f"asked: {meaning}".strip(": ")
    if question.unit is Unit.DEGREE:
        return text, f"{asked.value:.4f}", "deg", f"asked: {meaning}".strip(": ")
    shown = length_of(asked.value * (2 if question.is_diameter else 1), answer.unit)
    return text, shown, _unit(answer.unit), f"asked: {meaning}".strip(": ")


def _value(word: Word, lexicon: Lexicon, unit: Length) -> tuple[str, str]:
    """What a word states, in the terms in which it is written, and its unit."""
    value, row = float(lexicon.value(word, unit) or 0), lexicon.addresses[word.address]
    if row.unit is Unit.DEGREE:
        return f"{value:.4f}", "deg"
    if row.unit is Unit.SIGN:
        return f"{value:+g}", ""
    return length_of(value * (2 if row.is_diameter else 1), unit), _unit(unit)


def _axis_meaning(is_diameter: bool) -> str:
    return "where the contour begins" + (" (diameter)" if is_diameter else "")


def path_rows(answer: Answer) -> list[tuple[str, ...]]:
    """A header, the named points, and the elements with their end points, in the unit and the axes of the program."""
    contour = answer.contour
    if contour is None:
        return []
    unit = _unit(answer.unit)
    names = [
        f"{axis} dia" if is_diameter else axis
        for axis, is_diameter in zip(answer.plane.axes, answer.plane.diameters, strict=True)
    ]
    arcs = [element for element in contour.elements if isinstance(element, ArcSegment)]
    heads = [f"{name} [{unit}]" for name in names]
    if arcs:
        heads += [f"center {name} [{unit}]" for name in names] + [f"radius [{unit}]"]
    header = ("", "", *heads)
    blank = [""] * (len(heads) - 2)

    def point(at: Point) -> list[str]:
        return [
            length_of(value * (2 if is_diameter else 1), answer.unit)
            for value, is_diameter in zip(at, answer.plane.diameters, strict=True)
        ]

    rows: list[Sequence[str]] = [header]
    rows += [(name, "point", *point(at), *blank) for name, at in contour.points.items()]
    rows.append(("start", "", *point(contour.start), *blank))
    for element in contour.elements:
        if isinstance(element, ArcSegment):
            code = "G02" if element.turn is Turn.CW else "G03"
            arc = [*point(element.center), length_of(element.radius, answer.unit)]
            rows.append((element.name, code, *point(element.end), *arc))
        else:
            rows.append((element.name, "G01", *point(element.end), *blank))
    return [tuple(row) for row in rows]


def _unit(unit: Length) -> str:
    return "in" if unit is Length.INCH else "mm"
