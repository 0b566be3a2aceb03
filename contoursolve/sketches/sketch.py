"""A sketch: a chain of lines and arcs with what the drawing gives of each; all else is left out."""

from collections.abc import Iterator, Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any, Final, Literal

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls import DRAWINGS
from contoursolve.diagnosis import Answer, EquationSystem
from contoursolve.diagnostics import UserError, from_above, hash_of
from contoursolve.gcode import write_whole
from contoursolve.reading import Control

VERSION = 1
"""The version of a sketch's file."""

ASKED: Final = "?"
"""Stands for a number that is asked for."""

Value = Decimal | Literal["?"]


class SketchError(UserError, ValueError):
    """A sketch that cannot be read; the message says where, and what is meant there."""


class SketchCorner(Struct, frozen=True):
    """The corner after an element.

    Attributes:
        shape: `rounding` or `chamfer`.
        size: the radius of a rounding, or the setback of a chamfer, in the unit of the sketch; `?` asks for it.
    """

    shape: Literal["rounding", "chamfer"]
    size: Value


class SketchElement(Struct, frozen=True):
    """A line or an arc with what the drawing gives of it.

    Attributes:
        kind: `line` or `arc`.
        words: numbers by the names of words, such as X, IZ, AN, LEN, R, CCX, P1X, PAR: in the unit of the sketch, or
            degrees; X of a turned part is a diameter. `?` asks for one.
        turn: the sense of an arc, `cw` or `ccw`.
        tangent: whether it begins in the direction of the element before it.
        corner: what stands after it.
        guess: about where it ends, by axes, and where the centre of an arc is (CCX): it chooses among solutions, and
            never counts as a dimension.
        facts: statements about it, as `contoursolve facts` lists them.
    """

    kind: Literal["line", "arc"]
    words: Mapping[str, Value] = {}
    turn: Literal["cw", "ccw"] | None = None
    tangent: bool = False
    corner: SketchCorner | None = None
    guess: Mapping[str, Decimal] = {}
    facts: tuple[str, ...] = ()

    __hash__ = hash_of


class ContourSketch(Struct, frozen=True):
    """A contour as the drawing gives it.

    Attributes:
        part: `turned` (Z and X, X a diameter) or `milled` (X and Y).
        unit: `mm` or `inch`.
        start: where it begins, by axes.
        elements: lines and arcs in their order.
        closed: whether it ends where it begins.
        pole: the place from which PR and PA count.
        facts: statements about several elements.
    """

    part: Literal["turned", "milled"]
    elements: tuple[SketchElement, ...] = ()
    start: Mapping[str, Decimal] = {}
    unit: Literal["mm", "inch"] = "mm"
    closed: bool = False
    pole: Mapping[str, Decimal] = {}
    facts: tuple[str, ...] = ()

    __hash__ = hash_of

    @property
    def control(self) -> Control:
        """The tables by which it is read."""
        return DRAWINGS[self.part]

    @property
    def axes(self) -> tuple[str, str]:
        """The axes of its plane."""
        return self.control.plane.axes

    def name_of(self, number: int) -> str:
        """The name of an element, by its number from 1: `line 1`, `arc 2`."""
        return f"{self.elements[number - 1].kind} {number}"

    def parts(self) -> Iterator[tuple[str, int]]:
        """The names of its elements, and of the corners after them, each with the number of the element."""
        for number, element in enumerate(self.elements, 1):
            yield self.name_of(number), number
            if element.corner:
                yield f"corner {number}", number

    def solve(self, *, with_ranges: bool = False) -> Any:
        """All that is known of it, however little that is: a `SketchAnswer`, with `answer`, `elements` and `missing`.

        With ranges, each entry that would finish it has its ranges, and each finding its fixes; that takes longer.
        """
        return from_above("solve_sketch", self, with_ranges=with_ranges)

    def system(self) -> EquationSystem:
        """The equations of its contour, as far as it is given. Raises ValueError where it has no element, or begins
        nowhere."""
        answer: Answer | None = self.solve().answer
        if answer is None:
            raise ValueError("a system takes an element, and a place where the sketch begins")
        return answer.system

    def save(self, path: str | Path) -> None:
        """Write it as a file that `read_sketch` reads: JSON where the name ends so, else TOML. Raises UserError where
        it cannot be written."""
        text = from_above("write_sketch", self, as_json=Path(path).suffix.lower() == ".json")
        write_whole(Path(path), (text.encode(),), keeps_backup=False)

    def changed(self, number: int, **fields: Any) -> "ContourSketch":
        """The sketch with other fields of an element, by its number from 1; its words are one field:
        `changed(2, words={"R": 12})`. Raises ValueError for an element or a field that there is not."""
        if not 1 <= number <= len(self.elements):
            raise ValueError(f"there is no element {number}; the sketch has {len(self.elements)}")
        if unknown := [name for name in fields if name not in SketchElement.__struct_fields__]:
            raise ValueError(f"{unknown[0]} is no field; an element has {', '.join(SketchElement.__struct_fields__)}")
        element = replace(self.elements[number - 1], **fields)
        return replace(self, elements=(*self.elements[: number - 1], element, *self.elements[number:]))
