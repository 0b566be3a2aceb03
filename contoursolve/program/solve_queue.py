"""Contours that are found and not solved yet: together, as soon as it is known where they begin."""

from collections.abc import Callable, Sequence
from decimal import Decimal
from functools import cache, partial
from itertools import islice
from typing import Any, Protocol, cast

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import (
    Answer,
    Depth,
    Policy,
    context_of,
    examine,
    join,
    measured,
    report,
    report_behind,
)
from contoursolve.diagnostics import Applicability, Basis, Diagnostic, Fix, Severity
from contoursolve.gcode import Block, Passage, parse_block
from contoursolve.program.lookahead import View
from contoursolve.reading import (
    WAITS,
    Awaited,
    Control,
    End,
    Modes,
    ParsedContour,
    Position,
    ReadIssue,
    State,
    contours_of,
    leave,
)
from contoursolve.solving import Contour, Status
from contoursolve.tolerance import AGREEMENT


class Step(Struct, frozen=True):
    """One block of a program, or the blocks of one contour from its first line to its last, or plain lines in a row;
    and the state before them.

    `findings` are about blocks that are no contour.
    """

    blocks: tuple[Block, ...]
    before: State
    answer: Answer | None = None
    findings: tuple[Diagnostic, ...] = ()
    passage: Passage | None = None
    """In place of blocks: what nobody needed to read into words."""
    others: tuple[Answer, ...] = ()
    """The answers to the contour where other calls lead to other ones."""
    shares: str = ""
    """The reason why its blocks cannot be written anew: some run outside of this contour, or several times in it. Else
    empty."""


class Together(Protocol):
    """Solves many contours at once."""

    def solve(self, claims: Sequence[ParsedContour], examine: Sequence[Callable[[], Answer]]) -> Sequence[Answer]:
        """The answers to contours whose start is known, the same as `examine` gives to each of them."""


Previous = tuple[Sequence[Block], State]
"""The contour, or the block, before a place, and the state before it."""

Ahead = tuple[tuple[Sequence[Block] | Passage, State], ...]
"""The last contours, blocks and plain lines before a place that say something, each with the state before it."""


class Pending:
    """A contour that is found and not solved yet, in a state, and what follows it: it begins a view, and ends before
    its block `after`."""

    def __init__(
        self,
        contour: ParsedContour,
        step: Step,
        view: View,
        after: int,
        ahead: Ahead = (),
        lost: Diagnostic | None = None,
    ) -> None:
        self.contour, self.step, self.view, self.after, self.ahead = contour, step, view, after, ahead
        self.lost = lost
        """The finding that one of its words has lost its point, with which it is read."""
        self.wave = max([each.wave for each in step.before.axes.values() if isinstance(each, Awaited)], default=0)
        """How many contours in a row have to be solved before."""
        self.left: Callable[[], State] | None = None
        """The state that it leaves, once it is solved."""


class Answering(Protocol):
    """Answers contours, one by one."""

    def solve(self, found: ParsedContour, pending: Pending) -> Answer:
        """The answer to a contour, which is not explained yet."""

    def explain(self, answer: Answer, pending: Pending) -> Answer:
        """The same answer, explained, however it was solved."""

    def mend_behind(self, answer: Answer, found: Sequence[Diagnostic], pending: Pending) -> tuple[Diagnostic, ...]:
        """The findings about the block behind a contour, with what was meant there."""


