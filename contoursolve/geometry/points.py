"""Facts about points and circles: coordinates, directions from one point to another, points on circles, radii."""

from collections.abc import Collection, Iterator, Set
from math import atan2, degrees, hypot, pi
from typing import Any

from msgspec import Struct

from contoursolve.geometry.fact import Fact, Increments, Lookup, OfCircle, Placed, apart, cross, dot, place, size, step
from contoursolve.geometry.figure import FIRST, SECOND, both
from contoursolve.tolerance import LENGTH, RADIUS_DIFFERENCE


class Coordinate(Fact, Struct, frozen=True):
    """`point` has the given coordinate on `axis`."""

    given: str
    point: str
    axis: int

    def residual(self, at: Lookup) -> Any:
        return at.coordinate(self.point, self.axis) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.coordinate(self.point, self.axis))

    def reach(self, _at: Lookup, increment: Increments) -> Any:
        return increment(str(self.axis)) + increment(self.given)

    @property
    def placed(self) -> Placed:
        return Placed(self.point, self.axis, "")

    @property
    def is_affine(self) -> bool:
        return True


class Offset(Fact, Struct, frozen=True):
    """`point` lies the given distance from `origin`, counted along `axis`."""

    given: str
    point: str
    origin: str
    axis: int

    def residual(self, at: Lookup) -> Any:
        return at.coordinate(self.point, self.axis) - at.coordinate(self.origin, self.axis) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.coordinate(self.point, self.axis) - at.coordinate(self.origin, self.axis))

    def reach(self, _at: Lookup, increment: Increments) -> Any:
        return 2 * increment(str(self.axis)) + increment(self.given)

    @property
    def placed(self) -> Placed:
        return Placed(self.point, self.axis, self.origin)

    @property
    def is_affine(self) -> bool:
        return True


class Level(Fact, Struct, frozen=True):
    """`point` has the same coordinate on `axis` as `origin`."""

    point: str
    origin: str
    axis: int
    given: str = ""

    def residual(self, at: Lookup) -> Any:
        return at.coordinate(self.point, self.axis) - at.coordinate(self.origin, self.axis)

    @property
    def placed(self) -> Placed:
        return Placed(self.point, self.axis, self.origin, is_stepped=False)


class Collinear(Fact, Struct, frozen=True):
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

    def affine_in(self, unknowns: Set[str]) -> Fact:
        """The line may be taken to lead through either of two points: through the one that is known."""
        return self if unknowns.isdisjoint(both(self.through)) else Collinear(self.tail, self.point, self.through)

    @property
    def collinear(self) -> tuple[str, str, str]:
        return self.tail, self.through, self.point


class Heading(Fact, Struct, frozen=True):
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

    def reach(self, at: Lookup, increment: Increments) -> Any:
        cosine, sine = at.direction(self.given)
        first, second = step(at, self.tail, self.head)
        swing = at.root(first * first + second * second) * (pi / 180) * increment(self.given)
        return 2 * (size(sine, at) * increment(str(FIRST)) + size(cosine, at) * increment(str(SECOND))) + swing

    @property
    def heading(self) -> tuple[str, str]:
        return self.tail, self.head

    @property
    def is_affine(self) -> bool:
        return True


class Ray(Heading, frozen=True):
    """`head` lies in the given direction from `tail`, and not in the opposite one."""

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        return (dot(step(at, self.tail, self.head), at.direction(self.given)),)

    @property
    def is_ray(self) -> bool:
        return True


class OnCircle(Fact, Struct, frozen=True):
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

    def places(self, at: Lookup) -> Iterator[tuple[str, tuple[float, float]]]:
        yield self.center, place(at, self.point)

    @property
    def circle(self) -> OfCircle:
        return OfCircle(self.point, self.center, self.radius, self.slack)

    def phrase(self, _axes: tuple[str, str], sought: Collection[str]) -> str:
        return (
            f"the circle about {self.center} passes through {self.point}"
            if self.radius in sought
            else f"{self.point} on the circle about {self.center}"
        )

    def allowance(self, at: Lookup, increment: Increments) -> Any:
        return Fact.allowance(self, at, increment) if self.given else self.slack

    def excess(self, at: Lookup) -> Any:
        return apart(at, self.center, self.point) - at.radius(self.radius)


class Radius(Fact, Struct, frozen=True):
    """The radius has the given value."""

    given: str
    radius: str

    def residual(self, at: Lookup) -> Any:
        return at.radius(self.radius) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.radius(self.radius))

    def reach(self, _at: Lookup, increment: Increments) -> Any:
        return 2 * increment(self.given)

    @property
    def sizes(self) -> str:
        return self.radius
