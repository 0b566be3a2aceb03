"""Facts as equations: one class a fact, one residual formula for floats, sympy and CasADi alike."""

from dataclasses import dataclass
from math import atan2, degrees, hypot
from typing import Any

from contoursolve.model import FIRST, SECOND, Lookup, scalar


def _both(point: str) -> tuple[str, str]:
    return scalar(point, FIRST), scalar(point, SECOND)


@dataclass(frozen=True, slots=True)
class Coordinate:
    """`point` has the given coordinate on `axis`."""

    given: str
    point: str
    axis: int

    def reads(self) -> tuple[str, ...]:
        return (scalar(self.point, self.axis),)

    def residual(self, at: Lookup) -> Any:
        return at.coordinate(self.point, self.axis) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.coordinate(self.point, self.axis))


@dataclass(frozen=True, slots=True)
class Offset:
    """`point` lies the given distance from `origin`, counted along `axis`."""

    given: str
    point: str
    origin: str
    axis: int

    def reads(self) -> tuple[str, ...]:
        return scalar(self.point, self.axis), scalar(self.origin, self.axis)

    def residual(self, at: Lookup) -> Any:
        return at.coordinate(self.point, self.axis) - at.coordinate(self.origin, self.axis) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.coordinate(self.point, self.axis) - at.coordinate(self.origin, self.axis))


@dataclass(frozen=True, slots=True)
class Heading:
    """The line from `tail` to `head` runs at the given angle (its sense is checked apart)."""

    given: str
    tail: str
    head: str

    def reads(self) -> tuple[str, ...]:
        return *_both(self.tail), *_both(self.head)

    def residual(self, at: Lookup) -> Any:
        cosine, sine = at.direction(self.given)
        first, second = _step(at, self.tail, self.head)
        return first * sine - second * cosine

    def implied(self, at: Lookup) -> float | None:
        first, second = _step(at, self.tail, self.head)
        return degrees(atan2(second, first)) if hypot(first, second) > 0 else None


@dataclass(frozen=True, slots=True)
class OnCircle:
    """`point` lies on the circle about `center`; to first order the residual is the distance from it."""

    point: str
    center: str
    radius: str
    given: str = ""

    def reads(self) -> tuple[str, ...]:
        return *_both(self.point), *_both(self.center), self.radius

    def residual(self, at: Lookup) -> Any:
        first, second = _step(at, self.center, self.point)
        radius = at.radius(self.radius)
        return (first**2 + second**2 - radius**2) / (2 * radius)

    def implied(self, _at: Lookup) -> float | None:
        return None


@dataclass(frozen=True, slots=True)
class Radius:
    """The radius has the given value."""

    given: str
    radius: str

    def reads(self) -> tuple[str, ...]:
        return (self.radius,)

    def residual(self, at: Lookup) -> Any:
        return at.radius(self.radius) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.radius(self.radius))


def _step(at: Lookup, tail: str, head: str) -> tuple[Any, Any]:
    return (
        at.coordinate(head, FIRST) - at.coordinate(tail, FIRST),
        at.coordinate(head, SECOND) - at.coordinate(tail, SECOND),
    )
