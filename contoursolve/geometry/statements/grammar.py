"""The textual form of statements: read with the place of every mistake, and written again."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from functools import partial

from msgspec import Struct
from msgspec.structs import astuple

from contoursolve.geometry.profile import Length, Plane
from contoursolve.geometry.statements.statement import (
    ANGLES,
    ChordIs,
    CircleAt,
    DirectionIs,
    EqualLengths,
    EqualSizes,
    LengthIs,
    LiesOn,
    LineAt,
    Meeting,
    MeetsLine,
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
from contoursolve.numeric import trimmed
from contoursolve.tolerance import LARGEST

_NUMBER = re.compile(r"[+-]?+(?>\d++\.?+\d*+|\.\d++)(?>(?:[eE][+-]?+\d{1,3}+)?)(?![\w.])")
_DECIMAL_COMMA = re.compile(r"[+-]?+\d++,\d++(?![\w.])")
_PARTS = {"begin": ("begin of", "start of"), "end": ("end of",), "center": ("center of", "centre of")}
_TOKEN = re.compile(r"[^\s(),=]+|.", re.DOTALL)
_NAME = re.compile(r"[^\s(),=]+(?:\s+\d+)?|.", re.DOTALL)
"""The text where an element is expected: `line 3` is one name."""
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
    """The names that a statement may mention: elements and points by name, the plane's axes, the unit of lengths."""

    elements: Sequence[str]
    points: Sequence[str]
    plane: Plane
    unit: Length
    end: "PointName | None" = None
    """The point at which the path ends, which `end` names."""
    cut: Mapping[str, tuple[str, str]] = {}
    """Ends of elements that a corner cuts off, such as `line 1.end`: where the element ends then, and where it would
    without the corner. Whoever names one means either."""


class PointName(Struct, frozen=True):
    """A point by its name: `of` alone, or the `part` of that element (`begin`, `end` or `center`)."""

    part: str
    of: str

    @property
    def text(self) -> str:
        """The name as it is printed, such as `V2` or `corner 1.center`."""
        return f"{self.of}.{self.part}" if self.part else self.of


PATH_END = PointName("", "end")
"""The point at which the path ends, as it is named."""


class ResultName(Struct, frozen=True):
    """A number of a contour by its name: a coordinate of a point, or what `quantity` states the value of; the length of
    the path without both. A point alone has no `axis`."""

    point: PointName | None = None
    axis: int | None = None
    quantity: Statement | None = None


class _Measure(Struct, frozen=True):
    """The quantity that a value is of: the statement of it, how it begins, as it is written first, and
    the element that follows."""

    kind: type[LengthIs] | type[StraightIs] | type[DirectionIs] | type[RadiusIs] | type[ChordIs]
    begins: tuple[str, ...]
    element: str
    equal: type[EqualLengths] | type[EqualSizes] | None = None
    """The statement that two of these are equal."""


_MEASURES = (
    _Measure(LengthIs, ("length of",), "an element", EqualLengths),
    _Measure(StraightIs, ("straight part of",), "a line"),
    _Measure(DirectionIs, ("direction of",), "a line"),
    _Measure(RadiusIs, ("radius of", "size of"), "an element", EqualSizes),
    _Measure(ChordIs, ("chord of",), "an arc"),
)


class _Quantity(Struct, frozen=True):
    """The text before an equals sign, or behind one."""

    state: Callable[[Decimal | None], Statement]
    name: str = ""
    equal: type[EqualLengths] | type[EqualSizes] | None = None
    is_angle: bool = False
    factor: Decimal = Decimal(1)


def read_statement(text: str, vocabulary: Vocabulary) -> Statement:
    """The statement that a text makes. Raises GrammarError."""
    reader = _Reader(text, vocabulary)
    statement = reader.statement()
    reader.finish()
    return statement


def read_result(text: str, vocabulary: Vocabulary) -> ResultName:
    """The number of a contour that a text names, or the point. Raises GrammarError."""
    reader = _Reader(text, vocabulary, is_fact=False)
    found = reader.result()
    reader.finish()
    return found


def write_result(name: ResultName, plane: Plane) -> str:
    """The name as it is printed: `end Z`, `corner 1.center Z`, `straight part of line 1`, `length`."""
    if name.quantity is not None:
        return write_statement(name.quantity, plane, Length.MM).removesuffix(" = ?")
    if name.point is None:
        return _LENGTH
    return name.point.text if name.axis is None else f"{name.point.text} {plane.axes[name.axis]}"


_LENGTH = "length"


