"""Contours with open choices, further facts or asked values: all solutions, or the facts that are to blame."""

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence, Set
from decimal import Decimal

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.gcode import Word
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Coordinate,
    Fact,
    Given,
    Layout,
    Line,
    Profile,
    System,
    Through,
    Unit,
    assemble,
    both,
    line_scalars,
    scalar,
)
from contoursolve.solving.affine import affine_facts
from contoursolve.solving.alternatives import decide, find_alternatives
from contoursolve.solving.closed_steps import is_searched
from contoursolve.solving.compare import compare_affine
from contoursolve.solving.construction import is_closed
from contoursolve.solving.determinacy import analyse, groups_of
from contoursolve.solving.enumerate import Enumeration, enumerate_solutions
from contoursolve.solving.events import Status, Topic, events_about, refusals_about
from contoursolve.solving.identities import is_affine
from contoursolve.solving.partition import Group
from contoursolve.solving.solution import Alternative, Alternatives, Note, Obstacle, Refusal, SystemSolution
from contoursolve.solving.solve import solve


def restrict(profile: Profile, names: Iterable[str]) -> Profile:
    """The profile with the facts about these unknowns alone, and with no path.

    Where only a part of a point or of a line is among them, the other part, of which nothing is said then, is put
    somewhere.
    """
    system, kept = assemble(profile), frozenset(names)
    figure = profile.figure
    facts: list[Fact] = [fact for fact in profile.facts if kept.issuperset(system.unknowns_of(fact))]
    givens = dict(profile.givens)
    points = tuple(point for point in figure.points if not kept.isdisjoint(both(point)))
    for point in points:
        for axis in (FIRST, SECOND):
            if scalar(point, axis) not in kept:
                name = f"{point} somewhere along {axis}"
                givens[name] = Given(name, profile.start.values[axis] or Decimal(0), Unit.MM, None)
                facts.append(Coordinate(name, point, axis))
    carriers = tuple(line for line in figure.carriers if not kept.isdisjoint(line_scalars(line)))
    facts += [Through(line, figure.start) for line in carriers if line_scalars(line)[2] not in kept]
    lines = tuple(
        # A line has a sense where both its ends are known, not where one has been put somewhere.
        replace(line, head=line.head if kept.issuperset(both(line.tail, line.head)) else "")
        for line in (*figure.path, *figure.lines)
        if isinstance(line, Line)
    )
    part = replace(
        figure,
        points=points,
        radii=tuple(radius for radius in figure.radii if radius in kept),
        path=(),
        corners=(),
        lines=lines,
        carriers=carriers,
    )
    return replace(profile, layout=Layout(part, tuple(facts)), givens=givens, choices=(), questions=())


def headings_of(fact: Fact, system: System) -> tuple[str, ...]:
    """The given angles of the lines that a fact speaks about."""
    lines = (name.rpartition(".")[0] for name in fact.reads())
    return tuple(dict.fromkeys(system.headed[line][0] for line in lines if line in system.headed))


class Settlement(Struct, frozen=True):
    """The contour of a profile or what speaks against it, and every solution of its equations.

    `singular` are the givens of facts that do not fix what they speak about at their values, and `loose` is that;
    both are empty where there is another reason.
    """

    solution: SystemSolution
    alternatives: Alternatives
    singular: tuple[str, ...] = ()
    loose: tuple[str, ...] = ()


def settle(profile: Profile, *, is_blaming: bool = True, enumeration: Enumeration | None = None) -> Settlement:
    """The contour that the control makes of a determined profile, or the only one that there is; `enumeration` has its
    solutions if they are known.

    Where the first facts are singular or undecided at their values, those that were not needed are tried instead. Which
    facts are to blame where there is no contour takes searches of its own.
    """
    alternatives = find_alternatives(profile, enumeration)
    unsettled = [] if alternatives.items else _unsettled(alternatives)
    if unsettled:
        tried = (find_alternatives(other) for other in (*orders_of(profile), *_last(profile, unsettled)))
        alternatives = next((found for found in tried if not _unsettled(found)), alternatives)
    nearest = tuple(sorted(alternatives.items, key=_disagreement))
    solution = decide(replace(alternatives, items=nearest), profile)
    if not is_blaming or all(refusal.kind not in _SEARCHED for refusal in solution.refusals):
        return Settlement(solution, alternatives)
    system = assemble(profile)
    groups = groups_of(system)
    if alternatives.is_complete:
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
    solution = SystemSolution(Status.UNDERDETERMINED)
    return Settlement(solution, alternatives, _givens(doubtful, groups, system), tuple(singular))


