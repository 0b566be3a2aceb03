"""YASNAC LX3 G111: which words may be combined, and what the control cannot make."""

from decimal import Decimal

from contoursolve.diagnostic import Alarm, Severity
from contoursolve.dialects.yasnac_lx3.g111 import OTHER_G
from contoursolve.dialects.yasnac_lx3.lexicon import MANUAL
from contoursolve.reading import Trouble
from contoursolve.rules import Rule, Value, all_of, at_least, at_most, some
from contoursolve.solving import RefusalKind, RemarkKind
from contoursolve.source import Evidence, Source

_ROLE = "G111"
_END_X, _END_Z = ("X", "U"), ("Z", "W")
_LINE_2 = ("B", _END_X, _END_Z)
_WHOLE_LINE_2 = all_of(*_LINE_2)
_START = "G00 X40. Z0.\n"
_GOOD = _START + "G111 X100. A180. K-30. B120."


def _manual(place: str, evidence: Evidence = Evidence.PRINTED) -> Source:
    return Source(MANUAL, place, evidence)


_TABLE_234 = _manual("2.8.30, Table 2.34")
_FITS = _manual("2.8.30; the family's alarms", Evidence.DERIVED)
_WORDS_IN_BLOCK = Alarm("144", Evidence.ASSUMED)
_COMBINATION = Alarm("145", Evidence.ASSUMED)
_GEOMETRY = Alarm("146", Evidence.ASSUMED)

