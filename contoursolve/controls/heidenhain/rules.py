"""Free contour programming: what a block must state together, and what has no solution."""

from collections.abc import Sequence
from decimal import Decimal
from functools import reduce
from operator import or_

from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.geometry_rules import GENERAL, GEOMETRY_RULES
from contoursolve.controls.heidenhain.circumstances import (
    APART,
    AT_ARC,
    CLOSES_NOTHING,
    CONTINUED,
    CORNERED,
    CUT,
    FIRST_CORNER,
    LAST_CORNER,
    NEVER_CLOSED,
    NO_BEFORE,
    NO_BLOCK,
    NO_CENTER,
    NO_COORDINATE,
    NO_LINE,
    NO_POLE,
    NO_RADIUS,
    NO_SENSE,
    NO_TURN,
    PARAMETER,
    TOOL,
    TURNS_BACK,
    TWO_BLOCKS,
)
from contoursolve.controls.heidenhain.elements import ARC, CORNERS, LINE, PLAIN, POLAR, POLE, TANGENCY
from contoursolve.controls.heidenhain.lexicon import (
    BOOK,
    CHAMFER,
    IN_KLARTEXT,
    REFERRING_TO_LINES,
    ROUNDING,
    PlaneWords,
)
from contoursolve.controls.rule_rows import row
from contoursolve.diagnostics import Alarm, Evidence, Severity
from contoursolve.gcode import FaultKind
from contoursolve.reading import Condition, ReadIssue, Rule, Value, all_of, some
from contoursolve.solving import NoteKind, RefusalKind

_INCOMPLETE = Alarm("402-0008 (incomplete input in the FK block)", Evidence.PRINTED)
_ILLEGAL = Alarm("402-0009 (illegal positioning block in an FK sequence)", Evidence.PRINTED)
_ERRORS = BOOK.printed("NC error messages 402-0008, 402-0009")
_FK, _ANY = (LINE, ARC), (LINE, ARC, PLAIN)

START = "0 BEGIN PGM A MM\n1 L X+0 Y+0\n"
_LINES = START + "2 FL AN+60\n3 FL X+80 Y+20 AN-30\n4 END PGM A MM"
_POINT = START + "2 FL P1X+20 P1Y+20\n3 FL X+80 Y+20 AN-30\n4 END PGM A MM"
_BESIDE = START + "2 FL PDX+20 PDY+20 D0\n3 FL X+80 Y+20 AN-30\n4 END PGM A MM"
_ARC = START + "2 FC DR+ R20 CCX+0 CCY+20 X+20 Y+20\n3 END PGM A MM"
_PARALLEL = START + "2 FL X+50 Y+0\n3 FL AN+90\n" + "4 FL PAR 2 DP 30 AN+180\n5 FL X+0 Y+0 AN-90"
_TURNED_FROM = START + "2 FL X+50 Y+0\n3 FL AN+90 LEN20\n4 FL IAN+90 RAN 2 LEN20"
_POLAR = START + "2 FPOL X+10 Y+0\n3 FL PR+20 PA+45\n4 END PGM A MM"
_POLE = START + "2 FL X+5 Y+0\n3 FPOL X+10 Y+0\n4 FL PR+20 PA+45\n5 END PGM A MM"
_CLOSED = START + "2 FL X+30 Y+0 CLSD+\n3 FL X+30 Y+20\n4 FL CLSD-\n5 END PGM A MM"
_TANGENT = START + "2 FL X+30 Y+0\n3 FCT DR+ R10 CCA+0\n4 END PGM A MM"
_ROUND = START + "2 FC DR- R25 CCX+25 CCY+0 X+25 Y+25\n3 FCT DR- CCX+25 CCY+0 X+50 Y+0"
_TURNING = START + "2 FL AN+0\n3 FCT DR+ R10 CCA+0\n4 FLT X+40 Y+30"
_NUMBERED = START + "2 FL X+30 Y+0\n3 FL IX+5 IY+20 RX 2\n4 END PGM A MM"
_CORNER = START + "2 L X+40 Y+0\n3 RND R5\n4 L X+40 Y+30\n5 END PGM A MM"
_BOW = _CORNER.replace("4 L X+40 Y+30", "4 CR X+40 Y+30 R20 DR+")
_CIRCLE = START + "\n".join(
    ("2 CC X+20 Y+0", "3 L X+40 Y+0", "4 RND R2", "5 CP IPA+360 DR-", "6 RND R2", "7 L X+60 Y+20")
)
_FAR = START + "2 FL X+30 Y+0\n3 FL X+50 Y+10\n4 FL IX+5 IY+20 RX 2\n5 END PGM A MM"
_CHOSEN = START + "2 FL LEN40 P1X+30 P1Y+10\n3 FSELECT 1\n4 FL X+80 Y+20"
_TOOL = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S100\n2 L X+0 Y+0\n" + "3 FL AN+60\n4 FL X+80 Y+20 AN-30"


