"""NCT chapter 16: what the blocks of a contour are, and what their words are called.

A name begins with the number of its block; `first` and `second` are the axes of the plane, so that one set of
tables serves G17, G18 and G19.
"""

from dataclasses import dataclass

from contoursolve.dialects.nct_99m.lexicon import AXES
from contoursolve.model import Turn

LINE, ARC = "line", "arc"
OVER_LINE, OVER_CIRCLE = "over-defined line", "over-defined circle"
"""The roles of single blocks."""
LINE_LINE, LINE_CIRCLE, CIRCLE_LINE, CIRCLE_CIRCLE = "line-line", "line-circle", "circle-line", "circle-circle"
"""The roles of two blocks that meet in a computed intersection (16.3.1 to 16.3.4)."""

ALONE, OTHER_PLANE, RAPID = "@alone", "@other-plane", "@rapid"
UNCOMPENSATED, UNCOMPENSATED_FREE = "@uncompensated", "@uncompensated-free"
"""Over-defined without compensation where that is required, and where a setting frees it."""
FOLLOWED = "@followed"
"""The next block is over-defined, so that this one ends in a computed intersection."""
LAST = "@last"
"""No G1, G2 or G3 block follows."""
FEED, NEGATIVE_RADIUS, ONE_CENTER = "@feed", "@negative-radius", "@one-center"
"""A feed in the block; an over-defined circle with a negative R; one of the two distances to the centre."""
ON_PARALLEL_AXES = "@parallel"
"""A parallel axis stands for an axis of the plane."""
ONLY = "@only"
"""The only block of its contour."""
BESIDE = tuple(f"beside-{axis}" for axis in AXES)
"""Words that move an axis outside the plane, each with its axis."""
ORDINARY = "@ordinary"
"""The control calculates nothing for it."""

POINT = "point"
"""Stated as soon as a block that ends in an intersection has a coordinate: then it states a point of its element."""

AIMED = "aimed"
"""Stated instead of it if the same line has an angle, too: both then say where it runs."""

CHAMFER, ROUNDING = ",C", ",R"


@dataclass(frozen=True, slots=True)
class Element:
    """One block: a line, or an arc of a sense.

    `is_over` tells that it is over-defined: it begins in a computed intersection, and what it states is absolute.
    `is_followed` tells that the next block is, so that it ends in one.
    """

    turn: Turn | None
    is_over: bool
    is_followed: bool

    @property
    def role(self) -> str:
        """Which rules speak about it."""
        if self.turn is None:
            return OVER_LINE if self.is_over else LINE
        return OVER_CIRCLE if self.is_over else ARC


def pair_role(first: Element, second: Element) -> str:
    """Which rules speak about two blocks that meet in a computed intersection."""
    if first.turn is None:
        return LINE_LINE if second.turn is None else LINE_CIRCLE
    return CIRCLE_LINE if second.turn is None else CIRCLE_CIRCLE
