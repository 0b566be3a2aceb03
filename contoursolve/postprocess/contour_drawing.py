"""A solved contour as a drawing has it: elements up to their virtual intersections, corners, and the drawing's numbers.

From it the words of any control are made: each word states a fact about these points, whose value they tell.
"""

from collections.abc import Iterator, Mapping
from decimal import Decimal
from math import dist, isclose

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer, status_text
from contoursolve.geometry import CornerShape, Fact, Given, Length, Line, Plane, Unit
from contoursolve.postprocess.expansion_report import ConversionError
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment, direction, on_arc

EXACT = 5e-9
"""mm or degrees. A value that is off a number by no more is that number."""

SMOOTH = 1e-7
"""1 (sine of an angle). Elements whose directions differ by less touch each other: a millionth of a degree."""


class DrawnCorner(Struct, frozen=True):
    """The corner behind an element: its shape, its size (mm), how it is cut."""

    shape: CornerShape
    size: float
    segment: Segment


class DrawnElement(Struct, frozen=True):
    """A line or arc between virtual intersections, the part of it that is cut, and the corner behind it."""

    segment: Segment
    cut: Segment | None
    corner: DrawnCorner | None = None
    place: int = -1
    """Its place on the path of the profile."""

    @property
    def ends(self) -> tuple[complex, complex]:
        """The directions in which it begins and ends."""
        each = self.segment
        if isinstance(each, LineSegment):
            return (complex(*direction(each.start, each.end)),) * 2
        return complex(*on_arc(each, 0.0)[1]), complex(*on_arc(each, 1.0)[1])


_Numbers = Mapping[tuple[int | None, Unit, float], Decimal]
"""Coordinates by axis and lengths in mm (X of a lathe as radius), angles in degrees; by their rounded values."""


_TURN, _DIGITS = 360.0, 8


def _key(value: float, axis: int | None, unit: Unit) -> tuple[int | None, Unit, float]:
    is_angle = unit is Unit.DEGREE
    return axis, unit, round(value % _TURN, _DIGITS) % _TURN if is_angle else round(value, _DIGITS)


class ContourDrawing(Struct, frozen=True):
    """All elements in their order, and the numbers of the drawing."""

    plane: Plane
    unit: Length
    elements: tuple[DrawnElement, ...]
    numbers: _Numbers
    points: tuple[Point, ...] = ()
    """The points whose both coordinates the drawing gives."""

    def number(self, value: float, axis: int | None, unit: Unit) -> Decimal | None:
        """The number of the drawing that a value is."""
        return self.numbers.get(_key(value, axis, unit))

    def point_on(self, element: DrawnElement) -> Point | None:
        """A point of the drawing on the line or circle of an element, away from where it begins."""
        each = element.segment
        for at in self.points:
            off = complex(*at) - complex(*each.start)
            if isinstance(each, ArcSegment):
                beside = dist(at, each.center) - each.radius
            else:
                beside = (element.ends[0].conjugate() * off).imag
            if abs(beside) <= EXACT < abs(off):
                return at
        return None

    @property
    def start(self) -> Point:
        """The begin of the path, mm."""
        return self.elements[0].segment.start

    @property
    def path(self) -> Iterator[Segment]:
        """All that is cut, in order."""
        for element in self.elements:
            if element.cut is not None:
                yield element.cut
            if element.corner is not None:
                yield element.corner.segment


def draw(answer: Answer) -> ContourDrawing:
    """The drawing of a solved contour. Raises ConversionError if it has no path."""
    contour, profile = answer.contour, answer.profile
    if contour is None:
        raise ConversionError(f"the contour has no path: {status_text(answer.status)}")
    cut = {each.name: each for each in contour.elements}
    corners = {each.before: each for each in profile.figure.corners if each.name in cut}
    places = {profile.figure.path[-1].head: contour.end, **contour.places, profile.figure.start: contour.start}
    elements = list[DrawnElement]()
    for place, element in enumerate(profile.figure.path):
        own, corner = cut.get(element.name), corners.get(element.name)
        start, end = places[element.tail], places[element.head]
        if isinstance(element, Line):
            segment: Segment = LineSegment(element.name, start, end)
        elif isinstance(own, ArcSegment):
            segment = replace(own, start=start, end=end)
        else:
            continue
        if dist(start, end) <= EXACT and own is None:
            continue
        size = float(profile.givens[corner.size].value) if corner else 0.0
        behind = DrawnCorner(corner.shape, size, cut[corner.name]) if corner else None
        elements.append(DrawnElement(segment, own, behind, place))
    stated = [fact.placed for fact in profile.facts if fact.given and fact.placed is not None]
    axes = {(each.point, each.axis) for each in stated if each.is_stepped and not each.origin}
    points = tuple(at for name, at in contour.places.items() if {(name, 0), (name, 1)} <= axes)
    return ContourDrawing(answer.plane, answer.unit, tuple(elements), _numbers(answer), points)


