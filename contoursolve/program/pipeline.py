"""The order of the stages: from the text of a program to its contours and findings."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.diagnosis import Answer, Policy, rank
from contoursolve.diagnostics import Diagnostic, ProgramError, Shown, Span, hash_of
from contoursolve.execution import ALONE, Machine, ProgramEvent, ProgramKind, Surroundings, kind_of
from contoursolve.gcode import Directive, Program, spelled, telling
from contoursolve.geometry import Length, Plane
from contoursolve.program.calls import machine_for
from contoursolve.program.cycle_profiles import CycleProfile
from contoursolve.program.examination import Examination, tell
from contoursolve.program.lookahead import Line
from contoursolve.program.named_words import has_named, with_named
from contoursolve.program.no_contour import conclusions, look_without_control, nothing_to_solve
from contoursolve.program.recognise import begins_for_another
from contoursolve.program.request import Request
from contoursolve.program.running import KeptSteps, Running, lines_alone, steps_as_run, steps_written_out
from contoursolve.program.solve_queue import Step, Together
from contoursolve.program.start_point import check_places
from contoursolve.program.told_outside import Outside
from contoursolve.reading import Control, ReadIssue, contours_of, state_facts

if TYPE_CHECKING:
    from contoursolve.geometry import Statement

ELSEWHERE = (ReadIssue.SUBPROGRAM_SOLVED, ReadIssue.SUBPROGRAM_REFUSED)
"""Findings about contours of other files."""

_OF_CONTROL = (ReadIssue.CONTROL_ALIKE, ReadIssue.CONTROL_CALLED)
"""Findings that say from what a control is concluded."""


class Result(Shown, Struct, frozen=True):
    """All contours and findings of a program.

    Attributes:
        program: the program as typed.
        control: the name of its control; None where there was nothing to tell it by.
        answers: one for each contour, in the order in which the control runs them.
        diagnostics: all findings, in the order of the program.
        start: the block that stated the start point apart from the program; its line is line 0.
        facts: facts stated apart from the program; their lines are -1, -2, ...
        settings: the settings of the control that are not the default ones, by name.
        policy: what the manual's rules did.
        profiles: the profiles of cycles.
        around: the values of variables, and where subprograms are.
        is_concluded: whether a finding says from what its control is concluded.
        tool: the `ToolReport` of the tool for which it was solved; None without one.
    """

    program: Program
    control: str | None
    answers: tuple[Answer, ...]
    diagnostics: tuple[Diagnostic, ...]
    start: Program | None = None
    facts: tuple[Directive, ...] = ()
    settings: Mapping[str, str] = field(default_factory=dict)
    policy: Policy = Policy.ENFORCE
    profiles: tuple[CycleProfile, ...] = ()
    around: Surroundings = ALONE
    is_concluded: bool = False
    tool: Any = None

    __hash__ = hash_of

    @property
    def has_errors(self) -> bool:
        """Whether any finding is an error."""
        return any(each.is_error for each in self.diagnostics)

    @property
    def answer(self) -> Answer:
        """The answer for the only contour. Raises ValueError if there is none, or more than one."""
        if len(self.answers) == 1:
            return self.answers[0]
        if self.answers:
            lines = ", ".join(str(each.lines[0]) for each in self.answers)
            count = f"{len(self.answers)} contours, which begin in program lines {lines}"
            raise ValueError(f"the program has {count}; take one of result.answers, or result.contour_at(line)")
        finding = next((each for each in self.diagnostics if each.is_error), None)
        why = f": {finding.message}" if finding is not None else ""
        raise ValueError(f"the program has no contour{why}")

    def lines_of(self, finding: Diagnostic) -> tuple[int, ...]:
        """The lines that a fix of a finding replaces: those of its contour, or else its own."""
        own = next((each for each in self.answers if finding in each.diagnostics), None)
        return own.lines if own else (self.place(finding.span).line,)

    def contour_at(self, line: int) -> Answer:
        """The contour to which a line of the program belongs. Raises ValueError if there is none."""
        found = next((each for each in self.answers if each.lines[0] <= line <= each.lines[-1]), None)
        if found is not None:
            return found
        if not self.answers:
            raise ValueError(f"program line {line} belongs to no contour; the program has none")
        have = ", ".join(dict.fromkeys(str(each.lines[0]) for each in self.answers))
        begin = "contours begin in program lines" if len(self.answers) > 1 else "the contour begins in program line"
        raise ValueError(f"program line {line} belongs to no contour; {begin} {have}")

    def place(self, span: Span) -> Span:
        """The place itself, or for what was stated apart from the program the block that it is about."""
        if span.line > 0:
            return span
        lines = [answer.lines[-1] for answer in self.answers]
        blocks = [block for block in self.program.blocks if block.words or block.line in lines]
        block = next((block for block in blocks if block.line in lines), blocks[-1] if blocks else None)
        return block.span if block else Span(1, 1, 2)


class FactPlaceError(ProgramError, ValueError):
    """Facts were stated apart from a program with several contours; the message says what to do."""


def attach(program: Program, asked: Request) -> tuple[Program, tuple[Directive, ...]]:
    """The program with the further facts in the last block of its only contour, or else of its last block; and the
    facts, those that are no texts in words. Raises FactPlaceError if there are several contours."""
    control = asked.control
    if control is None or not asked.facts:
        return program, asked.facts
    before, program = control.initial_state(asked.unit), spelled(program, control.modes.syntax)
    contours = [each for each, _ in contours_of(program.blocks, control.find, control.modes, before, asked.start)]
    if len(contours) > 1:
        lines = ", ".join(str(each.blocks[0].line) for each in contours)
        raise FactPlaceError(
            f"the program has {len(contours)} contours (program lines {lines}); write the fact into the block that it "
            "is about, as a comment (contoursolve: ...)"
        )
    state, own = (contours[0].after, contours[0].blocks) if contours else (before, ())
    worded = tuple(_in_words(fact, state.plane, state.unit) for fact in asked.facts)
    return state_facts(program, own, worded), worded


def _in_words(fact: Directive, plane: Plane, unit: Length) -> Directive:
    """A fact with the text that states it."""
    if fact.statement is None:
        return fact
    from contoursolve.geometry import write_statement  # noqa: PLC0415 - few programs need it

    text = write_statement(cast("Statement", fact.statement), plane, unit)
    return replace(fact, text=text, span=Span(fact.span.line, 1, len(text) + 1))


# Results ---------------------------------------------------------------------------------------------------------


def run(program: Program, asked: Request, together: Together | None = None, kept: KeptSteps | None = None) -> Result:
    """Examine every block of a program and solve every contour, one by one or `together`; of one that runs, what is not
    `kept` of an earlier run. Raises FactPlaceError."""
    return Run(program, asked, together, kept).collect()


def frame_of(program: Program, asked: Request, facts: tuple[Directive, ...] = ()) -> Result:
    """A result without contours and findings."""
    control = asked.control
    return Result(
        program,
        control.name if control else None,
        (),
        (),
        asked.start,
        facts,
        control.modes.settings if control else {},
        asked.policy,
        around=asked.around,
        is_concluded=control is not None and any(each.about in _OF_CONTROL for each in control.taken),
    )


class Run:
    """The same as a stream: contours, and findings about other blocks, as they are found. `frame` is the result without
    them. Raises FactPlaceError."""

    def __init__(
        self, program: Program, asked: Request, together: Together | None = None, kept: KeptSteps | None = None
    ) -> None:
        control = asked.control
        if control is not None:
            program = spelled(program, control.modes.syntax)
            check_places(asked)
        program, facts = attach(program, asked)
        self._beside: tuple[Diagnostic, ...] = ()
        if control is not None and (asked.named or has_named(program.text)):
            asked, self._beside = with_named(asked, control, program)
            # Contours that are solved together say nothing of words that are named.
            together = None
        self.frame = frame_of(program, asked, facts)
        self.called: list[Answer] = []
        """The contours of other files that are called, when all is examined."""
        self.profiles: list[CycleProfile] = []
        """The profiles of cycles that ran, when all is examined."""
        self.asked, self._together, self._kept = asked, together, kept
        self._machine = machine_for(program, control, asked.around, asked.unit) if control else None

    @cached_property
    def _running(self) -> Running | None:
        """The run of a program that calls or computes."""
        if self._machine is None or self.asked.control is None:
            return None
        return Running(self._examination(self.asked.control), self._machine, self._kept)

    def ahead(self) -> Iterator[None]:
        """The run of a program that calls or computes, step by step; what is told of it waits for its end."""
        return iter(()) if self._running is None else self._running.walk

    def __iter__(self) -> Iterator[Answer | Diagnostic]:
        # A machine has read them.
        blocks = self._machine.main.blocks if self._machine is not None else self.frame.program.blocks
        asked, is_told = self.asked, False
        own = asked.control
        if own is not None and not asked.is_strict and begins_for_another(blocks, own):
            yield nothing_to_solve(asked, blocks)
            return
        if own is not None:
            yield from conclusions(asked, blocks)
        yield from self._beside
        for step in self._steps():
            is_told = is_told or any(each.is_error or each.about in ELSEWHERE for each in step.findings)
            yield from step.findings
            if isinstance(step.answer, Answer):
                is_told = True
                yield from (step.answer, *step.others)
        if not is_told:
            yield nothing_to_solve(asked, blocks)

    def _steps(self) -> Iterator[Step]:
        blocks, asked = self.frame.program.blocks, self.asked
        if asked.control is None:
            return tell([look_without_control(asked, blocks)], Outside(None, is_strict=asked.is_strict))
        if self._running is not None:
            return steps_as_run(self._running, self.profiles, self.called)
        return self._examination(asked.control).steps(blocks)

    def _examination(self, control: Control) -> Examination:
        machine, goes_on = self._machine, self.asked.depth.is_full
        told = (block.text for block in telling(self.frame.program.blocks))
        kind = None if machine is not None else kind_of(told, control.modes.language)
        is_called = kind is ProgramKind.FOR_CALLS if machine is None else machine.is_for_calls
        return Examination(
            self.asked, control, self._together, goes_on=goes_on, is_run=machine is not None, is_called=is_called
        )

    @property
    def is_strict(self) -> bool:
        """Whether it tells of every line."""
        return self.asked.is_strict

    def collect(self) -> Result:
        """All of it."""
        items = list(self)
        answers = [each for each in items if isinstance(each, Answer)]
        everything = [each for each in items if isinstance(each, Diagnostic)]
        everything += [each for answer in answers for each in answer.diagnostics]
        found = tuple(sorted(everything, key=rank))
        return replace(self.frame, answers=tuple(answers), diagnostics=found, profiles=tuple(self.profiles))


def walk(
    lines: Iterable[Line],
    asked: Request,
    together: Together | None = None,
    machine: Machine | None = None,
    told: Callable[[ProgramEvent], None] | None = None,
    *,
    is_whole: bool = False,
    is_called: bool = False,
) -> Iterator[Step]:
    """Every block and every contour of a program in order; lines that are not a sequence are read as they are needed,
    so that a program of any length takes no more memory than some thousand lines, or its longest contour. Plain lines
    are read into words only where that matters. Contours are solved one by one, or `together`. Where a machine runs the
    program, it has its lines; with `told`, its calls are written out, and with `is_whole`, what nothing calls as
    well. One that returns `is_called` by others."""
    is_run = machine is not None and not is_whole
    is_called = is_called if machine is None else machine.is_for_calls
    examination = Examination(asked, cast("Control", asked.control), together, is_run=is_run, is_called=is_called)
    if machine is None:
        return examination.steps(lines)
    if is_whole:
        return steps_written_out(examination, machine, machine.run_all_alone())
    if told is not None:
        return steps_written_out(examination, machine, lines_alone(machine, told))
    return steps_as_run(Running(examination, machine))
