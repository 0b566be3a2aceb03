"""The lines of a text that is being edited, read into blocks where somebody looks at them."""

from collections.abc import Iterator, Mapping, Sequence
from difflib import SequenceMatcher
from typing import overload

from msgspec import Struct

from contoursolve.gcode import ISO, Block, Syntax, parse_block, split_lines

Place = tuple[int, int]
"""A line and a column, both from 1."""

_MOST_BLOCKS = 20_000
"""Blocks that are kept; one takes 50 times the memory of its line."""


class Splice(Struct, frozen=True):
    """Lines that came in the place of others, from an index on; none of them is the same at either end."""

    first: int
    gone: Sequence[str]
    come: Sequence[str]


class OpenLines(Sequence[Block]):
    """The blocks of lines that change; after the end of the last line is one more."""

    def __init__(self, text: str) -> None:
        self.texts, self.syntax = _split(text), ISO
        self._read: dict[int, Block] = {}

    def __len__(self) -> int:
        return len(self.texts)

    @overload
    def __getitem__(self, index: int) -> Block: ...

    @overload
    def __getitem__(self, index: slice) -> list[Block]: ...

    def __getitem__(self, index: int | slice) -> Block | list[Block]:
        if isinstance(index, slice):
            return [self[each] for each in range(len(self))[index]]
        if not 0 <= index < len(self):
            raise IndexError(index)
        block = self._read.get(index)
        if block is None:
            if len(self._read) >= _MOST_BLOCKS:
                self._read = {}
            block = self._read[index] = parse_block(self.texts[index].rstrip("\r\n"), index + 1, self.syntax)
        return block

    def between(self, first: int, last: int) -> Iterator[Block]:
        """Those from an index on to before another one, each read when it is asked for."""
        return map(self.__getitem__, range(first, min(last, len(self))))

    def spell(self, syntax: Syntax) -> None:
        """Read them in this syntax from now on."""
        if self.syntax is not syntax:
            self.syntax, self._read = syntax, {}

    @property
    def text(self) -> str:
        """All of them as one text."""
        return "".join(self.texts)

    @property
    def line_end(self) -> str:
        """The end of the first line; a line feed if that line has no end."""
        first = self.texts[0]
        return first[len(first.rstrip("\r\n")) :] or "\n"

    def line(self, number: int) -> str:
        """The text of a line, without its end; empty where there is none."""
        return self.texts[number - 1].rstrip("\r\n") if 0 < number <= len(self.texts) else ""

    def replace(self, text: str) -> Splice | None:
        """Put another text in the place of the whole; what has changed, None where nothing has."""
        return self._change(0, len(self.texts), _split(text))

    def edit(self, begin: Place, end: Place, text: str) -> Splice | None:
        """Put a text in the place of what stands from one place to another, the second one not included; what has
        changed, None where nothing has. A place after the end of a line, or of the text, is that end."""
        lines = self.texts
        (first, start), (last, stop) = (self._within(place) for place in sorted((begin, end)))
        new, behind = lines[first][:start] + text + lines[last][stop:], last + 1
        # A carriage return and the line feed after it are one end of a line.
        if first and lines[first - 1].endswith("\r") and new.startswith("\n"):
            first -= 1
            new = lines[first] + new
        return self._change(first, behind, _split(new)[: None if behind == len(lines) else -1])

    def changes_to(self, text: str) -> Iterator[tuple[Place, Place, str]]:
        """The edits by whole lines, each as `edit` takes it, that make another text of this one; places are those
        before any of them."""
        old, new = self.texts, _split(text)
        for tag, first, last, begin, end in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
            if tag != "equal":
                yield self._begin_of(first), self._begin_of(last), "".join(new[begin:end])

    def edits_of(self, changes: Mapping[int, str | None]) -> Iterator[tuple[Place, Place, str]]:
        """The edits, each as `edit` takes it, that write other texts for lines, with a line feed between several, or
        take lines out (None): each from the first character that differs to the last one. Places are those before."""
        for line, text in changes.items():
            if text is None:
                yield (line, 1), (line + 1, 1), ""
                continue
            old, new = self.line(line), text.replace("\n", self.line_end)
            same, tail = _alike_at_ends(old, new)
            if old != new:
                yield (line, same + 1), (line, len(old) - tail + 1), new[same : len(new) - tail]

    def _begin_of(self, index: int) -> Place:
        """The place where a line begins; after the last one, where that ends."""
        return (index + 1, 1) if index < len(self.texts) else (index, len(self.texts[-1]) + 1)

    def _within(self, place: Place) -> tuple[int, int]:
        """The index of a line, and an offset in it."""
        lines, (line, column) = self.texts, place
        if line > len(lines):
            return len(lines) - 1, len(lines[-1])
        return max(line, 1) - 1, min(max(column, 1) - 1, len(lines[max(line, 1) - 1].rstrip("\r\n")))

    def _change(self, first: int, last: int, new: Sequence[str]) -> Splice | None:
        """Put other lines in the place of some. Lines that are the same at the beginning and the end are not touched:
        an edit may begin or end in one."""
        head, tail = _alike_at_ends(self.texts[first:last], new)
        first, last, new = first + head, last - tail, new[head : len(new) - tail]
        gone = self.texts[first:last]
        if not (gone or new):
            return None
        self.texts[first:last] = new
        is_moved = len(new) != len(gone)
        for index in [each for each in self._read if each >= first] if is_moved else range(first, last):
            self._read.pop(index, None)
        return Splice(first, gone, new)


def _alike_at_ends(old: Sequence[str], new: Sequence[str]) -> tuple[int, int]:
    """Numbers of items that are the same at the beginning of both, and at the end of what is left."""
    most = min(len(old), len(new))
    head = next((at for at in range(most) if old[at] != new[at]), most)
    most -= head
    return head, next((at for at in range(most) if old[-1 - at] != new[-1 - at]), most)


def _split(text: str) -> list[str]:
    """The lines of a text, each with its end; the last one has none."""
    lines = split_lines(text)
    return [*lines, ""] if not lines or lines[-1].endswith(("\r", "\n")) else lines
