"""Sympy: the exact, generic properties of a system's equations."""

import random
from collections.abc import Sequence
from typing import Any

import sympy
from sympy.polys.domains import QQ
from sympy.polys.matrices import DomainMatrix

from contoursolve.numeric.functions import Functions
from contoursolve.numeric.modular_rank import ExactRank

FUNCTIONS = Functions(sympy.sqrt, sympy.cos, sympy.sin)


class Symbols:
    """Sympy symbols for every scalar, amount, direction and side, created when a formula asks for them."""

    def __init__(self) -> None:
        self._symbols: dict[str, Any] = {}
        self._angles: dict[str, Any] = {}

    def scalar(self, name: str) -> Any:
        """The symbol of a coordinate, a radius, an amount, or a part of a line."""
        return self._symbols.setdefault(name, sympy.Symbol(name, real=True))

    def direction(self, given: str) -> tuple[Any, Any]:
        """Cosine and sine of a given angle's symbol."""
        angle = self._angles.setdefault(given, sympy.Symbol(given, real=True))
        return sympy.cos(angle), sympy.sin(angle)

    def random_point(self, seed: int) -> dict[Any, Any]:
        """A rational value for every symbol; angles and directions of lines get rational cosines and sines."""
        draw = random.Random(seed)
        point: dict[Any, Any] = {}

        def direction() -> tuple[Any, Any]:
            t = sympy.Rational(draw.randint(1, 9_999), draw.randint(1, 9_999))
            return (1 - t**2) / (1 + t**2), 2 * t / (1 + t**2)

        for angle in self._angles.values():
            point[sympy.cos(angle)], point[sympy.sin(angle)] = direction()
        for name, symbol in self._symbols.items():
            line, _, part = name.rpartition(".")
            if symbol in point:
                continue
            if part in ("cos", "sin"):
                point[self.scalar(f"{line}.cos")], point[self.scalar(f"{line}.sin")] = direction()
            else:
                point[symbol] = sympy.Rational(draw.randint(1, 99_999), draw.randint(1, 999))
        return point


def jacobian(residuals: Sequence[Any], unknowns: Sequence[Any]) -> Any:
    """Matrix of derivatives, shape (residuals, unknowns)."""
    return sympy.Matrix(len(residuals), len(unknowns), lambda row, column: sympy.diff(residuals[row], unknowns[column]))


def exact_rank(matrix: Any, point: dict[Any, Any]) -> ExactRank:
    """Rank and null spaces of a matrix at a rational point, without rounding."""
    numbers = matrix.xreplace(point)
    rows, columns = numbers.shape
    domain = DomainMatrix(
        [[QQ.from_sympy(numbers[row, column]) for column in range(columns)] for row in range(rows)],
        (rows, columns),
        QQ,
    )
    right = domain.nullspace().to_Matrix()
    left = domain.transpose().nullspace().to_Matrix()
    pivots = domain.transpose().rref()[1]
    return ExactRank(
        rank=len(pivots),
        independent_rows=tuple(pivots),
        dependent_rows=tuple(row for row in range(rows) if any(left[k, row] for k in range(left.rows))),
        free_columns=tuple(col for col in range(columns) if any(right[k, col] for k in range(right.rows))),
    )


def determinants(matrices: Sequence[Any]) -> str:
    """The distinct factors of the determinants of square matrices, whose zeros are their zeros, as text."""
    factors: dict[Any, None] = {}
    for matrix in matrices:
        numerator, _ = sympy.fraction(sympy.factor(sympy.trigsimp(matrix.det(method="berkowitz"))))
        factors |= dict.fromkeys(sympy.trigsimp(base) for base, _ in sympy.factor_list(numerator)[1])
    return str(sympy.Mul(*factors))


def eliminate(residuals: Sequence[Any], unknowns: Sequence[Any], wanted: Any) -> str:
    """`wanted` as a formula from residuals that are affine in it and in the unknowns, as text; empty if none."""
    used = [unknown for unknown in unknowns if any(residual.has(unknown) for residual in residuals)]
    for solution in sympy.solve(residuals, [*used, wanted], dict=True):
        if wanted in solution and not any(solution[wanted].has(unknown) for unknown in used):
            return str(sympy.trigsimp(sympy.simplify(solution[wanted])))
    return ""


def substitute_solution(expression: Any, residuals: Sequence[Any], unknowns: Sequence[Any]) -> str:
    """An expression with the unknowns replaced by what affine residuals make of them, as text `... = 0`."""
    used = [unknown for unknown in unknowns if any(residual.has(unknown) for residual in residuals)]
    solution = sympy.solve(residuals, used, dict=True)
    return f"{sympy.simplify(sympy.expand(expression.subs(solution[0])))} = 0" if solution else ""
