"""The NCT 99M and 2000M milling controls, from chapter 16 of their Programmer's Manual."""

from contoursolve.controls.arc_facts import reading_arcs
from contoursolve.controls.chain import ChainFinder, forms_of
from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.control_settings import SETTINGS_OF_ALL, arguments_setting
from contoursolve.controls.nct_99m.examples import WORDS
from contoursolve.controls.nct_99m.language import LANGUAGE, SETTINGS
from contoursolve.controls.nct_99m.lexicon import CODES, CODES_SOURCE, MODES, XY, YZ, ZX
from contoursolve.controls.nct_99m.rules import COMBINATION_RULES, GEOMETRY_RULES
from contoursolve.gcode import Block, Word
from contoursolve.reading import Control, Effect


def _signs(block: Block) -> tuple[Word, ...]:
    shown = {",A", ",C", ",R"} | _over_defining(block)
    if block.find(",A"):
        shown |= {"Q"}
    return tuple(word for word in block.words if word.address in shown)


def _over_defining(block: Block) -> set[str]:
    """The addresses that show an over-defined circle, whose G2 or G3 may stand in a block before (p. 134).

    A lathe's arc may have X, Z, I, K and R, too: there Q has to tell, and without G2 or G3 one that is no length.
    """
    stated = {word.address for word in block.words}
    motions = {word.number for word in block.words if word.address == "G"} - _OTHER_CODES
    plane = next((each for each in (XY, ZX, YZ) if stated >= {*each.axes, *each.centers, "R"}), None)
    if plane is None or not motions <= {2, 3}:
        return set()
    q = block.find("Q")
    if plane is ZX and (q is None or (q.has_point and not motions)):
        return set()
    return {*plane.centers, "R", "Q"}


_MOVING = (Effect.MOTION, Effect.CYCLE, Effect.SINGLE)
_OTHER_CODES = {number for number, code in CODES.items() if code.effect not in _MOVING}


_NCT_99M = Control(
    name="nct-99m",
    title="NCT 99M and 2000M milling controls",
    modes=MODES,
    plane=XY,
    forms=forms_of(LANGUAGE, MODES),
    rules=WORDS.tell(*COMMON_RULES, *COMBINATION_RULES, *GEOMETRY_RULES),
    find=ChainFinder(LANGUAGE),
    signs=_signs,
    contours="blocks with ,A ,C or ,R, arcs with R, and intersections by ,A or by end, centre and R",
    settings=(*SETTINGS, arguments_setting(CODES_SOURCE), *SETTINGS_OF_ALL),
)
NCT_99M = reading_arcs(_NCT_99M)
