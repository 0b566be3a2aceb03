"""python-flint: rational numbers, and balls that are certain to hold a real number.

A number here is either exact (`fmpq`) or a ball (`arb`); arithmetic mixes them, and whatever is exact
stays exact. Balls have the precision of the innermost `precision` block.
"""

import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from decimal import Decimal
from functools import lru_cache
from math import inf, nextafter
from threading import RLock
from typing import Any

import flint
from flint import acb_poly, arb, arb_poly, fmpq

from contoursolve.numeric.functions import Functions, undefined

Number = Any
"""fmpq or arb; python-flint has no types of its own for checkers."""

WORKING, HIGHEST = 212, 848
"""Bits of a ball's midpoint: four and sixteen times those of a double."""


_TURN = RLock()


def _renew() -> None:
    """A thread that was inside when the process forked is not in the child, and would never leave."""
    global _TURN  # noqa: PLW0603 - one lock for the process
    _TURN = RLock()
    flint.ctx.prec = _USUAL


_USUAL = flint.ctx.prec
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_renew)


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Balls made inside have midpoints of this many bits. It is one number for the whole process, so that one thread
    at a time is inside."""
    with _TURN, flint.ctx.workprec(bits):
        yield


def exact(value: Decimal | float) -> Number:
    """A finite decimal or float as the rational number that it is."""
    numerator, denominator = value.as_integer_ratio()
    return fmpq(numerator, denominator)


def direction(degrees: Decimal) -> tuple[Number, Number]:
    """(cosine, sine) of an angle: exact for multiples of 90 degrees, else balls."""
    return _direction(degrees, flint.ctx.prec)


@lru_cache(maxsize=65536)
def _direction(degrees: Decimal, _bits: int) -> tuple[Number, Number]:
    turns = exact(degrees) / 180
    halves = turns * 2
    if halves.q == 1:
        return ((fmpq(1), fmpq(0)), (fmpq(0), fmpq(1)), (fmpq(-1), fmpq(0)), (fmpq(0), fmpq(-1)))[int(halves.p) % 4]
    sine, cosine = arb.sin_cos_pi_fmpq(turns)
    return cosine, sine


def is_exact(value: Number) -> bool:
    """Whether a number is a rational one."""
    return isinstance(value, fmpq)


class SameNumbers:
    """Some numbers, for caches: equal to others that are exact and equal, or the very same balls. Balls have no
    equality; one that is kept here has its identity for itself."""

    __slots__ = ("_hash", "_key", "numbers")

    def __init__(self, numbers: Iterable[Number]) -> None:
        self.numbers = tuple(numbers)
        self._key = tuple(each if isinstance(each, fmpq) else (id(each),) for each in self.numbers)
        self._hash = hash((self._key, flint.ctx.prec))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SameNumbers) and self._hash == other._hash and self._key == other._key

    def __hash__(self) -> int:
        return self._hash


def sign(value: Number) -> int | None:
    """-1, 0 or 1; None for a ball that holds zero."""
    if isinstance(value, fmpq):
        return int(value.p > 0) - int(value.p < 0)
    if value > 0:
        return 1
    return -1 if value < 0 else None


def root(value: Number) -> Number:
    """Square root: exact for the square of a rational number."""
    if isinstance(value, fmpq):
        if value.p < 0:
            raise ValueError("square root of a negative number")
        numerator, denominator = value.p.isqrt(), value.q.isqrt()
        if numerator**2 == value.p and denominator**2 == value.q:
            return fmpq(numerator, denominator)
        return arb(value).sqrt()
    return value.sqrt()


def both_roots(value: Number) -> Number:
    """A ball about 0 that holds both square roots of whatever is not negative in a ball."""
    return arb(0, arb(value).upper().sqrt())


def cosine(value: Number) -> Number:
    """Cosine of an angle in radians."""
    return arb(value).cos()


def sine(value: Number) -> Number:
    """Sine of an angle in radians."""
    return arb(value).sin()


def magnitude(value: Number) -> Number:
    """Absolute value."""
    return abs(value)


def between(low: float, high: float) -> Number:
    """The ball from one float to another."""
    return arb(low).union(arb(high))


def around(value: float, margin: float) -> Number:
    """The ball of radius `margin` about a float."""
    return arb(value, margin)


def wider(value: Number, margin: float) -> Number:
    """A ball about a number, wider by `margin`."""
    return arb(value) + arb(0, margin)


def is_finite(value: Number) -> bool:
    """Whether a number has finite bounds."""
    return isinstance(value, fmpq) or bool(value.is_finite())


def middle(value: Number) -> float:
    """The float nearest to a number's midpoint."""
    return int(value.p) / int(value.q) if isinstance(value, fmpq) else float(value.mid())


def width(value: Number) -> float:
    """The radius of a ball as a float, rounded up; 0 for a rational number."""
    return 0.0 if isinstance(value, fmpq) else _up(value.rad())


def bounds(value: Number) -> tuple[float, float]:
    """Floats that enclose a number; the number itself twice if it is one."""
    if isinstance(value, fmpq) and exact(middle(value)) == value:
        return middle(value), middle(value)
    return nextafter(float(arb(value).lower()), -inf), nextafter(float(arb(value).upper()), inf)


def distance(value: Number, at: float) -> float:
    """The largest distance of a number from a float, rounded up."""
    return largest_distance(((value, at),))


def largest_distance(pairs: Iterable[tuple[Number, float]]) -> float:
    """The largest distance of any of some numbers from its float, rounded up; 0 for none."""
    return _up(max((float((arb(value) - at).abs_upper()) for value, at in pairs), default=0.0))


def contains(outer: Number, inner: Number) -> bool:
    """Whether `inner` lies in the interior of the ball `outer`."""
    return bool(arb(outer).contains_interior(arb(inner)))


def center(value: Number) -> Number:
    """The midpoint of a ball, as a ball without width."""
    return value if isinstance(value, fmpq) else value.mid()


def common(first: Number, second: Number) -> Number | None:
    """A ball that holds the common part of two balls; None if they are apart."""
    try:
        return arb(first).intersection(arb(second))
    except ValueError:
        return None


def intersects(first: Number, second: Number) -> bool:
    """Whether two balls have a point in common."""
    return bool(arb(first).overlaps(arb(second)))


def real_roots(coefficients: Sequence[Number]) -> list[Number] | None:
    """All real roots of a polynomial (constant first), each in a ball of its own; None if they cannot be told apart."""
    try:
        roots = acb_poly([arb(each) for each in coefficients]).roots()
    except ValueError:
        return None
    # The roots are isolated: one whose ball meets the real line is its own conjugate.
    polynomial = arb_poly([arb(each) for each in coefficients])
    return [_sharpened(polynomial, each.real) for each in roots if each.imag.contains(0)]


HALVINGS = 64
"""Largest number of contractions of a ball about a root; each doubles its digits, once it is small."""


def _sharpened(polynomial: Any, root: Number) -> Number:
    """The ball about a root that is isolated, which may be wide, shrunk by Newton's method as far as it goes."""
    for _ in range(HALVINGS):
        at = root.mid()
        # About the middle of the ball the powers do not cancel.
        shifted = polynomial(arb_poly([at, 1]))
        smaller = common(root, at - shifted[0] / shifted.derivative()(root - at))
        if smaller is None or not smaller.rad() < root.rad() / 2:
            break
        root = smaller
    return root


def _up(value: Any) -> float:
    found = float(value)
    return nextafter(found, inf) if found > 0 else found


FUNCTIONS = Functions(root, cosine, sine, magnitude=magnitude, at_most=undefined, below=undefined, sign=sign)
