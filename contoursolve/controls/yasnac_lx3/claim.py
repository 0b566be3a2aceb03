"""YASNAC LX3: a block as a contour of some form, with every word by the name of the given that it states."""

from collections.abc import Iterable, Mapping
from functools import lru_cache

from msgspec.structs import replace

from contoursolve.controls.yasnac_lx3.lexicon import (
    ADDRESSES,
    AXIS_45,
    BEVEL,
    LENGTH_45,
    MOTION_AFTER,
    SETBACK,
    UNCHANGED,
)
from contoursolve.gcode import Block, Word
from contoursolve.geometry import CornerShape, Given
from contoursolve.reading import Code, ContourForm, Effect, Mode, Modes, ParsedContour, State, apply_modes, codes_of

OTHER_G = "other G"
"""States that the block has a G code that uses the axis words itself."""

AXIS_EFFECTS = (Effect.MOTION, Effect.CYCLE, Effect.SINGLE, Effect.NO_MOTION, Effect.PRESET, Effect.CONTOUR)
"""G codes that use axis words themselves."""

_SHAPES = {
    AXIS_45: CornerShape.CHAMFER_AXIS_45,
    LENGTH_45: CornerShape.CHAMFER_LENGTH_45,
    SETBACK: CornerShape.CHAMFER_SETBACK,
}


def bevel_of(modes: Modes) -> CornerShape:
    """What a bevel is, by the setting."""
    return _SHAPES[modes.convention(BEVEL).value]


def after_cornering(block: Block, state: State, modes: Modes) -> State:
    """The state after a block of multiple cornering, which is not modal: what it stands with applies, and the motion
    is the one that was in force before it, or by the setting G01."""
    after, motion = apply_modes(state, block, modes), state.motion
    if not modes.has(MOTION_AFTER, UNCHANGED):
        motion = 1
        after = after.settle(Mode.MOTION, Mode.MOVE)
    return after if after.motion == motion else replace(after, motion=motion)


def claim_of(
    block: Block,
    form: ContourForm,
    own: int | None,
    before: State,
    after: State,
    modes: Modes,
    refused: frozenset[str] = frozenset(),
    supplied: Iterable[Given] = (),
) -> ParsedContour:
    """The block as a contour of a form whose G code is `own`.

    `refused` are addresses that a rule refuses; `supplied` are givens that the control derives from the words.
    """
    codes = [code for code in codes_of(block, modes) if isinstance(code, Code)]
    is_own = any(code.number == own for code in codes)
    others = [code.number for code in codes if code.number != own and code.effect in AXIS_EFFECTS]
    words: dict[str, Word] = {}
    repeated: list[Word] = []
    for word in block.words:
        name = word.address
        if name == "G":
            name = OTHER_G if word.number in others else f"G{word.number}"
        if name in words:
            if name != "M":
                repeated.append(word)
        else:
            words[name] = word
    lexicon, allowed = modes.lexicon, form.allowed
    stated: dict[str, Word] = {}
    beside: dict[str, Word] = {}
    givens: dict[str, Given] = {}
    unknown: list[Word] = []
    for name, word in words.items():
        if name in allowed and name in lexicon.addresses:
            stated[name] = word
            given = lexicon.given(name, word, after.unit)
            if given is not None:
                givens[name] = given
        if name == OTHER_G or name in refused:
            beside[name] = word
        elif word.address != "G" and word.address not in allowed:
            unknown.append(word)
    for each in supplied:
        givens[each.name] = each
    return ParsedContour(
        form=form,
        lexicon=lexicon,
        blocks=(block,),
        before=before if before.unit is after.unit else replace(before, unit=after.unit),
        after=after,
        words={**stated, **beside},
        givens=givens,
        vocabulary=_vocabulary(form),
        unknown=tuple(unknown),
        repeated=tuple(repeated),
        # Multiple cornering, and a motion that the block states itself, take no part in the one in force.
        doubts=(after.settle(Mode.MOTION, Mode.MOVE) if is_own else after).doubts,
        conventions=() if stated.keys().isdisjoint(_bevels(form)) else (modes.convention(BEVEL),),
    )


@lru_cache(maxsize=32)
def _bevels(form: ContourForm) -> frozenset[str]:
    """The words whose meaning is a convention."""
    return frozenset(word for row in form.corners for word, shape in row.shapes.items() if shape in _SHAPES.values())


@lru_cache(maxsize=32)
def _vocabulary(form: ContourForm) -> Mapping[str, tuple[str, int]]:
    return {row.address: (row.address, 0) for row in ADDRESSES if row.address in form.allowed}
