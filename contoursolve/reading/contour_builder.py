"""The builder of a parsed contour: what its blocks state, under the names of what that means."""

from collections.abc import Iterable, Mapping
from typing import Any

from msgspec.structs import replace

from contoursolve.gcode import Block, Word
from contoursolve.geometry import Given
from contoursolve.reading.contour_form import ContourForm
from contoursolve.reading.modal_state import FAULTY, WAITS, Modes, State
from contoursolve.reading.moved_zero import is_along_axes
from contoursolve.reading.parsed_contour import ParsedContour


class ContourBuilder:
    """Gathers what blocks state until all is known that the form of their contour depends on.

    A control says what its words are called; that they are kept once, valued, numbered and counted is the same for all.
    """

    def __init__(self, modes: Modes) -> None:
        self.modes = modes
        self.blocks: list[Block] = []
        self.words: dict[str, Word] = {}
        self.kept: dict[str, Word] = {}
        self.givens: dict[str, Given] = {}
        self.vocabulary: dict[str, tuple[str, int]] = {}
        self.circumstances: set[str] = set()
        self.repeated: list[Word] = []
        self.lasting: set[str] = set()

    def add(self, *blocks: Block) -> int:
        """Add the next blocks; the index of the first of them."""
        index = len(self.blocks)
        self.blocks += blocks
        return index

    def gather(self, named: Iterable[tuple[str, Word]]) -> dict[str, Word]:
        """Words by what they are called, the first one of each name; of the others only M may stand there again."""
        own: dict[str, Word] = {}
        for name, word in named:
            if own.setdefault(name, word) is not word and word.address != "M":
                self.repeated.append(word)
        return own

    def values(self, words: Mapping[str, Word], here: State) -> dict[str, Given]:
        """The values of words, as the control reads them in a state, but for variables and words that it has not."""
        lexicon = self.modes.words(here)
        found = (
            lexicon.given(name, word, here.unit) for name, word in words.items() if word.address in lexicon.addresses
        )
        return {given.name: given for given in found if given is not None}

    def name(self, prefix: str, index: int, addresses: Iterable[tuple[str, str]]) -> None:
        """Add names that words of the block of an index may state, each with the address of that word."""
        self.vocabulary |= {prefix + name: (address, index) for name, address in addresses}

    def state(
        self,
        prefix: str,
        words: Mapping[str, Word],
        givens: Mapping[str, Given],
        circumstances: Iterable[str] = (),
        *,
        kept: Mapping[str, Word] | None = None,
        lasting: Iterable[str] = (),
    ) -> None:
        """Add what one part of the contour states: its words and values by name, what holds of it, the words of earlier
        blocks that stay in force in it (`kept`), and the names of its own that do so behind it (`lasting`)."""
        self.words |= _under(prefix, words)
        self.kept |= _under(prefix, kept or {})
        self.givens |= {name: _called(given, name) for name, given in _under(prefix, givens).items()}
        self.circumstances |= {prefix + name for name in circumstances}
        self.lasting |= {prefix + name for name in lasting}

    def build(self, form: ContourForm, before: State, after: State, **chosen: Any) -> ParsedContour:
        """The contour of a form, between two states; `chosen` are further fields of it, and those that the control sees
        otherwise."""
        lost = [
            at for at in map(before.axes.__getitem__, before.plane.axes) if at.value is None and at.span is not None
        ]
        is_turned = bool(lost) and not is_along_axes(before.zero, self.modes.zero.first)
        fields: dict[str, Any] = {
            "needs_place": is_turned or any(at.reason.startswith((WAITS, FAULTY)) for at in lost),
            "lexicon": self.modes.words(after),
            "blocks": tuple(self.blocks),
            "words": self.words,
            "givens": self.givens,
            "vocabulary": self.vocabulary,
            "repeated": tuple(self.repeated),
            "circumstances": frozenset(self.circumstances),
            "kept": self.kept,
            "lasting": frozenset(self.lasting),
        }
        return ParsedContour(form=form, before=before, after=after, **(fields | chosen))


def _under(prefix: str, named: Mapping[str, Any]) -> Mapping[str, Any]:
    return {prefix + name: each for name, each in named.items()} if prefix else named


def _called(given: Given, name: str) -> Given:
    return given if given.name == name else replace(given, name=name)
