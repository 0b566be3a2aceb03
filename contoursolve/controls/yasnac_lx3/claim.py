"""YASNAC LX3: a block as a contour of some form, with every word by the name of the given that it states."""

from collections.abc import Collection, Iterable, Mapping
from decimal import Decimal
from functools import lru_cache

from msgspec.structs import replace

from contoursolve.controls.yasnac_lx3.lexicon import (
    AXIS_45,
    BEVEL,
    LENGTH_45,
    MOTION_AFTER,
    SETBACK,
    UNCHANGED,
)
from contoursolve.gcode import Block, Word
from contoursolve.geometry import CornerShape, Given
from contoursolve.reading import (
    ContourBuilder,
    ContourForm,
    Effect,
    Mode,
    Modes,
    ParsedContour,
    State,
    apply_modes,
    rows_of,
)

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
    """The shape of a bevel, by the setting."""
    return _SHAPES[modes.convention(BEVEL).value]


def after_cornering(block: Block, state: State, modes: Modes) -> State:
    """The state after a block of multiple cornering, which is not modal: what it stands with applies, and the motion
    is the one that was in force before it, or by the setting G01."""
    after, motion = apply_modes(state, block, modes), state.motion
    if not modes.has(MOTION_AFTER, UNCHANGED):
        motion = 1
        after = after.settle(Mode.MOTION, Mode.MOVE)
    return after if after.motion == motion else replace(after, motion=motion)


class BlockReader:
    """A block whose own G code is `own`: its words, before the form is known whose contour it states."""

    def __init__(self, block: Block, own: int | None, before: State, after: State, modes: Modes) -> None:
        self.before, self.after = before, after
        codes = rows_of(block, modes)
        self.is_own = any(code.number == own for code in codes)
        others = [code.number for code in codes if code.number != own and code.effect in AXIS_EFFECTS]
        self.builder = ContourBuilder(modes)
        self.builder.add(block)
        self.words = self.builder.gather((_name_of(word, others), word) for word in block.words)
        self.values = self.builder.values(self.words, after)

    def value(self, name: str) -> Decimal | None:
        """The value of a word, mm or degrees, if it is there and is known."""
        return self.values[name].value if name in self.values else None

    def claim(
        self, form: ContourForm, refused: frozenset[str] = frozenset(), supplied: Iterable[Given] = ()
    ) -> ParsedContour:
        """The block as a contour of a form. `refused` are addresses that a rule refuses; `supplied` are givens that the
        control derives from the words."""
        builder, modes, after = self.builder, self.builder.modes, self.after
        vocabulary = _vocabulary(form, tuple(modes.lexicon.addresses))
        stated = {name: word for name, word in self.words.items() if name in vocabulary}
        beside = {name: word for name, word in self.words.items() if name == OTHER_G or name in refused}
        unknown = (
            word
            for name, word in self.words.items()
            if name not in beside and word.address != "G" and word.address not in form.allowed
        )
        givens = {name: self.values[name] for name in stated if name in self.values}
        builder.state("", {**stated, **beside}, {**givens, **{each.name: each for each in supplied}})
        builder.vocabulary |= vocabulary
        is_same = self.before.unit is after.unit and self.before.axes is after.axes
        # Its own words may move the coordinate system in which it begins.
        before = self.before if is_same else replace(self.before, unit=after.unit, axes=after.axes)
        return builder.build(
            form,
            before,
            after,
            unknown=tuple(unknown),
            # Multiple cornering, and a motion that the block states itself, take no part in the one in force.
            doubts=(after.settle(Mode.MOTION, Mode.MOVE) if self.is_own else after).doubts,
            conventions=() if stated.keys().isdisjoint(_bevels(form)) else (modes.convention(BEVEL),),
        )


def _name_of(word: Word, others: Collection[int]) -> str:
    """The name of a word: its address, G codes with their number."""
    if word.address != "G":
        return word.address
    return OTHER_G if word.number in others else f"G{word.number}"


@lru_cache(maxsize=32)
def _vocabulary(form: ContourForm, addresses: tuple[str, ...]) -> Mapping[str, tuple[str, int]]:
    """The words that a form has, each with its address in the only block."""
    return {name: (name, 0) for name in addresses if name in form.allowed}


@lru_cache(maxsize=32)
def _bevels(form: ContourForm) -> frozenset[str]:
    """The words whose meaning is a convention."""
    return frozenset(word for word, shape in form.outline.shapes.items() if shape in _SHAPES.values())
