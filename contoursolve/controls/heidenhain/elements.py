"""The elements of a chain of lines and arcs, and the facts that their words state, alone or several together."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from operator import attrgetter

from msgspec import Struct

from contoursolve.controls.heidenhain.lexicon import (
    ABOUT_CENTER,
    CHAMFER,
    FREE,
    ROUNDING,
    STRAIGHT,
    TANGENT,
    PlaneWords,
)
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Chord,
    Circle,
    Coordinate,
    CornerShape,
    Distance,
    Extent,
    Fact,
    Heading,
    Leaving,
    Level,
    Line,
    Offset,
    ParallelLines,
    ParallelTangent,
    Radius,
    RadiusStep,
    Ray,
    Spoke,
    Turn,
    TurnBetween,
    direction_at,
    make_smooth,
    put_beside,
    put_on,
)
from contoursolve.reading import FactRow

START = "S"
TANGENCY = "tangent"
"""The statement of a function that begins in the direction of the element before it."""

LINE, ARC, PLAIN, POLE = "line", "arc", "plain", "pole"
"""The roles of blocks: free lines and arcs, conventional moves, poles."""

CORNERS = {ROUNDING: CornerShape.FILLET, CHAMFER: CornerShape.CHAMFER_SETBACK}


class FkElement(Struct, frozen=True):
    """One element as far as its facts depend on it.

    `counted` are the increments that count from another block, each with the number of the element at whose end that
    is (0 for the start of the chain). `parallel` is the number of the line to which it is parallel.
    `touching` are the distances of value 0: D and DP.
    """

    function: str
    turn: Turn | None = None
    pole: str = ""
    counted: tuple[tuple[str, int], ...] = ()
    parallel: int = 0
    touching: frozenset[str] = frozenset()
    is_entered: bool = False
    """Whether AN states the direction in which it begins."""
    is_ended: bool = False
    """Whether CCA states the direction from its centre to its end."""
    is_placed: bool = False
    """Whether its end is stated, though it may say so twice."""
    goes_round: bool = False
    """Whether it is on the circle of the arc before it, in the same sense, as the centres of both say."""
    has_radius_of_before: bool = False
    """Whether it touches the arc before it in the same sense with the same stated radius: it is on its circle, too."""
    is_loose: bool = False
    """Whether it may run against AN, too."""
    closes: int = 0
    """The number of the element at whose begin it ends: the one with CLSD+."""

    @property
    def is_line(self) -> bool:
        """Whether it is straight."""
        return self.function in STRAIGHT

    @property
    def role(self) -> str:
        """The role by which rules speak about it."""
        if self.function not in FREE:
            return PLAIN
        return LINE if self.is_line else ARC


class PlacedElement(Struct, frozen=True):
    """The names of an element and of its points, and the element itself.

    `label` is the number of its block, by which programmers speak of it.
    """

    number: int
    label: str
    element: FkElement
    tail: str
    head: str

    @property
    def prefix(self) -> str:
        """The begin of the names of what its block states."""
        return f"{self.number}:"

    @property
    def name(self) -> str:
        return f"{'line' if self.element.is_line else 'arc'} {self.label}"

    @property
    def center(self) -> str:
        return f"C{self.label}"

    @property
    def radius(self) -> str:
        return f"r{self.label}"

    @property
    def turn(self) -> Turn:
        return self.element.turn or Turn.CCW

    @property
    def shape(self) -> Line | Arc:
        """The line or arc of the path."""
        if self.element.is_line:
            return Line(self.name, self.tail, self.head)
        is_whole = self.element.function in ABOUT_CENTER
        return Arc(self.name, self.tail, self.head, self.center, self.radius, self.turn, may_be_full=is_whole)


class Chain(Struct, frozen=True):
    """All elements with their names; `poles` are the names of the poles that blocks of the chain state."""

    places: tuple[PlacedElement, ...]
    words: PlaneWords

    def at(self, number: int) -> str:
        """The end of the element of a number; of 0, the begin of the chain."""
        return self.places[number - 1].head if number else START

    def counted_from(self, place: PlacedElement, word: str) -> str:
        """The point from which an increment counts: where the element begins, or where another block ends."""
        counted = dict(place.element.counted)
        return self.at(counted[word]) if word in counted else place.tail


Facts = Callable[[Chain, PlacedElement, str], Iterable[Fact]]
"""(chain, element, name of the word) to what the word states."""


def _placing(of: str, mark: str, axes: tuple[str, str]) -> Iterator[tuple[str, Facts]]:
    """The words that place the end of an element, or its centre: the same, but for a mark in their names."""
    point = attrgetter(of)

    def coordinate(axis: int) -> Facts:
        return lambda _, place, given: [Coordinate(given, point(place), axis)]

    def step(axis: int, word: str) -> Facts:
        return lambda chain, place, given: [Offset(given, point(place), chain.counted_from(place, word), axis)]

    def farther(chain: Chain, place: PlacedElement, given: str) -> Iterator[Fact]:
        pole, radii = place.element.pole, [f"{given} {each}" for each in ("from", "to")]
        for end, radius in zip((chain.counted_from(place, f"I{mark}PR"), point(place)), radii, strict=True):
            yield put_on(Circle("", pole, radius), end)
        yield RadiusStep(given, radii[1], radii[0])

    def turned(chain: Chain, place: PlacedElement, given: str) -> Iterator[Fact]:
        pole = place.element.pole
        before = Chord(pole, chain.counted_from(place, f"I{mark}PA"))
        yield TurnBetween(given, before, Chord(pole, point(place)))

    for axis, letter in enumerate(axes):
        yield mark + letter, coordinate(axis)
        yield f"I{mark}{letter}", step(axis, f"I{mark}{letter}")
    yield f"{mark}PR", lambda _, place, given: [Distance(given, place.element.pole, point(place))]
    yield f"{mark}PA", lambda _, place, given: [Ray(given, place.element.pole, point(place))]
    yield f"I{mark}PR", farther
    yield f"I{mark}PA", turned


def _direction(_: Chain, place: PlacedElement, given: str) -> Iterator[Fact]:
    if place.element.is_line:
        yield (Heading if place.element.is_loose else Ray)(given, place.tail, place.head)
    else:
        yield from _spokes(given, place, place.tail, -place.turn.sign)


def _angle_to(chain: Chain, place: PlacedElement, given: str) -> Iterator[Fact]:
    number = dict(place.element.counted).get("IAN", place.number - 1)
    if number:
        other = chain.places[number - 1]
        yield TurnBetween(given, direction_at(other.shape, other.head), direction_at(place.shape, place.tail))


def _length(_: Chain, place: PlacedElement, given: str) -> Iterator[Fact]:
    if place.element.is_line:
        yield Extent(given, place.name, place.tail, place.head)
    else:
        yield Distance(given, place.tail, place.head)


def _spokes(given: str, place: PlacedElement, point: str, quarters: int = 0) -> Iterator[Fact]:
    """The radius of an arc that leads to a point in a stated direction, along both axes."""
    yield from (Spoke(given, place.center, point, place.radius, axis, quarters) for axis in (FIRST, SECOND))


def _closes(chain: Chain, place: PlacedElement, given: str) -> Iterator[Fact]:
    if place.element.closes:
        begin = chain.at(place.element.closes - 1)
        yield from (Level(place.head, begin, axis, given) for axis in (FIRST, SECOND))


def _touches_before(chain: Chain, place: PlacedElement, given: str) -> Iterator[Fact]:
    """That an element begins in the direction in which the one before it ends."""
    if place.number == 1:
        return
    before = chain.places[place.number - 2]
    if place.element.goes_round:
        return
    if is_aimed(chain, place):
        yield from _goes_on(before, place)
        return
    if place.element.has_radius_of_before:
        yield from (Level(place.center, before.center, axis, given) for axis in (FIRST, SECOND))
        return
    if place.element.is_line and before.element.is_placed and not before.element.is_line:
        yield Leaving(place.name, place.tail, before.center, before.turn, given)
        return
    yield from make_smooth(before.shape, place.shape, place.tail, given)


def is_aimed(chain: Chain, place: PlacedElement) -> bool:
    """Whether a word states the direction in which an arc ends or begins, where it touches another element."""
    if place.number == 1 or place.element.function not in TANGENT:
        return False
    before = chain.places[place.number - 2]
    return before.element.is_ended or (place.element.is_entered and not place.element.is_line)


def _goes_on(before: PlacedElement, place: PlacedElement) -> Iterator[Fact]:
    """The facts that the direction where two elements touch says of the other one: all of these are affine."""
    if before.element.is_ended:
        given = f"{before.prefix}CCA"
        if place.element.is_line:
            yield Ray(place.prefix + ALONG, place.tail, place.head)
        else:
            yield from _spokes(given, place, place.tail, 0 if before.turn is place.turn else 2)
    elif before.element.is_line:
        yield Ray(f"{place.prefix}AN", before.tail, before.head)
    else:
        yield from _spokes(f"{place.prefix}AN", before, place.tail, -before.turn.sign)


ALONG = "along"
"""The direction of a line that begins where CCA ends an arc: a quarter of a turn from that."""

_BY_THEMSELVES: Mapping[str, Facts] = {
    "AN": _direction,
    "IAN": _angle_to,
    "LEN": _length,
    "R": lambda _, place, given: [Radius(given, place.radius)],
    "CCA": lambda _, place, given: _spokes(given, place, place.head),
    "CLSD-": _closes,
    TANGENCY: _touches_before,
}


@cache
def facts_of(axes: tuple[str, str]) -> Mapping[str, Facts]:
    """The facts that a word states by itself, in a plane of these axes."""
    return {**dict(_placing("head", "", axes)), **dict(_placing("center", "CC", axes)), **_BY_THEMSELVES}


POLAR = frozenset({"PR", "PA", "IPR", "IPA", "CCPR", "CCPA", "ICCPR", "ICCPA"})
POINTS = ("P1", "P2", "P3")
BESIDE = "PD"


def point_rows(place: PlacedElement, axes: tuple[str, str]) -> Iterator[FactRow]:
    """Points on the element, each by two words, and one beside it, by three."""
    q = place.prefix
    for point in (POINTS[:2] if place.element.is_line else POINTS) + (BESIDE,):
        name, words = f"{q}{point}", [f"{q}{point}{axis}" for axis in axes]
        distance = f"{q}D"
        needs = (*words, *([distance] if point == BESIDE else []))
        radius, side = f"{name} distance", f"{name}.side"
        # What words state comes last: of what does not agree, it is named.
        if point != BESIDE or "D" in place.element.touching:
            yield FactRow(put_on(place.shape, name), needs)
        else:
            yield FactRow(put_beside(place.shape, name, radius, side), needs)
        yield from (FactRow(Coordinate(word, name, axis), needs) for axis, word in enumerate(words))
        if point == BESIDE and "D" not in place.element.touching:
            yield FactRow(Radius(distance, radius), needs)


def parallel_rows(chain: Chain, place: PlacedElement) -> Iterator[FactRow]:
    """A line parallel to another one, or to the tangent of an arc where it begins, and at which distance."""
    number = place.element.parallel
    if not (number and place.element.is_line):
        return
    other, word, distance = chain.places[number - 1], f"{place.prefix}PAR", f"{place.prefix}DP"
    if other.element.is_line:
        yield FactRow(ParallelLines(other.name, place.name, word), (word,))
    else:
        yield FactRow(ParallelTangent(place.name, other.tail, other.center, word), (word,))
    if "DP" in place.element.touching:
        yield FactRow(put_on(place.shape, other.tail, distance), (word, distance))
        return
    radius, side = f"{place.prefix}DP distance", f"{place.prefix}DP.side"
    yield FactRow(put_beside(place.shape, other.tail, radius, side), (word, distance))
    yield FactRow(Radius(distance, radius), (word, distance))
