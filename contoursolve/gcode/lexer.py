"""Reads characters into words: one table of tokens, no knowledge of any control."""

import re
from array import array
from collections.abc import Container, Iterator, Sequence
from decimal import Decimal
from typing import overload

from contoursolve.diagnostics.source import Span
from contoursolve.gcode.word import Block, Directive, Fault, FaultKind, Macro, Program, Word

LONGEST_BLOCK = 2_000
"""Characters of a block outside comments; no control reads more, and a listing shows no more."""

LONGEST_NUMBER, MOST_BEFORE_POINT = 32, 20
"""Characters of a number, and those before its point. Controls read 8 digits; Python's decimals divide what has at most
28 before the point of the quotient."""

_LINE_END = re.compile(r"\r\n|\n|\r")
_LINE = re.compile(r"[^\r\n]*(?:\r\n|\n|\r)|[^\r\n]+")
# Runs are possessive (`++`, `*+`): what they take is never tried again, so that a line takes time by its length.
# Groups that repeat are atomic (`(?>...)`) instead: Python before 3.11.5 reads `(?:...)*+` wrongly (gh-106052).
_BRACKETS = r"\[(?>(?:[^\[\]]++|\[(?>(?:[^\[\]]++|\[[^\[\]]*+\])*)\])*)\]"
_TOKEN = re.compile(
    rf"""
    (?P<blank>[ \t\f\v\x02\x03\x11-\x14\x1a\ufeff%]++)
  | (?P<comment>\([^)]*+\)|;.*+)
  | (?P<open>\([^)]*+)
  | (?P<word>(?P<comma>,?+)[ \t]*+(?P<letter>[A-Za-z])[ \t]*+
      (?:(?P<number>[+-]?+(?>\d++\.?+\d*+|\.\d++))(?![\d.]|,\d|[eE][+-]?+\d++(?![\d.]))
        |(?P<expression>[+-]?+(?:\#\d++|\#?+{_BRACKETS}))|(?P<asked>\?)))
  | (?P<malformed>,?+[ \t]*+[A-Za-z][ \t]*+(?>(?:[\d.+-]|,(?=\d))+)(?>(?:[eE][+-]?+\d++)?))
  | (?P<bare>,?+[ \t]*+[A-Za-z](?>(?:(?![A-Za-z][ \t]*+[+-]?+\.?+\d)[A-Za-z])*))
  | (?P<comma_only>,[^ \tA-Za-z(;]*+)
  | (?P<stray>[^ \tA-Za-z(;,%]++|.)
    """,
    re.VERBOSE | re.ASCII,
)
_SIMPLE_WORD = r"[ \t]*+([A-DF-Za-df-z])([+-]?+(?:[0-9]{1,16}+(?>(?:\.[0-9]{0,15}+)?)|\.[0-9]{1,16}+))(?=[ \tA-Za-z]|$)"
_SIMPLE = re.compile(rf"(?>(?:{_SIMPLE_WORD})+)[ \t]*+")
"""Nothing but words without blanks inside them; E may be an exponent."""
_SIMPLE_WORDS = re.compile(_SIMPLE_WORD)
_SKIP = re.compile(r"[ \t]*+/[1-9]?+(?!\d)")
_MACRO = re.compile(
    r"[ \t/]*+(?>(?:[Nn]\d++)?)[ \t]*+(?:(?P<assignment>\#)|(?P<flow>(?:IF|WHILE|GOTO|DO|END|THEN|ELSE)\b"
    r"|(?:GOTO|DO|END)\d|(?:IF|WHILE)\[))",
    re.IGNORECASE,
)
_COMMENTS = re.compile(r"\([^)]*+\)?+|;.*+")


def parse(text: str, name: str = "<program>", first_line: int = 1) -> Program:
    """Read a program's text into blocks; nothing is ever refused here, faults are kept as records.

    Line ends are LF, CRLF or CR. The text is not changed: each word keeps its characters and place.
    """
    blocks = Blocks(text, first_line)
    return Program(name, text, tuple(blocks) if len(blocks) <= MANY_LINES else blocks)


MANY_LINES = 10_000
"""Lines up to which a program's blocks are kept; a block takes 50 times the memory of its line."""


class Blocks(Sequence[Block]):
    """The blocks of a text, each read whenever somebody looks at it."""

    def __init__(self, text: str, first_line: int) -> None:
        self._text, self._first = text, first_line
        self._begins = array("Q", (0, *(end.end() for end in _LINE_END.finditer(text))))
        if len(self._begins) == 1 or self._begins[-1] < len(text):
            self._begins.append(len(text))

    def __len__(self) -> int:
        return len(self._begins) - 1

    @overload
    def __getitem__(self, index: int) -> Block: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Block, ...]: ...

    def __getitem__(self, index: int | slice) -> Block | tuple[Block, ...]:
        places = range(len(self))[index]
        return tuple(map(self._read, places)) if isinstance(places, range) else self._read(places)

    def __iter__(self) -> Iterator[Block]:
        return map(self._read, range(len(self)))

    def _read(self, place: int) -> Block:
        line = self._text[self._begins[place] : self._begins[place + 1]].rstrip("\r\n")
        return parse_block(line, self._first + place)


def split_lines(text: str) -> list[str]:
    """The lines of a text, each with its end: LF, CRLF or CR."""
    return _LINE.findall(text)


