"""The matrix of a system of equations on a page: its words down, its unknowns across, in the order of its blocks."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from contoursolve.diagnosis import BlockState, EquationSystem
from contoursolve.numeric import symbolic
from contoursolve.pictures.page import (
    PAD,
    SIZE,
    WIDTH,
    Anchor,
    Box,
    Dot,
    Item,
    Stroke,
    Text,
    TextRun,
    shorten,
    visible,
    width_of,
)
from contoursolve.pictures.sheet import Sheet
from contoursolve.pictures.theme import DASHES, Role
from contoursolve.pictures.value_axes import page_of

MOST_CELLS = 60
"""Rows, and columns, that can be read."""

_LEFT, _TOP, _NUMBERS = 190.0, 46.0, 26.0
"""Pixels for the words, above the names of the unknowns, and for the numbers of the blocks."""

_WIDEST, _HIGH, _GAP, _SMALL = 84.0, 26.0, 8.0, 11.0
"""Pixels of a cell, between texts and cells, and of the font in cells."""

_FIELDS: Mapping[BlockState, Role] = {
    BlockState.SOLVED: Role.SOLVED_FIELD,
    BlockState.OPEN: Role.OTHER_FIELD,
    BlockState.REPEATED: Role.REFUSED_FIELD,
}
_FRAMES: Mapping[BlockState, Role] = {
    BlockState.SOLVED: Role.INK,
    BlockState.OPEN: Role.FREE,
    BlockState.REPEATED: Role.IGNORED,
}
_TOLD: Mapping[BlockState, str] = {
    BlockState.SOLVED: "Each block with a number is solved from the columns before it.",
    BlockState.OPEN: "The unknowns in the dashed frame stay open.",
    BlockState.REPEATED: "The lowest rows, in the dotted frame, repeat what others say.",
}


class _Grid(NamedTuple):
    """The cells of a matrix on the page."""

    left: float
    top: float
    wide: float

    def cell(self, row: int, column: int, rows: int = 1, columns: int = 1) -> Box:
        left, top = self.left + column * self.wide, self.top + row * _HIGH
        return Box(left, top, left + columns * self.wide, top + rows * _HIGH)


def lay_out_matrix(system: EquationSystem, title: str | None = None) -> Sheet:
    """The page of the matrix of a system. Raises ValueError for one that is too large to be read."""
    rows = [row for block in system.blocks for row in block.rows]
    columns = [column for block in system.blocks for column in block.columns]
    if max(len(rows), len(columns)) > MOST_CELLS:
        raise ValueError(
            f"a matrix of {len(rows)} equations and {len(columns)} unknowns cannot be read; {MOST_CELLS} of each can"
        )
    names = [str(system.unknowns[column].symbol) for column in columns]
    wide = min(_WIDEST, (WIDTH - 2 * PAD - _LEFT - _NUMBERS) / max(len(columns), 1))
    widest = max((width_of(name, SIZE) for name in names), default=0.0)
    is_turned = widest > wide - _GAP
    grid = _Grid(PAD + _LEFT, _TOP + (widest if is_turned else SIZE) + _GAP, wide)
    items = [
        *_heads(system, grid, rows, names, is_turned=is_turned),
        *_cells(system, grid, rows, columns),
        *_frames(system, grid, len(columns)),
    ]
    found = f"{len(rows)} equations, {len(columns)} unknowns; {system.rank} equations say something new"
    told = [(_TOLD[state], Role.MUTED) for state in BlockState if any(each.state is state for each in system.blocks)]
    if any(isinstance(item, Dot) for item in items):
        told.append(("A dot is a derivative that is too long for its cell.", Role.MUTED))
    bottom = grid.cell(len(rows), 0).top + 24.0
    return page_of(title if title is not None else found, items, told, bottom)


def describe_matrix(system: EquationSystem) -> str:
    """The blocks in words."""
    told = []
    for number, block in enumerate(system.blocks, 1):
        unknowns = ", ".join(str(system.unknowns[column].symbol) for column in block.columns)
        words = " and ".join(_word(system, row) for row in block.rows) or "nothing"
        match block.state:
            case BlockState.SOLVED:
                told.append(f"{number}. {unknowns} from {words}")
            case BlockState.OPEN:
                told.append(f"still open: {unknowns}, about which there is {words}")
            case BlockState.REPEATED:
                told.append(f"what others say, too: {words}")
    return visible("; ".join(told))


def _word(system: EquationSystem, row: int) -> str:
    return system.statements[row].word or "the form"


def _heads(
    system: EquationSystem, grid: _Grid, rows: list[int], names: list[str], *, is_turned: bool
) -> Iterator[Item]:
    """The words before the rows, and the unknowns above the columns."""
    for place, row in enumerate(rows):
        told = shorten(visible(_word(system, row)), _LEFT - _GAP, SIZE)
        role = Role.GIVEN if system.statements[row].word else Role.MUTED
        at = grid.left - _GAP, grid.cell(place, 0).bottom - 8.0
        yield Text(at, (TextRun(told, role),), SIZE, Anchor.END)
    for place, name in enumerate(names):
        cell = grid.cell(0, place)
        middle = (cell.left + cell.right) / 2
        run = (TextRun(name, Role.INK),)
        if is_turned:
            yield Text((middle + 4.0, cell.top - _GAP), run, SIZE, Anchor.START, is_turned=True)
        else:
            yield Text((middle, cell.top - _GAP), run, SIZE, Anchor.MIDDLE)


def _cells(system: EquationSystem, grid: _Grid, rows: list[int], columns: list[int]) -> Iterator[Item]:
    """The derivatives that are not zero, on a field where they belong to the block of their row."""
    block_of = {row: block for block in system.blocks for row in block.rows}
    for down, row in enumerate(rows):
        block = block_of[row]
        for across, column in enumerate(columns):
            entry = system.jacobian[row, column]
            if entry == 0:
                continue
            is_own = block.state is BlockState.REPEATED or column in block.columns
            cell, role = grid.cell(down, across), Role.INK if is_own else Role.MUTED
            if is_own:
                yield cell.filled(_FIELDS[block.state])
            told, middle = symbolic.text(entry), (cell.left + cell.right) / 2
            if width_of(told, _SMALL) <= grid.wide - 4.0:
                yield Text((middle, cell.bottom - 9.0), (TextRun(told, role),), _SMALL, Anchor.MIDDLE)
            else:
                yield Dot((middle, (cell.top + cell.bottom) / 2), 3.0, role)


def _frames(system: EquationSystem, grid: _Grid, count: int) -> Iterator[Item]:
    """A frame around each block, with its number where it is solved."""
    down = across = 0
    for number, block in enumerate(system.blocks, 1):
        is_solved, wide = block.state is BlockState.SOLVED, len(block.columns)
        first, wide = (0, count) if block.state is BlockState.REPEATED else (across, wide)
        box, role = grid.cell(down, first, len(block.rows), wide), _FRAMES[block.state]
        corners = ((box.right, box.top), (box.right, box.bottom), (box.left, box.bottom), (box.left, box.top))
        yield Stroke((box.left, box.top), corners, role, 1.2, () if is_solved else DASHES[role])
        if is_solved:
            at = grid.cell(down, count).left + _GAP, (box.top + box.bottom) / 2 + 4.0
            yield Text(at, (TextRun(f"{number}", Role.INK),), SIZE, is_bold=True)
        down, across = down + len(block.rows), across + len(block.columns)
