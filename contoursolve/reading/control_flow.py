"""The ways through a program that runs: nobody knows which of them it takes, and where they meet only what all of them
agree on is known."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from functools import partial, reduce
from itertools import chain
from typing import Any, overload

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Span
from contoursolve.execution import EventKind, ProgramEvent
from contoursolve.gcode import Block
from contoursolve.reading.lexicon import Effect
from contoursolve.reading.modal_state import Mode, Modes, Position, State, with_diameters

_SAME = Decimal("1e-9")
"""mm by which two positions differ that are one; see `contoursolve.tolerance.LENGTH`."""

Lines = Mapping[Mode, int]
"""On which lines modes were set."""


class ControlFlowPath(Struct, frozen=True):
    """One way, in a state. `unread` are its last blocks: what they are depends on what comes behind them. `entered` are
    the states to which it comes back, `lines` where modes were set."""

    state: State
    unread: tuple[Block, ...] = ()
    entered: tuple[State, ...] = ()
    lines: Lines = {}


Read = Callable[[Sequence[Block], int, State, bool], tuple[int, State] | None]
"""(blocks, the index of one of them, the state before it, whether a contour may go on behind the last one) to how many
blocks belong to what begins there, and the state behind it; None where that depends on what comes behind the
last one."""


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


class Ways:
    """The ways on which a program has come to a place; none where all that follows from them has been looked at.

    `first` gives the state in which nothing has run.
    """

    def __init__(self, first: Callable[[], State], modes: Modes) -> None:
        self.modes, self._first = modes, first
        self.now: list[ControlFlowPath] = [ControlFlowPath(first())]
        self.marked: dict[int, State] = {}
        """The states before blocks, by their marks."""
        self._kept: dict[int, list[ControlFlowPath]] = {}
        self._reason, self._is_beyond = "", False
        """What decides between those that met last, and whether what follows has been read."""
        self._heads: dict[int, tuple[list[ControlFlowPath], bool]] = {}
        """Where something may run again: on which ways that was reached, and whether others have come into it."""
        self.settled: int | None = None
        """The mark of the last of these of which nothing new followed."""

    def read_on(self, blocks: Sequence[Block], read: Read, *, is_open: bool) -> Iterator[None]:
        """Follow each way through some blocks, step by step, as far as it is known what they are; ways that have come
        equally far meet. `is_open` tells whether a contour may go on behind them."""
        moving = [_Moving(way, [*way.unread, *blocks] if way.unread else blocks) for way in self.now]
        stopped = list[ControlFlowPath]()
        while moving and not (self._is_beyond and min(each.place for each in moving) >= 0):
            place = min(each.place for each in moving)
            here = [each for each in moving if each.place == place]
            if place >= 0 and len(here) > 1:
                met = _meet_all([replace(each.way, unread=()) for each in here], self._reason, self.modes)
                here = [_Moving(met[0], blocks, place)]
                moving = [*(each for each in moving if each.place != place), *here]
            one = here[0]
            found = None if place >= len(blocks) else read(one.blocks, one.index, one.way.state, is_open)
            if found is None:
                moving.remove(one)
                stopped.append(replace(one.way, unread=tuple(one.blocks[one.index :])))
                continue
            one.index += found[0]
            one.way = _behind(one.way, found[1], one.blocks[one.index - 1].line)
            yield
        self.now = [] if self._is_beyond else _meet_all(stopped, self._reason, self.modes)

    def follow(
        self,
        lines: Iterable[Block | ProgramEvent],
        read: Read,
        found: list[Any],
        happen: Callable[[ProgramEvent], bool],
    ) -> Iterator[None]:
        """Follow each way through a program as it runs, step by step. What was `found` since a head is dropped where
        `happen` says that it is found anew."""
        heads, blocks = dict[int, int](), list[Block]()
        for line in chain(lines, (None,)):
            if isinstance(line, Block):
                blocks.append(line)
                yield
                continue
            yield from self.read_on(blocks, read, is_open=line is not None and line.kind.is_open)
            blocks = []
            if line is None:
                return
            if line.kind is EventKind.HEAD:
                heads[line.mark] = len(found)
            if happen(line):
                del found[heads[line.mark] :]

    def happen(self, event: ProgramEvent) -> bool:
        """Take in what happens between two blocks; whether all that was found since its head is found anew."""
        span, self._is_beyond = Span(event.line, 1, 2), event.kind is EventKind.BEYOND
        match event.kind:
            case EventKind.FRESH:
                self.now = [ControlFlowPath(self._fresh(event))]
                self._kept, self._heads = {}, {}
            case EventKind.ENTER:
                self.now = [replace(each, entered=(*each.entered, each.state)) for each in self.now]
            case EventKind.LEAVE:
                self.now = [
                    replace(each, state=each.entered[-1], entered=each.entered[:-1]) if each.entered else each
                    for each in self.now
                ]
            case EventKind.LOST | EventKind.STOPPED | EventKind.CALLED:
                axes = self.modes.axes
                self.now = [replace(each, state=each.state.lose(axes, event.reason, span)) for each in self.now]
            case EventKind.PART:
                self._kept[event.mark] = self.now
            case EventKind.PAUSE:
                self._kept[event.mark], self.now = self.now, []
            case EventKind.MEET:
                self._reason = event.reason
                ways = [way for mark in event.ways for way in self._kept.pop(mark, ())]
                self.now = _meet_all(ways, event.reason, self.modes)
                self._heads = {
                    mark: (kept, is_aside or min(event.ways) < mark) for mark, (kept, is_aside) in self._heads.items()
                }
            case EventKind.HEAD:
                self._heads[event.mark] = self.now, False
            case EventKind.AGAIN:
                return self._run_again(event)
            case _:
                pass
        return False

    def state_behind(self, event: ProgramEvent, state: State) -> State:
        """The state behind an event of a program that is followed on one way, in a state before it."""
        self.now = [replace(each, state=state) for each in self.now]
        self.happen(event)
        return self.now[0].state if self.now else state

    def _run_again(self, event: ProgramEvent) -> bool:
        """Go back to where something begins that runs again, with what is known there in all of its passes."""
        kept, is_aside = self._heads.get(event.mark, ([], True))
        both = _meet_all([*kept, *self.now], event.reason, self.modes)
        is_settled = not self.now or _are_same(both, kept)
        self.settled = event.mark if is_settled else None
        if event.is_last and not is_settled:
            told = "the contour goes on" if any(each.unread for each in self.now) else "it is another place"
            told, span = f"{told} from pass to pass; {event.reason}", Span(event.line, 1, 2)
            self.now = [replace(each, state=each.state.lose(self.modes.axes, told, span)) for each in self.now]
        if event.is_last:
            return False
        self._heads[event.mark] = both, is_aside
        self.now = [] if is_settled else both
        return not is_settled and not is_aside

    def _fresh(self, event: ProgramEvent) -> State:
        if event.mark in self.marked:
            return self.marked[event.mark]
        state = self._first()
        told = f"{event.reason}; say with --start where the tool is when it begins"
        unknown = tuple(axis for axis, at in state.axes.items() if at.value is None)
        return state.lose(unknown, told, Span(event.line, 1, 2))


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
    before, now = _in_force(way.state), _in_force(state)
    if before == now:
        return ControlFlowPath(state, (), way.entered, way.lines)
    changed = (mode for mode, old, new in zip(_MODES, before, now, strict=True) if old != new)
    return ControlFlowPath(state, (), way.entered, {**way.lines, **dict.fromkeys(changed, line)})


_MODES = (Mode.MOTION, Mode.PLANE, Mode.UNIT, Mode.INCREMENTS, Mode.COMPENSATION, Mode.DIAMETER)


def _in_force(state: State) -> tuple[Any, ...]:
    """The values of `_MODES`."""
    plane = (state.plane.code, state.plane.axes)
    return state.motion, plane, state.unit, state.is_incremental, state.compensation, state.diameter


def _values(state: State) -> dict[Mode, Any]:
    """The modes of a state."""
    return dict(zip(_MODES, _in_force(state), strict=True))


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
    first, second = _values(ours), _values(theirs)
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
        memory=memory if _memories(ours) != _memories(theirs) else ours.memory,
        doubts=doubts,
    )
    entered = tuple(one.entered) if len(one.entered) <= len(other.entered) else tuple(other.entered)
    return ControlFlowPath(with_diameters(state), one.unread, entered, {**other.lines, **one.lines})


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


def _are_same(ways: Sequence[ControlFlowPath], others: Sequence[ControlFlowPath]) -> bool:
    """Whether the same is known on some ways and on others."""
    return [_known(each) for each in ways] == [_known(each) for each in others]


def _known(way: ControlFlowPath) -> object:
    """The knowledge on a way."""
    state = way.state
    places = {axis: None if at.value is None else round(at.value, 9) for axis, at in state.axes.items()}
    entered = tuple(_known(ControlFlowPath(each)) for each in way.entered)
    return tuple(map(_key, way.unread)), places, _values(state), _memories(state), {*state.doubts}, entered
