"""Controls that are read as plain G-code, without contour forms of their own, to compare programs with theirs."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from enum import Enum

from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.further import leaving, letters
from contoursolve.diagnostics import Evidence, Source
from contoursolve.gcode import Block
from contoursolve.geometry import Length, Plane, Unit
from contoursolve.reading import (
    Address,
    Code,
    Control,
    Diameter,
    Effect,
    Lexicon,
    Modes,
    NumberFormat,
    State,
    WithoutPoint,
)

LINUXCNC_MANUAL = Source("LinuxCNC User Manual", "G-codes; lathe user information", Evidence.PRINTED)


class Centers(Enum):
    """The point from which I J K of an arc are counted."""

    START = "where the arc begins"
    ORIGIN = "the origin"


CENTERS: Mapping[str, Mapping[Decimal, Centers | None]] = {
    "linuxcnc": {
        Decimal("90.1"): Centers.ORIGIN,
        Decimal("91.1"): Centers.START,
        Decimal("61.1"): None,
        Decimal("43.1"): None,
        Decimal("43.2"): None,
    }
}
"""By the name of the control: codes that change how the centres of arcs are read, and codes with a point that change
nothing here."""

LATHE = Plane("G18", ("Z", "X"), ("K", "I"), (False, True))
PLANES = {
    17: Plane("G17", ("X", "Y"), ("I", "J")),
    18: Plane("G18", ("Z", "X"), ("K", "I")),
    19: Plane("G19", ("Y", "Z"), ("J", "K")),
}


def lexicon(
    source: Source, numbers: NumberFormat, axes: str, increments: Mapping[str, str], *, is_diameter: bool
) -> Lexicon:
    """Coordinates, their increments, arc centres and radii; X and its increments are diameters, or not."""
    rows = [
        *(Address(axis, "coordinate", Unit.MM, source, axis, is_diameter=is_diameter and axis == "X") for axis in axes),
        *(
            Address(address, "increment", Unit.MM, source, axis, True, is_diameter and axis == "X")
            for address, axis in increments.items()
        ),
        *(Address(address, "centre of an arc", Unit.MM, source) for address in "IJK"),
        Address("R", "radius; negative for an arc of more than 180 deg", Unit.MM, source),
    ]
    return Lexicon({row.address: row for row in rows}, numbers, letters(source))


G20_G21 = {20: Length.INCH, 21: Length.MM}
_UNITS = {Length.INCH: "inches", Length.MM: "millimetres"}


def code_rows(
    source: Source,
    rows: Mapping[Effect, Mapping[int, str]],
    planes: Mapping[int, Plane],
    units: Mapping[int, Length] = G20_G21,
) -> dict[int, Code]:
    """Tables of codes by their effect, with those of units and planes."""
    codes = [Code(number, effect, meaning, source) for effect, row in rows.items() for number, meaning in row.items()]
    codes += [Code(number, Effect.UNITS, _UNITS[unit], source, unit=unit) for number, unit in units.items()]
    codes += [Code(number, Effect.PLANE, "plane", source, plane=plane) for number, plane in planes.items()]
    return {code.number: coming_back(code) for code in codes}


def coming_back(code: Code) -> Code:
    """The row of a code; G70 to G76 of lathes end where the tool was before them, G53 is about coordinates alone."""
    is_cycle = code.effect is Effect.SINGLE and ("cycle" in code.meaning or "roughing" in code.meaning)
    needs_axes = code.effect is Effect.SINGLE and code.meaning in _OF_COORDINATES
    return replace(code, comes_back=is_cycle, needs_axes=needs_axes) if is_cycle or needs_axes else leaving(code)


_OF_COORDINATES = ("machine coordinates", "no offset")
"""The codes about the coordinates of their block, and what they mean."""


MOTIONS = {0: "positioning", 1: "line", 2: "arc clockwise", 3: "arc counter-clockwise"}
ABSOLUTE_CODES = {Effect.ABSOLUTE: {90: "absolute coordinates"}, Effect.INCREMENTAL: {91: "incremental coordinates"}}
_COMPENSATION = {40: "no compensation", 41: "compensation left", 42: "compensation right"}
BASIC_CODES: dict[Effect, dict[int, str]] = {**ABSOLUTE_CODES, Effect.COMPENSATION: _COMPENSATION}
"""The codes of every control that has G90 and G91, its motions aside."""
_EVERYWHERE: dict[Effect, dict[int, str]] = {
    Effect.MOTION: MOTIONS,
    Effect.NO_MOTION: {4: "dwell", 10: "data setting"},
    Effect.COMPENSATION: _COMPENSATION,
    Effect.SHIFT: dict.fromkeys(range(54, 60), "work coordinate system"),
    Effect.SINGLE: {28: "reference point return", 30: "other reference point return", 53: "machine coordinates"},
    Effect.NONE: {96: "constant surface speed", 97: "spindle speed", 98: "feed or return", 99: "feed or return"},
}
DRILLING = dict.fromkeys((73, *range(81, 90)), "drilling cycle")


def merge(*tables: Mapping[Effect, Mapping[int, str]]) -> dict[Effect, dict[int, str]]:
    """Tables of codes in one; where two have a code, the later one counts."""
    rows: dict[Effect, dict[int, str]] = {}
    for table in (_EVERYWHERE, *tables):
        for effect, row in table.items():
            rows.setdefault(effect, {}).update(row)
    return rows


MILL_CODES = merge(
    ABSOLUTE_CODES,
    {
        Effect.MOTION: {33: "thread"},
        Effect.NO_MOTION: {22: "stored limit on", 23: "stored limit off"},
        Effect.SINGLE: {27: "reference point check", 29: "return from reference point", 31: "skip"}
        | {37: "length measurement", 65: "macro call", 66: "modal macro call", 67: "end of modal macro call"},
        Effect.CYCLE: DRILLING | {74: "drilling cycle", 76: "drilling cycle"},
        Effect.CANCEL: {80: "end of cycle"},
        Effect.PRESET: {92: "coordinate setting"},
        Effect.FRAME: {15: "end of polar coordinates", 16: "polar coordinates", 50: "end of scaling"}
        | {51: "scaling", 52: "local coordinate system", 68: "rotation", 69: "end of rotation"},
        Effect.NONE: {43: "length compensation", 44: "length compensation", 49: "no length compensation"}
        | {9: "exact stop", 61: "exact stop", 64: "cutting", 94: "feed a minute", 95: "feed a revolution"},
    },
)
"""Those of mills as Fanuc, Mitsubishi and NCT have them."""

LATHE_CODES: dict[Effect, dict[int, str]] = {
    Effect.MOTION: {32: "thread", 34: "thread of variable lead"},
    Effect.NO_MOTION: {22: "stored limit on", 23: "stored limit off"},
    Effect.SINGLE: {27: "reference point check", 31: "skip", 36: "tool offset X", 37: "tool offset Z"}
    | {65: "macro call", 66: "modal macro call", 67: "end of modal macro call"},
    Effect.CYCLE: {90: "turning cycle", 92: "thread cycle", 94: "facing cycle"},
    Effect.PRESET: {50: "coordinate setting or spindle limit"},
}
"""Those of lathes as Fanuc and YASNAC have them, but for their cycles."""

_LINUXCNC_CODES = code_rows(
    LINUXCNC_MANUAL,
    merge(
        ABSOLUTE_CODES,
        {
            Effect.MOTION: {33: "thread"},
            Effect.CYCLE: DRILLING,
            Effect.CANCEL: {80: "end of cycle"},
            Effect.PRESET: {92: "coordinate setting"},
            Effect.FRAME: {52: "local coordinate system"},
            Effect.SINGLE: {70: "finishing cycle", 71: "roughing", 72: "roughing", 76: "threading cycle"},
            Effect.NONE: {43: "length compensation", 49: "no length compensation", 61: "exact path", 64: "blending"}
            | dict.fromkeys((93, 94, 95), "kind of feed"),
        },
    ),
    PLANES,
)
_LINUXCNC_CODES |= {
    7: Code(7, Effect.NONE, "X is a diameter", LINUXCNC_MANUAL, diameter=Diameter.ON),
    8: Code(8, Effect.NONE, "X is a radius", LINUXCNC_MANUAL, diameter=Diameter.OFF),
}
_AS_WRITTEN = NumberFormat(WithoutPoint.AS_WRITTEN, LINUXCNC_MANUAL)
CALLS = frozenset({98, 99})


def _no_contour(blocks: Sequence[Block], index: int, state: State, modes: Modes) -> None:
    """There is none."""


LINUXCNC = Control(
    "linuxcnc",
    "LinuxCNC, mills and lathes",
    Modes(lexicon(LINUXCNC_MANUAL, _AS_WRITTEN, "XYZ", {}, is_diameter=False), _LINUXCNC_CODES, ("X", "Y", "Z"), CALLS),
    PLANES[17],
    (),
    COMMON_RULES,
    _no_contour,
    lambda _: (),
    diameter=Diameter.OFF,
)
PLAIN = {LINUXCNC.name: LINUXCNC}
