"""The records that an answer gives of its contour: its words, its solutions, what was asked for, what may be added."""

from collections.abc import Iterator

from msgspec import Struct

from contoursolve.gcode import Word
from contoursolve.geometry import Pick, Question
from contoursolve.solving import Certificate, Contour


class AskedValue(Struct, frozen=True):
    """A value that was asked for: mm (radius) or degrees; None where nothing determines it."""

    question: Question
    value: float | None


class Filled(Struct, frozen=True):
    """Blocks with the values that were asked for filled in, rounded to the least increment; they make the same
    contour to within `deviation` mm."""

    blocks: tuple[str, ...]
    deviation: float


class StatedWord(Struct, frozen=True):
    """A word of a contour, with its key: `A`, or `2:,A` where two blocks have one.

    `meaning` says what it is. `value` and `unit` (mm, in, deg) are as written; a variable or `?` has no value. `fixes`
    names the points and corners that it fixes.
    """

    key: str
    word: Word
    meaning: str
    value: float | None
    unit: str
    fixes: tuple[str, ...] = ()
    is_ignored: bool = False


class Addition(Struct, frozen=True):
    """A word that a block may still take.

    `text` is the word. It has its value where the geometry fixes that, and `?` where it is still to be chosen. It goes
    into the program line `line`; `replacement` has all lines of the contour with it. `contour` is the one that the
    block has then. It is None where other words are missing, or the value is.
    """

    address: str
    meaning: str
    text: str
    line: int
    replacement: str
    contour: Contour | None = None


class Completion(Struct, frozen=True):
    """A word that completes a block, and the whole block with it. `contour` is what it then has, None while the word's
    number is open."""

    word: str
    block: str
    contour: Contour | None


class Solution(Struct, frozen=True):
    """One solution: its name, its path (None if the control cannot make it, with the reasons), what selects it,
    and whether it is the contour that was solved."""

    name: str
    contour: Contour | None
    asked: tuple[AskedValue, ...]
    reasons: tuple[str, ...]
    selects: tuple[str, ...]
    is_chosen: bool
    certificate: Certificate
    picks: tuple[Pick, ...] = ()
    """The numbers that choose it, where the control has a word for these."""


class Solutions(Struct, frozen=True):
    """All solutions that were found, a sequence, and whether these are proven to be all."""

    solutions: tuple[Solution, ...]
    is_complete: bool
    method: str
    doubts: tuple[str, ...]
    chosen_by: str
    within: float | None = None
    """The distance from the start point within which these are all, mm, where they were searched for; None where a
    closed form gives them."""

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[Solution]:
        return iter(self.solutions)

    def __getitem__(self, number: int) -> Solution:
        return self.solutions[number]

    @property
    def is_closed(self) -> bool:
        """Whether a closed form gives them."""
        return self.within is None

    @property
    def is_single(self) -> bool:
        """Whether there is one solution, and no other one can be."""
        return len(self.solutions) == 1 and self.is_complete
