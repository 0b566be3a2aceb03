"""The ordinary moves that lead up to the contours of a program and away from them."""

from dataclasses import dataclass
from math import hypot

from contoursolve.comparison import Motion, Travel, follow
from contoursolve.contour import ArcSegment, LineSegment, Segment
from contoursolve.dialects import DIALECTS
from contoursolve.model import Turn
from contoursolve.pipeline import Result
from contoursolve.tolerance import LENGTH

MOST_MOVES = 2_000
"""Moves that are drawn."""


@dataclass(frozen=True, slots=True)
class Move:
    """A move in a plane, with the names of its axes."""

    segment: Segment
    axes: tuple[str, str]


def list_moves(result: Result) -> list[Move]:
    """The moves at a feed that are joined to a contour, before it or after it, in the plane of that contour; nothing
    for a control that nobody has described."""
    dialect = DIALECTS.get(result.control or "")
    if dialect is None or not result.answers:
        return []
    dialect = dialect.configure(result.settings)
    axes = tuple(dict.fromkeys(axis for answer in result.answers for axis in answer.plane.axes))
    # Before any code that says it, the unit is that of the first contour.
    path = follow(result, dialect, result.answers[0].unit, axes)
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
                    found[number] = Move(segment, plane)
    return [found[number] for number in sorted(found)[:MOST_MOVES]]


def _flat(travel: Travel, axes: tuple[str, ...], plane: tuple[str, str]) -> Segment | None:
    """A move as it is seen in a plane, if it is a line or an arc there."""
    first, second = (axes.index(axis) for axis in plane)
    ends = [(place[first], place[second]) for place in (travel.start, travel.end)]
    (x, y), (u, v) = ends
    if x is None or y is None or u is None or v is None:
        return None
    bend = travel.bend
    if bend is None:
        return LineSegment("move", (x, y), (u, v)) if hypot(u - x, v - y) > LENGTH else None
    if bend.axes != (first, second):
        return None
    turn = Turn.CCW if bend.sweep > 0 else Turn.CW
    return ArcSegment("move", (x, y), (u, v), bend.center, bend.radii[0], turn)
