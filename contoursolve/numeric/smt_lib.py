"""Equations of sympy in SMT-LIB 2.7: logic QF_NRA, polynomials over real numbers."""

from collections.abc import Mapping
from typing import Any

import sympy

_DIGITS = 30
"""Decimals of the bounds of a cosine that is no simple number."""


class Script:
    """Commands for a solver: each symbol of sympy once, then what holds. An angle is its cosine and its sine."""

    def __init__(self, meanings: Mapping[Any, str]) -> None:
        self._meanings = meanings
        self._declared: dict[str, None] = {}
        self.lines: list[str] = []

    def equal(self, equation: Any, name: str = "") -> None:
        """That both sides of an equation are equal, under a name for unsatisfiable cores."""
        self._hold(f"(= {self._term(equation.lhs)} {self._term(equation.rhs)})", name)

    def positive(self, expression: Any, name: str = "") -> None:
        """That an expression is more than zero."""
        self._hold(f"(> {self._term(expression)} 0.0)", name)

    def value(self, symbol: Any, number: Any) -> None:
        """The number of a symbol, exact."""
        self._hold(f"(= {self._term(symbol)} {_number(number)})")

    def sign(self, symbol: Any) -> None:
        """That a symbol is 1 or -1."""
        term = self._term(symbol)
        self._hold(f"(or (= {term} 1.0) (= {term} (- 1.0)))")

    def angle(self, symbol: Any, radians: Any) -> None:
        """The value of an angle: its cosine and its sine, exact where they are rational numbers, else within 1e-30."""
        for function in (sympy.cos, sympy.sin):
            term, exact = self._term(function(symbol)), function(radians)
            if exact.is_Rational:
                self._hold(f"(= {term} {_number(exact)})")
            else:
                low = sympy.floor(exact * 10**_DIGITS)
                bounds = (sympy.Rational(low + more, 10**_DIGITS) for more in (0, 1))
                self._hold("(and (<= {} {t}) (<= {t} {}))".format(*map(_number, bounds), t=term))

    def _hold(self, told: str, name: str = "") -> None:
        self.lines.append(f"(assert (! {told} :named |{name}|))" if name else f"(assert {told})")

    def _declare(self, name: str, meaning: str) -> bool:
        """Declare a constant; whether it is new."""
        is_new = name not in self._declared
        if is_new:
            self._declared[name] = None
            self.lines.append(f"(declare-const {name} Real)" + (f" ; {meaning}" if meaning else ""))
        return is_new

    def _term(self, expression: Any) -> str:
        """An expression as a term; what it needs is declared before."""
        return self._written(sympy.expand_trig(sympy.sympify(expression)))

    def _written(self, each: Any) -> str:
        if each.is_Rational:
            return _number(each)
        if each.is_Symbol:
            self._declare(each.name, self._meanings.get(each, ""))
            return str(each.name)
        if isinstance(each, sympy.cos | sympy.sin):
            return self._turned(each)
        if isinstance(each, sympy.Abs):
            term = self._written(each.args[0])
            return f"(ite (>= {term} 0.0) {term} (- {term}))"
        if each.is_Pow:
            return self._power(each)
        if each.is_Add or each.is_Mul:
            return f"({'+' if each.is_Add else '*'} {' '.join(map(self._written, each.args))})"
        raise ValueError(f"{each} is no polynomial")

    def _turned(self, each: Any) -> str:
        """The cosine or the sine of an angle, on the circle of radius 1."""
        (angle,) = each.args
        if not angle.is_Symbol:
            raise ValueError(f"{each} is no polynomial")
        cosine, sine = (f"{part}_{angle.name}" for part in ("cos", "sin"))
        if self._declare(cosine, self._meanings.get(angle, "")):
            self._declare(sine, "")
            self._hold(f"(= (+ (* {cosine} {cosine}) (* {sine} {sine})) 1.0)")
        return cosine if isinstance(each, sympy.cos) else sine

    def _power(self, each: Any) -> str:
        base, exponent = each.as_base_exp()
        if exponent == sympy.Rational(1, 2):
            inside, root = self._written(base), f"root_{len(self._declared) + 1}"
            self._declare(root, "")
            self._hold(f"(and (>= {root} 0.0) (= (* {root} {root}) {inside}))")
            return root
        if exponent.is_Integer and exponent > 0:
            return f"(* {' '.join([self._written(base)] * int(exponent))})"
        raise ValueError(f"{each} is no polynomial")


def _number(number: Any) -> str:
    """A rational number as a term of reals."""
    whole = sympy.Rational(number)
    size = f"{abs(whole.p)}.0" if whole.q == 1 else f"(/ {abs(whole.p)}.0 {whole.q}.0)"
    return f"(- {size})" if whole < 0 else size
