"""A contour as text and as tables: what was given, every element of the path, all solutions, what was checked."""

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

from msgspec.structs import replace

from contoursolve.diagnosis import (
    Answer,
    AskedValue,
    Solution,
    Solutions,
    axis_labels,
    called_in_program,
    certificate_text,
    coordinate_texts,
    coordinates,
    count,
    join,
    labels_of,
    length_of,
    list_alternatives,
    list_solutions,
    meaning_of,
    short_name,
    word_keys,
)
from contoursolve.diagnostics import Diagnosis, Verdict, checked
from contoursolve.gcode import FACT
from contoursolve.geometry import Length, Plane, Turn
from contoursolve.output.plain_text import NAMELESS, Name, Table, columns, printable
from contoursolve.output.premises import premise_texts
from contoursolve.output.word_meanings import found_value, stated_words
from contoursolve.program import Result
from contoursolve.solving import ArcSegment, Contour

if TYPE_CHECKING:
    from contoursolve.diagnosis import EquationSystem

_VERDICT = {Verdict.PASSED: "passed", Verdict.FOUND: "see finding", Verdict.NOT_RUN: "not run"}

SMALLEST = 0.0001
"""mm. What a listing with four decimals can show."""


def _called(answer: Answer) -> str:
    """From where a contour of a subprogram is called."""
    lines = [str(line) for line in answer.calls]
    return f", called in program line{'s' * (len(lines) > 1)} {join(lines)}" if lines else ""


def title_line(answer: Answer, name: str) -> str:
    """The place, the form and the status of a contour of a program."""
    place = f"{printable(name)}:{answer.lines[0]}"
    return f"{place}: {answer.form_text}{_called(answer)}: {answer.state}"


def explaining_lines(answer: Answer, system: "EquationSystem | None" = None) -> list[str]:
    """The equations of a contour, the conditions on which they determine it, and the construction; `system` is its own,
    if it is made already."""
    from contoursolve.output.construction import construction_lines  # noqa: PLC0415 - only on demand
    from contoursolve.output.equations import equation_view  # noqa: PLC0415 - sympy is slow to import

    lines = [
        *equation_view(system or answer.system).lines(),
        "",
        "  points:",
        *points_table(answer).lines("    "),
        "",
        *construction_lines(answer),
    ]
    if answer.contour and answer.profile.figure.corners and answer.claim.form.corner_note:
        lines.append(f"    {answer.claim.form.corner_note}")
    return lines


def points_table(answer: Answer) -> Table:
    """The labels of the points of a contour, each with where it lies."""
    labels, figure = labels_of(answer.profile), answer.profile.figure
    rows = [(name, labels[name]) for name in (figure.start, *figure.points) if name in labels]
    return Table(
        "Points", ("point", "where it lies"), rows, (0, 1), [("point", name) for name, _ in rows], is_headed=False
    )


def contour_lines(answer: Answer, result: Result, *, is_explained: bool = False, is_derived: bool = False) -> list[str]:
    """The listing of one contour, in the unit and the axes of its program; explained with its equations and its
    construction, derived with the calculation by hand."""
    alternatives = list_alternatives(answer)
    if alternatives is not answer.alternatives:
        # Found here once, for the construction and for the list.
        answer = replace(answer, alternatives=alternatives)
    lines = [title_line(answer, result.program.name)]
    lines += [f"  {printable(block.text.strip())[:160]}" for block in answer.profile.blocks]
    lines += ["", *columns(given_table(answer).rows, left=(0, 3))]
    system = answer.system if is_explained or is_derived else None
    if is_explained:
        lines += ["", *explaining_lines(answer, system)]
    if is_derived and system is not None and system.solution:
        from contoursolve.output.derivation import derivation_lines  # noqa: PLC0415 - sympy is slow to import

        lines += ["", *derivation_lines(system.derivation)]
        lines += [] if is_explained else ["", "  points:", *points_table(answer).lines("    ")]
    if answer.contour:
        path = path_of(answer, answer.contour)
        lines += ["", *columns([("", "", *path.header[2:]), *path.rows], path.left)]
        lines += [line for text in premise_texts(answer.premises, result.control or "") for line in ("", f"  {text}")]
        lines += [line for text in later_texts(answer) for line in ("", f"  {text}")]
    if answer.filled:
        lines += ["", f"  filled in (the contour moves by {small(answer.filled.deviation)}):"]
        lines += [f"    {printable(text.strip())}" for text in answer.filled.blocks]
    lines += _solution_lines(answer)
    if is_explained and answer.contour is None and answer.diagnosis:
        lines += ["", *check_table(answer.diagnosis).lines()]
    return [*lines, ""]


