"""YASNAC LX3 G111, taper multiple cornering: its facts, its path, and its rules."""

from decimal import Decimal
from functools import cache

from contoursolve.controls.geometry_rules import GENERAL
from contoursolve.controls.rule_rows import row
from contoursolve.controls.yasnac_lx3.claim import OTHER_G, BlockReader, after_cornering, bevel_of
from contoursolve.controls.yasnac_lx3.lexicon import ASSUMPTIONS, BOOK, MOTION_AFTER, alarms
from contoursolve.diagnostics import Evidence, Severity, Source
from contoursolve.gcode import Block
from contoursolve.geometry import FIRST, SECOND, BlockRole, Coordinate, CornerShape, Heading, Line, Offset
from contoursolve.reading import (
    ContourForm,
    CornerRow,
    FactRow,
    Modes,
    Outline,
    ParsedContour,
    ReadIssue,
    Sample,
    State,
    Value,
    WordTable,
    all_of,
    at_least,
    at_most,
    some,
)

START, V1, V2 = "S", "V1", "V2"

PASSING = frozenset("NGF")
"""Addresses without a meaning for the contour that may stand in the block; F is assumed."""

REFUSED = frozenset("MST")
"""Addresses that a rule refuses."""


_SAMPLE = Sample(
    "G00 X40. Z0.",
    ("G111 {A160.} {B120.} {C2.} {D2.} {I10.919} {K-30.} {P2.} {Q2.} {U60.} {W-41.016} {X100.} {Z-41.016}",),
)


@cache
def g111(bevel: CornerShape) -> ContourForm:
    """The form of the block, with bevels of a shape."""
    return ContourForm(
        name="G111",
        title="taper multiple cornering",
        roles=(BlockRole("G111"),),
        outline=Outline(
            start=START,
            points=(V1, V2),
            radii=(),
            facts=(
                FactRow(Offset("I", V1, START, SECOND), ("I",)),
                FactRow(Offset("K", V1, START, FIRST), ("K",)),
                FactRow(Heading("A", START, V1), ("A",)),
                FactRow(Coordinate("X", V2, SECOND), ("X",)),
                FactRow(Offset("U", V2, START, SECOND), ("U",)),
                FactRow(Coordinate("Z", V2, FIRST), ("Z",)),
                FactRow(Offset("W", V2, START, FIRST), ("W",)),
                FactRow(Heading("B", V1, V2), ("B",)),
            ),
            path=(Line("line 1", START, V1, heading="A"), Line("line 2", V1, V2, heading="B")),
            corners=(
                CornerRow("corner 1", V1, "line 1", "line 2", {"C": bevel, "P": CornerShape.FILLET}),
                CornerRow(
                    "corner 2",
                    V2,
                    "line 2",
                    None,
                    {"D": bevel, "Q": CornerShape.FILLET},
                    landing=((("X", "U"), FIRST), (("Z", "W"), SECOND)),
                ),
            ),
            intersections=(V1, V2),
        ),
        allowed=frozenset("XUZWABIKPQCD") | PASSING,
        table=WordTable(
            combinations=tuple(((), (address,)) for address in "AIKBXUZW"),
            sample=_SAMPLE,
        ),
        assumptions=ASSUMPTIONS,
        is_literal=True,
    )


G111 = g111(CornerShape.CHAMFER_AXIS_45)


def claim_g111(block: Block, state: State, modes: Modes) -> ParsedContour:
    """The contour of a block with G111."""
    reader = BlockReader(block, 111, state, after_cornering(block, state, modes), modes)
    return reader.claim(g111(bevel_of(modes)), REFUSED)


_ROLE = "G111"
_END_X, _END_Z = ("X", "U"), ("Z", "W")
_LINE_2 = ("B", _END_X, _END_Z)
_WHOLE_LINE_2 = all_of(*_LINE_2)
_START = "G00 X40. Z0.\n"
_GOOD = _START + "G111 X100. A180. K-30. B120."

_TABLE_234 = BOOK.printed("2.8.30, Table 2.34")
_FITS = BOOK.derived("2.8.30; the family's alarms")
_WORDS_IN_BLOCK, _COMBINATION, _GEOMETRY = alarms(Evidence.ASSUMED)


