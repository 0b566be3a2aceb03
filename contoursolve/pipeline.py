"""The order of the stages: from the text of a program to its contours and findings."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, cast

from contoursolve.diagnostic import Basis, Diagnostic, Severity
from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.examine import Answer, Depth, Policy, examine, rank
from contoursolve.explain import Context, report
from contoursolve.model import Length, Plane
from contoursolve.reading import Claim, State, Trouble, advance, leave, next_place
from contoursolve.source import Span
from contoursolve.spelling import (
    explain_asked_outside,
    explain_fault,
    explain_start_units,
    explain_unmarked,
    explain_words,
)
from contoursolve.syntax import Block, Directive, FaultKind, Program, Word

if TYPE_CHECKING:
    from contoursolve.statements import Statement


@dataclass(frozen=True, slots=True)
class Result:
    """All contours and findings of a program; `control` is None where there was nothing to tell it by."""

    program: Program
    control: str | None
    answers: tuple[Answer, ...]
    diagnostics: tuple[Diagnostic, ...]
    start: Program | None = None
    """What stated the start point apart from the program; its line is line 0."""
    facts: tuple[Directive, ...] = ()
    """What was stated apart from the program; their lines are -1, -2, ..."""
    settings: Mapping[str, str] = field(default_factory=dict)
    """The settings of the control that are not the default ones, by name."""
    policy: Policy = Policy.ENFORCE

    @property
    def has_errors(self) -> bool:
        """Whether any finding is an error."""
        return any(each.severity is Severity.ERROR for each in self.diagnostics)

    def place(self, span: Span) -> Span:
        """The place itself, or for a fact stated apart from the program the block that it is about."""
        if span.line >= 0:
            return span
        lines = [answer.lines[-1] for answer in self.answers]
        blocks = [block for block in self.program.blocks if block.words or block.line in lines]
        block = next((block for block in blocks if block.line in lines), blocks[-1] if blocks else None)
        return block.span if block else Span(1, 1, 2)


class UnknownControlError(ValueError):
    """The program does not tell which control it is for; the message lists the choices."""


class FactPlaceError(ValueError):
    """Facts were stated apart from a program with several contours; the message says what to do."""


def _attach(
    program: Program, dialect: Dialect, unit: Length, start: Program | None, facts: Sequence[Directive]
) -> tuple[Program, tuple[Directive, ...]]:
    """The program with further facts in the last block of its only contour, or else of its last block; and the facts,
    those that are no texts in words."""
    answers = list(_Examiner(program, dialect, unit, Policy.OFF, Depth.VERDICT).walk(start))
    if len(answers) > 1:
        lines = ", ".join(str(answer.lines[0]) for answer in answers)
        raise FactPlaceError(
            f"the program has {len(answers)} contours (lines {lines}); write the fact into the block that it is about, "
            "as a comment (contoursolve: ...)"
        )
    before = dialect.initial_state(unit)
    plane, length = (answers[0].plane, answers[0].unit) if answers else (before.plane, before.unit)
    worded = tuple(_in_words(fact, plane, length) for fact in facts)
    lines_with_words = [block.line for block in program.blocks if block.words]
    last = answers[0].lines[-1] if answers else max(lines_with_words, default=0)
    blocks = tuple(
        replace(block, directives=(*block.directives, *worded)) if block.line == last else block
        for block in program.blocks
    )
    return replace(program, blocks=blocks), worded


def _in_words(fact: Directive, plane: Plane, unit: Length) -> Directive:
    """A fact with the text that states it."""
    if fact.statement is None:
        return fact
    from contoursolve.statements import write_statement  # noqa: PLC0415 - few programs need it

    text = write_statement(cast("Statement", fact.statement), plane, unit)
    return replace(fact, text=text, span=Span(fact.span.line, 1, len(text) + 1))


def recognise(program: Program) -> Dialect | None:
    """The control that a program is written for; None if no block shows it.

    Raises UnknownControlError if its blocks show more than one.
    """
    signs = {name: block.line for name, dialect in DIALECTS.items() for block in program.blocks if dialect.signs(block)}
    if len(signs) > 1:
        places = ", ".join(f"{name} by line {line}" for name, line in signs.items())
        raise UnknownControlError(f"the program looks like more than one control ({places})")
    return DIALECTS[next(iter(signs))] if signs else None


def run(
    program: Program,
    dialect: Dialect | None,
    unit: Length,
    policy: Policy,
    depth: Depth = Depth.FULL,
    start: Program | None = None,
    facts: Sequence[Directive] = (),
) -> Result:
    """Examine every block of a program and solve every contour.

    `start` is a block that states the start point apart from the program, `facts` are further facts about its
    only contour; raises FactPlaceError if it has several. Without a dialect only the characters of the program are
    examined.
    """
    if facts and dialect is not None:
        program, facts = _attach(program, dialect, unit, start, facts)
    examiner = _Examiner(program, dialect, unit, policy, depth)
    answers = list(examiner.walk(start))
    if not answers and not any(each.severity is Severity.ERROR for each in examiner.diagnostics):
        examiner.nothing_to_solve()
    everything = [*examiner.diagnostics, *(each for answer in answers for each in answer.diagnostics)]
    everything.sort(key=rank)
    control, settings = (dialect.name, dialect.modes.settings) if dialect else (None, {})
    return Result(program, control, tuple(answers), tuple(everything), start, tuple(facts), settings, policy)


_FAULTS_OF_NO_CONSEQUENCE = (FaultKind.STRAY_CHARACTER,)
"""Faults that are only worth a warning in a block that is not a contour."""


class _Examiner:
    """One pass over one program: the modal state as it goes, and the findings outside contours."""

    def __init__(self, program: Program, dialect: Dialect | None, unit: Length, policy: Policy, depth: Depth) -> None:
        self.program = program
        self.dialect = dialect
        self.unit = unit
        self.policy = policy
        self.depth = depth
        self.rules = dialect.rules if dialect else DIALECTS["yasnac-lx3"].rules
        self.diagnostics: list[Diagnostic] = []

    def walk(self, start: Program | None) -> Iterator[Answer]:
        """The answer to every contour, in order."""
        if self.dialect is None:
            for block in self.program.blocks:
                self._check_block(block)
            return
        dialect, blocks = self.dialect, self.program.blocks
        state = dialect.initial_state(self.unit)
        for block in start.blocks if start else ():
            self._check_block(block)
            state = advance(state, block, dialect.modes)
        start_unit = state.unit
        index = 0
        while index < len(blocks):
            block = blocks[index]
            found = dialect.find(blocks, index, state, dialect.modes)
            if found is not None:
                answer = self._examine(found, index, state)
                if start and found.after.unit is not start_unit:
                    place = Context(self.rules, start_unit, place=start.blocks[0].span)
                    self.diagnostics.append(explain_start_units(place, found.after.unit, start.blocks[0]))
                    start_unit = found.after.unit
                has_findings = any(each.severity is not Severity.INFO for each in answer.diagnostics)
                if has_findings and self.depth is Depth.FULL:
                    # Most programs need no diagnosis, and none should wait for its import.
                    from contoursolve.diagnosis import diagnose  # noqa: PLC0415

                    answer = diagnose(answer, dialect, self.policy)
                if found.form.is_contour:
                    yield answer
                    lines = " and ".join(str(line) for line in answer.lines)
                    reason = f"the contour of line {lines} before it is not solved"
                    state = leave(found, answer.contour.end if answer.contour else None, dialect.modes, reason)
                else:
                    self.diagnostics += answer.diagnostics if answer.start.is_known else ()
                    state = advance(state, block, dialect.modes)
                index += found.blocks[-1].line - block.line
            else:
                self._check_block(block)
                state = advance(state, block, dialect.modes)
            index += 1

    def _examine(self, found: Claim, index: int, state: State) -> Answer:
        """The answer to a contour that begins at a block, with the values that it asks for filled in."""
        dialect, blocks = self.dialect, self.program.blocks
        if dialect is None:
            raise ValueError("without a control there is no contour")
        after = index + found.blocks[-1].line - found.blocks[0].line + 1
        answer = examine(found, self.rules, self.policy, lambda: next_place(blocks[after:], found, dialect.modes))
        if answer.contour is None or not any(value.value is not None for value in answer.answers):
            return answer
        from contoursolve.fill import fill_in  # noqa: PLC0415 - few blocks ask for a value

        return replace(answer, filled=fill_in(answer, state, dialect))

    def nothing_to_solve(self) -> None:
        """The finding that a program has no contour block."""
        forms = dict.fromkeys(
            f"{form.name} ({form.title}, {dialect.name})"
            for dialect in DIALECTS.values()
            for form in dialect.forms
            if self.dialect in (None, dialect) and form.is_contour
        )
        context = Context(self.rules, self.unit)
        rule = context.row(Trouble.NO_CONTOUR)
        self.diagnostics.append(report(context, rule, Basis.RULE, [], triggers=" and ".join(forms)))

    def _check_block(self, block: Block) -> None:
        context = Context(self.rules, self.unit, place=block.span)
        for fault in block.faults:
            finding = explain_fault(context, fault)
            if fault.kind in _FAULTS_OF_NO_CONSEQUENCE:
                finding = replace(finding, severity=Severity.WARNING)
            self.diagnostics.append(finding)
        self.diagnostics += explain_unmarked(context, block)
        for directive in block.directives:
            place = Context(self.rules, self.unit, place=directive.span)
            self.diagnostics.append(report(place, place.row(Trouble.FACT_NOWHERE), Basis.RULE, []))
        self.diagnostics += explain_asked_outside(context, block) if self.dialect else ()
        if self.dialect:
            lexicon = self.dialect.modes.lexicon
            addresses = lexicon.addresses
            axis_words = [word for word in block.words if word.address in addresses and addresses[word.address].axis]
            self.diagnostics += explain_words(context, lexicon, _repeated(axis_words), axis_words)


def _repeated(words: Sequence[Word]) -> list[Word]:
    seen: set[str] = set()
    return [word for word in words if word.address in seen or seen.add(word.address)]  # type: ignore[func-returns-value]
