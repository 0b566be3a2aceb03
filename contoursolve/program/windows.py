"""The blocks around something that is wrong, for trying what was meant."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from contoursolve.gcode import Block
from contoursolve.program.solve_queue import Previous
from contoursolve.reading import Dialect, State

if TYPE_CHECKING:
    from contoursolve.diagnosis import Window, WindowPart

Parts = Callable[[Sequence[Block], State, tuple[Previous, ...]], "Iterable[WindowPart]"]
"""Examines blocks from a state on; the last is ahead of them."""

AHEAD, MOST_AHEAD = 8, 12
"""Contours and blocks ahead of one that are kept, and the blocks of them in which slips are looked for."""


def further(ahead: tuple[Previous, ...], blocks: Sequence[Block], state: State) -> tuple[Previous, ...]:
    """The last contours and blocks, with one more."""
    return (*ahead[1 - AHEAD :], (blocks, state))


def window_of(
    ahead: Sequence[Previous],
    own: Sequence[Block],
    behind: Sequence[Block],
    state: State,
    dialect: Dialect,
    parts: Parts,
) -> "Window":
    """Blocks in a state, with what is ahead of them, as far as it is near, and some blocks behind."""
    from contoursolve.diagnosis import Window  # noqa: PLC0415 - most programs need no diagnosis

    return Window(tuple(near(ahead))[::-1], tuple(own), tuple(behind), state, dialect, parts)


def near(ahead: Sequence[Previous]) -> Iterator[Previous]:
    """Those that are near, the last one first."""
    count = 0
    for each in reversed(ahead):
        count += len(each[0])
        if count > MOST_AHEAD:
            return
        yield each
