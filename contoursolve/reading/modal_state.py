"""The modal state of a control, where the tool is and what is in force, followed through blocks and plain lines."""

import re
from cmath import rect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace as replace_fields
from decimal import Decimal
from enum import Enum
from functools import cache, partial
from itertools import groupby
from math import radians
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Span
from contoursolve.execution import MOST_BLOCKS, Limit, MacroLanguage
from contoursolve.gcode import (
    AXES,
    ISO,
    Block,
    FaultKind,
    Macro,
    Passage,
    Syntax,
    Word,
    blocks_in,
    find_lookalikes,
    lookalike_at,
    motion_of,
    parse_block,
    words_of,
)
from contoursolve.geometry import Length, Plane, Start
from contoursolve.reading.arc_table import ArcTable
from contoursolve.reading.contour_form import Convention, Setting
from contoursolve.reading.lexicon import END_OF, TURNED, Bearing, Code, Diameter, Effect, Lexicon, WithoutPoint
from contoursolve.reading.moved_zero import (
    NOTHING_MOVES,
    UNKNOWN_ZERO,
    Moved,
    Zero,
    ZeroRow,
    ZeroTable,
    change_entries,
    commanded,
    entries_of_assignment,
    forget_shifts,
    is_along_axes,
    move_zero,
    shift_in,
    turns_in,
    unknown_zero,
    with_turn,
)
from contoursolve.tolerance import TRAVEL


@dataclass(frozen=True, slots=True)
class Position:
    """One coordinate in mm (X of a lathe as radius), or None with the reason why it is not known.

    `span` is the place in the program that set it or made it unknown.
    """

    value: Decimal | None
    reason: str
    span: Span | None = None
    is_skippable: bool = False
    """The block that set it begins with `/`."""
    word: Word | None = None
    """The axis word that set it, where one did."""
    assumed: Decimal | None = None
    """The place where it would be, mm, if the contour that lost it had its best fix."""
    beyond: Decimal = Decimal(0)
    """The way that increments have led beyond the place that is not known, mm."""

    def step(self, by: Decimal) -> "Position":
        """An unknown place, some mm further."""
        assumed = None if self.assumed is None else self.assumed + by
        return replace_fields(self, beyond=self.beyond + by, assumed=assumed)


class Awaited(Position):
    """A coordinate that is found when somebody looks at it.

    `wave` counts the contours in a row, each of which begins where the one before it ends, that have to be solved
    before; `find` has them solved.
    """

    __slots__ = ("_depth", "_find", "_found", "wave")
    wave: int
    _find: Callable[[], Position] | None
    _found: Position | None
    _depth: int

    def __init__(self, find: Callable[[], Position], wave: int = 0, depth: int = 0) -> None:
        for name, value in (("_find", find), ("_found", None), ("wave", wave), ("_depth", depth)):
            object.__setattr__(self, name, value)

    def __eq__(self, other: object) -> bool:
        return self.found() == (other.found() if isinstance(other, Awaited) else other)

    def __hash__(self) -> int:
        return hash(self.found())

    def __reduce__(self) -> Any:
        return replace_fields, (self.found(),)

    def found(self) -> Position:
        """The position."""
        if self._found is None and self._find is not None:
            object.__setattr__(self, "_found", self._find())
            object.__setattr__(self, "_find", None)
            object.__setattr__(self, "wave", 0)
        if self._found is None:
            raise ValueError("the position has not been found")
        return self._found

    def then(self, follow: Callable[[Position], Position]) -> Position:
        """A position that follows from this one."""
        if self._found is not None or self._depth >= _DEEPEST:
            return follow(self.found())
        return Awaited(lambda: follow(self.found()), self.wave, self._depth + 1)

    @property
    def value(self) -> Decimal | None:
        return self.found().value

    @property
    def reason(self) -> str:
        return self.found().reason

    @property
    def span(self) -> Span | None:
        return self.found().span

    @property
    def is_skippable(self) -> bool:
        return self.found().is_skippable

    @property
    def word(self) -> Word | None:
        return self.found().word

    @property
    def assumed(self) -> Decimal | None:
        return self.found().assumed

    @property
    def beyond(self) -> Decimal:
        return self.found().beyond

    def step(self, by: Decimal) -> Position:
        """Raises ValueError if its place is not found yet."""
        return self.found().step(by)


_DEEPEST = 50
"""Positions that each follow from the one before, of which none is looked at."""


