"""What each kind of constraint says, as a table of its own: how far it is from being true at points that are claimed.

Vectors are pairs, values are numbers or NumPy arrays of them, also complex ones: the table knows nothing of where its
points come from, and has no branch that depends on them. Coordinates count from the start point, mm.
"""

from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from enum import Enum
from functools import partial
from math import atan2, cos, degrees, radians, sin, tau
from typing import Any

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve import geometry as kinds, tolerance
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Fact,
    Figure,
    Profile,
    Unit,
    both,
    cross,
    dot,
    headed_lines,
    line_scalars,
    rotate,
    scalar,
)

Vector = tuple[Any, Any]
Array = NDArray[Any]


class ResidualSystem(Struct, frozen=True):
    """The unknown scalars of a figure and everything that is known about it; `headed` are the lines whose direction is
    stated, each with the given that states it and with a point of the line."""

    figure: Figure
    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]
    known: Mapping[str, float]
    amounts: Mapping[str, float]
    directions: Mapping[str, Vector]
    headed: Mapping[str, tuple[str, str]]
    origin: tuple[Decimal, Decimal]

    @property
    def sides(self) -> tuple[str, ...]:
        """The names of the sides on which nothing states where two elements touch."""
        return tuple(dict.fromkeys(side for fact in self.facts for side in fact.sides()))

    @property
    def zero(self) -> Array:
        """All unknowns at 0."""
        return numpy.zeros(len(self.unknowns))

    def at(self, values: Array, signs: Mapping[str, Any]) -> "Place":
        """The figure at values of its unknowns, which are the last axis; `signs` are those of the sides."""
        columns = {name: values[..., number] for number, name in enumerate(self.unknowns)}
        return Place({**self.known, **columns}, self.amounts, self.directions, self.headed, signs)

    def residuals(self, facts: Sequence[Fact], values: Array, signs: Mapping[str, Any]) -> Array:
        """How far facts are from being true, mm, one a column."""
        at = self.at(values, signs)
        found = numpy.empty((*values.shape[:-1], len(facts)), values.dtype)
        for number, fact in enumerate(facts):
            found[..., number] = residual(fact, at)
        return found

    def jacobian(self, facts: Sequence[Fact], values: Array, signs: Mapping[str, Any]) -> Array:
        """The derivatives of facts (rows) by the unknowns (columns), by complex steps: exact but for rounding."""
        steps = values[..., None, :] + _STEP * 1j * numpy.eye(len(self.unknowns))
        signs = {name: sign[..., None] if isinstance(sign, numpy.ndarray) else sign for name, sign in signs.items()}
        return numpy.swapaxes(self.residuals(facts, steps, signs).imag / _STEP, -1, -2)

    def linearised(self, facts: Sequence[Fact]) -> tuple[Array, Array]:
        """The derivatives and the residuals of facts at zero, which are all there is to facts about lines."""
        return self.jacobian(facts, self.zero, {}), self.residuals(facts, self.zero, {})


_STEP = 1e-30


class Place(kinds.Values, frozen=True):
    """Points, radii and directions by their names, at some values."""

    def point(self, name: str) -> Vector:
        return self.scalars[scalar(name, FIRST)], self.scalars[scalar(name, SECOND)]

    def way(self, tail: str, head: str) -> Vector:
        (a, b), (c, d) = self.point(tail), self.point(head)
        return c - a, d - b

    def left(self, line: str, point: str) -> Any:
        """How far to the left of a line a point lies, mm."""
        if line in self.headed:
            return cross(self.bearing(line), self.way(self.headed[line][1], point))
        return cross(self.bearing(line), self.point(point)) - self.scalars[line_scalars(line)[2]]

    def side(self, name: str | int) -> Any:
        """+1 or -1: the side of this name, or one that is stated."""
        return self.signs[name] if isinstance(name, str) else name

    def travel(self, of: Any) -> Vector:
        """The direction in which an element is travelled (`Along` or `Tangent`)."""
        if isinstance(of, kinds.Chord):
            return unit(self.way(of.tail, of.head))
        if isinstance(of, kinds.Along):
            return self.bearing(of.line)
        first, second = unit(self.way(of.center, of.point))
        return -of.turn.sign * second, of.turn.sign * first

    def arc_end(self, fact: Any) -> Vector:
        """The spoke at which an arc of a stated length ends."""
        angle = self.amounts[fact.given] / self.radius(fact.radius)
        return rotate(self.way(fact.center, fact.tail), (numpy.cos(angle), fact.turn.sign * numpy.sin(angle)))

    def inside(self, fact: Any) -> Any:
        """How far the centre of a rounding lies from that of the arc that it touches; negative where beyond it."""
        return self.radius(fact.arc[1]) - fact.turn.sign * self.side(fact.side) * self.radius(fact.radius)

    def spoke(self, fact: Any) -> Vector:
        """The direction in which a radius leads."""
        return rotate(self.directions[fact.given], ((1, 0), (0, 1), (-1, 0), (0, -1))[fact.quarters % 4])

    def advance(self, fact: Any) -> Any:
        """How a path advances along an axis: by the lines between which it is, or else by the first of its parts that
        moves along it at all."""
        if getattr(fact, "between", ()):
            return sum(self.bearing(line)[fact.axis] for line in fact.between)
        parts = [self.way(*each) if len(each) > 1 else self.bearing(each[0]) for each in fact.advance]
        return next((each[fact.axis] for each in parts if abs(each[fact.axis]) > _NO_ADVANCE), 0.0)


