"""SINUMERIK: how blocks are spelled, addresses, numbers, planes, G codes and commands with a name."""

import re
from collections.abc import Mapping
from functools import cache

from msgspec import structs

from contoursolve.controls.plain import BASIC_CODES, MOTIONS, PLANES, code_rows, lexicon
from contoursolve.diagnostics.source import Book
from contoursolve.execution.language import MacroLanguage
from contoursolve.execution.sinumerik import sinumerik
from contoursolve.gcode import Block, Syntax, Word, long_parts
from contoursolve.gcode.syntax import IN_BRACKETS, IN_PARENTHESES
from contoursolve.geometry import Length, Unit
from contoursolve.reading import Address, Code, Diameter, Effect, Lexicon, Modes, NumberFormat, WithoutPoint

BOOK = Book("SINUMERIK NC programming manual")


TANGENT_ARC = 1001
"""Stands for CT among the motions."""

_CODES = BASIC_CODES | {
    Effect.MOTION: MOTIONS | dict.fromkeys((33, 34, 35, 331, 332), "thread"),
    Effect.NO_MOTION: {4: "dwell", 25: "lower limit", 26: "upper limit"},
    Effect.SHIFT: dict.fromkeys((*range(54, 60), 500, *range(505, 600)), "work offset"),
    Effect.SINGLE: {53: "no offset", 153: "no offset", 74: "reference point", 75: "fixed point", 63: "tapping"}
    | dict.fromkeys((147, 148, 247, 248, 340, 341, 347, 348), "soft approach or retraction"),
    Effect.FRAME: dict.fromkeys((110, 111, 112), "pole of polar coordinates"),
    Effect.NONE: dict.fromkeys((9, 60, 601, 602, 603), "exact stop")
    | dict.fromkeys((64, *range(641, 646)), "continuous path")
    | dict.fromkeys((93, 94, 95, 96, 97), "kind of feed or speed")
    | dict.fromkeys((450, 451, 460, 461, 462), "corners of the compensated path"),
}
_UNITS = {70: Length.INCH, 71: Length.MM, 700: Length.INCH, 710: Length.MM}
_NAMES: tuple[tuple[Effect, str, str], ...] = (
    (Effect.FRAME, "coordinate frame", "TRANS ATRANS ROT AROT SCALE ASCALE MIRROR AMIRROR ROTS AROTS TRAFOOF"),
    (Effect.SINGLE, "no offset", "SUPA"),
    (Effect.NONE, "nothing about the path", "MSG SETMS STOPRE BRISK SOFT DRIVE NORM KONT KONTC KONTT FFWON FFWOF"),
    (Effect.NONE, "nothing about the path", "COMPOF CFC CFTCP CFIN SBLON SBLOF DISPLOF SAVE WALIMON WALIMOF DIAMCHANA"),
    (Effect.NONE, "nothing about the path", "OFFN LIMS SETAL TC G291 G290 WORKPIECE ADIS ADISPOS SPCON SPCOF"),
)  # fmt: skip
_DIAMETERS = {
    "DIAMOF": (Diameter.OFF, "X is a radius"),
    "DIAMON": (Diameter.ON, "X is a diameter"),
    "DIAM90": (Diameter.ABSOLUTE, "X is a diameter in absolute coordinates, a radius in increments"),
}


def _codes() -> dict[int, Code]:
    rows = [*code_rows(BOOK.assumed("list of G functions"), _CODES, PLANES, _UNITS).values()]
    rows.append(Code(TANGENT_ARC, Effect.MOTION, "arc that begins tangentially", BOOK.printed("p. 201"), name="CT"))
    number = TANGENT_ARC
    for name, (diameter, meaning) in _DIAMETERS.items():
        number += 1
        rows.append(Code(number, Effect.NONE, meaning, BOOK.assumed("diameters"), diameter=diameter, name=name))
    for effect, meaning, names in _NAMES:
        for name in names.split():
            number += 1
            rows.append(Code(number, effect, meaning, BOOK.assumed("commands"), name=name))
    return {code.number: code for code in rows}


CODES = _codes()

