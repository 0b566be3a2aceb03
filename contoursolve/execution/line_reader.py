"""Reads a line by a table of statements: what each begins with, and who reads the rest of it."""

import re
from collections.abc import Callable, Iterable
from functools import cache

from msgspec import Struct

from contoursolve.execution.macro_language import (
    Assign,
    CodeLine,
    Forget,
    FormalParameter,
    MacroStatement,
    ReadAs,
    Strange,
    WordFormula,
)
from contoursolve.execution.notation import Notation, UnreadableTermError, compiled
from contoursolve.gcode import IN_BRACKETS
from contoursolve.numeric import Constant, Indexed, Quoted, Term, Variable

LONGEST_LINE = 2_000
"""Characters; no control reads more."""
_MOST_SHOWN = 40


class LineReader:
    """One line, read from the left. Comments are blanks in `text`, so that nothing in them counts."""

    def __init__(self, typed: str, form: "LineForm") -> None:
        self.text = compiled(form.comment).sub(lambda found: " " * len(found[0]), typed)
        self.notation, self.names, self._form = form.notation, form.names, form
        self.at = 0
        self.number = ""
        self.begins: str | None = None
        self.unit = ""
        self.is_part = self.saves = False
        self.labels, self.words = list[str](), list[WordFormula]()
        self.statements, self.parameters = list[MacroStatement](), list[FormalParameter]()
        self.read_as = list[ReadAs]()
        """Conditions that are read as few expect."""
        self._rest = list(typed)

    def take(self, pattern: str) -> re.Match[str] | None:
        """Take the next text, if it matches a pattern."""
        found = compiled(rf"[ \t]*+(?:{pattern})").match(self.text, self.at)
        if found is not None:
            self.at = found.end()
        return found

    def need(self, pattern: str) -> re.Match[str]:
        """Take the next text, which must match. Raises UnreadableTermError."""
        found = self.take(pattern)
        if found is None:
            raise UnreadableTermError(pattern)
        return found

    def term(self, *, is_value: bool = False) -> Term:
        """The expression that stands next."""
        # Lark takes a tenth of a second to import, and few programs have expressions.
        from contoursolve.execution.term_reader import read_term  # noqa: PLC0415

        begin = self.at
        found, self.at = read_term(self.notation, self.text, begin, is_value=is_value)
        if self.notation.compares_last and _compares_beside(self.text[begin : self.at]):
            from contoursolve.execution.term_writer import write_in_full  # noqa: PLC0415 - few conditions need it

            meant = write_in_full(found, self.notation.name.lower())
            self.read_as.append(ReadAs(f"{self.text[begin : self.at].strip()} is read as {meant}"))
        return found

    def target(self) -> Term | str:
        """The name or the number of what is called, or the expression that is it: a text in quotes is a name."""
        found = self.take(r"(\d++)(?![.\w])")
        if found is not None:
            return number_of(found[1])
        term = self.term(is_value=True)
        return term.value.upper() if isinstance(term, Quoted) else term

    def word(self, *, is_value: bool = True) -> None:
        """The value of a word, if it is an expression; what cannot be read is left to the reader of words."""
        self.take("")
        begin = self.at
        try:
            term = self.term(is_value=is_value)
        except UnreadableTermError:
            self.take(r"[^ \t]++")
            return
        if not isinstance(term, Quoted) and not _PLAIN.fullmatch(self.text, begin, self.at):
            self.words.append(WordFormula(begin, self.at, term))

    def assignment(self) -> MacroStatement:
        """A variable, an equals sign and a value; the variable is not known where the value cannot be read."""
        self.take("")
        begin, variable = self.at, self.term(is_value=True)
        self.need("=")
        if not isinstance(variable, Variable | Indexed):
            raise UnreadableTermError
        try:
            value = self.term()
            self.need(f"(?={self._form.behind_value}|$)")
        except UnreadableTermError:
            self.at = len(self.text)
            return Forget(variable, strange(self.text[begin:]).reason)
        return Assign(variable, value)

    def hide(self, begin: int, end: int) -> None:
        """Blanks in the place of what stands there, comments apart."""
        for place in range(begin, end):
            if self.text[place] != " ":
                self._rest[place] = " "

    def keeps(self, begin: int) -> bool:
        """Whether anything but comments is left of the line from a place on."""
        return any(
            kept.strip() and typed.strip() for kept, typed in zip(self._rest[begin:], self.text[begin:], strict=True)
        )

    def read_statements(self) -> list[MacroStatement]:
        """The statements up to the end of the line."""
        found, form = list[MacroStatement](), self._form
        while True:
            table = form.table if found else (_O_WORD, *form.table)
            skipped = form.up_to_statement(is_first=not found).match(self.text, self.at)
            begin = self.at = skipped.end() if skipped is not None else len(self.text)
            if begin == len(self.text):
                return found
            for spelling in table:
                match = compiled(spelling.pattern).match(self.text, begin)
                if match is None:
                    continue
                self.at, stays = match.end(), spelling.stays
                try:
                    said = [*spelling.read(self, match)]
                except UnreadableTermError:
                    said, self.at, stays = [strange(self.text[begin:])], len(self.text), False
                if said and not stays:
                    self.hide(begin, self.at)
                found += [*self.read_as, *said]
                self.read_as = []
                break
            if self.at == begin:
                token = compiled(form.skip).match(self.text, begin)
                self.at = token.end() if token else begin + 1

    def code(self) -> CodeLine:
        """The line as it was read."""
        words = sorted(self.words, key=lambda word: word.begin)
        return CodeLine(
            "".join(self._rest),
            self.number,
            tuple(self.labels),
            self.begins,
            self.is_part,
            tuple(self.statements),
            tuple(words),
            tuple(self.parameters),
            self.saves,
            self.unit,
        )


