"""Notes what a program says that a target does not know, or reads in another way."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from contoursolve.dialects import Dialect
from contoursolve.posts import Post, Reading
from contoursolve.reading import State, WithoutPoint
from contoursolve.syntax import Block, Macro, Word

_NO_COMPENSATION = 40


@dataclass(frozen=True, slots=True)
class Unfamiliar:
    """One code or word, as it was first written: what is the matter with it, and in which line that is."""

    text: str
    problem: str
    line: int


@lru_cache(maxsize=32)
def _looking_for(addresses: str, is_counting: bool) -> re.Pattern[str]:
    """A word of one of some addresses, or (where numbers without a point count in another way) a coordinate without a
    point; or something in a comment that looks like one."""
    parts = [rf"[{addresses}][ \t]*[+-]?[.0-9]"] * bool(addresses)
    parts += [r"[XYZ][ \t]*[+-]?[0-9]+(?![0-9.])"] * is_counting
    return re.compile("|".join(parts), re.IGNORECASE)


class Watch:
    """Looks at every block that is not replaced."""

    def __init__(self, post: Post, dialect: Dialect, reading: Reading | None) -> None:
        self.post = post
        self.reading = reading
        self.lexicon = dialect.modes.lexicon
        self.modes = dialect.modes
        without_point = post.without_point or self.lexicon.numbers.without_point
        self.counts = None if without_point is self.lexicon.numbers.without_point else without_point
        self.found: list[Unfamiliar] = []
        self._named: set[str] = set()
        self._open = {*"FST"} & reading.otherwise.keys() if reading else set()
        """What may be said in a line that only moves, and is not noted yet."""
        self._verdicts: dict[tuple[str, str], str] = {}

    def asks(self, text: str) -> bool:
        """Whether lines that only move may say something that is not noted yet."""
        if self.reading is None:
            return False
        is_counting = self.counts is not None and "without point" not in self._named
        if not self._open and not is_counting:
            return False
        return _looking_for("".join(sorted(self._open)), is_counting).search(text) is not None

    def minds(self, state: State) -> bool:
        """Whether what is in force may be worth a note at any block."""
        is_flat = self.reading is not None and self.reading.flat_compensation
        return is_flat and state.plane.code == "G19" and state.compensation != _NO_COMPENSATION

    def look(self, block: Block, words: Sequence[Word], state: State) -> None:
        """Note what a block, with the state before it, says in words that the target does not read like this."""
        reading = self.reading
        if reading is None:
            return
        if block.macro is Macro.FLOW and not reading.has_macros:
            self._note("IF, WHILE, GOTO", block.text.strip(), "is not known", block.line)
        for word in words:
            key = word.address, word.text
            problem = self._verdicts.get(key)
            if problem is None:
                problem = self._judge(word, reading)
                if word.address in "GMT":
                    self._verdicts[key] = problem
            if problem:
                self._note(word.text.strip() if word.address in "GM" else word.address, word.text, problem, block.line)
            if self.counts is not None and self._counts_otherwise(word):
                problem = (
                    "counts in least increments where it has no point"
                    if self.counts is WithoutPoint.LEAST_INCREMENTS
                    else "is taken as written where it has no point"
                )
                self._note("without point", word.text, problem, block.line)
        if self.minds(state):
            self._note("G19 compensation", f"G{state.compensation} in G19", "is not known", block.line)

    def _judge(self, word: Word, reading: Reading) -> str:
        """What is the matter with one word; empty if nothing."""
        if word.address in ("G", "M"):
            known = reading.g if word.address == "G" else reading.m
            is_whole = word.number is not None and word.number == word.number.to_integral_value()
            if word.number is not None and is_whole:
                name = f"{word.address}{int(word.number)}"
                return reading.otherwise.get(name, "" if int(word.number) in known else "is not known")
            return "is not known"
        return reading.otherwise.get(word.address, "")

    def _counts_otherwise(self, word: Word) -> bool:
        """Whether a number means another length or angle on the target because it has no point."""
        is_number = word.number is not None and word.number != 0 and not word.has_point
        return is_number and word.address in self.lexicon.addresses and word.address != "Q"

    def _note(self, name: str, text: str, problem: str, line: int) -> None:
        if name not in self._named:
            self._named.add(name)
            self._open.discard(name)
            self.found.append(Unfamiliar(text.strip(), problem, line))