def settled_by(profile: Profile, unknown: str) -> tuple[str, ...]:
    """The givens of the facts that determine an unknown together."""
    system = assemble(profile)
    groups = groups_of(system)
    return _givens([group for group in groups if unknown in group.unknowns], groups, system)


def _singular(alternatives: Alternatives) -> list[str]:
    """The unknowns of a step whose facts do not fix them at their values."""
    doubts = (doubt for doubt in alternatives.doubts if doubt.obstacle is Obstacle.SINGULAR)
    return list(dict.fromkeys(name for doubt in doubts for name in doubt.unknowns))


def _unsettled(alternatives: Alternatives) -> list[str]:
    """The unknowns of steps that are singular, or too close to decide, at their values."""
    doubts = (doubt for doubt in alternatives.doubts if doubt.obstacle in (Obstacle.SINGULAR, Obstacle.UNDECIDED))
    return list(dict.fromkeys(name for doubt in doubts for name in doubt.unknowns))


def orders_of(profile: Profile) -> Iterator[Profile]:
    """The profile with one of the facts that were not needed put first, so that it is."""
    basis = analyse(assemble(profile)).basis
    for index, fact in enumerate(profile.facts):
        if index not in basis:
            rest = (each for each in profile.facts if each is not fact)
            yield replace(profile, layout=Layout(profile.figure, (fact, *rest)))


def _last(profile: Profile, unknowns: Sequence[str]) -> Iterator[Profile]:
    """The profile with one of the facts that do not fix some unknowns at their values put last, so that another one is
    needed instead, where something is said twice."""
    system = assemble(profile)
    if len(system.facts) <= len(system.unknowns):
        return
    for group in groups_of(system):
        for fact in group.facts if not set(unknowns).isdisjoint(group.unknowns) else ():
            rest = (each for each in profile.facts if each is not fact)
            yield replace(profile, layout=Layout(profile.figure, (*rest, fact)))


def _disagreement(item: Alternative) -> float:
    """By how much facts that were not needed disagree with a solution, mm."""
    return sum(refusal.values.get("off_by_mm", 0.0) for refusal in item.solution.refusals)


def before(profile: Profile, words: Set[Word]) -> Profile | None:
    """The part of a profile that is solved before the group whose facts these words state, all of them and no others;
    None where no group is stated so, or none is before it."""
    system = assemble(profile)
    groups = groups_of(system)
    for number, group in enumerate(groups):
        stated = (profile.givens[name].word for name in _without_point([group], groups, system))
        if number and {word for word in stated if word is not None} == words:
            return _first(profile, groups[:number])
    return None


def _dead(profile: Profile, groups: tuple[Group, ...]) -> list[Group]:
    """The first group that has no solution after the groups before it; found by halving."""

    def is_dead(number: int) -> bool:
        part = _first(profile, groups[: number + 1])
        system = assemble(part)
        if not system.unknowns or not analyse(system).is_determined:
            return False
        return not enumerate_solutions(part, system).found

    # Of all groups together it is known.
    number = bisect_left(range(len(groups) - 1), True, key=is_dead)
    return [groups[number]]


def _first(profile: Profile, groups: tuple[Group, ...]) -> Profile:
    """The part of a profile that some groups determine, without points of which one coordinate is determined."""
    names = {name for group in groups for name in group.unknowns}
    half = [pair for point in profile.figure.points if not names.issuperset(pair := both(point))]
    return restrict(profile, names.difference(*half))


def _blame(solution: SystemSolution, blamed: list[Group], groups: tuple[Group, ...], system: System) -> SystemSolution:
    """The solution whose refusal names the facts of some groups."""
    subject = ",".join(name for group in blamed for name in group.unknowns)
    givens = (_without_point if Status.NO_SOLUTION is solution.status else _givens)(blamed, groups, system)
    refusals = (replace(each, subject=subject, givens=givens) for each in solution.refusals)
    return replace(solution, refusals=tuple(refusals))


def _without_point(blamed: list[Group], groups: tuple[Group, ...], system: System) -> tuple[str, ...]:
    """The givens of the facts of some groups that have no solution, and of what these build on: with other values of
    that, they may have one."""
    used = {name for group in blamed for fact in group.facts for name in system.unknowns_of(fact)}
    earlier = [group for group in groups if group not in blamed and not used.isdisjoint(group.unknowns)]
    return tuple(dict.fromkeys((*_givens(earlier, groups, system), *_givens(blamed, groups, system))))