class _Reader:
    def __init__(self, text: str, vocabulary: Vocabulary, *, is_fact: bool = True) -> None:
        self.text = text
        self.words = vocabulary
        self.at = 0
        self.is_fact = is_fact

    def result(self) -> ResultName:
        quantity = self._quantity()
        if quantity is not None:
            stated = quantity.state(None)
            if isinstance(stated, PointIs):
                return ResultName(PointName(stated.part, stated.of), stated.axis)
            return ResultName(quantity=stated)
        for element in self._names(self.words.elements):
            if self._accept(f"{element}.room"):
                return ResultName(quantity=StraightIs(element, None))
        point = self._point()
        if point is not None:
            letter = self.text[self.at :].strip(" .")
            if len(letter) == 1 and letter.isalpha():
                axes = " and ".join(self.words.plane.axes)
                raise GrammarError(f"the axes of this contour are {axes}", self.at, len(self.text))
            return ResultName(point)
        if self._accept(_LENGTH):
            return ResultName()
        raise self._error("a point with an axis, or a quantity such as `radius of`", _NAME)

    def statement(self) -> Statement:
        quantity = self._quantity()
        if quantity is not None:
            return self._equation(quantity)
        part = self._part()
        if part:
            element = self._element("an element")
            if not any(map(self._accept, _LYING)):
                raise self._error("`lies on`")
            return LiesOn(part, element, self.touched())
        element = self._element("an element, or a quantity such as `length of`, `radius of`, `Z of`")
        for row in _RELATIONS:
            if any(map(self._accept, row.verbs)):
                return row.kind(element, *(read(self) for read in row.objects))
        raise self._error("`passes through`, `passes beside`, `parallel to`, `tangent to` or `meets`")

    def other_line(self) -> str:
        return self._element("a line")

    def distance_or_end(self) -> Decimal | None:
        return self.distance() if self._skip() < len(self.text) else None

    def distance(self) -> Decimal:
        if not self._accept("at"):
            raise self._error("`at` and a distance")
        return self._number() * self.words.unit.in_mm

    def finish(self) -> None:
        self._skip()
        if self.at < len(self.text):
            raise self._error("the end of the fact" if self.is_fact else "the end of the name")

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
        if quantity.equal is not None and quantity.equal is other.equal:
            return quantity.equal(quantity.name, other.name)
        raise GrammarError("only two lengths or two radii can be equal", begin, self.at)

    def _quantity(self) -> _Quantity | None:
        for row in _MEASURES:
            if any(map(self._accept, row.begins)):
                name = self._element(row.element)
                return _Quantity(partial(row.kind, name), name, row.equal, row.kind in ANGLES)
        if self._accept("polar angle of"):
            part = self._part(("begin", "end")) or "end"
            arc = self._element("an arc, or `begin of` or `end of` one")
            return _Quantity(partial(PolarAngleIs, arc, part=part), is_angle=True)
        if self._accept("angle from"):
            first = self._element("an element")
            if not self._accept("to"):
                raise self._error("`to`")
            return _Quantity(partial(TurnIs, first, self._element("an element")), is_angle=True)
        for axis, name in enumerate(self.words.plane.axes):
            if self._accept(f"{name} of"):
                return self._coordinate(axis, self._part_of())
        begin, point = self.at, self._point()
        if point is not None:
            self._symbol(".")
            for axis, name in enumerate(self.words.plane.axes):
                if self._accept(name):
                    return self._coordinate(axis, point)
        self.at = begin
        return None

    def _coordinate(self, axis: int, point: PointName) -> _Quantity:
        factor = Decimal("0.5") if self.words.plane.diameters[axis] else Decimal(1)
        return _Quantity(partial(PointIs, point.part, point.of, axis), factor=factor)

    def _part_of(self) -> PointName:
        """The point behind `Z of`."""
        begin, part = self.at, self._part()
        if part:
            point = PointName(part, self._name(self.words.elements, "an element"))
            return point if self.is_fact else self._uncut(point, begin)
        return self._point() or PointName("", self._name(self.words.points, _A_POINT))

    def _point(self) -> PointName | None:
        """The point whose name stands here, such as `V2`, `corner 1.center` or `end`; None without one."""
        begin, words = self._skip(), self.words
        for name in self._names((*words.points, *words.elements)):
            if name in words.points and self._accept(name):
                return PointName("", name)
            for part in _PARTS:
                if name in words.elements and self._accept(f"{name}.{part}"):
                    return self._uncut(PointName(part, name), begin)
        is_end = words.end is not None and self._accept(PATH_END.of)
        return None if not is_end else words.end if self.is_fact else PATH_END

    def _uncut(self, point: PointName, begin: int) -> PointName:
        """The point, unless a corner cuts it off. Raises GrammarError."""
        if point.text in self.words.cut:
            its, without = self.words.cut[point.text]
            told = f"a corner cuts off {point.text}: write {its} for where it ends, or {without} for its virtual end"
            raise GrammarError(told, begin, self.at)
        return point

    def _names(self, names: Iterable[str]) -> list[str]:
        """The names that may stand here, the longest first."""
        here = self.text[self._skip() :].lstrip().lower()
        return sorted((name for name in names if here.startswith(name[:1].lower())), key=len, reverse=True)

    def _part(self, parts: Sequence[str] = tuple(_PARTS)) -> str:
        """The part of an element that is meant; empty if none is said."""
        return next((part for part in parts if any(map(self._accept, _PARTS[part]))), "")

    def touched(self) -> str | CircleAt | LineAt:
        begin = self.at
        for what, letter in (("circle", "R"), ("line", "A")):
            self.at = begin
            bracket = self._open() if (is_named := self._accept(what)) else ""
            if not is_named or not (bracket or self._starts_place()):
                continue
            place, value = self._axis_words(), self._lettered(letter)
            self._close(bracket)
            if what == "line":
                return LineAt(place, value)
            if value < 0:
                raise GrammarError("a radius is not negative", begin, self.at)
            return CircleAt(place, value * self.words.unit.in_mm)
        self.at = begin
        return self._element("an element, `circle (...)` or `line (...)`")

    def meeting(self) -> Meeting:
        if self._accept("next line"):
            return Meeting(None, None)
        if self._accept("line to"):
            return Meeting(self.place(), None)
        if self._accept("line at"):
            return Meeting(None, self._number())
        raise self._error("`next line`, `line to (...)` or `line at` an angle")

    def place(self) -> Place:
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
        for name in self._names(names):
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


