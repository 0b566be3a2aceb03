"""SINUMERIK: how blocks are spelled, addresses, numbers, planes, G codes and commands with a name."""

import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cache, partial

from msgspec import structs

from contoursolve.controls.further import rows as rows_beside
from contoursolve.controls.plain import BASIC_CODES, MOTIONS, PLANES, code_rows, coming_back, lexicon
from contoursolve.diagnostics import Book
from contoursolve.execution import MOVES_BESIDE, SYNCHRONOUS, MacroLanguage, sinumerik
from contoursolve.gcode import IN_BRACKETS, IN_PARENTHESES, Block, Syntax, Word, lines_and_arcs, long_parts
from contoursolve.geometry import Length, Unit
from contoursolve.reading import (
    TOOL,
    WORK,
    Address,
    Bearing,
    Code,
    Diameter,
    Effect,
    Lexicon,
    Modes,
    NumberFormat,
    WithoutPoint,
    ZeroMove,
    ZeroRow,
    ZeroTable,
    table_of,
)

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
    | dict.fromkeys((93, 94, 95, 96, 97, 931, 942, 952, 961, 962, 971, 972, 973), "kind of feed or speed")
    | dict.fromkeys((62, 621), "slower at corners")
    | dict.fromkeys((140, 141, 142, 143), "way of approach")
    | {290: "language of SINUMERIK"}
    | dict.fromkeys((450, 451, 460, 461, 462), "corners of the compensated path"),
}
_UNITS = {70: Length.INCH, 71: Length.MM, 700: Length.INCH, 710: Length.MM}
_UNREAD: tuple[tuple[Effect, Mapping[str, tuple[str, ...]]], ...] = (
    (Effect.MOTION, {
        "arc through a point": ("CIP",),
        "involute": ("INVCW INVCCW",),
        "spline or polynomial": ("ASPLINE BSPLINE CSPLINE POLY",),
    }),
    (Effect.FRAME, {
        "another surface": ("TRANSMIT TRACYL TRAANG TRAORI TRACON",),
        "tilted plane": ("CYCLE800 PAROT PAROTOF TOROT TOROTX TOROTY TOROTZ TOROTOF TOFRAME",),
    }),
)  # fmt: skip
"""Commands by name that change the path or the coordinates in a way that contoursolve does not follow."""
_NAMES: tuple[tuple[Effect, Mapping[str, tuple[str, ...]]], ...] = (
    (Effect.FRAME, {
        "coordinate frame": (
            "TRANS ATRANS ROT AROT SCALE ASCALE MIRROR AMIRROR ROTS AROTS PRESETON PRESETONS",
        ),
        "end of another surface": ("TRAFOOF",),
    }),
    (Effect.SINGLE, {
        "no offset": ("SUPA",),
    }),
    (Effect.NONE, {
        "speeds up and slows down": (
            "BRISK BRISKA SOFT SOFTA DRIVE DRIVEA JERKLIM JERKLIMA FFWON FFWOF DYNNORM DYNPOS DYNROUGH",
            "DYNSEMIFIN DYNFINISH DYNPREC CYCLE832 COMPON COMPCURV COMPCAD COMPSURF COMPPATH COMPOF FIFOCTRL",
            "STARTFIFO STOPFIFO PREPRO",
        ),
        "feed": ("CFC CFTCP CFIN FNORM FLIN FCUB FPO FPRAON FPRAOF FGROUP",),
        "spindle": (
            "SETMS SCC SPCON SPCOF SPI SPN SPOSON DIAMCHANA COUPDEF COUPDEL COUPON COUPONC COUPOF COUPOFS",
            "COUPRES",
        ),
        "channels and axes": (
            "WAITM WAITMC WAITE WAITP WAITS WAITENC SETM CLEARM START INIT GET GETD RELEASE AXTOCHAN TANG",
            "TANGON TANGOF TANGDEL TLIFT TRAILON TRAILOF LEADON LEADOF CTABDEF CTABEND EGDEF EGON EGONSYN",
            "EGONSYNE EGOFS EGOFC EGDEL CPDEF CPDEL CPON CPOF MASLON MASLOF MASLOFS MASLDEF MASLDEL AXSTRING",
            "BFREE",
        ),
        "tool": (
            "CUT2D CUT2DF CUT3DC CUT3DF CUT3DFS CUT3DFF CUTCONON CUTCONOF CUTMOD NORM KONT KONTC KONTT CDON",
            "CDOF CDOF2 GETSELT GETEXET SETPIECE DELT NEWT TCA TCI TMMVTL GETT SETDNO GETDNO CHKDNO DELTC",
            "DZERO DELDL DELTOOLENV TOOLENV",
        ),
        "tells or stores": (
            "MSG SETAL WRITE READ DELETE ISFILE WORKPIECE GROUP_BEGIN GROUP_END GROUP_ADDEND DISPLOF DISPLON",
            "ACTBLOCNO SBLON SBLOF SAVE STOPRE STOPREOF ICYCOF ICYCON MMC EXTOPEN EXTCLOSE EXTWRITE PROT",
            "NPROT NPROTDEF PRLOC BLSYNC CONTPRON CONTDCON EXECTAB EXECUTE",
        ),
        "watches": (
            "WALIMON WALIMOF CPRECON CPRECOF CANCEL LOCK UNLOCK ENABLE DISABLE SETINT CLRINT DELDTG LIFTFAST",
            "LFON LFOF LFWP LFTXT LFPOS WHEN WHENEVER FROM EVERY DO RDISABLE POLFMASK POLFMLIN RTLION RTLIOF",
            "COARSEA IPOENDA FINEA",
        ),
        "orientation of the tool": (
            "ORIWKS ORIMKS ORIAXES ORIVECT ORIPLANE ORICONCW ORICONCCW ORICONIO ORICURVE ORIEULER ORIRPY",
            "ORIRPY2 ORIVIRT1 ORIVIRT2 ORIC ORID ORISON ORISOF OSOF OSC OSS OSSE OSD OST ORIPATH ORIPATHS",
            "ORIROTA ORIROTR ORIROTT ORIROTC",
        ),
        "nothing about the path": (
            "MCALL UPATH SPATH CP PTP PTPG0 ADISPOS ADIS OFFN LIMS BLKSKIP TOWSTD TOWMCS TOWWCS TOWTCS TOWBCS",
            "TOWKCS",
        ),
    }),
)  # fmt: skip
"""Predefined commands and subprograms by name."""
_DIAMETERS = {
    "DIAMOF": (Diameter.OFF, "X is a radius"),
    "DIAMON": (Diameter.ON, "X is a diameter"),
    "DIAM90": (Diameter.ABSOLUTE, "X is a diameter in absolute coordinates, a radius in increments"),
}


