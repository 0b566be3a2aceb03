"""YASNAC LX3: the words of examples."""

from contoursolve.controls.own_words import G_CODES, NO_CONTROL, UNKNOWN, OwnWords

_GAPS = {
    **G_CODES,
    "start": "G00 X40. Z0.\n",
    "contour": "{block}{more}",
    "block": "G111 A180. K-30. B120. X100. {corner}{size}",
    "corner": "P",
    "size": "5.",
    "whole": "5",
    "start_whole": "G00 X40 Z0\n",
    "start_again": "G00 X40. Z0.",
    "elsewhere": "G00 X130. Z0.",
    "steps": "G111 A180. K-30. B120. U60.",
    "move": "G01 X120. Z-80.",
    "move_whole": "G01 X120 Z-80",
    "foreign": "R5.",
    "with_variable": "{known}=-30.\n{start}G111 A180. K{known} B120. X100.",
    "of_others": ",A30.",
    "other_corner": "C2.",
    "end_word": "X100.",
    "missed": "Z-47.3",
    "unfinished": "G111 A180. B120. X100.",
    "again": "G111 A180. K-10. B120. X120.",
    "cycle": "G00 X140. Z2.\nG71 P10 Q20 U.4 W.1 F.2\nN10 G00 X40.\nG01 Z0.\n{block}\nN20 G01 {on}\nG70 P10 Q20",
    "on": "X120.",
    "back_in_cycle": "X90.",
}
_OPEN = {
    "wrong": "{start}G111 A180. K-30. B120. ({said})",
    "right": "{start}G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",
}
_STATED = "{start}G111 X100. Z-47. B120. (contoursolve: length of line 1 = 30)"
_SLIPS = {
    "words-redundant": {"more": " U60."},
    "words-conflict": {"more": " U50."},
    "word-idle": {"wrong": "G01 X50. R2.\nZ-60."},
    "fact-beyond": {
        "wrong": "{start}G111 A180. K-30. X100. (contoursolve: line 2 passes through [Z-60. X160.])",
    },
    "word-unused": {"wrong": "{start}G11 X80. Z-20. I8.", "options": "--rules off"},
    "letter-for-digit": {"behind": "\nG1l1 A180. B120. X160. Z-80."},
    "code-mistyped": {"behind": "\nG110 A180. B120. X160. Z-80."},
    "suspected": {"wrong": "{start}G111 A180. K-30. B60. X100.\nG01 Z-60."},
    "corner-nowhere": {"wrong": "{start}G111 A180. K-30. X100. Z-47. D2."},
    "several-contours": {"wrong": "{start}G111 X100. Z-47. B120. (contoursolve: length of line 1 = 30)"},
    "no-point": {"wrong": "{start}G111 X100. Z-47. B120. (contoursolve: length of line 1 = 3)"},
    "facts-singular": {"wrong": "{start}G111 I0 B120. X100. (contoursolve: direction of line 1 = 180)"},
    "fact-conflict": {"said": "contoursolve: line 2 passes through [Z-40. X80.]"},
    "out-of-range": {"wrong": "{start}G111 A180. K-10. B179.9999999999 X41."},
    "line-vanishes": {"wrong": "{start}G111 I0 K0 B120. X100."},
    "axis-crossed": {"wrong": "G00 X-40. Z0.\nG111 A180. K-30. B120. X100."},
    "start-skippable": {"between": "/G01 X50.\n"},
    "fact-unreadable": {**_OPEN, "said": "contoursolve: length of line 9 = 20"},
    "fact-impossible": {**_OPEN, "said": "contoursolve: radius of line 2 = 20"},
    "contour-waits": {"contour": "G111 A180. B120. X100."},
    "start-assumed": {"size": "90.", "behind": "\n{again}"},
}
_ABSENT = {
    **NO_CONTROL,
    **UNKNOWN,
    "words part by themselves": "blank-missing word-mistyped word-beside-code",
    "its X is a diameter throughout": "machine-taken start-diameter",
    "no block is known to cause it here": "contour-sensitive cut-free not-checked arc-radius-differs",
}
WORDS = OwnWords(_GAPS, _SLIPS, _ABSENT)
