"""Formulas of a calculation by hand, with sympy: each line gives a symbol a value from those before it."""

from collections.abc import Mapping
from typing import Any

import sympy
from sympy.printing.str import StrPrinter

from contoursolve.numeric.symbolic import PositiveFirst


class Calculator:
    """Symbols with their values so far, by which later lines are calculated."""

    def __init__(self, values: Mapping[Any, Any]) -> None:
        self.values = {symbol: sympy.sympify(value) for symbol, value in values.items()}
        self.angles: set[Any] = set()

    def put(self, name: str | Any, formula: Any, *, is_angle: bool = False) -> tuple[Any, float]:
        """A new symbol, or one that is known by its name, with the value of a formula."""
        symbol = sympy.Symbol(name, real=True) if isinstance(name, str) else name
        value = sympy.sympify(formula).xreplace(self.values)
        self.values[symbol] = sympy.Float(float(value), 17)
        if is_angle:
            self.angles.add(symbol)
        return symbol, float(value)

    def value(self, symbol: Any) -> float:
        """The value of a symbol, or of a formula."""
        return float(sympy.sympify(symbol).xreplace(self.values))

    def numbers(self, formula: Any) -> str:
        """A formula with the numbers in place of its symbols, angles in degrees."""
        return str(_Numbers(self).doprint(sympy.sympify(formula))).replace("**", "^")


class _Numbers(PositiveFirst, StrPrinter):  # type: ignore[misc]
    """Text of a formula with numbers for symbols."""

    def __init__(self, sheet: Calculator) -> None:
        super().__init__()
        self._sheet = sheet

    def _print_Symbol(self, symbol: Any) -> str:  # noqa: N802 - the name that sympy looks for
        value = float(self._sheet.values[symbol])
        if symbol in self._sheet.angles:
            return f"{short(value * 180 / float(sympy.pi))} deg"
        text = short(value)
        return f"({text})" if text.startswith("-") else text


def short(value: float) -> str:
    """A number with up to four decimals."""
    text = f"{value:z.4f}"
    return text.rstrip("0").rstrip(".")


def tangent(angle: Any) -> Any:
    """The tangent of an angle."""
    return sympy.tan(angle)


def sine(angle: Any) -> Any:
    """The sine of an angle."""
    return sympy.sin(angle)


def cosine(angle: Any) -> Any:
    """The cosine of an angle."""
    return sympy.cos(angle)


def arcsine(value: Any) -> Any:
    """The angle whose sine is a value."""
    return sympy.asin(value)


PI = sympy.pi


def root(value: Any) -> Any:
    """The square root."""
    return sympy.sqrt(value)


def heading(second: Any, first: Any) -> Any:
    """The angle of a direction from its parts along the second and the first axis."""
    return sympy.atan2(second, first)


def solve_linear(residuals: list[Any], unknowns: list[Any]) -> list[Any] | None:
    """The formulas of unknowns from residuals that are linear in them; None if there are none."""
    found = sympy.solve(residuals, unknowns, dict=True)
    if len(found) != 1 or any(each not in found[0] for each in unknowns):
        return None
    return [sympy.trigsimp(found[0][each]) for each in unknowns]
