"""Block numbers and the jumps to them: where each stands, what follows it, and how one is renamed."""

import re
from collections import defaultdict
from collections.abc import Mapping, Sequence
from decimal import Decimal
from enum import Enum

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls import DIALECTS
from contoursolve.diagnosis import SHOWN, join
from contoursolve.diagnostics import Span
from contoursolve.gcode import ISO, Block, FaultKind, Word, parse, parse_block, split_lines
from contoursolve.program import UnknownControlError, choose, configure, named_control
from contoursolve.reading import COMMENTED, Dialect

SHORT, LONG = 9_999, 99_999
"""The highest block number: four digits, unless the program itself uses five."""

PROFILE_CYCLES = (70, 71, 72, 73)
"""Turning cycles whose profile is between the blocks P and Q."""


class Where(Enum):
    """The program of a file in which a jump looks for its block."""

    OWN = "own"
    CALLED = "called"
    """The one that P names; the own one without P."""
    CALLER = "caller"
    """The own one if that is a main program, else the one that calls it."""


class WordJump(Struct, frozen=True):
    """A code of ISO 6983 controls, and the words beside it that name blocks."""

    code: str
    addresses: str
    where: Where = Where.OWN
    controls: tuple[str, ...] = ()
    """Beginnings of the names of the controls that have it; empty for all controls."""


_PROFILES = frozenset(f"G{code}" for code in PROFILE_CYCLES)
_PROFILE_WORDS, _DRILLING_WORDS = frozenset("PQ"), frozenset("XYZ")
"""P and Q name blocks where there are both, and no word of a drilling cycle, which G73 is on a mill."""

WORD_JUMPS = (
    *(WordJump(code, "PQ") for code in sorted(_PROFILES)),
    # Haas operator's manual, M96 and M97; on a Fanuc, M96 calls a program, and M97 is the machine's own.
    WordJump("M96", "P", controls=("haas",)),
    WordJump("M97", "P", controls=("haas",)),
    WordJump("M98", "Q", Where.CALLED, ("fanuc", "nct", "yasnac")),
    WordJump("M98", "H", Where.CALLED, ("mitsubishi",)),
    WordJump("M99", "P", Where.CALLER),
)


class TextJump(Struct, frozen=True):
    """A statement that names blocks: one as its `target`, several anywhere in its `targets`, or, for a `reason`, ones
    that cannot be followed."""

    pattern: re.Pattern[str]
    reason: str = ""


def _text(pattern: str, reason: str = "") -> TextJump:
    return TextJump(re.compile(pattern, re.IGNORECASE | re.ASCII), reason)


_COMPUTES = "may lead to any block, so the blocks keep their numbers"
_ELSEWHERE = "may lead to a block of the program that calls this one"
_ANOTHER = "names blocks of another program"
TEXT_JUMPS: Mapping[str, tuple[TextJump, ...]] = {
    "iso": (_text(r"(?<![A-Z])GOTO[ \t]*+(?P<target>(?:N[ \t]*+)?\d++(?![\d.\[#])|[^ \t]*+)"),),
    "sinumerik": (
        _text(r"(?<![A-Z_])GOTO[BFC]?\b[ \t]*+(?P<target>N\d++\b|:\d++|[A-Z_]\w++(?![\[(<])|.*+)"),
        _text(r"(?<![A-Z_])REPEATB?\b(?P<targets>.*+)"),
        _text(r"(?<![A-Z_])CALL[ \t]++BLOCK\b(?P<targets>.*+)"),
        _text(r"(?<![A-Z_])CALL\b(?![ \t]++BLOCK\b).*?\bBLOCK\b", _ANOTHER),
        _text(r"(?<![A-Z_])RET[ \t]*+\([ \t,]*+[^ \t,)][^)]*+\)?", _ELSEWHERE),
        # The profile of a turning cycle; the text of a message is no jump.
        _text(r"^(?!.*\bMSG\b).*?(?P<targets>\"N\d++(?::N\d++)?\".*+)"),
    ),
    "isg": (
        _text(r"\$GOTO[ \t]*+(?P<target>N[ \t]*+\d++\b|\[[^\]]*+\]|.*+)"),
        _text(r"(?<![A-Z_])L[ \t]++SEQUENCE\b(?=.*\bNAME\b)", _ANOTHER),
        _text(r"(?<![A-Z_])L[ \t]++SEQUENCE\b(?=.*\bN[ \t]*+[^\d \tA])", _COMPUTES),
        _text(r"(?<![A-Z_])L[ \t]++SEQUENCE\b(?P<targets>.*+)"),
    ),
}
"""The statements that name blocks, by the name of the syntax.

Fanuc, Haas, Mitsubishi: custom macro; SINUMERIK: job planning, program jumps and repetition; ISG kernel: programming
manual, control blocks and L SEQUENCE.
"""

