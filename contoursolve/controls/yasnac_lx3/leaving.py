"""YASNAC LX3 G11 and G12, and G01 with I or K: along one axis, then a corner that leaves it on one side."""

from decimal import Decimal
from functools import cache

from contoursolve.controls.geometry_rules import GENERAL
from contoursolve.controls.rule_rows import row
from contoursolve.controls.yasnac_lx3.claim import OTHER_G, BlockReader
from contoursolve.controls.yasnac_lx3.g111 import START, V1
from contoursolve.controls.yasnac_lx3.lexicon import BOOK
from contoursolve.diagnostics import Alarm, Evidence
from contoursolve.gcode import Block
from contoursolve.geometry import FIRST, SECOND, BlockRole, Coordinate, CornerShape, Given, Level, Line, Offset, Unit
from contoursolve.reading import (
    ContourForm,
    CornerRow,
    FactRow,
    Modes,
    Outline,
    ParsedContour,
    Sample,
    State,
    Value,
    WordTable,
    all_of,
    apply_modes,
    at_most,
    some,
)

ALONG_Z, ALONG_X = "leaving Z", "leaving X"
SIZE, END = "corner", "end"
"""The size of the corner, which has no sign, and where the tool has left V1 by that much."""

_LINE = 1
_TITLES = {11: "bevelling", 12: "rounding", 1: "bevelling"}
_SHAPES = {11: CornerShape.CHAMFER_AXIS_45, 12: CornerShape.FILLET, 1: CornerShape.CHAMFER_AXIS_45}
_WORDS = ((("Z", "W"), "I", "X"), (("X", "U"), "K", "Z"))
"""By the axis along which a block moves: its words, the letter of its corner, and the axis that this is along."""


@cache
def leaving(code: int, along: int) -> ContourForm:
    """The form of a block with or under a G code, along an axis."""
    (absolute, increment), letter, other = _WORDS[along]
    return ContourForm(
        name=f"G{code:02}",
        title=f"{_TITLES[code]}, along {'ZX'[along]}",
        roles=(BlockRole("leaving"), BlockRole((ALONG_Z, ALONG_X)[along])),
        outline=Outline(
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
        ),
        allowed=frozenset("XUZWIKNGFMST"),
        table=WordTable(
            combinations=tuple(((), (name,)) for name in (absolute, increment, letter)),
            sample=None if code == _LINE else Sample("G00 X30. Z0.", (f"G{code:02} {_SAMPLES[along]}",)),
        ),
        meanings={
            absolute: f"absolute {absolute} of the virtual intersection",
            increment: f"{absolute} increment from start to virtual intersection",
            letter: f"size of the corner; its sign is the way in which the corner leaves, along {other}",
        },
    )


_SAMPLES = ("Z-20. {I8.} {K8.} {U50.} {W-20.} {X80.}", "X80. {I7.} {K-7.} {U50.}")

LEAVING_FORMS = tuple(leaving(code, along) for code in _TITLES for along in (FIRST, SECOND))


def claim_leaving(block: Block, code: int, state: State, modes: Modes) -> ParsedContour:
    """The contour of a block that moves along one axis with a corner, with or under G11, G12 or G01."""
    addresses = {word.address for word in block.words}
    along = FIRST if addresses & {"Z", "W"} or ("I" in addresses and not addresses & {"X", "U"}) else SECOND
    reader = BlockReader(block, code, state, apply_modes(state, block, modes), modes)
    size = reader.values.get(_WORDS[along][1])
    supplied = [Given(SIZE, abs(size.value), Unit.MM, size.word)] if size is not None else []
    return reader.claim(leaving(code, along), supplied=supplied)


_ROLE = "leaving"
_X, _Z = ("X", "U"), ("Z", "W")
_START = "G00 X30. Z0.\n"
_BEVEL = _START + "G11 Z-20. I8. F30."
_GOOD = _BEVEL + "\nX80. K-7."
_ROUND = _START + "G12 Z-20. I8. F30.\nX80. K-7."
_BY_G01 = _START + "G01 Z-20. I8. F30.\nX80. K-7."