class Queue:
    """The contours of one program that are pending. If it `goes_on`, those behind one that is refused are checked from
    where its best fix ends."""

    def __init__(
        self,
        control: Control,
        together: Together | None,
        answers: Answering,
        *,
        goes_on: bool = False,
    ) -> None:
        self.control, self.together, self.answers, self.goes_on = control, together, answers, goes_on
        self.pending: list[Pending] = []

    def add(self, pending: Pending) -> None:
        """Take a contour; without company, it is solved at once."""
        self.pending.append(pending)
        if self.together is None:
            self.settle()

    def settle(self) -> None:
        """Solve what is pending: first what starts from a known point, then what begins where that ends, and so on."""
        waves: dict[int, list[Pending]] = {}
        for pending in self.pending:
            waves.setdefault(pending.wave, []).append(pending)
        self.pending = []
        for _, ready in sorted(waves.items()):
            claimed = [(each, each.contour) for each in ready]
            each_alone = [partial(self.answers.solve, claim, each) for each, claim in claimed]
            answers = (
                [once() for once in each_alone]
                if self.together is None
                else self.together.solve([claim for _, claim in claimed], each_alone)
            )
            for (each, _), answer in zip(claimed, answers, strict=True):
                self._take(each, self.answers.explain(answer, each))

    def _take(self, each: Pending, answer: Answer) -> None:
        """Take in the answer to a contour that was pending."""
        claim = each.contour
        if each.left is None:
            step, origin = each.step, _awaited(claim, answer) if answer.contour is None else None
            told, tried = self._check_on(each, answer, is_else_right=origin is not None)
            end = partial(self._end_of_fix, tried) if self.goes_on else _nowhere
            each.left = cache(partial(_after, claim, self.control.modes, answer, origin, end))
            behind = self._behind(each, claim.form.name, answer.contour, each.left)
            if behind:
                told = replace(told, diagnostics=(*told.diagnostics, *self.answers.mend_behind(told, behind, each)))
            if each.lost is not None:
                told = _refused(told, each.lost)
            each.step = Step(step.blocks, step.before, told, step.findings)
            # Who waits for its end would keep all that was before it.
            each.ahead = ()

    def _examine(self, claim: ParsedContour, each: Pending) -> Answer:
        return self.answers.explain(self.answers.solve(claim, each), each)

    def _check_on(self, each: Pending, answer: Answer, *, is_else_right: bool) -> tuple[Answer, Answer]:
        """The answer to a contour, with what is found if it begins where the best fix of the contour before ends, if
        it waits for that and `is_else_right`; and the answer to it from there. That it waits is no error of its own."""
        if answer.contour is not None:
            return answer, answer
        before = each.contour.before
        lost = {axis: before.axes[axis] for axis in before.plane.axes if before.axes[axis].value is None}
        lines = join([str(line) for line in dict.fromkeys(place.span.line for place in lost.values() if place.span)])
        if not lost or not all(place.reason.startswith(WAITS) for place in lost.values()):
            return answer, answer
        told = replace(answer, diagnostics=tuple(map(_as_following, answer.diagnostics)))
        if not self.goes_on:
            return told, answer
        if not is_else_right:
            return self._with_start(told, ReadIssue.CONTOUR_WAITS, (), line=lines), answer
        state = before.move({axis: Position(place.assumed, place.reason, place.span) for axis, place in lost.items()})
        claim = self.control.find(each.view, 0, state, self.control.modes) if state.start().is_known else None
        if not isinstance(claim, ParsedContour):
            return self._with_start(told, ReadIssue.CONTOUR_WAITS, (), line=lines), answer
        tried = self._examine(claim, each)
        first, second = (float(value or 0) for value in state.start().values)
        place = measured((first, second), state.plane, claim.after.unit)
        return self._with_start(told, ReadIssue.START_ASSUMED, tried.diagnostics, line=lines, place=place), tried

    def _with_start(self, answer: Answer, about: ReadIssue, others: tuple[Diagnostic, ...], **fields: Any) -> Answer:
        """The answer with another finding about its start, and others."""
        context = context_of(answer.claim, self.control.rules)
        start = report(context, context.row(about), Basis.RULE, [], **fields)
        lost = [each for each in answer.diagnostics if each.about is ReadIssue.POSITION_UNKNOWN]
        labels = (*start.labels, *(label for each in lost for label in each.labels))
        start = replace(start, labels=tuple(dict.fromkeys(labels)))
        # What is found from there says more; that it waits says that its start is not known.
        again = {(each.code, each.span) for each in (*others, *(lost if about is ReadIssue.CONTOUR_WAITS else ()))}
        kept = (each for each in answer.diagnostics if (each.code, each.span) not in again)
        return replace(answer, diagnostics=(*kept, start, *others))

    def _end_of_fix(self, answer: Answer, state: State) -> End:
        """The end of a contour, mm: its own, or that with the first fix of its first error that leaves nothing open and
        ends where the contour says, as far as the state behind it knows that."""
        if answer.contour is not None:
            return answer.contour.end
        if answer.mended is not None:
            return self._end_of_fix(answer.mended, state)
        if not answer.start.is_known:
            return None
        errors = (each for each in answer.diagnostics if each.is_error)
        fixes = (fix for each in errors for fix in each.fixes if fix.applicability is not Applicability.PLACEHOLDER)
        known = [state.axes[axis].value for axis in answer.claim.after.plane.axes]
        for fix in islice(fixes, _MOST_FIXES):
            end = self._end_with(fix, answer.claim)
            if end and all(
                at is None or abs(float(at) - value) <= AGREEMENT for at, value in zip(known, end, strict=True)
            ):
                return end
        return None

    def _end_with(self, fix: Fix, claim: ParsedContour) -> End:
        """The end of a contour with a fix, mm."""
        ends = list[End]()
        texts = enumerate(fix.replacement.split("\n"), claim.blocks[0].line)
        pointed = [word for block in claim.blocks for word in block.pointed]
        blocks = [parse_block(text, line, self.control.modes.syntax).with_points(pointed) for line, text in texts]

        def end_of(found: ParsedContour) -> End:
            contour = examine(found, self.control, Policy.ENFORCE, lambda: None, Depth.VERDICT).contour
            ends.append(contour.end if contour else None)
            return ends[-1]

        for _ in contours_of(blocks, self.control.find, self.control.modes, claim.before, end_of=end_of):
            pass
        return ends[-1] if ends else None

    def _behind(
        self, each: Pending, form: str, contour: Contour | None, left: Callable[[], State]
    ) -> tuple[Diagnostic, ...]:
        """The findings about the block behind a contour."""
        control = self.control
        if control.follow is None:
            return ()
        found = control.follow(form, contour, left, islice(each.view, each.after, None), control.modes)
        return tuple(report_behind(one, control, each.contour.blocks) for one in found)

    def leave(self, pending: Pending) -> State:
        """The state after a contour; where it ends follows when it is solved."""
        if pending.left is not None:
            return pending.left()
        contour, addresses = pending.contour, self.control.modes.lexicon.addresses
        state, axes = contour.left, [*contour.after.plane.axes]
        for words in map(contour.beside_plane, contour.blocks):
            axes += [axis for axis in (addresses[word.address].axis for word in words) if axis not in axes]

        def find(axis: str) -> Position:
            if pending.left is None:
                self.settle()
            if pending.left is None:
                # While others are solved, one of them asks for it.
                self._take(pending, self._examine(pending.contour, pending))
            return cast("Callable[[], State]", pending.left)().axes[axis]

        return state.move({axis: Awaited(partial(find, axis), pending.wave + 1) for axis in axes})