_CORNERS = BOOK.derived("RND and CHF stand between two elements")
_PRINTED_REFERENCE = BOOK.printed("data relative to a block")
_LEAST = Decimal("0.001")


def _referring(trouble: str, names: Sequence[str]) -> Condition:
    """A word that names a block, in this trouble."""
    return reduce(or_, (some(trouble + name) & some(name) for name in names))


def _half(*words: str) -> Condition:
    """Some of these words is there, and not all of them."""
    return some(*words) & ~all_of(*words)


def _rows(words: PlaneWords) -> tuple[Rule, ...]:
    """The rows about words of a chain; their examples are Klartext."""
    both = f"write {words.axes[0]} and {words.axes[1]} after FPOL"
    return (
        *(
            row(f"heidenhain-point-{number}", "{words}: of this point one coordinate is missing",
                "write both coordinates", _ERRORS, _half(*words.each(f"P{number}{{}}")), (good, bad), _FK,
                alarm=_INCOMPLETE)
            for number, good, bad in (
                (1, _POINT, (" P1Y+20", "")),
                (2, _POINT.replace("P1", "P2"), (" P2Y+20", "")),
                (3, _ARC.replace("R20 CCX+0 CCY+20", "P1X+10 P1Y+2.679 P3X+17.321 P3Y+10"), (" P3Y+10", "")),
            )
        ),
        row("heidenhain-beside",
            f"{{words}}: a point beside the element takes {words.beside[0]}, {words.beside[1]} and D",
            "write all three", _ERRORS, _half(*words.beside, "D"), (_BESIDE, (" D0", ""), (" PDY+20", "")), _FK,
            alarm=_INCOMPLETE),
        row("heidenhain-sense", "the arc has no DR", "add DR+ (counter-clockwise) or DR-", _ERRORS, some(NO_SENSE),
            (_ARC, (" DR+", "")), (ARC,), alarm=_INCOMPLETE),
        row("heidenhain-arc-sense", "the arc has no DR", "add DR+ (counter-clockwise) or DR-",
            BOOK.assumed("path functions"), some(NO_SENSE), (_BOW, (" DR+", "")), (PLAIN,)),
        row("heidenhain-distance-alone", "{words}: a distance needs the block of the line to which it is parallel",
            "add PAR and the number of that block", _ERRORS, some("DP") & ~some("PAR"), (_PARALLEL, (" PAR 2", "")),
            (LINE,), alarm=_INCOMPLETE),
        row("heidenhain-pole-half", "{words}: the pole has one coordinate", both, _ERRORS, _half(*words.axes),
            (_POLE, ("10 Y+0", "10")), (POLE,), alarm=_INCOMPLETE),
        row("heidenhain-pole-empty", "FPOL has no coordinate", both,
            BOOK.derived("FPOL with one coordinate is incomplete"), some(NO_COORDINATE), (_POLE, (" X+10 Y+0", "")),
            (POLE,), alarm=Alarm(_INCOMPLETE.number, Evidence.DERIVED)),
        row("heidenhain-block-illegal",
            "the chain is still open where a conventional move follows; FL, FC, RND, CHF, APPR or DEP may",
            "complete the chain before it, or write the move as FL or FC", _ERRORS, some(CUT),
            (_LINES, ("3 FL X+80 Y+20 AN-30", "3 L X+80 Y+20")), _ANY, alarm=_ILLEGAL),
        row("heidenhain-block-missing", "{words}: no element of this number stands before it in the chain",
            "write the number of a block of this chain that stands before it", _PRINTED_REFERENCE,
            _referring(NO_BLOCK, words.referring), (_NUMBERED, ("RX 2", "RX 7")), _FK),
        row("heidenhain-block-twice",
            "{words}: two elements of the chain have this block number, so it tells of neither",
            "number the blocks anew, so that each number stands once", BOOK.assumed("data relative to a block"),
            _referring(TWO_BLOCKS, words.referring), (_FAR, ("3 FL X+50", "2 FL X+50")), _FK),
        row("heidenhain-block-no-line", "{words} names the block of an arc, and RAN names a line",
            "write the number of a line, or state the direction by AN", BOOK.assumed("data relative to a block"),
            _referring(NO_LINE, REFERRING_TO_LINES), (_TURNED_FROM, ("2 FL X+50 Y+0", "2 FC X+50 Y+0 DR- R40")), _FK),
        row("heidenhain-reference-alone",
            "{words} names the block from which an increment counts, and the increment is missing",
            "write the increment before it, or delete {words}", _PRINTED_REFERENCE,
            reduce(or_, (some(f"R{name}") & ~some(f"I{name}") for name in words.referred)),
            (_NUMBERED, ("IX+5", "X+35")), _FK, severity=Severity.WARNING),
        row("heidenhain-parameter-relative", "{words}: an element with data relative to a block takes no Q parameters",
            "write numbers in this block, or give its data without {words}",
            BOOK.printed("TNC 426: data relative to a block"),
            some(PARAMETER) & some(*(f"R{name}" for name in words.referred)),
            (_NUMBERED.replace("2 FL", "Q1 = 5\n2 FL"), ("IX+5", "IX+Q1")), _FK),
        row("heidenhain-pole-missing",
            "{words}: polar data need a pole, and no FPOL is in force; CC does not serve here",
            "write FPOL X Y before the chain or in it", BOOK.printed("pole of FK"),
            some(NO_POLE) & some(*sorted(POLAR)), (_POLAR, ("2 FPOL X+10 Y+0\n", "2 CC X+10 Y+0\n")), _FK),
        row("heidenhain-tangent-first", "it begins in the direction of the element before, which is not known here",
            "write FL or FC with AN, or let the move before it begin at a known point",
            BOOK.derived("tangential connection"), some(NO_BEFORE) & (some(TANGENCY) | (some("IAN") & ~some("RAN"))),
            (_TANGENT, ("1 L X+0 Y+0\n2 FL X+30 Y+0\n", "1 CC X+0\n2 APPR LCT X+30 Y+0 R5\n")), (LINE, ARC, PLAIN)),
        row("heidenhain-closes-nothing",
            "CLSD- ends a contour that CLSD+ in an earlier block begins, and there is none",
            "write CLSD+ into the first block of the contour", BOOK.printed("closed contour"),
            some(CLOSES_NOTHING) & some("CLSD-"), (_CLOSED, (" CLSD+", "")), _FK),
        row("heidenhain-centre-missing", "it counts from CC, and no CC is in force", "write CC X Y before it",
            BOOK.assumed("path functions"), some(NO_CENTER),
            (_CORNER.replace("4 L X+40 Y+30", "4 CC X+60 Y+0\n5 C X+60 Y+20 DR-"), ("4 CC X+60 Y+0\n", "")), (PLAIN,)),
        row("heidenhain-radius-missing", "CR is an arc by its radius, and R is missing", "add R",
            BOOK.printed("path functions"), some(NO_RADIUS), (_BOW, (" R20", "")), (PLAIN,)),
        row("heidenhain-corner-without-next", "{words}: a corner needs an element after it, and none follows",
            "put the next line or arc right after it, or delete it", _CORNERS,
            some(*CORNERS) & some(LAST_CORNER) & ~some(FIRST_CORNER), (_CORNER, ("4 L X+40 Y+30\n", "")), _ANY),
        row("heidenhain-corner-first", "{words}: a corner needs a line or an arc right before it, and none is there",
            "put it right after the block that leads to the corner, or delete it", _CORNERS,
            some(*CORNERS) & some(FIRST_CORNER), (_CORNER, ("2 L X+40 Y+0\n", "2 DEP LT LEN5\n")), (PLAIN,)),
        row("heidenhain-corner-apart", "{words} is not checked: it stands beside a call, an approach or a departure",
            "nothing has to be changed; contoursolve solves corners between two elements in a row",
            BOOK.assumed("RND and CHF beside calls, approaches and departures"), some(*CORNERS) & some(APART),
            (_CORNER, ("2 L X+40 Y+0\n", "2 APPR LT X+40 Y+0 LEN5 RL\n"), ("4 L X+40 Y+30", "4 DEP LT LEN5")), (PLAIN,),
            severity=Severity.INFO),
        row("heidenhain-corner-size", "{words}: the size of a corner is negative", "write a positive number", _CORNERS,
            Value((ROUNDING, CHAMFER), least=Decimal(0)) & some(APART),
            (_CORNER.replace("4 L X+40 Y+30", "4 DEP LT LEN5"), ("RND R5", "RND R-5")), (PLAIN,)),
        row("heidenhain-corner-outside-plane", "{words} leads out of the plane of the corner beside it",
            "move the tool axis in a block of its own", BOOK.printed("RND: both elements lie in the plane of the arc"),
            some(*words.across) & some(CORNERED) & ~some(TOOL), (_CORNER, ("X+40 Y+30", "X+40 Y+30 Z-5")), _ANY),
        row("heidenhain-chamfer-beside-arc",
            "{words}: the manual has CHF between two lines, and here is an arc beside it",
            "check it on the control, or write RND", BOOK.printed("path functions: chamfer between two lines"),
            some(CHAMFER) & some(AT_ARC),
            (_CORNER.replace("RND R5", "CHF 5"), ("4 L X+40 Y+30", "4 CR X+40 Y+30 R20 DR+")), _ANY,
            severity=Severity.WARNING),
        row("heidenhain-turns", "{words}: the arc turns more than once, and contoursolve makes one turn of it at most",
            "write each turn as a block of its own", BOOK.assumed("path functions"),
            Value(("IPA",), least=Decimal(-360), most=Decimal(360)) & some("DR"), (_CIRCLE, ("IPA+360", "IPA+720")),
            (PLAIN,), severity=Severity.WARNING),
        row("heidenhain-size", "{words}: a radius, and a distance from the pole, is larger than 0",
            "write a positive number", BOOK.assumed("polar coordinates"),
            Value(("PR", "CCPR", "R", "LEN"), least=_LEAST), (_POLAR, ("PR+20", "PR-20")), _FK),
        row("heidenhain-turns-back", "the arc goes back on the circle of the arc before it: DR says the other way",
            "write the same DR in both, or FC", BOOK.derived("tangential connection"), some(TURNS_BACK),
            (_ROUND, ("FCT DR-", "FCT DR+")), (ARC,)),
        row("heidenhain-continued",
            "~ continues the block in the next line; contoursolve reads a free block on one line",
            "write the block on one line", BOOK.assumed("~"), some(CONTINUED), (_LINES, ("AN-30", "AN-30 ~")), _ANY),
        row("heidenhain-never-closed", "{words} begins a closed contour, and no CLSD- ends it",
            "write CLSD- into its last block, or delete CLSD+", BOOK.printed("closed contour"),
            some(NEVER_CLOSED) & some("CLSD+"), (_CLOSED, (" CLSD-", " X+0 Y+0")), _FK, severity=Severity.WARNING),
        row("heidenhain-tangent-arc", "to which side CT turns is not known before the blocks before it are solved",
            "write FCT with DR+ or DR-", BOOK.assumed("CT after a free contour"), some(NO_TURN),
            (_TURNING, ("FCT DR+ R10 CCA+0", "CT X+40 Y+10")), (PLAIN,)),
        row("heidenhain-tool-axis", "contours are solved in X and Y, and the tool axis is another one",
            "check TOOL CALL: contoursolve reads contours with the tool axis Z", BOOK.assumed("planes"), some(TOOL),
            (_TOOL, ("1 Z S", "1 X S")), _ANY),
    )  # fmt: skip


