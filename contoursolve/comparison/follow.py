"""Follows a solved program block by block, as it runs, into its path: contours, and the ordinary moves G0 to G3 between
them."""

import re
from collections.abc import Iterable, Iterator, Sequence
from decimal import Decimal
from itertools import chain
from math import atan2, ceil, cos, dist, hypot, isnan, radians, sin, tau

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison.travel import Bend, Motion, Place, Step, Travel, Unfollowed
from contoursolve.comparison.words import is_of_cycle
from contoursolve.controls import CENTERS, Centers
from contoursolve.diagnosis import Answer, Depth
from contoursolve.gcode import Block, Macro, Program, Word
from contoursolve.geometry import Length, Plane, Turn
from contoursolve.program import Request, Result, Step as Passed, machine_for, walk
from contoursolve.reading import (
    MOTIONS,
    WORK,
    Around,
    Bearing,
    Code,
    ContourBlock,
    Control,
    Effect,
    Lexicon,
    Modes,
    Plain,
    Position,
    Reliance,
    State,
    WithoutPoint,
    advance,
    apply_modes,
    blocks_of,
    codes_of,
    leave,
    reliance,
)
from contoursolve.solving import ArcSegment, Segment, center_by_radius, shifted
from contoursolve.tolerance import LENGTH, REGULAR

FINISHING, ROUGHING = ("G70",), ("G71", "G72", "G73")
"""The cycles that cut a profile once, along it, and those before it."""
_G70 = 70
_TURNS = {2: Turn.CW, 3: Turn.CCW}
_NO_COMPENSATION = 40

_NOWHERE = (None, None)
_LINES = {0: Motion.RAPID, 1: Motion.FEED}
_BESIDE = frozenset("NGFSTMDHEO")
"""Addresses that may stand beside the coordinates of a move and say nothing about its path."""
_BESIDE_MACRO = re.compile(r"^[\s/]*N\d+|\([^)]*\)|;.*")
_ABSOLUTE = "{}=AC"
"""A centre that is no increment, `I=AC(20)`."""
_NAMES = frozenset("DGHMNOPST")
"""Addresses whose numbers are names or counts: a decimal point changes nothing."""


class ToolPath(Struct, frozen=True):
    """The path of one program: its axes, and its elements in order."""

    name: str
    control: str
    axes: tuple[str, ...]
    steps: tuple[Step, ...]
    blocks: tuple[Block, ...] = ()
    """Its blocks as they run."""
    program: Program | None = None
    modes: Modes | None = None
    """The knowledge of its control."""

    @property
    def unfollowed(self) -> tuple[Unfollowed, ...]:
        """The parts that are not followed."""
        return tuple(step for step in self.steps if isinstance(step, Unfollowed))

    def with_places(self) -> "ToolPath":
        """The same without moves in a plane in which only their steps are known."""
        return replace(self, steps=tuple(map(_with_place, self.steps)))


def _with_place(step: Step) -> Step:
    if isinstance(step, Unfollowed) or step.plane is None or {*step.plane.axes}.isdisjoint(step.free):
        return step
    reason = "where it begins is not known; state that with --start"
    return Unfollowed(step.line, step.text, (f"step {step.text}",), reason, step.file, step.number)


def follow(
    result: Result,
    control: Control,
    unit: Length,
    axes: tuple[str, ...],
    *,
    finishes: bool = False,
    ran: Iterable[Passed] | None = None,
) -> ToolPath:
    """The path of a program that has been solved for this control; `unit` is that before any G20 or G21. With
    `finishes`, G70 runs the profile that it names. What has been `ran` of it is not run again."""
    follower = _Follower(control, unit, axes)
    machine = machine_for(result.program, control, result.around, unit) if ran is None else None
    steps: Iterator[Step]
    if ran is not None:
        steps = follower.run(ran, finishes=finishes)
    elif machine is None:
        for block in result.start.blocks if result.start else ():
            follower.state = advance(follower.state, block, control.modes)
        steps = follower.walk(result.program, result.answers)
    else:
        asked, machine.finishes = Request(control, unit, result.policy, Depth.VERDICT, result.start), finishes
        steps = follower.run(walk((), asked, machine=machine, is_whole=True), finishes=finishes)
    program, path = result.program, tuple(steps)  # which fills `follower.ran`
    return ToolPath(program.name, control.name, axes, path, tuple(follower.ran), program, control.modes)


