"""Sketches as text: TOML or JSON in, TOML or JSON out, and the schema, all by one table."""

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from decimal import Decimal, InvalidOperation
from enum import Enum
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls import DRAWINGS, words_of_drawing
from contoursolve.diagnostics import checked, names_like
from contoursolve.gcode import read_toml
from contoursolve.sketches.sketch import ASKED, VERSION, ContourSketch, SketchCorner, SketchElement, SketchError
from contoursolve.tolerance import LARGEST

_AXES = sorted({axis for each in DRAWINGS.values() for axis in each.plane.axes})
_NUMBER_SCHEMA = {"type": ["number", "string"]}


def _numbers(names: Iterable[str], **more: object) -> dict[str, Any]:
    """The schema of a table of numbers."""
    properties = dict.fromkeys(names, _NUMBER_SCHEMA)
    return {"type": "object", "properties": properties, **more, "additionalProperties": False}


class _Kind(Enum):
    """Kinds of values in a sketch: what is meant, for a reader, and the schema."""

    VERSION = f"{VERSION}, the version of the file", {"const": VERSION}
    CHOICE = "one of its names", dict[str, Any]()
    FLAG = "true or false", {"type": "boolean"}
    PLACE = "a number for each axis, such as {{ {0} = 10, {1} = 20 }}", _numbers(_AXES)
    GUESS = PLACE[0], _numbers([*_AXES, *(f"CC{axis}" for axis in _AXES)])
    CORNER = (
        "a rounding or a chamfer, such as {{ rounding = 2 }}",
        _numbers(("rounding", "chamfer"), minProperties=1, maxProperties=1),
    )
    VALUE = 'a number, or "?"', _NUMBER_SCHEMA
    FACTS = (
        'a list of statements, such as ["length of line 2 = 30"]',
        {"type": "array", "items": {"type": "string"}},
    )
    ELEMENTS = "a list of lines and arcs", {"type": "array", "items": {"$ref": "#/$defs/element"}}

    def __init__(self, meant: str, schema: Mapping[str, Any]) -> None:
        self.meant, self.schema = meant, schema


class _Field(Struct, frozen=True):
    """A key of a table: its kind, what it means, its names where it is a choice, whether it must be there."""

    kind: _Kind
    meaning: str
    names: tuple[str, ...] = ()
    is_needed: bool = False

    def schema(self) -> dict[str, Any]:
        """The schema of its value."""
        return {"description": self.meaning, **({"enum": [*self.names]} if self.names else self.kind.schema)}

    def example(self) -> str:
        """A value of it, or its choices."""
        return " or ".join(f'"{name}"' for name in self.names) or self.kind.meant.partition(",")[0]


_CHAIN: Mapping[str, _Field] = {
    "sketch": _Field(_Kind.VERSION, "version of the file", is_needed=True),
    "part": _Field(_Kind.CHOICE, "turned: Z and X, X a diameter; milled: X and Y", tuple(DRAWINGS), is_needed=True),
    "unit": _Field(_Kind.CHOICE, "unit of all lengths", ("mm", "inch")),
    "closed": _Field(_Kind.FLAG, "whether it ends where it begins"),
    "start": _Field(_Kind.PLACE, "where it begins"),
    "pole": _Field(_Kind.PLACE, "place from which PR and PA count"),
    "facts": _Field(_Kind.FACTS, "statements about several elements"),
    "element": _Field(_Kind.ELEMENTS, "lines and arcs in their order"),
}
_ELEMENT: Mapping[str, _Field] = {
    "kind": _Field(_Kind.CHOICE, "line or arc", ("line", "arc"), is_needed=True),
    "turn": _Field(_Kind.CHOICE, "sense of an arc: clockwise or counter-clockwise", ("cw", "ccw")),
    "tangent": _Field(_Kind.FLAG, "whether it begins in the direction of the element before it"),
    "corner": _Field(_Kind.CORNER, "what stands after it: the radius of a rounding, the setback of a chamfer"),
    "guess": _Field(_Kind.GUESS, "about where it ends, or its centre is: chooses, never counts as a dimension"),
    "facts": _Field(_Kind.FACTS, "statements about it"),
}
_KINDS = {"line": "arcs", "arc": "lines"}
"""The kinds of elements, each with what those are of which another field is."""


def _fields_of(part: str, kind: str | None = None) -> dict[str, _Field]:
    """The fields of lines or arcs, or of both, of a part."""
    own = {**_ELEMENT}
    if kind == "line":
        own["guess"] = replace(own["guess"], kind=_Kind.PLACE)
        del own["turn"]
    return own | {name: _Field(_Kind.VALUE, meaning) for name, meaning in words_of_drawing(part, kind).items()}


