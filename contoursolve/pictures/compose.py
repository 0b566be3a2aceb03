"""From the answer about a contour to the scene that a picture shows, and to the same in words."""

from collections.abc import Iterator, Mapping, Sequence

from msgspec.structs import replace

from contoursolve.diagnosis import Answer, labels_of, list_solutions
from contoursolve.diagnostics import Diagnostic, Severity
from contoursolve.gcode import FACT
from contoursolve.geometry import SECOND, Turn
from contoursolve.pictures.auxiliary import list_auxiliary
from contoursolve.pictures.dimensions import Others, list_dimensions, list_marks, noted_points
from contoursolve.pictures.page import About, TextRun, visible
from contoursolve.pictures.scene import Closeup, Scene, ToolDrawing, Trail, Weight, axis_names, coordinates, number
from contoursolve.pictures.subject import Subject, fitting, shared_part, subject_of, trace_known
from contoursolve.pictures.theme import Role
from contoursolve.pictures.two_solutions import two_solutions
from contoursolve.reading import ReadIssue
from contoursolve.solving import SAME, ArcSegment, Contour, Point, distance, trace

MOST_LINES, MOST_OF_CHAIN = 6, 24
"""Lines of a program in a picture's head: of any, and of a chain, whose elements are named by their blocks."""

MOST_LABELS = 120
"""Labels of a chain, whose words are all there to be found; those for which there is no room stand below."""

MOST_REMARKS = 3

_REMARKS = {Severity.ERROR: Role.CONFLICTING, Severity.WARNING: Role.IGNORED, Severity.INFO: Role.MUTED}
"""Colour role of a finding's text, by severity."""

MOST_SOLUTIONS = 6
"""Other solutions that are drawn."""

MOST_ELEMENTS = 24
"""Elements that are told in words."""


def compose(
    answer: Answer, title: str | None = None, beside: Sequence[ToolDrawing] = (), *, is_shared: bool = False
) -> Scene:
    """The scene of one contour, whatever its status, with what else is drawn in its plane. If `is_shared`, without the
    others that fit, and where nothing chooses only what all of them share."""
    subject = subject_of(answer)
    ghosts: list[Trail] = []
    others: Others = {}
    both = two_solutions(answer) if not is_shared else None
    if is_shared:
        subject = shared_part(subject)
    elif both is None:
        ghosts, others = _other_ways(subject) if subject.is_chain else _ghosts(subject)
    noted = noted_points(subject)
    scene = Scene(
        title=title if title is not None else title_of(answer),
        axes=axis_names(answer.plane, answer.unit),
        parts=(
            *ghosts,
            *(both.trails if both is not None else subject.trails),
            *(both.marks if both is not None else ()),
            *(each for each in list_marks(subject, noted, others) if both is None or each.role not in _UNDECIDED),
            *list_dimensions(subject, noted),
            *list_auxiliary(subject),
        ),
        lines=tuple(_lines(subject)),
        remarks=tuple(remarks_of(answer.diagnostics)),
        meanings=_meanings(subject),
        has_turning_axis=answer.plane.diameters[SECOND] and not answer.start.free[SECOND],
        is_one_contour=True,
        closeups=tuple(_corners(subject.trails, labels_of(answer.profile))),
    )
    scene = scene.with_beside(each for each in beside if each.plane == answer.plane)
    return replace(scene, most_labels=MOST_LABELS) if subject.is_chain else scene


_UNDECIDED = Role.SEVERAL, Role.CANDIDATE
"""Roles of points that two solutions have in two places."""

_READABLE = 11.0
"""Pixels of the larger side of a corner that can be read."""


def _corners(trails: Sequence[Trail], labels: Mapping[str, str]) -> Iterator[Closeup]:
    """The corners of a path, in its order."""
    segments = [segment for trail in trails if trail.weight is Weight.MAIN for segment in trail.segments]
    corners = {each.name: each for each in segments[::-1] if each.name.startswith("corner")}
    shown = (each for each in segments if corners.get(each.name) is each)
    yield from (Closeup(labels.get(each.name, each.name), (each,), _READABLE) for each in shown)


