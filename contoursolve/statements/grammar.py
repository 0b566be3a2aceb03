"""The textual form of statements: read with the place of every mistake, and written again."""

import re
from collections.abc import Callable, Sequence
from decimal import Decimal

from msgspec import Struct

from contoursolve.geometry import Length, Plane
from contoursolve.statements.draft import Meeting, MeetsLine
from contoursolve.statements.statement import (
    ANGLES,
    ChordIs,
    CircleAt,
    DirectionIs,
    EqualLengths,
    EqualSizes,
    LengthIs,
    LineAt,
    ParallelTo,
    PassesBeside,
    PassesThrough,
    Place,
    PointIs,
    PolarAngleIs,
    RadiusIs,
    Statement,
    StraightIs,
    Touches,
    TurnIs,
)
from contoursolve.tolerance import LARGEST

_NUMBER = re.compile(r"[+-]?+(?>\d++\.?+\d*+|\.\d++)(?>(?:[eE][+-]?+\d{1,3}+)?)(?![\w.])")
_DECIMAL_COMMA = re.compile(r"[+-]?+\d++,\d++(?![\w.])")
_PARTS = {"begin": ("begin of", "start of"), "end": ("end of",), "center": ("center of", "centre of")}
_TOKEN = re.compile(r"[^\s(),=]+|.", re.DOTALL)
_NAME = re.compile(r"[^\s(),=]+(?:\s+\d+)?|.", re.DOTALL)
"""What stands where an element is expected: `line 3` is one name."""
_BLANK = re.compile(r"[\s,]*")
LONGEST_NUMBER = 40
"""Characters of a number; 17 digits are all that a double holds."""


class GrammarError(ValueError):
    """A statement that cannot be read: the message, and from which to which character (from 0)."""

    def __init__(self, message: str, begin: int, end: int) -> None:
        super().__init__(message)
        self.begin = begin
        self.end = max(end, begin + 1)


class Vocabulary(Struct, frozen=True):
    """What a statement may mention: elements and points by name, the plane's axes, the unit of lengths."""

    elements: Sequence[str]
    points: Sequence[str]
    plane: Plane
    unit: Length


class _Quantity(Struct, frozen=True):
    kind: str
    names: tuple[str, ...]
    state: Callable[[Decimal | None], Statement]
    is_angle: bool = False
    factor: Decimal = Decimal(1)


def read_statement(text: str, vocabulary: Vocabulary) -> Statement:
    """The statement that a text makes. Raises GrammarError."""
    reader = _Reader(text, vocabulary)
    statement = reader.statement()
    reader.finish()
    return statement


