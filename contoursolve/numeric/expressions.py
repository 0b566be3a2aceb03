"""CasADi: builds expressions of named inputs and evaluates them through raw buffers."""

import threading
from array import array
from collections.abc import Iterable, KeysView, Mapping, Sequence
from functools import reduce
from math import inf, isfinite
from typing import Any

import casadi
import numpy
from numpy.typing import NDArray

from contoursolve.numeric.echelon import Echelon


class Expression:
    """A scalar expression of CasADi.

    CasADi's own operators first try whether their operands are other kinds of matrices: 11 us an operation, where
    this takes 2 us.
    """

    __slots__ = ("sx",)

    def __init__(self, sx: Any) -> None:
        self.sx = sx

    def __add__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_ADD, self, other)

    def __radd__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_ADD, other, self)

    def __sub__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_SUB, self, other)

    def __rsub__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_SUB, other, self)

    def __mul__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_MUL, self, other)

    def __rmul__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_MUL, other, self)

    def __truediv__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_DIV, self, other)

    def __rtruediv__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_DIV, other, self)

    def __pow__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_POW, self, other)

    def __neg__(self) -> "Expression":
        return _unary(casadi.OP_NEG, self)

    def __le__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_LE, self, other)

    def __lt__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_LT, self, other)

    def __gt__(self, other: Any) -> "Expression":
        return _binary(casadi.OP_LT, other, self)


def _sx(value: Any) -> Any:
    """CasADi's matrix behind an expression; a number is its own."""
    return value.sx if isinstance(value, Expression) else value


def _unary(operation: int, value: Any) -> Expression:
    return Expression(casadi.SX.unary(operation, _sx(value)))


def _binary(operation: int, first: Any, second: Any) -> Expression:
    return Expression(casadi.SX.binary(operation, _sx(first), _sx(second)))


def _stack(values: Iterable[Any]) -> Any:
    """Scalars, and vectors, as one vector."""
    parts = [*map(_sx, values)]
    stacked = parts[0] if len(parts) == 1 else casadi.vertcat(*parts)
    return stacked if isinstance(stacked, casadi.SX) else casadi.SX(stacked)  # of numbers alone it is another matrix


def sqrt(value: Any) -> Expression:
    """Square root; NaN below zero."""
    return _unary(casadi.OP_SQRT, value)


def cosine(value: Any) -> Expression:
    """Cosine of an angle in radians."""
    return _unary(casadi.OP_COS, value)


def sine(value: Any) -> Expression:
    """Sine of an angle in radians."""
    return _unary(casadi.OP_SIN, value)


def sign(value: Any) -> Expression:
    """-1, 0 or 1."""
    return _unary(casadi.OP_SIGN, value)


def angle(sine_part: Any, cosine_part: Any) -> Expression:
    """The angle with this sine and cosine (of any common length), -pi to pi."""
    return _binary(casadi.OP_ATAN2, sine_part, cosine_part)


def magnitude(value: Any) -> Expression:
    """Absolute value."""
    return _unary(casadi.OP_FABS, value)


def larger(first: Any, second: Any) -> Expression:
    """The larger of two."""
    return _binary(casadi.OP_FMAX, first, second)


def where(condition: Any, then: Any, otherwise: Any) -> Expression:
    """`then` where the condition is true."""
    chosen, other = _if(condition, then), _if(opposite(condition), otherwise)
    return chosen + other


def _if(condition: Any, value: Any) -> Expression:
    """A value where the condition is true, else 0."""
    return _binary(casadi.OP_IF_ELSE_ZERO, condition, value)


def at_most(first: Any, second: Any) -> Expression:
    """1 if the first is not larger, else 0; also 0 for what is not a number."""
    return _binary(casadi.OP_LE, first, second)


def below(first: Any, second: Any) -> Expression:
    """1 if the first is smaller, else 0; also 0 for what is not a number."""
    return _binary(casadi.OP_LT, first, second)


def opposite(condition: Any) -> Expression:
    """1 where a condition is 0, else 0."""
    return _unary(casadi.OP_NOT, condition)


