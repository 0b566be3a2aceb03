"""NCT 99M, chapter 16: which words may be combined, and what has no solution."""

from dataclasses import replace
from decimal import Decimal

from contoursolve.controls.chain.language import (
    ALONE,
    ARC,
    CIRCLE_CIRCLE,
    CIRCLE_LINE,
    FOLLOWED,
    LAST,
    LINE,
    LINE_CIRCLE,
    LINE_LINE,
    ONLY,
    ORDINARY,
    OTHER_PLANE,
    OTHER_ZERO,
    OVER_CIRCLE,
    OVER_LINE,
    RAPID,
    STATED_CENTER,
    STATED_POINT,
)
from contoursolve.controls.geometry_rules import ANGLE_RANGE, COMMA_MISSING, PLANE_CHANGES, ZERO_MOVES, told
from contoursolve.controls.nct_99m.lexicon import BESIDE, BOOK, SINGLE_BLOCK, UNCOMPENSATED
from contoursolve.diagnostics import Alarm, Evidence, Severity, Source
from contoursolve.reading import Rule, Value, all_of, at_most, some

_ANY = (LINE, ARC, OVER_LINE, OVER_CIRCLE)
_OVER = (OVER_LINE, OVER_CIRCLE)
_CHOOSING = (LINE_CIRCLE, CIRCLE_LINE, CIRCLE_CIRCLE)

_START = "G17 G90 G0 X90 Y0\nG42 G1 X50 D0\n"
_ARC = "G3 X-50 Y0 R50\n"
_LINE = "G1 X-50 Y42.857 ,A171.87 Q-1"
_GOOD = _START + _ARC + _LINE
_CENTERED = _START + "G3 I-50 J0\n" + _LINE
_LINES = "G17 G90 G41 G0 X90 Y10 D0\nG1 ,A150\nG1 X10 Y20 ,A225"
_TO_CIRCLE = "G17 G90 G42 G0 X100 Y20 D0\nG1 X-30 Y-20\nG3 X20 Y40 I20 J-10 R50 Q-1"
_CIRCLES = _START + "G3 X-50 Y0 I-50 J0\nG3 X-40 Y60 I-40 J20 R40 Q-1"
_CUT = "G17 G90 G0 X0 Y0\nG1 X30 ,C10\nX40 Y40"
_ROUNDED = "G17 G90 G0 X0 Y0\nG1 X30 ,R8\nG3 X0 Y30 R30"
_BY_ANGLE = "G17 G90 G0 X0 Y0\nG1 X30 ,A45"


_GEOMETRY = BOOK.derived("16.3: on no page seen")
_ASSUMED = BOOK.assumed("16.3: not described")
_CIRCLE = Alarm("3014 ERRONEOUS CIRCLE DEF.", Evidence.PRINTED)
_CIRCLE_R = Alarm("3012 ERRONEOUS CIRCLE DEF. R", Evidence.PRINTED)
_CORNERS = Alarm("3081 DEFINITION ERROR ,C ,R", Evidence.PRINTED)
_TOO_HIGH = Alarm("3084 ,C ,R TOO HIGH", Evidence.PRINTED)

