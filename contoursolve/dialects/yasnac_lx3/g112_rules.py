"""YASNAC LX3 G112: which words may be combined, and what the control cannot make."""

from decimal import Decimal

from contoursolve.diagnostic import Severity
from contoursolve.dialects.yasnac_lx3.claim import OTHER_G
from contoursolve.dialects.yasnac_lx3.g112 import BACKS_UP, FACING, TURNING, UNDECIDED
from contoursolve.dialects.yasnac_lx3.manual import alarms, manual
from contoursolve.rules import Rule, Value, all_of, at_least, at_most, some
from contoursolve.solving import RefusalKind, RemarkKind
from contoursolve.source import Evidence

_ROLE = "G112"
_END = ("X", "U", "Z", "W")
_START = "G00 X100. Z-50.\n"
_GOOD = _START + "G112 U0 I10. K-50. R30."
_FACE = _START + "G112 W0 I30. K5. R15."
_ARC_FIRST = _START + "G112 U-10. I0 K-50. R30."

_FORMAT = manual("2.8.30, p. 144")
_IMPOSSIBLE = manual("2.8.30, p. 146, Table 2.44")
_WAY = manual("2.8.30, p. 144-146: the path does not back up", Evidence.DERIVED)
_FITS = manual("2.8.30, p. 146, Table 2.44: no intersection, bevel cannot be made", Evidence.DERIVED)
_WORDS_IN_BLOCK, _PRINTED_COMBINATION, _PRINTED_GEOMETRY = alarms(Evidence.PRINTED)
_, _COMBINATION, _GEOMETRY = alarms(Evidence.ASSUMED)

_COMBINATION_RULES = (
    Rule(
        code="g112-word-missing",
        message="G112 needs I, K, R and one of X, U, Z and W; the block gives {present:X U Z W I K R}",
        help="add {absent:X|U|Z|W I K R}; a zero must be written, too (U0, I0)",
        source=_FORMAT,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=at_most(3, _END, "I", "K", "R"),
        accepted=(_GOOD, _FACE),
        rejected=(_START + "G112 U0 I10. K-50.", _START + "G112 I10. K-50. R30.", _START + "G112 U0 K-50. R30."),
    ),
    Rule(
        code="g112-x-and-u",
        message="{words}: X and U both give the line on which corner 2 lands",
        help="keep one of them",
        source=_FORMAT,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=all_of("X", "U"),
        accepted=(_GOOD,),
        rejected=(_GOOD + " X100.",),
    ),
    Rule(
        code="g112-z-and-w",
        message="{words}: Z and W both give the line on which corner 2 lands",
        help="keep one of them",
        source=_FORMAT,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=all_of("Z", "W"),
        accepted=(_FACE,),
        rejected=(_FACE + " Z-50.",),
    ),
    Rule(
        code="g112-x-and-z",
        message="{words:X U Z W}: corner 2 lands on a line along Z by X(U), or on one along X by Z(W), not on both",
        help="keep X(U) if line 1 runs along Z, Z(W) if it runs along X",
        source=_FORMAT,
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=all_of(("X", "U"), ("Z", "W")),
        accepted=(_GOOD, _FACE),
        rejected=(_GOOD + " Z-150.",),
    ),
    Rule(
        code="g112-c-and-p",
        message="{words}: corner 1 is either a bevel C or a rounding P",
        help="keep one of them",
        source=_FORMAT,
        alarm=_PRINTED_COMBINATION,
        roles=(_ROLE,),
        when=all_of("C", "P"),
        accepted=(_GOOD + " C5. Q5.", _GOOD + " P5. D5."),
        rejected=(_GOOD + " C5. P5.",),
    ),
    Rule(
        code="g112-d-and-q",
        message="{words}: corner 2 is either a bevel D or a rounding Q",
        help="keep one of them",
        source=_FORMAT,
        alarm=_PRINTED_COMBINATION,
        roles=(_ROLE,),
        when=all_of("D", "Q"),
        accepted=(_GOOD + " D5.", _GOOD + " Q5."),
        rejected=(_GOOD + " D5. Q5.",),
    ),
    Rule(
        code="g112-corner-sign",
        message="{words} is negative; C, P, D and Q are written without sign",
        help="delete the minus sign: the arc tells on which side the corner lies",
        source=manual("2.8.30, p. 144: without sign; that it is an error", Evidence.ASSUMED),
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=Value(("C", "P", "D", "Q"), least=Decimal(0)),
        accepted=(_GOOD + " P5. Q5.", _GOOD + " P0"),
        rejected=(_GOOD + " P-5.",),
    ),
    Rule(
        code="g112-radius",
        message="{words}: the radius of the arc must be more than 0",
        help="write the radius without sign; I and K tell where the centre is",
        source=manual("2.8.30, p. 144: arc radius", Evidence.DERIVED),
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=Value(("R",), least=Decimal(0), excluding=Decimal(0)),
        accepted=(_GOOD,),
        rejected=(_START + "G112 U0 I10. K-50. R-30.", _START + "G112 U0 I10. K-50. R0"),
    ),
    Rule(
        code="g112-m-s-t",
        message="{words:M S T}: a G112 block takes no M, S or T word",
        help="write it in a block of its own",
        source=_IMPOSSIBLE,
        alarm=_WORDS_IN_BLOCK,
        roles=(_ROLE,),
        when=some("M", "S", "T"),
        accepted=(_GOOD + " F0.2", "M08\n" + _GOOD),
        rejected=(_GOOD + " M08", _GOOD + " S500", _GOOD + " T0101"),
    ),
    Rule(
        code="g112-other-g",
        message="{words:other G} uses the axis words of the block itself, and so does G112",
        help="write it in a block of its own; G112 needs no G01",
        source=manual("2.8.30: multiple cornering is not modal; two codes of one group", Evidence.ASSUMED),
        alarm=_COMBINATION,
        roles=(_ROLE,),
        when=some(OTHER_G),
        accepted=(_GOOD,),
        rejected=(_START + "G01 G112 U0 I10. K-50. R30.", _START + "G04 G112 U0 I10. K-50. R30."),
    ),
)