_NO_ADVANCE = 1e-9
"""mm."""


def norm(a: Vector) -> Any:
    """Length of a vector, analytic also for complex steps."""
    return numpy.sqrt(a[0] * a[0] + a[1] * a[1])


def unit(a: Vector) -> Vector:
    """Direction of a vector."""
    length = norm(a)
    return a[0] / length, a[1] / length


def _in_line(spoke: Vector, between: Vector) -> Any:
    """How far a point is off the line through two centres, or where these are almost one, how far the second is off
    the line from the first to the point, mm."""
    apart = norm(between)
    return cross(between, spoke) / numpy.where(abs(apart) <= tolerance.LENGTH, norm(spoke), apart)


def _touching(fact: Any, at: Place) -> Any:
    """Circles that touch: from outside (+1), or one inside the other."""
    (center, radius), (other, size) = fact.first, fact.second
    outside, one, two = at.side(fact.side), at.radius(radius), at.radius(size)
    # The larger radius less the smaller one, without a branch: the root of a square.
    inner = numpy.sqrt((one - two) ** 2)
    return norm(at.way(center, other)) - (1 + outside) / 2 * (one + two) - (1 - outside) / 2 * inner


class States(Enum):
    """What a word states with a constraint."""

    NOTHING = "nothing"
    LENGTH = "length"
    ANGLE = "angle"


Formula = Callable[[Any, Place], Any]


class Meaning(Struct, frozen=True):
    """What one kind of constraint says; `name` is what checks call it.

    `formula` is how far it is from being true, mm (1 for a direction). Where a word states a length, it is what the
    word would have to be, mm; where one states an angle, the two vectors between which that is. `positive` must not be
    negative besides, because the formula alone is true of the opposite as well.
    """

    name: str
    formula: Formula
    positive: Callable[[Any, Place], tuple[Any, ...]] = lambda *_: ()
    states: States = States.NOTHING


LENGTH, ANGLE = partial(Meaning, states=States.LENGTH), partial(Meaning, states=States.ANGLE)

