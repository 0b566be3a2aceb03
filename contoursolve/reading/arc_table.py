"""The table by which a control reads arcs, and the issues that there are with one."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any

from contoursolve.gcode import Block, Passage
from contoursolve.tolerance import LENGTH, RADIUS_DIFFERENCE


class ArcIssue(Enum):
    """An issue with an arc by itself, or with one that begins the profile of a cycle."""

    RADII_DIFFER = "arc-radii-differ"
    RADII_UNCORRECTED = "arc-radii-uncorrected"
    SPIRAL = "arc-spiral"
    CENTRE_MOVES = "arc-centre-moves"
    RADIUS_SMALL = "arc-radius-small"
    FULL_BY_RADIUS = "arc-full-by-radius"
    MOVES_NOTHING = "arc-moves-nothing"
    UNDEFINED = "arc-undefined"
    RUNS_LINE = "arc-runs-line"
    BOTH = "arc-both"
    OUTSIDE_PLANE = "arc-outside-plane"
    OVER_HALF = "arc-over-half"
    EMPTY = "arc-empty-circle"
    OPENING = "arc-opening-angle"
    IN_LINE = "arc-in-line"
    PROFILE_ARC = "profile-begins-with-arc"
    PROFILE_CODE = "profile-begins-without-code"


class BothStated(Enum):
    """The effect of a centre beside a radius."""

    REFUSED = "refused"
    RADIUS_COUNTS = "radius counts"
    AGREES = "they must agree"


class Beyond(Enum):
    """The action of a control on radii that differ by more than is allowed."""

    REFUSES = "refuses"
    SPIRAL = "spiral"
    AXIS_LINE = "arc, then a line along an axis"
    MOVES_CENTRE = "moves the centre"


@dataclass(frozen=True, slots=True)
class ArcTable:
    """The reading of arcs by a control, and how exact it wants them.

    `read` is (block, state before it, modes) to the arc that it states, and `suspects` (passage, state before it,
    modes) to the indices of lines that may be none, of a control that is not programmed in G codes.
    """

    difference: float = RADIUS_DIFFERENCE
    """mm. By how much the radii where an arc begins and ends may differ; 0 where that is not looked at."""
    share: float = 0.0
    """The share of the radius by which they may, where that is more."""
    beyond: Beyond = Beyond.REFUSES
    unchecked: Beyond = Beyond.SPIRAL
    """The action where the difference is not looked at."""
    issue: ArcIssue = ArcIssue.RADII_DIFFER
    """The issue with radii that differ by more, where it is refused."""
    both: BothStated = BothStated.REFUSED
    runs_line: bool = False
    """Whether an arc without a centre and a radius is a straight line."""
    is_still: bool = False
    """Whether an arc by its radius moves nothing where it ends where it begins."""
    needs_end: bool = True
    """Whether a radius without an end is an arc; else it only sets the radius."""
    refuses_negative: bool = False
    """Whether an arc by its radius is less than half a circle."""
    counts_from_origin: bool = False
    """Whether the words of a centre are its coordinates."""
    beside: frozenset[str] = frozenset()
    """Words beside an arc that change no radius, although contoursolve does not read them."""
    opening: str = ""
    """The address of an opening angle, by which an arc is made with its end or its centre."""
    through: str = ""
    """The code of an arc through a point between its ends, whose words are those of a centre with a 1 behind."""
    has_pitch: bool = False
    """Whether the word of a centre outside the plane is the pitch of a helix."""
    planes: frozenset[str] = frozenset()
    """The planes in which its axes are those of the tables; empty for all."""
    others: frozenset[str] = frozenset()
    """Words that stay in force and make words of axes something else than coordinates."""
    shift: float = 0.0
    """mm. By how much a centre may be moved, where it is."""
    shift_share: float = 0.0
    """The share of the radius by which it may."""
    in_force: Callable[["ArcTable", Any], "ArcTable"] | None = None
    """From the table and a state to the table with the words in force."""
    read: Callable[[Block, Any, Any], Any] | None = None
    suspects: Callable[[Passage, Any, Any], Any] | None = None

    def limit(self, radius: float) -> float:
        """The allowed difference of the radii, mm."""
        return max(self.difference, self.share * radius)

    def allows(self, off: float, radius: float) -> bool:
        """Whether radii may differ by so much (mm); the rounding of a difference that is just allowed makes it no
        more."""
        return off <= self.limit(radius) + LENGTH

    def with_numbers(self, settings: Mapping[str, str]) -> "ArcTable":
        """The table with the numbers that settings state."""
        stated: dict[str, Any] = {
            name: float(settings[key]) * unit for key, (name, unit) in _NUMBERS.items() if key in settings
        }
        table = replace(self, **stated) if stated else self
        if table.difference == 0 and not table.share:
            return replace(table, difference=RADIUS_DIFFERENCE, beyond=table.unchecked)
        return table


_NUMBERS: Mapping[str, tuple[str, float]] = {
    "radius-difference": ("difference", 1.0),
    "radius-difference-factor": ("share", 1.0),
    "centre-shift": ("shift", 1.0),
    "centre-shift-share": ("shift_share", 0.01),
}
"""The fields that settings with a number state, each with what 1 of the number is."""

CENTRES = "arc-centre"
"""The setting of from where the words of a centre count."""
