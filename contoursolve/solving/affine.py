"""Both null spaces of the Jacobian of facts, at the values of one block.

Every fact of lines between points is affine: its residual is a row of a matrix times the unknowns plus a
constant. Of others, that is so to first order near a solution. What the matrix maps to zero can still move; a
combination of rows that is zero is a set of facts that say the same.
"""

import cmath
from collections import ChainMap
from collections.abc import Iterable, Iterator, Mapping, MutableMapping, Sequence
from functools import cached_property
from itertools import combinations
from math import comb, copysign, hypot
from typing import Any, NamedTuple, cast

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Freedom
from contoursolve.geometry import FIRST, SECOND, Fact, Profile, System, Values, assemble, scalar
from contoursolve.numeric import CONSTANT, Created, Echelon, Functions, pinv, svd
from contoursolve.solving.identities import is_affine
from contoursolve.solving.numbers import lookup
from contoursolve.tolerance import REGULAR


class Circuit(Struct, frozen=True):
    """Facts that say the same: each is determined by the others, and no part of them is tied.

    `off` (mm) says for each fact by how much it misses what the others say; all zero if they agree.
    """

    facts: tuple[Fact, ...]
    off: tuple[float, ...]


class Circuits(NamedTuple):
    """Circuits, smallest first, and whether they are all there are."""

    found: tuple[Circuit, ...]
    is_complete: bool


NO_CIRCUITS = Circuits((), is_complete=True)


class Part(NamedTuple):
    """Facts and the unknowns that they share with no other fact, decomposed once.

    `tied` is a basis of the combinations of rows that vanish, shape (rows, ties); `loose` one of what can still move,
    shape (freedoms, columns); `values` are those of the unknowns that satisfy the facts best, shape (columns,).
    """

    rows: tuple[int, ...]
    columns: tuple[int, ...]
    tied: numpy.ndarray
    loose: numpy.ndarray
    values: numpy.ndarray