_LYING = ("lies on", "is on")
"""The verb that says of a part of an element where it lies, as it is written first."""


_A_POINT = "a point, or `begin of`, `end of`, `center of`"


class _Relation(Struct, frozen=True):
    """A verb that says something of an element: what stands behind it, as it is written first, and what follows."""

    kind: Callable[..., Statement]
    verbs: tuple[str, ...]
    objects: tuple[Callable[[_Reader], object], ...]


_RELATIONS = (
    _Relation(PassesThrough, ("passes through", "through"), (_Reader.place,)),
    _Relation(PassesBeside, ("passes beside", "passes"), (_Reader.place, _Reader.distance)),
    _Relation(ParallelTo, ("parallel to", "is parallel to"), (_Reader.other_line, _Reader.distance_or_end)),
    _Relation(Touches, ("tangent to", "is tangent to"), (_Reader.touched,)),
    _Relation(MeetsLine, ("meets",), (_Reader.meeting,)),
)


def write_statement(statement: Statement, plane: Plane, unit: Length) -> str:
    """The text that states it in a program of this plane and unit; places in brackets that a comment allows."""
    relation = next((row for row in _RELATIONS if row.kind is type(statement)), None)
    if relation is not None:
        element, *objects = astuple(statement)
        texts = (_object(each, plane, unit) for each in objects if each is not None)
        return " ".join([element, relation.verbs[0], *texts])
    if isinstance(statement, LiesOn):
        return f"{statement.part} of {statement.of} {_LYING[0]} {_object(statement.on, plane, unit)}"
    if isinstance(statement, EqualLengths | EqualSizes):
        what = next(row.begins[0] for row in _MEASURES if row.equal is type(statement))
        return f"{what} {statement.first} = {what} {statement.second}"
    value: Decimal | None = getattr(statement, "value", None)
    if isinstance(statement, PointIs):
        part = f"{statement.part} of " if statement.part else ""
        shown = "?" if value is None else _length(value, unit, is_diameter=plane.diameters[statement.axis])
        return f"{plane.axes[statement.axis]} of {part}{statement.of} = {shown}"
    shown = "?" if value is None else trimmed(value) if isinstance(statement, ANGLES) else _length(value, unit)
    if isinstance(statement, TurnIs):
        return f"angle from {statement.first} to {statement.second} = {shown}"
    if isinstance(statement, PolarAngleIs):
        part = "" if statement.part == "end" else f"{statement.part} of "
        return f"polar angle of {part}{statement.arc} = {shown}"
    row = next(row for row in _MEASURES if row.kind is type(statement))
    return f"{row.begins[0]} {astuple(statement)[0]} = {shown}"


def _object(part: str | Decimal | Place | CircleAt | LineAt | Meeting, plane: Plane, unit: Length) -> str:
    """The object of the verb: an element by its name, a distance, or something that is given with its place."""
    match part:
        case str():
            return part
        case Decimal():
            return f"at {_length(part, unit)}"
        case CircleAt(center=center, radius=radius):
            return f"circle [{_place(center, plane, unit)} R{_length(radius, unit)}]"
        case LineAt(place=place, angle=angle):
            return f"line [{_place(place, plane, unit)} A{trimmed(angle)}]"
        case Meeting(to=to, angle=angle):
            if to is not None:
                return f"line to {_object(to, plane, unit)}"
            return "next line" if angle is None else f"line at {trimmed(angle)}"
    return f"[{_place(part, plane, unit)}]"


def _place(place: Place, plane: Plane, unit: Length) -> str:
    axes = zip(plane.axes, place, plane.diameters, strict=True)
    return " ".join(f"{axis}{_length(value, unit, is_diameter=is_diameter)}" for axis, value, is_diameter in axes)


def _length(mm: Decimal, unit: Length, *, is_diameter: bool = False) -> str:
    return trimmed(mm * (2 if is_diameter else 1) / unit.in_mm)
