"""SINUMERIK: the words of examples."""

from contoursolve.controls.chain.rules import ExampleWords, gaps_of
from contoursolve.controls.own_words import (
    AS_WRITTEN,
    NO_ARGUMENTS,
    NO_CODES,
    NO_COMMAS,
    NO_CONTROL,
    NO_MEASURE,
    NO_PAIRS,
    NO_SIGNS,
    UNKNOWN,
    OwnWords,
)

EXAMPLES = ExampleWords(angle="ANG=", corner="RND=", radius="CR=20", before_arc="G1 X40 RND=6")
_GAPS = {
    **gaps_of(EXAMPLES),
    "comment": "; {said}",
    "variable": "R101",
    "known": "R1",
    "jump": "IF R1==1 GOTOF FIVE\nG70\nFIVE: ",
    "nowhere": "GOTOF END\n",
    "call": "CALLED",
    "call_file": "CALLED",
    "file_name": "CALLED.SPF",
    "return": "M17",
    "mistyped": "AGN=5",
    "move": "G1 X50 Y50",
    "end_word": "Y40",
    "missed": "Y40.3",
    "start_again": "G0 X0 Y0",
    "elsewhere": "G0 X28 Y0",
    "subprogram": "\nM30\n%_N_CALLED_SPF\n{contour}\nM17",
    "unread": "G1 AP=30 RP=20",
    "no_word": "P5",
    "of_others": ",A30",
    "idle": "CR=5",
    "other_corner": "CHR=5",
    "straight_on": "X60",
    "turned_back": "X10",
    "hardly_turned": "X60 Y0.3",
    "small_radius": "CR=5",
    "beside_code": "G25 {corner}{size}",
    "in_inches": "G70\n",
    "turned": "{plane}G90 DIAMON\nG0 X60 Z2\nG1 X40 F0.2\nZ-20 RND=2\nX52",
    "plane": "G18 ",
    "asked": "{line} X=? {across} {corner}{size}\n{on_to} {comment}",
    "parametrised": "PROC SLOT(REAL RAD)\nG17 G90 G0 X0 Y0\nG1 X60\nY40 RND=RAD\nX20",
    "after": "X80",
    "center_off": "I18 J0",
    "opposite_end": "X80 Y0",
    "half_radius": "CR=19.9995",
    "foreign": ",R5",
    "opposite": "210",
}
_SLIPS = {
    "comma-word-unknown": {"behind": "\nG1 X50 ,R5 G4"},
    "siemens-chamfer-along-arc": {
        "wrong": "{start}G1 X30 CHR=2\nG2 X50 Y20 CR=20",
        "options": "--setting CONTROL.chamfer-on-arc=arc_length",
    },
    "siemens-closing-increment": {
        "wrong": "{start}G1 X10 Y5\nANG=30 RND=6\nX=IC(60) Y=IC(20) ANG=-45",
        "options": "--setting CONTROL.closing-incremental=error",
    },
    **{
        f"siemens-{word.lower()}-left-out": {
            "wrong": f"{{start}}G1 X30 {word}=5\nG18\nX40 Z40",
            "options": "--setting CONTROL.no-second-move=leave-out",
        }
        for word in ("CHR", "CHF", "RND")
    },
    "siemens-corner-without-next": {"turn": "M30", "options": "--setting CONTROL.no-second-move=error"},
    "siemens-plane-changes": {"turn": "G18 X40 Z40", "options": "--setting CONTROL.no-second-move=error"},
    "siemens-corner-rapid": {"line": "", "options": "--setting CONTROL.rapid-corner=error"},
    "axis-crossed": {"wrong": "G18 DIAMON G90 G0 X20 Z0\nG1 Z-20 RND=2\nX-20 Z-30"},
    "corner-twice": {"contour": "G1 X30 CHR=5 CHF=5\nX40 Y40"},
    "start-diameter": {"wrong": "G18 DIAMON\nG1 X40 RND=2\nZ-50\nG0 Y5", "options": '--start "X20 Z0"'},
}
_ABSENT = {
    **AS_WRITTEN,
    **NO_ARGUMENTS,
    **NO_CODES,
    **NO_COMMAS,
    **NO_CONTROL,
    **NO_PAIRS,
    **NO_MEASURE,
    **NO_SIGNS,
    **UNKNOWN,
    "a comment ends with its line, and words part by themselves": "comment-not-closed blank-missing",
    "its programs stand in files of their own": "text-outside",
    "it has no such cycle": "profile-turns-back",
    "its corners lie where both elements are known": "corner-nowhere cut-free",
}
_RIGHT = {
    "siemens-two-chamfers": ("{start}G1 X30 CHR=5\nX40 Y40", "{start}G1 X30 CHF=5\nX40 Y40"),
    "siemens-center-and-radius": (
        "{start}G1 X40 RND=6\nG2 X60 Y20 CR=20",
        "G18 DIAMOF G90 G0 X0 Z0\nG1 X40 RND=6\nG2 X60 Z-20 I20 K0",
    ),
    "siemens-diameter-changes": (
        "G18 DIAM90 G90 G0 X20 Z0\nG1 Z-10\nG91 X5 RND=1\nG90 Z-30 RND=1\nX40",
        "G18 DIAM90 G90 G0 X20 Z0\nG1 Z-10\nX=DAC(30) RND=1\nZ-30 RND=1\nX=RIC(5)",
        "G18 DIAM90 G90 G0 X20 Z0\nG1 Z-10\nX=DIC(10) RND=1\nZ-30 RND=1\nX=RAC(20)",
    ),
    "siemens-closing-increment": (
        "{start}G1 X=AC(30) Y=AC(0) RND=5\nX=IC(10) Y=IC(40)",
        "G18 DIAMON G90 G0 X0 Z0\nG1 Z=AC(-30) RND=5\nX=AC(40) Z=IC(-10)",
    ),
}
WORDS = OwnWords(_GAPS, _SLIPS, _ABSENT, _RIGHT)
