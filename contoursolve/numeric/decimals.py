"""Decimal numbers as text."""

from decimal import Decimal


def trimmed(value: Decimal | float, places: int | None = None) -> str:
    """A number without zeros at its end: all digits of a decimal one, or rounded to so many places, without a negative
    zero.

    >>> trimmed(Decimal("30.50")), trimmed(-47.32051, 3), trimmed(-0.0001, 3)
    ('30.5', '-47.321', '0')
    """
    text = f"{value:f}" if places is None else f"{value:z.{places}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text
