"""The part of a long path that some values move: its points from those around it, which stay."""

from collections.abc import Collection, Iterable

from msgspec.structs import replace

from contoursolve.geometry import FIRST, Arc, Fact, Line, Profile, System, assemble, both, build_system, scalar
from contoursolve.numeric import ball
from contoursolve.solving.construction import is_closed
from contoursolve.solving.determinacy import analyse, groups_of, spare_of
from contoursolve.solving.elimination import Close
from contoursolve.solving.enumerate import DRAWING, Enumeration, enumerate_many
from contoursolve.solving.exact_inputs import ground_of
from contoursolve.solving.partition import Group

_BESIDE = 3
"""Elements on either side that count with it: a corner lies between two, which have one at their other ends."""

_LONG = 12
"""Elements of a path of which a part is worth the trouble."""


def moved_part(profile: Profile, givens: Collection[str]) -> tuple[System, dict[str, float]] | None:
    """The system of what some givens move, whose other points are places, and the values of these, counted from the
    start point, mm. None where that is most of the path, or what stays is not known."""
    system = assemble(profile)
    figure, groups = system.figure, groups_of(system)
    if len(figure.path) < _LONG or figure.lines or figure.circles or figure.carriers:
        return None
    turned = {line for line, (given, _) in system.headed.items() if given in givens}

    def reads(fact: Fact) -> set[str]:
        return {*system.unknowns_of(fact)}

    def is_moved(fact: Fact, moved: Collection[str]) -> bool:
        is_told = fact.given in givens or any(name.rpartition(".")[0] in turned for name in fact.reads())
        return is_told or not reads(fact).isdisjoint(moved)

    moved = set[str]()
    for group in groups:
        if any(is_moved(fact, moved) for fact in group.facts):
            moved |= _points_of(group.unknowns, system)
    # Of a point, both coordinates belong to it, with all that is determined together with them.
    while (
        more := {
            name
            for group in groups
            if not moved.isdisjoint(group.unknowns)
            for name in _points_of(group.unknowns, system)
        }
        - moved
    ):
        moved |= more
    own = [fact for group in groups if not moved.isdisjoint(group.unknowns) for fact in group.facts]
    facts = {*own, *(fact for fact in spare_of(system) if is_moved(fact, moved))}
    sizes = {name for corner in figure.corners if corner.size in givens for name in (corner.before, corner.after)}
    places = [
        place
        for place, each in enumerate(figure.path)
        if each.name in turned or each.name in sizes or not moved.isdisjoint(_scalars_of(each))
    ]
    path = figure.path[max(places[0] - _BESIDE, 0) : places[-1] + _BESIDE + 1] if places else figure.path
    if 2 * len(path) > len(figure.path):
        return None
    names, unknowns = {each.name for each in path}, {*system.unknowns}
    stays = {name for each in path for name in _scalars_of(each)} | {name for fact in facts for name in reads(fact)}
    stays = _points_of(stays & unknowns, system) - moved
    # Of an arc whose end is compared with its circle, corners are cut as it ends.
    facts |= {fact for fact in spare_of(system) if reads(fact) <= moved | stays}
    known = _values_of(profile, stays, groups)
    if known is None:
        return None
    part = replace(
        figure,
        points=tuple(each for each in figure.points if scalar(each, FIRST) in moved),
        radii=tuple(each for each in figure.radii if each in moved),
        path=path,
        corners=tuple(each for each in figure.corners if each.before in names and (each.after or each.before) in names),
        places=(*figure.places, *(each for each in figure.points if scalar(each, FIRST) in stays)),
        known_radii=(*figure.known_radii, *(each for each in figure.radii if each in stays)),
    )
    choices = tuple(each for each in system.choices if scalar(each, FIRST) in moved)
    own_system = build_system(part, tuple(fact for fact in system.facts if fact in facts), choices)
    return (own_system, known) if analyse(own_system).is_determined and is_closed(own_system) else None


def _points_of(names: Iterable[str], system: System) -> set[str]:
    """Some unknowns, with both coordinates of their points."""
    radii = {*system.figure.radii}
    return {each for name in names for each in ((name,) if name in radii else both(name.rpartition(".")[0]))}


def _scalars_of(element: Line | Arc) -> tuple[str, ...]:
    """The unknowns that an element may be made of."""
    if isinstance(element, Line):
        return both(element.tail, element.toward or element.head, element.head)
    return *both(element.tail, element.head, element.center), element.radius


def _values_of(profile: Profile, names: Collection[str], groups: tuple[Group, ...]) -> dict[str, float] | None:
    """The values of some unknowns, by as few groups of facts as determine them; None unless there is one solution."""
    system, wanted, needed = assemble(profile), {*names}, list[Group]()
    for group in reversed(groups):
        if not wanted.isdisjoint(group.unknowns):
            needed.append(group)
            wanted.update(name for fact in group.facts for name in system.unknowns_of(fact))
    with ball.precision(ball.WORKING):
        (found,) = enumerate_many([ground_of(profile)], system, (*reversed(needed),), Close.REFUSE, DRAWING)
        if not isinstance(found, Enumeration) or len(found.found) != 1 or found.doubts:
            return None
        starts = [ball.exact(value) for value in profile.start.values if value is not None]
        scalars = found.found[0].scalars
        return {
            name: ball.middle(
                scalars[name] - starts[int(name[-1])] if name not in system.figure.radii else scalars[name]
            )
            for name in names
        }
