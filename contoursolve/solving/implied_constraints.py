"""Equations that follow from facts taken together: nothing new, but it excludes boxes that no fact excludes alone."""

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from functools import partial
from itertools import combinations
from typing import Any

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Clearance,
    Fact,
    Figure,
    Line,
    Lookup,
    Radial,
    both,
    cross,
    dot,
    line_scalars,
    side_of,
    step,
)
from contoursolve.solving.exact_inputs import SMALLEST


class _Known:
    """The knowledge that all facts give of points on lines and circles, as far as the unknowns of some facts tell where
    these are. An `Incidence`."""

    def __init__(self, facts: Sequence[Fact], true: Sequence[Fact], headed: Mapping[str, tuple[str, str]]) -> None:
        self.read: Set[str] = {name for fact in facts for name in fact.reads()}
        tails = (both(tail) for line, (_, tail) in headed.items() if line_scalars(line)[2] in self.read)
        self.read = self.read.union(*tails)
        self._feet: dict[tuple[str, str], dict[str, None]] = {}
        self._on_line: dict[str, dict[str, None]] = {}
        self._radius_of: dict[tuple[str, str], str] = {}
        self.on_circle: dict[tuple[str, str], dict[str, None]] = {}
        self.ways = {fact.span for fact in true if fact.span}
        for line, (given, tail) in headed.items():
            rays = (fact.heading for fact in true if fact.heading and fact.given == given)
            self._on_line[line] = dict.fromkeys((tail, *(head for begin, head in rays if begin == tail)))
        for fact in true:
            if fact.passes is not None:
                line, point = fact.passes
                self._on_line.setdefault(line, {})[point] = None
            elif fact.foot is not None:
                line, center, point = fact.foot
                self._feet.setdefault((line, center), {})[point] = None
            elif fact.circle is not None:
                self._radius_of[fact.circle.center, fact.circle.point] = fact.circle.radius
            spoke = fact.circle or fact.radial
            if spoke is not None:
                self.on_circle.setdefault((spoke.center, spoke.radius), {})[spoke.point] = None
        for each in (fact.beside for fact in true if fact.beside):
            for point in self.touched(each.line, each.center):
                self.on_circle.setdefault((each.center, each.radius), {})[point] = None

    @property
    def lines(self) -> Iterable[str]:
        """The lines of which points are known."""
        return self._on_line

    def tangents(self, true: Sequence[Fact]) -> Iterator[Clearance]:
        """The lines that touch circles, as far as all of it is among the scalars."""
        for fact in true:
            if fact.beside is not None and fact.beside.line and self.read >= {*fact.reads()}:
                yield fact.beside

    def radials(self, true: Sequence[Fact]) -> Iterator[Radial]:
        """The points of circles that lie in a direction from the centre which a fact tells."""
        for fact in true:
            if fact.radial is not None:
                yield fact.radial
            for each in self.tangents([fact]):
                for point in self.touched(each.line, each.center):
                    yield Radial(each.center, each.radius, point, partial(_toward, each))

    def is_on(self, center: str, radius: str, *points: str) -> bool:
        """Whether facts put points on the circle about a centre, with that radius."""
        return all(self._radius_of.get((center, point)) == radius for point in points)

    def radius_of(self, center: str, point: str) -> str:
        """The radius of the circle about a centre on which facts put a point; empty if none does."""
        return self._radius_of.get((center, point), "")

    def on_line(self, line: str) -> Set[str]:
        """All points on a line."""
        return self._on_line.get(line, {}).keys()

    def points(self, line: str) -> list[str]:
        """The points on a line whose coordinates are among the unknowns."""
        return [point for point in self._on_line.get(line, ()) if self.has(point)]

    def touched(self, line: str, center: str) -> list[str]:
        """The points in which a line touches the circle about a centre."""
        feet = self._feet.get((line, center), ())
        return [point for point in feet if point in self._on_line.get(line, ())]

    def has(self, *points: str) -> bool:
        """Whether both coordinates of each point are among the unknowns."""
        return all(self.read >= {*both(point)} for point in points)