COMBINATION_RULES = (
    Rule(
        code="g111-line-1",
        message="line 1 needs two of A, I and K; the block gives {present:A I K}",
        help="add {absent:A I K}; a zero must be written, too (I0, K0)",
        source=_TABLE_234,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=at_most(1, "A", "I", "K") & ~(_WHOLE_LINE_2 & at_least(1, "A", "I", "K")),
        accepted=(_GOOD, _START + "G111 A180. B120. X100. Z-47.3205"),
        rejected=(_START + "G111 X100. A180. B120.", _START + "G111 X100. B120. Z-47."),
    ),
    Rule(
        code="g111-line-2",
        message="line 2 needs two of B, X or U, Z or W; the block gives {present:B X U Z W}",
        help="add {absent:B X|U Z|W}; a zero must be written, too (U0, W0, B0)",
        source=_TABLE_234,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=at_most(1, *_LINE_2),
        accepted=(_GOOD, _START + "G111 A180. K-30. B120. U60."),
        rejected=(_START + "G111 A180. K-30. B120.", _START + "G111 A180. K-30."),
    ),
    Rule(
        code="g111-x-and-u",
        message="{words}: X and U both give the end of line 2 in X",
        help="keep one of them",
        source=_TABLE_234,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=all_of("X", "U"),
        accepted=(_GOOD,),
        rejected=(_GOOD + " U60.",),
    ),
    Rule(
        code="g111-z-and-w",
        message="{words}: Z and W both give the end of line 2 in Z",
        help="keep one of them",
        source=_TABLE_234,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=all_of("Z", "W"),
        accepted=(_START + "G111 A180. K-30. B120. Z-47.",),
        rejected=(_START + "G111 A180. K-30. B120. Z-47. W-47.",),
    ),
    Rule(
        code="g111-c-and-p",
        message="{words}: corner 1 is either a bevel C or a rounding P",
        help="keep one of them",
        source=_TABLE_234,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=all_of("C", "P"),
        accepted=(_GOOD + " C5. Q5.", _GOOD + " P5. D5."),
        rejected=(_GOOD + " C5. P5.",),
    ),
    Rule(
        code="g111-d-and-q",
        message="{words}: corner 2 is either a bevel D or a rounding Q",
        help="keep one of them",
        source=_TABLE_234,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=all_of("D", "Q"),
        accepted=(_GOOD + " D5.", _GOOD + " Q5."),
        rejected=(_GOOD + " D5. Q5.",),
    ),
    Rule(
        code="g111-corner-2-without-angle",
        message="{words:D Q}: corner 2 is not available when X(U) and Z(W) give line 2",
        help="delete {words:D Q}, or give line 2 by B and one of X(U), Z(W)",
        source=_manual("2.8.30, supplementary note iii"),
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=some("D", "Q") & all_of(_END_X, _END_Z) & ~_WHOLE_LINE_2,
        accepted=(_GOOD + " Q5.",),
        rejected=(_START + "G111 A180. K-30. X100. Z-47. Q5.",),
    ),
    Rule(
        code="g111-corner-2-with-three",
        message="{words:D Q}: corner 2 is not available when B, X(U) and Z(W) are all given",
        help="delete {words:D Q}, or one of X(U) and Z(W)",
        source=_manual("2.8.30, supplementary notes i and iii", Evidence.ASSUMED),
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=some("D", "Q") & _WHOLE_LINE_2,
        accepted=(_GOOD + " Q5.",),
        rejected=(_START + "G111 A180. B120. X100. Z-47. Q5.",),
    ),
    Rule(
        code="g111-a-ignored",
        message="{words:A} is ignored, because I and K are given, too{comparison}",
        help="delete {words:A}, or one of I and K if the angle is what you mean",
        source=_manual("2.8.30, supplementary note v"),
        severity=Severity.WARNING,
        roles=(_ROLE,),
        when=all_of("A", "I", "K"),
        about=Trouble.WORD_IGNORED,
        ignores="A",
        accepted=(_GOOD,),
        rejected=(_START + "G111 A135. I10. K-12. B180. Z-40.",),
    ),
    Rule(
        code="g111-b-ignored",
        message="{words:B} is ignored, because X(U) and Z(W) and two of A, I, K are given, too{comparison}",
        help="delete {words:B}, or one word more if the angle is what you mean",
        source=_manual("2.8.30, supplementary note vi"),
        severity=Severity.WARNING,
        roles=(_ROLE,),
        when=_WHOLE_LINE_2 & at_least(2, "A", "I", "K"),
        about=Trouble.WORD_IGNORED,
        ignores="B",
        accepted=(_GOOD, _START + "G111 A180. B120. X100. Z-47."),
        rejected=(_START + "G111 A180. K-30. B120. X100. Z-47.",),
    ),
    Rule(
        code="g111-angle-range",
        message="{words} is outside -360 to 360 deg",
        help="write the same direction within one turn",
        source=_manual("2.8.30, p. 140"),
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=Value(("A", "B"), least=Decimal(-360), most=Decimal(360)),
        accepted=(_GOOD, _START + "G111 X100. A-180. K-30. B-240."),
        rejected=(_START + "G111 X100. A180. K-30. B480.",),
    ),
    Rule(
        code="g111-corner-sign",
        message="{words} is negative; C, P, D and Q are written without sign",
        help="delete the minus sign: the lines tell on which side the corner lies",
        source=_manual("2.8.30, Table 2.33: without sign; that it is an error", Evidence.ASSUMED),
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=Value(("C", "P", "D", "Q"), least=Decimal(0)),
        accepted=(_GOOD + " P5. Q5.", _GOOD + " P0"),
        rejected=(_GOOD + " P-5.",),
    ),
    Rule(
        code="g111-m-s-t",
        message="{words:M S T}: a G111 block takes no M, S or T word",
        help="write it in a block of its own",
        source=_manual("2.8.30"),
        alarm=_WORDS_IN_BLOCK,
        roles=(_ROLE,),
        when=some("M", "S", "T"),
        accepted=(_GOOD + " F0.2", "M08\n" + _GOOD),
        rejected=(_GOOD + " M08", _GOOD + " S500", _GOOD + " T0101"),
    ),
    Rule(
        code="g111-other-g",
        message="{words:other G} uses the axis words of the block itself, and so does G111",
        help="write it in a block of its own; G111 needs no G01",
        source=_manual("2.8.30: G111 is not modal; two codes of one group", Evidence.ASSUMED),
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=some(OTHER_G),
        accepted=(_GOOD,),
        rejected=(_START + "G01 G111 X100. A180. K-30. B120.", _START + "G04 G111 X100. A180. K-30. B120."),
    ),
)

_TOUCHING = Source("contoursolve", "further facts", Evidence.ASSUMED)

