"""Structure of a system: which fact can determine which unknown, and in which order."""

from collections.abc import Sequence
from typing import NamedTuple

from contoursolve.geometry import Fact, System


class Group(NamedTuple):
    """Facts that determine the unknowns together, given all groups before."""

    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]


def match(system: System, facts: Sequence[Fact], unknowns: Sequence[str] | None = None) -> dict[str, Fact]:
    """A maximum matching from unknowns to facts; earlier facts are matched in preference to later ones.

    `unknowns` are those of the system unless told otherwise.
    Augmenting paths (Berge 1957); the matched facts are the greedy basis of a transversal matroid.
    """
    matched: dict[str, Fact] = {}
    wanted = frozenset(system.unknowns if unknowns is None else unknowns)

    def augment(fact: Fact, seen: set[str]) -> bool:
        for unknown in system.unknowns_of(fact):
            if unknown in wanted and unknown not in seen:
                seen.add(unknown)
                if unknown not in matched or augment(matched[unknown], seen):
                    matched[unknown] = fact
                    return True
        return False

    for fact in facts:
        augment(fact, set())
    return matched


def order(system: System, facts: Sequence[Fact], unknowns: Sequence[str] | None = None) -> tuple[Group, ...]:
    """The finest sequence of groups in which each determines its unknowns from the ones before.

    `facts` must match all unknowns (of the system, unless told otherwise) one to one; raises ValueError if not.
    The groups are the strongly connected components of
    the matched incidence graph (Tarjan 1972), the block triangular form of Dulmage and Mendelsohn.
    """
    wanted = system.unknowns if unknowns is None else tuple(unknowns)
    matched = match(system, facts, wanted)
    if len(matched) != len(wanted) or len(facts) != len(matched):
        raise ValueError(f"{len(facts)} facts match {len(matched)} of {len(wanted)} unknowns")
    places = {name: place for place, name in enumerate(wanted)}
    numbers = {id(fact): number for number, fact in enumerate(facts)}
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: dict[str, None] = {}
    """In the order in which they were met."""
    groups: list[Group] = []

    def visit(unknown: str) -> None:
        index[unknown] = low[unknown] = len(index)
        stack[unknown] = None
        for needed in system.unknowns_of(matched[unknown]):
            if needed not in matched:
                continue
            if needed not in index:
                visit(needed)
                low[unknown] = min(low[unknown], low[needed])
            elif needed in stack:
                low[unknown] = min(low[unknown], index[needed])
        if low[unknown] == index[unknown]:
            members = [stack.popitem()[0]]
            while members[-1] != unknown:
                members.append(stack.popitem()[0])
            names = tuple(sorted(members, key=places.__getitem__))
            own = sorted((matched[name] for name in names), key=lambda fact: numbers[id(fact)])
            groups.append(Group(tuple(own), names))

    for unknown in wanted:
        if unknown not in index:
            visit(unknown)
    return tuple(groups)


class Parts(NamedTuple):
    """The Dulmage-Mendelsohn parts of a system, by structure alone (Dulmage and Mendelsohn 1958).

    The facts of the over-determined part are more than its unknowns; the unknowns of the
    under-determined part are more than its facts; the rest fits one to one.
    """

    over_facts: tuple[Fact, ...]
    over_unknowns: tuple[str, ...]
    under_facts: tuple[Fact, ...]
    under_unknowns: tuple[str, ...]


def decompose(system: System) -> Parts:
    """The over- and the under-determined part: all that alternating paths reach from what is unmatched."""
    fact_of = match(system, system.facts)
    unknown_of = {fact: unknown for unknown, fact in fact_of.items()}
    over = [fact for fact in system.facts if fact not in unknown_of]
    over_unknowns: list[str] = []
    for fact in over:
        for unknown in system.unknowns_of(fact):
            if unknown not in over_unknowns:
                over_unknowns.append(unknown)
                over.append(fact_of[unknown])
    under = [unknown for unknown in system.unknowns if unknown not in fact_of]
    under_facts: list[Fact] = []
    for unknown in under:
        for fact in system.facts:
            if unknown in system.unknowns_of(fact) and fact not in under_facts:
                under_facts.append(fact)
                under.append(unknown_of[fact])
    return Parts(
        tuple(fact for fact in system.facts if fact in over),
        tuple(name for name in system.unknowns if name in over_unknowns),
        tuple(fact for fact in system.facts if fact in under_facts),
        tuple(name for name in system.unknowns if name in under),
    )
