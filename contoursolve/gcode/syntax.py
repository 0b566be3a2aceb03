"""Spelling of a control's blocks: its tokens, its comments, and the names that stand for G codes."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from contoursolve.gcode.plain_spelling import ISO_LINES, PlainSpelling


def letter_parts(token: re.Match[str]) -> tuple[str, str | None, bool]:
    """The parts of a word whose address is a letter, or a comma and a letter; of one as other controls have them, with
    several letters and an equals sign."""
    if token["long"] is not None:
        return token["long"].upper(), token["value"], False
    comma, letter, number, asked = token.group("comma", "letter", "number", "asked")
    return (comma + letter).upper(), number, asked is not None


def long_parts(token: re.Match[str]) -> tuple[str, str | None, bool]:
    """The parts of a word whose address may have several letters: `X=IC` is the address of `X=IC(5)`. A comma stands
    for a point."""
    found = token.groupdict()
    function, number = found["function"], found["inner"] or found["plain"] or found["short"]
    address = (found["letter"] or found["long"]) + (f"={function}" if function else "")
    is_asked = any(found[name] is not None for name in ("unset", "wanted", "asked"))
    return address.upper(), number and number.replace(",", "."), is_asked


_LAST_NUMBER = re.compile(r"[+-]?+[\d.,]++(?=\s*+$)|\?(?=\s*+$)")


@dataclass(frozen=True)
class WordSpelling:
    """One way to spell words. `before` is the text before the numbers of words that have no equals sign there, by their
    addresses; those of `signs` have a sign and no number. `names` are the addresses whose values words of other names
    state, and `spare` is text before a number that belongs to another word, but for its first group."""

    before: Mapping[str, str] = field(default_factory=dict)
    signs: frozenset[str] = frozenset()
    names: Mapping[str, str] = field(default_factory=dict)
    spare: re.Pattern[str] | None = None

    def __hash__(self) -> int:
        return hash((frozenset(self.before), self.signs, frozenset(self.names)))

    @cached_property
    def addresses(self) -> Mapping[str, str]:
        """The addresses of words whose text before the number is another one, by that text."""
        return {text.strip(): address for address, text in self.before.items() if text.strip() != address}

    def spell(self, address: str, number: str) -> str:
        """A word of an address and a number: `X40.`, `,A30.`, `ANG=30`, `X=IC(5)`, `LEN40`, `DR-`."""
        if address in self.before:
            return self.before[address] + number
        if address in self.signs:
            return address + ("-" if number.startswith("-") else "+")
        if "=" in address:
            return f"{address}({number})"
        return f"{address}={number}" if len(address.lstrip(", \t")) > 1 else address + number

    def number_of(self, text: str, address: str) -> str:
        """The number of a word that is spelled so, as it is written."""
        if address in self.before:
            found = _LAST_NUMBER.search(text)
            return found[0] if found else ""
        return text.strip()[len(address) :].strip("=() \t")


PLAIN = WordSpelling()
"""The spelling of words by letters, and by names with an equals sign."""


_SKIP = re.compile(r"[ \t]*+/[1-9]?+(?!\d)")


@dataclass(frozen=True, slots=True)
class Syntax:
    """One way to spell blocks.

    `token` matches each stretch of a block, and is named by what it is: a `blank`, a `comment`, a `word`, the `name` of
    a code, or one of the faults of the lexer (`mistyped` is a number that is almost one). `parts` are those of a word:
    its address, its number if it has one, and whether a question mark stands for it. `statement` matches a block that
    is no list of words: an `assignment` or a `flow` of control. `remark` is what a comment looks like that is written,
    with `{}` for its text; facts stand in those alone.
    """

    name: str
    token: re.Pattern[str]
    statement: re.Pattern[str]
    comment: re.Pattern[str]
    remark: str = "({})"
    codes: Mapping[str, int] = field(default_factory=dict)
    """The codes that have a name instead of G and a number, by that name in upper case: a number that no G code has."""
    parts: Callable[[re.Match[str]], tuple[str, str | None, bool]] = letter_parts
    skip: re.Pattern[str] = _SKIP
    """Beginning of a block that a switch at the machine skips."""
    bare_number: re.Pattern[str] | None = None
    """A block with its number alone, where none may be left with that."""
    counts_blocks: bool = False
    """Whether whoever writes such programs counts by the numbers of blocks, not by lines."""
    plain: PlainSpelling = ISO_LINES
    """The lines that do nothing but move."""
    words: WordSpelling = PLAIN
    """The spelling of its words."""

    def __hash__(self) -> int:
        return hash(self.name)


# Runs are possessive (`++`, `*+`): what they take is never tried again, so that a line takes time by its length.
# Groups that repeat are atomic (`(?>...)`) instead: Python before 3.11.5 reads `(?:...)*+` wrongly (gh-106052).
DEEPEST_BRACKETS = 30
"""Levels of brackets that are read; Fanuc admits five."""


def nested(opening: str, closing: str, inside: str, depth: int = DEEPEST_BRACKETS) -> str:
    """A pattern for what stands between brackets, with so many levels of them."""
    pattern = ""
    for _ in range(depth):
        pattern = rf"{opening}(?>(?:{inside}{pattern and '|'}{pattern})*){closing}"
    return pattern


IN_BRACKETS = nested(r"\[", r"\]", r"[^\[\]]++")
"""Text in square brackets: an expression, or the index of a field."""
IN_PARENTHESES = nested(r"\(", r"\)", r"[^()\"]++|\"[^\"]*+\"")
"""Text in parentheses: an expression, or arguments. Parentheses in a text in quotes do not count."""
ISO = Syntax(
    "iso",
    token=re.compile(
        rf"""
    (?P<blank>[ \t\f\v\x02\x03\x11-\x14\x1a\ufeff%]++)
  | (?P<comment>\([^)]*+\)|;.*+)
  | (?P<open>\([^)]*+)
  | (?P<word>(?P<long>\#?+[A-Za-z_][A-Za-z]\w*+|[SMsm]\d{{1,2}})[ \t]*+=[ \t]*+
      (?P<value>[+-]?+(?>\d++\.?+\d*+|\.\d++))(?![\d.,\[\#])
    |(?P<comma>,?+)[ \t]*+(?P<letter>[A-Za-z])[ \t]*+
      (?:(?P<number>[+-]?+(?>\d++\.?+\d*+|\.\d++))(?![\d.]|,\d|[eE][+-]?+\d++(?![\d.]))
        |(?P<expression>[+-]?+(?:\#++\d++|\#?+{IN_BRACKETS}))|(?P<asked>\?)))
  | (?P<malformed>,?+[ \t]*+[A-Za-z][ \t]*+(?>(?:[\d.+-]|,(?=\d))+)(?>(?:[eE][+-]?+\d++)?))
  | (?P<bare>,?+[ \t]*+[A-Za-z](?>(?:(?![A-Za-z][ \t]*+[+-]?+\.?+\d)[A-Za-z])*))
  | (?P<comma_only>,[^ \tA-Za-z(;]*+)
  | (?P<stray>[^ \tA-Za-z(;,%]++|.)
    """,
        re.VERBOSE | re.ASCII,
    ),
    statement=re.compile(
        r"[ \t/]*+(?>(?:[Nn]\d++)?)[ \t]*+(?:(?P<assignment>\#)|(?P<flow>(?:IF|WHILE|GOTO|DO|END|THEN|ELSE)\b"
        r"|(?:GOTO|DO|END)\d|(?:IF|WHILE)\[))",
        re.IGNORECASE,
    ),
    comment=re.compile(r"\([^)]*+\)?+|;.*+"),
)
"""Letters with numbers, comments in brackets or behind a semicolon: Fanuc, and whoever follows ISO 6983."""
