"""What follows from facts taken together: nothing new, but it excludes boxes that no fact excludes alone."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

from contoursolve.constraints import ArcLength, Contact, OnCircle, Tangent, TangentCircles, TurnBetween
from contoursolve.constraints.equation import dot, rotate, step
from contoursolve.constraints.touching import side_of
from contoursolve.model import FIRST, SECOND, Fact, Lookup


def consequences(facts: Sequence[Fact], true: Sequence[Fact], at: Lookup) -> Iterator[Any]:
    """Expressions that are zero wherever the facts hold in their senses, and of which each reads no more than they do.

    `true` are all facts of the system that are to hold, among them those on the circles of these.
    """
    circles = [fact for fact in true if isinstance(fact, OnCircle)]
    radius_of = {(fact.point, fact.center): fact.radius for fact in circles}
    read = {name for fact in facts for name in fact.reads()}
    for fact in facts:
        match fact:
            case ArcLength(tail=tail, head=head, center=center, radius=radius):
                if radius == radius_of.get((tail, center)) == radius_of.get((head, center)):
                    yield from _arc(fact, at)
            case TurnBetween(first=first, second=second):
                ends = [each for each in (first, second) if isinstance(each, Tangent)]
                if all(radius_of.get((each.point, each.center)) == each.radius for each in ends):
                    yield from _turn(fact, at)
            case TangentCircles(first=(one, size), second=(other, other_size)):
                between = step(at, one, other)
                reach = at.radius(size) + side_of(fact.side, at) * at.radius(other_size)
                yield dot(between, between) - reach * reach
            case Contact(point=point, first=one, second=other):
                radii = [radius_of.get((point, center), "") for center in (one, other)]
                if all(radius in read for radius in radii):
                    # From one centre through the point to the other: r1 to the point, r1 + side * r2 in all.
                    first_radius, second_radius = map(at.radius, radii)
                    part, whole = step(at, one, point), step(at, one, other)
                    for axis in (FIRST, SECOND):
                        yield part[axis] * (first_radius + fact.side * second_radius) - whole[axis] * first_radius
    for one_end, other_end in combinations([fact for fact in facts if isinstance(fact, OnCircle)], 2):
        if (one_end.center, one_end.radius) == (other_end.center, other_end.radius):
            # The centre lies on the perpendicular bisector.
            spokes = [step(at, one_end.center, each.point) for each in (one_end, other_end)]
            chord = step(at, one_end.point, other_end.point)
            yield dot(chord, (spokes[0][0] + spokes[1][0], spokes[0][1] + spokes[1][1]))


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


def _turn(fact: TurnBetween, at: Lookup) -> Iterator[Any]:
    """The second direction is the first one turned, both of the length 1."""
    first, second = rotate(fact.first.vector(at), at.direction(fact.given)), fact.second.vector(at)
    for axis in (FIRST, SECOND):
        yield first[axis] * fact.second.length(at) - second[axis] * fact.first.length(at)