_GROUPS = (
    "G60 G64 G641 G642 G643 G644 G645",
    "G601 G602 G603",
    "G93 G94 G95 G96 G97 G931 G942 G952 G961 G962 G971 G972 G973",
    "G62 G621 FENDNORM",
    "G140 G141 G142 G143",
    "G450 G451",
    "G460 G461 G462",
    "BRISK SOFT DRIVE",
    "FFWON FFWOF",
    "DYNNORM DYNPOS DYNROUGH DYNSEMIFIN DYNFINISH DYNPREC",
    "COMPON COMPCURV COMPCAD COMPSURF COMPOF",
    "CFC CFTCP CFIN",
    "FNORM FLIN FCUB",
    "NORM KONT KONTC KONTT",
    "CDON CDOF CDOF2",
    "CUT2D CUT2DF CUT3DC CUT3DF CUT3DFS CUT3DFF",
    "CUTCONON CUTCONOF",
    "WALIMON WALIMOF",
    "UPATH SPATH",
    "CP PTP PTPG0",
)
"""G functions of which each takes the place of another one of its group, as the manual lists them; recalled."""


def _codes() -> dict[int, Code]:
    rows = [*code_rows(BOOK.assumed("list of G functions"), _CODES, PLANES, _UNITS).values()]
    rows.append(Code(TANGENT_ARC, Effect.MOTION, "arc that begins tangentially", BOOK.printed("p. 201"), name="CT"))
    number = TANGENT_ARC
    for name, (diameter, meaning) in _DIAMETERS.items():
        number += 1
        rows.append(Code(number, Effect.NONE, meaning, BOOK.assumed("diameters"), diameter=diameter, name=name))
    for is_read, table in ((True, _NAMES), (False, _UNREAD)):
        named = ((effect, *row) for effect, rows_of in table for row in rows_of.items())
        for effect, meaning, names in named:
            for name in " ".join(names).split():
                number += 1
                source = BOOK.assumed("commands and predefined subprograms")
                row = Code(number, effect, meaning, source, name=name, is_read=is_read)
                rows.append(coming_back(row))
    groups = {name: group for group in _GROUPS for name in group.split()}
    return {code.number: replace(code, group=groups.get(code.text, "")) for code in rows}


