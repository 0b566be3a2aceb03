"""Structure of a system: which fact can determine which unknown, and in which order."""

from collections.abc import Sequence
from typing import NamedTuple

from contoursolve.constraints import System
from contoursolve.model import Fact


class Group(NamedTuple):
    """Facts that determine the unknowns together, given all groups before."""

    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]


def match(system: System, facts: Sequence[Fact]) -> dict[str, Fact]:
    """A maximum matching from unknowns to facts; earlier facts are matched in preference to later ones.

    Augmenting paths (Berge 1957); the matched facts are the greedy basis of a transversal matroid.
    """
    matched: dict[str, Fact] = {}

    def augment(fact: Fact, seen: set[str]) -> bool:
        for unknown in system.unknowns_of(fact):
            if unknown not in seen:
                seen.add(unknown)
                if unknown not in matched or augment(matched[unknown], seen):
                    matched[unknown] = fact
                    return True
        return False

    for fact in facts:
        augment(fact, set())
    return matched


def order(system: System, facts: Sequence[Fact]) -> tuple[Group, ...]:
    """The finest sequence of groups in which each determines its unknowns from the ones before.

    `facts` must match all unknowns one to one. The groups are the strongly connected components of
    the matched incidence graph (Tarjan 1972), the block triangular form of Dulmage and Mendelsohn.
    """
    matched = match(system, facts)
    if len(matched) != len(system.unknowns) or len(facts) != len(matched):
        raise ValueError(f"{len(facts)} facts match {len(matched)} of {len(system.unknowns)} unknowns")
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    groups: list[Group] = []

    def visit(unknown: str) -> None:
        index[unknown] = low[unknown] = len(index)
        stack.append(unknown)
        for needed in system.unknowns_of(matched[unknown]):
            if needed not in index:
                visit(needed)
                low[unknown] = min(low[unknown], low[needed])
            elif needed in stack:
                low[unknown] = min(low[unknown], index[needed])
        if low[unknown] == index[unknown]:
            members = stack[stack.index(unknown) :]
            del stack[stack.index(unknown) :]
            names = tuple(name for name in system.unknowns if name in members)
            own = {id(matched[name]) for name in names}
            groups.append(Group(tuple(fact for fact in facts if id(fact) in own), names))

    for unknown in system.unknowns:
        if unknown not in index:
            visit(unknown)
    return tuple(groups)
