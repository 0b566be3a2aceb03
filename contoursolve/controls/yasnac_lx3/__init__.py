"""The YASNAC LX3 lathe control, from section 2.8.30 and pages 31-32 of its Instruction Manual."""

from contoursolve.controls.arc_facts import reading_arcs
from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.control_settings import SETTINGS_OF_ALL, arguments_setting
from contoursolve.controls.plain import LATHE
from contoursolve.controls.yasnac_lx3.examples import WORDS
from contoursolve.controls.yasnac_lx3.find import find, follow
from contoursolve.controls.yasnac_lx3.g111 import G111, G111_RULES
from contoursolve.controls.yasnac_lx3.g112 import G112_FORMS, G112_RULES
from contoursolve.controls.yasnac_lx3.leaving import LEAVING_FORMS, LEAVING_RULES
from contoursolve.controls.yasnac_lx3.lexicon import BEVEL, BOOK, MODES, MOTION_AFTER
from contoursolve.gcode import Block, Word
from contoursolve.reading import NAMED_FILE, POLAR_WORDS, SEMICOLON_COMMENT, Y_AXIS, Control

_OF_A_POCKET = frozenset("DJLQY")
"""Words of a circular pocket, which G12 is on Haas mills, and of no bevel or quarter circle."""


def _signs(block: Block) -> tuple[Word, ...]:
    """The words that show the control. G112 alone is polar interpolation on Fanuc and Haas lathes."""
    addresses = {word.address for word in block.words}
    codes = {111}
    if addresses & {*"XUZWIKR"}:
        codes.add(112)
    if addresses & {*"XUZW"} and addresses & {*"IK"} and not addresses & _OF_A_POCKET:
        codes |= {11, 12}
    return tuple(word for word in block.words if word.address == "G" and word.number in codes)


_YASNAC_LX3 = Control(
    name="yasnac-lx3",
    title="YASNAC LX3 lathe control",
    modes=MODES,
    plane=LATHE,
    forms=(G111, *G112_FORMS, *LEAVING_FORMS),
    rules=WORDS.tell(*COMMON_RULES, *G111_RULES, *G112_RULES, *LEAVING_RULES),
    find=find,
    signs=_signs,
    # On SINUMERIK, whose files have endings of their own, G111 and G112 state a pole; and this lathe has no Y.
    excluded_by=frozenset({Y_AXIS, POLAR_WORDS, SEMICOLON_COMMENT, NAMED_FILE}),
    contours="G111, G112, G11, G12, and G01 with I or K",
    settings=(BEVEL, MOTION_AFTER, arguments_setting(BOOK.assumed("not described")), *SETTINGS_OF_ALL),
    has_runs=False,
    follow=follow,
)
YASNAC_LX3 = reading_arcs(_YASNAC_LX3)
