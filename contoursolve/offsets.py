"""How far the tool is from where the original program has it, behind a contour whose end was rounded."""

from collections.abc import Sequence
from itertools import count
from math import hypot, sqrt

from contoursolve.model import Length
from contoursolve.reading import Effect, Modes, State, apply_modes, codes_of
from contoursolve.syntax import Block, Word
from contoursolve.tolerance import ARC_START


class Offsets:
    """The axes that are off, mm (X of a lathe as radius)."""

    def __init__(self, modes: Modes) -> None:
        self.modes = modes
        self._off: dict[str, float] = {}

    def __bool__(self) -> bool:
        return bool(self._off)

    def leave(self, axes: Sequence[str], here: Sequence[float], end: Sequence[float]) -> None:
        """The tool is here, and the original program has it at the end of a contour."""
        self._off |= {axis: at - exact for axis, at, exact in zip(axes, here, end, strict=True) if at != exact}

    def take(self, axes: Sequence[str]) -> list[float]:
        """How far these axes are off; what follows puts them in their places."""
        return [self._off.pop(axis, 0.0) for axis in axes]

    def keep(self, axes: Sequence[str]) -> None:
        """All other axes are put in their places."""
        self._off = {axis: off for axis, off in self._off.items() if axis in axes}

    def update(self, block: Block, state: State) -> str:
        """A block that stays as it is: an absolute word puts an axis in its place. What is wrong with an arc that
        begins too far off, if anything is."""
        here = apply_modes(state, block, self.modes)
        if any(not isinstance(code, Word) and code.effect is Effect.NO_MOTION for code in codes_of(block, self.modes)):
            return ""
        off = hypot(*(self._off.get(axis, 0.0) for axis in here.plane.axes))
        is_arc = here.motion in (2, 3) and any(word.address in (*here.plane.centers, "R") for word in block.words)
        rows = [self.modes.lexicon.addresses.get(word.address) for word in block.words]
        moved = [row.axis for row in rows if row and row.axis and not (row.is_increment or here.is_incremental)]
        self.keep([axis for axis in self._off if axis not in moved])
        if not is_arc or off <= self.modes.radius_difference * ARC_START:
            return ""
        least = least_decimals(here.unit, self.modes.radius_difference)
        return (
            f"its arc begins where the contour before it ends, which is rounded by {off:.2g} mm: take {least} decimals"
        )


def least_decimals(unit: Length, allowed: float) -> int:
    """Of the end of a contour, so that an arc behind it begins near enough to its place, where the radii at its ends
    may differ by so much, mm."""
    return next(digits for digits in count(1) if 10.0**-digits * float(unit.in_mm) * sqrt(0.5) <= allowed * ARC_START)
