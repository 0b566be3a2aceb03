"""Both null spaces of facts that are affine in the unknowns, at the values of one block.

Every fact of lines between points is affine: its residual is a row of a matrix times the unknowns plus a
constant. What the matrix maps to zero can still move; a combination of rows that is zero is a set of
facts that say the same.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy

from contoursolve.analysis.identities import is_affine
from contoursolve.constraints import assemble
from contoursolve.diagnostic import Freedom
from contoursolve.model import FIRST, SECOND, Fact, Profile, scalar
from contoursolve.solving.numbers import lookup
from contoursolve.tolerance import REGULAR


@dataclass(frozen=True, slots=True)
class Circuit:
    """Facts that say the same: each is determined by the others, and no part of them is tied.

    `off` (mm) says for each fact by how much it misses what the others say; all zero if they agree.
    """

    facts: tuple[Fact, ...]
    off: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class AffineFacts:
    """Facts as rows of `matrix`, shape (facts, unknowns), and `constants`, shape (facts,), mm."""

    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]
    matrix: numpy.ndarray
    constants: numpy.ndarray

    def circuits(self) -> tuple[Circuit, ...]:
        """All minimal sets of facts that are tied at these values, smallest first; exhaustive."""
        found: list[tuple[int, ...]] = []
        result = []
        for size in range(1, min(len(self.unknowns) + 1, len(self.facts)) + 1):
            for rows in combinations(range(len(self.facts)), size):
                if any(set(other) <= set(rows) for other in found):
                    continue
                left, values, _ = numpy.linalg.svd(self.matrix[list(rows)])
                if size <= len(self.unknowns) and values[-1] > REGULAR:
                    continue
                weights = left[:, -1]
                found.append(rows)
                gap = float(weights @ self.constants[list(rows)])
                off = tuple(abs(gap / float(weight)) for weight in weights)
                result.append(Circuit(tuple(self.facts[row] for row in rows), off))
        return tuple(result)

    def freedoms(self) -> tuple[Freedom, ...]:
        """What can still move, point by point, in the order of the unknowns."""
        if not self.facts:
            null = numpy.eye(len(self.unknowns))
        else:
            _, values, right = numpy.linalg.svd(self.matrix)
            null = right[int((values > REGULAR).sum()) :]
        points = dict.fromkeys(name.partition(".")[0] for name in self.unknowns)
        result = []
        for point in points:
            columns = [self.unknowns.index(scalar(point, axis)) for axis in (FIRST, SECOND)]
            _, values, right = numpy.linalg.svd(null[:, columns])
            rank = int((values > REGULAR).sum())
            along = right[0] if right[0][numpy.argmax(abs(right[0]))] > 0 else -right[0]
            if rank:
                direction = (float(along[0]), float(along[1])) if rank == 1 else None
                result.append(Freedom(point, direction))
        return tuple(result)

    def fixed_by(self, facts: Sequence[Fact]) -> dict[str, float]:
        """The unknowns that some of the facts determine, with their values, mm."""
        rows = [self.facts.index(fact) for fact in facts]
        _, values, right = numpy.linalg.svd(self.matrix[rows])
        null = right[int((values > REGULAR).sum()) :]
        solution = numpy.linalg.lstsq(self.matrix[rows], -self.constants[rows], rcond=None)[0]
        return {
            name: float(solution[column])
            for column, name in enumerate(self.unknowns)
            if not (abs(null[:, column]) > REGULAR).any()
        }


def affine_facts(profile: Profile, facts: Sequence[Fact]) -> AffineFacts | None:
    """Facts of a profile, at its values, as a matrix; None if one is not affine or the start is unknown."""
    if not is_affine(facts) or not profile.start.is_known:
        return None
    unknowns = assemble(profile).unknowns

    def residuals(values: dict[str, float]) -> numpy.ndarray:
        at = lookup(profile, values)
        return numpy.array([float(fact.residual(at)) for fact in facts])

    nowhere = dict.fromkeys(unknowns, 0.0)
    constants = residuals(nowhere)
    columns = [residuals({**nowhere, name: 1.0}) - residuals({**nowhere, name: 0.0}) for name in unknowns]
    matrix = numpy.array(columns).T.reshape(len(facts), len(unknowns))
    return AffineFacts(tuple(facts), unknowns, matrix, constants)
