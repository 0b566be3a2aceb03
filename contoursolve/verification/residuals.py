"""What each kind of constraint says, as a table of its own: how far it is from being true at points that are claimed.

Vectors are pairs, values are numbers or NumPy arrays of them, also complex ones: the table knows nothing of where its
points come from, and has no branch that depends on them. Coordinates count from the start point, mm.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from math import atan2, cos, degrees, radians, sin
from typing import Any

import numpy
from numpy.typing import NDArray

from contoursolve import constraints as kinds
from contoursolve.model import FIRST, SECOND, Fact, Figure, Line, Profile, Unit, line_scalars, scalar

Vector = tuple[Any, Any]
Array = NDArray[Any]


@dataclass(frozen=True, slots=True)
class Sheet:
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

    def at(self, values: Array, signs: Mapping[str, Any]) -> "Place":
        """The sheet at values of its unknowns, which are the last axis; `signs` are those of the sides."""
        columns = {name: values[..., number] for number, name in enumerate(self.unknowns)}
        return Place(self, {**self.known, **columns}, signs)

    def residuals(self, facts: Sequence[Fact], values: Array, signs: Mapping[str, Any]) -> Array:
        """How far facts are from being true, mm, one a column."""
        at = self.at(values, signs)
        shape = values.shape[:-1]
        found = numpy.empty((*shape, len(facts)), values.dtype)
        for number, fact in enumerate(facts):
            found[..., number] = residual(fact, at)
        return found

    def slopes(self, facts: Sequence[Fact], values: Array, signs: Mapping[str, Any]) -> Array:
        """The derivatives of facts (rows) by the unknowns (columns), by complex steps: exact but for rounding."""
        steps = values[..., None, :] + _STEP * 1j * numpy.eye(len(self.unknowns))
        signs = {name: sign[..., None] if isinstance(sign, numpy.ndarray) else sign for name, sign in signs.items()}
        return numpy.swapaxes(self.residuals(facts, steps, signs).imag / _STEP, -1, -2)


_STEP = 1e-30


@dataclass(frozen=True, slots=True)
class Place:
    """Points, radii and directions by their names, at some values."""

    sheet: Sheet
    scalars: Mapping[str, Any]
    signs: Mapping[str, Any]

    def point(self, name: str) -> Vector:
        return self.scalars[scalar(name, FIRST)], self.scalars[scalar(name, SECOND)]

    def size(self, name: str) -> Any:
        return self.scalars[name]

    def way(self, tail: str, head: str) -> Vector:
        (a, b), (c, d) = self.point(tail), self.point(head)
        return c - a, d - b

    def along(self, line: str) -> Vector:
        """The direction of a line."""
        if line in self.sheet.headed:
            return self.sheet.directions[self.sheet.headed[line][0]]
        cosine, sine, _ = line_scalars(line)
        return self.scalars[cosine], self.scalars[sine]

    def left(self, line: str, point: str) -> Any:
        """How far to the left of a line a point lies, mm."""
        if line in self.sheet.headed:
            return cross(self.along(line), self.way(self.sheet.headed[line][1], point))
        return cross(self.along(line), self.point(point)) - self.scalars[line_scalars(line)[2]]

    def side(self, side: str | int) -> Any:
        return self.signs[side] if isinstance(side, str) else side

    def travel(self, of: Any) -> Vector:
        """The direction in which an element is travelled (`Along` or `Tangent`)."""
        if isinstance(of, kinds.Along):
            return self.along(of.line)
        first, second = unit(self.way(of.center, of.point))
        return -of.turn.sign * second, of.turn.sign * first


def dot(a: Vector, b: Vector) -> Any:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1]


def cross(a: Vector, b: Vector) -> Any:
    """Vector product; positive where b points to the left of a."""
    return a[0] * b[1] - a[1] * b[0]


def norm(a: Vector) -> Any:
    """Length of a vector, analytic also for complex steps."""
    return numpy.sqrt(a[0] * a[0] + a[1] * a[1])


def unit(a: Vector) -> Vector:
    """Direction of a vector."""
    length = norm(a)
    return a[0] / length, a[1] / length


def turned(a: Vector, by: Vector) -> Vector:
    """A vector turned by the angle of a direction."""
    return a[0] * by[0] - a[1] * by[1], a[0] * by[1] + a[1] * by[0]


def _arc_end(fact: Any, at: Place, length: Any) -> Vector:
    """The spoke at which an arc of a length ends."""
    angle = length / at.size(fact.radius)
    return turned(at.way(fact.center, fact.tail), (numpy.cos(angle), fact.turn.sign * numpy.sin(angle)))


def _swept(fact: Any, at: Place) -> float:
    begin, end = at.way(fact.center, fact.tail), at.way(fact.center, fact.head)
    return float(at.size(fact.radius) * (atan2(fact.turn.sign * cross(begin, end), dot(begin, end)) % (2 * numpy.pi)))


def _touching(fact: Any, at: Place) -> Any:
    """Circles that touch: from outside (+1), or one inside the other."""
    (center, radius), (other, size) = fact.first, fact.second
    distance, outside = norm(at.way(center, other)), at.side(fact.side)
    one, two = at.size(radius), at.size(size)
    # The larger radius less the smaller one, without a branch: the root of a square.
    return distance - (1 + outside) / 2 * (one + two) - (1 - outside) / 2 * numpy.sqrt((one - two) ** 2)


def _inside(fact: Any, at: Place) -> Any:
    """How far the centre of a rounding must lie from that of the arc that it touches; negative where beyond it."""
    return at.size(fact.arc[1]) - fact.turn.sign * at.side(fact.side) * at.size(fact.radius)


Formula = Callable[[Any, Place], Any]

MEASURED: Mapping[type, Formula] = {
    kinds.Coordinate: lambda fact, at: at.point(fact.point)[fact.axis],
    kinds.Offset: lambda fact, at: at.way(fact.origin, fact.point)[fact.axis],
    kinds.Radius: lambda fact, at: at.size(fact.radius),
    kinds.Distance: lambda fact, at: norm(at.way(fact.tail, fact.head)),
    kinds.Extent: lambda fact, at: dot(at.along(fact.line), at.way(fact.tail, fact.head)),
}
"""Facts that state a length or a coordinate: what they would have to state, mm."""

HEADED: Mapping[type, Callable[[Any, Place], tuple[Vector, Vector]]] = {
    kinds.Heading: lambda fact, at: ((1.0, 0.0), at.way(fact.tail, fact.head)),
    kinds.Directed: lambda fact, at: ((1.0, 0.0), at.along(fact.line)),
    kinds.TurnBetween: lambda fact, at: (at.travel(fact.first), at.travel(fact.second)),
}
"""Facts that state an angle: between which vectors."""

OTHERS: Mapping[type, Formula] = {
    kinds.Level: lambda fact, at: at.way(fact.origin, fact.point)[fact.axis],
    kinds.Collinear: lambda fact, at: cross(unit(at.way(fact.tail, fact.through)), at.way(fact.tail, fact.point)),
    kinds.OnCircle: lambda fact, at: norm(at.way(fact.center, fact.point)) - at.size(fact.radius),
    kinds.EqualRadii: lambda fact, at: at.size(fact.first) - at.size(fact.second),
    kinds.EqualDistances: lambda fact, at: norm(at.way(*fact.first)) - norm(at.way(*fact.second)),
    kinds.TangentCircles: _touching,
    kinds.Contact: lambda fact, at: cross(unit(at.way(fact.first, fact.second)), at.way(fact.first, fact.point)),
    kinds.ArcLength: lambda fact, at: (
        cross(_arc_end(fact, at, at.sheet.amounts[fact.given]), at.way(fact.center, fact.head)) / at.size(fact.radius)
    ),
    kinds.TangentArc: lambda fact, at: (
        # Also where the rounding is larger than the arc, whose centre it then has beyond its own.
        norm(at.way(fact.arc[0], fact.center)) - numpy.sqrt(_inside(fact, at) ** 2)
    ),
    kinds.ArcContact: lambda fact, at: cross(unit(at.way(fact.arc[0], fact.point)), at.way(fact.arc[0], fact.center)),
    kinds.Setback: lambda fact, at: (
        fact.way * dot(at.along(fact.line), at.way(fact.point, fact.corner)) - at.size(fact.size)
    ),
    kinds.ChordSetback: lambda fact, at: norm(at.way(fact.point, fact.corner)) - at.size(fact.size),
    kinds.UnitDirection: lambda fact, at: norm(at.along(fact.line)) - 1,
    kinds.Through: lambda fact, at: at.left(fact.line, fact.point),
    kinds.Foot: lambda fact, at: dot(at.along(fact.line), at.way(fact.center, fact.point)),
    kinds.Parallel: lambda fact, at: at.along(fact.line)[1 - fact.axis],
    kinds.TangentLine: lambda fact, at: at.left(fact.line, fact.center) - at.side(fact.side) * at.size(fact.radius),
    kinds.ChamferLeg: lambda fact, at: (
        at.way(fact.begin, fact.end)[fact.axis] - fact.share * at.side(fact.side) * at.size(fact.size)
    ),
}
"""Facts without a value of their own: how far they are from being true, mm (1 for a direction)."""

SENSES: Mapping[type, Callable[[Any, Place], tuple[Any, ...]]] = {
    kinds.Directed: lambda fact, at: (dot(at.sheet.directions[fact.given], at.along(fact.line)),),
    kinds.TurnBetween: lambda fact, at: (
        dot(turned(at.travel(fact.first), at.sheet.directions[fact.given]), at.travel(fact.second)),
    ),
    kinds.Contact: lambda fact, at: (fact.side * dot(at.way(fact.first, fact.point), at.way(fact.point, fact.second)),),
    kinds.ArcLength: lambda fact, at: (
        dot(_arc_end(fact, at, at.sheet.amounts[fact.given]), at.way(fact.center, fact.head)),
        2 * numpy.pi * at.size(fact.radius) - at.sheet.amounts[fact.given],
    ),
    kinds.ArcContact: lambda fact, at: (
        _inside(fact, at) * dot(at.way(fact.arc[0], fact.point), at.way(fact.arc[0], fact.center)),
        fact.way * fact.turn.sign * cross(at.way(fact.arc[0], fact.point), at.way(fact.arc[0], fact.corner)),
    ),
    kinds.ChordSetback: lambda fact, at: (
        fact.way * fact.turn.sign * cross(at.way(fact.center, fact.point), at.way(fact.center, fact.corner)),
    ),
    kinds.Foot: lambda fact, at: (
        (fact.way * dot(at.along(fact.line), at.way(fact.point, fact.corner)),) if fact.corner else ()
    ),
    kinds.Parallel: lambda fact, at: (at.along(fact.line)[fact.axis] * _advance(fact, at),),
    kinds.ChamferLeg: lambda fact, at: (
        at.side(fact.side)
        * (sum(at.along(line)[fact.axis] for line in fact.between) if fact.between else _advance(fact, at)),
    ),
}
"""What must not be negative besides, because the formula alone is true of the opposite as well."""


def _advance(fact: Any, at: Place) -> Any:
    """How a path advances along an axis, by the first of its parts that moves along it at all."""
    parts = [at.way(*each) if len(each) > 1 else at.along(each[0]) for each in fact.advance]
    return next((each[fact.axis] for each in parts if abs(each[fact.axis]) > _NO_ADVANCE), 0.0)


_NO_ADVANCE = 1e-9
"""mm."""


def residual(fact: Fact, at: Place) -> Any:
    """How far a fact is from being true, mm (1 for a direction). Raises KeyError for a kind that the table lacks."""
    kind = type(fact)
    if kind in MEASURED:
        return MEASURED[kind](fact, at) - at.sheet.amounts[fact.given]
    if kind in HEADED:
        first, second = HEADED[kind](fact, at)
        return cross(turned(first, at.sheet.directions[fact.given]), second)
    return OTHERS[kind](fact, at)


def senses(fact: Fact, at: Place) -> tuple[float, ...]:
    """What must not be negative where a fact holds."""
    own = SENSES.get(type(fact))
    return tuple(float(each) for each in own(fact, at)) if own else ()


def measured(fact: Fact, at: Place) -> tuple[float, bool, float]:
    """What a fact would have to state, in mm (of a coordinate the program's own) or degrees; whether it is an angle;
    over what length (mm) that is known."""
    kind = type(fact)
    if kind in HEADED:
        first, second = HEADED[kind](fact, at)
        reach = float(norm(second)) if kind is kinds.Heading else 1.0
        return degrees(atan2(cross(first, second), dot(first, second))), True, reach
    value = _swept(fact, at) if kind is kinds.ArcLength else float(MEASURED[kind](fact, at))
    shift = at.sheet.origin[fact.axis] if isinstance(fact, kinds.Coordinate) else Decimal(0)
    return float(Decimal(value) + shift), False, 0.0


def direction(angle: Decimal) -> Vector:
    """Cosine and sine of an angle in degrees, exact along the axes."""
    quarters, rest = divmod(angle % 360 + (360 if angle % 360 < 0 else 0), 90)
    found = (cos(radians(float(rest))), sin(radians(float(rest)))) if rest else (1.0, 0.0)
    return turned(found, ((1, 0), (0, 1), (-1, 0), (0, -1))[int(quarters) % 4])


def sheet_of(profile: Profile) -> Sheet:
    """The sheet of a profile, counted from its start point, or from zero where that is not known."""
    figure, origin = profile.figure, tuple(value or Decimal(0) for value in profile.start.values)
    absolute = {fact.given: fact.axis for fact in _coordinates(profile)}
    absolute |= {scalar(place, axis): axis for place in figure.places for axis in (FIRST, SECOND)}
    amounts, directions = {}, {}
    for name, given in profile.givens.items():
        if given.unit is Unit.DEGREE:
            directions[name] = direction(given.value)
        else:
            amounts[name] = float(given.value - (origin[absolute[name]] if name in absolute else 0))
    names = [scalar(point, axis) for point in figure.points for axis in (FIRST, SECOND)]
    names += [*figure.radii, *(name for line in figure.carriers for name in line_scalars(line))]
    known = {scalar(figure.start, axis): 0.0 for axis in (FIRST, SECOND)}
    known |= {name: amounts[name] for place in figure.places for name in (scalar(place, FIRST), scalar(place, SECOND))}
    known |= {name: amounts[name] for name in figure.known_radii}
    lines = [each for each in (*figure.path, *figure.lines) if isinstance(each, Line) and each.heading]
    headed = {line.name: (line.heading or "", line.tail) for line in lines if line.name not in figure.carriers}
    return Sheet(figure, profile.facts, tuple(names), known, amounts, directions, headed, (origin[0], origin[1]))


def _coordinates(profile: Profile) -> list[kinds.Coordinate]:
    facts = (*profile.facts, *profile.ignored, *(question.fact for question in profile.questions))
    return [fact for fact in facts if isinstance(fact, kinds.Coordinate)]
