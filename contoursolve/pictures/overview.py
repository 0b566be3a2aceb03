"""Several contours in one picture: those of a program with the moves between them, and one block for several values."""

from collections import Counter
from collections.abc import Sequence
from pathlib import PurePath

from msgspec.structs import replace

from contoursolve.comparison import Motion, Travel, follow
from contoursolve.controls import DIALECTS
from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.wording import statuses_text
from contoursolve.geometry import SECOND, Turn
from contoursolve.pictures.compose import MOST_ELEMENTS, remarks_of
from contoursolve.pictures.page import TextRun
from contoursolve.pictures.scene import Mark, MarkKind, Part, Scene, Trail, Weight, axis_names
from contoursolve.pictures.subject import find_known, list_trails
from contoursolve.pictures.theme import Role
from contoursolve.pictures.vectors import distance
from contoursolve.program.pipeline import Result
from contoursolve.solving import Point
from contoursolve.solving.contour import ArcSegment, LineSegment, Segment
from contoursolve.tolerance import LENGTH

MOST_CONTOURS = 400
"""Contours that are drawn; a picture of more says how many it leaves out."""

MOST_LABELED = 60

MOST_MOVES = 2_000
"""Moves that are drawn."""

MOST_VALUES = 48
"""Contours of a fan."""

_LABELED = 7
"""Contours of a fan that are labelled, besides those beside which the outcome changes."""

Numbered = Sequence[tuple[int, Answer]]
"""Contours with their numbers, from 1."""

Move = tuple[Segment, tuple[str, str]]
"""A move in a plane, and the names of its axes."""


def compose_overview(result: Result, title: str | None) -> list[Scene]:
    """A scene for each plane in which the program has contours, in their order."""
    total = len(result.answers)
    told = statuses_text(Counter(answer.status for answer in result.answers))
    named = f"{PurePath(result.program.name).name}: {total} contour{'' if total == 1 else 's'}"
    shown = title if title is not None else named + (f" ({told})" if told else "")
    if not total:
        none = (TextRun("The program has no contour.", Role.MUTED),)
        return [Scene(shown, ("", ""), remarks=(none, *remarks_of(result.diagnostics)))]
    moves = _moves(result)
    scenes: list[Scene] = []
    for plane in dict.fromkeys(answer.plane for answer in result.answers):
        own = [(number, answer) for number, answer in enumerate(result.answers, 1) if answer.plane == plane]
        scenes.append(_scene(shown if not scenes else f"{plane.code}: {' and '.join(plane.axes)}", own, moves))
    return scenes


def describe_overview(result: Result) -> str:
    """What the picture of a program shows: its contours, and what became of each."""
    shown = result.answers[:MOST_ELEMENTS]
    sentences = [
        f"Contour {number}, line {answer.lines[0]}, {answer.claim.form.name}: {answer.status.value}."
        for number, answer in enumerate(shown, 1)
    ]
    if len(result.answers) > len(shown):
        sentences.append(f"And {len(result.answers) - len(shown)} more contours.")
    return " ".join(sentences) or "There is no contour."


def _scene(title: str, answers: Numbered, moves: Sequence[Move]) -> Scene:
    plane = answers[0][1].plane
    parts: list[Part] = [Trail((move,), Role.INK, Weight.BESIDE) for move, axes in moves if axes == plane.axes]
    remarks = [(TextRun("thin: the moves that lead to contours and away from them", Role.MUTED),)] if parts else []
    drawn = [(number, answer, _trails(answer)) for number, answer in answers[:MOST_CONTOURS]]
    begun: dict[Point, list[tuple[int, Answer]]] = {}
    for number, answer, own in drawn[:MOST_LABELED]:
        if own:
            begun.setdefault(own[0].segments[0].start, []).append((number, answer))
    for place, (number, answer, own) in enumerate(drawn):
        parts += [replace(trail, role=_role(answer)) for trail in own]
        if answer.contour is None:
            remarks.append((TextRun(f"{number}, line {answer.lines[0]}: {answer.status.value}", Role.CONFLICTING),))
        if own and place < MOST_LABELED:
            here = begun.pop(own[0].segments[0].start, None)
            if here:
                label = _label(here)
                parts.append(Mark(own[0].segments[0].start, MarkKind.START, label, label[:-1]))
            parts.append(Mark(own[-1].segments[-1].end, MarkKind.END))
    if len(answers) > MOST_CONTOURS:
        remarks.append(
            (TextRun(f"... and {len(answers) - MOST_CONTOURS} more contours, which are not drawn", Role.MUTED),)
        )
    return Scene(
        title,
        axis_names(plane),  # it has no numbers, so that contours in mm and in inches may stand together
        tuple(parts),
        remarks=tuple(remarks),
        meanings={Role.CONFLICTING: "no contour"},
        has_turning_axis=plane.diameters[SECOND],
    )