def true() -> Expression:
    """1, from which conditions are multiplied.

    A product is computed on columns in a fifth of the time of a logical operation.
    """
    return Expression(casadi.SX(1))


def largest(values: Iterable[Any]) -> Expression:
    """The largest absolute value; NaN if any value is, and 0 of none."""
    sizes = [size for size in map(magnitude, values) if not size.sx.is_zero()]
    if len(sizes) < 2:  # noqa: PLR2004 - nothing to compare
        return sizes[0] if sizes else Expression(casadi.SX(0))
    total = reduce(Expression.__add__, sizes)
    # The larger of two is the one that is a number.
    return reduce(larger, sizes) + _if(opposite(below(total, inf)), total)


def is_zero(value: Any) -> Expression:
    """1 if a value is exactly zero, else 0, as an expression."""
    return _binary(casadi.OP_EQ, value, 0)


def is_number(value: Expression, number: float | None = None) -> bool:
    """Whether an expression is a number, or this one."""
    sx = value.sx
    if isinstance(sx, casadi.SX) and not sx.is_constant():
        return False
    return number is None or float(sx) == number


class Tape:
    """Collects the inputs and outputs of one function under construction."""

    def __init__(self) -> None:
        self._inputs: dict[str, Expression] = {}
        self._outputs: dict[str, Any] = {}

    def input(self, name: str) -> Expression:
        """The symbol of an input; the first request creates it."""
        if name not in self._inputs:
            self._inputs[name] = symbol(name)
        return self._inputs[name]

    def output(self, name: str, expression: Any) -> None:
        """Declare an output."""
        self._outputs[name] = expression

    @property
    def inputs(self) -> tuple[str, ...]:
        """The names of the inputs, in order."""
        return tuple(self._inputs)

    def expression(self, name: str) -> Any:
        """The expression of an output."""
        return self._outputs[name]

    def replaced(self, inputs: Mapping[str, Any], outputs: Mapping[str, Any]) -> tuple[list[Any], list[Any]]:
        """The inputs that stay, and expressions of this tape with the others replaced."""
        names = [name for name in self._inputs if name in inputs]
        known, new = _stack(self._inputs[name] for name in names), _stack(inputs[name] for name in names)
        expressions = casadi.substitute(_stack(outputs.values()), known, new)
        stay = [each for name, each in self._inputs.items() if name not in inputs]
        return stay, [Expression(expressions[number]) for number in range(len(outputs))]

    def function(self) -> Any:
        """The CasADi function of all inputs, as one vector, to all outputs, as another."""
        inputs = _stack(self._inputs.values()) if self._inputs else casadi.SX(0, 1)
        outputs = casadi.densify(_stack(self._outputs.values()))
        return casadi.Function("contour", [inputs], [outputs])

    def shared(self) -> Any:
        """The same function, in which what several outputs have in common is computed once."""
        outputs = casadi.densify(_stack(self._outputs.values()))
        return casadi.Function("contour", [_stack(self._inputs.values())], [casadi.cse(outputs)])

    def keep(self, outputs: Iterable[str] = ()) -> "Tape":
        """A tape of its own with the same inputs, and these outputs in this order."""
        return self.of(self._inputs, outputs)

    def of(self, inputs: Iterable[str], outputs: Iterable[str]) -> "Tape":
        """A tape of its own with these inputs and outputs, in this order."""
        chosen = Tape()
        chosen._inputs = {name: self._inputs[name] for name in inputs}
        chosen._outputs = {name: self._outputs[name] for name in outputs}
        return chosen

    def copy(self) -> "Tape":
        """A tape of its own with the same inputs and outputs."""
        return self.keep(self._outputs)

    def slopes(self, outputs: Sequence[str], inputs: Sequence[str]) -> "Compiled":
        """The derivatives of some outputs by some inputs, as outputs named `output by input`."""
        jacobian = casadi.densify(
            casadi.jacobian(
                _stack(self._outputs[name] for name in outputs), _stack(self._inputs[name] for name in inputs)
            )
        )
        function = casadi.Function("slopes", [_stack(self._inputs.values())], [casadi.vec(jacobian.T)])
        return Compiled(function, self.inputs, tuple(f"{output} by {name}" for output in outputs for name in inputs))

    @property
    def outputs(self) -> KeysView[str]:
        """The names of the outputs, in order."""
        return self._outputs.keys()

    def finish(self) -> "Compiled":
        """The function of all inputs and outputs."""
        return Compiled(self.function(), self.inputs, tuple(self._outputs))