_NAMED = re.compile(r"(?<![A-Z_$])N[ \t]*+(\d++)(?!(?!N\d|TO\b)\w)", re.IGNORECASE | re.ASCII)
_TARGET = re.compile(r"(?:N[ \t]*+)?(\d++)", re.IGNORECASE | re.ASCII)
_WORD = re.compile(r"[A-Z][ \t]*+\+?+(\d++)\.?+", re.IGNORECASE | re.ASCII)
_OWN_NUMBER = re.compile(r"[ \t]*+(?>(?:/\d?+)?)[ \t]*+N[ \t]*+(\d++)(?![\d.])", re.IGNORECASE | re.ASCII)
_LABEL = re.compile(r"(?<![\w$])([A-Z_]\w++):(?!=)", re.IGNORECASE | re.ASCII)
_MARK = re.compile(r":\d++|\[[ \t]*+[A-Z_]\w*+[ \t]*+\]", re.IGNORECASE | re.ASCII)
_STRING = re.compile(r"\"(?!N\d++(?::N\d++)?\")[^\"]*+\"", re.IGNORECASE | re.ASCII)
_BEGINS_TAPE = re.compile(r"[ \t]*+%[ \t]*+\w")
_BEGINS_ISO = re.compile(r"[ \t/]*+(?>(?:N\d++)?)[ \t]*+[O:][ \t]*+(\d++)", re.IGNORECASE | re.ASCII)
_ENDS = frozenset({"M2", "M30"})
_CALLS = frozenset({"M98", "G65", "G66"})
_PARAMETERS = frozenset({"L50", "L52"})
"""Beside G10: blocks up to G11 set parameters then, which their N names (Fanuc operator's manual, G10 L50, G10 L52)."""
_REPEATS = 10_000
"""In M98 P51000 the digits before the last four are a number of times on older controls."""


class BlockNumber(Struct, frozen=True):
    """A block number as it is typed, in its block or in a jump to it.

    `span` are its digits, and `number` is what they say. `line` is that of the block: None for a jump to no block of
    the program, or to one of several.
    """

    span: Span
    number: int
    line: int | None


class Replacement(Struct, frozen=True):
    """A stretch of one line, and the text that takes its place."""

    span: Span
    text: str


def block_number_at(
    text: str,
    line: int,
    column: int,
    *,
    control: str | Dialect | None = None,
    settings: Mapping[str, str] | None = None,
) -> BlockNumber | None:
    """The block number under the cursor, of a block or in a jump to it; None if there is none.

    Args:
        text: the program.
        line: the line of the cursor, from 1.
        column: the column before which it stands, from 1.
        control: and `settings` as for `format_program`, with the same errors.

    >>> found = block_number_at("N10 G00 X0\\nGOTO 10", 2, 6)
    >>> found.number, found.line, found.span.column, found.span.end_column
    (10, 1, 6, 8)
    """
    numbers = numbers_of(text, control, settings)
    places = (each for each in (numbers.own.get(line), *numbers.jumps) if each is not None and each.span.line == line)
    place = next((each for each in places if each.begin <= column <= each.span.end_column), None)
    if place is None:
        return None
    blocks = [place] if place is numbers.own.get(line) else numbers.blocks.get((place.section, place.number), [])
    return BlockNumber(place.span, place.number, blocks[0].span.line if len(blocks) == 1 else None)


