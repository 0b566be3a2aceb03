"""Follows a program from contour to contour as the control does; after each, the claimed end is the position."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import Decimal

from contoursolve.dialects import Dialect, Unresolved
from contoursolve.model import Length
from contoursolve.reading import Claim, Position, State, advance, positions
from contoursolve.syntax import Program
from contoursolve.verification.claimed import ClaimedContour
from contoursolve.verification.measure import PRINTED


@dataclass(frozen=True, slots=True)
class Found:
    """A contour block of the program and what the result claims of it, if anything.

    `start_error` (mm) is how far the position may be from the one that the result was made with: the result
    tells the ends of earlier contours with 12 decimals.
    """

    claim: Claim
    claimed: ClaimedContour | None
    start_error: float


def follow(
    program: Program, dialect: Dialect, unit: Length, claims: Mapping[int, ClaimedContour]
) -> Iterator[Found | Unresolved]:
    """Every contour block of a program, in order; `claims` are those of the result by their line."""
    blocks, state, start_error = program.blocks, dialect.initial_state(unit), 0.0
    index = 0
    while index < len(blocks):
        found = dialect.find(blocks, index, state, dialect.modes)
        if isinstance(found, Claim):
            claimed = claims.get(blocks[index].line)
            yield Found(found, claimed, start_error)
            state = _state_after(found, claimed, dialect)
            if claimed and claimed.end is not None:
                start_error = PRINTED
            index += found.blocks[-1].line - blocks[index].line
        else:
            state = advance(state, blocks[index], dialect.modes)
            if found:
                yield found
                state = state.lose(state.plane.axes, f"{found.form} is not resolved", found.word.span)
        index += 1


def _state_after(claim: Claim, claimed: ClaimedContour | None, dialect: Dialect) -> State:
    """The modes of the contour's blocks, and where it is claimed to end.

    Without a claimed path, an axis that the last block programs is still known.
    """
    state, last = claim.after, claim.blocks[-1]
    if claimed and claimed.has_path and claimed.end is not None:
        ends = zip(state.plane.axes, claimed.end, strict=True)
        return state.move({axis: Position(Decimal(value), "the claimed end", last.span) for axis, value in ends})
    addresses = dialect.modes.lexicon.addresses
    words = [word for word in last.words if word.address in addresses and addresses[word.address].axis]
    programmed = positions(replace(state, is_incremental=False), words, dialect.modes, last.is_skippable)
    lost = state.lose(state.plane.axes, "the contour before has no path", last.span)
    return lost if last.faults else lost.move(programmed)
