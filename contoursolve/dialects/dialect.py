"""What a control is: a record of tables, and how its contours are found among the blocks."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from contoursolve.model import Length, Plane
from contoursolve.reading import Claim, Form, Modes, Position, State
from contoursolve.rules import Rule
from contoursolve.syntax import Block, Word


@dataclass(frozen=True, slots=True)
class Unresolved:
    """A contour block of a form that this version does not resolve, and the word that shows it."""

    block: Block
    word: Word
    form: str


Finder = Callable[[Sequence[Block], int, State, Modes], Claim | Unresolved | None]
"""(blocks, index, state before the block, modes) to the contour that begins at this block, if any."""


@dataclass(frozen=True, slots=True)
class Dialect:
    """One control."""

    name: str
    title: str
    modes: Modes
    plane: Plane
    forms: tuple[Form, ...]
    rules: tuple[Rule, ...]
    find: Finder
    signs: Callable[[Block], bool]
    """Whether a block can only be meant for this control."""

    def initial_state(self, unit: Length) -> State:
        """The state before the first block: the position is not known, nothing is compensated."""
        reason = "no block before it positions this axis"
        axes = {axis: Position(None, reason) for axis in self.modes.axes}
        return State(axes, None, self.plane, unit, is_incremental=False, compensation=40)