class Mode(Enum):
    """A mode that a G code puts in force, in words."""

    MOTION = "the motion in force"
    MOVE = "whether a motion is in force"
    PLANE = "the plane"
    UNIT = "the unit"
    INCREMENTS = "whether increments are in force"
    COMPENSATION = "the compensation"
    DIAMETER = "whether X is a diameter"


_SETS: Mapping[Effect, tuple[Mode, ...]] = {
    Effect.MOTION: (Mode.MOTION, Mode.MOVE),
    Effect.CYCLE: (Mode.MOTION, Mode.MOVE),
    Effect.CANCEL: (Mode.MOTION, Mode.MOVE),
    Effect.PLANE: (Mode.PLANE,),
    Effect.UNITS: (Mode.UNIT,),
    Effect.ABSOLUTE: (Mode.INCREMENTS,),
    Effect.INCREMENTAL: (Mode.INCREMENTS,),
    Effect.COMPENSATION: (Mode.COMPENSATION,),
}
"""The modes that are known behind a G code."""


_MODES_IN_FORCE = (Mode.MOTION, Mode.PLANE, Mode.UNIT, Mode.INCREMENTS, Mode.COMPENSATION, Mode.DIAMETER)


class State(Struct, frozen=True):
    """The modes in force before a block, and the position."""

    axes: Mapping[str, Position]
    motion: int | None
    plane: Plane
    unit: Length
    is_incremental: bool
    compensation: int
    """40, 41 or 42."""
    moved_with: int = 40
    """The compensation of the last move in the plane: another one than is in force where G40, G41 or G42 came since."""
    diameter: Diameter | None = None
    """The words of X that are diameters; None: as the tables of the control say, and no code switches it."""
    memory: Mapping[str, Word] = {}
    """Words that stay in force, by their address."""
    travel: float = TRAVEL
    """mm. How far from the start point the control can make a contour."""
    zero: Zero = {}
    """The offsets and shifts of the coordinate system that are known to be in force (see `ZeroTable`)."""
    doubts: Mapping["Mode | str", str] = {}
    """The rest that is not known to be in force, as ways that meet do not agree on it, and why: modes, and by their
    address words that stay in force."""

    def step_to(self, other: "State") -> complex | None:
        """The way to where another state behind this one is, mm in the plane; None where it is not known."""
        ways = list[float]()
        for axis in self.plane.axes:
            here, there = self.axes[axis], other.axes[axis]
            if here.value is not None and there.value is not None:
                ways.append(float(there.value - here.value))
            elif here.value is None and there.value is None and (here.reason, here.span) == (there.reason, there.span):
                ways.append(float(there.beyond - here.beyond))
        return complex(*ways) if len(ways) == len(self.plane.axes) else None

    def start(self) -> Start:
        """The position in the plane."""
        first, second = self.plane.axes
        return Start((self.axes[first].value, self.axes[second].value))

    def move(self, changes: Mapping[str, Position]) -> "State":
        """The state with other positions on some axes."""
        return replace(self, axes={**self.axes, **changes}) if changes else self

    def cut(self) -> "State":
        """The state behind a move in the plane: the compensation in force has been started, changed or ended."""
        return self if self.moved_with == self.compensation else replace(self, moved_with=self.compensation)

    def settle(self, *modes: "Mode | str") -> "State":
        """The state in which some modes are known, whatever they were."""
        if self.doubts.keys().isdisjoint(modes):
            return self
        return replace(self, doubts={each: why for each, why in self.doubts.items() if each not in modes})

    def remember(self, memory: Mapping[str, Word]) -> "State":
        """The state with other words that stay in force."""
        if memory is self.memory:
            return self
        names = {**self.memory, **memory} if self.doubts else ()
        changed = [name for name in names if memory.get(name) is not self.memory.get(name)]
        return replace(self, memory=memory).settle(*changed)

    def known(self) -> object:
        """The knowledge of a state, and why the rest is not known, to be compared."""
        places = tuple((at.value, at.is_skippable, at.assumed, at.span, at.reason) for at in self.axes.values())
        words = tuple((name, word.text) for name, word in self.memory.items())
        plane, doubts = (self.plane.code, self.plane.axes, self.plane.diameters), tuple(self.doubts.items())
        modes = self.motion, plane, self.unit, self.is_incremental, self.compensation, self.diameter
        return places, modes, self.moved_with, words, doubts, tuple(self.zero.items())

    def in_force(self) -> "dict[Mode, object]":
        """The modes in force, without whether they are known."""
        plane = (self.plane.code, self.plane.axes)
        values = self.motion, plane, self.unit, self.is_incremental, self.compensation, self.diameter
        return dict(zip(_MODES_IN_FORCE, values, strict=True))

    def counts_diameters(self) -> bool:
        """Whether a plain word of X is a diameter, where codes switch that."""
        if self.diameter is Diameter.BY_PLANE:
            return {*self.plane.axes} == {"X", "Z"}
        return self.diameter is Diameter.ON or (self.diameter is Diameter.ABSOLUTE and not self.is_incremental)

    def lose(self, axes: Mapping[str, Position] | tuple[str, ...], reason: str, span: Span) -> "State":
        """The state with the position on these axes unknown."""
        return self.move({axis: Position(None, reason, span) for axis in axes})

    def doubt(self, modes: "Modes", reason: str) -> "State":
        """The state in which no mode is known, nor any word that stays in force. Where no G codes are programmed, each
        block says how it moves, and the head of a program its unit."""
        names: list[Mode | str] = [*dict.fromkeys([*modes.lasting, *self.memory])]
        own = (Mode.PLANE, Mode.COMPENSATION) if modes.follow is not None else tuple(Mode)
        names += (mode for mode in own if mode is not Mode.DIAMETER or self.diameter is not None)
        return replace(self, doubts=dict.fromkeys(names, reason))

    def lose_all(self, axes: tuple[str, ...], reason: str, span: Span) -> "State":
        """The same where it is not known either which offsets are in force."""
        return replace(self.lose(axes, reason, span), zero=unknown_zero(self.zero))


