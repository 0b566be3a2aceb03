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
from contoursolve.controls.geometry_rules import GENERAL
from contoursolve.controls.rule_rows import row, with_pages
from contoursolve.controls.siemens.examples import EXAMPLES, WORDS
from contoursolve.controls.siemens.language import ALONG_ARC, NO_STEPS, STRICT_ANGLE
from contoursolve.controls.siemens.lexicon import BOOK
from contoursolve.diagnostics import Alarm, Evidence, Severity
from contoursolve.reading import ReadIssue, Value, all_of, some

_ALARMS = {
    "plane-changes": "10790 (plane change)",
    "angles-parallel": "10791 (invalid angle)",
    "angle-on-arc": "10792 (wrong interpolation type)",
    "end-missing": "10793 (second block missing)",
    "closing-incomplete": "10794 (angle missing in the second block)",
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
_ASSUMED, _PAGE = MANUAL.assumed, BOOK.printed(MANUAL.source.place)

_OWN = (
    row("siemens-two-chamfers", "{words}: a block takes one size of a chamfer", "keep one of them", _ASSUMED,
        all_of("CHR", "CHF"), (MANUAL.cut, ("RND=5", "CHR=5 CHF=5")), ANY),
    *(
        row(f"siemens-{word.lower()}-ignored", "{words}: the control makes the rounding alone, without a message",
            f"delete {word}, or delete RND", _PAGE, all_of(word, "RND"), (MANUAL.cut, ("RND=5", f"{word}=2 RND=5")),
            ANY, ignores=word, severity=Severity.WARNING)
        for word in ("CHR", "CHF")
    ),
    *(
        row(f"siemens-{word.lower()}-left-out",
            "{words}: no move follows in the plane, so the control leaves the corner out",
            f"put the next line or arc right after it, or delete {word}", _ASSUMED,
            some(word) & some(LAST) & some(LEFT_OUT) & (~some(RAPID) | some(RAPID_CORNER)), MANUAL.cut, ANY,
            ignores=word, severity=Severity.WARNING)
        for word in ("CHR", "CHF", "RND")
    ),
    row("siemens-chamfer-along-arc", "a chamfer that is measured along an arc is not computed",
        "set chamfer-on-arc=chord, or write the chamfer out", _ASSUMED,
        some("CHR") & some(ALONG_ARC) & some(BESIDE_ARC), MANUAL.arc, ANY),
    row("siemens-angle-redundant", "{words} is one word too many beside both coordinates{comparison}",
        "delete one of the three; where the control checks it, set redundant-angle=check", _ASSUMED,
        all_of(FIRST, SECOND, "ANG") & ~some(FOLLOWED) & some(STRICT_ANGLE), (MANUAL.angled, ("X40", "X40 Y20")),
        (LINE,), ignores="ANG", alarm=Alarm("10795 (end point specification contradictory)", Evidence.ASSUMED)),
    row("siemens-closing-increment", "{words}: the second of two lines gives its end by coordinates",
        "write X=AC( ), or G90", _ASSUMED, some(*STEPS) & some(NO_STEPS), MANUAL.vertex, (OVER_LINE,)),
    row("siemens-rounding-negative", "{words}: a rounding has no sign",
        "delete the minus sign; RNDM=0 ends the roundings", _ASSUMED, Value(("RNDM",), least=Decimal(0)),
        (MANUAL.cut.replace("RND", "RNDM"), ("=5", "=-5")), ANY),
    row("siemens-shape-on-tangent", "{words}: the centre and the radius of CT follow from the move before it",
        "delete it, or write G2 or G3", _ASSUMED, some(*STATED_CENTER, "R") & some(SMOOTH),
        (_START + "G1 X20\nCT X40 Y20", ("CT X40 Y20", "CT X40 Y20 CR=20"), ("CT X40 Y20", "CT X40 Y20 I0 J20")),
        (ARC,)),
    row("siemens-diameter-changes", "X is a diameter in one block of the contour and a radius in another",
        "write DIAMON, DIAMOF or DIAM90 before its first block", _ASSUMED, some(OTHER_DIAMETER),
        ("G18 DIAMON G90 G0 X20 Z0\nG1 X40 RND=2\nZ-50", ("Z-50", "DIAMOF Z-50")), ANY),
    row("siemens-no-tangent", "CT goes on from a line or an arc, and no G1, G2, G3 or CT is right before it",
        "put a line or an arc right before it, or write G2 or G3 with CR", _PAGE, some(NO_TANGENT),
        (_START + "G1 X20\nCT X40 Y20", _START + "CT X40 Y20"), (ARC,)),
)  # fmt: skip


_GEOMETRY = {
    "corner-too-large": (MANUAL.cut, ("RND=5", "CHR=31")),
    "corner-straight": (MANUAL.cut, ("X40 Y40", "X60")),
    "radius-difference": (MANUAL.arc, ("I20", "I18")),
}
_COMMON = (
    row("stray-character", like=GENERAL, help="delete it, or put it into a comment after a semicolon",
        examples=(MANUAL.cut, ("X30", "X30 !"))),
    row("number-malformed", like=GENERAL,
        help="write digits with at most one point; after a name write an equals sign, such as RND=5",
        examples=(MANUAL.cut, ("RND=5", "RND5"))),
)  # fmt: skip
_OF_VARIABLES = (
    row("siemens-variable-refused", "{reason}; the control stops here with an alarm",
        "define it by DEF where it is used, with two letters first, or hand it back by a VAR parameter",
        BOOK.printed("job planning 07/2010 p. 23; NC programming 12/2019 p. 383"), ReadIssue.VARIABLE_REFUSED,
        (f"DEF REAL BB=5\n{MANUAL.cut.replace('RND=5', 'RND=BB')}", f"DEF REAL B=5\n{MANUAL.cut}")),
    row("siemens-comparison-last", "{meant}: a comparison binds less than AND, OR and XOR",
        "put each comparison into brackets of its own",
        BOOK.printed("job planning 07/2010 p. 72; NC programming 12/2019 p. 444"), ReadIssue.COMPARISON_LAST,
        (f"R1=(1==1) AND (2==2)\n{MANUAL.cut}", f"R1=1==1 AND 2==2\n{MANUAL.cut}"), severity=Severity.WARNING),
)  # fmt: skip
_RULES = WORDS.tell(*rules_of(MANUAL, _OWN, _GEOMETRY, _COMMON), *_OF_VARIABLES)
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
