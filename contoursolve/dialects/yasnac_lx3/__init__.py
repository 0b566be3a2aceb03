"""The YASNAC LX3 lathe control, from section 2.8.30 of its Instruction Manual."""

from contoursolve.dialects.common import COMMON_RULES
from contoursolve.dialects.dialect import Dialect
from contoursolve.dialects.yasnac_lx3.g111 import G111, find
from contoursolve.dialects.yasnac_lx3.lexicon import LATHE, MODES
from contoursolve.dialects.yasnac_lx3.rules import COMBINATION_RULES, GEOMETRY_RULES
from contoursolve.syntax import Block


def _signs(block: Block) -> bool:
    return any(word.address == "G" and word.number in (111, 112) for word in block.words)


YASNAC_LX3 = Dialect(
    name="yasnac-lx3",
    title="YASNAC LX3 lathe control",
    modes=MODES,
    plane=LATHE,
    forms=(G111,),
    rules=COMMON_RULES + COMBINATION_RULES + GEOMETRY_RULES,
    find=find,
    signs=_signs,
)