def unread_state(unit: Length) -> State:
    """The state of a program whose control is not known: there are no axes, and nothing is in force."""
    return State({}, None, Plane("", ("", ""), ("", "")), unit, is_incremental=False, compensation=40)


_UNREAD = (Bearing.UNREAD, Bearing.END)


@dataclass(frozen=True, slots=True)
class Modes:
    """The knowledge of a control that following its state needs."""

    lexicon: Lexicon
    codes: Mapping[int, Code]
    axes: tuple[str, ...]
    calls: frozenset[int]
    """M codes that call or end a subprogram."""
    unread_calls: frozenset[int] = field(default=frozenset(), kw_only=True)
    """M codes that may call a subprogram, in a way that contoursolve does not read."""
    call_addresses: frozenset[str] = field(default=frozenset(), kw_only=True)
    """Addresses of words that call one."""
    settings: Mapping[str, str] = field(default_factory=dict)
    """The values of settings that are not the default ones, by name."""
    syntax: Syntax = ISO
    """The spelling of its blocks."""
    radius: str = "R"
    """The address of an arc's radius."""
    remember: Callable[[Mapping[str, Word], Block], Mapping[str, Word]] | None = None
    """From the words that stay in force, and a block, to those behind it; the same record if nothing changes."""

    lasting: Mapping[str, str] = field(default_factory=dict, kw_only=True)
    """Addresses of words that stay in force and change the path, each with the word that ends it."""
    separate: frozenset[int] = field(default=frozenset(), kw_only=True)
    """G codes of blocks that belong to a contour and move nothing."""
    zero: ZeroTable = field(default=NOTHING_MOVES, kw_only=True)
    """The table of what moves the coordinate system."""
    language: MacroLanguage | None = field(default=None, kw_only=True)
    """Its variables, jumps and calls."""
    follow: Callable[[State, Block, "Modes"], State] | None = field(default=None, kw_only=True)
    """From the state before a block that is no contour to the one behind it, where the control is not programmed in G
    codes."""
    arcs: ArcTable | None = field(default=None, kw_only=True)
    """The reading of arcs outside contours; None where each arc is a contour."""

    def code_of(self, unit: Length) -> str:
        """The first code that sets a unit; empty where none does."""
        return next((each.text for each in self.codes.values() if each.unit is unit), "")

    def is_call(self, word: Word) -> bool:
        """Whether a word calls or ends a subprogram."""
        return (word.address == "M" and word.number in self.calls) or word.address in self.call_addresses

    def why_lost(self, word: Word) -> str:
        """The effect of such a word."""
        return not_read(word.text) if self.is_unread_call(word) else f"{word.text.strip()} calls or ends a subprogram"

    def is_unread_call(self, word: Word) -> bool:
        """Whether a word may call a subprogram, in a way that is not read."""
        return word.address == "M" and word.number in self.unread_calls

    def unread(self, block: Block, state: State) -> Word | None:
        """The first word of a block that shapes its path in a way that contoursolve does not read; `state` is the one
        with its codes in force."""
        for word in block.words:
            row = self.codes.get(word.number) if word.address == "G" and word.number is not None else None  # type: ignore[call-overload]
            if (row and not row.is_read) or self.is_unread_call(word) or self.lexicon.bearing(word.address) in _UNREAD:
                return word
        motion = self.codes.get(state.motion) if state.motion is not None else None
        if motion is None or motion.is_read or not axis_words(block, self):
            return None
        return Word("G", Decimal(motion.number), False, motion.text, block.span)

    def words(self, state: State) -> Lexicon:
        """The lexicon by which words are read in a state."""
        if state.diameter is None:
            return self.lexicon
        is_word = state.counts_diameters()
        is_absolute = state.diameter is Diameter.ABSOLUTE or is_word
        return self.lexicon.turned(
            absolute=is_absolute, increment=is_word and state.diameter is not Diameter.ABSOLUTE, word=is_word
        )

    def convention(self, setting: Setting) -> Convention:
        """A setting with its value."""
        return Convention(setting, self.settings.get(setting.name, setting.default))

    def has(self, setting: Setting, value: str) -> bool:
        """Whether a setting has this value."""
        return self.settings.get(setting.name, setting.default) == value

    @property
    def radius_difference(self) -> float:
        """The allowed difference of the radii at two points of an arc, mm: a machine parameter, and so a setting."""
        return (self.arcs or ArcTable()).with_numbers(self.settings).difference

    @property
    def travel(self) -> float:
        """The distance from the start point up to which the control can make a contour, mm: a setting."""
        return float(self.settings.get("travel", TRAVEL))

    @property
    def most_blocks(self) -> int:
        """The number of blocks that may run again before a program is said to go on for ever: a setting."""
        return int(self.settings.get(Limit().setting, MOST_BLOCKS))


