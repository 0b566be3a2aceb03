"""Mitsubishi: which words may be combined, and what has no solution. Alarm numbers but P33 are recalled."""

from decimal import Decimal

from contoursolve.controls.chain.language import (
    ARC,
    CENTER_AT,
    CIRCLE_CIRCLE,
    CIRCLE_LINE,
    FOLLOWED,
    LAST,
    LINE,
    LINE_CIRCLE,
    LINE_LINE,
    OTHER_PLANE,
    OTHER_ZERO,
    OVER_CIRCLE,
    OVER_LINE,
    RAPID,
    STATED_CENTER,
    STATED_POINT,
)
from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.geometry_rules import (
    ANGLE_RANGE,
    ANGLE_RAPID,
    GENERAL,
    GEOMETRY_RULES,
    PLANE_CHANGES,
    ZERO_MOVES,
)
from contoursolve.controls.mitsubishi.examples import WORDS
from contoursolve.controls.mitsubishi.language import (
    ALONG_ARC,
    CHAMFER_LAST,
    FROM_END,
    HIGH_SPEED,
    INCREMENTAL,
    ONE_CORNER,
    PICK_REQUIRED,
    PICKS_NOTHING,
    ROUNDING_LAST,
    STRAIGHT_ONLY,
    TURNED,
    UNGUARDED,
)
from contoursolve.controls.mitsubishi.lexicon import BOOK, LAST_CORNER
from contoursolve.controls.rule_rows import row
from contoursolve.diagnostics import Alarm, Evidence, Severity
from contoursolve.reading import AnglesParallel, Value, all_of, some

_BESIDE = tuple(f"beside-{axis}" for axis in "XYZ")
_GUARD = Decimal("0.9999999")
"""Degrees: less than 1."""
_LINES, _ARCS = (LINE, OVER_LINE), (ARC, OVER_CIRCLE)
_ANY = (*_LINES, *_ARCS)
_CORNER, _FIRST, _SECOND = (",C", ",R"), ("first", "first-step"), ("second", "second-step")
_BOOK = BOOK.printed("linear angle command, p. 375")


_MILL = "G17 G90 G00 X0 Y0\n"
_CUT = _MILL + "G01 X30. ,C5.\nX40. Y40."
_TWICE = _MILL + "G01 X30. ,R6.\nY20. ,R6.\nX60."
_ANGLED = _MILL + "G01 X40. A30."
_VERTEX = _MILL + "G01 A70.\nX80. Y25. A-30."
_CROSSING = _MILL + "G01 A10.\nG02 X60. Y10. I-20. J-25. H0"
_LEAVING = _MILL + "G03 I30. J0 H0\nG01 X20. Y-60. A-90."
_CENTERED = _LEAVING.replace("I30. J0", "P30. Q0")
_TOUCHING = _MILL + "G01 A15.\nG03 X70. Y50. R30."
_ARCS_TOUCH = _MILL + "G03 I0 J30.\nG02 X70. Y60. R25."
_ARC = _MILL + "G01 X40. ,C6.\nG02 X60. Y20. I20. J0"


def _alarm(number: str) -> Alarm:
    return Alarm(number, Evidence.PRINTED if number.startswith("P33 ") else Evidence.ASSUMED)


_FORMAT = _alarm("P395 (address or format)")

