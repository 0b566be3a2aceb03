"""The largest size that fits: a zero of what is left, found at once where that falls linearly with the size."""

from collections.abc import Callable
from math import inf

TINY, NEAR, DECIMALS = 1e-14, 1e-8, 6
"""mm. To which a size is found, within which it is a decimal but for rounding, and the decimals of a size in mm or
inch."""

LEAST = 0.00254
"""mm. The least increment of an inch program, the larger one: where no more is left, there is no room."""

_TRIES = 3
"""Steps after which half of the sizes must be ruled out."""


def largest_fitting(left: Callable[[float], float], high: float) -> float:
    """The largest size (mm) at which no less than 0 is left, below one at which less is; 0 if there is none.

    What is left falls with the size, and may be no number where nothing fits. The zero of the secant through the last
    two sizes is next, as a decimal if it is one but for rounding; where that rules out too little, the middle is.
    """
    low, width, tries = 0.0, high, 0
    (last, before), size = (high, left(high)), high / 2
    while high - low > 2 * _beside(low):
        value = left(size)
        low, high = (size, high) if value >= 0 else (low, size)
        zero = _zero(last, before, size, value)
        if zero >= high and min(value, before) >= 0:
            # On an arc, where what is left ends like a root.
            zero = _zero(last, before * before, size, value * value)
        last, before = size, value
        width, tries = (high - low, 0) if high - low <= width / 2 else (width, tries + 1)
        size = (low + high) / 2
        if high - low <= NEAR and low < round(size, DECIMALS) < high:
            size = round(size, DECIMALS)
        if zero < high and tries < _TRIES:
            decimal = round(zero, DECIMALS)
            zero = decimal if abs(decimal - zero) <= NEAR else zero
            size = max(low + _beside(low), min(zero, high - TINY * max(1.0, high)))
    decimal = round(low, DECIMALS)
    return decimal if abs(decimal - low) <= NEAR and (decimal <= low or left(decimal) >= 0) else low


def _zero(first: float, before: float, second: float, value: float) -> float:
    """The place where the line through two values falls to zero; infinite if it does not."""
    slope = (value - before) / (second - first)
    return second - value / slope if slope < 0 else inf


def _beside(low: float) -> float:
    """The distance above a size that fits in which one that does not is looked for, mm."""
    return (NEAR if low == round(low, DECIMALS) else TINY) * max(1.0, low)
