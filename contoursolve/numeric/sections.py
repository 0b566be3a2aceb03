"""The place where something begins to hold: what lies between two values is divided again and again."""

from collections.abc import Callable

import numpy
from numpy.typing import NDArray

from contoursolve.numeric.linear_algebra import Array

SECTIONS, _PLACES = 12, 33
"""The number of times that what lies between two values is divided, at most, and values that divide it."""


def section(
    low: float, high: float, is_beyond: Callable[[Array], NDArray[numpy.bool_]], width: float = 0.0
) -> tuple[float, float]:
    """Two numbers no farther apart than so much, or neighbours, between which something first holds that does not at
    the first value, but at the other one."""
    for _ in range(SECTIONS):
        if abs(high - low) <= max(width, 4 * numpy.spacing(max(abs(low), abs(high)))):
            break
        places = numpy.linspace(low, high, _PLACES)
        changed = is_beyond(places)
        changed[0], changed[-1] = False, True
        number = int(changed.argmax())
        low, high = float(places[number - 1]), float(places[number])
    return low, high


def halve(inside: float, outside: float, kind: Callable[[float], object], width: float = 0.0) -> tuple[float, float]:
    """The same by single values: at the first number the kind is still that of the first value."""
    own = kind(inside)
    while abs(outside - inside) > width and (middle := (inside + outside) / 2) not in (inside, outside):
        inside, outside = (middle, outside) if kind(middle) == own else (inside, middle)
    return inside, outside