CODES = _codes()
_OFFSETS, _LENGTHS, _SELECTS = BOOK.assumed("frames and offsets"), BOOK.assumed("lengths of tools"), ZeroMove.SELECT
_BY_PLANE = {"G17": ("Z",), "G18": ("X", "Y", "Z"), "G19": ("X",)}
"""The axes that the lengths of a tool move: the tool's axis, and on lathes (G18) two."""
_FRAMES = "$P_IFRAME $P_BFRAME $P_ACTBFRAME $P_CHBFRAME $P_NCBFRAME $P_ACTFRAME $P_SETFRAME $P_EXTFRAME"
_SYSTEM_FRAMES = "$P_PARTFRAME $P_TOOLFRAME $P_WPFRAME $P_CYCFRAME $P_TRAFRAME"
_TOOL_DATA = " ".join(f"$TC_DP{number}" for number in (3, 4, 5, 12, 13, 14, 21, 22, 23))
"""The lengths of a tool, their wear and their base."""
_ZERO_ROWS = (
    ZeroRow(" ".join(f"G{code}" for code in (54, 55, 56, 57, 500, *range(505, 600))), _SELECTS,
            BOOK.printed("fundamentals 11/2006 p. 100"), WORK),
    ZeroRow("T", _SELECTS, _LENGTHS, TOOL, _BY_PLANE, words="D"),
    ZeroRow("D", _SELECTS, _LENGTHS, TOOL, _BY_PLANE, words="D", goes_on=True),
    ZeroRow("M6 DL TOFFL TOFFLR", ZeroMove.OTHER, _LENGTHS, TOOL, _BY_PLANE),
    ZeroRow("TOFF TCARR", ZeroMove.OTHER, _LENGTHS, TOOL),
    ZeroRow(_TOOL_DATA, ZeroMove.OTHER, _LENGTHS, TOOL, _BY_PLANE),
    ZeroRow("TRANS", ZeroMove.REPLACE, BOOK.printed("NC programming 12/2019 p. 315")),
    ZeroRow("ATRANS", ZeroMove.ADD, BOOK.printed("NC programming 12/2019 p. 315")),
    ZeroRow("ROT SCALE MIRROR ROTS", ZeroMove.TURN, _OFFSETS),
    ZeroRow("AROT ASCALE AMIRROR AROTS", ZeroMove.TURN_FURTHER, _OFFSETS),
    ZeroRow("$P_PFRAME", ZeroMove.FORMULA, BOOK.printed("NC programming 12/2019 p. 315: CTRANS")),
    ZeroRow(_FRAMES, ZeroMove.OTHER, _OFFSETS, WORK),
    ZeroRow(_SYSTEM_FRAMES, ZeroMove.OTHER, BOOK.assumed("system frames"), WORK),
    ZeroRow("$P_UIFR $P_UBFR $P_CHBFR $P_NCBFR $P_SETFR $P_EXTFR", ZeroMove.LATER, _OFFSETS, WORK),
)  # fmt: skip
"""The moves of the coordinate system of every SINUMERIK."""
_AXIAL = (
    ZeroRow("G58", ZeroMove.SET, BOOK.printed("fundamentals 11/2006 p. 238")),
    ZeroRow("G59", ZeroMove.FINE, BOOK.printed("fundamentals 11/2006 p. 238")),
)
"""Shifts of single axes, without motion; of smaller controls they are work offsets."""
_WORK_58_59 = (ZeroRow("G58 G59", _SELECTS, _OFFSETS, WORK),)


def _zero(*more: ZeroRow) -> ZeroTable:
    return table_of((*_ZERO_ROWS, *more), {code.name: code.number for code in CODES.values() if code.name}, "XYZ")


