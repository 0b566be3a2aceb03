"""Block numbers of the lines that take the place of one block: none that the program has or jumps to is used again."""

import re
from collections.abc import Iterable
from decimal import Decimal

from contoursolve.reading import Code, Effect, Modes, codes_of
from contoursolve.syntax import Block

SHORT, LONG = 9_999, 99_999
"""The highest block number: four digits, unless the program itself uses five."""

_NUMBER = re.compile(r"(?:[NPQ]|GOTO)[ \t]*([0-9]{1,5})(?![0-9])", re.IGNORECASE)
"""What is a block number or may be the number of a block that is jumped to, in comments, too."""

_PROFILE_CYCLES = frozenset({70, 71, 72, 73})


class Numbers:
    """Which block numbers of a program are taken."""

    def __init__(self, lines: Iterable[str]) -> None:
        self._taken = bytearray(LONG + 1)
        for line in lines:
            for digits in _NUMBER.findall(line):
                self._taken[int(digits)] = 1
        self.highest = LONG if 1 in self._taken[SHORT + 1 :] else SHORT

    def take_after(self, number: int) -> int | None:
        """The next free number, which is taken from now on; the lowest one where there is none behind; None if there
        is none at all."""
        for begin, end in ((number + 1, self.highest + 1), (1, number)):
            found = self._taken.find(0, begin, end)
            if found >= 0:
                self._taken[found] = 1
                return found
        return None


class Numberer:
    """Numbers the lines in the place of blocks; what cannot be numbered as it has to be is told as a reason."""

    def __init__(self, modes: Modes, numbers: Numbers | None) -> None:
        """`numbers` are those of the program, where all lines are to have one."""
        self._modes = modes
        self._numbers = numbers
        self._ends: set[Decimal] = set()
        """Blocks with which the profile of a cycle ends that was called before them."""
        self._divided: dict[Decimal, int] = {}
        """The lines of blocks that have become several, numbered in the first."""

    def look(self, block: Block) -> str:
        """Keep in mind with which block a profile ends; the reason if that is one that has become several."""
        codes = [code for code in codes_of(block, self._modes) if isinstance(code, Code)]
        word = block.find("Q")
        is_call = any(code.effect is Effect.SINGLE and code.number in _PROFILE_CYCLES for code in codes)
        if not is_call or word is None or word.number is None:
            return ""
        if word.number in self._divided:
            end = f"N{word.number} of line {self._divided[word.number]}"
            return f"the profile of line {block.line} ends with {end}, which is more than one line now"
        self._ends.add(word.number)
        return ""

    def number(self, block: Block, own: list[str], texts: list[list[str]]) -> str:
        """Put the number of a block before the words of its first line, or of its last one if a profile ends there."""
        word = block.find("N")
        place = len(texts) - 1 if word and word.number in self._ends else 0
        texts[place][:0] = own
        if word is None or word.number is None or len(texts) == 1:
            return ""
        if not place:
            self._divided[word.number] = block.line
        if self._numbers is None or word.number % 1:
            return ""
        number, width = int(word.number), len(word.text.strip()) - 1
        for text in (text for at, text in enumerate(texts) if at != place):
            free = self._numbers.take_after(number)
            if free is None:
                return f"no block number up to {self._numbers.highest} is free for it: number its first line only"
            text.insert(0, f"N{free:0{width}}")
            number = free
        return ""