def _compares_beside(text: str) -> bool:
    """Whether a comparison stands beside AND, OR or XOR, in no brackets of its own."""
    if not _ABOVE_COMPARISONS.search(text):
        return False
    flat = text
    while (shorter := _INNERMOST.sub(" ", flat)) != flat:
        if any(_is_mixed(each) for each in _INNERMOST.findall(flat)):
            return True
        flat = shorter
    return _is_mixed(flat)


def _is_mixed(text: str) -> bool:
    return _COMPARES.search(text) is not None and _ABOVE_COMPARISONS.search(text) is not None


_INNERMOST = re.compile(r"\([^()]*+\)|\"[^\"]*+\"")
_COMPARES = re.compile(r"==|<>|[<>]=?")
_ABOVE_COMPARISONS = re.compile(r"(?<![\w$])X?(?:AND|OR)(?![\w$])", re.IGNORECASE)
_GROUP = re.compile(r"\(\?P<\w+>")
_PLAIN = re.compile(r"[ \t]*+[+-]?+[ \t]*+[\d.,]++")


def strange(text: str) -> Strange:
    """The statement that cannot be read."""
    shown = " ".join(text.split())
    return Strange(f"{shown if len(shown) <= _MOST_SHOWN else shown[:_MOST_SHOWN] + '...'} cannot be read")


_O_WORDS = "SUB|ENDSUB|CALL|RETURN|IF|ELSEIF|ELSE|ENDIF|DO|WHILE|ENDWHILE|REPEAT|ENDREPEAT|BREAK|CONTINUE"
_OF_MACRO_B = r"(?!.*(?:GOTO|THEN|DO[ \t]*+\d))"
O_WORD = rf"O[ \t]*+(?>(?:\d++|<[^<>]*+>|#\d++|{IN_BRACKETS}))[ \t]*+(?:{_O_WORDS})(?![A-Z]){_OF_MACRO_B}"
"""An O word of LinuxCNC: a number or a name, and what the program does there; behind the number of a program there may
be an IF of Macro B, which jumps or says THEN."""


def o_word(line: "LineReader", found: re.Match[str]) -> Iterable[MacroStatement]:
    """The statement of an O word of LinuxCNC, which no supported control reads."""
    line.at = len(line.text)
    name = " ".join(found[0].split())
    yield Strange(f"contoursolve does not follow {name}: that is how LinuxCNC calls and branches", name)


class Spelling(Struct, frozen=True):
    """A statement: what it begins with, and what reads the rest of it. `stays` if its words stay in the line."""

    pattern: str
    read: Callable[[LineReader, re.Match[str]], Iterable[MacroStatement]]
    stays: bool = False


def number_of(text: str) -> str:
    """A number as jumps name it."""
    return text.lstrip("0") or "0"


_O_WORD = Spelling(rf"(?<![^\s/\d]){O_WORD}", o_word)


def _has_o_word(text: str) -> bool:
    """Whether an O word may stand in a line."""
    return compiled(O_WORD).search(text) is not None


class LineForm(Struct, frozen=True, eq=False):
    """Form of the lines of a language: their beginnings, comments and statements."""

    notation: Notation
    head: str
    """Pattern of the beginning of a line: groups `number` and `program`, and `part` for a subprogram."""
    comment: str
    table: tuple[Spelling, ...]
    skip: str
    """Pattern of words, names and signs that are no statement, one at a time."""
    behind_value: str
    """Pattern of text that may follow the value of a variable, besides the end of the line."""
    says: str
    """Pattern of text that may be a statement."""
    names: frozenset[str] = frozenset()
    """Names that call no subprogram."""

    @cache  # noqa: B019 - there are few forms, and they stay
    def up_to_statement(self, *, is_first: bool) -> re.Pattern[str]:
        """A pattern of what stands before the first statement of a line, or the next one, or the end of the line."""
        begins = "|".join(rf"(?:{_GROUP.sub('(?:', each.pattern)})" for each in (_O_WORD, *self.table)[not is_first :])
        return compiled(rf"(?>(?:(?!{begins})(?>{self.skip}|.))*)")

    def may_say(self, line: str) -> bool:
        text = line if ";" not in line else line.partition(";")[0]
        return compiled(self.says).search(text) is not None or (("O" in text or "o" in text) and _has_o_word(text))

    def read(self, line: str) -> CodeLine:
        """Read the statements of a line. Never raises."""
        head = compiled(self.head).match(line)
        number = number_of(head["number"]) if head and head["number"] else ""
        if not self.may_say(line):
            return CodeLine(line, number)
        reader = LineReader(line, self)
        if len(reader.text.rstrip()) > LONGEST_LINE:
            return CodeLine(line, number, statements=(Strange(f"a line of {len(line):,} characters"),))
        reader.number, reader.at = number, head.end() if head else 0
        groups = head.groupdict() if head else {}
        if program := groups.get("program"):
            reader.begins, reader.is_part = number_of(program).upper(), bool(groups.get("part"))
        reader.statements = reader.read_statements()
        return reader.code()


def nothing(_: LineReader, __: re.Match[str]) -> Iterable[MacroStatement]:
    """No statement."""
    return ()


ONE = Constant(1.0)
PROGRAM_END = r"(?<![A-Z])M0*+(?:2|30)(?![\d.]|[ \t]*+=)"


def word(line: LineReader, _: re.Match[str]) -> Iterable[MacroStatement]:
    """The value of a word."""
    line.word()
    return ()