_WAY_RULES = (
    Rule(
        code="g112-no-way",
        message="{words}: line 1 runs along Z towards the centre, and the centre is not before or behind the start",
        help="write the Z distance to the centre, or use Z(W) if line 1 runs along X",
        source=_WAY,
        alarm=_GEOMETRY,
        roles=(TURNING,),
        when=Value(("K",), excluding=Decimal(0)),
        is_about_geometry=True,
        accepted=(_GOOD,),
        rejected=(_START + "G112 U0 I10. K0 R30.",),
    ),
    Rule(
        code="g112-no-way-facing",
        message="{words}: line 1 runs along X towards the centre, and the centre is neither above nor below the start",
        help="write the X distance to the centre, or use X(U) if line 1 runs along Z",
        source=_WAY,
        alarm=_GEOMETRY,
        roles=(FACING,),
        when=Value(("I",), excluding=Decimal(0)),
        is_about_geometry=True,
        accepted=(_FACE,),
        rejected=(_START + "G112 W0 I0 K5. R15.",),
    ),
    Rule(
        code="g112-backs-up",
        message="{words}: line 1 and the line on which corner 2 lands lie on opposite sides of the centre, so the arc "
        "between them would have to turn back",
        help="put both lines on one side of the centre, or change the sign of I or K",
        source=_WAY,
        alarm=_GEOMETRY,
        roles=(_ROLE,),
        when=some(BACKS_UP) & at_least(1, "I", "K", *_END),
        is_about_geometry=True,
        accepted=(_GOOD,),
        rejected=(_START + "G112 U30. I10. K-50. R30.", _START + "G112 W8. I30. K5. R15."),
    ),
    Rule(
        code="g112-side-open",
        message="{words}: line 1 and the line on which corner 2 lands both lead through the centre, so nothing tells "
        "on which side of it the arc runs",
        help="move the centre or the line on which corner 2 lands",
        source=_WAY,
        alarm=_GEOMETRY,
        roles=(_ROLE,),
        when=some(UNDECIDED) & at_least(1, "I", "K", *_END),
        is_about_geometry=True,
        accepted=(_ARC_FIRST,),
        rejected=(_START + "G112 U0 I0 K-50. R30.",),
    ),
)

