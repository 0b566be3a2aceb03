"""Statements as the text that the grammar reads."""

from decimal import Decimal

from contoursolve.model import Length, Plane
from contoursolve.statements.meeting import MeetsLine
from contoursolve.statements.statement import (
    CircleAt,
    DirectionIs,
    EqualLengths,
    EqualSizes,
    LengthIs,
    LineAt,
    PassesThrough,
    Place,
    PointIs,
    RadiusIs,
    Statement,
    StraightIs,
    Touches,
    TurnIs,
)

_OF: dict[type, tuple[str, str]] = {
    LengthIs: ("length of", "element"),
    StraightIs: ("straight part of", "line"),
    DirectionIs: ("direction of", "line"),
    RadiusIs: ("radius of", "element"),
}
"""What each is called, and the field that names what it is of."""
_EQUAL = {EqualLengths: "length of", EqualSizes: "radius of"}
_ANGLES = (DirectionIs, TurnIs)


def write_statement(statement: Statement, plane: Plane, unit: Length) -> str:
    """The text that states it in a program of this plane and unit; places in brackets that a comment allows."""
    if isinstance(statement, EqualLengths | EqualSizes):
        what = _EQUAL[type(statement)]
        return f"{what} {statement.first} = {what} {statement.second}"
    if isinstance(statement, PassesThrough):
        return f"{statement.element} passes through [{_place(statement.place, plane, unit)}]"
    if isinstance(statement, Touches):
        return f"{statement.first} tangent to {_other(statement.second, plane, unit)}"
    if isinstance(statement, MeetsLine):
        return f"{statement.corner} meets {_meeting(statement, plane, unit)}"
    value: Decimal | None = getattr(statement, "value", None)
    if isinstance(statement, PointIs):
        part = f"{statement.part} of " if statement.part else ""
        shown = "?" if value is None else _length(value, unit, is_diameter=plane.diameters[statement.axis])
        return f"{plane.axes[statement.axis]} of {part}{statement.of} = {shown}"
    shown = "?" if value is None else _number(value) if isinstance(statement, _ANGLES) else _length(value, unit)
    if isinstance(statement, TurnIs):
        return f"angle from {statement.first} to {statement.second} = {shown}"
    what, field = _OF[type(statement)]
    return f"{what} {getattr(statement, field)} = {shown}"


def _other(other: str | CircleAt | LineAt, plane: Plane, unit: Length) -> str:
    if isinstance(other, CircleAt):
        return f"circle [{_place(other.center, plane, unit)} R{_length(other.radius, unit)}]"
    if isinstance(other, LineAt):
        return f"line [{_place(other.place, plane, unit)} A{_number(other.angle)}]"
    return other


def _meeting(statement: MeetsLine, plane: Plane, unit: Length) -> str:
    line = statement.line
    if line.to is not None:
        return f"line to [{_place(line.to, plane, unit)}]"
    return "next line" if line.angle is None else f"line at {_number(line.angle)}"


def _place(place: Place, plane: Plane, unit: Length) -> str:
    axes = zip(plane.axes, place, plane.diameters, strict=True)
    return " ".join(f"{axis}{_length(value, unit, is_diameter=is_diameter)}" for axis, value, is_diameter in axes)


def _length(mm: Decimal, unit: Length, *, is_diameter: bool = False) -> str:
    return _number(mm * (2 if is_diameter else 1) / unit.in_mm)


def _number(value: Decimal) -> str:
    """All its digits, and none that say nothing."""
    text = f"{value:f}"
    return text.rstrip("0").rstrip(".") if "." in text else text