class _Reader:
    def __init__(self, text: str, vocabulary: Vocabulary) -> None:
        self.text = text
        self.words = vocabulary
        self.at = 0

    def statement(self) -> Statement:
        quantity = self._quantity()
        if quantity is not None:
            return self._equation(quantity)
        element = self._element("an element, or a quantity such as `length of`, `radius of`, `Z of`")
        if self._accept("passes through") or self._accept("through"):
            return PassesThrough(element, self._place())
        if self._accept("passes beside") or self._accept("passes"):
            return PassesBeside(element, self._place(), self._distance())
        if self._accept("is parallel to") or self._accept("parallel to"):
            other = self._element("a line")
            self._skip()
            return ParallelTo(element, other, self._distance() if self.at < len(self.text) else None)
        if self._accept("is tangent to") or self._accept("tangent to"):
            return Touches(element, self._other())
        if self._accept("meets"):
            return MeetsLine(element, self._meeting())
        raise self._error("`passes through`, `passes beside`, `parallel to`, `tangent to` or `meets`")

    def _distance(self) -> Decimal:
        if not self._accept("at"):
            raise self._error("`at` and a distance")
        return self._number() * self.words.unit.in_mm

    def finish(self) -> None:
        self._skip()
        if self.at < len(self.text):
            raise self._error("the end of the fact")

    def _equation(self, quantity: _Quantity) -> Statement:
        if not self._symbol("="):
            raise self._error("`=`")
        if self._symbol("?"):
            return quantity.state(None)
        begin = self._skip()
        other = self._quantity()
        if other is None:
            value = self._number()
            return quantity.state(value if quantity.is_angle else value * quantity.factor * self.words.unit.in_mm)
        if quantity.kind == other.kind == "length":
            return EqualLengths(quantity.names[0], other.names[0])
        if quantity.kind == other.kind == "radius":
            return EqualSizes(quantity.names[0], other.names[0])
        raise GrammarError("only two lengths or two radii can be equal", begin, self.at)

    def _quantity(self) -> _Quantity | None:
        if self._accept("length of"):
            name = self._element("an element")
            return _Quantity("length", (name,), lambda value: LengthIs(name, value))
        if self._accept("straight part of"):
            name = self._element("a line")
            return _Quantity("straight part", (name,), lambda value: StraightIs(name, value))
        if self._accept("direction of"):
            name = self._element("a line")
            return _Quantity("direction", (name,), lambda value: DirectionIs(name, value), is_angle=True)
        if self._accept("radius of") or self._accept("size of"):
            name = self._element("an element")
            return _Quantity("radius", (name,), lambda value: RadiusIs(name, value))
        if self._accept("chord of"):
            name = self._element("an arc")
            return _Quantity("chord", (name,), lambda value: ChordIs(name, value))
        if self._accept("polar angle of"):
            part = self._part(("begin", "end")) or "end"
            name = self._element("an arc, or `begin of` or `end of` one")
            return _Quantity("polar angle", (name,), lambda value: PolarAngleIs(name, value, part), is_angle=True)
        if self._accept("angle from"):
            first = self._element("an element")
            if not self._accept("to"):
                raise self._error("`to`")
            second = self._element("an element")
            return _Quantity("angle", (first, second), lambda value: TurnIs(first, second, value), is_angle=True)
        for axis, name in enumerate(self.words.plane.axes):
            if self._accept(f"{name} of"):
                return self._coordinate(axis)
        return None

    def _coordinate(self, axis: int) -> _Quantity:
        factor = Decimal("0.5") if self.words.plane.diameters[axis] else Decimal(1)
        part = self._part()
        expected = "an element" if part else "a point, or `begin of`, `end of`, `center of`"
        name = self._name(self.words.elements if part else self.words.points, expected)
        return _Quantity("coordinate", (name,), lambda value: PointIs(part, name, axis, value), factor=factor)

    def _part(self, parts: Sequence[str] = tuple(_PARTS)) -> str:
        """Which part of an element is meant; empty if none is said."""
        return next((part for part in parts if any(map(self._accept, _PARTS[part]))), "")

    def _other(self) -> str | CircleAt | LineAt:
        begin = self.at
        bracket = self._open() if self._accept("circle") else ""
        if self.at > begin and (bracket or self._starts_place()):
            place = self._axis_words()
            radius = self._lettered("R") * self.words.unit.in_mm
            self._close(bracket)
            if radius < 0:
                raise GrammarError("a radius is not negative", begin, self.at)
            return CircleAt(place, radius)
        self.at = begin
        bracket = self._open() if self._accept("line") else ""
        if self.at > begin and (bracket or self._starts_place()):
            place = self._axis_words()
            angle = self._lettered("A")
            self._close(bracket)
            return LineAt(place, angle)
        self.at = begin
        return self._element("an element, `circle (...)` or `line (...)`")

    def _meeting(self) -> Meeting:
        if self._accept("next line"):
            return Meeting(None, None)
        if self._accept("line to"):
            return Meeting(self._place(), None)
        if self._accept("line at"):
            return Meeting(None, self._number())
        raise self._error("`next line`, `line to (...)` or `line at` an angle")

    def _place(self) -> Place:
        bracket = self._open()
        place = self._axis_words()
        self._close(bracket)
        return place

    def _open(self) -> str:
        """The bracket that must close what begins here; none is needed."""
        return next((closing for opening, closing in ("()", "[]") if self._symbol(opening)), "")

    def _axis_words(self) -> Place:
        values: dict[int, Decimal] = {}
        for _ in range(2):
            for axis, letter in enumerate(self.words.plane.axes):
                if axis not in values and self._peek_letter(letter):
                    factor = Decimal("0.5") if self.words.plane.diameters[axis] else Decimal(1)
                    values[axis] = self._lettered(letter) * factor * self.words.unit.in_mm
        if len(values) < 2:  # noqa: PLR2004 - both axes
            raise self._error("a place such as " + self._example())
        return values[0], values[1]

    def _example(self) -> str:
        first, second = self.words.plane.axes
        return f"`({first}10. {second}20.)`"

    def _peek_letter(self, letter: str) -> bool:
        self._skip()
        pattern = re.compile(re.escape(letter) + r"(?=\s*[+-]?[.\d])", re.IGNORECASE)
        return pattern.match(self.text, self.at) is not None

    def _lettered(self, letter: str) -> Decimal:
        if not self._peek_letter(letter):
            raise self._error(f"`{letter}` and a number")
        self.at += 1
        return self._number()

    def _close(self, bracket: str) -> None:
        if bracket and not self._symbol(bracket):
            raise self._error(f"`{bracket}`")

    def _starts_place(self) -> bool:
        return any(self._peek_letter(letter) for letter in self.words.plane.axes)

    def _element(self, expected: str) -> str:
        return self._name(self.words.elements, expected)

    def _name(self, names: Sequence[str], expected: str) -> str:
        self._skip()
        for name in sorted(names, key=len, reverse=True):
            if self._accept(name):
                return name
        raise self._error(f"{expected} ({', '.join(names)})", _NAME)

    def _number(self) -> Decimal:
        self._skip()
        match = _NUMBER.match(self.text, self.at)
        if not match or len(match[0]) > LONGEST_NUMBER:
            raise self._error("a number")
        comma = _DECIMAL_COMMA.match(self.text, self.at)
        if comma:
            message = f"{comma[0]} has a decimal comma; write {comma[0].replace(',', '.')}"
            raise GrammarError(message, self.at, comma.end())
        value = Decimal(match[0])
        if abs(value) > Decimal(LARGEST):
            raise GrammarError(f"{match[0]} is larger than a control can travel", self.at, match.end())
        self.at = match.end()
        return value

    def _accept(self, phrase: str) -> bool:
        """Whether the next words are these; then they are passed over."""
        begin = self._skip()
        pattern = r"\s+".join(re.escape(word) for word in phrase.split()) + r"(?!\w)"
        match = re.compile(pattern, re.IGNORECASE).match(self.text, begin)
        if match:
            self.at = match.end()
        return match is not None

    def _symbol(self, symbol: str) -> bool:
        self._skip()
        if self.text.startswith(symbol, self.at):
            self.at += 1
            return True
        return False

    def _skip(self) -> int:
        match = _BLANK.match(self.text, self.at)
        if match:
            self.at = match.end()
        return self.at

    def _error(self, expected: str, found_as: re.Pattern[str] = _TOKEN) -> GrammarError:
        self._skip()
        rest = found_as.match(self.text, self.at)
        found = f"`{rest[0]}`" if rest else "the end"
        return GrammarError(f"expected {expected}, found {found}", self.at, rest.end() if rest else self.at)