def rename_block(
    text: str,
    line: int,
    number: int,
    *,
    control: str | Dialect | None = None,
    settings: Mapping[str, str] | None = None,
) -> tuple[Replacement, ...]:
    """Another number for one block, and for every jump to it.

    Args:
        text: the program.
        line: the line of the block, from 1.
        number: its new number.
        control: and `settings` as for `format_program`, with the same errors.

    Returns:
        The digits that change, from the first line to the last one.

    Raises:
        ValueError: the block has no number, or another one has the new number. Or a jump may lead to the block, and
            the program does not tell.

    >>> [(each.span, each.text) for each in rename_block("N10 G00 X0\\nGOTO 10", 1, 200)]
    [(Span(line=1, column=2, end_column=4), '200'), (Span(line=2, column=6, end_column=8), '200')]
    """
    numbers = numbers_of(text, control, settings)
    own = numbers.own.get(line)
    if own is None:
        raise ValueError(f"program line {line} has no block number")
    if isinstance(number, bool) or not isinstance(number, int) or not 0 < number <= LONG:
        raise ValueError(f"a block number is a whole number from 1 to {LONG:,}, not {number!r}")
    if number == own.number:
        return ()
    section = own.section
    if (section, number) in numbers.blocks:
        raise ValueError(f"N{number} is in program line {numbers.blocks[section, number][0].span.line} already")
    for doubt in numbers.doubts:
        if doubt.section == section and doubt.number in (None, number, own.number):
            raise ValueError(doubt.message)
    places = [own]
    for jump in numbers.jumps:
        if jump.section == section and jump.number == number:
            raise ValueError(f"program line {jump.span.line} leads to N{number} already, which is not there")
        if jump.section == section and jump.number == own.number:
            numbers.target(jump)
            places.append(jump)
    return tuple(Replacement(each.span, each.spell(number)) for each in sorted(places, key=lambda each: each.span))


def numbers_of(text: str, control: str | Dialect | None, settings: Mapping[str, str] | None) -> "Directory":
    """The block numbers of a program as its control reads it."""
    dialect = dialect_of(text, control, settings)
    return Directory(read_lines(text, dialect), dialect)


def dialect_of(text: str, control: str | Dialect | None, settings: Mapping[str, str] | None) -> Dialect | None:
    """The control of a program as `choose` finds it; None also for a program that may be for several."""
    named = named_control(control, settings)
    if named is not None:
        return configure(named, settings)
    try:
        return choose(None, parse(text), settings)
    except UnknownControlError:
        return None


class ProgramLine(Struct, frozen=True):
    """A line of a program with its end."""

    block: Block
    end: str
    is_comment: bool
    """It stands among lines that are a comment."""

    @property
    def is_read(self) -> bool:
        """Whether a control could read it: it is no comment, and not too long."""
        return not self.is_comment and all(each.kind is not FaultKind.BLOCK_TOO_LONG for each in self.block.faults)


def read_lines(text: str, dialect: Dialect | None) -> list[ProgramLine]:
    """The lines of a program as its control spells blocks; as ISO 6983 does where that is not known."""
    syntax = dialect.modes.syntax if dialect else ISO
    remember = dialect.modes.remember if dialect else None
    memory: Mapping[str, Word] = {}
    found = []
    for number, line in enumerate(split_lines(text), 1):
        bare = line.rstrip("\r\n")
        block = parse_block(bare, number, syntax)
        was = COMMENTED in memory
        memory = remember(memory, block) if remember else memory
        found.append(ProgramLine(block, line[len(bare) :], was or COMMENTED in memory))
    return found


class Number(Struct, frozen=True):
    """The digits of a block number, and the program of the file where its block is looked for."""

    span: Span
    digits: str
    section: int
    begin: int
    """The column where the word or the statement begins."""
    text: str
    """The word or the statement."""

    @property
    def number(self) -> int:
        """The number that the digits write."""
        return int(self.digits)

    def spell(self, number: int) -> str:
        """Another number, with leading zeros if this one has any."""
        return f"{number:0{len(self.digits)}}" if self.digits.startswith("0") else str(number)


class RenumberingObstacle(Struct, frozen=True):
    """An obstacle to other numbers for the blocks of a section: it concerns this number, or all (None)."""

    message: str
    section: int
    number: int | None = None


