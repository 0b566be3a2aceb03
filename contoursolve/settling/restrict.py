"""The part of a profile that some of its unknowns make, as a profile of its own."""

from collections.abc import Iterable
from dataclasses import replace
from decimal import Decimal

from contoursolve.constraints import Coordinate, Through, assemble
from contoursolve.model import FIRST, SECOND, Fact, Given, Layout, Line, Profile, Unit, line_scalars, scalar


def restrict(profile: Profile, names: Iterable[str]) -> Profile:
    """The profile with the facts about these unknowns alone, and with no path.

    Where only a part of a point or of a line is among them, the other part, of which nothing is said then, is put
    somewhere.
    """
    system, kept = assemble(profile), frozenset(names)
    figure = profile.figure
    facts: list[Fact] = [fact for fact in profile.facts if kept.issuperset(system.unknowns_of(fact))]
    givens = dict(profile.givens)
    points = tuple(point for point in figure.points if not kept.isdisjoint(_both(point)))
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
        replace(line, head=line.head if kept.issuperset(_both(line.tail, line.head)) else "")
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


def _both(*points: str) -> tuple[str, ...]:
    return tuple(scalar(point, axis) for point in points for axis in (FIRST, SECOND))