@checked
def read_sketch(text: str) -> ContourSketch:
    """The sketch of a file's text, TOML or JSON.

    Numbers are exact; a text such as "12,5" is a number with a decimal comma. Raises SketchError, which names the place
    and what is meant there.

    >>> read_sketch('sketch = 1\\npart = "turned"\\nstart = { Z = 0, X = 0 }').axes
    ('Z', 'X')
    """
    return sketch_of(_parsed(text))


def _parsed(text: str) -> object:
    is_json = text.lstrip("\ufeff \t\r\n").startswith("{")
    try:
        if is_json:
            return json.loads(text, parse_float=Decimal, object_pairs_hook=_once, parse_constant=Decimal)
        return read_toml(text.removeprefix("\ufeff"), Decimal)
    except SketchError:
        raise
    except (ValueError, RecursionError, InvalidOperation) as error:
        comma = None if is_json else _COMMA.search(text)
        if comma:
            line = text.count("\n", 0, comma.start()) + 1
            number = comma["number"].replace(",", ".")
            raise SketchError(f"line {line} of the file: write {number} with a point, or in quotes") from None
        raise SketchError(f"the file is no {'JSON' if is_json else 'TOML'}: {str(error)[:200]}") from None


_COMMA = re.compile(r"=[ \t]*+(?P<number>[+-]?\d++,\d++)[ \t]*+(?=[,}#\r\n]|$)")


def _once(pairs: Sequence[tuple[str, object]]) -> dict[str, object]:
    found: dict[str, object] = {}
    for name, value in pairs:
        if name in found:
            raise SketchError(f"{name} is given twice in one table; leave one out")
        found[name] = value
    return found


def sketch_of(table: object) -> ContourSketch:
    """The sketch of a table with plain values, such as JSON has them. Raises SketchError."""
    if not isinstance(table, Mapping):
        raise SketchError("a sketch is a table with sketch, part, start and element")
    part = table.get("part")
    axes = DRAWINGS[part].plane.axes if isinstance(part, str) and part in DRAWINGS else ("X", "Y")
    own = _Reader("", axes).table(table, _CHAIN)
    elements = tuple(_element(number, each, own["part"], axes) for number, each in enumerate(own.pop("element", ()), 1))
    del own["sketch"]
    return ContourSketch(elements=elements, **own)


def _element(number: int, table: object, part: str, axes: tuple[str, str]) -> SketchElement:
    if not isinstance(table, Mapping):
        raise SketchError(f"element {number}: {_shown(table)} is no table; write kind = and what the drawing gives")
    kind = next((each for each in _KINDS if each == table.get("kind")), None)
    reader, fields = _Reader(f"element {number}: ", axes), _fields_of(part, kind)
    for name in (each for each in _fields_of(part) if each not in fields and each in table):
        raise reader.refusal(name, f"is a field of {_KINDS[str(kind)]}; leave it out, or change kind")
    own = reader.table(table, fields)
    return SketchElement(words={name: own.pop(name) for name in tuple(own) if name not in _ELEMENT}, **own)


class _Reader(Struct, frozen=True):
    """A reader of one table: which one, for messages, and the axes of the part."""

    where: str
    axes: tuple[str, str]

    def table(self, table: Mapping[str, object], fields: Mapping[str, _Field]) -> dict[str, Any]:
        """The values of a table by the names of its fields. Raises SketchError."""
        for name in table:
            if name not in fields:
                raise self.refusal(str(name)[:40], "is no field here" + _meant(str(name), fields))
        for name, field in fields.items():
            if field.is_needed and table.get(name) is None:
                raise self.refusal(name, f"is missing; write {name} = {field.example()}")
        return {name: self.value(name, fields[name], value) for name, value in table.items() if value is not None}

    def value(self, name: str, field: _Field, value: object) -> Any:
        """The value of a field."""
        match field.kind, value:
            case (_Kind.FLAG, bool()) | (_Kind.ELEMENTS, list() | tuple()):
                return value
            case _Kind.VERSION, int() if not isinstance(value, bool):
                if value != VERSION:
                    told = f"is {value}, and this contoursolve reads version {VERSION}; install a newer one"
                    raise self.refusal(name, told)
                return value
            case _Kind.CHOICE, _:
                if value not in field.names:
                    raise self.refusal(name, f"is {_shown(value)}; write {field.example()}")
                return value
            case _Kind.PLACE, Mapping():
                return self._place(name, value, self.axes)
            case _Kind.GUESS, Mapping():
                return self._place(name, value, (*self.axes, *(f"CC{axis}" for axis in self.axes)))
            case _Kind.CORNER, Mapping() if len(value) == 1 and value.keys() <= field.kind.schema["properties"].keys():
                ((shape, size),) = value.items()
                return SketchCorner(shape, self._number(f"{name}.{shape}", size))
            case _Kind.VALUE, _:
                return self._number(name, value)
            case _Kind.FACTS, list() | tuple() if all(_is_line(each) for each in value):
                return tuple(value)
        raise self.refusal(name, f"is {_shown(value)}; write {field.kind.meant.format(*self.axes)}")

    def _place(self, name: str, table: Mapping[str, object], axes: Sequence[str]) -> Mapping[str, Decimal]:
        for axis in table:
            if axis not in axes:
                told = f"is no axis of this part; its axes are {' and '.join(self.axes)}"
                raise self.refusal(f"{name}.{str(axis)[:40]}", told)
            if table[axis] == ASKED:
                raise self.refusal(f"{name}.{axis}", 'is "?", and a number must stand there')
        return {axis: self._number(f"{name}.{axis}", table[axis]) for axis in axes if axis in table}

    def _number(self, name: str, value: object) -> Any:
        if value == ASKED:
            return ASKED
        text = (
            value.strip() if isinstance(value, str) else str(value) if isinstance(value, int | Decimal | float) else ""
        )
        if len(text) > LONGEST or not _NUMBER.fullmatch(text):
            raise self.refusal(name, f'is {_shown(value)}; write a number, such as 12.5 or "12,5", or "?"')
        number = Decimal(text.replace(",", "."))
        if abs(number) > Decimal(LARGEST):
            raise self.refusal(name, f"is {_shown(value)}, which is larger than a control can travel")
        return number

    def refusal(self, name: str, trouble: str) -> SketchError:
        """The error about a field."""
        return SketchError(f"{self.where}{name} {trouble}")


