"""Text outside the % that begin and end a program: controls do not read it, and here it is read as blocks."""

import re
from collections.abc import Iterator

from msgspec.structs import replace

from contoursolve.diagnosis import Context, report
from contoursolve.diagnostics import Basis, Diagnostic, Span
from contoursolve.gcode import ISO, Block, Passage
from contoursolve.reading import ReadIssue, words_of

_OUTSIDE_COMMENTS = re.compile(r"\([^)]*\)?|;.*|(?P<mark>%)")


class Marks:
    """Follows the % of one program, as ISO 6983 and RS-274 have them on a tape: one before its first block, one behind
    its last; a single one behind blocks ends it. One finding a side names the first line there."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.first: Span | None = None
        """The first block, as long as no % has come before or behind it."""
        self.before: tuple[Span, Span] | None = None
        """The first block of a program that did not begin with %, and the % behind it."""
        self.after: Span | None = None
        """The first block behind that %."""
        self.opened: Span | None = None
        """The % that begins the program."""
        self.closed: Span | None = None
        """The % that ends it."""
        self.is_done = False

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Marks) and vars(self) == vars(other)

    __hash__ = None  # type: ignore[assignment]

    def look(self, line: Block | Passage) -> Iterator[Diagnostic]:
        """Findings about text outside the %, as the next line, or the next lines that only move, show it."""
        if self.is_done or line.syntax is not ISO:
            return
        is_inside = self.first is not None and not self.closed and self.before is None
        if is_inside and not (isinstance(line, Block) and "%" in line.text):
            return
        span: Span | None
        if isinstance(line, Passage):
            span = _first_words(line)
        else:
            mark = next((found for found in _OUTSIDE_COMMENTS.finditer(line.text) if found["mark"]), None)
            if mark is not None:
                if line.words and line.words[0].span.column <= mark.start():
                    yield from self._say(line.span)
                yield from self._mark(Span(line.line, mark.start() + 1, mark.end() + 1))
                return
            span = line.span if line.words or line.macro or line.faults else None
        if span is not None:
            yield from self._say(span)

    def _say(self, span: Span) -> Iterator[Diagnostic]:
        """A block that says something."""
        if self.closed:
            self.is_done = True
            yield self._outside(span, "behind", "ends", self.closed)
        elif self.before is not None:
            self.after = self.after or span
        else:
            self.first = self.first or span

    def _mark(self, mark: Span) -> Iterator[Diagnostic]:
        """A %."""
        if self.before is not None:
            span, first = self.before
            if self.after is not None:
                # There are two, so that the first one begins the program.
                yield self._outside(span, "before", "begins", first)
            self.before, self.closed = None, mark if self.after is not None else first
        elif self.opened:
            self.closed = self.closed or mark
        elif self.first is not None and not self.closed:
            self.before = self.first, mark
        else:
            self.opened = mark

    def finish(self) -> Iterator[Diagnostic]:
        """Findings about text outside the %, at the end of the program."""
        if self.before is not None and self.after is not None:
            yield self._outside(self.after, "behind", "ends", self.before[1])

    def _outside(self, span: Span, side: str, does: str, mark: Span) -> Diagnostic:
        rule, place = self.context.row(ReadIssue.TEXT_OUTSIDE), replace(self.context, place=span)
        return report(place, rule, Basis.RULE, [], side=side, does=does, mark=f"program line {mark.line}")


def _first_words(passage: Passage) -> Span | None:
    """The first of some plain lines that says something."""
    for number, line in enumerate(passage.lines, passage.line):
        if words_of(line):
            text = line.rstrip("\r\n")
            return Block(number, text, ()).span
    return None