COMMENTED = "comment"
"""The name of what stays in force where lines are a comment."""


WAITS, FAULTY = "this contour waits for", "the block has an error"
"""The begins of the reasons why a place is not known that an error before it has: behind a contour that is not solved,
and behind a word that cannot be read."""


def codes_of(block: Block, modes: Modes) -> list[Code | Word]:
    """The rows of a block's G codes; a code without a row is given as its word."""
    found: list[Code | Word] = []
    for word in block.words:
        if word.address == "G":
            row = None if word.number is None else modes.codes.get(word.number)  # type: ignore[call-overload]
            found.append(row or word)
    return found


def rows_of(block: Block, modes: Modes) -> list[Code]:
    """The rows of a block's G codes, of those that have one."""
    return [code for code in codes_of(block, modes) if not isinstance(code, Word)]


def apply_modes(state: State, block: Block, modes: Modes) -> State:
    """The state with the block's G codes in force, before its motion."""
    codes = rows_of(block, modes)
    for code in codes:
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
            case Effect.SHIFT | Effect.FRAME if code.number not in modes.zero.codes:
                reason = f"{code.text} changes the coordinate system"
                state = state.lose(modes.axes, reason, block.span)
                zero = state.zero if code.is_read else unknown_zero(state.zero)
                zero = forget_shifts(zero) if code.effect is Effect.SHIFT else _turned(zero, code, block, modes)
                state = replace(state, zero=zero)
            case Effect.PRESET:
                state = replace(state, zero=forget_shifts(state.zero))
            case _:
                pass
        if code.diameter is not None:
            state = replace(state, diameter=code.diameter).settle(Mode.DIAMETER)
    state = _settled(state, codes, block, modes) if state.doubts else state
    if modes.remember is not None:
        state = state.remember(modes.remember(state.memory, block))
    state = with_diameters(state)
    moving = modes.zero.rows_in(block)
    return _move_zero(state, block, moving, modes) if moving or block.macro is not None else state


def _turned(zero: Zero, code: Code, block: Block, modes: Modes) -> Zero:
    """The zero behind a code that turns, mirrors or scales axes, or ends that; single axes are mirrored, each by
    itself."""
    name = code.meaning.removeprefix(END_OF)
    if name.startswith(_POLE):
        return zero
    axes = [_axis(word, modes) for word in axis_words(block, modes)] if name == _MIRRORING else []
    is_end = code.ends_frame
    every = [each for each in turns_in(zero) if each.startswith(name)] if is_end and not axes else [name]
    for each in [f"{name} of {axis}" for axis in axes] or every:
        zero = with_turn(zero, each, is_on=not is_end)
    return zero


