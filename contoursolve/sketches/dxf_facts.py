"""Facts about a chain of a DXF drawing: its dimensions, where their points are points of the chain, and coordinates. Of
many facts those are chosen that do not follow from others."""

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from decimal import Decimal
from math import atan2, degrees, dist, hypot, nan
from typing import Any

import numpy as np
from msgspec import Struct

from contoursolve.sketches.dxf_chain import DxfChain
from contoursolve.sketches.sketch import SketchElement, Value
from contoursolve.solving import ArcSegment, LineSegment, Point

_STRAIGHT, _SLOPED, _ANGULAR, _DIAMETER, _RADIUS, _BY_POINTS, _ORDINATE = range(7)
"""Types of dimensions, as DXF numbers them (group 70)."""
_IS_OF_X = 64
"""Flag of an ordinate dimension that gives X."""
_DIGITS, _ROUND = 6, 4
"""Digits behind the point: of a number that is read from a coordinate, and of one that a drawing may give."""
_SMOOTH = 1e-5
"""1 (sine of an angle). Neighbours whose directions differ by less go on smoothly, and lines so near to an axis run
along it."""
_RANKS = 0.05, 1e-4
"""1 (share of a gradient). What is left of it besides those before it: less follows from them, or nearly so, and is
taken only where nothing else is left to take."""
_STEP = 1e-7
"""1 (share of the chain's size). How far a place is moved to see what depends on it."""

Places = np.ndarray[Any, np.dtype[np.float64]]
Measure = Callable[[Places], float]


def number(value: float) -> Decimal:
    """The number that a coordinate stands for: one with few digits within a millionth, else 6 digits.

    >>> number(39.9999999999), number(1 / 3)
    (Decimal('40'), Decimal('0.333333'))
    """
    digits = next((each for each in range(_ROUND) if abs(round(value, each) - value) <= 10.0**-_DIGITS), _DIGITS)
    found = Decimal(repr(round(value, digits))).normalize()
    return Decimal(f"{found:f}") if found else Decimal(0)


class DrawnFact(Struct, frozen=True):
    """A field of an element, by the element's place, with its value (of `tangent` and `facts` no number); what it says
    of the places, as a function of them; the dimension that gives it, empty where none does. `further` stands beside
    it."""

    element: int
    field: str
    value: Decimal
    measure: Measure
    given: str = ""
    further: tuple[tuple[str, Decimal], ...] = ()
    text: str = ""


