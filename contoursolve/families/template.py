"""A block with free words: its text, and what a single solve makes of it with any values filled in."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal, InvalidOperation

from contoursolve import syntax
from contoursolve.diagnostic import Severity
from contoursolve.dialects import Dialect
from contoursolve.examine import Answer, Depth, Policy
from contoursolve.families.ranges import START, FamilyError
from contoursolve.model import Length
from contoursolve.pipeline import Result, run
from contoursolve.syntax import FACT, Directive, Program, Word


class RefusedError(FamilyError):
    """A block that is refused whatever the values of its free words. The message has the first error and what to do;
    `result` is what `solve` says of the block as it stands."""

    def __init__(self, result: Result) -> None:
        self.result = result
        error = next(each for each in result.diagnostics if each.severity is Severity.ERROR)
        remedy = error.fixes[0].description if error.fixes else error.help
        super().__init__(f"{error.message}; {remedy}" if remedy else error.message)


@dataclass(frozen=True, slots=True, eq=False)
class Template:
    """A program with one contour, how it is read, and its free words by the names that the user gave them: words of its
    blocks, words of the start point, and facts whose value is free."""

    program: Program
    dialect: Dialect
    unit: Length
    policy: Policy
    start: Program | None
    words: Mapping[str, Word]
    facts: tuple[Directive, ...] = ()

    def solve(self, values: Mapping[str, float]) -> Answer:
        """What a single solve says. Raises FamilyError where the blocks are no single contour with a known start."""
        program = self._fill(self.program, values, 1)
        start = self._fill(self.start, values, 0) if self.start is not None else None
        result = run(program, self.dialect, self.unit, self.policy, Depth.VERDICT, start, self._facts(values))
        if len(result.answers) != 1:
            if not result.answers and result.has_errors:
                raise RefusedError(self.examined())
            reasons = [each.message for each in result.diagnostics]
            told = f"the block has {len(result.answers)} contours; a family is about one"
            raise FamilyError(reasons[0] if reasons and not result.answers else told)
        answer = result.answers[0]
        if not answer.start.is_known:
            if any(each.severity is Severity.ERROR and not each.span.line for each in result.diagnostics):
                raise RefusedError(self.examined())
            raise FamilyError('the start point is not known; state it as the start, such as "X40. Z0."')
        return answer

    def examined(self) -> Result:
        """All that `solve` says of the block as it stands, with every repair."""
        return run(self.program, self.dialect, self.unit, self.policy, Depth.FULL, self.start, self.facts)

    def texts(self, values: Mapping[str, float]) -> Iterator[str]:
        """The lines of the block with these values, and the facts that are stated apart from it."""
        yield from (block.text for block in self._fill(self.program, values, 1).blocks)
        yield from (each.text for each in self._facts(values))

    def filled(self, values: Mapping[str, float]) -> "Template":
        """The block with these values written in it, and no word free."""
        program = self._fill(self.program, values, 1)
        start = self._fill(self.start, values, 0) if self.start is not None else None
        return replace(self, program=program, start=start, words={}, facts=tuple(self._facts(values)))

    def _fill(self, program: Program, values: Mapping[str, float], first_line: int) -> Program:
        """A program with these values in place of the free words'."""
        lines = {block.line: block.text for block in program.blocks}
        free = [(name, word) for name, word in self.words.items() if word.span.line in lines and name in values]
        # From the right, so that the columns of the others stay true.
        for name, word in sorted(free, key=lambda item: item[1].span, reverse=True):
            line, span = lines[word.span.line], word.span
            typed = _stating(word, values[name]) if word.address == FACT else word.address + write(values[name])
            lines[span.line] = line[: span.column - 1] + typed + line[span.end_column - 1 :]
        return syntax.parse("\n".join(lines.values()), program.name, first_line)

    def _facts(self, values: Mapping[str, float]) -> list[Directive]:
        free = {word.span.line: _stating(word, values[name]) for name, word in self.words.items() if name in values}
        lines = ((each, each.span.line) for each in self.facts)
        return [syntax.read_directive(free[line], line) if line in free else each for each, line in lines]


