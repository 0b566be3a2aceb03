"""A solved contour as text: what was given, the virtual intersections, every element of the path."""

from collections.abc import Sequence
from dataclasses import replace

from contoursolve.contour import ArcSegment
from contoursolve.diagnostic import Verdict
from contoursolve.examine import Answer, AskedValue, list_alternatives
from contoursolve.model import Length, Turn, Unit
from contoursolve.output.layout import columns, length_of, printable
from contoursolve.output.solutions import list_solutions, printed_certificate
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
    lines = [f"{result.program.name}:{answer.lines[0]}: {form.name} ({form.title}): {answer.status.value}"]
    lines += [f"  {printable(block.text.strip())[:160]}" for block in answer.profile.blocks]
    lines += ["", *columns(_given_rows(answer, form), left=(0, 3))]
    if is_explained:
        from contoursolve.output.construction import construction_lines  # noqa: PLC0415 - only on demand

        lines += ["", *construction_lines(answer)]
    if answer.contour:
        lines += ["", *columns(_path_rows(answer), left=(0, 1))]
    if answer.contour:
        lines += [line for each in answer.claim.conventions for line in _convention_lines(each, result.control or "")]
    if answer.filled:
        lines += ["", f"  filled in (the contour moves by {_small(answer.filled.deviation)}):"]
        lines += [f"    {printable(text.strip())}" for text in answer.filled.blocks]
    lines += _solution_lines(answer)
    if answer.contour is None and answer.diagnosis:
        lines += ["", *_check_lines(answer)]
    return [*lines, ""]


def _convention_lines(convention: Convention, control: str) -> list[str]:
    """What the manual does not say and this contour rests on."""
    setting = convention.setting
    evidence = setting.source.evidence.value
    return ["", f"  {evidence}: {convention.meaning} (--set {control}.{setting.name}={convention.value})"]


def _check_lines(answer: Answer) -> list[str]:
    diagnosis = answer.diagnosis
    layers = diagnosis.layers if diagnosis else ()
    rows = [(layer.name, _VERDICT[layer.verdict], layer.remark) for layer in layers]
    return columns([("check", "verdict", "what was checked"), *rows], left=(0, 1, 2))


def _small(mm: float) -> str:
    return "less than 0.0001 mm" if mm < SMALLEST else f"{mm:.4f} mm"


def _solution_lines(answer: Answer) -> list[str]:
    """The certificate, and where there are several solutions, all of them."""
    listing = list_solutions(answer)
    if listing is None:
        return []
    if len(listing.solutions) == 1 and listing.is_complete:
        return ["", f"  certificate: {printed_certificate(answer.certificate)}"] if answer.contour else []
    count, shown = len(listing.solutions), f"by {listing.method}"
    known = f"these are all ({shown})" if listing.is_complete else f"there may be more ({shown})"
    lines = ["", f"  {'at least ' if not listing.is_complete else ''}{_plural(count)}; {known}"]
    lines += [f"  not decided: {doubt}" for doubt in listing.doubts]
    rows = []
    contours = [each.contour for each in listing.solutions if each.contour]
    differing = (
        [point for point in contours[0].points if len({contour.points[point] for contour in contours}) > 1]
        if contours
        else []
    )
    for each in listing.solutions:
        mark = "->" if each.is_chosen else ""
        where = ", ".join(each.reasons)
        if each.contour:
            places = (f"{point} {' '.join(_place(each.contour.points[point], answer))}" for point in differing)
            where = "  ".join((*places, *(_asked_text(asked, answer) for asked in each.asked)))
        label = "" if each.contour else "no contour:"
        rows.append((mark, each.name or "only solution", label, where, " ".join(each.selects), str(each.certificate)))
    lines += columns(rows, left=(0, 1, 2, 3, 4, 5))
    if listing.chosen_by:
        lines.append(f"  -> chosen by {listing.chosen_by}")
    return lines


def _asked_text(asked: AskedValue, answer: Answer) -> str:
    """A value that was asked for, in one solution."""
    question, name = asked.question, asked.question.word.text.rstrip(" =?")
    if asked.value is None:
        return ""
    if question.unit is Unit.DEGREE:
        return f"{name} = {asked.value:.4f}"
    return f"{name} = {length_of(asked.value * (2 if question.is_diameter else 1), answer.unit)}"


def _plural(count: int) -> str:
    return f"{count} solution{'' if count == 1 else 's'}"


def _place(at: Point, answer: Answer) -> list[str]:
    plane = answer.plane
    return [
        f"{axis}{length_of(value * (2 if is_diameter else 1), answer.unit)}"
        for axis, value, is_diameter in zip(plane.axes, at, plane.diameters, strict=True)
    ]


def _given_rows(answer: Answer, form: Form) -> list[tuple[str, str, str, str]]:
    """Word, value, unit and meaning of everything that was given."""
    rows = []
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


def _path_rows(answer: Answer) -> list[tuple[str, ...]]:
    """A header, the named points, and the elements with their end points."""
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
        heads += [f"center {name}" for name in names] + ["radius"]
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
