"""Facts about points and circles: coordinates, directions from one point to another, points on circles, radii."""

from math import atan2, degrees, hypot
from typing import Any

from msgspec import Struct

from contoursolve.geometry.figure import Lookup
from contoursolve.geometry.system import Equation, cross, dot, step
from contoursolve.tolerance import LENGTH, RADIUS_DIFFERENCE


class Coordinate(Equation, Struct, frozen=True):
    """`point` has the given coordinate on `axis`."""

    given: str
    point: str
    axis: int

    def residual(self, at: Lookup) -> Any:
        return at.coordinate(self.point, self.axis) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.coordinate(self.point, self.axis))


class Offset(Equation, Struct, frozen=True):
    """`point` lies the given distance from `origin`, counted along `axis`."""

    given: str
    point: str
    origin: str
    axis: int

    def residual(self, at: Lookup) -> Any:
        return at.coordinate(self.point, self.axis) - at.coordinate(self.origin, self.axis) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.coordinate(self.point, self.axis) - at.coordinate(self.origin, self.axis))


class Level(Equation, Struct, frozen=True):
    """`point` has the same coordinate on `axis` as `origin`."""

    point: str
    origin: str
    axis: int
    given: str = ""

    def residual(self, at: Lookup) -> Any:
        return at.coordinate(self.point, self.axis) - at.coordinate(self.origin, self.axis)


class Collinear(Equation, Struct, frozen=True):
    """`point` lies on the line from `tail` through `through`."""

    tail: str
    through: str
    point: str
    given: str = ""

    def equation(self, at: Lookup) -> Any:
        return cross(step(at, self.tail, self.through), step(at, self.tail, self.point))

    def residual(self, at: Lookup) -> Any:
        along = step(at, self.tail, self.through)
        return self.equation(at) / at.root(dot(along, along))


class Heading(Equation, Struct, frozen=True):
    """The line from `tail` to `head` runs at the given angle."""

    given: str
    tail: str
    head: str

    def residual(self, at: Lookup) -> Any:
        cosine, sine = at.direction(self.given)
        first, second = step(at, self.tail, self.head)
        return first * sine - second * cosine

    def implied(self, at: Lookup) -> float | None:
        first, second = step(at, self.tail, self.head)
        return degrees(atan2(second, first)) if hypot(first, second) > LENGTH else None


class Ray(Heading, frozen=True):
    """`head` lies in the given direction from `tail`, and not in the opposite one."""

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (dot(step(at, self.tail, self.head), at.direction(self.given)),)


class OnCircle(Equation, Struct, frozen=True):
    """`point` lies on the circle about `center`; to first order the residual is the distance from it.

    By up to `slack` (mm) it may be off where the circle is known without it.
    """

    point: str
    center: str
    radius: str
    given: str = ""
    slack: float = RADIUS_DIFFERENCE

    def __repr__(self) -> str:
        """Without the slack, which is no part of the equation: equations are told apart by their texts."""
        return f"OnCircle(point={self.point!r}, center={self.center!r}, radius={self.radius!r}, given={self.given!r})"

    def equation(self, at: Lookup) -> Any:
        spoke, radius = step(at, self.point, self.center), at.radius(self.radius)
        return dot(spoke, spoke) - radius * radius

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * at.radius(self.radius))


class Radius(Equation, Struct, frozen=True):
    """The radius has the given value."""

    given: str
    radius: str

    def residual(self, at: Lookup) -> Any:
        return at.radius(self.radius) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.radius(self.radius))
