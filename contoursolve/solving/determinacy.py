"""The facts that determine each unknown, and on which condition: the rank at random values, and sympy's verdict for all
values."""

import pkgutil
from collections.abc import Collection, Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from msgspec import Struct, json
from msgspec.structs import replace

from contoursolve.geometry import Fact, System, scalar
from contoursolve.numeric import (
    COSINE,
    RESIDUES,
    SIDE,
    SINE,
    ExactRank,
    Residue,
    draw,
    draw_direction,
    modular_rank,
)
from contoursolve.solving.inputs import Headed, headed_of, input_values, symbolic_values
from contoursolve.solving.partition import Group, order


def generic_rank(system: System) -> ExactRank:
    """The rank of the facts' derivatives by the unknowns, at random values modulo a prime."""
    columns = {name: number for number, name in enumerate(system.unknowns)}
    slopes = (_slopes(fact, headed_of(system, [fact]), system.unknowns_of(fact)) for fact in system.facts)
    rows = [{columns[name]: slope for name, slope in each.items()} for each in slopes]
    return modular_rank.exact_rank(rows, len(columns))


class _Witnesses(NamedTuple):
    """Random values of all inputs, some of which are unknowns."""

    unknowns: Collection[str]

    def input(self, name: str) -> Residue:
        """The value of an input; the derivative of an unknown by itself is 1."""
        return Residue(witness_of(name), {name: 1} if name in self.unknowns else {})


@lru_cache(maxsize=8192)
def _slopes(fact: Fact, headed: Headed, unknowns: tuple[str, ...]) -> Mapping[str, int]:
    """The derivatives of a fact by the unknowns that it reads, those that are not zero: the same in every system."""
    value = fact.equation(input_values(dict(headed), _Witnesses(unknowns), {}, RESIDUES))
    return {name: slope for name, slope in value.slopes.items() if slope}


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


class Determinacy(Struct, frozen=True):
    """The generic properties of a system, exact for all values but those on which `condition` is zero.

    `basis` are the indices of the first facts that determine as much as all of them do; `tied` those
    of facts that take part in a dependency; `free` the unknown scalars that nothing determines.
    `condition` is the determinant of the basis, as text (empty unless all unknowns are determined), without the
    groups of more than `LARGEST_DETERMINANT` unknowns.
    """

    rank: int
    basis: tuple[int, ...]
    tied: tuple[int, ...]
    free: tuple[str, ...]
    condition: str

    @property
    def is_determined(self) -> bool:
        """Whether the facts determine every unknown, except on the condition."""
        return not self.free


SEEDS = (1, 2)
"""The rank is the largest at these random points; a rational point misses it with probability of
about degree / range, 1e-3 (Schwartz 1980), two of them with 1e-6, and the shipped table is checked."""


@lru_cache(maxsize=8192)
def analyse(system: System) -> Determinacy:
    """The verdict on a system: from the table that ships with the package, else by the rank at random values.

    Importing sympy takes longer than solving a program, and its verdict on a combination of words
    never changes, so those of all the controls' forms are kept in `verdicts.json`; a test compares
    every one of them with `derive`. Systems with further facts are judged without sympy, and without a condition.
    """
    known = _shipped().get(system.equations_key)
    return _from_json(known) if known else survey(system)


def is_known(system: System) -> bool:
    """Whether the table that ships has the verdict on a system."""
    return system.equations_key in _shipped()


def basis_of(system: System) -> tuple[Fact, ...]:
    """The first facts that determine as much as all facts of a system do."""
    return tuple(system.facts[index] for index in analyse(system).basis)


def spare_of(system: System) -> tuple[Fact, ...]:
    """The facts beside the basis: they say what others say already."""
    basis = frozenset(analyse(system).basis)
    return tuple(fact for index, fact in enumerate(system.facts) if index not in basis)


@lru_cache(maxsize=256)
def groups_of(system: System) -> tuple[Group, ...]:
    """The groups of the basis of a determined system, in the order in which they are solved."""
    return order(system, basis_of(system))


def blocks_of(system: System, verdict: Determinacy) -> tuple[tuple[Group, ...], Group, tuple[Fact, ...]]:
    """A system in its blocks: groups that are solved one after the other, the unknowns that stay open with the facts
    about them, and facts that repeat others."""
    basis = [system.facts[row] for row in verdict.basis]
    known = [name for name in system.unknowns if name not in verdict.free]
    about = [fact for fact in basis if not set(verdict.free).intersection(system.unknowns_of(fact))]
    try:
        groups = order(system, about, known)
    except ValueError:  # some of them follow only from facts about what is open
        groups, about, known = (), [], []
    left = Group(
        tuple(fact for fact in basis if fact not in about),
        tuple(name for name in system.unknowns if name not in known),
    )
    return groups, left, tuple(fact for fact in system.facts if fact not in basis)


