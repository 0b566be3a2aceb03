"""Places in a text: a client counts lines from 0 and UTF-16 units, contoursolve lines and characters from 1."""

from collections.abc import Callable, Iterable, Mapping

from lsprotocol import types

import contoursolve

Place = tuple[int, int]
"""A line and a column, both from 1."""

_FAR = 0xFFFF
"""The last character that takes one unit of UTF-16."""


class ClientPositions:
    """The places of one program, in the units that the client counts."""

    def __init__(self, program: "contoursolve.OpenProgram", encoding: types.PositionEncodingKind | str) -> None:
        self.program = program
        self._width = _WIDTHS.get(encoding, _WIDTHS[types.PositionEncodingKind.Utf16])

    def text(self, line: int) -> str:
        """A line, without its end."""
        return self.program.line(line)

    def position(self, line: int, column: int) -> types.Position:
        """A place as the client counts it; behind the end of a line is its end."""
        return types.Position(max(line, 1) - 1, sum(map(self._width, self.text(line)[: max(column, 1) - 1])))

    def range(self, line: int, column: int, end_column: int) -> types.Range:
        """A stretch of a line."""
        return types.Range(self.position(line, column), self.position(line, end_column))

    def whole(self, first: int, last: int) -> types.Range:
        """The lines from one to another, without the last one's end."""
        return types.Range(self.position(first, 1), self.position(last, len(self.text(last)) + 1))

    def place(self, position: types.Position) -> tuple[int, int]:
        """The line and the column of a place that the client names."""
        line, units = position.line + 1, position.character
        for column, character in enumerate(self.text(line), 1):
            if units <= 0:
                return line, column
            units -= self._width(character)
        return line, len(self.text(line)) + 1


def edits(places: ClientPositions, changes: Mapping[int, str | None]) -> list[types.TextEdit]:
    """The edits that write other texts for lines, or take out a line where there is none."""
    return _as_client(places, places.program.edits_of(changes))


def edits_to(places: ClientPositions, text: str) -> list[types.TextEdit]:
    """The edits that make another text of a program."""
    return _as_client(places, places.program.changes_to(text))


def _as_client(places: ClientPositions, edits: Iterable[tuple[Place, Place, str]]) -> list[types.TextEdit]:
    return [
        types.TextEdit(types.Range(places.position(*begin), places.position(*end)), new) for begin, end, new in edits
    ]


def _units_of_utf16(character: str) -> int:
    return 2 if ord(character) > _FAR else 1


def _units_of_utf8(character: str) -> int:
    return len(character.encode("utf-8", "surrogatepass"))


_WIDTHS: dict[types.PositionEncodingKind | str, Callable[[str], int]] = {
    types.PositionEncodingKind.Utf16: _units_of_utf16,
    types.PositionEncodingKind.Utf8: _units_of_utf8,
    types.PositionEncodingKind.Utf32: len,
}
