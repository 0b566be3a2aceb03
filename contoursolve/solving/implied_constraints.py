"""What follows from facts taken together: nothing new, but it excludes boxes that no fact excludes alone."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

from contoursolve.geometry import (
    FIRST,
    SECOND,
    ArcLength,
    Chord,
    Contact,
    Extent,
    Fact,
    Figure,
    Foot,
    Line,
    Lookup,
    OnCircle,
    Tangent,
    TangentCircles,
    TangentLine,
    Through,
    TurnBetween,
    line_scalars,
)
from contoursolve.geometry.system import both, dot, rotate, step
from contoursolve.geometry.touching import side_of
from contoursolve.solving.exact_inputs import SMALLEST


def consequences(facts: Sequence[Fact], true: Sequence[Fact], at: Lookup) -> Iterator[Any]:
    """Expressions that are zero wherever the facts hold in their senses, and of which each reads no more than they do.

    `true` are all facts of the system that are to hold, among them those on the circles of these.
    """
    circles = [fact for fact in true if isinstance(fact, OnCircle)]
    radius_of = {(fact.point, fact.center): fact.radius for fact in circles}
    on_line = {(fact.line, fact.point) for fact in true if isinstance(fact, Through)}
    feet = [fact for fact in true if isinstance(fact, Foot)]
    read = {name for fact in facts for name in fact.reads()}
    for fact in facts:
        match fact:
            case ArcLength(tail=tail, head=head, center=center, radius=radius) if (
                radius == radius_of.get((tail, center)) == radius_of.get((head, center))
            ):
                yield from _arc(fact, at)
            case TurnBetween(first=first, second=second) if not isinstance(first, Chord):
                ends = [each for each in (first, second) if isinstance(each, Tangent)]
                if all(radius_of.get((each.point, each.center)) == each.radius for each in ends):
                    yield from _turn(fact, at)
            case Extent(line=line, tail=tail, head=head) if {(line, tail), (line, head)} <= on_line:
                yield from _span(fact, at)
            case TangentLine(line=line, center=center):
                for point in (foot.point for foot in feet if (foot.line, foot.center) == (line, center)):
                    if (line, point) in on_line and set(both(point)) <= read:
                        yield from _spoke(fact, point, at)
            case TangentCircles(first=(one, size), second=(other, other_size)):
                between = step(at, one, other)
                reach = at.radius(size) + side_of(fact.side, at) * at.radius(other_size)
                yield dot(between, between) - reach * reach
            case Contact(point=point, first=one, second=other):
                radii = [radius_of.get((point, center), "") for center in (one, other)]
                if all(radius in read for radius in radii):
                    yield from _contact(fact, radii, at)
    yield from _chords([fact for fact in facts if isinstance(fact, OnCircle)], at)


def _chords(ends: Sequence[OnCircle], at: Lookup) -> Iterator[Any]:
    """The centre of a circle lies on the perpendicular bisector of every two of its points."""
    for one_end, other_end in combinations(ends, 2):
        if (one_end.center, one_end.radius) == (other_end.center, other_end.radius):
            spokes = [step(at, one_end.center, each.point) for each in (one_end, other_end)]
            chord = step(at, one_end.point, other_end.point)
            yield dot(chord, (spokes[0][0] + spokes[1][0], spokes[0][1] + spokes[1][1]))


def _contact(fact: Contact, radii: Sequence[str], at: Lookup) -> Iterator[Any]:
    """From one centre through the point to the other: r1 to the point, r1 + side * r2 in all."""
    first, second = map(at.radius, radii)
    part, whole = step(at, fact.first, fact.point), step(at, fact.first, fact.second)
    for axis in (FIRST, SECOND):
        yield part[axis] * (first + fact.side * second) - whole[axis] * first


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
