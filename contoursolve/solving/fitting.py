"""The last values with which something holds: the largest size that fits, and limits as they are typed."""

from bisect import bisect_left
from collections.abc import Callable
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from math import copysign, inf

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


def last_holding(inside: Decimal, outside: Decimal, step: Decimal, holds: Callable[[float], bool]) -> Decimal:
    """The last number of whole steps with which something holds, on the way from a number with which it does to
    another one; the first number itself where there is none.

    What holds is taken to hold up to there. Steps back that double are tried first, for most limits are almost known.
    """
    way = 1 if outside >= inside else -1
    ahead, back = (ROUND_FLOOR, ROUND_CEILING) if way > 0 else (ROUND_CEILING, ROUND_FLOOR)
    last, first = (outside / step).to_integral_value(ahead), (inside / step).to_integral_value(back)
    count = int(way * (last - first)) + (first * step != inside)

    def at(number: int) -> Decimal:
        return (last - way * number) * step if number < count else inside

    def is_good(number: int) -> bool:
        return number >= count or holds(float(at(number)))

    if is_good(0):
        return at(0)
    far = next(2**power for power in range(count.bit_length() + 1) if is_good(2**power))
    return at(bisect_left(range(count), True, far // 2 + 1, min(far, count), key=is_good))


def typed_limit(inside: float, limit: float, decimals: int, holds: Callable[[float], bool]) -> Decimal:
    """An upper or a lower limit as it is typed: the last number of so many decimals with which something holds, on the
    way from a value inside; of more decimals where there is no such number."""
    found = Decimal(repr(limit))
    if limit != inside:
        begin = Decimal(repr(inside))
        end = Decimal(repr(limit + copysign(_BEYOND * max(1.0, abs(limit)), limit - inside)))
        steps = (Decimal(1).scaleb(-digits) for digits in range(decimals, _MOST_DECIMALS))
        tried = ((step, last_holding(begin, end, step, holds)) for step in steps)
        found = next((each for step, each in tried if each != begin or (not each % step and holds(inside))), found)
    shown = round(found, decimals) + 0
    return shown if shown == found else found


_BEYOND, _MOST_DECIMALS = 1e-7, 17
"""Share of a limit (at least of 1) by which a number that holds may lie beyond it, and decimals that no float has."""
