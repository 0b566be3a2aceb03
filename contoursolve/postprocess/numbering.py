"""Block numbers of expanded lines, and how far rounding leaves the tool from where the program has it."""

import re
from collections.abc import Iterable, Sequence
from decimal import Decimal
from itertools import count
from math import hypot, sqrt

from contoursolve.gcode import Block, Word
from contoursolve.geometry import Length
from contoursolve.reading import Control, Effect, Modes, State, apply_modes, codes_of, rows_of
from contoursolve.tolerance import ARC_START

SHORT, LONG = 9_999, 99_999
"""The highest block number: four digits, unless the program itself uses five."""

PROFILE_CYCLES = (70, 71, 72, 73)
"""Turning cycles whose profile is between the blocks P and Q."""

_NUMBER = re.compile(r"(?:[NPQ]|GOTO)[ \t]*([0-9]{1,5})(?![0-9])", re.IGNORECASE)
"""Block numbers, and numbers of blocks to which a program may jump; in comments, too."""


def numbers_of(lines: Iterable[str], control: Control) -> "Numbers":
    """The block numbers of a program, in the spelling of its control."""
    return Numbers(lines, control.writing.number if control.writing is not None else _NUMBER)


class Numbers:
    """The set of block numbers that a program has taken."""

    def __init__(self, lines: Iterable[str], number: re.Pattern[str] = _NUMBER) -> None:
        self._taken = bytearray(LONG + 1)
        for line in lines:
            for digits in number.findall(line):
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
        self.prefix = "N"
        """What stands before a number."""
        self._modes = modes
        self._numbers = numbers
        self._ends: set[Decimal] = set()
        """Blocks with which the profile of a cycle ends that was called before them."""
        self._divided: dict[Decimal, int] = {}
        """The lines of blocks that have become several, numbered in the first."""

    def look(self, block: Block) -> str:
        """Keep in mind with which block a profile ends; the reason if that is one that has become several."""
        codes = rows_of(block, self._modes)
        word = block.find("Q")
        is_call = any(code.effect is Effect.SINGLE and code.number in PROFILE_CYCLES for code in codes)
        if not is_call or word is None or word.number is None:
            return ""
        if word.number in self._divided:
            end = f"N{word.number} of program line {self._divided[word.number]}"
            return f"the profile of program line {block.line} ends with {end}, which is more than one line now"
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
        number, width = int(word.number), len(word.text.strip().lstrip("Nn"))
        for text in (text for at, text in enumerate(texts) if at != place):
            free = self._numbers.take_after(number)
            if free is None:
                return f"no block number up to {self._numbers.highest} is free for it: number its first line only"
            text.insert(0, f"{self.prefix}{free:0{width}}")
            number = free
        return ""


class Offsets:
    """The axes that are off, mm (X of a lathe as radius)."""

    def __init__(self, modes: Modes) -> None:
        self.modes = modes
        self._off: dict[str, float] = {}

    def __bool__(self) -> bool:
        return bool(self._off)

    def leave(self, axes: Sequence[str], here: Sequence[float], end: Sequence[float]) -> None:
        """The tool is here, and the original program has it at the end of a contour."""
        self._off |= {axis: at - exact for axis, at, exact in zip(axes, here, end, strict=True) if at != exact}

    def take(self, axes: Sequence[str]) -> list[float]:
        """Take the offsets of these axes, mm; the blocks that follow make up for them."""
        return [self._off.pop(axis, 0.0) for axis in axes]

    def keep(self, axes: Sequence[str]) -> None:
        """All other axes are put in their places."""
        self._off = {axis: off for axis, off in self._off.items() if axis in axes}

    def update(self, block: Block, state: State) -> str:
        """A block that stays as it is: an absolute word puts an axis in its place. What is wrong with an arc that
        begins too far off, if anything is."""
        here = apply_modes(state, block, self.modes)
        if any(not isinstance(code, Word) and code.effect is Effect.NO_MOTION for code in codes_of(block, self.modes)):
            return ""
        off = hypot(*(self._off.get(axis, 0.0) for axis in here.plane.axes))
        shapes = (*here.plane.centers, self.modes.radius)
        is_arc = here.motion in (2, 3) and any(word.address in shapes for word in block.words)
        rows = [self.modes.lexicon.addresses.get(word.address) for word in block.words]
        moved = [row.axis for row in rows if row and row.axis and not row.is_step(is_incremental=here.is_incremental)]
        self.keep([axis for axis in self._off if axis not in moved])
        if not is_arc or off <= self.modes.radius_difference * ARC_START:
            return ""
        least = least_decimals(here.unit, self.modes.radius_difference)
        return (
            f"its arc begins where the contour before it ends, which is rounded by {off:.2g} mm: take {least} decimals"
        )


def least_decimals(unit: Length, allowed: float) -> int:
    """Of the end of a contour, so that an arc behind it begins near enough to its place, where the radii at its ends
    may differ by so much, mm."""
    return next(digits for digits in count(1) if 10.0**-digits * float(unit.in_mm) * sqrt(0.5) <= allowed * ARC_START)
