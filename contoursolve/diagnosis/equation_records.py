"""The parts of a system of equations, as records: unknowns, values, equations, conditions, steps, corners."""

from collections.abc import Mapping
from enum import Enum
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from contoursolve.diagnostics import LateModule
from contoursolve.gcode import Word
from contoursolve.numeric import Array
from contoursolve.solving import NullMotion

if TYPE_CHECKING:
    from contoursolve.numeric import symbolic
else:
    symbolic = LateModule("contoursolve.numeric.symbolic")


def _latex_of(expression: Any) -> str:
    """An expression of sympy as a notebook shows it."""
    text: str = expression._repr_latex_()
    return text


class SystemUnknown(Struct, frozen=True):
    """An unknown of a system: its symbol (of sympy), what it is, and its unit.

    `value` is what it has in the contour that was solved (mm, X of a lathe as radius); None without one.
    """

    symbol: "symbolic.Symbol"
    meaning: str
    unit: str
    value: float | None
    name: str

    def _sympy_(self) -> "symbolic.Symbol":
        return self.symbol

    def _repr_latex_(self) -> str:
        return _latex_of(self.symbol)


class SystemValue(Struct, frozen=True):
    """A value that a word, or the start point, states: its symbol, what it is, its unit, and its number.

    `number` is that of the equations: mm, X of a lathe as radius, or an angle in radians, exact, of sympy. None where
    it is not known. `source` is the word; None for the start point and for what the control supplies by itself.
    """

    symbol: "symbolic.Symbol"
    meaning: str
    unit: str
    number: "symbolic.Expr | None"
    name: str
    source: Word | None = None

    def _sympy_(self) -> "symbolic.Symbol":
        return self.symbol

    def _repr_latex_(self) -> str:
        return _latex_of(self.symbol)

    @property
    def text(self) -> str:
        """The word as it is typed; empty without one."""
        return self.source.text.strip() if self.source else ""


class Equation(Struct, frozen=True):
    """One equation, of sympy, and what it says. `source` is the word that states it; None for what the form itself
    states."""

    equation: "symbolic.Eq"
    meaning: str
    source: Word | None = None

    def _sympy_(self) -> "symbolic.Eq":
        return self.equation

    def _repr_latex_(self) -> str:
        return _latex_of(self.equation)

    @property
    def word(self) -> str:
        """The word as it is typed; empty without one."""
        return self.source.text.strip() if self.source else ""


class SystemCondition(Struct, frozen=True):
    """A condition on which one step of a system is determined: an expression of sympy that must not be zero, its value
    at the contour that was solved (None without one), in words what it means, and the symbols that it determines."""

    expression: "symbolic.Expr"
    value: float | None
    meaning: str
    determines: "tuple[symbolic.Symbol, ...]"


class SystemStep(Struct, frozen=True):
    """A step in which a system is solved: the unknowns that it finds, from which equations, and how."""

    unknowns: "tuple[symbolic.Symbol, ...]"
    equations: tuple[Equation, ...]
    how: str
    is_closed: bool


class BlockState(Enum):
    """Fate of a block of a system: its unknowns are found, or stay open, or its equations repeat others."""

    SOLVED = "solved"
    OPEN = "open"
    REPEATED = "repeated"


class SystemBlock(Struct, frozen=True):
    """A block of a system: its equations and its unknowns, by their numbers in `statements` and `unknowns`, which are
    the rows and columns of `jacobian`. No unknowns where it repeats what others say."""

    state: BlockState
    rows: tuple[int, ...]
    columns: tuple[int, ...]


class CornerSystem(Struct, frozen=True):
    """A corner: its name, the unknowns of where it begins, ends and has its centre, and the equations between them."""

    name: str
    unknowns: tuple[SystemUnknown, ...]
    equations: tuple[Equation, ...]


class NullSpace(Struct, frozen=True):
    """The motions that are left, at a drawing of which `values` has the unknowns by their symbols (mm; directions
    have no unit).

    `motions` are independent ways to move, each in mm for each mm of the first point that moves; `texts` say of each
    point that moves how. `numbers` are the same motions in the order of the unknowns, shape (unknowns, motions), and
    `exact` is that as a Matrix of sympy, where a motion moves one unknown, its leading one, by 1. It is None where more
    can move in the drawing than for almost all values, and where its formulas would be too long or divide by nothing.
    """

    values: Mapping["symbolic.Symbol", float]
    motions: tuple[NullMotion, ...]
    texts: tuple[str, ...]
    numbers: Array
    exact: "symbolic.Matrix | None"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, NullSpace) and self._made_of() == other._made_of()

    def __hash__(self) -> int:
        return hash(self.texts)

    def _made_of(self) -> tuple[Any, ...]:
        return self.values, self.motions, self.texts, self.numbers.tolist(), self.exact

    @property
    def dimension(self) -> int:
        """In how many ways it can still move."""
        return len(self.motions)


class TiedWords(Struct, frozen=True):
    """Words that say the same, the equation of sympy that ties them (None where it has no formula), and whether their
    values disagree."""

    words: tuple[str, ...]
    identity: "symbolic.Eq | None"
    is_conflict: bool = False
