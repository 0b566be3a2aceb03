"""Facts about corners whose sizes and ends are unknowns: how they begin and end on lines and arcs."""

from dataclasses import dataclass
from typing import Any

from contoursolve.constraints.equation import Equation, both, cross, dot, step
from contoursolve.constraints.touching import side_of
from contoursolve.model import Lookup, Turn, line_scalars


@dataclass(frozen=True, slots=True)
class TangentArc(Equation):
    """The circle about `center` touches the circle of an arc, and lies to the left of its travel (`side` +1) or to
    the right (-1). To first order the residual is the gap."""

    arc: tuple[str, str]
    """Center and radius."""
    turn: Turn
    center: str
    radius: str
    side: str | int
    given: str = ""

    def reads(self) -> tuple[str, ...]:
        return *both(self.arc[0], self.center), self.arc[1], self.radius

    def sides(self) -> tuple[str, ...]:
        return (self.side,) if isinstance(self.side, str) else ()

    def equation(self, at: Lookup) -> Any:
        between, own, radius = step(at, self.arc[0], self.center), at.radius(self.arc[1]), at.radius(self.radius)
        # Expanded with side**2 = 1, as in `TangentCircles`.
        inward = 2 * self.turn.sign * side_of(self.side, at) * own * radius
        return dot(between, between) - own * own - radius * radius + inward

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * (at.radius(self.arc[1]) + at.radius(self.radius)))


@dataclass(frozen=True, slots=True)
class ArcContact(Equation):
    """`point`, which lies on the circle of an arc, is where a circle about `center` touches it: in line with both
    centres. It comes before the `corner` on the arc (`way` +1) or after it (-1), by less than half a turn."""

    point: str
    arc: tuple[str, str]
    """Center and radius."""
    turn: Turn
    center: str
    radius: str
    side: str | int
    corner: str
    way: int
    given: str = ""

    def reads(self) -> tuple[str, ...]:
        return both(self.point, self.arc[0], self.center)

    def equation(self, at: Lookup) -> Any:
        return cross(step(at, self.arc[0], self.point), step(at, self.arc[0], self.center))

    def residual(self, at: Lookup) -> Any:
        spoke = step(at, self.arc[0], self.point)
        return self.equation(at) / at.root(dot(spoke, spoke))

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        spoke, between = step(at, self.arc[0], self.point), step(at, self.arc[0], self.center)
        # A circle that turns the same way and is larger than the arc's has its centre beyond the arc's.
        reach = at.radius(self.arc[1]) - self.turn.sign * side_of(self.side, at) * at.radius(self.radius)
        ahead = cross(spoke, step(at, self.arc[0], self.corner))
        return reach * dot(spoke, between), self.way * self.turn.sign * ahead

    def sense_reads(self) -> tuple[str, ...]:
        return *self.reads(), self.arc[1], self.radius, *both(self.corner)


@dataclass(frozen=True, slots=True)
class Setback(Equation):
    """`point`, which lies on the line, is `size` before the `corner` (`way` +1) or after it (-1)."""

    line: str
    point: str
    corner: str
    size: str
    way: int
    given: str = ""

    def reads(self) -> tuple[str, ...]:
        return *line_scalars(self.line)[:2], *both(self.point, self.corner), self.size

    def residual(self, at: Lookup) -> Any:
        ahead = dot(at.bearing(self.line), step(at, self.point, self.corner))
        return self.way * ahead - at.radius(self.size)


@dataclass(frozen=True, slots=True)
class ChordSetback(Equation):
    """`point`, which lies on the circle of an arc, is `size` away from the `corner`, along the chord: before it on
    the arc (`way` +1) or after it (-1)."""

    center: str
    turn: Turn
    point: str
    corner: str
    size: str
    way: int
    given: str = ""

    def reads(self) -> tuple[str, ...]:
        return *both(self.point, self.corner), self.size

    def equation(self, at: Lookup) -> Any:
        chord, size = step(at, self.point, self.corner), at.radius(self.size)
        return dot(chord, chord) - size * size

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * at.radius(self.size))

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (
            self.way * self.turn.sign * cross(step(at, self.center, self.point), step(at, self.center, self.corner)),
        )

    def sense_reads(self) -> tuple[str, ...]:
        return *self.reads(), *both(self.center)