_MIRRORING, _POLE = "mirroring", "pole"


def _move_zero(state: State, block: Block, moving: Sequence[tuple[ZeroRow, Word]], modes: Modes) -> State:
    """The state with the coordinate system moved by words of a block, or by the variable that it sets."""
    numbers = _shifts_in(state, block, modes) if moving else {}
    for row, word in moving:
        mm, own = partial(_shift_of, state), numbers
        if row.adds_increments and state.is_incremental:
            ways = {axis: (shift_in(state.zero, axis), by) for axis, by in numbers.items()}
            own = {axis: None if old is None or by is None else old + by for axis, (old, by) in ways.items()}
        moved = move_zero(state.zero, row, word, block, own, modes.axes, state.plane.code, mm)
        state = state if moved is None else state_moved(state, moved, block.span)
    entries = [*entries_of_assignment(modes.zero, block)]
    if entries:
        moved = change_entries(state.zero, entries, modes.axes, f"{block.text.strip()} changes an offset")
        state = state if moved is None else state_moved(state, moved, block.span)
    return state


def _settled(state: State, codes: Sequence[Code], block: Block, modes: Modes) -> State:
    """The state in which it is known what a block says: modes, and words that stay in force or end."""
    said = [mode for code in codes for mode in _SETS.get(code.effect, ())]
    return state.settle(*said, *(word.address for word in block.words if word.address in modes.lasting))


def _shift_of(state: State, axis: str, number: Decimal) -> Decimal | None:
    """A shift by a number, mm. Where X is a diameter, it is not known whether a shift is one, too."""
    is_open = (axis == TURNED and state.counts_diameters()) or not state.doubts.keys().isdisjoint(_OF_SHIFTS)
    return None if is_open else number * state.unit.in_mm


_OF_SHIFTS = (Mode.UNIT, Mode.DIAMETER, Mode.PLANE)


def _shifts_in(state: State, block: Block, modes: Modes) -> dict[str, Decimal | None]:
    """The values of a block's axis words, mm, as shifts."""
    words, found = modes.words(state), dict[str, Decimal | None]()
    for word in axis_words(block, modes):
        axis, value = _axis(word, modes), words.value(word, state.unit)
        is_open = axis in found or _shift_of(state, axis, Decimal(0)) is None
        found[axis] = None if is_open else value
    return found


def state_moved(state: State, moved: Moved, span: Span) -> State:
    """The state behind what moves the coordinate system: where the tool is has other coordinates."""
    changes = dict[str, Position]()
    for axis, by in moved.by.items():
        at = state.axes[axis]
        if by is None:
            changes[axis] = Position(None, moved.reason, span)
        elif isinstance(at, Awaited):
            changes[axis] = at.then(partial(_shifted, by=by, reason=moved.reason, span=span))
        else:
            changes[axis] = _shifted(at, by, moved.reason, span)
    return replace(state.move(changes), zero=moved.zero)


def _shifted(at: Position, by: Decimal, reason: str, span: Span) -> Position:
    """The coordinate of a place after the zero has moved, mm: another one also where it is not known."""
    if at.value is None:
        return copy(at)
    return Position(at.value - by, reason, span, at.is_skippable)


def with_diameters(state: State) -> State:
    """The state with the diameters that its plane shows."""
    if state.diameter is None:
        return state
    counts, plane = state.counts_diameters(), state.plane
    first, second = (counts and axis == TURNED for axis in plane.axes)
    return (
        state if plane.diameters == (first, second) else replace(state, plane=replace(plane, diameters=(first, second)))
    )


def advance(state: State, block: Block, modes: Modes) -> State:
    """The state after a block that is not a contour."""
    if not block.words and not block.faults and block.macro is None:
        return state
    return modes.follow(state, block, modes) if modes.follow is not None else _follow_codes(state, block, modes)