def _givens(blamed: list[Group], groups: tuple[Group, ...], system: System) -> tuple[str, ...]:
    """The givens of the facts of some groups; for a fact that nothing states, what it builds on."""
    names: dict[str, None] = {}
    for fact in (fact for group in blamed for fact in group.facts):
        names |= dict.fromkeys(name for name in (fact.given, *headings_of(fact, system)) if name)
        if not fact.given:
            used = set(system.unknowns_of(fact)).difference(*(group.unknowns for group in blamed))
            earlier = [group for group in groups if not used.isdisjoint(group.unknowns)]
            names |= dict.fromkeys(_givens(earlier, groups, system))
    return tuple(names)


def _affine(profile: Profile, groups: tuple[Group, ...], doubtful: list[Group]) -> SystemSolution | None:
    """The answer of the solver of ordinary words about a group, where it and all before it are about such words."""
    part = _first(profile, groups[: groups.index(doubtful[0]) + 1])
    system = assemble(part)
    if not is_affine(part.facts) or not analyse(system).is_determined or not is_closed(system):
        return None
    refusals = [each for each in solve(part).refusals if isinstance(each, Refusal)]
    return SystemSolution(refusals[0].kind.status, refusals=tuple(refusals)) if refusals else None


_COMPARED = events_about(Topic.WORD) | refusals_about(Topic.FACT, Topic.RADII)
_SEARCHED = refusals_about(Topic.SEARCH)


def said_twice(profile: Profile) -> tuple[Refusal | Note, ...]:
    """The comparison of facts that are not needed with the others, as far as these determine what they speak about.

    Facts about lines are compared whatever the others leave free. Of the others, where they leave several places, the
    one with which most of them agree counts; where they leave none, what speaks against that is told.
    """
    affine = affine_facts(profile, profile.facts)
    if affine is not None:
        return tuple(compare_affine(profile, affine))
    part = _determined(profile)
    if part is None:
        return ()
    found = find_alternatives(part)
    loose = () if found.items else [name for doubt in found.doubts for name in doubt.unknowns]
    if loose:
        # At these values, something else is not fixed either: where two parts of one circle meet.
        part = restrict(part, (name for name in assemble(part).unknowns if name not in loose))
        if not part.facts or not analyse(assemble(part)).is_determined:
            return ()
        found = find_alternatives(part)
    if found.items or not found.is_complete:
        return min(map(_compared, found.items), key=_disagreements) if found.items else ()
    return settle(part).solution.refusals


def is_found_at_once(profile: Profile) -> bool:
    """Whether what the facts of a profile determine takes no search."""
    part = _determined(profile)
    system = assemble(part) if part is not None else None
    return system is None or not any(is_searched(system, group) for group in groups_of(system))


def is_given_up(profile: Profile) -> bool:
    """Whether a search in the part of a profile that its facts determine ends without all solutions."""
    part = _determined(profile)
    return part is not None and not find_alternatives(part).is_complete


def nearest_of_determined(profile: Profile) -> tuple[Profile, Alternative] | None:
    """The part of a profile that its facts determine, itself if that is all, and of the solutions of that the one with
    which most of its facts agree; None where there is none."""
    part = _determined(profile)
    items = find_alternatives(part).items if part is not None else ()
    best = min(items, key=lambda item: (not item.is_path, *_disagreements(_compared(item))), default=None)
    return None if part is None or best is None else (part, best)


def _determined(profile: Profile) -> Profile | None:
    """The part of a profile that its facts determine, itself if that is all; None if that is nothing."""
    system, figure = assemble(profile), profile.figure
    free = analyse(system).free
    if not free:
        # A corner whose size nothing tells is no part of it.
        sized = {*profile.givens, *figure.radii}
        told = tuple(each for each in figure.corners if {each.size, f"{each.name}.radius"} & sized)
        is_whole = told == figure.corners
        return profile if is_whole else replace(profile, layout=Layout(replace(figure, corners=told), profile.facts))
    part = restrict(profile, (name for name in system.unknowns if name not in free))
    return part if part.facts and analyse(assemble(part)).is_determined else None


def _compared(item: Alternative) -> tuple[Refusal | Note, ...]:
    """The events of a solution about facts that were not needed."""
    events: tuple[Refusal | Note, ...] = (*item.solution.refusals, *item.solution.remarks)
    return tuple(event for event in events if event.kind in _COMPARED)


def _disagreements(events: tuple[Refusal | Note, ...]) -> tuple[int, float]:
    """The number of facts that disagree, and by how much together, mm."""
    refusals = [event for event in events if isinstance(event, Refusal)]
    return len(refusals), sum(each.values.get("off_by_mm", 0.0) for each in refusals)
