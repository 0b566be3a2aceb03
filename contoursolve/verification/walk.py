"""Follows a program from contour to contour as the control does; after each, the claimed end is the position."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal

from contoursolve import syntax
from contoursolve.dialects import Dialect
from contoursolve.model import Length
from contoursolve.reading import Claim, Position, State, advance, apply_modes, positions
from contoursolve.syntax import Block, Directive, Program
from contoursolve.verification.claimed import ClaimedContour
from contoursolve.verification.measure import PRINTED


@dataclass(frozen=True, slots=True)
class Found:
    """A contour block of the program and what the result claims of it, if anything.

    `start_error` (mm) is how far the position may be from the one that the result was made with: the result
    tells the ends of earlier contours with 12 decimals. `next_end` is where the line of the next block ends, mm, if
    that is known.
    """

    claim: Claim
    claimed: ClaimedContour | None
    start_error: float
    dialect: Dialect
    next_end: tuple[Decimal, Decimal] | None


def follow(program: Program, dialect: Dialect, unit: Length, claims: Mapping[int, ClaimedContour]) -> Iterator[Found]:
    """Every contour block of a program, in order; `claims` are those of the result by their line.

    Facts that only the result states are taken as stated in the last block of their contour.
    """
    blocks, state, start_error = _with_facts(program.blocks, claims), dialect.initial_state(unit), 0.0
    index = 0
    while index < len(blocks):
        found = dialect.find(blocks, index, state, dialect.modes)
        if found is not None and found.form.is_contour:
            claimed = claims.get(blocks[index].line)
            after = index + found.blocks[-1].line - blocks[index].line
            yield Found(found, claimed, start_error, dialect, _next_end(blocks[after + 1 :], found, dialect))
            state = _state_after(found, claimed, dialect)
            if claimed and claimed.path.end is not None:
                start_error = PRINTED
            index = after
        else:
            state = advance(state, blocks[index], dialect.modes)
        index += 1


def _with_facts(blocks: tuple[Block, ...], claims: Mapping[int, ClaimedContour]) -> tuple[Block, ...]:
    """The blocks with the facts that only the result states, on lines below zero as they were given."""
    added: dict[int, tuple[Directive, ...]] = {}
    own = {block.line: [each.text for each in block.directives] for block in blocks}
    for claimed in claims.values():
        known = [text for line in claimed.lines for text in own.get(line, ())]
        rest: list[Directive] = []
        for text in claimed.facts or ():
            if text in known:
                known.remove(text)
            else:
                rest.append(syntax.read_directive(text, -len(rest) - 1))
        if rest and claimed.lines:
            added[claimed.lines[-1]] = tuple(rest)
    return tuple(
        replace(block, directives=(*block.directives, *added[block.line])) if block.line in added else block
        for block in blocks
    )


def _next_end(blocks: Sequence[Block], claim: Claim, dialect: Dialect) -> tuple[Decimal, Decimal] | None:
    """Where the next block with words ends, if it is a line and states both coordinates."""
    block = next((each for each in blocks if each.words), None)
    if block is None or block.faults:
        return None
    modes, state = dialect.modes, apply_modes(claim.after, block, dialect.modes)
    if state.motion not in (0, 1, None):
        return None
    state = state.lose(modes.axes, "the contour before it decides", block.span)
    addresses = modes.lexicon.addresses
    words = [word for word in block.words if word.address in addresses and addresses[word.address].axis]
    found = positions(state, words, modes, block.is_skippable)
    first, second = (found[axis].value if axis in found else None for axis in state.plane.axes)
    return None if first is None or second is None else (first, second)


def _state_after(claim: Claim, claimed: ClaimedContour | None, dialect: Dialect) -> State:
    """The modes of the contour's blocks, and where it is claimed to end.

    Without a claimed path, an axis that the last block programs is still known.
    """
    state, last = claim.after, claim.blocks[-1]
    if claimed and claimed.has_path and claimed.path.end is not None:
        ends = zip(state.plane.axes, claimed.path.end, strict=True)
        return state.move({axis: Position(Decimal(value), "the claimed end", last.span) for axis, value in ends})
    addresses = dialect.modes.lexicon.addresses
    words = [word for word in last.words if word.address in addresses and addresses[word.address].axis]
    programmed = positions(replace(state, is_incremental=False), words, dialect.modes, last.is_skippable)
    lost = state.lose(state.plane.axes, "the contour before has no path", last.span)
    return lost if last.faults else lost.move(programmed)
