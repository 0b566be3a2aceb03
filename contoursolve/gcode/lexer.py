"""Reads characters into words: one table of tokens, no knowledge of any control."""

import re
from array import array
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from decimal import Decimal
from functools import cached_property, lru_cache
from itertools import chain
from typing import overload

from contoursolve.diagnostics import Span
from contoursolve.gcode.late_pattern import late_pattern
from contoursolve.gcode.plain_lines import Passage
from contoursolve.gcode.syntax import ISO, Syntax
from contoursolve.gcode.word import Block, Directive, Fault, FaultKind, Macro, Named, NamedAs, Program, Word

LONGEST_BLOCK = 2_000
"""Characters of a block outside comments; no control reads more, and a listing shows no more."""

LONGEST_NUMBER, MOST_BEFORE_POINT = 32, 20
"""Characters of a number, and those before its point. Controls read 8 digits; Python's decimals divide what has at most
28 before the point of the quotient."""

_LINE_END = re.compile(r"\r\n|\n|\r")
_SIMPLE_WORD = r"[ \t]*+([A-DF-Za-df-z])([+-]?+(?:[0-9]{1,16}+(?>(?:\.[0-9]{0,15}+)?)|\.[0-9]{1,16}+))(?=[ \tA-Za-z]|$)"
_SIMPLE = re.compile(rf"(?>(?:{_SIMPLE_WORD})+)[ \t]*+")
"""Nothing but words without blanks inside them; E may be an exponent."""
_SIMPLE_WORDS = re.compile(_SIMPLE_WORD)


def parse(text: str, name: str = "<program>", first_line: int = 1, syntax: Syntax = ISO) -> Program:
    """Read a program's text into blocks; nothing is ever refused here, faults are kept as records.

    Line ends are LF, CRLF or CR. The text is not changed: each word keeps its characters and place.
    """
    blocks = Blocks(text, first_line, syntax)
    return Program(name, text, tuple(blocks) if len(blocks) <= MANY_LINES else blocks, syntax)


def spelled(program: Program, syntax: Syntax) -> Program:
    """The program read in another way of spelling, if it is not read in this one."""
    if program.syntax is syntax:
        return program
    first = program.blocks[0].line if program.blocks else 1
    return parse(program.text, program.name, first, syntax)


MANY_LINES = 10_000
"""Lines up to which a program's blocks are kept; a block takes 50 times the memory of its line."""


class Blocks(Sequence[Block]):
    """The blocks of a text, each read whenever somebody looks at it; the first ones that are no plain lines are kept
    then."""

    def __init__(self, text: str, first_line: int, syntax: Syntax) -> None:
        self._text, self._first, self._syntax = text, first_line, syntax
        self._begins = array("Q", (0, *(end.end() for end in _LINE_END.finditer(text))))
        if len(self._begins) == 1 or self._begins[-1] < len(text):
            self._begins.append(len(text))
        self._kept: dict[int, Block] = {}

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
        return self._kept.get(place) or parse_block(line, self._first + place, self._syntax)

    @cached_property
    def _plain(self) -> "array[int]":
        """The index of the first line of each passage of plain lines, and of the line behind it, in turn."""
        text, begins, found, place, several = self._text, self._begins, array("Q"), 0, self._syntax.plain.several
        while place < len(self):
            passage = several.match(text, begins[place])
            behind = place + 1 if passage is None else bisect_left(begins, passage.end(), place + 1)
            if passage is not None:
                found.extend((place, behind))
            place = behind
        return found

    def passages(self) -> Iterator[Block | Passage]:
        """The blocks, plain lines in a row as passages. Whoever walks over a long program has to read the others
        alone."""
        place, ends = 0, chain(self._plain, (len(self), len(self)))
        for first, behind in zip(ends, ends, strict=True):
            for other in range(place, first):
                block = self._read(other)
                if len(self._kept) < MANY_LINES:
                    self._kept[other] = block
                yield block
            if first < behind:
                text = self._text[self._begins[first] : self._begins[behind]]
                yield Passage(self._first + first, text, behind - first, self._syntax)
            place = behind


def in_passages(blocks: Iterable[Block]) -> Iterator[Block | Passage]:
    """Blocks, plain lines that nobody has read into words yet as passages."""
    return blocks.passages() if isinstance(blocks, Blocks) else iter(blocks)


