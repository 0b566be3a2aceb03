"""Contours that are found and not solved yet: together, as soon as it is known where they begin."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Protocol, cast

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.explain import Context
from contoursolve.diagnosis.wording import join
from contoursolve.diagnostics.finding import Diagnostic, Severity
from contoursolve.gcode import Block, Passage
from contoursolve.program.stream import View
from contoursolve.reading import Awaited, Modes, ParsedContour, Position, ReadIssue, State, leave
from contoursolve.reading.dialect import Dialect
from contoursolve.solving.contour import Contour


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


class Together(Protocol):
    """Solves many contours at once."""

    def solve(self, claims: Sequence[ParsedContour], examine: Sequence[Callable[[], Answer]]) -> Sequence[Answer]:
        """The answers to contours whose start is known, the same as `examine` gives to each of them."""


Previous = tuple[Sequence[Block], State]
"""The contour, or the block, before a place, and the state before it."""


class Pending:
    """A contour that is found and not solved yet, in a state, and what follows it."""

    def __init__(
        self, contour: ParsedContour, step: Step, view: View, after: int, previous: Previous | None = None
    ) -> None:
        self.contour, self.step, self.view, self.after, self.previous = contour, step, view, after, previous
        self.wave = max([each.wave for each in step.before.axes.values() if isinstance(each, Awaited)], default=0)
        """How many contours in a row have to be solved before."""
        self.left: Callable[[], State] | None = None
        """The state that it leaves, once it is solved."""


class Queue:
    """The contours of one program that are pending; `examine` gives the answer to one of them by itself."""

    def __init__(
        self, dialect: Dialect, together: Together | None, examine: Callable[[ParsedContour, Pending], Answer]
    ) -> None:
        self.dialect, self.together, self.examine = dialect, together, examine
        self.pending: list[Pending] = []

    def add(
        self, contour: ParsedContour, step: Step, view: View, after: int, previous: Previous | None = None
    ) -> Pending:
        """A contour that begins a view and ends before its block `after`; without company, it is solved at once."""
        pending = Pending(contour, step, view, after, previous)
        self.pending.append(pending)
        if self.together is None:
            self.settle()
        return pending

    def settle(self) -> None:
        """Solve what is pending: first what starts from a known point, then what begins where that ends, and so on."""
        waves: dict[int, list[Pending]] = {}
        for pending in self.pending:
            waves.setdefault(pending.wave, []).append(pending)
        self.pending = []
        for _, ready in sorted(waves.items()):
            claimed = [(each, each.contour) for each in ready]
            examine = [partial(self.examine, claim, each) for each, claim in claimed]
            answers = (
                [once() for once in examine]
                if self.together is None
                else self.together.solve([claim for _, claim in claimed], examine)
            )
            for (each, claim), answer in zip(claimed, answers, strict=True):
                step = each.step
                each.left = partial(_after, claim, self.dialect.modes, answer)
                behind = self._behind(each, claim.form.name, answer.contour, each.left)
                told = replace(answer, diagnostics=(*answer.diagnostics, *behind)) if behind else answer
                each.step = Step(step.blocks, step.before, told, step.findings)

    def _behind(
        self, each: Pending, form: str, contour: Contour | None, left: Callable[[], State]
    ) -> tuple[Diagnostic, ...]:
        """The findings about the block behind a contour."""
        dialect = self.dialect
        if dialect.follow is None:
            return ()
        context = Context(dialect.rules, each.step.before.unit)
        return tuple(dialect.follow(form, contour, left, each.view.lines(each.after), context, dialect.modes))

    def leave(self, pending: Pending) -> State:
        """The state after a contour; where it ends follows when it is solved."""
        if pending.left is not None:
            return pending.left()
        contour, addresses = pending.contour, self.dialect.modes.lexicon.addresses
        state, axes = contour.left, [*contour.after.plane.axes]
        for words in map(contour.beside_plane, contour.blocks):
            axes += [axis for axis in (addresses[word.address].axis for word in words) if axis not in axes]

        def find(axis: str) -> Position:
            if pending.left is None:
                self.settle()
            return cast("Callable[[], State]", pending.left)().axes[axis]

        return state.move({axis: Awaited(partial(find, axis), pending.wave + 1) for axis in axes})


def _after(claim: ParsedContour, modes: Modes, answer: Answer) -> State:
    """The state that a contour leaves."""
    if answer.contour is not None:
        return leave(claim, answer.contour.end, modes)
    origin = _awaited(claim, answer)
    if origin is not None:
        return leave(claim, None, modes, origin.reason, origin.span)
    lines = (
        f"line {answer.lines[0]}, which is"
        if len(answer.lines) == 1
        else f"lines {join(list(map(str, answer.lines)))}, which are"
    )
    return leave(claim, None, modes, f"this contour waits for {lines} not solved")


def _awaited(claim: ParsedContour, answer: Answer) -> Position | None:
    """What made the start of a contour unknown, if nothing else is wrong with it."""
    errors = [each.about for each in answer.diagnostics if each.severity is Severity.ERROR]
    places = [claim.before.axes[axis] for axis in claim.before.plane.axes]
    unknown = [each for each in places if each.value is None and each.span is not None]
    return unknown[0] if unknown and errors == [ReadIssue.POSITION_UNKNOWN] else None