COMBINATION_RULES = (
    Rule(
        code="nct-compensation-off",
        message="{words}: the control computes intersections only with G41 or G42 active before the first of the two "
        "blocks",
        help="switch G41 or G42 on before that block; D00 keeps the path where it is",
        source=BOOK.assumed("16.3: every format and example has it"),
        roles=_OVER,
        when=some(",A", "R") & some(UNCOMPENSATED),
        accepted=(_GOOD, _TO_CIRCLE),
        rejected=(
            _GOOD.replace("G42 ", ""),
            _TO_CIRCLE.replace("G42 ", ""),
            _GOOD.replace("G42 ", "").replace(_LINE, "G42 " + _LINE),
        ),
    ),
    Rule(
        code="nct-nothing-before",
        message="{words}: this block begins in an intersection; but right before it there is no G1, G2 or G3 block",
        help="put the element that it shall meet right before it; or drop ,A of a line, or the centre or R of an arc",
        source=BOOK.printed("16.3: consecutive blocks"),
        roles=(*_OVER, LINE, ARC),
        when=some(",A", "R") & some(ALONE),
        accepted=(_GOOD, _LINES),
        rejected=(
            _START + "M8\n" + _LINE,
            "G17 G90 G41 G0 X50 Y0\n" + _LINE,
            "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 I0 J0 R50",
        ),
    ),
    Rule(
        code="nct-line-rapid",
        message="{words}: a line that begins in an intersection must be a G1 block, not G0",
        help="write G1",
        source=BOOK.derived("16.3: the formats"),
        roles=(OVER_LINE,),
        when=some(",A") & some(RAPID),
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G0 X-50 Y42.857 ,A171.87 Q-1",),
    ),
    Rule(
        code="nct-q-missing",
        message="Q is missing: the two elements meet twice, and only Q's sign tells which point is meant",
        help="add Q-1 or Q1: along a line Q-1 is the nearer point, Q1 the farther one",
        source=_ASSUMED,
        roles=_CHOOSING,
        when=~some("2:Q"),
        is_about_choice=True,
        accepted=(_GOOD, _TO_CIRCLE),
        rejected=(_START + _ARC + "G1 X-50 Y42.857 ,A171.87", _TO_CIRCLE.replace(" Q-1", "")),
    ),
    Rule(
        code="nct-line-incomplete",
        message="{words} chooses an intersection, but this line begins in none: {lacking} is missing",
        help="add {lacking}: a line that begins in an intersection has both coordinates of its end and ,A; or delete "
        "{words}, and the line begins where the block before it ends",
        source=BOOK.derived("16.3: the formats"),
        roles=(OVER_LINE,),
        when=some("Q") & ~all_of("first", "second", ",A"),
        accepted=(_GOOD,),
        rejected=(_GOOD.replace(",A171.87 ", ""), _GOOD.replace("Y42.857 ", "")),
    ),
    Rule(
        code="nct-circle-incomplete",
        message="{words} chooses an intersection, but this arc begins in none: {lacking} is missing",
        help="add {lacking}: an arc that begins in an intersection has its end, its centre and R; or delete {words}, "
        "and the arc begins where the block before it ends",
        source=BOOK.derived("p. 128, 16.3.2"),
        roles=(OVER_CIRCLE,),
        when=some("Q") & ~all_of("first", "second", *STATED_CENTER, "R"),
        accepted=(_TO_CIRCLE,),
        rejected=tuple(_TO_CIRCLE.replace(word, "") for word in (" R50", " J-10", " X20")),
    ),
    Rule(
        code="nct-q-zero",
        message="{words} has no sign, and only Q's sign tells which point is meant",
        help="write Q-1 or Q1: along a line Q-1 is the nearer point, Q1 the farther one",
        source=_ASSUMED,
        roles=_CHOOSING,
        when=Value(("2:Q",), excluding=Decimal(0)),
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G1 X-50 Y42.857 ,A171.87 Q0", _TO_CIRCLE.replace("Q-1", "Q0")),
    ),
    Rule(
        code="nct-q-unused",
        message="{words}: two lines meet in one point, so Q chooses nothing",
        help="delete it",
        source=BOOK.printed("16.3.1, p. 123"),
        severity=Severity.WARNING,
        roles=(LINE_LINE,),
        when=some("2:Q"),
        accepted=(_LINES,),
        rejected=(_LINES + " Q1",),
    ),
    Rule(
        code="nct-circle-undefined",
        message="the arc has neither a centre nor a radius",
        help="add the centre's two distances from the start point, or R with a point",
        source=BOOK.printed("p. 26 (4.3): alarm 3014"),
        alarm=_CIRCLE,
        roles=(ARC,),
        when=at_most(0, STATED_CENTER, "R"),
        accepted=(_GOOD, _CENTERED),
        rejected=(_START + "G3 X-50 Y0\n" + _LINE,),
    ),
    Rule(
        code="nct-center-and-radius",
        message="{words}: the arc has both a centre and a radius",
        help="keep one of them; to begin it in an intersection (16.3), give its end, its centre (absolute), R and Q",
        source=BOOK.printed("16.3.3, p. 129"),
        roles=(ARC,),
        when=all_of(STATED_CENTER, "R") & ~some(ALONE),
        accepted=(_GOOD, _CENTERED, _TO_CIRCLE),
        rejected=(_START + "G3 X-50 I-50 J0 R50\n" + _LINE,),
    ),
    Rule(
        code="nct-radius-without-point",
        message="{words}: with R the arc needs a point of the circle",
        help="add the coordinates of a point, or give the centre instead",
        source=BOOK.printed("p. 26 (4.3): alarm 3012"),
        alarm=_CIRCLE_R,
        roles=(ARC,),
        when=some("R") & ~some(*STATED_POINT),
        accepted=(_GOOD,),
        rejected=(_START + "G3 R50\n" + _LINE,),
    ),
    Rule(
        code="nct-radius-zero",
        message="{words}: a circle of radius 0 meets nothing",
        help="write the radius",
        source=_ASSUMED,
        roles=(ARC, OVER_CIRCLE),
        when=Value(("R",), excluding=Decimal(0)),
        accepted=(_GOOD,),
        rejected=(_START + "G3 X-50 Y0 R0\n" + _LINE,),
    ),
    Rule(
        code="nct-center-outside-plane",
        message="{words} lies outside the selected plane",
        help="G17 takes I and J, G18 takes I and K, G19 takes J and K",
        source=BOOK.printed("p. 26 (4.3): alarm 3014"),
        alarm=_CIRCLE,
        roles=(ARC, OVER_CIRCLE),
        when=some("wrong-center"),
        accepted=(_CENTERED,),
        rejected=(_START + "G3 I-50 K0\n" + _LINE,),
    ),
    Rule(
        code="nct-center-on-line",
        message="{words}: a line has no centre and no radius",
        help="delete it; a rounding is ,R",
        source=BOOK.derived("16.3: the formats"),
        roles=(LINE, OVER_LINE),
        when=some(*STATED_CENTER, "wrong-center", "R"),
        accepted=(_GOOD,),
        rejected=(_GOOD + " R5",),
    ),
    Rule(
        code="nct-q-without-intersection",
        message="{words}: this block does not begin in a computed intersection, so Q chooses nothing",
        help="delete it; a line with both coordinates and ,A begins in an intersection; so does an arc with end, "
        "centre and R",
        source=BOOK.derived("16.3: the formats"),
        roles=(LINE, ARC),
        when=some("Q") & ~some(ALONE),
        accepted=(_GOOD,),
        rejected=(_START + "G3 X-50 Y0 R50 Q1\n" + _LINE, _BY_ANGLE + " Q1"),
    ),
    Rule(
        code="nct-angle-on-arc",
        message="{words}: an arc has no angle",
        help="delete it",
        source=BOOK.derived("16.3: the formats"),
        roles=(ARC, OVER_CIRCLE),
        when=some(",A"),
        accepted=(_GOOD,),
        rejected=(_START + "G3 X-50 Y0 R50 ,A90\n" + _LINE,),
    ),
    Rule(
        code="nct-angle-range",
        message=ANGLE_RANGE[0],
        help=ANGLE_RANGE[1],
        source=BOOK.assumed("16.2, 16.3: the range of ,A is not on the pages that we have"),
        severity=Severity.WARNING,
        roles=(LINE, OVER_LINE),
        when=Value((",A",), least=Decimal(-360), most=Decimal(360)),
        accepted=(_BY_ANGLE, _BY_ANGLE.replace(",A45", ",A-315")),
        rejected=(_BY_ANGLE.replace(",A45", ",A405"), _GOOD.replace(",A171.87", ",A-548.13")),
    ),
    Rule(
        code="nct-direction-twice",
        message="{words}: the next block begins in an intersection, where this line ends; its direction is given by ,A "
        "and by a point",
        help="keep ,A alone, or the point alone",
        source=BOOK.derived("16.3.1: the formats of N1"),
        roles=(LINE,),
        when=all_of(",A", STATED_POINT) & some(FOLLOWED),
        accepted=(_LINES, _LINES.replace("G1 ,A150", "G1 X50 Y33.094")),
        rejected=(_LINES.replace("G1 ,A150", "G1 X50 ,A150"),),
    ),
    Rule(
        code="nct-line-undefined",
        message="the line has neither ,A nor a point, and it ends in an intersection: nothing tells where it runs",
        help="add ,A or a point of the line",
        source=BOOK.derived("16.3.1: the formats of N1"),
        roles=(LINE,),
        when=at_most(0, ",A", STATED_POINT) & some(FOLLOWED),
        accepted=(_LINES,),
        rejected=(_LINES.replace("G1 ,A150", "G1 ,C5"),),
    ),
    Rule(
        code="nct-coordinate-missing",
        message="{words} alone does not say where the line ends",
        help="add one coordinate of its end; or, if it shall end in an intersection, over-define the next block: a "
        "line by both coordinates and ,A, an arc by its end, its centre and R",
        source=BOOK.printed("16.2, p. 120"),
        roles=(LINE,),
        when=some(",A") & ~some(*STATED_POINT) & ~some(FOLLOWED),
        accepted=(_BY_ANGLE, _LINES),
        rejected=("G17 G90 G0 X0 Y0\nG1 ,A45", _LINES.replace("Y20 ", "")),
    ),
    Rule(
        code="nct-two-corners",
        message="{words}: a block takes ,C or ,R, not both",
        help="keep one of them",
        source=BOOK.printed("16.1; alarm 3017"),
        alarm=Alarm("3017 ,C AND ,R IN ONE BLOCK", Evidence.PRINTED),
        roles=_ANY,
        when=all_of(",C", ",R"),
        note=SINGLE_BLOCK,
        accepted=(_CUT, _ROUNDED),
        rejected=(_CUT.replace(",C10", ",C10 ,R5"),),
    ),
    Rule(
        code="nct-corner-without-next",
        message="{words}: a corner needs an element after it, and no G1, G2 or G3 block follows",
        help="put the next element right after it, or delete it",
        source=BOOK.printed("16.1; alarm 3081"),
        alarm=_CORNERS,
        roles=_ANY,
        when=some(",C", ",R") & some(LAST),
        note=SINGLE_BLOCK,
        accepted=(_CUT,),
        rejected=("G17 G90 G0 X0 Y0\nG1 X30 ,C10\nM8\nX40 Y40", "G17 G90 G0 X0 Y0\nG1 X30 ,R5\nG0 X40 Y40"),
    ),
    Rule(
        code="nct-corner-negative",
        message="{words}: a chamfer or a rounding has no sign",
        help="delete the minus sign: the elements tell on which side the corner lies",
        source=BOOK.assumed("16.1: not described"),
        roles=_ANY,
        when=Value((",C", ",R"), least=Decimal(0)),
        note=SINGLE_BLOCK,
        accepted=(_CUT,),
        rejected=(_CUT.replace(",C10", ",C-10"),),
    ),
    Rule(
        code="nct-corner-outside-plane",
        message="{words}: a corner lies in the plane, but the block moves an axis outside it",
        help="move that axis in a block of its own",
        source=BOOK.printed("16.1; alarm 3081"),
        alarm=_CORNERS,
        roles=_ANY,
        when=some(*BESIDE) & some(",C", ",R"),
        note=SINGLE_BLOCK,
        accepted=(_CUT,),
        rejected=(_CUT.replace("G1 X30", "G1 X30 Z-5"),),
    ),
    Rule(
        code="nct-axis-outside-plane",
        message="{words} moves an axis outside the plane of the contour",
        help="move that axis in a block of its own; only a line by one coordinate and ,A may have one such word",
        source=_ASSUMED,
        roles=_ANY,
        when=some(*BESIDE) & ~some(ORDINARY) & ~some(",C", ",R") & ~(some(",A") & some(ONLY) & at_most(1, *BESIDE)),
        accepted=(_GOOD, _BY_ANGLE + " Z-5", _BY_ANGLE + " W-5"),
        rejected=(_GOOD + " Z-5", _BY_ANGLE + " Z-5 W-5", _CUT + " Z-5"),
    ),
    Rule(
        code="nct-plane-changes",
        message=PLANE_CHANGES[0],
        help=PLANE_CHANGES[1],
        source=BOOK.derived("16.3: in one plane"),
        roles=_ANY,
        when=some(OTHER_PLANE),
        accepted=(_GOOD,),
        rejected=(_START + _ARC + "G18 G1 X-50 Z42.857 ,A171.87 Q-1",),
    ),
    Rule(
        code="nct-zero-moves",
        message=ZERO_MOVES[0],
        help=ZERO_MOVES[1],
        source=_ASSUMED,
        roles=_ANY,
        when=some(OTHER_ZERO),
        accepted=(_GOOD,),
        rejected=(_CUT.replace("X40", "G55 X40"),),
    ),
)

