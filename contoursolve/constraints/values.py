"""A lookup over plain mappings, for numbers and symbols of every kind."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from contoursolve.model import FIRST, SECOND, Figure, Line, line_scalars, scalar


def _may_vanish(value: Any) -> bool:
    return bool(value != 0) is False


@dataclass(frozen=True, slots=True)
class Functions:
    """What equations need beyond arithmetic, for one kind of number."""

    root: Callable[[Any], Any] = math.sqrt
    cosine: Callable[[Any], Any] = math.cos
    sine: Callable[[Any], Any] = math.sin
    vanishes: Callable[[Any], bool] = _may_vanish
    """Whether a number is zero; of a ball about one number, whether it may be."""


FLOATS = Functions()


@dataclass(frozen=True, slots=True)
class Values:
    """`scalars` holds coordinates, radii and lines by name, `amounts`, `directions` and `signs` the givens.

    A coordinate or a radius that is no scalar is a given. `headed` are the lines whose direction is a given,
    each with that given and with a point of the line.
    """

    scalars: Mapping[str, Any]
    amounts: Mapping[str, Any]
    directions: Mapping[str, tuple[Any, Any]]
    headed: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    signs: Mapping[str, Any] = field(default_factory=dict)
    functions: Functions = FLOATS

    def scalar(self, name: str) -> Any:
        return self.scalars[name] if name in self.scalars else self.amounts[name]

    def coordinate(self, point: str, axis: int) -> Any:
        return self.scalar(scalar(point, axis))

    def radius(self, name: str) -> Any:
        return self.scalar(name)

    def amount(self, given: str) -> Any:
        return self.amounts[given]

    def direction(self, given: str) -> tuple[Any, Any]:
        return self.directions[given]

    def bearing(self, name: str) -> tuple[Any, Any]:
        if name in self.headed:
            return self.direction(self.headed[name][0])
        cosine, sine, _ = line_scalars(name)
        return self.scalars[cosine], self.scalars[sine]

    def line(self, name: str) -> tuple[Any, Any, Any]:
        cosine, sine = self.bearing(name)
        if name not in self.headed:
            return cosine, sine, self.scalars[line_scalars(name)[2]]
        tail = self.headed[name][1]
        return cosine, sine, cosine * self.coordinate(tail, SECOND) - sine * self.coordinate(tail, FIRST)

    def side(self, name: str) -> Any:
        return self.signs[name]

    def rotation(self, angle: Any) -> tuple[Any, Any]:
        return self.functions.cosine(angle), self.functions.sine(angle)

    def vanishes(self, value: Any) -> bool:
        return self.functions.vanishes(value)

    def root(self, value: Any) -> Any:
        return self.functions.root(value)


def headed_lines(figure: Figure) -> dict[str, tuple[str, str]]:
    """The lines of a figure whose direction is a given, each with that given and with a point of the line."""
    lines = (line for line in (*figure.path, *figure.lines) if isinstance(line, Line))
    return {
        line.name: (line.heading, line.tail)
        for line in lines
        if line.heading is not None and line.name not in figure.carriers
    }
