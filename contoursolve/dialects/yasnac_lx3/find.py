"""YASNAC LX3: which blocks are contours, and of which form."""

from collections.abc import Sequence

from contoursolve.dialects.yasnac_lx3.arc import claim_arc
from contoursolve.dialects.yasnac_lx3.claim import AXIS_EFFECTS
from contoursolve.dialects.yasnac_lx3.g111 import claim_g111
from contoursolve.dialects.yasnac_lx3.g112 import claim_g112
from contoursolve.dialects.yasnac_lx3.leaving import claim_leaving
from contoursolve.reading import Claim, Code, Modes, State, codes_of
from contoursolve.syntax import Block

AXIS_WORDS = frozenset("XUZW")
"""Words that move an axis."""

_BEVELLING, _ROUNDING, _LINE, _ARC_CODES = 11, 12, 1, (2, 3)


def find(blocks: Sequence[Block], index: int, state: State, modes: Modes) -> Claim | None:
    """The contour that a block states by itself, if it states one."""
    block = blocks[index]
    codes = codes_of(block, modes)
    known = [code for code in codes if isinstance(code, Code)]
    own = [code.number for code in known if code.effect in AXIS_EFFECTS]
    if 111 in own:  # noqa: PLR2004 - the code
        return claim_g111(block, state, modes)
    if 112 in own:  # noqa: PLR2004
        return claim_g112(block, state, modes)
    # A word that cannot be read still shows what the block was meant to be.
    addresses = {word.address.lstrip(",") for word in block.words} | {fault.address for fault in block.faults}
    corner = next((code for code in own if code in (_BEVELLING, _ROUNDING)), None)
    if corner and addresses & {*AXIS_WORDS, "I", "K"}:
        return claim_leaving(block, corner, state, modes)
    if len(codes) > len(known) or len(own) > 1:
        return None
    motion = own[0] if own else state.motion
    if motion in (_BEVELLING, _ROUNDING) and addresses & {*AXIS_WORDS, "I", "K"}:
        return claim_leaving(block, motion, state, modes)
    if motion == _LINE and addresses & AXIS_WORDS and addresses & {"I", "K"}:
        # p. 31-32: the bevel of G11 in another form.
        return claim_leaving(block, _LINE, state, modes)
    return claim_arc(block, motion, state, modes) if motion in _ARC_CODES else None
