"""Sympy: the exact, generic properties of a system's equations."""

import random
from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from typing import Any

import numpy
import sympy
from sympy import Eq, Expr, Matrix, Symbol
from sympy.polys.domains import QQ
from sympy.polys.matrices import DomainMatrix
from sympy.printing.latex import LatexPrinter
from sympy.printing.mathml import MathMLPresentationPrinter
from sympy.printing.str import StrPrinter

from contoursolve.numeric import expressions
from contoursolve.numeric.functions import Functions
from contoursolve.numeric.linear_algebra import Array
from contoursolve.numeric.modular_rank import ExactRank

__all__ = ["Eq", "Expr", "Matrix", "Symbol"]
"""Classes of sympy that others name in types."""

FUNCTIONS = Functions(sympy.sqrt, sympy.cos, sympy.sin)


class Symbols:
    """Sympy symbols for every scalar, amount, direction and side, created when a formula asks for them; `call` gives
    the name of a symbol."""

    def __init__(self, call: Callable[[str], str] = str) -> None:
        self._call = call
        self._symbols: dict[str, Any] = {}
        self._angles: dict[str, Any] = {}

    def scalar(self, name: str) -> Any:
        """The symbol of a coordinate, a radius, an amount, or a part of a line."""
        if name not in self._symbols:
            self._symbols[name] = symbol(self._call(name))
        return self._symbols[name]

    def angle(self, given: str) -> Any:
        """The symbol of an angle."""
        if given not in self._angles:
            self._angles[given] = symbol(self._call(given))
        return self._angles[given]

    def direction(self, given: str) -> tuple[Any, Any]:
        """Cosine and sine of a given angle's symbol."""
        angle = self.angle(given)
        return sympy.cos(angle), sympy.sin(angle)

    def turned(self) -> dict[Any, Any]:
        """The cosine and the sine of each line whose direction is unknown, as those of an angle by the line's name: so
        sympy knows that the sum of their squares is 1."""
        lines = [name.removesuffix(".cos") for name in self._symbols if name.endswith(".cos")]
        found = dict[Any, Any]()
        for line in lines:
            angle = self.turned_angle(line)
            found |= {self.scalar(f"{line}.cos"): sympy.cos(angle), self.scalar(f"{line}.sin"): sympy.sin(angle)}
        return found

    def turned_angle(self, line: str) -> Any:
        """The angle of a line whose direction is unknown."""
        return symbol(self._call(line))

    def points(self) -> list[tuple[Any, Any]]:
        """The coordinates of each point of which a formula asked for both."""
        names = [name.removesuffix(".0") for name in self._symbols if name.endswith(".0")]
        pairs = ((f"{name}.0", f"{name}.1") for name in names)
        return [(self._symbols[one], self._symbols[two]) for one, two in pairs if two in self._symbols]

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


def exact(value: Decimal, *, is_angle: bool = False) -> Any:
    """A decimal number without rounding; of an angle in degrees, its radians."""
    number = sympy.Rational(str(value))
    return number * sympy.pi / 180 if is_angle else number


def equation(left: Any, right: Any) -> Any:
    """That two expressions are equal."""
    return sympy.Eq(left, right, evaluate=False)


def value_at(expression: Any, values: Mapping[Any, Any]) -> float | None:
    """The number that an expression has at values of its symbols; None where one of these is not known."""
    known = {symbol: sympy.sympify(value) for symbol, value in values.items()}
    found = sympy.sympify(expression).xreplace(known)
    return float(found) if found.is_number else None


def no_motions(unknowns: int) -> Any:
    """The motions of a figure that stands still, by unknowns: a matrix without columns."""
    return sympy.Matrix(unknowns, 0, [])


def balanced(expression: Any) -> Any:
    """The equation that an expression is zero, with what is taken away on the other side."""
    terms = sympy.Add.make_args(expression)
    less = [term for term in terms if term.as_coeff_Mul()[0] < 0]
    if len(less) in (0, len(terms)):
        return equation(expression, 0)
    return equation(sympy.Add(*(term for term in terms if term not in less)), -sympy.Add(*less))


