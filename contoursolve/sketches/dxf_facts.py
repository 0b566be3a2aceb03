"""Facts about a chain of a DXF drawing: its dimensions, where their points are points of the chain, and coordinates. Of
many facts those are chosen that do not follow from others."""

import re
from cmath import phase, rect
from collections.abc import Callable, Collection, Iterator, Sequence
from decimal import Decimal
from math import degrees, dist, hypot, nan, radians
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.sketches.dxf_chain import DxfChain
from contoursolve.sketches.sketch import SketchCorner, SketchElement, Value
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, direction, foot

_STRAIGHT, _SLOPED, _ANGULAR, _DIAMETER, _RADIUS, _BY_POINTS, _ORDINATE = range(7)
"""Types of dimensions, as DXF numbers them (group 70)."""
_IS_OF_X = 64
"""Flag of an ordinate dimension that gives X."""
_DIGITS, _ROUND = 6, 4
"""Digits behind the point: of a number that is read from a coordinate, and of one that a drawing may give."""
_SMOOTH = degrees(1e-5)
"""Degrees. Neighbours whose directions differ by less go on smoothly, and lines so near to an axis run along it."""
_RANKS = 0.05, 1e-4
"""1 (share of a gradient). What is left of it besides those before it: less follows from them, or nearly so, and is
taken only where nothing else is left to take."""
_STEP = 1e-7
"""1 (share of the chain's size). How far a place is moved to see what depends on it."""

Places = np.ndarray[Any, np.dtype[np.float64]]


def number(value: float) -> Decimal:
    """The number that a coordinate stands for: one with few digits within a millionth, else 6 digits.

    >>> number(39.9999999999), number(1 / 3)
    (Decimal('40'), Decimal('0.333333'))
    """
    digits = next((each for each in range(_ROUND) if abs(round(value, each) - value) <= 10.0**-_DIGITS), _DIGITS)
    found = Decimal(repr(round(value, digits))).normalize()
    return Decimal(f"{found:f}") if found else Decimal(0)


class DrawnFact(Struct, frozen=True):
    """A field of an element, by the element's place, with its number; the end, or the element, from which it counts;
    and the dimension that gives it, empty where none does."""

    element: int
    field: str
    value: Decimal = Decimal(0)
    origin: int | None = None
    given: str = ""

    def words(self) -> dict[str, Value]:
        """The fields that state it."""
        if self.field in ("tangent", "facts", "corner"):
            return {}
        counts = {f"R{self.field[1:]}": Decimal(self.origin)} if self.origin not in (None, self.element) else {}
        return {self.field: self.value, **counts}


class CutCorner(Struct, frozen=True):
    """A chamfer or a rounding after an element, by the element's place: setback or radius, its ends, its centre."""

    after: int
    corner: SketchCorner
    ends: tuple[Point, Point]
    center: Point | None = None


def cornered(
    chain: DxfChain, near: float, left: Collection[tuple[Point, Point]] = ()
) -> tuple[DxfChain, tuple[CutCorner, ...]]:
    """The chain without chamfers and roundings: lines and arcs that cut as much from both lines beside them, which go
    on to the corner; and these. Those with ends in `left` stay in the chain."""
    kept, cut, found = [*chain.elements], set[int](), list[CutCorner]()
    for place, own in enumerate(chain.elements[1:-1], 1):
        before, _, after = chain.elements[place - 1 : place + 2]
        is_open = place - 1 not in cut and (own.start, own.end) not in left
        at = _corner_of(before, own, after, near) if is_open else None
        if at is None:
            continue
        corner, center = SketchCorner("chamfer", number(dist(at, own.start))), None
        if isinstance(own, ArcSegment):
            corner, center = SketchCorner("rounding", number(own.radius)), own.center
        found.append(CutCorner(place - 1 - len(cut), corner, (own.start, own.end), center))
        cut.add(place)
        kept[place - 1], kept[place + 1] = replace(kept[place - 1], end=at), replace(after, start=at)
    elements = tuple(each for place, each in enumerate(kept) if place not in cut)
    return replace(chain, elements=elements), tuple(found)


