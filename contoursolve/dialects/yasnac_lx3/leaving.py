"""YASNAC LX3 G11 and G12, and G01 with I or K: along one axis, then a corner that leaves it on one side.

The virtual intersection V1 is the programmed point. The tool leaves it along the other axis, for as far as I or K.
"""

from functools import cache

from contoursolve.constraints import Coordinate, Level, Offset
from contoursolve.dialects.yasnac_lx3.claim import claim_of
from contoursolve.dialects.yasnac_lx3.g111 import START, V1
from contoursolve.model import FIRST, SECOND, CornerShape, Given, Line, Role, Unit
from contoursolve.reading import Claim, CornerRow, FactRow, Form, Modes, Sample, State, apply_modes
from contoursolve.syntax import Block

ALONG_Z, ALONG_X = "leaving Z", "leaving X"
SIZE, END = "corner", "end"
"""The size of the corner, which has no sign, and where the tool has left V1 by that much."""

_LINE = 1
_TITLES = {11: "bevelling", 12: "rounding", 1: "bevelling"}
_SHAPES = {11: CornerShape.CHAMFER_AXIS_45, 12: CornerShape.FILLET, 1: CornerShape.CHAMFER_AXIS_45}
_WORDS = ((("Z", "W"), "I", "X"), (("X", "U"), "K", "Z"))
"""By the axis along which a block moves: its words, the letter of its corner, and the axis that this is along."""


@cache
def leaving(code: int, along: int) -> Form:
    """The form of a block with or under a G code, along an axis."""
    (absolute, increment), letter, other = _WORDS[along]
    return Form(
        name=f"G{code:02}",
        title=f"{_TITLES[code]}, along {'ZX'[along]}",
        roles=(Role("leaving"), Role((ALONG_Z, ALONG_X)[along])),
        start=START,
        points=(V1, END),
        radii=(),
        facts=(
            FactRow(Coordinate(absolute, V1, along), (absolute,)),
            FactRow(Offset(increment, V1, START, along), (increment,)),
            FactRow(Level(V1, START, 1 - along), ()),
            FactRow(Offset(letter, END, V1, 1 - along), (letter,)),
            FactRow(Level(END, V1, along), ()),
        ),
        path=(Line("line 1", START, V1),),
        lines=(Line("line 2", V1, END),),
        corners=(CornerRow("corner 1", V1, "line 1", None, {SIZE: _SHAPES[code]}, lands_on="line 2"),),
        intersections=(V1,),
        allowed=frozenset("XUZWIKNGFMST"),
        combinations=tuple(((), (name,)) for name in (absolute, increment, letter)),
        # A block with G01 and neither I nor K is a line; all others say what they say with G11.
        sample=None if code == _LINE else Sample("G00 X30. Z0.", (f"G{code:02} {_SAMPLES[along]}",)),
        meanings={
            absolute: f"absolute {absolute} of the virtual intersection",
            increment: f"{absolute} increment from start to virtual intersection",
            letter: f"size of the corner; its sign is the way in which the corner leaves, along {other}",
        },
    )


_SAMPLES = ("Z-20. {I8.} {K8.} {U50.} {W-20.} {X80.}", "X80. {I7.} {K-7.} {U50.}")

LEAVING_FORMS = tuple(leaving(code, along) for code in _TITLES for along in (FIRST, SECOND))


def claim_leaving(block: Block, code: int, state: State, modes: Modes) -> Claim:
    """The contour of a block that moves along one axis with a corner, with or under G11, G12 or G01."""
    addresses = {word.address for word in block.words}
    along = FIRST if addresses & {"Z", "W"} or ("I" in addresses and not addresses & {"X", "U"}) else SECOND
    form, after = leaving(code, along), apply_modes(state, block, modes)
    claim = claim_of(block, form, code, state, after, modes)
    size = claim.givens.get(_WORDS[along][1])
    supplied = [Given(SIZE, abs(size.value), Unit.MM, size.word)] if size is not None else []
    return claim_of(block, form, code, state, after, modes, supplied=supplied)
