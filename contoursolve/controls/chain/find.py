"""The finder of blocks in a row that make a contour of a language.

Two blocks belong together where they meet in an intersection that the control computes, and where the first one has a
corner.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace as replace_fields
from itertools import count
from typing import Any

from msgspec.structs import replace

from contoursolve.controls.chain.claim import claim_of, shapes_of
from contoursolve.controls.chain.language import Element, Joining, Language, Member
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Turn, assemble
from contoursolve.reading import (
    COMMENTED,
    Control,
    Effect,
    Modes,
    ParsedContour,
    Position,
    State,
    apply_modes,
    axis_words,
    codes_of,
    leave,
    positions,
    read,
)
from contoursolve.solving import ArcSegment, Segment, Status, analyse, is_closed, solve, trace

STRAIGHT = 1e-6
"""The distance beside the direction before it, mm, up to which the end of an arc makes it a line."""

_SAME = 1e-9
"""The sine of the angle between two directions that are one."""

_Ways = tuple[complex | None, complex | None]
"""The directions in which an element begins and ends; None where they are not known."""

_NO_COMPENSATION = 40

_TURNS = {2: Turn.CW, 3: Turn.CCW}
_QUIET = (Effect.NONE, Effect.NO_MOTION, Effect.PLANE)
_OWN_USE = (Effect.CORNER, Effect.SINGLE, Effect.NO_MOTION, Effect.PRESET, Effect.CYCLE, Effect.FRAME)


class ChainFinder:
    """Finds the contours of a language: called as a `Finder` is."""

    def __init__(self, language: Language) -> None:
        self.language = language
        self._cornered = frozenset(language.corner.words)
        self._angles = frozenset(language.angle.addresses)
        self._moving = frozenset({*language.axes, *self._angles, *language.corner.words})
        arcs = (language.arc.tangent,) if language.arc.tangent is not None else ()
        self._cutting = frozenset({1, *_TURNS, *arcs})

    def __call__(self, blocks: Sequence[Block], index: int, state: State, modes: Modes) -> ParsedContour | None:
        """The contour that begins at a block: everything that is resolved together with it."""
        block = blocks[index]
        if self._is_corner(block) and COMMENTED not in state.memory:
            return claim_of(self.language, [self._member(block, state, modes, is_over=False)], state, modes)
        if not block.words or COMMENTED in state.memory or not self._is_motion(block, state, modes):
            return None
        members = [self._member(block, state, modes, is_over=False)]
        is_alone = self._is_over_defined(block, members[0].here)
        is_tied = is_alone or self._is_tied_alone(members[0])
        position = index
        while members[0].here.motion in self._cutting or self._runs_in_rapid(members):
            last = members[-1]
            following, here = self._next(blocks, position, last.here, modes)
            if following is not None and self._is_corner(blocks[following]):
                here = self._apply(here, blocks[following], modes)
                members[-1] = last = replace(last, corner=blocks[following], here=here)
                is_tied = True
                following, here = self._next(blocks, following, here, modes)
            if following is None or not self._is_motion(blocks[following], here, modes):
                members[-1] = replace(last, unread=self._unread(last, blocks, following, here, modes))
                break
            before, here = here, self._apply(here, blocks[following], modes)
            is_over = self._begins_in_intersection(last, blocks[following], here)
            is_cut = self._may_follow_corner(last, here, modes) and self._moves(blocks[following], here)
            is_smooth = here.motion == self.language.arc.tangent and last.here.motion in self._cutting
            is_joined = is_smooth or (self._makes_corner(last) and is_cut)
            if not is_over and (self._ends_behind(last, here, modes) or not is_joined):
                break
            if is_over:
                members[-1] = replace(last, element=replace(last.element, is_followed=True))
            members[-1] = replace(members[-1], is_joined=True)
            members.append(self._member(blocks[following], before, modes, is_over=is_over))
            if is_smooth:
                members[-1] = replace(members[-1], element=self._bend(members, state, modes))
            members[-2:] = self._aimed(members[-2], members[-1])
            if is_over and self._touches(members[-2], members[-1]):
                members[-1] = replace(members[-1], element=replace(members[-1].element, touches=True))
            position = following
            is_tied = True
            if here.motion == 0 and not self._runs_in_rapid(members):
                break
        if not is_tied:
            return None
        members[0] = replace(members[0], is_alone=is_alone)
        is_last = self._has_corner(members[-1]) and members[-1].unread is None
        members[-1] = replace(members[-1], is_last=is_last)
        members = self._without_straight(members, state, modes)
        return claim_of(self.language, members, state, modes)

    def _member(self, block: Block, before: State, modes: Modes, *, is_over: bool) -> Member:
        here = self._apply(before, block, modes)
        is_smooth = self.language.arc.tangent is not None and here.motion == self.language.arc.tangent
        turn = Turn.CCW if is_smooth else _TURNS.get(here.motion or 0)
        element = Element(turn, is_over, is_smooth=is_smooth)
        is_signed = not self.language.corner.is_signed_by_shape and bool(self._signed_words(block, here))
        return Member(block, element, before, here, is_signed=is_signed)

    def _signed_words(self, block: Block, here: State) -> list[Word]:
        """The words of a line that may make a corner whose sign tells which way the next line runs."""
        words = [word for word in block.words if word.address in self.language.corner.signed]
        # Two letters beside G40 are the direction of the next wall (printed for Haas, assumed of others).
        if len({word.address for word in words} & {"I", "J", "K"}) > 1 and any(
            word.address == "G" and word.number == _NO_COMPENSATION for word in block.words
        ):
            return []
        return [
            word for word in words if here.motion == 1 and self.language.corner.signed_name(word.address, here.plane)
        ]

    def _aimed(self, last: Member, following: Member) -> tuple[Member, Member]:
        """Two blocks with a corner between them; the second with which way it must run, where a sign tells that."""
        words, axes = self._signed_words(last.block, last.here), [*last.here.plane.axes]
        if not words:
            return last, following
        moved = [self._programmed(each.block, each.here) for each in (last, following)]
        is_drawn = any(self._stated(each.block, each.here) & self._angles for each in (last, following))
        is_square = [len(each) for each in moved] == [1, 1] and moved[0] != moved[1] and not is_drawn
        is_square = is_square and following.here.motion == 1 and following.here.plane == last.here.plane
        if self.language.corner.is_signed_by_shape and not is_square:
            return last, following
        last = replace(last, is_signed=True)
        if len(moved[0]) == 1:
            across = 1 - axes.index(min(moved[0]))
            leaves = (across,) if following.element.turn is None else (0, 1)
            following = replace(following, leaves=leaves)
            number = words[0].number
            if is_square and number and not following.element.is_over:
                element = replace(following.element, aim=across)
                following = replace(following, element=element, way=1 if number > 0 else -1)
        return last, following

    def _runs_in_rapid(self, members: Sequence[Member]) -> bool:
        may_run = self.language.order.runs_in_rapid or self.language.corner.codes_in_rapid
        return may_run and members[-1].here.motion == 0

    def _ends_behind(self, last: Member, here: State, modes: Modes) -> bool:
        """Whether nothing joins a block to the next one: a rapid without a corner, or a corner that is left out, as
        another plane is selected behind it."""
        is_rapid = last.here.motion == 0 and not self.language.order.runs_in_rapid
        is_left = self.language.corner.leaves_out(modes) and here.plane.code != last.here.plane.code
        return (is_rapid and last.corner is None) or is_left

    def _may_follow_corner(self, last: Member, here: State, modes: Modes) -> bool:
        """Whether a motion may follow the corner of a block."""
        corner = self.language.corner
        may_be_rapid = last.corner is not None and corner.codes_in_rapid
        may_be_rapid = may_be_rapid or (self._has_corner(last) and corner.words_in_rapid(modes))
        return here.motion in self._cutting or (here.motion == 0 and may_be_rapid)

    def _bend(self, members: Sequence[Member], state: State, modes: Modes) -> Element:
        """The last block's element: an arc that begins in the direction of what is before it turns to the side on which
        it ends, and is a line where it ends straight ahead. Where what is before it is not known, it is any arc."""
        element = members[-1].element
        state, ways = self._ways(members[:-1], state, modes)
        way, chord = ways[-1][1], _chord(members[-1], state, modes)
        if way is None or not chord:
            return element
        aside = (way.conjugate() * chord).imag
        if abs(aside) <= STRAIGHT and (way.conjugate() * chord).real > 0:
            return replace(element, turn=None, is_smooth=False)
        return replace(element, turn=Turn.CW if aside < 0 else Turn.CCW)

    def _without_straight(self, members: Sequence[Member], state: State, modes: Modes) -> list[Member]:
        """The members, without the corners of a word that stays in force where the direction does not change."""
        if not any(member.here.memory.keys() & self.language.corner.stays.keys() for member in members):
            return list(members)
        _, ways = self._ways(members, state, modes)
        found = []
        for (_, end), (begin, _), member in zip(ways, ways[1:], members, strict=False):
            turn = end.conjugate() * begin if end is not None and begin is not None else None
            is_straight = turn is not None and abs(turn.imag) <= _SAME and turn.real > 0
            found.append(replace(member, is_straight=True) if is_straight else member)
        return [*found, members[-1]]

    def _ways(self, members: Sequence[Member], state: State, modes: Modes) -> tuple[State, list[_Ways]]:
        """The state behind blocks, and the directions in which each of them begins and ends, without the corners."""
        ways, run = list[_Ways](), list[Member]()
        for member in (*members, None):
            if member is not None and not member.element.is_smooth:
                run.append(member)
                continue
            if run:
                state, found = self._ways_of_run(run, state, modes)
                ways, run = [*ways, *found], []
            if member is not None:
                way, chord = ways[-1][1] if ways else None, _chord(member, state, modes)
                # A chord lies in the middle between the directions at its ends.
                end = way.conjugate() * chord**2 / abs(chord) ** 2 if way is not None and chord else None
                state, ways = state.move(_ends(member, state, modes)), [*ways, (way, end)]
        return state, ways

    def _ways_of_run(self, run: Sequence[Member], state: State, modes: Modes) -> tuple[State, list[_Ways]]:
        """The same of blocks without arcs that begin in the direction of what is before them."""
        claim = claim_of(self.language, run, state, modes)
        corners = frozenset(name for name in claim.givens if name.partition(":")[2] in self._cornered)
        profile = read(claim, corners)
        system = assemble(profile)
        if profile.start.is_known and analyse(system).is_determined and is_closed(system):
            solution = solve(profile, is_proven=False)
            if solution.status in (Status.SOLVED, Status.OVERDETERMINED):
                contour = trace(profile, solution)
                elements = {each.name: each for each in contour.elements}
                return leave(claim, contour.end, modes), [
                    _ways_of(elements[each.name]) if each.name in elements else (None, None)
                    for each in claim.form.outline.path
                ]
        return leave(claim, None, modes), [(None, None)] * len(run)

    def _is_corner(self, block: Block) -> bool:
        """Whether a block makes a corner between those beside it, and nothing else."""
        return bool(shapes_of(self.language, block))

    def _apply(self, before: State, block: Block, modes: Modes) -> State:
        """The state with the block's G codes in force; its plane has a parallel axis in place of its own one where a
        line by its angle has only that coordinate."""
        here, parallel = apply_modes(before, block, modes), self.language.angle.parallel
        plane = self.language.planes.get(here.plane.code, here.plane)
        here = here if here.plane == plane else replace(here, plane=plane)
        stated, axes = self._stated(block, here), here.plane.axes
        moved = [axis for axis in axes if parallel.get(axis) in stated]
        if (
            self.language.angle.address not in stated
            or here.motion not in (0, 1)
            or stated & {*axes}
            or len(moved) != 1
        ):
            return here
        named = tuple(parallel[axis] if axis in moved else axis for axis in axes)
        return replace(here, plane=replace(here.plane, axes=(named[0], named[1])))

    def _next(self, blocks: Sequence[Block], index: int, here: State, modes: Modes) -> tuple[int | None, State]:
        """The index of the next block that says something, and is none that a contour may have between its blocks; and
        the state before it."""
        passed = 0
        for other in count(index + 1):  # the length of what is read ahead is not known without counting
            try:
                block = blocks[other]
            except IndexError:
                return None, here
            codes = {word.number for word in block.words if word.address == "G"}
            if not block.says_something or (codes and codes <= self.language.order.passes):
                continue
            if passed == self.language.order.between or not self._is_idle(block, here, modes):
                return other, here
            here = self._apply(here, block, modes)
            passed += 1
        return None, here

    def _is_idle(self, block: Block, here: State, modes: Modes) -> bool:
        """Whether a block moves nothing, and leaves the motion and how words are read as they are. It may select a
        plane: a contour that goes on in another one is refused."""
        if block.faults or block.macro or any(modes.is_call(word) for word in block.words):
            return False
        behind = apply_modes(here, block, modes)
        if modes.unread(block, behind) is not None or any(behind.axes[a] is not here.axes[a] for a in here.plane.axes):
            return False
        codes = codes_of(block, modes)
        is_quiet = all(not isinstance(code, Word) and code.effect in _QUIET and code.diameter is None for code in codes)
        return is_quiet and not self._moves(block, here) and not self._is_corner(block)

    def _is_motion(self, block: Block, state: State, modes: Modes) -> bool:
        """Whether the block's axis words are the end of a motion with G0 to G3."""
        codes = codes_of(block, modes)
        if block.macro or any(isinstance(code, Word) or code.effect in _OWN_USE for code in codes):
            return False
        here = apply_modes(state, block, modes)
        if here.motion in self.language.order.threads:
            # Other threads are no part of a contour; what would make these one is refused.
            words = {*self._angles, *self._cornered}
            return any(word.startswith(",") for word in self._stated(block, here) & words)
        return here.motion in (0, *self._cutting) and self._moves(block, here)

    def _moves(self, block: Block, here: State) -> bool:
        """Whether a block is a motion: it has a coordinate, an angle, a corner; an arc a centre, R, or just its G code.
        A Q that belongs to nothing is looked at, too; with M or P it belongs to these (`G64 P0.1 Q0.1`)."""
        stated = self._stated(block, here)
        is_arc = here.motion in _TURNS and stated & {"I", "J", "K", "R"}
        is_choice = self.language.meeting.selector in stated and not (block.find("M") or block.find("P"))
        if stated & self._moving or is_arc or is_choice:
            return True
        arcs = {*_TURNS, self.language.arc.tangent}
        is_corner = not self.language.corner.is_signed_by_shape and bool(self._signed_words(block, here))
        return is_corner or any(word.address == "G" and word.number in arcs for word in block.words)

    def _stated(self, block: Block, here: State) -> set[str]:
        """The names of the addresses of a block; a word that cannot be read still shows what the block was meant to
        be."""
        addresses = {word.address for word in block.words}
        if block.faults:
            addresses |= {fault.address for fault in block.faults}
        if not self.language.names:
            return addresses
        names = self.language.names_in(is_arc=here.motion in _TURNS)
        return {names.get(address, address) for address in addresses}

    def _programmed(self, block: Block, here: State) -> set[str]:
        """The axes of the plane that a block programs."""
        rows = (self.language.lexicon.addresses.get(address) for address in self._stated(block, here))
        return {row.axis for row in rows if row} & {*here.plane.axes}

    def _over_defining(self, here: State) -> set[str]:
        """The words that over-define a block: both coordinates of the plane and the angle of a line; end, centre and R
        of a circle. The selector does not: it only chooses."""
        if here.motion in _TURNS:
            return {*here.plane.axes, *here.plane.centers, "R"}
        return {*here.plane.axes, self.language.angle.address}

    def _is_over_defined(self, block: Block, here: State) -> bool:
        is_possible = self.language.meeting.joining is Joining.OVER_DEFINED
        return is_possible and self._stated(block, here) >= self._over_defining(here)

    def _begins_in_intersection(self, last: Member, following: Block, here: State) -> bool:
        """Whether a block meets the one before it in an intersection, or touches it."""
        if self.language.meeting.joining is Joining.PAIRED:
            return self._is_open(last) and self._is_paired(last, following, here)
        if self.language.meeting.joining is Joining.OPEN:
            is_cut = last.here.motion == 1 or (
                self.language.order.runs_in_rapid and last.here.motion == here.motion == 0
            )
            return here.motion in (0, 1) and is_cut and self._is_open(last)
        missing = self._over_defining(here) - self._stated(following, here)
        # A block with a selector that lacks one word only is meant to.
        return len(missing) <= (self.language.meeting.selector in self._stated(following, here)) or self._is_joined(
            last, following, here
        )

    def _is_open(self, last: Member) -> bool:
        """Whether a line has an angle, and no end; of blocks in pairs, whether an arc has none."""
        is_arc = last.element.turn is not None and self.language.meeting.joining is Joining.PAIRED
        is_drawn = is_arc or bool(self._stated(last.block, last.here) & self._angles)
        return is_drawn and not self._programmed(last.block, last.here)

    def _is_paired(self, last: Member, following: Block, here: State) -> bool:
        """Whether what has no end has it where a block meets it. About its centre, an arc without an end is a full
        circle, too, where what follows does not show that it is none."""
        first, second = self._stated(last.block, last.here), self._stated(following, here)
        if last.element.turn is None or first & {"R", self.language.meeting.picks, *self.language.arc.centers}:
            return last.here.motion != 0
        if self.language.arc.closes or not first & {*last.here.plane.centers} or not second >= {*here.plane.axes}:
            return False
        drawing = {*here.plane.centers, "R"} if here.motion in _TURNS else self._angles
        return here.motion != 0 and bool(second & drawing)

    def _touches(self, first: Member, second: Member) -> bool:
        """Whether two blocks in a pair touch: two arcs, and a line and an arc that has no centre."""
        arcs = [each for each in (first, second) if each.element.turn is not None]
        centers = {*first.here.plane.centers, *self.language.arc.centers}
        is_centered = any(self._stated(each.block, each.here) & centers for each in arcs)
        return self.language.meeting.joining is Joining.PAIRED and bool(arcs) and (len(arcs) > 1 or not is_centered)

    def _is_joined(self, last: Member, following: Block, here: State) -> bool:
        """Whether further facts join two blocks in an intersection, for contoursolve alone: an arc and a line, or a
        line whose end is not programmed and what follows it."""
        is_extended = any(word.is_asked for word in _words(last.block, following))
        if not (is_extended or last.block.directives or following.directives):
            return False
        if last.element.turn is not None:
            is_line = here.motion in (0, 1)
            return is_line and bool(
                self._programmed(following, here) or self.language.angle.address in self._stated(following, here)
            )
        return self._is_open(last)

    def _needs_next(self, last: Member, following: Block, here: State) -> bool:
        """Whether an element may be another one with the next block: it has a corner or no end, or that block may meet
        it in an intersection."""
        meets = self.language.meeting.joining is Joining.OVER_DEFINED and bool(self._programmed(following, here))
        return meets or self._has_corner(last) or self._is_open(last)

    def _unread(
        self, last: Member, blocks: Sequence[Block], following: int | None, here: State, modes: Modes
    ) -> Word | None:
        """The word that shapes the next block, on which the last element depends, in a way that is not read; what is no
        code may have been meant as one on which it depends."""
        if following is None or blocks[following].macro is not None:
            return None
        # What is no code has no number that says what it does.
        codes = codes_of(blocks[following], modes)
        unknown = (replace(code, number=None) for code in codes if isinstance(code, Word))
        word = modes.unread(blocks[following], apply_modes(here, blocks[following], modes))
        return (word if self._needs_next(last, blocks[following], here) else None) or next(unknown, None)

    def _keeps_angle(self, member: Member) -> bool:
        """Whether a line with one coordinate runs at the angle that stays in force."""
        kept = self.language.angle.stays and self.language.angle.address in member.here.memory
        return kept and member.element.turn is None and len(self._programmed(member.block, member.here)) == 1

    def _has_corner(self, member: Member) -> bool:
        """Whether a block, or one of its own behind it, has a corner word."""
        stated = self._stated(member.block, member.here)
        return member.corner is not None or member.is_signed or bool(stated & self._cornered)

    def _makes_corner(self, member: Member) -> bool:
        """The same, or whether a word that stays in force makes one, which it does not behind a rapid."""
        is_kept = member.here.motion != 0 and member.here.memory.keys() & self.language.corner.stays.keys()
        return self._has_corner(member) or bool(is_kept)

    def _is_tied_alone(self, member: Member) -> bool:
        """Whether a block is calculated although nothing follows that belongs to it: a line by its angle, one with a
        corner, and an arc about a centre that it has to itself."""
        block, here = member.block, member.here
        stated = self._stated(block, here)
        is_centered = here.motion in _TURNS and bool(stated & {*self.language.arc.centers})
        is_open = is_centered and not stated & {"I", "J", "K", "R"}
        if self._has_corner(member) or member.element.is_smooth or is_open:
            return True
        return bool(stated & {*self._angles, self.language.meeting.selector}) or self._keeps_angle(member)


