"""ISG kernel: how blocks are spelled, addresses, numbers, planes and G codes."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from decimal import Decimal

from contoursolve.controls.further import rows as rows_beside
from contoursolve.controls.plain import BASIC_CODES, MOTIONS, PLANES, code_rows, lexicon
from contoursolve.diagnostics import Book
from contoursolve.execution import COMMENT, isg
from contoursolve.gcode import IN_BRACKETS, Block, Syntax, Word, late_pattern, lines_and_arcs
from contoursolve.geometry import Length, Unit
from contoursolve.reading import (
    COMMENTED,
    TOOL,
    WORK,
    Address,
    Bearing,
    Code,
    Diameter,
    Effect,
    Entry,
    Lexicon,
    Modes,
    NumberFormat,
    WithoutPoint,
    ZeroMove,
    ZeroRow,
    table_of,
)

BOOK = Book("ISG kernel, programming manual")


CENTERS = "G164"
"""The name of what is in force where the control does not move the centre of an arc that disagrees with its ends."""
CHAMFER, ROUNDING = 301, 302
"""G301 and G302: corners in blocks of their own."""

_CODES = BASIC_CODES | {
    Effect.MOTION: MOTIONS | dict.fromkeys((33, 34, 63, 331, 332), "thread"),
    Effect.NO_MOTION: {4: "dwell"},
    Effect.SHIFT: dict.fromkeys((53, *range(54, 60), 159), "zero offset"),
    Effect.SINGLE: {74: "reference point", 100: "measuring", 310: "measuring", 161: "absolute centres"},
    Effect.FRAME: {92: "reference point offset", 68: "rotation", 69: "end of rotation"}
    | {20: "end of mirroring"}
    | dict.fromkeys((*range(21, 25), 351), "mirroring"),
    Effect.NONE: {162: "centres from where an arc begins", 164: "no centre correction", 165: "centre correction"}
    | dict.fromkeys((8, 9, 60, 61, 260, 261, 359, 360, 361), "exact stop or blending")
    | dict.fromkeys((93, 94, 95, 96, 97, 194), "kind of feed or speed")
    | dict.fromkeys((25, 26, 138, 139, 150, 151, 236, 237, 238, 239), "compensation at corners"),
    Effect.CORNER: {CHAMFER: "chamfer", ROUNDING: "rounding"},
}


def _codes() -> dict[int, Code]:
    rows = [*code_rows(BOOK.assumed("list of G functions"), _CODES, PLANES, {70: Length.INCH, 71: Length.MM}).values()]
    rows += [
        Code(51, Effect.NONE, "X is a diameter", BOOK.printed("turning functions"), diameter=Diameter.ON),
        Code(52, Effect.NONE, "X is a radius", BOOK.printed("turning functions"), diameter=Diameter.OFF),
    ]
    return {code.number: code for code in rows}


def _parts(token: re.Match[str]) -> tuple[str, str | None, bool]:
    """The parts of a word: a letter, or `#` and a name."""
    address, number = token["letter"] or token["long"].replace(" ", ""), token["plain"] or token["short"]
    return address.upper(), number, token["wanted"] is not None or token["asked"] is not None


_NUMBER = r"[+-]?+(?>\d++\.?+\d*+|\.\d++)"
_OWN = r"\#[ \t]*+(?:ANG|RND|CHR|CHF|FRC)\b"
_FOREIGN = r"\#[ \t]*+[A-Za-z]\w*+(?=[ \t]*+=[ \t]*+[-+.\d])"
"""A word with a number sign that the control has not."""
_NUMBERED = rf"(?:[SM][ \t]*+{IN_BRACKETS}|G159)(?=[ \t]*+=)"
"""A word of one of several spindles: `S[2]=500`; and a zero offset by its number."""
SYNTAX = Syntax(
    "isg",
    token=re.compile(
        rf"""
    (?P<blank>[ \t\f\v\x02\x03\x11-\x14\x1a\ufeff]++|%.*+)
  | (?P<comment>{COMMENT}|;.*+)
  | (?P<mistyped>\#[ \t]*+(?:ANG|RND|CHR|CHF|FRC)(?:(?=[-+.\d])[-+.,\d]++
      |[ \t]*+=[ \t]*+[+-]?+[\d.]++,[\d.,]*+))
  | (?P<word>
        (?P<long>{_OWN}|{_FOREIGN}|{_NUMBERED})[ \t]*+(?>(?:=[ \t]*+)?)
          (?:(?P<plain>{_NUMBER})(?![\w.+*/\[-])|(?P<wanted>\?)
          |(?P<formula>[^ \t;()]++))
      | (?P<letter>[A-Za-z])(?![A-Za-z_])[ \t]*+(?>(?:=[ \t]*+)?)(?:(?P<short>{_NUMBER})(?![\d.+*/\[-])|(?P<asked>\?)
          |(?P<expression>[+-]?+(?>(?:[A-Z]*+{IN_BRACKETS}|[PV](?>(?:[\w.]++|{IN_BRACKETS})*)|\d[\d.]*+|[+*/-])+))))
  | (?P<name>\#[^;(]*+|\$[A-Za-z]++[^;(]*+|(?>[A-Za-z_]{{2}}[\w.]*+)|[Ll][ \t]++\w[\w.]*+)
  | (?P<malformed>[A-Za-z][ \t]*+[\d.,+-]++)
  | (?P<bare>[A-Za-z])
  | (?P<stray>[^ \tA-Za-z;(]++)
    """,
        re.VERBOSE | re.ASCII | re.IGNORECASE,
    ),
    statement=re.compile(
        r"[ \t/]*+(?>(?:N[ \t]*+\d++)?)[ \t]*+(?:(?P<assignment>P\d++[ \t]*+=|V\.\w"
        r"|\#(?:SET|MSG|HSC|SLOPE|CONTOUR|FLUSH|COMMENT|VAR|ENDVAR)\b)|(?P<flow>\$(?:IF|ELSE|ELSEIF|ENDIF|SWITCH|CASE|DEFAULT|ENDSWITCH|FOR|ENDFOR|WHILE"
        r"|ENDWHILE|DO|ENDDO|GOTO|BREAK|CONTINUE)\b))",
        re.IGNORECASE,
    ),
    comment=re.compile(COMMENT + r"|;.*+"),
    parts=_parts,
    plain=lines_and_arcs("XYZ", "(;", r"(?<=[FXYZIJKR])=?@", "[IJKR]"),
)


NUMBERS = NumberFormat(WithoutPoint.AS_WRITTEN, BOOK.assumed("numbers"))
_ANGLES, _CORNERS = BOOK.printed("contour line programming"), BOOK.printed("chamfers and roundings")


_BESIDE = (
    ("#FRC", "feed of a corner", Bearing.NONE),
    ("G159", "zero offset by its number", Bearing.NONE),
    ("E", "feed at the end of the block", Bearing.NONE),
    ("S H D L", "spindle, function, offset or call", Bearing.NONE),
)


def _words() -> Lexicon:
    plain = lexicon(BOOK.printed("language"), NUMBERS, "XYZ", {}, is_diameter=False)
    rows = (
        Address("#ANG", "angle of the line, from the plane's first axis, counter-clockwise", Unit.DEGREE, _ANGLES),
        Address("#RND", "rounding", Unit.MM, _CORNERS),
        Address("#CHR", "chamfer: the distance of both its ends from the corner", Unit.MM, _CORNERS),
        Address("#CHF", "chamfer: the length of its face", Unit.MM, _CORNERS),
    )
    beside = rows_beside(BOOK.assumed("addresses"), _BESIDE)
    addresses = {**plain.addresses, **{row.address: row for row in rows}}
    stops = BOOK.assumed("a word that is not known stops the control")
    return replace(plain, addresses=addresses, beside=(*plain.beside, *beside), unknown=stops)


def _remember(memory: Mapping[str, Word], block: Block) -> Mapping[str, Word]:
    """The size of the last G301 or G302 stays in force for the next one; an angle, where that is set; and G164."""
    angle, size = block.find("#ANG"), block.find("I")
    is_corner = any(word.address == "G" and word.number in (CHAMFER, ROUNDING) for word in block.words)
    kept = {"I": size} if is_corner and size is not None else {}
    kept |= {"#ANG": angle} if angle is not None else {}
    for word in block.words:
        ends = _CENTRES.get(word.number) if word.address == "G" and word.number is not None else None
        if ends is not None:
            memory = {name: each for name, each in memory.items() if name not in ends}
            kept |= {f"G{word.number}": word} if word.number != FROM_START else {}
    mark = _LINES_OF_COMMENT.match(block.text)
    if mark is not None and mark["begins"]:
        kept[COMMENTED] = Word(COMMENTED, None, False, mark[0].strip(), block.span)
    elif mark is not None:
        memory = {name: word for name, word in memory.items() if name != COMMENTED}
    return {**memory, **kept} if kept else memory


FROM_START = 162
_CENTRES: Mapping[Decimal, tuple[str, ...]] = {
    Decimal(161): ("G161",),
    Decimal(FROM_START): ("G161",),
    Decimal(164): ("G164", "G165"),
    Decimal(165): ("G164", "G165"),
}
"""Codes about centres, which stay in force, and those that each of them ends."""
_LINES_OF_COMMENT = re.compile(r"\s*+#\s*+COMMENT\s++(?:(?P<begins>BEGIN)|END)\b", re.IGNORECASE)


_INITIAL = 53
"""The code without an offset; those behind it select the first ones of the table."""


def _entries_set(name: str) -> Iterator[Entry]:
    """The entries of tables that a variable is. Those of the offset in force hold until it is selected next."""
    found = _OFFSET_DATA.fullmatch(name)
    if found is None:
        return
    axes = (found["axis"],) if found["axis"] else ()
    if found["tool"]:
        yield Entry(TOOL, None, axes, fades=True)
    elif found["index"] is None:
        yield Entry(WORK, None, axes, fades=True)
    elif found["index"].isdigit():
        number = int(found["index"])
        yield Entry(WORK, (("G", _INITIAL + number),), axes, fades=True)
        yield Entry(WORK, (("G159", number),), axes, fades=True)
    else:
        yield Entry(WORK, None, axes, fades=True)


_OFFSET_DATA = re.compile(
    r"V\.G\.(?:NP_AKT|NP[ \t]*+\[[ \t]*+(?P<index>[^\]]*?)[ \t]*+\]|(?P<tool>WZ_AKT))\.(?:V\.(?P<axis>[XYZ])|.*+)"
)
_OFFSETS = BOOK.printed("zero offsets")
_BY_PLANE = {"G17": ("Z",), "G18": ("X", "Y", "Z"), "G19": ("X",)}
"""The axes that the lengths of a tool move: the tool's axis, and on lathes (G18) two."""
_TURNING = late_pattern(
    r"#(?P<name>CS|ACS|ECS|MCS|ROTATION|SCALE|MIRROR|TRAFO)[ \t]+(?:ON|(?P<end>OFF))\b", re.IGNORECASE
)
"""Commands of other coordinate systems."""
_ZERO = replace(
    table_of(
        (
            ZeroRow("G53 G54 G55 G56 G57 G58 G59", ZeroMove.SELECT, _OFFSETS, WORK),
            ZeroRow("G159", ZeroMove.SELECT, _OFFSETS, WORK, words="G159"),
            ZeroRow("G92", ZeroMove.SET, BOOK.printed("reference point offset (G92), 206145291"), adds_increments=True),
            ZeroRow("D", ZeroMove.SELECT, BOOK.printed("tool geometry"), TOOL, _BY_PLANE),
        ),
        {},
        "XYZ",
        first={WORK: (("G", _INITIAL),)},
        variables=_entries_set,
        beside=(
            ZeroRow("V.G.NP, V.G.NP_AKT, V.G.WZ_AKT", ZeroMove.DATA, BOOK.printed("access to the current zero offset")),
        ),
    ),
    commands=_TURNING,
)
"""The moves of the coordinate system: at first, no offset is in force."""


MODES = Modes(
    _words(),
    _codes(),
    ("X", "Y", "Z"),
    frozenset({17, 29}),
    syntax=SYNTAX,
    remember=_remember,
    call_addresses=frozenset("L"),
    separate=frozenset({CHAMFER, ROUNDING}),
    language=isg(),
    zero=_ZERO,
)
