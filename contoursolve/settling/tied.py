"""Which facts a fact that is one too many follows from."""

from contoursolve.analysis import judge
from contoursolve.analysis.verdict import survey
from contoursolve.constraints import System
from contoursolve.model import Fact


def tied_with(system: System, fact: Fact) -> tuple[str, ...]:
    """The givens of a smallest set of facts from which a fact of the system follows, with its own, in the order of
    the facts.

    A fact beside the basis can replace exactly those facts of the basis that it is tied with. A fact of the basis
    is tied with the first fact beside it that can replace it.
    """
    verdict = judge(system)
    if system.facts.index(fact) in verdict.basis:
        spare = (each for index, each in enumerate(system.facts) if index not in verdict.basis)
        return next((names for names in (tied_with(system, each) for each in spare) if fact.given in names), ())
    basis = tuple(system.facts[index] for index in verdict.basis)
    # A fact without unknowns is about the givens alone, and the angles among them tell which.
    replaceable = basis if system.unknowns_of(fact) else ()
    tied = [each for each in replaceable if _rank(system, basis, each, fact) == verdict.rank]
    names = [name for each in (*tied, fact) for name in (*headings_of(each, system), each.given) if name]
    return tuple(dict.fromkeys(names))


def _rank(system: System, basis: tuple[Fact, ...], old: Fact, new: Fact) -> int:
    return survey(system.keep((*(fact for fact in basis if fact is not old), new))).rank


def headings_of(fact: Fact, system: System) -> tuple[str, ...]:
    """The given angles of the lines that a fact speaks about."""
    lines = (name.rpartition(".")[0] for name in fact.reads())
    return tuple(dict.fromkeys(system.headed[line][0] for line in lines if line in system.headed))
