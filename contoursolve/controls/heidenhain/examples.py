"""HEIDENHAIN: the words of examples."""

from contoursolve.controls.own_words import AS_WRITTEN, G_CODES, NO_CODES, NO_COMMAS, NO_CONTROL, NO_SIGNS, OwnWords

_GAPS = {
    **G_CODES,
    "start": "0 BEGIN PGM A MM\n1 L X+0 Y+0\n",
    "contour": "{block}\n3 {corner}{size}{more}\n{turn}",
    "block": "2 L X+40 Y+0",
    "corner": "RND R",
    "turn": "4 L X+40 Y+30",
    "tail": "\n9 END PGM A MM",
    "comment": "; {said}",
    "size": "5",
    "move": "5 L X+50 Y+50",
    "element": "line 2",
    "variable": "+Q1",
    "unfinished": "2 FL AN+30",
    "end_word": "Y+30",
    "missed": "Y+30.3",
    "of_others": ",A30",
    "straight_on": "4 L X+80 Y+0",
    "turned_back": "4 L X+10 Y+0",
    "mistyped": ",CHF2",
    "idle": "AN+60",
    "twice": "2 L X+40 Y+0\n3 RND R{each}\n4 L X+40 Y+40\n5 RND R{each}\n6 L X+80 Y+40",
    "each": "5",
    "one_axis": "4 L Y+30",
    "again": "5 M8\n6 L X+90\n7 RND R5\n8 L Y+60",
    "nowhere": "2 FN 9: IF +0 EQU +0 GOTO LBL 20\n",
    "call": "2 CALL LBL 1",
    "start_again": "3 L X+0 Y+0",
    "elsewhere": "3 L X+38 Y+0",
    "subprogram": "\n5 M30\n6 LBL 1\n7 L X+40 Y+0\n8 RND R5\n9 L X+40 Y+30\n10 LBL 0{tail}",
    "call_file": "2 CALL PGM O200.H{tail}",
    "file_name": "O200.H",
    "return": "9 END PGM O200 MM",
    "asked": "2 FL X? {across} {comment}\n3 FL X+80 Y+20",
    "across": "Y+40",
    "level": "Y+0",
    "in_inches": "0 BEGIN PGM A INCH\n",
    "vertex_blocks": "2 FL AN+30\n3 FL X+80 Y+20 {closing}",
    "closing": "AN-30",
    "opening": "AN+30",
    "angled_block": "2 FL {end} {degrees}",
    "end": "X+40",
    "degrees": "AN+60",
    "at_start": "X+0",
    "across_end": "AN+90",
}
_SLIPS = {
    "blank-missing": {"wrong": "0 BEGIN PGM A MM\n1 L X+0 Y+0\n2 FLAN+30 LEN20\n3 FL X+60 Y+40{tail}"},
    "word-unused": {"contour": "{block}\n3 RND R5", "options": "--rules off"},
    "heidenhain-first-taken": {
        "wrong": "{start}2 FL LEN40 P1X+30 P1Y+10\n3 FL X+80 Y+20{tail}",
        "options": "--set CONTROL.ambiguous=first",
    },
    "cut-free": {
        "wrong": "{start}2 FL X+0 Y+20\n3 FL Y+20\n4 FL X+50 Y+20{tail}",
        "right": "{start}2 FL X+0 Y+20\n3 FL X+20 Y+20\n4 FL X+50 Y+20{tail}",
    },
    "several-contours": {"wrong": "{start}2 FL LEN40 P1X+30 P1Y+10\n3 FL X+80 Y+20{tail}"},
    "no-point": {"wrong": "{start}2 FC DR+ R5 X+40 Y+0{tail}"},
    "search-unfinished": {"wrong": "{start}2 FL X+40 Y+0\n3 FC DR- R20 CCX+60 X+80\n4 FLT Y-20{tail}"},
    "fact-beyond": {"said": "contoursolve: line 4 passes through [X40. Y80.]"},
    "line-vanishes": {"wrong": "{start}2 L Y+0\n3 RND R5\n4 L X+40{tail}"},
    "double": {"wrong": "{start}2 FL X+40 Y+0\n3 FC DR- R20 CCX+60 CCY+0 X+80{tail}"},
    "arc-empty": {"wrong": "{start}2 FC DR+ CCX+20 CCY+0 R20 X+0 Y+0{tail}"},
    "radius-difference": {"wrong": "{start}2 L X+20 Y+0\n3 RND R5\n4 CC X+60 Y+5\n5 C X+60 Y+20 DR-{tail}"},
}
_ABSENT = {
    **AS_WRITTEN,
    **NO_CODES,
    **NO_COMMAS,
    **NO_CONTROL,
    **NO_SIGNS,
    "its words have no codes": "word-beside-code not-read",
    "a comment ends with its line": "comment-not-closed",
    "a program begins with BEGIN PGM": "text-outside",
    "it is on mills": "profile-turns-back machine-taken start-diameter axis-crossed",
    "its elements are solved together: what fits nowhere has no point": "point-is-start circle-missed radius-too-small "
    "circles-apart circle-undefined line-reversed line-backwards radius-differs half-circle angle-opposite "
    "corner-dropped corner-twice corner-nowhere contour-sensitive",
    "no block is known to cause it here": "count-open only-unproven not-verified suspected mode-unknown not-checked",
}
_RIGHT = {
    "heidenhain-tangent-first": (
        "{start}2 FL X+30 Y+0\n3 FCT DR+ R10 CCA+0\n4 FLT X+40 Y+30{tail}",
        "{start}2 L X+20 Y+0\n3 CT X+40 Y+20{tail}",
    ),
    "heidenhain-tool-axis": ("{start}2 L Z+5\n3 L X+40 Y+0\n4 RND R5\n5 L X+40 Y+30{tail}",),
}
WORDS = OwnWords(_GAPS, _SLIPS, _ABSENT, _RIGHT)
