"""Patterns of lines that do nothing but move, or nothing at all, as controls spell them."""

import re
from typing import Any

from msgspec import Struct

from contoursolve.gcode.late_pattern import late_pattern

AXES = "UVWXYZ"
"""The letters of axes that plain lines may have; each control has some of them."""

MOST_TOGETHER = 1_000
"""Lines of a passage."""

# A word at most once, so that there is nothing to say of it, and a number as every control has it: 9,999 inches are a
# place, more may be none. Few blanks, so that no line is too long. Possessive or atomic throughout: what is taken is
# never tried again. A comment may state a fact.
NUMBER = r"[+-]?+(?:[0-9]{1,4}+(?>(?:\.[0-9]{0,12}+)?)|\.[0-9]{1,12}+)"
_BLANKS = r"[ \t]{0,20}+"
_COMMENTS = {
    "(": (r"(?>(?:\((?![ \t]*+c\w*tour)[^()\r\n]*+\)[ \t]*+)*)", r"\([^()]*+\)"),
    "[": (r"(?>(?:\[(?![ \t]*+c\w*tour)[^\[\]\r\n]*+\][ \t]*+)*)", r"\[[^\[\]]*+\]"),
    ";": (r"(?>(?:;(?![ \t(]*+c\w*tour)[^\r\n]*+)?)", r";[^\r\n]*+"),
}
_FLAGS = re.IGNORECASE | re.ASCII


class PlainSpelling(Struct, frozen=True):
    """One way to spell plain lines. They make no contour, and one may begin or end with them only beside others."""

    one: re.Pattern[str]
    """A line, with its end or without."""
    several: re.Pattern[str]
    """Lines in a row."""
    aside: re.Pattern[str]
    """The pattern of what is no word: comments, and names with the letter of an axis."""
    motions: tuple[int, ...] = (0, 1)
    """The motions in which the lines lead where their coordinates say."""
    begins: re.Pattern[str] = re.compile(r"\S")
    """Words of a line with which a contour may begin, if what follows makes one of it."""
    parts: re.Pattern[str] | None = None
    """The signs of what the words of a line set, if that is more than places and the motion: the first two name it, and
    the last line with that name counts."""


def plain_spelling(words: str, comments: str, names: str = "", **others: Any) -> PlainSpelling:
    """The spelling of lines with some words or none, and comments, which begin with one of these signs; `names` have
    the letter of an axis."""
    behind, asides = zip(*(_COMMENTS[each] for each in comments), strict=True)
    aside = late_pattern("|".join((*asides, names or "(?!)")), _FLAGS)
    line = rf"{_BLANKS}(?>(?:{words})?){''.join(behind)}(?:\r\n|\n|\r|\Z)"
    several = late_pattern(rf"(?>(?:{line}){{1,{MOST_TOGETHER}}})", _FLAGS)
    return PlainSpelling(late_pattern(line, _FLAGS), several, aside, **others)


def lines_and_arcs(axes: str, comments: str, values: str, arc: str = "") -> PlainSpelling:
    """The spelling of lines in G codes: its axes, comments, the values of words, with @ for a number, and the words of
    arcs alone, if arcs are plain, too."""

    def words(name: str, others: str, motions: str) -> str:
        once = rf"(?P<{name}>[GMNSTF{axes}]{others})(?![^\r\n{comments}]*(?P={name}))"
        code = rf"(?<=G)0?{motions}|(?<=M)0?[34589]|(?<=[NST])[0-9]{{1,8}}+"
        value = rf"(?:{values.replace('@', NUMBER)}|{code})(?![0-9.])"
        return rf"(?=[^\r\n{comments}]*[{axes}])(?>(?:{once}{value}{_BLANKS})+)"

    lines = words("of_line", "", "[01]")
    if not arc:
        return plain_spelling(lines, comments)
    arcs = rf"(?=[^\r\n{comments}]*G0?[23](?![0-9])){words('of_arc', f'|{arc}', '[23]')}"
    return plain_spelling(f"{arcs}|{lines}", comments, motions=(0, 1, 2, 3))


ISO_LINES = lines_and_arcs(AXES, "(", rf"(?<=[F{AXES}])@")
"""Lines with G00 or G01, or neither, as ISO 6983 has them."""
