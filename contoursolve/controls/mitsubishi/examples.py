"""Mitsubishi: the words of examples."""

from contoursolve.controls.chain.rules import ExampleWords, gaps_of
from contoursolve.controls.own_words import NO_CODES, NO_CONTROL, NO_MEASURE, NO_SIGNS, UNKNOWN, OwnWords

_WORDS = ExampleWords(
    start="G17 G90 G00 X0 Y0\n",
    line="G01",
    angle="A",
    corner=",R",
    size="5.",
    before="X30.",
    turn="X40. Y40.",
    end="X40.",
    degrees="30.",
    opening="70.",
    closing="-30.",
    closing_end="X80. Y25.",
    before_arc="G01 X40. ,C6.",
    arc_code="G02",
    arc_end="X60. Y20.",
    center="I20. J0",
    radius="R20.",
)
_GAPS = {
    **gaps_of(_WORDS),
    "comma_lost": "R",
    "other_corner": ",C5.",
    "whole": "5",
    "start_whole": "G17 G90 G00 X20 Y10\n",
    "start_again": "G00 X0 Y0",
    "elsewhere": "G00 X28. Y0",
    "move": "G01 X50. Y50.",
    "move_whole": "G01 X50 Y50",
    "end_word": "Y40.",
    "missed": "Y40.3",
    "of_others": "RND5.",
    "idle": "R5.",
    "straight_on": "X60.",
    "turned_back": "X10.",
    "hardly_turned": "X60. Y0.3",
    "small_radius": "R5.",
    "after": "X80.",
    "leaving": "G03 I30. J0 H0\nG01 X20. Y-60. A-90.",
    "center_off": "I18. J0",
    "opposite_end": "X80. Y0",
    "half_radius": "R19.9995",
    "foreign": "C4.",
    "opposite": "210.",
}
_INCREMENTS = {"options": "--setting CONTROL.number=increment"}
_SLIPS: dict[str, dict[str, str]] = {
    **dict.fromkeys(("point-missing", "point-lost", "start-in-increments", "move-in-increments"), _INCREMENTS),
    "mitsubishi-two-corners": {
        "contour": "{line} {before} ,C5. {corner}{size}\n{turn}",
        "options": "--setting CONTROL.two-corner-words=error",
    },
    "corner-twice": {"more": " {other_corner}", "options": "--setting CONTROL.two-corner-words=error"},
    "mitsubishi-corner-arc": {"contour": "{arc_blocks}", "options": "--setting CONTROL.corner=I"},
    "mitsubishi-chamfer-along-arc": {
        "contour": "{arc_blocks}",
        "options": "--setting CONTROL.chamfer-on-arc=arc_length",
    },
    "mitsubishi-centre-from-end": {"contour": "{leaving}", "options": "--setting CONTROL.first-centre=end"},
    "mitsubishi-centre-of-diameter": {
        "wrong": "G18 G90 G00 X0 Z0\nG03 P30. Q0 H0\nG01 X20. Z-60. A-90.",
        "options": "--setting CONTROL.diameter=on",
    },
    "mitsubishi-h-missing": {
        "wrong": "{start}G01 A10.\nG02 X60. Y10. I-20. J-25.",
        "options": "--setting CONTROL.h-default=error",
    },
}
_SLIPS |= {
    "touches": {"wrong": "{start}{line} A0.\nG02 X60. Y10. I-20. J15. H0"},
    "arc-empty": {"wrong": "{start}{line} A0.\nG02 X60. Y0 I-20. J-25. H1"},
    "axis-crossed": {
        "wrong": "G18 G90 G00 X20. Z0.\nG01 Z-20. ,R2.\nX-20. Z-30.",
        "options": "--setting CONTROL.diameter=on",
    },
}
_ABSENT = {
    **NO_CODES,
    **NO_CONTROL,
    **NO_MEASURE,
    **NO_SIGNS,
    **UNKNOWN,
    "words part by themselves": "blank-missing",
    "it has no such cycle": "profile-turns-back",
    "its X is a radius or a diameter throughout": "machine-taken start-diameter",
    "its corners lie where both elements are known": "corner-nowhere cut-free",
    "no two arcs meet that have no ends of their own": "point-is-start circles-apart line-backwards double",
}
_RIGHT = {
    "mitsubishi-angle-range": ("{start}G01 X40. ,A30. ,R5.\nX80.",),
    "mitsubishi-center-and-radius": ("{start}G01 X40. ,C6.\nG02 X60. Y20. R20.",),
    "mitsubishi-outside-plane": ("G18 G90 G00 X0 Z0\nG01 X40. ,C6.\nG02 X60. Z20. I20. K0",),
}
WORDS = OwnWords(_GAPS, _SLIPS, _ABSENT, _RIGHT)
