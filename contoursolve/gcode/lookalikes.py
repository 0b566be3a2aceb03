"""Stretches of a block that are almost a word: letters for digits (l and I for 1, O for 0), a comma for the point,
a point, a sign or an equals sign too many."""

import re
from bisect import bisect_right
from collections.abc import Callable, Sequence

from msgspec import Struct

from contoursolve.diagnostics import Span
from contoursolve.gcode.late_pattern import late_pattern
from contoursolve.gcode.syntax import ISO
from contoursolve.gcode.word import Block, Fault, FaultKind

_DIGITS = str.maketrans("lI|Oo", "11100")
_NUMBER = r"(?>(?:[-+0-9.lI|Oo]|,(?=[\d.,]|[ \t]*+(?:[;(]|$)))+)"
_SEARCH = late_pattern(
    rf"\([^)]*+\)?+|;.*+|,?+[A-Za-z][ \t]*+(?:=[ \t]*+)?(?:[-+]++[ \t]++)?(?P<number>{_NUMBER})"
    r"(?>(?P<text>(?=[A-Za-z](?![ \t]*+[+-]?+[.\dlI|Oo])))?)"
)
"""A comment; or an address and what may be its number, and whether it goes on as a text does."""
_WORD = late_pattern(r",?+[A-Za-z][ \t]*+[+-]?+(?>\d++\.?+\d*+|\.\d++)", re.ASCII)
_CODE = late_pattern(r"[Gg][ \t]*+\d{1,3}+", re.ASCII)
_HINT = late_pattern(r"[Gg][ \t]*+\d*+[lI|Oo]")
_LONGEST = 40
"""Characters of what may be a number; a control reads 8 digits."""
_WHOLE = "GMNOST"
"""Addresses whose numbers have no point."""


class Lookalike(Struct, frozen=True):
    """A stretch of a block that is one word if its slips are mended: as typed, and that word."""

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

    @property
    def has_letters(self) -> bool:
        """Whether letters stand for digits, and nothing else is wrong."""
        return self.new == with_digits(self.old)


def find_lookalikes(block: Block) -> tuple[Lookalike, ...]:
    """The stretches of a block outside comments that would be words with their slips mended.

    `X10I5.` is one, too, and means what it says: what is meant shows only where it is tried.
    """
    found, text, place = [], block.text, 0
    if any(fault.kind is FaultKind.BLOCK_TOO_LONG for fault in block.faults):
        return ()
    torn = _torn(block) if block.faults else ()
    if block.syntax is not ISO:
        own = tuple(
            each
            for each in (_meant(block, fault) for fault in block.faults)
            if each and not lookalike_at(torn, each.span)
        )
        return tuple(sorted((*own, *torn), key=lambda each: each.span))
    while match := _SEARCH.search(text, place):
        old, place = match[0], match.end()
        if match["number"] is None or match["text"] is not None:
            continue
        new = mended(old) if len(match["number"]) <= _LONGEST else ""
        if new and new != old:
            found.append(Lookalike(Span(block.line, match.start() + 1, match.end() + 1), old, new))
        elif not new:
            # A letter among the digits may be the address.
            place = max(match.start() + 1, match.end() - _LONGEST)
    found = [each for each in found if not lookalike_at(torn, each.span)]
    return tuple(sorted((*found, *torn), key=lambda each: each.span))


def _torn(block: Block) -> tuple[Lookalike, ...]:
    """Words in whose numbers a blank stands, as in `,C1. 5`: digits behind them that belong to no word."""
    found, ends = [], {word.span.end_column: word for word in block.words if word.number is not None}
    for fault in block.faults:
        begin = len(block.text[: fault.span.column - 1].rstrip(" \t")) + 1
        word = ends.get(begin)
        digits = fault.text.strip()
        joined = word.text + digits if word is not None else ""
        is_number = digits.isdigit() or digits.lstrip(".").isdigit()
        if word is not None and is_number and begin < fault.span.column and word.has_point + ("." in digits) < 2:  # noqa: PLR2004 - one point
            old = block.text[word.span.column - 1 : fault.span.end_column - 1]
            found.append(Lookalike(Span(block.line, word.span.column, fault.span.end_column), old, joined))
    return tuple(found)


def _meant(block: Block, fault: Fault) -> Lookalike | None:
    """The word that a fault was meant to be: digits for letters, and an equals sign behind a long address. None if that
    is no word."""
    words = block.syntax.words
    match = _LONG.fullmatch(words.spare.sub(r"\1 ", fault.text) if words.spare else fault.text)
    if match is None or fault.kind is not FaultKind.NUMBER_MALFORMED:
        return None
    address = words.names.get(match["address"].upper(), match["address"])
    new = words.spell(address, match["number"].translate(_DIGITS).replace(",", "."))
    return Lookalike(fault.span, fault.text, new) if new != fault.text else None


_LONG = late_pattern(r"(?P<address>#?[A-Za-z_]\w*?)[ \t]*=?[ \t]*(?P<number>[+-]?\d[\d.,Ool|]*)", re.ASCII)


def lookalike_at(words: Sequence[Lookalike], place: Span) -> Lookalike | None:
    """The one of some such words, in their order, in which a place lies."""
    index = bisect_right(words, (place.line, place.column), key=lambda each: (each.span.line, each.span.column)) - 1
    found = words[index] if index >= 0 else None
    is_in = found is not None and place.line == found.span.line and place.column < found.span.end_column
    return found if is_in else None


def has_lookalike_code(block: Block) -> bool:
    """Whether a G code of a block may have letters for digits."""
    return _HINT.search(block.text) is not None and any(each.is_code for each in find_lookalikes(block))


def with_digits(word: str) -> str:
    """A word whose letters behind the address are the digits that they look like."""
    begin = 2 if word.startswith(",") else 1
    return word[:begin] + word[begin:].translate(_DIGITS)


def mended(word: str) -> str:
    """A word without what keeps its number from being read; empty if it is none then, either."""
    word = with_digits(word)
    begin = 2 if word.startswith(",") else 1
    address, number = word[:begin], word[begin:]
    for mend in _MENDING:
        number = mend(number, address)
    return address + number if _WORD.fullmatch(address + number) else ""


def _equals(number: str, _: str) -> str:
    """No equals sign behind the address, which other controls have."""
    text = number.lstrip()
    return text[1:].lstrip() if text.startswith("=") else number


def _sign(number: str, _: str) -> str:
    """One sign, before the digits: of several, a minus."""
    match = _SIGNS.fullmatch(number)
    if match is None or not (match["before"] or match["behind"]):
        return number
    signs = match["before"] + match["behind"]
    return ("-" if "-" in signs else "+") + match["digits"]


def _comma(number: str, address: str) -> str:
    """A point for a comma; none where there is a point already, or where a number has none."""
    text = number.rstrip(",")
    if text == number:
        return number.replace(",", ".")
    return text if "." in text or "," in text or address.upper() in _WHOLE else f"{text}."


def _points(number: str, _: str) -> str:
    """One point for several in a row, and none behind a number that has one."""
    text = _IN_A_ROW.sub(".", number)
    return text[:-1] if text.endswith(".") and text.count(".") > 1 else text


_SIGNS = late_pattern(r"(?P<blank>[ \t]*+)(?P<before>[-+]*+)[ \t]*+(?P<digits>[0-9.,]++)(?P<behind>[-+]*+)")
_IN_A_ROW = late_pattern(r"\.{2,}")
_MENDING: tuple[Callable[[str, str], str], ...] = (_equals, _sign, _comma, _points)
"""Corrections of the text behind an address, applied one after the other."""