def _corner_of(before: Segment, own: Segment, after: Segment, near: float) -> Point | None:
    """The corner that a chamfer or a rounding cuts; None of what is neither."""
    if not (isinstance(before, LineSegment) and isinstance(after, LineSegment)):
        return None
    way, other = direction(before.start, before.end), direction(after.end, after.start)
    turn = way[0] * other[1] - way[1] * other[0]
    if abs(turn) < _SHARP:
        return None
    gap = own.end[0] - own.start[0], own.end[1] - own.start[1]
    setbacks = (gap[0] * other[1] - gap[1] * other[0]) / turn, (gap[0] * way[1] - gap[1] * way[0]) / turn
    is_square = abs(way[0] * other[0] + way[1] * other[1]) < _SHARP
    if isinstance(own, ArcSegment):
        # It touches both lines where it meets them, and its corner is no farther than a line of the drawing is long.
        off = (
            complex(*own.center) - complex(*at) - 1j * own.turn.sign * own.radius * complex(*along)
            for at, along in ((own.start, way), (own.end, (-other[0], -other[1])))
        )
        is_cut = max(map(abs, off)) <= near and max(setbacks) <= max(before.length, after.length)
    else:
        is_cut = own.length < (max if is_square else min)(before.length, after.length)
    if not is_cut or abs(setbacks[0] - setbacks[1]) > near or min(setbacks) <= near:
        return None
    return own.start[0] + way[0] * setbacks[0], own.start[1] + way[1] * setbacks[0]


_SHARP = 1e-3
"""1 (a sine). Lines that turn by less have no corner; lines that turn from a right angle by less are square."""


class Chained:
    """A chain with its places: the start, the end of each element, then the centres of its arcs. Of a closed chain the
    last end is the start. `near` is how near the points of dimensions lie."""

    def __init__(
        self,
        chain: DxfChain,
        axes: tuple[str, str],
        near: float,
        *,
        is_turned: bool,
        corners: Sequence[CutCorner] = (),
    ) -> None:
        self.corners = {each.after: each for each in corners}
        self.elements, self.axes, self.near = chain.elements, axes, near
        self.is_turned, self.is_closed = is_turned, chain.is_closed
        count = len(self.elements)
        self.nodes = [*range(count), 0 if chain.is_closed else count]
        points = [self.elements[0].start, *(each.end for each in self.elements)][: count + (not chain.is_closed)]
        self.arcs = {place: each for place, each in enumerate(self.elements) if isinstance(each, ArcSegment)}
        self.centers = {place: len(points) + row for row, place in enumerate(self.arcs)}
        self.at: Places = np.array([*points, *(each.center for each in self.arcs.values())])

    def place(self, node: int) -> dict[str, Decimal]:
        """The coordinates of an end, as words say them."""
        return {name: self.fact(node - 1, name).value for name in self.axes}

    def fact(self, place: int, field: str, origin: int | None = None) -> DrawnFact:
        """A field of an element with the number that it has in the drawing."""
        bare = DrawnFact(place, field, origin=origin)
        return replace(bare, value=number(self.arcs[place].radius if field == "R" else self.measure(self.at, bare)))

    def measure(self, at: Places, fact: DrawnFact) -> float:
        """The number of a field at any places of the chain: mm, of X of a turned part a diameter, or degrees."""
        place, field, origin = fact.element, fact.field, fact.origin or 0
        begin, end = at[self.nodes[place]], at[self.nodes[place + 1]]
        kind, axis = (field[:-1], self.axes.index(field[-1])) if field[-1] in self.axes else (field, 0)
        factor = 2 if self.is_turned and axis == 1 else 1
        match kind:
            case "":
                return float(end[axis]) * factor
            case "I":
                return float(end[axis] - at[self.nodes[origin], axis]) * factor
            case "CC":
                return float(at[self.centers[place], axis]) * factor
            case "R":
                return dist(begin, at[self.centers[place]])
            case "off":  # of an arc: by how much both radii differ
                return dist(begin, at[self.centers[place]]) - dist(end, at[self.centers[place]])
            case "LEN":
                return dist(begin, end)
            case "AN":
                return degrees(phase(self._run(at, place))) % 360
        # The angle by which it turns from another element: `tangent`, or of a statement in `facts`.
        return degrees(phase(self._run(at, place) * self._run(at, origin, is_end=True).conjugate()))

    def _run(self, at: Places, place: int, *, is_end: bool = False) -> complex:
        """The direction of travel where an element begins or ends."""
        begin, end = (complex(*at[self.nodes[place + on]]) for on in (0, 1))
        if place not in self.arcs:
            return end - begin
        return ((end if is_end else begin) - complex(*at[self.centers[place]])) * 1j * self.arcs[place].turn.sign

    def over(self, at: Point) -> Point:
        """A place of the drawing on the side of the profile: a turned part has two."""
        return (at[0], abs(at[1])) if self.is_turned else at

    def ends_at(self, at: Point) -> set[int]:
        """The ends that lie at a place of the drawing."""
        return {node for node, row in enumerate(self.nodes) if dist(self.at[row], self.over(at)) <= self.near}

    def level_with(self, axis: int, at: Point) -> list[int]:
        """These ends, and all that lines along the other axis show to have the same coordinate."""
        # Where a chamfer or a rounding ends, the corner has the same coordinate as the line that it cuts.
        cut = {
            place + 1
            for place, each in self.corners.items()
            for line, end in zip(self.elements[place : place + 2], each.ends, strict=True)
            if self.is_along(line, 1 - axis) and dist(end, self.over(at)) <= self.near
        }
        found, grown = set[int](), self.ends_at(at) | cut
        level = [place for place, each in enumerate(self.elements) if self.is_along(each, 1 - axis)]
        while found != grown:
            found = {*grown}
            grown |= {place + on for place in level for on in (0, 1) if {place, place + 1} & found}
        return sorted(found)

    def is_along(self, element: LineSegment | ArcSegment, axis: int) -> bool:
        """Whether an element is a line along an axis."""
        off = abs(element.start[1 - axis] - element.end[1 - axis])
        return isinstance(element, LineSegment) and off <= self.near / 10

    def lines_on(self, begin: Point, end: Point) -> list[int]:
        """The lines of the chain that lie on the line through two places."""
        way, found = direction(begin, end), list[int]()
        for place, each in enumerate(self.elements if dist(begin, end) > self.near else ()):
            off = max(dist(at, foot(at, begin, way)) for at in (each.start, each.end))
            found += [place] if place not in self.arcs and off <= self.near else []
        return found


