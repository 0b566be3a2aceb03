"""Letters typed for the digits that they look like: l and I for 1, O for 0."""

import re
from dataclasses import dataclass

from contoursolve.source import Span
from contoursolve.syntax.word import Block, FaultKind

_DIGITS = str.maketrans("lI|Oo", "11100")
_SEARCH = re.compile(r"\([^)]*\)?|;.*|,?[A-Za-z][ \t]*+[+-]?[0-9.lI|Oo]++(?![A-Za-z](?![ \t]*[+-]?[.\dlI|Oo]))")
"""A comment; or an address and what may be its number, unless it goes on as a text does."""
_WORD = re.compile(r",?[A-Za-z][ \t]*[+-]?(?:\d+\.?\d*|\.\d+)", re.ASCII)
_CODE = re.compile(r"[Gg][ \t]*\d{1,3}", re.ASCII)
_HINT = re.compile(r"[Gg][ \t]*\d*[lI|Oo]")


@dataclass(frozen=True, slots=True)
class Lookalike:
    """A stretch of a block that is one word if its letters are digits: as typed, and that word."""

    span: Span
    old: str
    new: str

    @property
    def address(self) -> str:
        """The address of the word, upper case with its comma."""
        return self.new[: 1 + self.new.startswith(",")].upper()

    @property
    def is_code(self) -> bool:
        """Whether it would be a G code."""
        return _CODE.fullmatch(self.new) is not None

    def covers(self, span: Span) -> bool:
        """Whether a place of its block lies in it."""
        return self.span.column <= span.column < self.span.end_column


def find_lookalikes(block: Block) -> tuple[Lookalike, ...]:
    """The stretches of a block outside comments that would be words with digits for some letters.

    `X10I5.` is one, too, and means what it says: what is meant shows only where it is tried.
    """
    found, text, place = [], block.text, 0
    if any(fault.kind is FaultKind.BLOCK_TOO_LONG for fault in block.faults):
        return ()
    while match := _SEARCH.search(text, place):
        old, place = match[0], match.end()
        new = with_digits(old)
        if _WORD.fullmatch(new) and new != old:
            found.append(Lookalike(Span(block.line, match.start() + 1, match.end() + 1), old, new))
        elif new != old and old[0] not in "(;":
            place = match.start() + 1
    return tuple(found)


def has_lookalike_code(block: Block) -> bool:
    """Whether a G code of a block may have letters for digits."""
    return _HINT.search(block.text) is not None and any(each.is_code for each in find_lookalikes(block))


def with_digits(word: str) -> str:
    """A word whose letters behind the address are the digits that they look like."""
    begin = 2 if word.startswith(",") else 1
    return word[:begin] + word[begin:].translate(_DIGITS)
