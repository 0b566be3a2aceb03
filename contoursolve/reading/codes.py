"""G codes as rows of a table: what each of them does to the modal state."""

from dataclasses import dataclass
from enum import Enum

from contoursolve.model import Length, Plane
from contoursolve.source import Source


class Effect(Enum):
    """What a G code does, as far as contours are concerned."""

    NONE = "none"
    """Changes nothing that matters here; axis words in its block are a motion as always."""
    MOTION = "motion"
    """A motion that ends at the block's coordinates; stays in force."""
    CYCLE = "cycle"
    """A cycle; stays in force until another motion; where it ends is not followed."""
    SINGLE = "single"
    """Acts in its block only and uses the axis words in its own way; where it ends is not known."""
    NO_MOTION = "no-motion"
    """Acts in its block only, and the axis words in it are not coordinates (a dwell, data input)."""
    PRESET = "preset"
    """Declares the coordinates of the present position: afterwards they are the block's."""
    SHIFT = "shift"
    """Changes the coordinate system: all coordinates are unknown afterwards."""
    FRAME = "frame"
    """Changes the coordinate system with the axis words of its block: all coordinates are unknown."""
    PLANE = "plane"
    UNITS = "units"
    ABSOLUTE = "absolute"
    INCREMENTAL = "incremental"
    COMPENSATION = "compensation"
    CONTOUR = "contour"
    """Begins a contour block."""
    CANCEL = "cancel"
    """Ends a cycle."""


@dataclass(frozen=True, slots=True)
class Code:
    """One row: the G code and its effect; `plane` or `unit` is what it selects."""

    number: int
    effect: Effect
    meaning: str
    source: Source
    plane: Plane | None = None
    unit: Length | None = None