def title_of(answer: Answer) -> str:
    """The title of a picture: name of the form, program lines and status of the contour."""
    form = answer.claim.form
    lines = answer.lines
    where = f"program line {lines[0]}" if len(lines) == 1 else f"program lines {lines[0]} to {lines[-1]}"
    return f"{form.name} ({form.title}), {where}: {answer.state}"


def _ghosts(subject: Subject) -> tuple[list[Trail], Others]:
    """Other contours, and where their computed intersections are with what selects each."""
    answer, known = subject.answer, subject.known
    places: dict[str, list[tuple[Point, str]]] = {}
    drawn = answer.contour.elements if answer.contour else tuple(s for s, _ in trace_known(answer.profile, known))
    others = [trace(answer.profile, other).elements for other in known.others]
    trails = [Trail(elements, Role.GHOST, Weight.GHOST) for elements in others if elements and elements != drawn]
    listing = list_solutions(answer) if answer.alternatives is not None else None
    solutions = listing.solutions if listing is not None else ()
    shown = [(each, each.contour) for each in solutions if each.contour is not None and not each.is_chosen]
    for each, contour in shown[:MOST_SOLUTIONS]:
        points, first = contour.points, known.points
        own = [name for name, at in points.items() if name in first and distance(at, first[name]) > SAME]
        is_drawn = answer.contour is None and not own and points.keys() <= first.keys()
        if not is_drawn and contour.elements:
            is_candidate = subject.other is Role.CANDIDATE
            trails.append(Trail(contour.elements, subject.other, Weight.MAIN if is_candidate else Weight.GHOST))
        for name in own or [name for name in points if name.startswith("P")]:
            places.setdefault(name, []).append((points[name], " ".join(each.selects)))
    return trails, places


def _meanings(subject: Subject) -> Mapping[Role, str]:
    """Legend text for other contours, by role."""
    if subject.known.others:
        return {Role.GHOST: "other values"}
    form = subject.answer.claim.form
    return {Role.GHOST: f"another solution, by its {form.free.picking}"} if form.free.picking else {}


def _other_ways(subject: Subject) -> tuple[list[Trail], Others]:
    """The solutions of a chain that it does not take, thin, each with the numbers that choose it where it parts from
    the rest; where nothing chooses, all of them have their numbers there."""
    answer, profile = subject.answer, subject.profile
    trails, places = list[Trail](), dict[str, list[tuple[Point, str]]]()
    if answer.alternatives is None:
        return trails, places
    from contoursolve.solving import numbers_of  # noqa: PLC0415 - few controls have such words

    paths, left = answer.alternatives.paths, fitting(answer)
    is_solved, stated = answer.contour is not None, {each.element for each in profile.picks}
    for item in [each for each in paths if (each in left) is not is_solved][:MOST_SOLUTIONS]:
        picks = numbers_of(item, paths, profile)
        if is_solved:
            elements = trace(profile, item.solution).elements
            trails += [Trail(elements, Role.GHOST, Weight.GHOST)] if elements else []
        else:
            picks = [each for each in picks if each.element not in stated]
        if picks and answer.claim.form.free.picking:
            numbers = "-".join(str(each.number) for each in picks)
            told = numbers if is_solved else answer.claim.lexicon.spell(answer.claim.form.free.picking, numbers)
            name = profile.figure.path[picks[-1].element - 1].head
            places.setdefault(name, []).append((item.solution.points[name], told))
    return trails, places


