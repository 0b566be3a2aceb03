"""The NCT 99M and 2000M milling controls, from chapter 16 of their Programmer's Manual."""

from contoursolve.dialects.common import COMMON_RULES
from contoursolve.dialects.dialect import Dialect
from contoursolve.dialects.nct_99m.chain import FORMS
from contoursolve.dialects.nct_99m.claim import CIRCLE_CIRCLE_Q
from contoursolve.dialects.nct_99m.find import find
from contoursolve.dialects.nct_99m.lexicon import MODES, XY
from contoursolve.dialects.nct_99m.rules import COMBINATION_RULES, GEOMETRY_RULES
from contoursolve.syntax import Block, Word


def _signs(block: Block) -> tuple[Word, ...]:
    stated = {word.address for word in block.words}
    is_over_defined_circle = (
        {"R", "Q"} <= stated
        and len(stated & {"I", "J", "K"}) == 2  # noqa: PLR2004 - the axes of a plane
        and any(word.address == "G" and word.number in (2, 3) for word in block.words)
    )
    if stated.isdisjoint((",A", ",C", ",R")) and not is_over_defined_circle:
        return ()
    shown = {",A", ",C", ",R"} | ({"I", "J", "K", "R", "Q"} if is_over_defined_circle else set())
    return tuple(word for word in block.words if word.address in shown)


NCT_99M = Dialect(
    name="nct-99m",
    title="NCT 99M and 2000M milling controls",
    modes=MODES,
    plane=XY,
    forms=FORMS,
    rules=COMMON_RULES + COMBINATION_RULES + GEOMETRY_RULES,
    find=find,
    signs=_signs,
    contours="blocks with ,A ,C or ,R, arcs with R, and blocks over-defined by ,A or by centre, R and Q",
    settings=(CIRCLE_CIRCLE_Q,),
)
