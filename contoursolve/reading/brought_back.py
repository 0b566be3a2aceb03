"""The modes that SAVE brings back where a subprogram ends: the modes and frames at its call, as a state and as blocks.

Of G54 and shifts, SINUMERIK's basic functions print it (09/2011, p. 793); of other G codes, it is assumed.
"""

from collections.abc import Collection, Sequence

from msgspec.structs import replace

from contoursolve.diagnostics import Span
from contoursolve.execution import WrittenBack
from contoursolve.gcode import Block
from contoursolve.reading.lexicon import Diameter, Effect
from contoursolve.reading.modal_state import Mode, Modes, State, rows_of, state_moved
from contoursolve.reading.moved_zero import WORK, zero_brought_back, zero_written_back


def bring_back(before: State, now: State, reason: str, span: Span) -> State:
    """The state where a subprogram ends, given the one where it was called: the tool stays where it is, and so do words
    that are no G codes."""
    doubts = [each for each in before.doubts.items() if isinstance(each[0], Mode)]
    words = [each for each in now.doubts.items() if isinstance(each[0], str)]
    doubts_of_both = dict([*doubts, *words])
    state = replace(before, axes=now.axes, moved_with=now.moved_with, memory=now.memory, doubts=doubts_of_both)
    return state_moved(state, zero_brought_back(before.zero, now.zero, tuple(now.axes), reason), span)


def write_back(before: State, now: State, earlier: Sequence[Block], ran: Sequence[Block], modes: Modes) -> WrittenBack:
    """Blocks for a program without calls that say what is in force again behind some blocks that ran, given those that
    did so earlier; no block says what is not known."""
    old, new, codes = before.in_force(), now.in_force(), list[str]()
    changed = [mode for mode in _ORDER if old[mode] != new[mode] or before.doubts.get(mode) != now.doubts.get(mode)]
    for mode in changed:
        if mode in before.doubts:
            return WrittenBack(refused=f"{mode.value} at the call is not known: {before.doubts[mode]}")
        codes.append(_code(mode, before, modes))
    rows = [row for block in ran for row, _ in modes.zero.rows_in(block) if row.group in ("", WORK)]
    lines = zero_written_back(before.zero, now.zero, modes.zero, modes.axes, before.unit.in_mm) if rows else iter(())
    if lines is None:
        return WrittenBack(
            refused="which work offset and shift are in force at the call is not known: select them before it"
        )
    others = _left_by(ran, modes)
    earlier_ones = _left_by(earlier, modes, others.keys())
    codes += (earlier_ones[group] for group, code in others.items() if earlier_ones.get(group, code) != code)
    left = [code for group, code in others.items() if group not in earlier_ones]
    told = f"what was in force before {', '.join(left)} is again, and no line says what: write it before the call"
    return WrittenBack((*([" ".join(filter(None, codes))] if any(codes) else []), *lines), told if left else "")


def _left_by(blocks: Sequence[Block], modes: Modes, groups: Collection[str] | None = None) -> dict[str, str]:
    """The codes that blocks leave in force, by their groups: all of them, or those that are asked for."""
    found = dict[str, str]()
    for block in reversed(blocks):
        if groups is not None and len(found) == len(groups):
            break
        for row in reversed(rows_of(block, modes)):
            if row.group and (groups is None or row.group in groups):
                found.setdefault(row.group, row.text)
    return dict(reversed(found.items()))


_ORDER = (Mode.UNIT, Mode.PLANE, Mode.INCREMENTS, Mode.DIAMETER, Mode.COMPENSATION, Mode.MOTION)


def _code(mode: Mode, state: State, modes: Modes) -> str:
    """The code that puts a mode in force as it is in a state; empty where there is none."""
    match mode:
        case Mode.UNIT:
            return modes.code_of(state.unit)
        case Mode.PLANE:
            return state.plane.code
        case Mode.INCREMENTS:
            effect = Effect.INCREMENTAL if state.is_incremental else Effect.ABSOLUTE
            return next((each.text for each in modes.codes.values() if each.effect is effect), "")
        case Mode.COMPENSATION:
            return f"G{state.compensation}"
        case Mode.MOTION:
            row = None if state.motion is None else modes.codes.get(state.motion)
            return "" if row is None else row.text
    diameter = state.diameter
    if diameter is Diameter.BY_PLANE:
        # No code says that; here, one of them is the same.
        diameter = Diameter.ON if state.counts_diameters() else Diameter.OFF
    return next((each.text for each in modes.codes.values() if each.diameter is diameter), "")
