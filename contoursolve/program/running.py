"""The walk over a program that calls or computes: as it runs, on each of its ways."""

from collections import Counter, deque
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from functools import partial
from itertools import chain
from typing import Any, cast

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer, Context
from contoursolve.diagnostics import Diagnostic
from contoursolve.execution import EventKind, Machine, ProgramEvent
from contoursolve.gcode import Block
from contoursolve.program.calls import arguments_without_point, in_text_order
from contoursolve.program.contour_answers import AnswersInPasses, Learned
from contoursolve.program.cycle_profiles import CycleProfile
from contoursolve.program.examination import Cursor, Examination, tell, tell_rest
from contoursolve.program.lookahead import View
from contoursolve.program.outside_contours import NEAR
from contoursolve.program.request import Request
from contoursolve.program.solve_queue import Pending, Step
from contoursolve.program.tape_markers import Marks
from contoursolve.program.told_outside import Outside
from contoursolve.reading import Paths, State, TakenBlocks, Ways

_OPENING = (EventKind.LOST, EventKind.STOPPED, EventKind.UNDECIDED)
"""Events behind which it is not known what runs, or where the tool is."""


def steps_as_run(
    running: "Running", profiles: list[CycleProfile] | None = None, called: list[Answer] | None = None
) -> Iterator[Step]:
    """Every block and every contour of a program as it runs, on each of its ways, told in the order in which it is
    written. At the end, the profiles of cycles are added to `profiles`, contours of other files to `called`."""
    examination, machine = running.examination, running.machine
    asked, blocks = examination.asked, machine.main.blocks
    outside = Outside(examination.control, is_strict=asked.is_strict)
    told = list[Diagnostic]()
    if asked.is_strict:
        context = Context(asked.rules, asked.unit)
        marks, found = Marks().look(blocks, context)
        told = [*found, *marks.finish(context)]
    told += arguments_without_point(machine, asked)
    deque(running.walk, 0)
    examination.queue.settle()
    yield from in_text_order(
        blocks,
        chain(tell(map(examination.with_arcs, machine.found), outside), tell_rest(outside)),
        machine.passed_over,
        asked,
        told,
        profiles if profiles is not None else [],
        examination.control,
        called if called is not None else [],
    )


class _KeptStep(Struct, frozen=True):
    """A step of so many lines, and the cursor behind it. It rests on so many blocks, one more than there are where it
    rests on the end; on what was known here; and it has added to the answers what was `learned`."""

    step: Step | Pending
    lines: int
    behind: Cursor
    reach: int
    blocks: Sequence[Block] = ()
    ends_at_call: bool = False
    here: Cursor | None = None
    learned: Learned = Learned((), ())


class KeptSteps:
    """The steps of the last run of a program that is edited. A step holds in the next run where the same blocks come in
    the same state, at the same visit of their line."""

    def __init__(self) -> None:
        self._asked: Request | None = None
        self._old: dict[object, _KeptStep] = {}
        self._new: dict[object, _KeptStep] = {}
        self._visits = Counter[object]()

    def begin(self, asked: Request) -> None:
        """Begin a run; what ran before it with other options is forgotten."""
        # A run that was left has not come to all of them.
        self._old = self._old | self._new if asked == self._asked else {}
        self._asked, self._new, self._visits = asked, {}, Counter()

    def take(
        self,
        held: Sequence[Block],
        index: int,
        here: Cursor,
        answers: AnswersInPasses,
        make: Callable[[], _KeptStep | None],
        *,
        ends_at_call: bool,
    ) -> _KeptStep | None:
        """The step at a block: that of the last run where it holds, else the one that is made."""
        block = held[index]
        place = block.file, block.line, block.callers
        self._visits[place] += 1
        key = self._visits[place], place
        found = self._old.get(key)
        if (
            found is None
            or found.here != here
            or found.blocks != held[index : index + found.reach]
            or (found.reach > len(held) - index and found.ends_at_call is not ends_at_call)
            or not answers.recall(found.learned)
        ):
            answers.begin()
            made = make()
            learned = answers.learned()
            if made is None or learned is None:
                return made
            step = made.step.step if isinstance(made.step, Pending) else made.step
            found = replace(made, here=here, blocks=held[index : index + made.reach], learned=learned, step=step)
        self._new[key] = found
        return found