def telling(blocks: Iterable[Block]) -> Iterator[Block]:
    """The blocks that may say more than a motion: without plain lines that nobody has read yet, but for those with a
    comment, which controls with another spelling read."""
    for each in in_passages(blocks):
        if isinstance(each, Block):
            yield each
        elif each.syntax is ISO and "(" in each.text:
            yield from (block for block in blocks_in(each) if "(" in block.text)


def blocks_in(passage: Passage) -> Iterator[Block]:
    """The lines of a passage, read into words."""
    for number, line in enumerate(passage.lines, passage.line):
        yield parse_block(line.rstrip("\r\n"), number, passage.syntax)


def parse_block(text: str, line: int, syntax: Syntax = ISO) -> Block:
    """Read one line (without its end) into words and faults."""
    simple = _read_simply(text, line)
    if simple:
        # Most blocks; they need nothing of what follows.
        return Block(line, text, simple, syntax=syntax)
    if len(text) > LONGEST_BLOCK and len(syntax.comment.sub("", text)) > LONGEST_BLOCK:
        span = Span(line, 1, len(text) + 1)
        fault = Fault(FaultKind.BLOCK_TOO_LONG, f"{len(text):,} characters", span)
        return Block(line, text, (), (fault,), syntax=syntax)
    macro = syntax.statement.match(text)
    if macro:
        kind = Macro.FLOW if macro["flow"] else Macro.ASSIGNMENT
        is_skippable = syntax.skip.match(text) is not None
        return Block(line, text, (), macro=kind, is_skippable=is_skippable, syntax=syntax)
    return _read_tokens(text, line, syntax)


def _read_tokens(text: str, line: int, syntax: Syntax) -> Block:
    """Read one line that is no statement into words, faults and what comments say."""
    words: list[Word] = []
    faults: list[Fault] = []
    looks = text.translate(_READ_AS)
    directives: list[Directive] = []
    unmarked: list[Directive] = []
    named: list[Named] = []
    skip = syntax.skip.match(text)
    for token in syntax.token.finditer(looks, skip.end() if skip else 0):
        shape = token.lastgroup
        if shape == "comment":
            named += _named(token[0], line, token.start(), syntax)
            directives += _directives(token[0], line, token.start(), syntax)
            unmarked += _unmarked(token[0], line, token.start(), syntax)
        elif looks != text:
            places = range(token.start(), token.end())
            strange = [at for at in places if looks[at] != text[at]]
            faults += (Fault(FaultKind.STRAY_CHARACTER, text[at], Span(line, at + 1, at + 2)) for at in strange)
        if shape == "blank" or shape == "comment":
            continue
        span = Span(line, token.start() + 1, token.end() + 1)
        if shape == "word":
            address, number, is_asked = syntax.parts(token)
            if number and (len(number) > LONGEST_NUMBER or len(number.partition(".")[0]) > MOST_BEFORE_POINT):
                faults.append(Fault(FaultKind.NUMBER_TOO_LONG, token[0], span))
                continue
            value = Decimal(number) if number else None
            words.append(Word(address, value, "." in (number or ""), token[0], span, is_asked))
        elif shape in ("name", "glued"):
            code = syntax.codes.get(token[shape].upper())
            if shape == "glued":
                faults.append(Fault(FaultKind.BLANK_MISSING, token[0], span))
            words.append(Word("G", None if code is None else Decimal(code), False, token[0], span))
        else:
            faults.append(Fault(_FAULTS[shape or ""], token[0], span))
    return Block(
        line,
        text,
        tuple(words),
        tuple(faults),
        directives=tuple(directives),
        unmarked=tuple(unmarked),
        named=tuple(named),
        is_skippable=skip is not None,
        syntax=syntax,
    )


def words_as(block: Block, syntax: Syntax) -> tuple[Word, ...]:
    """The words of a block as they are spelled in a syntax; none from its comments."""
    return block.words if block.syntax is syntax else _respelled(block.text, block.line, block.syntax, syntax)


@lru_cache(16)
def _respelled(text: str, line: int, own: Syntax, other: Syntax) -> tuple[Word, ...]:
    """The words of a line as another syntax has them: several controls share one."""
    return parse_block(own.comment.sub(lambda comment: " " * len(comment[0]), text), line, other).words


def _read_simply(text: str, line: int) -> tuple[Word, ...]:
    """The words of a line that is nothing but words, without blanks inside them; none of another line."""
    return tuple([_simple_word(token, line) for token in _SIMPLE_WORDS.finditer(text)]) if _is_simple(text) else ()


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


