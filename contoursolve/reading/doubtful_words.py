"""Words of a block outside contours that are odd, though the control may say nothing of them."""

from collections.abc import Iterator

from contoursolve.gcode import Block, Word
from contoursolve.reading.lexicon import Effect
from contoursolve.reading.modal_state import Modes

_WHOLE_NUMBERS = "STMHD"
"""Addresses of numbers that have no decimal point."""


def doubtful_words(block: Block, modes: Modes) -> Iterator[tuple[Word, str]]:
    """The words of a block that are odd, each with the reason; without one a code that the control has not."""
    addresses = modes.lexicon.addresses
    for word in block.words:
        if word.number is None:
            continue
        code = modes.codes.get(int(word.number)) if word.address == "G" and word.number % 1 == 0 else None
        if word.address == "G" and word.number not in modes.codes:
            yield word, ""
        elif word.address in _WHOLE_NUMBERS and word.has_point:
            yield word, "its number has no decimal point"
        elif code is not None and code.effect is Effect.SINGLE:
            others = [addresses[each.address] for each in block.words if each.address in addresses]
            if others and not any(row.axis for row in others):
                yield word, f"the block has no axis for {code.meaning}"
