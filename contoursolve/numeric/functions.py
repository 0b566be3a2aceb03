"""Functions of equations beyond arithmetic, for any kind of number; mappings that make their values on demand; numbers
as text."""

import math
import operator
from collections.abc import Callable, Mapping
from decimal import Decimal
from typing import Any

from msgspec import Struct


def _may_vanish(value: Any) -> bool:
    return bool(value != 0) is False


def _larger(first: Any, second: Any) -> Any:
    """The larger of two; of one that is not a number, the other."""
    return second if first != first else first if second != second else max(first, second)


def undefined(*_values: Any) -> Any:
    """A function that a kind of number does not have. Raises TypeError."""
    raise TypeError("this kind of number has no such function")


class Functions(Struct, frozen=True):
    """Functions of one kind of number beyond arithmetic, as equations and instructions of CasADi ask for them."""

    root: Callable[[Any], Any] = math.sqrt
    cosine: Callable[[Any], Any] = math.cos
    sine: Callable[[Any], Any] = math.sin
    vanishes: Callable[[Any], bool] = _may_vanish
    """Test that a number is zero, or, of a ball about one number, that it may be."""
    unless_zero: Callable[[Any, Any], Any] | None = None
    """The first of two numbers, or the other where it is zero; None where `vanishes` tells."""
    magnitude: Callable[[Any], Any] = abs
    larger: Callable[[Any, Any], Any] = _larger
    """The larger of two; of one that is not a number, the other."""
    at_most: Callable[[Any, Any], Any] = operator.le
    below: Callable[[Any, Any], Any] = operator.lt
    opposite: Callable[[Any], Any] = operator.not_
    sign: Callable[[Any], Any] = undefined
    """-1, 0 or 1; None of a ball that does not tell."""
    angle: Callable[[Any, Any], Any] = undefined
    """The angle of a sine and a cosine that have a common factor, radians."""
    equal: Callable[[Any, Any], Any] = undefined
    chosen: Callable[[Any, Any], Any] | None = None
    """The value where a condition holds, else 0; None where conditions are True or False, and `sign` and `at_most`
    decide them, or raise an error."""


FLOATS = Functions()


class Created(Mapping[str, Any]):
    """A mapping that makes what is asked for, whatever the name."""

    def __init__(self, make: Callable[[str], Any]) -> None:
        self._make = make

    def __getitem__(self, name: str) -> Any:
        return self._make(name)

    def __contains__(self, _name: object) -> bool:
        return True

    def __iter__(self) -> Any:
        raise TypeError("what is made when it is asked for cannot be listed")

    def __len__(self) -> int:
        raise TypeError("what is made when it is asked for cannot be counted")


def trimmed(value: Decimal | float, places: int | None = None) -> str:
    """A number without zeros at its end: all digits of a decimal one, or rounded to so many places, without a negative
    zero.

    >>> trimmed(Decimal("30.50")), trimmed(-47.32051, 3), trimmed(-0.0001, 3)
    ('30.5', '-47.321', '0')
    """
    text = f"{value:f}" if places is None else f"{value:z.{places}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text
