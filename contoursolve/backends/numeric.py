"""CasADi: builds expressions of named inputs and evaluates them through raw buffers."""

import threading
from collections.abc import Mapping, Sequence
from typing import Any

import casadi
import numpy


def sqrt(value: Any) -> Any:
    """Square root; NaN below zero."""
    return casadi.sqrt(value)


def cosine(value: Any) -> Any:
    """Cosine of an angle in radians."""
    return casadi.cos(value)


def sine(value: Any) -> Any:
    """Sine of an angle in radians."""
    return casadi.sin(value)


def sign(value: Any) -> Any:
    """-1, 0 or 1."""
    return casadi.sign(value)


def magnitude(value: Any) -> Any:
    """Absolute value."""
    return casadi.fabs(value)


def where(condition: Any, then: Any, otherwise: Any) -> Any:
    """`then` where the condition is true."""
    return casadi.if_else(condition, then, otherwise)


def is_zero(value: Any) -> Any:
    """Whether a value is exactly zero, as an expression."""
    return value == 0


class Tape:
    """Collects the inputs and outputs of one function under construction."""

    def __init__(self) -> None:
        self._inputs: dict[str, Any] = {}
        self._outputs: dict[str, Any] = {}

    def input(self, name: str) -> Any:
        """The symbol of an input; the first request creates it."""
        if name not in self._inputs:
            self._inputs[name] = casadi.SX.sym(name)
        return self._inputs[name]

    def output(self, name: str, expression: Any) -> None:
        """Declare an output."""
        self._outputs[name] = expression

    @property
    def inputs(self) -> tuple[str, ...]:
        """The names of the inputs, in order."""
        return tuple(self._inputs)

    def function(self) -> Any:
        """The CasADi function of all inputs, as one vector, to all outputs, as another."""
        inputs = casadi.vertcat(*self._inputs.values()) if self._inputs else casadi.SX(0, 1)
        outputs = casadi.densify(casadi.vertcat(*self._outputs.values()))
        return casadi.Function("contour", [inputs], [outputs])

    def shared(self) -> Any:
        """The same function, in which what several outputs have in common is computed once."""
        inputs = casadi.vertcat(*self._inputs.values())
        outputs = casadi.densify(casadi.vertcat(*self._outputs.values()))
        return casadi.Function("contour", [inputs], [casadi.cse(outputs)])

    def keep(self, prefixes: tuple[str, ...], names: Sequence[str]) -> "Tape":
        """The same tape with only the outputs of these names, or that begin so."""
        kept = Tape()
        kept._inputs = self._inputs
        kept._outputs = {
            name: each for name, each in self._outputs.items() if name in names or name.startswith(prefixes)
        }
        return kept

    @property
    def outputs(self) -> tuple[str, ...]:
        """The names of the outputs, in order."""
        return tuple(self._outputs)

    def finish(self) -> "Compiled":
        """The function of all inputs and outputs."""
        return Compiled(self.function(), self.inputs, self.outputs)


def symbol(name: str) -> Any:
    """A fresh symbol for an unknown of an affine step."""
    return casadi.SX.sym(name)


def affine_parts(residuals: Sequence[Any], unknowns: Sequence[Any]) -> tuple[list[list[Any]], list[Any]]:
    """(matrix, constants) of residuals that are affine in the unknowns: residual = matrix @ u + constant."""
    stacked, symbols = casadi.vertcat(*residuals), casadi.vertcat(*unknowns)
    jacobian = casadi.densify(casadi.jacobian(stacked, symbols))
    constants = casadi.substitute(stacked, symbols, casadi.SX.zeros(len(unknowns)))
    size = range(len(residuals)), range(len(unknowns))
    return [[jacobian[i, j] for j in size[1]] for i in size[0]], [constants[i] for i in size[0]]