# The two corners cannot overlap: each of them stays on its side of the arc's lowest or highest point.
_GEOMETRY_RULES = (
    Rule(
        code="g112-missed",
        message="the line through {subject} misses the arc: it passes the centre at {actual}, the radius is {limit}",
        help="write a larger R, or move the centre or the line nearer to each other by {off}",
        source=_IMPOSSIBLE,
        alarm=_PRINTED_GEOMETRY,
        roles=(_ROLE,),
        about=RefusalKind.CIRCLE_MISSED,
        accepted=(_GOOD,),
        rejected=(_START + "G112 U0 I40. K-50. R30.", _START + "G112 U-60. I10. K-50. R30."),
    ),
    Rule(
        code="g112-touches",
        message="the line through {subject} just touches the arc, so the path has no corner there",
        help="check that it is meant to touch",
        source=_WAY,
        severity=Severity.INFO,
        roles=(_ROLE,),
        about=RemarkKind.TOUCHES,
        accepted=(_GOOD,),
        rejected=(_START + "G112 U-40. I10. K-50. R30.",),
    ),
    Rule(
        code="g112-reversed",
        message="{subject} would have to run back: it meets the arc first {off} behind its start",
        help="start farther from the arc, or change the centre or the radius",
        source=_IMPOSSIBLE,
        alarm=_PRINTED_GEOMETRY,
        roles=(_ROLE,),
        about=RefusalKind.LINE_REVERSED,
        accepted=(_GOOD,),
        rejected=(_START + "G112 U0 I10. K-20. R30.",),
    ),
    Rule(
        code="g112-arc-empty",
        message="{subject} ends where it begins: both lines touch it in the same point",
        help="move the centre or the line on which corner 2 lands",
        source=_FITS,
        alarm=_GEOMETRY,
        roles=(_ROLE,),
        about=RefusalKind.ARC_EMPTY,
        accepted=(_GOOD,),
        rejected=(_START + "G112 U0 I30. K-50. R30.",),
    ),
    Rule(
        code="g112-corner-too-large",
        message="{subject} does not fit: {words} is {actual}, {fits} on line 1 and on the arc",
        help="{smaller}, or make line 1 and the arc longer",
        source=_FITS,
        alarm=_GEOMETRY,
        roles=(_ROLE,),
        about=RefusalKind.CORNER_TOO_LARGE,
        accepted=(_GOOD + " P5. Q5.", _GOOD + " C5. D5."),
        rejected=(_GOOD + " P60.", _GOOD + " D40."),
    ),
    Rule(
        code="g112-no-corner",
        message="{words}: at {subject} the line touches the arc, so there is nothing to round or bevel",
        help="delete {words}",
        source=_FITS,
        alarm=_GEOMETRY,
        roles=(_ROLE,),
        about=RefusalKind.CORNER_STRAIGHT,
        accepted=(_GOOD + " P5.",),
        rejected=(_START + "G112 U-40. I10. K-50. R30. Q5.",),
    ),
    Rule(
        code="g112-bevel-band",
        message="{words}: no 45 deg segment of {subject} joins the line and the arc",
        help="use a rounding, or a sharp corner",
        source=_IMPOSSIBLE,
        alarm=_PRINTED_GEOMETRY,
        roles=(_ROLE,),
        about=RefusalKind.BEVEL_IN_BAND,
        accepted=(_GOOD + " C5. D5.",),
        rejected=(_START + "G112 U0 I28. K-50. R30. C1.",),
    ),
)

G112_RULES = _COMBINATION_RULES + _WAY_RULES + _GEOMETRY_RULES