def _follow_codes(state: State, block: Block, modes: Modes) -> State:
    """The state after a block that is programmed in G codes."""
    if COMMENTED in state.memory and modes.remember is not None:
        return state.remember(modes.remember(state.memory, block))
    if block.macro is Macro.FLOW:
        return state.lose_all(modes.axes, "a macro statement may jump", block.span)
    state = apply_modes(state, block, modes)
    if block.find("O"):
        # What is stated apart from the program holds for its beginning.
        stated = [axis for axis, at in state.axes.items() if at.span is not None and at.span.line > 0]
        state = state.lose(tuple(stated), "a new program begins", block.span)
        state = replace(state, zero=UNKNOWN_ZERO) if stated else state
    for word in block.words:
        if modes.is_call(word) or modes.is_unread_call(word):
            why = modes.why_lost(word)
            state = state.doubt(modes, why) if modes.is_unread_call(word) else state
            return state.lose_all(modes.axes, why, word.span)
    codes = codes_of(block, modes)
    for code in codes:
        if isinstance(code, Word):
            # Whatever it does, it may do to every axis.
            state = state.lose_all(modes.axes, f"{code.text} is not known to contoursolve", code.span)
            return replace(state, zero=commanded(state.zero, modes.zero, code.text))
    lost = _lost_by_faults(block, modes)
    words = axis_words(block, modes)
    codes = [code for code in codes if words or isinstance(code, Word) or not code.needs_axes]
    effect, reason = _effect(state, codes, modes)
    if effect is Effect.NO_MOTION:
        return state
    if effect is Effect.SINGLE or (effect is Effect.CYCLE and words):
        axes = tuple(dict.fromkeys(_axis(word, modes) for word in words))
        # Where axes are turned, an axis of the machine moves others of the program.
        is_alone = axes and (effect is not Effect.SINGLE or is_along_axes(state.zero, modes.zero.first))
        return state.lose(axes if is_alone else modes.axes, reason, block.span)
    if words:
        state = _moved(state, words, block, modes)
    preset = next((code for code in rows_of(block, modes) if code.effect is Effect.PRESET), None)
    if preset is not None and state.is_incremental:
        rows = (modes.lexicon.addresses[word.address] for word in words)
        open_axes = tuple(row.axis for row in rows if row.follows_increments)
        state = state.lose(open_axes, f"what {preset.text} sets where increments are in force is not known", block.span)
    state = _lose_ends(state, block, modes)
    return state.move({axis: Position(None, FAULTY, span) for axis, span in lost.items()})


def _moved(state: State, words: list[Word], block: Block, modes: Modes) -> State:
    """The state behind the motion of a block with these axis words."""
    is_in_plane = any(_axis(word, modes) in state.plane.axes for word in words)
    state = state.move(positions(state, words, modes, block.is_skippable))
    return state.cut() if is_in_plane else state


def _lose_ends(state: State, block: Block, modes: Modes) -> State:
    """The state where the axes of the plane are not known whose end words state that are not read."""
    for word in block.words:
        if modes.arcs is not None and word.address == modes.arcs.opening and state.motion in (2, _COUNTER_CLOCKWISE):
            state = _opened(state, block, word, modes)
        elif modes.lexicon.bearing(word.address) is Bearing.END:
            stated = {_axis(each, modes) for each in block.words}
            left = tuple(axis for axis in state.plane.axes if axis not in stated)
            state = state.lose(left, not_read(word.text), word.span)
    return state


def _opened(state: State, block: Block, word: Word, modes: Modes) -> State:
    """The state behind an arc by its opening angle: with a centre and without an end, it turns about that centre."""
    plane, words = state.plane, modes.words(state)
    centers = [block.find(each) for each in plane.centers]
    if any(_axis(each, modes) in plane.axes for each in block.words):
        return state
    values = [Decimal(0) if each is None else words.value(each, state.unit) for each in centers]
    first, second = (None if value is None else float(value) for value in values)
    if not any(centers) or word.number is None or first is None or second is None or state.doubts:
        return state.lose(plane.axes, not_read(word.text), word.span)
    sign = 1 if state.motion == _COUNTER_CLOCKWISE else -1
    turned = -complex(first, second) * rect(1, sign * radians(word.number))
    moved = dict[str, Position]()
    for axis, end in zip(plane.axes, (first + turned.real, second + turned.imag), strict=True):
        before, by = state.axes[axis], Decimal(repr(end)).quantize(_EXACT)
        lead = partial(_step, by=by, word=word, is_skippable=block.is_skippable)
        moved[axis] = before.then(lead) if isinstance(before, Awaited) else lead(before)
    return state.move(moved)


