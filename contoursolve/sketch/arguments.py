"""The arguments of a sketch's calls: names that facts can mention, and numbers; what is none is refused by name."""

import re
from collections.abc import Iterable
from decimal import Decimal, InvalidOperation
from numbers import Integral, Real

from contoursolve.model import Length, Plane
from contoursolve.statements import GrammarError, PointIs, RadiusIs, Touches, Vocabulary, read_statement
from contoursolve.tolerance import LARGEST

Number = Decimal | float | int | str
"""A value in mm or degrees; a float is taken as the decimal that Python prints for it."""

Place = tuple[Decimal, Decimal]

PLANE = Plane("", ("X", "Y"), ("I", "J"))
"""The axes of every sketch."""

_INTERNAL = re.compile(r"fact \d+", re.IGNORECASE)
"""What facts are called among the givens."""


def checked_element(call: str, name: str, taken: Iterable[str]) -> str:
    """A name for a new element. Raises ValueError if it cannot be one, or is taken."""
    _check_text(call, "the name", name)
    words = Vocabulary((name,), (), PLANE, Length.MM)
    try:
        is_clear = read_statement(f"radius of {name} = 1", words) == RadiusIs(name, Decimal(1))
        is_clear &= read_statement(f"{name} tangent to {name}", words) == Touches(name, name)
    except GrammarError:
        is_clear = False
    if not is_clear or _INTERNAL.fullmatch(name):
        raise ValueError(f"{call}: no fact could mention an element of the name {name!r}; choose another one")
    _check_free(call, "an element", name, taken)
    return name


def checked_point(call: str, name: str, taken: Iterable[str]) -> str:
    """A name for a new point. Raises ValueError if it cannot be one, or is taken."""
    _check_text(call, "the name of a point", name)
    try:
        is_clear = read_statement(f"X of {name} = 1", Vocabulary((), (name,), PLANE, Length.MM)) == PointIs(
            "", name, 0, Decimal(1)
        )
    except GrammarError:
        is_clear = False
    if not is_clear or _INTERNAL.fullmatch(name):
        raise ValueError(f"{call}: no fact could mention a point of the name {name!r}; choose another one")
    _check_free(call, "a point", name, taken)
    return name


def _check_text(call: str, what: str, name: object) -> None:
    if not isinstance(name, str) or not name.strip():
        raise ValueError(f"{call}: {what} is a text, not {name!r}")
    if "." in name:
        raise ValueError(
            f"{call}: {name!r} has a dot, as the names have that a sketch gives (`k.center`); leave it out"
        )


def _check_free(call: str, what: str, name: str, taken: Iterable[str]) -> None:
    same = next((each for each in taken if each.lower() == name.lower()), None)
    if same is not None:
        as_well = "" if same == name else f" ({same!r}: capitals do not matter)"
        raise ValueError(f"{call}: there is {what} of the name {name!r} already{as_well}; choose another one")


def checked_place(call: str, what: str, place: object) -> Place:
    """A pair of coordinates, mm. Raises ValueError if it is none."""
    if not isinstance(place, tuple | list) or len(place) != 2:  # noqa: PLR2004 - the plane has two axes
        raise ValueError(f"{call}: {what} is a pair of numbers such as (10, 20), not {place!r}")
    return checked_number(call, f"X of {what}", place[0]), checked_number(call, f"Y of {what}", place[1])


def checked_number(call: str, what: str, value: object) -> Decimal:
    """A number. Raises ValueError if it is none, is not finite, or is larger than any drawing."""
    try:
        number = _decimal(value)
    except InvalidOperation:
        number = None
    if number is None:
        raise ValueError(f"{call}: {what} is a number, not {value!r}")
    if not number.is_finite():
        raise ValueError(f"{call}: {what} is a finite number, not {value!r}")
    if abs(number) > Decimal(LARGEST):
        raise ValueError(f"{call}: {what} is {value!r}; the largest number that is read is {LARGEST:.0f}")
    return number


def _decimal(value: object) -> Decimal | None:
    """Raises InvalidOperation for a text that is no number."""
    if isinstance(value, bool):
        return None
    if isinstance(value, Decimal | str):
        return Decimal(value)
    if isinstance(value, Integral):
        return Decimal(int(value))
    return Decimal(repr(float(value))) if isinstance(value, Real) else None