_COMBINATION_RULES = (
    row("g111-line-1", "the first straight needs two of A, I and K; the block gives {present:A I K}",
        "add {absent:A I K}; a zero must be written, too (I0, K0)", _TABLE_234,
        at_most(1, "A", "I", "K") & ~(_WHOLE_LINE_2 & at_least(1, "A", "I", "K")),
        ((_GOOD, _START + "G111 A180. B120. X100. Z-47.3205"), _START + "G111 X100. A180. B120.",
         _START + "G111 X100. B120. Z-47."), (_ROLE,), alarm=_COMBINATION),
    row("g111-line-2", "the second straight needs two of B, X or U, Z or W; the block gives {present:B X U Z W}",
        "add {absent:B X|U Z|W}; a zero must be written, too (U0, W0, B0)", _TABLE_234, at_most(1, *_LINE_2),
        ((_GOOD, _START + "G111 A180. K-30. B120. U60."), _START + "G111 A180. K-30. B120.",
         _START + "G111 A180. K-30."), (_ROLE,), alarm=_COMBINATION),
    row("g111-x-and-u",
        "{words}: X and U both give the end of the second straight in X", "keep one of them", _TABLE_234,
        all_of("X", "U"), (_GOOD, _GOOD + " U60."), (_ROLE,), alarm=_COMBINATION),
    row("g111-z-and-w",
        "{words}: Z and W both give the end of the second straight in Z", "keep one of them", _TABLE_234,
        all_of("Z", "W"), (_START + "G111 A180. K-30. B120. Z-47.", _START + "G111 A180. K-30. B120. Z-47. W-47."),
        (_ROLE,), alarm=_COMBINATION),
    row("g111-c-and-p", "{words}: the first corner is either a bevel C or a rounding P", "keep one of them", _TABLE_234,
        all_of("C", "P"), ((_GOOD + " C5. Q5.", _GOOD + " P5. D5."), _GOOD + " C5. P5."), (_ROLE,), alarm=_COMBINATION),
    row("g111-d-and-q",
        "{words}: the second corner is either a bevel D or a rounding Q", "keep one of them", _TABLE_234,
        all_of("D", "Q"), ((_GOOD + " D5.", _GOOD + " Q5."), _GOOD + " D5. Q5."), (_ROLE,), alarm=_COMBINATION),
    row("g111-corner-2-without-angle",
        "{words:D Q}: the second corner is not available when X(U) and Z(W) give the second straight",
        "delete {words:D Q}, or give the second straight by B and one of X(U), Z(W)",
        BOOK.printed("2.8.30, p. 140 (iii)"),
        some("D", "Q") & all_of(_END_X, _END_Z) & ~_WHOLE_LINE_2,
        (_GOOD + " Q5.", _START + "G111 A180. K-30. X100. Z-47. Q5."), (_ROLE,), alarm=_COMBINATION),
    row("g111-corner-2-with-three",
        "{words:D Q}: the second corner is not available when B, X(U) and Z(W) are all given",
        "delete {words:D Q}, or one of X(U) and Z(W)", BOOK.assumed("2.8.30, p. 140 (i); as (iii)"),
        some("D", "Q") & _WHOLE_LINE_2 & at_most(1, "A", "I", "K"),
        (_GOOD + " Q5.", _START + "G111 A180. B120. X100. Z-47. Q5."), (_ROLE,), alarm=_COMBINATION),
    row("g111-corner-2-without-b",
        "{words:D Q}: the second corner is not available: the control ignores {words:B}, and X(U) and Z(W) give the "
        "second straight",
        "delete {words:D Q}, or one of X(U) and Z(W)", BOOK.derived("2.8.30, p. 140 (vi) and (iii)"),
        some("D", "Q") & _WHOLE_LINE_2 & at_least(2, "A", "I", "K"),
        ((_GOOD + " Q5.", _START + "G111 A180. K-30. B120. X100. Z-47."),
         _START + "G111 A180. K-30. B120. X100. Z-47. Q5.", _START + "G111 I0 K-30. B120. X100. Z-47. D5."), (_ROLE,),
        alarm=_COMBINATION),
    row("g111-a-ignored", "the control ignores {words:A}, because I and K are given, too{comparison}",
        "delete {words:A}, or one of I and K if the angle is what you mean", BOOK.printed("2.8.30, p. 140 (v)"),
        all_of("A", "I", "K"), (_GOOD, _START + "G111 A135. I10. K-12. B180. Z-40."), (_ROLE,),
        about=ReadIssue.WORD_IGNORED, severity=Severity.WARNING, ignores="A"),
    row("g111-b-ignored",
        "the control ignores {words:B}, because X(U) and Z(W) and two of A, I, K are given, too{comparison}",
        "delete {words:B}, or one word more if the angle is what you mean", BOOK.printed("2.8.30, p. 140 (vi)"),
        _WHOLE_LINE_2 & at_least(2, "A", "I", "K"),
        ((_GOOD, _START + "G111 A180. B120. X100. Z-47."), _START + "G111 A180. K-30. B120. X100. Z-47."), (_ROLE,),
        about=ReadIssue.WORD_IGNORED, severity=Severity.WARNING, ignores="B"),
    row("g111-angle-range", "{words} is outside -360 to 360 deg",
        "write an angle from -360 to 360 deg; this one is the direction of {within}",
        BOOK.printed("2.8.30, p. 140 (vii)"), Value(("A", "B"), least=Decimal(-360), most=Decimal(360)),
        ((_GOOD, _START + "G111 X100. A-180. K-30. B-240."), _START + "G111 X100. A180. K-30. B480."), (_ROLE,),
        alarm=_COMBINATION),
    row("g111-corner-sign", "{words} {are} negative; C, P, D and Q are written without sign",
        "delete the minus sign: the lines tell on which side the corner lies",
        BOOK.assumed("2.8.30, Table 2.33: without sign; that it is an error"),
        Value(("C", "P", "D", "Q"), least=Decimal(0)), ((_GOOD + " P5. Q5.", _GOOD + " P0"), _GOOD + " P-5."), (_ROLE,),
        alarm=_COMBINATION),
    row("g111-m-s-t", "{words:M S T}: a G111 block takes no M, S or T word", "write it in a block of its own",
        BOOK.printed("2.8.30, p. 140 Note 2"), some("M", "S", "T"),
        ((_GOOD + " F0.2", "M08\n" + _GOOD), _GOOD + " M08", _GOOD + " S500", _GOOD + " T0101"), (_ROLE,),
        alarm=_WORDS_IN_BLOCK),
    row("g111-other-g", "{words:other G} uses the axis words of the block itself, and so does G111",
        "write it in a block of its own; G111 needs no G01",
        BOOK.assumed("2.8.30: G111 is not modal; two codes of one group"), some(OTHER_G),
        (_GOOD, ("G111", "G01 G111"), ("G111", "G04 G111")), (_ROLE,), alarm=_COMBINATION),
)  # fmt: skip

