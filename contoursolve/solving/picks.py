"""The solutions of a profile, and which of them is meant, element by element in the order of travel."""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from math import atan2, cos, dist, pi, remainder, sin, tau
from statistics import fmean

from contoursolve.geometry import Arc, Line, Pick, Profile, System, assemble
from contoursolve.solving.determinacy import analyse, groups_of
from contoursolve.solving.events import NoteKind, RefusalKind
from contoursolve.solving.solution import Alternative, Note, Point, Refusal
from contoursolve.tolerance import LENGTH


def pick(paths: Sequence[Alternative], profile: Profile) -> tuple[list[Alternative], list[Refusal | Note]]:
    """The contours that the picks of a profile leave, and what there is to say of these.

    At each element contours are parted by how they run there. They are counted in one order, that of the first element
    in which they part: the nearer end along it first, of equally near ones the smaller turn to the left there.
    """
    left, events = _in_order(paths, profile), list[Refusal | Note]()
    for each in sorted(profile.picks, key=lambda each: each.element) if left else ():
        groups = _groups(left, each, profile)
        if each.most and len(groups) > each.most:
            continue
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
    left, found = _in_order(paths, profile), list[Pick]()
    for element in range(1, len(profile.figure.path) + 1):
        groups = _groups(left, Pick(element, 1, ""), profile)
        number = next(number for number, group in enumerate(groups, 1) if item in group)
        if len(groups) > 1:
            found.append(Pick(element, number, ""))
            left = groups[number - 1]
    return found


def _groups(paths: Sequence[Alternative], at: Pick, profile: Profile) -> list[list[Alternative]]:
    """Contours that run alike at an element, as far as it is determined when its block is chosen; in the order of the
    contours."""
    groups: list[tuple[list[Point], list[Alternative]]] = []
    for path in paths:
        run = _run(path, at, profile)
        same = next((group for group in groups if all(map(_is_same, group[0], run))), None)
        if same is None:
            groups.append((run, [path]))
        else:
            same[1].append(path)
    return [each for _, each in groups]


def _is_same(one: Point, other: Point) -> bool:
    return dist(one, other) <= LENGTH


def _run(path: Alternative, at: Pick, profile: Profile) -> list[Point]:
    """The points that tell how a contour runs at an element."""
    points, own = path.solution.points, profile.figure.path[at.element - 1]
    tail, head = points[own.tail], points[own.head]
    begin, _ = _directions(path, own)
    # An end that a later block determines is not there yet when this block is chosen.
    ends = [] if not at.most and own.name in resolved_later(profile) else [head]
    way = (tail[0] + cos(begin), tail[1] + sin(begin))
    return [tail, way, *([points[own.center]] if isinstance(own, Arc) else []), *ends]


SAME = 1e-6
"""mm and radians. Lengths and turns that differ by less count as equal: far more than rounding, and far less than what
tells two contours apart."""


def _in_order(paths: Sequence[Alternative], profile: Profile) -> list[Alternative]:
    """Contours in the order in which they are counted, which only what they are has a part in: not how the drawing is
    turned, where it lies, or how its equations were solved."""
    ranks: list[list[int]] = [[] for _ in paths]
    ahead = [_ahead(paths, profile)] * len(paths)
    for own in profile.figure.path:
        runs = [_directions(path, own) for path in paths]
        turns = [(begin - before) % tau for (begin, _), before in zip(runs, ahead, strict=True)]
        turns = [0.0 if tau - turn < SAME else turn for turn in turns]
        measured = ([_length(path, own) for path in paths], turns, [_radius(path, own) for path in paths])
        for values in measured:
            for rank, each in zip(ranks, _ranked(values), strict=True):
                rank.append(each)
        ahead = [end for _, end in runs]
    order = sorted(range(len(paths)), key=ranks.__getitem__)
    return [paths[index] for index in order]


def _ranked(values: Sequence[float]) -> list[int]:
    """The place of each value among those that differ."""
    order = sorted(range(len(values)), key=values.__getitem__)
    ranks, rank = [0] * len(values), 0
    for before, index in pairwise(order):
        rank += values[index] - values[before] > SAME
        ranks[index] = rank
    return ranks


def _ahead(paths: Sequence[Alternative], profile: Profile) -> float:
    """The direction from which the turn at the first element is measured, radians: from the start to the first place
    that the drawing states or all contours have, or else the first direction in which all end an element; where they
    have neither in common, from the start to the first place that is not there in the middle of all contours."""
    figure = profile.figure
    centers = [each.center for each in figure.path if isinstance(each, Arc)]
    names = (*(each.head for each in figure.path), *centers, *figure.points)
    begin = paths[0].solution.points[figure.start] if paths else (0.0, 0.0)
    middles = list[Point]()
    for name in names if paths else ():
        places = [each.solution.points[name] for each in paths]
        middles.append((fmean(x for x, _ in places), fmean(y for _, y in places)))
        if all(_is_same(place, places[0]) for place in places) and dist(begin, places[0]) > SAME:
            return _direction(begin, places[0])
    for own in figure.path:
        ends = [_directions(path, own)[1] for path in paths]
        if ends and all(abs(remainder(end - ends[0], tau)) <= SAME for end in ends):
            return ends[0]
    return next((_direction(begin, middle) for middle in middles if dist(begin, middle) > SAME), 0.0)


def _direction(begin: Point, end: Point) -> float:
    """From one point to another, radians."""
    return atan2(end[1] - begin[1], end[0] - begin[0])


def _length(path: Alternative, own: Line | Arc) -> float:
    points = path.solution.points
    tail, head = points[own.tail], points[own.head]
    if isinstance(own, Line):
        return dist(tail, head)
    begin, end = _directions(path, own)
    return dist(tail, points[own.center]) * ((own.turn.sign * (end - begin)) % tau)


def _radius(path: Alternative, own: Line | Arc) -> float:
    return 0.0 if isinstance(own, Line) else dist(path.solution.points[own.tail], path.solution.points[own.center])


def _directions(path: Alternative, own: Line | Arc) -> tuple[float, float]:
    """The directions in which an element begins and ends, radians."""
    points = path.solution.points
    tail, head = points[own.tail], points[own.head]
    if isinstance(own, Line):
        angle = _direction(tail, head)
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
