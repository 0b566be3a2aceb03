"""The ways through a program that runs: nobody knows which of them it takes, and where they meet only what all of them
agree on is known."""

from collections.abc import Callable, Generator, Mapping, Sequence
from decimal import Decimal
from functools import partial, reduce
from typing import Any, overload

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Span
from contoursolve.execution import EventKind, Follower, ProgramEvent, WrittenBack
from contoursolve.gcode import Block
from contoursolve.reading.brought_back import bring_back, write_back
from contoursolve.reading.lexicon import Effect
from contoursolve.reading.modal_state import Mode, Modes, Position, State, with_diameters
from contoursolve.reading.moved_zero import zero_at_call

_SAME = Decimal("1e-9")
"""mm by which two positions differ that are one; see `contoursolve.tolerance.LENGTH`."""

Lines = Mapping[Mode, int]
"""On which lines modes were set."""


class ControlFlowPath(Struct, frozen=True):
    """One way, in a state. `unread` are its last blocks: what they are depends on what comes behind them. `lines` tells
    where modes were set."""

    state: State
    unread: tuple[Block, ...] = ()
    lines: Lines = {}


class Paths(Struct, frozen=True):
    """The ways on which a program has come to a place, and what decides between them; none where all that follows from
    them has been read."""

    ways: Sequence[ControlFlowPath]
    reason: str = ""


class Ahead(Sequence[Block]):
    """Blocks; `is_passed` tells whether somebody has looked behind the last one."""

    def __init__(self, blocks: Sequence[Block]) -> None:
        self.blocks, self.is_passed = blocks, False

    def __len__(self) -> int:
        return len(self.blocks)

    @overload
    def __getitem__(self, index: int) -> Block: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Block]: ...

    def __getitem__(self, index: int | slice) -> Block | Sequence[Block]:
        if isinstance(index, int) and index >= len(self.blocks):
            self.is_passed = True
        return self.blocks[index]


class Ways(Follower):
    """Follows a program on each of its ways. `first` gives the state in which nothing has run, and `take` finds what
    begins at a block."""

    goes_beyond = True
    """True where a contour may go on beyond an event."""

    def __init__(self, first: Callable[[], State], modes: Modes, take: "Take") -> None:
        self.modes, self._first, self._take = modes, first, take
        self.marked: dict[int, State] = {}
        """The states before blocks, by their marks."""
        self._is_beyond = False
        """Whether the next blocks have been read."""

    def begin(self, event: ProgramEvent | None) -> Paths:
        state = self._first()
        if event is not None and event.mark in self.marked:
            state = self.marked[event.mark]
        elif event is not None:
            told = f"{event.reason}; say with --start where the tool is when it begins"
            unknown = tuple(axis for axis, at in state.axes.items() if at.value is None)
            state = state.lose_all(unknown, told, Span(event.line, 1, 2))
        return Paths((ControlFlowPath(state),))

    def read(self, known: Paths, blocks: Sequence[Block], event: ProgramEvent | None) -> Generator[Any, None, Paths]:
        """Follow each way through some blocks, step by step, as far as it is known what they are; ways that have come
        equally far meet."""
        is_open = event is not None and event.kind.is_open and self.goes_beyond
        moving = [_Moving(way, [*way.unread, *blocks] if way.unread else blocks) for way in known.ways]
        stopped = list[ControlFlowPath]()
        while moving and not (self._is_beyond and min(each.place for each in moving) >= 0):
            place = min(each.place for each in moving)
            here = [each for each in moving if each.place == place]
            if place >= 0 and len(here) > 1:
                met = _meet_all([replace(each.way, unread=()) for each in here], known.reason, self.modes)
                here = [_Moving(met[0], blocks, place)]
                moving = [*(each for each in moving if each.place != place), *here]
            one = here[0]
            if place < len(blocks) and (mark := one.blocks[one.index].mark):
                self.marked[mark] = one.way.state
            taken = None if place >= len(blocks) else self._take(one.blocks, one.index, one.way.state, is_open)
            if taken is None:
                moving.remove(one)
                stopped.append(replace(one.way, unread=tuple(one.blocks[one.index :])))
                continue
            one.index += taken.blocks
            one.way = _behind(one.way, taken.state, one.blocks[one.index - 1].line)
            yield taken.found
        was_beyond, self._is_beyond = self._is_beyond, event is not None and event.kind is EventKind.BEYOND
        return Paths(() if was_beyond else _meet_all(stopped, known.reason, self.modes), known.reason)

    def join(self, several: Sequence[Paths], reason: str) -> Paths:
        return Paths(_meet_all([way for each in several for way in each.ways], reason, self.modes), reason)

    def is_same(self, one: Paths, other: Paths) -> bool:
        return [*map(_known, one.ways)] == [*map(_known, other.ways)]

    def enter(self, known: Paths) -> Paths:
        states = (replace(each.state, zero=zero_at_call(each.state.zero)) for each in known.ways)
        return replace(known, ways=[replace(way, state=each) for way, each in zip(known.ways, states, strict=True)])

    def restore(self, entry: Paths, now: Paths, reason: str, line: int) -> Paths:
        if not entry.ways:
            return now
        # No contour goes on beyond a call, so that the ways have met there.
        before, span = entry.ways[0], Span(line, 1, 2)
        ways = [
            replace(each, state=bring_back(before.state, each.state, reason, span), lines=before.lines)
            for each in now.ways
        ]
        return replace(now, ways=ways)

    def write_back(self, entry: Paths, now: Paths, earlier: Sequence[Block], ran: Sequence[Block]) -> WrittenBack:
        if not (entry.ways and now.ways):
            return WrittenBack()
        return write_back(entry.ways[0].state, now.ways[0].state, earlier, ran, self.modes)

    def lose(self, known: Paths, reason: str, line: int, *, modes: bool = False, in_passes: bool = False) -> Paths:
        if in_passes:
            told = "the contour goes on" if any(each.unread for each in known.ways) else "it is another place"
            reason = f"{told} from pass to pass; {reason}"
        axes, span = self.modes.axes, Span(line, 1, 2)
        states = [each.state.lose_all(axes, reason, span) for each in known.ways]
        if modes:
            states = [each.doubt(self.modes, f"{reason}{_on_line(line)}") for each in states]
        return replace(known, ways=[replace(way, state=state) for way, state in zip(known.ways, states, strict=True)])


