"""Which of several contours is meant, element by element in the order of travel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from math import atan2, cos, dist, pi, sin, tau
from typing import TYPE_CHECKING

from contoursolve.analysis import analyse, groups_of
from contoursolve.geometry import Arc, Line, Pick, Profile, System, assemble
from contoursolve.solving.solution import Note, NoteKind, Point, Refusal, RefusalKind
from contoursolve.tolerance import LENGTH

if TYPE_CHECKING:
    from contoursolve.solving.alternatives import Alternative


def pick(paths: Sequence[Alternative], profile: Profile) -> tuple[list[Alternative], list[Refusal | Note]]:
    """The contours that the picks of a profile leave, and what there is to say of these.

    At each element contours are parted by how they run there, and counted: the nearer end along the element first, of
    equally near ones the smaller turn to the left from the direction before.
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
    # An end that a later block determines is not there yet when this block is chosen.
    ends = [] if own.name in resolved_later(profile) else [head]
    way = (tail[0] + cos(begin), tail[1] + sin(begin))
    before = _directions(path, element - 1, profile)[1] if element > 1 else 0.0
    turn = (begin - before) % tau
    turn = 0.0 if tau - turn < LENGTH else turn
    if isinstance(own, Line):
        return [tail, way, *ends], (dist(tail, head) if ends else 0.0, turn)
    center = points[own.center]
    angles = [atan2(at[1] - center[1], at[0] - center[0]) for at in (tail, head)]
    sweep = (own.turn.sign * (angles[1] - angles[0])) % tau
    return [tail, way, center, *ends], (dist(tail, center) * sweep if ends else 0.0, turn)


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


def resolved_later(profile: Profile) -> Mapping[str, str]:
    """The elements of a chain that only a later block determines, each with the element of that block."""
    return _resolved_later(assemble(profile))


@lru_cache(maxsize=256)
def _resolved_later(system: System) -> Mapping[str, str]:
    path = system.figure.path
    if not analyse(system).is_determined:
        return {}
    latest: dict[str, int] = {}
    for group in groups_of(system):
        numbers = [_block_of(fact.given) for fact in group.facts]
        used = (name for fact in group.facts for name in system.unknowns_of(fact) if name in latest)
        latest |= dict.fromkeys(group.unknowns, max([*numbers, *(latest[name] for name in used)], default=0))
    found = {}
    for number, element in enumerate(path, 1):
        things = {element.name, element.head, *((element.center, element.radius) if isinstance(element, Arc) else ())}
        last = max((at for name, at in latest.items() if {name, name.rpartition(".")[0]} & things), default=0)
        if last > number:
            found[element.name] = path[last - 1].name
    return found


def _block_of(given: str) -> int:
    """The number of the element whose block states a given; 0 for what none states."""
    number = given.partition(":")[0]
    return int(number) if number.isdigit() else 0
