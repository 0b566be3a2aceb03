"""Cosine and sine of an angle in degrees, exact where they are exact."""

from decimal import Decimal
from functools import lru_cache
from math import cos, radians, sin, sqrt

COSINE, SINE, SIDE = ":cos", ":sin", "side:"
"""Ends of the names of inputs for a given angle, and beginning of that for a side."""

_HALF = Decimal(45)


@lru_cache(maxsize=65536)
def direction(degrees: Decimal) -> tuple[float, float]:
    """(cosine, sine) of an angle in degrees.

    The angle is folded into 0 to 45 degrees in decimal arithmetic first, so that 90 degrees has the
    cosine 0, opposite angles have exactly opposite directions, and mirrored angles exactly mirrored
    ones: the verdict on a mirrored contour is then the same to the last bit.
    """
    quarter, rest = divmod(degrees % 360, 90)
    if rest < 0:
        rest += 90
        quarter -= 1
    if rest == _HALF:
        cosine = sine = sqrt(0.5)
    elif rest < _HALF:
        cosine, sine = cos(radians(float(rest))), sin(radians(float(rest)))
    else:
        cosine, sine = sin(radians(float(90 - rest))), cos(radians(float(90 - rest)))
    for _ in range(int(quarter) % 4):
        cosine, sine = -sine, cosine
    return cosine + 0.0, sine + 0.0