class TakenBlocks(Struct, frozen=True):
    """The find at a block: how many blocks belong to it, the state behind it, and what is found there."""

    blocks: int
    state: State
    found: Any = None


Take = Callable[[Sequence[Block], int, State, bool], TakenBlocks | None]
"""(blocks, the index of one of them, the state before it, whether a contour may go on behind the last one) to what
begins there; None where that depends on what comes behind the last one."""


class _Moving:
    """A way through some blocks, behind those that it had not read before, and the index up to which it has."""

    def __init__(self, way: ControlFlowPath, blocks: Sequence[Block], index: int = 0) -> None:
        self.way, self.blocks, self.index, self._before = way, blocks, index, len(way.unread)

    @property
    def place(self) -> int:
        """The place that it has reached in those that are new."""
        return self.index - self._before


def _behind(way: ControlFlowPath, state: State, line: int) -> ControlFlowPath:
    """A way behind what ends on a line."""
    before, now = way.state.in_force(), state.in_force()
    if before == now:
        return ControlFlowPath(state, (), way.lines)
    changed = (mode for mode, old in before.items() if old != now[mode])
    return ControlFlowPath(state, (), {**way.lines, **dict.fromkeys(changed, line)})


# Where ways meet -------------------------------------------------------------------------------------------------


def _meet_all(ways: Sequence[ControlFlowPath], reason: str, modes: Modes) -> list[ControlFlowPath]:
    """The ways that there are behind some that meet: one for each end of which it is not known yet what it is."""
    by_end: dict[object, list[ControlFlowPath]] = {}
    for way in ways:
        by_end.setdefault(tuple(map(_key, way.unread)), []).append(way)
    return [reduce(partial(_meet, reason=reason, modes=modes), each) for each in by_end.values()]


def _key(block: Block) -> object:
    return block.line, block.text, block.file, block.callers


