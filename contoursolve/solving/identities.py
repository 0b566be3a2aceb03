"""Identities: how words that say the same depend on one another, for all values, by sympy."""

from collections.abc import Sequence

from contoursolve.geometry import Fact, System
from contoursolve.solving.inputs import symbolic_values


def derive_identity(system: System, facts: Sequence[Fact]) -> str:
    """The last length among the facts as a formula of the other words, such as `K = I/tan(A)`.

    All facts must be affine in the unknowns. Lengths are radius values; S.0 and S.1 are the start
    point's coordinates.
    """
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - sympy is slow to import, see analyse

    lengths = [fact for fact in facts if fact.placed and fact.given]
    symbols = symbolic.Symbols()
    at = symbolic_values(symbols, symbolic.FUNCTIONS, system.headed)
    unknowns = [symbols.scalar(name) for name in system.unknowns]
    if not lengths:
        return ""
    solved = symbolic.eliminate([fact.residual(at) for fact in facts], unknowns, symbols.scalar(lengths[-1].given))
    return f"{lengths[-1].given} = {solved}" if solved else ""


def derive_circle_identity(system: System, facts: Sequence[Fact]) -> str:
    """The equation that two points of one circle make their words satisfy, a formula that is zero; empty if the tie is
    another one. S.0 and S.1 are the start point's coordinates."""
    from contoursolve.numeric import symbolic  # noqa: PLC0415 - sympy is slow to import, see analyse

    circles = [fact for fact in facts if fact.circle]
    if len(circles) != 2 or len({fact.circle[1:3] for fact in circles if fact.circle}) != 1:  # noqa: PLR2004
        return ""
    symbols = symbolic.Symbols()
    at = symbolic_values(symbols, symbolic.FUNCTIONS, system.headed)
    first, second = (fact.equation(at) for fact in circles)
    affine = [fact.residual(at) for fact in facts if not fact.circle]
    return symbolic.substitute_solution(first - second, affine, [symbols.scalar(name) for name in system.unknowns])


def is_affine(facts: Sequence[Fact]) -> bool:
    """Whether all facts are affine in the unknowns."""
    return all(fact.is_affine for fact in facts)
