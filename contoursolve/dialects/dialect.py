"""What a control is: a record of tables, and how its contours are found among the blocks."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from contoursolve.model import Length, Plane
from contoursolve.reading import Claim, Form, Modes, Position, Setting, State
from contoursolve.rules import Rule
from contoursolve.syntax import Block, Word

Finder = Callable[[Sequence[Block], int, State, Modes], Claim | None]
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
    signs: Callable[[Block], Sequence[Word]]
    """The words of a block by which it can only be meant for this control."""
    contours: str = ""
    """What shows a contour block, for a reader."""
    settings: tuple[Setting, ...] = ()
    """Conventions on which the manual is silent."""
    has_runs: bool = True
    """Whether a contour may be several blocks in a row."""

    def configure(self, values: Mapping[str, str]) -> "Dialect":
        """The control with other values of its settings.

        Raises ValueError, naming what there is, if there is no such setting or no such value.
        """
        known = {setting.name: setting for setting in self.settings}
        for name, value in values.items():
            if name not in known:
                names = ", ".join(known) or "none"
                raise ValueError(f"{self.name} has no setting {name!r}; settings are: {names}")
            if value not in known[name].values:
                choices = ", ".join(known[name].values)
                raise ValueError(f"{self.name}.{name} cannot be {value!r}; values are: {choices}")
        return replace(self, modes=replace(self.modes, settings={**self.modes.settings, **values}))

    def initial_state(self, unit: Length) -> State:
        """The state before the first block: the position is not known, nothing is compensated."""
        reason = "nothing before it gives an absolute position"
        axes = {axis: Position(None, reason) for axis in self.modes.axes}
        return State(axes, None, self.plane, unit, is_incremental=False, compensation=40)
