"""The walk over a program: a fold over a frozen record of where it stands. Each step takes a contour, a block or plain
lines, and gives what is found there and where the walk stands behind it."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property, partial
from itertools import islice, takewhile
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import (
    Answer,
    Context,
    Depth,
    counts_few,
    explain_call,
    explain_codes_by_name,
    explain_lost,
    lost_points,
    report,
)
from contoursolve.diagnostics import Basis, Diagnostic, Span
from contoursolve.execution import EventKind, ProgramEvent
from contoursolve.gcode import AXES, Block, Blocks, Passage, Word, in_passages, words_of
from contoursolve.program.contour_answers import BEHIND, Answers, AnswersAhead, AnswersInPasses
from contoursolve.program.lookahead import Line, Lookahead, View
from contoursolve.program.named_words import untouched
from contoursolve.program.outside_contours import (
    NEAR,
    findings_of_block,
    findings_of_values,
    with_arcs,
    with_slips,
)
from contoursolve.program.request import Request
from contoursolve.program.solve_queue import Ahead, Pending, Queue, Step, Together
from contoursolve.program.start_point import StartCount, compare_count, start_count, state_before
from contoursolve.program.tape_markers import Marks
from contoursolve.program.told_outside import Outside
from contoursolve.program.windows import further, near
from contoursolve.reading import (
    WAITS,
    Control,
    ParsedContour,
    PlainLines,
    Position,
    ReadIssue,
    State,
    WithoutPoint,
    advance,
    advance_plainly,
    apply_modes,
    is_plain,
    reach_of,
)

if TYPE_CHECKING:
    from contoursolve.diagnosis import WindowPart

_FIRST, _WINDOW = 16, 4_096
"""Steps of a program of which the contours are solved together while it is read: in the beginning, when nothing is
known, and later."""

_WHOLE = 32_768
"""The same for a program that has been read: the more there are of a kind, the less each of them takes."""

_MOST_AWAITED = 16
"""Contours in a row, each of which begins where the one before ends, that are followed and not solved."""


class Cursor(Struct, frozen=True):
    """Place of the walk over a program: the knowledge before one of its blocks."""

    state: State
    marks: Marks
    count: StartCount | None
    """Units in which a start point that is stated apart counts."""
    ahead: Ahead = ()
    """The last contours and blocks that say something, each with the state before it: what is wrong behind them may be
    a slip in them, and with a comma in the next block, the last one may be part of the contour there."""
    told: tuple[Span, ...] = ()
    """Words behind the contour before of which it tells itself."""
    findings: tuple[Diagnostic, ...] = ()
    """Findings since the last step, told with the next one."""


class Beginning(Struct, frozen=True):
    """Contour that begins at a block, or what is read as one is, if there is either; and the number of its lines."""

    contour: ParsedContour | None
    lines: int


class WalkStep(Struct, frozen=True):
    """One step of the walk: what is found, of how many lines, and what gives the cursor behind it."""

    step: Step | Pending
    lines: int
    behind: Callable[[], Cursor]


class Examination:
    """The walk over one program of a control. Its contours are solved one by one, or `together`; if it `goes_on`, those
    behind one that is refused are checked from where its best fix ends. A program that `is_run` may come to a line
    again and again; one `is_ahead` that is followed, and not examined. Where one `is_called`, the program that calls it
    says which offsets and shifts are in force."""

    def __init__(
        self,
        asked: Request,
        control: Control,
        together: Together | None = None,
        *,
        goes_on: bool = False,
        is_run: bool = False,
        is_ahead: bool = False,
        is_called: bool = False,
    ) -> None:
        self.asked, self.control = asked, control
        answers = AnswersInPasses if is_run else AnswersAhead if is_ahead else Answers
        self.answers = answers(asked, control, self._parts)
        self.queue = Queue(control, together, self.answers, goes_on=goes_on)
        self._context = Context(asked.rules, asked.unit)
        self._plain = PlainLines(control.modes, has_points=asked.is_strict)
        """The lines of which nothing is told: of a number without a point, it may be."""
        state, found = state_before(asked, control)
        state = replace(state, zero={}) if is_called else state
        # A program that runs is not read in its order, in which a % stands.
        self.begin = Cursor(state, Marks(is_done=is_run), start_count(asked, state), findings=found)
        """The cursor before the program, behind the block that states its start point apart."""

    @cached_property
    def _trial(self) -> "Examination":
        """The walk over blocks that are tried."""
        return Examination(replace(self.asked, depth=Depth.TRIAL, start=None, facts=()), self.control)

    def _parts(self, blocks: Sequence[Block], state: State, ahead: Ahead) -> "Iterator[WindowPart]":
        """Blocks from a state on, with what is ahead of them, as they are examined, without what is said of what is
        wrong."""
        from contoursolve.diagnosis import WindowPart  # noqa: PLC0415 - most programs need no diagnosis

        cursor = Cursor(state, Marks(is_done=True), None, ahead)
        for step, reach, behind in self._trial.resume(blocks, 0, cursor):
            yield WindowPart(step.blocks, step.before, behind.state, reach, step.findings, step.answer)

    # One step ----------------------------------------------------------------------------------------------------

    def find(self, view: View, state: State) -> Beginning:
        """The contour, or the block alone, that begins with the first of some blocks."""
        contour = self.control.find(view, 0, state, self.control.modes)
        return Beginning(contour, reach_of(contour, view)) if contour is not None else Beginning(None, 1)

    def take(self, view: View, found: Beginning, cursor: Cursor) -> WalkStep:
        """The step that takes what was found at the first of some blocks."""
        lost = self._lost_point(view, found, cursor)
        if lost is not None:
            at, word = lost
            view.blocks[at] = view[at].with_points([word])
            found = self.find(view, cursor.state)
        blocks = (view[0],) if found.lines == 1 else tuple(view[: found.lines])
        marks, outside = cursor.marks.look(blocks, self._context)
        count, differences = compare_count(cursor.count, found.contour, self.asked)
        found_before = (*cursor.findings, *outside, *differences)
        here = Cursor(cursor.state, marks, count, cursor.ahead, cursor.told, found_before)
        if found.contour is not None and found.contour.form.is_contour:
            return self._take_contour(view, blocks, found.contour, here, lost[1] if lost else None)
        return self._take_block(view, blocks, found.contour, here, lost[1] if lost else None)

    def _lost_point(self, view: View, found: Beginning, cursor: Cursor) -> tuple[int, Word] | None:
        """The word of what was found that has lost its point, with the place of its block; None for none."""
        modes, blocks = self.control.modes, view[: found.lines]
        if modes.lexicon.numbers.without_point is not WithoutPoint.LEAST_INCREMENTS:
            return None
        if not any(counts_few(word, modes.lexicon) for block in blocks for word in block.words if word.address in AXES):
            return None
        ahead = [block for each in reversed([*near(cursor.ahead)]) for block in each]
        around = [*ahead, *view[: found.lines + NEAR]]
        lost = lost_points(blocks, around, modes) if not cursor.state.is_incremental else []
        read = [word for word in lost if word.address in modes.lexicon.addresses]
        return next(((at, word) for at, block in enumerate(blocks) for word in read if word in block.words), None)

    def _explain_lost(self, word: Word, blocks: Sequence[Block], state: State) -> Diagnostic:
        """That a word of some blocks has lost its point."""
        context = Context(self.asked.rules, self.asked.unit, place=blocks[0].span)
        return explain_lost(context, word, blocks, self.control.modes, state.unit)

    def _take_contour(
        self, view: View, blocks: tuple[Block, ...], contour: ParsedContour, here: Cursor, lost: Word | None
    ) -> WalkStep:
        """The step that takes a contour, which is solved now or later; it is read with the point of a word that has
        `lost` it."""
        strange = [each for block in blocks for each in self._codes_beside(block, contour)]
        step = Step(blocks, here.state, findings=(*here.findings, *strange))
        told = self._explain_lost(lost, contour.blocks, here.state) if lost is not None else None
        pending = Pending(contour, step, view, len(blocks), here.ahead, told)
        self.queue.add(pending)

        def behind() -> Cursor:
            told = tuple(word.span for word in contour.unread if word.span.line > blocks[-1].line)
            ahead = further(here.ahead, blocks, here.state)
            return Cursor(self.queue.leave(pending), here.marks, here.count, ahead, told)

        return WalkStep(pending, len(blocks), behind)

    def _codes_beside(self, block: Block, contour: ParsedContour) -> Iterator[Diagnostic]:
        """The codes in a block of a contour that the control has not, but for those of which the contour tells."""
        rows = self.control.modes.codes
        if all(word.address != "G" or (word.number is not None and word.number in rows) for word in block.words):
            return
        told = {word.span for word in contour.unread}
        context = Context(self.asked.rules, self.asked.unit, place=block.span)
        for each in explain_codes_by_name(context, block, self.control.modes):
            if each.span not in told and each.about is ReadIssue.CODE_UNKNOWN:
                yield each

    def _take_block(
        self, view: View, blocks: tuple[Block, ...], read: ParsedContour | None, here: Cursor, lost: Word | None
    ) -> WalkStep:
        """The step that takes a block that is no contour, though it may be `read` as one is; where it leads is not
        known if a word has `lost` its point."""
        block, asked, modes = blocks[0], self.asked, self.control.modes
        states = here.state, advance(here.state, block, modes)
        if read is not None:
            pending = Pending(read, Step((), here.state), view, len(blocks))
            findings = (*here.findings, *findings_of_values(pending, self.answers.examine))
        else:
            found = findings_of_block(asked, block, apply_modes(here.state, block, modes), here.ahead)
            told_of = [*here.findings, *(each for each in found if each.span not in here.told)]
            findings = untouched(with_slips(asked, view, states, here.ahead, told_of, self._parts), blocks, asked)
        ahead = further(here.ahead, blocks, here.state) if block.words else here.ahead
        told = tuple(span for span in here.told if span.line > block.line)
        behind = Cursor(states[1], here.marks, here.count, ahead, told)
        if lost is not None:
            findings = (self._explain_lost(lost, blocks[:1], here.state), *findings)
            behind = replace(behind, state=_lost_at(states[1], lost, modes.lexicon.addresses[lost.address].axis))
        return WalkStep(Step(blocks, here.state, findings=findings), len(blocks), lambda: behind)

    def pass_block(self, blocks: Sequence[Block], index: int, cursor: Cursor) -> WalkStep | None:
        """The step that takes a plain line, if it makes no contour with others: what moves behind it is plain, too."""
        block, modes = blocks[index], self.control.modes
        if block.callers or not is_plain(cursor.state, modes) or not self._plain.has(block.text):
            return None
        begins, behind = modes.syntax.plain.begins, blocks[index + 1 : index + 1 + NEAR]
        for each in takewhile(lambda each: self._plain.has(each.text), behind):
            if begins.search(words_of(each.text, modes.syntax)):
                taken = self.pass_by(Passage(block.line, f"{block.text}\n", 1, modes.syntax), cursor)
                return replace(taken, step=Step((block,), cursor.state, findings=cursor.findings))
        return None

    def pass_by(self, passage: Passage, cursor: Cursor) -> WalkStep:
        """The step that takes plain lines that nobody needs to read into words."""
        marks, outside = cursor.marks.look((passage,), self._context)
        step = Step((), cursor.state, findings=cursor.findings + outside, passage=passage)

        def behind() -> Cursor:
            state = advance_plainly(cursor.state, passage, self.control.modes)
            told = tuple(span for span in cursor.told if span.line >= passage.line + passage.count)
            return Cursor(state, marks, cursor.count, further(cursor.ahead, passage, cursor.state), told)

        return WalkStep(step, passage.count, behind)

    def happen(self, event: ProgramEvent, cursor: Cursor) -> Cursor:
        """The cursor behind an event of the program, with what is found there; its state is that before the event."""
        context = Context(self.asked.rules, self.asked.unit, place=Span(event.line, 1, 2))
        found = (*cursor.findings, *_findings_of_event(event, context, self.control))
        count = self.begin.count if event.kind is EventKind.FRESH else cursor.count
        return Cursor(cursor.state, cursor.marks, count, findings=found)

    def end(self, cursor: Cursor) -> Iterator[Step]:
        """The last step of a program, with the findings at its end, if there are any."""
        found = cursor.findings + cursor.marks.finish(self._context)
        if found:
            yield Step((), cursor.state, findings=found)

    # All of them -------------------------------------------------------------------------------------------------

    def walk(self, lines: Iterable[Line], cursor: Cursor | None = None) -> Iterator[tuple[Step | Pending, Cursor]]:
        """Every block and every contour from a cursor, or from the beginning, in order, contours as they are found; and
        the cursor before each."""
        cursor, ahead = cursor or self.begin, Lookahead(lines)
        while ahead.line is not None:
            taken = self._next(ahead, cursor)
            if taken is None:
                ahead.read_on()
                continue
            yield taken.step, cursor
            cursor = taken.behind()
            ahead.go_on(taken.lines)
        yield from ((step, cursor) for step in self.end(cursor))

    def follow(self, lines: Blocks, cursor: Cursor) -> Iterator[tuple[Step, Cursor]]:
        """The same of one `is_ahead`, without answers: a contour is solved where somebody asks for its end, as few do.
        Raises TooFarError, and so does who asks."""
        self.queue.together = _OneByOne()
        for step, before in self.walk(self._passages(lines), cursor):
            yield step.step if isinstance(step, Pending) else step, before
            # Who asks for the end of the last one of many in a row asks for all of them, one in another.
            if isinstance(step, Pending) and step.wave >= _MOST_AWAITED:
                self.queue.settle()
            self.queue.pending = []

    def _next(self, ahead: Lookahead, cursor: Cursor) -> WalkStep | None:
        """The step at the next line; None where it depends on lines that are not read yet."""
        if isinstance(ahead.line, Passage):
            passage = ahead.plain(moves=is_plain(cursor.state, self.control.modes), joins=self.control.has_runs)
            if passage is not None:
                return self.pass_by(passage, cursor)
        view = ahead.view()
        if not ahead.is_whole and not view.holds(1 + NEAR):
            return None
        found = self.find(view, cursor.state)
        # Nothing goes on at a block that says nothing; else that is known at the next block that says something.
        ends = found.contour is None and not view[0].says_something
        is_known = ahead.is_whole or ends or (view.says_something(found.lines) and view.holds(found.lines + BEHIND))
        return self.take(view, found, cursor) if is_known else None

    def steps(self, lines: Iterable[Line]) -> Iterator[Step]:
        """The same with all contours solved, and with those findings outside contours that are told. Plain lines of
        blocks that are not kept are not read."""
        is_whole = isinstance(lines, Sequence) and not isinstance(lines, Blocks)
        walk = self.walk(self._passages(lines) if isinstance(lines, Blocks) else lines)
        return self.told((step for step, _ in walk), is_whole=is_whole)

    def told(self, steps: Iterator[Step | Pending], *, is_whole: bool = False) -> Iterator[Step]:
        """Steps with all contours solved, and with those findings outside contours that are told."""
        outside = Outside(self.control, is_strict=self.asked.is_strict)
        size, most = (_WHOLE, _WHOLE) if is_whole else (_FIRST, _WINDOW)
        if self.queue.together is None:
            size, most = 1, 1
        while window := [*islice(steps, size)]:
            self.queue.settle()
            yield from tell(map(self.with_arcs, window), outside)
            size = min(2 * size, most)
        yield from tell_rest(outside)

    def with_arcs(self, step: Step | Pending) -> Step:
        """A step that is solved, with the findings about its arcs."""
        own = step.step if isinstance(step, Pending) else step
        return own if self.asked.depth is Depth.TRIAL else with_arcs(self.asked, self.control, own)

    def _passages(self, lines: Blocks) -> Iterator[Block | Passage]:
        return self._plain.among(in_passages(lines))

    def resume(self, blocks: Sequence[Block], index: int, cursor: Cursor) -> Iterator[tuple[Step, int, Cursor]]:
        """The steps of a program that is at hand from a block on, one by one, each with the number of lines from its
        first one on that it rests on, one more than there are where it rests on the end; and the cursor behind it.
        Contours are not solved together."""
        while index < len(blocks):
            view = View(blocks, index)
            taken = self.take(view, self.find(view, cursor.state), cursor)
            cursor, index = taken.behind(), index + taken.lines
            yield self.with_arcs(taken.step), view.reach, cursor


def _lost_at(state: State, word: Word, axis: str) -> State:
    """A state whose place along an axis follows from a word that has lost its point."""
    place = state.axes[axis]
    reason = f"{WAITS} program line {word.span.line}, where {word.text.strip()} has no decimal point"
    return state.move({axis: Position(None, reason, word.span, place.is_skippable, None, place.value)})


class _OneByOne:
    """Solves each contour by itself, none before it is asked for."""

    def solve(self, _: Sequence[ParsedContour], examine: Sequence[Callable[[], Answer]]) -> list[Answer]:
        """The answers to contours whose start is known."""
        return [each() for each in examine]


def _findings_of_event(event: ProgramEvent, context: Context, control: Control) -> Iterator[Diagnostic]:
    """Findings about what happens between two blocks."""
    if event.kind in (EventKind.STOPPED, EventKind.MAY_STOP):
        stopped = report(context, context.row(ReadIssue.NOT_FOLLOWED), Basis.RULE, [], reason=event.reason)
        help_ = "write the block or the label; where it jumps, the control stops"
        yield replace(stopped, help=help_) if event.kind is EventKind.MAY_STOP else stopped
    if event.kind is EventKind.REFUSED:
        yield report(context, context.row(ReadIssue.VARIABLE_REFUSED), Basis.RULE, [], reason=event.reason)
    if event.kind is EventKind.READ_AS:
        yield report(context, context.row(ReadIssue.COMPARISON_LAST), Basis.RULE, [], meant=event.reason)
    if event.unread:
        yield report(context, context.row(ReadIssue.NOT_READ), Basis.RULE, [], name=event.unread)
    if event.called:
        yield from explain_call(context, event.called, control)


# What is told ----------------------------------------------------------------------------------------------------


def tell(steps: Iterable[Step | Pending], outside: Outside) -> Iterator[Step]:
    """Some steps in a row, solved, with those findings outside contours that are told."""
    for each in steps:
        step = each.step if isinstance(each, Pending) else each
        held: Sequence[Line] = [step.passage] if step.passage else step.blocks
        line = held[0].line if held else 0
        told = tuple(outside.take(step.findings, line, partial(iter, held), step.answer, step.before))
        yield step if told == step.findings else replace(step, findings=told)


def tell_rest(outside: Outside) -> Iterator[Step]:
    """The last step, with what waited for the end of the program."""
    rest, before = outside.rest()
    if rest and before is not None:
        yield Step((), before, findings=rest)
