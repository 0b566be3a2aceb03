"""Patterns of lines that do nothing but move, or nothing at all, as controls spell them."""

import re

from msgspec import Struct

from contoursolve.gcode.late_pattern import late_pattern

AXES = "UVWXYZ"
"""The letters of axes that plain lines may have; each control has some of them."""

MOST_TOGETHER = 1_000
"""Lines of a passage."""

# A word at most once, so that there is nothing to say of it, and a number as every control has it: 9,999 inches are a
# place, more may be none. Few blanks, so that no line is too long. Possessive or atomic throughout: what is taken is
# never tried again.
_BLANKS = r"[ \t]{0,20}+"
NUMBER = r"[+-]?+(?:[0-9]{1,4}+(?>(?:\.[0-9]{0,12}+)?)|\.[0-9]{1,12}+)"
COMMENTS = r"(?>(?:\((?![ \t]*+c\w*tour)[^()\r\n]*+\)[ \t]*+)*)"
"""Comments in parentheses; not one that states a fact."""
REMARK = r"(?>(?:;(?![ \t(]*+c\w*tour)[^\r\n]*+)?)"
"""A comment behind a semicolon, to the end of the line."""
_OTHERS = r"(?<=[NST])[0-9]{1,8}+|(?<=M)0?[34589]"


class PlainSpelling(Struct, frozen=True, eq=False):
    """One way to spell plain lines. They make no contour, and one may begin or end with them only beside others."""

    one: re.Pattern[str]
    """A line, with its end or without."""
    several: re.Pattern[str]
    """Lines in a row."""
    aside: re.Pattern[str]
    """What is no word: comments, and a name with the letter of an axis."""
    motions: tuple[int, ...] = (0, 1)
    """The motions in which the lines lead where their coordinates say."""
    begins: re.Pattern[str] = late_pattern(r"\S")
    """Words of a line with which a contour may begin, if what follows makes one of it."""
    parts: re.Pattern[str] | None = None
    """What the words of a line set, if that is more than a place: its first two signs name it, and the last line with
    that name counts."""


def words_once(letters: str, values: str, *, until: str, needs: str, name: str = "word") -> str:
    """A pattern of words with blanks behind them: what they begin with, each at most once before a comment, which
    begins with one of the signs `until`; and their values. The line `needs` something."""
    once = rf"(?P<{name}>{letters})(?![^\r\n{until}]*(?P={name}))"
    return rf"(?=[^\r\n{until}]*{needs})(?>(?:{once}(?:{values}|{_OTHERS})(?![0-9.]){_BLANKS})+)"


def plain_spelling(words: str, comments: str, aside: str, **others: object) -> PlainSpelling:
    """The spelling of lines of some words, or none, and comments."""
    line, flags = rf"{_BLANKS}(?:{words})?+{comments}(?:\r\n|\n|\r|\Z)", re.IGNORECASE | re.ASCII
    several = late_pattern(rf"(?>(?:{line}){{1,{MOST_TOGETHER}}})", flags)
    return PlainSpelling(late_pattern(line, flags), several, late_pattern(aside, flags), **others)  # type: ignore[arg-type]


LINES = words_once(f"[GMNSTF{AXES}]", rf"(?<=[F{AXES}]){NUMBER}|(?<=G)0?[01]", until="(", needs=f"[{AXES}]")
"""Words of lines as ISO 6983 has them."""
ISO_LINES = plain_spelling(LINES, COMMENTS, r"\([^()]*+\)")
"""Lines with G00 or G01, or neither, and comments in parentheses."""