class Chained:
    """A chain with its places: the start, the end of each element, then the centres of its arcs. Of a closed chain the
    last end is the start. `near` is how near the points of dimensions lie."""

    def __init__(self, chain: DxfChain, axes: tuple[str, str], near: float, *, is_turned: bool) -> None:
        self.elements, self.axes, self.near = chain.elements, axes, near
        self.is_turned, self.is_closed = is_turned, chain.is_closed
        count = len(self.elements)
        self.nodes = [*range(count), 0 if chain.is_closed else count]
        points = [self.elements[0].start, *(each.end for each in self.elements)][: count + (not chain.is_closed)]
        self.arcs = {place: each for place, each in enumerate(self.elements) if isinstance(each, ArcSegment)}
        self.centers = {place: len(points) + row for row, place in enumerate(self.arcs)}
        self.at: Places = np.array([*points, *(each.center for each in self.arcs.values())])
        # Places that a line along the other axis joins have the same coordinate.
        self.same = [self._classes(axis) for axis in (0, 1)]

    def _classes(self, axis: int) -> list[set[int]]:
        groups = [{node} for node in range(len(self.nodes))]
        for place, each in enumerate(self.elements):
            if isinstance(each, LineSegment) and abs(each.start[axis] - each.end[axis]) <= self.near / 10:
                both = groups[place] | groups[place + 1]
                for node in both:
                    groups[node] = both
        return groups

    def place(self, node: int) -> dict[str, Decimal]:
        """The coordinates of an end, as words say them."""
        at = self.at[self.nodes[node]]
        return {name: number(float(at[axis]) * self.factor(axis)) for axis, name in enumerate(self.axes)}

    def factor(self, axis: int) -> int:
        """The times that a word counts a length along an axis: twice where it is a diameter."""
        return 2 if self.is_turned and axis == 1 else 1

    def nodes_at(self, at: Point) -> set[int]:
        """The ends that lie at a place of the drawing."""
        return {node for node, row in enumerate(self.nodes) if dist(self.at[row], at) <= self.near}

    def difference(self, axis: int, second: int, first: int | None = None) -> Measure:
        """A coordinate of an end, or how far it lies beyond that of another."""
        rows = self.nodes[second], None if first is None else self.nodes[first]
        return lambda at: float(at[rows[0], axis] - (0 if rows[1] is None else at[rows[1], axis]))

    def center(self, place: int, axis: int) -> Measure:
        """A coordinate of the centre of an arc."""
        row = self.centers[place]
        return lambda at: float(at[row, axis])

    def run(self, at: Places, place: int, *, is_end: bool) -> Any:
        """The direction of travel where an element begins or ends."""
        begin, end = at[self.nodes[place]], at[self.nodes[place + 1]]
        if place not in self.arcs:
            run = end - begin
        else:
            spoke = (end if is_end else begin) - at[self.centers[place]]
            run = np.array([-spoke[1], spoke[0]]) * self.arcs[place].turn.sign
        return run / hypot(*run)

    def bend(self, place: int) -> Measure:
        """The sine by which the direction changes from the element before; of one that turns back it is 1."""

        def measure(at: Places) -> float:
            before, behind = self.run(at, place - 1, is_end=True), self.run(at, place, is_end=False)
            return float(before[0] * behind[1] - before[1] * behind[0]) if before @ behind > 0 else 1.0

        return measure

    def angle(self, place: int, before: int | None = None) -> Measure:
        """The direction of a line, or by how much it turns from that of a line before it; radians."""

        def measure(at: Places) -> float:
            along, across = self.run(at, place, is_end=False)
            first, second = (1.0, 0.0) if before is None else self.run(at, before, is_end=False)
            return float(atan2(first * across - second * along, first * along + second * across))

        return measure

    def length(self, place: int) -> Measure:
        """The length of a line, or the chord of an arc."""
        return lambda at: float(dist(at[self.nodes[place]], at[self.nodes[place + 1]]))

    def radius(self, place: int, *, is_end: bool = False) -> Measure:
        """The radius of an arc, at its begin or its end."""
        row, center = self.nodes[place + is_end], self.centers[place]
        return lambda at: float(dist(at[row], at[center]))

    def roundness(self, place: int) -> Measure:
        """By how much both radii of an arc differ."""
        one, other = self.radius(place), self.radius(place, is_end=True)
        return lambda at: one(at) - other(at)


def relations(chained: Chained) -> Iterator[DrawnFact]:
    """Facts that every reader of a drawing sees without a number: lines along the axes, and smooth joints."""
    for place, element in enumerate(chained.elements):
        if isinstance(element, LineSegment):
            for axis in (0, 1):
                if abs(element.end[axis] - element.start[axis]) <= chained.near / 10:
                    value = Decimal(round(element.angle) % 360)
                    yield DrawnFact(place, "AN", value, chained.difference(axis, place + 1, place))
        is_round = place in chained.arcs or place - 1 in chained.arcs
        if place and is_round and abs(chained.bend(place)(chained.at)) <= _SMOOTH:
            yield DrawnFact(place, "tangent", Decimal(1), chained.bend(place))


def coordinates(chained: Chained) -> Iterator[DrawnFact]:
    """The coordinates of ends, then radii and centres of arcs, as the drawing has them."""
    for place in range(len(chained.elements)):
        for axis, name in enumerate(chained.axes if chained.nodes[place + 1] else ()):
            measure = chained.difference(axis, place + 1)
            yield DrawnFact(place, name, number(measure(chained.at) * chained.factor(axis)), measure)
    for place, arc in chained.arcs.items():
        yield DrawnFact(place, "R", number(arc.radius), chained.radius(place))
        for axis, name in enumerate(chained.axes):
            yield DrawnFact(
                place, f"CC{name}", number(arc.center[axis] * chained.factor(axis)), chained.center(place, axis)
            )


