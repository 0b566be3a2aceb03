"""The modal state of a control: where the tool is, and what is in force."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal

from contoursolve.model import Length, Plane, Start
from contoursolve.source import Span
from contoursolve.syntax import Word


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
    word: Word | None = None
    """The axis word that set it, where one did."""


class Awaited(Position):
    """A coordinate that is found when somebody looks at it.

    `wave` counts the contours in a row, each of which begins where the one before it ends, that have to be solved
    before; `find` has them solved.
    """

    __slots__ = ("_depth", "_find", "_found", "wave")
    wave: int
    _find: Callable[[], Position] | None
    _found: Position | None
    _depth: int

    def __init__(self, find: Callable[[], Position], wave: int = 0, depth: int = 0) -> None:
        for name, value in (("_find", find), ("_found", None), ("wave", wave), ("_depth", depth)):
            object.__setattr__(self, name, value)

    def found(self) -> Position:
        """The position."""
        if self._found is None and self._find is not None:
            object.__setattr__(self, "_found", self._find())
            object.__setattr__(self, "_find", None)
            object.__setattr__(self, "wave", 0)
        if self._found is None:
            raise ValueError("the position has not been found")
        return self._found

    def then(self, follow: Callable[[Position], Position]) -> Position:
        """A position that follows from this one."""
        if self._found is not None or self._depth >= _DEEPEST:
            return follow(self.found())
        return Awaited(lambda: follow(self.found()), self.wave, self._depth + 1)

    @property
    def value(self) -> Decimal | None:
        return self.found().value

    @property
    def reason(self) -> str:
        return self.found().reason

    @property
    def span(self) -> Span | None:
        return self.found().span

    @property
    def is_skippable(self) -> bool:
        return self.found().is_skippable

    @property
    def word(self) -> Word | None:
        return self.found().word


_DEEPEST = 50
"""Positions that each follow from the one before, of which none is looked at."""


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
        first, second = self.plane.axes
        return Start((self.axes[first].value, self.axes[second].value))

    def move(self, changes: Mapping[str, Position]) -> "State":
        """The state with other positions on some axes."""
        if not changes:
            return self
        axes = {**self.axes, **changes}
        return State(axes, self.motion, self.plane, self.unit, self.is_incremental, self.compensation)

    def lose(self, axes: Mapping[str, Position] | tuple[str, ...], reason: str, span: Span) -> "State":
        """The state with the position on these axes unknown."""
        return self.move({axis: Position(None, reason, span) for axis in axes})
