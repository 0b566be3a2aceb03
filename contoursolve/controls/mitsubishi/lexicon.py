"""Mitsubishi: addresses, numbers, planes and G codes."""

from collections.abc import Mapping
from dataclasses import replace

from msgspec.structs import replace as replace_fields

from contoursolve.controls.further import MILLS, UNREAD_CALLS, known_by_name
from contoursolve.controls.plain import CALLS, LATHE, MILL_CODES, PLANES, code_rows, lexicon, merge
from contoursolve.controls.zero_tables import zero_table
from contoursolve.diagnostics import Book, Evidence, Source
from contoursolve.execution import fanuc
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Plane, Unit
from contoursolve.reading import Address, Effect, Lexicon, Modes, NumberFormat, WithoutPoint

BOOK = Book("Mitsubishi M700V/M70V programming manual")


_CODES = merge(MILL_CODES, {Effect.NONE: {5: "high-speed machining"}})
_NUMBERS = NumberFormat(WithoutPoint.AS_WRITTEN, BOOK.assumed("a machine parameter"))
STOPS = BOOK.assumed("an address that cannot stand there stops the control")
_PLACE = BOOK.printed("linear angle command, p. 375")
_CHAMFER = Source("Mitsubishi corner chamfering, as users quote it", "length of ,C", Evidence.PRINTED)
LAST_CORNER = BOOK.assumed("corner chamfering, second hand: of two words in a block, the last is valid")
_CENTER = BOOK.printed("p. 378: format list 3")
_ANGLE = "angle of the line, from the plane's first axis, counter-clockwise"


def _words(*, is_diameter: bool) -> Lexicon:
    """The addresses, with X as a diameter or a radius; I, J, K and R are no diameters."""
    plain = lexicon(BOOK.assumed("addresses"), _NUMBERS, "XYZ", {}, is_diameter=is_diameter)
    rows = (
        Address("A", _ANGLE, Unit.DEGREE, _PLACE),
        Address(",A", _ANGLE, Unit.DEGREE, _PLACE),
        Address(",C", "chamfer: the distance of both its ends from the virtual corner", Unit.MM, _CHAMFER),
        Address(",R", "rounding", Unit.MM, BOOK.assumed("corner chamfering")),
        Address("P", "centre of an arc without an end, a coordinate in place of I (in G19 of J)", Unit.MM, _CENTER),
        Address("Q", "centre of an arc without an end, a coordinate in place of K (in G17 of J)", Unit.MM, _CENTER),
        Address("H", "0 the crossing with the shorter line, 1 with the longer line", Unit.SIGN, BOOK.printed("p. 378")),
    )
    return replace(plain, addresses={**plain.addresses, **{row.address: row for row in rows}}, unknown=STOPS)


def _modes(words: Lexicon, planes: dict[int, Plane]) -> Modes:
    source = BOOK.assumed("list of G codes")
    codes = known_by_name(source, MILLS, code_rows(source, _CODES, planes))
    axes = ("X", "Y", "Z")
    zero = zero_table(BOOK.assumed("work and tool offsets, as on Fanuc"), axes)
    return Modes(words, codes, axes, CALLS, remember=_remember, language=fanuc(), unread_calls=UNREAD_CALLS, zero=zero)


HIGH_SPEED = 5
"""G05."""


def _remember(memory: Mapping[str, Word], block: Block) -> Mapping[str, Word]:
    """High-speed machining stays in force until G05 P0."""
    codes = [word for word in block.words if word.address == "G" and word.number == HIGH_SPEED]
    if not codes:
        return memory
    mode = block.find("P")
    return {} if mode is not None and mode.number == 0 else {"G05": mode or codes[0]}


TURNED_PLANES = {17: replace_fields(PLANES[17], diameters=(True, False)), 18: LATHE, 19: PLANES[19]}
MODES, TURNED_MODES = _modes(_words(is_diameter=False), PLANES), _modes(_words(is_diameter=True), TURNED_PLANES)


def turned(modes: Modes) -> Modes:
    """The same where X is a diameter."""
    words = replace(TURNED_MODES.lexicon, numbers=modes.lexicon.numbers)
    return replace(modes, lexicon=words, codes=TURNED_MODES.codes)