def relations(chained: Chained) -> Iterator[DrawnFact]:
    """Facts that every reader of a drawing sees without a number: lines along the axes, and smooth joints."""
    for place, each in enumerate(chained.elements):
        if isinstance(each, LineSegment) and (chained.is_along(each, 0) or chained.is_along(each, 1)):
            yield DrawnFact(place, "AN", Decimal(round(each.angle) % 360))
        smooth = DrawnFact(place, "tangent", Decimal(1), place - 1)
        is_round = place in chained.arcs or place - 1 in chained.arcs
        if place and is_round and abs(chained.measure(chained.at, smooth)) <= _SMOOTH:
            yield smooth


def coordinates(chained: Chained) -> Iterator[DrawnFact]:
    """The coordinates of ends, then radii and centres of arcs, as the drawing has them."""
    places = [place for place, node in enumerate(chained.nodes[1:]) if node]
    yield from (chained.fact(place, name) for place in places for name in chained.axes)
    fields = ("R", *(f"CC{name}" for name in chained.axes))
    yield from (chained.fact(place, name) for place in chained.arcs for name in fields)


def dimensions(
    chained: Chained, entities: Sequence[Any], place: Callable[[Any], Point]
) -> tuple[list[DrawnFact], list[str]]:
    """The facts that dimensions give, each in all ways in which a field can say it, the plainest first; and what is
    told of others. `place` gives the place of the sketch for one of the drawing, on both sides of an axis."""
    found, notes = list[DrawnFact](), list[str]()
    for entity in entities:
        name = f"{entity.dxftype()} {entity.dxf.handle or 'of a block'}"
        is_plain = entity.dxftype() == "DIMENSION"
        measured, ways = _read(chained, entity, place) if is_plain else (nan, [])
        trouble = _doubt(entity, measured) if ways else "its points are no points of the chain, or no field says it"
        notes += [f"{name} is left out: {trouble}"] if trouble else []
        found += [] if trouble else [replace(each, given=f"{name}: {number(measured)}") for each in ways]
    return found, notes


