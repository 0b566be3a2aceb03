"""Which facts determine which unknowns for nearly all values: the rank of their derivatives at random values."""

from collections.abc import Mapping
from typing import NamedTuple

from contoursolve.backends import residue
from contoursolve.backends.inputs import COSINE, SIDE, SINE, lookup
from contoursolve.backends.residue import RESIDUES, ExactRank, Residue, Row, draw, draw_direction
from contoursolve.constraints import System
from contoursolve.model import Fact


def generic_rank(system: System) -> ExactRank:
    """The rank of the facts' derivatives by the unknowns, at random values modulo a prime."""
    columns = {name: number for number, name in enumerate(system.unknowns)}
    rows = [_gradient(system, fact, columns) for fact in system.facts]
    return residue.exact_rank(rows, len(columns))


class _Witnesses(NamedTuple):
    """Random values of all inputs, some of which are unknowns."""

    unknowns: Mapping[str, int]

    def input(self, name: str) -> Residue:
        """The value of an input; the derivative of an unknown by itself is 1."""
        return Residue(witness_of(name), {name: 1} if name in self.unknowns else {})


def _gradient(system: System, fact: Fact, columns: Mapping[str, int]) -> Row:
    value = fact.equation(lookup(system, _Witnesses(columns), {}, RESIDUES))
    return {columns[name]: slope for name, slope in value.slopes.items() if slope}


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
