"""The unknowns of an NCT contour of any number of blocks, as the result claims them: points, radii, sizes of corners.

Points count from the start point, in mm; real is the plane's first axis, imaginary its second.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import sqrt

from contoursolve.model import FIRST, SECOND
from contoursolve.verification.case import Case, Move
from contoursolve.verification.chain import draw
from contoursolve.verification.course import Bend, Course, Shape, trace
from contoursolve.verification.drawing import Drawing, UnmeasurableError
from contoursolve.verification.measure import direction, unit
from contoursolve.verification.nct_words import CORNERS, ENDS, POINT, Element, elements_of
from contoursolve.verification.rails import Rail, Ray, Ring, UnmakeableError

Slots = Mapping[str, Move]
"""The claimed elements by their names."""


@dataclass(frozen=True, slots=True)
class Figure:
    """Points and numbers by their names; numbers are radii, and the sizes of corners that are asked for, mm."""

    points: Mapping[str, complex]
    numbers: Mapping[str, float]

    def listed(self) -> tuple[float, ...]:
        """All of them, mm."""
        return (*self.numbers.values(), *(value for at in self.points.values() for value in (at.real, at.imag)))

    def changed(self, values: Sequence[float]) -> "Figure":
        """The same with other values, in the order of `listed`."""
        count = len(self.numbers)
        places = (complex(*pair) for pair in zip(values[count::2], values[count + 1 :: 2], strict=True))
        numbers = dict(zip(self.numbers, values[:count], strict=True))
        return Figure(dict(zip(self.points, places, strict=True)), numbers)

    def at(self, name: str) -> complex:
        """A point; the start is no unknown."""
        return self.points.get(name, 0j)


def makers(case: Case, each: Element) -> list[str]:
    """The words that make the corner after an element: a word of 0 makes none."""
    names = [each.given(word) for word in CORNERS]
    return [name for name in names if name in case.asked or (case.states(name) and case.value(name))]


def slots_of(case: Case) -> Iterator[Slots]:
    """Every way to give the claimed elements their names. Lines, and corners whose size is asked for, may be of no
    length and left out."""
    order: list[tuple[str, bool, bool]] = []
    elements = elements_of(case.claim)
    for each in elements:
        order.append((each.name, each.turn is not None, each.turn is None))
        for name in makers(case, each)[:1] if each is not elements[-1] else ():
            is_rounding = CORNERS[name.partition(":")[2]] is Shape.ROUNDING
            order.append((f"corner {each.number}", is_rounding, name in case.asked))
    kinds = [move.circle is not None for move in case.moves]
    missing = len(order) - len(kinds)
    optional = [number for number, each in enumerate(order) if each[2]]
    for left in combinations(optional, missing) if 0 <= missing <= len(optional) else ():
        kept = [each for number, each in enumerate(order) if number not in left]
        if [each[1] for each in kept] == kinds:
            yield dict(zip((each[0] for each in kept), case.moves, strict=True))


def figure_of(case: Case, slots: Slots) -> Figure:
    """The unknowns as claimed."""
    points: dict[str, complex] = {}
    numbers: dict[str, float] = {}
    joints = {name: case.points[name] for name in case.claim.form.intersections}
    for each in elements_of(case.claim):
        if each.name in slots and slots[each.name].circle:
            circle = slots[each.name].circle
            assert circle is not None
            points[each.center], numbers[each.radius] = circle.center, circle.radius
        for name in makers(case, each):
            if name in case.asked:
                numbers[name] = _claimed_size(slots.get(f"corner {each.number}"), joints.get(each.head, 0j), name)
        points[each.head] = joints.get(each.head, case.end or 0j)
    for each in elements_of(case.claim):
        if each.own not in points and (case.states(each.given(POINT)) or each.is_over):
            points[each.own] = _point(case, each, points, numbers)
    return Figure(points, numbers)


def _claimed_size(move: Move | None, at: complex, name: str) -> float:
    if move is None:
        return 0.0
    return move.circle.radius if move.circle and name.endswith(",R") else abs(move.start - at)


def _point(case: Case, each: Element, points: Mapping[str, complex], numbers: Mapping[str, float]) -> complex:
    """The point that an element's coordinates state; a coordinate that is asked for is the claimed one.

    Where nothing claims it, it is taken from the circle or line.
    """
    tail = points.get(each.tail, 0j)
    found: list[float | None] = []
    for axis, (absolute, step) in zip((FIRST, SECOND), ENDS, strict=True):
        begin = (tail.real, tail.imag)[axis]
        if case.states(each.given(absolute)):
            found.append(case.coordinate(each.given(absolute), axis))
        elif case.states(each.given(step)):
            found.append(begin + case.amount(each.given(step)))
        else:
            found.append(_asked(case, each, axis, begin))
    first, second = found
    if first is not None and second is not None:
        return complex(first, second)
    if each.turn is None:
        head = points[each.head]
        return complex(head.real if first is None else first, head.imag if second is None else second)
    center, radius = points.get(each.center, 0j), numbers.get(each.radius, 0.0)
    if first is None:
        first = _on_circle(radius, center.real, (second or 0.0) - center.imag)
    if second is None:
        second = _on_circle(radius, center.imag, first - center.real)
    return complex(first, second)


def _asked(case: Case, each: Element, axis: int, begin: float) -> float | None:
    """A coordinate that the program asks for, as the result answers it."""
    for name, is_absolute in zip(ENDS[axis], (True, False), strict=True):
        word = case.claim.words.get(each.given(name))
        for asked in case.claimed.asked or ():
            if word and (asked.word, asked.line) == (word.text, word.span.line) and asked.value is not None:
                return asked.value - float(case.origin[axis]) if is_absolute else asked.value + begin
    return None


def _on_circle(radius: float, middle: float, off: float) -> float:
    """Where a circle is, `off` from its centre along the other axis; where it comes closest, if it is nowhere."""
    return middle + sqrt(max(0.0, (radius - off) * (radius + off)))


def rail_of(case: Case, each: Element, figure: Figure) -> Rail:
    """The line or circle of an element."""
    if each.turn is not None:
        return Ring(figure.at(each.center), figure.numbers.get(each.radius, 0.0), each.turn)
    tail, run = figure.at(each.tail), figure.at(each.head) - figure.at(each.tail)
    has_angle = bool(case.states(each.given(",A")))
    return Ray(tail, direction(case.value(each.given(",A"))) if has_angle and not run else unit(run))


def course_at(case: Case, figure: Figure) -> Course:
    """The course of a figure."""
    elements = elements_of(case.claim)
    bends = {}
    for each in elements[:-1]:
        for name in makers(case, each):
            size = figure.numbers[name] if name in case.asked else case.amount(name)
            shape = CORNERS[name.partition(":")[2]]
            if size:
                bends[each.number - 1] = Bend(f"corner {each.number}", shape, size, case.texts(name))
    rails = tuple(rail_of(case, each, figure) for each in elements)
    joints = (0j, *(figure.at(each.head) for each in elements))
    return Course(tuple(each.name for each in elements), rails, joints, bends)


def drawing_at(case: Case, figure: Figure) -> Drawing:
    """The figure as a drawing. Raises UnmeasurableError where there is none."""
    course = course_at(case, figure)
    try:
        pieces = trace(course).pieces
    except UnmakeableError as error:
        raise UnmeasurableError(str(error)) from None
    return draw(course, pieces, {"S": 0j, **figure.points})
