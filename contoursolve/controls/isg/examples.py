"""ISG kernel: the words of examples."""

from contoursolve.controls.chain.rules import ExampleWords, gaps_of
from contoursolve.controls.own_words import (
    AS_WRITTEN,
    NO_ARGUMENTS,
    NO_COMMAS,
    NO_CONTROL,
    NO_MEASURE,
    NO_PAIRS,
    NO_SIGNS,
    UNKNOWN,
    OwnWords,
)

EXAMPLES = ExampleWords(angle="#ANG=", corner="#RND=", radius="R20", before_arc="G1 X40 #RND=6")
_GAPS = {
    **gaps_of(EXAMPLES),
    "comment": "({said})",
    "variable": "P101",
    "known": "P1",
    "jump": "$IF P1==1\nG70\n$ENDIF\n",
    "nowhere": "$GOTO N20\n",
    "call": "LL CALLED",
    "call_file": "L CALLED",
    "file_name": "CALLED",
    "return": "M17",
    "mistyped": "#AGN=5",
    "move": "G1 X50 Y50",
    "end_word": "Y40",
    "missed": "Y40.3",
    "start_again": "G0 X0 Y0",
    "elsewhere": "G0 X28 Y0",
    "no_word": "Q1",
    "of_others": "RND=5",
    "idle": "R5",
    "other_corner": "#CHR=5",
    "straight_on": "X60",
    "turned_back": "X10",
    "hardly_turned": "X60 Y0.3",
    "small_radius": "R5",
    "beside_code": "G1 X50 G310 {corner}{size}",
    "in_inches": "G70\n",
    "turned": "{plane}G90 G51\nG0 X60 Z2\nG1 X40 F0.2\nZ-20 #RND=2\nX52",
    "plane": "G18 ",
    "after": "X80",
    "center_off": "I18 J0",
    "opposite_end": "X80 Y0",
    "half_radius": "R19.9995",
    "foreign": "Q5",
    "opposite": "210",
}
_SLIPS = {
    "start-assumed": {"size": "99.", "turn": "X40 #ANG=60"},
    "start-diameter": {"wrong": "G18 G51\nG1 X40 #RND=2\nZ-50", "options": '--start "X20 Z0"'},
    "number-missing": {"before": "X"},
    "number-malformed": {"corner": "#RND"},
    "calls-differ": {
        "program": "%L CALLED\n{block}\n{turn}\nM17\n%MAIN\n{start}{call}\n{place}\n{call}\nM30",
    },
    "axis-crossed": {"wrong": "G18 G51 G90 G0 X20 Z0\nG1 Z-20 #RND=2\nX-20 Z-30"},
    "code-mistyped": {"wrong": "{start}G1 X30 #RND=5\nX40 Y40\nG300 I5\nX50 Y0"},
}
_ABSENT = {
    **AS_WRITTEN,
    **NO_ARGUMENTS,
    **NO_COMMAS,
    **NO_CONTROL,
    **NO_PAIRS,
    **NO_MEASURE,
    **NO_SIGNS,
    **UNKNOWN,
    "a comment may end with its line, and words part by themselves": "comment-not-closed blank-missing",
    "no code of a contour has such a letter": "letter-for-digit",
    "its programs stand in files of their own": "text-outside",
    "it has no such cycle": "profile-turns-back",
    "its corners lie where both elements are known": "corner-nowhere cut-free",
    "none of its codes is left unread": "not-read",
    "no subprogram has parameters": "not-checked",
    "an angle is that of the travel": "angle-opposite",
}
_RIGHT = {
    "isg-two-corners": ("{start}G1 X30 #CHR=5\nX40 Y40", "{start}G1 X30 #CHF=5\nX40 Y40"),
    "isg-corner-crowded": ("{start}G1 X30\nG302 I5 F200\nG1 X40 Y40",),
    "isg-corner-rapid": ("{start}G0 X30\nG302 I5\nG1 X40 Y40", "{start}G1 X30\nG301 I5\nG0 X40 Y40"),
    "isg-corner-size": ("{start}G1 X30\nG301 I5\nG1 X40 Y40",),
    "isg-center-and-radius": (
        "{start}G1 X40 #RND=6\nG2 X60 Y20 R20",
        "G18 G90 G0 X0 Z0\nG1 X40 #RND=6\nG3 X60 Z20 I20 K0",
    ),
}
WORDS = OwnWords(_GAPS, _SLIPS, _ABSENT, _RIGHT)
