"""A sketch as a program of the control `drawing`: one line for each element, and the place of each field."""

from collections.abc import Iterator, Mapping
from decimal import Decimal
from typing import Literal

from msgspec import Struct

from contoursolve.controls import words_of_drawing
from contoursolve.diagnostics import Span
from contoursolve.gcode import parse, spelled
from contoursolve.sketches.sketch import ASKED, ContourSketch, SketchCorner, SketchElement, Value

FUNCTIONS: Mapping[tuple[Literal["line", "arc"], bool], str] = {
    ("line", False): "FL",
    ("line", True): "FLT",
    ("arc", False): "FC",
    ("arc", True): "FCT",
}
_FACT = " ; contoursolve: "

Field = tuple[int, str]
"""The number of an element, from 1, and the name of one of its fields; that of a fact has its place, as `facts.0`."""


class SketchProgram(Struct, frozen=True):
    """The text of a sketch's program, the words that state where it begins, and the place of each field in it. An
    element of a number stands in the line of that number."""

    text: str
    start: str | None
    places: Mapping[Field, Span]

    def field_at(self, place: Span) -> Field | None:
        """The field that stands at a place; of a whole line, the kind of its element."""
        for field, span in self.places.items():
            if span.line == place.line and span.column <= place.column < span.end_column:
                return field
        return (place.line, "kind") if 0 < place.line <= self.text.count("\n") + 1 and self.text else None


def as_program(sketch: ContourSketch, picks: Mapping[int, int] = {}) -> SketchProgram:
    """The program of a sketch; `picks` are the numbers of solutions by elements, as FSELECT has them. A corner with no
    element after it is left out."""
    lines, places = list[str](), dict[Field, Span]()
    for number, element in enumerate(sketch.elements, 1):
        facts = [((number, f"facts.{place}"), fact) for place, fact in enumerate(element.facts)]
        facts += [((0, f"facts.{place}"), fact) for place, fact in enumerate(sketch.facts) if number == 1]
        words = _words(sketch, number, element, picks.get(number))
        told = [((number, name), " ", written) for name, written in words]
        told += [(field, "; " if place else _FACT, fact) for place, (field, fact) in enumerate(facts)]
        text = str(number)
        for field, lead, written in told:
            begin = len(text + lead) + 1
            places[field] = Span(number, begin, begin + len(written))
            text += lead + written
        lines.append(text)
    return SketchProgram("\n".join(lines), _start(sketch), places)


def _words(sketch: ContourSketch, number: int, element: SketchElement, pick: int | None) -> Iterator[tuple[str, str]]:
    """The words of an element, each with the name of its field."""
    yield "kind", FUNCTIONS[element.kind, element.tangent]
    if element.turn:
        yield "turn", element.turn
    order = words_of_drawing(sketch.part, element.kind)
    yield from ((name, f"{name}{_number(element.words[name])}") for name in order if name in element.words)
    if element.corner and number < len(sketch.elements):
        yield "corner", f"{element.corner.shape} {_number(element.corner.size)}"
    if sketch.closed and len(sketch.elements) > 1 and number in (1, len(sketch.elements)):
        yield "closed", "CLSD+" if number == 1 else "CLSD-"
    if pick is not None:
        yield "guess", f"FSELECT{pick}"


def _number(value: Value) -> str:
    return ASKED if value == ASKED else f"{Decimal(value):f}"


def _start(sketch: ContourSketch) -> str | None:
    """The words that state where it begins, and its pole; None where that is not known."""
    if any(axis not in sketch.start for axis in sketch.axes):
        return None
    begins = " ".join(f"{axis}{_number(sketch.start[axis])}" for axis in sketch.axes)
    pole = " ".join(f"{axis}{_number(value)}" for axis, value in sketch.pole.items())
    return f"{begins}\nFPOL {pole}" if pole else begins


def element_of(line: str, sketch: ContourSketch) -> SketchElement | None:
    """The element that a line of a sketch's program has; None where it is none, or has what no element has."""
    blocks = spelled(parse(line.partition(";")[0]), sketch.control.modes.syntax).blocks
    words, corner, kind = dict[str, Value](), None, None
    turn: Literal["cw", "ccw"] | None = None
    for word in blocks[0].words if len(blocks) == 1 else ():
        value: Value = ASKED if word.is_asked else Decimal(word.number or 0)
        match word.address:
            case "G":
                kind = next((key for key, name in FUNCTIONS.items() if name == word.text.strip().upper()), None)
            case "N" | "CLSD":
                pass
            case "DR":
                turn = "cw" if value == -1 else "ccw"
            case "ROUNDING" | "CHAMFER":
                corner = SketchCorner("rounding" if word.address == "ROUNDING" else "chamfer", value)
            case _:
                words[word.address] = value
    if kind is None or blocks[0].faults or not words.keys() <= words_of_drawing(sketch.part, kind[0]).keys():
        return None
    told = (each.strip() for each in line.partition(_FACT)[2].split(";"))
    return SketchElement(kind[0], words, turn, kind[1], corner, facts=tuple(filter(None, told)))
