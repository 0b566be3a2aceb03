"""Edits of a whole program: blanks, and block numbers with their jumps."""

from lsprotocol import types
from pygls.exceptions import JsonRpcException

from contoursolve import BlockNumber, block_number_at, format_program, rename_block
from contoursolve.lsp.opened import Opened
from contoursolve.lsp.positions import edits

_REFUSED = -32803
"""RequestFailed of the protocol: the client shows the message, and nothing is changed."""


_TOO_LONG = 9


class EditRefusedError(JsonRpcException):
    """A request that cannot be met, with the reason for the user."""

    def __init__(self, message: str) -> None:
        super().__init__(message, _REFUSED)


def formatted(opened: Opened) -> list[types.TextEdit]:
    """The edits that put blanks and block numbers right. Raises EditRefusedError if block numbers cannot be."""
    program, step = opened.program, opened.options.block_numbers
    try:
        new = format_program(program.text, control=program.dialect, block_numbers=step)
    except ValueError as error:
        raise EditRefusedError(f"nothing was changed: {error}") from None
    ends = str.maketrans("", "", "\r\n")
    lines = enumerate(new.replace("\r\n", "\n").replace("\r", "\n").split("\n"), 1)
    return edits(opened.places, {line: text.translate(ends) for line, text in lines})


def block_number_under(opened: Opened, position: types.Position) -> types.PrepareRenamePlaceholder | None:
    """The block number under the cursor, of a block that there is; None if there is none."""
    found = _number(opened, position)
    if found is None or found.line is None:
        return None
    return types.PrepareRenamePlaceholder(opened.places.range(*found.span), str(found.number))


def renamed(opened: Opened, position: types.Position, name: str) -> types.WorkspaceEdit | None:
    """Another number for a block and every jump to it. Raises EditRefusedError if that cannot be."""
    found, digits = _number(opened, position), name.strip().lstrip("Nn")
    if found is None or found.line is None:
        return None
    if not (digits.isascii() and digits.isdigit() and len(digits) < _TOO_LONG):
        raise EditRefusedError(f"a block number is a whole number, not {name!r}")
    try:
        changes = rename_block(opened.program.text, found.line, int(digits), control=opened.program.dialect)
    except ValueError as error:
        raise EditRefusedError(f"nothing was changed: {error}") from None
    return opened.workspace_edit([types.TextEdit(opened.places.range(*each.span), each.text) for each in changes])


def target_of(opened: Opened, position: types.Position) -> types.Location | None:
    """The block to which the jump under the cursor goes; None if there is no jump, or no such block."""
    found = _number(opened, position)
    if found is None or found.line is None:
        return None
    return types.Location(opened.uri, opened.places.whole(found.line, found.line))


def _number(opened: Opened, position: types.Position) -> BlockNumber | None:
    line, column = opened.places.place(position)
    return block_number_at(opened.program.text, line, column, control=opened.program.dialect)
