"""Words, blocks and programs exactly as they were typed."""

import re
from collections.abc import Iterable, Sequence
from decimal import Decimal
from enum import Enum
from typing import NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Shown, Span
from contoursolve.gcode.syntax import ISO, Syntax


class Word(Struct, frozen=True):
    """An address with its value, such as `X40.` or `,A150`.

    Attributes:
        address: the address, upper case with its comma.
        number: the number as it is typed; None for a variable, a macro expression, or `?`.
        has_point: whether the number has a decimal point, or is read as if it had.
        text: what was typed.
        span: its place in the program.
        is_asked: whether `?` stands for the number.
    """

    address: str
    number: Decimal | None
    has_point: bool
    text: str
    span: Span
    is_asked: bool = False


FACT = "fact"
"""Address of a fact that is no word."""


class Directive(Struct, frozen=True):
    """A fact for contoursolve alone, in a comment `(contoursolve: ...)` or stated apart from the program.

    A fact apart from the program has a line number below zero, and may hold the statement that `text` shows.
    """

    text: str
    span: Span
    statement: object = None


class FaultKind(Enum):
    """Fault in the characters of a block."""

    NUMBER_MISSING = "number-missing"
    NUMBER_MALFORMED = "number-malformed"
    NUMBER_TOO_LONG = "number-too-long"
    BLANK_MISSING = "blank-missing"
    COMMA_WITHOUT_ADDRESS = "comma-without-address"
    STRAY_CHARACTER = "stray-character"
    COMMENT_NOT_CLOSED = "comment-not-closed"
    BLOCK_TOO_LONG = "block-too-long"


class Fault(Struct, frozen=True):
    """A stretch of a block that is not a word."""

    kind: FaultKind
    text: str
    span: Span

    @property
    def address(self) -> str:
        """The address that the word would have had, upper case with its comma; empty if there is none."""
        match = _ADDRESS.match(self.text)
        return "".join(match.groups()).upper() if match else ""


_ADDRESS = re.compile(
    r"[ \t]*(,?)[ \t]*"
    r"(#?[A-Za-z_]\w*(?=[ \t]*=)|[A-Za-z]{2,}(?=[ \t]+[+-]?[RQ])|[A-Za-z]{2,}(?=[ \t]*[+-]?\.?\d)|[A-Za-z])",
    re.ASCII,
)


def call(word: Word, words: Sequence[Word]) -> str:
    """The name of a word among all: its letter, with its line where several have it."""
    is_alone = sum(each.address == word.address for each in words) == 1
    return word.address if is_alone else f"{word.span.line}:{word.address}"


def words_called(name: str, words: Iterable[Word]) -> list[Word]:
    """The words that a name means among all: its letter, `A`, or with its program line, `2:A`; several where the letter
    alone does not tell. Capitals do not matter."""
    line, _, address = name.strip().upper().rpartition(":")
    if line and not line.isdecimal():
        return []
    return [each for each in words if each.address == address and (not line or each.span.line == int(line))]


class NamedAs(Enum):
    """The part that words play which a comment names for contoursolve alone."""

    TRUST = "trust"
    """They are right: no fix changes them."""
    REFERENCE = "reference"
    """They are compared with the contour, and not used."""


class Named(Struct, frozen=True):
    """Words that a comment names for contoursolve alone, `(contoursolve trust: Z-50. A120.)`, or that are named apart
    from the program, on a line below 1; none where the comment cannot be read as words."""

    role: NamedAs
    text: str
    words: tuple[Word, ...]
    span: Span


class Macro(Enum):
    """Macro statements that a block may consist of."""

    ASSIGNMENT = "assignment"
    """`#100 = 5.`: moves nothing."""
    FLOW = "flow"
    """`IF`, `WHILE`, `GOTO`, ...: which block runs next is not known."""


class Caller(Struct, frozen=True):
    """The block from which a line was called: its line, and what it says. `cycle` is the cycle whose profile it is;
    `is_reached` says whether the main program comes there."""

    line: int
    text: str
    cycle: str = ""
    is_reached: bool = True


class Substitution(Struct, frozen=True):
    """Text that replaces a variable in a line: the columns of the typed value, from 0, and its number. Without a
    number, `reason` says why."""

    begin: int
    end: int
    typed: str
    number: str
    reason: str = ""

    def is_within(self, span: Span) -> bool:
        """Whether the typed value is in a stretch of the line as it was typed."""
        return span.column <= self.begin + 1 and self.end < span.end_column