def write(value: float) -> str:
    """A number as a word has it: with a point, without an exponent, and all its digits."""
    text = format(Decimal(repr(float(value))), "f")
    return text if "." in text else f"{text}."


def find_words(template: Template, names: Sequence[str]) -> dict[str, Word]:
    """The words that names such as `A`, `,A`, `2:,A` (of line 2), `start.X` or `length of line 1` (a fact) speak of.
    Raises FamilyError if one does not say which."""
    found: dict[str, Word] = {}
    program, start, facts = template.program, template.start, template.facts
    words = _words_of(program)
    stated = {
        _subject(each.text): each
        for each in (*facts, *(each for block in program.blocks for each in block.directives))
        if "=" in each.text
    }
    for name in names:
        head, _, address = name.rpartition(".")
        if " " in name:
            found[name] = _fact_of(name, stated)
            continue
        if head == START:
            found[name] = _only(address, _words_of(start) if start is not None else [], "the start point", "")
        else:
            line, _, address = name.rpartition(":")
            if line and not line.isdigit():
                raise FamilyError(f"{name} names no word; write its letter, or LINE:LETTER such as 2:,A")
            found[name] = _only(address, words, "the block", line)
    if len({word.span for word in found.values()}) < len(found):
        raise FamilyError(f"{' and '.join(found)} name a word twice")
    return found


def _words_of(program: Program) -> list[Word]:
    return [word for block in program.blocks for word in block.words if word.address not in _NEVER]


def _only(address: str, words: Sequence[Word], where: str, line: str) -> Word:
    same = [word for word in words if word.address == address and (not line or word.span.line == int(line))]
    if len(same) != 1:
        have = ", ".join(call(word, words) for word in words)
        if len({word.span.line for word in same}) == len(same) > 1:
            which = " or ".join(call(word, words) for word in same)
            raise FamilyError(f"{where} has {len(same)} words {address}; write {which}")
        told = f"{len(same)} words {address}" if same else f"no word {address}"
        raise FamilyError(f"{where} has {told}{f' in line {line}' if line else ''}; its words are {have or 'none'}")
    if same[0].number is None:
        raise FamilyError(f"{same[0].text} has no number to vary")
    return same[0]


def _fact_of(name: str, stated: Mapping[str, Directive]) -> Word:
    """A fact whose value is a number, as a word with that number."""
    fact = stated.get(_subject(name))
    if fact is None:
        raise FamilyError(f"no fact says what {name} is; there are {', '.join(stated) or 'none'}")
    text = fact.text.partition("=")[2].strip()
    try:
        number = Decimal(text)
    except InvalidOperation:
        raise FamilyError(f"{fact.text}: {text} is no number that could vary") from None
    return Word(FACT, number, "." in text, fact.text, fact.span)


def _subject(text: str) -> str:
    """What a fact gives the value of, however it is spaced."""
    return " ".join(text.partition("=")[0].split()).lower()


def is_same(typed: Word, other: Word) -> bool:
    """Whether a word, wherever it now stands in its line, is the free word that was typed."""
    is_alike = (typed.span.line, typed.address) == (other.span.line, other.address)
    return is_alike and (typed.address != FACT or _subject(typed.text) == _subject(other.text))


def unit_word(word: Word, *, has_point: bool) -> Word:
    """The word with the number 1."""
    return replace(word, number=Decimal(1), has_point=has_point)


def _stating(word: Word, value: float) -> str:
    return re.sub(r"=.*", f"= {write(value)}", word.text)


_NEVER = ("G", "N", "M")
"""What says what the other words mean."""


def call(word: Word, words: Sequence[Word]) -> str:
    """The name of a word among all: its letter, with its line where several have it."""
    is_alone = sum(each.address == word.address for each in words) == 1
    return word.address if is_alone else f"{word.span.line}:{word.address}"
