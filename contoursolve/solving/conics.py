"""Equations of degree 2 as expressions: affine ones by determinants, and a conic on the line that they leave."""

from collections.abc import Iterable, Sequence
from typing import Any

from contoursolve.numeric import Expression, is_number

Monomial = tuple[int, ...]
Row = dict[Monomial, Expression]
"""A polynomial: its coefficients by monomial, without those that are always zero."""

Matrix = list[list[Expression | None]]
Column = list[Expression | None]
"""None is zero."""


def separate(rows: Sequence[Row]) -> tuple[list[Row], list[Row]]:
    """Affine equations and those that are left; affine ones are made of the others as far as numbers alone can."""
    affine = [row for row in rows if _degree(row) < 2]  # noqa: PLR2004 - affine
    rest, done = [row for row in rows if _degree(row) == 2], []  # noqa: PLR2004 - quadratic
    while rest:
        pivots = ((n, key) for n, row in enumerate(rest) for key in row if len(key) > 1 and is_number(row[key]))
        number, monomial = next(pivots, (0, ()))
        pivot = rest.pop(number)
        done.append(pivot)
        if monomial:
            rest = [_without(row, monomial, pivot) for row in rest]
        affine += [row for row in rest if _degree(row) < 2]  # noqa: PLR2004 - affine
        rest = [row for row in rest if _degree(row) == 2]  # noqa: PLR2004 - quadratic
    return affine, done


def _degree(row: Row) -> int:
    return max((len(monomial) for monomial in row), default=0)


def _without(row: Row, monomial: Monomial, pivot: Row) -> Row:
    if monomial not in row:
        return row
    factor = row[monomial] / pivot[monomial]
    found = dict(row)
    for key, value in pivot.items():
        found[key] = found[key] - factor * value if key in found else -(factor * value)
    return {key: value for key, value in found.items() if key != monomial and not is_number(value, 0)}


def determinant(matrix: Matrix) -> Expression | None:
    """The determinant of a matrix, by its first row; None if it is zero by structure."""
    if not matrix:
        return Expression(1.0)
    terms = []
    for column, each in enumerate(matrix[0]):
        if each is None:
            continue
        minor = determinant([[*row[:column], *row[column + 1 :]] for row in matrix[1:]])
        if minor is not None:
            terms.append(each * minor if column % 2 == 0 else -(each * minor))
    return total(terms) if terms else None


def cofactor(matrix: Matrix, column: int) -> Expression | None:
    """The cofactor of an entry of the last row, which the matrix lacks."""
    minor = determinant([[*row[:column], *row[column + 1 :]] for row in matrix])
    return minor if minor is None or (len(matrix) + column) % 2 == 0 else -minor


def replaced(matrix: Matrix, constants: Column, column: int) -> Expression | None:
    """The determinant of a matrix with the right sides in place of a column (Cramer's rule)."""
    pairs = zip(matrix, constants, strict=True)
    return determinant([[*row[:column], None if end is None else -end, *row[column + 1 :]] for row, end in pairs])


def restrict(curve: Row, along: Sequence[Any], through: Sequence[Any]) -> tuple[Any, Any, Any]:
    """The coefficients of a quadratic equation at `through + t * along`: of the square of t, of t, and without it."""
    parts: tuple[list[Any], list[Any], list[Any]] = ([], [], [])
    for monomial, value in curve.items():
        if len(monomial) > 1:
            i, j = monomial
            parts[0].append(value * (along[i] * along[j]))
            parts[1].append(value * (along[i] * through[j] + along[j] * through[i]))
            parts[2].append(value * (through[i] * through[j]))
        elif monomial:
            parts[1].append(value * along[monomial[0]])
            parts[2].append(value * through[monomial[0]])
        else:
            parts[2].append(value)
    leading, middle, last = map(total, parts)
    return leading, middle, last


def total(values: Iterable[Any]) -> Any:
    """The sum of expressions."""
    result: Any = Expression(0.0)
    for each in values:
        result = result + each
    return result


def or_zero(value: Expression | None) -> Expression:
    """An entry of a matrix as an expression."""
    return Expression(0.0) if value is None else value


def or_none(value: Expression) -> Expression | None:
    """An expression as an entry of a matrix."""
    return None if is_number(value, 0) else value