_NUMBER = re.compile(r"[+-]?+(?:\d++(?:[.,]\d*+)?|[.,]\d++)(?:[eE][+-]?\d{1,2})?")
LONGEST = 40
"""Characters of a number; 17 digits are all that a double holds."""


def _is_line(value: object) -> bool:
    return isinstance(value, str) and value.isprintable() and bool(value.strip())


def _shown(value: object) -> str:
    text = _json(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def _meant(name: str, fields: Mapping[str, _Field]) -> str:
    """The fields that an unknown name was probably meant to be."""
    meant = names_like(name, fields)
    return f"; {' or '.join(meant)} was probably meant" if meant else f"; there are {', '.join(fields)}"


@checked
def write_sketch(sketch: ContourSketch, *, as_json: bool = False) -> str:
    """The text of a sketch's file, TOML or JSON; `read_sketch` of it is the same sketch.

    >>> print(write_sketch(ContourSketch("milled", start={"X": Decimal("0.50")})), end="")
    sketch = 1
    part = "milled"
    start = { X = 0.50 }
    """
    table = plain_sketch(sketch)
    if as_json:
        return _json(table) + "\n"
    elements = table.pop("element", [])
    lines = [f"{name} = {_toml(value)}" for name, value in table.items()]
    for each in elements:
        lines += ["", "[[element]]", *(f"{name} = {_toml(value)}" for name, value in each.items())]
    return "\n".join(lines) + "\n"


def plain_sketch(sketch: ContourSketch) -> dict[str, Any]:
    """A sketch as a table with plain values; numbers are Decimal."""
    table = {
        "sketch": VERSION,
        "part": sketch.part,
        "unit": sketch.unit if sketch.unit != "mm" else "",
        "closed": sketch.closed,
        "start": dict(sketch.start),
        "pole": dict(sketch.pole),
        "facts": [*sketch.facts],
        "element": [plain_element(each) for each in sketch.elements],
    }
    return {name: value for name, value in table.items() if value}


def plain_element(element: SketchElement) -> dict[str, Any]:
    """An element as a table with plain values; numbers are Decimal."""
    table = {
        "kind": element.kind,
        "turn": element.turn,
        "tangent": element.tangent,
        **element.words,
        "corner": {element.corner.shape: element.corner.size} if element.corner else {},
        "guess": dict(element.guess),
        "facts": [*element.facts],
    }
    return {name: value for name, value in table.items() if value or name in element.words}


def _toml(value: object) -> str:
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{name} = {_toml(each)}' for name, each in value.items())} }}"
    return _json(value)


def _json(value: object) -> str:
    """A value as JSON has it, and TOML beside tables; numbers with the digits that they have."""
    match value:
        case Decimal():
            return f"{value:f}"
        case Mapping():
            return f"{{{', '.join(f'{json.dumps(name)}: {_json(each)}' for name, each in value.items())}}}"
        case list() | tuple():
            return f"[{', '.join(map(_json, value))}]"
    return json.dumps(value, default=str, ensure_ascii=False)


def sketch_schema() -> dict[str, Any]:
    """The JSON schema of a sketch's file."""
    elements = {name: each for part in DRAWINGS for name, each in _fields_of(part).items()}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Sketch of a contour for contoursolve",
        **_schema_of(_CHAIN),
        "$defs": {"element": _schema_of(elements)},
    }


def _schema_of(fields: Mapping[str, _Field]) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": {name: each.schema() for name, each in fields.items()},
        "required": [name for name, each in fields.items() if each.is_needed],
        "additionalProperties": False,
    }