def in_cycle(block: Block, cycles: Sequence[str]) -> bool:
    """Whether it is cut as a part of a profile by one of some cycles."""
    return bool(block.callers) and block.callers[-1].cycle in cycles


def _finishes(block: Block) -> bool:
    """Whether it is G70 with a profile."""
    return block.find("P") is not None and block.find("Q") is not None and any(w.number == _G70 for w in block.words)


class _Follower:
    """The state as it goes, and how words are read."""

    def __init__(self, control: Control, unit: Length, axes: tuple[str, ...]) -> None:
        self.modes = control.modes
        self.switches = CENTERS.get(control.name, {})
        self.centers = Centers.START
        self.state = control.initial_state(unit)
        self.axes = axes
        self.bases = dict[str, object]()
        """What made each axis unknown on which steps are followed since."""
        self.ran: list[Block] = []
        self.plain = control.writing.plain() if control.writing is not None else None

    def walk(self, program: Program, answers: Sequence[Answer]) -> Iterator[Step]:
        """Every element of the path in order."""
        contours = {answer.lines[0]: answer for answer in answers}
        inside = 0
        for block in program.blocks:
            answer = contours.get(block.line)
            if answer is not None:
                inside = answer.lines[-1]
                between = program.blocks[block.line - 1 : inside]
                yield from self._contour(answer, between)
            elif block.line > inside:
                yield from self._beside(block)

    def run(self, steps: Iterable[Passed], *, finishes: bool) -> Iterator[Step]:
        """The same of a program that calls or computes, as it runs. Behind the profile that G70 cuts, the tool goes
        back to where it was."""
        cycle, number, last = None, 0, None
        for step in chain((each for each in steps if each.blocks), (None,)):
            block = step.blocks[0] if step is not None else None
            if cycle is not None and (block is None or not in_cycle(block, FINISHING)):
                self.state, back = cycle.before, step.before if step is not None else cycle.before
                if last is None:
                    yield from self._block(cycle.blocks[0])
                elif self._place(back) != last.end:
                    ways = last.end, self._place(back)
                    yield replace(self._travel(cycle.blocks[0], back, Motion.RAPID, ways, None), number=number)
                cycle = None
            if step is None or block is None:
                return
            self.state = step.before
            if finishes and _finishes(block):
                cycle, number, last = step, len(self.ran), None
                self.ran.append(block)
                continue
            beside = chain.from_iterable(map(self._beside, step.blocks))
            for each in self._contour(step.answer, step.blocks) if step.answer is not None else beside:
                last = each if isinstance(each, Travel) else last
                # Compensation is for the finishing pass (assumed).
                is_rough = finishes and isinstance(each, Travel) and in_cycle(block, ROUGHING)
                yield replace(each, compensation=40) if is_rough else each

    def _beside(self, block: Block) -> Iterator[Step]:
        """The steps that a block beside contours adds to the path."""
        self.ran.append(block)
        if block.words or block.macro or block.faults:
            yield from self._restated(self.plain, block) if self.plain else self._block(self._switch(block))

    def _contour(self, answer: Answer, blocks: Sequence[Block]) -> Iterator[Step]:
        """The elements of a contour in some blocks, each with the one that makes it: a form has one block, or one an
        element."""
        claim, parts = answer.claim, list(blocks_of(answer.claim, self.state, self.modes))
        reason = "the contour is not solved"
        left = leave(claim, answer.contour.end if answer.contour else None, self.modes, reason)
        elements = answer.contour.elements if answer.contour else ()
        by_name = {name: part for part in parts[::-1] for name in part.names or ()}
        places = {block.line: len(self.ran) + number for number, block in enumerate(blocks)}
        self.ran += blocks
        of_axes = zip(answer.plane.axes, answer.start.free, strict=True)
        free = [
            axis for axis, is_free in of_axes if is_free and self._steps_on(axis, self.state, self.state, is_new=True)
        ]
        begin = [float(self.state.axes[axis].beyond) if axis in free else 0.0 for axis in answer.plane.axes]
        for element in elements:
            part = by_name.get(element.name, parts[0])
            # Axes outside the plane move along.
            ends = self.state, left if element is elements[-1] else self.state
            own = shifted(element, (begin[0], begin[1])) if any(begin) else element
            step = self._segment(part, answer.plane, own, ends)
            named = (*free, *step.free)
            step = replace(step, free=tuple(axis for axis in self.axes if axis in named))
            yield replace(step, number=places[part.block.line])
        if answer.contour is None:
            yield self._unfollowed(claim.blocks[0], reason)
        elif not elements and any(map(claim.beside_plane, claim.blocks)):
            motion = Motion.RAPID if parts[0].state.motion == 0 else Motion.FEED
            yield self._between(claim.blocks[0], parts[0].state, motion, (self.state, left))
        self.state = left

    def _segment(self, part: ContourBlock, plane: Plane, segment: Segment, states: tuple[State, State]) -> Travel:
        """An element of a contour in space, where the other axes are as in the states before and after it."""
        is_rapid = self.plain.is_rapid(part.block) if self.plain else part.is_rapid
        travel = self._between(part.block, part.state, Motion.RAPID if is_rapid else Motion.FEED, states)
        return along(replace(travel, plane=plane, element=segment.name), segment, self.axes)

    def _restated(self, plain: Plain, block: Block) -> Iterator[Step]:
        """The steps of a block that is not programmed in G codes."""
        before, here = self.state, apply_modes(self.state, block, self.modes)
        self.state = advance(before, block, self.modes)
        rows = (self.modes.lexicon.addresses.get(word.address) for word in block.words)
        begin, finish, free = self._ends(before, self.state, [row.axis for row in rows if row])
        said = plain.restate(block, _counted(before, free), self.state)
        others = [text for text in said.says.words if text[0] not in _BESIDE]
        if others or (said.reason and not said.ends):
            yield self._unfollowed(block, f"{others[0]} in a move" if others else said.reason)
            return
        if said.around is not None and free and not block.find(self.modes.radius):
            yield self._unfollowed(block, "where it begins is not known, and its centre is a coordinate")
            return
        start = begin
        end = tuple(
            finish[place] if axis in free else said.ends.get(axis, start[place]) for place, axis in enumerate(self.axes)
        )
        motion = Motion.RAPID if said.is_rapid else Motion.FEED
        ways = zip(start, end, strict=True)
        if said.around is not None:
            indices = self.axes.index(here.plane.axes[0]), self.axes.index(here.plane.axes[1])
            for begin, finish, bend in _turns(indices, said.around, start, end):
                yield replace(self._travel(block, here, motion, (begin, finish), bend), free=free)
        elif any(new is not None and (old is None or abs(new - old) > LENGTH) for old, new in ways):
            yield replace(self._travel(block, here, motion, (start, end), None), free=free)

    def _switch(self, block: Block) -> Block:
        """A block without the codes that change how its words are read, which are in force now."""
        found = [word for word in block.words if word.address == "G" and word.number in self.switches]
        for centers in (self.switches[word.number] for word in found if word.number is not None):
            self.centers = centers or self.centers
        if not found:
            return block
        return replace(block, words=tuple(word for word in block.words if word not in found))

    def _block(self, block: Block) -> Iterator[Step]:
        """The steps of a block that is no contour."""
        before = self.state
        here = apply_modes(before, block, self.modes)
        self.state = advance(before, block, self.modes)
        codes = codes_of(block, self.modes)
        if block.macro is not None:
            is_flow = block.macro is Macro.FLOW
            yield self._unfollowed(block, "a macro statement may jump" if is_flow else "it sets a variable")
            return
        for word in block.words:
            if self.modes.is_call(word):
                yield self._unfollowed(block, self.modes.why_lost(word))
                return
        is_preset = False
        for code in codes:
            if isinstance(code, Word):
                yield self._unfollowed(block, f"{code.text.strip()} is not known to contoursolve")
                return
            if code.effect in (Effect.SINGLE, Effect.FRAME):
                yield self._unfollowed(block, f"{_named(code)}: {code.meaning}")
                return
            if code.effect is Effect.SHIFT:
                named = Word("G", Decimal(code.number), False, _named(code), block.span)
                yield self._unfollowed(replace(block, words=(named,)), f"{_named(code)}: {code.meaning}")
            if code.effect is Effect.NO_MOTION:
                if self._sets_offsets(block):
                    yield self._unfollowed(block, f"{_named(code)}: {code.meaning}")
                return
            is_preset = is_preset or code.effect is Effect.PRESET
        yield from self._move(block, here, is_preset=is_preset)

    def _sets_offsets(self, block: Block) -> bool:
        """Whether a block changes work offsets in their table."""
        rows = [row for row, _ in self.modes.zero.rows_in(block) if row.entries is not None]
        return any(each.group == WORK for row in rows if row.entries for each in row.entries(block, ()))

    def _move(self, block: Block, here: State, *, is_preset: bool) -> Iterator[Step]:
        """A move by the block's coordinates, if it has any."""
        rows = self.modes.lexicon.addresses
        moved = [rows[word.address].axis for word in block.words if word.address in rows and rows[word.address].axis]
        has_center = any(word.address in (*here.plane.centers, self.modes.radius) for word in block.words)
        turn = _TURNS.get(here.motion or 0)
        if not moved and (turn is None or is_preset or not has_center):
            return
        code = self.modes.codes.get(here.motion) if here.motion is not None else None
        start, end, free = self._ends(here, self.state, moved)
        places = [self.state.axes[axis] for axis in moved if axis not in free]
        lost, ends = [place.reason for place in places if place.value is None], (start, end)
        if lost:
            yield self._unfollowed(block, lost[0])
        elif is_preset:
            yield self._travel(block, here, Motion.PRESET, ends, None)
        elif code is None or code.effect is not Effect.MOTION:
            yield self._unfollowed(block, f"{_named(code)}: {code.meaning}" if code else "no G0 to G3 is in force")
        elif turn is not None:
            yield self._arc(block, here, turn)
        else:
            motion = _LINES.get(code.number, Motion.THREAD)
            beside = [word for word in block.words if not self._is_plain(word)]
            if beside and motion is not Motion.THREAD:
                is_off = any(word.address == "G" and word.number == _NO_COMPENSATION for word in block.words)
                place = "beside G40, the direction of a wall" if is_off else "in a line"
                yield self._unfollowed(block, f"{beside[0].text.strip()} {place}")
            elif any(
                new is not None and (old is None or abs(new - old) > LENGTH) for old, new in zip(*ends, strict=True)
            ):
                yield replace(self._travel(block, here, motion, ends, None), free=free)

    def _is_plain(self, word: Word, more: tuple[str, ...] = ()) -> bool:
        row = self.modes.lexicon.addresses.get(word.address)
        is_beside = word.address in _BESIDE or self._bears_nothing(word.address) or word.address in more
        return is_beside or bool(row and row.axis)

    def _bears_nothing(self, address: str) -> bool:
        """Whether a word with several letters changes no path where no contour is."""
        is_lasting = address in self.modes.lasting
        return is_lasting or (len(address) > 1 and self.modes.lexicon.bearing(address) is Bearing.NONE)

    def _arc(self, block: Block, here: State, turn: Turn) -> Step:
        """An arc by its centre or its radius, or why it is none."""
        own = (*here.plane.centers, *map(_ABSOLUTE.format, here.plane.centers), self.modes.radius)
        beside = [word for word in block.words if not self._is_plain(word, own)]
        if beside:
            return self._unfollowed(block, f"{beside[0].text.strip()} in an arc of {here.plane.code}")
        rows = (self.modes.lexicon.addresses.get(word.address) for word in block.words)
        begun, ended, free = self._ends(here, self.state, [row.axis for row in rows if row])
        indices = self.axes.index(here.plane.axes[0]), self.axes.index(here.plane.axes[1])
        known = [place[index] for place in (begun, ended) for index in indices]
        numbers = [value for value in known if value is not None]
        if len(numbers) != len(known):
            return self._unfollowed(block, "the start of the arc is not known")
        start, end = (numbers[0], numbers[1]), (numbers[2], numbers[3])
        values = self._values(block, here)
        if values is None:
            return self._unfollowed(block, "the centre or the radius of the arc is not known")
        absolute = map(_ABSOLUTE.format, here.plane.centers)
        if "R" in values and len(values) > 1:
            return self._unfollowed(block, "the arc has a centre and a radius")
        if "R" in values:
            center = center_by_radius(start, end, values["R"], turn, self.modes.radius_difference)
            if center is None:
                return self._unfollowed(block, "R is too small for the arc, or the arc ends where it starts")
        elif free and (self.centers is not Centers.START or not {*absolute}.isdisjoint(values)):
            return self._unfollowed(block, "the start of the arc is not known")
        else:
            base = start if self.centers is Centers.START else (0.0, 0.0)
            ways = zip(here.plane.centers, base, strict=True)
            first, second = (values.get(_ABSOLUTE.format(each), at + values.get(each, 0.0)) for each, at in ways)
            center = first, second
        bend, unit = bend_of(indices, center, start, end, turn), here.unit.value
        if abs(bend.radii[0] - bend.radii[1]) > self.modes.radius_difference or not min(bend.radii):
            one, other = (value / float(here.unit.in_mm) for value in bend.radii)
            return self._unfollowed(
                block, f"the radius of the arc is {one:.4f} {unit} at its start and {other:.4f} {unit} at its end"
            )
        return replace(self._travel(block, here, Motion.FEED, (begun, ended), bend), free=free)

    def _values(self, block: Block, here: State) -> dict[str, float] | None:
        """The centre or the radius that a block states, mm; None if it states none, or one that has no number."""
        lexicon: Lexicon = self.modes.words(here)
        values: dict[str, float] = {}
        absolute, own = [*map(_ABSOLUTE.format, here.plane.centers)], (*here.plane.centers, self.modes.radius)
        for word in block.words:
            if word.address in (*own, *absolute):
                value = lexicon.value(word, here.unit) if word.address in lexicon.addresses else None
                if word.address in absolute and word.number is not None and not any(here.plane.diameters):
                    value = word.number * here.unit.in_mm
                if value is None or word.address in values:
                    return None
                values["R" if word.address == self.modes.radius else word.address] = float(value)
        return values or None

    def _between(self, block: Block, here: State, motion: Motion, states: tuple[State, State]) -> Travel:
        """A move from one state to another."""
        start, end, free = self._ends(*states)
        return replace(self._travel(block, here, motion, (start, end), None), free=free)

    def _ends(self, before: State, after: State, moved: Sequence[str] = ()) -> tuple[Place, Place, tuple[str, ...]]:
        """The begin and the end of a move along some axes, and the axes on which only its step is known."""
        start, end = [*self._place(before)], [*self._place(after)]
        free = tuple(
            axis
            for axis, ends in zip(self.axes, zip(start, end, strict=True), strict=True)
            if axis in after.axes and ends == _NOWHERE and self._steps_on(axis, before, after, is_new=axis in moved)
        )
        for place, axis in enumerate(self.axes):
            if axis in free:
                start[place], end[place] = float(before.axes[axis].beyond), float(after.axes[axis].beyond)
        return tuple(start), tuple(end), free

    def _steps_on(self, axis: str, before: State, after: State, *, is_new: bool) -> bool:
        """Whether steps along an axis are followed from an unknown place; from a step that is new on."""
        here, there = before.axes[axis], after.axes[axis]
        base = here.reason, here.span
        if (there.reason, there.span) != base:
            return False
        if is_new or here.beyond != there.beyond:
            self.bases[axis] = base
        return self.bases.get(axis) == base

    def _place(self, state: State) -> Place:
        values = (state.axes[axis].value if axis in state.axes else None for axis in self.axes)
        return tuple(None if value is None else float(value) for value in values)

    def _travel(
        self, block: Block, state: State, motion: Motion, ends: tuple[Place, Place], bend: Bend | None
    ) -> Travel:
        rows = self.modes.words(state).addresses.values()
        doubled = {row.axis for row in rows if row.is_diameter}
        return Travel(
            line=block.line,
            text=block.text.strip(),
            motion=motion,
            start=ends[0],
            end=ends[1],
            bend=bend,
            compensation=state.compensation,
            is_skippable=block.is_skippable,
            unit=state.unit,
            doubled=tuple(axis in doubled for axis in self.axes),
            file=block.file,
            called_at=block.callers[0].line if block.file and block.callers else 0,
            plane=state.plane,
            number=len(self.ran) - 1,
        )

    def _unfollowed(self, block: Block, reason: str) -> Unfollowed:
        """A block with its words in the terms in which the control reads them."""
        state = self.state
        modes = ["/"] if block.is_skippable else []
        if block.macro is not None:
            modes.append("".join(_BESIDE_MACRO.sub("", block.text.upper()).split()))
        if any(word.address not in _NAMES for word in block.words):
            modes += [state.unit.value, "incremental" if state.is_incremental else "absolute"]
        motion = self._motion(block, state)
        if motion:
            modes += [f"G{motion.number}", *([] if motion.number in _LINES else [state.plane.code])]
            own = [word for word in block.words if word.address == "G" and word.number == motion.number]
            block = replace(block, words=tuple(word for word in block.words if word not in own))
        words = sorted(self._canonical(word) for word in block.words if is_of_cycle(word, block, self.modes))
        place = max(len(self.ran) - 1, 0)
        return Unfollowed(block.line, block.text.strip(), (*modes, *words), reason, block.file, place)

    def _motion(self, block: Block, state: State) -> Code | None:
        """The motion that a block states, or that is in force and that the block relies on."""
        own = [code for code in codes_of(block, self.modes) if isinstance(code, Code) and code.effect in MOTIONS]
        relies = reliance(block, self.modes) in (Reliance.WORDS, Reliance.BESIDE)
        modal = self.modes.codes.get(state.motion) if relies and state.motion is not None else None
        return own[0] if own else modal

    def _canonical(self, word: Word) -> str:
        if word.number is None:
            return "".join(word.text.upper().split())
        counts = self.modes.lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS
        is_count = counts and not word.has_point and word.number and word.address not in _NAMES
        return f"{word.address}{word.number.normalize():f}{' increments' if is_count else ''}"


