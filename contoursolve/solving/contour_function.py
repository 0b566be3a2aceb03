"""One contour as a function of CasADi: from the values of its words to points, elements, corners, room, conditions."""

from collections.abc import Callable, Mapping, Sequence
from math import radians
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Choice,
    CornerShape,
    Fact,
    Profile,
    Side,
    System,
    Unit,
    Values,
    assemble,
    both,
    scalar,
)
from contoursolve.numeric import (
    COSINE,
    SIDE,
    SINE,
    Expression,
    Tape,
    closed_function,
    cosine,
    implicit_function,
    put_in,
    sine,
    symbol,
)
from contoursolve.solving.affine import values_at
from contoursolve.solving.compile import compile_path, compile_system
from contoursolve.solving.construction import is_closed, points_with_two_solutions
from contoursolve.solving.corners import CornerPath, Pair
from contoursolve.solving.determinacy import basis_of
from contoursolve.solving.inputs import input_values
from contoursolve.solving.numbers import axes_of, inputs_of
from contoursolve.solving.sides import BOTH, sides_of

_RADIANS = radians(1)
"""Of one degree."""


class TypedValues(Struct, frozen=True):
    """The values of a contour as expressions of what is typed: `start` (mm), `givens` by name (mm or degrees); `sides`
    are the signs of what no word states."""

    start: Pair
    givens: Mapping[str, Any]
    sides: Mapping[str, int] = {}


def build_function(
    profile: Profile,
    name: str,
    inputs: Mapping[str, Expression],
    typed: TypedValues,
    conditions: Callable[[Mapping[str, Any]], list[Any]],
    followed: tuple[Mapping[str, float], Mapping[str, float]],
) -> Any:
    """The function of `inputs` to the outputs that `EquationSystem.function` describes. `conditions` are made of the
    values of unknowns, of the start and of givens; `followed` are inputs and unknowns of a solution."""
    system, (base, scalars) = assemble(profile), followed
    stated = [base[each] for each in inputs]
    if is_closed(system):
        profile = _choosing(profile, system, scalars)
        unknowns = _closed(profile, system, typed)
        return closed_function(name, inputs, stated, _outputs(profile, system, typed, unknowns, conditions))
    unknowns = {each: symbol(each) for each in system.unknowns}
    known = _values(profile, system, typed, typed.start)
    residuals = _stated(system, {**known, **unknowns}, lambda fact, at: fact.equation(at), basis_of(system))
    outputs = _outputs(profile, system, typed, unknowns, conditions)
    sought = [unknowns[each] for each in system.unknowns]
    begin = stated, [scalars[each] for each in system.unknowns]
    return implicit_function(name, inputs, sought, residuals, begin, outputs)


def _choosing(profile: Profile, system: System, scalars: Mapping[str, float]) -> Profile:
    """The profile with a choice wherever a step has two places: the side on which the solution that is followed lies,
    where that is not the one that the profile chooses."""
    points = points_with_two_solutions(system)
    sides = sides_of(system, values_at(profile, system.facts, scalars), frozenset(points)) if points else {}
    chosen = {each.point: each for each in profile.choices}
    for point in points:
        side = sides.get(point, BOTH)
        if side != BOTH and (point not in chosen or chosen[point].side.value != side):
            chosen[point] = Choice(point, Side(side), "")
        elif point not in chosen:  # the two places are one
            chosen[point] = Choice(point, Side.FARTHER, "")
    return replace(profile, choices=tuple(chosen.values()))


def _stated(
    system: System, values: Mapping[str, Any], evaluate: Callable[[Fact, Values], Any], facts: Sequence[Fact]
) -> list[Any]:
    """Facts evaluated at values."""
    tape = Tape()
    at = input_values(system.headed, tape, {})
    for number, fact in enumerate(facts):
        tape.output(str(number), evaluate(fact, at))
    return [*put_in(tape, [*tape.outputs], values).values()] if facts else []