def dimensions(
    chained: Chained, entities: Sequence[Any], place: Callable[[Any], Point]
) -> tuple[list[DrawnFact], list[str]]:
    """The facts that dimensions give, each in all ways in which a field can say it, the plainest first; and what is
    told of others. `place` gives the place of the sketch for one of the drawing, on both sides of an axis."""
    found, notes = list[DrawnFact](), list[str]()
    for entity in entities:
        name = f"{entity.dxftype()} {entity.dxf.handle or 'of a block'}"
        ways = list(_Dimension(chained, entity, name, place).ways())
        trouble = (
            _doubt(entity, ways[0].given) if ways else "its points are no points of the chain, or no field says it"
        )
        notes += [f"{name} is left out: {trouble}"] if trouble else []
        found += [] if trouble else ways
    return found, notes


_NUMBER = re.compile(r"\d++(?:[.,]\d++)?")


def _doubt(entity: Any, given: str) -> str:
    """The reason not to take a dimension: it shows another number than it measures; empty where it does not."""
    text, measured = entity.dxf.text, float(given.rpartition(" ")[2])
    factor = abs(entity.override().get("dimlfac", 1.0) or 1.0)
    if factor != 1 and entity.dimtype not in (_ANGULAR, _BY_POINTS):
        return f"it is shown {factor:g} times as large as it is drawn"
    shown = [each.replace(",", ".") for each in _NUMBER.findall(text)]
    # A radius may be shown as the diameter that it is of the part.
    off = [
        abs(float(each) - measured * times) <= 0.5 * 10.0 ** -len(each.partition(".")[2])
        for each in shown
        for times in (1, 2)
    ]
    if shown and "<>" not in text and not any(off):
        return f"it shows {text!r}, and measures {measured:g}"
    return "" if round(measured, _ROUND) == measured else f"it measures {measured:.{_DIGITS}f}, which no drawing gives"


