"""A contour as a drawing whose elements and points have names, and what can be measured in it.

Points count from the start point, in mm; real is the plane's first axis, imaginary its second.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, tau

from contoursolve.model import Turn
from contoursolve.verification.measure import cross, dot


class UnmeasurableError(ValueError):
    """Something that the drawing does not have; the message says what."""


@dataclass(frozen=True, slots=True)
class Straight:
    """A line from `tail` to `head`, the virtual intersections at its ends; its corners leave `begin` to `end`.

    `along` is the unit vector in its direction, also where it has no length.
    """

    tail: complex
    head: complex
    begin: complex
    end: complex
    along: complex

    @property
    def length(self) -> float:
        """Between the virtual intersections, mm."""
        return abs(self.head - self.tail)


@dataclass(frozen=True, slots=True)
class Round:
    """An arc or a rounding; radius in mm."""

    begin: complex
    end: complex
    center: complex
    radius: float
    turn: Turn

    @property
    def length(self) -> float:
        """Along the arc, mm; less than a full turn."""
        spokes = self.begin - self.center, self.end - self.center
        return self.radius * (atan2(cross(*spokes), dot(*spokes)) * self.turn.sign % tau)


@dataclass(frozen=True, slots=True)
class Bevel:
    """A chamfer; its size is the extent along each axis, mm."""

    begin: complex
    end: complex
    size: float

    @property
    def length(self) -> float:
        """From end to end, mm."""
        return abs(self.end - self.begin)


Shape = Straight | Round | Bevel


@dataclass(frozen=True, slots=True)
class Drawing:
    """Shapes and points by their names; `chain` are the names of lines and arcs in the order of travel."""

    points: Mapping[str, complex]
    shapes: Mapping[str, Shape]
    chain: tuple[str, ...]

    def shape(self, name: str) -> Shape:
        """The element of this name. Raises UnmeasurableError if there is none."""
        if name not in self.shapes:
            raise UnmeasurableError(f"there is no {name}")
        return self.shapes[name]

    def line(self, name: str) -> Straight:
        """The line of this name. Raises UnmeasurableError if it is none."""
        shape = self.shape(name)
        if not isinstance(shape, Straight):
            raise UnmeasurableError(f"{name} is not a line")
        return shape

    def round(self, name: str) -> Round:
        """The arc or rounding of this name. Raises UnmeasurableError if it is none."""
        shape = self.shape(name)
        if not isinstance(shape, Round):
            raise UnmeasurableError(f"{name} is not round")
        return shape

    def size(self, name: str) -> float:
        """The radius of an arc or a rounding, the size of a chamfer, mm."""
        shape = self.shape(name)
        return shape.size if isinstance(shape, Bevel) else self.round(name).radius

    def point(self, part: str, of: str) -> complex:
        """A point by its name, or where an element begins, ends, or has its center; a line between its virtual
        intersections."""
        if not part:
            if of not in self.points:
                raise UnmeasurableError(f"there is no point {of}")
            return self.points[of]
        if part == "center":
            return self.round(of).center
        shape = self.shape(of)
        if isinstance(shape, Straight):
            return shape.tail if part == "begin" else shape.head
        return shape.begin if part == "begin" else shape.end

    def are_neighbours(self, first: str, second: str) -> bool:
        """Whether one of two lines or arcs follows the other."""
        return {(first, second), (second, first)} & set(pairwise(self.chain)) != set()

    def travel(self, name: str, other: str) -> tuple[complex, float]:
        """The unit direction of travel of an element where its neighbour meets it, and how far from there the
        direction is known, mm."""
        shape = self.shape(name)
        if isinstance(shape, Straight):
            return shape.along, shape.length
        form = self.round(name)
        if not self.are_neighbours(name, other):
            raise UnmeasurableError(f"{name} and {other} are not neighbours")
        at = form.end if self.chain.index(name) < self.chain.index(other) else form.begin
        spoke = at - form.center
        if not spoke:
            raise UnmeasurableError(f"{name} has no radius")
        return spoke / abs(spoke) * 1j * form.turn.sign, form.radius
