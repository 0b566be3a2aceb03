"""On which side of what points, centres and arcs lie, and the names of the sides."""

from collections.abc import Set
from itertools import pairwise
from typing import Any

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Line,
    Side,
    System,
    Values,
)
from contoursolve.numeric import ball

BOTH = "touches"
"""The side of a double solution."""

ARCS = ("short arc", "long arc")
"""The two arcs of one radius and sense between two points: less and more than half a circle."""


def sides_of(system: System, at: Values, chosen: Set[str]) -> dict[str, str]:
    """On which side everything lies for which there is another: points on lines and circles, centres, contacts.

    `chosen` are the points whose side the control chooses.
    """
    values = side_values(system, at, chosen).items()
    sides = {name: {1: left, -1: right}.get(ball.sign(value) or 0, BOTH) for name, (value, left, right) in values}
    for fact in system.facts:
        for side in fact.sides():
            sides[side.removesuffix(".side")] = fact.side_names[0 if at.signs[side] == 1 else 1]
    return sides


def side_values(system: System, at: Values, chosen: Set[str]) -> dict[str, tuple[Any, str, str]]:
    """The numbers (of any kind) that tell on which side points and centres lie, each with the names of the sides on
    which it is positive and negative."""

    def step(tail: str, head: str) -> tuple[Any, Any]:
        first, second = (at.coordinate(head, axis) - at.coordinate(tail, axis) for axis in (FIRST, SECOND))
        return first, second

    sides: dict[str, tuple[Any, str, str]] = {}
    circles = [fact.circle for fact in system.facts if fact.circle]
    axes = {fact.placed[:2] for fact in system.facts if fact.placed and fact.placed.is_stepped}
    stated = {point for point, _ in axes}
    # A point whose coordinates are both stated is at one place, whatever else passes through it.
    unknown = {point for point in system.figure.points if not {(point, FIRST), (point, SECOND)} <= axes}
    ends = {element.head for element in system.figure.path}
    # Where two elements of the path touch, there is one place.
    unknown -= ends & {fact.contact for fact in system.facts}
    beside = (line for line in system.figure.lines if line.heading is not None)
    for line in (*(element for element in system.figure.path if isinstance(element, Line)), *beside):
        for circle in circles:
            if circle.point in (line.tail, line.head) and circle.point in unknown:
                # The sense of travel is that of the angle, or leads from end to end where no angle is stated.
                tips = (line.tail, line.toward or line.head)
                way = at.direction(line.heading) if line.heading is not None else step(*tips)
                spoke = step(circle.center, circle.point)
                names = Side.FARTHER, Side.NEARER
                if line.counts_length:
                    other = line.head if circle.point == line.tail else line.tail
                    way, lean = step(other, circle.point), step(other, circle.center)
                    ahead = way[FIRST] * lean[FIRST] + way[SECOND] * lean[SECOND]
                    way, names = (way[FIRST] * ahead, way[SECOND] * ahead), (Side.LONGER, Side.SHORTER)
                along = way[FIRST] * spoke[FIRST] + way[SECOND] * spoke[SECOND]
                sides[circle.point] = along, *(name.value for name in names)
    arcs = [element for element in system.figure.path if isinstance(element, Arc)]
    for first, second in pairwise(arcs):
        if first.head == second.tail in unknown:
            centers, spoke = step(first.center, second.center), step(first.center, first.head)
            left = centers[FIRST] * spoke[SECOND] - centers[SECOND] * spoke[FIRST]
            names = Side.LEFT, Side.RIGHT
            if second.counts_clockwise:
                # From outside the second circle, the left one is met first.
                reach = step(first.tail, second.center)
                left = left * (reach[FIRST] ** 2 + reach[SECOND] ** 2 - at.radius(second.radius) ** 2)
                names = Side.FIRST, Side.SECOND
            sides[first.head] = left, *(name.value for name in names)
    for arc in arcs:
        on_it = [circle.point for circle in circles if circle.center == arc.center]
        others = [point for point in on_it if point != arc.tail and point not in sides]
        # The end that an arc is stated by, and not an intersection in which it ends instead.
        others.sort(key=lambda point: point in ends and point not in stated)
        is_chosen = arc.center in chosen
        if is_chosen and others and arc.tail not in on_it:
            continue
        # Where no fact but a contact, or another side, puts its ends on it, its path does.
        others = others or [arc.head]
        chord, spoke = step(arc.tail, others[0] if is_chosen else arc.head), step(arc.tail, arc.center)
        twice = chord[FIRST] * spoke[SECOND] - chord[SECOND] * spoke[FIRST]
        if is_chosen:
            sides[arc.center] = twice, Side.LEFT.value, Side.RIGHT.value
        else:
            # Turning left, the shorter way about a centre is the one that has it to the left of the chord.
            sides[arc.name] = arc.turn.sign * twice, *ARCS
    return sides