class AffineFacts(Struct, frozen=True, dict=True):
    """Facts as rows without their zeros, by the number of the unknown, and `constants`, shape (facts,), mm."""

    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]
    rows: tuple[Mapping[int, float], ...]
    constants: numpy.ndarray

    def matrix_of(self, rows: Sequence[int]) -> numpy.ndarray:
        """Some rows with their zeros, shape (rows, unknowns)."""
        matrix = numpy.zeros((len(rows), len(self.unknowns)))
        for place, row in enumerate(rows):
            for column, slope in self.rows[row].items():
                matrix[place, column] = slope
        return matrix

    @cached_property
    def places(self) -> Mapping[Fact, int]:
        """The row of each fact."""
        return {fact: row for row, fact in reversed([*enumerate(self.facts)])}

    @cached_property
    def columns(self) -> Mapping[str, int]:
        """The column of each unknown."""
        return {name: column for column, name in enumerate(self.unknowns)}

    def off_at(self, scalars: Mapping[str, float]) -> numpy.ndarray:
        """By how much each fact misses being true at some values of the unknowns, mm."""
        matrix = self.matrix_of(range(len(self.facts)))
        off: numpy.ndarray = matrix @ [scalars[name] for name in self.unknowns] + self.constants
        return off

    def circuits(self) -> Circuits:
        """The minimal sets of facts that are tied at these values, smallest first.

        They are the supports of the left null space's vectors that vanish on as many facts as possible. A fact on
        which all vectors vanish is in none, and facts that share no circuit are looked at apart.
        """
        found: list[tuple[int, ...]] = []
        is_complete = True
        basis, tied = IndependentFacts(self), set[int]()
        for row in range(len(self.facts)):
            tied.update(basis.add_row(row) or ())
        rows = sorted(tied)
        # What is in no circuit of a basis is in none.
        for part in _parts(self.matrix_of(rows), self.constants[rows]):
            for within in _connected(part.tied):
                supports, is_whole = _supports(part.tied[list(within)])
                found += [tuple(rows[part.rows[within[index]]] for index in support) for support in supports]
                is_complete = is_complete and is_whole
        circuits = [self._circuit(rows) for rows in sorted(set(found), key=lambda rows: (len(rows), rows))]
        return Circuits(tuple(filter(None, circuits)), is_complete and None not in circuits)

    def _circuit(self, rows: Sequence[int]) -> Circuit | None:
        """The circuit that ties these rows; None where rounding alone made them look tied once."""
        matrix = self.matrix_of(rows)
        tied = _decompose(matrix[:, matrix.any(axis=0)]).tied
        if tied.shape[1] != 1:
            return None
        weights = dict(zip(rows, tied[:, 0].tolist(), strict=True))
        present = [row for row in rows if abs(weights[row]) > REGULAR]
        gap = sum(weights[row] * float(self.constants[row]) for row in present)
        return Circuit(tuple(self.facts[row] for row in present), tuple(abs(gap / weights[row]) for row in present))

    def freedoms(self) -> tuple[Freedom, ...]:
        """The freedoms that are left, point by point, in the order of the unknowns."""
        basis = IndependentFacts(self)
        for row in range(len(self.facts)):
            basis.add_row(row)
        moves = basis.moves()
        points = dict.fromkeys(name.partition(".")[0] for name in self.unknowns)
        result = []
        for point in points:
            one, other = (moves[scalar(point, axis)] for axis in (FIRST, SECOND))
            ways = [(one.get(free, 0.0), other.get(free, 0.0)) for free in {**one, **other}]
            if ways:
                first, second = max(ways, key=lambda way: hypot(*way))
                size = hypot(first, second)
                # Of two that differ by rounding, the first tells which way is forwards.
                size = copysign(size, first if abs(first) > abs(second) * (1 - REGULAR) else second)
                along = first / size + 0.0, second / size + 0.0
                is_line = all(abs(along[FIRST] * way[SECOND] - along[SECOND] * way[FIRST]) <= REGULAR for way in ways)
                result.append(Freedom(point, along if is_line else None))
        return tuple(result)

    def placed_by(self, facts: Sequence[Fact]) -> dict[str, float]:
        """Values of all unknowns with which some facts that agree are true, mm; of those that can move, some place."""
        rows = [self.places[fact] for fact in facts]
        values = pinv(self.matrix_of(rows)) @ -self.constants[rows]
        return dict(zip(self.unknowns, values.tolist(), strict=True))

    def fixed_by(self, facts: Sequence[Fact]) -> dict[str, float]:
        """The unknowns that some of the facts determine, with their values, mm."""
        rows = [self.places[fact] for fact in facts]
        basis = IndependentFacts(self)
        if all(basis.add_row(row) is None for row in rows):
            return basis.fixed(self.unknowns)
        # Where they disagree, what satisfies them best counts.
        parts = _parts(self.matrix_of(rows), self.constants[rows])
        fixed = {
            column: value
            for part in parts
            for column, value, moves in zip(part.columns, part.values.tolist(), part.loose.T, strict=True)
            if not (abs(moves) > REGULAR).any()
        }
        return {self.unknowns[column]: fixed[column] for column in sorted(fixed)}


class IndependentFacts:
    """Facts of which none follows from the others, added one after the other."""

    def __init__(self, affine: AffineFacts) -> None:
        self._affine = affine
        self._echelon = Echelon(REGULAR)
        self._rests: dict[int, Mapping[int, float]] = {}
        """What is left of further facts beside those that were added."""

    def add(self, fact: Fact) -> Circuit | None:
        """Add a fact, and give None; or else give the facts from which it follows, in order, and itself, which comes
        last."""
        affine, index = self._affine, self._affine.places[fact]
        weights = self.add_row(index)
        if weights is None:
            return None
        present = {row: weight for row, weight in weights.items() if abs(weight) > REGULAR and row != index}
        told = sum(weight * float(affine.constants[row]) for row, weight in present.items())
        gap = abs(float(affine.constants[index]) - told)
        rows = sorted(present)
        return Circuit((*(affine.facts[row] for row in rows), fact), (*(gap / abs(present[row]) for row in rows), gap))

    def add_row(self, row: int) -> dict[int, float] | None:
        """The same by the number of a fact: the multiples of facts that it is the sum of, and itself, once."""
        self._rests.clear()
        weights = self._echelon.add(row, self._entries(row))
        return None if weights is None else {**weights, row: 1.0}

    def _entries(self, row: int) -> dict[int, float]:
        return {**self._affine.rows[row], CONSTANT: float(self._affine.constants[row])}

    def moves(self) -> dict[str, dict[int, float]]:
        """For each unknown, how far it moves with each of those that are free, as these are numbered, by one of its
        own; nothing for one that the facts determine."""
        solved = self._echelon.solved(self._affine.columns.values())
        return {
            self._affine.unknowns[column]: {
                free: share for free, share in moves.items() if free >= 0 and abs(share) > REGULAR
            }
            for column, moves in solved.items()
        }

    def rank_with(self, further: Iterable[Fact]) -> int:
        """The number of facts that would be independent with further ones."""
        rests = Echelon(REGULAR)
        for fact in further:
            row = self._affine.places[fact]
            if row not in self._rests:
                self._rests[row] = self._echelon.rest(self._entries(row))
            rests.add(row, self._rests[row])
        return self._echelon.rank + rests.rank

    def fixed(self, names: Iterable[str]) -> dict[str, float]:
        """Of some unknowns, those that the facts determine, with their values, mm, in the order of the unknowns."""
        columns = self._affine.columns
        found = self._echelon.fixed(columns[name] for name in names if name in columns)
        return {self._affine.unknowns[column]: found[column] for column in sorted(found)}