_NUMBER = r"[+-]?+(?>\d++(?>[.,]\d*+)?|[.,]\d++)"
_OWN = "ANG|RNDM?|CHR|CHF|CR"
SYNTAX = Syntax(
    "sinumerik",
    token=re.compile(
        rf"""
    (?P<blank>[ \t\f\v\x02\x03\x11-\x14\x1a\ufeff]++|%.*+|[A-Za-z_]\w++:(?!=)|:\d++)
  | (?P<comment>;.*+)
  | (?P<mistyped>(?:[A-Za-z_]\w*+[ \t]*+=|[A-Za-z](?![A-Za-z_]))[ \t]*+
      [+-]?+[\d.,]++(?-i:[Ool|][\d.,Ool|]*+)(?![\w(\[=]))
  | (?P<word>(?P<comma>)(?:
        (?>(?P<long>\$?[A-Za-z_]\w*+(?>(?:{IN_BRACKETS})?))[ \t]*+=[ \t]*+)(?:
            (?P<function>[AaIi][Cc])[ \t]*+\([ \t]*+(?:(?P<inner>{_NUMBER})|(?P<unset>\?))[ \t]*+\)
          | (?P<plain>{_NUMBER})(?![\w.,+*/\-\[(])|(?P<wanted>\?)
          | (?![\d.,+-]++(?:[\s;]|$))(?P<formula>(?>(?:[^\s;()\[\]\"]++|{IN_PARENTHESES}|{IN_BRACKETS}|\"[^\"]*+\")+)))
      | (?P<letter>[A-Za-z])(?![A-Za-z_])[ \t]*+(?:(?P<short>{_NUMBER})(?![\d.,])|(?P<asked>\?))))
  | (?P<malformed>(?:(?:{_OWN})[ \t]*+(?>(?:=[ \t]*+)?)|[A-Za-z][ \t]*+)(?=[\d.,+-])[\d.,+-]++)
  | (?P<name>(?>[A-Za-z_]{{2}}\w*+))[ \t]*+(?>(?:{IN_PARENTHESES})?)
  | (?P<bare>[A-Za-z])
  | (?P<stray>\"[^\"]*+\"?+|[^ \tA-Za-z;]++)
    """,
        re.VERBOSE | re.ASCII | re.IGNORECASE,
    ),
    statement=re.compile(
        r"[ \t/]*+(?>(?:[Nn]\d++)?)[ \t]*+(?>(?:[A-Za-z_]\w++:)?)[ \t]*+(?:"
        r"(?P<assignment>DEF|EXTERN|PROC|REDEF|DEFINE)"
        r"|(?P<flow>IF|ELSE|ENDIF|FOR|ENDFOR|WHILE|ENDWHILE|LOOP|ENDLOOP|REPEATB?|UNTIL|GOTO[BFCS]?|CASE|P?CALL|MCALL|RET))\b",
        re.IGNORECASE,
    ),
    comment=re.compile(r";.*+"),
    remark=";{}",
    codes={code.name: code.number for code in CODES.values() if code.name},
    parts=long_parts,
)

NUMBERS = NumberFormat(WithoutPoint.AS_WRITTEN, BOOK.assumed("numbers"))
_CORNER, _PLACE = BOOK.printed("p. 220"), BOOK.printed("p. 201")
ANGLE = "angle of the line, from the plane's first axis, counter-clockwise"


def _words() -> Lexicon:
    plain = lexicon(BOOK.assumed("addresses"), NUMBERS, "XYZ", {}, is_diameter=False)
    rows = [
        Address("ANG", ANGLE, Unit.DEGREE, BOOK.printed("p. 214")),
        Address("RND", "rounding", Unit.MM, _CORNER),
        Address("CHR", "chamfer: the distance of both its ends from the corner", Unit.MM, _CORNER),
        Address("CHF", "chamfer: the length of its face", Unit.MM, _CORNER),
        Address("RNDM", "rounding of every corner from here on; 0 ends it", Unit.MM, BOOK.assumed("as users quote it")),
        Address("CR", "radius; negative for an arc of more than 180 deg", Unit.MM, BOOK.assumed("addresses")),
    ]
    for axis in "XYZ":
        rows.append(
            Address(f"{axis}=AC", "coordinate, whatever G90 and G91 say", Unit.MM, _PLACE, axis, is_absolute=True)
        )
        rows.append(Address(f"{axis}=IC", "increment, whatever G90 and G91 say", Unit.MM, _PLACE, axis, True))
    kept = {name: row for name, row in plain.addresses.items() if name != "R"}
    return Lexicon({**kept, **{row.address: row for row in rows}}, NUMBERS)


def _remember(memory: Mapping[str, Word], block: Block) -> Mapping[str, Word]:
    """RNDM stays in force until it is 0."""
    word = block.find("RNDM")
    if word is None:
        return memory
    return {} if word.number == 0 else {"RNDM": word}


_ENDS, _LEXICON, _BESIDE = frozenset({17}), _words(), frozenset({"RNDM", "FRC", "FRCM", "LIMS"})


@cache
def statements() -> MacroLanguage:
    """Variables, jumps and calls: a name that is no word and no command calls a subprogram."""
    return structs.replace(sinumerik([*SYNTAX.codes, *_LEXICON.addresses, *_BESIDE]), declares=True, made_by=statements)


MODES = Modes(
    _LEXICON,
    CODES,
    ("X", "Y", "Z"),
    _ENDS,
    syntax=SYNTAX,
    radius="CR",
    remember=_remember,
    call_addresses=frozenset("L"),
    moving=re.compile(r"AP|RP|AR|POS[AP]?\[[XYZ]\w*\]|[XYZIJK]\d+(=\w+)?"),
    lasting={"RNDM": "RNDM=0"},
    beside=_BESIDE,
    language=statements(),
)