_PAGE = BOOK.printed("p. 31-32")
_BOTH_AXES = Alarm("050", Evidence.PRINTED)

LEAVING_RULES = (
    row("g11-both-axes", "{words:X U Z W}: the block moves along both axes, and a corner leaves one axis",
        "write each axis in a block of its own: X(U) with K, Z(W) with I", _PAGE, all_of(_X, _Z),
        ((_GOOD, _ROUND, _BY_G01), _START + "G11 X80. Z-20. I8.", _START + "G12 U50. W-20. K8."), (_ROLE,),
        alarm=_BOTH_AXES),
    row("g11-axis-twice", "{words}: both give the end along one axis", "keep one of them",
        BOOK.derived("p. 31-32: one axis a block"), all_of("Z", "W"), (_GOOD, _BEVEL + " W-20."), (ALONG_Z,)),
    row("g11-axis-twice-x", "{words}: both give the end along one axis", "keep one of them",
        BOOK.derived("p. 31-32: one axis a block"), all_of("X", "U"), (_GOOD, _START + "G11 X80. U50. K-7."),
        (ALONG_X,)),
    row("g11-axis-missing", "{words:I K}: the block moves along no axis that a corner could leave",
        "add X(U) to a K, Z(W) to an I", _PAGE, at_most(0, _X, _Z) & at_most(2, "I", "K"),
        ((_GOOD, _ROUND), _START + "G11 I8.", _GOOD + "\nK2."), (_ROLE,)),
    row("g11-corner-missing",
        "under G11 and G12, a block along Z needs I: how far the corner leaves, and to which side",
        "add I, or write G00 or G01 for a move without a corner", _PAGE, some(*_Z) & ~some(*_X) & at_most(0, "I", "K"),
        ((_GOOD, _ROUND + "\nG01 Z-50."), _BEVEL + "\nZ-50.", _START + "G12 W-20."), (ALONG_Z,)),
    row("g11-corner-missing-x",
        "under G11 and G12, a block along X needs K: how far the corner leaves, and to which side",
        "add K, or write G00 or G01 for a move without a corner", _PAGE, some(*_X) & ~some(*_Z) & at_most(0, "I", "K"),
        ((_GOOD, _ROUND + "\nG01 X90."), _BEVEL + "\nX80.", _START + "G12 U50."), (ALONG_X,)),
    row("g11-corner-letter", "for an X move write K, not {words:I}", "write K for {words:I}", _PAGE,
        some(*_X) & ~some(*_Z) & some("I"), (_GOOD, _START + "G11 X80. I8.", _START + "G11 X80. K-7. I8."), (ALONG_X,)),
    row("g11-corner-letter-z", "for a Z move write I, not {words:K}", "write I for {words:K}", _PAGE,
        some(*_Z) & ~some(*_X) & some("K"), (_GOOD, _START + "G11 Z-20. K8.", _START + "G01 Z-20. I8. K8."),
        (ALONG_Z,)),
    row("g11-corner-zero", "{words}: a corner of size 0 is an error",
        "write its size, or G00 or G01 and no {words} for a move without a corner", _PAGE,
        Value(("I", "K"), excluding=Decimal(0)), ((_GOOD, _ROUND), _START + "G11 Z-20. I0", _START + "G12 X80. K0"),
        (_ROLE,)),
    row("g11-other-g", "{words:other G} uses the axis words of the block itself, and so do G11 and G12",
        "write it in a block of its own", BOOK.assumed("p. 31-32: modal, group A; two codes of one group"),
        some(OTHER_G), (_GOOD, _START + "G01 G11 Z-20. I8."), (_ROLE,)),
    row("g11-corner-too-large", like=GENERAL, message="{words} is larger than the move: {actual}, {fits}",
        help="{smaller}, or move farther", source=_PAGE,
        examples=((_GOOD, _START + "G11 Z-8. I8."), _START + "G11 Z-5. I8.", _START + "G12 U10. K-7.",
         _START + "G01 W-2. I3."), roles=(_ROLE,)),
)  # fmt: skip
