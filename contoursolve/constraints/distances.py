"""Facts about how far points lie apart."""

from dataclasses import dataclass
from math import hypot
from typing import Any

from contoursolve.constraints.equation import Equation, both, dot, step
from contoursolve.model import Lookup


@dataclass(frozen=True, slots=True)
class Distance(Equation):
    """`tail` and `head` lie the given distance apart; to first order the residual is the excess."""

    given: str
    tail: str
    head: str

    def reads(self) -> tuple[str, ...]:
        return both(self.tail, self.head)

    def equation(self, at: Lookup) -> Any:
        between = step(at, self.tail, self.head)
        return dot(between, between) - at.amount(self.given) * at.amount(self.given)

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * at.amount(self.given))

    def implied(self, at: Lookup) -> float | None:
        return hypot(*map(float, step(at, self.tail, self.head)))


@dataclass(frozen=True, slots=True)
class EqualDistances(Equation):
    """Two pairs of points lie equally far apart."""

    given: str
    first: tuple[str, str]
    second: tuple[str, str]

    def reads(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(both(*self.first, *self.second)))

    def equation(self, at: Lookup) -> Any:
        first, second = step(at, *self.first), step(at, *self.second)
        return dot(first, first) - dot(second, second)

    def residual(self, at: Lookup) -> Any:
        first, second = step(at, *self.first), step(at, *self.second)
        return at.root(dot(first, first)) - at.root(dot(second, second))
