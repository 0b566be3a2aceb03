"""The walk over a program that calls or computes: as it runs, on each of its ways."""

from collections import Counter, deque
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import chain
from typing import cast

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer, Context
from contoursolve.diagnostics import Diagnostic
from contoursolve.execution import EventKind, Machine, ProgramEvent
from contoursolve.gcode import Block
from contoursolve.program.calls import in_text_order
from contoursolve.program.contour_answers import AnswersInPasses, Learned
from contoursolve.program.cycle_profiles import CycleProfile
from contoursolve.program.examination import Cursor, Examination, tell, tell_rest
from contoursolve.program.lookahead import Line, View
from contoursolve.program.outside_contours import NEAR
from contoursolve.program.request import Request
from contoursolve.program.solve_queue import Pending, Step
from contoursolve.program.tape_markers import Marks
from contoursolve.program.told_outside import Outside
from contoursolve.reading import State, Ways

_OPENING = (EventKind.LOST, EventKind.STOPPED, EventKind.UNDECIDED)
"""Events behind which it is not known what runs, or where the tool is."""


def steps_as_run(
    running: "Running", profiles: list[CycleProfile] | None = None, called: list[Answer] | None = None
) -> Iterator[Step]:
    """Every block and every contour of a program as it runs, on each of its ways, told in the order in which it is
    written. At the end, the profiles of cycles are added to `profiles`, contours of other files to `called`."""
    examination, machine = running.examination, running.machine
    asked, blocks = examination.asked, machine.main.blocks
    outside = Outside(examination.dialect, is_strict=asked.is_strict)
    told = list[Diagnostic]()
    if asked.is_strict:
        context = Context(asked.rules, asked.unit)
        marks, found = Marks().look(blocks, context)
        told = [*found, *marks.finish(context)]
    deque(running.walk, 0)
    examination.queue.settle()
    yield from in_text_order(
        blocks,
        chain(tell(running.found, outside), tell_rest(outside)),
        machine.passed_over,
        asked.rules,
        told,
        profiles if profiles is not None else [],
        examination.dialect.initial_state(asked.unit),
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


class Running:
    """One run of a program, made by whoever goes on with its `walk`; what is `found` is complete at its end. Ways are
    followed in turn: the cursor goes from one to the other. Steps that are `kept` of an earlier run are not taken
    again."""

    def __init__(self, examination: Examination, machine: Machine, kept: KeptSteps | None = None) -> None:
        self.examination, self.machine, self.cursor = examination, machine, examination.begin
        self.kept = kept
        if kept is not None:
            kept.begin(examination.asked)
        self.ways = Ways(lambda: examination.begin.state, examination.dialect.modes)
        self.found: list[Step | Pending] = []
        self._last: tuple[Sequence[Block], int] | None = None
        """The blocks that were read last, and the index behind what was taken of them."""
        self.walk = self._go()

    def _go(self) -> Iterator[None]:
        yield from self.ways.follow(self.machine.run(), self._read, self.found, self._happen)
        first = self.examination.dialect.initial_state(self.examination.asked.unit)
        self.found += self.examination.end(replace(self.cursor, state=first))

    def _read(self, held: Sequence[Block], index: int, state: State, is_open: bool) -> tuple[int, State] | None:
        """Take what begins at a block, on the way that has come to it; see `Ways.follow`."""
        if held[index].mark:
            self.ways.marked[held[index].mark] = state
        goes_on = self._last is not None and self._last[0] is held and self._last[1] == index
        here = replace(self.cursor, state=state, ahead=self.cursor.ahead if goes_on else ())
        make = partial(self._take, held, index, here, is_open=is_open)
        answers = cast("AnswersInPasses", self.examination.answers)
        taken = make() if self.kept is None else self.kept.take(held, index, here, answers, make)
        if taken is None:
            return None
        self._last, self.cursor = (held, index + taken.lines), taken.behind
        self.found.append(taken.step)
        return taken.lines, self.cursor.state

    def _take(self, held: Sequence[Block], index: int, here: Cursor, *, is_open: bool) -> _KeptStep | None:
        """The step at a block; None where it depends on what comes behind the last one."""
        taken = self.examination.pass_block(held, index, here)
        if taken is not None:
            return _KeptStep(taken.step, taken.lines, taken.behind(), 1 + NEAR)
        view = View(held, index)
        found = self.examination.find(view, here.state)
        if is_open and view.reach > len(held) - index:
            return None
        taken = self.examination.take(view, found, here)
        behind = taken.behind()
        return _KeptStep(taken.step, taken.lines, behind, view.reach)

    def _happen(self, event: ProgramEvent) -> bool:
        """Take in an event of the program; whether all that was found since a head is found anew."""
        if event.kind is EventKind.LEAVE:
            # Where the profile of a cycle ended.
            for way in self.ways.now:
                self.found.append(Step((), way.state, findings=self.cursor.findings))
                self.cursor = replace(self.cursor, findings=())
        self.cursor = self.examination.happen(event, self.cursor)
        is_anew = self.ways.happen(event)
        self.machine.settled = self.ways.settled
        return is_anew


def lines_alone(machine: Machine, told: Callable[[ProgramEvent], None]) -> Iterator[Line]:
    """The lines of a program as one without calls and jumps; `told` is called where it is not known what runs."""
    for each in machine.run_alone():
        if isinstance(each, ProgramEvent):
            is_unknown = each.kind in _OPENING and not each.is_told
            if is_unknown or (each.kind is EventKind.BARRIER and each.reason):
                told(each)
            if each.kind is EventKind.HEAD:
                # What is written out runs once.
                continue
        yield each