def _meet(one: ControlFlowPath, other: ControlFlowPath, reason: str, modes: Modes) -> ControlFlowPath:
    """The common part of two ways."""
    if one.state is other.state:
        return one
    ours, theirs, why = one.state, other.state, f"; {reason}" if reason else ""
    axes = {axis: _meet_positions(at, theirs.axes[axis], why) for axis, at in ours.axes.items()}
    doubts = {**theirs.doubts, **ours.doubts}
    first, second = ours.in_force(), theirs.in_force()
    for mode, value in first.items():
        if value != second[mode]:
            texts = (
                f"{_text(mode, state, modes)}{_on_line(way.lines.get(mode, 0))}"
                for state, way in ((ours, one), (theirs, other))
            )
            doubts.setdefault(mode, f"{' or '.join(texts)}{why}")
    motions = [modes.codes.get(state.motion or 0) for state in (ours, theirs)]
    if ours.motion != theirs.motion and any(code is None or code.effect is not Effect.MOTION for code in motions):
        doubts.setdefault(Mode.MOVE, doubts[Mode.MOTION])
    memory = dict(theirs.memory if modes.follow is None else {}) | dict(ours.memory)
    for name in dict.fromkeys([*ours.memory, *theirs.memory]):
        words = [state.memory.get(name) for state in (ours, theirs)]
        if _said(words[0]) == _said(words[1]):
            continue
        if modes.follow is not None:
            # What is not in force there is not known.
            memory.pop(name, None)
        texts = (f"{word.text.strip()}{_on_line(word.span.line)}" if word else f"no {name}" for word in words)
        doubts.setdefault(name, f"{' or '.join(texts)}{why}")
    both = (ours.motion, theirs.motion)
    # The one in which a contour is found, so that it is told.
    motion = next((each for each in (1, 2, 3) if each in both), ours.motion or theirs.motion)
    state = replace(
        ours,
        axes=axes,
        motion=ours.motion if ours.motion == theirs.motion else motion,
        moved_with=ours.moved_with if ours.moved_with == theirs.moved_with else ours.compensation,
        memory=memory if _memories(ours) != _memories(theirs) else ours.memory,
        zero={name: value for name, value in ours.zero.items() if theirs.zero.get(name) == value},
        doubts=doubts,
    )
    return ControlFlowPath(with_diameters(state), one.unread, {**other.lines, **one.lines})


def _meet_positions(one: Position, other: Position, why: str) -> Position:
    """The place of an axis on two ways."""
    if one is other:
        return one
    first, second = one.value, other.value
    if first is None or second is None:
        return one if first is None else other
    if abs(first - second) <= _SAME:
        return one if one.is_skippable or not other.is_skippable else other
    places = [f"{each.reason}{_on_line(each.span.line if each.span else 0)}" for each in (one, other)]
    # The later one is where the axis was moved last.
    span = max((each.span for each in (one, other) if each.span is not None), default=None)
    return Position(None, f"{' or '.join(places)}{why}", span)


def _on_line(line: int) -> str:
    return f" (program line {line})" if line > 0 else ""


def _text(mode: Mode, state: State, modes: Modes) -> str:
    """The modes in force, in words."""
    match mode:
        case Mode.MOTION:
            code = modes.codes.get(state.motion) if state.motion is not None else None
            return "none" if state.motion is None else code.text if code else f"G{state.motion:02}"
        case Mode.PLANE:
            return state.plane.code
        case Mode.UNIT:
            return state.unit.value
        case Mode.INCREMENTS:
            return "increments" if state.is_incremental else "coordinates"
        case Mode.COMPENSATION:
            return f"G{state.compensation}"
        case _:
            return next((each.text for each in modes.codes.values() if each.diameter is state.diameter), "no code")


def _said(word: Any) -> object:
    """The text of a word that stays in force, wherever it stands."""
    return None if word is None else (word.address, word.number, None if word.number is not None else word.text.strip())


def _memories(state: State) -> dict[str, object]:
    return {name: _said(word) for name, word in state.memory.items()}


def _known(way: ControlFlowPath) -> object:
    """The knowledge on a way."""
    state = way.state
    places = {axis: None if at.value is None else round(at.value, 9) for axis, at in state.axes.items()}
    return (
        tuple(map(_key, way.unread)),
        places,
        state.in_force(),
        state.moved_with,
        _memories(state),
        {*state.doubts},
        state.zero,
    )
