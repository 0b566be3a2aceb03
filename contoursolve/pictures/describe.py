"""A picture in words, for those who do not see it."""

from contoursolve.contour import ArcSegment
from contoursolve.diagnostic import Severity
from contoursolve.examine import Answer
from contoursolve.model import FIRST, SECOND, Turn
from contoursolve.pictures.wording import coordinate, number
from contoursolve.pipeline import Result
from contoursolve.solving import Point

MOST_ELEMENTS = 24
"""Elements that are listed."""


def describe(answer: Answer) -> str:
    """What the picture of a contour shows: every element of its path, or what keeps it from having one."""
    plane, unit = answer.plane, answer.unit

    def place(at: Point) -> str:
        return " ".join(coordinate(at, axis, plane, unit) for axis in (FIRST, SECOND))

    first, second = plane.axes
    diameter = " as a diameter" if plane.diameters[SECOND] else ""
    sentences = [f"{first} to the right, {second} up{diameter}, in {unit.value}."]
    contour = answer.contour
    if contour is not None:
        sentences.append(f"The path starts at {place(contour.start)}.")
        for element in contour.elements[:MOST_ELEMENTS]:
            if isinstance(element, ArcSegment):
                turn = "clockwise" if element.turn is Turn.CW else "counter-clockwise"
                sentences.append(
                    f"{element.name}: arc {turn} to {place(element.end)}, radius {number(element.radius, unit)}."
                )
            else:
                sentences.append(f"{element.name}: straight to {place(element.end)}.")
        if len(contour.elements) > MOST_ELEMENTS:
            sentences.append(f"And {len(contour.elements) - MOST_ELEMENTS} more elements.")
        sentences += [f"{name} is at {place(at)}." for name, at in list(contour.points.items())[:MOST_ELEMENTS]]
    else:
        sentences.append(f"There is no contour: {answer.status.value}.")
    for finding in [each for each in answer.diagnostics if each.severity is not Severity.INFO][:3]:
        sentences.append(f"{finding.severity.value}: {finding.message}.")
    return " ".join(sentences)


def describe_result(result: Result) -> str:
    """What the picture of a program shows: its contours, and what became of each."""
    shown = result.answers[:MOST_ELEMENTS]
    sentences = [
        f"Contour {number}, line {answer.lines[0]}, {answer.claim.form.name}: {answer.status.value}."
        for number, answer in enumerate(shown, 1)
    ]
    if len(result.answers) > len(shown):
        sentences.append(f"And {len(result.answers) - len(shown)} more contours.")
    return " ".join(sentences) or "There is no contour."
