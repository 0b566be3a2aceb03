"""The records that an answer gives of its contour: its words, its solutions, what was asked for, what may be added."""

from collections.abc import Iterator

from msgspec import Struct

from contoursolve.gcode import Word
from contoursolve.geometry import Pick, Question
from contoursolve.solving import Certificate, Contour


class AskedValue(Struct, frozen=True):
    """A value that was asked for.

    Attributes:
        question: the word with `?`, and what it asks for.
        value: mm (radius) or degrees; None where nothing determines it.
    """

    question: Question
    value: float | None

    @property
    def word(self) -> Word:
        """The word that asks, such as that of `K?`."""
        return self.question.word


class Filled(Struct, frozen=True):
    """Blocks with the values that were asked for filled in, rounded to the least increment; they make the same
    contour to within `deviation` mm."""

    blocks: tuple[str, ...]
    deviation: float


class StatedWord(Struct, frozen=True):
    """A word of a contour.

    Attributes:
        key: its name: `A`, or `2:,A` where two blocks have one.
        word: the word in the program.
        meaning: what it states.
        value: its value as it is written; None for a variable or `?`.
        unit: what it is written in: mm, in or deg.
        fixes: the points and corners that it fixes, by name.
        is_ignored: whether the control drops it by a rule.
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

    Attributes:
        address: its address, such as `P` or `,A`.
        meaning: what it states.
        text: the word: with its value where the geometry fixes that, with `?` where it is still to be chosen.
        line: the program line into which it goes.
        replacement: all lines of the contour with it.
        contour: the contour that the block has then; None where other words are missing, or the value is.
    """

    address: str
    meaning: str
    text: str
    line: int
    replacement: str
    contour: Contour | None = None


class Completion(Struct, frozen=True):
    """A word that completes a block.

    Attributes:
        word: the word; it ends with `?` where its number is still to be chosen.
        block: the whole block with it.
        contour: the contour that it then has; None while the number is open.
    """

    word: str
    block: str
    contour: Contour | None


class Solution(Struct, frozen=True):
    """One solution of a contour.

    Attributes:
        name: its name, such as `A`; empty where there is one alone.
        contour: its path, mm; None if the control cannot make it.
        asked: the values that were asked for, in it.
        reasons: what speaks against its path.
        selects: the words, or sides, that select it.
        is_chosen: whether it is the contour that was solved.
        certificate: how sure its points are, mm.
        picks: the numbers that choose it, where the control has a word for these.
    """

    name: str
    contour: Contour | None
    asked: tuple[AskedValue, ...]
    reasons: tuple[str, ...]
    selects: tuple[str, ...]
    is_chosen: bool
    certificate: Certificate
    picks: tuple[Pick, ...] = ()


class Solutions(Struct, frozen=True):
    """All solutions of a contour that were found: a sequence.

    Attributes:
        solutions: the solutions, each with its path and what selects it.
        is_complete: whether these are all, with proof.
        method: how they were found: by a closed form, or by a search.
        doubts: what could not be decided, where they may not be all.
        chosen_by: the words that chose the control's own; empty where no choice is open.
        within: the distance from the start point within which these are all, mm, where they were searched for; None
            where a closed form gives them.
        steps: the number of steps that construct a solution, one after the other.
        boxes: the number of boxes of places that the search looked at; 0 where a closed form gives all.
    """

    solutions: tuple[Solution, ...]
    is_complete: bool
    method: str
    doubts: tuple[str, ...]
    chosen_by: str
    within: float | None = None
    steps: int = 0
    boxes: int = 0

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
