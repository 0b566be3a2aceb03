"""Facts as words that findings and listings can show."""

from contoursolve.source import Span
from contoursolve.syntax import FACT, Directive, Word


def word_of(directive: Directive, begin: int = 0, end: int | None = None) -> Word:
    """A directive, or a part of it, as a word that a finding can mark."""
    text = directive.text[begin:end] or directive.text[-1:]
    column = directive.span.column + begin
    return Word(FACT, None, False, text, Span(directive.span.line, column, column + max(len(text), 1)))
