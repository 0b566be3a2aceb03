"""What a further fact states, measured in a drawing: lengths, angles, coordinates, contacts."""

from collections.abc import Iterator
from dataclasses import astuple, dataclass
from decimal import Decimal
from math import inf

from contoursolve.statements import (
    CircleAt,
    DirectionIs,
    EqualLengths,
    EqualSizes,
    LengthIs,
    LineAt,
    MeetsLine,
    PassesThrough,
    PointIs,
    RadiusIs,
    StraightIs,
    Touches,
    TurnIs,
)
from contoursolve.verification.drawing import Drawing, Straight, UnmeasurableError
from contoursolve.verification.measure import angle_between, cross, direction, dot

Origin = tuple[Decimal, Decimal]
"""The start point, mm, as the program states it."""

Valued = LengthIs | StraightIs | DirectionIs | TurnIs | PointIs | RadiusIs
"""Facts with a value, which may be asked for instead."""

Fact = Valued | PassesThrough | Touches | EqualLengths | EqualSizes | MeetsLine


@dataclass(frozen=True, slots=True)
class Gap:
    """By how much a fact is untrue: `residual` (mm) has a sign, `degrees` is the same for an angle.

    `against` (mm) is how far something runs the opposite way.
    """

    residual: float
    degrees: float | None = None
    against: float = 0.0


@dataclass(frozen=True, slots=True)
class Quantity:
    """A measured value in mm or degrees; `reach` (mm) is over what length an angle is known."""

    value: float
    is_angle: bool = False
    reach: float = inf


def numbers(fact: Fact) -> Iterator[Decimal]:
    """Every number that a fact states."""
    return (part for part in _parts(astuple(fact)) if isinstance(part, Decimal))


def _parts(value: object) -> Iterator[object]:
    for each in value if isinstance(value, tuple) else ():
        yield each
        yield from _parts(each)


def quantity(fact: Valued, drawing: Drawing, origin: Origin) -> Quantity:
    """The value of what a fact is about; a coordinate as it is in the program's axes, X of a lathe as radius."""
    match fact:
        case LengthIs():
            return Quantity(drawing.shape(fact.element).length)
        case StraightIs():
            line = drawing.line(fact.line)
            return Quantity(dot(line.along, line.end - line.begin))
        case DirectionIs():
            line = drawing.line(fact.line)
            return Quantity(angle_between(1, line.along), is_angle=True, reach=line.length)
        case TurnIs():
            (before, reach), (after, other) = _travels(fact, drawing)
            return Quantity(angle_between(before, after), is_angle=True, reach=min(reach, other))
        case PointIs():
            at = drawing.point(fact.part, fact.of)
            return Quantity(float(Decimal((at.real, at.imag)[fact.axis]) + origin[fact.axis]))
        case RadiusIs():
            return Quantity(drawing.size(fact.element))


def gap(fact: Fact, drawing: Drawing, origin: Origin) -> Gap:
    """By how much a fact that has a value is untrue. Raises UnmeasurableError if it is about nothing in the drawing."""
    match fact:
        case PointIs(value=Decimal() as value):
            at = drawing.point(fact.part, fact.of)
            return Gap((at.real, at.imag)[fact.axis] - float(value - origin[fact.axis]))
        case DirectionIs(value=Decimal() as value):
            line = drawing.line(fact.line)
            return _angle(direction(value), line.along, line.length)
        case TurnIs(value=Decimal() as value):
            (before, reach), (after, other) = _travels(fact, drawing)
            return _angle(before * direction(value), after, min(reach, other))
        case (
            LengthIs(value=Decimal() as value)
            | StraightIs(value=Decimal() as value)
            | RadiusIs(value=Decimal() as value)
        ):
            return Gap(quantity(fact, drawing, origin).value - float(value))
        case PassesThrough():
            place = _place(fact.place, origin)
            shape = drawing.shape(fact.element)
            if isinstance(shape, Straight):
                return Gap(cross(shape.along, place - shape.tail))
            form = drawing.round(fact.element)
            return Gap(abs(place - form.center) - form.radius)
        case EqualLengths():
            return Gap(drawing.line(fact.first).length - drawing.line(fact.second).length)
        case EqualSizes():
            return Gap(drawing.size(fact.first) - drawing.size(fact.second))
        case Touches():
            return _contact(fact, drawing, origin)
        case _:
            raise UnmeasurableError("it has no value")


def _travels(fact: TurnIs, drawing: Drawing) -> tuple[tuple[complex, float], tuple[complex, float]]:
    return drawing.travel(fact.first, fact.second), drawing.travel(fact.second, fact.first)


def _angle(wanted: complex, found: complex, reach: float) -> Gap:
    off = angle_between(wanted, found)
    return Gap(cross(wanted, found) * reach, off, max(0.0, -dot(wanted, found)) * reach)


def _place(place: tuple[Decimal, Decimal], origin: Origin) -> complex:
    return complex(*(float(value - start) for value, start in zip(place, origin, strict=True)))


def _contact(fact: Touches, drawing: Drawing, origin: Origin) -> Gap:
    """How far two elements are from touching. Neighbours must go on smoothly, too."""
    if isinstance(fact.second, str) and drawing.are_neighbours(fact.first, fact.second):
        before, after = sorted((fact.first, fact.second), key=drawing.chain.index)
        (arriving, reach), (leaving, other) = drawing.travel(before, after), drawing.travel(after, before)
        return _angle(arriving, leaving, min(reach, other))
    first, second = _carrier(fact.first, drawing, origin), _carrier(fact.second, drawing, origin)
    match first, second:
        case (_Circle() as circle, _Line() as line) | (_Line() as line, _Circle() as circle):
            return Gap(abs(cross(line.along, circle.center - line.place)) - circle.radius)
        case _Circle(), _Circle():
            distance = abs(first.center - second.center)
            outside, inside = first.radius + second.radius, abs(first.radius - second.radius)
            return Gap(min(distance - outside, distance - inside, key=abs))
        case _:
            raise UnmeasurableError("two lines cannot be tangent unless they are neighbours")


@dataclass(frozen=True, slots=True)
class _Circle:
    center: complex
    radius: float


@dataclass(frozen=True, slots=True)
class _Line:
    place: complex
    along: complex


def _carrier(of: str | CircleAt | LineAt, drawing: Drawing, origin: Origin) -> _Circle | _Line:
    """The line or circle that an element is part of."""
    match of:
        case CircleAt():
            return _Circle(_place(of.center, origin), float(of.radius))
        case LineAt():
            return _Line(_place(of.place, origin), direction(of.angle))
        case _:
            shape = drawing.shape(of)
            if isinstance(shape, Straight):
                return _Line(shape.tail, shape.along)
            form = drawing.round(of)
            return _Circle(form.center, form.radius)
