"""The place of a block in a program: how many lines stand around it, also after the program has changed."""

from collections.abc import Mapping, Sequence

from msgspec import Struct

from contoursolve.gcode import split_lines


class BlockPlace(Struct, frozen=True):
    """The number of lines before a block of a program, and behind it."""

    before: int
    behind: int

    def has(self, line: int, count: int) -> bool:
        """Whether a line, of so many that the program has, is one of the block's."""
        return self.before < line <= count - self.behind

    def after_changes(self, changes: Mapping[int, str | None], count: int) -> "BlockPlace":
        """The place when lines, of so many that the program has, get other texts: of several lines, or none."""
        grown = {line: -1 if new is None else new.count("\n") for line, new in changes.items()}
        before = sum(by for line, by in grown.items() if line <= self.before)
        behind = sum(by for line, by in grown.items() if line > count - self.behind)
        return BlockPlace(self.before + before, self.behind + behind)

    def in_another(self, old: str, new: str) -> "BlockPlace":
        """The place in another text of the program. Where lines came in or went both in the block and beside it, all
        lines that differ belong to the block."""
        one, other = split_lines(old), split_lines(new)
        if len(one) == len(other):
            return self
        head = _common(one, other)
        most, growth = min(len(one), len(other)) - head, len(other) - len(one)
        tail = min(most, _common(one[::-1], other[::-1]))
        before, behind = self.before, self.behind
        if head < before:
            before = before + growth if tail >= len(one) - before else head
        if tail < behind:
            behind = behind + growth if head >= len(one) - behind else tail
        return BlockPlace(before, behind)


def _common(one: Sequence[str], other: Sequence[str]) -> int:
    """The number of lines with which both begin."""
    pairs = enumerate(zip(one, other, strict=False))
    return next((at for at, (left, right) in pairs if left != right), min(len(one), len(other)))
