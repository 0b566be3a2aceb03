"""Modal state, and the way from blocks to profiles."""

from contoursolve.reading.advance import Modes, advance, apply_modes, codes_of, positions
from contoursolve.reading.beyond import end_of_contour, leave, next_place
from contoursolve.reading.claim import Claim, Selector, Trouble, read, unused_words
from contoursolve.reading.codes import Code, Effect
from contoursolve.reading.form import CornerRow, FactRow, Form, Sample, lay_out, stated_sets
from contoursolve.reading.lexicon import Address, Lexicon, NumberFormat, WithoutPoint
from contoursolve.reading.plain import advance_plainly, is_plain, motion_of, plain_lines, words_of
from contoursolve.reading.setting import AT_ITS_LIMIT, Assumption, Convention, Setting
from contoursolve.reading.state import Awaited, Position, State

__all__ = [
    "AT_ITS_LIMIT",
    "Address",
    "Assumption",
    "Awaited",
    "Claim",
    "Code",
    "Convention",
    "CornerRow",
    "Effect",
    "FactRow",
    "Form",
    "Lexicon",
    "Modes",
    "NumberFormat",
    "Position",
    "Sample",
    "Selector",
    "Setting",
    "State",
    "Trouble",
    "WithoutPoint",
    "advance",
    "advance_plainly",
    "apply_modes",
    "codes_of",
    "end_of_contour",
    "is_plain",
    "lay_out",
    "leave",
    "motion_of",
    "next_place",
    "plain_lines",
    "positions",
    "read",
    "stated_sets",
    "unused_words",
    "words_of",
]
