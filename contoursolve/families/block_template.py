"""Template of a block with free words, and how it is read: plain data, from which any process makes the same."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace as replace_fields
from decimal import Decimal, InvalidOperation
from enum import Enum
from typing import Any, Literal

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve import gcode
from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import Answer, Depth, fact_key, fact_subject, join, named_in_program, typed_text, with_value
from contoursolve.diagnostics import Diagnostic
from contoursolve.families.errors import FamilyError
from contoursolve.families.word_values import START, name_of
from contoursolve.gcode import FACT, Directive, Program, Word, call, words_called
from contoursolve.program import (
    Request,
    Result,
    SolveOptions,
    StartKeywords,
    UnknownControlError,
    choose,
    run,
    start_text,
)
from contoursolve.reading import Control, ReadIssue
from contoursolve.solving import Point


def errors_of(found: Answer | Result) -> list[Diagnostic]:
    """The errors among the findings."""
    return [each for each in found.diagnostics if each.is_error]


def first_error(found: Answer | Result) -> str:
    """The message of the first error; empty without one."""
    error = next(iter(errors_of(found)), None)
    return "" if error is None else message_of(error, found)


def message_of(error: Diagnostic, found: Answer | Result) -> str:
    """The message of an error, which names the parts of a contour by what stands in the program."""
    if not isinstance(found, Answer):
        return error.message
    return named_in_program((error,), found.claim, found.profile)[0].message


def first_message(found: Answer | Result) -> str:
    """The message of the first finding; empty without one."""
    return next((each.message for each in found.diagnostics), "")


def _example(answers: Sequence[Answer]) -> str:
    """Advice that names one of several contours: by a word of the last one, with its line."""
    blocks = (block for answer in reversed(answers) for block in answer.claim.blocks)
    word = next((word for block in blocks for word in block.words if word.address not in _NEVER), None)
    return f": name a word of it with its line, such as {word.span.line}:{word.address}" if word is not None else ""


class RefusedError(FamilyError):
    """A block that is refused whatever the values of its free words, or with those of a row (`where`) although not as
    it stands. The message has the first error and what to do; `result` is what `solve` says of it."""

    def __init__(self, result: Result, where: str = "") -> None:
        self.result = result
        error = errors_of(result)[0]
        remedy = error.fixes[0].description if error.fixes else error.help
        told = f"{error.message}; {remedy}" if remedy else error.message
        super().__init__(f"with {where}: {told}" if where else told)


_KEPT = 8
"""Answers that a template keeps; more than a family with few classes asks for."""


class Template(Struct, frozen=True, eq=False):
    """A program with one contour, or one of whose contours has the free words; how it is read, and its free words by
    the names that the user gave them: words of its blocks, words of the start point, and facts whose value is free."""

    program: Program
    asked: Request
    words: Mapping[str, Word] = {}
    variables: Mapping[str, tuple[int, int]] = {}
    """Variables that stand for a word: by their names, the line and the column of its value."""
    readings: dict[tuple[float | None, ...], Any] = field(default_factory=dict)
    """Rows that were read by themselves, until they are asked for again (see `traced_reading.read_alone`)."""
    ends: dict[int, Point | None] = field(default_factory=dict)
    """The ends of contours that no free word moves, by their first lines (see `end_of`)."""
    answers: dict[str, Answer] = field(default_factory=dict)
    """The last few answers of single solves, by the values of their words."""

    def with_words(self, names: Sequence[str]) -> "Template":
        """The same block with the words of these names free. Raises FamilyError as `find_words`."""
        return replace(self, words=find_words(self, names), answers={})

    def solve(self, values: Mapping[str, float]) -> Answer:
        """The answer of a single solve. Raises FamilyError where there is no single contour with a known start."""
        key = repr(dict(values))
        found = self.answers.get(key)
        if found is None:
            found = self._solved(values)
            if len(self.answers) >= _KEPT:
                self.answers.clear()
            self.answers[key] = found
        return found

    def _solved(self, values: Mapping[str, float]) -> Answer:
        result = self.filled(values).examined(Depth.VERDICT)
        if not result.answers and result.has_errors:
            raise self.refused(values)
        answer = self.one_of(result)
        if not answer.start.is_known or answer.start.is_relative:
            if any(not each.span.line for each in errors_of(result)):
                raise self.refused(values)
            raise FamilyError('the start point is not known; state it as the start, such as "X40. Z0."')
        return answer

    def one_of(self, result: Result) -> Answer:
        """The only contour of a result, or that of several which the free words are in. Raises FamilyError."""
        answers = result.answers
        if len(answers) > 1:
            lines = {word.span.line for word in self.words.values()}
            answers = tuple(each for each in answers if not lines.isdisjoint(each.lines))
        if len(answers) == 1:
            return answers[0]
        if not result.answers:
            told = first_message(result) or "the block has 0 contours; a family is about one"
        elif answers:
            told = f"{join(list(self.words))} are in {len(answers)} contours; a family is about one"
        else:
            lines_of = ", ".join(str(each.lines[0]) for each in result.answers)
            told = (
                f"the block has {len(result.answers)} contours (program lines {lines_of}); a family is about one"
                f"{_example(result.answers)}"
            )
        raise FamilyError(told)

    def end_of(self, line: int) -> Point | None:
        """The end of the contour that begins at a line, behind which the free words stand; None without one."""
        if not self.ends:
            for answer in self.examined(Depth.VERDICT).answers:
                self.ends[answer.lines[0]] = answer.contour.end if answer.contour is not None else None
        return self.ends.get(line)

    def refused(self, values: Mapping[str, float]) -> RefusedError:
        """The error that the block is refused: as it stands, or if it is not, with these values, which refuse it."""
        as_it_stands = self.examined()
        if errors_of(as_it_stands):
            return RefusedError(as_it_stands)
        told = ", ".join(f"{called(name)} {value:g}" for name, value in values.items())
        return RefusedError(self.filled(values).examined(), told)

    def examined(self, depth: Depth = Depth.FULL) -> Result:
        """All that `solve` says of the block as it stands, with every repair."""
        return run(self.program, replace(self.asked, depth=depth))

    def filled(self, values: Mapping[str, float]) -> "Template":
        """The block with these values written in it, and no word free."""
        if unknown := values.keys() - self.words.keys():
            raise KeyError(f"{', '.join(unknown)}: the free words are {', '.join(self.words)}")
        words, spelling = self.words.items(), self.program.syntax.words
        texts = {name: with_value(word, typed_text(values[name]), spelling) for name, word in words if name in values}
        return self.typed(texts)

    def typed(self, texts: Mapping[str, str]) -> "Template":
        """The block with these texts in place of free words, and no word free."""
        program = gcode.parse("\n".join(self.lines(self.program, texts)), self.program.name, syntax=self.program.syntax)
        start = self.asked.start
        if start is not None:
            start = gcode.parse("\n".join(self.lines(start, texts)), start.name, 0, start.syntax)
        free = {self.words[name].span.line: text for name, text in texts.items()}
        lines = ((each, each.span.line) for each in self.asked.facts)
        facts = tuple(gcode.read_directive(free[line], line) if line in free else each for each, line in lines)
        return replace(self, program=program, asked=replace(self.asked, start=start, facts=facts), words={}, answers={})

    def lines(self, program: Program, texts: Mapping[str, str]) -> list[str]:
        """The lines of the block, or of the start, with these texts in place of free words."""
        lines = {block.line: block.text for block in program.blocks}
        free = [(word.span, texts[name]) for name, word in self.words.items() if name in texts]
        # From the right, so that the columns of the others stay true.
        for span, text in sorted(free, reverse=True):
            if span.line in lines:
                line = lines[span.line]
                lines[span.line] = line[: span.column - 1] + text + line[span.end_column - 1 :]
        return list(lines.values())


def find_words(template: Template, names: Sequence[str]) -> dict[str, Word]:
    """The words of some names, by the names under which they are printed (see `read_word`). Raises FamilyError if one
    does not say which, or two name one."""
    read = [read_word(name, template) for name in names]
    if len({word.span for _, word in read}) < len(read):
        raise FamilyError(f"{' and '.join(names)} name a word twice")
    return dict(read)


def read_word(name: str, template: Template) -> tuple[str, Word]:
    """A word by its name, with the name under which it is printed: `A`, `,A`, `2:,A` (of line 2), a variable,
    `start X`, or `length of line 1` (of a fact, what it gives the value of). Raises FamilyError, which names those that
    fit."""
    text, program, start = name_of(name), template.program, template.asked.start
    words = _words_of(program)
    head, blank, axis = text.partition(" ")
    if text in template.variables:
        return text, _at(template.variables[text], words)
    if blank and head == START:
        return text, _only(axis, _words_of(start) if start is not None else [], "the start point", "")
    facts = (*template.asked.facts, *(each for block in program.blocks for each in block.directives))
    stated = {fact_key(each.text): each for each in facts if "=" in each.text}
    if fact_key(text) in stated or blank:
        fact = stated.get(fact_key(text))
        return fact_subject(fact.text if fact is not None else text), _fact_of(text, stated)
    line = text.rpartition(":")[0]
    if line and not line.isdecimal():
        told = "; N names a block, LINE is the line of the program, from 1" if line.startswith("N") else ""
        raise FamilyError(f"{name} names no word; write its letter, or LINE:LETTER such as 2:,A{told}")
    word = _only(text, words, "the block", line)
    return call(word, words), word


def word_named(name: str, template: Template) -> str | None:
    """The free word of a name, as it is printed; None for a word that is not free. Raises FamilyError for none."""
    span = read_word(name, template)[1].span
    return next((own for own, word in template.words.items() if word.span == span), None)


def _at(place: tuple[int, int], words: Iterable[Word]) -> Word:
    """The word that is at a line and a column."""
    line, column = place
    return next(each for each in words if each.span.line == line and each.span.column <= column < each.span.end_column)


def _words_of(program: Program) -> list[Word]:
    return [word for block in program.blocks for word in block.words if word.address not in _NEVER]


def _only(name: str, words: Sequence[Word], where: str, line: str) -> Word:
    same, address = words_called(name, words), name.rpartition(":")[2]
    if len(same) != 1:
        have = ", ".join(call(word, words) for word in words)
        if len({word.span.line for word in same}) == len(same) > 1:
            which = " or ".join(call(word, words) for word in same)
            raise FamilyError(f"{where} has {len(same)} words {address}; write {which}")
        beside = [each for each in words if each.address == f",{address}"]
        if not same and len(beside) == 1:
            raise FamilyError(f"{where} has no word {address}; write {call(beside[0], words)}")
        told = f"{len(same)} words {address}" if same else f"no word {address}"
        raise FamilyError(
            f"{where} has {told}{f' in program line {line}' if line else ''}; its words are {have or 'none'}"
        )
    if same[0].number is None:
        raise FamilyError(f"{same[0].text} has no number to vary")
    return same[0]


def _fact_of(name: str, stated: Mapping[str, Directive]) -> Word:
    """A fact whose value is a number, as a word with that number."""
    fact = stated.get(fact_key(name))
    if fact is None:
        have = ", ".join(fact_subject(each.text) for each in stated.values())
        raise FamilyError(f"no fact says what {name} is; there are {have or 'none'}")
    text = fact.text.partition("=")[2].strip()
    try:
        number = Decimal(text)
    except InvalidOperation:
        raise FamilyError(f"{fact.text}: {text} is no number that could vary") from None
    return Word(FACT, number, "." in text, fact.text, fact.span)


def is_same(typed: Word, other: Word) -> bool:
    """Whether a word, wherever it now stands in its line, is the free word that was typed."""
    is_alike = (typed.span.line, typed.address) == (other.span.line, other.address)
    return is_alike and (typed.address != FACT or fact_key(typed.text) == fact_key(other.text))


def unit_word(word: Word, *, has_point: bool) -> Word:
    """The word with the number 1."""
    return replace(word, number=Decimal(1), has_point=has_point)


_NEVER = ("G", "N", "M")
"""Addresses that say what the other words mean."""


def called(word: str) -> str:
    """The name of a word in a sentence."""
    line, _, address = word.rpartition(":")
    return f"{address} of program line {line}" if line else address


BranchesName = Literal["chosen", "all"]
"""The values of `Branches`, as users write them."""


class Branches(Enum):
    """The solutions that a family has of each row."""

    CHOSEN = "chosen"
    """The one that the words choose; none where they choose none."""
    ALL = "all"
    """All of them, in a dimension of their own."""


class SweepSpec(Struct, frozen=True):
    """A block, the names of its free words, and how it is read: the arguments of `family`, but for the values."""

    block: str
    names: tuple[str, ...]
    start: str | None
    control: str | Control | None
    facts: tuple[str, ...]
    units: str
    rules: str
    settings: tuple[tuple[str, str], ...]
    variables: tuple[tuple[str, float], ...] = ()
    branches: Branches = Branches.CHOSEN

    def template(self) -> Template:
        """The block with its free words. Raises FamilyError for a word that is not there, UnknownControlError,
        SettingError, and ValueError for units or rules that are none of their choices."""
        for name, text in (("block", self.block), ("start", self.start or "")):
            if not isinstance(text, str):
                raise TypeError(f"the {name} is a text (str), not {type(text).__name__}")
        program = gcode.parse(self.block, "<block>")
        control = choose(self.control, program, dict(self.settings))
        if control is not None and self.branches is Branches.ALL:
            control = replace_fields(control, rules=tuple(each for each in control.rules if not each.is_about_choice))
        told = SolveOptions(start=self.start, units=self.units, rules=self.rules, facts=self.facts, strict=True)
        asked = told.request(program.name, control)
        if control is None:
            unread = run(program, replace(asked, facts=()))
            if any(each.about is not ReadIssue.NO_CONTOUR for each in errors_of(unread)):
                raise RefusedError(unread)
            raise UnknownControlError(f"the block does not show its control: {' or '.join(CONTROLS)}")
        program = gcode.spelled(program, control.modes.syntax)
        from contoursolve.families.variables import numbered  # noqa: PLC0415 - it raises errors of this module

        program, places = numbered(program, control.modes.language, dict(self.variables), self.names)
        return Template(program, asked, variables=places).with_words(self.names)


class BlockOptions(StartKeywords, total=False):
    """Options of every question about a block: how it is read (see `family`)."""

    facts: Iterable[str]


def spec_of(  # noqa: PLR0913 - what `family` takes
    block: str,
    names: Iterable[str] = (),
    *,
    start: str | Mapping[str, float] | None = None,
    control: str | Control | None = None,
    facts: Iterable[str] = (),
    units: str = "mm",
    rules: str = "enforce",
    settings: Mapping[str, str] | None = None,
    variables: Mapping[str, float] | None = None,
    branches: Branches = Branches.CHOSEN,
) -> SweepSpec:
    """The spec of a block with the words of these names free; a text alone is one fact."""
    # What `solve` says of these, before they are sorted.
    SolveOptions(start=start, facts=facts, settings=settings, variables=variables).check_types()
    stated = (facts,) if isinstance(facts, str) else tuple(facts)
    options = tuple(sorted((settings or {}).items()))
    known = tuple((name.strip().upper(), float(value)) for name, value in (variables or {}).items())
    names = tuple(map(name_of, names))
    return SweepSpec(block, names, start_text(start), control, stated, units, rules, options, known, branches)