GEOMETRY_RULES = (
    Rule(
        code="g111-touches",
        message="{subject}: two contours have become one, because an element just touches; a small change parts them",
        help="check that it is meant to touch",
        source=_TOUCHING,
        about=RemarkKind.DOUBLE,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=("G00 X40. Z0.\nG111 A180. K-30. X100. (contoursolve: length of line 2 = 30)",),
    ),
    Rule(
        code="g111-parallel",
        message="no point satisfies {words} together: the lines are parallel and {off} apart",
        help="change an angle, or give the point by its distances I and K",
        source=_manual("2.8.30, p. 146: no intersection"),
        alarm=_GEOMETRY,
        about=RefusalKind.LINES_PARALLEL,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. B180. X100. Z-50.", _START + "G111 A180. I5. B120. X100."),
    ),
    Rule(
        code="g111-not-fixed",
        message="{words} do not fix {free}: at these values they state the same line",
        help="replace one of them by a word that says where on the line the point is",
        source=_manual("2.8.30, p. 146: no intersection", Evidence.DERIVED),
        alarm=_GEOMETRY,
        about=RefusalKind.NOT_FIXED,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. I0 B120. X100.",),
    ),
    Rule(
        code="g111-reversed",
        message="{subject} would run against {words}: its end lies {off} behind its start",
        help="write {expected}, or move the end to the other side",
        source=_manual("2.8.30, p. 146: moves away"),
        alarm=_GEOMETRY,
        about=RefusalKind.LINE_REVERSED,
        accepted=(_GOOD,),
        rejected=(_START + "G111 X100. A0 K-30. B120.", _START + "G111 X100. A180. K-30. B-60."),
    ),
    Rule(
        code="g111-corner-too-large",
        message="{subject} does not fit: {words} is {actual}, at most {limit} fits on its lines",
        help="write at most {limit}, or make the lines longer",
        source=_FITS,
        alarm=_GEOMETRY,
        about=RefusalKind.CORNER_TOO_LARGE,
        accepted=(_GOOD + " P5. Q5.",),
        rejected=(_GOOD + " P60.", _GOOD + " D40."),
    ),
    Rule(
        code="g111-corners-overlap",
        message="{words} overlap on {subject}: they need {actual}, the line has {limit}",
        help="make the corners smaller by {off} of line in all",
        source=_FITS,
        alarm=_GEOMETRY,
        about=RefusalKind.CORNERS_OVERLAP,
        accepted=(_GOOD + " P5. Q5.",),
        rejected=(_GOOD + " P35. Q35.",),
    ),
    Rule(
        code="g111-no-corner",
        message="{words}: {subject} joins two lines of the same direction, so there is nothing to round or bevel",
        help="delete {words}",
        source=_manual("2.8.30, p. 146: no intersection", Evidence.DERIVED),
        alarm=_GEOMETRY,
        about=RefusalKind.CORNER_STRAIGHT,
        accepted=(_GOOD + " P5.",),
        rejected=(_START + "G111 A135. K-30. B135. X120. P2.",),
    ),
    Rule(
        code="g111-corner-reverses",
        message="{words}: {subject} turns back by 180 deg, where no corner can be made",
        help="change an angle",
        source=_manual("2.8.30, p. 146: no intersection", Evidence.DERIVED),
        alarm=_GEOMETRY,
        about=RefusalKind.CORNER_REVERSES,
        accepted=(_GOOD + " P5.",),
        rejected=(_START + "G111 A135. K-30. B-45. X60. P2.",),
    ),
    Rule(
        code="g111-bevel-outside",
        message="{words}: the virtual intersection lies {off} outside the rectangle between start and end of line 2",
        help="use a rounding P, or a sharp corner",
        source=_manual("2.8.30, p. 138"),
        alarm=_GEOMETRY,
        about=RefusalKind.BEVEL_OUTSIDE,
        accepted=(_GOOD + " C5.",),
        rejected=(_START + "G111 X100. A180. K-30. B60. C5.",),
    ),
    Rule(
        code="g111-bevel-band",
        message="{words}: no 45 deg segment joins the two lines of {subject}",
        help="use a rounding, or a sharp corner: the virtual intersection lies in the band between the 45 deg lines",
        source=_manual("2.8.30, p. 138: printed for C, the same for D by symmetry", Evidence.DERIVED),
        alarm=_GEOMETRY,
        about=RefusalKind.BEVEL_IN_BAND,
        accepted=(_GOOD + " C5. D5.",),
        rejected=(_START + "G111 X60. A180. K-30. B160. C2.", _START + "G111 X60. A180. K-30. B160. D2."),
    ),
    Rule(
        code="g111-landing-unknown",
        message="{words}: neither line advances along the line that {subject} would land on",
        help="delete {words}",
        source=_manual("2.8.30, Tables 2.35 and 2.36", Evidence.DERIVED),
        alarm=_GEOMETRY,
        about=RefusalKind.LANDING_UNKNOWN,
        accepted=(_GOOD + " Q5.",),
        rejected=(_START + "G111 A90. I10. B90. X100. Q2.",),
    ),
)
