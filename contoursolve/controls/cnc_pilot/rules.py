"""CNC PILOT: which words may stand together, and what has no solution. No alarm number is known."""

from decimal import Decimal

from contoursolve.controls.cnc_pilot.contour import LAST, NO_CODE, OVERSIZE, TOO_MUCH
from contoursolve.controls.cnc_pilot.examples import WORDS
from contoursolve.controls.cnc_pilot.lexicon import BOOK
from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.geometry_rules import GENERAL, GEOMETRY_RULES
from contoursolve.controls.heidenhain.elements import ARC, LINE
from contoursolve.controls.heidenhain.lexicon import CHAMFER, ROUNDING
from contoursolve.controls.rule_rows import row, with_rows
from contoursolve.diagnostics import Severity
from contoursolve.reading import Value, all_of, some
from contoursolve.solving import NoteKind, RefusalKind

_ANY, _CENTER, _LEAST = (LINE, ARC), ("ICCZ", "ICCX", "CCZ", "CCX"), Decimal("0.0001")
_CUT = "FERTIGTEIL\nG0 X30 Z0\nG1 X50 B-2\nG1 Z-40\nG1 X65"
_ARC = "G0 X40 Z-20\nG2 X60 Z-30 R10\nG1 X80"
_CROSSING = "G0 X40 Z0\nG1 A5 B0 Q1\nG12 X58 Z-52 I38 K-40"
_LEAVING = "G0 X0 Z0\nG3 X? Z? I0 K-25 B0 Q1\nG1 X40 Z-60 A8"
_TANGENT = "G0 X0 Z0\nG3 X? Z? I0 K-15\nG1 X50 Z-70"
_ASSUMED = BOOK.assumed("not described")

_ROWS = (
    row("cnc-pilot-code-missing", "the block has words of a contour and no G code",
        "write G1, or G2, G3, G12 or G13 for an arc", BOOK.assumed("each printed block has its own"), some(NO_CODE),
        (_CUT, ("G1 Z-40", "Z-40 B1")), _ANY),
    row("cnc-pilot-center-on-line", "{words}: a line has no centre and no radius", "delete it; a rounding is B",
        BOOK.derived("p. 148"), some(*_CENTER, "R"), (_CUT, ("Z-40", "Z-40 R5")), (LINE,)),
    row("cnc-pilot-angle-on-arc", "{words}: an arc has no angle", "write G1, or delete it", BOOK.derived("p. 148"),
        some("A"), (_ARC, ("R10", "R10 A20")), (ARC,)),
    row("cnc-pilot-center-and-radius", "{words}: the arc has both a centre and a radius", "keep one of them",
        BOOK.printed("p. 180, for arcs on the lateral surface"), all_of(_CENTER, "R"), (_ARC, ("R10", "R10 I10 K0")),
        (ARC,)),
    row("cnc-pilot-radius-range", "{words}: a radius is above 0, and 200000 at most", "write a radius in this range",
        BOOK.printed("p. 190"), Value(("R",), _LEAST, Decimal(200_000)), (_ARC, ("R10", "R-10")), (ARC,)),
    row("cnc-pilot-corner-without-next", "{words}: a corner needs an element after it, and none follows",
        "put the next element right after it, or delete it", BOOK.printed("p. 147: B at the end of the element"),
        some(ROUNDING, CHAMFER) & some(LAST), (_CUT, ("\nG1 Z-40\nG1 X65", "")), _ANY),
    row("cnc-pilot-feed-range", "{words}: the share of the feed is above 0, and 1 at most",
        "write E1 or less; on a MANUALplus 4110, E is the feed itself", BOOK.printed("p. 147"),
        Value(("E",), _LEAST, Decimal(1)), (_CUT, ("B-2", "B-2 E1.5")), _ANY),
    row("cnc-pilot-selection-value", "{words}: Q is 0 for the near intersection, and 1 for the far one",
        "write Q0 or Q1", BOOK.printed("p. 147"), Value(("Q",), Decimal(0), Decimal(1)), (_CROSSING, ("Q1", "Q2")),
        _ANY),
    row("cnc-pilot-arc-selection", "{words}: editions of the manual disagree whether Q0 of an arc is near or far",
        "check it on the control; the setting arc-q tells it", BOOK.printed("p. 148 and the pocket guide"), some("Q"),
        (_CROSSING, _LEAVING), (ARC,), severity=Severity.WARNING),
    row("cnc-pilot-angle-redundant", "{words}: the angle is one word too many beside both coordinates",
        "delete the angle, or a coordinate", _ASSUMED, all_of(("Z", "IZ"), ("X", "IX"), "AN") & some(TOO_MUCH), _CUT,
        (LINE,)),
    row("cnc-pilot-oversize", "G52 is an oversize: the path is the contour without it", "nothing has to be changed",
        BOOK.printed("p. 163 and 165"), some(OVERSIZE), (_CUT, ("G1 Z-40", "G52 G1 Z-40")), _ANY,
        severity=Severity.WARNING),
    row("cnc-pilot-selection", "{words}: {subject} has {limit_count} alone", "write {numbers}", _ASSUMED,
        RefusalKind.PICK_NONE, _CROSSING),
    row("cnc-pilot-selection-idle", "{words} has nothing to choose: there is one solution alone",
        "nothing is wrong: it is taken", _ASSUMED, NoteKind.PICK_OPEN, (_TANGENT, ("K-15", "K-15 Q1")),
        severity=Severity.INFO),
    row("cnc-pilot-selection-missing", "{subject} ends in one of {limit_count}, and Q is missing: it is read as Q0",
        "write Q0 or Q1; editions of the manual disagree which of them is near: see the setting arc-q",
        BOOK.printed("p. 148 and 190"), NoteKind.PICK_FIRST, (_CROSSING, _LEAVING.replace(" Q1", "")),
        severity=Severity.WARNING),
    row("cnc-pilot-redundant", like=GENERAL["words-redundant"], help="nothing has to be changed: the words agree",
        examples=(_CUT, ("X50 B-2\nG1 Z-40", "X50\nG1 Z-40 X55 A3.57633")), severity=Severity.INFO),
    row("cnc-pilot-arc-empty", like=GENERAL, source=BOOK.printed("p. 425"),
        examples=(_ARC, ("X60 Z-30 R10", "X40 Z-20 I10 K0"))),
    row("cnc-pilot-corner-dropped", like=GENERAL,
        message="{words}: the elements touch there, so that there is no corner",
        help="nothing is wrong: the path is the same without it", source=_ASSUMED,
        examples=(_CUT, ("X50 B-2\nG1 Z-40", "X50\nG1 Z-20 B2\nG1 Z-40")), severity=Severity.INFO),
    row("cnc-pilot-corner-too-large", like=GENERAL, examples=(_CUT, ("B-2", "B-12"))),
    row("cnc-pilot-below-centre", "{words}: the contour goes below the turning centre",
        "look for a lost sign; nothing to do if a tool is meant to pass the centre",
        BOOK.printed("errors of a contour, a later control"), Value(("X",), Decimal(0)), (_CUT, ("X65", "X-4")), _ANY,
        severity=Severity.WARNING),
)  # fmt: skip
_VARIABLE = row(
    "value-variable", like=GENERAL, help="write the number: contoursolve does not follow the variables of this control"
)
RULES = WORDS.tell(*_ROWS, *with_rows(COMMON_RULES, _VARIABLE), *GEOMETRY_RULES)
