"""Mitsubishi M70, M700, M800 and E70: linear angle command, Geometric I and IB, corners ,C ,R.

Its words, language and rules come in; a control goes out. Begin with `language`.
"""

from contoursolve.controls.arc_facts import reading_arcs
from contoursolve.controls.chain import ChainFinder, forms_of
from contoursolve.controls.control_settings import SETTINGS_OF_ALL
from contoursolve.controls.mitsubishi.language import LANGUAGE, SETTINGS
from contoursolve.controls.mitsubishi.lexicon import MODES
from contoursolve.controls.mitsubishi.rules import RULES
from contoursolve.controls.plain import PLANES
from contoursolve.gcode import Block, Word
from contoursolve.reading import Control


def _signs(block: Block) -> tuple[Word, ...]:
    """H beside an arc about its centre is a word of this control alone; a plain A may be that of a rotary axis."""
    codes = {word.number for word in block.words if word.address == "G"}
    stated = {word.address for word in block.words}
    is_picked = codes <= {2, 3, 90} and codes & {2, 3} and stated & {"I", "J", "K"}
    shown = {"H"} if is_picked else {",C", ",R"} if "," in block.text else set()
    return tuple(word for word in block.words if word.address in shown)


_MITSUBISHI = Control(
    name="mitsubishi",
    title="Mitsubishi M70, M700, M800 and E70",
    modes=MODES,
    plane=PLANES[17],
    forms=forms_of(LANGUAGE, MODES),
    rules=RULES,
    find=ChainFinder(LANGUAGE),
    signs=_signs,
    rare=frozenset({",A"}),
    contours="lines with A or ,A, arcs without an end, H0 and H1 beside an arc, and ,C or ,R",
    settings=(*SETTINGS, *SETTINGS_OF_ALL),
)
MITSUBISHI = reading_arcs(_MITSUBISHI)
