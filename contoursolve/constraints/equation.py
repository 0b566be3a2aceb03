"""What the facts have in common: how they name scalars, and what most of them do not need."""

from typing import Any

from contoursolve.model import FIRST, SECOND, Lookup, scalar


class Equation:
    """A fact whose residual is a polynomial already, that holds in one sense only and on no open side."""

    __slots__ = ()

    def sides(self) -> tuple[str, ...]:
        return ()

    def equation(self, at: Lookup) -> Any:
        return self.residual(at)

    def residual(self, at: Lookup) -> Any:
        raise NotImplementedError

    def senses(self, _at: Lookup) -> tuple[Any, ...]:
        return ()

    def sense_reads(self) -> tuple[str, ...]:
        return self.reads()

    def reads(self) -> tuple[str, ...]:
        raise NotImplementedError

    def implied(self, _at: Lookup) -> float | None:
        return None


def both(*points: str) -> tuple[str, ...]:
    """The names of both coordinates of points."""
    return tuple(scalar(point, axis) for point in points for axis in (FIRST, SECOND))


def step(at: Lookup, tail: str, head: str) -> tuple[Any, Any]:
    """From one point to another, mm along each axis."""
    return (
        at.coordinate(head, FIRST) - at.coordinate(tail, FIRST),
        at.coordinate(head, SECOND) - at.coordinate(tail, SECOND),
    )


def dot(a: tuple[Any, Any], b: tuple[Any, Any]) -> Any:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1]


def cross(a: tuple[Any, Any], b: tuple[Any, Any]) -> Any:
    """Vector product; positive where b points to the left of a."""
    return a[0] * b[1] - a[1] * b[0]


def rotate(vector: tuple[Any, Any], by: tuple[Any, Any]) -> tuple[Any, Any]:
    """A vector turned by the angle of this cosine and sine."""
    return vector[0] * by[0] - vector[1] * by[1], vector[1] * by[0] + vector[0] * by[1]