def _refused(answer: Answer, lost: Diagnostic) -> Answer:
    """The answer to a contour that was read as it is meant, and is not what the control makes of its words."""
    found = (lost, *answer.diagnostics)
    return replace(answer, status=Status.REJECTED, contour=None, certificate=None, sides={}, diagnostics=found)


def _as_following(finding: Diagnostic) -> Diagnostic:
    """A finding; that the start is not known follows from another one, and is no error of its own."""
    return replace(finding, severity=Severity.INFO) if finding.about is ReadIssue.POSITION_UNKNOWN else finding


_MOST_FIXES = 3
"""Fixes of one contour of which one may tell where it ends."""


def _nowhere(_: State) -> None:
    """No point."""


def _after(
    claim: ParsedContour,
    modes: Modes,
    answer: Answer,
    origin: Position | None,
    find_end: Callable[[State], End],
) -> State:
    """The state that a contour leaves; `origin` is what made its start unknown, `find_end` finds where its best fix
    ends."""
    if answer.contour is not None:
        return leave(claim, answer.contour.end, modes)
    state = _lost(claim, modes, answer, origin)
    ends = zip(claim.after.plane.axes, find_end(state) or (), strict=False)
    lost = {axis: (state.axes[axis], value) for axis, value in ends if state.axes[axis].value is None}
    return state.move(
        {
            axis: Position(None, place.reason, place.span, place.is_skippable, place.word, Decimal(repr(value)))
            for axis, (place, value) in lost.items()
        }
    )


def _lost(claim: ParsedContour, modes: Modes, answer: Answer, origin: Position | None) -> State:
    """The state that a contour without a path leaves."""
    if origin is not None:
        return leave(claim, None, modes, origin.reason, origin.span)
    lines = (
        f"program line {answer.lines[0]}, which is"
        if len(answer.lines) == 1
        else f"program lines {join(list(map(str, answer.lines)))}, which are"
    )
    return leave(claim, None, modes, f"{WAITS} {lines} not solved")


def _awaited(claim: ParsedContour, answer: Answer) -> Position | None:
    """The position that makes the start of a contour unknown, if nothing else is wrong with it."""
    errors = [each.about for each in answer.diagnostics if each.is_error]
    places = [claim.before.axes[axis] for axis in claim.before.plane.axes]
    unknown = [each for each in places if each.value is None and each.span is not None]
    return unknown[0] if unknown and errors == [ReadIssue.POSITION_UNKNOWN] else None
