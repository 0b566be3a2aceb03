"""A lookup whose values are inputs by name: of a CasADi function under construction, or numbers that stand for them."""

from collections.abc import Mapping
from typing import Any, Protocol

from contoursolve.geometry import Functions, System, Values
from contoursolve.numeric import expressions

COSINE, SINE, SIDE = ":cos", ":sin", "side:"
"""What the inputs for a given angle end with, and that for a side begins with."""

_SYMBOLS = Functions(expressions.sqrt, expressions.cosine, expressions.sine)


class Tape(Protocol):
    """Gives the inputs of formulas."""

    def input(self, name: str) -> Any:
        """The value of an input."""


class Inputs(Mapping[str, Any]):
    """Numbers by name as inputs of a tape, created when a formula asks for them; some are symbols already."""

    def __init__(self, tape: Tape, symbols: Mapping[str, Any], prefix: str = "") -> None:
        self._tape = tape
        self._symbols = symbols
        self._prefix = prefix

    def __getitem__(self, name: str) -> Any:
        return self._symbols[name] if name in self._symbols else self._tape.input(self._prefix + name)

    def __contains__(self, _name: object) -> bool:
        return True

    def __iter__(self) -> Any:
        raise TypeError("inputs are created by asking for them")

    def __len__(self) -> int:
        raise TypeError("inputs are created by asking for them")


class Directions(Inputs):
    """Given angles as pairs of inputs."""

    def __getitem__(self, name: str) -> Any:
        return self._tape.input(name + COSINE), self._tape.input(name + SINE)


def lookup(system: System, tape: Tape, symbols: Mapping[str, Any], functions: Functions = _SYMBOLS) -> Values:
    """A lookup whose values are symbols, or inputs of a tape."""
    return Values(
        Inputs(tape, symbols),
        Inputs(tape, {}),
        Directions(tape, {}),
        system.headed,
        Inputs(tape, {}, SIDE),
        functions,
    )