_TOUCHING = Source("contoursolve", "further facts", Evidence.ASSUMED)

_GEOMETRY_RULES = (
    row("g111-touches", like=GENERAL["double"], source=_TOUCHING,
        examples=(_GOOD, "G00 X40. Z0.\nG111 A180. K-30. X100. (contoursolve: length of line 2 = 30)"), roles=(_ROLE,)),
    row("g111-parallel", like=GENERAL, help="change an angle, or give the point by its distances I and K",
        source=BOOK.derived("2.8.30, p. 146: no intersection"),
        examples=(_GOOD, _START + "G111 A180. B180. X100. Z-50.", _START + "G111 A180. I5. B120. X100."),
        roles=(_ROLE,), alarm=_GEOMETRY),
    row("g111-not-fixed", like=GENERAL, source=BOOK.derived("2.8.30, p. 146: no intersection"),
        examples=(_GOOD, _START + "G111 A180. I0 B120. X100."), roles=(_ROLE,), alarm=_GEOMETRY),
    row("g111-reversed", like=GENERAL, source=BOOK.derived("2.8.30, p. 146: moves away"),
        examples=(_GOOD, _START + "G111 X100. A0 K-30. B120.", _START + "G111 X100. A180. K-30. B-60."), roles=(_ROLE,),
        alarm=_GEOMETRY),
    row("g111-corner-too-large", like=GENERAL, help="{smaller}, or make the lines longer", source=_FITS,
        examples=(_GOOD + " P5. Q5.", _GOOD + " P60.", _GOOD + " D40."), roles=(_ROLE,), alarm=_GEOMETRY),
    row("g111-corners-overlap", like=GENERAL,
        message="{words} overlap on {subject}: they need {actual}, the line has {limit}", source=_FITS,
        examples=(_GOOD + " P5. Q5.", _GOOD + " P35. Q35."), roles=(_ROLE,), alarm=_GEOMETRY),
    row("g111-no-corner", like=GENERAL,
        message="{words}: {subject} joins two lines of the same direction, so it is no corner",
        source=BOOK.derived("2.8.30, p. 146: no intersection"),
        examples=(_GOOD + " P5.", _START + "G111 A135. K-30. B135. X120. P2."), roles=(_ROLE,), alarm=_GEOMETRY),
    row("g111-corner-reverses", like=GENERAL, help="change an angle",
        source=BOOK.derived("2.8.30, p. 146: no intersection"),
        examples=(_GOOD + " P5.", _START + "G111 A135. K-30. B-45. X60. P2."), roles=(_ROLE,), alarm=_GEOMETRY),
    row("g111-bevel-outside", like=GENERAL,
        message="{words}: the virtual intersection lies {off} in {axis} outside the rectangle between start and end of "
        "the second straight", help="use a rounding P, or a sharp corner", source=BOOK.printed("2.8.30, p. 140 Note 3"),
        examples=(_GOOD + " C5.", _START + "G111 X100. A180. K-30. B60. C5."), roles=(_ROLE,), alarm=_GEOMETRY),
    row("g111-bevel-band", like=GENERAL, message="{words}: no 45 deg segment joins the two lines of {subject}",
        help="use a rounding, or a sharp corner: the virtual intersection lies in the band between the 45 deg lines",
        source=BOOK.derived("2.8.30, p. 140 Note 3: printed for C, the same for D by symmetry"),
        examples=(_GOOD + " C5. D5.", _START + "G111 X60. A180. K-30. B160. C2.",
         _START + "G111 X60. A180. K-30. B160. D2."), roles=(_ROLE,), alarm=_GEOMETRY),
    row("g111-landing-unknown", like=GENERAL,
        message="{words}: neither line advances along the line that {subject} would land on",
        source=BOOK.derived("2.8.30, p. 137, Tables 2.35 and 2.36"),
        examples=(_GOOD + " Q5.", _START + "G111 A90. I10. B90. X100. Q2."), roles=(_ROLE,), alarm=_GEOMETRY),
)  # fmt: skip