_COUNTER_CLOCKWISE, _EXACT = 3, Decimal("1e-9")


def not_read(text: str) -> str:
    """The remark on a word of the control that contoursolve does not follow."""
    name = " ".join(text.split()).partition("=")[0].partition("(")[0]
    return f"contoursolve does not read {name.strip()} yet"


def positions(state: State, words: list[Word], modes: Modes, is_skippable: bool) -> dict[str, Position]:
    """The positions where the axis words of a motion lead."""
    moved: dict[str, Position] = {}
    for word in words:
        axis = _axis(word, modes)
        is_step = modes.lexicon.addresses[word.address].is_step(is_incremental=state.is_incremental)
        twice = Position(None, f"{axis} is given twice", word.span) if axis in moved else None
        moved[axis] = (
            twice
            or _doubted(word, state, modes)
            or _led(word, state.axes[axis] if is_step else None, state, modes, is_skippable)
        )
    return moved


def _doubted(word: Word, state: State, modes: Modes) -> Position | None:
    """The unknown place to which an axis word leads where it is not known how it is read."""
    if not state.doubts:
        return None
    row = modes.lexicon.addresses[word.address]
    is_turned = row.axis == TURNED
    minds = {
        Mode.UNIT: True,
        Mode.MOVE: True,
        Mode.INCREMENTS: row.follows_increments,
        Mode.DIAMETER: is_turned,
        Mode.PLANE: is_turned and state.diameter is Diameter.BY_PLANE,
    }
    mode = next((mode for mode, is_minded in minds.items() if is_minded and mode in state.doubts), None)
    return None if mode is None else Position(None, f"{mode.value} is not known: {state.doubts[mode]}", word.span)


def _led(word: Word, before: Position | None, state: State, modes: Modes, is_skippable: bool) -> Position:
    """The position where an axis word leads; `before` is where an increment counts from, None for a coordinate."""
    value = modes.words(state).value(word, state.unit)
    if value is None:
        return Position(None, f"{word.text} depends on a variable", word.span)
    if before is None:
        return Position(value, word.text, word.span, is_skippable, word)
    if isinstance(before, Awaited):
        return before.then(partial(_step, by=value, word=word, is_skippable=is_skippable))
    return _step(before, value, word, is_skippable)


def _step(before: Position, by: Decimal, word: Word, is_skippable: bool) -> Position:
    """The place where an increment leads, mm."""
    if before.value is None:
        return before.step(by)
    return Position(before.value + by, word.text, word.span, is_skippable or before.is_skippable, word)


def axis_words(block: Block, modes: Modes) -> list[Word]:
    """The words of a block that program an axis."""
    return [word for word in block.words if _axis(word, modes)]


def _axis(word: Word, modes: Modes) -> str:
    row = modes.lexicon.addresses.get(word.address)
    return row.axis if row else ""


def _effect(state: State, codes: Sequence[Code | Word], modes: Modes) -> tuple[Effect, str]:
    """The effect of a block of these G codes on its axis words, and the reason to give if the position is lost."""
    for code in codes:
        if isinstance(code, Word):
            continue
        if code.comes_back:
            return Effect.NO_MOTION, ""
        if code.effect is Effect.SINGLE:
            is_read = f"contoursolve does not know where {code.text} ({code.meaning}) ends"
            return Effect.SINGLE, is_read if code.is_read else not_read(code.text)
        if code.effect in (Effect.NO_MOTION, Effect.FRAME, Effect.CORNER):
            return Effect.NO_MOTION, ""
        if code.effect is Effect.PRESET:
            return Effect.MOTION, ""
    modal = modes.codes.get(state.motion) if state.motion is not None else None
    if modal and modal.effect is Effect.CYCLE:
        return Effect.CYCLE, f"contoursolve does not know where {modal.text} ({modal.meaning}) ends"
    return Effect.MOTION, ""


def _lost_by_faults(block: Block, modes: Modes) -> dict[str, Span]:
    """The axes whose words could not be read, or are read in part, as X4O. is."""
    lost: dict[str, Span] = {}
    meant = find_lookalikes(block) if block.faults else ()
    for fault in block.faults:
        torn = lookalike_at(meant, fault.span)
        row = modes.lexicon.addresses.get(torn.address if torn else fault.address)
        if fault.kind is FaultKind.BLOCK_TOO_LONG:
            lost.update(dict.fromkeys(modes.axes, fault.span))
        elif row and row.axis and fault.kind is not FaultKind.COMMENT_NOT_CLOSED:
            lost[row.axis] = fault.span
        elif fault.kind is FaultKind.COMMA_WITHOUT_ADDRESS:
            lost.update(dict.fromkeys(modes.axes, fault.span))
    return lost