def parse_block(text: str, line: int) -> Block:
    """Read one line (without its end) into words and faults."""
    simple = _read_simply(text, line)
    if simple:
        # Most blocks; they need nothing of what follows.
        return Block(line, text, simple)
    if len(text) > LONGEST_BLOCK and len(_COMMENTS.sub("", text)) > LONGEST_BLOCK:
        span = Span(line, 1, len(text) + 1)
        return Block(line, text, (), (Fault(FaultKind.BLOCK_TOO_LONG, f"{len(text):,} characters", span),))
    macro = _MACRO.match(text)
    if macro:
        return Block(line, text, (), macro=Macro.ASSIGNMENT if macro["assignment"] else Macro.FLOW)
    words: list[Word] = []
    faults: list[Fault] = []
    directives: list[Directive] = []
    unmarked: list[Directive] = []
    skip = _SKIP.match(text)
    for token in _TOKEN.finditer(text, skip.end() if skip else 0):
        kind = token.lastgroup
        if kind == "comment":
            directives += _directives(token[0], line, token.start())
            unmarked += _unmarked(token[0], line, token.start())
        if kind == "blank" or kind == "comment":
            continue
        span = Span(line, token.start() + 1, token.end() + 1)
        if kind == "word":
            comma, letter, number, asked = token.group("comma", "letter", "number", "asked")
            if number and (len(number) > LONGEST_NUMBER or len(number.partition(".")[0]) > MOST_BEFORE_POINT):
                faults.append(Fault(FaultKind.NUMBER_TOO_LONG, token[0], span))
                continue
            address = (comma + letter).upper()
            value = Decimal(number) if number else None
            words.append(Word(address, value, "." in (number or ""), token[0], span, asked is not None))
        else:
            faults.append(Fault(_FAULTS[kind or ""], token[0], span))
    return Block(
        line,
        text,
        tuple(words),
        tuple(faults),
        directives=tuple(directives),
        unmarked=tuple(unmarked),
        is_skippable=skip is not None,
    )


def _read_simply(text: str, line: int) -> tuple[Word, ...]:
    """The words of a line that is nothing but words, without blanks inside them; none of another line."""
    return tuple([_simple_word(token, line) for token in _SIMPLE_WORDS.finditer(text)]) if _is_simple(text) else ()


def find_words(text: str, line: int, addresses: Container[str]) -> list[Word]:
    """The words of a line that have one of some addresses."""
    if not _is_simple(text):
        return [word for word in parse_block(text, line).words if word.address in addresses]
    tokens = _SIMPLE_WORDS.finditer(text)
    return [_simple_word(token, line) for token in tokens if token[1].upper() in addresses]


def _is_simple(text: str) -> bool:
    return len(text) <= LONGEST_BLOCK and _SIMPLE.fullmatch(text) is not None


def _simple_word(token: re.Match[str], line: int) -> Word:
    letter, number = token.groups()
    begin, end = token.start(1), token.end()
    return Word(letter.upper(), Decimal(number), "." in number, letter + number, Span(line, begin + 1, end + 1))


def read_directive(text: str, line: int, column: int = 1) -> Directive:
    """A fact that is stated on a line, from a column on; blanks around it do not belong to it."""
    begin = column + len(text) - len(text.lstrip())
    return Directive(text.strip(), Span(line, begin, begin + max(len(text.strip()), 1)))


def _directives(comment: str, line: int, offset: int) -> list[Directive]:
    """The facts in a comment, separated by semicolons."""
    match = _DIRECTIVE.match(comment)
    if match is None:
        return []
    found, at = [], match.end()
    for part in comment[at:].removesuffix(")").split(";"):
        if part.strip():
            found.append(read_directive(part, line, offset + at + 1))
        at += len(part) + 1
    return found


_DIRECTIVE = re.compile(r"\(\s*+contoursolve\s*+:", re.IGNORECASE)
_UNMARKED = re.compile(r"[(;]\s*+c\w*tour[\s_-]*+sol\w*+(?P<gap>[\s:;.,=-]*+)(?P<fact>[^)]*+)", re.IGNORECASE)
_STATES = re.compile(r"=|passes\s++through|tangent\s++to|meets", re.IGNORECASE)


def _unmarked(comment: str, line: int, offset: int) -> list[Directive]:
    """A comment that begins almost like one that states facts, as it would have to be written."""
    match = _UNMARKED.match(comment)
    if match is None or _DIRECTIVE.match(comment):
        return []
    fact = match["fact"]
    if not _STATES.search(fact):
        # In `(contoursolve = 5)` the sign is between the mark and what it states.
        _, sign, behind = match["gap"].rpartition("=")
        if not sign:
            return []
        fact = sign + behind + fact
    text = f"(contoursolve: {fact.strip()})"
    return [Directive(text, Span(line, offset + 1, offset + 1 + len(comment)))]


_FAULTS = {
    "open": FaultKind.COMMENT_NOT_CLOSED,
    "malformed": FaultKind.NUMBER_MALFORMED,
    "bare": FaultKind.NUMBER_MISSING,
    "comma_only": FaultKind.COMMA_WITHOUT_ADDRESS,
    "stray": FaultKind.STRAY_CHARACTER,
}
