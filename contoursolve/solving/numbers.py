"""Numbers into a compiled system and out of it: what a profile states as inputs, the outputs as a solution."""

from collections.abc import Callable, Mapping
from decimal import Decimal
from functools import lru_cache
from typing import TypeVar

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Profile,
    Start,
    System,
    Unit,
    Values,
    headed_lines,
    scalar,
)
from contoursolve.numeric import COSINE, SIDE, SINE, direction
from contoursolve.solving.corners import CornerPath
from contoursolve.solving.events import Status
from contoursolve.solving.solution import CornerSolution, Point, SystemSolution

Kind = TypeVar("Kind")
"""A kind of numbers: floats, or what `numeric.ball` makes."""


def inputs_of(profile: Profile, system: System) -> dict[str, float]:
    """All inputs of the function of a system. Coordinates are counted from the start point, and the difference is taken
    in decimals: a shifted program has the same numbers, to the last bit. Raises ValueError without a start."""
    return inputs_as(_float, direction, profile, system) | profile.increments


def inputs_as(
    number: Callable[[Decimal | float, Decimal], Kind],
    direction: Callable[[Decimal], tuple[Kind, Kind]],
    profile: Profile,
    system: System,
) -> dict[str, Kind]:
    """The same as numbers of a kind, without increments: `number` makes one of a value less another one, `direction`
    cosine and sine."""
    first, second = profile.start.values
    if first is None or second is None:
        raise ValueError("the start point is not known")
    inputs = {scalar(system.figure.start, axis): number(0.0, _ZERO) for axis in (FIRST, SECOND)}
    absolute = axes_of(system)
    for name, given in profile.givens.items():
        if given.unit is Unit.DEGREE:
            inputs[name + COSINE], inputs[name + SINE] = direction(given.value)
        elif name in absolute:
            inputs[name] = number(given.value, second if absolute[name] else first)
        else:
            inputs[name] = number(given.value, _ZERO)
    for choice in profile.choices:
        inputs[SIDE + choice.point] = number(choice.side.sign, _ZERO)
    return inputs


_ZERO = Decimal(0)


def _float(value: Decimal | float, less: Decimal) -> float:
    return float(value - less if isinstance(value, Decimal) and less else value)


@lru_cache(maxsize=4096)
def axes_of(system: System) -> Mapping[str, int]:
    """The axis of each given that is a coordinate."""
    places = {scalar(place, axis): axis for place in system.figure.places for axis in (FIRST, SECOND)}
    return places | {fact.given: fact.placed.axis for fact in system.facts if fact.placed and not fact.placed.origin}


def solution_at(
    system: System,
    start: Start,
    sizes: Mapping[str, float],
    out: Mapping[str, float],
    corners: Mapping[str, CornerPath],
) -> SystemSolution:
    """The values among the outputs of a compiled system, and of its corners, which count coordinates from the start
    point; `sizes` are those of the corners by the words that state them, mm."""
    figure, (first, second) = system.figure, start.values
    one, other = float(first or 0), float(second or 0)

    def absolute(point: Point) -> Point:
        return one + point[FIRST], other + point[SECOND]

    points = {figure.start: absolute((0.0, 0.0))}
    points |= {name: absolute((out[scalar(name, FIRST)], out[scalar(name, SECOND)])) for name in figure.points}
    return SystemSolution(
        Status.SOLVED,
        points=points,
        radii={name: out[name] for name in figure.radii},
        corners={
            corner.name: corner_of(corners[corner.name], sizes[corner.size], absolute) for corner in figure.corners
        },
    )


def corner_of(built: CornerPath, size: float, absolute: Callable[[Point], Point]) -> CornerSolution:
    """A corner in numbers, which count from the start point."""
    center = None if built.center is None else absolute(built.center)
    return CornerSolution(absolute(built.begin), absolute(built.end), center, size, built.turn)


def lookup(profile: Profile, scalars: dict[str, float]) -> Values:
    """A lookup of floats for the facts of a profile: its givens, and these values of the unknowns."""
    start = {
        scalar(profile.figure.start, axis): float(value)
        for axis, value in enumerate(profile.start.values)
        if value is not None
    }
    givens = profile.givens.values()
    return Values(
        {**start, **scalars},
        {given.name: float(given.value) for given in givens},
        {given.name: direction(given.value) for given in givens if given.unit is Unit.DEGREE},
        headed_lines(profile.figure) if profile.is_extended else {},
    )


def scalars_of(points: Mapping[str, Point]) -> dict[str, float]:
    """The coordinates of points by their scalars' names."""
    return {scalar(name, axis): value for name, point in points.items() for axis, value in enumerate(point)}


def sizes_of(profile: Profile) -> dict[str, float]:
    """The stated sizes of a profile's corners, mm."""
    sizes = (corner.size for corner in profile.figure.corners)
    return {size: float(profile.givens[size].value) for size in sizes if size in profile.givens}
