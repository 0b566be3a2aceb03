"""Writes a contour as plain G-code: rounded so that every arc stays valid, with the deviation that this costs."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import atan2, ceil, cos, floor, hypot, inf, pi, radians, sin, sqrt, tau
from typing import NamedTuple

from msgspec.structs import replace

from contoursolve.gcode import PLAIN, WordSpelling
from contoursolve.geometry import Length, Plane, Turn
from contoursolve.postprocess.post_processors import Arcs
from contoursolve.reading import State
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment

LONGEST_BY_CENTER = 300.0
"""Degrees. A longer arc is written as two: where its ends come close, they no longer tell where its centre is, and
where they round to the same point, it would be no arc or a full circle."""

LONGEST_BY_RADIUS = 120.0
"""Degrees. A longer arc is written as several: near 180, the least change of R moves the centre far."""


@dataclass(frozen=True, slots=True)
class Format:
    """Format of the words of a block: the unit of lengths and their decimals. Centres and radii have at least
    `arc_decimals`, so that controls find both ends of an arc equally far from its centre."""

    plane: Plane
    unit: Length
    decimals: int
    has_point: bool
    arcs: Arcs
    is_incremental: bool = False
    arc_decimals: int = 0
    radius: str = "R"
    """The address of an arc's radius."""
    is_center_absolute: bool = False
    """Whether centres are coordinates, and not counted from where the arc begins."""
    letters: tuple[str, ...] = ()
    """The addresses of the plane's axes, where these are not their names."""
    words: WordSpelling = PLAIN
    mm: float = field(init=False)
    """Millimetres of one unit."""
    step: float = field(init=False)
    """One of the last decimal."""
    arc_step: float = field(init=False)
    """The same of a centre or a radius."""
    scales: tuple[int, int] = field(init=False)
    """Factors of a radius on each axis."""
    spec: str = field(init=False)
    arc_spec: str = field(init=False)

    def __post_init__(self) -> None:
        arc_decimals = max(self.decimals, self.arc_decimals)
        scales = tuple(2 if is_diameter else 1 for is_diameter in self.plane.diameters)
        for name, value in (
            ("mm", float(self.unit.in_mm)),
            ("step", 10.0**-self.decimals),
            ("scales", scales),
            ("spec", f"%.{self.decimals}f"),
            ("arc_step", 10.0**-arc_decimals),
            ("arc_spec", f"%.{arc_decimals}f"),
        ):
            object.__setattr__(self, name, value)

    def number(self, value: float, spec: str | None = None) -> str:
        """A number with its decimals, without zeros at its end."""
        text = (spec or self.spec) % value
        if "." in text:
            text = text.rstrip("0")
        elif self.has_point:
            text += "."
        if text in ("-0.", "-0"):
            text = text[1:]
        return text if self.has_point else text.removesuffix(".")


class MotionBlock(NamedTuple):
    """One block of plain G-code: its motion code, its words, where it ends and how far its path is from the exact
    one; mm, X of a lathe as radius."""

    code: int
    words: tuple[str, ...]
    end: Point
    deviation: float


def plane_of(contour: Plane, state: State) -> Plane:
    """The plane of a contour as one of its blocks counts in it: one command may make X a diameter in absolute
    coordinates and a radius in increments."""
    own = state.plane
    return replace(contour, diameters=own.diameters) if contour.axes == own.axes else contour


def longest(form: Format) -> float:
    """The longest arc that is written as one, degrees."""
    return LONGEST_BY_RADIUS if form.arcs is Arcs.RADIUS else LONGEST_BY_CENTER


_ALONE: Mapping[str, tuple[float, float]] = {}


def emit(
    segment: Segment,
    here: Point,
    form: Format,
    *,
    is_rapid: bool = False,
    beside: Mapping[str, tuple[float, float]] = _ALONE,
) -> Iterator[MotionBlock]:
    """The moves that make an element, from where the tool really is; none if it rounds to nothing. Axes `beside` its
    plane go along from one coordinate to another, mm.

    A last move without words tells how far off that is.
    """
    parts = parts_of(segment, form)
    places = {axis: low / form.mm for axis, (low, _) in beside.items()}
    for number, part in enumerate(parts, 1):
        move = _Writer(part, here, form).move(is_rapid)
        here, words, off = move.end, list(move.words), move.deviation
        for axis, (low, high) in beside.items():
            exact, base = (low + (high - low) * number / len(parts)) / form.mm, places[axis] * form.is_incremental
            words.append(axis + form.number(exact - base))
            places[axis] = base + float(form.number(exact - base))
            off = max(off, abs(places[axis] - exact) * form.mm)
        code = 0 if is_rapid and not move.words else move.code
        yield MotionBlock(code, tuple(words), here, off) if beside else move


def parts_of(segment: Segment, form: Format) -> tuple[Segment, ...]:
    """An element as the parts that have blocks of their own: an arc that is too long for one is several."""
    parts = ceil(segment.sweep / longest(form)) if isinstance(segment, ArcSegment) else 1
    return (segment,) if parts <= 1 else tuple(_split(segment, parts))


def _split(arc: Segment, parts: int) -> Iterator[Segment]:
    """An arc as so many equal ones."""
    if isinstance(arc, LineSegment):
        raise TypeError("a line is not split")
    begin, start = atan2(arc.start[1] - arc.center[1], arc.start[0] - arc.center[0]), arc.start
    for number in range(1, parts + 1):
        angle = begin + arc.turn.sign * radians(arc.sweep) * number / parts
        middle = arc.center[0] + arc.radius * cos(angle), arc.center[1] + arc.radius * sin(angle)
        end = arc.end if number == parts else middle
        yield replace(arc, start=start, end=end)
        start = end


