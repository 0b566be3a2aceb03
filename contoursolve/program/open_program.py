"""A program that is open in an editor: after each edit only what depends on it is examined again.

The program is held in parts, each with what was known before it and how far it looked ahead. An edit makes those stale
that it touches or that looked at it. Examination goes on from the first stale part until it knows the same as an old
part did at the same place; from there on, the old parts hold.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import accumulate, chain, islice, takewhile
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls import ControlName
from contoursolve.diagnosis import Answer, Context, Policy, rank
from contoursolve.diagnostics import Diagnostic, Span, choice_of
from contoursolve.execution import ProgramKind, kind_of, needs_running, says_end, surroundings_of
from contoursolve.gcode import ISO, Block, Blocks, Program, Syntax
from contoursolve.geometry import Length
from contoursolve.program.contour_answers import TooFarError
from contoursolve.program.examination import Cursor, Examination
from contoursolve.program.named_words import has_named, is_named_for_all
from contoursolve.program.no_contour import conclusions, nothing_to_solve
from contoursolve.program.open_lines import OpenLines, Place, Splice
from contoursolve.program.pipeline import Result, Run, frame_of
from contoursolve.program.renumbering import renumbered
from contoursolve.program.request import Request, Rules, Units
from contoursolve.program.running import KeptSteps
from contoursolve.program.solve_queue import Step
from contoursolve.program.told_control import ToldControl
from contoursolve.program.told_outside import Outside
from contoursolve.reading import Control

_LONGEST = 16
"""Lines of a part without contours and findings."""

_MOST_RENEWED = 16
"""Contours on lines that have moved that are found anew one by one; more are solved together."""

_MOST_MOVES = 64
"""Edits that moved lines that are kept, before all parts are brought up to date with them."""


class OpenContour(Struct, frozen=True):
    """A contour of an open program.

    Attributes:
        first: its first line as it is now, from 1.
        last: its last line, likewise.
        answer: its answer. It may be older: its own lines are those at which it was found (see
            `OpenProgram.contour_at`).
    """

    first: int
    last: int
    answer: Answer


@dataclass(slots=True)
class _Part:
    """Some lines in a row: one contour, or blocks that are none. The last part has no lines."""

    known: Cursor
    """State and findings before the part."""
    count: int
    reach: int = 1
    """Number of lines, from its first one on, on which it rests."""
    answer: Answer | None = None
    beside: tuple[Diagnostic, ...] = ()
    """Findings that are not about the contour."""
    findings: tuple[Diagnostic, ...] = ()
    """Findings about the contour."""
    age: int = 0
    """Number of moves that it knows of, and of moves that its answer knows of."""
    answer_age: int = 0
    is_stale: bool = False


@dataclass(frozen=True, slots=True)
class _Move:
    """All lines from one on are so many lines further down."""

    first: int
    by: int

    def line(self, line: int) -> int:
        return line + self.by if line >= self.first else line

    def place(self, span: Span) -> Span:
        return span._replace(line=self.line(span.line)) if span.line >= self.first else span


class OpenProgram:
    """A program that is open in an editor: its contours and findings follow every edit.

    They are those that `solve` finds in the text as it is, once `check` has returned True.

    >>> program = OpenProgram("G00 X40. Z0.\\nG111 X100. A180. K-30. B120. P60.")
    >>> program.check(), [each.code for each in program.diagnostics]
    (True, ['g111-corner-too-large'])
    >>> program.edit((2, 30), (2, 34), "P5.")
    >>> program.check(), program.diagnostics
    (True, ())
    """

    def __init__(
        self,
        text: str = "",
        *,
        control: ControlName | Control | None = None,
        units: Units = "mm",
        rules: Rules = "enforce",
        settings: Mapping[str, str] | None = None,
        name: str = "<program>",
    ) -> None:
        """Arguments as for `solve`; but what a comment in the program states counts more than `settings`."""
        self.name = name
        self._asked = Request(None, choice_of(Length, units, "units"), choice_of(Policy, rules, "rules"))
        self._lines = OpenLines(text)
        self._control = ToldControl(self._lines, name, self._asked)
        self._parts: list[_Part] = []
        self._moves: list[_Move] = []
        self._walk: Iterator[None] | None = None
        self._ahead: tuple[int, Step, Cursor, Iterator[tuple[Step, Cursor]]] | None = None
        """How far the program is followed: a line, the step and the cursor there, and what goes on."""
        self._looked: dict[tuple[int, int], bool] = {}
        """The lines that are examined before their turn, or that were to be."""
        self._seeds: list[_Part] = []
        """The parts of these."""
        self._is_looking = False
        self._diagnostics: tuple[Diagnostic, ...] | None = None
        self._examination: Examination | None = None
        self._unread: Result | None = None
        """What is found where no control is known, or in a program that runs."""
        self._kept = KeptSteps()
        """What is kept of it for the next run."""
        self._control.configure(control, settings or {})
        self._begin()

    def copy(self) -> "OpenProgram":
        """The same text with the same options, examined by itself."""
        own, asked = self._control, self._asked
        told: dict[str, Any] = {"control": own.named, "units": asked.unit.value, "rules": asked.policy.value}
        return OpenProgram(self.text, settings=own.settings, name=self.name, **told)

    @property
    def control(self) -> Control | None:
        """The control; None where nothing tells it."""
        return self._control.control

    @property
    def is_stated(self) -> bool:
        """Whether a comment in the program states it."""
        return self._control.is_stated

    @property
    def trouble(self) -> str:
        """The reason for which the control cannot be told, if it cannot."""
        return self._control.trouble

    @property
    def is_ambiguous(self) -> bool:
        """Whether that is because the program may be for several."""
        return self._control.is_ambiguous

    @property
    def syntax(self) -> Syntax:
        """Syntax of its blocks: that of its control, or ISO 6983 if the control is not known."""
        return self.control.modes.syntax if self.control is not None else ISO

    @property
    def text(self) -> str:
        """The program as it is now."""
        return self._lines.text

    @property
    def blocks(self) -> Sequence[Block]:
        """Its blocks, each read when it is looked at; after the end of the last line is one more."""
        return self._lines

    def line(self, number: int) -> str:
        """The text of a line, without its end; empty where there is none."""
        return self._lines.line(number)

    @property
    def line_end(self) -> str:
        """The end of its first line; a line feed if that line has no end."""
        return self._lines.line_end

    def changes_to(self, text: str) -> Iterator[tuple[Place, Place, str]]:
        """The edits by whole lines, each as `edit` takes it, that make another text of the program; places are those
        before any of them."""
        return self._lines.changes_to(text)

    def edits_of(self, changes: Mapping[int, str | None]) -> Iterator[tuple[Place, Place, str]]:
        """The edits, each as `edit` takes it, that write other texts for lines, with a line feed between several, or
        take lines out (None): each from the first character that differs to the last one. Places are those before."""
        return self._lines.edits_of(changes)

    @property
    def unit(self) -> str:
        """The unit of numbers before any code that says it."""
        return self._asked.unit.value

    @property
    def request(self) -> Request:
        """The options of its examination, with its control."""
        return replace(self._asked, control=self.control, around=surroundings_of(self.name))

    def configure(self, control: ControlName | Control | None, settings: Mapping[str, str]) -> None:
        """Read the program as one for this control (None: as it shows), with these settings."""
        if (control, dict(settings)) != (self._control.named, self._control.settings):
            self._control.configure(control, settings)
            self._begin()

    def replace(self, text: str) -> None:
        """Put another text in the place of the whole."""
        self._follow_change(self._lines.replace(text))

    def edit(self, begin: Place, end: Place, text: str) -> None:
        """Put a text in the place of what stands from one place to another, the second one not included. A place after
        the end of a line, or of the program, is that end."""
        self._follow_change(self._lines.edit(begin, end, text))

    def _follow_change(self, change: Splice | None) -> None:
        """Make stale what rests on lines that have changed."""
        if change is None:
            return
        self._forget()
        is_another = self._control.follow(change)
        is_run = self.control is not None and (
            self._examination is None
            or needs_running(change.come, self.control.modes.language)
            or says_end((*change.gone, *change.come), self.control.modes.language)
            or any(map(has_named, change.come))
        )
        if is_another or is_run:
            self._begin()
        else:
            gone = len(change.gone)
            self._make_stale(change.first, change.first + gone, len(change.come) - gone)

    def _begin(self) -> None:
        """Make everything stale."""
        self._forget()
        self._parts, self._moves, self._examination = [], [], None
        self._lines.spell(self.syntax)
        # A program that calls or computes is examined as a whole, or that names words for all of it.
        if (
            self.control is not None
            and (kind := kind_of(self._lines.texts, self.control.modes.language)) is not ProgramKind.FOLLOWED
            and not any(map(is_named_for_all, (self._lines[at] for at in self._marked_lines())))
        ):
            asked, self._kept = replace(self._asked, control=self.control), KeptSteps()
            is_called = kind is ProgramKind.FOR_CALLS
            self._examination = Examination(asked, self.control, goes_on=True, is_called=is_called)
            known = self._examination.begin
            self._parts = [_Part(known, len(self._lines), is_stale=True), _Part(known, 0)]

    def _forget(self) -> None:
        """Leave what was begun with another text."""
        self._diagnostics = self._walk = self._unread = self._ahead = None
        for part in self._seeds:
            part.is_stale = True
        self._looked, self._seeds, self._is_looking = {}, [], False

    def _marked_lines(self) -> Iterator[int]:
        """The indices of the lines that may name words."""
        return (at for at, line in enumerate(self._lines.texts) if has_named(line))

    def _make_stale(self, first: int, last: int, more: int) -> None:
        """The lines from an index to another are others now, and so many more."""
        parts = self._parts
        starts = [*accumulate((part.count for part in parts), initial=0)]
        # The parts that have changed lines; none where new lines are put between two of them.
        begin = bisect_right(starts, first) - 1
        end = max(bisect_left(starts, last), begin + 1)
        if first == last and starts[begin] == first:
            begin = end = bisect_left(starts, first)
        held = parts[begin]
        changed = _Part(held.known, sum(part.count for part in parts[begin:end]) + more, age=held.age, is_stale=True)
        for part, start in zip(parts[:begin], starts, strict=False):
            if start + part.reach > first:
                part.is_stale = True
        parts[begin:end] = [changed]
        if more:
            self._moves.append(_Move(last + 1, more))

    def check(self, most: int | None = None) -> bool:
        """Go on examining what is stale, so many blocks and contours of it or all; whether everything is up to date."""
        walk, self._walk, self._diagnostics = self._walk or self._examine(), None, None
        if sum(1 for _ in islice(walk, most)) == most:
            self._walk = walk
            return False
        return True

    @property
    def examined(self) -> int:
        """The number of lines, from the first one on, of which all is up to date."""
        if self._examination is None:
            return 0 if self._unread is None else len(self._lines)
        return sum(part.count for part in takewhile(lambda part: not part.is_stale, self._parts))

    def is_examined(self, first: int, last: int) -> bool:
        """Whether all is up to date from one line to another."""
        looked = (lines for lines, is_done in self._looked.items() if is_done)
        return any(begin <= first and last <= end for begin, end in looked) or self.examined >= last

    def look(self, first: int, last: int) -> None:
        """Have `check` examine these lines before all others, unless it is under way to some: the program is followed
        up to them, which takes less than to examine it. One that runs is examined as it runs."""
        is_new = not self._is_looking and (first, last) not in self._looked
        if self._examination is not None and is_new and not self.is_examined(first, last):
            self._walk, self._is_looking = chain(self._look(first, last), self._examine()), True

    def _look(self, first: int, last: int) -> Iterator[None]:
        """Follow the program up to some lines, and examine them."""
        self._looked[first, last] = False
        try:
            if self._examination is not None:
                yield from self._examine_ahead(self._examination, first, last)
                self._looked[first, last] = True
        except TooFarError:
            self._ahead = None
        self._is_looking = False

    def _examine_ahead(self, examination: Examination, first: int, last: int) -> Iterator[None]:
        line, known = yield from self._follow(first, examination)
        index = begin = self._split(line - 1, known)
        for step, reach, behind in examination.resume(self._lines, line - 1, known):
            # What is told here may ask where the tool is, and nobody is to wait for that then.
            known.state.known()
            index += self._take(index, begin, step, reach, known)
            self._seeds.append(self._parts[index - 1])
            line, known = line + len(step.blocks), behind
            yield
            if line > last:
                return

    def _follow(self, wanted: int, examination: Examination) -> Generator[None, None, tuple[int, Cursor]]:
        """The first line of what is on a line, and the cursor before it, from where the program is followed to, or else
        from its first stale part on."""
        if self._ahead is None or self._ahead[0] > wanted:
            index = next(at for at, part in enumerate(self._parts) if part.is_stale)
            self._bring_up(self._parts[index])
            first, known = sum(part.count for part in self._parts[:index]), self._parts[index].known
            rest = Blocks("".join(self._lines.texts[first:]), first + 1, self._lines.syntax)
            walk = Examination(examination.asked, examination.control, goes_on=True, is_ahead=True).follow(rest, known)
            self._ahead = first + 1, *next(walk), walk
        while True:
            line, step, known, walk = self._ahead
            count = step.passage.count if step.passage is not None else len(step.blocks)
            found = next(walk, None) if line + count <= wanted else None
            if found is None:
                break
            self._ahead = line + count, *found, walk
            yield
        if step.passage is not None and line < wanted:
            passed = examination.pass_by(step.passage.part(0, wanted - line), known)
            return wanted, passed.behind()
        return line, known

    def _split(self, first: int, known: Cursor) -> int:
        """The index of the part that begins at the index of a line, where this is known."""
        starts = [*accumulate((part.count for part in self._parts), initial=0)]
        index = bisect_left(starts, first)
        if starts[index] != first:
            index -= 1
            cut = self._parts[index]
            behind = _Part(known, starts[index + 1] - first, age=len(self._moves), is_stale=True)
            cut.count, cut.is_stale = first - starts[index], True
            self._parts.insert(index + 1, behind)
            index += 1
        return index

    def _examine(self) -> Iterator[None]:
        """Examine each stale part and what follows from it, step by step. Wherever this stops, the parts together are
        the whole program."""
        examination, parts = self._examination, self._parts
        if examination is None:
            if self._unread is None:
                whole = Run(self._program(), self.request, kept=self._kept)
                yield from whole.ahead()
                self._unread = whole.collect()
            return
        while (index := next((at for at, part in enumerate(parts) if part.is_stale), -1)) >= 0:
            line = sum(part.count for part in parts[:index])
            self._bring_up(parts[index])
            known, begin = parts[index].known, index
            walk = examination.resume(self._lines, line, known)
            while parts[index].count or parts[index].is_stale:
                here = parts[index]
                if not here.count:
                    del parts[index]
                    continue
                if not here.is_stale:
                    self._bring_up(here)
                    if here.known == known:
                        break
                here.is_stale, here.known, here.age = True, known, len(self._moves)
                yield
                step, reach, behind = next(walk)
                index += self._take(index, begin, step, reach, known)
                line, known = line + len(step.blocks), behind
            else:
                parts[index].known, parts[index].age = known, len(self._moves)
        if len(self._moves) > _MOST_MOVES:
            for part in parts:
                self._bring_up(part)
                part.age, part.answer_age = 0, part.answer_age - len(self._moves)
            self._moves = []

    def _take(self, index: int, begin: int, step: Step, reach: int, known: Cursor) -> int:
        """Put a step in the place of the parts at an index; how many parts more there are before what is behind it."""
        parts, left, now = self._parts, len(step.blocks), len(self._moves)
        while left:
            part = parts[index]
            if part.count <= left:
                left -= part.count
                del parts[index]
            else:
                part.count, part.is_stale, left = part.count - left, True, 0
        before = parts[index - 1] if index > begin else None
        if step.answer is None and not step.findings and before is not None and _is_plain(before):
            before.reach = max(before.reach, before.count + reach)
            before.count += len(step.blocks)
            return 0
        findings = step.answer.diagnostics if step.answer else ()
        new = _Part(known, len(step.blocks), reach, step.answer, step.findings, findings, now, now)
        parts.insert(index, new)
        return 1

    def _bring_up(self, part: _Part) -> None:
        """Bring what a part knows, and its findings, up to date with the lines that have moved."""
        for move in self._moves[part.age :]:
            part.known = renumbered(part.known, move)
            part.beside, part.findings = renumbered(part.beside, move), renumbered(part.findings, move)
        part.age = len(self._moves)

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """All findings, in the order of the program; those that are known until `check` has returned True."""
        if self._diagnostics is None:
            self._diagnostics = tuple(sorted((finding for finding, _ in self.found()), key=rank))
        return self._diagnostics

    def found(self) -> Iterator[tuple[Diagnostic, tuple[int, ...]]]:
        """Each finding, with the lines that its fixes replace."""
        if self._examination is None:
            if (whole := self._unread) is not None:
                yield from ((finding, whole.lines_of(finding)) for finding in whole.diagnostics)
            return
        asked = self._examination.asked
        yield from ((each, (each.span.line,)) for each in conclusions(asked, self._lines))
        parts, outside, begin = self._parts, Outside(self.control), 0
        starts = [*accumulate((part.count for part in parts), initial=0)]
        is_told = any(part.answer is not None for part in parts)
        for index, part in enumerate(parts):
            if not (part.beside or part.findings or (part.answer is not None and outside.is_waiting)):
                continue
            self._bring_up(part)
            # What lies between says nothing, and nothing before it waits for it.
            contour = next((at for at in range(index - 1, begin - 1, -1) if parts[at].answer is not None), -1)
            between = partial(self._lines.between, starts[max(contour + 1, begin)], starts[index])
            outside.pass_by(starts[contour] + 1 if contour >= 0 else 0, between)
            begin, start = index + 1, starts[index]
            blocks = partial(self._lines.between, start, start + part.count)
            for finding in outside.take(part.beside, start + 1, blocks, part.answer, part.known.state):
                is_told = is_told or finding.is_error
                yield finding, (finding.span.line,)
            if part.findings and part.answer is not None:
                lines = part.answer.lines
                now = tuple(line - lines[0] + start + 1 for line in lines)
                yield from ((finding, now) for finding in part.findings)
        if any(part.is_stale for part in parts):
            # Nothing is known of the end.
            return
        start, last = starts[-1], parts[-1]
        self._bring_up(last)
        beside = outside.take(
            last.known.marks.finish(Context(asked.rules, asked.unit)), start, tuple, None, last.known.state
        )
        yield from ((finding, (finding.span.line,)) for finding in beside)
        if not is_told:
            finding = nothing_to_solve(asked, self._lines)
            yield finding, (finding.span.line,)

    def _program(self) -> Program:
        """The program with its blocks as they are."""
        blocks = tuple(self._lines[: len(self._lines) - (self._lines.texts[-1] == "")])
        return Program(self.name, self.text, blocks, self._lines.syntax)

    def result(self) -> Result:
        """The program with all that is found in it, once `check` has returned True."""
        if self._examination is None or self.control is None:
            return self._unread or frame_of(self._program(), self.request)
        from contoursolve.program.batch import Batch  # noqa: PLC0415 - an editor asks for findings alone

        asked, now = self._examination.asked, len(self._moves)
        program = self._program()
        parts = [part for part in self._parts if part.answer is not None]
        if sum(part.answer_age != now for part in parts) > _MOST_RENEWED:
            together = Batch(self.control, asked.policy, is_proven=True)
            for part, answer in zip(parts, Run(program, asked, together).collect().answers, strict=True):
                part.answer, part.answer_age = answer, now
        starts = accumulate((part.count for part in self._parts), initial=0)
        answers = (self._answer_of(part, start) for part, start in zip(self._parts, starts, strict=False))
        found = tuple(filter(None, answers))
        return replace(frame_of(program, asked), answers=found, diagnostics=self.diagnostics)

    @property
    def contours(self) -> Iterator[OpenContour]:
        """The contours, in the order of the program."""
        if self._examination is None:
            answers = self._unread.answers if self._unread else ()
            yield from (OpenContour(each.lines[0], each.lines[-1], each) for each in answers)
            return
        start = 0
        for part in self._parts:
            if part.answer is not None:
                yield OpenContour(start + 1, start + part.count, part.answer)
            start += part.count

    def contour_at(self, line: int) -> Answer | None:
        """The contour on a line, with its words where they are now; None where there is none."""
        if self._examination is None:
            return next((each.answer for each in self.contours if each.first <= line <= each.last), None)
        start = 0
        for part in self._parts:
            if start < line <= start + part.count:
                return self._answer_of(part, start)
            start += part.count
        return None

    def _answer_of(self, part: _Part, start: int) -> Answer | None:
        """The contour of a part, with its words where they are now; None where it has none, or is stale."""
        if part.answer is None or part.is_stale or self._examination is None:
            return None
        if part.answer_age != len(self._moves):
            self._bring_up(part)
            step, _, _ = next(self._examination.resume(self._lines, start, part.known))
            part.answer, part.answer_age = step.answer, len(self._moves)
        return part.answer


def _is_plain(part: _Part) -> bool:
    """Whether a part may take in another plain block."""
    return part.answer is None and not part.beside and not part.is_stale and 0 < part.count < _LONGEST
