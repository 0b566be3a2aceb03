"""The fan of a family: the contours of one block for several values of one word."""

from collections.abc import Sequence
from dataclasses import replace

from contoursolve.examine import Answer
from contoursolve.model import FIRST, SECOND
from contoursolve.pictures.compose import axis_name, main_trails
from contoursolve.pictures.finding import find_known
from contoursolve.pictures.scene import Kind, Mark, Scene, Trail, Weight
from contoursolve.pictures.sheet import Run
from contoursolve.pictures.theme import Role
from contoursolve.solving import Status

MOST_CONTOURS = 48
"""Contours of a fan."""

_LABELED = 7
"""Contours that are labelled, besides those beside which the outcome changes."""


def compose_fan(word: str, values: Sequence[float], answers: Sequence[Answer], title: str | None) -> Scene:
    """The contours of one block for several values of one word. Raises ValueError for none, or more than there is room
    for."""
    if not answers or len(answers) != len(values):
        raise ValueError(f"a fan needs a value for each of its contours: {len(values)} for {len(answers)}")
    if len(answers) > MOST_CONTOURS:
        raise ValueError(f"a fan of {len(answers)} contours cannot be read; draw at most {MOST_CONTOURS}")
    every = max(1, -(-len(answers) // _LABELED))
    trails: list[Trail] = []
    marks: list[Mark] = []
    for number, (value, answer) in enumerate(zip(values, answers, strict=True)):
        own = main_trails(answer, find_known(answer))
        is_solved = answer.contour is not None
        role = Role.GIVEN if is_solved else Role.CONFLICTING
        is_edge = number and (answers[number - 1].contour is None) == is_solved
        is_named = bool(own) and (number % every == 0 or number == len(answers) - 1 or is_edge)
        weight = Weight.GHOST if not is_solved else Weight.MAIN if is_named else Weight.BESIDE
        trails += [replace(trail, role=role, weight=weight) for trail in own]
        if is_named:
            text = Run(f"{word}{value:g}", role)
            marks.append(Mark(own[-1].segments[-1].end, Kind.END, (text,), (text,)))
    plane = answers[0].plane
    counts = {status: sum(answer.status is status for answer in answers) for status in Status}
    told = ", ".join(f"{counts[status]} {status.value}" for status in reversed(Status) if counts[status])
    start = next((trail.segments[0].start for trail in trails), None)
    marks += [Mark(start, Kind.START, (Run("start", Role.INK),), ())] if start is not None else []
    span = f"{word} from {min(values):g} to {max(values):g}"
    shown = title if title is not None else f"{span}, {len(answers)} contours: {told}"
    return Scene(
        shown,
        (axis_name(plane, FIRST, answers[0].unit), axis_name(plane, SECOND, answers[0].unit)),
        tuple(trails),
        marks=tuple(marks),
        meanings={Role.GIVEN: "solved", Role.CONFLICTING: "no contour"},
        has_turning_axis=plane.diameters[SECOND],
    )