def typed_span(span: Span, substituted: Sequence[Substitution]) -> Span:
    """The place in a line as it was typed of a stretch of the line with numbers for its variables; of a part of such a
    number, all of what it replaces."""
    begin, end = span.column - 1, span.end_column - 1
    typed_begin, typed_end, shift = begin, end, 0
    for each in substituted:
        first = each.begin + shift
        last = first + len(each.number or each.typed)
        shift += last - first - (each.end - each.begin)
        if begin > first:
            typed_begin = begin - shift if begin >= last else each.begin
        if end > first:
            typed_end = end - shift if end >= last else each.end
    return Span(span.line, typed_begin + 1, typed_end + 1)


class Block(Shown, Struct, frozen=True):
    """One line of a program.

    Attributes:
        line: its number, from 1.
        text: the line without its end, with numbers in the place of known variables.
        words: its words, in their order.
        faults: the stretches that are no words.
        macro: what kind of macro statement it is; None for words.
        directives: the facts that its comments state for contoursolve.
        unmarked: comments that look like facts, but lack the mark: what would have to be written.
        named: the words that its comments name, as trusted or for reference.
        is_skippable: whether it begins with `/`: a switch at the machine decides whether it runs.
        syntax: the spelling by which it was read.
        callers: from where it was called, the main program first.
        file: the file of the subprogram that it belongs to, if that is another file.
        substituted: texts that replace variables in it, in the order of the line.
        mark: under which number is kept what is known before it; 0: it is not kept.
    """

    line: int
    text: str
    words: tuple[Word, ...]
    faults: tuple[Fault, ...] = ()
    macro: Macro | None = None
    directives: tuple[Directive, ...] = ()
    unmarked: tuple[Directive, ...] = ()
    named: tuple[Named, ...] = ()
    is_skippable: bool = False
    syntax: Syntax = ISO
    callers: tuple[Caller, ...] = ()
    file: str = ""
    substituted: tuple[Substitution, ...] = ()
    mark: int = 0

    def find(self, address: str) -> Word | None:
        """The first word with this address, or None."""
        for word in self.words:
            if word.address == address:
                return word
        return None

    def with_points(self, words: Iterable[Word]) -> "Block":
        """The block, in which some of its words are read as if they had their decimal points."""
        texts = {word.text for word in words}
        if not texts:
            return self
        own = (replace(each, has_point=True) if each.text in texts else each for each in self.words)
        return replace(self, words=tuple(own))

    @property
    def pointed(self) -> list[Word]:
        """The words that are read so."""
        return [word for word in self.words if word.has_point and "." not in word.text]

    def typed_span(self, span: Span) -> Span:
        """The place of a stretch of its text in the line as it was typed."""
        return typed_span(span, self.substituted)

    @property
    def says_something(self) -> bool:
        """Whether it has more than its number."""
        return bool(self.faults or self.macro) or any(word.address not in "NO" for word in self.words)

    @property
    def span(self) -> Span:
        """The whole line without surrounding blanks."""
        stripped = self.text.strip()
        column = self.text.find(stripped) + 1 if stripped else 1
        return Span(self.line, column, column + max(len(stripped), 1))


class TypedPlace(NamedTuple):
    """The place of a word in its line as it was typed, and the variables and expressions that give its value."""

    span: Span
    formulas: tuple[str, ...]


def typed_places(words: Iterable[Word], blocks: Iterable[Block]) -> dict[Span, TypedPlace]:
    """The places of words as they were typed, by their places in blocks that have numbers for variables."""
    lines: dict[int, list[Block]] = {}
    for block in blocks:
        if block.substituted:
            lines.setdefault(block.line, []).append(block)
    return {word.span: _typed_place(word, lines.get(word.span.line, ())) for word in words}


def _typed_place(word: Word, blocks: Iterable[Block]) -> TypedPlace:
    # In a loop, a line may run several times.
    block = next((each for each in blocks if word in each.words), None)
    span = word.span if block is None else block.typed_span(word.span)
    typed = [each.typed for each in block.substituted if each.is_within(span)] if block is not None else []
    return TypedPlace(span, tuple(typed or [word.text.strip()] * (word.number is None and not word.is_asked)))


class Program(Shown, Struct, frozen=True):
    """A program as typed.

    Attributes:
        name: what findings call it.
        text: all of it.
        blocks: its lines, empty ones included.
        syntax: the spelling by which it was read.
    """

    name: str
    text: str
    blocks: Sequence[Block]
    syntax: Syntax = ISO
