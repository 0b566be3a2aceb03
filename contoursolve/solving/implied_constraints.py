"""Equations that follow from facts taken together: nothing new, but it excludes boxes that no fact excludes alone."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

from contoursolve.geometry import (
    FIRST,
    SECOND,
    ArcLength,
    Chord,
    Contact,
    Distance,
    Extent,
    Fact,
    Figure,
    Foot,
    Heading,
    Line,
    Lookup,
    OnCircle,
    Spoke,
    Tangent,
    TangentCircles,
    TangentLine,
    Through,
    TurnBetween,
    both,
    cross,
    dot,
    line_scalars,
    rotate,
    side_of,
    step,
)
from contoursolve.solving.exact_inputs import SMALLEST


class _Known:
    """The knowledge that all facts give of points on lines and circles, as far as the unknowns of some facts tell where
    these are."""

    def __init__(self, facts: Sequence[Fact], true: Sequence[Fact], headed: Mapping[str, tuple[str, str]]) -> None:
        self.read = {name for fact in facts for name in fact.reads()}
        self.read.update(*(both(tail) for line, (_, tail) in headed.items() if line_scalars(line)[2] in self.read))
        self.feet: dict[tuple[str, str], dict[str, None]] = {}
        """Where a line touches the circle about a centre."""
        self.on_line: dict[str, dict[str, None]] = {}
        self.on_circle: dict[str, dict[str, None]] = {}
        self.radius_of: dict[tuple[str, str], str] = {}
        for line, (given, tail) in headed.items():
            rays = (fact for fact in true if isinstance(fact, Heading) and (fact.given, fact.tail) == (given, tail))
            self.on_line[line] = dict.fromkeys((tail, *(fact.head for fact in rays)))
        for fact in true:
            if isinstance(fact, Through):
                self.on_line.setdefault(fact.line, {})[fact.point] = None
            elif isinstance(fact, Foot):
                self.feet.setdefault((fact.line, fact.center), {})[fact.point] = None
            elif isinstance(fact, OnCircle):
                self.radius_of[fact.point, fact.center] = fact.radius
            if isinstance(fact, OnCircle | Spoke):
                self.on_circle.setdefault(fact.center, {})[fact.point] = None
        self.ways = {(fact.tail, fact.head) for fact in true if isinstance(fact, Distance)}
        for fact in true:
            if isinstance(fact, TangentLine):
                for point in self.touched(fact):
                    self.on_circle.setdefault(fact.center, {})[point] = None

    def points(self, line: str) -> list[str]:
        """The points on a line."""
        return [point for point in self.on_line.get(line, ()) if self.has(point)]

    def touched(self, fact: TangentLine) -> list[str]:
        """The points in which a line touches a circle."""
        feet = self.feet.get((fact.line, fact.center), ())
        return [point for point in feet if point in self.on_line.get(fact.line, ())]

    def has(self, *points: str) -> bool:
        """Whether both coordinates of each point are among the unknowns."""
        return all(self.read.issuperset(both(point)) for point in points)


def consequences(
    facts: Sequence[Fact], true: Sequence[Fact], headed: Mapping[str, tuple[str, str]], at: Lookup
) -> Iterator[Any]:
    """Expressions that are zero wherever the facts hold in their senses, and of which each reads no more than they do.

    `true` are all facts of the system that are to hold, among them those on the circles of these; `headed` are its
    lines of a given direction, as in `System`.
    """
    known = _Known(facts, true, headed)
    for fact in facts:
        yield from _of(fact, known, at)
    yield from _on_circles(true, known, at)
    for line in known.on_line:
        for one, other in combinations(known.points(line), 2):
            if line not in headed and known.read.issuperset(line_scalars(line)[:2]):
                yield cross(at.bearing(line), step(at, one, other))
    tangents = [fact for fact in true if isinstance(fact, TangentLine) and known.read.issuperset(fact.reads())]
    for first, second in combinations(tangents, 2):
        if (first.center, first.radius) == (second.center, second.radius):
            yield from _two_tangents(first, second, known, at)


def _on_circles(true: Sequence[Fact], known: _Known, at: Lookup) -> Iterator[Any]:
    """The equations that every two points of a circle give: of a large one how their chord runs, and of one far away
    how long it is, which the distances from its centre do not."""
    for center, points in known.on_circle.items():
        for one, other in combinations(points, 2):
            if known.has(center, one, other):
                # The centre lies on the perpendicular bisector.
                first, second = step(at, center, one), step(at, center, other)
                yield dot(step(at, one, other), (first[0] + second[0], first[1] + second[1]))
    for (first_fact, one), (second_fact, other) in combinations(_directions(true, known), 2):
        is_chord = first_fact.center == second_fact.center and one != other and known.has(one, other)
        if is_chord and first_fact.radius == second_fact.radius in known.read:
            # A chord is the difference of two radii, and square to the sum of their directions. It is read the way
            # round in which its length is stated, so that both narrow the same difference.
            ways = {one: _direction(first_fact, at), other: _direction(second_fact, at)}
            tail, head = (other, one) if (other, one) in known.ways else (one, other)
            chord, radius = step(at, tail, head), at.radius(first_fact.radius)
            yield dot(chord, (ways[one][0] + ways[other][0], ways[one][1] + ways[other][1]))
            for axis in (FIRST, SECOND):
                yield chord[axis] - radius * (ways[head][axis] - ways[tail][axis])


def _of(fact: Fact, known: _Known, at: Lookup) -> Iterator[Any]:
    """The equations that follow from one fact, together with the points on its lines and circles."""
    radius_of = known.radius_of
    match fact:
        case ArcLength(tail=tail, head=head, center=center, radius=radius) if (
            radius == radius_of.get((tail, center)) == radius_of.get((head, center))
        ):
            yield from _arc(fact, at)
        case TurnBetween(first=first, second=second) if not isinstance(first, Chord):
            ends = [each for each in (first, second) if isinstance(each, Tangent)]
            if all(radius_of.get((each.point, each.center)) == each.radius for each in ends):
                yield from _turn(fact, at)
        case Extent(line=line, tail=tail, head=head) if {tail, head} <= known.on_line.get(line, {}).keys():
            yield from _span(fact, at)
        case TangentLine(line=line, center=center):
            touched = known.touched(fact)
            for point in known.points(line):
                if point in touched:
                    yield from _spoke(fact, point, at)
                else:
                    aside = cross(at.bearing(line), step(at, point, center))
                    yield aside - side_of(fact.side, at) * at.radius(fact.radius)
        case TangentCircles(first=(one, size), second=(other, other_size)):
            between = step(at, one, other)
            reach = at.radius(size) + side_of(fact.side, at) * at.radius(other_size)
            yield dot(between, between) - reach * reach
        case Contact(point=point, first=one, second=other):
            radii = [radius_of.get((point, center), "") for center in (one, other)]
            if all(radius in known.read for radius in radii):
                yield from _contact(fact, radii, at)


def _two_tangents(first: TangentLine, second: TangentLine, known: _Known, at: Lookup) -> Iterator[Any]:
    """The centre of a circle that touches two lines lies on the bisector where these meet."""
    one, other = at.bearing(first.line), at.bearing(second.line)
    sides = side_of(first.side, at) * side_of(second.side, at)
    along = one[FIRST] + sides * other[FIRST], one[SECOND] + sides * other[SECOND]
    for point in known.points(first.line):
        if point in known.points(second.line):
            yield dot(step(at, point, first.center), along)


def _directions(true: Sequence[Fact], known: _Known) -> Iterator[tuple[TangentLine | Spoke, str]]:
    """The points on circles that lie in a direction from the centre which a fact tells, each with that fact."""
    for fact in true:
        if isinstance(fact, Spoke) and fact.axis == FIRST:
            yield fact, fact.point
        elif isinstance(fact, TangentLine) and known.read.issuperset(fact.reads()):
            yield from ((fact, point) for point in known.touched(fact))


def _direction(fact: TangentLine | Spoke, at: Lookup) -> tuple[Any, Any]:
    """The direction from the centre of a circle to a point on it."""
    if isinstance(fact, Spoke):
        return fact.direction(at)
    cosine, sine = at.bearing(fact.line)
    side = side_of(fact.side, at)
    return side * sine, -side * cosine


def _contact(fact: Contact, radii: Sequence[str], at: Lookup) -> Iterator[Any]:
    """From one centre to the point is r1, from there to the other in the same direction r2, or back."""
    first, second = map(at.radius, radii)
    part, rest = step(at, fact.first, fact.point), step(at, fact.point, fact.second)
    for axis in (FIRST, SECOND):
        yield fact.side * second * part[axis] - rest[axis] * first


def _arc(fact: ArcLength, at: Lookup) -> Iterator[Any]:
    """Its end is its begin turned about the centre; its chord is twice the radius times the sine of half the sweep."""
    radius = at.radius(fact.radius)
    cosine, sine = at.rotation(at.amount(fact.given) / radius)
    begin, end = step(at, fact.center, fact.tail), step(at, fact.center, fact.head)
    turned = rotate(begin, (cosine, fact.turn.sign * sine))
    yield turned[0] - end[0]
    yield turned[1] - end[1]
    chord = step(at, fact.tail, fact.head)
    half = 2 * radius * at.rotation(at.amount(fact.given) / (2 * radius))[1]
    yield dot(chord, chord) - half * half


def _span(fact: Extent, at: Lookup) -> Iterator[Any]:
    """From end to end of a line is its length along its direction."""
    way, bearing = step(at, fact.tail, fact.head), at.bearing(fact.line)
    for axis in (FIRST, SECOND):
        yield way[axis] - at.amount(fact.given) * bearing[axis]


def _spoke(fact: TangentLine, point: str, at: Lookup) -> Iterator[Any]:
    """From where a line touches a circle to its centre is the radius, square to the line."""
    cosine, sine = at.bearing(fact.line)
    spoke, radius = step(at, point, fact.center), side_of(fact.side, at) * at.radius(fact.radius)
    yield spoke[FIRST] + radius * sine
    yield spoke[SECOND] - radius * cosine


def _turn(fact: TurnBetween, at: Lookup) -> Iterator[Any]:
    """The second direction is the first one turned, both of the length 1."""
    first, second = rotate(fact.first.vector(at), at.direction(fact.given)), fact.second.vector(at)
    for axis in (FIRST, SECOND):
        yield first[axis] * fact.second.length(at) - second[axis] * fact.first.length(at)


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
        if isinstance(fact, Contact):
            between = step(at, fact.first, fact.second)
            yield dot(between, between) - SMALLEST * SMALLEST
