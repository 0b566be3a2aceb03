"""Runs the instructions of a CasADi function on numbers of any kind: balls, rationals, intervals."""

import operator
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import casadi

from contoursolve.numeric.functions import Functions

_BINARY: Mapping[int, Callable[[Any, Any], Any]] = {
    casadi.OP_ADD: operator.add,
    casadi.OP_SUB: operator.sub,
    casadi.OP_MUL: operator.mul,
    casadi.OP_DIV: operator.truediv,
}
_UNARY: Mapping[int, Callable[[Any], Any]] = {
    casadi.OP_NEG: operator.neg,
    casadi.OP_INV: lambda value: 1 / value,
    casadi.OP_ASSIGN: lambda value: value,
}
_OF_ITSELF: Mapping[int, Callable[[Any, Any], Any]] = {
    casadi.OP_SQ: operator.mul,  # a power of a ball about 0 is no number
    casadi.OP_TWICE: operator.add,
}
"""One operand that is both."""
_CHOICES: Mapping[int, str] = {
    casadi.OP_EQ: "equal",
    casadi.OP_LE: "at_most",
    casadi.OP_LT: "below",
    casadi.OP_NOT: "opposite",
    casadi.OP_IF_ELSE_ZERO: "chosen",
}
_POWERS = (casadi.OP_POW, casadi.OP_CONSTPOW)
_FUNCTIONS: Mapping[int, str] = {
    casadi.OP_SQRT: "root",
    casadi.OP_COS: "cosine",
    casadi.OP_SIN: "sine",
    casadi.OP_FABS: "magnitude",
    casadi.OP_SIGN: "sign",
    casadi.OP_ATAN2: "angle",
    casadi.OP_FMAX: "larger",
}


Step = tuple[Callable[..., Any], int, int, int]
"""Operation, places of the first and the second operand (-1 for none) and of the result."""


def run_steps(steps: Sequence[Step], work: list[Any]) -> None:
    """Put the results of steps, one after the other, in their places."""
    for operation, first, second, target in steps:
        work[target] = operation(work[first], work[second]) if second >= 0 else operation(work[first])


class Replay:
    """The instructions of a function of one vector to one vector, as a list to run through; `constant` makes a number
    of the wanted kind from a float."""

    def __init__(self, function: Any, functions: Functions, constant: Callable[[float], Any]) -> None:
        self._zero = constant(0.0)
        self._inputs: list[tuple[int, int]] = []
        self._outputs: list[tuple[int, int]] = []
        self._count = function.nnz_out(0)
        self._steps: list[Step] = []
        self._constants: list[Any] = [None] * function.n_instructions()
        """The places of all values, with those that are known beforehand."""
        # CasADi reuses places of its work vector; every value gets a place of its own here.
        place: dict[int, int] = {}
        for number in range(function.n_instructions()):
            kind = function.instruction_id(number)
            if kind == casadi.OP_OUTPUT:
                self._outputs.append(
                    (place[function.instruction_input(number)[0]], function.instruction_output(number)[1])
                )
                continue
            read = tuple(function.instruction_input(number))
            target = function.instruction_output(number)[0]
            if kind == casadi.OP_INPUT:
                self._inputs.append((read[1], number))
            elif kind == casadi.OP_CONST:
                self._constants[number] = constant(function.instruction_constant(number))
            else:
                first, second = place[read[0]], place[read[1]] if len(read) > 1 else -1
                if kind in _OF_ITSELF:
                    second = first
                self._steps.append((_operation(kind, functions), first, second, number))
            place[target] = number

    def __call__(self, inputs: Sequence[Any]) -> list[Any]:
        """The outputs at these inputs; an output that is always zero is the constant 0."""
        return self.results(self.values(inputs))

    def values(self, inputs: Sequence[Any]) -> list[Any]:
        """All values at these inputs, by their places."""
        work = self._constants.copy()
        for source, target in self._inputs:
            work[target] = inputs[source]
        run_steps(self._steps, work)
        return work

    def results(self, work: Sequence[Any]) -> list[Any]:
        """The outputs among all values, by their places."""
        results = [self._zero] * self._count
        for source, target in self._outputs:
            results[target] = work[source]
        return results


def _operation(kind: int, functions: Functions) -> Callable[..., Any]:
    if kind in _BINARY:
        return _BINARY[kind]
    if kind in _OF_ITSELF:
        return _OF_ITSELF[kind]
    if kind in _UNARY:
        return _UNARY[kind]
    if kind in _FUNCTIONS:
        found: Callable[..., Any] = getattr(functions, _FUNCTIONS[kind])
        return found
    if kind in _POWERS:
        return operator.pow
    if kind in _CHOICES:
        own: Callable[..., Any] = getattr(functions, _CHOICES[kind])
        return own if functions.chosen is not None else _choice(kind, functions)
    raise ValueError(f"CasADi instruction {kind} has no counterpart here")


def _choice(kind: int, functions: Functions) -> Callable[..., Any]:
    """A comparison that gives True or False, and what is chosen by it."""
    if kind == casadi.OP_EQ:
        return lambda a, b: functions.sign(a - b) == 0
    if kind == casadi.OP_LE:
        return functions.at_most
    if kind == casadi.OP_NOT:
        return operator.not_
    if kind == casadi.OP_LT:
        raise ValueError("what is below what is not decided here")
    return lambda condition, value: value if condition else value * 0
