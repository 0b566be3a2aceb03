"""The moves of the coordinate system on Fanuc and its kin, as tables: work offsets, tool offsets, data setting,
variables of the machine."""

from collections.abc import Iterator, Mapping
from decimal import Decimal

from msgspec import Struct

from contoursolve.diagnostics import Source
from contoursolve.gcode import Block
from contoursolve.reading import LENGTH, TOOL, WORK, Entry, ZeroMove, ZeroRow, ZeroTable, table_of

_FIRST_CODE = 54
_OF_WORK, _OF_FURTHER, _OF_PARAMETERS = 2, 20, 50
"""L of G10: work offsets, further ones, and from here on parameters, among which offsets are as well."""
_PLACES = 20
"""Variables of each work offset, one an axis."""
_EXTERNAL, _BY_CODE = 5201, 5221
_WORK_OFFSETS = {_EXTERNAL: 1, _BY_CODE: 6, 7001: 48, 14001: 300}
"""The first variables of tables of work offsets, and how many offsets follow."""


class _Family(Struct, frozen=True):
    """The differences between controls: the code of further work offsets, and the axes that the coordinates of a
    tool offset move."""

    further: Decimal
    is_mill: bool

    def tool(self, number: Decimal | int | None) -> Entry:
        """The offset of a tool by its number; of a lathe, 0 shifts the work."""
        if self.is_mill:
            return Entry(LENGTH, axes=("Z",))
        return Entry(TOOL, (("T", number % _GEOMETRY),) if number else None, ("X", "Z"), digits=2)

    def axes_at(self, place: int) -> tuple[str, ...]:
        """The axes of which one has a place among variables: a third one of a lathe may be Z."""
        return (("X",), ("Y",) if self.is_mill else ("Z",), ("Z",))[place] if place < 3 else ("-",)  # noqa: PLR2004

    def entries_of(self, block: Block, axes: tuple[str, ...]) -> Iterator[Entry]:
        """The entries of tables that G10 changes."""
        table, place = block.find("L"), block.find("P")
        kind, number = (word.number if word is not None else None for word in (table, place))
        if table is not None and kind is None:
            yield Entry(WORK, None, axes)
        elif kind == _OF_WORK:
            yield Entry(WORK, (("G", _FIRST_CODE - 1 + number),) if number else None, axes)
        elif kind == _OF_FURTHER:
            yield Entry(WORK, None if number is None else (("G", self.further), ("P", number)), axes)
        elif kind is None or kind < _OF_FURTHER:
            yield self.tool(number)
        elif kind >= _OF_PARAMETERS:
            yield Entry(WORK, None, axes)

    def entries_set(self, name: str) -> Iterator[Entry]:
        """The entries of tables that a variable is; any may be one whose index is not known."""
        number = int(name[1:] or 0) if name else 0
        for first, count in _WORK_OFFSETS.items():
            at, place = divmod(number - first, _PLACES)
            if 0 <= at < count:
                by_code = (("G", _FIRST_CODE + at),) if first == _BY_CODE else (("G", self.further), ("P", at + 1))
                yield Entry(WORK, None if first == _EXTERNAL else by_code, self.axes_at(place))
        if _BY_AXIS <= number < _BY_AXIS + 100 * _AXES_BY_AXIS:
            place, at = divmod(number - _BY_AXIS, 100)
            is_shift = at == 0 or not self.is_mill
            yield Entry(WORK, None if is_shift else (("G", _FIRST_CODE - 1 + at),), self.axes_at(place))
        for first, last in _TOOLS:
            if first <= number <= last:
                yield self.tool((number - first) % (100 if last < _GEOMETRY else 1000) + 1)
        if not name:
            yield Entry(WORK)


_GEOMETRY = 10000
"""From here on, numbers of tool offsets mean their geometry."""
_TOOLS = ((2001, 2499), (10001, 13999))
"""Variables of tool offsets."""
_BY_AXIS, _AXES_BY_AXIS = 2500, 4
"""Variables of work offsets by axes: from #2500 on those of X, from #2600 on those of the next axis."""


_VARIABLES = ", ".join(f"#{first}" for first in sorted((*_WORK_OFFSETS, _BY_AXIS, *(first for first, _ in _TOOLS))))
"""The first ones of each table."""


def zero_table(
    source: Source, axes: tuple[str, ...], *more: ZeroRow, numbers: Mapping[str, int] | None = None, further: str = ""
) -> ZeroTable:
    """The moves of the coordinate system of a control of this kind, with rows of its own; `further` is the code of
    further work offsets, where that is not G54.1."""
    family = _Family(Decimal(further or "54.1"), "Y" in axes)
    rows = [
        ZeroRow("G54", ZeroMove.SELECT, source, WORK, words="P", indexed=family.further),
        ZeroRow("G55 G56 G57 G58 G59", ZeroMove.SELECT, source, WORK),
        ZeroRow("G54.1", ZeroMove.SELECT, source, WORK, words="P"),
        ZeroRow("G10", ZeroMove.DATA, source, entries=family.entries_of),
    ]
    if family.is_mill:
        rows += [
            ZeroRow("G52", ZeroMove.SET, source),
            ZeroRow("G43 G44", ZeroMove.SELECT, source, LENGTH, ("Z",), words="H", goes_on=True),
            ZeroRow("G49", ZeroMove.SELECT, source, LENGTH, ("Z",)),
            ZeroRow("M6", ZeroMove.OTHER, source, LENGTH, ("Z",)),
        ]
    else:
        rows.append(ZeroRow("T", ZeroMove.SELECT, source, TOOL, ("X", "Z")))
    shifted = axes if family.is_mill else ()
    beside = (ZeroRow(_VARIABLES, ZeroMove.DATA, source),)
    return table_of((*rows, *more), numbers or {}, shifted, variables=family.entries_set, beside=beside)


def length_rows(source: Source) -> tuple[ZeroRow, ...]:
    """H of mills on which it means nothing else."""
    return (ZeroRow("H", ZeroMove.SELECT, source, LENGTH, ("Z",), words="H", goes_on=True),)


def haas_rows(source: Source) -> tuple[ZeroRow, ...]:
    """Those of Haas alone: G110 is G154 P1."""
    extended = (
        ZeroRow(f"G{110 + at}", ZeroMove.SELECT, source, WORK, stands_for=(("G", 154), ("P", at + 1)))
        for at in range(20)
    )
    return (ZeroRow("G154", ZeroMove.SELECT, source, WORK, words="P"), *extended)
