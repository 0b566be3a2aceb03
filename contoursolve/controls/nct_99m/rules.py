"""NCT 99M, chapter 16: which words may be combined, and what has no solution."""

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
from contoursolve.controls.geometry_rules import ANGLE_RANGE, GENERAL, PLANE_CHANGES, ZERO_MOVES
from contoursolve.controls.nct_99m.lexicon import BESIDE, BOOK, SINGLE_BLOCK, UNCOMPENSATED
from contoursolve.controls.rule_rows import row
from contoursolve.diagnostics import Alarm, Evidence, Severity, Source
from contoursolve.reading import Value, all_of, at_most, some

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
    row("nct-compensation-off",
        "{words}: the control computes intersections only with G41 or G42 active before the first of the two blocks",
        "switch G41 or G42 on before that block; D00 keeps the path where it is",
        BOOK.assumed("16.3: every format and example has it"), some(",A", "R") & some(UNCOMPENSATED),
        ((_GOOD, _TO_CIRCLE), ("G42 ", ""), _TO_CIRCLE.replace("G42 ", ""),
         _GOOD.replace("G42 ", "").replace(_LINE, "G42 " + _LINE)), _OVER),
    row("nct-nothing-before",
        "{words}: this block begins in an intersection; but right before it there is no G1, G2 or G3 block",
        "put the element that it shall meet right before it; or drop ,A of a line, or the centre or R of an arc",
        BOOK.printed("16.3: consecutive blocks"), some(",A", "R") & some(ALONE),
        ((_GOOD, _LINES), _START + "M8\n" + _LINE, "G17 G90 G41 G0 X50 Y0\n" + _LINE,
         "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 I0 J0 R50"), (*_OVER, LINE, ARC)),
    row("nct-line-rapid", "{words}: a line that begins in an intersection must be a G1 block, not G0", "write G1",
        BOOK.derived("16.3: the formats"), some(",A") & some(RAPID),
        (_GOOD, _START + _ARC + "G0 X-50 Y42.857 ,A171.87 Q-1"), (OVER_LINE,)),
    row("nct-q-missing", "Q is missing: the two elements meet twice, and only Q's sign tells which point is meant",
        "add Q-1 or Q1: along a line Q-1 is the nearer point, Q1 the farther one", _ASSUMED, ~some("2:Q"),
        ((_GOOD, _TO_CIRCLE), _START + _ARC + "G1 X-50 Y42.857 ,A171.87", _TO_CIRCLE.replace(" Q-1", "")), _CHOOSING,
        is_about_choice=True),
    row("nct-line-incomplete", "{words} chooses an intersection, but this line begins in none: {lacking} is missing",
        "add {lacking}: a line that begins in an intersection has both coordinates of its end and ,A; or delete "
        "{words}, and the line begins where the block before it ends", BOOK.derived("16.3: the formats"),
        some("Q") & ~all_of("first", "second", ",A"), (_GOOD, (",A171.87 ", ""), ("Y42.857 ", "")), (OVER_LINE,)),
    row("nct-circle-incomplete", "{words} chooses an intersection, but this arc begins in none: {lacking} is missing",
        "add {lacking}: an arc that begins in an intersection has its end, its centre and R; or delete {words}, and "
        "the arc begins where the block before it ends", BOOK.derived("p. 128, 16.3.2"),
        some("Q") & ~all_of("first", "second", *STATED_CENTER, "R"),
        (_TO_CIRCLE, *((word, "") for word in (" R50", " J-10", " X20"))), (OVER_CIRCLE,)),
    row("nct-q-zero", "{words} has no sign, and only Q's sign tells which point is meant",
        "write Q-1 or Q1: along a line Q-1 is the nearer point, Q1 the farther one", _ASSUMED,
        Value(("2:Q",), excluding=Decimal(0)),
        (_GOOD, _START + _ARC + "G1 X-50 Y42.857 ,A171.87 Q0", _TO_CIRCLE.replace("Q-1", "Q0")), _CHOOSING),
    row("nct-q-unused", "{words}: two lines meet in one point, so Q chooses nothing", "delete it",
        BOOK.printed("16.3.1, p. 123"), some("2:Q"), (_LINES, _LINES + " Q1"), (LINE_LINE,), severity=Severity.WARNING),
    row("nct-circle-undefined", "the arc has neither a centre nor a radius",
        "add the centre's two distances from the start point, or R with a point",
        BOOK.printed("p. 26 (4.3): alarm 3014"), at_most(0, STATED_CENTER, "R"),
        ((_GOOD, _CENTERED), _START + "G3 X-50 Y0\n" + _LINE), (ARC,), alarm=_CIRCLE),
    row("nct-center-and-radius", "{words}: the arc has both a centre and a radius",
        "keep one of them; to begin it in an intersection (16.3), give its end, its centre (absolute), R and Q",
        BOOK.printed("16.3.3, p. 129"), all_of(STATED_CENTER, "R") & ~some(ALONE),
        ((_GOOD, _CENTERED, _TO_CIRCLE), _START + "G3 X-50 I-50 J0 R50\n" + _LINE), (ARC,)),
    row("nct-radius-without-point", "{words}: with R the arc needs a point of the circle",
        "add the coordinates of a point, or give the centre instead", BOOK.printed("p. 26 (4.3): alarm 3012"),
        some("R") & ~some(*STATED_POINT), (_GOOD, _START + "G3 R50\n" + _LINE), (ARC,), alarm=_CIRCLE_R),
    row("nct-radius-zero", "{words}: a circle of radius 0 meets nothing", "write the radius", _ASSUMED,
        Value(("R",), excluding=Decimal(0)), (_GOOD, _START + "G3 X-50 Y0 R0\n" + _LINE), (ARC, OVER_CIRCLE)),
    row("nct-center-outside-plane", "{words} lies outside the selected plane",
        "G17 takes I and J, G18 takes I and K, G19 takes J and K", BOOK.printed("p. 26 (4.3): alarm 3014"),
        some("wrong-center"), (_CENTERED, _START + "G3 I-50 K0\n" + _LINE), (ARC, OVER_CIRCLE), alarm=_CIRCLE),
    row("nct-center-on-line", "{words}: a line has no centre and no radius", "delete it; a rounding is ,R",
        BOOK.derived("16.3: the formats"), some(*STATED_CENTER, "wrong-center", "R"), (_GOOD, _GOOD + " R5"),
        (LINE, OVER_LINE)),
    row("nct-q-without-intersection",
        "{words}: this block does not begin in a computed intersection, so Q chooses nothing",
        "delete it; a line with both coordinates and ,A begins in an intersection; so does an arc with end, centre and "
        "R", BOOK.derived("16.3: the formats"), some("Q") & ~some(ALONE),
        (_GOOD, _START + "G3 X-50 Y0 R50 Q1\n" + _LINE, _BY_ANGLE + " Q1"), (LINE, ARC)),
    row("nct-angle-on-arc", "{words}: an arc has no angle", "delete it", BOOK.derived("16.3: the formats"), some(",A"),
        (_GOOD, _START + "G3 X-50 Y0 R50 ,A90\n" + _LINE), (ARC, OVER_CIRCLE)),
    row("nct-angle-range", *ANGLE_RANGE, BOOK.assumed("16.2, 16.3: the range of ,A is not on the pages that we have"),
        Value((",A",), least=Decimal(-360), most=Decimal(360)),
        ((_BY_ANGLE, _BY_ANGLE.replace(",A45", ",A-315")), (",A45", ",A405"), _GOOD.replace(",A171.87", ",A-548.13")),
        (LINE, OVER_LINE), severity=Severity.WARNING),
    row("nct-direction-twice",
        "{words}: the next block begins in an intersection, where this line ends; its direction is given by ,A and by "
        "a point", "keep ,A alone, or the point alone", BOOK.derived("16.3.1: the formats of N1"),
        all_of(",A", STATED_POINT) & some(FOLLOWED),
        ((_LINES, _LINES.replace("G1 ,A150", "G1 X50 Y33.094")), ("G1 ,A150", "G1 X50 ,A150")), (LINE,)),
    row("nct-line-undefined",
        "the line has neither ,A nor a point, and it ends in an intersection: nothing tells where it runs",
        "add ,A or a point of the line", BOOK.derived("16.3.1: the formats of N1"),
        at_most(0, ",A", STATED_POINT) & some(FOLLOWED), (_LINES, ("G1 ,A150", "G1 ,C5")), (LINE,)),
    row("nct-coordinate-missing", "{words} alone does not say where the line ends",
        "add one coordinate of its end; or, if it shall end in an intersection, over-define the next block: a line by "
        "both coordinates and ,A, an arc by its end, its centre and R", BOOK.printed("16.2, p. 120"),
        some(",A") & ~some(*STATED_POINT) & ~some(FOLLOWED),
        ((_BY_ANGLE, _LINES), "G17 G90 G0 X0 Y0\nG1 ,A45", _LINES.replace("Y20 ", "")), (LINE,)),
    row("nct-two-corners", "{words}: a block takes ,C or ,R, not both", "keep one of them",
        BOOK.printed("16.1; alarm 3017"), all_of(",C", ",R"), ((_CUT, _ROUNDED), (",C10", ",C10 ,R5")), _ANY,
        alarm=Alarm("3017 ,C AND ,R IN ONE BLOCK", Evidence.PRINTED), note=SINGLE_BLOCK),
    row("nct-corner-without-next", "{words}: a corner needs an element after it, and no G1, G2 or G3 block follows",
        "put the next element right after it, or delete it", BOOK.printed("16.1; alarm 3081"),
        some(",C", ",R") & some(LAST),
        (_CUT, "G17 G90 G0 X0 Y0\nG1 X30 ,C10\nM8\nX40 Y40", "G17 G90 G0 X0 Y0\nG1 X30 ,R5\nG0 X40 Y40"), _ANY,
        alarm=_CORNERS, note=SINGLE_BLOCK),
    row("nct-corner-negative", "{words}: a chamfer or a rounding has no sign",
        "delete the minus sign: the elements tell on which side the corner lies", BOOK.assumed("16.1: not described"),
        Value((",C", ",R"), least=Decimal(0)), (_CUT, (",C10", ",C-10")), _ANY, note=SINGLE_BLOCK),
    row("nct-corner-outside-plane", "{words}: a corner lies in the plane, but the block moves an axis outside it",
        "move that axis in a block of its own", BOOK.printed("16.1; alarm 3081"), some(*BESIDE) & some(",C", ",R"),
        (_CUT, ("G1 X30", "G1 X30 Z-5")), _ANY, alarm=_CORNERS, note=SINGLE_BLOCK),
    row("nct-axis-outside-plane", "{words} moves an axis outside the plane of the contour",
        "move that axis in a block of its own; only a line by one coordinate and ,A may have one such word", _ASSUMED,
        some(*BESIDE) & ~some(ORDINARY) & ~some(",C", ",R") & ~(some(",A") & some(ONLY) & at_most(1, *BESIDE)),
        ((_GOOD, _BY_ANGLE + " Z-5", _BY_ANGLE + " W-5"), _GOOD + " Z-5", _BY_ANGLE + " Z-5 W-5", _CUT + " Z-5"), _ANY),
    row("nct-plane-changes", *PLANE_CHANGES, BOOK.derived("16.3: in one plane"), some(OTHER_PLANE),
        (_GOOD, _START + _ARC + "G18 G1 X-50 Z42.857 ,A171.87 Q-1"), _ANY),
    row("nct-zero-moves", *ZERO_MOVES, _ASSUMED, some(OTHER_ZERO), (_GOOD, _CUT.replace("X40", "G55 X40")), _ANY),
)  # fmt: skip