_NUMBER = re.compile(r"\d++(?:[.,]\d++)?")


def _doubt(entity: Any, measured: float) -> str:
    """The reason not to take a dimension: it shows another number than it measures; empty where it does not."""
    text, told = entity.dxf.text, float(number(measured))
    factor = abs(entity.override().get("dimlfac", 1.0) or 1.0)
    if factor != 1 and entity.dimtype not in (_ANGULAR, _BY_POINTS):
        return f"it is shown {factor:g} times as large as it is drawn"
    shown = [each.replace(",", ".") for each in _NUMBER.findall(text)]
    # A radius may be shown as the diameter that it is of the part.
    off = (
        abs(float(each) - told * times) <= 0.5 * 10.0 ** -len(each.partition(".")[2])
        for each in shown
        for times in (1, 2)
    )
    if shown and "<>" not in text and not any(off):
        return f"it shows {text!r}, and measures {told:g}"
    return "" if round(told, _ROUND) == told else f"it measures {told:.{_DIGITS}f}, which no drawing gives"


def _read(chained: Chained, entity: Any, place: Callable[[Any], Point]) -> tuple[float, list[DrawnFact]]:
    """A dimension: what it measures, mm or degrees, and all ways to say it."""
    kind, near = entity.dimtype, chained.near
    corner, first, second, last = (
        place(entity.dxf.get(name, (nan, nan))) for name in ("defpoint", "defpoint2", "defpoint3", "defpoint4")
    )
    if kind in (_STRAIGHT, _SLOPED):
        run = complex(*second) - complex(*first)
        angle = entity.dxf.angle if kind == _STRAIGHT else degrees(phase(run))
        ways = [
            fact
            for axis in (0, 1)
            if _is_parallel(angle, 90 * axis, 180)
            for fact in _along(chained, axis, first, second)
        ]
        if _is_parallel(degrees(phase(run)), angle, 180):
            one, other = chained.ends_at(first), chained.ends_at(second)
            ways += [chained.fact(min(a, b), "LEN") for a in one for b in other if abs(a - b) == 1]
        return abs((run * rect(1, -radians(angle))).real), ways
    if kind in (_RADIUS, _DIAMETER):
        center = corner if kind == _RADIUS else ((corner[0] + last[0]) / 2, (corner[1] + last[1]) / 2)
        of_arcs = ((chained.fact(place, "R"), arc.center, arc.radius) for place, arc in chained.arcs.items())
        of_corners = (
            (DrawnFact(place, "corner"), each.center, dist(each.center, each.ends[0]))
            for place, each in chained.corners.items()
            if each.center is not None
        )
        same = [
            fact
            for fact, at, radius in (*of_arcs, *of_corners)
            if dist(at, chained.over(center)) <= near >= abs(radius - dist(center, last))
        ]
        return dist(corner, last), same
    if kind in (_ANGULAR, _BY_POINTS):
        sides = ((last, first), (last, second)) if kind == _BY_POINTS else ((first, second), (last, corner))
        return _between(chained, *sides)
    axis = 0 if entity.dxf.dimtype & _IS_OF_X else 1
    ends = chained.ends_at(first) if kind == _ORDINATE and hypot(*corner) <= near else set[int]()
    return abs(first[axis]), [chained.fact(node - 1, chained.axes[axis]) for node in sorted(ends) if node]


def _is_parallel(angle: float, other: float, period: float) -> bool:
    """Whether two directions are the same but for whole periods, degrees."""
    return abs((angle - other + period / 2) % period - period / 2) <= _SMOOTH