def affine_facts(profile: Profile, facts: Sequence[Fact]) -> AffineFacts | None:
    """Facts of a profile, at its values, as a matrix; None if one is not affine or the start is unknown."""
    if not is_affine(facts) or not profile.start.is_known:
        return None
    return linearise(profile, facts, dict.fromkeys(assemble(profile).unknowns, 0.0))


def linearise(profile: Profile, facts: Sequence[Fact], scalars: Mapping[str, float]) -> AffineFacts:
    """Facts of a profile, whose start is known, to first order at these values of the unknowns (mm)."""
    return rows_at(assemble(profile), facts, values_at(profile, facts, scalars))


def values_at(profile: Profile, facts: Sequence[Fact], scalars: Mapping[str, float]) -> Values:
    """A lookup for facts of a profile at these values of the unknowns (mm). An open side is the one with which its
    facts are nearest to being true."""
    system = assemble(profile)
    at = replace(lookup(profile, {name: scalars[name] for name in system.unknowns}), headed=system.headed)
    return replace(at, signs=nearest_sides(facts, at))


def rows_at(system: System, facts: Sequence[Fact], at: Values) -> AffineFacts:
    """Facts about the unknowns of a system to first order at some values."""
    columns = {name: column for column, name in enumerate(system.unknowns)}
    at = replace(at, functions=_COMPLEX)
    here = {name: at.scalar(name) for fact in facts for name in system.unknowns_of(fact)}
    # A copy is read far more often than it is made; what makes each value when it is asked for cannot be copied.
    given = cast("dict[str, Any]", at.scalars)
    scalars: MutableMapping[str, Any] = {**given} if isinstance(given, dict) else ChainMap({}, given)
    following = replace(at, scalars=scalars)
    rows = list[dict[int, float]]()
    constants = numpy.zeros(len(facts))
    for row, fact in enumerate(facts):
        constants[row] = complex(fact.residual(at)).real
        rows.append({})
        for name in system.unknowns_of(fact):
            scalars[name] = complex(here[name], _STEP)
            slope = complex(fact.residual(following)).imag / _STEP
            scalars[name] = here[name]
            if slope:
                rows[row][columns[name]] = slope
            constants[row] -= slope * here[name]
    return AffineFacts(tuple(facts), system.unknowns, tuple(rows), constants)


_STEP = 2.0**-200
"""mm. Of a derivative by a step along the imaginary axis nothing is subtracted, so that it is exact (Squire 1998); by a
power of two, to the last bit."""

_COMPLEX = Functions(cmath.sqrt, cmath.cos, cmath.sin, lambda value: complex(value).real == 0)


def nearest_sides(facts: Iterable[Fact], at: Values) -> dict[str, int]:
    """The sign of each open side with which the facts that it is a side of miss least."""
    of_side: dict[str, list[Fact]] = {}
    for fact in facts:
        for side in fact.sides():
            of_side.setdefault(side, []).append(fact)

    def miss(side: str, sign: int) -> float:
        signed = replace(at, signs=Created(lambda _: sign))
        return sum(abs(float(fact.residual(signed))) for fact in of_side[side])

    return {side: min((1, -1), key=lambda sign: miss(side, sign)) for side in of_side}