def symbol(name: str) -> Expression:
    """A fresh symbol."""
    return Expression(casadi.SX.sym(name))


def affine_parts(residuals: Sequence[Any], unknowns: Sequence[Any]) -> tuple[list[list[Expression]], list[Expression]]:
    """(matrix, constants) of residuals that are affine in the unknowns: residual = matrix @ u + constant."""
    stacked, symbols = _stack(residuals), _stack(unknowns)
    jacobian = casadi.densify(casadi.jacobian(stacked, symbols))
    constants = casadi.substitute(stacked, symbols, casadi.SX.zeros(len(unknowns)))
    size = range(len(residuals)), range(len(unknowns))
    return (
        [[Expression(jacobian[i, j]) for j in size[1]] for i in size[0]],
        [Expression(constants[i]) for i in size[0]],
    )


def is_affine(residuals: Sequence[Any], unknowns: Sequence[Any]) -> bool:
    """Whether residuals are affine in the unknowns (symbols), so that `affine_parts` are free of them."""
    symbols = _stack(unknowns)
    return not casadi.depends_on(casadi.jacobian(_stack(residuals), symbols), symbols)


def jacobian_parts(
    residuals: Sequence[Any], unknowns: Sequence[Any], at: Sequence[Any]
) -> dict[tuple[int, int], Expression]:
    """Non-zero entries of the derivative of residuals by unknowns (symbols), at expressions `at`."""
    stacked, symbols = _stack(residuals), _stack(unknowns)
    jacobian = casadi.substitute(casadi.jacobian(stacked, symbols), symbols, _stack(at))
    rows, columns = jacobian.sparsity().get_triplet()
    return {(row, column): Expression(jacobian[row, column]) for row, column in zip(rows, columns, strict=True)}


def with_slopes(residuals: Sequence[Any], unknowns: Sequence[Any]) -> tuple[Expression, bool]:
    """Residuals and then their derivatives by unknowns (symbols), row by row, as one vector; and whether the
    derivatives are free of the unknowns."""
    stacked, symbols = _stack(residuals), _stack(unknowns)
    jacobian = casadi.jacobian(stacked, symbols)
    is_affine = jacobian.is_constant() or not casadi.depends_on(jacobian, symbols)
    rows = jacobian if jacobian.is_scalar() else casadi.vec(casadi.densify(jacobian).T)
    return Expression(casadi.vertcat(stacked, rows)), is_affine


def quadratic_parts(
    residuals: Sequence[Any], unknowns: Sequence[Any]
) -> dict[tuple[int, tuple[int, ...]], Expression] | None:
    """The coefficients of polynomials of degree 2 by (residual, monomial); None if one is of another kind.

    A monomial names the unknowns that are multiplied, by their index in order: `(0, 0)`, `(1,)`, `()`.
    """
    symbols, zero = _stack(unknowns), casadi.SX.zeros(len(unknowns))
    parts: dict[tuple[int, tuple[int, ...]], Expression] = {}
    for number, residual in enumerate(map(_sx, residuals)):
        hessian, gradient = casadi.hessian(residual, symbols)
        if casadi.which_depends(casadi.vec(hessian), symbols, 1, False).count(True):
            return None
        parts[number, ()] = Expression(casadi.substitute(residual, symbols, zero))
        at_zero = casadi.substitute(gradient, symbols, zero)
        for row in set(gradient.sparsity().row()):
            parts[number, (row,)] = Expression(at_zero[row, 0])
        for row, column in zip(*hessian.sparsity().get_triplet(), strict=True):
            if row <= column:
                parts[number, (row, column)] = Expression(hessian[row, column]) / (2 if row == column else 1)
    return parts


