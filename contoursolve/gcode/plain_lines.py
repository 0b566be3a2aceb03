"""Lines that do nothing but move, or nothing at all: most lines of most programs. One pattern finds many at once, and
nobody needs to read them into words."""

import re
from functools import cached_property

from msgspec import Struct

from contoursolve.gcode.late_pattern import late_pattern
from contoursolve.gcode.syntax import ISO, Syntax

AXES = "UVWXYZ"
"""The letters of axes that plain lines may have; each control has some of them."""

MOST_TOGETHER = 1_000
"""Lines of a passage."""


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


# A word at most once, so that there is nothing to say of it, and a number as every control has it: 9,999 inches are a
# place, more may be none. Few blanks, so that no line is too long. Possessive or atomic throughout: what is taken is
# never tried again.
_BLANKS = r"[ \t]{0,20}+"
_NUMBER = r"[+-]?+(?:[0-9]{1,4}+(?>(?:\.[0-9]{0,12}+)?)|\.[0-9]{1,12}+)"
_WORD = (
    rf"([GMNSTF{AXES}])(?![^\r\n(]*\1)"
    rf"(?:(?<=[F{AXES}]){_NUMBER}|(?<=[NST])[0-9]{{1,8}}+|(?<=G)0?[01]|(?<=M)0?[34589])(?![0-9.])"
)
_COMMENT = r"\((?![ \t]*+c\w*tour)[^()\r\n]*+\)"
_MOVING = rf"(?=[^\r\n(]*[{AXES}])(?>(?:{_WORD}{_BLANKS})+)"
_PLAIN = rf"{_BLANKS}(?:{_MOVING})?+(?>(?:{_COMMENT}[ \t]*+)*)(?:\r\n|\n|\r|\Z)"
_ONE = late_pattern(_PLAIN, re.IGNORECASE | re.ASCII)
SEVERAL = late_pattern(rf"(?>(?:{_PLAIN}){{1,{MOST_TOGETHER}}})", re.IGNORECASE | re.ASCII)
"""The pattern of plain lines in a row."""

_COMMENTS = re.compile(r"\([^()]*+\)")
_MOTION = re.compile(r"G0?([01])")


def is_plain_line(line: str) -> bool:
    """Whether a line, with its end or without, has G00, G01 or neither and coordinates, whatever its feed, speed and
    tool; or has no words."""
    return _ONE.fullmatch(line) is not None


def words_of(line: str) -> str:
    """The words of plain lines, upper case, without their comments, and the ends around them; empty if they have
    none."""
    return (_COMMENTS.sub("", line) if "(" in line else line).strip().upper()


def motion_of(words: str) -> int | None:
    """The last motion that the words of plain lines state, if they state one."""
    found = _MOTION.match(words, words.rfind("G")) if "G" in words else None
    return int(found[1]) if found else None
