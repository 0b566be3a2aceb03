"""Plain text in columns, safe for any terminal."""

import re
import unicodedata
from collections.abc import Sequence
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Decimal

from contoursolve.model import Length, Plane

_INCH = float(Length.INCH.in_mm)


def columns(rows: Sequence[Sequence[str]], left: Sequence[int] = (0,), indent: str = "  ") -> list[str]:
    """Lines with aligned cells, two blanks apart; the columns named in `left` are aligned left."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    template = indent + "  ".join(f"%{'-' if number in left else ''}{width}s" for number, width in enumerate(widths))
    return [(template % tuple(row)).rstrip() for row in rows]


def printable(text: str) -> str:
    """The text with tabs as blanks and other control characters as dots: as many characters as before."""
    return text if text.isprintable() else "".join(c if c.isprintable() else (" " if c == "\t" else ".") for c in text)


def cells(text: str, begin: int, end: int) -> int:
    """The columns of a terminal that characters of a printable text take, from a place on to before another one, which
    may be behind its end: two for those of East Asia, none for accents that stand above another character."""
    stretch = text[max(begin, 0) : max(end, 0)]
    return max(end, 0) - max(begin, 0) + (0 if stretch.isascii() else sum(map(_surplus, stretch)))


def _surplus(char: str) -> int:
    """How many columns a character takes beyond one."""
    if unicodedata.east_asian_width(char) in "WF":
        return 1
    return -1 if unicodedata.category(char) in ("Mn", "Me") else 0


def harmless(text: str) -> str:
    """The text without lines that GitHub's runner would take for commands to it: names of files and blocks may begin
    with `::`."""
    return _COMMAND.sub(r"\g<blank>\\::", text) if "::" in text else text


_COMMAND = re.compile(r"^(?P<blank>[^\S\n]*+)::", re.MULTILINE)


def length_of(mm: float, unit: Length) -> str:
    """A length in the unit of a program: four decimals of a millimetre, five of an inch; no negative zero."""
    return f"{mm:z.4f}" if unit is Length.MM else f"{mm / _INCH:z.5f}"


def written(value: float, unit: str, way: int = 0) -> str:
    """A value as its word has it, with its unit (mm, inch or deg); decimals as for lengths. An upper (`way` 1) or a
    lower limit (-1) is rounded into its range."""
    decimals = 5 if unit == "inch" else 4
    rounding = {1: ROUND_FLOOR, -1: ROUND_CEILING}.get(way, ROUND_HALF_EVEN)
    shown = Decimal(repr(value)).quantize(Decimal(1).scaleb(-decimals), rounding) if way else value
    return f"{shown:z.{decimals}f} {short_name(unit)}"


def coordinates(place: Sequence[float | None], plane: Plane, unit: Length) -> str:
    """Coordinates (mm, X of a lathe as radius) as the control writes them; of a place with one coordinate, that one."""
    return " ".join(
        f"{letter}{length_of(value * (2 if is_diameter else 1), unit)}"
        for letter, value, is_diameter in zip(plane.axes, place, plane.diameters, strict=True)
        if value is not None
    )


def measured(place: Sequence[float | None], plane: Plane, unit: Length) -> str:
    """Coordinates as the control writes them, with their unit."""
    return f"{coordinates(place, plane, unit)} {short_name(unit.value)}"


def length_in(mm: float, unit: Length) -> str:
    """A length in the unit of a program, with that unit."""
    return f"{length_of(mm, unit)} {short_name(unit.value)}"


def short_name(unit: str) -> str:
    """A unit as it stands behind a number."""
    return "in" if unit == "inch" else unit


def count(number: int, noun: str) -> str:
    """A number with its noun: `1 error`, `2 errors`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"
