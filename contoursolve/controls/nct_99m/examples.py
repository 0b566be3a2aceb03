"""NCT 99M: the words of examples."""

from contoursolve.controls.chain.rules import ExampleWords, gaps_of
from contoursolve.controls.own_words import AS_WRITTEN, NO_CODES, NO_CONTROL, UNKNOWN, OwnWords

_WORDS = ExampleWords(
    angle=",A",
    corner=",R",
    radius="R20",
    before_arc="G1 X40 ,C6",
    degrees="45",
    opening="150",
    closing="225",
    closing_end="X10 Y20",
)
_GAPS = {
    **gaps_of(_WORDS),
    "comma_lost": "R",
    "other_corner": ",C5",
    "start_again": "G0 X0 Y0",
    "elsewhere": "G0 X28 Y0",
    "move": "G1 X50 Y50",
    "end_word": "Y40",
    "missed": "Y40.3",
    "of_others": "RND5",
    "idle": "R5",
    "straight_on": "X60",
    "turned_back": "X10",
    "hardly_turned": "X60 Y0.3",
    "small_radius": "R5",
    "after": "X80",
    "foreign": "C4",
}
_SLIPS = {
    "contour-sensitive": {"wrong": "G17 G41 G0 X5000 Y0\nG3 I-5000 J0\nG1 X-6000 Y4999.9999999999 ,A180 Q-1"},
    "line-vanishes": {"wrong": "G17 G90 G41 G0 X10 Y10 D0\nG1 X10 ,A225"},
}
_ABSENT = {
    **AS_WRITTEN,
    **NO_CODES,
    **NO_CONTROL,
    **UNKNOWN,
    "words part by themselves": "blank-missing",
    "it is on mills": "profile-turns-back machine-taken start-diameter axis-crossed",
    "its corners lie where both elements are known": "corner-nowhere cut-free",
}
_RIGHT = {
    "nct-axis-outside-plane": (
        "G17 G90 G0 X0 Y0 U0\nG1 U40 ,A45\nX80 ,A0",
        "G17 G90 G0 X0 Y0 V0\nG1 V40 ,A45\nX80 ,A0",
    ),
    "nct-two-corners": ("G18 G90 G0 X0 Z0\nG1 X40 ,C6\nG2 X60 Z20 I20 K0",),
}
WORDS = OwnWords(_GAPS, _SLIPS, _ABSENT, _RIGHT)
