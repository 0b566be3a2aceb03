"""The blocks around something that is wrong, for trying what was meant."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import islice
from typing import TYPE_CHECKING

from contoursolve.gcode import Block, Passage, blocks_in, words_of
from contoursolve.program.solve_queue import Ahead, Previous
from contoursolve.reading import Dialect, Modes, State, advance, advance_plainly

if TYPE_CHECKING:
    from contoursolve.diagnosis import Window, WindowPart

Parts = Callable[[Sequence[Block], State, Ahead], "Iterable[WindowPart]"]
"""Examines blocks from a state on; the last is ahead of them."""

AHEAD, MOST_AHEAD = 8, 12
"""Contours and blocks ahead of one that are kept, and the blocks of them in which slips are looked for."""


def further(ahead: Ahead, blocks: Sequence[Block] | Passage, state: State) -> Ahead:
    """The last contours, blocks and passages that say something, with one more."""
    if isinstance(blocks, Passage) and not words_of(blocks.text):
        return ahead
    return (*ahead[1 - AHEAD :], (blocks, state))


def last_of(ahead: Ahead, modes: Modes) -> Previous | None:
    """The last contour or block that says something, and the state before it."""
    if ahead and not isinstance(ahead[-1][0], Passage):
        return ahead[-1]  # type: ignore[return-value]
    return next(iter(_read(ahead[-1:], modes)[-1:]), None)


def _read(ahead: Ahead, modes: Modes) -> list[Previous]:
    """The last contours and blocks, plain lines read into words."""
    found = list[Previous]()
    for blocks, before in ahead:
        if not isinstance(blocks, Passage):
            found.append((blocks, before))
            continue
        saying = [place for place, line in enumerate(blocks.lines) if words_of(line)][-AHEAD:]
        first, state = saying[0], before
        if first:
            state = advance_plainly(state, blocks.part(0, first), modes)
        for block in blocks_in(blocks.part(first, blocks.count)):
            if block.words:
                found.append(((block,), state))
                state = advance(state, block, modes)
    return found[-AHEAD:]


def window_of(
    ahead: Ahead,
    own: Sequence[Block],
    behind: Sequence[Block],
    state: State,
    dialect: Dialect,
    parts: Parts,
) -> "Window":
    """Blocks in a state, with what is ahead of them, as far as it is near, and some blocks behind."""
    from contoursolve.diagnosis import Window  # noqa: PLC0415 - most programs need no diagnosis

    held, count = _read(ahead, dialect.modes), sum(1 for _ in near(ahead))
    return Window(tuple(held[len(held) - count :]), tuple(own), tuple(behind), state, dialect, parts)


def near(ahead: Ahead) -> Iterator[Sequence[Block]]:
    """The contours and blocks ahead that are near, the last one first."""
    count = 0
    for blocks in islice((one for each, _ in reversed(ahead) for one in _backwards(each)), AHEAD):
        count += len(blocks)
        if count > MOST_AHEAD:
            return
        yield blocks


def _backwards(blocks: Sequence[Block] | Passage) -> Iterator[Sequence[Block]]:
    """A contour or a block; or plain lines that say something, read into words, the last one first."""
    if not isinstance(blocks, Passage):
        yield blocks
        return
    for place in range(blocks.count - 1, -1, -1):
        if words_of(blocks.lines[place]):
            yield tuple(blocks_in(blocks.part(place, place + 1)))
