"""Formulas of a calculation by hand, with sympy: each line gives a symbol a value from those before it."""

from collections.abc import Mapping
from math import degrees
from typing import Any

import sympy
from sympy.printing.latex import LatexPrinter
from sympy.printing.str import StrPrinter

from contoursolve.numeric.functions import trimmed
from contoursolve.numeric.symbolic import PositiveFirst, symbol


class Calculator:
    """Symbols with their values so far, by which later lines are calculated."""

    def __init__(self, values: Mapping[Any, Any]) -> None:
        self.values = {symbol: sympy.sympify(value) for symbol, value in values.items()}
        self.angles: set[Any] = set()

    def put(self, name: str | Any, formula: Any, *, is_angle: bool = False) -> tuple[Any, float]:
        """A new symbol, or one that is known by its name, with the value of a formula. Raises ArithmeticError where
        that is no real number."""
        own = symbol(name) if isinstance(name, str) else name
        value = sympy.sympify(formula).xreplace(self.values).evalf(17)
        if not value.is_real:
            raise ArithmeticError(f"{formula} is no real number")
        self.values[own] = sympy.Float(float(value), 17)
        if is_angle:
            self.angles.add(own)
        return own, float(value)

    def value(self, formula: Any) -> float:
        """The value of a formula, or of a symbol."""
        return float(sympy.sympify(formula).xreplace(self.values))

    def numbers(self, formula: Any) -> str:
        """A formula with the numbers in place of its symbols, angles in degrees."""
        return str(_Numbers(self).doprint(sympy.sympify(formula))).replace("**", "^")

    def latex(self, formula: Any) -> str:
        """The same for LaTeX."""
        return str(_LatexNumbers(self).doprint(sympy.sympify(formula)))

    def number(self, own: Any, degree: str) -> str:
        """The value of a symbol as it stands in a formula, an angle with the sign for degrees."""
        value = float(self.values[own])
        if own in self.angles:
            return f"{trimmed(degrees(value), 4)}{degree}"
        text = trimmed(value, 4)
        return f"({text})" if text.startswith("-") else text


class _Numbers(PositiveFirst, StrPrinter):  # type: ignore[misc]
    """Text of a formula with numbers for symbols."""

    def __init__(self, sheet: Calculator) -> None:
        super().__init__()
        self._sheet = sheet

    def _print_Symbol(self, own: Any) -> str:  # noqa: N802 - the name that sympy looks for
        return self._sheet.number(own, " deg")


class _LatexNumbers(PositiveFirst, LatexPrinter):  # type: ignore[misc]
    """LaTeX of a formula with numbers for symbols."""

    def __init__(self, sheet: Calculator) -> None:
        super().__init__({"mul_symbol": "dot"})
        self._sheet = sheet

    def _print_Symbol(self, own: Any, style: str = "plain") -> str:  # noqa: ARG002, N802 - as sympy calls it
        return self._sheet.number(own, "^{\\circ}")


sine, cosine, tangent, arcsine, root, heading, PI = (
    sympy.sin,
    sympy.cos,
    sympy.tan,
    sympy.asin,
    sympy.sqrt,
    sympy.atan2,
    sympy.pi,
)
"""`heading` is the angle of a direction from its parts along the second and the first axis."""


def solve_linear(residuals: list[Any], unknowns: list[Any]) -> list[Any] | None:
    """The formulas of unknowns from residuals that are linear in them; None if there are none."""
    found = sympy.solve(residuals, unknowns, dict=True)
    if len(found) != 1 or any(each not in found[0] for each in unknowns):
        return None
    return [sympy.trigsimp(found[0][each]) for each in unknowns]
