"""The order of the stages: from the text of a program to its contours and findings."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import copy
from functools import cache, partial
from itertools import islice
from typing import TYPE_CHECKING, Any, cast

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.controls import DIALECTS
from contoursolve.diagnosis import (
    Answer,
    Context,
    Depth,
    Policy,
    corner_words,
    either,
    examine,
    explain_asked_outside,
    explain_call,
    explain_codes_by_name,
    explain_corners,
    explain_faults,
    explain_start_diameter,
    explain_start_units,
    explain_unmarked,
    explain_vocabulary,
    explain_words,
    has_corners,
    is_known,
    join,
    like_corners,
    moves,
    name_of,
    not_read_yet,
    rank,
    report,
)
from contoursolve.diagnostics import Basis, Diagnostic, ProgramError, Severity, Shown, Span, UserError
from contoursolve.execution import ALONE, EventKind, Machine, ProgramEvent, Surroundings
from contoursolve.gcode import (
    Block,
    Directive,
    FaultKind,
    Passage,
    Program,
    Word,
    find_lookalikes,
    has_lookalike_code,
    parse_block,
    spelled,
)
from contoursolve.geometry import Length, Plane
from contoursolve.program.calls import in_text_order, machine_for
from contoursolve.program.cycle_profiles import CycleProfile
from contoursolve.program.lookahead import Line, View, each_block, go_on, pass_plainly, says_something
from contoursolve.program.outside_contours import Outside
from contoursolve.program.recognise import begins_for_another, first_signs, what_shows
from contoursolve.program.request import Request
from contoursolve.program.solve_queue import Pending, Previous, Queue, Step, Together
from contoursolve.program.tape_markers import Marks
from contoursolve.reading import (
    COMMENTED,
    TURNED,
    Dialect,
    Effect,
    Modes,
    ParsedContour,
    ReadIssue,
    State,
    Ways,
    advance,
    advance_plainly,
    apply_modes,
    codes_of,
    contours_of,
    is_plain,
    next_place,
    reach_of,
    state_facts,
    unread_state,
)

if TYPE_CHECKING:
    from contoursolve.geometry import Statement


class Result(Shown, Struct, frozen=True):
    """All contours and findings of a program; `control` is None where there was nothing to tell it by."""

    program: Program
    control: str | None
    answers: tuple[Answer, ...]
    diagnostics: tuple[Diagnostic, ...]
    start: Program | None = None
    """The block that stated the start point apart from the program; its line is line 0."""
    facts: tuple[Directive, ...] = ()
    """Facts stated apart from the program; their lines are -1, -2, ..."""
    settings: Mapping[str, str] = field(default_factory=dict)
    """The settings of the control that are not the default ones, by name."""
    policy: Policy = Policy.ENFORCE
    profiles: tuple[CycleProfile, ...] = ()
    """The profiles of cycles."""
    around: Surroundings = ALONE
    """The values of variables, and where subprograms are."""
    is_concluded: bool = False
    """Whether a finding says from what its control is concluded."""

    @property
    def has_errors(self) -> bool:
        """Whether any finding is an error."""
        return any(each.is_error for each in self.diagnostics)

    def lines_of(self, finding: Diagnostic) -> tuple[int, ...]:
        """The lines that a fix of a finding replaces: those of its contour, or its own; a contour tells of the block
        behind it, too."""
        own = next((each for each in self.answers if finding in each.diagnostics), None)
        line = self.place(finding.span).line
        return own.lines if own and line <= own.lines[-1] else (line,)

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
    dialect = asked.dialect
    if dialect is None or not asked.facts:
        return program, asked.facts
    before, program = dialect.initial_state(asked.unit), spelled(program, dialect.modes.syntax)
    contours = [each for each, _ in contours_of(program.blocks, dialect.find, dialect.modes, before, asked.start)]
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


def run(program: Program, asked: Request, together: Together | None = None) -> Result:
    """Examine every block of a program and solve every contour, one by one or `together`. Raises FactPlaceError."""
    return Run(program, asked, together).collect()


class Run:
    """The same as a stream: contours, and findings about other blocks, as they are found. `frame` is the result without
    them. Raises FactPlaceError."""

    def __init__(self, program: Program, asked: Request, together: Together | None = None) -> None:
        dialect, start = asked.dialect, asked.start
        if dialect is not None:
            program = spelled(program, dialect.modes.syntax)
        program, facts = attach(program, asked)
        control, settings = (dialect.name, dialect.modes.settings) if dialect else (None, {})
        is_concluded = dialect is not None and any(each.about in _OF_CONTROL for each in dialect.taken)
        self.frame = Result(
            program,
            control,
            (),
            (),
            start,
            facts,
            settings,
            asked.policy,
            around=asked.around,
            is_concluded=is_concluded,
        )
        self._asked = asked
        self._examiner = Examiner(asked, together, goes_on=asked.depth is Depth.FULL)
        self._machine = machine_for(program, dialect, asked.around) if dialect is not None else None

    def __iter__(self) -> Iterator[Answer | Diagnostic]:
        program, examiner, is_told = self.frame.program, self._examiner, False
        own = self._asked.dialect
        if own is not None and not self.is_strict and begins_for_another(program.blocks, own):
            yield examiner.nothing_to_solve(program.blocks)
            return
        if own is not None:
            yield from examiner.conclusions(program.blocks)
        for step in self._steps():
            is_told = is_told or any(each.is_error or each.about in ELSEWHERE for each in step.findings)
            yield from step.findings
            if isinstance(step.answer, Answer):
                is_told = True
                yield from (step.answer, *step.others)
        if not is_told:
            yield examiner.nothing_to_solve(program.blocks)

    def check_start(self) -> None:
        """Raise StartError where the start point that is stated apart cannot be read."""
        check_start(self._asked)

    @property
    def called(self) -> Sequence[Answer]:
        """The contours of other files that are called, when all is examined."""
        return self._examiner.called

    def _steps(self) -> Iterator[Step]:
        blocks = self.frame.program.blocks
        if self._machine is not None:
            return self._examiner.steps_as_run(self._machine.main.blocks, self._machine)
        # Blocks that are not kept are read as they are needed.
        is_whole = isinstance(blocks, tuple) or self.frame.control is None
        return self._examiner.steps(blocks if is_whole else iter(blocks))

    @property
    def is_strict(self) -> bool:
        """Whether it tells of every line."""
        return self._asked.is_strict

    def collect(self) -> Result:
        """All of it."""
        items = list(self)
        answers = [each for each in items if isinstance(each, Answer)]
        everything = [each for each in items if isinstance(each, Diagnostic)]
        everything += [each for answer in answers for each in answer.diagnostics]
        profiles = tuple(self._examiner.profiles)
        found = tuple(sorted(everything, key=rank))
        return replace(self.frame, answers=tuple(answers), diagnostics=found, profiles=profiles)


class StartError(UserError, ValueError):
    """A start point that is stated apart from a program and cannot be read; the message says why."""


def check_start(asked: Request) -> None:
    """Raise StartError where words that state the start point cannot be read, or give no position."""
    dialect, start = asked.dialect, asked.start
    if dialect is None or start is None or not start.text.strip():
        return
    examiner = Examiner(asked)
    examiner.begin()
    error = next((each for each in examiner.diagnostics if each.is_error), None)
    axes = {name for name, each in dialect.modes.lexicon.addresses.items() if each.axis}
    has_position = any(word.address in axes for block in start.blocks for word in block.words)
    if error is not None or not has_position:
        told = error.message if error is not None else "it gives no position"
        raise StartError(
            f'--start "{start.text}": {told}; write words such as "X40. Z0.", as {dialect.name} reads them'
        )


def walk(
    blocks: Iterable[Line],
    asked: Request,
    together: Together | None = None,
    machine: Machine | None = None,
    told: Callable[[ProgramEvent], None] | None = None,
) -> Iterator[Step]:
    """Every block and every contour of a program in order; blocks that are not a sequence are read as they are needed,
    so that a program of any length takes no more memory than some thousand lines, or its longest contour. Plain lines
    are read into words only where that matters. Contours are solved one by one, or `together`; where a machine runs the
    program, `blocks` are those that it has; with `told`, its calls are written out."""
    examiner = Examiner(asked, together)
    if machine is not None and told is not None:
        return examiner.steps_alone(machine, told)
    if machine is not None:
        return examiner.steps_as_run(cast("Sequence[Block]", blocks), machine)
    return examiner.steps(blocks)


_OF_CONTROL = (ReadIssue.CONTROL_ALIKE, ReadIssue.CONTROL_CALLED)
"""Findings that say from what a control is concluded."""

ELSEWHERE = (ReadIssue.SUBPROGRAM_SOLVED, ReadIssue.SUBPROGRAM_REFUSED)
"""Findings about contours of other files."""

_OPENING = (EventKind.LOST, EventKind.STOPPED, EventKind.PART)
"""Events behind which it is not known what runs, or where the tool is."""

_FAULTS_OF_NO_CONSEQUENCE = (FaultKind.STRAY_CHARACTER,)
"""Faults that are only worth a warning in a block that is not a contour."""

_LOOKED_AT = 1_000
"""Lines of a program in which the words of a control are looked for."""

_ARCS = (2, 3)
"""Motions of arcs. Those with an end or a centre end where their words say, whatever else is wrong with them."""

_TRIES = 32
"""Blocks among them that are tried with a comma."""

_MOVING = frozenset("XYZUVWABCR")
"""Addresses of axes, and of what a comma makes a part of a contour."""

_NEAR = 8
"""Blocks at a place that are looked at together for what may have been meant there."""

_BEHIND = 32
"""Blocks after a contour of which a repair may make a part of it: the rest of a chain that a comma joins."""

MOST_EXPLAINED = 100
"""Wrong results of one contour that are explained and mended, where it runs again and again."""

_BATCH = 1_000
"""Blocks that are read at once."""

_FIRST, _WINDOW = 16, 4_096
"""Steps of a program of which the contours are solved together while it is read: in the beginning, when nothing is
known, and later."""

_WHOLE = 32_768
"""The same for a program that has been read: the more there are of a kind, the less each of them takes."""


class Checkpoint(Struct, frozen=True):
    """Knowledge of an examination about a program before one of its blocks."""

    state: State
    previous: Previous | None
    marks: Marks
    start_unit: Length
    start_counts: bool | None


class Examiner:
    """One pass over one program: the modal state as it goes, and the findings outside contours."""

    def __init__(self, asked: Request, together: Together | None = None, *, goes_on: bool = False) -> None:
        self.asked, self.dialect, self.rules = asked, asked.dialect, asked.rules
        self.outside = Outside(asked.dialect, is_strict=asked.is_strict)
        self.together = together
        self.diagnostics: list[Diagnostic] = []
        self.marks = Marks(Context(self.rules, asked.unit))
        self.previous: Previous | None = None
        """The last contour or block that says something, and the state before it: with a comma in the next block, it
        may be part of the contour there."""
        self.start_unit = asked.unit
        """In which a start point that is stated apart counts, until a contour has another unit."""
        self.start_counts: bool | None = None
        """Whether X of a start point that is stated apart counted diameters, where codes switch that."""
        self.profiles: list[CycleProfile] = []
        """The profiles of cycles that ran, known at the end."""
        self.called: list[Answer] = []
        """The contours of other files, known at the end."""
        self.known: dict[object, Answer] = {}
        """The answers of a program that runs, by what is known before a contour, its blocks and those behind it."""
        self.faulty: Counter[tuple[str, int]] | None = None
        """Of a program that runs: how often the contour at a line of a file was wrong. In a loop, each pass may be."""
        self.queue = Queue(self.dialect, together, self._examine_once, goes_on=goes_on) if self.dialect else None

    def steps(self, blocks: Iterable[Line]) -> Iterator[Step]:
        """Every block and every contour, in order; without a dialect, only what is found."""
        window: list[Step | Pending] = []
        size, most = (_WHOLE, _WHOLE) if isinstance(blocks, Sequence) else (_FIRST, _WINDOW)
        if self.together is None:
            size, most = 1, 1
        for each in self._walk(blocks):
            window.append(each)
            if len(window) >= size:
                yield from self._told(window)
                window, size = [], min(2 * size, most)
        yield from self._told(window)

    def _told(self, window: Sequence[Step | Pending]) -> Iterator[Step]:
        """Some steps in a row, solved, with those findings outside contours that are told."""
        if self.queue is not None:
            self.queue.settle()
        for each in window:
            step = each.step if isinstance(each, Pending) else each
            held: Sequence[Line] = [step.passage] if step.passage else step.blocks
            line, blocks = held[0].line if held else 0, partial(each_block, held, 0)
            told = tuple(self.outside.take(step.findings, line, blocks, step.answer, step.before))
            yield step if told == step.findings else replace(step, findings=told)

    def steps_as_run(self, blocks: Sequence[Block], machine: Machine) -> Iterator[Step]:
        """The same of a program that calls or computes: as it runs, told in the order in which it is written."""
        self.marks.is_done, self.faulty = True, Counter()
        marks = Marks(self.marks.context)
        told = [*(finding for block in blocks for finding in marks.look(block)), *marks.finish()]
        steps = self._told(self._run(machine))
        outside = told if self.outside.is_strict else []
        first = cast("Dialect", self.dialect).initial_state(self.asked.unit)
        yield from in_text_order(
            blocks, steps, machine.passed_over, self.rules, outside, self.profiles, first, self.called
        )

    def steps_alone(self, machine: Machine, told: Callable[[ProgramEvent], None]) -> Iterator[Step]:
        """The same as one program without calls; `told` is called where it is not known what runs."""
        self.marks.is_done, self.faulty = True, Counter()

        def watched() -> Iterator[Line]:
            for each in machine.run_alone():
                if isinstance(each, ProgramEvent):
                    if (each.kind in _OPENING and not each.is_told) or (each.kind is EventKind.BARRIER and each.reason):
                        told(each)
                    if each.kind is EventKind.HEAD:
                        # What is written out runs once.
                        continue
                yield each

        yield from self.steps(watched())

    def checkpoint(self, state: State) -> Checkpoint:
        """The checkpoint before a block, in a state."""
        return Checkpoint(state, self.previous, copy(self.marks), self.start_unit, self.start_counts)

    def resume(self, blocks: Sequence[Block], index: int, known: Checkpoint) -> Iterator[tuple[Step, int, Checkpoint]]:
        """The steps of a program that is at hand from a block on, one by one, each with the number of lines from its
        first one on that it rests on, one more than there are where it rests on the end; and what is known behind it.
        Contours are not solved together."""
        self.previous, self.marks = known.previous, copy(known.marks)
        self.start_unit, self.start_counts = known.start_unit, known.start_counts
        while index < len(blocks):
            view = View(blocks, index)
            found, after = self._find(view, known.state)
            taken, leave = self._take(view, found, after, known.state)
            known, index = self.checkpoint(leave()), index + after
            yield taken.step if isinstance(taken, Pending) else taken, view.reach, known

    def begin(self) -> Checkpoint:
        """The checkpoint before a program, behind the block that states its start point apart."""
        return self.checkpoint(self._begin(cast("Dialect", self.dialect)))

    def _run(self, machine: Machine) -> list[Step | Pending]:
        """Every block and every contour of a program that runs, on each of its ways."""
        dialect, found = cast("Dialect", self.dialect), list[Step | Pending]()
        ways, last = self._ways(dialect), list[tuple[Sequence[Block], int]]()

        def read(
            held: Sequence[Block], index: int, state: State, is_open: bool
        ) -> tuple[int, Callable[[], State]] | None:
            view = View(held, index)
            if view[0].mark:
                ways.marked[view[0].mark] = state
            contour, after = self._find(view, state)
            if is_open and view.reach > len(held) - index:
                return None
            if not last or last[-1][0] is not held or last[-1][1] != index:
                # Another way.
                self.previous = None
            last[:] = [(held, index + after)]
            taken, leave = self._take(view, contour, after, state)
            found.append(taken)
            return after, leave

        def happen(event: ProgramEvent) -> bool:
            if event.kind is EventKind.LEAVE:
                # Where the profile of a cycle ended.
                found.extend(Step((), way.state, findings=self._findings()) for way in ways.now)
            is_anew = self._happen(event, ways)
            machine.settled = ways.settled
            return is_anew

        ways.follow(machine.run(), read, found, happen)
        found += self._end(dialect.initial_state(self.asked.unit))
        return found

    def _ways(self, dialect: Dialect) -> Ways:
        return Ways(partial(self._begin, dialect), dialect.modes)

    def _happen(self, event: ProgramEvent, ways: Ways) -> bool:
        """Take in an event of the program; whether all that was found since a head is found anew."""
        self.previous = None
        context = Context(self.rules, self.asked.unit, place=Span(event.line, 1, 2))
        if event.kind is EventKind.STOPPED:
            row = context.row(ReadIssue.NOT_FOLLOWED)
            self.diagnostics.append(report(context, row, Basis.RULE, [], reason=event.reason))
        if event.kind is EventKind.MAY_STOP:
            found = report(context, context.row(ReadIssue.NOT_FOLLOWED), Basis.RULE, [], reason=event.reason)
            help_ = "write the block or the label; where it jumps, the control stops"
            self.diagnostics.append(replace(found, help=help_))
        if event.unread:
            row = context.row(ReadIssue.NOT_READ)
            self.diagnostics.append(report(context, row, Basis.RULE, [], name=event.unread))
        if event.called:
            self.diagnostics += explain_call(context, event.called, ways.modes)
        return ways.happen(event)

    def _begin(self, dialect: Dialect) -> State:
        """The modal state before a program, behind the block that states its start point apart."""
        state, start = dialect.initial_state(self.asked.unit), self.asked.start
        for block in start.blocks if start else ():
            self._check_block(block)
            state = advance(state, block, dialect.modes)
        self.start_unit = state.unit
        has_x = any(word.address == TURNED for block in start.blocks for word in block.words) if start else False
        self.start_counts = state.counts_diameters() if has_x and state.diameter is not None else None
        return state

    def _end(self, state: State) -> Iterator[Step]:
        """The last step of a program, with the findings at its end, if there are any."""
        self.diagnostics += self.marks.finish()
        if self.diagnostics:
            yield Step((), state, findings=self._findings())

    def _look_at_all(self, blocks: Sequence[Block]) -> Step:
        """Examine blocks without a control: their characters, their facts, and signs of contours."""
        is_shown = False
        for index, block in enumerate(blocks):
            if self.outside.is_strict:
                self.diagnostics += self.marks.look(block)
            is_torn = not is_shown and has_lookalike_code(block)
            is_unread = any(fault.kind is FaultKind.BLOCK_TOO_LONG for fault in block.faults)
            if self.outside.is_strict or block.directives or is_torn or is_unread:
                self._check_block(block)
            # One line is enough: with that mended, the control is known.
            is_shown = is_shown or (is_torn and self._check_letters_of_any(blocks, index))
        self.diagnostics += self.marks.finish()
        return Step((), unread_state(self.asked.unit), findings=self._findings())

    def _walk(self, blocks: Iterable[Line]) -> Iterator[Step | Pending]:
        """Every block and every contour, in order, contours as they are found."""
        if self.dialect is None:
            yield self._look_at_all(cast("Sequence[Block]", blocks))
            return
        dialect = self.dialect
        ways = self._ways(dialect)
        state = ways.now[0].state
        is_whole, index, size = isinstance(blocks, Sequence), 0, _FIRST
        held: list[Line] = list(blocks) if is_whole else []
        rest = iter(() if is_whole else blocks)
        while True:
            if index >= len(held) - 1 and not is_whole:
                more, size = list(islice(rest, size)), min(2 * size, _BATCH)
                held, index, is_whole = [*held[index:], *more], 0, not more
                continue
            if index >= len(held):
                yield from self._end(state)
                return
            line = held[index]
            if isinstance(line, ProgramEvent):
                if line.kind is EventKind.LEAVE:
                    # Where the profile of a cycle ended.
                    yield Step((), state, findings=self._findings())
                ways.now = [replace(each, state=state) for each in ways.now]
                self._happen(line, ways)
                state, index = ways.now[0].state if ways.now else state, index + 1
                continue
            if isinstance(line, Block) and line.mark:
                ways.marked[line.mark] = state
            if isinstance(line, Passage):
                passed = pass_plainly(held, index, moves=is_plain(state), joins=dialect.has_runs)
                if passed:
                    self.diagnostics += self.marks.look(passed)
                    yield Step((), state, findings=self._findings(), passage=passed)
                    state = advance_plainly(state, passed, dialect.modes)
                    held, index = go_on(held, index, len(passed.lines))
                    continue
            view = View(held, index)
            if not is_whole and not view.holds(1 + _NEAR):
                more = list(islice(rest, _BATCH))
                held, index, is_whole = [*held[index:], *more], 0, not more
                continue
            found, after = self._find(view, state)
            # Nothing goes on at a block that says nothing.
            ends = found is None and not says_something(view[0])
            if not is_whole and not ends and not (view.says_something(after) and view.holds(after + _BEHIND)):
                # Whether a contour goes on is known at the next block that says something.
                more = list(islice(rest, max(_BATCH, len(held) - index)))
                held, index, is_whole = [*held[index:], *more], 0, not more
                continue
            taken, leave = self._take(view, found, after, state)
            yield taken
            state = leave()
            held, index = go_on(held, index, after)

    def _find(self, view: View, state: State) -> tuple[ParsedContour | None, int]:
        """The contour that begins at the first of some blocks, if one does, and the number of lines that it has."""
        dialect = cast("Dialect", self.dialect)
        found = dialect.find(view, 0, state, dialect.modes)
        return found, reach_of(found, view) if isinstance(found, ParsedContour) else 1

    def _take(
        self, view: View, found: ParsedContour | None, after: int, state: State
    ) -> tuple[Step | Pending, Callable[[], State]]:
        """The step of so many blocks, and what gives the state behind it."""
        dialect = cast("Dialect", self.dialect)
        block, modes = view[0], dialect.modes
        blocks = (block,) if after == 1 else tuple(view[:after])
        self.diagnostics += (finding for each in blocks for finding in self.marks.look(each))
        if isinstance(found, ParsedContour) and found.form.is_contour:
            self._check_arc_before(view)
            self._check_units(found)
            step = Step(blocks, state, findings=self._findings())
            queue = cast("Queue", self.queue)
            pending = queue.add(found, step, view, after, self.previous)
            self.previous = found.blocks, state
            return pending, partial(queue.leave, pending)
        behind = advance(state, block, modes)
        if isinstance(found, ParsedContour):
            ends = behind.motion in _ARCS and any(map(block.find, (*behind.plane.axes, *behind.plane.centers)))
            if self.outside.is_strict or not ends or dialect.signs(block):
                self._check_arc(found, Pending(found, Step((), state), view, after))
            self._check_units(found)
        else:
            self._check_block(block, apply_modes(state, block, modes))
            self._check_slips(view, (state, behind))
        self.previous = ((block,), state) if block.words else self.previous
        return Step(blocks, state, findings=self._findings()), lambda: behind

    def _check_arc(self, found: ParsedContour, pending: Pending) -> None:
        """Examine an arc that is read as a contour is, but is none, and keep the findings about its values."""
        answer = self._examine(found, pending)
        if not found.form.needs_values:
            self.diagnostics += (each for each in answer.diagnostics if each.about not in _ABOUT_VALUES)
        elif answer.start.is_known:
            self.diagnostics += answer.diagnostics

    def _check_arc_before(self, view: View) -> None:
        """The arc that leads to a contour; others are looked at only where every line is."""
        if self.dialect is None or self.previous is None or self.outside.is_strict:
            return
        (block, *others), state = self.previous
        modes = self.dialect.modes
        if others or apply_modes(state, block, modes).motion not in _ARCS:
            return
        both = [block, *view[:_NEAR]]
        found = self.dialect.find(both, 0, state, modes)
        if isinstance(found, ParsedContour) and not found.form.is_contour:
            self._check_arc(found, Pending(found, Step((), state), View(both, 0), 1))

    def _check_slips(self, blocks: Sequence[Block], states: tuple[State, State]) -> None:
        """Add findings about slips in the first of some lines that would be a contour without them."""
        block, dialect = blocks[0], self.dialect
        if dialect is None or self.asked.depth is Depth.VERDICT:
            return
        if any(f",{word.address}" in dialect.modes.lexicon.addresses for word in block.words):
            from contoursolve.diagnosis import explain_commas  # noqa: PLC0415 - few programs need it

            context = Context(self.rules, self.asked.unit, place=block.span)
            self.diagnostics += explain_commas(context, dialect, blocks[:_NEAR], states, self.previous)
        codes = dialect.modes.codes
        if any(word.address == "G" and word.number is not None and word.number not in codes for word in block.words):
            from contoursolve.diagnosis import explain_codes  # noqa: PLC0415 - few programs need it

            context = Context(self.rules, self.asked.unit, place=block.span)
            self.diagnostics = [*explain_codes(context, dialect, blocks[:_NEAR], states[0], self.diagnostics)]
        if has_lookalike_code(block):
            self._check_letters(dialect, blocks[:_NEAR], states[0])

    def _check_letters(self, dialect: Dialect, blocks: Sequence[Block], before: State) -> None:
        """Add findings about letters in the first of some lines that would be a contour with digits in their place."""
        from contoursolve.diagnosis import explain_letters  # noqa: PLC0415 - few programs need it

        block = blocks[0]
        own = [each for each in self.diagnostics if each.span.line == block.line]
        others = [each for each in self.diagnostics if each.span.line != block.line]
        context = Context(self.rules, self.asked.unit, place=block.span)
        self.diagnostics = [*others, *explain_letters(context, dialect, blocks, before, own)]

    def _check_letters_of_any(self, blocks: Sequence[Block], index: int) -> bool:
        """The same for a line of a program that shows no control, by the control that shows if they are digits; whether
        there is one."""
        meant = parse_block(" ".join(each.new for each in find_lookalikes(blocks[index])), blocks[index].line)
        dialect = next((each for each in DIALECTS.values() if each.signs(meant)), None)
        if dialect is None:
            return False
        state = dialect.initial_state(self.asked.unit)
        start = self.asked.start
        for block in (*(start.blocks if start else ()), *islice(blocks, index)):
            state = advance(state, block, dialect.modes)
        self._check_letters(dialect, blocks[index : index + _NEAR], state)
        return True

    def _findings(self) -> tuple[Diagnostic, ...]:
        """Take the findings since the last step."""
        findings, self.diagnostics = tuple(self.diagnostics), []
        return findings

    def _examine_once(self, found: ParsedContour, pending: Pending) -> Answer:
        """The answer to a contour of a program that runs: where it comes to the same again, that it gave before."""
        if self.faulty is None or found.directives:
            return self._examine(found, pending)
        behind = pending.view[pending.after : pending.after + _NEAR]
        key = (found.before.known(), tuple(map(_key_of, (*found.blocks, *behind))), len(found.blocks))
        if key not in self.known:
            self.known[key] = self._examine(found, pending)
        return self.known[key]

    def _examine(self, found: ParsedContour, pending: Pending) -> Answer:
        """The answer to a contour, with the values that it asks for filled in."""
        dialect, blocks, after, state = self.dialect, pending.view, pending.after, pending.step.before
        if dialect is None:
            raise ValueError("without a control there is no contour")
        behind = islice(blocks, after, None)
        answer = examine(
            found, self.rules, self.asked.policy, lambda: next_place(behind, found, dialect.modes), self.asked.depth
        )
        if answer.contour is not None and any(value.value is not None for value in answer.answers):
            from contoursolve.diagnosis import fill_in  # noqa: PLC0415 - few blocks ask for a value

            answer = replace(answer, filled=fill_in(answer, state, dialect))
        # A path across the spindle axis is as the words say it.
        told = (each for each in answer.diagnostics if each.about is not ReadIssue.AXIS_CROSSED)
        has_findings = any(each.severity is not Severity.INFO for each in told)
        if has_findings and not self._is_explained(found.blocks[0]):
            note = f"only the first {MOST_EXPLAINED} wrong results of a contour are explained; this is a later one"
            diagnostics = (replace(each, notes=(*each.notes, note)) for each in answer.diagnostics)
            answer = replace(answer, diagnostics=tuple(diagnostics))
        elif has_findings and self.asked.depth is not Depth.VERDICT:
            # Most programs need no diagnosis, and none should wait for its import.
            from contoursolve.diagnosis import diagnose  # noqa: PLC0415

            answer = diagnose(answer, dialect, self.asked.policy, blocks[after : after + _BEHIND], pending.previous)
            if self.asked.depth is Depth.FULL and any(each.about is ReadIssue.VARIABLE for each in answer.diagnostics):
                from contoursolve.program.open_values import tell_values  # noqa: PLC0415 - few contours need it

                answer = tell_values(answer, dialect, self.asked.policy)
        elif self.asked.depth is not Depth.VERDICT and any(
            each.about is ReadIssue.POINT_MISSING for each in answer.diagnostics
        ):
            from contoursolve.diagnosis import mend_points  # noqa: PLC0415

            answer = mend_points(answer, dialect)
        return answer

    def _is_explained(self, first: Block) -> bool:
        """Whether what is wrong with a contour, of which this is the first block, is explained this time."""
        if self.faulty is None:
            return True
        self.faulty[first.file, first.line] += 1
        return self.faulty[first.file, first.line] <= MOST_EXPLAINED

    def _check_units(self, found: ParsedContour) -> None:
        """Add findings if a contour has other units, or other diameters, than the start point stated apart from the
        program."""
        start = self.asked.start
        if start and found.after.unit is not self.start_unit:
            place = Context(self.rules, self.start_unit, place=start.blocks[0].span)
            self.diagnostics.append(explain_start_units(place, found.after.unit, start.blocks[0]))
        self.start_unit = found.after.unit
        here, was = found.after, self.start_counts
        if start and was is not None and here.counts_diameters() is not was:
            place = Context(self.rules, self.start_unit, place=start.blocks[0].span)
            self.diagnostics.append(explain_start_diameter(place, here, self._codes_of(here), start.blocks[0]))
        self.start_counts = None

    def _codes_of(self, state: State) -> str:
        """The code by which X is what it is in a state."""
        codes = self.dialect.modes.codes.values() if self.dialect else ()
        return next((code.text for code in codes if code.diameter is state.diameter), state.plane.code)

    def nothing_to_solve(self, blocks: Sequence[Block]) -> Diagnostic:
        """The finding that a program has no contour block: a warning where nothing in it looks like one."""
        own = self.dialect.name if self.dialect else None
        if self.dialect is None and self.asked.depth is not Depth.VERDICT:
            looked_at = blocks[:_LOOKED_AT]
            for name, dialect in DIALECTS.items():
                for slip in self._slips_as(dialect, looked_at):
                    context = Context(self.rules, self.asked.unit, place=slip.span)
                    row = context.row(ReadIssue.CONTROL_UNKNOWN)
                    readers = self._taking(slip.span, looked_at)
                    word = looked_at[slip.span.line - 1].text[slip.span.column - 1 : slip.span.end_column - 1]
                    taken = f"with {join(readers)}, {word} is a word of a contour; " if readers else ""
                    told = f"{taken}with --control {name}: {slip.message}"
                    return report(context, row, Basis.RULE, [], control="|".join([*readers, name]), readings=told)
        controls = (self.dialect,) if self.dialect else DIALECTS.values()
        triggers = [f"of {each.name}: {each.contours}" for each in controls]
        shown = (
            what_shows(blocks, self.dialect)
            if self.dialect and _lacks_motion(self.dialect, blocks, self.asked.unit)
            else ""
        )
        by_sign: dict[str, list[str]] = {}
        for name, sign in ({} if shown or own is None else first_signs(blocks, own)).items():
            by_sign.setdefault(sign, []).append(name)
        notes = [
            f"{sign} is for {either(names)}: try --control {names[0] if len(names) == 1 else 'with one of them'}"
            for sign, names in by_sign.items()
        ]
        if shown:
            notes.insert(0, f"no G code of a motion is in force at {shown}: write G01")
        context = Context(self.rules, self.asked.unit)
        row = context.row(ReadIssue.NO_CONTOUR)
        finding = report(context, row, Basis.RULE, [], triggers="; ".join(triggers))
        slight = Severity.WARNING if self.outside.is_strict else Severity.INFO
        return replace(finding, notes=tuple(notes)) if notes else replace(finding, severity=slight)

    def _taking(self, place: Span, blocks: Sequence[Block]) -> list[str]:
        """The controls that have the axes of a program and for which the word at a place belongs to a contour."""
        axes = {word.address for block in blocks for word in block.words} & {*"XYZ"}
        return [
            name
            for name, each in DIALECTS.items()
            if axes <= each.modes.lexicon.addresses.keys()
            for claim, _ in contours_of(blocks, each.find, each.modes, each.initial_state(self.asked.unit))
            if any(word.span == place for word in claim.words.values())
        ]

    def conclusions(self, blocks: Iterable[Block]) -> Iterator[Diagnostic]:
        """Findings about the conclusions on the control, at the first block that shows it."""
        own = cast("Dialect", self.dialect)
        place = next((block.span for block in blocks if own.signs(block)), Span(1, 1, 2)) if own.taken else None
        for each in own.taken:
            context = Context(self.rules, self.asked.unit, place=cast("Span", place))
            yield report(context, each.about, Basis.RULE, [], **cast("dict[str, Any]", each.fields))

    def _slips_as(self, dialect: Dialect, blocks: Sequence[Block]) -> Iterator[Diagnostic]:
        """The words that make a contour for a control with their comma, in the first lines of a program."""
        from contoursolve.diagnosis import explain_commas  # noqa: PLC0415 - few programs need it

        state, tries = dialect.initial_state(self.asked.unit), _TRIES
        lacking = {each[1:] for each in dialect.modes.lexicon.addresses if each.startswith(",")}
        for index, block in enumerate(blocks):
            before, state = state, advance(state, block, dialect.modes)
            # What moves in rapid traverse, or alone, is an axis that turns.
            stated = {word.address for word in block.words if word.address in _MOVING}
            lacking -= stated if len(stated) == 1 or state.motion == 0 else set()
            if not tries or not lacking:
                return
            if lacking & stated:
                tries -= 1
                context = Context(dialect.rules, self.asked.unit, place=block.span)
                found = explain_commas(context, dialect, blocks[index : index + _NEAR], (before, state))
                yield from (each for each in found if each.fixes)

    def _check_block(self, block: Block, here: State | None = None) -> None:
        """Add the findings about a block that is no contour; `here` is the state with its codes in force."""
        if (
            self.dialect
            and _is_clean(block, self.dialect, here)
            and not (here and self.dialect.modes.unread(block, here))
        ):
            return
        context = Context(self.rules, self.asked.unit, place=block.span)
        known = len(self.diagnostics)
        for finding in explain_faults(context, block):
            is_slight = finding.about in _FAULTS_OF_NO_CONSEQUENCE
            self.diagnostics.append(replace(finding, severity=Severity.WARNING) if is_slight else finding)
        self.diagnostics += explain_unmarked(context, block)
        for directive in block.directives:
            place = Context(self.rules, self.asked.unit, place=directive.span)
            self.diagnostics.append(report(place, place.row(ReadIssue.FACT_NOWHERE), Basis.RULE, []))
        self.diagnostics += explain_asked_outside(context, block) if self.dialect else ()
        if self.dialect:
            lexicon = self.dialect.modes.lexicon
            addresses = lexicon.addresses
            axis_words = [word for word in block.words if word.address in addresses and addresses[word.address].axis]
            self.diagnostics += explain_words(context, lexicon, _repeated(axis_words), axis_words)
            self._check_words(context, block, here)
            modes = self.dialect.modes
            if here is not None and len(self.diagnostics) > known and has_corners(block, here, modes):
                found = self.diagnostics[known:]
                self.diagnostics[known:] = explain_corners(context, block.text, found, lexicon, _corner_words())

    def _is_behind_contour(self, modes: Modes) -> bool:
        """Whether the last block that said something has the code of a contour."""
        codes = codes_of(self.previous[0][-1], modes) if self.previous else ()
        return any(not isinstance(code, Word) and code.effect is Effect.CONTOUR for code in codes)

    def _check_words(self, context: Context, block: Block, here: State | None) -> None:
        """The words and codes of a block that the control has not; and that one is not read, which is told once of
        several blocks in a row."""
        dialect = self.dialect
        if dialect is None or here is None or COMMENTED in here.memory:
            return
        modes, signs = dialect.modes, dialect.signs(block)
        found = explain_codes_by_name(context, block, modes)
        # The contour of this block is lost with it.
        self.diagnostics += (replace(each, severity=Severity.ERROR) if signs else each for each in found)
        if (
            moves(block, here, modes, signs)
            or has_corners(block, here, modes)
            or like_corners(block, modes, _corner_words())
        ):
            found = explain_vocabulary(context, block, here, modes, _comma_words())
            # Of the block behind a contour, some controls tell by themselves what its words would have meant there.
            is_said = dialect.follow is not None and self._is_behind_contour(modes)
            self.diagnostics += (each for each in found if not is_said or each.about is not ReadIssue.WORD_IDLE)
        unread = modes.unread(block, here)
        if unread is None:
            return
        last = self.previous[0][-1].words if self.previous else ()
        is_told = unread not in block.words or any(name_of(each) == name_of(unread) for each in last)
        if signs or not is_told:
            self.diagnostics.append(not_read_yet(context, unread, is_needed=bool(signs)))


_ABOUT_VALUES = (ReadIssue.VARIABLE, ReadIssue.POSITION_UNKNOWN)
"""Findings that matter to calculated values alone."""

_OF_ARCS = "IJK"
"""Words that most arcs have."""


def _key_of(block: Block) -> object:
    return block.line, block.text, block.file, block.callers, block.substituted


_USUAL = 10_000
"""A number that is no value too large, in inches neither."""


@cache
def _comma_words() -> frozenset[str]:
    """The words with a comma that any control has."""
    words = (each for dialect in DIALECTS.values() for each in dialect.modes.lexicon.addresses)
    return frozenset(each for each in words if each.startswith(","))


@cache
def _corner_words() -> frozenset[str]:
    """The words that make corners and angles on any control."""
    return frozenset(each for dialect in DIALECTS.values() for each in corner_words(dialect.modes.lexicon))


def _is_clean(block: Block, dialect: Dialect, here: State | None) -> bool:
    """Whether a block has words alone, each once, and all as usual: there is nothing to say then."""
    if block.faults or block.directives or block.unmarked:
        return False
    addresses, modes = [word.address for word in block.words], dialect.modes
    own = {*_OF_ARCS, modes.radius} if here is not None and here.motion in _ARCS else set[str]()
    is_read = all(each in own or is_known(each, modes.lexicon) for each in addresses)
    codes = codes_of(block, modes) if "G" in addresses else ()
    is_read = is_read and all(not isinstance(code, Word) and code.is_read for code in codes)
    is_usual = all(word.number is not None and abs(word.number) <= _USUAL for word in block.words)
    return is_read and is_usual and len({*addresses}) == len(addresses)


def _repeated(words: Sequence[Word]) -> list[Word]:
    seen: set[str] = set()
    return [word for word in words if word.address in seen or seen.add(word.address)]  # type: ignore[func-returns-value]


def _lacks_motion(dialect: Dialect, blocks: Sequence[Block], unit: Length) -> bool:
    """Whether no motion is in force in the first block with a word of the control's contours."""
    state = dialect.initial_state(unit)
    for block in blocks:
        state = advance(state, block, dialect.modes)
        words = dialect.signs(block)
        if words:
            return state.motion is None and all(each.address in dialect.modes.lexicon.addresses for each in words)
    return False