_OF: dict[type, tuple[str, str]] = {
    LengthIs: ("length of", "element"),
    StraightIs: ("straight part of", "line"),
    ChordIs: ("chord of", "arc"),
    DirectionIs: ("direction of", "line"),
    RadiusIs: ("radius of", "element"),
}
"""What each is called, and the field that names what it is of."""
_EQUAL = {EqualLengths: "length of", EqualSizes: "radius of"}


def write_statement(statement: Statement, plane: Plane, unit: Length) -> str:
    """The text that states it in a program of this plane and unit; places in brackets that a comment allows."""
    if isinstance(statement, EqualLengths | EqualSizes):
        what = _EQUAL[type(statement)]
        return f"{what} {statement.first} = {what} {statement.second}"
    if isinstance(statement, PassesThrough):
        return f"{statement.element} passes through [{_place(statement.place, plane, unit)}]"
    if isinstance(statement, PassesBeside):
        place = _place(statement.place, plane, unit)
        return f"{statement.element} passes beside [{place}] at {_length(statement.distance, unit)}"
    if isinstance(statement, ParallelTo):
        apart = "" if statement.distance is None else f" at {_length(statement.distance, unit)}"
        return f"{statement.line} parallel to {statement.other}{apart}"
    if isinstance(statement, Touches):
        return f"{statement.first} tangent to {_other(statement.second, plane, unit)}"
    if isinstance(statement, MeetsLine):
        return f"{statement.corner} meets {_meeting(statement, plane, unit)}"
    value: Decimal | None = getattr(statement, "value", None)
    if isinstance(statement, PointIs):
        part = f"{statement.part} of " if statement.part else ""
        shown = "?" if value is None else _length(value, unit, is_diameter=plane.diameters[statement.axis])
        return f"{plane.axes[statement.axis]} of {part}{statement.of} = {shown}"
    shown = "?" if value is None else _number(value) if isinstance(statement, ANGLES) else _length(value, unit)
    if isinstance(statement, TurnIs):
        return f"angle from {statement.first} to {statement.second} = {shown}"
    if isinstance(statement, PolarAngleIs):
        part = "" if statement.part == "end" else f"{statement.part} of "
        return f"polar angle of {part}{statement.arc} = {shown}"
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