_ROWS = (
    row("mitsubishi-two-corners", "{words}: a block takes ,C or ,R, not both", "keep one of them",
        BOOK.assumed("not described"), all_of(*_CORNER) & some(ONE_CORNER), _CUT, _ANY, alarm=_FORMAT),
    *(
        row(f"mitsubishi-{name}-replaced",
            "{words}: the control makes the last corner word of a block alone, without a message",
            f"delete {word}, or delete {kept}", LAST_CORNER, all_of(*_CORNER) & some(last) & ~some(ONE_CORNER),
            (_CUT, (",C5.", f"{word}5. {kept}5.")), _ANY, ignores=word, severity=Severity.WARNING)
        for name, word, kept, last in (("chamfer", ",C", ",R", ROUNDING_LAST), ("rounding", ",R", ",C", CHAMFER_LAST))
    ),
    row("mitsubishi-corner-without-next", "{words}: a corner needs an element after it, and none follows",
        "put the next element right after it, or delete it", BOOK.assumed("corner chamfering: the first block"),
        some(*_CORNER) & some(LAST) & ~some(RAPID), (_CUT, ("\nX40.", "\nM8\nX40."), ("\nX40.", "\nG00 X40.")), _ANY,
        alarm=_alarm("P382 (no move behind the corner)")),
    row("mitsubishi-corner-rapid", "{words}: the control makes a corner in a cutting move, not in G00", "write G01",
        BOOK.derived("corner"), some(*_CORNER) & some(RAPID), (_CUT, ("G01 ", "")), _ANY),
    row("mitsubishi-corner-arc",
        "{words}: with corner chamfering I this control makes corners between lines alone, and this is an arc",
        "write its lines and corners out; with option II set corner=II", BOOK.printed("p. 372: corner chamfering I"),
        some(*STATED_POINT, *STATED_CENTER, "R", *_CORNER) & some(STRAIGHT_ONLY), _ARC, _ARCS),
    row("mitsubishi-chamfer-along-arc", "a chamfer whose size is measured along an arc is not computed",
        "set chamfer-on-arc=chord, or write the chamfer out", BOOK.assumed("not described"),
        some(*STATED_POINT, *STATED_CENTER, "R") & some(ALONG_ARC), _ARC, _ARCS),
    row("mitsubishi-outside-plane", "{words} does not belong to the plane of the contour",
        "delete it, or move that axis in a block of its own", BOOK.printed("p. 375: in the selected plane"),
        some(*_BESIDE, "wrong-center"), (_CUT, ("X40. Y40.", "G02 X40. Y10. K10."), ("X30.", "X30. Z-5.")), _ANY),
    row("mitsubishi-plane-changes", *PLANE_CHANGES, BOOK.assumed("one plane"), some(OTHER_PLANE),
        (_CUT, ("X40. Y40.", "G18 X40. Z40.")), _ANY, alarm=_alarm("P396 (plane changed)")),
    row("mitsubishi-zero-moves", *ZERO_MOVES, BOOK.assumed("work offsets"), some(OTHER_ZERO),
        (_CUT, ("X40. Y40.", "G55 X40. Y40.")), _ANY),
    row("mitsubishi-center-on-line", "{words}: a line has no centre and no radius", "delete it; a rounding is ,R",
        BOOK.derived("lines and arcs"), some(*STATED_CENTER, "R"), (_CUT, ("Y40.", "Y40. R5.")), _LINES),
    row("mitsubishi-angle-ignored", "{words} is ignored, because both coordinates are there{comparison}",
        "delete {words}, or delete the coordinate that is to be computed", _BOOK, all_of(_FIRST, _SECOND, "A"),
        (_ANGLED, ("A30.", "Y20. A30.")), (LINE,), ignores="A", severity=Severity.WARNING),
    row("mitsubishi-angle-rapid", ANGLE_RAPID, "write G01; where A is an axis, set angle-word=,A", _BOOK,
        some("A") & some(RAPID), (_ANGLED, ("G01 ", "")), (LINE,)),
    row("mitsubishi-angle-on-arc", "{words}: the control works out angles in G01, not in G02 and G03",
        "write G01, or delete {words}", _BOOK, some("A"), (_TOUCHING, ("R30.", "R30. A20.")), _ARCS),
    row("mitsubishi-high-speed", "{words}: in high-speed machining the control takes no angle",
        "end that mode before, with G05 P0", BOOK.printed("p. 375"), some(HIGH_SPEED) & some("A"),
        (_ANGLED, ("G01", "G05 P2\nG01")), _LINES, alarm=_alarm("P33 (angle in high-speed machining)")),
    row("mitsubishi-angle-range", *ANGLE_RANGE, _BOOK, Value(("A",), least=Decimal(-360), most=Decimal(360)),
        (_ANGLED, ("A30.", "A390.")), _LINES, severity=Severity.WARNING),
    row("mitsubishi-end-missing", "{words} alone does not say where the line ends",
        "add a coordinate; or let a block follow that tells where it goes", BOOK.assumed("p. 377: two blocks in a row"),
        some("A") & ~some(*STATED_POINT, FOLLOWED), (_VERTEX, ("\nX80.", "\nM8\nX80.")), (LINE,), alarm=_FORMAT),
    row("mitsubishi-second-rapid", "the block before has no end, so this block must cut, and G00 does not", "write G01",
        BOOK.assumed("p. 377"), some(RAPID), (_VERTEX, ("\nX80.", "\nG00 X80.")), (OVER_LINE,),
        alarm=_alarm("P394 (the second block is not linear)"), note="without the option Geometric the alarm is P390"),
    row("mitsubishi-second-incremental",
        "{words}: the block before has no end, so this block must give its own in absolute coordinates",
        "write it with G90", BOOK.printed("p. 377: absolute position"), some("first", "second") & some(INCREMENTAL),
        (_VERTEX, ("\n", "\nG91 ")), (OVER_LINE, OVER_CIRCLE), alarm=_alarm("P393 (the second block is incremental)")),
    row("mitsubishi-second-line-incomplete", "the block before has no end, so this line needs {lacking}, too",
        "add {lacking}", BOOK.printed("p. 377 and 379"), ~all_of("first", "second", "A") & ~some(RAPID),
        (_VERTEX, (" A-30.", ""), ("X80. ", "")), (OVER_LINE,), alarm=_FORMAT),
    row("mitsubishi-second-arc-incomplete", "the block before has no end, so this arc needs {lacking}, too",
        "add {lacking}", BOOK.printed("p. 378 and 379"), ~all_of("first", "second", (*STATED_CENTER, "R")),
        (_TOUCHING, (" R30.", ""), ("X70. ", "")), (OVER_CIRCLE,), alarm=_FORMAT,
        note="without the option for arcs the alarm is P391 or P398"),
    row("mitsubishi-center-and-radius", "{words}: the arc has both a centre and a radius", "keep one of them",
        BOOK.assumed("not described"), all_of((*STATED_CENTER, *CENTER_AT), "R"), (_ARC, ("J0", "J0 R20.")), _ARCS,
        alarm=_FORMAT),
    row("mitsubishi-circle-undefined", "the arc has neither a centre nor a radius", "add I, J or K of the plane, or R",
        BOOK.assumed("not described"), ~some(*STATED_CENTER, *CENTER_AT, "R"), (_ARC, (" I20. J0", "")), (ARC,)),
    row("mitsubishi-radius-without-end", "{words}: with R the arc needs its end",
        "add the coordinates of its end, or give the centre instead", BOOK.assumed("not described"),
        some("R") & ~some(*STATED_POINT, FOLLOWED), (_ARC, ("X60. Y20. I20. J0", "R20.")), (ARC,)),
    row("mitsubishi-two-radii", "{words}: two arcs that touch are not found by two radii",
        "give the centre of one of them by I, J or K", BOOK.printed("p. 378: two-arc contact"), all_of("1:R", "2:R"),
        (_ARCS_TOUCH, ("I0 J30.", "R30.")), (CIRCLE_CIRCLE,), alarm=_FORMAT),
    row("mitsubishi-no-full-circle", "the arc of {words} ends where it meets the next block; it is no full circle",
        "for a full circle write its end, too, or set arc-without-end=circle", BOOK.derived("p. 378"),
        some("1:center-first", "1:center-second") & ~some("1:H"), (_LEAVING, (" H0", ""), _ARCS_TOUCH),
        (CIRCLE_LINE, CIRCLE_CIRCLE), severity=Severity.WARNING),
    row("mitsubishi-centre-from-end", "{words}: a centre that is counted from the end to be found is not computed",
        "set first-centre=start, or write both blocks out", BOOK.derived("p. 378"),
        some(*STATED_CENTER) & some(FOLLOWED) & some(FROM_END), _LEAVING, (ARC,)),
    row("mitsubishi-centre-half", "{words}: of a centre by P and Q, one coordinate is missing", "write both",
        BOOK.derived("p. 378"), some(*CENTER_AT) & ~all_of(*CENTER_AT), (_CENTERED, (" Q0", "")), _ARCS),
    row("mitsubishi-centre-place",
        "{words}: P and Q are the centre of an arc without an end or another centre, before a line",
        "let a line with its end and its angle follow, or give the centre by I and J",
        BOOK.printed("p. 378: format list 3"),
        some(*CENTER_AT) & (some(*STATED_POINT, *STATED_CENTER) | ~some(FOLLOWED)),
        (_CENTERED, ("H0", "I30. H0"), ("P30.", "X40. P30."), ("\nG01 X20.", "\nM8\nG01 X20.")), _ARCS),
    row("mitsubishi-centre-of-two-arcs",
        "{words}: P and Q are the centre of an arc that a line meets, and here an arc follows",
        "write I and J in place of P and Q", BOOK.printed("p. 378: format list 3"),
        some(*(f"{block}:{name}" for block in (1, 2) for name in CENTER_AT)), (_ARCS_TOUCH, ("I0 J30.", "P0 Q30.")),
        (CIRCLE_CIRCLE,), alarm=_FORMAT),
    row("mitsubishi-centre-of-diameter", "{words}: where X is a diameter, no page says whether P is one, too",
        "write I and K in place of P and Q", BOOK.assumed("not described"), some(*CENTER_AT) & some(TURNED), _CENTERED,
        _ARCS),
    row("mitsubishi-centre-on-line", "{words}: P and Q belong to an arc without an end", "delete them",
        BOOK.derived("p. 378"), some("P", "Q") & ~some(HIGH_SPEED), (_ANGLED, ("A30.", "A30. P5.")), _LINES),
    row("mitsubishi-angles-parallel",
        "{words}: the two lines are parallel to less than 1 deg, so the control computes no vertex",
        "correct one of the angles", BOOK.assumed("alarm P392"),
        AnglesParallel(("1:A", "2:A"), _GUARD) & ~some("1:" + UNGUARDED),
        (_VERTEX, ("A-30.", "A70.5"), ("A-30.", "A250.")), (LINE_LINE,), alarm=_alarm("P392 (angle less than 1 deg)"),
        is_about_geometry=True),
    row("mitsubishi-h-value", "H is neither 0 nor 1", "choose: H0 is the shorter line, H1 the longer one",
        BOOK.printed("p. 378"), some(PICKS_NOTHING), (_CROSSING, ("H0", "H2")), _ARCS, alarm=_FORMAT),
    row("mitsubishi-h-missing", "H is missing: the line crosses the circle twice",
        "choose: H0 is the shorter line, H1 the longer one", BOOK.assumed("not described"),
        some("1:center-first", "1:center-at-first", "2:center-first") & ~some("1:H", "2:H")
        & some("1:" + PICK_REQUIRED), _CROSSING, (LINE_CIRCLE, CIRCLE_LINE), is_about_choice=True),
)  # fmt: skip


_MISSED = _alarm("P397 (no crossing or contact)")
_SHORT = _alarm("P383 or P384 (shorter than the corner needs: the block, or the next one)")
_OWN = (
    row("mitsubishi-circle-missed", like=GENERAL, examples=(_CROSSING, ("A10.", "A80.")), alarm=_MISSED),
    row("mitsubishi-no-point", like=GENERAL, examples=(_TOUCHING, ("R30.", "R3.")), alarm=_MISSED),
    row("mitsubishi-radius-difference", like=GENERAL, examples=(_ARC, ("I20.", "I18."))),
    row("mitsubishi-corner-too-large", like=GENERAL, examples=(_CUT, (",C5.", ",C31.")), alarm=_SHORT),
    row("mitsubishi-corners-overlap", like=GENERAL, examples=(_TWICE, ("R6.", "R16.")), alarm=_SHORT),
)
_COMMON = tuple(rule for rule in COMMON_RULES if rule.code != "no-point")
RULES = WORDS.tell(*_COMMON, *_ROWS, *_OWN, *GEOMETRY_RULES)
