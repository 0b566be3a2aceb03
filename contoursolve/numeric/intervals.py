"""Many intervals at once, as NumPy arrays of bounds rounded outwards: fast enough to look at thousands of boxes.

Every bound of an operation is moved to the next double, so that whatever is excluded is excluded with proof.
"""

from typing import Any

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.numeric.functions import Functions
from contoursolve.numeric.linear_algebra import Array

LARGEST_ANGLE = 1e6
"""Radians. The sine of an angle that may be larger is anything from -1 to 1."""

TRIGONOMETRY = 2.0**-46
"""1. By how much NumPy's sines and cosines are taken to be off at most, 64 times the rounding of a 1."""


def down(value: Array) -> Array:
    """The next double below."""
    return numpy.nextafter(value, -numpy.inf)


def up(value: Array) -> Array:
    """The next double above."""
    return numpy.nextafter(value, numpy.inf)


class Intervals(Struct, frozen=True, eq=False):
    """Lower and upper bounds."""

    low: Array
    high: Array

    def __getitem__(self, places: slice | NDArray[numpy.bool_]) -> "Intervals":
        return Intervals(self.low[places], self.high[places])

    def __add__(self, other: "Intervals") -> "Intervals":
        return Intervals(down(self.low + other.low), up(self.high + other.high))

    def __sub__(self, other: "Intervals") -> "Intervals":
        return Intervals(down(self.low - other.high), up(self.high - other.low))

    def __neg__(self) -> "Intervals":
        return Intervals(-self.high, -self.low)

    def __mul__(self, other: "Intervals") -> "Intervals":
        if other is self:
            return square(self)
        a, b, c, d = self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high
        low = numpy.minimum(numpy.minimum(a, b), numpy.minimum(c, d))
        return rounded(low, numpy.maximum(numpy.maximum(a, b), numpy.maximum(c, d)))

    def __truediv__(self, other: "Intervals") -> "Intervals":
        return self * inverse(other)

    def __rtruediv__(self, _one: int) -> "Intervals":
        return inverse(self)

    def __pow__(self, exponent: "Intervals") -> "Intervals":
        raise ValueError("powers other than squares are not needed")


def constant(value: float) -> Intervals:
    """A double."""
    return Intervals(numpy.array(value), numpy.array(value))


def rounded(low: Array, high: Array) -> Intervals:
    """The bounds moved outwards by a double each; what is not a number is no bound."""
    # fmax and fmin pass over what is not a number.
    return Intervals(numpy.fmax(down(low), -numpy.inf), numpy.fmin(up(high), numpy.inf))


def square(value: Intervals) -> Intervals:
    """The square, never negative."""
    a, b = value.low * value.low, value.high * value.high
    low = numpy.where((value.low <= 0) & (value.high >= 0), 0.0, down(numpy.minimum(a, b)))
    return Intervals(low, up(numpy.maximum(a, b)))


def inverse(value: Intervals) -> Intervals:
    """One divided by it; everything where it holds zero, except as an end."""
    holds = (value.low < 0) & (value.high > 0)
    low = numpy.where(value.high == 0, -numpy.inf, 1 / value.high)
    high = numpy.where(value.low == 0, numpy.inf, 1 / value.low)
    return rounded(numpy.where(holds, -numpy.inf, low), numpy.where(holds, numpy.inf, high))


def root(value: Intervals) -> Intervals:
    """Square root of the part that is not negative."""
    low, high = (numpy.sqrt(numpy.maximum(each, 0.0)) for each in (value.low, value.high))
    return Intervals(numpy.maximum(down(low), 0.0), up(high))


def magnitude(value: Intervals) -> Intervals:
    """Absolute value."""
    low = numpy.maximum(numpy.maximum(value.low, -value.high), 0.0)
    return Intervals(low, numpy.maximum(-value.low, value.high))


def sign(value: Intervals) -> Intervals:
    """-1, 0 or 1."""
    return Intervals(numpy.sign(value.low), numpy.sign(value.high))


def cosine(value: Intervals) -> Intervals:
    """Cosine of angles in radians."""
    return _wave(value, 0.0)


