"""The equations of one step of a plan, ready for exact numbers and balls."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from contoursolve.analysis import Group
from contoursolve.backends import ball, numeric
from contoursolve.backends.inputs import lookup
from contoursolve.backends.numeric import Tape
from contoursolve.backends.replay import Replay
from contoursolve.constraints import System
from contoursolve.model import Fact
from contoursolve.solving.polynomial import COEFFICIENTS, Monomial, rational


@dataclass(frozen=True, slots=True, eq=False)
class Kernel:
    """Equations and unknowns of one step.

    `coefficients` gives the coefficients of the equations as polynomials in the unknowns, in the order of `terms`
    (equation, monomial), at the values of `parameters`; it is None if an equation is no
    polynomial of degree 2. `equations` gives the equations and then their derivatives, row by row, at the values of
    `arguments`, which are the unknowns and then other inputs. `function` is the same in CasADi.
    """

    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]
    sides: tuple[str, ...]
    parameters: tuple[str, ...]
    terms: tuple[tuple[int, Monomial], ...]
    coefficients: Replay | None
    arguments: tuple[str, ...]
    equations: Replay
    function: Any


@lru_cache(maxsize=8192)
def make_kernel(system: System, group: Group) -> Kernel:
    """The kernel of a group of facts of a system."""
    sides = tuple(dict.fromkeys(side for fact in group.facts for side in fact.sides()))
    symbols = {name: numeric.symbol(name) for name in group.unknowns}
    tape = Tape()
    parts = numeric.quadratic_parts(
        [fact.equation(lookup(system, tape, symbols)) for fact in group.facts],
        list(symbols.values()),
    )
    coefficients = None
    if parts is not None:
        for number, expression in enumerate(parts.values()):
            tape.output(str(number), expression)
        coefficients = Replay(tape.function(), COEFFICIENTS, rational)
    at = Tape()
    unknowns = [at.input(name) for name in group.unknowns]
    outputs = [fact.equation(lookup(system, at, {})) for fact in group.facts]
    for number, expression in enumerate((*outputs, *numeric.derivatives(outputs, unknowns))):
        at.output(str(number), expression)
    function = at.function()
    return Kernel(
        facts=group.facts,
        unknowns=group.unknowns,
        sides=sides,
        parameters=tape.inputs,
        terms=tuple(parts) if parts is not None else (),
        coefficients=coefficients,
        arguments=at.inputs,
        equations=Replay(function, ball, ball.exact),
        function=function,
    )