def read_named(role: NamedAs, text: str, syntax: Syntax, line: int = 0, column: int = 1) -> Named:
    """Words that are named on a line, from a column on, as a syntax spells them, with signs between them or none; no
    words where anything else is there."""
    block = _read_tokens(" " * (column - 1) + _BETWEEN_WORDS.sub(" ", text), line, syntax)
    words = () if block.faults else block.words
    return Named(role, text.strip(), words, read_directive(text, line, column).span)


def looks_like(character: str) -> str:
    """The character that one looks like on a screen, where it is another one."""
    return character.translate(_READ_AS) if len(character) == 1 else character


def _directives(comment: str, line: int, offset: int, syntax: Syntax) -> list[Directive]:
    """The facts in a comment, separated by semicolons."""
    match = _DIRECTIVE.match(comment)
    if match is None or _NAMED.match(comment) or not comment.startswith(syntax.remark[0]):
        return []
    found, at = [], match.end()
    told = _without_end(comment[at:], match[0])
    for part in told.split(";"):
        if part.strip():
            found.append(read_directive(part, line, offset + at + 1))
        at += len(part) + 1
    return found


def _named(comment: str, line: int, offset: int, syntax: Syntax) -> list[Named]:
    """The words that a comment names."""
    match = _NAMED.match(comment)
    if match is None:
        return []
    text = _without_end(comment[match.end() :], match[0])
    return [read_named(NamedAs(match["role"].lower()), text, syntax, line, offset + match.end() + 1)]


def _without_end(text: str, mark: str) -> str:
    """The text of a comment behind its mark, without the bracket that ends it."""
    return text.removesuffix("]" if "[" in mark else ")" if "(" in mark else "")


_BETWEEN_WORDS = late_pattern(r";|,(?=\s)|,$")
_NAMED = late_pattern(
    r"(?:[(\[]|;\s*+\(?+)\s*+contoursolve\s*+:?+\s*+(?P<role>trust|reference)(?>(?:ed|d|s)?)(?:\s*+:|(?=\s))",
    re.IGNORECASE,
)
_DIRECTIVE = late_pattern(r"(?:[(\[]|;\s*+\(?+)\s*+contoursolve\s*+:", re.IGNORECASE)
_UNMARKED = late_pattern(r"[(;\[]\s*+c\w*tour[\s_-]*+sol\w*+(?P<gap>[\s:;.,=-]*+)(?P<fact>[^)]*+)", re.IGNORECASE)
_STATES = late_pattern(r"=|passes\s++through|tangent\s++to|meets", re.IGNORECASE)


def _unmarked(comment: str, line: int, offset: int, syntax: Syntax) -> list[Directive]:
    """A comment that begins almost like one that states facts, as it would have to be written."""
    match = _UNMARKED.match(comment)
    if match is None or _NAMED.match(comment) or (_DIRECTIVE.match(comment) and comment.startswith(syntax.remark[0])):
        return []
    fact = match["fact"]
    if not _STATES.search(fact):
        # In `(contoursolve = 5)` the sign is between the mark and what it states.
        _, sign, behind = match["gap"].rpartition("=")
        if not sign:
            return []
        fact = sign + behind + fact
    text = syntax.remark.format(f"contoursolve: {fact.removesuffix(']' if comment[0] == '[' else '').strip()}")
    return [Directive(text, Span(line, offset + 1, offset + 1 + len(comment)))]


_READ_AS = {
    0x00: " ",
    **dict.fromkeys((0xA0, 0x2002, 0x2003, 0x2007, 0x2009, 0x200A, 0x200B, 0x202F, 0x3000), " "),
    **dict.fromkeys((0x2010, 0x2011, 0x2012, 0x2013, 0x2014, 0x2212), "-"),
    0xFF0C: ",",
    0xFF0E: ".",
    **{0xFF10 + digit: str(digit) for digit in range(10)},
}
"""Characters that look like others on a screen, each with that one: they are told, and what they stand in is read as it
looks."""

_FAULTS = {
    "open": FaultKind.COMMENT_NOT_CLOSED,
    "malformed": FaultKind.NUMBER_MALFORMED,
    "mistyped": FaultKind.NUMBER_MALFORMED,
    "bare": FaultKind.NUMBER_MISSING,
    "comma_only": FaultKind.COMMA_WITHOUT_ADDRESS,
    "stray": FaultKind.STRAY_CHARACTER,
}
