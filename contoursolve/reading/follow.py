"""Following a program through its contours, one after the other, and a contour through its blocks."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from decimal import Decimal
from operator import lt

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.execution import Machine
from contoursolve.gcode import Block, Directive, Program, Word
from contoursolve.reading.control_flow import Ahead, TakenBlocks, Ways
from contoursolve.reading.lexicon import Effect
from contoursolve.reading.modal_state import WAITS, Modes, State, advance, apply_modes, codes_of
from contoursolve.reading.parsed_contour import ParsedContour, leave, next_place

Finder = Callable[[Sequence[Block], int, State, Modes], ParsedContour | None]
"""(blocks, index, state before the block, modes) to the contour that begins at this block, if any."""

End = tuple[float, float] | None
"""The end of a contour, mm, if that is known."""


def contours_of(
    blocks: Sequence[Block],
    find: Finder,
    modes: Modes,
    state: State,
    start: Program | None = None,
    end_of: Callable[[ParsedContour], End] = lambda _: None,
) -> Iterator[tuple[ParsedContour, int]]:
    """Every contour of a program, with the index of the block behind it; the next one begins where `end_of` says.

    `start` are blocks that state the start point apart from the program.
    """
    for block in start.blocks if start else ():
        state = advance(state, block, modes)
    index = 0
    while index < len(blocks):
        found = find(blocks, index, state, modes)
        if found is not None and found.form.is_contour:
            index += reach_of(found, blocks, index)
            yield found, index
            state = leave(found, end_of(found), modes, f"{WAITS} one that has no path")
        else:
            state = advance(state, blocks[index], modes)
            index += 1


def contours_as_run(
    blocks: Sequence[Block],
    machine: Machine | None,
    find: Finder,
    modes: Modes,
    first: State,
    end_of: Callable[[ParsedContour], End],
) -> list[tuple[ParsedContour, tuple[Decimal, Decimal] | None]]:
    """Every contour of a main program on each of its ways, each time that it runs, with where the line of the next
    block ends, mm, if that is known; the next one begins where `end_of` says. `machine` runs what is not a row of
    blocks."""
    reached = set[int]()

    def take(held: Sequence[Block], index: int, state: State, is_open: bool) -> TakenBlocks | None:
        ahead, block = Ahead(held), held[index]
        is_reached = all(each.is_reached for each in block.callers)
        if is_reached and not block.file:
            reached.add(block.line)
        found = find(ahead, index, state, modes)
        if is_open and ahead.is_passed:
            return None
        if found is None or not found.form.is_contour:
            return TakenBlocks(1, advance(state, block, modes))
        reach = reach_of(found, held, index)
        is_own = not block.file and (is_reached or block.line not in reached)
        met = (found, next_place(held[index + reach :], found, modes)) if is_own else None
        return TakenBlocks(reach, leave(found, end_of(found), modes, f"{WAITS} one that has no path"), met)

    ways = Ways(lambda: first, modes, take)
    if machine is None:
        return [each for each in ways.read(ways.begin(None), blocks, None) if each is not None]
    deque(machine.follow(machine.run(), ways), 0)
    return [each for each in machine.found if each is not None]


def reach_of(contour: ParsedContour, blocks: Sequence[Block], index: int = 0) -> int:
    """The number of blocks from an index on up to the last one of a contour that begins there."""
    lines = [each.line for each in contour.blocks]
    last, count = lines[-1], lines[-1] - lines[0] + 1
    if (
        all(map(lt, lines, lines[1:]))
        and blocks[index + count - 1 : index + count]
        and blocks[index + count - 1].line == last
    ):
        return count
    # Jumps have left lines out, or lines run again.
    place = index - 1
    for own in contour.blocks:
        place += 1
        while blocks[place].line != own.line:
            place += 1
    return place - index + 1


def state_facts(program: Program, contour: Sequence[Block], facts: Sequence[Directive]) -> Program:
    """The program with further facts in the last block of its only contour, or else in its last block with words: there
    they may make a contour."""
    last = max((block.line for block in contour or [block for block in program.blocks if block.words]), default=0)
    blocks = tuple(
        replace(block, directives=(*block.directives, *facts)) if block.line == last else block
        for block in program.blocks
    )
    return replace(program, blocks=blocks)


class ContourBlock(Struct, frozen=True):
    """One block of a contour: the state in which its words are read, whether it moves in rapid, and the names of the
    elements and corners that it makes, None for all of them. A contour has one block, or one for each element."""

    block: Block
    state: State
    is_rapid: bool
    names: frozenset[str] | None

    def makes(self, element: str) -> bool:
        """Whether it makes the element of this name."""
        return self.names is None or element in self.names


def blocks_of(claim: ParsedContour, before: State, modes: Modes) -> Iterator[ContourBlock]:
    """The blocks of a contour that begins in a state."""
    corners = dict[str, list[str]]()
    for row in () if claim.makes else claim.form.outline.corners:
        corners.setdefault(row.before, []).append(row.name)
    for number, block in enumerate(claim.blocks):
        before, names = apply_modes(before, block, modes), None
        if claim.makes:
            names = frozenset(claim.makes[number])
        elif len(claim.blocks) > 1:
            own = claim.form.outline.path[number].name
            names = frozenset([own, *corners.get(own, ())])
        codes = codes_of(block, modes)
        # A code of the block itself may make it a contour, so that the motion in force has no part in it.
        is_own = any(not isinstance(code, Word) and code.effect is Effect.CONTOUR for code in codes)
        yield ContourBlock(block, before, before.motion == 0 and not is_own, names)