def later_texts(answer: Answer) -> Iterator[str]:
    """A line that names elements of a chain which only a later block determines, each with that block; none without."""
    if not answer.claim.form.is_general:
        return
    from contoursolve.solving import resolved_later  # noqa: PLC0415 - most contours are no such chains

    if later := resolved_later(answer.profile):
        called = called_in_program(answer.profile)
        told = (f"{called(name)} by {called(other)}" for name, other in later.items())
        yield f"known by a later block: {', '.join(told)}"


def check_table(diagnosis: Diagnosis) -> Table:
    """The checks that a contour went through."""
    rows = [(layer.name, _VERDICT[layer.verdict], layer.remark) for layer in diagnosis.layers]
    return Table("Checks", ("check", "verdict", "what was checked"), rows, left=(0, 1, 2))


def small(mm: float) -> str:
    """A deviation, as far as a listing can show it."""
    return "less than 0.0001 mm" if mm < SMALLEST else f"{mm:.4f} mm"


# Solutions ---------------------------------------------------------------------------------------------------


def _solution_lines(answer: Answer) -> list[str]:
    """An unusual certificate of the only solution, or all solutions with what selects each."""
    listing = list_solutions(answer)
    if listing is None:
        return []
    if listing.is_single:
        searched = [] if listing.is_closed else [f"  {count_text(listing)}"]
        known = certificate_text(answer.certificate)
        told = [*searched, *([f"  certificate: {known}"] if known else [])]
        return ["", *told] if answer.contour and told else []
    lines = ["", f"  {count_text(listing)}"]
    lines += [f"  not decided: {doubt}" for doubt in listing.doubts]
    rows = [("->" if each.is_chosen else "", *row) for each, row in solution_rows(answer, listing)]
    lines += columns(rows, left=(0, 1, 2, 3, 4, 5))
    if listing.chosen_by:
        lines.append(f"  -> chosen by {listing.chosen_by}")
    return lines


def count_text(listing: Solutions) -> str:
    """The count of solutions as text, and whether the list is complete."""
    number, shown = len(listing.solutions), f"by {listing.method}"
    told = "this is the only one" if number == 1 else "these are all"
    known = f"{told} ({shown})" if listing.is_complete else f"there may be more ({shown})"
    return f"{'' if listing.is_complete else 'at least '}{count(number, 'solution')}; {known}"


def solution_rows(answer: Answer, listing: Solutions) -> list[tuple[Solution, tuple[str, str, str, str, str]]]:
    """Each solution with its name, whether it is no contour, where it differs from the others or why there is none,
    what selects it, and its certificate if it is not the usual one."""
    contours, called = [each.contour for each in listing.solutions if each.contour], called_in_program(answer.profile)
    points = contours[0].points if contours else ()
    differing = [point for point in points if len({contour.points[point] for contour in contours}) > 1]
    rows = []
    for each in listing.solutions:
        where = called(", ".join(each.reasons))
        if each.contour:
            at = each.contour.points
            places = (f"{point} {coordinates(at[point], answer.plane, answer.unit)}" for point in differing)
            where = "  ".join((*places, *(_asked_text(asked, answer) for asked in each.asked)))
        label = "" if each.contour else "no contour:"
        selects = (", " if answer.claim.form.free.picking else " ").join(each.selects)
        row = (
            called(each.name) or ("only solution" if listing.is_complete else "one solution"),
            label,
            where,
            selects,
            certificate_text(each.certificate),
        )
        rows.append((each, row))
    return rows


# What was given ----------------------------------------------------------------------------------------------


