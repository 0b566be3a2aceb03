"""Blocks that differ in their numbers alone: what is known of one, without its numbers, is known of all."""

from collections.abc import Hashable
from dataclasses import dataclass, replace
from decimal import Decimal
from typing import NamedTuple

from contoursolve.contour import Contour
from contoursolve.diagnostic import Diagnostic
from contoursolve.dialects import Dialect
from contoursolve.model import Plane, Start, Unit
from contoursolve.reading import Claim, Code, Effect, State, codes_of
from contoursolve.syntax import Block, read_simply

Pattern = tuple[str, ...]
"""The addresses of a block, those of codes with their numbers, and every number without a point."""

_CODES = "GMTgmt"
"""Addresses whose numbers tell what the block is."""


@dataclass(frozen=True, slots=True, eq=False)
class Mould:
    """A contour of one block that leaves the modal state as it is, without its numbers: `kind` tells what else is
    solved like it, `form` what it is called. `givens` are the values that its words state: name, unit, the word's
    index, and what its number is multiplied by; `kept` are the indices of the other words. `state` is one in which the
    block means this."""

    kind: Hashable
    form: str
    state: State
    givens: tuple[tuple[str, Unit, int, Decimal], ...]
    kept: frozenset[int]

    def fits(self, state: State) -> bool:
        """Whether the block means the same in another state."""
        own = self.state
        return (
            state.motion == own.motion
            and state.unit is own.unit
            and state.is_incremental == own.is_incremental
            and state.compensation == own.compensation
            and state.plane.code == own.plane.code
        )


class Cast(NamedTuple):
    """A block of a mould, which nobody has read into words yet."""

    line: int
    text: str
    numbers: tuple[str, ...]
    mould: Mould

    def block(self) -> Block:
        """The block with those of its words that are not about the contour, and without its G code."""
        kept = self.mould.kept
        return Block(self.line, self.text, read_simply(self.text, self.line, kept) if kept else ())

    def values(self) -> dict[str, Decimal]:
        """What its words state, mm or degrees, by name."""
        numbers = self.numbers
        return {name: Decimal(numbers[index]) * factor for name, _, index, factor in self.mould.givens}


class Moulded(NamedTuple):
    """A contour of a mould, solved without a finding about itself: as much of an answer as its path needs."""

    blocks: tuple[Block, ...]
    before: State
    after: State
    plane: Plane
    start: Start
    contour: Contour
    diagnostics: tuple[Diagnostic, ...] = ()
    """What there is to say of the block behind it."""

    @property
    def claim(self) -> "Moulded":
        """The blocks and the states."""
        return self


def pattern_of(words: list[tuple[str, str]]) -> Pattern:
    """The pattern of a block of these addresses and numbers."""
    return tuple([letter if "." in number and letter not in _CODES else letter + number for letter, number in words])


def mould_of(claim: Claim, kind: Hashable, dialect: Dialect) -> Mould | None:
    """The mould of a contour about which there is nothing to say; None where more than its numbers would count."""
    if not claim.form.is_literal or len(claim.blocks) > 1 or claim.choices or claim.circumstances:
        return None
    sizes = (claim.givens.get(word) for row in claim.form.corners for word in row.shapes)
    if any(given is not None and not given.value for given in sizes):
        # A corner of size 0 is none, one of another size is.
        return None
    (block,), modes = claim.blocks, dialect.modes
    codes = codes_of(block, modes)
    is_own = len(codes) == 1 and isinstance(codes[0], Code) and codes[0].effect is Effect.CONTOUR
    if not is_own or block.text != block.text.strip():
        return None
    places = {id(word): index for index, word in enumerate(block.words)}
    givens: list[tuple[str, Unit, int, Decimal]] = []
    for name, given in claim.givens.items():
        word = given.word
        if word is None or word.address != name or id(word) not in places:
            return None
        one = modes.lexicon.value(replace(word, number=Decimal(1)), claim.after.unit)
        if one is None:
            return None
        givens.append((name, given.unit, places[id(word)], one))
    stated = {index for _, _, index, _ in givens}
    kept = frozenset(index for index, word in enumerate(block.words) if word.address != "G") - stated
    if any(block.words[index].address in modes.lexicon.addresses for index in kept):
        return None
    return Mould(kind, claim.form.name, claim.after, tuple(givens), kept)
