"""Which facts determine which unknowns for nearly all values: the rank of their derivatives at random values."""

from collections.abc import Mapping
from typing import Any

from contoursolve.backends import numeric, residue
from contoursolve.backends.numeric import Tape
from contoursolve.backends.replay import Replay
from contoursolve.backends.residue import ExactRank, Residue, draw, draw_direction
from contoursolve.constraints import Functions, System, Values
from contoursolve.model import Fact

COSINE, SINE, SIDE = ":cos", ":sin", "side:"
"""What the inputs for a given angle end with, and that for a side begins with."""

_SYMBOLS = Functions(numeric.sqrt, numeric.cosine, numeric.sine)


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


def lookup(system: System, tape: Tape, symbols: Mapping[str, Any]) -> Values:
    """A lookup whose values are symbols, or inputs of a tape."""
    return Values(
        Inputs(tape, symbols),
        Inputs(tape, {}),
        Directions(tape, {}),
        system.headed,
        Inputs(tape, {}, SIDE),
        _SYMBOLS,
    )


def generic_rank(system: System) -> ExactRank:
    """The rank of the facts' derivatives by the unknowns, at random values modulo a prime."""
    columns = {name: number for number, name in enumerate(system.unknowns)}
    rows = [_gradient(system, fact, columns) for fact in system.facts]
    return residue.exact_rank(rows, len(columns))


def _gradient(system: System, fact: Fact, columns: Mapping[str, int]) -> list[int]:
    tape = Tape()
    names = system.unknowns_of(fact)
    row = [0] * len(columns)
    if not names:
        return row
    unknowns = [tape.input(name) for name in names]
    equation = fact.equation(lookup(system, tape, {}))
    for number, expression in enumerate(numeric.derivatives([equation], unknowns)):
        tape.output(str(number), expression)
    replay = Replay(tape.function(), residue.Drawn, lambda value: Residue(residue.rational(value)))
    values = replay([Residue(witness_of(name)) for name in tape.inputs])
    for name, value in zip(names, values, strict=True):
        row[columns[name]] = value.value
    return row


def witness_of(name: str, signs: Mapping[str, int] | None = None) -> int:
    """The random residue that stands for an input; directions have the length 1, sides are +1 or -1."""
    if name.startswith(SIDE):
        side = name.removeprefix(SIDE)
        return signs[side] if signs is not None else 1 - 2 * (draw(side) % 2)
    for number, endings in enumerate(((COSINE, ".cos"), (SINE, ".sin"))):
        for ending in endings:
            if name.endswith(ending):
                return draw_direction(name.removesuffix(ending))[number]
    return draw(name)
