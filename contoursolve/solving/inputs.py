"""A lookup whose values are inputs by name: of a CasADi function under construction, or numbers that stand for them."""

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any, Protocol

from contoursolve.geometry import Fact, System, Values
from contoursolve.numeric import COSINE, SIDE, SINE, Created, Functions, expressions

EXPRESSIONS = Functions(
    expressions.sqrt,
    expressions.cosine,
    expressions.sine,
    unless_zero=lambda value, other: expressions.where(expressions.is_zero(value), other, value),
    magnitude=expressions.magnitude,
    larger=expressions.larger,
    at_most=expressions.at_most,
    below=expressions.below,
    opposite=expressions.opposite,
)
"""Of expressions of CasADi."""


class InputSource(Protocol):
    """Gives the inputs of formulas."""

    def input(self, name: str) -> Any:
        """The value of an input."""


def named_inputs(tape: InputSource, symbols: Mapping[str, Any] = MappingProxyType({}), prefix: str = "") -> Created:
    """Numbers by name as inputs of a tape, created when a formula asks for them; some are symbols already."""
    return Created(lambda name: symbols[name] if name in symbols else tape.input(prefix + name))


def given_directions(tape: InputSource) -> Created:
    """Given angles as pairs of inputs."""
    return Created(lambda name: (tape.input(name + COSINE), tape.input(name + SINE)))


Headed = frozenset[tuple[str, tuple[str, str]]]
"""Lines of given direction, each with that given and with a point of the line."""


def headed_of(system: System, facts: Iterable[Fact]) -> Headed:
    """The lines of given direction that some facts of a system read."""
    lines = {name.rpartition(".")[0] for fact in facts for name in fact.reads()}
    return frozenset((line, system.headed[line]) for line in lines if line in system.headed)


def input_values(
    headed: Mapping[str, tuple[str, str]],
    tape: InputSource,
    symbols: Mapping[str, Any],
    functions: Functions = EXPRESSIONS,
) -> Values:
    """A lookup whose values are symbols, or inputs of a tape; `headed` are the lines of given direction."""
    return Values(
        named_inputs(tape, symbols),
        named_inputs(tape),
        given_directions(tape),
        headed,
        named_inputs(tape, prefix=SIDE),
        functions,
    )


def symbolic_values(symbols: Any, functions: Functions, headed: Mapping[str, tuple[str, str]]) -> Values:
    """A lookup of symbols of sympy; `headed` are the lines of given direction."""
    scalars = Created(symbols.scalar)
    return Values(scalars, scalars, Created(symbols.direction), headed, scalars, functions)
