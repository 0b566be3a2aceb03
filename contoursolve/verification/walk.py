"""Follows a program from contour to contour as the control does; after each, the claimed end is the position."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal

from contoursolve import syntax
from contoursolve.dialects import Dialect
from contoursolve.model import Length
from contoursolve.reading import Claim, advance, leave, next_place
from contoursolve.syntax import Block, Directive, Program
from contoursolve.verification.claimed import ClaimedContour, Rules
from contoursolve.verification.document import CannotVerifyError
from contoursolve.verification.measure import PRINTED


@dataclass(frozen=True, slots=True)
class Found:
    """A contour block of the program and what the result claims of it, if anything.

    `rules` is the policy under which the result says that it was made; None where it does not.
    `apart` is how many facts were stated apart from the program, on lines -1, -2 and so on.
    `start_error` (mm) is how far the position may be from the one that the result was made with: the result
    tells the ends of earlier contours with 12 decimals. `next_end` is where the line of the next block ends, mm, if
    that is known.
    """

    claim: Claim
    claimed: ClaimedContour | None
    start_error: float
    dialect: Dialect
    next_end: tuple[Decimal, Decimal] | None
    rules: Rules | None
    apart: int


def follow(
    program: Program,
    dialect: Dialect,
    unit: Length,
    claims: Mapping[int, ClaimedContour],
    rules: Rules | None = None,
    start: Program | None = None,
) -> Iterator[Found]:
    """Every contour block of a program, in order; `claims` are those of the result by their line.

    `start` are blocks that state the start point apart from the program. Facts that only the result states are taken
    as stated in the last block of their contour.
    """
    blocks, state, start_error = _with_facts(tuple(program.blocks), claims), dialect.initial_state(unit), 0.0
    for block in start.blocks if start else ():
        state = advance(state, block, dialect.modes)
    apart = sum(each.span.line < 0 for block in program.blocks for each in block.directives)
    index = 0
    while index < len(blocks):
        found = dialect.find(blocks, index, state, dialect.modes)
        if found is not None and found.form.is_contour:
            claimed = claims.get(blocks[index].line)
            after = index + found.blocks[-1].line - blocks[index].line
            yield Found(
                found,
                claimed,
                start_error,
                dialect,
                next_place(blocks[after + 1 :], found, dialect.modes),
                rules,
                apart,
            )
            end = claimed.path.end if claimed and claimed.has_path else None
            state = leave(found, end, dialect.modes, "the contour before has no path")
            if claimed and claimed.path.end is not None:
                start_error = PRINTED
            index = after
        else:
            state = advance(state, blocks[index], dialect.modes)
        index += 1


def with_facts(
    program: Program, dialect: Dialect, unit: Length, start: Program | None, facts: Sequence[str]
) -> Program:
    """The program with facts that were stated apart from it, in the last block of its only contour, or else its last
    block: there they may make a contour. Raises CannotVerifyError if there are several contours."""
    found = [each for each in follow(program, dialect, unit, {}, start=start) if isinstance(each, Found)]
    if len(found) > 1:
        lines = ", ".join(str(each.claim.blocks[0].line) for each in found)
        raise CannotVerifyError(f"a fact is about the only contour, and the program has {len(found)} (lines {lines})")
    directives = tuple(syntax.read_directive(text, -number) for number, text in enumerate(facts, 1))
    own = found[0].claim.blocks if found else [block for block in program.blocks if block.words]
    last = max((block.line for block in own), default=0)
    blocks = tuple(
        replace(block, directives=(*block.directives, *directives)) if block.line == last else block
        for block in program.blocks
    )
    return replace(program, blocks=blocks)


def _with_facts(blocks: tuple[Block, ...], claims: Mapping[int, ClaimedContour]) -> tuple[Block, ...]:
    """The blocks with the facts that only the result states, on lines below zero as they were given."""
    added: dict[int, tuple[Directive, ...]] = {}
    own = {block.line: [each.text for each in block.directives] for block in blocks}
    given = sum(each.span.line < 0 for block in blocks for each in block.directives)
    for claimed in claims.values():
        known = [text for line in claimed.lines for text in own.get(line, ())]
        rest: list[Directive] = []
        for text in claimed.facts or ():
            if text in known:
                known.remove(text)
            else:
                rest.append(syntax.read_directive(text, -given - len(rest) - 1))
        if rest and claimed.lines:
            added[claimed.lines[-1]] = tuple(rest)
    return tuple(
        replace(block, directives=(*block.directives, *added[block.line])) if block.line in added else block
        for block in blocks
    )