_NUMBER = r"[+-]?+(?>\d++\.?+\d*+|\.\d++)"
_OWN = "ANG|RNDM?|CHR|CHF|CR"
_WAYS = "[DR]?[AI]C"
"""The way one word counts: absolute or as an increment; of X, also as a diameter or as a radius."""
# What stands before an equals sign is one name up to the blank before it.
_PLACES = r"(?<=[FXYZIJK])@|(?<=[XYZ])(?<!\S[XYZ])=(?>@|AC\(@\))|(?<=CR)=@"
SYNTAX = Syntax(
    "sinumerik",
    token=re.compile(
        rf"""
    (?P<blank>\A[ \t\ufeff]*+\{{.*+|[ \t\f\v\x02\x03\x11-\x14\x1a\ufeff]++|%.*+|[A-Za-z_]\w++:(?!=)|:\d++)
  | (?P<comment>;.*+)
  | (?P<mistyped>(?:[A-Za-z_]\w*+[ \t]*+=|[A-Za-z](?![A-Za-z_]))[ \t]*+
      [+-]?+[\d.,]++(?-i:[Ool|][\d.,Ool|]*+)(?![\w(\[=]))
  | (?P<word>(?P<comma>)(?:
        (?>(?P<long>\$?[A-Za-z_]\w*+(?>(?:{IN_BRACKETS})?))[ \t]*+=[ \t]*+)(?:
            (?P<function>{_WAYS})[ \t]*+\([ \t]*+(?:(?P<inner>{_NUMBER})|(?P<unset>\?))[ \t]*+\)
          | (?P<plain>{_NUMBER})(?![\w.,+*/\-\[(])|(?P<wanted>\?)
          | (?![\d.,+-]++(?:[\s;]|$)|{_WAYS}[ \t]*+\([\d.,+-]++\))
            (?P<formula>(?>(?:[^\s;()\[\]\"]++|{IN_PARENTHESES}|{IN_BRACKETS}|\"[^\"]*+\")+)))
      | (?P<letter>[A-Za-z])(?![A-Za-z_])[ \t]*+(?:(?P<short>{_NUMBER})(?![\d.,])|(?P<asked>\?))))
  | (?P<malformed>(?:(?:{_OWN})[ \t]*+(?>(?:=[ \t]*+)?)|[A-Za-z_]\w*+[ \t]*+=[ \t]*+|[A-Za-z][ \t]*+)
      (?=[\d.,+-])[\d.,+-]++
     |[A-Za-z_]\w*+[ \t]*+=[ \t]*+{_WAYS}[ \t]*+\([\d.,+-]++\))
  | (?P<name>(?>[A-Za-z_]{{2}}\w*+))[ \t]*+(?>(?:{IN_PARENTHESES}|{IN_BRACKETS})?)
  | (?P<bare>[A-Za-z])
  | (?P<stray>\"[^\"]*+\"?+|[^ \tA-Za-z;]++)
    """,
        re.VERBOSE | re.ASCII | re.IGNORECASE,
    ),
    statement=re.compile(
        r"[ \t/]*+(?>(?:[Nn]\d++)?)[ \t]*+(?>(?:[A-Za-z_]\w++:)?)[ \t]*+(?:"
        rf"(?P<assignment>DEF|EXTERN|PROC|REDEF|DEFINE|{SYNCHRONOUS}(?!{MOVES_BESIDE}))"
        r"|(?P<flow>IF|ELSE|ENDIF|FOR|ENDFOR|WHILE|ENDWHILE|LOOP|ENDLOOP|REPEATB?|UNTIL|GOTO[BFCS]?|CASE|P?CALL|RET"
        r"|IDS?(?=[ \t]*=)|WHEN|WHENEVER|FROM|EVERY|DO))\b",
        re.IGNORECASE,
    ),
    comment=re.compile(r";.*+"),
    remark=";{}",
    codes={code.name: code.number for code in CODES.values() if code.name},
    parts=long_parts,
    plain=lines_and_arcs("XYZ", ";", _PLACES, r"[IJK]|(?<!\S)CR"),
)

NUMBERS = NumberFormat(WithoutPoint.AS_WRITTEN, BOOK.assumed("numbers"))
_CORNER, _PLACE = BOOK.printed("p. 220"), BOOK.printed("p. 201")
ANGLE = "angle of the line, from the plane's first axis, counter-clockwise"


