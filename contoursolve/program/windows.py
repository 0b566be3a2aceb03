"""The blocks around something that is wrong, for trying what was meant."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import islice
from typing import TYPE_CHECKING

from contoursolve.gcode import Block, Passage, Syntax, parse_block, words_of
from contoursolve.program.solve_queue import Ahead, Previous
from contoursolve.reading import Control, Modes, State, advance, advance_plainly

if TYPE_CHECKING:
    from contoursolve.diagnosis import Window, WindowPart

Parts = Callable[[Sequence[Block], State, Ahead], "Iterable[WindowPart]"]
"""Examines blocks from a state on; the last is ahead of them."""

AHEAD, MOST_AHEAD = 8, 12
"""Contours and blocks ahead of one that are kept, and the blocks of them in which slips are looked for."""


def further(ahead: Ahead, blocks: Sequence[Block] | Passage, state: State) -> Ahead:
    """The last contours, blocks and passages that say something, with one more."""
    if isinstance(blocks, Passage) and not words_of(blocks.text, blocks.syntax):
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
    for blocks, before in reversed(ahead):
        if len(found) >= AHEAD:
            break
        found[:0] = [(blocks, before)] if not isinstance(blocks, Passage) else _in_words(blocks, before, modes)
    return found[-AHEAD:]


def _in_words(passage: Passage, state: State, modes: Modes) -> list[Previous]:
    """The last plain lines that say something, each as a block, with the state before it."""
    found = list[Previous]()
    saying = [place for place, line in enumerate(passage.lines) if words_of(line, passage.syntax)][-AHEAD:]
    state = advance_plainly(state, passage.part(0, saying[0]), modes) if saying[0] else state
    for place in saying:
        block = _block_of(passage.lines[place], passage.line + place, passage.syntax)
        found.append(((block,), state))
        state = advance(state, block, modes)
    return found


@lru_cache(64)
def _block_of(line: str, number: int, syntax: Syntax) -> Block:
    """A plain line, read into words: what is beside one contour is beside the next one, too."""
    return parse_block(line.rstrip("\r\n"), number, syntax)


def window_of(
    ahead: Ahead,
    own: Sequence[Block],
    behind: Sequence[Block],
    state: State,
    control: Control,
    parts: Parts,
    *,
    is_end: bool = False,
) -> "Window":
    """Blocks in a state, with what is ahead of them, as far as it is near, and some blocks behind; with `is_end`, all
    of these."""
    from contoursolve.diagnosis import Window  # noqa: PLC0415 - most programs need no diagnosis

    held, count = _read(ahead, control.modes), sum(1 for _ in near(ahead))
    return Window(tuple(held[len(held) - count :]), tuple(own), tuple(behind), state, control, parts, is_end)


def near(ahead: Ahead, *, has_plain: bool = True) -> Iterator[Sequence[Block]]:
    """The contours and blocks ahead that are near, the last one first; without `has_plain`, nothing in place of each
    plain line: those have no corner and no angle."""
    count = 0
    for blocks in islice((one for each, _ in reversed(ahead) for one in _backwards(each, has_plain)), AHEAD):
        count += len(blocks) or 1
        if count > MOST_AHEAD:
            return
        yield blocks


def _backwards(blocks: Sequence[Block] | Passage, has_plain: bool) -> Iterator[Sequence[Block]]:
    """A contour or a block; or plain lines that say something, read into words, the last one first."""
    if not isinstance(blocks, Passage):
        yield blocks
        return
    for place in range(blocks.count - 1, -1, -1):
        if words_of(blocks.lines[place], blocks.syntax):
            yield (_block_of(blocks.lines[place], blocks.line + place, blocks.syntax),) if has_plain else ()
