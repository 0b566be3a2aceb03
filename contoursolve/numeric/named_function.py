"""Functions of CasADi with named inputs and matrices as outputs, for those who go on with them in CasADi."""

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import casadi

from contoursolve.numeric.expressions import Expression, Tape

Function: TypeAlias = casadi.Function

Rows = Sequence[Sequence[Any]]
"""Expressions and numbers by row and column."""


STEPS = 8
"""Of the inputs, from those whose unknowns are known."""


def _matrix(rows: Rows) -> Any:
    """A dense matrix of CasADi; of no rows, one of none."""
    parts = [[each.sx if isinstance(each, Expression) else each for each in row] for row in rows]
    if not parts:
        return casadi.SX(0, 1)
    return casadi.densify(casadi.vertcat(*(casadi.horzcat(*row) for row in parts)))


def _column(values: Sequence[Any]) -> Any:
    return casadi.densify(casadi.SX(_matrix([[each] for each in values])))


def put_in(tape: Tape, names: Sequence[str], inputs: Mapping[str, Any]) -> dict[str, Expression]:
    """Outputs of a tape with expressions, or numbers, for all its inputs."""
    function = casadi.Function(
        "part",
        [_column([tape.input(name) for name in tape.inputs])],
        [_column([tape.expression(name) for name in names])],
    )
    found = function(_column([inputs[name] for name in tape.inputs]))
    return {name: Expression(found[number]) for number, name in enumerate(names)}


def closed_function(
    name: str, inputs: Mapping[str, Expression], known: Sequence[float], outputs: Mapping[str, Rows]
) -> Any:
    """The function of scalars to matrices, in closed form; an input that is left out is as it is `known`."""
    symbols = [each.sx for each in inputs.values()]
    results = [_matrix(rows) for rows in outputs.values()]
    return casadi.Function(name, symbols, results, [*inputs], [*outputs], {"default_in": [*known]})


def implicit_function(
    name: str,
    inputs: Mapping[str, Expression],
    unknowns: Sequence[Expression],
    residuals: Sequence[Expression],
    known: tuple[Sequence[float], Sequence[float]],
    outputs: Mapping[str, Rows],
) -> Any:
    """The same where unknowns follow from residuals that are zero: by Newton's method from `known` inputs and unknowns
    on, in steps, so that it stays with the solution; with derivatives by the implicit function theorem. `outputs` are
    of inputs and unknowns. Where it finds none, the residuals among them are not zero."""
    given, sought = _column([*inputs.values()]), _column(unknowns)
    equations = casadi.Function("equations", [sought, given], [_column(residuals)])
    # A square system of full rank: as fine as floats are.
    finder = casadi.rootfinder(
        "solution", "newton", equations, {"abstol": 1e-12, "abstolStep": 1e-12, "max_iter": 50, "error_on_fail": False}
    )
    measure = casadi.Function("measure", [sought, given], [_matrix(rows) for rows in outputs.values()])
    scalars = [casadi.MX.sym(each) for each in inputs]
    values = casadi.vertcat(*scalars) if scalars else casadi.MX(0, 1)
    base, at = (casadi.MX(casadi.DM([*each])) for each in known)
    for number in range(1, STEPS + 1):
        at = finder(at, base + (values - base) * (number / STEPS))
    found = measure(at, values)
    results = [found] if len(outputs) == 1 else list(found)
    return casadi.Function(name, scalars, results, [*inputs], [*outputs], {"default_in": [*known[0]]})
