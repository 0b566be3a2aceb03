"""Which blocks in a row make a contour of a language.

Two blocks belong together where they meet in an intersection that the control computes, and where the first one has a
corner.
"""

from collections.abc import Iterator, Sequence
from itertools import count

from msgspec.structs import replace

from contoursolve.controls.chain.claim import claim_of
from contoursolve.controls.chain.language import Element, Joining, Language, Member
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Turn
from contoursolve.reading import Effect, Modes, ParsedContour, State, apply_modes, codes_of

_TURNS = {2: Turn.CW, 3: Turn.CCW}
_OWN_USE = (Effect.SINGLE, Effect.NO_MOTION, Effect.PRESET, Effect.CYCLE, Effect.FRAME)


class ChainFinder:
    """Finds the contours of a language: called as a `Finder` is."""

    def __init__(self, language: Language) -> None:
        self.language = language
        self._cornered = frozenset(language.corners)
        self._moving = frozenset({*language.axes, *language.angles, *language.corners})

    def __call__(self, blocks: Sequence[Block], index: int, state: State, modes: Modes) -> ParsedContour | None:
        """The contour that begins at a block: everything that is resolved together with it."""
        block = blocks[index]
        if not block.words or not self._is_motion(block, state, modes):
            return None
        members = [self._member(block, state, modes, is_over=False)]
        is_alone = self._is_over_defined(block, members[0].here)
        is_tied = is_alone or self._is_tied_alone(block, members[0].here, modes)
        position = index
        while members[0].here.motion in (1, 2, 3):
            last = members[-1]
            following = self._next(blocks, position)
            if following is None or not self._is_motion(blocks[following], last.here, modes):
                break
            here = self._apply(last.here, blocks[following], modes)
            is_over = self._begins_in_intersection(last, blocks[following], here)
            is_cut = here.motion in (1, 2, 3) and self._moves(blocks[following], here)
            if not is_over and not (self._has_corner(last.block) and is_cut):
                break
            if is_over:
                members[-1] = replace(last, element=replace(last.element, is_followed=True))
            members.append(self._member(blocks[following], last.here, modes, is_over=is_over))
            if is_over and self._touches(members[-2], members[-1]):
                members[-1] = replace(members[-1], element=replace(members[-1].element, touches=True))
            position = following
            is_tied = True
            if here.motion == 0:
                break
        if not is_tied:
            return None
        members[0] = replace(members[0], is_alone=is_alone)
        members[-1] = replace(members[-1], is_last=self._has_corner(members[-1].block))
        return claim_of(self.language, members, state, modes)

    def _member(self, block: Block, before: State, modes: Modes, *, is_over: bool) -> Member:
        here = self._apply(before, block, modes)
        return Member(block, Element(_TURNS.get(here.motion or 0), is_over, is_followed=False), before, here)

    def _apply(self, before: State, block: Block, modes: Modes) -> State:
        """The state with the block's G codes in force; its plane has a parallel axis in place of its own one where a
        line by its angle has only that coordinate."""
        here, parallel = apply_modes(before, block, modes), self.language.parallel
        plane = self.language.planes.get(here.plane.code, here.plane)
        here = here if here.plane == plane else replace(here, plane=plane)
        stated, axes = _stated(block), here.plane.axes
        moved = [axis for axis in axes if parallel.get(axis) in stated]
        if self.language.angle not in stated or here.motion not in (0, 1) or stated & {*axes} or len(moved) != 1:
            return here
        named = tuple(parallel[axis] if axis in moved else axis for axis in axes)
        return replace(here, plane=replace(here.plane, axes=(named[0], named[1])))

    def _next(self, blocks: Sequence[Block], index: int) -> int | None:
        """The index of the next block that says something, and is none that a contour may have between its blocks."""
        for other in count(index + 1):  # the length of what is read ahead is not known without counting
            try:
                block = blocks[other]
            except IndexError:
                return None
            codes = {word.number for word in block.words if word.address == "G"}
            if _has_words(block) and not (codes and codes <= self.language.passes):
                return other
        return None

    def _is_motion(self, block: Block, state: State, modes: Modes) -> bool:
        """Whether the block's axis words are the end of a motion with G0 to G3."""
        codes = codes_of(block, modes)
        if block.macro or any(isinstance(code, Word) or code.effect in _OWN_USE for code in codes):
            return False
        here = apply_modes(state, block, modes)
        return here.motion in (0, 1, 2, 3) and self._moves(block, here)

    def _moves(self, block: Block, here: State) -> bool:
        """Whether a block is a motion: it has a coordinate, an angle, a corner; an arc a centre, R, or just its G code.
        A Q that belongs to nothing is looked at, too."""
        stated = _stated(block)
        is_arc = here.motion in _TURNS and stated & {"I", "J", "K", "R"}
        is_choice = self.language.selector in stated and not block.find("M")
        if stated & self._moving or is_arc or is_choice:
            return True
        return any(word.address == "G" and word.number in _TURNS for word in block.words)

    def _programmed(self, block: Block, here: State) -> set[str]:
        """The axes of the plane that a block programs."""
        rows = (self.language.lexicon.addresses.get(address) for address in _stated(block))
        return {row.axis for row in rows if row} & {*here.plane.axes}

    def _over_defining(self, here: State) -> set[str]:
        """What over-defines a block: both coordinates of the plane and the angle of a line; end, centre and R of a
        circle. The selector does not: it only chooses."""
        if here.motion in _TURNS:
            return {*here.plane.axes, *here.plane.centers, "R"}
        return {*here.plane.axes, self.language.angle}

    def _is_over_defined(self, block: Block, here: State) -> bool:
        is_possible = self.language.joining is Joining.OVER_DEFINED
        return is_possible and _stated(block) >= self._over_defining(here)

    def _begins_in_intersection(self, last: Member, following: Block, here: State) -> bool:
        """Whether a block meets the one before it in an intersection, or touches it."""
        if self.language.joining is Joining.PAIRED:
            return self._is_open(last) and self._is_paired(last, following, here)
        if self.language.joining is Joining.OPEN:
            return here.motion in (0, 1) and last.here.motion == 1 and self._is_open(last)
        missing = self._over_defining(here) - _stated(following)
        # A block with a selector that lacks one word only is meant to.
        return len(missing) <= (self.language.selector in _stated(following)) or self._is_joined(last, following, here)

    def _is_open(self, last: Member) -> bool:
        """Whether a line has an angle, and no end; of blocks in pairs, whether an arc has none."""
        is_arc = last.element.turn is not None and self.language.joining is Joining.PAIRED
        is_drawn = is_arc or bool(_stated(last.block) & {*self.language.angles})
        return is_drawn and not self._programmed(last.block, last.here)

    def _is_paired(self, last: Member, following: Block, here: State) -> bool:
        """Whether what has no end has it where a block meets it. About its centre, an arc without an end is a full
        circle, too, where what follows does not show that it is none."""
        first, second = _stated(last.block), _stated(following)
        if last.element.turn is None or first & {"R", self.language.picks}:
            return last.here.motion != 0
        if self.language.closes or not first & {*last.here.plane.centers} or not second >= {*here.plane.axes}:
            return False
        drawing = {*here.plane.centers, "R"} if here.motion in _TURNS else {*self.language.angles}
        return here.motion != 0 and bool(second & drawing)

    def _touches(self, first: Member, second: Member) -> bool:
        """Whether two blocks in a pair touch: two arcs, and a line and an arc that has no centre."""
        arcs = [each for each in (first, second) if each.element.turn is not None]
        is_centered = any(_stated(each.block) & {*each.here.plane.centers} for each in arcs)
        return self.language.joining is Joining.PAIRED and bool(arcs) and (len(arcs) > 1 or not is_centered)

    def _is_joined(self, last: Member, following: Block, here: State) -> bool:
        """Whether further facts join two blocks in an intersection, for contoursolve alone: an arc and a line, or a
        line whose end is not programmed and what follows it."""
        is_extended = any(word.is_asked for word in _words(last.block, following))
        if not (is_extended or last.block.directives or following.directives):
            return False
        if last.element.turn is not None:
            is_line = here.motion in (0, 1)
            return is_line and bool(self._programmed(following, here) or self.language.angle in _stated(following))
        return self._is_open(last)

    def _has_corner(self, block: Block) -> bool:
        return bool(_stated(block) & self._cornered)

    def _is_tied_alone(self, block: Block, here: State, modes: Modes) -> bool:
        """Whether a block is calculated although nothing follows that belongs to it: a line by its angle, one with
        a corner; and where arcs are checked, an arc with an end, if its values are known. About its centre, it is a
        full circle if that is where it begins (assumed)."""
        stated = _stated(block)
        if self._has_corner(block) or stated & {*self.language.angles, self.language.selector}:
            return True
        is_variable = any(word.number is None and not word.is_asked for word in block.words)
        if not self.language.checks_arcs or here.motion not in _TURNS or is_variable:
            return False
        if not stated & {*here.plane.axes, "R"}:
            return False
        return "R" in stated or not stated & {*here.plane.centers} or not _ends_where_it_begins(block, here, modes)


def _has_words(block: Block) -> bool:
    return bool(block.faults or block.macro) or any(word.address not in ("N", "O") for word in block.words)


def _stated(block: Block) -> set[str]:
    """The addresses of a block; a word that cannot be read still shows what the block was meant to be."""
    return {word.address for word in block.words} | {fault.address for fault in block.faults}


def _ends_where_it_begins(block: Block, here: State, modes: Modes) -> bool:
    ends = {word.address: word for word in block.words if word.address in here.plane.axes}
    return all(
        word.number is not None
        and modes.lexicon.value(word, here.unit) == (0 if here.is_incremental else here.axes[axis].value)
        for axis, word in ends.items()
    )


def _words(*blocks: Block) -> Iterator[Word]:
    return (word for block in blocks for word in block.words)
