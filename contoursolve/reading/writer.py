"""The writing of a control that is not programmed in G codes, and what its own blocks are in G codes."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from msgspec import Struct

from contoursolve.gcode import Block
from contoursolve.reading.modal_dependence import Carried
from contoursolve.reading.modal_state import State

NOTHING = Carried((), (), (), (), ())
"""The name of a block that is not written."""


class Around(NamedTuple):
    """The arc of a block: its centre, mm, and how far it turns, degrees, counter-clockwise positive."""

    center: tuple[float, float]
    sweep: float


class Restated(Struct, frozen=True):
    """A block in G codes: what it says besides its path, and the coordinates to which it moves, mm. `reason` is why it
    cannot be said, or, with coordinates or words, what of it cannot."""

    says: Carried = NOTHING
    ends: Mapping[str, float] = {}
    is_rapid: bool = False
    around: Around | None = None
    reason: str = ""


class Own(Protocol):
    """Writes one program in the words of its control."""

    def keep(self, block: Block) -> None:
        """A block stays as it is."""

    def write(self, block: Block, moves: Sequence[tuple[int, tuple[str, ...]]]) -> list[list[str]]:
        """The blocks in the place of one: its moves as G01 to G03 with absolute centres, and what it says besides."""

    def close(self, after: State) -> list[list[str]]:
        """The blocks behind a contour that put in force again what it has changed."""


class Plain(Protocol):
    """Writes one program in G codes."""

    def restate(self, block: Block, before: State, after: State) -> Restated:
        """A block that belongs to no contour."""

    def is_rapid(self, block: Block) -> bool:
        """Whether a block moves in rapid."""

    def beside(self, block: Block, before: State) -> Restated:
        """The words of a block of a contour besides it."""


@dataclass(frozen=True, slots=True)
class Writing:
    """The writing of the programs of a control: in its own words, and in G codes.

    `opening` stands before a program in G codes if the target asks for nothing else. `number` matches what is, or may
    name, the number of a block.
    """

    own: Callable[[], Own]
    plain: Callable[[], Plain]
    opening: str
    number: re.Pattern[str]
    number_prefix: str = ""
    center_decimals: int = 1
    """The number of decimals that the centre of an arc has more than a coordinate."""
