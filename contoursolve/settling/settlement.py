"""Looks for every contour of a profile, and says which of its facts are to blame where there is none."""

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass, replace

from contoursolve.analysis import Group, judge, order
from contoursolve.analysis.identities import is_affine
from contoursolve.constraints import System, assemble
from contoursolve.model import Layout, Profile, scalar
from contoursolve.settling.restrict import restrict
from contoursolve.settling.tied import headings_of
from contoursolve.solving import Refusal, RefusalKind, Solution, Status, solve
from contoursolve.solving.alternatives import Alternative, Alternatives, find_alternatives
from contoursolve.solving.decide import decide
from contoursolve.solving.elimination import Obstacle
from contoursolve.solving.enumerate import enumerate_solutions


@dataclass(frozen=True, slots=True)
class Settlement:
    """The contour of a profile or what speaks against it, and every solution of its equations.

    `singular` are the givens of facts that do not fix what they speak about at their values, and `loose` is that;
    both are empty where there is another reason.
    """

    solution: Solution
    alternatives: Alternatives
    singular: tuple[str, ...] = ()
    loose: tuple[str, ...] = ()


def settle(profile: Profile) -> Settlement:
    """The contour that the control makes of a determined profile, or the only one that there is.

    Where the first facts are singular at their values, those that were not needed are tried instead of them.
    """
    alternatives = find_alternatives(profile)
    if not alternatives.items and _singular(alternatives):
        tried = (find_alternatives(other) for other in orders_of(profile))
        alternatives = next((found for found in tried if not _singular(found)), alternatives)
    nearest = tuple(sorted(alternatives.items, key=_disagreement))
    solution = decide(replace(alternatives, items=nearest), profile)
    kinds = {refusal.kind for refusal in solution.refusals}
    if not kinds & {RefusalKind.NO_POINT, RefusalKind.SEARCH_UNFINISHED}:
        return Settlement(solution, alternatives)
    system = assemble(profile)
    groups = _groups(system)
    if RefusalKind.NO_POINT in kinds:
        dead = _dead(profile, groups)
        return Settlement(_affine(profile, groups, dead) or _blame(solution, dead, groups, system), alternatives)
    unknowns = {name for doubt in alternatives.doubts for name in doubt.unknowns}
    doubtful = [group for group in groups if not unknowns.isdisjoint(group.unknowns)]
    singular = _singular(alternatives)
    if not singular:
        return Settlement(_blame(solution, doubtful, groups, system), alternatives)
    found = _affine(profile, groups, doubtful)
    if found is not None:
        return Settlement(found, alternatives)
    solution = Solution(Status.UNDERDETERMINED)
    return Settlement(solution, alternatives, _givens(doubtful, groups, system), tuple(singular))


def settled_by(profile: Profile, unknown: str) -> tuple[str, ...]:
    """The givens of the facts that determine an unknown together."""
    system = assemble(profile)
    groups = _groups(system)
    return _givens([group for group in groups if unknown in group.unknowns], groups, system)


def _singular(alternatives: Alternatives) -> list[str]:
    """The unknowns of a step whose facts do not fix them at their values."""
    doubts = (doubt for doubt in alternatives.doubts if doubt.obstacle is Obstacle.SINGULAR)
    return list(dict.fromkeys(name for doubt in doubts for name in doubt.unknowns))


def orders_of(profile: Profile) -> Iterator[Profile]:
    """The profile with one of the facts that were not needed put first, so that it is."""
    basis = judge(assemble(profile)).basis
    for index, fact in enumerate(profile.facts):
        if index not in basis:
            rest = (each for each in profile.facts if each is not fact)
            yield replace(profile, layout=Layout(profile.figure, (fact, *rest)))


def _disagreement(item: Alternative) -> float:
    """By how much facts that were not needed disagree with a solution, mm."""
    return sum(refusal.values.get("off_by_mm", 0.0) for refusal in item.solution.refusals)


def _groups(system: System) -> tuple[Group, ...]:
    return order(system, tuple(system.facts[index] for index in judge(system).basis))


def _dead(profile: Profile, groups: tuple[Group, ...]) -> list[Group]:
    """The first group that has no solution after the groups before it; found by halving."""

    def is_dead(number: int) -> bool:
        part = _first(profile, groups[: number + 1])
        system = assemble(part)
        if not system.unknowns or not judge(system).is_determined:
            return False
        return not enumerate_solutions(part, system).found

    # Of all groups together it is known.
    number = bisect_left(range(len(groups) - 1), True, key=is_dead)
    return [groups[number]]


def _first(profile: Profile, groups: tuple[Group, ...]) -> Profile:
    """The part of a profile that some groups determine, without points of which one coordinate is determined."""
    names = {name for group in groups for name in group.unknowns}
    half = [
        pair for point in profile.figure.points if not names.issuperset(pair := {scalar(point, 0), scalar(point, 1)})
    ]
    return restrict(profile, names.difference(*half))


def _blame(solution: Solution, blamed: list[Group], groups: tuple[Group, ...], system: System) -> Solution:
    """The solution whose refusal names the facts of some groups."""
    subject = ",".join(name for group in blamed for name in group.unknowns)
    givens = _givens(blamed, groups, system)
    refusals = (replace(each, subject=subject, givens=givens) for each in solution.refusals)
    return replace(solution, refusals=tuple(refusals))


def _givens(blamed: list[Group], groups: tuple[Group, ...], system: System) -> tuple[str, ...]:
    """What states the facts of some groups; for a fact that nothing states, what it builds on."""
    names: dict[str, None] = {}
    for fact in (fact for group in blamed for fact in group.facts):
        names |= dict.fromkeys(name for name in (fact.given, *headings_of(fact, system)) if name)
        if not fact.given:
            used = set(system.unknowns_of(fact)).difference(*(group.unknowns for group in blamed))
            earlier = [group for group in groups if not used.isdisjoint(group.unknowns)]
            names |= dict.fromkeys(_givens(earlier, groups, system))
    return tuple(names)


def _affine(profile: Profile, groups: tuple[Group, ...], doubtful: list[Group]) -> Solution | None:
    """What the solver of ordinary words says of a group, where it and all before it are about such words."""
    part = _first(profile, groups[: groups.index(doubtful[0]) + 1])
    system = assemble(part)
    if not is_affine(part.facts) or not judge(system).is_determined:
        return None
    refusals = [each for each in solve(part).refusals if isinstance(each, Refusal)]
    return Solution(refusals[0].kind.status, refusals=tuple(refusals)) if refusals else None
