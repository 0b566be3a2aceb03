"""What lies behind a contour: where it leaves the tool, and where the line of the next block ends."""

from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal

from contoursolve.reading.advance import Modes, apply_modes, positions
from contoursolve.reading.claim import Claim
from contoursolve.reading.state import Position, State
from contoursolve.source import Span
from contoursolve.syntax import Block, Word


def leave(
    claim: Claim, end: tuple[float, float] | None, modes: Modes, reason: str = "", cause: Span | None = None
) -> State:
    """The modes of a contour's blocks, and the position where it ends, mm.

    Where it has no end, for this reason, whose `cause` may lie in a line before it, an axis that its last block
    programs is still known.
    """
    state, last, axes = claim.left, claim.blocks[-1], claim.after.plane.axes
    if end is not None:
        before = claim.before.axes
        is_skippable = any(block.is_skippable for block in claim.blocks) or any(
            before[axis].is_skippable for axis in axes
        )
        ends = zip(axes, end, strict=True)
        state = state.move({axis: end_of_contour(value, last.span, is_skippable=is_skippable) for axis, value in ends})
        return _move_beside(state, claim, modes)
    lost = state.lose(axes, reason, cause or last.span)
    if last.faults:
        return lost
    # Increments count from where the last block begins, which is known of an only one.
    origin = state if len(claim.blocks) == 1 else lost
    told = replace(origin, is_incremental=state.is_incremental and not claim.is_end_absolute)
    return lost.move(positions(told, _axis_words(last, modes), modes, last.is_skippable))


def _move_beside(state: State, claim: Claim, modes: Modes) -> State:
    """The state with the axes outside the plane where the words of a contour's blocks lead."""
    here = claim.before
    for block in claim.blocks:
        words = claim.beside_plane(block)
        here = apply_modes(here.move(state.axes), block, modes)
        state = state.move(positions(here, words, modes, block.is_skippable)) if words else state
    return state


def end_of_contour(value: float, span: Span, *, is_skippable: bool = False) -> Position:
    """Where a contour ends on an axis, mm; `span` is its last block."""
    return Position(Decimal(value), "the end of this contour", span, is_skippable)


def next_place(blocks: Sequence[Block], claim: Claim, modes: Modes) -> tuple[Decimal, Decimal] | None:
    """Where the next block with words ends, mm, if it is a line and both its coordinates are known."""
    block = next((block for block in blocks if block.words), None)
    if block is None or block.faults:
        return None
    state = apply_modes(claim.left, block, modes)
    if state.motion not in (0, 1, None):
        return None
    unknown = state.lose(modes.axes, "the contour before it is not solved yet", block.span)
    found = positions(unknown, _axis_words(block, modes), modes, is_skippable=False)
    first, second = (found[axis].value if axis in found else None for axis in state.plane.axes)
    return None if first is None or second is None else (first, second)


def _axis_words(block: Block, modes: Modes) -> list[Word]:
    addresses = modes.lexicon.addresses
    return [word for word in block.words if word.address in addresses and addresses[word.address].axis]
