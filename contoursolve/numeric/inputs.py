"""A lookup whose values are inputs by name: of a CasADi function under construction, or numbers that stand for them."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Protocol

from contoursolve.geometry import Created, Functions, System, Values
from contoursolve.numeric import expressions

COSINE, SINE, SIDE = ":cos", ":sin", "side:"
"""What the inputs for a given angle end with, and that for a side begins with."""

_SYMBOLS = Functions(expressions.sqrt, expressions.cosine, expressions.sine)


class Tape(Protocol):
    """Gives the inputs of formulas."""

    def input(self, name: str) -> Any:
        """The value of an input."""


def named_inputs(tape: Tape, symbols: Mapping[str, Any] = MappingProxyType({}), prefix: str = "") -> Created:
    """Numbers by name as inputs of a tape, created when a formula asks for them; some are symbols already."""
    return Created(lambda name: symbols[name] if name in symbols else tape.input(prefix + name))


def given_directions(tape: Tape) -> Created:
    """Given angles as pairs of inputs."""
    return Created(lambda name: (tape.input(name + COSINE), tape.input(name + SINE)))


def lookup(system: System, tape: Tape, symbols: Mapping[str, Any], functions: Functions = _SYMBOLS) -> Values:
    """A lookup whose values are symbols, or inputs of a tape."""
    return Values(
        named_inputs(tape, symbols),
        named_inputs(tape),
        given_directions(tape),
        system.headed,
        named_inputs(tape, prefix=SIDE),
        functions,
    )