def _values(profile: Profile, system: System, typed: TypedValues, start: Pair) -> dict[str, Any]:
    """All inputs of the functions of a system: what is typed, and what nobody types, with coordinates as they are, and
    where the contour starts."""
    found: dict[str, Any] = dict(inputs_of(profile, system))
    found |= {SIDE + name: float(sign) for name, sign in typed.sides.items()}
    for name, given in profile.givens.items():
        value = typed.givens.get(name, float(given.value))
        if given.unit is not Unit.DEGREE:
            found[name] = value
        elif name in typed.givens:
            found[name + COSINE], found[name + SINE] = cosine(value * _RADIANS), sine(value * _RADIANS)
    return found | dict(zip(both(system.figure.start), start, strict=True))


def _closed(profile: Profile, system: System, typed: TypedValues) -> dict[str, Any]:
    """The unknowns in closed form, which counts from the start point."""
    values = _values(profile, system, typed, (0.0, 0.0))
    for name, axis in axes_of(system).items():
        values[name] = values[name] - typed.start[axis]
    found: dict[str, Any] = put_in(compile_system(system).tape, system.unknowns, values)
    for point in system.figure.points:
        for axis in (FIRST, SECOND):
            found[scalar(point, axis)] = found[scalar(point, axis)] + typed.start[axis]
    return found


def _outputs(
    profile: Profile,
    system: System,
    typed: TypedValues,
    unknowns: Mapping[str, Any],
    conditions: Callable[[Mapping[str, Any]], list[Any]],
) -> dict[str, list[list[Any]]]:
    figure, machine = system.figure, compile_path(system)
    values = {**_values(profile, system, typed, typed.start), **unknowns}
    # The size of a corner that is asked for is an unknown.
    values |= {each.size: unknowns[each.radius] for each in figure.corners if each.radius in unknowns}
    found = put_in(machine.tape, [*machine.tape.outputs], values)
    path, at = machine.path.read(found.__getitem__), {**values, **found}

    def point(name: str) -> list[Any]:
        return [at[each] for each in both(name)]

    residuals = _stated(system, values, lambda fact, at: fact.residual(at), system.facts)
    elements = [[*begin, *end] for begin, end in _elements(system, path.corners, point)]
    fillets = [corner for corner in figure.corners if corner.shape is CornerShape.FILLET]
    centers = [path.corners[corner.name].center for corner in fillets]
    return {
        "points": [point(name) for name in figure.points],
        "radii": [[at[name]] for name in figure.radii],
        "elements": elements,
        "centers": [[*center] for center in centers if center is not None],
        "room": [[each] for each in path.rooms.values()],
        "conditions": [[each] for each in conditions(at)],
        "residuals": [[each] for each in residuals],
    }


def rows_of(system: System) -> dict[str, tuple[str, ...]]:
    """The names of the rows of each output that are those of points, elements and corners."""
    figure, machine = system.figure, compile_path(system)
    return {
        "points": figure.points,
        "radii": figure.radii,
        "elements": tuple(name for name, _ in _order(system)),
        "centers": tuple(each.name for each in figure.corners if each.shape is CornerShape.FILLET),
        "room": tuple(machine.path.rooms),
    }


def _order(system: System) -> list[tuple[str, bool]]:
    """The names of elements and corners in the order of travel, and whether each is a corner."""
    behind = {corner.before: corner.name for corner in system.figure.corners}
    found = list[tuple[str, bool]]()
    for element in system.figure.path:
        found.append((element.name, False))
        if element.name in behind:
            found.append((behind[element.name], True))
    return found


def _elements(
    system: System, corners: Mapping[str, CornerPath], point: Callable[[str], list[Any]]
) -> list[tuple[list[Any], list[Any]]]:
    """The begin and the end of each element, corners among them."""
    path = {element.name: element for element in system.figure.path}
    before = {corner.before: corners[corner.name] for corner in system.figure.corners}
    after = {corner.after: corners[corner.name] for corner in system.figure.corners if corner.after}
    found = list[tuple[list[Any], list[Any]]]()
    for name, is_corner in _order(system):
        if is_corner:
            found.append(([*corners[name].begin], [*corners[name].end]))
            continue
        begin = [*after[name].end] if name in after else point(path[name].tail)
        found.append((begin, [*before[name].begin] if name in before else point(path[name].head)))
    return found
