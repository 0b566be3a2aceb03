"""Identities: how words that say the same depend on one another, for all values, by sympy."""

from collections.abc import Sequence
from typing import Any

from contoursolve.geometry import Fact, System
from contoursolve.solving.inputs import symbolic_values


def tie_of(system: System, facts: Sequence[Fact], symbols: Any) -> Any:
    """The equation that facts which say the same make their words satisfy, in the `symbols` of sympy: the last length
    as a formula of the other words, or what two points of one circle have in common. None where neither is the case.

    Lengths are radius values; S.0 and S.1 are the start point's coordinates.
    """
    return _of_lengths(system, facts, symbols) if is_affine(facts) else _of_circle(system, facts, symbols)


def _of_lengths(system: System, facts: Sequence[Fact], symbols: Any) -> Any:
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - sympy is slow to import, see analyse

    lengths = [fact for fact in facts if fact.placed and fact.given]
    at = symbolic_values(symbols, symbolic.FUNCTIONS, system.headed)
    unknowns = [symbols.scalar(name) for name in system.unknowns]
    if not lengths:
        return None
    last = symbols.scalar(lengths[-1].given)
    solved = symbolic.eliminate([fact.residual(at) for fact in facts], unknowns, last)
    return symbolic.equation(last, solved) if solved is not None else None


def _of_circle(system: System, facts: Sequence[Fact], symbols: Any) -> Any:
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - sympy is slow to import, see analyse

    circles = [fact for fact in facts if fact.circle]
    if len(circles) != 2 or len({fact.circle[1:3] for fact in circles if fact.circle}) != 1:  # noqa: PLR2004
        return None
    at = symbolic_values(symbols, symbolic.FUNCTIONS, system.headed)
    first, second = (fact.equation(at) for fact in circles)
    affine = [fact.residual(at) for fact in facts if not fact.circle]
    unknowns = [symbols.scalar(name) for name in system.unknowns]
    found = symbolic.substitute_solution(first - second, affine, unknowns)
    # What the words leave open of the circle takes part in no formula of theirs.
    is_open = found is None or not found.free_symbols.isdisjoint(unknowns)
    return None if is_open else symbolic.equation(found, 0)


def derive_identity(system: System, facts: Sequence[Fact]) -> str:
    """The same as text, such as `K = I/tan(A)`; empty if there is none."""
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - sympy is slow to import, see analyse

    found = tie_of(system, facts, symbolic.Symbols())
    return f"{found.lhs} = {found.rhs}" if found is not None else ""


def is_affine(facts: Sequence[Fact]) -> bool:
    """Whether all facts are affine in the unknowns."""
    return all(fact.is_affine for fact in facts)