MEANINGS: Mapping[type, Meaning] = {
    kinds.Coordinate: LENGTH("{axis} of {point}", lambda own, at: at.point(own.point)[own.axis]),
    kinds.Offset: LENGTH("{axis} from {origin} to {point}", lambda own, at: at.way(own.origin, own.point)[own.axis]),
    kinds.Radius: LENGTH("radius {radius}", lambda own, at: at.radius(own.radius)),
    kinds.Distance: LENGTH("distance from {tail} to {head}", lambda own, at: norm(at.way(own.tail, own.head))),
    kinds.Extent: LENGTH(
        "length of {line} from {tail} to {head}", lambda own, at: dot(at.bearing(own.line), at.way(own.tail, own.head))
    ),
    kinds.Heading: ANGLE(
        "direction of the line from {tail} to {head}", lambda own, at: ((1.0, 0.0), at.way(own.tail, own.head))
    ),
    kinds.Ray: ANGLE(
        "direction from {tail} to {head}",
        lambda own, at: ((1.0, 0.0), at.way(own.tail, own.head)),
        lambda own, at: (dot(at.directions[own.given], at.way(own.tail, own.head)),),
    ),
    kinds.RadiusStep: LENGTH("{radius} less {origin}", lambda own, at: at.radius(own.radius) - at.radius(own.origin)),
    kinds.Directed: ANGLE(
        "direction of {line}",
        lambda own, at: ((1.0, 0.0), at.bearing(own.line)),
        lambda own, at: (dot(at.directions[own.given], at.bearing(own.line)),),
    ),
    kinds.TurnBetween: ANGLE(
        "the angle between both elements",
        lambda own, at: (at.travel(own.first), at.travel(own.second)),
        lambda own, at: (dot(rotate(at.travel(own.first), at.directions[own.given]), at.travel(own.second)),),
    ),
    kinds.ArcLength: Meaning(
        "length of the arc from {tail} to {head}",
        lambda own, at: cross(at.arc_end(own), at.way(own.center, own.head)) / at.radius(own.radius),
        lambda own, at: (
            dot(at.arc_end(own), at.way(own.center, own.head)),
            tau * at.radius(own.radius) - at.amounts[own.given],
        ),
    ),
    kinds.Level: Meaning(
        "{axis} of {point} is that of {origin}", lambda own, at: at.way(own.origin, own.point)[own.axis]
    ),
    kinds.Collinear: Meaning(
        "{point} is on the line from {tail} through {through}",
        lambda own, at: cross(unit(at.way(own.tail, own.through)), at.way(own.tail, own.point)),
    ),
    kinds.OnCircle: Meaning(
        "{point} is on the circle about {center}",
        lambda own, at: norm(at.way(own.center, own.point)) - at.radius(own.radius),
    ),
    kinds.EqualRadii: Meaning("{first} is {second}", lambda own, at: at.radius(own.first) - at.radius(own.second)),
    kinds.EqualDistances: Meaning(
        "both lines are equally long", lambda own, at: norm(at.way(*own.first)) - norm(at.way(*own.second))
    ),
    kinds.TangentCircles: Meaning("both circles touch", _touching),
    kinds.PointBeside: Meaning(
        "the point is as far beside the circle as stated",
        # Inside a circle, it is no farther from it than the centre is: the distance of the two is not negative.
        lambda own, at: (
            norm(at.way(own.first[0], own.second[0]))
            - at.radius(own.second[1])
            - at.side(own.side) * at.radius(own.first[1])
        ),
    ),
    kinds.Contact: Meaning(
        "{point} is in line with {first} and {second}",
        lambda own, at: _in_line(at.way(own.first, own.point), at.way(own.first, own.second)),
        lambda own, at: (own.side * dot(at.way(own.first, own.point), at.way(own.point, own.second)),),
    ),
    kinds.TangentArc: Meaning(
        "the rounding about {center} touches the arc",
        # Also where the rounding is larger than the arc, whose centre it then has beyond its own.
        lambda own, at: norm(at.way(own.arc[0], own.center)) - numpy.sqrt(at.inside(own) ** 2),
    ),
    kinds.ArcContact: Meaning(
        "{point} is where the rounding touches the arc",
        lambda own, at: cross(unit(at.way(own.arc[0], own.point)), at.way(own.arc[0], own.center)),
        lambda own, at: (
            at.inside(own) * dot(at.way(own.arc[0], own.point), at.way(own.arc[0], own.center)),
            own.way * own.turn.sign * cross(at.way(own.arc[0], own.point), at.way(own.arc[0], own.corner)),
        ),
    ),
    kinds.Setback: Meaning(
        "{point} is its size away from {corner}",
        lambda own, at: own.way * dot(at.bearing(own.line), at.way(own.point, own.corner)) - at.radius(own.size),
    ),
    kinds.ChordSetback: Meaning(
        "{point} is its size away from {corner}",
        lambda own, at: norm(at.way(own.point, own.corner)) - at.radius(own.size),
        lambda own, at: (own.way * own.turn.sign * cross(*(at.way(own.center, to) for to in (own.point, own.corner))),),
    ),
    kinds.UnitDirection: Meaning("{line} has one direction", lambda own, at: norm(at.bearing(own.line)) - 1),
    kinds.Through: Meaning("{line} passes through {point}", lambda own, at: at.left(own.line, own.point)),
    kinds.Foot: Meaning(
        "{point} is where {line} is touched",
        lambda own, at: dot(at.bearing(own.line), at.way(own.center, own.point)),
        lambda own, at: (own.way * dot(at.bearing(own.line), at.way(own.point, own.corner)),) if own.corner else (),
    ),
    kinds.Leaving: Meaning(
        "{line} leaves the circle about {center} in {point}",
        lambda own, at: dot(at.bearing(own.line), at.way(own.center, own.point)),
        lambda own, at: (own.turn.sign * cross(at.way(own.center, own.point), at.bearing(own.line)),),
    ),
    kinds.Parallel: Meaning(
        "{line} is parallel to {axis}",
        lambda own, at: at.bearing(own.line)[1 - own.axis],
        lambda own, at: (at.bearing(own.line)[own.axis] * at.advance(own),),
    ),
    kinds.Spoke: Meaning(
        "direction of the radius from {center} to {point}",
        lambda own, at: at.way(own.center, own.point)[own.axis] - at.spoke(own)[own.axis] * at.radius(own.radius),
    ),
    kinds.ParallelLines: Meaning(
        "{first} is parallel to {second}", lambda own, at: cross(at.bearing(own.first), at.bearing(own.second))
    ),
    kinds.TangentLine: Meaning(
        "{line} touches the circle about {center}",
        lambda own, at: at.left(own.line, own.center) - at.side(own.side) * at.radius(own.radius),
    ),
    kinds.ChamferLeg: Meaning(
        "extent of the bevel from {begin} to {end} along {axis}",
        lambda own, at: at.way(own.begin, own.end)[own.axis] - own.share * at.side(own.side) * at.radius(own.size),
        lambda own, at: (at.side(own.side) * at.advance(own),),
    ),
}