@lru_cache(maxsize=256)
def circuits_of(system: System) -> Mapping[Fact, tuple[Fact, ...]]:
    """For each fact beside the basis, the facts of the basis from which it follows, in order: one elimination tells it
    for all of them."""
    circuits = generic_rank(system).circuits.items()
    return {system.facts[number]: tuple(system.facts[row] for row in rows) for number, rows in circuits}


def survey(system: System) -> Determinacy:
    """The verdict on a system without sympy, from its rank modulo a prime; it has no condition."""

    rank = generic_rank(system)
    free = tuple(system.unknowns[column] for column in rank.free_columns)
    return Determinacy(rank.rank, rank.independent_rows, rank.dependent_rows, free, "")


def derive(system: System) -> Determinacy:
    """The verdict on a system, by sympy: exact rank of the Jacobian at random rational points, and the condition."""
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - 200 ms, see analyse

    symbols = symbolic.Symbols()
    matrix = jacobian_of(system, symbols)
    found = rank_of(system, symbols, matrix)
    if found.free or not found.basis:
        return found
    return replace(found, condition=_condition(system, symbols, matrix, found.basis))


def jacobian_of(system: System, symbols: Any) -> Any:
    """The derivatives of a system's equations by its unknowns, as a matrix of sympy."""
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - see analyse

    at = symbolic_values(symbols, symbolic.FUNCTIONS, system.headed)
    residuals = [fact.equation(at) for fact in system.facts]
    return symbolic.jacobian(residuals, [symbols.scalar(name) for name in system.unknowns])


def rank_of(system: System, symbols: Any, matrix: Any) -> Determinacy:
    """The verdict on a system by the exact rank of its Jacobian, without the condition."""
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - see analyse

    if not system.facts:
        return Determinacy(0, (), (), system.unknowns, "")
    ranks = [symbolic.exact_rank(matrix, symbols.random_point(seed)) for seed in SEEDS]
    best = max(ranks, key=lambda each: each.rank)
    free = tuple(system.unknowns[column] for column in best.free_columns)
    return Determinacy(best.rank, best.independent_rows, best.dependent_rows, free, "")


def _condition(system: System, symbols: Any, matrix: Any, basis: Sequence[int]) -> str:
    """The value that must not be zero: the product of the conditions of the groups."""
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - see analyse

    found = conditions_of(system, symbols, matrix, basis)
    return str(symbolic.product(factor for each in found for factor in each.factors))


LARGEST_DETERMINANT = 5
"""The determinant of a larger group has hundreds of terms and tells nobody anything."""


class StepCondition(Struct, frozen=True):
    """A group of facts that determines its unknowns unless one of `factors` (expressions of sympy) is zero. None of
    them where it always does, or where the group has more than `LARGEST_DETERMINANT` unknowns (`is_large`)."""

    group: Group
    factors: tuple[Any, ...]
    is_large: bool = False


def conditions_of(system: System, symbols: Any, matrix: Any, basis: Sequence[int]) -> list[StepCondition]:
    """The conditions on which the basis of a determined system determines it, group by group in the order in which they
    are solved, in the `symbols` of `matrix`, its Jacobian."""
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - see analyse

    groups = order(system, [system.facts[index] for index in basis])
    row_of = {system.facts[index]: index for index in basis}
    column_of = {name: index for index, name in enumerate(system.unknowns)}
    known, found = dict[Any, Any](), list[StepCondition]()
    for group in groups:
        if len(group.unknowns) > LARGEST_DETERMINANT:
            found.append(StepCondition(group, (), is_large=True))
            continue
        part = matrix.extract([row_of[fact] for fact in group.facts], [column_of[name] for name in group.unknowns])
        found.append(StepCondition(group, symbolic.determinant(part, symbols, known)))
        known |= _stated(group, symbols, known)
    return found


def _stated(group: Group, symbols: Any, known: Mapping[Any, Any]) -> dict[Any, Any]:
    """The coordinate that a word states, as that word, so that conditions on later groups tell of words."""
    placed = group.facts[0].placed
    if len(group.facts) > 1 or placed is None:
        return {}
    origin = symbols.scalar(scalar(placed.origin, placed.axis)) if placed.origin else 0
    step = symbols.scalar(group.facts[0].given) if placed.is_stepped else 0
    return {symbols.scalar(group.unknowns[0]): known.get(origin, origin) + step}


@lru_cache(maxsize=1)
def _shipped() -> dict[str, Any]:
    data = pkgutil.get_data(__package__, "verdicts.json")
    table: dict[str, Any] = json.decode(data) if data else {}
    return table


def _from_json(row: dict[str, Any]) -> Determinacy:
    return Determinacy(row["rank"], tuple(row["basis"]), tuple(row["tied"]), tuple(row["free"]), row["condition"])
