"""CNC PILOT: sections, how blocks are spelled, words, codes, and conventions on which the manuals are silent."""

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from decimal import Decimal
from typing import Any

from contoursolve.controls.control_settings import angle_sense_setting, redundant_angle_setting, setting
from contoursolve.controls.further import letters
from contoursolve.controls.heidenhain.lexicon import SPELLING
from contoursolve.controls.plain import BASIC_CODES, LATHE, MOTIONS
from contoursolve.diagnostics import Book
from contoursolve.gcode import Block, Syntax, Word, plain_spelling
from contoursolve.geometry import Turn, Unit
from contoursolve.reading import (
    COMMENTED,
    TOOL,
    Address,
    Code,
    Control,
    Effect,
    Lexicon,
    Modes,
    NumberFormat,
    WithoutPoint,
    ZeroMove,
    ZeroRow,
    table_of,
)

BOOK = Book("HEIDENHAIN CNC PILOT 4290 manuals, DIN PLUS")
_PRINTED = BOOK.printed("p. 147 to 191: geometry commands")

SHOWS = r"FERTIGTEIL|FINISHED(?:[ \t]+PART)?|HILFSKONTUR|AUXIL(?:IARY[ \t]+|_)CONTOUR|BEARBEITUNG"
"""The sections that no other control has."""
_READ = (
    rf"{SHOWS}|MACHINING|CONTOUR|ROHTEIL|(?:AUXIL_)?BLANK|STIRN\w*|FRONT(?:[ \t]+END)?|FACE_C|RUECKSEITE\w*|MANTEL\w*"
    r"|REAR[ \t]+(?:END|SIDE)|(?:CYLINDER[ \t]+)?SURFACE|LATERAL(?:_C)?"
)
"""Those whose blocks are read; in the others they are data."""
_SECTIONS = (
    rf"{_READ}|PROGRAMMKOPF|PROGRAM[ \t]+HEAD(?:ER)?|REVOLVER|TURRET|SPANNMITTEL|CLAMPING[ \t]+DEVICE|CONST|ENDE?"
    r"|CHUCKING[ \t]+EQUIPMENT|UNTERPROGRAMM|SUBPROGRAM|RETURN"
)
_LATER = {"AN": "A", "BR": "B", "BE": "E"}
"""Words as later controls write them."""


def _parts(token: re.Match[str]) -> tuple[str, str | None, bool]:
    address = token["letters"].upper() if token["section"] is None else "O"
    return _LATER.get(address, address), token["number"], token["asked"] is not None


_SPELLING = replace(SPELLING, names={})
SYNTAX = Syntax(
    "din plus",
    token=re.compile(
        r"(?P<blank>(?>[ \t\f\v\x1a\ufeff]++|\$\d++)+)|(?P<comment>\[(?>(?:[^\[\]]++|\[[^\]]*+\])*)\])|(?P<open>\[.*+)"
        rf"|(?P<word>(?P<section>(?<![^ \t])(?:{_SECTIONS})(?!\w)[^\[]*+)|(?P<letters>[A-Z]{{1,3}}?)[ \t]*+"
        r"(?:(?P<number>[+-]?+(?>\d++\.?+\d*+|\.\d++))(?![\d.,])|(?P<asked>\?)|[+-]?+(?:[#V]\d++|\{[^ \t\[]*+)))"
        r"|(?P<malformed>[A-Z]{1,3}[ \t]*+[\d.,+-]++)|(?P<bare>[A-Z]++)|(?P<stray>.)",
        re.ASCII | re.IGNORECASE,
    ),
    statement=re.compile(r"[ \t/]*+(?:(?P<assignment>\#|V\d++[ \t]*+=)|(?P<flow>(?!)))", re.IGNORECASE),
    comment=re.compile(r"\[(?>(?:[^\[\]]++|\[[^\]]*+(?:\]|$))*)\]?+"),
    remark="[{}]",
    words=_SPELLING,
    parts=_parts,
    plain=plain_spelling("(?!)", "["),
)

TURNS = {2: Turn.CW, 3: Turn.CCW, 12: Turn.CW, 13: Turn.CCW}
"""Arcs; the last two have their centre in coordinates."""
_OVERSIZE = 52
_CODES: Mapping[Effect, Mapping[int, str]] = {
    Effect.MOTION: MOTIONS | {12: "arc clockwise, its centre absolute", 13: "the same counter-clockwise"},
    Effect.COMPENSATION: BASIC_CODES[Effect.COMPENSATION],
    Effect.NONE: dict.fromkeys((7, 8, 9), "precision stop")
    | dict.fromkeys((10, 38, 39, _OVERSIZE, 95, 149), "attribute of an element"),
    Effect.NO_MOTION: dict.fromkeys((20, 21), "blank"),
    Effect.SINGLE: dict.fromkeys(range(100, 104), "contour on the face")
    | dict.fromkeys(range(110, 114), "contour on the lateral surface")
    | dict.fromkeys(range(170, 174), "contour in the plane of X and Y"),
}  # fmt: skip