class _Dimension(Struct, frozen=True):
    """A dimension of the drawing, and the ways to say it."""

    chained: Chained
    entity: Any
    name: str
    place: Callable[[Any], Point]

    def at(self, name: str) -> Point:
        """A point of it on the drawing; below the axis of a turned part too."""
        return self.place(self.entity.dxf.get(name, (nan, nan)))

    def over(self, at: Point) -> Point:
        """That point on the side of the profile."""
        return (at[0], abs(at[1])) if self.chained.is_turned else at

    def fact(self, place: int, field: str, value: Decimal, measure: Measure, real: float, **more: Any) -> DrawnFact:
        """A fact that this dimension gives: `real` is what it measures."""
        return DrawnFact(place, field, value, measure, f"{self.name}: {number(real)}", **more)

    def ways(self) -> Iterator[DrawnFact]:
        """All ways."""
        kind, dxf = self.entity.dimtype, self.entity.dxf
        if self.entity.dxftype() != "DIMENSION":
            return
        if kind in (_STRAIGHT, _SLOPED):
            first, second = self.at("defpoint2"), self.at("defpoint3")
            run = second[0] - first[0], second[1] - first[1]
            angle = dxf.angle if kind == _STRAIGHT else degrees(atan2(run[1], run[0]))
            for axis in (0, 1):
                if abs((angle - 90 * axis + 90) % 180 - 90) <= degrees(_SMOOTH):
                    yield from self._along(axis, first, second)
            yield from self._sloped(first, second, angle)
        elif kind in (_RADIUS, _DIAMETER):
            at, end = self.at("defpoint"), self.at("defpoint4")
            center = at if kind == _RADIUS else ((at[0] + end[0]) / 2, (at[1] + end[1]) / 2)
            radius = dist(center, end)
            for place, arc in self.chained.arcs.items():
                if dist(arc.center, self.over(center)) <= self.chained.near >= abs(arc.radius - radius):
                    real = arc.radius * (1 if kind == _RADIUS else 2)
                    yield self.fact(
                        place, "R", number(real) / (2 if kind == _DIAMETER else 1), self.chained.radius(place), real
                    )
        elif kind in (_ANGULAR, _BY_POINTS):
            corner = self.at("defpoint4")
            ends = (self.at("defpoint2"), self.at("defpoint3")), (corner, self.at("defpoint"))
            if kind == _BY_POINTS:
                ends = (corner, self.at("defpoint2")), (corner, self.at("defpoint3"))
            yield from self._angles(*ends)
        elif kind == _ORDINATE and hypot(*self.at("defpoint")) <= self.chained.near:
            axis = 0 if dxf.dimtype & _IS_OF_X else 1
            at = self.over(self.at("defpoint2"))
            for node in sorted(self.chained.nodes_at(at)):
                yield from self._absolute(axis, node, abs(at[axis]))

    def _absolute(self, axis: int, node: int, real: float) -> Iterator[DrawnFact]:
        """A coordinate of an end."""
        chained, factor = self.chained, self.chained.factor(axis)
        value = number(float(chained.at[chained.nodes[node], axis]) * factor)
        if node:
            yield self.fact(node - 1, chained.axes[axis], value, chained.difference(axis, node), real)

    def _along(self, axis: int, first: Point, second: Point) -> Iterator[DrawnFact]:
        """A distance along an axis: from the start, from the end before, from an earlier end; across the axis of a
        turned part it is the diameter, from the axis the radius."""
        chained, real = self.chained, abs(second[axis] - first[axis])
        if chained.is_turned and axis == 1:
            low, high = sorted((first, second), key=lambda at: abs(at[1]))
            if abs(low[1]) <= self.chained.near or abs(low[1] + high[1]) <= self.chained.near:
                for node in self._same(axis, chained.nodes_at(self.over(high))):
                    yield from self._absolute(axis, node, real)
                return
            if low[1] * high[1] < 0:
                return
        ends = [chained.nodes_at(self.over(at)) for at in (first, second)]
        if not all(ends):
            return
        one, other = (self._same(axis, each) for each in ends)
        for these, those in ((one, other), (other, one)):
            if 0 in these:
                yield from (fact for node in those for fact in self._absolute(axis, node, real))
        pairs = sorted({tuple(sorted((a, b))) for a in one for b in other}, key=lambda pair: (pair[1] - pair[0], pair))
        for early, late in pairs:
            measure = chained.difference(axis, late, early)
            value = number(measure(chained.at) * chained.factor(axis))
            further = () if late == early + 1 else ((f"R{chained.axes[axis]}", Decimal(early)),)
            if early or late == 1:
                yield self.fact(late - 1, f"I{chained.axes[axis]}", value, measure, real, further=further)

    def _same(self, axis: int, nodes: Iterable[int]) -> list[int]:
        """All ends with the same coordinate as these, as lines along the other axis show."""
        return sorted({each for node in nodes for each in self.chained.same[axis][node]})

    def _sloped(self, first: Point, second: Point, angle: float) -> Iterator[DrawnFact]:
        """A distance between the ends of one element."""
        chained = self.chained
        one, other = (chained.nodes_at(self.over(at)) for at in (first, second))
        run = degrees(atan2(second[1] - first[1], second[0] - first[0]))
        if abs((run - angle + 90) % 180 - 90) > degrees(_SMOOTH):
            return
        for place in range(len(chained.elements)):
            if (place in one and place + 1 in other) or (place in other and place + 1 in one):
                real = chained.length(place)(chained.at)
                yield self.fact(place, "LEN", number(real), chained.length(place), real)

    def _angles(self, *sides: tuple[Point, Point]) -> Iterator[DrawnFact]:
        """The angle between two lines of the chain, or between one and an axis."""
        chained = self.chained
        runs = [degrees(atan2(end[1] - begin[1], end[0] - begin[0])) for begin, end in sides]
        lines = [self._lines_on(*map(self.over, side)) for side in sides]
        between = abs((runs[1] - runs[0] + 180) % 360 - 180)
        for these, those, run in ((lines[0], lines[1], runs[1]), (lines[1], lines[0], runs[0])):
            is_axis = abs((run + 45) % 90 - 45) <= degrees(_SMOOTH)
            for place in these if is_axis else ():
                measure = chained.angle(place)
                yield self.fact(place, "AN", number(degrees(measure(chained.at)) % 360), measure, between)
            for place, before in ((a, b) for a in these for b in those if a > b):
                measure = chained.angle(place, before)
                turn = number(degrees(measure(chained.at)))
                text = f"angle from line {before + 1} to line {place + 1} = {turn}"
                yield self.fact(place, "facts", turn, measure, between, text=text)

    def _lines_on(self, begin: Point, end: Point) -> list[int]:
        """The lines of the chain that lie on the line through two places."""
        length = dist(begin, end)

        def off(at: Point) -> float:
            return abs((end[0] - begin[0]) * (at[1] - begin[1]) - (end[1] - begin[1]) * (at[0] - begin[0])) / length

        return [
            place
            for place, each in enumerate(self.chained.elements)
            if length > self.chained.near
            and isinstance(each, LineSegment)
            and max(off(each.start), off(each.end)) <= self.chained.near
        ]


