"""YASNAC LX3 G111, taper multiple cornering: its facts and its path."""

from functools import cache

from contoursolve.constraints import Coordinate, Heading, Offset
from contoursolve.dialects.yasnac_lx3.claim import after_cornering, bevel_of, claim_of
from contoursolve.dialects.yasnac_lx3.lexicon import ASSUMPTIONS
from contoursolve.model import FIRST, SECOND, CornerShape, Line, Role
from contoursolve.reading import Claim, CornerRow, FactRow, Form, Modes, Sample, State
from contoursolve.syntax import Block

START, V1, V2 = "S", "V1", "V2"

PASSING = frozenset("NGF")
"""Addresses without a meaning for the contour that may stand in the block; F is assumed."""

REFUSED = frozenset("MST")
"""Addresses that a rule refuses."""


@cache
def g111(bevel: CornerShape) -> Form:
    """The form of the block, with bevels of a shape."""
    return Form(
        name="G111",
        title="taper multiple cornering",
        roles=(Role("G111"),),
        start=START,
        points=(V1, V2),
        radii=(),
        facts=(
            FactRow(Offset("I", V1, START, SECOND), ("I",)),
            FactRow(Offset("K", V1, START, FIRST), ("K",)),
            FactRow(Heading("A", START, V1), ("A",)),
            FactRow(Coordinate("X", V2, SECOND), ("X",)),
            FactRow(Offset("U", V2, START, SECOND), ("U",)),
            FactRow(Coordinate("Z", V2, FIRST), ("Z",)),
            FactRow(Offset("W", V2, START, FIRST), ("W",)),
            FactRow(Heading("B", V1, V2), ("B",)),
        ),
        path=(Line("line 1", START, V1, heading="A"), Line("line 2", V1, V2, heading="B")),
        corners=(
            CornerRow("corner 1", V1, "line 1", "line 2", {"C": bevel, "P": CornerShape.FILLET}),
            CornerRow(
                "corner 2",
                V2,
                "line 2",
                None,
                {"D": bevel, "Q": CornerShape.FILLET},
                landing=((("X", "U"), FIRST), (("Z", "W"), SECOND)),
            ),
        ),
        intersections=(V1, V2),
        allowed=frozenset("XUZWABIKPQCD") | PASSING,
        combinations=tuple(((), (address,)) for address in "AIKBXUZW"),
        sample=Sample(
            "G00 X40. Z0.",
            ("G111 {A160.} {B120.} {C2.} {D2.} {I10.919} {K-30.} {P2.} {Q2.} {U60.} {W-41.016} {X100.} {Z-41.016}",),
        ),
        assumptions=ASSUMPTIONS,
        is_literal=True,
    )


G111 = g111(CornerShape.CHAMFER_AXIS_45)


def claim_g111(block: Block, state: State, modes: Modes) -> Claim:
    """The contour of a block with G111."""
    after = after_cornering(block, state, modes)
    return claim_of(block, g111(bevel_of(modes)), 111, state, after, modes, REFUSED)