_MM, _CENTER = Unit.MM, "centre of the arc: in G2 and G3 from its start, in G12 and G13 a coordinate"
_WORDS = (
    Address("X", "coordinate", _MM, _PRINTED, "X", is_diameter=True, is_absolute=True),
    Address("Z", "coordinate", _MM, _PRINTED, "Z", is_absolute=True),
    Address("XI", "increment", _MM, BOOK.derived("a printed program"), "X", is_increment=True, is_diameter=True),
    Address("ZI", "increment", _MM, _PRINTED, "Z", is_increment=True),
    Address("A", "direction of the line, from minus Z towards plus X", Unit.DEGREE,
            BOOK.derived("p. 148: the other sense would lead back"), clockwise_from=Decimal(180)),
    Address("I", f"{_CENTER}; along X, a radius", _MM, _PRINTED),
    Address("K", f"{_CENTER}; along Z", _MM, _PRINTED),
    Address("R", "radius of an arc of at most 180 deg", _MM, _PRINTED),
    Address("B", "after it, above 0 a rounding, below 0 a chamfer, 0 a corner without tangency", _MM, _PRINTED),
    Address("E", "share of the feed in the corner", Unit.SIGN, _PRINTED),
    Address("Q", "0 the near intersection, 1 the far one", Unit.SIGN, _PRINTED),
)  # fmt: skip
_LEXICON = Lexicon(
    {row.address: row for row in _WORDS},
    NumberFormat(WithoutPoint.AS_WRITTEN, BOOK.derived("the printed programs")),
    letters(BOOK.assumed("addresses")),
    BOOK.assumed("a word that is not known stops the control"),
    _SPELLING,
)


def _remember(memory: Mapping[str, Word], block: Block) -> Mapping[str, Word]:
    """A section whose blocks are data lasts until the next one begins."""
    section = block.find("O")
    if section is None:
        return memory
    is_read = re.match(rf"(?:{_READ})(?!\w)", section.text, re.IGNORECASE)
    return {} if is_read else {COMMENTED: Word(COMMENTED, None, False, section.text.strip(), section.span)}


def _code(number: int, effect: Effect, meaning: str) -> Code:
    source = BOOK.assumed("codes") if effect is Effect.COMPENSATION else _PRINTED
    return Code(number, effect, meaning, source, is_read=effect is not Effect.SINGLE and number != _OVERSIZE)


MODES = Modes(
    _LEXICON,
    {number: _code(number, effect, meaning) for effect, rows in _CODES.items() for number, meaning in rows.items()},
    LATHE.axes,
    frozenset(),
    syntax=SYNTAX,
    remember=_remember,
    zero=table_of((ZeroRow("T", ZeroMove.OTHER, BOOK.assumed("tools"), TOOL),), {}),
)


def _with(address: str, **fields: Any) -> Callable[[Control], Control]:
    """The change of a control in which a word has these other fields."""

    def change(control: Control) -> Control:
        words = control.modes.lexicon
        rows = {**words.addresses, address: replace(words.addresses[address], **fields)}
        return replace(control, modes=replace(control.modes, lexicon=replace(words, addresses=rows)))

    return change


_ZERO = setting(
    "angle-zero", "from where A counts",
    {"minus_z": "from minus Z, towards plus X", "plus_z": "from plus Z, towards plus X"},
    BOOK.derived("p. 148: the printed program with A30"),
    {"plus_z": _with("A", meaning="direction of the line, from plus Z towards plus X", clockwise_from=None)},
)  # fmt: skip
_I = setting(
    "i", "what I is", {"radius": "a radius", "diameter": "a diameter, as on the MANUALplus 4110"},
    BOOK.printed("p. 148"), {"diameter": _with("I", is_diameter=True)},
)  # fmt: skip
SENSE = angle_sense_setting(BOOK.assumed("A is the angle of a line"))
EXTRA = redundant_angle_setting(BOOK.assumed("not described"), "check")
MODAL = setting("modal-g", "whether G1 to G3, G12 and G13 stay in force", {"off": "no", "on": "yes"},
                BOOK.assumed("each printed block has its own"))  # fmt: skip
MISSING = setting("b-missing", "where an element without B touches the next one",
                  {"when_needed": "where it would be open otherwise", "always": "everywhere"},
                  BOOK.derived("square corners without B are printed"))  # fmt: skip
WIDTH = setting("chamfer", "what the size of a chamfer is",
                {"leg": "the distance of both its ends from the corner", "face": "the length of its face"},
                BOOK.assumed("chamfer width"))  # fmt: skip
ARC_Q = setting("arc-q", "which intersection at the end of an arc Q0 is",
                {"zero_near": "the near one", "zero_far": "the far one, as in the pocket guide"},
                BOOK.printed("p. 148 and 190; the pocket guide contradicts"))  # fmt: skip
SETTINGS = (_ZERO, _I, SENSE, EXTRA, MODAL, MISSING, WIDTH, ARC_Q)