def _numbers(answer: Answer) -> _Numbers:
    """The numbers that the words of a contour and its facts state, and those of its start."""
    profile = answer.profile
    facts: Mapping[str, Fact] = {fact.given: fact for fact in profile.facts if fact.given}
    found = list[tuple[Decimal, int | None, Unit]]()
    found += [(value, axis, Unit.MM) for axis, value in enumerate(profile.start.values) if value is not None]
    for given in (each for each in profile.givens.values() if _is_drawn(each)):
        placed = facts[given.name].placed if given.name in facts else None
        axis = placed.axis if placed is not None and placed.is_stepped and not placed.origin else None
        found.append((given.value, axis, given.unit))
        if axis is None and given.unit is not Unit.DEGREE:
            found.append((-given.value, axis, given.unit))
    return {_key(float(number), axis, unit): number for number, axis, unit in reversed(found)}


def _is_drawn(given: Given) -> bool:
    """Whether a given is a number that somebody states: by a word, or as the place of a pole."""
    return (given.word is not None or given.name.startswith("pole")) and given.unit is not Unit.SIGN


def with_roundings(drawn: ContourDrawing) -> ContourDrawing:
    """The same, where each arc that touches the lines before and behind it is the rounding of their corner."""
    elements = list(drawn.elements)
    for number in reversed(range(1, len(elements) - 1)):
        elements[number - 1 : number + 2] = _rounded(*elements[number - 1 : number + 2])
    return replace(drawn, elements=tuple(elements))


def _rounded(before: DrawnElement, arc: DrawnElement, after: DrawnElement) -> tuple[DrawnElement, ...]:
    """Two lines up to their virtual intersection, if what is between them rounds it; else all three."""
    round_, lines = arc.segment, all(isinstance(each.segment, LineSegment) for each in (before, after))
    one, other = before.ends[1], after.ends[0]
    is_tangent = begins_smoothly(before, arc) and begins_smoothly(arc, after)
    if not (isinstance(round_, ArcSegment) and lines and is_tangent and round_.sweep < _MOST_ROUNDED):
        return before, arc, after
    vertex = complex(*round_.start) + one * round_.radius * abs((other - one) / (other + one))
    at, corner = (vertex.real, vertex.imag), DrawnCorner(CornerShape.FILLET, round_.radius, round_)
    return (
        replace(before, segment=replace(before.segment, end=at), corner=corner),
        replace(after, segment=replace(after.segment, start=at)),
    )


_MOST_ROUNDED = 170.0
"""Degrees. The virtual intersection of lines that turn by more lies far away."""


def begins_smoothly(before: DrawnElement, element: DrawnElement) -> bool:
    """Whether an element begins in the direction in which the one before it ends, without a corner."""
    turn = before.ends[1].conjugate() * element.ends[0]
    return before.corner is None and abs(turn.imag) <= SMOOTH and turn.real > 0


def size_as(shape: CornerShape, element: DrawnElement) -> float | None:
    """The size of the corner behind an element, in mm, if it were stated as a shape; None if it has not that shape."""
    corner = element.corner
    if corner is None:
        return None
    if isinstance(corner.segment, ArcSegment):
        return corner.segment.radius if shape is CornerShape.FILLET else None
    if corner.shape is shape:
        return corner.size
    begin, end, at = corner.segment.start, corner.segment.end, element.segment.end
    face, setbacks = dist(begin, end), (dist(at, begin), dist(at, end))
    extents = abs(end[0] - begin[0]), abs(end[1] - begin[1])
    if shape.share:
        is_45 = isclose(*extents, rel_tol=0, abs_tol=EXACT)
        return extents[0] / shape.share if is_45 else None
    if shape is CornerShape.FILLET or not isclose(*setbacks, rel_tol=0, abs_tol=EXACT):
        return None
    return setbacks[0] if shape is CornerShape.CHAMFER_SETBACK else face
