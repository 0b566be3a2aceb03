"""Facts about points: coordinates, and the direction from one to another."""

from dataclasses import dataclass
from math import atan2, degrees, hypot
from typing import Any

from contoursolve.constraints.equation import Equation, both, cross, dot, step
from contoursolve.model import Lookup, scalar


@dataclass(frozen=True, slots=True)
class Coordinate(Equation):
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
class Offset(Equation):
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
class Level(Equation):
    """`point` has the same coordinate on `axis` as `origin`."""

    point: str
    origin: str
    axis: int
    given: str = ""

    def reads(self) -> tuple[str, ...]:
        return scalar(self.point, self.axis), scalar(self.origin, self.axis)

    def residual(self, at: Lookup) -> Any:
        return at.coordinate(self.point, self.axis) - at.coordinate(self.origin, self.axis)


@dataclass(frozen=True, slots=True)
class Collinear(Equation):
    """`point` lies on the line from `tail` through `through`."""

    tail: str
    through: str
    point: str
    given: str = ""

    def reads(self) -> tuple[str, ...]:
        return both(self.tail, self.through, self.point)

    def equation(self, at: Lookup) -> Any:
        return cross(step(at, self.tail, self.through), step(at, self.tail, self.point))

    def residual(self, at: Lookup) -> Any:
        along = step(at, self.tail, self.through)
        return self.equation(at) / at.root(dot(along, along))


@dataclass(frozen=True, slots=True)
class Heading(Equation):
    """The line from `tail` to `head` runs at the given angle."""

    given: str
    tail: str
    head: str

    def reads(self) -> tuple[str, ...]:
        return both(self.tail, self.head)

    def residual(self, at: Lookup) -> Any:
        cosine, sine = at.direction(self.given)
        first, second = step(at, self.tail, self.head)
        return first * sine - second * cosine

    def implied(self, at: Lookup) -> float | None:
        first, second = step(at, self.tail, self.head)
        return degrees(atan2(second, first)) if hypot(first, second) > 0 else None