class PositiveFirst:
    """A printer of sums that begin with what is added."""

    def _as_ordered_terms(self, expr: Any, order: Any = None) -> Any:
        terms = super()._as_ordered_terms(expr, order)  # type: ignore[misc]
        return sorted(terms, key=lambda term: bool(term.as_coeff_Mul()[0].is_negative))


class _Text(PositiveFirst, StrPrinter):  # type: ignore[misc]
    """Text."""


class _Latex(PositiveFirst, LatexPrinter):  # type: ignore[misc]
    """LaTeX."""


class _MathML(PositiveFirst, MathMLPresentationPrinter):  # type: ignore[misc]
    """Presentation MathML."""


def text(expression: Any) -> str:
    """An expression, or an equation, in one line."""
    if isinstance(expression, sympy.Eq):
        return f"{text(expression.lhs)} = {text(expression.rhs)}"
    return str(_Text().doprint(expression)).replace("**", "^")


def latex(expression: Any) -> str:
    """The same for LaTeX."""
    return str(_Latex().doprint(expression))


def mathml(expression: Any) -> str:
    """The same as presentation MathML, which browsers draw and screen readers read."""
    return str(_MathML().doprint(expression))


def casadi_of(expression: Any, values: Mapping[Any, Any]) -> Any:
    """An expression as one of CasADi, of values of its symbols that are such."""
    names = sorted(sympy.sympify(expression).free_symbols, key=str)
    own = {"sin": expressions.sine, "cos": expressions.cosine, "sqrt": expressions.sqrt}
    return sympy.lambdify(names, expression, modules=[own, "math"])(*(values[name] for name in names))


MOST_TOGETHER, MOST_SIMPLIFIED, MOST_WRITTEN = 3, 30, 1_000
"""Unknowns of a group whose motion is written down, operations of one that is simplified, and of the largest one."""


def null_space(matrix: Any, groups: Iterable[tuple[Sequence[int], Sequence[int]]], leading: Sequence[int]) -> Any:
    """The motions that a Matrix of derivatives leaves: a column for each leading unknown, which alone of them moves, by
    1. Groups of rows with as many columns determine the others, one after the other. None where a formula would be too
    long to be read."""
    result = sympy.zeros(matrix.cols, len(leading))
    for place, column in enumerate(leading):
        result[column, place] = 1
    for rows, columns in groups:
        if len(columns) > MOST_TOGETHER:
            return None
        own = matrix.extract([*rows], [*columns])
        moved = own.adjugate() * -(matrix.extract([*rows], [*range(matrix.cols)]) * result) / own.det()
        for row, column in enumerate(columns):
            for place in range(len(leading)):
                size = sympy.count_ops(moved[row, place])
                if size > MOST_WRITTEN:
                    return None
                result[column, place] = (
                    sympy.simplify(moved[row, place]) if size <= MOST_SIMPLIFIED else moved[row, place]
                )
    return result


def is_near(matrix: Any, values: Mapping[Any, Any], numbers: Array, most: float) -> bool:
    """Whether a Matrix has these numbers at values of its symbols, each to so much or so large a part."""
    known = {symbol: sympy.sympify(value) for symbol, value in values.items()}
    for place, number in numpy.ndenumerate(numbers):
        found = matrix[place].xreplace(known)
        if not found.is_number or not abs(complex(found.evalf()) - number) <= most * max(1.0, abs(number)):
            return False
    return True


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


def determinant(matrix: Any, symbols: Symbols, known: Mapping[Any, Any]) -> tuple[Any, ...]:
    """The distinct factors of the determinant of a square matrix, whose zeros are its zeros; none if it is a number.

    They are written so that they can be read: directions of lines as angles, cosine and sine of one angle in their
    lowest powers, points by their distances from another one, and `known` unknowns as the words that state them.
    """
    found = _reduced(matrix.det(method="berkowitz").xreplace(symbols.turned()))
    return tuple(dict.fromkeys(_readable(base, symbols, known) for base, _ in sympy.factor_list(found)[1]))


