"""The words of a program that change the radius of its tool, or compensation, where they are in force."""

import re
from collections.abc import Iterator, Sequence
from decimal import Decimal
from math import inf

from msgspec import Struct

from contoursolve.controls import ToolWord
from contoursolve.gcode import Block


class WordInForce(Struct, frozen=True):
    """A word, as it is written, its line and its number, and the places of the first and the last block in which it is
    in force."""

    row: ToolWord
    text: str
    line: int
    number: Decimal | None
    tool: str | None
    first: float
    last: float


class RadiusWords:
    """Such words of some blocks as they run."""

    def __init__(self, blocks: Sequence[Block], rows: Sequence[ToolWord]) -> None:
        texts = (block.syntax.comment.sub(" ", block.text) for block in (blocks if rows else ()))
        self.texts = [" ".join(text.upper().split()) for text in texts]
        self.found = [each for row in rows for each in self._of(row, blocks)]

    def _of(self, row: ToolWord, blocks: Sequence[Block]) -> Iterator[WordInForce]:
        pattern, ends = re.compile(row.pattern), re.compile(row.ends or "(?!)")
        for place, (block, text) in enumerate(zip(blocks, self.texts, strict=False)):
            if (found := pattern.search(text)) is None:
                continue
            behind = range(place + 1, len(blocks)) if row.ends else ()
            last = next((each - 1 for each in behind if ends.search(self.texts[each])), inf)
            # For its block alone, up to its end, or for the whole program.
            first, last = (place, place) if row.ends is None else (place, last) if row.ends else (-inf, inf)
            line = block.callers[0].line if block.file and block.callers else block.line
            stated, tool = (found.groupdict().get(name) for name in ("number", "tool"))
            yield WordInForce(row, found[0], line, Decimal(stated) if stated else None, tool, first, last)

    def beside(self, first: int, last: int, broken: int) -> tuple[WordInForce, ...]:
        """The words in force somewhere from one place to another one, or in a line, if they are about the tool that is
        called last."""
        own = (each for each in self.found if (each.first <= last and first <= each.last) or each.line == broken)
        return tuple(each for each in own if self._called(each.row, last) in (None, each.tool and int(each.tool)))

    def _called(self, row: ToolWord, last: int) -> int | None:
        calls = (re.search(row.calls, text) for text in (reversed(self.texts[: last + 1]) if row.calls else ()))
        return next((int(found["tool"]) for found in calls if found is not None), None)