class _Writer:
    """One element; inside, lengths are in the program's unit, X as radius."""

    def __init__(self, segment: Segment, here: Point, form: Format) -> None:
        self.form = form
        self.mm = form.mm
        self.segment = segment
        self.here = here[0] / self.mm, here[1] / self.mm
        self.step = form.step

    def move(self, is_rapid: bool) -> MotionBlock:
        form, mm, (here, there) = self.form, self.mm, self.here
        (one, two), exact = form.scales, self.segment.end
        base, other = (here, there) if form.is_incremental else (0.0, 0.0)
        first, second = form.number((exact[0] / mm - base) * one), form.number((exact[1] / mm - other) * two)
        end = base + float(first) / one, other + float(second) / two
        off = hypot(exact[0] - end[0] * mm, exact[1] - end[1] * mm)
        if hypot(end[0] - here, end[1] - there) < self.step / 4 or self._is_turned_back(end):
            return MotionBlock(1, (), self._in_mm(self.here), off)
        words = sorted(
            form.words.spell(*each) for each in zip(form.letters or form.plane.axes, (first, second), strict=True)
        )
        more: list[str] = []
        if isinstance(self.segment, LineSegment):
            code = 0 if is_rapid else 1
        else:
            code = 2 if self.segment.turn is Turn.CW else 3
            by_radius = self.form.arcs is Arcs.RADIUS
            more, center, radius = self._by_radius(end) if by_radius else self._by_center(end)
            off = max(off, _arc_deviation(self.segment, self._in_mm(center), radius * self.mm))
        return MotionBlock(code, (*words, *sorted(more)), (end[0] * mm, end[1] * mm), off)

    def _is_turned_back(self, end: Point) -> bool:
        """Whether an arc is so short that its rounded end lies behind its start: it would go around nearly once."""
        if isinstance(self.segment, LineSegment):
            return False
        ways = zip(self.here, end, self.segment.start, self.segment.end, strict=True)
        return sum((new - old) * (last - first) for old, new, first, last in ways) <= 0

    def _by_center(self, end: Point) -> tuple[list[str], Point, float]:
        """I J K for a centre that is as far from one end as from the other, to one unit of its last decimal; of those,
        the one nearest to the exact centre."""
        arc, start = self._arc(), self.here
        exact = arc.center[0] / self.mm - start[0], arc.center[1] / self.mm - start[1]
        chord = end[0] - start[0], end[1] - start[1]
        along = (chord[0] / 2 - exact[0]) * chord[0] + (chord[1] / 2 - exact[1]) * chord[1]
        along /= chord[0] ** 2 + chord[1] ** 2
        step, (across, rise), (to_first, to_second) = self.form.arc_step, chord, exact
        # Where centres are coordinates, those have the decimals.
        origin = start if self.form.is_center_absolute else (0.0, 0.0)
        best = (inf, inf, 0.0, 0.0)
        for share in (0.0, along):
            first = (origin[0] + to_first + share * across) / step
            second = (origin[1] + to_second + share * rise) / step
            for one in {floor(first), ceil(first)}:
                i = one * step - origin[0]
                for two in {floor(second), ceil(second)}:
                    j = two * step - origin[1]
                    mismatch = abs(hypot(i, j) - hypot(across - i, rise - j))
                    key = (max(mismatch, step), hypot(i - to_first, j - to_second), i, j)
                    if key < best:
                        best = key
        if best[0] == inf:
            raise ValueError("an arc without a center")
        spec = self.form.arc_spec
        texts = [self.form.number(value + base, spec) for value, base in zip(best[2:], origin, strict=True)]
        i, j = (float(text) - base for text, base in zip(texts, origin, strict=True))
        center = start[0] + i, start[1] + j
        words = [address + text for address, text in zip(self.form.plane.centers, texts, strict=True)]
        return words, center, hypot(i, j)

    def _by_radius(self, end: Point) -> tuple[list[str], Point, float]:
        """R, large enough to reach both ends."""
        arc, start = self._arc(), self.here
        chord = end[0] - start[0], end[1] - start[1]
        half = hypot(*chord) / 2
        spec, step = self.form.arc_spec, self.form.arc_step
        radius = float(self.form.number(arc.radius / self.mm, spec))
        if radius < half:
            radius = ceil(half / step) * step
        text = self.form.number(radius, spec)
        height = sqrt(max(radius**2 - half**2, 0.0)) * arc.turn.sign / (2 * half)
        center = (start[0] + end[0]) / 2 - chord[1] * height, (start[1] + end[1]) / 2 + chord[0] * height
        return [self.form.words.spell(self.form.radius, text)], center, radius

    def _arc(self) -> ArcSegment:
        if isinstance(self.segment, LineSegment):
            raise TypeError("a line has no center")
        return self.segment

    def _in_mm(self, point: Point) -> Point:
        return point[0] * self.mm, point[1] * self.mm


def _arc_deviation(arc: ArcSegment, center: Point, radius: float) -> float:
    """The largest distance of the points of an exact arc from a circle, mm: at its ends, or in line with both
    centres."""
    aside = center[0] - arc.center[0], center[1] - arc.center[1]
    angle = atan2(aside[1], aside[0])
    begin = atan2(arc.start[1] - arc.center[1], arc.start[0] - arc.center[0])
    extremes = [
        extreme for extreme in (angle, angle + pi) if ((extreme - begin) * arc.turn.sign) % tau <= radians(arc.sweep)
    ]
    points = [
        arc.start,
        arc.end,
        *((arc.center[0] + arc.radius * cos(a), arc.center[1] + arc.radius * sin(a)) for a in extremes),
    ]
    return max(abs(hypot(point[0] - center[0], point[1] - center[1]) - radius) for point in points)
