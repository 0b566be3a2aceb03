"""What a fact about a drawing is: an equation that remembers the word which states it."""

from typing import Any, Protocol


class Lookup(Protocol):
    """Gives the values of points, radii and givens; a value is anything with `+ - * / **`."""

    def scalar(self, name: str) -> Any:
        """A coordinate, a radius, or a part of a line, by its name."""

    def coordinate(self, point: str, axis: int) -> Any:
        """One coordinate of a point, mm."""

    def radius(self, name: str) -> Any:
        """A radius, mm."""

    def amount(self, given: str) -> Any:
        """A given length or coordinate, mm."""

    def direction(self, given: str) -> tuple[Any, Any]:
        """Cosine and sine of a given angle."""

    def bearing(self, name: str) -> tuple[Any, Any]:
        """Cosine and sine of a line's direction."""

    def line(self, name: str) -> tuple[Any, Any, Any]:
        """Cosine and sine of a line's direction, and how far to the right of it the origin lies, mm.

        A point (x, y) lies `cosine * y - sine * x - offset` to the left of the line, mm.
        """

    def side(self, name: str) -> Any:
        """+1 or -1: on which side two elements touch."""

    def rotation(self, angle: Any) -> tuple[Any, Any]:
        """Cosine and sine of a computed angle, radians."""

    def root(self, value: Any) -> Any:
        """Square root."""

    def vanishes(self, value: Any) -> bool:
        """Whether a value is zero."""


class Fact(Protocol):
    """One equation. Its residual is in mm; `equation` is the same without what makes it no polynomial."""

    @property
    def given(self) -> str:
        """Name of the given that states this fact; empty for what the form itself states."""

    def reads(self) -> tuple[str, ...]:
        """Names of the scalars that the residual depends on besides the given."""

    def sides(self) -> tuple[str, ...]:
        """Names of the sides on which it is not stated where two elements touch."""

    def residual(self, at: Lookup) -> Any:
        """Signed distance from being true, mm."""

    def equation(self, at: Lookup) -> Any:
        """Zero where the residual is, and polynomial in coordinates, radii and directions where it can be."""

    def senses(self, at: Lookup) -> tuple[Any, ...]:
        """What must be positive besides, because the equation alone allows the opposite."""

    def sense_reads(self) -> tuple[str, ...]:
        """Names of the scalars that the sense depends on."""

    def implied(self, at: Lookup) -> float | None:
        """The value of the given (mm or degrees) that makes the residual zero; None where any does."""


def scalar(point: str, axis: int) -> str:
    """The name of one coordinate of a point."""
    return f"{point}.{axis}"


def line_scalars(line: str) -> tuple[str, str, str]:
    """The names of a line's direction and place."""
    return f"{line}.cos", f"{line}.sin", f"{line}.off"
