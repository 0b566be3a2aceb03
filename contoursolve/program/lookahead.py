"""The lines of a program that are read ahead: blocks, and what nobody needs to read into words yet."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice, takewhile
from typing import overload

from contoursolve.gcode import ISO, Block, Passage, blocks_in, words_of

Line = Block | Passage
"""A line of a program, or several, read as far as it was needed."""


_FIRST, _BATCH = 16, 1_000
"""Lines that are read at once: in the beginning, when nothing is known, and later."""

_PIECE = 64
"""Lines at the begin of a passage that are cut off with the one that was passed, for further ones may follow."""


class Lookahead:
    """The lines of a program that are read and not passed yet; lines that are not a sequence are read as they are
    needed."""

    def __init__(self, lines: Iterable[Line]) -> None:
        self.is_whole = isinstance(lines, Sequence)
        """Whether all lines are read."""
        self._held: list[Line] = list(lines) if self.is_whole else []
        self._rest = iter(() if self.is_whole else lines)
        self._index, self._size = 0, _FIRST

    @property
    def line(self) -> Line | None:
        """The next line; None at the end."""
        while self._index >= len(self._held) - 1 and not self.is_whole:
            self.read_on()
        return self._held[self._index] if self._index < len(self._held) else None

    def view(self) -> "View":
        """The blocks from the next line on."""
        return View(self._held, self._index)

    def plain(self, *, moves: bool, joins: bool) -> Passage | None:
        """The plain lines in a row from the next one on that need not be read into words: up to the last one that moves
        if the next contour may begin with it (`joins`); if lines that move need be (not `moves`), up to the first."""
        first = self._held[self._index]
        if not isinstance(first, Passage):
            return None
        says = first.syntax.plain.begins if moves else ISO.plain.begins
        order = range(first.count) if not moves else range(first.count - 1, -1, -1) if joins else ()
        if moves and joins:
            behind = takewhile(lambda each: isinstance(each, Passage), islice(self._held, self._index + 1, None))
            if any(isinstance(each, Passage) and says.search(words_of(each.text, each.syntax)) for each in behind):
                return first
        stop = next((at for at in order if says.search(words_of(first.lines[at], first.syntax))), first.count)
        return None if not stop else first if stop == first.count else first.part(0, stop)

    def read_on(self) -> None:
        """Read further lines: at least as many as are held, so that long contours are not looked at again and again."""
        wanted, more = max(self._size, sum(map(_count, self._held[self._index :]))), list[Line]()
        for each in self._rest:
            more.append(each)
            wanted -= _count(each)
            if wanted <= 0:
                break
        self._held, self._index = [*self._held[self._index :], *more], 0
        self._size, self.is_whole = min(2 * self._size, _BATCH), not more

    def go_on(self, count: int) -> None:
        """Pass so many lines."""
        self._held, self._index = _behind(self._held, self._index, count)


class View(Sequence[Block]):
    """The blocks from a place on; plain lines are read into words when somebody looks at them. `reach` is how many were
    looked at; one that is not there counts, too. If they `end_at_call`, others run behind the last one, at which
    nobody looks."""

    def __init__(self, held: Sequence[Line], index: int, *, end_at_call: bool = False) -> None:
        self.held, self.first, self.reach, self.end_at_call = held, index, 0, end_at_call
        self.blocks: list[Block] = []
        self.rest = each_block(held, index)

    def __len__(self) -> int:
        return sum(map(_count, _from(self.held, self.first)))

    @overload
    def __getitem__(self, index: int) -> Block: ...

    @overload
    def __getitem__(self, index: slice) -> list[Block]: ...

    def __getitem__(self, index: int | slice) -> Block | list[Block]:
        last = (len(self) if index.stop is None else index.stop) if isinstance(index, slice) else index + 1
        self.reach = max(self.reach, last)
        if last > len(self.blocks):
            self.blocks += islice(self.rest, last - len(self.blocks))
        return self.blocks[index]

    def holds(self, count: int) -> bool:
        """Whether there are at least so many lines."""
        # Each is a line or more.
        return len(self.held) - self.first >= count or len(self) >= count

    def telling(self, first: int, count: int) -> Iterator[Block]:
        """Of so many lines from an index on the blocks, without plain lines that nobody has read into words."""
        self.reach, number = max(self.reach, first + count), 0
        for each in _from(self.held, self.first):
            if number >= first + count:
                return
            if number >= first and not isinstance(each, Passage):
                yield each
            number += _count(each)

    def says_something(self, first: int) -> bool:
        """Whether any block from an index on has more than its number."""
        place, number = self.first, 0
        while place < len(self.held):
            each = self.held[place]
            lines, at = each.lines if isinstance(each, Passage) else (each,), max(0, first - number)
            if any(words_of(one, each.syntax) if isinstance(one, str) else one.says_something for one in lines[at:]):
                return True
            place, number = place + 1, number + len(lines)
        return False


def each_block(held: Sequence[Line], index: int) -> Iterator[Block]:
    """The blocks from an index on."""
    for each in _from(held, index):
        if isinstance(each, Passage):
            yield from blocks_in(each)
        else:
            yield each


def _from(held: Sequence[Line], index: int) -> Iterator[Line]:
    return (held[at] for at in range(index, len(held)))


def _count(each: Line) -> int:
    """The number of lines."""
    return each.count if isinstance(each, Passage) else 1


def _behind(held: list[Line], index: int, count: int) -> tuple[list[Line], int]:
    """The lines that are held, and the index behind so many of them; a passage that goes on there is cut."""
    while count:
        each = held[index]
        if isinstance(each, Passage) and each.count > count:
            # Whoever looks at the old list later finds it as it was.
            piece = min(count + _PIECE, each.count)
            parts = (each.part(count, piece), each.part(piece, each.count))
            return [*(part for part in parts if part.count), *held[index + 1 :]], 0
        count -= _count(each)
        index += 1
    return held, index
