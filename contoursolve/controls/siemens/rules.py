"""SINUMERIK: which words may be combined, and what has no solution. No page with the alarms was seen."""

from dataclasses import replace
from decimal import Decimal

from contoursolve.controls.chain.language import (
    ARC,
    BESIDE_ARC,
    FOLLOWED,
    LAST,
    LEFT_OUT,
    LINE,
    NO_TANGENT,
    OTHER_DIAMETER,
    OVER_LINE,
    RAPID,
    RAPID_CORNER,
    SMOOTH,
    STATED_CENTER,
)
from contoursolve.controls.chain.rules import ANY, FIRST, SECOND, STEPS, Manual, rules_of
from contoursolve.controls.rule_rows import with_pages
from contoursolve.controls.siemens.examples import EXAMPLES, WORDS
from contoursolve.controls.siemens.language import ALONG_ARC, NO_STEPS, STRICT_ANGLE
from contoursolve.controls.siemens.lexicon import BOOK
from contoursolve.diagnostics import Alarm, Evidence, Severity
from contoursolve.gcode import FaultKind
from contoursolve.reading import ReadIssue, Rule, Value, all_of, some

_ALARMS = {
    "plane-changes": "10790 (plane change)",
    "angles-parallel": "10791 (invalid angle)",
    "angle-on-arc": "10792 (wrong interpolation type)",
    "end-missing": "10793 (second block missing)",
    "closing-incomplete": "10794 (angle missing in the second block)",
    "angle-redundant": "10795 (end point specification contradictory)",
}
_START = "G17 G90 G0 X0 Y0\n"
MANUAL = Manual(
    prefix="siemens",
    source=BOOK.assumed("contour definition, p. 214 and 220"),
    angle="ANG",
    chamfers=("CHR", "CHF"),
    rounding="RND",
    radius="CR",
    examples=EXAMPLES,
    plane="; for a lathe, set siemens-840d.machine=lathe",
    alarms={code: Alarm(number, Evidence.ASSUMED) for code, number in _ALARMS.items()}
    | {"radius-difference": Alarm("14040 (error in the end point of a circle)", Evidence.PRINTED)},
)
_row = MANUAL.row

_OWN = (
    _row("two-chamfers", "{words}: a block takes one size of a chamfer", "keep one of them",
         all_of("CHR", "CHF"), ANY, MANUAL.cut, ("RND=5", "CHR=5 CHF=5")),
    *(
        _row(f"{word.lower()}-ignored", "{words}: the control makes the rounding alone, without a message",
             f"delete {word}, or delete RND", all_of(word, "RND"), ANY, MANUAL.cut, ("RND=5", f"{word}=2 RND=5"),
             evidence=Evidence.PRINTED, ignores=word, severity=Severity.WARNING)
        for word in ("CHR", "CHF")
    ),
    *(
        _row(f"{word.lower()}-left-out", "{words}: no move follows in the plane, so the control leaves the corner out",
             f"put the next line or arc right after it, or delete {word}",
             some(word) & some(LAST) & some(LEFT_OUT) & (~some(RAPID) | some(RAPID_CORNER)), ANY,
             MANUAL.cut, ignores=word, severity=Severity.WARNING)
        for word in ("CHR", "CHF", "RND")
    ),
    _row("chamfer-along-arc", "a chamfer that is measured along an arc is not computed",
         "set chamfer-on-arc=chord, or write the chamfer out", some("CHR") & some(ALONG_ARC) & some(BESIDE_ARC), ANY,
         MANUAL.arc),
    _row("angle-redundant",
         "{words} is one word too many beside both coordinates{comparison}",
         "delete one of the three; where the control checks it, set redundant-angle=check",
         all_of(FIRST, SECOND, "ANG") & ~some(FOLLOWED) & some(STRICT_ANGLE), (LINE,), MANUAL.angled,
         ("X40", "X40 Y20"), ignores="ANG"),
    _row("closing-increment", "{words}: the second of two lines gives its end by coordinates", "write X=AC( ), or G90",
         some(*STEPS) & some(NO_STEPS), (OVER_LINE,), MANUAL.vertex),
    _row("rounding-negative", "{words}: a rounding has no sign", "delete the minus sign; RNDM=0 ends the roundings",
         Value(("RNDM",), least=Decimal(0)), ANY, MANUAL.cut.replace("RND", "RNDM"), ("=5", "=-5")),
    _row("shape-on-tangent", "{words}: the centre and the radius of CT follow from the move before it",
         "delete it, or write G2 or G3", some(*STATED_CENTER, "R") & some(SMOOTH), (ARC,),
         _START + "G1 X20\nCT X40 Y20", ("CT X40 Y20", "CT X40 Y20 CR=20"), ("CT X40 Y20", "CT X40 Y20 I0 J20")),
    _row("diameter-changes", "X is a diameter in one block of the contour and a radius in another",
         "write DIAMON, DIAMOF or DIAM90 before its first block", some(OTHER_DIAMETER), ANY,
         "G18 DIAMON G90 G0 X20 Z0\nG1 X40 RND=2\nZ-50",
         ("Z-50", "DIAMOF Z-50")),
    _row("no-tangent", "CT goes on from a line or an arc, and no G1, G2, G3 or CT is right before it",
         "put a line or an arc right before it, or write G2 or G3 with CR", some(NO_TANGENT), (ARC,),
         _START + "G1 X20\nCT X40 Y20", _START + "CT X40 Y20", evidence=Evidence.PRINTED),
)  # fmt: skip


