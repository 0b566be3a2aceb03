"""A whole program in one picture: every contour where it is, with its number and line."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import PurePath

from contoursolve.examine import Answer
from contoursolve.model import FIRST, SECOND, Length
from contoursolve.pictures.compose import axis_name, main_trails, remarks_of
from contoursolve.pictures.finding import find_known
from contoursolve.pictures.moves import Move, list_moves
from contoursolve.pictures.scene import Kind, Mark, Scene, Trail, Weight
from contoursolve.pictures.sheet import Run
from contoursolve.pictures.theme import Role
from contoursolve.pipeline import Result
from contoursolve.solving import Point, Status

MOST_CONTOURS = 400
"""Contours that are drawn; a picture of more says how many it leaves out."""

MOST_LABELED = 60


def compose_overview(result: Result, title: str | None) -> list[Scene]:
    """A scene for each plane in which the program has contours, in their order."""
    answers = list(enumerate(result.answers, 1))
    planes = dict.fromkeys(answer.plane for _, answer in answers)
    told = title if title is not None else _title(result)
    if not answers:
        none = (Run("The program has no contour.", Role.MUTED),)
        return [Scene(told, ("", ""), remarks=(none, *remarks_of(result.diagnostics)))]
    scenes: list[Scene] = []
    moves = list_moves(result)
    for plane in planes:
        own = [(number, answer) for number, answer in answers if answer.plane == plane]
        scene = _scene(own, moves)
        scenes.append(replace(scene, title=told if not scenes else f"{plane.code}: {' and '.join(plane.axes)}"))
    return scenes


def _title(result: Result) -> str:
    counts = {status: sum(answer.status is status for answer in result.answers) for status in Status}
    told = ", ".join(f"{counts[status]} {status.value}" for status in reversed(Status) if counts[status])
    number = len(result.answers)
    return f"{PurePath(result.program.name).name}: {number} contour{'' if number == 1 else 's'}" + (
        f" ({told})" if told else ""
    )


def _scene(answers: Sequence[tuple[int, Answer]], moves: Sequence[Move]) -> Scene:
    plane = answers[0][1].plane
    trails = [Trail((move.segment,), Role.INK, Weight.BESIDE) for move in moves if move.axes == plane.axes]
    marks: list[Mark] = []
    remarks = []
    if trails:
        remarks.append((Run("thin: the moves that lead to contours and away from them", Role.MUTED),))
    drawn = [(number, answer, main_trails(answer, find_known(answer))) for number, answer in answers[:MOST_CONTOURS]]
    begun: dict[Point, list[tuple[int, Answer]]] = {}
    for number, answer, own in drawn[:MOST_LABELED]:
        if own:
            begun.setdefault(own[0].segments[0].start, []).append((number, answer))
    for place, (number, answer, own) in enumerate(drawn):
        trails += [replace(trail, role=_role(answer)) for trail in own]
        if answer.contour is None:
            remarks.append((Run(f"{number}, line {answer.lines[0]}: {answer.status.value}", Role.CONFLICTING),))
        if own and place < MOST_LABELED:
            here = begun.pop(own[0].segments[0].start, None)
            if here:
                label = _label(here)
                marks.append(Mark(own[0].segments[0].start, Kind.START, label, label[:-1]))
            marks.append(Mark(own[-1].segments[-1].end, Kind.END))
    if len(answers) > MOST_CONTOURS:
        remarks.append((Run(f"... and {len(answers) - MOST_CONTOURS} more contours, which are not drawn", Role.MUTED),))
    # It has no numbers, so that contours in mm and in inches may stand together.
    names = axis_name(plane, FIRST, Length.MM), axis_name(plane, SECOND, Length.MM)
    return Scene(
        "",
        names,
        tuple(trails),
        marks=tuple(marks),
        remarks=tuple(remarks),
        meanings={Role.CONFLICTING: "no contour"},
        has_turning_axis=plane.diameters[SECOND],
    )


def _label(here: Sequence[tuple[int, Answer]]) -> tuple[Run, ...]:
    """The numbers and the lines of the contours that begin at one place."""
    numbers = [Run(f"{', ' if place else ''}{number}", _role(answer)) for place, (number, answer) in enumerate(here)]
    lines = ", ".join(str(answer.lines[0]) for _, answer in here)
    return (*numbers, Run(f"  line{'s' if len(here) > 1 else ''} {lines}", Role.MUTED))


def _role(answer: Answer) -> Role:
    return Role.INK if answer.contour is not None else Role.CONFLICTING
