"""Conditions that things run in their stated sense: numbers that must be positive, of floats, balls or expressions."""

from collections.abc import Callable, Iterable, Iterator

from msgspec import Struct

from contoursolve.geometry import FIRST, SECOND, Fact, Line, System, Values, scalar
from contoursolve.numeric import Expression, Number, ball

Signed = Number | Expression
"""A number, or an expression of one, by which a sense is told."""


class Sense(Struct, frozen=True, eq=False):
    """Numbers that must be positive, the unknowns that they read, and the facts and unknowns that they are about."""

    values: Callable[[Values], Iterable[Signed]]
    reads: frozenset[str]
    facts: tuple[Fact, ...]
    unknowns: tuple[str, ...]
    is_free: bool = False
    """Whether nothing states the sense: a line beside the path is taken to run to the right, or upwards."""
    sides: frozenset[str] = frozenset()
    """The open sides that they read."""


def senses_of(system: System) -> Iterator[Sense]:
    """The senses of a system: those that facts state, and those of lines whose directions are unknown."""
    for fact in system.facts:
        names = system.unknowns_among(fact.sense_reads())
        yield Sense(fact.senses, frozenset(names), (fact,), names, sides=frozenset(fact.sides()))
    figure = system.figure
    lines = [line for line in (*figure.path, *figure.lines) if isinstance(line, Line) and line.name in figure.carriers]
    for line in lines:
        if line.tail and line.head:
            ends = {scalar(point, axis) for point in (line.tail, line.head) for axis in (FIRST, SECOND)}
            reads = frozenset({*ends, f"{line.name}.cos"} - system.known)
            yield Sense(_along(line), reads, (), (line.name,))
    for line in lines:
        if not line.tail:
            yield Sense(_rightwards(line), frozenset({f"{line.name}.cos", f"{line.name}.sin"}), (), (line.name,), True)


def _along(line: Line) -> Callable[[Values], Iterable[Signed]]:
    """The way from the tail of a line to its head, along it, mm."""

    def values(at: Values) -> Iterator[Signed]:
        cosine, sine = at.bearing(line.name)
        first, second = (at.coordinate(line.head, axis) - at.coordinate(line.tail, axis) for axis in (FIRST, SECOND))
        yield first * cosine + second * sine

    return values


def _rightwards(line: Line) -> Callable[[Values], Iterable[Signed]]:
    """The first part of the direction of a line that is not zero for certain."""

    def values(at: Values) -> Iterator[Signed]:
        cosine, sine = at.bearing(line.name)
        yield sine if ball.sign(cosine) == 0 else cosine

    return values