_OWN = (
    row("heidenhain-no-word", "{words} is no function and no word with a number",
        "check the spelling: moves are L, C, CR, CT, FL, FLT, FC and FCT, with a blank after them",
        BOOK.printed("path functions"), FaultKind.NUMBER_MISSING, (_LINES, ("3 FL", "3 FTL"))),
    row("heidenhain-word-unknown", "{words} has no meaning in this block", "{advice}",
        BOOK.printed("free contours FK"), ReadIssue.UNKNOWN_ADDRESS, (_LINES, ("AN+60", "AN+60 R5"))),
    row("heidenhain-selection", "{words}: {subject} has {limit_count} alone", "write {numbers}",
        BOOK.assumed("how FSELECT counts"), RefusalKind.PICK_NONE, (_CHOSEN, ("SELECT 1", "SELECT 3"))),
    row("heidenhain-selection-open",
        "{words} cannot be counted here: the other blocks leave one solution at {subject} alone",
        "nothing is wrong: the solution that is taken fits all blocks", BOOK.assumed("how FSELECT counts"),
        NoteKind.PICK_OPEN, (_CHOSEN, _CHOSEN.replace("LEN40", "X+30 Y+10").replace("SELECT 1", "SELECT 2")),
        severity=Severity.INFO),
    row("heidenhain-first-taken", "{subject} has {limit_count}: the first one is taken, as the setting ambiguous says",
        "write FSELECT after its block", BOOK.assumed("an open contour cannot be run"), NoteKind.PICK_FIRST, _CHOSEN,
        severity=Severity.WARNING),
    # RND and CHF behind an element belong to it.
    row("heidenhain-repeated", "{words} is given twice for this element", like=GENERAL["address-repeated"],
        examples=(_CORNER, ("RND R5", "RND R5\nRND R3"))),
    row("heidenhain-redundant", like=GENERAL["words-redundant"],
        help="nothing has to be changed: the control accepts data that agree",
        examples=(_LINES, ("AN+60", "AN+60 LEN57.321")), severity=Severity.INFO),
    # An arc often ends at a quadrant, where its end only just fits.
    row("heidenhain-touches", like=GENERAL,
        examples=(_LINES, START + "2 FL X+40 Y+0\n3 FC DR- R20 CCX+60 CCY+0 X+80\n4 FLT Y-20"),
        severity=Severity.INFO),
    row("heidenhain-parameter", "{words}: the value of the parameter is not known here",
        'set it by a formula of numbers before this block, or state it: --variable "Q1=5"',
        BOOK.assumed("Q parameters"),
        ReadIssue.VARIABLE,
        (START + "2 Q1 = ( 40 + 20 ) / 2\n3 FL X+Q1 Y+5\n4 END PGM A MM", ("( 40 + 20 ) / 2", "Q2 + 5"))),
)  # fmt: skip


def rules_in(words: PlaneWords) -> tuple[Rule, ...]:
    """All rows about chains with these words."""
    return (*_OWN, *COMMON_RULES, *_rows(words), *GEOMETRY_RULES)


RULES = rules_in(IN_KLARTEXT)
