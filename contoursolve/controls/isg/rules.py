"""ISG kernel: which words may be combined, and what has no solution. The error numbers are printed."""

from dataclasses import replace

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
from contoursolve.controls.rule_rows import with_pages
from contoursolve.diagnostics import Alarm, Evidence
from contoursolve.reading import Count, all_of, some

_IDS = {
    "angles-parallel": "21892 (two lines with equal angles, or 180 deg apart)",
    "angle-redundant": "21895 (an angle with both coordinates)",
    "end-missing": "21904 (contour line not completely defined)",
    "closing-incomplete": "21904 (contour line not completely defined)",
    "closing-increment": "21910 (second block incremental)",
    "circle-uncorrected": "20036 (the radius of a circle is 0)",
    "corner-size": "20012 (no size, or 0)",
    "corner-both": "20130 (two G codes of one group)",
    "center-and-radius": "21024 (centre and radius at once; newer controls: 22159)",
    "corner-alone": "20351 (no motion block before), or 20701 (two corners without a motion between)",
}
_START = "G17 G90 G0 X0 Y0\n"
MANUAL = Manual(
    prefix="isg",
    source=BOOK.printed("contour line programming; chamfers and roundings"),
    angle="#ANG",
    chamfers=("#CHR", "#CHF"),
    rounding="#RND",
    radius="R",
    examples=EXAMPLES,
    alarms={code: Alarm(number, Evidence.PRINTED) for code, number in _IDS.items()},
)
_row, _PRINTED = MANUAL.row, Evidence.PRINTED
_BLOCK = _START + "G1 X30\nG302 I5\nG1 X40 Y40"
_UNCORRECTED = MANUAL.arc.replace("G17", "G17 G164")
_CORNERS = (("#CHR",), ("#CHF",), ("#RND",))

_OWN = (
    _row("two-corners", "{words}: a corner takes one of #RND, #CHR and #CHF", "keep one of them",
         Count(_CORNERS, 2), ANY, MANUAL.cut, ("#RND=5", "#RND=5 #CHR=5")),
    _row("corner-twice", "{words}: the block after it makes a corner in the same place", "keep one of them",
         some(CORNER_TWICE), ANY, MANUAL.cut, ("\nX40", "\nG302 I5\nG1 X40")),
    _row("corner-crowded", "the block after it makes a corner, and takes the size I of one corner alone",
         "put everything else in a block of its own", some(CORNER_CROWDED), ANY, _BLOCK, (" I5", " I5 X50"),
         (" I5", " I5 I6"), (" I5", " I5 #RND=3")),
    _row("corner-both", "the block after it has G301 and G302, which are of one group",
         "keep one of them", some(CORNER_BOTH), ANY, _BLOCK, ("G302", "G301 G302")),
    _row("angle-redundant", "{words} is one word too many beside both coordinates{comparison}",
         "delete a coordinate, or the angle", all_of(FIRST, SECOND, "#ANG") & ~some(FOLLOWED), (LINE,), MANUAL.angled,
         ("X40", "X40 Y20"), evidence=_PRINTED, ignores="#ANG"),
    _row("closing-increment", "{words}: the second of two lines gives its end in absolute coordinates",
         "write it with G90", some(*STEPS), (OVER_LINE,), MANUAL.vertex, ("\n", "\nG91 "), evidence=_PRINTED),
    _row("corner-size", "the corner has no size: I is missing or 0, and no corner before it gave one",
         "write the size after G301 or G302, such as I5", some(NO_SIZE), ANY, _BLOCK, (" I5", ""), (" I5", " I0"),
         evidence=_PRINTED),
    _row("corner-alone", "G301 and G302 stand between two moves; here no move is right before",
         "put the corner right after the move that it ends", some(CORNER_ALONE), (LINE,), _BLOCK,
         ("G302 I5", "G302 I5\nG301 I2"), evidence=_PRINTED),
    _row("circle-uncorrected", "the arc has neither a centre nor a radius", "add I, J or K of the plane, or R",
         ~some(*STATED_CENTER, "R") & some(UNCORRECTED), (ARC,), _UNCORRECTED, (" I20 J0", ""), evidence=_PRINTED),
    _row("diameter-changes", "X is a diameter in one block of the contour and a radius in another",
         "write G51 or G52 before its first block", some(OTHER_DIAMETER), ANY,
         "G18 G51 G90 G0 X20 Z0\nG1 X40 #RND=2\nG1 Z-50",
         ("Z-50", "G52 Z-50")),
)  # fmt: skip


_GEOMETRY = {
    "corner-too-large": (MANUAL.cut, MANUAL.cut.replace("#RND=5", "#CHR=31")),
    "corner-straight": (MANUAL.cut, MANUAL.cut.replace("X40 Y40", "X60")),
    "line-reversed": (MANUAL.angled, MANUAL.angled.replace("X40", "X-40")),
}
_COUNTED = "the arc has neither a centre nor a radius; its centre counts as where it begins, and the radius is 0"
_ROWS = (
    # Without G164, a centre that is missing counts 0.
    replace(rule, message=_COUNTED, when=rule.when & ~some(UNCORRECTED))
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
