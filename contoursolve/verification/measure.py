"""Measuring in the plane: a point is a complex number in mm, real along the plane's first axis."""

from cmath import rect
from decimal import Decimal
from math import atan2, degrees, radians

EPSILON = 2.0**-52
"""1. Two neighbouring doubles differ by this share of their size."""

ROUNDING = 16 * EPSILON
"""1 (share of the sizes that take part). The rounding of a handful of operations on doubles."""

PRINTED = 1e-12
"""mm. Results are written with 12 decimals: twice the half of the last one, for a distance of two points."""

_QUARTER = Decimal(90)


def direction(angle: Decimal) -> complex:
    """The unit vector of an angle in degrees, counter-clockwise; exact along the axes.

    >>> direction(Decimal(180)) == -1, direction(Decimal(-90)) == -1j
    (True, True)
    """
    turned = angle % 360
    if turned < 0:
        turned += 360
    quarter = int(turned // _QUARTER)
    rest = turned - quarter * _QUARTER
    unit = rect(1.0, radians(float(rest))) if rest else complex(1, 0)
    return unit * (1, 1j, -1, -1j)[quarter % 4]


def dot(a: complex, b: complex) -> float:
    """Scalar product: how far `b` reaches along a unit vector `a`."""
    return a.real * b.real + a.imag * b.imag


def cross(a: complex, b: complex) -> float:
    """Vector product: how far `b` lies to the left of a unit vector `a`."""
    return a.real * b.imag - a.imag * b.real


def angle_between(a: complex, b: complex) -> float:
    """The angle from `a` to `b`, degrees, -180 to 180."""
    return degrees(atan2(cross(a, b), dot(a, b)))


def unit(a: complex) -> complex:
    """The direction of a vector; zero for the zero vector."""
    length = abs(a)
    return a / length if length else 0j


def sign(value: float, zero: float = 0.0) -> int:
    """-1, 0 or 1; values up to `zero` in size count as 0."""
    return (value > zero) - (value < -zero)
