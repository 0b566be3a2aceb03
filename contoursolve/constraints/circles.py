"""Facts about circles: points on them, and their radii."""

from dataclasses import dataclass
from typing import Any

from contoursolve.constraints.equation import Equation, both, dot, step
from contoursolve.model import Lookup
from contoursolve.tolerance import RADIUS_DIFFERENCE


@dataclass(frozen=True, slots=True)
class OnCircle(Equation):
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

    def reads(self) -> tuple[str, ...]:
        return *both(self.point, self.center), self.radius

    def equation(self, at: Lookup) -> Any:
        spoke, radius = step(at, self.center, self.point), at.radius(self.radius)
        return dot(spoke, spoke) - radius * radius

    def residual(self, at: Lookup) -> Any:
        return self.equation(at) / (2 * at.radius(self.radius))


@dataclass(frozen=True, slots=True)
class Radius(Equation):
    """The radius has the given value."""

    given: str
    radius: str

    def reads(self) -> tuple[str, ...]:
        return (self.radius,)

    def residual(self, at: Lookup) -> Any:
        return at.radius(self.radius) - at.amount(self.given)

    def implied(self, at: Lookup) -> float | None:
        return float(at.radius(self.radius))