_POSITIONED = " ".join(
    f"{word}[{axis}]" for word in ("POS", "POSA", "POSP") for axis in ("X", "Y", "Z", "X1", "Y1", "Z1")
)
_WORDS = (
    ("N", "number of a block", Bearing.NONE),
    ("F FB FL FA FD FDA FZ FAD FMA FGREF FLIM FPR FRC FRCM OVR OVRA OVRRAP", "feed", Bearing.NONE),
    ("ACC VELOLIM VELOLIMA ACCLIMA", "limit of an axis", Bearing.NONE),
    ("S SPOS SPOSA LIMS SVC SCC SETMS SF M3 M4 M5", "spindle", Bearing.NONE),
    ("T D DL H M TCARR TOFFL TOFF TOFFR ISD OFFN DISC DISCL DISR DISRP ALF", "tool, offset or function", Bearing.NONE),
    ("ADIS ADISPOS CTOL OTOL ATOL STOLF CTOLF", "rounding of the path that the control does by itself", Bearing.NONE),
    ("RPL CRPL ID IDS", "rotation or synchronous action", Bearing.NONE),
    ("FXS FXST FXSW FOC FOCON OS OSP1 OSP2 OSB OST1 OST2 OSCTRL OSNSC OSE CPL POLF", "axis on its own", Bearing.NONE),
    ("LEAD TILT THETA ORIRESET", "direction of the tool", Bearing.NONE),
    ("P", "argument of a call", Bearing.ARGUMENT),
    ("A B C E O Q U V W POS POSA POSP", "further axis", Bearing.AXIS),
    ("I J K TURN MEAS MEAW PL PW SD DITS DITE", "part of the path", Bearing.UNREAD),
    (f"AP AR RP PO AX X Y Z {_POSITIONED}", "end of the block", Bearing.END),
)  # fmt: skip
"""The words beside contours, by the names of all of which there are some with a number or an index behind."""
_MACHINES = (("DRESS", "word of a machine builder", Bearing.NONE),)


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
    own = BOOK.assumed("words of a diameter or a radius: recalled")
    for letter, counts in (("D", "diameter"), ("R", "radius")):
        for way, meaning in (("AC", "coordinate"), ("IC", "increment")):
            row = Address(f"X={letter}{way}", f"{meaning} as a {counts}", Unit.MM, own, "X", way == "IC", letter == "D")
            rows.append(replace(row, is_absolute=way == "AC", keeps_diameter=True))
    kept = {name: row for name, row in plain.addresses.items() if name != "R"}
    source = BOOK.assumed("addresses")
    return Lexicon(
        {**kept, **{row.address: row for row in rows}},
        NUMBERS,
        rows_beside(source, (*_WORDS, *_MACHINES)),
        BOOK.assumed("a name that is not defined stops the control"),
    )


def _remember(memory: Mapping[str, Word], block: Block) -> Mapping[str, Word]:
    """RNDM stays in force until it is 0."""
    word = block.find("RNDM")
    if word is None:
        return memory
    return {} if word.number == 0 else {"RNDM": word}


_ENDS, _LEXICON = frozenset({17}), _words()


@cache
def statements(more: tuple[str, ...] = (), *, shows_main: bool = True) -> MacroLanguage:
    """Variables, jumps and calls: a name that is no word and no command calls a subprogram; `more` are further ones of
    the machine builder. Subprograms may know what the main program defines."""
    names = [*SYNTAX.codes, *_LEXICON.plain_names(), *more]
    made_by, with_names = (partial(each, shows_main=shows_main) for each in (partial(statements, more), statements))
    language = structs.replace(sinumerik(names), declares=True, shows_main=shows_main)
    return structs.replace(language, made_by=made_by, with_names=with_names)


MODES = Modes(
    _LEXICON,
    CODES,
    ("X", "Y", "Z"),
    _ENDS,
    syntax=SYNTAX,
    radius="CR",
    remember=_remember,
    call_addresses=frozenset("L"),
    lasting={"RNDM": "RNDM=0"},
    language=statements(),
    zero=_zero(*_WORK_58_59),
)
AXIAL_MODES = replace(
    MODES,
    codes={**CODES, **{number: replace(CODES[number], effect=Effect.FRAME, meaning="shift") for number in (58, 59)}},
    zero=_zero(*_AXIAL),
)
"""The same where G58 and G59 shift single axes."""
