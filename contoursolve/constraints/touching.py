"""Facts about circles and arcs as a whole: how they touch, what they have in common, how long they are."""

from dataclasses import dataclass
from math import atan2, tau
from typing import Any

from contoursolve.constraints.equation import Equation, both, cross, dot, rotate, step
from contoursolve.model import Lookup, Turn


@dataclass(frozen=True, slots=True)
class EqualRadii(Equation):
    """Two circles have the same radius."""

    given: str
    first: str
    second: str

    def reads(self) -> tuple[str, ...]:
        return self.first, self.second

    def residual(self, at: Lookup) -> Any:
        return at.radius(self.first) - at.radius(self.second)


@dataclass(frozen=True, slots=True)
class TangentCircles(Equation):
    """Two circles touch: from outside (`side` +1) or one inside the other (-1).

    `side` is the name of an open side, or the side itself. To first order the residual is the gap.
    """

    first: tuple[str, str]
    """Center and radius."""
    second: tuple[str, str]
    side: str | int
    given: str = ""

    def reads(self) -> tuple[str, ...]:
        return *both(self.first[0], self.second[0]), self.first[1], self.second[1]

    def sides(self) -> tuple[str, ...]:
        return (self.side,) if isinstance(self.side, str) else ()

    def equation(self, at: Lookup) -> Any:
        between, side = step(at, self.first[0], self.second[0]), side_of(self.side, at)
        first, second = at.radius(self.first[1]), at.radius(self.second[1])
        # Expanded with side**2 = 1, so that a difference of two such equations has no squares at all.
        return dot(between, between) - first * first - second * second - 2 * side * first * second

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * (at.radius(self.first[1]) + at.radius(self.second[1])))


@dataclass(frozen=True, slots=True)
class Contact(Equation):
    """`point`, which lies on two circles, is where they touch: in line with their centres.

    It lies between the centres for a contact from outside (`side` +1), beyond them for one from inside (-1).
    """

    point: str
    first: str
    second: str
    """The centres."""
    side: int
    given: str = ""

    def reads(self) -> tuple[str, ...]:
        return both(self.point, self.first, self.second)

    def equation(self, at: Lookup) -> Any:
        return cross(step(at, self.first, self.point), step(at, self.first, self.second))

    def residual(self, at: Lookup) -> Any:
        between = step(at, self.first, self.second)
        return self.equation(at) / at.root(dot(between, between))

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (self.side * dot(step(at, self.first, self.point), step(at, self.point, self.second)),)


@dataclass(frozen=True, slots=True)
class ArcLength(Equation):
    """The arc from `tail` to `head` about `center` has the given length.

    The residual is how far `head` lies off the ray at which the arc must end.
    """

    given: str
    tail: str
    head: str
    center: str
    radius: str
    turn: Turn

    def reads(self) -> tuple[str, ...]:
        return *both(self.tail, self.head, self.center), self.radius

    def _spokes(self, at: Lookup) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
        cosine, sine = at.rotation(at.amount(self.given) / at.radius(self.radius))
        begin = rotate(step(at, self.center, self.tail), (cosine, self.turn.sign * sine))
        return begin, step(at, self.center, self.head)

    def equation(self, at: Lookup) -> Any:
        return cross(*self._spokes(at))

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / at.radius(self.radius)

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        # 710 / 113 is 2 pi and a little more: an arc is no longer than its circle.
        circle = at.radius(self.radius) * 710 / 113
        return dot(*self._spokes(at)), circle - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        begin, end = step(at, self.center, self.tail), step(at, self.center, self.head)
        sweep = atan2(float(cross(begin, end)) * self.turn.sign, float(dot(begin, end))) % tau
        return float(at.radius(self.radius)) * sweep


def side_of(side: str | int, at: Lookup) -> Any:
    """The value of a side, whether stated or open."""
    return at.side(side) if isinstance(side, str) else side
