"""The values of some words with which a contour passes its checks, as far as floats can tell; of a long path, what the
values move is computed alone."""

from collections.abc import Collection, Iterable, Mapping
from functools import lru_cache

import numpy
from msgspec.structs import replace

from contoursolve.geometry import (
    FIRST,
    Fact,
    Profile,
    System,
    Unit,
    assemble,
    both,
    build_system,
    scalar,
    scalars_of,
)
from contoursolve.numeric import COSINE, SINE, Array, Replay, ball, difference, directions, replay_rows
from contoursolve.solving.checks import compile_checks
from contoursolve.solving.construction import is_closed
from contoursolve.solving.determinacy import analyse, groups_of, spare_of
from contoursolve.solving.elimination import Close
from contoursolve.solving.enumerate import DRAWING, Enumeration, enumerate_many
from contoursolve.solving.exact_inputs import ground_of
from contoursolve.solving.numbers import axes_of, inputs_of
from contoursolve.solving.partition import Group


def passed_rows(profile: Profile, values: Mapping[str, Array]) -> numpy.ndarray | None:
    """For each row of values of some givens (mm, X as radius, or degrees), whether every check is passed that they have
    a part in, as far as floats can tell. None where no one function answers all rows: there is no closed form, or a
    point may lie in two places between which nothing chooses. Raises ValueError without a start."""
    found = _replay(profile, values, is_whole=False)
    return None if found is None else numpy.equal(found[-1], 1)


def agreement_rows(profile: Profile, values: Mapping[str, Array]) -> numpy.ndarray | None:
    """For each row, by how much the facts that were not needed agree more closely than they must (mm; below 0 if one of
    them does not agree, and NaN where that is not known). None as above, and where every fact is needed."""
    found = _replay(profile, values, is_whole=True)
    return None if found is None or len(found) == 1 else numpy.min(found[:-1], axis=0)


def _replay(profile: Profile, values: Mapping[str, Array], *, is_whole: bool) -> list[numpy.ndarray] | None:
    """The outputs of the checks, a column each: of the whole contour, or of what the values move."""
    system = assemble(profile)
    if not analyse(system).is_determined or not is_closed(system):
        return None
    system, known = (None if is_whole else _moved_part(profile, frozenset(values))) or (system, {})
    names, replay = _compile(system)
    inputs: dict[str, float | Array] = {**inputs_of(profile, system), **known}
    if not inputs.keys() >= {*names}:
        return None
    axes, start = axes_of(system), profile.start.values
    for name, column in values.items():
        if profile.givens[name].unit is Unit.DEGREE:
            inputs[name + COSINE], inputs[name + SINE] = directions(column)
        else:
            inputs[name] = difference(column, float(start[axes[name]] or 0)) if name in axes else column
    count = len(next(iter(values.values())))
    with numpy.errstate(all="ignore"):
        # Numbers of NumPy, because those of Python do not divide by zero.
        return [numpy.broadcast_to(each, count) for each in replay([numpy.float64(inputs[name]) for name in names])]


@lru_cache(maxsize=256)
def _compile(system: System) -> tuple[tuple[str, ...], Replay]:
    """The inputs of the checks of a system, and as a function of these the margins of the facts that were not needed,
    and whether all checks are passed."""
    checked = compile_checks(system)
    tape = checked.tape.keep(checked.outputs.margins.values())
    tape.output("clear", checked.is_clear)
    return tape.inputs, replay_rows(tape)


_BESIDE = 3
"""Elements on either side that count with it: a corner lies between two, which have one at their other ends."""

_LONG = 12
"""Elements of a path of which a part is worth the trouble."""


def _moved_part(profile: Profile, givens: Collection[str]) -> tuple[System, dict[str, float]] | None:
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
    own = list[Group]()
    while len(own) < len(own := [group for group in groups if not moved.isdisjoint(group.unknowns)]):
        moved.update(name for group in own for name in _points_of(group.unknowns, system))
    facts = {
        *(fact for group in own for fact in group.facts),
        *(fact for fact in spare_of(system) if is_moved(fact, moved)),
    }
    sizes = {name for corner in figure.corners if corner.size in givens for name in (corner.before, corner.after)}
    places = [
        place
        for place, each in enumerate(figure.path)
        if each.name in turned or each.name in sizes or not moved.isdisjoint(scalars_of(each))
    ]
    path = figure.path[max(places[0] - _BESIDE, 0) : places[-1] + _BESIDE + 1] if places else figure.path
    if 2 * len(path) > len(figure.path):
        return None
    names, unknowns = {each.name for each in path}, {*system.unknowns}
    stays = {name for each in path for name in scalars_of(each)} | {name for fact in facts for name in reads(fact)}
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
