"""ISG kernel: which words may be combined, and what has no solution. The error numbers are printed."""

from functools import partial

from contoursolve.controls.chain.language import (
    ARC,
    CORNER_ALONE,
    CORNER_BOTH,
    CORNER_CROWDED,
    CORNER_TWICE,
    FOLLOWED,
    LINE,
    OTHER_DIAMETER,
    OVER_LINE,
    STATED_CENTER,
)
from contoursolve.controls.chain.rules import ANY, FIRST, SECOND, STEPS, Manual, rules_of
from contoursolve.controls.isg.examples import EXAMPLES, WORDS
from contoursolve.controls.isg.language import NO_SIZE, UNCORRECTED
from contoursolve.controls.isg.lexicon import BOOK
from contoursolve.controls.rule_rows import row, with_pages
from contoursolve.diagnostics import Alarm, Evidence
from contoursolve.reading import Count, all_of, some

_IDS = {
    "angles-parallel": "21892 (two lines with equal angles, or 180 deg apart)",
    "end-missing": "21904 (contour line not completely defined)",
    "closing-incomplete": "21904 (contour line not completely defined)",
    "center-and-radius": "21024 (centre and radius at once; newer controls: 22159)",
}
_alarm = partial(Alarm, evidence=Evidence.PRINTED)
_START = "G17 G90 G0 X0 Y0\n"
MANUAL = Manual(
    prefix="isg",
    source=BOOK.printed("contour line programming; chamfers and roundings"),
    angle="#ANG",
    chamfers=("#CHR", "#CHF"),
    rounding="#RND",
    radius="R",
    examples=EXAMPLES,
    alarms={code: _alarm(number) for code, number in _IDS.items()},
)
_ASSUMED, _PAGE = MANUAL.assumed, MANUAL.source
_BLOCK = _START + "G1 X30\nG302 I5\nG1 X40 Y40"
_UNCORRECTED = MANUAL.arc.replace("G17", "G17 G164")
_CORNERS = (("#CHR",), ("#CHF",), ("#RND",))

_OWN = (
    row("isg-two-corners", "{words}: a corner takes one of #RND, #CHR and #CHF", "keep one of them", _ASSUMED,
        Count(_CORNERS, 2), (MANUAL.cut, ("#RND=5", "#RND=5 #CHR=5")), ANY),
    row("isg-corner-twice", "{words}: the block after it makes a corner in the same place", "keep one of them",
        _ASSUMED, some(CORNER_TWICE), (MANUAL.cut, ("\nX40", "\nG302 I5\nG1 X40")), ANY),
    row("isg-corner-crowded", "the block after it makes a corner, and takes the size I of one corner alone",
        "put everything else in a block of its own", _ASSUMED, some(CORNER_CROWDED),
        (_BLOCK, (" I5", " I5 X50"), (" I5", " I5 I6"), (" I5", " I5 #RND=3")), ANY),
    row("isg-corner-both", "the block after it has G301 and G302, which are of one group", "keep one of them", _ASSUMED,
        some(CORNER_BOTH), (_BLOCK, ("G302", "G301 G302")), ANY,
        alarm=_alarm("20130 (two G codes of one group)")),
    row("isg-angle-redundant", "{words} is one word too many beside both coordinates{comparison}",
        "delete a coordinate, or the angle", _PAGE, all_of(FIRST, SECOND, "#ANG") & ~some(FOLLOWED),
        (MANUAL.angled, ("X40", "X40 Y20")), (LINE,), ignores="#ANG",
        alarm=_alarm("21895 (an angle with both coordinates)")),
    row("isg-closing-increment", "{words}: the second of two lines gives its end in absolute coordinates",
        "write it with G90", _PAGE, some(*STEPS), (MANUAL.vertex, ("\n", "\nG91 ")), (OVER_LINE,),
        alarm=_alarm("21910 (second block incremental)")),
    row("isg-corner-size", "the corner has no size: I is missing or 0, and no corner before it gave one",
        "write the size after G301 or G302, such as I5", _PAGE, some(NO_SIZE), (_BLOCK, (" I5", ""), (" I5", " I0")),
        ANY, alarm=_alarm("20012 (no size, or 0)")),
    row("isg-corner-alone", "G301 and G302 stand between two moves; here no move is right before",
        "put the corner right after the move that it ends", _PAGE, some(CORNER_ALONE),
        (_BLOCK, ("G302 I5", "G302 I5\nG301 I2")), (LINE,),
        alarm=_alarm("20351 (no motion block before), or 20701 (two corners without a motion between)")),
    row("isg-circle-uncorrected", "the arc has neither a centre nor a radius", "add I, J or K of the plane, or R",
        _PAGE, ~some(*STATED_CENTER, "R") & some(UNCORRECTED), (_UNCORRECTED, (" I20 J0", "")), (ARC,),
        alarm=_alarm("20036 (the radius of a circle is 0)")),
    row("isg-diameter-changes", "X is a diameter in one block of the contour and a radius in another",
        "write G51 or G52 before its first block", _ASSUMED, some(OTHER_DIAMETER),
        ("G18 G51 G90 G0 X20 Z0\nG1 X40 #RND=2\nG1 Z-50", ("Z-50", "G52 Z-50")), ANY),
)  # fmt: skip


_GEOMETRY = {
    "corner-too-large": (MANUAL.cut, ("#RND=5", "#CHR=31")),
    "corner-straight": (MANUAL.cut, ("X40 Y40", "X60")),
    "line-reversed": (MANUAL.angled, ("X40", "X-40")),
}
_COUNTED = "the arc has neither a centre nor a radius; its centre counts as where it begins, and the radius is 0"
_ROWS = (
    # Without G164, a centre that is missing counts 0.
    row(rule.code, _COUNTED, like=rule, finds=rule.when & ~some(UNCORRECTED))
    if rule.code == "isg-circle-undefined" and rule.when is not None
    else rule
    for rule in rules_of(MANUAL, _OWN, _GEOMETRY)
)
RULES = WORDS.tell(
    *with_pages(
        _ROWS,
        BOOK,
        {
            "isg-circle-undefined": "G02, G03; G165",
            "isg-angle-on-arc": "contour line programming",
            "isg-angles-parallel": "diagnosis: 21892",
            "isg-center-and-radius": "diagnosis: 21024; newer 22159",
            "isg-corner-both": "diagnosis: 20130",
            "isg-end-missing": "diagnosis: 21904",
        },
    )
)