def jacobian_parts(residuals: Sequence[Any], unknowns: Sequence[Any], at: Sequence[Any]) -> dict[tuple[int, int], Any]:
    """Non-zero entries of the derivative of residuals by unknowns (symbols), at expressions `at`."""
    stacked, symbols = casadi.vertcat(*residuals), casadi.vertcat(*unknowns)
    jacobian = casadi.substitute(casadi.jacobian(stacked, symbols), symbols, casadi.vertcat(*at))
    rows, columns = jacobian.sparsity().get_triplet()
    return {(row, column): jacobian[row, column] for row, column in zip(rows, columns, strict=True)}


def derivatives(residuals: Sequence[Any], unknowns: Sequence[Any]) -> list[Any]:
    """The dense Jacobian of residuals by unknowns, row by row."""
    jacobian = casadi.densify(casadi.jacobian(casadi.vertcat(*residuals), casadi.vertcat(*unknowns)))
    return [jacobian[row, column] for row in range(len(residuals)) for column in range(len(unknowns))]


def quadratic_parts(residuals: Sequence[Any], unknowns: Sequence[Any]) -> dict[tuple[int, tuple[int, ...]], Any] | None:
    """The coefficients of polynomials of degree 2 by (residual, monomial); None if one is of another kind.

    A monomial names the unknowns that are multiplied, by their index in order: `(0, 0)`, `(1,)`, `()`.
    """
    symbols = casadi.vertcat(*unknowns)
    zero = casadi.SX.zeros(len(unknowns))
    parts: dict[tuple[int, tuple[int, ...]], Any] = {}
    for number, residual in enumerate(residuals):
        hessian, gradient = casadi.hessian(residual, symbols)
        if casadi.which_depends(casadi.vec(hessian), symbols, 1, False).count(True):
            return None
        parts[number, ()] = casadi.substitute(residual, symbols, zero)
        at_zero = casadi.substitute(gradient, symbols, zero)
        for row in set(gradient.sparsity().row()):
            parts[number, (row,)] = at_zero[row, 0]
        for row, column in zip(*hessian.sparsity().get_triplet(), strict=True):
            if row <= column:
                parts[number, (row, column)] = hessian[row, column] / (2 if row == column else 1)
    return parts


class Compiled:
    """A CasADi function with names for its inputs and outputs.

    It is called through `Function.buffer()`, which costs 0.3 us where arrays cost 16 us. A buffer is
    not shared between threads.
    """

    def __init__(self, function: Any, inputs: tuple[str, ...], outputs: tuple[str, ...]) -> None:
        self._function = function
        self._local = threading.local()
        self.inputs = inputs
        self.outputs = outputs

    def __call__(self, values: Mapping[str, float]) -> dict[str, float]:
        """All outputs by name at the inputs by name."""
        local = self._local
        if not hasattr(local, "trigger"):
            local.arguments = numpy.zeros(len(self.inputs))
            local.results = numpy.zeros(len(self.outputs))
            local.buffer, local.trigger = self._function.buffer()
            local.buffer.set_arg(0, memoryview(local.arguments))
            local.buffer.set_res(0, memoryview(local.results))
        local.arguments[:] = [values[name] for name in self.inputs]
        local.trigger()
        return dict(zip(self.outputs, local.results.tolist(), strict=True))


def inverse_norm(entries: Mapping[tuple[int, int], float], size: int) -> float:
    """Largest row sum of the absolute inverse of a square matrix; infinite if it is singular."""
    matrix = numpy.zeros((size, size))
    for (row, column), value in entries.items():
        matrix[row, column] = value
    try:
        return float(numpy.abs(numpy.linalg.inv(matrix)).sum(axis=1).max())
    except numpy.linalg.LinAlgError:
        return float("inf")


def inverse(rows: Sequence[Sequence[float]]) -> list[list[float]] | None:
    """The inverse of a square matrix; None if it is singular or not finite."""
    try:
        found = numpy.linalg.inv(numpy.array(rows))
    except numpy.linalg.LinAlgError:
        return None
    return found.tolist() if numpy.isfinite(found).all() else None