_FOLLOWING_RULES = (
    row("g111-forgotten", "{words} {stand} here without {code}, which is not modal: each contour needs its own",
        "write {code} into this block, or delete {words}", BOOK.derived("2.8.30: G111 is not modal"),
        ReadIssue.CODE_FORGOTTEN,
        ((_GOOD + "\nG111 X160. A180. K-30. B120.", _GOOD + "\nG01 X120. K-5.", _GOOD + "\nG02 U10. W-5. I5. K0"),
         _GOOD + "\nX160. A180. K-30. B120.",
        "G01 X40. Z0. F0.2\nG111 X100. A180. K-30. B120.\nX160. A180. K-30. B120.", _GOOD + "\nZ-90. K-10."),
        (_ROLE, "G112"), severity=Severity.WARNING),
    row("g111-rapid-behind",
        "{words} {have} no G code: after {code}, G00 is in force again, so this is a rapid along the part",
        "write G01 or G00; if {code} leaves G01 in force on your control: --setting yasnac-lx3.motion-after=g01",
        MOTION_AFTER.source, ReadIssue.RAPID_BEHIND,
        ((_GOOD + "\nG01 Z-90.", _GOOD + "\nG00 X200.", "G01 X40. Z0. F0.2\nG111 X100. A180. K-30. B120.\nZ-90."),
         _GOOD + "\nZ-90.", _GOOD + " Q5.\nM08\nW-30.", "G00 X100. Z-50.\nG112 U0 I10. K-50. R30.\nZ-150."),
        (_ROLE, "G112"), severity=Severity.WARNING),
    row("g111-landing-left",
        "{words} {leave} the line on which the second corner lands by {angle}: it is made for {line}",
        "go on along {line}, or give the second straight a sharp end",
        BOOK.derived("2.8.30, p. 137 and 140: corner 2 does not look at the next block"), ReadIssue.LANDING_LEFT,
        ((_GOOD + " Q5.\nG01 Z-90.", _GOOD + " Q5.\nG00 X200. Z10.", _GOOD + " D5.\nG111 A180. K-30. B120. X160.",
         _GOOD + " Q5.\nG02 X110. Z-55.207 I5. K0", _GOOD + "\nG01 X120."), _GOOD + " Q5.\nG01 X120.",
         _GOOD + " D5.\nG01 X110. Z-90.", _GOOD + " Q5.\nG01 Z-40.", _GOOD + " Q5.\nG111 A150. K-30. B120. X160.",
        "G00 X100. Z-50.\nG112 U0 I10. K-50. P5. Q5. R30.\nG01 X120. Z-150."), (_ROLE, "G112"),
        severity=Severity.WARNING),
)  # fmt: skip

G111_RULES = _COMBINATION_RULES + _GEOMETRY_RULES + _FOLLOWING_RULES
