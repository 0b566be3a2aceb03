"""YASNAC LX3 G111, taper multiple cornering: its facts, its path, and how a block is found."""

from collections.abc import Sequence
from dataclasses import replace

from contoursolve.constraints import Coordinate, Heading, Offset
from contoursolve.dialects.dialect import Unresolved
from contoursolve.dialects.yasnac_lx3.lexicon import ADDRESSES
from contoursolve.model import FIRST, SECOND, CornerShape, Line, Role
from contoursolve.reading import (
    Claim,
    Code,
    CornerRow,
    Effect,
    FactRow,
    Form,
    Modes,
    Sample,
    State,
    apply_modes,
    codes_of,
)
from contoursolve.syntax import Block, Word

START, V1, V2 = "S", "V1", "V2"
BEVEL, ROUNDING = CornerShape.CHAMFER_AXIS_45, CornerShape.FILLET

_PASSING = frozenset("NGF")
"""Addresses without a meaning for the contour that may stand in the block; F is assumed."""

G111 = Form(
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
        CornerRow("corner 1", V1, "line 1", "line 2", {"C": BEVEL, "P": ROUNDING}),
        CornerRow(
            "corner 2",
            V2,
            "line 2",
            None,
            {"D": BEVEL, "Q": ROUNDING},
            landing=((("X", "U"), FIRST), (("Z", "W"), SECOND)),
        ),
    ),
    intersections=(V1, V2),
    allowed=frozenset(row.address for row in ADDRESSES) | _PASSING,
    combinations=tuple(((), (address,)) for address in "AIKBXUZW"),
    sample=Sample(
        "G00 X40. Z0.",
        ("G111 {A160.} {B120.} {C2.} {D2.} {I10.919} {K-30.} {P2.} {Q2.} {U60.} {W-41.016} {X100.} {Z-41.016}",),
    ),
)

OTHER_G = "other G"
_REFUSED = frozenset({"M", "S", "T", OTHER_G})
"""Names that a rule refuses."""
_EXPECTED = G111.allowed | _REFUSED
_VOCABULARY = {row.address: (row.address, 0) for row in ADDRESSES}

_AXIS_EFFECTS = (
    Effect.MOTION,
    Effect.CYCLE,
    Effect.SINGLE,
    Effect.NO_MOTION,
    Effect.PRESET,
    Effect.UNRESOLVED,
)
"""G codes that use axis words themselves."""


def find(blocks: Sequence[Block], index: int, state: State, modes: Modes) -> Claim | Unresolved | None:
    """The contour that begins at a block: G111 alone; G112, G11 and G12 are recognised only."""
    block = blocks[index]
    codes = [code for code in codes_of(block, modes) if isinstance(code, Code)]
    if any(code.effect is Effect.CONTOUR for code in codes):
        return _claim(block, codes, state, modes)
    unresolved = next((code for code in codes if code.effect is Effect.UNRESOLVED or code.number in (11, 12)), None)
    axis_words = [word for word in block.words if word.address in ("X", "U", "Z", "W")]
    if unresolved:
        word = next(word for word in block.words if word.address == "G" and word.number == unresolved.number)
        return Unresolved(block, word, f"G{unresolved.number} ({unresolved.meaning})")
    corner = next((word for word in block.words if word.address in ("I", "K")), None)
    if corner and len(axis_words) == 1 and apply_modes(state, block, modes).motion == 1:
        # p. 31-32: the bevel of G11 in another form.
        return Unresolved(block, corner, "G01 with one axis and I or K (bevelling)")
    if not codes and state.motion in (11, 12) and axis_words:
        return Unresolved(block, axis_words[0], f"G{state.motion} (modal, {modes.codes[state.motion].meaning})")
    return None


def _claim(block: Block, codes: list[Code], state: State, modes: Modes) -> Claim:
    # G111 is not modal: what it stands with applies, and the motion before it stays in force.
    after = apply_modes(state, block, modes)
    if after.motion != state.motion:
        after = replace(after, motion=state.motion)
    others = {code.number for code in codes if code.effect in _AXIS_EFFECTS}
    words: dict[str, Word] = {}
    repeated: list[Word] = []
    for word in block.words:
        name = word.address
        if name == "G":
            name = OTHER_G if word.number in others else f"G{word.number}"
        if name in words:
            repeated.append(word)
        words.setdefault(name, word)
    lexicon = modes.lexicon
    stated = {name: word for name, word in words.items() if name in lexicon.addresses or name in _REFUSED}
    givens = {name: lexicon.given(name, word, after.unit) for name, word in words.items() if name in lexicon.addresses}
    return Claim(
        form=G111,
        lexicon=lexicon,
        blocks=(block,),
        before=state if state.unit is after.unit else replace(state, unit=after.unit),
        after=after,
        words=stated,
        givens={name: given for name, given in givens.items() if given is not None},
        vocabulary=_VOCABULARY,
        unknown=tuple(word for word in words.values() if word.address not in _EXPECTED),
        repeated=tuple(repeated),
    )