class Compiled:
    """A CasADi function with names for its inputs and outputs.

    It is called through `Function.buffer()`, which costs 0.3 us where arrays cost 16 us. A buffer is
    not shared between threads.
    """

    def __init__(self, function: Any, inputs: tuple[str, ...], outputs: tuple[str, ...]) -> None:
        self.function = function
        self._local = threading.local()
        self.inputs = inputs
        self.outputs = outputs

    def __call__(self, values: Mapping[str, float]) -> dict[str, float]:
        """All outputs by name at the inputs by name."""
        local = self._ready()
        local.arguments[:] = array("d", [values[name] for name in self.inputs])
        local.trigger()
        return dict(zip(self.outputs, local.results.tolist(), strict=True))

    def rows(self, inputs: Sequence[Sequence[float]]) -> NDArray[numpy.float64]:
        """All outputs (row, output) at rows of inputs, to the last bit as one by one."""
        local = self._ready()
        found = numpy.empty((len(inputs), len(self.outputs)))
        for row, result in zip(inputs, found, strict=True):
            local.arguments[:] = array("d", row)
            local.trigger()
            result[:] = local.results
        return found

    def _ready(self) -> Any:
        """The buffer of this thread."""
        local = self._local
        if not hasattr(local, "trigger"):
            local.arguments = array("d", [0.0]) * len(self.inputs)
            local.results = array("d", [0.0]) * len(self.outputs)
            local.buffer, local.trigger = self.function.buffer()
            local.buffer.set_arg(0, memoryview(local.arguments))
            local.buffer.set_res(0, memoryview(local.results))
        return local


_DENSE = 100
"""Rows up to which a matrix is inverted as a whole, and entries of a row, on average, up to which its inverse is taken
row by row: from there on, it is as good as full."""


def inverse_norm(entries: Mapping[tuple[int, int], float], size: int) -> float:
    """Largest row sum of the absolute inverse of a square matrix; infinite if it is singular."""
    if size > _DENSE:
        found = _sparse_inverse_norm(entries, size)
        if found is not None:
            return found
    matrix = numpy.zeros((size, size))
    for (row, column), value in entries.items():
        matrix[row, column] = value
    try:
        # The ufuncs themselves, for a matrix is as small as their wrappers are slow.
        return float(numpy.maximum.reduce(numpy.add.reduce(numpy.abs(numpy.linalg.inv(matrix)), axis=1)))
    except numpy.linalg.LinAlgError:
        return float("inf")


def _sparse_inverse_norm(entries: Mapping[tuple[int, int], float], size: int) -> float | None:
    """The same for a matrix whose inverse is mostly zero, as that of a chain with points that are known; None for
    another one, and for what is no number."""
    rows: list[dict[int, float]] = [{-1 - row: -1.0} for row in range(size)]
    for (row, column), value in entries.items():
        if not isfinite(value):
            return None
        if value:
            rows[row][column] = value
    echelon = Echelon(0.0)
    for number, each in enumerate(rows):
        if echelon.add(number, each) is not None:
            return float("inf")
        if echelon.size > _DENSE * size:
            return None
    return max(sum(map(abs, row.values())) for row in echelon.solved(range(size)).values())


def inverse_norms(
    entries: Mapping[tuple[int, int], NDArray[numpy.float64]], size: int, rows: int
) -> NDArray[numpy.float64]:
    """`inverse_norm` of so many matrices, whose entries are columns; infinite for all if one is singular."""
    matrices = numpy.zeros((rows, size, size))
    for (row, column), values in entries.items():
        matrices[:, row, column] = values
    try:
        return numpy.asarray(numpy.abs(numpy.linalg.inv(matrices)).sum(axis=2).max(axis=1))
    except numpy.linalg.LinAlgError:
        return numpy.full(rows, numpy.inf)


def inverse(rows: Sequence[Sequence[float]]) -> list[list[float]] | None:
    """The inverse of a square matrix; None if it is singular or not finite."""
    try:
        found = numpy.linalg.inv(numpy.array(rows))
    except numpy.linalg.LinAlgError:
        return None
    return found.tolist() if numpy.isfinite(found).all() else None
