"""NCT chapter 16: which blocks in a row make a contour.

Two blocks belong together where the second one is over-defined (16.3), so that they meet in an intersection that the
control computes, and where the first one has ,C or ,R (16.1).
"""

from collections.abc import Iterator, Sequence
from itertools import count

from msgspec.structs import replace

from contoursolve.controls.nct_99m.claim import Member, claim_of
from contoursolve.controls.nct_99m.lexicon import AXES, CHAMFER, PARALLEL_TO, PLANES, ROUNDING, Element
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Turn
from contoursolve.reading import Effect, Modes, ParsedContour, State, apply_modes, codes_of

_TURNS = {2: Turn.CW, 3: Turn.CCW}
_OWN_USE = (Effect.SINGLE, Effect.NO_MOTION, Effect.PRESET, Effect.CYCLE, Effect.FRAME)


def find(blocks: Sequence[Block], index: int, state: State, modes: Modes) -> ParsedContour | None:
    """The contour that begins at a block: everything that is resolved together with it."""
    block = blocks[index]
    if not block.words or not _is_motion(block, state, modes):
        return None
    members = [_member(block, state, modes, is_over=False)]
    is_alone = _is_over_defined(block, members[0].here)
    is_tied = is_alone or _is_tied_alone(block, members[0].here, modes)
    position = index
    while members[0].here.motion in (1, 2, 3):
        last = members[-1]
        following = _next(blocks, position)
        if following is None or not _is_motion(blocks[following], last.here, modes):
            break
        here = _apply(last.here, blocks[following], modes)
        is_over = _is_meant_over_defined(blocks[following], here) or _is_stated(last, blocks[following], here)
        is_cut = here.motion in (1, 2, 3) and _moves(blocks[following], here)
        if not is_over and not (_has_corner(last.block) and is_cut):
            break
        if is_over:
            members[-1] = replace(last, element=replace(last.element, is_followed=True))
        members.append(_member(blocks[following], last.here, modes, is_over=is_over))
        position = following
        is_tied = True
        if here.motion == 0:
            break
    if not is_tied:
        return None
    members[0] = replace(members[0], is_alone=is_alone)
    members[-1] = replace(members[-1], is_last=_has_corner(members[-1].block))
    return claim_of(members, state, modes)


def _member(block: Block, before: State, modes: Modes, *, is_over: bool) -> Member:
    here = _apply(before, block, modes)
    return Member(block, Element(_TURNS.get(here.motion or 0), is_over, is_followed=False), here)


def _apply(before: State, block: Block, modes: Modes) -> State:
    """The state with the block's G codes in force; its plane has a parallel axis in place of its own one where a line
    by its angle has only that coordinate (16.2)."""
    here = apply_modes(before, block, modes)
    plane = PLANES[here.plane.code]
    here = here if here.plane == plane else replace(here, plane=plane)
    stated, axes = _stated(block), here.plane.axes
    parallel = [axis for axis in axes if PARALLEL_TO[axis] in stated]
    if ",A" not in stated or here.motion not in (0, 1) or stated & {*axes} or len(parallel) != 1:
        return here
    named = tuple(PARALLEL_TO[axis] if axis in parallel else axis for axis in axes)
    return replace(here, plane=replace(here.plane, axes=(named[0], named[1])))


def _next(blocks: Sequence[Block], index: int) -> int | None:
    """The index of the next block that says something."""
    for other in count(index + 1):  # the length of what is read ahead is not known without counting
        try:
            block = blocks[other]
        except IndexError:
            return None
        if _has_words(block):
            return other
    return None


def _has_words(block: Block) -> bool:
    return bool(block.faults or block.macro) or any(word.address not in ("N", "O") for word in block.words)


def _is_motion(block: Block, state: State, modes: Modes) -> bool:
    """Whether the block's axis words are the end of a motion with G0 to G3."""
    codes = codes_of(block, modes)
    if block.macro or any(isinstance(code, Word) or code.effect in _OWN_USE for code in codes):
        return False
    here = apply_modes(state, block, modes)
    return here.motion in (0, 1, 2, 3) and _moves(block, here)


def _stated(block: Block) -> set[str]:
    """The addresses of a block; a word that cannot be read still shows what the block was meant to be."""
    return {word.address for word in block.words} | {fault.address for fault in block.faults}


def _moves(block: Block, here: State) -> bool:
    """Whether a block is a motion: it has a coordinate, an angle, a corner; an arc a centre, R, or just its G code.
    A Q that belongs to nothing is looked at, too."""
    moving = {*AXES, ",A", CHAMFER, ROUNDING}
    if here.motion in _TURNS:
        moving |= {"I", "J", "K", "R"}
    if not block.find("M"):
        moving |= {"Q"}
    return bool(_stated(block) & moving) or any(word.address == "G" and word.number in _TURNS for word in block.words)


def _over_defining(here: State) -> set[str]:
    """What over-defines a block: both coordinates of the plane and ,A of a line; end, centre and R of a circle (16.3).
    Q does not: it only chooses."""
    if here.motion in _TURNS:
        return {*here.plane.axes, *here.plane.centers, "R"}
    return {*here.plane.axes, ",A"}


def _is_over_defined(block: Block, here: State) -> bool:
    return _stated(block) >= _over_defining(here)


def _is_meant_over_defined(block: Block, here: State) -> bool:
    """Whether it is, or has a Q and lacks one word only."""
    missing = _over_defining(here) - _stated(block)
    return len(missing) <= ("Q" in _stated(block))


def _has_corner(block: Block) -> bool:
    return bool(_stated(block) & {CHAMFER, ROUNDING})


def _is_tied_alone(block: Block, here: State, modes: Modes) -> bool:
    """Whether a block is calculated although nothing follows that belongs to it: a line by its angle (16.2), one with
    a corner, and an arc with an end, which is checked if its values are known; about its centre, it is a full circle
    if that is where it begins (assumed)."""
    stated = _stated(block)
    if _has_corner(block) or stated & {",A", "Q"}:
        return True
    is_variable = any(word.number is None and not word.is_asked for word in block.words)
    if here.motion not in _TURNS or not stated & {*here.plane.axes, "R"} or is_variable:
        return False
    return "R" in stated or not stated & {*here.plane.centers} or not _ends_where_it_begins(block, here, modes)


def _ends_where_it_begins(block: Block, here: State, modes: Modes) -> bool:
    ends = {word.address: word for word in block.words if word.address in here.plane.axes}
    return all(
        word.number is not None
        and modes.lexicon.value(word, here.unit) == (0 if here.is_incremental else here.axes[axis].value)
        for axis, word in ends.items()
    )


def _is_stated(last: Member, following: Block, here: State) -> bool:
    """Whether further facts join two blocks in an intersection, for contoursolve alone: an arc and a line, or a line
    whose end is not programmed and what follows it."""
    is_extended = any(word.is_asked for word in _words(last.block, following))
    if not (is_extended or last.block.directives or following.directives):
        return False
    if last.element.turn is not None:
        return here.motion in (0, 1) and bool(_stated(following) & {*here.plane.axes, ",A"})
    own = _stated(last.block)
    return ",A" in own and not own & {*here.plane.axes}


def _words(*blocks: Block) -> Iterator[Word]:
    return (word for block in blocks for word in block.words)