def _counted(state: State, free: Iterable[str]) -> State:
    """A state whose places count from where nobody knows along some axes."""
    places = ((axis, state.axes[axis]) for axis in free)
    return state.move({axis: Position(at.beyond, at.reason, at.span) for axis, at in places})


def _named(code: Code) -> str:
    return code.name or f"G{code.number}"


def along(step: Travel, segment: Segment, axes: Sequence[str]) -> Travel:
    """A move along another element of its plane, mm; what is no number there is not known. Other axes move as they
    did."""
    first, second = (axes.index(axis) for axis in (step.plane.axes if step.plane else ()))
    start, end = [*step.start], [*step.end]
    for place, at in ((start, segment.start), (end, segment.end)):
        place[first], place[second] = (None if isnan(value) else value for value in at)
    bend = None
    if isinstance(segment, ArcSegment):
        bend = bend_of((first, second), segment.center, segment.start, segment.end, segment.turn)
    return replace(step, start=tuple(start), end=tuple(end), bend=bend)


def bend_of(
    axes: tuple[int, int],
    center: tuple[float, float],
    start: tuple[float, float],
    end: tuple[float, float],
    turn: Turn,
) -> Bend:
    """An arc from its ends; a full circle if they are the same."""
    (begin, one), (finish, other) = (
        (atan2(at[1] - center[1], at[0] - center[0]), hypot(at[0] - center[0], at[1] - center[1]))
        for at in (start, end)
    )
    is_full = hypot(end[0] - start[0], end[1] - start[1]) <= LENGTH
    sweep = tau if is_full else ((finish - begin) * turn.sign) % tau
    return Bend(axes, center, begin, sweep * turn.sign, (one, other))


def _turns(axes: tuple[int, int], around: Around, start: Place, end: Place) -> Iterator[tuple[Place, Place, Bend]]:
    """An arc, each turn by itself if it has several: where it begins and ends, and what makes it one."""
    (first, second), (center, sweep) = axes, around
    radii = [dist(center, (at[first] or 0.0, at[second] or 0.0)) for at in (start, end)]
    begin = atan2((start[second] or 0.0) - center[1], (start[first] or 0.0) - center[0])
    parts = max(1, ceil(abs(sweep) / 360.0 - REGULAR))
    for number in range(parts):
        share = radians(sweep) / parts
        angles = begin + share * number, begin + share * (number + 1)
        places = [start, end]
        for side, at in enumerate(angles):
            way = (number + side) / parts
            if 0 < way < 1:
                radius = radii[0] + (radii[1] - radii[0]) * way
                place = [None if a is None or b is None else a + (b - a) * way for a, b in zip(start, end, strict=True)]
                place[first], place[second] = center[0] + radius * cos(at), center[1] + radius * sin(at)
                places[side] = tuple(place)
        yield places[0], places[1], Bend(axes, center, angles[0], share, (radii[0], radii[1]))