def _trails(answer: Answer) -> list[Trail]:
    return [*list_trails(answer, find_known(answer))]


def _label(here: Numbered) -> tuple[TextRun, ...]:
    """The numbers and the lines of the contours that begin at one place."""
    numbers = [
        TextRun(f"{', ' if place else ''}{number}", _role(answer)) for place, (number, answer) in enumerate(here)
    ]
    lines = ", ".join(str(answer.lines[0]) for _, answer in here)
    return (*numbers, TextRun(f"  line{'s' if len(here) > 1 else ''} {lines}", Role.MUTED))


def _role(answer: Answer, solved: Role = Role.INK) -> Role:
    return solved if answer.contour is not None else Role.CONFLICTING


# Moves -------------------------------------------------------------------------------------------------------


def _moves(result: Result) -> list[Move]:
    """The moves at a feed that are joined to a contour, before it or after it, in the plane of that contour; nothing
    for a control that nobody has described."""
    dialect = DIALECTS.get(result.control or "")
    if dialect is None:
        return []
    axes = tuple(dict.fromkeys(axis for answer in result.answers for axis in answer.plane.axes))
    # Before any code that says it, the unit is that of the first contour.
    path = follow(result, dialect.configure(result.settings), result.answers[0].unit, axes)
    planes = {line: answer.plane.axes for answer in result.answers for line in answer.lines}
    found: dict[int, Move] = {}
    for steps in (list(enumerate(path.steps)), list(enumerate(path.steps))[::-1]):
        plane: tuple[str, str] | None = None
        for number, step in steps:
            if step.line in planes:
                plane = planes[step.line]
            elif not isinstance(step, Travel) or step.motion is not Motion.FEED:
                plane = None
            elif plane is not None:
                segment = _flat(step, axes, plane)
                if segment is not None:
                    found[number] = segment, plane
    return [found[number] for number in sorted(found)[:MOST_MOVES]]


def _flat(travel: Travel, axes: tuple[str, ...], plane: tuple[str, str]) -> Segment | None:
    """A move as it is seen in a plane, if it is a line or an arc there."""
    first, second = (axes.index(axis) for axis in plane)
    (x, y), (u, v) = ((place[first], place[second]) for place in (travel.start, travel.end))
    bend = travel.bend
    if x is None or y is None or u is None or v is None:
        return None
    if bend is None:
        return LineSegment("move", (x, y), (u, v)) if distance((u, v), (x, y)) > LENGTH else None
    turn = Turn.CCW if bend.sweep > 0 else Turn.CW
    is_flat = bend.axes == (first, second)
    return ArcSegment("move", (x, y), (u, v), bend.center, bend.radii[0], turn) if is_flat else None


# Fans --------------------------------------------------------------------------------------------------------


def compose_fan(word: str, values: Sequence[float], answers: Sequence[Answer], title: str | None) -> Scene:
    """The contours of one block for several values of one word. Raises ValueError for none, or more than there is room
    for."""
    if not answers or len(answers) != len(values):
        raise ValueError(f"a fan needs a value for each of its contours: {len(values)} for {len(answers)}")
    if len(answers) > MOST_VALUES:
        raise ValueError(f"a fan of {len(answers)} contours cannot be read; draw at most {MOST_VALUES}")
    every = max(1, -(-len(answers) // _LABELED))
    parts: list[Part] = []
    for number, (value, answer) in enumerate(zip(values, answers, strict=True)):
        own, role, is_solved = _trails(answer), _role(answer, Role.GIVEN), answer.contour is not None
        is_edge = number and (answers[number - 1].contour is None) == is_solved
        is_named = bool(own) and (number % every == 0 or number == len(answers) - 1 or is_edge)
        weight = Weight.GHOST if not is_solved else Weight.MAIN if is_named else Weight.BESIDE
        parts += [replace(trail, role=role, weight=weight) for trail in own]
        if is_named:
            text = (TextRun(f"{word}{value:g}", role),)
            parts.append(Mark(own[-1].segments[-1].end, MarkKind.END, text, text))
    start = next((part.segments[0].start for part in parts if isinstance(part, Trail)), None)
    parts += [Mark(start, MarkKind.START, (TextRun("start", Role.INK),))] if start is not None else []
    told = statuses_text(Counter(answer.status for answer in answers))
    named = f"{word} from {min(values):g} to {max(values):g}, {len(answers)} contours: {told}"
    return Scene(
        title if title is not None else named,
        axis_names(answers[0].plane, answers[0].unit),
        tuple(parts),
        meanings={Role.GIVEN: "solved", Role.CONFLICTING: "no contour"},
        has_turning_axis=answers[0].plane.diameters[SECOND],
    )
