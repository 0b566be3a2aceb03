"""ISG kernel, as in Beckhoff TwinCAT CNC and KUKA: #ANG, #RND, #CHR, #CHF, G301 and G302 in lines and arcs in a row.

Its words, language and rules come in; a control goes out. Begin with `language`.
"""

import re

from contoursolve.controls.arc_facts import reading_arcs
from contoursolve.controls.chain import ChainFinder, forms_of
from contoursolve.controls.control_settings import SETTINGS_OF_ALL, with_default
from contoursolve.controls.isg.language import LANGUAGE, SETTINGS
from contoursolve.controls.isg.lexicon import CHAMFER, MODES, ROUNDING, SYNTAX
from contoursolve.controls.isg.rules import RULES
from contoursolve.controls.plain import PLANES
from contoursolve.gcode import Block, Word, words_as
from contoursolve.reading import Control, Diameter

_CORNER = re.compile(r"G[ \t]*+(?:=[ \t]*+)?30[12]", re.IGNORECASE)
"""Most blocks have none of it, and need not be read again."""


_OWN = LANGUAGE.own


def _signs(block: Block) -> tuple[Word, ...]:
    """The words that show the control: those with a number sign, and corners in blocks of their own."""
    if "#" not in block.text and not _CORNER.search(block.text):
        return ()
    codes, words = (CHAMFER, ROUNDING), words_as(block, SYNTAX)
    return tuple(word for word in words if word.address in _OWN or (word.address == "G" and word.number in codes))


_ISG = Control(
    name="isg",
    title="ISG kernel: Beckhoff TwinCAT CNC, KUKA",
    modes=MODES,
    plane=PLANES[17],
    forms=forms_of(LANGUAGE, MODES),
    rules=RULES,
    find=ChainFinder(LANGUAGE),
    signs=_signs,
    contours="lines with #ANG, corners with #RND, #CHR or #CHF, and G301 or G302",
    settings=(*SETTINGS, *with_default(SETTINGS_OF_ALL, "tool-equal-radius", "error")),
    motion=1,
    diameter=Diameter.OFF,
)
ISG = reading_arcs(_ISG)
