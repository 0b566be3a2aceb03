"""Fanuc and Haas: addresses, numbers, planes and G codes of lathes and mills."""

from dataclasses import replace as dataclass_replace

from msgspec.structs import replace

from contoursolve.controls.further import HAAS_LATHES, HAAS_MILLS, LATHES, MILLS, UNREAD_CALLS, known_by_name
from contoursolve.controls.plain import (
    CALLS,
    LATHE,
    LATHE_CODES,
    MILL_CODES,
    PLANES,
    code_rows,
    lexicon,
    merge,
)
from contoursolve.controls.zero_tables import haas_rows, length_rows, zero_table
from contoursolve.diagnostics import Book, Evidence, Source
from contoursolve.execution import fanuc, haas
from contoursolve.geometry import Unit
from contoursolve.reading import Address, Effect, Lexicon, Modes, NumberFormat, WithoutPoint

FANUC_MANUAL = Source("Fanuc 0i operator's manuals", "list of G codes, code system A for lathes", Evidence.ASSUMED)
DRAWING = Book("FANUC lathe, direct drawing dimensions")
CORNERS = Book("FANUC mill, optional angle chamfering and corner rounding")
HAAS = Book("Haas operator's manual, corner rounding and chamfering")

STOPS = Source("Fanuc 0i operator's manuals", "an address that cannot stand there stops the control", Evidence.ASSUMED)

_INCREMENTS = NumberFormat(WithoutPoint.LEAST_INCREMENTS, FANUC_MANUAL)

LATHE_PLANES = {17: replace(LATHE, code="G17"), 18: LATHE, 19: replace(LATHE, code="G19")}
"""A lathe has Z and X alone, whatever plane is selected."""

HAAS_LATHE_PLANES = {17: replace(PLANES[17], diameters=(True, False)), 18: LATHE, 19: PLANES[19]}
"""A Haas lathe may have Y, and makes corners in each of its planes."""

_OF_LATHES = merge(LATHE_CODES, {Effect.SINGLE: dict.fromkeys(range(70, 77), "cycle")})
_LATHE_CODES = code_rows(FANUC_MANUAL, _OF_LATHES, LATHE_PLANES)
_HAAS_LATHE_CODES = code_rows(FANUC_MANUAL, _OF_LATHES, HAAS_LATHE_PLANES)
_MILL_CODES = code_rows(FANUC_MANUAL, MILL_CODES, PLANES)


def _with(words: Lexicon, *rows: Address) -> Lexicon:
    addresses = {**words.addresses, **{row.address: row for row in rows}}
    return dataclass_replace(words, addresses=addresses, unknown=STOPS)


_TURNED = lexicon(FANUC_MANUAL, _INCREMENTS, "XZ", {"U": "X", "W": "Z"}, is_diameter=True)
_HAAS_TURNED = lexicon(FANUC_MANUAL, _INCREMENTS, "XYZ", {"U": "X", "V": "Y", "W": "Z"}, is_diameter=True)
_MILLED = lexicon(FANUC_MANUAL, _INCREMENTS, "XYZ", {}, is_diameter=False)

_ANGLE = "angle of the line, from +Z, counter-clockwise"
_LEG, _ROUND = "chamfer: the distance of both its ends from the virtual corner", "rounding"
LATHE_WORDS = _with(
    _TURNED,
    Address(",A", _ANGLE, Unit.DEGREE, DRAWING.printed("block patterns")),
    Address(",C", _LEG, Unit.MM, DRAWING.printed("block patterns 4 to 8")),
    Address(",R", _ROUND, Unit.MM, DRAWING.printed("block patterns 3 to 8")),
)
MILL_WORDS = _with(
    _MILLED,
    Address(",C", _LEG, Unit.MM, CORNERS.printed("sample program")),
    Address(",R", _ROUND, Unit.MM, CORNERS.printed("sample program")),
)
HAAS_LATHE_WORDS = _with(
    _HAAS_TURNED,
    Address("A", _ANGLE, Unit.DEGREE, HAAS.assumed("recalled")),
    Address(",C", _LEG, Unit.MM, HAAS.printed("example")),
    Address(",R", _ROUND, Unit.MM, HAAS.printed("example")),
)
HAAS_MILL_WORDS = _with(
    _MILLED,
    Address(",C", _LEG, Unit.MM, HAAS.assumed("lathe's example")),
    Address(",R", _ROUND, Unit.MM, HAAS.assumed("lathe's example")),
)

_CODES = {
    name: known_by_name(FANUC_MANUAL, more, own)
    for name, more, own in (
        ("lathe", LATHES, _LATHE_CODES),
        ("mill", MILLS, _MILL_CODES),
        ("haas lathe", HAAS_LATHES, _HAAS_LATHE_CODES),
        ("haas mill", HAAS_MILLS, _MILL_CODES),
    )
}
_ON_LATHES, _ON_MILLS = ("Z", "X"), ("X", "Y", "Z")
_OFFSETS = Source("Fanuc 0i operator's manuals", "work and tool offsets, G10, system variables", Evidence.ASSUMED)
_HAAS_OFFSETS = Source("Haas operator's manuals", "work and tool offsets, G10, macro variables", Evidence.ASSUMED)
_LATHE_ZERO = zero_table(_OFFSETS, _ON_LATHES)
_MILL_ZERO = zero_table(_OFFSETS, _ON_MILLS, *length_rows(_OFFSETS))
_HAAS_LATHE_ZERO, _HAAS_MILL_ZERO = (
    zero_table(_HAAS_OFFSETS, axes, *haas_rows(_HAAS_OFFSETS), *more, further="154")
    for axes, more in ((_ON_LATHES, ()), (_ON_MILLS, length_rows(_HAAS_OFFSETS)))
)
LATHE_MODES = Modes(
    LATHE_WORDS, _CODES["lathe"], _ON_LATHES, CALLS, language=fanuc(), unread_calls=UNREAD_CALLS, zero=_LATHE_ZERO
)
MILL_MODES = Modes(
    MILL_WORDS, _CODES["mill"], _ON_MILLS, CALLS, language=fanuc(), unread_calls=UNREAD_CALLS, zero=_MILL_ZERO
)
HAAS_LATHE_MODES = Modes(
    HAAS_LATHE_WORDS, _CODES["haas lathe"], (*_ON_LATHES, "Y"), CALLS, language=haas(), zero=_HAAS_LATHE_ZERO
)
HAAS_MILL_MODES = Modes(HAAS_MILL_WORDS, _CODES["haas mill"], _ON_MILLS, CALLS, language=haas(), zero=_HAAS_MILL_ZERO)
