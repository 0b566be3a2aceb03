"""A solved contour as text: what was given, the virtual intersections, every element of the path."""

from collections.abc import Sequence

from contoursolve.contour import ArcSegment
from contoursolve.diagnostic import Verdict
from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.examine import Answer
from contoursolve.model import Length, Turn, Unit
from contoursolve.output.layout import columns, printable
from contoursolve.pipeline import Result
from contoursolve.reading import Form, Lexicon
from contoursolve.solving import Point
from contoursolve.syntax import Word

_VERDICT = {Verdict.PASSED: "passed", Verdict.FOUND: "see finding", Verdict.NOT_RUN: "not run"}

_INCH = float(Length.INCH.in_mm)


def contour_lines(answer: Answer, result: Result) -> list[str]:
    """The listing of one contour, in the unit and the axes of its program."""
    dialect = DIALECTS[result.control or ""]
    form = next(form for form in dialect.forms if form.name == answer.form)
    lines = [f"{result.program.name}:{answer.lines[0]}: {form.name} ({form.title}): {answer.status.value}"]
    lines += [f"  {printable(block.text.strip())[:160]}" for block in answer.profile.blocks]
    lines += ["", *columns(_given_rows(answer, form, dialect), left=(0, 3))]
    if answer.contour:
        lines += ["", *columns(_path_rows(answer), left=(0, 1))]
    elif answer.diagnosis:
        rows = [(layer.name, _VERDICT[layer.verdict], layer.remark) for layer in answer.diagnosis.layers]
        lines += ["", *columns([("check", "verdict", "what was checked"), *rows], left=(0, 1, 2))]
    return [*lines, ""]


def _given_rows(answer: Answer, form: Form, dialect: Dialect) -> list[tuple[str, str, str, str]]:
    """Word, value, unit and meaning of everything that was given."""
    rows = []
    for axis, value, is_diameter in zip(answer.plane.axes, answer.start.values, answer.plane.diameters, strict=True):
        shown = "unknown" if value is None else _length(float(value) * (2 if is_diameter else 1), answer.unit)
        rows.append(
            ("start " + axis, shown, _unit(answer.unit) if value is not None else "", _axis_meaning(is_diameter))
        )
    ignored = {fact.given for fact in answer.profile.ignored}
    words = {given.name: given.word for given in answer.profile.givens.values() if given.word}
    for name, word in sorted(words.items(), key=lambda item: item[1].span):
        meaning = form.meanings.get(name) or dialect.modes.lexicon.addresses[word.address].meaning
        meaning += " - ignored" if name in ignored else ""
        rows.append((word.text, *_value(word, dialect.modes.lexicon, answer.unit), meaning))
    if answer.side:
        choice = next(choice for choice in answer.profile.choices if choice.side is answer.side)
        rows.append(("choice", answer.side.value, "", f"of two intersections, by {words[choice.given].text}"))
    return rows


def _value(word: Word, lexicon: Lexicon, unit: Length) -> tuple[str, str]:
    """What a word states, in the terms in which it is written, and its unit."""
    value, row = float(lexicon.value(word, unit) or 0), lexicon.addresses[word.address]
    if row.unit is Unit.DEGREE:
        return f"{value:.4f}", "deg"
    if row.unit is Unit.SIGN:
        return f"{value:+g}", ""
    return _length(value * (2 if row.is_diameter else 1), unit), _unit(unit)


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
            _length(value * (2 if is_diameter else 1), answer.unit)
            for value, is_diameter in zip(at, answer.plane.diameters, strict=True)
        ]

    rows: list[Sequence[str]] = [header]
    rows += [(name, "point", *point(at), *blank) for name, at in contour.points.items()]
    rows.append(("start", "", *point(contour.start), *blank))
    for element in contour.elements:
        if isinstance(element, ArcSegment):
            code = "G02" if element.turn is Turn.CW else "G03"
            arc = [*point(element.center), _length(element.radius, answer.unit)]
            rows.append((element.name, code, *point(element.end), *arc))
        else:
            rows.append((element.name, "G01", *point(element.end), *blank))
    return [tuple(row) for row in rows]


def _length(mm: float, unit: Length) -> str:
    text = f"{mm:.4f}" if unit is Length.MM else f"{mm / _INCH:.5f}"
    return text.removeprefix("-") if text in ("-0.0000", "-0.00000") else text


def _unit(unit: Length) -> str:
    return "in" if unit is Length.INCH else "mm"