GEOMETRY_RULES = (
    row("nct-comma-missing", like=GENERAL, source=BOOK.printed("16.1, 16.2: ,A ,C ,R have a comma")),
    row("nct-point-is-start", like=GENERAL,
        message="{words}: this point of the line is its start point, so it gives the line no direction",
        help="give another point of the line, or ,A alone", source=BOOK.printed("16.3.1, p. 123"),
        examples=(_LINES.replace("G1 ,A150", "G1 X50 Y33.094"), _LINES.replace("G1 ,A150", "G1 X90 Y10"),
         _TO_CIRCLE.replace("X-30 Y-20", "X100 Y20"))),
    row("nct-circle-missed", like=GENERAL, source=_GEOMETRY, examples=(_GOOD, _START + _ARC + "G1 X-50 Y80 ,A180 Q-1")),
    row("nct-circle-touched", like=GENERAL,
        message="{subject}: two elements only touch, so that both intersections are one point and Q chooses nothing",
        source=BOOK.derived("16.3.3, p. 129"), examples=(_GOOD, _START + _ARC + "G1 X-50 Y50 ,A180 Q-1")),
    row("nct-double", like=GENERAL, source=Source("contoursolve", "further facts", Evidence.ASSUMED),
        examples=(_GOOD, _START + "G3 X? Y50 R50 (contoursolve: X of C = 0)\n" + _LINE)),
    row("nct-radius-too-small", like=GENERAL,
        message="{words}: the radius of {actual} is less than half the distance from the start to the point, {limit}: "
        "no circle passes through both", help="write at least {limit}",
        source=BOOK.derived("p. 25: R; no alarm is printed for it"),
        examples=(_GOOD, _START + "G3 X-50 Y0 R40\n" + _LINE)),
    row("nct-circle-degenerate", like=GENERAL,
        message="{words} {define} no circle: the radius is 0, or the point is the start point",
        help="give a centre away from the start, or a point away from it",
        source=BOOK.printed("p. 26 (4.3): alarm 3012, end equals start"),
        examples=((_GOOD, _CENTERED), _START + "G3 X50 Y0 R40\n" + _LINE, _START + "G3 I0 J0\n" + _LINE),
        alarm=_CIRCLE_R),
    row("nct-radius-difference", like=GENERAL,
        message="{words}: the arc has a radius of {radius}, and one of its points is {distance} from its centre; that "
        "differs by {off}, allowed {limit}",
        help="correct the point, the centre or the radius; a centre counts from where the arc begins, but that of an "
        "arc that begins in an intersection is absolute",
        source=BOOK.assumed("p. 26 (4.3): alarm 3011; the allowed difference is a machine parameter"),
        examples=(_START + "G3 X-50 Y0 I-50 J0\n" + _LINE, _START + "G3 X-50 Y2 I-50 J0\n" + _LINE,
         _START + "G3 X-49 Y0 I-50 J0\n" + _LINE), alarm=Alarm("3011 RADIUS DIFFERENCE", Evidence.PRINTED)),
    row("nct-radius-differs", like=GENERAL,
        message="{words}: two points of the arc differ in their distance from the centre by {off}, within the "
        "control's {limit}",
        source=BOOK.assumed("p. 26 (4.3): alarm 3011; the allowed difference is a machine parameter"),
        examples=(_START + "G3 X-50 Y0 I-50 J0\n" + _LINE, _START + "G3 X-49.995 Y0 I-50 J0\n" + _LINE)),
    row("nct-half-circle", like=GENERAL,
        source=BOOK.assumed("16.3.3, p. 130: an example of this shape; that the increments count"),
        examples=(_GOOD, _START + "G3 X-50 Y0 R49.9995\n" + _LINE)),
    row("nct-reversed", like=GENERAL,
        message="{words} points away from the end of the line, which lies {off} behind its start; the control gives no "
        "alarm and makes the wrong motion",
        help="check the signs: as its ends lie, the line would run at {expected}; next to a circle the other angle "
        "also exchanges the meanings of Q",
        source=BOOK.printed("16.3.3, p. 129: movements contrary to programmer's needs"),
        examples=(_GOOD, _START + _ARC + "G1 X-50 Y42.857 ,A-8.13 Q-1")),
    row("nct-arc-empty", like=GENERAL, help="choose the other point by Q, or drop the arc", source=_ASSUMED,
        examples=(_GOOD, _START + _ARC + "G1 X90 Y0 ,A0 Q1")),
    row("nct-circles-apart", like=GENERAL, source=_GEOMETRY, examples=(_CIRCLES, ("I-40 J20 R40", "I-40 J160 R40"))),
    row("nct-backwards", like=GENERAL,
        message="{subject} would run backwards: the intersection lies {off} behind where it begins",
        help="choose the other point by Q, or move the point of the line",
        source=BOOK.assumed("16.3.1: the line runs towards its point"),
        examples=(_LINES, ("G1 ,A150", "G1 X130 Y-13.094"))),
    row("nct-parallel", like=GENERAL, source=_GEOMETRY, examples=(_LINES, (",A225", ",A150"))),
    row("nct-not-fixed", like=GENERAL, source=BOOK.derived("16.2"),
        examples=(_BY_ANGLE, "G17 G90 G0 X0 Y0\nG1 X0 ,A90")),
    row("nct-corner-too-large", like=GENERAL, source=BOOK.printed("16.1; alarm 3084"),
        examples=((_CUT, _ROUNDED), (",C10", ",C31"), _ROUNDED.replace(",R8", ",R40")), alarm=_TOO_HIGH,
        note=SINGLE_BLOCK),
    row("nct-corners-overlap", like=GENERAL, source=BOOK.derived("16.1; alarm 3084"),
        examples=(_CUT, "G17 G90 G0 X0 Y0\nG1 X30 ,C20\nY30 ,C20\nX60"), alarm=_TOO_HIGH, note=SINGLE_BLOCK),
    row("nct-no-corner", like=GENERAL, source=BOOK.assumed("16.1: not described"), examples=(_CUT, ("X40 Y40", "X60"))),
    row("nct-corner-reverses", like=GENERAL, source=BOOK.assumed("16.1: not described"),
        examples=(_CUT, ("X40 Y40", "X10"))),
)  # fmt: skip