class Running(Ways):
    """One run of a program, made by whoever goes on with its `walk`; what the machine has `found` is complete at its
    end. Ways are followed in turn: the cursor goes from one to the other. Steps that are `kept` of an earlier run are
    not taken again."""

    def __init__(
        self,
        examination: Examination,
        machine: Machine,
        kept: KeptSteps | None = None,
        lines: Iterable[Block | ProgramEvent] | None = None,
    ) -> None:
        begin = examination.begin
        super().__init__(lambda: begin.state, examination.control.modes, self._read)
        self.examination, self.machine, self.cursor = examination, machine, begin
        self.kept = kept
        if kept is not None:
            kept.begin(examination.asked)
        self._last: tuple[Sequence[Block], int] | None = None
        """The blocks that were read last, and the index behind what was taken of them."""
        self._is_at_call = False
        """Whether a call or a return comes behind the blocks that are read."""
        self._lines, self.goes_beyond = lines, lines is None
        self.walk = self._go()

    def _go(self) -> Iterator[Any]:
        yield from self.machine.follow(self.machine.run() if self._lines is None else self._lines, self)
        first = self.examination.control.initial_state(self.examination.asked.unit)
        rest = [*self.examination.end(replace(self.cursor, state=first))]
        self.machine.found += rest
        yield from rest

    def steps(self) -> Iterator[Step | Pending]:
        """The steps, as they are found."""
        return (each for each in self.walk if each is not None)

    def read(self, known: Paths, blocks: Sequence[Block], event: ProgramEvent | None) -> Generator[Any, None, Paths]:
        self._is_at_call = event is not None and event.kind is EventKind.BARRIER
        known = yield from super().read(known, blocks, event)
        if event is not None and event.kind is EventKind.LEAVE:
            # Where the profile of a cycle ended.
            for way in known.ways:
                yield Step((), way.state, findings=self.cursor.findings)
                self.cursor = replace(self.cursor, findings=())
        if event is not None:
            self.cursor = self.examination.happen(event, self.cursor)
        return known

    def _read(self, blocks: Sequence[Block], index: int, state: State, is_open: bool) -> TakenBlocks | None:
        """Take what begins at a block, on the way that has come to it."""
        goes_on = self._last is not None and self._last[0] is blocks and self._last[1] == index
        here = replace(self.cursor, state=state, ahead=self.cursor.ahead if goes_on else ())
        make = partial(self._step, blocks, index, here, is_open=is_open)
        answers = cast("AnswersInPasses", self.examination.answers)
        kept, is_at_call = self.kept, self._is_at_call
        taken = make() if kept is None else kept.take(blocks, index, here, answers, make, ends_at_call=is_at_call)
        if taken is None:
            return None
        self._last, self.cursor = (blocks, index + taken.lines), taken.behind
        return TakenBlocks(taken.lines, self.cursor.state, taken.step)

    def _step(self, held: Sequence[Block], index: int, here: Cursor, *, is_open: bool) -> _KeptStep | None:
        """The step at a block; None where it depends on what comes behind the last one."""
        taken = self.examination.pass_block(held, index, here)
        if taken is not None:
            return _KeptStep(taken.step, taken.lines, taken.behind(), 1 + NEAR)
        view = View(held, index, end_at_call=self._is_at_call)
        found = self.examination.find(view, here.state)
        if is_open and view.reach > len(held) - index:
            return None
        taken = self.examination.take(view, found, here)
        behind = taken.behind()
        return _KeptStep(taken.step, taken.lines, behind, view.reach, ends_at_call=self._is_at_call)


def steps_written_out(
    examination: Examination, machine: Machine, lines: Iterable[Block | ProgramEvent]
) -> Iterator[Step]:
    """The steps of a program as one without calls, in the order of its lines."""
    return examination.told(Running(examination, machine, lines=lines).steps())


def lines_alone(machine: Machine, told: Callable[[ProgramEvent], None]) -> Iterator[Block | ProgramEvent]:
    """The lines of a program as one without calls and jumps; `told` is called where it is not known what runs."""
    for each in machine.run_alone():
        if isinstance(each, ProgramEvent):
            is_unknown = each.kind in _OPENING and not each.is_told
            if is_unknown or (each.kind is EventKind.BARRIER and each.reason):
                told(each)
        yield each
