"""The parts of a system of equations, as records: unknowns, values, equations, conditions, steps, corners."""

from typing import Any

from msgspec import Struct


class Unknown(Struct, frozen=True):
    """An unknown of a system: its symbol (of sympy), what it is, and its unit.

    `value` is what it has in the contour that was solved (mm, X of a lathe as radius); None without one.
    """

    symbol: Any
    meaning: str
    unit: str
    value: float | None
    name: str


class Value(Struct, frozen=True):
    """A value that a word, or the start point, states: its symbol, what it is, as it is typed, and its number.

    `number` is that of the equations: mm, X of a lathe as radius, or an angle in radians, exact, of sympy. None where
    it is not known.
    """

    symbol: Any
    meaning: str
    text: str
    unit: str
    number: Any
    name: str


class Equation(Struct, frozen=True):
    """One equation: of sympy, the word that states it (empty for what the form itself states), and what it says."""

    equation: Any
    word: str
    meaning: str
    line: int = 0
    """Program line of the word; 0 without one."""


class Condition(Struct, frozen=True):
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
    unknowns: tuple[Unknown, ...]
    equations: tuple[Equation, ...]


class TiedWords(Struct, frozen=True):
    """Words that say the same, and the equation of sympy that ties them; None where it has no formula."""

    words: tuple[str, ...]
    identity: Any
