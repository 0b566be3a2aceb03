"""The start point that is stated apart from a program: where the program begins, and what its words count in."""

from msgspec import Struct

from contoursolve.diagnosis import Context, explain_start_diameter, explain_start_units, join
from contoursolve.diagnostics import Diagnostic, UserError
from contoursolve.geometry import Length
from contoursolve.program.outside_contours import findings_of_block
from contoursolve.program.request import Request
from contoursolve.reading import TURNED, Control, ParsedContour, State, advance


class StartError(UserError, ValueError):
    """A start point that is stated apart from a program and cannot be read; the message says why."""


class StartCount(Struct, frozen=True):
    """Units in which a start point that is stated apart counts, until a contour counts otherwise."""

    unit: Length
    has_diameters: bool | None = None
    """True where X counted diameters, if codes switch that; None if they do not, and behind the first contour."""


def state_before(asked: Request, control: Control) -> tuple[State, tuple[Diagnostic, ...]]:
    """The modal state before a program, behind the block that states its start point apart; and what is found about
    that block."""
    state, found = control.initial_state(asked.unit), list[Diagnostic]()
    for block in asked.start.blocks if asked.start else ():
        found += findings_of_block(asked, block)
        state = advance(state, block, control.modes)
    return state, tuple(found)


def start_count(asked: Request, state: State) -> StartCount | None:
    """The units in which the start point counts, in the state behind it; None where none is stated apart."""
    if not asked.start:
        return None
    has_x = any(word.address == TURNED for block in asked.start.blocks for word in block.words)
    is_switched = has_x and state.diameter is not None
    return StartCount(state.unit, state.counts_diameters() if is_switched else None)


def compare_count(
    count: StartCount | None, found: ParsedContour | None, asked: Request
) -> tuple[StartCount | None, tuple[Diagnostic, ...]]:
    """The same behind a contour, if there is one; and findings where the contour counts in other units, or other
    diameters."""
    if count is None or found is None or not asked.start:
        return count, ()
    here, block, told = found.after, asked.start.blocks[0], list[Diagnostic]()
    if here.unit is not count.unit:
        told.append(explain_start_units(Context(asked.rules, count.unit, place=block.span), here.unit, block))
    if count.has_diameters is not None and here.counts_diameters() is not count.has_diameters:
        context = Context(asked.rules, here.unit, place=block.span)
        told.append(explain_start_diameter(context, here, _code_of_x(here, asked.control), block))
    return StartCount(here.unit), tuple(told)


def _code_of_x(state: State, control: Control | None) -> str:
    """The code by which X is what it is in a state."""
    codes = control.modes.codes.values() if control else ()
    return next((code.text for code in codes if code.diameter is state.diameter), state.plane.code)


def check_places(asked: Request) -> None:
    """Raise StartError where a start without any code has words that are no places, and would mean nothing."""
    control, start = asked.control, asked.start
    if control is None or start is None:
        return
    addresses = control.modes.lexicon.addresses
    words = [word for block in start.blocks for word in block.words]
    idle = [word for word in words if word.address in addresses and not addresses[word.address].axis]
    idle = [word for word in idle if word.address not in _MACHINE]
    if idle and all(word.address in addresses or word.address in _MACHINE for word in words):
        axes = join([name for name, each in addresses.items() if each.axis and each.axis == name])
        told = f"{join([word.text for word in idle])} states no place"
        raise StartError(f'the start "{start.text}": {told}; the axes of {control.name} are {axes}')


_MACHINE = ("F", "S", "T", "M", "N", "D", "H")
"""Addresses that stand beside a position, and state none."""


def check_start(asked: Request) -> None:
    """Raise StartError where words that state the start point cannot be read, or give no position."""
    control, start = asked.control, asked.start
    if control is None or start is None or not start.text.strip():
        return
    _, found = state_before(asked, control)
    error = next((each for each in found if each.is_error), None)
    axes = {name for name, each in control.modes.lexicon.addresses.items() if each.axis}
    has_position = any(word.address in axes for block in start.blocks for word in block.words)
    if error is not None or not has_position:
        told = error.message if error is not None else "it gives no position"
        raise StartError(
            f'--start "{start.text}": {told}; write words such as "X40. Z0.", as {control.name} reads them'
        )