def _parts(matrix: numpy.ndarray, constants: numpy.ndarray) -> tuple[Part, ...]:
    """The finest parts of a matrix whose facts share no unknown with those of another part."""
    parts = []
    for rows, columns in _blocks(matrix):
        found = _decompose(matrix[numpy.ix_(rows, columns)], constants[rows])
        parts.append(Part(tuple(rows), tuple(columns), found.tied, found.loose, found.values))
    return tuple(parts)


def _blocks(matrix: numpy.ndarray) -> Iterator[tuple[list[int], list[int]]]:
    """The rows and columns of each part that is connected by what is not zero; of a row of zeros, the row alone."""
    is_there, seen = matrix != 0, set[int]()
    for first in range(len(matrix)):
        if first in seen:
            continue
        rows, size = numpy.arange(len(matrix)) == first, 0
        while rows.sum() > size:
            size = rows.sum()
            columns = is_there[rows].any(axis=0)
            rows = rows | is_there[:, columns].any(axis=1)
        found = numpy.flatnonzero(rows).tolist()
        seen.update(found)
        yield found, numpy.flatnonzero(columns).tolist()


class _Decomposed(NamedTuple):
    """See `Part`."""

    tied: numpy.ndarray
    loose: numpy.ndarray
    values: numpy.ndarray


def _decompose(matrix: numpy.ndarray, constants: numpy.ndarray | None = None) -> _Decomposed:
    """The null spaces of a matrix, and the unknowns that satisfy its facts best."""
    if not matrix.size:
        return _Decomposed(numpy.eye(len(matrix)), numpy.eye(matrix.shape[1]), numpy.zeros(matrix.shape[1]))
    left, sizes, right = svd(matrix)
    rank = int((sizes > REGULAR).sum())
    known = numpy.zeros(len(matrix)) if constants is None else constants
    values = right[:rank].T @ (left[:, :rank].T @ -known / sizes[:rank])
    return _Decomposed(left[:, rank:], right[rank:], values)


MOST_SUBSETS = 5_000
"""Sets of facts that are looked through for circuits; where there are more, only those circuits are found in which one
fact says what earlier ones say."""

_INDEPENDENT = 1e-6
"""1 (sine of an angle). Facts that are independent by less than this are left to other sets of facts: a tenth of the
sine of the least angle, 0.001 deg, and far above the rounding of a null space."""

_ABSENT = 1e-9
"""1 (share of the largest). Rounding of a weight that is zero."""


def _leading(tied: numpy.ndarray) -> numpy.ndarray:
    """The combinations that vanish, shape (rows, ties), one for each of the last facts that earlier ones determine."""
    chosen: list[int] = []
    rest = tied
    for row in reversed(range(len(tied))):
        size = float(numpy.linalg.norm(rest[row]))
        if size > _INDEPENDENT:
            chosen.append(row)
            along = rest[row] / size
            rest = rest - numpy.outer(rest @ along, along)
    return tied @ pinv(tied[chosen])


def _connected(tied: numpy.ndarray) -> list[tuple[int, ...]]:
    """The rows that are tied, in the finest groups such that no circuit has rows of two."""
    groups: list[set[int]] = []
    for support in _present(_leading(tied).T) if tied.shape[1] else ():
        group = set(support)
        for other in [other for other in groups if other & group]:
            groups.remove(other)
            group |= other
        groups.append(group)
    return sorted(tuple(sorted(group)) for group in groups)


def _supports(tied: numpy.ndarray) -> tuple[list[tuple[int, ...]], bool]:
    """The smallest supports of the combinations that vanish, and whether they are all."""
    leading = _leading(tied)
    ties = leading.shape[1]
    if ties == 1 or comb(len(tied), ties - 1) > MOST_SUBSETS:
        return _present(leading.T), ties == 1
    basis = svd(tied)[0][:, :ties]
    absent = numpy.array(list(combinations(range(len(tied)), ties - 1)))
    _, values, right = svd(basis[absent])
    is_alone = values.min(axis=1) > _INDEPENDENT
    return _present(right[is_alone, -1] @ basis.T), True


def _present(vectors: numpy.ndarray) -> list[tuple[int, ...]]:
    """Of each row, the places where it is not zero; each once."""
    sizes = abs(vectors)
    is_there = sizes > _ABSENT * sizes.max(axis=1, keepdims=True, initial=0.0)
    return list(dict.fromkeys(tuple(numpy.flatnonzero(row).tolist()) for row in is_there))
