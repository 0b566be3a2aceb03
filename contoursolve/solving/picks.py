"""Which of several contours is meant, element by element in the order of travel."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, dist, pi, tau
from typing import TYPE_CHECKING

from contoursolve.geometry import Line, Pick, Profile
from contoursolve.solving.solution import Note, NoteKind, Point, Refusal, RefusalKind
from contoursolve.tolerance import LENGTH

if TYPE_CHECKING:
    from contoursolve.solving.alternatives import Alternative


def pick(paths: Sequence[Alternative], profile: Profile) -> tuple[list[Alternative], list[Refusal | Note]]:
    """The contours that the picks of a profile leave, and what there is to say of these.

    At each element contours are parted by how they run there, and counted: the shorter element first, of equally
    long ones the smaller turn to the left from the direction before.
    """
    left, events = list(paths), list[Refusal | Note]()
    for each in sorted(profile.picks, key=lambda each: each.element) if left else ():
        groups = _groups(left, each.element, profile)
        givens = (each.given,) if each.given else ()
        values = {"actual": float(each.number), "limit": float(len(groups))}
        subject = profile.figure.path[each.element - 1].name
        if len(groups) == 1 and each.number > 1:
            events.append(Note(NoteKind.PICK_OPEN, subject, givens, values))
        elif each.number > len(groups) or each.number < 1:
            return [], [*events, Refusal(RefusalKind.PICK_NONE, subject, givens, values)]
        else:
            if not each.given and len(groups) > 1:
                events.append(Note(NoteKind.PICK_FIRST, subject, (), values))
            left = groups[each.number - 1]
    return left, events


def numbers_of(item: Alternative, paths: Sequence[Alternative], profile: Profile) -> list[Pick]:
    """The picks that leave one contour of several: at each element at which they part, in the order of travel."""
    left, found = list(paths), list[Pick]()
    for element in range(1, len(profile.figure.path) + 1):
        groups = _groups(left, element, profile)
        number = next(number for number, group in enumerate(groups, 1) if item in group)
        if len(groups) > 1:
            found.append(Pick(element, number, ""))
            left = groups[number - 1]
    return found


def _groups(paths: Sequence[Alternative], element: int, profile: Profile) -> list[list[Alternative]]:
    """Contours that run alike at an element, in the order in which they are counted."""
    groups: list[tuple[tuple[float, float], list[Point], list[Alternative]]] = []
    for path in paths:
        run, rank = _run(path, element, profile)
        same = next((group for group in groups if all(map(_is_same, group[1], run))), None)
        if same is None:
            groups.append((rank, run, [path]))
        else:
            same[2].append(path)
    groups.sort(key=lambda group: (round(group[0][0], 6), group[0][1]))
    return [each for _, _, each in groups]


def _is_same(one: Point, other: Point) -> bool:
    return dist(one, other) <= LENGTH


def _run(path: Alternative, element: int, profile: Profile) -> tuple[list[Point], tuple[float, float]]:
    """The points of an element, and its length with the turn to the left at which it begins, from 0 to 360 degrees."""
    points, own = path.solution.points, profile.figure.path[element - 1]
    tail, head = points[own.tail], points[own.head]
    begin, _ = _directions(path, element, profile)
    before = _directions(path, element - 1, profile)[1] if element > 1 else 0.0
    turn = (begin - before) % tau
    turn = 0.0 if tau - turn < LENGTH else turn
    if isinstance(own, Line):
        return [tail, head], (dist(tail, head), turn)
    center = points[own.center]
    angles = [atan2(at[1] - center[1], at[0] - center[0]) for at in (tail, head)]
    sweep = (own.turn.sign * (angles[1] - angles[0])) % tau
    return [tail, head, center], (dist(tail, center) * sweep, turn)


def _directions(path: Alternative, element: int, profile: Profile) -> tuple[float, float]:
    """The directions in which an element begins and ends, radians."""
    points, own = path.solution.points, profile.figure.path[element - 1]
    tail, head = points[own.tail], points[own.head]
    if isinstance(own, Line):
        angle = atan2(head[1] - tail[1], head[0] - tail[0])
        return angle, angle
    center = points[own.center]
    first, second = (atan2(at[1] - center[1], at[0] - center[0]) + own.turn.sign * pi / 2 for at in (tail, head))
    return first, second