def reading(
    names: Mapping[str, str] | None = None,
    like: Mapping[str, str] | None = None,
    **parts: Mapping[str, Any],
) -> Callable[[Control], Control]:
    """The change that a value of a setting makes in the language of a control.

    `names` are addresses, each with the one whose row and name it takes, which is no word then; `like` are words
    besides, each with the one whose row it has; `parts` are changes in the parts of the language, by field.
    """
    names, like = names or {}, like or {}

    def change(control: Control) -> Control:
        if not isinstance(control.find, ChainFinder):
            raise TypeError(f"{control.name} has no language")
        language, rows = control.find.language, dict(control.modes.lexicon.addresses)
        added = {**names, **like}
        named = {address: replace_fields(rows[name], address=address) for address, name in added.items()}
        rows = {address: row for address, row in rows.items() if address not in names.values()} | named
        words = replace_fields(control.modes.lexicon, addresses=rows) if added else control.modes.lexicon
        known = language.allowed - {*names.values()} | {*added}
        language = replace_fields(language, lexicon=words, allowed=known, names={**language.names, **names})
        changed = {part: replace_fields(getattr(language, part), **fields) for part, fields in parts.items()}
        language = replace_fields(language, **changed)
        return replace_fields(control, modes=replace_fields(control.modes, lexicon=words), find=ChainFinder(language))

    return change


def _ways_of(segment: Segment) -> _Ways:
    """The directions in which an element begins and ends, of length 1."""
    start, end = complex(*segment.start), complex(*segment.end)
    if isinstance(segment, ArcSegment):
        center = complex(*segment.center)
        spokes = [(at - center) * segment.turn.sign * 1j for at in (start, end)]
        return spokes[0] / abs(spokes[0]), spokes[1] / abs(spokes[1])
    return (end - start) / abs(end - start), (end - start) / abs(end - start)


def _chord(member: Member, state: State, modes: Modes) -> complex | None:
    """From where a block begins to where its words end, if that is known."""
    here = replace(member.here, axes=state.axes)
    return here.step_to(here.move(_ends(member, state, modes)))


def _ends(member: Member, state: State, modes: Modes) -> dict[str, Position]:
    here = replace(member.here, axes=state.axes)
    return positions(here, axis_words(member.block, modes), modes, False)


def _words(*blocks: Block) -> Iterator[Word]:
    return (word for block in blocks for word in block.words)