def independent(chained: Chained, *groups: Sequence[DrawnFact]) -> tuple[list[DrawnFact], bool]:
    """Of facts in their order those that say something new about the places, for which a field is free; and whether
    they determine the chain."""
    basis, chosen, taken = list[Any](), list[DrawnFact](), set[tuple[int, str]]()
    step = _STEP * float(np.ptp(chained.at))
    moves = np.eye(chained.at.size).reshape(-1, *chained.at.shape) * step

    def is_new(measure: Measure, least: float) -> bool:
        gradient = np.array([measure(chained.at + move) - measure(chained.at - move) for move in moves]) / (2 * step)
        rest = gradient / (float(np.linalg.norm(gradient)) or 1.0)
        for each in (*basis, *basis):
            rest = rest - (rest @ each) * each
        left = float(np.linalg.norm(rest))
        if left > least:
            basis.append(rest / left)
        return left > least

    for measure in (chained.difference(0, 0), chained.difference(1, 0), *map(chained.roundness, chained.arcs)):
        is_new(measure, _RANKS[-1])
    for least, fact in ((each, fact) for each in _RANKS for group in groups for fact in group):
        name = fact.field.removeprefix("I")
        rivals = {name, f"I{name}"} if name in chained.axes else {fact.field} - {"facts"}
        is_free = not any((fact.element, each) in taken for each in rivals)
        if len(basis) < chained.at.size and is_free and is_new(fact.measure, least):
            chosen.append(fact)
            taken.add((fact.element, fact.field))
    return chosen, len(basis) == chained.at.size


def elements_of(chained: Chained, facts: Sequence[DrawnFact], *, has_guess: bool) -> tuple[SketchElement, ...]:
    """The elements of the sketch with their fields; `has_guess` says where each ends about, to choose a solution."""
    found = []
    for place, element in enumerate(chained.elements):
        own = [fact for fact in facts if fact.element == place]
        words: dict[str, Value] = {}
        for fact in own:
            words |= {} if fact.field in ("tangent", "facts") else {fact.field: fact.value, **dict(fact.further)}
        found.append(
            SketchElement(
                "arc" if isinstance(element, ArcSegment) else "line",
                words,
                element.turn.value if isinstance(element, ArcSegment) else None,
                any(fact.field == "tangent" for fact in own),
                guess=chained.place(place + 1) if has_guess else {},
                facts=tuple(fact.text for fact in own if fact.text),
            )
        )
    return tuple(found)
