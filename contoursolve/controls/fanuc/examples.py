"""Fanuc and Haas: the words of examples."""

from dataclasses import replace

from contoursolve.controls.chain.rules import ExampleWords, gaps_of
from contoursolve.controls.own_words import NO_CODES, NO_CONTROL, NO_PAIRS, NO_SIGNS, UNKNOWN, OwnWords

_LATHE = ExampleWords(
    start="G00 X20. Z0.\n",
    line="G01",
    angle=",A",
    corner=",R",
    size="5.",
    before="Z-20.",
    turn="X40. Z-30.",
    end="X40.",
    degrees="150.",
    opening="180.",
    closing="120.",
    closing_end="X60. Z-47.",
    before_arc="G01 Z-20. ,R2.",
    arc_code="G02",
    arc_end="X40. Z-30.",
    center="I10. K0",
    radius="R10.",
)
_MILL = replace(
    _LATHE,
    start="G17 G90 G00 X0 Y0\n",
    angle="",
    before="X30.",
    turn="X40. Y40.",
    before_arc="G01 X40. ,C6.",
    arc_end="X60. Y20.",
    center="I20. J0",
    radius="R20.",
)
_COMMA = {
    "comma_lost": "R",
    "of_others": "RND5.",
    "other_corner": ",C5.",
    "whole": "5",
    "foreign": "Q5.",
}
_TURNING = {
    **gaps_of(_LATHE),
    **_COMMA,
    "start_whole": "G00 X20 Z0\n",
    "asked": "{line} X? {across} {corner}{size} {comment}\nX90. Z-60.",
    "across": "Z-30.",
    "level": "Z0",
    "along": "90",
    "nearly_along": "90.0000000001",
    "across_end": "180.",
    "parametrised": "O7002\n{start}{line} Z#24 {corner}#18\nX60.\nZ-80.\nM99",
    "series": "{line} Z-15.\nX50. {angle}{odd}\nZ-60.\nX70. {angle}150.\nZ-90.\nX90. {angle}150.\nZ-120.",
    "odd": "150.",
    "unlike": "120.",
    "beside": "[Z-10. X40.]",
    "beyond": "[Z-50. X80.]",
    "repetition": "length of line 1 = 20",
    "at_start": "X20.",
    "stated_start": "X1. Z1.",
    "small_radius": "R3.",
    "center_off": "I8. K0",
    "opposite_end": "X60. Z-20.",
    "half_radius": "R9.9995",
    "opposite": "-30.",
    "start_again": "G00 X20. Z0.",
    "steps": "{line} W-20. {corner}{size}\nU20. W-10.",
    "elsewhere": "G00 X20. Z-18.",
    "move": "G01 X50. Z-50.",
    "move_whole": "G01 X50 Z-50",
    "again": "M8\n{line} X60. {corner}5.\nZ-60.",
    "one_axis": "X40.",
    "closing_on": "135.",
    "end_on": "X100. Z-40.",
    "end_word": "Z-30.",
    "missed": "Z-30.3",
    "beyond_axis": "X-40. Z-30.",
    "idle": "J5.",
    "after": "Z-50.",
    "hardly_turned": "Z-40. X20.2",
    "cycle": "G00 X140. Z2.\nG71 U2. R1.\nG71 P10 Q20 U.4 W.1 F.2\nN10 G00 X20.\nG01 Z0.\n{block}\n{turn}\nN20 {on}\n"
    "G70 P10 Q20",
    "on": "X120.",
    "back_in_cycle": "X30.",
}
_MILLING = {
    **gaps_of(_MILL),
    **_COMMA,
    "start_whole": "G17 G90 G00 X20 Y10\n",
    "start_again": "G00 X0 Y0",
    "elsewhere": "G00 X28. Y0",
    "move": "G01 X50. Y50.",
    "move_whole": "G01 X50 Y50",
    "unfinished": "{line} {before} {corner}?\n{turn}",
    "end_word": "Y40.",
    "missed": "Y40.3",
    "idle": "R5.",
    "after": "X80.",
    "hardly_turned": "X60. Y0.3",
    "center_off": "I18. J0",
    "small_radius": "R5.",
    "opposite_end": "X80. Y0",
    "half_radius": "R19.9995",
}
_ABSENT = {
    **NO_CODES,
    **NO_CONTROL,
    **NO_PAIRS,
    **NO_SIGNS,
    **UNKNOWN,
    "words part by themselves": "blank-missing",
    "its X is a radius or a diameter throughout": "machine-taken start-diameter",
    "its corners lie where both elements are known": "corner-nowhere cut-free contour-sensitive radius-differs",
}
_ON_HAAS = {**_ABSENT, "no two lines meet by their angles": "line-vanishes"}
_ON_MILLS = {
    **_ABSENT,
    "no line is stated by an angle": "lines-parallel not-fixed line-reversed angle-opposite",
    "the radius of a mill has no sign of a diameter": "axis-crossed profile-turns-back",
}
_OFF = {"options": "--rules off"}
_BESIDE_ARCS = dict.fromkeys(("radius-too-small", "circle-undefined", "radius-difference", "half-circle"), _OFF)
_VANISHED = {"wrong": "{start}G01 X0 {corner}{size}\nM8\n{turn}", **_OFF}
_STRAIGHT = {"turn": "{hardly_turned}", "options": "--setting CONTROL.guard-corner=error"}
_ALLOWED = "--setting CONTROL.generation=classic"
_TURNED = (
    "{start}G01 W-20. ,R5.\nU20. W-10.",
    "{start}G01 Z-20. ,R2.\nX40.\nG02 X60. Z-30. I10. K0",
    "{start}G01 Z-20. ,R2.\nX40.\nG02 X60. Z-30. R10.",
)
FANUC_LATHE_WORDS = OwnWords(
    _TURNING,
    {
        **_BESIDE_ARCS,
        "fanuc-angle-supplementary": {"contour": "{angled_block}", "options": "--setting CONTROL.angle=supplementary"},
        "fanuc-angle-redundant": {
            "wrong": "{start}G01 X40. Z-17.3205 ,A150.",
            "options": "--setting CONTROL.redundant-angle=error",
        },
        "fanuc-corner-straight": _STRAIGHT,
    },
    _ABSENT,
    {"fanuc-arc": _TURNED},
)
FANUC_MILL_WORDS = OwnWords(
    _MILLING,
    {
        "line-vanishes": _VANISHED,
        "fanuc-chamfer-along-arc": {
            "contour": "{arc_blocks}",
            "options": "--setting CONTROL.chamfer-on-arc=arc_length",
        },
        "fanuc-corner-straight": _STRAIGHT,
    },
    _ON_MILLS,
    {
        "fanuc-corner-outside-plane": ("G18 G90 G00 X0 Z0\nG01 X40. ,C6.\nG02 X60. Z20. I20. K0",),
    },
)
HAAS_LATHE_WORDS = OwnWords(
    {**_TURNING, "angle": "A", "of_others": ",A5.", "foreign": "Q5."},
    {**_BESIDE_ARCS, "haas-corner-straight": _STRAIGHT},
    _ON_HAAS,
    {
        "haas-arc": _TURNED,
        "haas-plane-changes": (
            "G17 G00 X60. Y2.\nG01 Y-20. ,R3.\nX100. ,C2.\nV-30.",
            "G19 G00 Y30. Z2.\nG01 Z-20. ,R3.\nY50. ,C2.\nW-30.",
        ),
    },
)
HAAS_MILL_WORDS = OwnWords(
    _MILLING,
    {
        "line-vanishes": _VANISHED,
        "haas-corner-straight": _STRAIGHT,
        **{code: {"options": _ALLOWED} for code in ("radius-too-small", "half-circle")},
        "haas-center-and-radius": {"contour": "{arc_blocks} {radius}", "options": _ALLOWED},
        "haas-circle-undefined": {"contour": "{arc_blocks}", "center": "", "options": _ALLOWED},
        "haas-radius-without-end": {
            "contour": "{arc_blocks}",
            "arc_end": "",
            "center": "{radius}",
            "options": _ALLOWED,
        },
    },
    _ON_MILLS,
    {
        "haas-center-and-radius": (
            "{start}{arc_blocks}",
            "{start}G01 X40. ,C6.\nG02 X60. Y20. R20.",
            "G18 G90 G00 X0 Z0\nG01 X40. ,C6.\nG03 X60. Z20. I20. K0",
        ),
    },
)
