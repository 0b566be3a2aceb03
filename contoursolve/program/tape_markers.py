"""Text outside the % that begin and end a program: controls do not read it, and here it is read as blocks."""

import re
from collections.abc import Iterable

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Context, report
from contoursolve.diagnostics import Basis, Diagnostic, Span
from contoursolve.gcode import ISO, Block, Passage, words_of
from contoursolve.reading import ReadIssue

_OUTSIDE_COMMENTS = re.compile(r"\([^)]*\)?|;.*|(?P<mark>%)")


class Marks(Struct, frozen=True):
    """The % of one program up to a line, as ISO 6983 and RS-274 have them on a tape: one before its first block, one
    behind its last; a single one behind blocks ends it. One finding a side names the first line there."""

    first: Span | None = None
    """The first block, as long as no % has come before or behind it."""
    before: tuple[Span, Span] | None = None
    """The first block of a program that did not begin with %, and the % behind it."""
    after: Span | None = None
    """The first block behind that %."""
    opened: Span | None = None
    """The % that begins the program."""
    closed: Span | None = None
    """The % that ends it."""
    is_done: bool = False
    """Whether nothing more is told."""

    def look(self, lines: Iterable[Block | Passage], context: Context) -> tuple["Marks", tuple[Diagnostic, ...]]:
        """The marks behind further lines; and findings about text outside the %."""
        marks, told = self, tuple[Diagnostic, ...]()
        for line in lines:
            if not marks._passes(line):
                marks, more = marks._read(line, context)
                told += more
        return marks, told

    def finish(self, context: Context) -> tuple[Diagnostic, ...]:
        """Findings about text outside the %, at the end of the program."""
        if self.before is None or self.after is None:
            return ()
        return (_outside(context, self.after, "after", "ends", self.before[1]),)

    def _passes(self, line: Block | Passage) -> bool:
        """Whether a line, or lines that only move, says nothing about the marks."""
        if self.is_done or line.syntax is not ISO:
            return True
        is_inside = self.first is not None and self.closed is None and self.before is None
        return is_inside and not (isinstance(line, Block) and "%" in line.text)

    def _read(self, line: Block | Passage, context: Context) -> tuple["Marks", tuple[Diagnostic, ...]]:
        """The marks behind a line that counts."""
        if isinstance(line, Passage):
            span = _first_words(line)
            return self._behind_words(span, context) if span is not None else (self, ())
        mark = next((found for found in _OUTSIDE_COMMENTS.finditer(line.text) if found["mark"]), None)
        says_something = line.words or line.macro or line.faults
        if mark is None:
            return self._behind_words(line.span, context) if says_something else (self, ())
        marks, told = self, tuple[Diagnostic, ...]()
        if line.words and line.words[0].span.column <= mark.start():
            marks, told = self._behind_words(line.span, context)
        marks, more = marks._behind_mark(Span(line.line, mark.start() + 1, mark.end() + 1), context)
        return marks, told + more

    def _behind_words(self, span: Span, context: Context) -> tuple["Marks", tuple[Diagnostic, ...]]:
        """The marks behind a block that says something."""
        if self.closed:
            return replace(self, is_done=True), (_outside(context, span, "after", "ends", self.closed),)
        if self.before is not None:
            return replace(self, after=self.after or span), ()
        return replace(self, first=self.first or span), ()

    def _behind_mark(self, mark: Span, context: Context) -> tuple["Marks", tuple[Diagnostic, ...]]:
        """The marks behind a %."""
        if self.before is not None and self.after is not None:
            # There are two, so that the first one begins the program.
            span, first = self.before
            told = _outside(context, span, "before", "begins", first)
            return replace(self, before=None, closed=mark), (told,)
        if self.before is not None:
            return replace(self, before=None, closed=self.before[1]), ()
        if self.opened:
            return replace(self, closed=self.closed or mark), ()
        if self.first is not None and not self.closed:
            return replace(self, before=(self.first, mark)), ()
        return replace(self, opened=mark), ()


def _outside(context: Context, span: Span, side: str, does: str, mark: Span) -> Diagnostic:
    rule, place = context.row(ReadIssue.TEXT_OUTSIDE), replace(context, place=span)
    return report(place, rule, Basis.RULE, [], side=side, does=does, mark=f"program line {mark.line}")


def _first_words(passage: Passage) -> Span | None:
    """The first of some plain lines that says something."""
    for number, line in enumerate(passage.lines, passage.line):
        if words_of(line, passage.syntax):
            text = line.rstrip("\r\n")
            return Block(number, text, ()).span
    return None