_GEOMETRY = {
    "corner-too-large": (MANUAL.cut, MANUAL.cut.replace("RND=5", "CHR=31")),
    "corner-straight": (MANUAL.cut, MANUAL.cut.replace("X40 Y40", "X60")),
    "radius-difference": (MANUAL.arc, MANUAL.arc.replace("I20", "I18")),
}
_HELPS = {
    FaultKind.STRAY_CHARACTER: (
        "delete it, or put it into a comment after a semicolon",
        MANUAL.cut.replace("X30", "X30 !"),
    ),
    FaultKind.NUMBER_MALFORMED: (
        "write digits with at most one point; after a name write an equals sign, such as RND=5",
        MANUAL.cut.replace("RND=5", "RND5"),
    ),
}
_OF_VARIABLES = (
    Rule(
        code="siemens-variable-refused",
        message="{reason}; the control stops here with an alarm",
        help="define it by DEF where it is used, with two letters first, or hand it back by a VAR parameter",
        source=BOOK.printed("job planning 07/2010 p. 23; NC programming 12/2019 p. 383"),
        about=ReadIssue.VARIABLE_REFUSED,
        accepted=(f"DEF REAL BB=5\n{MANUAL.cut.replace('RND=5', 'RND=BB')}",),
        rejected=(f"DEF REAL B=5\n{MANUAL.cut}",),
    ),
    Rule(
        code="siemens-comparison-last",
        message="{meant}: a comparison binds less than AND, OR and XOR",
        help="put each comparison into brackets of its own",
        source=BOOK.printed("job planning 07/2010 p. 72; NC programming 12/2019 p. 444"),
        about=ReadIssue.COMPARISON_LAST,
        severity=Severity.WARNING,
        accepted=(f"R1=(1==1) AND (2==2)\n{MANUAL.cut}",),
        rejected=(f"R1=1==1 AND 2==2\n{MANUAL.cut}",),
    ),
)
_RULES = WORDS.tell(*rules_of(MANUAL, _OWN, _GEOMETRY, _HELPS), *_OF_VARIABLES)
_ONE = "NC programming 12/2019 (ONE) p."
RULES = with_pages(
    _RULES,
    BOOK,
    {
        "siemens-corner-negative": f"{_ONE} 1242: CHF, CHR and RND are unsigned",
        "siemens-rounding-negative": f"{_ONE} 1242: RNDM is unsigned",
        "siemens-closing-incomplete": f"{_ONE} 214",
    },
)
_REDUCED = "; the control makes it smaller by itself, to a size that is not printed"
RULES_REDUCING = tuple(
    replace(rule, message=rule.message + _REDUCED) if rule.code == "siemens-corner-too-large" else rule
    for rule in with_pages(_RULES, BOOK, {"siemens-plane-changes": "808D milling 01/2014 p. 89"})
)