def residual(fact: Fact, at: Place) -> Any:
    """How far a fact is from being true, mm (1 for a direction). Raises KeyError for a kind that the table lacks."""
    meaning = MEANINGS[type(fact)]
    found = meaning.formula(fact, at)
    if meaning.states is States.LENGTH:
        return found - at.amounts[fact.given]
    if meaning.states is States.ANGLE:
        return cross(rotate(found[0], at.directions[fact.given]), found[1])
    return found


def senses(fact: Fact, at: Place) -> tuple[float, ...]:
    """What must not be negative where a fact holds."""
    return tuple(map(float, MEANINGS[type(fact)].positive(fact, at)))


def measured(fact: Fact, at: Place, origin: tuple[Decimal, Decimal]) -> tuple[float, bool, float]:
    """What a fact would have to state, in mm (of a coordinate the program's own) or degrees; whether it is an angle;
    over what length (mm) that is known."""
    if isinstance(fact, kinds.ArcLength):
        begin, end = at.way(fact.center, fact.tail), at.way(fact.center, fact.head)
        swept = atan2(fact.turn.sign * cross(begin, end), dot(begin, end)) % tau
        return float(at.radius(fact.radius) * swept), False, 0.0
    meaning = MEANINGS[type(fact)]
    found = meaning.formula(fact, at)
    if meaning.states is States.ANGLE:
        reach = float(norm(found[1])) if isinstance(fact, kinds.Heading) else 1.0
        return degrees(atan2(cross(*found), dot(*found))), True, reach
    shift = origin[fact.axis] if isinstance(fact, kinds.Coordinate) else Decimal(0)
    return float(Decimal(float(found)) + shift), False, 0.0


def direction(angle: Decimal) -> Vector:
    """Cosine and sine of an angle in degrees, exact along the axes."""
    quarters, rest = divmod(angle % 360 + (360 if angle % 360 < 0 else 0), 90)
    found = (cos(radians(float(rest))), sin(radians(float(rest)))) if rest else (1.0, 0.0)
    return rotate(found, ((1, 0), (0, 1), (-1, 0), (0, -1))[int(quarters) % 4])


def system_of(profile: Profile) -> ResidualSystem:
    """The system of a profile, counted from its start point, or from zero where that is not known."""
    figure, origin = profile.figure, tuple(value or Decimal(0) for value in profile.start.values)
    facts = (*profile.facts, *profile.ignored, *(question.fact for question in profile.questions))
    absolute = {fact.given: fact.axis for fact in facts if isinstance(fact, kinds.Coordinate)}
    absolute |= {scalar(place, axis): axis for place in figure.places for axis in (FIRST, SECOND)}
    amounts, directions = {}, {}
    for name, given in profile.givens.items():
        if given.unit is Unit.DEGREE:
            directions[name] = direction(given.value)
        else:
            amounts[name] = float(given.value - (origin[absolute[name]] if name in absolute else 0))
    names = [*both(*figure.points), *figure.radii, *(name for line in figure.carriers for name in line_scalars(line))]
    known = dict.fromkeys(both(figure.start), 0.0)
    known |= {name: amounts[name] for name in (*both(*figure.places), *figure.known_radii)}
    return ResidualSystem(
        figure, profile.facts, tuple(names), known, amounts, directions, headed_lines(figure), (origin[0], origin[1])
    )
