"""The modal state of a control: where the tool is, and what is in force."""

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal

from contoursolve.model import Length, Plane, Start
from contoursolve.source import Span


@dataclass(frozen=True, slots=True)
class Position:
    """One coordinate in mm (X of a lathe as radius), or None with the reason why it is not known.

    `span` is the place in the program that set it or made it unknown.
    """

    value: Decimal | None
    reason: str
    span: Span | None = None
    is_skippable: bool = False
    """The block that set it begins with `/`."""


@dataclass(frozen=True, slots=True)
class State:
    """What is in force before a block."""

    axes: Mapping[str, Position]
    motion: int | None
    plane: Plane
    unit: Length
    is_incremental: bool
    compensation: int
    """40, 41 or 42."""

    def start(self) -> Start:
        """The position in the plane."""
        first, second = (self.axes[axis].value for axis in self.plane.axes)
        return Start((first, second))

    def move(self, changes: Mapping[str, Position]) -> "State":
        """The state with other positions on some axes."""
        if not changes:
            return self
        axes = {**self.axes, **changes}
        return State(axes, self.motion, self.plane, self.unit, self.is_incremental, self.compensation)

    def lose(self, axes: Mapping[str, Position] | tuple[str, ...], reason: str, span: Span) -> "State":
        """The state with the position on these axes unknown."""
        return self.move({axis: Position(None, reason, span) for axis in axes})