def consequences(
    facts: Sequence[Fact], true: Sequence[Fact], headed: Mapping[str, tuple[str, str]], at: Lookup
) -> Iterator[Any]:
    """Expressions that are zero wherever the facts hold in their senses, and of which each reads no more than they do.

    `true` are all facts of the system that are to hold, among them those on the circles of these; `headed` are its
    lines of a given direction, as in `System`.
    """
    known = _Known(facts, true, headed)
    for fact in facts:
        yield from fact.follows(known, at)
    yield from _on_circles(true, known, at)
    for line in known.lines:
        for one, other in combinations(known.points(line), 2):
            if line not in headed and known.read >= {*line_scalars(line)[:2]}:
                yield cross(at.bearing(line), step(at, one, other))
    for first, second in combinations(known.tangents(true), 2):
        if (first.center, first.radius) == (second.center, second.radius):
            yield from _two_tangents(first, second, known, at)


def _on_circles(true: Sequence[Fact], known: _Known, at: Lookup) -> Iterator[Any]:
    """The equations that every two points of a circle give: of a large one how their chord runs, and of one far away
    how long it is, which the distances from its centre do not."""
    for (center, _), points in known.on_circle.items():
        for one, other in combinations(points, 2):
            if known.has(center, one, other):
                # The centre lies on the perpendicular bisector.
                first, second = step(at, center, one), step(at, center, other)
                yield dot(step(at, one, other), (first[0] + second[0], first[1] + second[1]))
    for this, that in combinations(known.radials(true), 2):
        is_chord = this.center == that.center and this.point != that.point and known.has(this.point, that.point)
        if is_chord and this.radius == that.radius in known.read:
            # A chord is the difference of two radii, and square to the sum of their directions. It is read the way
            # round in which its length is stated, so that both narrow the same difference.
            tail, head = (that, this) if (that.point, this.point) in known.ways else (this, that)
            chord, radius = step(at, tail.point, head.point), at.radius(this.radius)
            start, end = tail.direction(at), head.direction(at)
            yield dot(chord, (start[FIRST] + end[FIRST], start[SECOND] + end[SECOND]))
            yield from (chord[axis] - radius * (end[axis] - start[axis]) for axis in (FIRST, SECOND))


def _toward(tangent: Clearance, at: Lookup) -> tuple[Any, Any]:
    """The direction from the centre of a circle to where a line touches it."""
    (cosine, sine), side = at.bearing(tangent.line), side_of(tangent.side, at)
    return side * sine, -side * cosine


def _two_tangents(first: Clearance, second: Clearance, known: _Known, at: Lookup) -> Iterator[Any]:
    """The centre of a circle that touches two lines lies on the bisector where these meet."""
    one, other = at.bearing(first.line), at.bearing(second.line)
    sides = side_of(first.side, at) * side_of(second.side, at)
    along = one[FIRST] + sides * other[FIRST], one[SECOND] + sides * other[SECOND]
    for point in known.points(first.line):
        if point in known.points(second.line):
            yield dot(step(at, point, first.center), along)


def necessities(figure: Figure, facts: Sequence[Fact], at: Lookup) -> Iterator[Any]:
    """Expressions that no contour makes negative, of what the facts read: how far each line runs along its direction,
    and how far apart the centres of neighbours that touch are, from the least that is searched for on."""
    read = {name for fact in facts for name in fact.reads()}
    # Only facts whose sense is about what they read: that of the others depends on other groups.
    yield from (sense for fact in facts if fact.sense_reads() == fact.reads() for sense in fact.senses(at))
    for line in (*figure.path, *figure.lines):
        if not isinstance(line, Line) or line.name not in figure.carriers:
            continue
        if not line.tail:
            if line_scalars(line.name)[0] in read:
                yield at.bearing(line.name)[FIRST]
        elif {*line_scalars(line.name)[:2], *both(line.tail, line.head)} - {*both(figure.start)} <= read:
            yield dot(step(at, line.tail, line.head), at.bearing(line.name)) - SMALLEST
    for fact in facts:
        if fact.centers is not None:
            between = step(at, *fact.centers)
            yield dot(between, between) - SMALLEST * SMALLEST