def sine(value: Intervals) -> Intervals:
    """Sine of angles in radians."""
    return _wave(value, numpy.pi / 2)


def _wave(value: Intervals, crest: float) -> Intervals:
    """A cosine whose crests are at `crest` and full turns from it."""
    low, high = value.low, value.high
    is_far = ~(numpy.maximum(numpy.abs(low), numpy.abs(high)) < LARGEST_ANGLE)
    low, high = numpy.where(is_far, 0.0, low), numpy.where(is_far, 0.0, high)
    function: Any = numpy.sin if crest else numpy.cos
    ends = function(low), function(high)

    def holds(at: float) -> Any:
        # A crest that is hardly outside counts as inside.
        turns = (low - at) / (2 * numpy.pi) - 1e-9, (high - at) / (2 * numpy.pi) + 1e-9
        return numpy.floor(turns[1]) >= numpy.ceil(turns[0])

    bottom = numpy.minimum(*ends) - TRIGONOMETRY
    top = numpy.maximum(*ends) + TRIGONOMETRY
    return Intervals(
        numpy.where(is_far | holds(crest + numpy.pi), -1.0, numpy.maximum(bottom, -1.0)),
        numpy.where(is_far | holds(crest), 1.0, numpy.minimum(top, 1.0)),
    )


def angle(first: Intervals, second: Intervals) -> Intervals:
    """The angle with this sine and cosine (of any common length), -pi to pi."""
    corners = [numpy.arctan2(y, x) for y in (first.low, first.high) for x in (second.low, second.high)]
    low = numpy.minimum(numpy.minimum(*corners[:2]), numpy.minimum(*corners[2:])) - TRIGONOMETRY
    high = numpy.maximum(numpy.maximum(*corners[:2]), numpy.maximum(*corners[2:])) + TRIGONOMETRY
    is_open = ~((first.low > 0) | (first.high < 0) | (second.low > 0))  # about the origin, or where the angle jumps
    return Intervals(numpy.where(is_open, -numpy.pi, low), numpy.where(is_open, numpy.pi, high))


def larger(first: Intervals, second: Intervals) -> Intervals:
    """The larger of two."""
    return Intervals(numpy.maximum(first.low, second.low), numpy.maximum(first.high, second.high))


def _truth(surely: Any, possibly: Any) -> Intervals:
    """0 or 1, or both where it is not known."""
    return Intervals(surely * 1.0, possibly * 1.0)


def equal(first: Intervals, second: Intervals) -> Intervals:
    """Truth of both being the same number, as an interval from 0 to 1."""
    is_one = (first.low == first.high) & (second.low == second.high) & (first.low == second.low)
    return _truth(is_one, (first.low <= second.high) & (second.low <= first.high))


def at_most(first: Intervals, second: Intervals) -> Intervals:
    """Truth of the first being not larger, as an interval from 0 to 1."""
    return _truth(first.high <= second.low, first.low <= second.high)


def below(first: Intervals, second: Intervals) -> Intervals:
    """Truth of the first being smaller, as an interval from 0 to 1."""
    return _truth(first.high < second.low, first.low < second.high)


def opposite(value: Intervals) -> Intervals:
    """0 for 1, and 1 for 0."""
    return Intervals(1.0 - value.high, 1.0 - value.low)


def chosen(condition: Intervals, value: Intervals) -> Intervals:
    """The value where the condition is true, 0 where it is not, and what lies between where it is not known."""
    low = numpy.where(condition.low == 1, value.low, numpy.minimum(value.low, 0.0))
    high = numpy.where(condition.low == 1, value.high, numpy.maximum(value.high, 0.0))
    is_false = condition.high == 0
    return Intervals(numpy.where(is_false, 0.0, low), numpy.where(is_false, 0.0, high))


FUNCTIONS = Functions(
    root,
    cosine,
    sine,
    magnitude=magnitude,
    larger=larger,
    at_most=at_most,
    below=below,
    opposite=opposite,
    sign=sign,
    angle=angle,
    equal=equal,
    chosen=chosen,
)