GEOMETRY_RULES = (
    replace(COMMA_MISSING, code="nct-comma-missing", source=BOOK.printed("16.1, 16.2: ,A ,C ,R have a comma")),
    told(
        "nct-point-is-start",
        _LINES.replace("G1 ,A150", "G1 X50 Y33.094"),
        _LINES.replace("G1 ,A150", "G1 X90 Y10"),
        _TO_CIRCLE.replace("X-30 Y-20", "X100 Y20"),
        message="{words}: this point of the line is its start point, so it gives the line no direction",
        help="give another point of the line, or ,A alone",
        source=BOOK.printed("16.3.1, p. 123"),
    ),
    told("nct-circle-missed", _GOOD, _START + _ARC + "G1 X-50 Y80 ,A180 Q-1", source=_GEOMETRY),
    told(
        "nct-circle-touched",
        _GOOD,
        _START + _ARC + "G1 X-50 Y50 ,A180 Q-1",
        source=BOOK.derived("16.3.3, p. 129"),
        message="{subject}: two elements only touch, so that both intersections are one point and Q chooses nothing",
    ),
    told(
        "nct-double",
        _GOOD,
        _START + "G3 X? Y50 R50 (contoursolve: X of C = 0)\n" + _LINE,
        source=Source("contoursolve", "further facts", Evidence.ASSUMED),
    ),
    told(
        "nct-radius-too-small",
        _GOOD,
        _START + "G3 X-50 Y0 R40\n" + _LINE,
        message="{words}: the radius of {actual} is less than half the distance from the start to the "
        "point, {limit}: no circle passes through both",
        help="write at least {limit}",
        source=BOOK.derived("p. 25: R; no alarm is printed for it"),
    ),
    told(
        "nct-circle-degenerate",
        (_GOOD, _CENTERED),
        _START + "G3 X50 Y0 R40\n" + _LINE,
        _START + "G3 I0 J0\n" + _LINE,
        message="{words} {define} no circle: the radius is 0, or the point is the start point",
        help="give a centre away from the start, or a point away from it",
        source=BOOK.printed("p. 26 (4.3): alarm 3012, end equals start"),
        alarm=_CIRCLE_R,
    ),
    told(
        "nct-radius-difference",
        _START + "G3 X-50 Y0 I-50 J0\n" + _LINE,
        _START + "G3 X-50 Y2 I-50 J0\n" + _LINE,
        _START + "G3 X-49 Y0 I-50 J0\n" + _LINE,
        message="{words}: the arc has a radius of {radius}, and one of its points is {distance} from its centre; "
        "that differs by {off}, allowed {limit}",
        help="correct the point, the centre or the radius; a centre counts from where the arc begins, but that of an "
        "arc that begins in an intersection is absolute",
        source=BOOK.assumed("p. 26 (4.3): alarm 3011; the allowed difference is a machine parameter"),
        alarm=Alarm("3011 RADIUS DIFFERENCE", Evidence.PRINTED),
    ),
    told(
        "nct-radius-differs",
        _START + "G3 X-50 Y0 I-50 J0\n" + _LINE,
        _START + "G3 X-49.995 Y0 I-50 J0\n" + _LINE,
        source=BOOK.assumed("p. 26 (4.3): alarm 3011; the allowed difference is a machine parameter"),
        message="{words}: two points of the arc differ in their distance from the centre by {off}, within the "
        "control's {limit}",
    ),
    told(
        "nct-half-circle",
        _GOOD,
        _START + "G3 X-50 Y0 R49.9995\n" + _LINE,
        source=BOOK.assumed("16.3.3, p. 130: an example of this shape; that the increments count"),
    ),
    told(
        "nct-reversed",
        _GOOD,
        _START + _ARC + "G1 X-50 Y42.857 ,A-8.13 Q-1",
        message="{words} points away from the end of the line, which lies {off} behind its start; the control "
        "gives no alarm and makes the wrong motion",
        help="check the signs: as its ends lie, the line would run at {expected}; next to a circle the other angle "
        "also exchanges the meanings of Q",
        source=BOOK.printed("16.3.3, p. 129: movements contrary to programmer's needs"),
    ),
    told(
        "nct-arc-empty",
        _GOOD,
        _START + _ARC + "G1 X90 Y0 ,A0 Q1",
        source=_ASSUMED,
        help="choose the other point by Q, or drop the arc",
    ),
    told("nct-circles-apart", _CIRCLES, ("I-40 J20 R40", "I-40 J160 R40"), source=_GEOMETRY),
    told(
        "nct-backwards",
        _LINES,
        _LINES.replace("G1 ,A150", "G1 X130 Y-13.094"),
        message="{subject} would run backwards: the intersection lies {off} behind where it begins",
        help="choose the other point by Q, or move the point of the line",
        source=BOOK.assumed("16.3.1: the line runs towards its point"),
    ),
    told("nct-parallel", _LINES, (",A225", ",A150"), source=_GEOMETRY),
    told("nct-not-fixed", _BY_ANGLE, "G17 G90 G0 X0 Y0\nG1 X0 ,A90", source=BOOK.derived("16.2")),
    told(
        "nct-corner-too-large",
        (_CUT, _ROUNDED),
        (",C10", ",C31"),
        _ROUNDED.replace(",R8", ",R40"),
        source=BOOK.printed("16.1; alarm 3084"),
        alarm=_TOO_HIGH,
        note=SINGLE_BLOCK,
    ),
    told(
        "nct-corners-overlap",
        _CUT,
        "G17 G90 G0 X0 Y0\nG1 X30 ,C20\nY30 ,C20\nX60",
        source=BOOK.derived("16.1; alarm 3084"),
        alarm=_TOO_HIGH,
        note=SINGLE_BLOCK,
    ),
    told(
        "nct-no-corner",
        _CUT,
        ("X40 Y40", "X60"),
        source=BOOK.assumed("16.1: not described"),
    ),
    told(
        "nct-corner-reverses",
        _CUT,
        ("X40 Y40", "X10"),
        source=BOOK.assumed("16.1: not described"),
    ),
)