class Directory:
    """The block numbers of a program and all jumps to them. A file may hold several programs: each is a section."""

    def __init__(self, lines: Sequence[ProgramLine], dialect: Dialect | None) -> None:
        self.own: dict[int, Number] = {}
        """The numbers of blocks, by line."""
        self.blocks: dict[tuple[int, int], list[Number]] = defaultdict(list)
        """The same by section and number."""
        self.jumps: list[Number] = []
        self.doubts: list[RenumberingObstacle] = []
        self.sections: dict[int, int] = {}
        """The section of each line."""
        self._syntax = dialect.modes.syntax if dialect else ISO
        # A control of the user's own may have any of the codes.
        self._control = dialect.name if dialect and dialect.name in DIALECTS else ""
        self._rows = [row for row in WORD_JUMPS if self._syntax is ISO and self._has(row)]
        self._programs: dict[int, int] = {}
        self._calls: list[tuple[Decimal, int]] = []
        self._mains: set[int] = set()
        self._labels: set[str] = set()
        blocks = [line.block for line in lines if line.is_read]
        section = 0
        for block in blocks:
            section += self._begins(block.text, section + 1)
            self.sections[block.line] = section
            self._enter(block)
        for block in blocks:
            self._follow_text(block)
            if self._rows:
                self._follow_words(block)

    def target(self, jump: Number) -> Number:
        """The number of the block that a jump leads to. Raises ValueError unless there is just one."""
        found = self.blocks.get((jump.section, jump.number), [])
        if len(found) == 1:
            return found[0]
        lines = join([str(each.span.line) for each in found])
        where = f"which is in program lines {lines}" if found else "which is not there"
        raise ValueError(f"program line {jump.span.line}: {jump.text} leads to N{jump.number}, {where}")

    def _has(self, row: WordJump) -> bool:
        """Whether the control may have a code."""
        return not self._control or not row.controls or self._control.startswith(row.controls)

    def _begins(self, text: str, section: int) -> bool:
        """Whether a line begins a program, which is a section."""
        found = (_BEGINS_ISO if self._syntax is ISO else _BEGINS_TAPE).match(text)
        if found and found.groups():
            self._programs[int(found[1])] = section
        return found is not None

    def _enter(self, block: Block) -> None:
        """Note the number of a block, and what it shows of its program."""
        section, words = self.sections[block.line], _words(block)
        codes = {_code(word) for word in words}
        if codes & _ENDS:
            self._mains.add(section)
        if codes & _CALLS:
            self._calls += [(word.number, section) for word in words if word.address == "P" and word.number is not None]
        if self._syntax is not ISO:
            self._labels |= {each.upper() for each in _LABEL.findall(_masked(block))}
        if block.macro:
            found = _OWN_NUMBER.match(block.text)
            if found:
                self._enter_number(block, found, 0)
            return
        if codes & _PARAMETERS and "G10" in codes:
            self._doubt(block, "here N is the number of a parameter, so the blocks keep their numbers")
        # `N1O` is not N1: its end is a fault.
        faults = {each.span.column for each in block.faults}
        for word in block.words:
            is_first = word is block.words[0] and min(faults, default=word.span.column) >= word.span.column
            if word.address != "N" or word.span.end_column in faults or (self._syntax is not ISO and not is_first):
                continue
            found = _WORD.fullmatch(word.text)
            if found and is_first:
                self._enter_number(block, found, word.span.column - 1)
            else:
                reason = "is no plain block number" if is_first else "does not begin its block"
                self._doubt(block, f"{_shown(word.text)} {reason}")

    def _enter_number(self, block: Block, found: re.Match[str], offset: int) -> None:
        number = self._number(block, found, offset, self.sections[block.line])
        self.own[block.line] = number
        self.blocks[number.section, number.number].append(number)

    def _number(self, block: Block, found: re.Match[str], offset: int, section: int) -> Number:
        """The digits that a match found so many characters behind the begin of a block."""
        span = Span(block.line, offset + found.start(1) + 1, offset + found.end(1) + 1)
        return Number(span, found[1], section, offset + found.start() + 1, _shown(found[0]))

    def _follow_words(self, block: Block) -> None:
        """The jumps that words of a block make."""
        words = _words(block)
        stated, codes = {word.address for word in words}, {_code(word) for word in words}
        is_profile = stated >= _PROFILE_WORDS and stated.isdisjoint(_DRILLING_WORDS)
        for row in self._rows:
            if row.code not in codes or (row.code in _PROFILES and not is_profile):
                continue
            for word in (word for word in words if word.address in row.addresses):
                found, text = _WORD.fullmatch(word.text), f"{row.code} {_shown(word.text)}"
                if found is None:
                    self._doubt(block, f"{text} {_COMPUTES}")
                    continue
                section = self._where(row, block, words)
                if isinstance(section, str):
                    self._doubt(block, f"{text} {section}", int(found[1]))
                elif section is not None:
                    number = self._number(block, found, word.span.column - 1, section)
                    self.jumps.append(replace(number, text=text))

    def _where(self, row: WordJump, block: Block, words: Sequence[Word]) -> int | str | None:
        """The section in which a jump looks for its block: None if that is another file, or why it is not known."""
        own = self.sections[block.line]
        program = next((word for word in words if word.address == "P"), None)
        if row.where is Where.CALLER:
            return self._caller(own)
        if row.where is Where.OWN or program is None:
            return own
        if program.number is None:
            return _COMPUTES
        return next((self._programs[each] for each in _called(program.number) if each in self._programs), None)

    def _caller(self, own: int) -> int | str:
        """The section to which M99 returns."""
        if own in self._mains or self._control.startswith("haas"):
            return own
        names = {name for name, section in self._programs.items() if section == own}
        callers = {section for name, section in self._calls if not names.isdisjoint(_called(name))}
        return callers.pop() if self._control and len(callers) == 1 else _ELSEWHERE

    def _follow_text(self, block: Block) -> None:
        """The jumps that a block makes as a statement."""
        text, section = _masked(block), self.sections[block.line]
        for row in TEXT_JUMPS.get(self._syntax.name, ()):
            for statement in row.pattern.finditer(text):
                shown, names = _shown(block.text[statement.start() : statement.end()]), statement.groupdict()
                if row.reason:
                    self._doubt(block, f"{shown} {row.reason}")
                elif "targets" in names:
                    found = _NAMED.finditer(text, statement.start("targets"), statement.end("targets"))
                    numbers = [self._number(block, each, 0, section) for each in found]
                    self.jumps += [replace(each, text=shown) for each in numbers]
                else:
                    target = _TARGET.fullmatch(text, statement.start("target"), statement.end("target"))
                    if target:
                        number = self._number(block, target, 0, section)
                        self.jumps.append(replace(number, text=shown, begin=statement.start() + 1))
                    elif not self._is_label(names["target"]):
                        self._doubt(block, f"{shown} {_COMPUTES}")

    def _is_label(self, target: str) -> bool:
        """Whether a jump leads to a label, or to a main block, which keep their names."""
        return self._syntax is not ISO and (_MARK.fullmatch(target) is not None or target.upper() in self._labels)

    def _doubt(self, block: Block, reason: str, number: int | None = None) -> None:
        self.doubts.append(
            RenumberingObstacle(f"program line {block.line}: {reason}", self.sections[block.line], number)
        )


def _code(word: Word) -> str:
    """`M99` of M99 and of M099."""
    return f"{word.address}{int(word.number)}" if word.number is not None and word.number % 1 == 0 else ""


def _called(number: Decimal) -> tuple[int, int]:
    """The programs that P of a call may name."""
    return int(number), int(number) % _REPEATS


def _words(block: Block) -> Sequence[Word]:
    """The words of a block; those of a macro statement behind what makes it one, such as IF."""
    if block.macro is None:
        return block.words
    statement = block.syntax.statement.match(block.text)
    end = statement.end() if statement else 0
    return parse_block(" " * end + block.text[end:], block.line, block.syntax).words


def _masked(block: Block) -> str:
    """The text of a block without what its comments and texts say; a text may be the name of a block."""
    text = block.syntax.comment.sub(lambda comment: " " * len(comment[0]), block.text)
    return text if block.syntax is ISO else _STRING.sub(lambda each: '"' * len(each[0]), text)


def _shown(text: str) -> str:
    return text.strip()[:SHOWN]