def _reduced(expression: Any) -> Any:
    """An expression with sines and cosines of single angles, in which their squares are told to add up to 1."""
    found = sympy.expand(sympy.expand_trig(expression))
    for angle in sorted({each.args[0] for each in found.atoms(sympy.sin, sympy.cos)}, key=str):
        pair = sympy.sin(angle), sympy.cos(angle)
        rests = (sympy.expand(sympy.rem(found, pair[0] ** 2 + pair[1] ** 2 - 1, each)) for each in pair)
        found = min(found, *rests, key=sympy.count_ops)
    return found


def _readable(factor: Any, symbols: Symbols, known: Mapping[Any, Any]) -> Any:
    """A factor of a condition: of directions alone as the sine or cosine of a difference; else by the distances of
    points from that point for which it is shortest."""
    turned = factor.atoms(sympy.sin, sympy.cos)
    if turned and factor.free_symbols <= {symbol for each in turned for symbol in each.free_symbols}:
        found = sympy.trigsimp(factor)
        return -found if found.could_extract_minus_sign() else found
    places = [pair for pair in symbols.points() if factor.free_symbols & {*pair}]
    forms = [factor, *(_from(place, factor, places, turned) for place in places)]
    shortest = min((form.xreplace(known) for form in forms if form is not None), key=sympy.count_ops)
    return -shortest if shortest.could_extract_minus_sign() else shortest


def _from(place: tuple[Any, Any], factor: Any, places: Sequence[tuple[Any, Any]], turned: Iterable[Any]) -> Any:
    """A factor by the distances of other points from a place; None if it depends on where that lies."""
    moved = factor.xreplace(dict.fromkeys(place, sympy.Integer(0)))
    back = {each: each - own for pair in places if pair != place for each, own in zip(pair, place, strict=True)}
    if sympy.expand(moved.xreplace(back) - factor) != 0:
        return None
    groups = [*(pair for pair in places if pair != place), tuple(sorted(turned, key=str))]
    collected = (sympy.collect(sympy.expand(moved), group) for group in groups if group)
    return min((each.xreplace(back) for each in collected), key=sympy.count_ops)


def factors_of(expression: Any) -> tuple[Any, ...]:
    """The factors of a product."""
    return tuple(sympy.Mul.make_args(expression))


def symbol(name: str) -> Any:
    """The symbol of a real number."""
    return sympy.Symbol(name, real=True)


def product(factors: Iterable[Any]) -> Any:
    """The product of distinct factors."""
    return sympy.Mul(*dict.fromkeys(factors))


def eliminate(residuals: Sequence[Any], unknowns: Sequence[Any], wanted: Any) -> Any:
    """`wanted` as a formula from residuals that are affine in it and in the unknowns; None if there is none."""
    used = [unknown for unknown in unknowns if any(residual.has(unknown) for residual in residuals)]
    for solution in sympy.solve(residuals, [*used, wanted], dict=True):
        if wanted in solution and not any(solution[wanted].has(unknown) for unknown in used):
            return sympy.trigsimp(sympy.simplify(solution[wanted]))
    return None


MOST_REPLACED = 4
"""Unknowns that are replaced by what affine equations make of them."""


def substitute_solution(expression: Any, residuals: Sequence[Any], unknowns: Sequence[Any]) -> Any:
    """An expression with the unknowns replaced by what affine residuals make of them; None if they make nothing, and of
    more than `MOST_REPLACED` unknowns: that takes seconds, and has more terms than anybody reads."""
    used = [unknown for unknown in unknowns if any(residual.has(unknown) for residual in residuals)]
    if len(used) > MOST_REPLACED:
        return None
    solution = sympy.solve(residuals, used, dict=True)
    return sympy.simplify(sympy.expand(expression.subs(solution[0]))) if solution else None
