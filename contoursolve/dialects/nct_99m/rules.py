"""NCT 16.3.3: which words the pair of blocks may have, and what cannot be intersected."""

from decimal import Decimal

from contoursolve.diagnostic import Alarm, Severity
from contoursolve.dialects.nct_99m.circle_line import ALONE, CHAINED, COMPENSATED, OTHER_PLANE, RAPID
from contoursolve.dialects.nct_99m.lexicon import MANUAL
from contoursolve.rules import Condition, Rule, Value, all_of, at_most, some
from contoursolve.solving import RefusalKind, RemarkKind
from contoursolve.source import Evidence, Source

_FORM = "circle-line"
_START = "G17 G90 G0 X90 Y0\nG42 G1 X50 D0\n"
_ARC = "G3 X-50 Y0 R50\n"
_LINE = "G1 X-50 Y42.857 ,A171.87 Q-1"
_GOOD = _START + _ARC + _LINE
_CENTERED = _START + "G3 I-50 J0\n" + _LINE

_CENTERS = ("1:center-first", "1:center-second")
_POINT = ("1:first", "1:first-step", "1:second", "1:second-step")
_PAIR: Condition = ~some(ALONE)


def _manual(place: str, evidence: Evidence = Evidence.PRINTED) -> Source:
    return Source(MANUAL, place, evidence)


_PAGE = _manual("16.3.3, p. 129")
_DERIVED = _manual("16.3.3, p. 129", Evidence.DERIVED)
_ASSUMED = _manual("16.3.3, p. 129: not described", Evidence.ASSUMED)
_CIRCLE = Alarm("3014 ERRONEOUS CIRCLE DEF.", Evidence.PRINTED)
_CIRCLE_R = Alarm("3012 ERRONEOUS CIRCLE DEF. R", Evidence.PRINTED)