def given_table(answer: Answer) -> Table:
    """Word, value, unit and meaning of everything that was given."""
    plane, unit, rows = answer.plane, short_name(answer.unit.value), []
    keys, names, called = word_keys(answer.claim.words.values()), list[Name](), called_in_program(answer.profile)
    starts = coordinate_texts([float(value or 0) for value in answer.start.values], plane, answer.unit)
    of_axes = zip(plane.axes, answer.start.values, answer.start.free, starts, plane.diameters, strict=True)
    for axis, value, is_free, text, is_diameter in of_axes:
        shown = ("unknown", "") if value is None else (text, unit)
        told = "where the contour begins" + ("; its place is not known" if is_free else "")
        rows.append((f"start {axis}", *shown, told + (" (diameter)" if is_diameter else "")))
        names.append(("point", "start"))
    for each in stated_words(answer):
        names.append(NAMELESS if each.word.address == FACT else ("word", each.key))
        meaning = called(each.meaning) + (" - ignored" if each.is_ignored else "")
        if each.word.address == FACT:
            rows.append((printable(each.word.text), "", "", "further fact"))
        else:
            rows.append((each.word.text, *_cells(each.value, each.unit), meaning))
    for asked in answer.asked:
        question = asked.question
        meaning = f"asked: {called(meaning_of(question.name, question.word, answer.claim))}".strip(": ")
        number = ("?", "") if asked.value is None else _cells(*found_value(asked, answer))
        rows.append((printable(question.word.text), *number, meaning))
        names.append(("word", keys[question.word.span]) if question.word.span in keys else NAMELESS)
    words = {given.name: given.word for given in answer.profile.givens.values() if given.word}
    by_point = {choice.point: words[choice.given].text for choice in answer.profile.choices if choice.given in words}
    for point, side in answer.sides.items():
        rows.append((f"choice {point}", side.value, "", f"of two intersections, by {by_point[point]}"))
        names.append(("point", point))
    return Table("What was given", ("word", "value", "unit", "meaning"), rows, (0, 2, 3), names)


_FORMATS = {"mm": "z.4f", "in": "z.5f", "deg": ".4f", "": "+g"}
"""Format of a number, by its unit."""


def _cells(value: float | None, unit: str) -> tuple[str, str]:
    return f"{value or 0.0:{_FORMATS[unit]}}", unit


def _asked_text(asked: AskedValue, answer: Answer) -> str:
    """A value that was asked for, in one solution."""
    name = asked.question.word.text.rstrip(" =?")
    return f"{name} = {_cells(*found_value(asked, answer))[0]}" if asked.value is not None else ""


# The path ----------------------------------------------------------------------------------------------------


@checked
def path_of(answer: Answer, contour: Contour) -> Table:
    """The path of a contour, with what its points and elements are in the program."""
    return path_table(contour, answer.unit, labels_of(answer.profile))


def path_heads(plane: Plane, unit: Length) -> tuple[str, ...]:
    """The columns of a path: both axes of its end points, both of its centers, and the radius."""
    written = short_name(unit.value)
    labels = [f"{label} [{written}]" for label in axis_labels(plane)]
    return (*labels, *(f"center {label}" for label in labels), f"radius [{written}]")


@checked
def path_table(contour: Contour, unit: Length = Length.MM, called: Mapping[str, str] = MappingProxyType({})) -> Table:
    """The named points, and the elements with their end points, in a unit and as the control writes the axes; `called`
    says what they are."""
    has_arc = any(isinstance(each, ArcSegment) for each in contour.elements)
    heads = path_heads(contour.plane, unit)[: None if has_arc else 2]
    blank = [""] * (len(heads) - 2)

    def point(at: tuple[float, float]) -> list[str]:
        return coordinate_texts(at, contour.plane, unit)

    told = {name: f"{name}, {called[name]}" if name in called else name for name in contour.points}
    rows: list[tuple[str, ...]] = [(told[name], "point", *point(at), *blank) for name, at in contour.points.items()]
    rows.append(("start", "", *point(contour.start), *blank))
    names: list[Name] = [*(("point", name) for name in contour.points), ("point", "start")]
    for element in contour.elements:
        own = called.get(element.name, element.name)
        if isinstance(element, ArcSegment):
            code = "G02" if element.turn is Turn.CW else "G03"
            arc = [*point(element.center), length_of(element.radius, unit)]
            rows.append((own, code, *point(element.end), *arc))
        else:
            rows.append((own, "G01", *point(element.end), *blank))
        names.append(("element", element.name))
    return Table("The path", ("element", "move", *heads), rows, (0, 1), names)
