"""What contoursolve answers to test vectors: `python run.py python answer.py`. A pattern for other programs."""

import json
import sys

import contoursolve
from contoursolve import ArcSegment, LineSegment


def answer(asked: dict) -> dict:
    """A line of the output: all moves, mm, X as radius, or why there are none."""
    settings = {f"{asked['control']}.{name}": value for name, value in asked["settings"].items()}
    result = contoursolve.solve(asked["program"], control=asked["control"], settings=settings, depth="verdict")
    for each in result.diagnostics:
        if each.is_error:
            return {"refused": each.code, "alarm": each.alarm.number.split()[0] if each.alarm else None}
    contours = (each.contour for each in result.answers if each.contour)
    return {"path": [move(each) for contour in contours for each in contour.elements]}


def move(element: LineSegment | ArcSegment) -> dict:
    """A line or an arc."""
    if isinstance(element, LineSegment):
        return {"end": element.end}
    return {"end": element.end, "center": element.center, "radius": element.radius, "turn": element.turn.value}


if __name__ == "__main__":
    for line in sys.stdin:
        print(json.dumps(answer(json.loads(line))))