def _lines(subject: Subject) -> Iterator[tuple[TextRun, ...]]:
    """The program's lines, each word in its role."""
    answer, roles = subject.answer, subject.roles
    by_span = {
        given.word.span: roles[name]
        for name, given in answer.profile.givens.items()
        if given.word is not None and name in roles
    }
    questions = [asked.question for asked in answer.asked if asked.question.word.address != FACT]
    by_span |= {question.word.span: roles.get(question.name, Role.FREE) for question in questions}
    by_span |= {span: Role.CONFLICTING for span in subject.blamed if span not in by_span}
    blocks, most = answer.claim.blocks, MOST_OF_CHAIN if subject.is_chain else MOST_LINES
    for block in blocks[:most]:
        runs, place, text = [], 0, visible(block.text)
        for span in sorted((span for span in by_span if span.line == block.line), key=lambda span: span.column):
            if span.column - 1 < place:
                continue
            runs.append(TextRun(text[place : span.column - 1], Role.MUTED))
            shown, role = text[span.column - 1 : span.end_column - 1], by_span[span]
            runs.append(TextRun(shown, role, subject.about(span), role is Role.CONFLICTING))
            place = span.end_column - 1
        runs.append(TextRun(text[place:], Role.MUTED))
        yield tuple(run for run in runs if run.text)
    if len(blocks) > most:
        yield (TextRun(f"... and {len(blocks) - most} more blocks", Role.MUTED),)
    for directive in answer.claim.directives:
        if directive.span.line < 0:
            role = by_span.get(directive.span, Role.GIVEN)
            told = visible(f'--fact "{directive.text}"')
            yield (TextRun(told, role, subject.about(directive.span), role is Role.CONFLICTING),)


def remarks_of(diagnostics: Sequence[Diagnostic]) -> Iterator[tuple[TextRun, ...]]:
    """The first findings; of what is no error or warning, only that a word lacks its point, or the contour its
    place."""
    findings = [(place, finding) for place, finding in enumerate(diagnostics, 1) if _is_told(finding)]
    for place, finding in findings[:MOST_REMARKS]:
        role = _REMARKS[finding.severity]
        yield (TextRun(visible(f"{finding.severity.value}: {finding.message}"), role, About(finding=str(place))),)
    if len(findings) > MOST_REMARKS:
        yield (TextRun(f"... and {len(findings) - MOST_REMARKS} more findings", Role.MUTED),)


def _is_told(finding: Diagnostic) -> bool:
    return finding.severity is not Severity.INFO or finding.about in _TOLD


_TOLD = (ReadIssue.POINT_MISSING, ReadIssue.START_RELATIVE)


def told_of(beside: Sequence[ToolDrawing]) -> Iterator[str]:
    """The sentences about what is drawn beside contours."""
    for each in beside:
        told = (each.title, *("".join(run.text for run in runs) for runs in each.remarks))
        yield from (f"{text[0].upper()}{text[1:]}." for text in told)


def describe(answer: Answer) -> str:
    """Description for readers who cannot see the picture: each element of the path, or the findings that prevent
    one."""
    first, second = answer.plane.axes
    diameter = " as a diameter" if answer.plane.diameters[SECOND] else ""
    sentences = [f"{first} to the right, {second} up{diameter}, in {answer.unit.value}."]
    if answer.contour is not None:
        sentences += _path_in_words(answer, answer.contour)
    else:
        sentences.append(f"There is no contour: {answer.state}.")
    for finding in [*filter(_is_told, answer.diagnostics)][:3]:
        sentences.append(f"{finding.severity.value}: {finding.message}.")
    return " ".join(sentences)


def _path_in_words(answer: Answer, contour: Contour) -> Iterator[str]:
    def place(at: Point) -> str:
        return coordinates(at, answer.plane, answer.unit)

    labels = labels_of(answer.profile)

    def called(name: str) -> str:
        told = labels.get(name, name)
        return f"{told[0].upper()}{told[1:]}"

    yield f"The path starts at {place(contour.start)}."
    for element in contour.elements[:MOST_ELEMENTS]:
        if isinstance(element, ArcSegment):
            turn = "clockwise" if element.turn is Turn.CW else "counter-clockwise"
            radius = number(element.radius, answer.unit)
            yield f"{called(element.name)} {turn} to {place(element.end)}, radius {radius}."
        else:
            yield f"{called(element.name)} to {place(element.end)}."
    if len(contour.elements) > MOST_ELEMENTS:
        yield f"And {len(contour.elements) - MOST_ELEMENTS} more elements."
    yield from (
        f"{name}, {labels.get(name, 'a point')}, is at {place(at)}."
        for name, at in list(contour.points.items())[:MOST_ELEMENTS]
    )