COMBINATION_RULES = (
    Rule(
        code="nct-compensation-off",
        message="{words}: intersections are computed only with G41 or G42 active",
        help="switch G41 or G42 on before the arc; D00 keeps the path where it is",
        source=_manual("16.3: every format and example has it", Evidence.ASSUMED),
        form=_FORM,
        when=some("2:,A") & ~some(COMPENSATED),
        accepted=(_GOOD,),
        rejected=("G17 G90 G0 X50 Y0\n" + _ARC + _LINE,),
    ),
    Rule(
        code="nct-line-without-arc",
        message="{words}: this line has both coordinates and ,A, but the block before it is no arc",
        help="put the arc (G2 or G3) right before it, or drop ,A; a line before it (16.3.1) is not resolved "
        "by this version",
        source=_DERIVED,
        form=_FORM,
        when=some("2:,A") & some(ALONE),
        accepted=(_GOOD,),
        rejected=(_START + "G1 X60 Y10\n" + _LINE,),
    ),
    Rule(
        code="nct-line-rapid",
        message="{words}: the over-defined line must be a G1 block, not G0",
        help="write G1",
        source=_DERIVED,
        form=_FORM,
        when=some("2:,A") & some(RAPID),
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G0 X-50 Y42.857 ,A171.87 Q-1",),
    ),
    Rule(
        code="nct-q-missing",
        message="Q is missing: the line meets the circle twice, and only Q's sign tells which point is meant",
        help="add Q-1 for the nearer or Q1 for the farther point, counted along ,A",
        source=_ASSUMED,
        form=_FORM,
        when=some("2:,A") & ~some("2:Q") & _PAIR,
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G1 X-50 Y42.857 ,A171.87",),
    ),
    Rule(
        code="nct-q-zero",
        message="{words} has no sign, and only Q's sign tells which point is meant",
        help="write Q-1 for the nearer or Q1 for the farther point, counted along ,A",
        source=_ASSUMED,
        form=_FORM,
        when=Value(("2:Q",), excluding=Decimal(0)),
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G1 X-50 Y42.857 ,A171.87 Q0",),
    ),
    Rule(
        code="nct-circle-undefined",
        message="the arc has neither a centre nor a radius",
        help="add the centre's two distances from the start point, or R with a point",
        source=_manual("16.3.3, p. 129; alarm 3014"),
        alarm=_CIRCLE,
        form=_FORM,
        when=at_most(0, _CENTERS, "1:R") & _PAIR,
        accepted=(_GOOD, _CENTERED),
        rejected=(_START + "G3 X-50 Y0\n" + _LINE,),
    ),
    Rule(
        code="nct-center-and-radius",
        message="{words}: the arc has both a centre and a radius",
        help="keep one of them; an over-defined circle in a chain (16.3.5) is not resolved by this version",
        source=_PAGE,
        form=_FORM,
        when=all_of(_CENTERS, "1:R"),
        accepted=(_GOOD, _CENTERED),
        rejected=(_START + "G3 X-50 Y0 I-50 J0 R50\n" + _LINE,),
    ),
    Rule(
        code="nct-radius-without-point",
        message="{words}: with R the arc needs a point of the circle",
        help="add the coordinates of a point, or give the centre instead",
        source=_manual("16.3.3, p. 129; alarm 3012"),
        alarm=_CIRCLE_R,
        form=_FORM,
        when=some("1:R") & ~some(*_POINT),
        accepted=(_GOOD,),
        rejected=(_START + "G3 R50\n" + _LINE,),
    ),
    Rule(
        code="nct-radius-zero",
        message="{words}: a circle of radius 0 meets nothing",
        help="write the radius",
        source=_ASSUMED,
        form=_FORM,
        when=Value(("1:R",), excluding=Decimal(0)),
        accepted=(_GOOD,),
        rejected=(_START + "G3 X-50 Y0 R0\n" + _LINE,),
    ),
    Rule(
        code="nct-center-outside-plane",
        message="{words} lies outside the selected plane",
        help="G17 takes I and J, G18 takes I and K, G19 takes J and K",
        source=_manual("16.3.3, p. 129; alarm 3014"),
        alarm=_CIRCLE,
        form=_FORM,
        when=some("1:wrong-center", "2:wrong-center"),
        accepted=(_CENTERED,),
        rejected=(_START + "G3 I-50 K0\n" + _LINE,),
    ),
    Rule(
        code="nct-center-on-line",
        message="{words}: a line has no centre and no radius",
        help="delete it",
        source=_DERIVED,
        form=_FORM,
        when=some("2:center-first", "2:center-second", "2:R"),
        accepted=(_GOOD,),
        rejected=(_GOOD + " R5",),
    ),
    Rule(
        code="nct-q-on-arc",
        message="{words}: Q and ,A belong to the line, not to this arc",
        help="delete it; chains of over-defined blocks (16.3.5) are not resolved by this version",
        source=_DERIVED,
        form=_FORM,
        when=some("1:Q", "1:,A"),
        accepted=(_GOOD,),
        rejected=(_START + "G3 X-50 Y0 R50 Q1\n" + _LINE,),
    ),
    Rule(
        code="nct-axis-outside-plane",
        message="{words} moves an axis outside the plane in which the intersection is computed",
        help="move that axis in a block of its own",
        source=_ASSUMED,
        form=_FORM,
        when=some("1:off-plane", "2:off-plane"),
        accepted=(_GOOD,),
        rejected=(_GOOD + " Z-5",),
    ),
    Rule(
        code="nct-corner-at-intersection",
        message="{words}: a chamfer or rounding at a computed intersection is not resolved by this version",
        help="the block was not solved; the control inserts the corner after it has found the intersection",
        source=_manual("16.3.3, p. 129: the intersection first, then the corner"),
        form=_FORM,
        when=some("1:,C", "1:,R", "2:,C", "2:,R"),
        accepted=(_GOOD,),
        rejected=(_START + "G3 X-50 Y0 R50 ,R2\n" + _LINE,),
    ),
    Rule(
        code="nct-chain",
        message="the next block is over-defined, too: this is a chain (16.3.5), which this version does not resolve",
        help="the pair was not solved: the line's end is then not its real end, but a point that it passes through",
        source=_manual("16.3.5; the rule which coordinates are a real end"),
        form=_FORM,
        when=some(CHAINED),
        accepted=(_GOOD,),
        rejected=(_GOOD + "\nG2 X-80 Y20 I-60 J30 R20 Q1",),
    ),
    Rule(
        code="nct-plane-changes",
        message="the plane changes between the arc and the line",
        help="select the plane before the arc",
        source=_DERIVED,
        form=_FORM,
        when=some(OTHER_PLANE),
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G18 G1 X-50 Z42.857 ,A171.87 Q-1",),
    ),
)