def _along(chained: Chained, axis: int, first: Point, second: Point) -> Iterator[DrawnFact]:
    """A distance along an axis: from the start, from the end before, from an earlier end; across the axis of a turned
    part it is the diameter, from the axis the radius."""
    name = chained.axes[axis]
    one, other = (chained.level_with(axis, at) for at in (first, second))
    if chained.is_turned and axis == 1:
        low, high = sorted((first, second), key=lambda at: abs(at[1]))
        if abs(low[1]) <= chained.near or abs(low[1] + high[1]) <= chained.near:
            yield from (chained.fact(node - 1, name) for node in chained.level_with(axis, high) if node)
            return
        if low[1] * high[1] < 0:
            return
    for these, those in ((one, other), (other, one)):
        yield from (chained.fact(node - 1, name) for node in those if 0 in these and node)
    pairs = {(min(a, b), max(a, b)) for a in one for b in other}
    for early, late in sorted(pairs, key=lambda pair: (pair[1] - pair[0], pair)):
        if early or late == 1:
            yield chained.fact(late - 1, f"I{name}", early)


def _between(chained: Chained, *sides: tuple[Point, Point]) -> tuple[float, list[DrawnFact]]:
    """The angle between two lines of the chain, or between one and an axis."""
    runs = [degrees(phase(complex(*end) - complex(*begin))) for begin, end in sides]
    (one, other), found = [chained.lines_on(*map(chained.over, side)) for side in sides], list[DrawnFact]()
    for these, those, run in ((one, other, runs[1]), (other, one, runs[0])):
        found += [chained.fact(place, "AN") for place in these if _is_parallel(run, 0, 90)]
        found += [chained.fact(place, "facts", before) for place in these for before in those if place > before]
    return abs((runs[1] - runs[0] + 180) % 360 - 180), found


def independent(chained: Chained, *groups: Sequence[DrawnFact]) -> tuple[list[DrawnFact], bool]:
    """Of facts in their order those that say something new about the places, for which a field is free; and whether
    they determine the chain."""
    basis, taken = list[Any](), set[tuple[int, str]]()
    chosen = [fact for group in groups for fact in group if fact.field == "corner"]
    step = _STEP * float(np.ptp(chained.at))
    moves = np.eye(chained.at.size).reshape(-1, *chained.at.shape) * step

    def is_new(fact: DrawnFact, least: float) -> bool:
        ends = ([chained.measure(chained.at + way, fact) for way in (move, -move)] for move in moves)
        # Of an angle, half a turn is the same on both sides.
        gradient = np.array([(one - other + 180) % 360 - 180 for one, other in ends])
        rest = gradient / (float(np.linalg.norm(gradient)) or 1.0)
        for each in (*basis, *basis):
            rest = rest - (rest @ each) * each
        left = float(np.linalg.norm(rest))
        if left > least:
            basis.append(rest / left)
        return left > least

    stated = [DrawnFact(-1, name) for name in chained.axes] + [DrawnFact(place, "off") for place in chained.arcs]
    for each in stated:
        is_new(each, _RANKS[-1])
    for least, fact in ((each, fact) for each in _RANKS for group in groups for fact in group if fact not in chosen):
        name = fact.field.removeprefix("I")
        rivals = {name, f"I{name}"} if name in chained.axes else {fact.field} - {"facts"}
        is_free = not any((fact.element, each) in taken for each in rivals)
        if len(basis) < chained.at.size and is_free and is_new(fact, least):
            chosen.append(fact)
            taken.add((fact.element, fact.field))
    return chosen, len(basis) == chained.at.size


def elements_of(chained: Chained, facts: Sequence[DrawnFact], *, has_guess: bool) -> tuple[SketchElement, ...]:
    """The elements of the sketch with their fields; `has_guess` says where each ends about, to choose a solution."""
    found = []
    for place in range(len(chained.elements)):
        own = [fact for fact in facts if fact.element == place]
        arc = chained.arcs.get(place)
        found.append(
            SketchElement(
                "arc" if arc else "line",
                {name: value for fact in own for name, value in fact.words().items()},
                arc.turn.value if arc else None,
                any(fact.field == "tangent" for fact in own),
                chained.corners[place].corner if place in chained.corners else None,
                guess=chained.place(place + 1) if has_guess else {},
                facts=tuple(
                    f"angle from line {(fact.origin or 0) + 1} to line {place + 1} = {fact.value}"
                    for fact in own
                    if fact.field == "facts"
                ),
            )
        )
    return tuple(found)
