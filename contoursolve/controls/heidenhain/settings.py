"""Conventions of free contour programming on which the manuals are silent."""

from contoursolve.controls.common import setting
from contoursolve.controls.heidenhain.lexicon import BOOK

SELECTION = setting(
    "fselect",
    "which of several solutions FSELECT takes",
    {
        "own_order": "by travel: the nearer end along the element first, then the smaller turn to the left",
        "ignore": "none: what the program says besides must choose",
    },
    BOOK.assumed("the order is on no page"),
)
AMBIGUOUS = setting(
    "ambiguous",
    "what comes of several solutions without FSELECT",
    {"error": "it is refused, with all of them", "first": "the first one is taken, in the order of FSELECT"},
    BOOK.assumed("an open contour cannot be run"),
)
SETTINGS = (SELECTION, AMBIGUOUS)
