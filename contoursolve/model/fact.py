"""What a fact about a drawing is: an equation that remembers the word which states it."""

from typing import Any, Protocol


class Lookup(Protocol):
    """Gives the values of points, radii and givens; a value is anything with `+ - * / **`."""

    def coordinate(self, point: str, axis: int) -> Any:
        """One coordinate of a point, mm."""

    def radius(self, name: str) -> Any:
        """A radius, mm."""

    def amount(self, given: str) -> Any:
        """A given length or coordinate, mm."""

    def direction(self, given: str) -> tuple[Any, Any]:
        """Cosine and sine of a given angle."""


class Fact(Protocol):
    """One equation. Its residual is in mm and polynomial in the unknowns."""

    @property
    def given(self) -> str:
        """Name of the given that states this fact; empty for what the form itself states."""

    def reads(self) -> tuple[str, ...]:
        """Names of the scalars that the residual depends on besides the given."""

    def residual(self, at: Lookup) -> Any:
        """Signed distance from being true, mm."""

    def implied(self, at: Lookup) -> float | None:
        """The value of the given (mm or degrees) that makes the residual zero; None where any does."""


def scalar(point: str, axis: int) -> str:
    """The name of one coordinate of a point."""
    return f"{point}.{axis}"
