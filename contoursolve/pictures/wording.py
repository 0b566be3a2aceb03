"""Words and numbers as a picture shows them: in the unit and with the axes of the program."""

from contoursolve.model import Length, Plane
from contoursolve.solving import Point

LONGEST = 28
"""Characters of a word on a drawing."""

_DECIMALS = {Length.MM: 3, Length.INCH: 4}


def number(mm: float, unit: Length) -> str:
    """A length in the unit of a program, to the least increment; without zeros at its end, or a negative zero.

    >>> number(-47.32051, Length.MM), number(30.0, Length.MM), number(-0.0001, Length.MM)
    ('-47.321', '30', '0')
    """
    text = f"{mm / float(unit.in_mm):.{_DECIMALS[unit]}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def coordinate(at: Point, axis: int, plane: Plane, unit: Length) -> str:
    """One coordinate as a word, a diameter as one."""
    return plane.axes[axis] + number(at[axis] * (2 if plane.diameters[axis] else 1), unit)


def word_text(text: str) -> str:
    """A word as it is shown: without blanks around, not too long, and with nothing that cannot be seen."""
    shown = visible(" ".join(text.split()))
    return shown if len(shown) <= LONGEST else shown[: LONGEST - 1] + "…"


def axis_text(word: str, unit: str) -> str:
    """The name of an axis on which the values of a word stand, with the unit in which it is written, if it has one."""
    return visible(f"{word} [{'in' if unit == 'inch' else unit}]" if unit else word)


def visible(text: str) -> str:
    """The text with what cannot be seen as dots, tabs as blanks: one character each."""
    return "".join(each if each.isprintable() else (" " if each == "\t" else "·") for each in text)
