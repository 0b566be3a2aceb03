"""Lines that do nothing but move, or nothing at all: most lines of most programs. One pattern finds many at once, and
nobody needs to read them into words."""

import re
from functools import cached_property

from msgspec import Struct

from contoursolve.gcode.syntax import ISO, Syntax


class Passage(Struct, frozen=True, dict=True):
    """Plain lines in a row that nobody has read into words yet: the number of the first one, all of them with their
    ends, and how many there are."""

    line: int
    text: str
    count: int
    syntax: Syntax = ISO

    @cached_property
    def lines(self) -> tuple[str, ...]:
        """The lines, each with its end."""
        return tuple(split_lines(self.text))

    def part(self, first: int, end: int) -> "Passage":
        """The lines from an index to another one."""
        lines = self.lines[first:end]
        return Passage(self.line + first, "".join(lines), len(lines), self.syntax)


_LINE = re.compile(r"[^\r\n]*(?:\r\n|\n|\r)|[^\r\n]+")


def split_lines(text: str) -> list[str]:
    """The lines of a text, each with its end: LF, CRLF or CR."""
    return _LINE.findall(text)


_MOTION = re.compile(r"G0?([0-3])")


def words_of(line: str, syntax: Syntax = ISO) -> str:
    """The words of plain lines, upper case, without their comments, and the ends around them; empty if they have
    none."""
    return (syntax.plain.aside.sub("", line) if syntax is not ISO or "(" in line else line).strip().upper()


def motion_of(words: str) -> int | None:
    """The last motion that the words of plain lines state, if they state one."""
    found = _MOTION.match(words, words.rfind("G")) if "G" in words else None
    return int(found[1]) if found else None
