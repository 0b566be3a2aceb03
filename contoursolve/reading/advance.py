"""Follows the modal state through blocks that are not contours."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal
from functools import partial

from contoursolve.model import Length
from contoursolve.reading.codes import Code, Effect
from contoursolve.reading.lexicon import Lexicon
from contoursolve.reading.setting import Convention, Setting
from contoursolve.reading.state import Awaited, Position, State
from contoursolve.source import Span
from contoursolve.syntax import Block, FaultKind, Macro, Word
from contoursolve.tolerance import RADIUS_DIFFERENCE


@dataclass(frozen=True, slots=True)
class Modes:
    """What following the state of a control needs to know of it."""

    lexicon: Lexicon
    codes: Mapping[int, Code]
    axes: tuple[str, ...]
    calls: frozenset[int]
    """M codes that call or end a subprogram."""
    settings: Mapping[str, str] = field(default_factory=dict)
    """The values of settings that are not the default ones, by name."""

    def convention(self, setting: Setting) -> Convention:
        """A setting with its value."""
        return Convention(setting, self.settings.get(setting.name, setting.default))

    @property
    def radius_difference(self) -> float:
        """How much the radii at two points of an arc may differ, mm: a setting where a machine parameter tells."""
        return float(self.settings.get("radius-difference", RADIUS_DIFFERENCE))


def codes_of(block: Block, modes: Modes) -> list[Code | Word]:
    """The rows of a block's G codes; a code without a row is given as its word."""
    found: list[Code | Word] = []
    for word in block.words:
        if word.address == "G":
            row = None if word.number is None else modes.codes.get(word.number)  # type: ignore[call-overload]
            found.append(row or word)
    return found


def apply_modes(state: State, block: Block, modes: Modes) -> State:
    """The state with the block's G codes in force, before its motion."""
    for code in codes_of(block, modes):
        if isinstance(code, Word):
            continue
        match code.effect:
            case Effect.MOTION | Effect.CYCLE:
                state = state if state.motion == code.number else replace(state, motion=code.number)
            case Effect.CANCEL:
                state = replace(state, motion=None)
            case Effect.PLANE:
                state = replace(state, plane=code.plane or state.plane)
            case Effect.UNITS:
                state = replace(state, unit=code.unit or state.unit)
            case Effect.ABSOLUTE | Effect.INCREMENTAL:
                state = replace(state, is_incremental=code.effect is Effect.INCREMENTAL)
            case Effect.COMPENSATION:
                state = replace(state, compensation=code.number)
            case Effect.SHIFT | Effect.FRAME:
                reason = f"G{code.number} changes the coordinate system"
                state = state.lose(modes.axes, reason, block.span)
            case _:
                pass
    return state


def advance(state: State, block: Block, modes: Modes) -> State:
    """The state after a block that is not a contour."""
    if not block.words and not block.faults and block.macro is None:
        return state
    if block.macro is Macro.FLOW:
        return state.lose(modes.axes, "a macro statement may jump", block.span)
    state = apply_modes(state, block, modes)
    if block.find("O"):
        state = state.lose(modes.axes, "a new program begins", block.span)
    for word in block.words:
        if word.address == "M" and word.number in modes.calls:
            return state.lose(modes.axes, f"{word.text} calls or ends a subprogram", word.span)
    codes = codes_of(block, modes)
    for code in codes:
        if isinstance(code, Word):
            # Whatever it does, it may do to every axis.
            return state.lose(modes.axes, f"{code.text} is not known to contoursolve", code.span)
    lost = _lost_by_faults(block, modes)
    effect, reason = _effect(state, codes, modes)
    words = [word for word in block.words if _axis(word, modes)]
    if effect is Effect.NO_MOTION:
        return state
    if effect is Effect.SINGLE or (effect is Effect.CYCLE and words):
        axes = tuple(dict.fromkeys(_axis(word, modes) for word in words)) or modes.axes
        return state.lose(axes, reason, block.span)
    if words:
        state = state.move(positions(state, words, modes, block.is_skippable))
    return state.move({axis: Position(None, "the block has an error", span) for axis, span in lost.items()})


def positions(state: State, words: list[Word], modes: Modes, is_skippable: bool) -> dict[str, Position]:
    """Where the axis words of a motion lead."""
    moved: dict[str, Position] = {}
    for word in words:
        axis = _axis(word, modes)
        is_step = state.is_incremental or modes.lexicon.addresses[word.address].is_increment
        moved[axis] = _led(word, axis in moved, state.axes[axis] if is_step else None, state.unit, modes, is_skippable)
    return moved


def absolute_positions(words: list[Word], unit: Length, modes: Modes) -> dict[str, Position]:
    """Where absolute axis words lead."""
    moved: dict[str, Position] = {}
    for word in words:
        axis = _axis(word, modes)
        moved[axis] = _led(word, axis in moved, None, unit, modes, is_skippable=False)
    return moved


def _led(
    word: Word, is_second: bool, before: Position | None, unit: Length, modes: Modes, is_skippable: bool
) -> Position:
    """Where an axis word leads; `before` is where an increment counts from, None for a coordinate."""
    if is_second:
        return Position(None, f"{_axis(word, modes)} is given twice", word.span)
    value = modes.lexicon.value(word, unit)
    if value is None:
        return Position(None, f"{word.text} depends on a variable", word.span)
    if before is None:
        return Position(value, word.text, word.span, is_skippable, word)
    if isinstance(before, Awaited):
        return before.then(partial(_step, by=value, word=word, is_skippable=is_skippable))
    return _step(before, value, word, is_skippable)


def _step(before: Position, by: Decimal, word: Word, is_skippable: bool) -> Position:
    """Where an increment leads, mm."""
    if before.value is None:
        return before
    return Position(before.value + by, word.text, word.span, is_skippable or before.is_skippable, word)


def _axis(word: Word, modes: Modes) -> str:
    row = modes.lexicon.addresses.get(word.address)
    return row.axis if row else ""


def _effect(state: State, codes: Sequence[Code | Word], modes: Modes) -> tuple[Effect, str]:
    """What a block of these G codes does with its axis words, and the reason to give if the position is lost."""
    for code in codes:
        if isinstance(code, Word):
            continue
        if code.effect is Effect.SINGLE:
            return Effect.SINGLE, f"the end of G{code.number} ({code.meaning}) is not followed"
        if code.effect in (Effect.NO_MOTION, Effect.FRAME):
            return Effect.NO_MOTION, ""
        if code.effect is Effect.PRESET:
            return Effect.MOTION, ""
    modal = modes.codes.get(state.motion) if state.motion is not None else None
    if modal and modal.effect is Effect.CYCLE:
        return Effect.CYCLE, f"the end of G{modal.number} ({modal.meaning}) is not followed"
    return Effect.MOTION, ""


def _lost_by_faults(block: Block, modes: Modes) -> dict[str, Span]:
    """The axes whose words could not be read."""
    lost: dict[str, Span] = {}
    for fault in block.faults:
        row = modes.lexicon.addresses.get(fault.address)
        if fault.kind is FaultKind.BLOCK_TOO_LONG:
            lost.update(dict.fromkeys(modes.axes, fault.span))
        elif row and row.axis and fault.kind is not FaultKind.COMMENT_NOT_CLOSED:
            lost[row.axis] = fault.span
        elif fault.kind is FaultKind.COMMA_WITHOUT_ADDRESS:
            lost.update(dict.fromkeys(modes.axes, fault.span))
    return lost