GEOMETRY_RULES = (
    Rule(
        code="nct-circle-missed",
        message="the line misses the circle: it passes the centre at {actual}, the radius is {limit}, {off} too far",
        help="change ,A or the line's end point, or make the circle larger",
        source=_PAGE,
        about=RefusalKind.CIRCLE_MISSED,
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G1 X-50 Y80 ,A180 Q-1",),
    ),
    Rule(
        code="nct-circle-touched",
        message="the line touches the circle: both intersections are one point, and Q chooses nothing",
        help="a value slightly different splits it in two or loses it: check that tangency is meant",
        source=_DERIVED,
        about=RemarkKind.TOUCHES,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G1 X-50 Y50 ,A180 Q-1",),
    ),
    Rule(
        code="nct-double",
        message="{subject}: two contours have become one, because an element just touches; a small change parts them",
        help="check that it is meant to touch",
        source=Source("contoursolve", "further facts", Evidence.ASSUMED),
        about=RemarkKind.DOUBLE,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(_START + "G3 X? Y50 R50 (contoursolve: X of C = 0)\n" + _LINE,),
    ),
    Rule(
        code="nct-radius-too-small",
        message="{words}: the radius of {actual} is less than half the distance from the start to the "
        "point, {limit}: no circle passes through both",
        help="write at least {limit}",
        source=_manual("16.3.3, p. 129; alarm 3012", Evidence.DERIVED),
        alarm=Alarm("3012 ERRONEOUS CIRCLE DEF. R", Evidence.ASSUMED),
        about=RefusalKind.RADIUS_TOO_SMALL,
        accepted=(_GOOD,),
        rejected=(_START + "G3 X-50 Y0 R40\n" + _LINE,),
    ),
    Rule(
        code="nct-circle-degenerate",
        message="{words} define no circle: the radius is 0, or the point is the start point",
        help="give a centre away from the start, or a point away from it",
        source=_manual("alarm 3012: end equals start"),
        alarm=_CIRCLE_R,
        about=RefusalKind.CIRCLE_UNDEFINED,
        accepted=(_GOOD, _CENTERED),
        rejected=(_START + "G3 X50 Y0 R40\n" + _LINE, _START + "G3 I0 J0\n" + _LINE),
    ),
    Rule(
        code="nct-radius-difference",
        message="{words}: start and point differ in their distance from the centre by {off}, allowed {limit}",
        help="correct the point or the centre; the point may be left out",
        source=_manual("alarm 3011; the allowed difference is a machine parameter", Evidence.ASSUMED),
        alarm=Alarm("3011 RADIUS DIFFERENCE", Evidence.PRINTED),
        about=RefusalKind.RADIUS_DIFFERENCE,
        accepted=(_START + "G3 X-50 Y0 I-50 J0\n" + _LINE,),
        rejected=(_START + "G3 X-50 Y2 I-50 J0\n" + _LINE, _START + "G3 X-49 Y0 I-50 J0\n" + _LINE),
    ),
    Rule(
        code="nct-radius-differs",
        message="{words}: start and point differ in their distance from the centre by {off}, within the "
        "control's {limit}; the start counts",
        help="correct the point or leave it out",
        source=_manual("alarm 3011; the allowed difference is a machine parameter", Evidence.ASSUMED),
        severity=Severity.INFO,
        about=RemarkKind.RADIUS_DIFFERS,
        accepted=(_START + "G3 X-50 Y0 I-50 J0\n" + _LINE,),
        rejected=(_START + "G3 X-49.995 Y0 I-50 J0\n" + _LINE,),
    ),
    Rule(
        code="nct-reversed",
        message="the line would run against {words}: its end lies {off} behind the intersection; the control "
        "gives no alarm and makes the wrong motion",
        help="write {expected} at ,A, which also exchanges the meanings of Q, or move the end point",
        source=_manual("16.3.3, p. 129: movements contrary to programmer's needs"),
        about=RefusalKind.LINE_REVERSED,
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G1 X-50 Y42.857 ,A-8.13 Q-1",),
    ),
    Rule(
        code="nct-arc-empty",
        message="the intersection is the start point of the arc: no arc, or a full circle, would be cut",
        help="choose the other point by Q, or drop the arc",
        source=_ASSUMED,
        about=RefusalKind.ARC_EMPTY,
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G1 X90 Y0 ,A0 Q1",),
    ),
)
