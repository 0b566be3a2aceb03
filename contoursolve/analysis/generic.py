"""Which facts determine which unknowns for nearly all values: the rank of their derivatives at random values."""

from collections.abc import Mapping

from contoursolve.backends import numeric, residue
from contoursolve.backends.inputs import COSINE, SIDE, SINE, lookup
from contoursolve.backends.numeric import Tape
from contoursolve.backends.replay import Replay
from contoursolve.backends.residue import ExactRank, Residue, Row, draw, draw_direction
from contoursolve.constraints import System
from contoursolve.model import Fact


def generic_rank(system: System) -> ExactRank:
    """The rank of the facts' derivatives by the unknowns, at random values modulo a prime."""
    columns = {name: number for number, name in enumerate(system.unknowns)}
    rows = [_gradient(system, fact, columns) for fact in system.facts]
    return residue.exact_rank(rows, len(columns))


def _gradient(system: System, fact: Fact, columns: Mapping[str, int]) -> Row:
    tape = Tape()
    names = system.unknowns_of(fact)
    if not names:
        return {}
    unknowns = [tape.input(name) for name in names]
    equation = fact.equation(lookup(system, tape, {}))
    for number, expression in enumerate(numeric.derivatives([equation], unknowns)):
        tape.output(str(number), expression)
    replay = Replay(tape.function(), residue.Drawn, lambda value: Residue(residue.rational(value)))
    values = replay([Residue(witness_of(name)) for name in tape.inputs])
    return {columns[name]: value.value for name, value in zip(names, values, strict=True) if value.value}


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
