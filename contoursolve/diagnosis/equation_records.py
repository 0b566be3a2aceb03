"""The parts of a system of equations, as records: unknowns, values, equations, conditions, steps, corners."""

from typing import Any

from msgspec import Struct

from contoursolve.gcode import Word


def _latex_of(expression: Any) -> str:
    """An expression of sympy as a notebook shows it."""
    text: str = expression._repr_latex_()
    return text


class SystemUnknown(Struct, frozen=True):
    """An unknown of a system: its symbol (of sympy), what it is, and its unit.

    `value` is what it has in the contour that was solved (mm, X of a lathe as radius); None without one.
    """

    symbol: Any
    meaning: str
    unit: str
    value: float | None
    name: str

    def _sympy_(self) -> Any:
        return self.symbol

    def _repr_latex_(self) -> str:
        return _latex_of(self.symbol)


class SystemValue(Struct, frozen=True):
    """A value that a word, or the start point, states: its symbol, what it is, its unit, and its number.

    `number` is that of the equations: mm, X of a lathe as radius, or an angle in radians, exact, of sympy. None where
    it is not known. `source` is the word; None for the start point and for what the control supplies by itself.
    """

    symbol: Any
    meaning: str
    unit: str
    number: Any
    name: str
    source: Word | None = None

    def _sympy_(self) -> Any:
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

    equation: Any
    meaning: str
    source: Word | None = None

    def _sympy_(self) -> Any:
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

    expression: Any
    value: float | None
    meaning: str
    determines: tuple[Any, ...]


class SystemStep(Struct, frozen=True):
    """A step in which a system is solved: the unknowns that it finds, from which equations, and how."""

    unknowns: tuple[Any, ...]
    equations: tuple[Equation, ...]
    how: str
    is_closed: bool


class CornerSystem(Struct, frozen=True):
    """A corner: its name, the unknowns of where it begins, ends and has its centre, and the equations between them."""

    name: str
    unknowns: tuple[SystemUnknown, ...]
    equations: tuple[Equation, ...]


class TiedWords(Struct, frozen=True):
    """Words that say the same, the equation of sympy that ties them (None where it has no formula), and whether their
    values disagree."""

    words: tuple[str, ...]
    identity: Any
    is_conflict: bool = False