class PlainLines:
    """The plain lines of programs that a control reads as what they look like: they move its own axes, and a comment is
    one. Such a line is no contour, and belongs to one only beside a line that is not plain, as long as `is_plain`;
    there is nothing to say of it. A coordinate that counts so few least increments that it may have lost its point is
    in none of them; with `has_points`, each has its point."""

    def __init__(self, modes: Modes, *, has_points: bool = False) -> None:
        others = "".join(axis for axis in AXES if axis not in modes.axes)
        is_counted = modes.lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS
        digits = "[0-9]++" if has_points else "0*+[1-9][0-9]{0,2}+"
        ways = [rf"[{others}]"] * bool(others) + [rf"[{AXES}][+-]?+{digits}(?![0-9.])"] * is_counted
        self._others, self._syntax = re.compile("|".join(ways) or "(?!)", re.IGNORECASE), modes.syntax

    def has(self, line: str) -> bool:
        """Whether a line is plain, and the control reads it so."""
        is_plain = self._syntax.plain.one.fullmatch(line) is not None
        return is_plain and self._others.search(words_of(line, self._syntax)) is None

    def among(self, lines: Iterable[Block | Passage]) -> Iterator[Block | Passage]:
        """The lines of a program, those that the control reads otherwise as blocks."""
        for each in lines:
            if isinstance(each, Block) or self._others.search(each.text) is None:
                yield each
                continue
            first = 0
            for is_plain, group in groupby(each.lines, self.has):
                count = len(list(group))
                part, first = each.part(first, first + count), first + count
                yield from (part,) if is_plain else blocks_in(part)


def is_plain(state: State, modes: Modes) -> bool:
    """Whether plain lines lead to their coordinates in this state."""
    if modes.follow is not None:
        return not state.doubts
    is_moving = state.motion in modes.syntax.plain.motions
    return is_moving and not (state.is_incremental or state.memory or state.doubts)


def advance_plainly(state: State, passage: Passage, modes: Modes) -> State:
    """The state after plain lines; each axis and the motion are where the last line that says so has them. What an
    axis is told is read when somebody asks."""
    if modes.syntax.plain.parts is not None:
        return _advance_by_parts(state, passage, modes, modes.syntax.plain.parts)
    axes, motion, lines = dict[str, Position](), None, passage.lines
    state = state.cut()
    text = passage.text.upper()
    programmed = [axis for axis in modes.axes if axis in text]
    # Increments are not in force where lines are plain: no place follows from the one before.
    reading = replace(state, axes={})
    for place in range(len(lines) - 1, -1, -1):
        words, found = words_of(lines[place], modes.syntax), None
        motion = motion_of(words) if motion is None else motion
        for axis in programmed:
            if axis in words and axis not in axes:
                found = found or cache(partial(_places, lines[place], passage.line + place, reading, modes))
                axes[axis] = Awaited(partial(_place, found, axis))
        if motion is not None and len(axes) == len(programmed):
            break
    if motion is not None and motion != state.motion:
        state = replace(state, motion=motion)
    return state.move(axes)


def _advance_by_parts(state: State, passage: Passage, modes: Modes, parts: re.Pattern[str]) -> State:
    """The same where a line may set more than places: the last lines are read that set each part of the state."""
    there, last = {each[:2] for each in parts.findall(words_of(passage.text, modes.syntax))}, dict[str, int]()
    for place in range(passage.count - 1, -1, -1):
        for each in parts.findall(words_of(passage.lines[place], modes.syntax)):
            last.setdefault(each[:2], place)
        if len(last) == len(there):
            break
    for place in sorted({*last.values()}):
        line = passage.lines[place].rstrip("\r\n")
        state = advance(state, parse_block(line, passage.line + place, modes.syntax), modes)
    return state


def _place(places: Callable[[], Mapping[str, Position]], axis: str) -> Position:
    return places()[axis]


def _places(line: str, number: int, state: State, modes: Modes) -> dict[str, Position]:
    """The positions where a plain line leads."""
    block = parse_block(line.rstrip("\r\n"), number, modes.syntax)
    return positions(state, axis_words(block, modes), modes, is_skippable=False)
