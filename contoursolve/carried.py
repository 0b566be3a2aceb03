"""What a block says besides its contour, and what stands around its words: both are kept in what replaces it."""

import re
from typing import NamedTuple

from contoursolve.reading import Effect, Modes, codes_of
from contoursolve.reliance import MOTIONS
from contoursolve.syntax import Block, Word

_BLANKS = " \t\f\v\x02\x03\x11\x12\x13\x14\x1a\ufeff%"

_FRAME = re.compile(rf"(?P<head>[{_BLANKS}]*+)(?P<skip>/[1-9]?+(?!\d)[ \t]*+)?+")

_DROPPED = (*MOTIONS, Effect.CONTOUR)
"""G codes in whose place those of the plain motions stand."""

_AFTER_MOTION = frozenset({0, 1, 2, 5, 9, 30, 60, 98, 99})
"""M codes that act after the motion of their block: stop, end, spindle and coolant off, pallet, calls."""


class Frame(NamedTuple):
    """What stands around the words of a block: what is for a tape reader, blanks before the words, the block skip, and
    what is for a tape reader behind them."""

    before: str = ""
    indent: str = ""
    skip: str = ""
    behind: str = ""


class Carried(NamedTuple):
    """What a block says besides its contour, as it is written: its numbers and G codes, words for the first and for
    the last line in its place, and the G codes and words among them (`kept`)."""

    numbers: tuple[str, ...]
    codes: tuple[str, ...]
    words: tuple[str, ...]
    last: tuple[str, ...]
    kept: tuple[Word, ...]

    @property
    def says_something(self) -> bool:
        """Whether there is anything besides the contour."""
        return bool(self.kept)


def frame_of(text: str) -> Frame:
    """What stands around the words of a block."""
    if text[:1].isalpha() and (text[-1].isalnum() or text[-1] == "."):
        return Frame()
    frame = _FRAME.match(text)
    if frame is None:
        return Frame()
    head, rest = frame["head"], text[frame.end() :]
    indent = "".join(c for c in head if c in " \t")
    before = "".join(c for c in head if c not in " \t")
    return Frame(before, indent, frame["skip"] or "", rest[len(rest.rstrip(_BLANKS)) :].strip(" \t"))


def carried(block: Block, modes: Modes) -> Carried:
    """What a block says besides its contour."""
    numbers: list[str] = []
    codes: list[str] = []
    words: list[str] = []
    last: list[str] = []
    kept: list[Word] = []
    rows = iter(codes_of(block, modes) if block.words else ())
    for word in block.words:
        text = word.text.strip()
        if word.address == "G":
            row = next(rows)
            if not isinstance(row, Word) and row.effect in _DROPPED:
                continue
            codes.append(text)
        elif word.address in "NO":
            numbers.append(text)
        elif word.address in modes.lexicon.addresses:
            continue
        elif word.address == "M" and word.number in _AFTER_MOTION:
            last.append(text)
        else:
            words.append(text)
        kept.append(word)
    return Carried(tuple(numbers), tuple(codes), tuple(words), tuple(last), tuple(kept))
