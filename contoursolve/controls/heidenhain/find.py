"""The finder of chains of blocks that are solved together."""

from collections.abc import Sequence
from dataclasses import replace as replace_fields
from itertools import count

from msgspec import structs

from contoursolve.controls.heidenhain.chain_blocks import (
    OF_CORNERS,
    ChainBlocks,
    is_in_plane,
    leads_elsewhere,
    stands_between,
)
from contoursolve.controls.heidenhain.circumstances import APART, FIRST_CORNER, LAST_CORNER
from contoursolve.controls.heidenhain.claim import claim_of
from contoursolve.controls.heidenhain.follow import (
    DEPARTED,
    JOINT,
    POLE,
    begins_chain,
    is_of_machine,
)
from contoursolve.controls.heidenhain.lexicon import (
    FREE,
    IN_KLARTEXT,
    MOVES,
    TANGENT,
    PlaneWords,
    function_of,
)
from contoursolve.gcode import Block
from contoursolve.reading import Modes, ParsedContour, State


def _follows_elsewhere(block: Block, state: State) -> bool:
    """Whether a corner that follows no element may join an approach, or one that another call has run."""
    lost = (
        each for each in (state.axes[axis] for axis in state.plane.axes) if each.value is None and each.span is not None
    )
    return bool(block.callers) or JOINT in state.memory or any(each.reason != DEPARTED for each in lost)


def find(
    blocks: Sequence[Block], index: int, state: State, modes: Modes, words: PlaneWords = IN_KLARTEXT
) -> ParsedContour | None:
    """The chain that begins at a block, if any: with a free element, a move with a corner, one that the next element
    touches, or a corner behind no element."""
    block = blocks[index]
    if block.macro is not None or not block.words:
        return None
    function, is_known = function_of(block), state.start().is_known
    if function in FREE:
        # A chain may begin with where it begins.
        is_begun = is_known or not begins_chain(function, block, words.axes)
    elif function in MOVES:
        # What touches a move from an unknown place to a coordinate cannot be found.
        is_step = any(map(block.find, words.increments)) and not any(map(block.find, words.axes))
        joins = (*OF_CORNERS, *TANGENT) if is_known or is_step else tuple(OF_CORNERS)
        is_begun = is_in_plane(block) and not is_of_machine(block) and _next_function(blocks, index) in joins
    elif function == POLE:
        # A pole is read where it stands; one with a coordinate missing is none for the chain behind it.
        is_begun = any(block.find(axis) is None for axis in words.axes)
    else:
        is_begun = function in OF_CORNERS
    if not is_begun:
        return None
    if words.slack != modes.radius_difference:
        words = structs.replace(words, slack=modes.radius_difference)
    chain = ChainBlocks(state, modes, words)
    if function != POLE or _next_function(blocks, index) in MOVES:
        chain.read(blocks, index)
    if not chain.is_contour and function == POLE:
        chain = ChainBlocks(state, modes, words)
        chain.read_pole(block)
        return _without_path(claim_of(chain, state, modes))
    if not chain.is_contour:
        return None
    claim = claim_of(chain, state, modes)
    if function in OF_CORNERS and (_follows_elsewhere(block, state) or leads_elsewhere(blocks, index)):
        circumstances = claim.circumstances - {f"1:{FIRST_CORNER}", f"1:{LAST_CORNER}"} | {f"1:{APART}"}
        return replace_fields(_without_path(claim), circumstances=circumstances)
    return claim


def _without_path(claim: ParsedContour) -> ParsedContour:
    """The same as something that is read as a contour is, and is none: it has no path, and needs no values."""
    outline = replace_fields(claim.form.outline, path=())
    form = replace_fields(claim.form, outline=outline, is_contour=False, needs_values=False)
    return replace_fields(claim, form=form)


def _next_function(blocks: Sequence[Block], index: int) -> str:
    """The function of the next element or corner behind a block; empty if something else comes first."""
    for place in count(index + 1):
        try:
            block = blocks[place]
        except IndexError:
            return ""
        function = function_of(block)
        says_something = block.words or block.faults or block.macro is not None
        if says_something and not stands_between(block, function):
            return function if block.macro is None else ""
    return ""
