"""Sympy's verdict on a system for all values of its words: what determines what, under which condition."""

import json
import pkgutil
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from contoursolve.analysis.partition import order
from contoursolve.constraints import System


@dataclass(frozen=True, slots=True)
class Verdict:
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
def judge(system: System) -> Verdict:
    """The verdict on a system: from the table that ships with the package, else by the rank at random values.

    Importing sympy takes longer than solving a program, and its verdict on a combination of words
    never changes, so those of all the controls' forms are kept in `verdicts.json`; a test compares
    every one of them with `derive`. Systems with further facts are judged without sympy, and without a condition.
    """
    known = _shipped().get(system.equations_key)
    return _from_json(known) if known else survey(system)


def survey(system: System) -> Verdict:
    """The verdict on a system without sympy, from its rank modulo a prime; it has no condition."""
    from contoursolve.analysis.generic import generic_rank  # noqa: PLC0415 - the shipped systems do not need it

    rank = generic_rank(system)
    free = tuple(system.unknowns[column] for column in rank.free_columns)
    return Verdict(rank.rank, rank.independent_rows, rank.dependent_rows, free, "")


def derive(system: System) -> Verdict:
    """The verdict on a system, by sympy: exact rank of the Jacobian at random rational points."""
    from contoursolve.backends import symbolic  # noqa: PLC0415 - 200 ms, see judge

    symbols = symbolic.Symbols()
    at = symbols.lookup(system.headed)
    residuals = [fact.equation(at) for fact in system.facts]
    unknowns = [symbols.scalar(name) for name in system.unknowns]
    if not residuals:
        return Verdict(0, (), (), system.unknowns, "")
    matrix = symbolic.jacobian(residuals, unknowns)
    ranks = [symbolic.exact_rank(matrix, symbols.random_point(seed)) for seed in SEEDS]
    best = max(ranks, key=lambda each: each.rank)
    is_determined = not best.free_columns
    basis = best.independent_rows
    return Verdict(
        rank=best.rank,
        basis=basis,
        tied=best.dependent_rows,
        free=tuple(system.unknowns[column] for column in best.free_columns),
        condition=_condition(system, matrix, basis) if is_determined else "",
    )


LARGEST_DETERMINANT = 5
"""The determinant of a larger group has hundreds of terms and tells nobody anything."""


def _condition(system: System, matrix: Any, basis: Sequence[int]) -> str:
    """What must not be zero: the product of the determinants of the groups that are solved one after the other."""
    from contoursolve.backends import symbolic  # noqa: PLC0415 - see judge

    groups = order(system, [system.facts[index] for index in basis])
    row_of = {system.facts[index]: index for index in basis}
    column_of = {name: index for index, name in enumerate(system.unknowns)}
    small = [group for group in groups if len(group.unknowns) <= LARGEST_DETERMINANT]
    return symbolic.determinants(
        [
            matrix.extract([row_of[fact] for fact in group.facts], [column_of[name] for name in group.unknowns])
            for group in small
        ]
    )


@lru_cache(maxsize=1)
def _shipped() -> dict[str, Any]:
    data = pkgutil.get_data("contoursolve.analysis", "verdicts.json")
    table: dict[str, Any] = json.loads(data) if data else {}
    return table


def _from_json(row: dict[str, Any]) -> Verdict:
    return Verdict(row["rank"], tuple(row["basis"]), tuple(row["tied"]), tuple(row["free"]), row["condition"])
