"""The answer to one contour of a program: solved, with its findings explained as deeply as is asked."""

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import chain, islice
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer, Depth, context_of, examine, may_be_suspected, may_have_odd_points, report
from contoursolve.diagnostics import Basis, Diagnostic, Severity
from contoursolve.gcode import Block
from contoursolve.program.named_words import mark_trusted, with_named_words
from contoursolve.program.outside_contours import NEAR
from contoursolve.program.request import Request
from contoursolve.program.solve_queue import Ahead, Pending
from contoursolve.program.windows import Parts, near, window_of
from contoursolve.reading import Control, ParsedContour, ReadIssue, axis_words, next_place

if TYPE_CHECKING:
    from contoursolve.diagnosis import Window

BEHIND = 32
"""Blocks after a contour of which a repair may make a part of it: the rest of a chain that a comma joins."""

MOST_EXPLAINED = 100
"""Wrong results of one contour that are explained and mended, where it runs again and again."""

_MOST_NESTED = 2
"""Explanations of contours, one for the other, that are made while a program is followed ahead."""


def answer_to(asked: Request, control: Control, found: ParsedContour, pending: Pending) -> Answer:
    """The answer to a contour, with the values that it asks for filled in; its findings are not explained yet."""
    behind = islice(pending.view, pending.after, None)
    answer = examine(found, control, asked.policy, lambda: next_place(behind, found, control.modes), asked.depth)
    if answer.contour is None:
        following = [each for each in pending.view[pending.after : pending.after + BEHIND] if each.says_something]
        block, goes_on = next(iter(following), None), any(axis_words(each, control.modes) for each in following)
        if pending.view.end_at_call and not goes_on:
            answer = replace(answer, diagnostics=tuple(_at_call(each, answer, control) for each in answer.diagnostics))
        elif block is not None and control.modes.zero.rows_in(block):
            answer = replace(answer, diagnostics=tuple(_at_moved_zero(each, block) for each in answer.diagnostics))
    if answer.contour is not None and any(value.value is not None for value in answer.asked):
        from contoursolve.diagnosis import fill_in  # noqa: PLC0415 - few blocks ask for a value

        return replace(answer, filled=fill_in(answer))
    return answer


_CUT_OFF = {"corner-without-next": "a corner", "end-missing": "a line by its angle alone"}
"""The elements that need the next one, by the ends of the codes of what is said where none follows."""


def _at_call(finding: Diagnostic, answer: Answer, control: Control) -> Diagnostic:
    """The finding about a contour right before a call or a return, behind which nobody looks for its next element."""
    what = next((each for code, each in _CUT_OFF.items() if finding.code.endswith(f"-{code}")), None)
    if what is None:
        return finding
    words = [word for word in answer.claim.words.values() if word.span == finding.span]
    name = f"{what} right before a call or a return"
    told = report(context_of(answer.claim, control.rules), ReadIssue.NOT_READ, Basis.RULE, words, name=name)
    help_ = "write the next cutting move right after it, in the same program"
    return replace(told, severity=finding.severity, help=help_)


def _at_moved_zero(finding: Diagnostic, moving: Block) -> Diagnostic:
    """The finding about a contour right before a block that moves the coordinate system."""
    if not any(finding.code.endswith(f"-{code}") for code in _CUT_OFF):
        return finding
    text = " ".join(word.text.strip() for word in moving.words)
    told = f"{text} in program line {moving.line} moves the coordinate system first; move it before the contour"
    return replace(finding, message=f"{finding.message}: {told}")


def explained(asked: Request, control: Control, answer: Answer, pending: Pending, ahead: Ahead, parts: Parts) -> Answer:
    """An answer with what is wrong, or hardly meant, explained, and how it is mended; `ahead` is before the contour,
    `parts` examines blocks that are tried."""
    if asked.depth in (Depth.VERDICT, Depth.TRIAL):
        return answer

    def window() -> "Window":
        return _window(control, answer, pending, ahead, parts)

    if asked.depth is Depth.PATH and answer.contour is not None and _is_wrong(answer):
        # What is written needs no repair.
        return answer
    if _is_wrong(answer):
        # Most programs need no diagnosis, and none should wait for its import.
        from contoursolve.diagnosis import diagnose  # noqa: PLC0415

        following = pending.view[pending.after : pending.after + BEHIND]
        answer = diagnose(answer, control, asked.policy, following, window())
        if asked.depth.is_full and _has(answer, ReadIssue.VARIABLE):
            from contoursolve.program.open_values import tell_values  # noqa: PLC0415 - few contours need it

            return tell_values(answer, control, asked.policy)
        return answer
    if _has(answer, ReadIssue.POINT_MISSING):
        from contoursolve.diagnosis import mend_points  # noqa: PLC0415

        answer = mend_points(answer, control)
    before = (block for blocks in near(ahead, has_plain=False) for block in reversed(blocks))
    beside = chain(before, pending.view.telling(pending.after, NEAR))
    if may_be_suspected(answer, beside, lambda: _around(pending, ahead)) or _has_odd_points(answer):
        from contoursolve.diagnosis import suspect  # noqa: PLC0415 - few contours look odd

        answer = suspect(answer, window())
    return answer


def _has_odd_points(answer: Answer) -> bool:
    if not may_have_odd_points(answer):
        return False
    from contoursolve.diagnosis import has_odd_points  # noqa: PLC0415 - few contours are lines with few aslant

    return has_odd_points(answer)


def _window(control: Control, answer: Answer, pending: Pending, ahead: Ahead, parts: Parts, own: int = 0) -> "Window":
    """The blocks around a contour; its own are as many more as `own` says. Behind it, no contour is cut in two, as far
    as so many blocks are known."""
    view, after = pending.view, pending.after + own
    behind, count = view[after : after + BEHIND], NEAR
    while count < len(behind) and control.signs(behind[count - 1]):
        count += 1
    is_end = count >= len(behind) < BEHIND and not view.end_at_call
    return window_of(ahead, view[:after], behind[:count], answer.claim.before, control, parts, is_end=is_end)


def _around(pending: Pending, ahead: Ahead) -> Sequence[Block]:
    """The blocks of such a window, without the states before them."""
    before = [block for blocks in reversed([*near(ahead)]) for block in blocks]
    return [*before, *pending.view[: pending.after + NEAR]]


def _is_wrong(answer: Answer) -> bool:
    """Whether anything is wrong with a contour. A path across the spindle axis is as the words say it."""
    return any(
        each.severity is not Severity.INFO and each.about is not ReadIssue.AXIS_CROSSED for each in answer.diagnostics
    )


def _has(answer: Answer, issue: ReadIssue) -> bool:
    return any(each.about is issue for each in answer.diagnostics)


class Answers:
    """The answers to the contours of one program: each is solved, alone or with others, and then explained."""

    looks_back = True
    """True where the lines before a contour run before it."""

    def __init__(self, asked: Request, control: Control, parts: Parts) -> None:
        self.asked, self.control, self.parts = asked, control, parts

    def solve(self, found: ParsedContour, pending: Pending) -> Answer:
        """The answer to a contour, which is not explained yet."""
        return answer_to(self.asked, self.control, mark_trusted(found, self.asked), pending)

    def explain(self, answer: Answer, pending: Pending) -> Answer:
        """The same answer with what is wrong, or hardly meant, explained."""
        ahead = pending.ahead if self.looks_back else ()
        answer = explained(self.asked, self.control, answer, pending, ahead, self.parts)
        answer = with_named_words(answer, self.asked)
        return replace(answer, diagnostics=self._named(answer.diagnostics, answer)) if answer.diagnostics else answer

    def _named(self, findings: Iterable[Diagnostic], answer: Answer) -> tuple[Diagnostic, ...]:
        if self.asked.depth in (Depth.VERDICT, Depth.TRIAL):
            return tuple(findings)
        from contoursolve.diagnosis import named_in_program  # noqa: PLC0415 - most contours have no findings

        return named_in_program(findings, answer.claim, answer.profile)

    def examine(self, found: ParsedContour, pending: Pending) -> Answer:
        """Both."""
        return self.explain(self.solve(found, pending), pending)

    def mend_behind(self, answer: Answer, found: Sequence[Diagnostic], pending: Pending) -> tuple[Diagnostic, ...]:
        """The findings about the block behind a contour, with what was meant there."""
        is_written = self.asked.depth is Depth.PATH and answer.contour is not None
        if is_written or self.asked.depth in (Depth.VERDICT, Depth.TRIAL):
            return self._named(found, answer)
        from contoursolve.diagnosis import mend_behind  # noqa: PLC0415 - few contours need it

        lines = [each.span.line for each in found]
        behind = pending.view[pending.after : pending.after + NEAR]
        own = next((at for at, block in enumerate(behind, 1) if block.line in lines), 0)
        window = _window(self.control, answer, pending, pending.ahead, self.parts, own)
        return self._named(mend_behind(answer, found, window), answer)


class TooFarError(Exception):
    """Too many wrong contours in a row would have to be explained before it is known where one of them ends."""


class AnswersAhead(Answers):
    """The same of a program that is followed ahead of its examination. What is wrong in a contour rests on those before
    it. Raises TooFarError."""

    _nested = 0

    def explain(self, answer: Answer, pending: Pending) -> Answer:
        if answer.contour is None and self._nested == _MOST_NESTED:
            raise TooFarError
        self._nested += 1
        try:
            return super().explain(answer, pending)
        finally:
            self._nested -= 1


class Learned(Struct, frozen=True):
    """Answers that one step adds to what is known of a program that runs, and the contours that were wrong there."""

    known: tuple[tuple[object, Answer], ...]
    wrong: tuple[tuple[str, int], ...]


class AnswersInPasses(Answers):
    """The same of a program that runs: where a contour comes to the same again, its answer is that of before; and in a
    loop, each pass may be wrong, of which the first ones are explained."""

    looks_back = False

    def __init__(self, asked: Request, control: Control, parts: Parts) -> None:
        super().__init__(asked, control, parts)
        self._known: dict[object, Answer] = {}
        """By what is known before a contour, its blocks and those behind it."""
        self._wrong = Counter[tuple[str, int]]()
        """How often the contour at a line of a file was wrong."""
        self._begun, self._is_alone, self._wrong_here = 0, True, list[tuple[str, int]]()

    def solve(self, found: ParsedContour, pending: Pending) -> Answer:
        known = None if found.directives else self._known.get(_key_of_pass(found, pending))
        return super().solve(found, pending) if known is None else known

    def explain(self, answer: Answer, pending: Pending) -> Answer:
        if answer.claim.directives:
            return self._explain_pass(answer, pending)
        key = _key_of_pass(answer.claim, pending)
        if key in self._known:
            self._is_alone = False
        else:
            self._known[key] = self._explain_pass(answer, pending)
        return self._known[key]

    def begin(self) -> None:
        """Begin a step of which it is asked what it has `learned`."""
        self._begun, self._is_alone, self._wrong_here = len(self._known), True, []

    def learned(self) -> Learned | None:
        """The answers that the step has added; None where its answers rest on those of other steps."""
        known = islice(self._known.items(), self._begun, None)
        return Learned(tuple(known), tuple(self._wrong_here)) if self._is_alone else None

    def recall(self, learned: Learned) -> bool:
        """Take in what a step of an earlier run has added; False where this run would answer otherwise."""
        if not (learned.known or learned.wrong):
            return True
        wrong = self._wrong + Counter(learned.wrong)
        if any(wrong[each] > MOST_EXPLAINED for each in learned.wrong):
            return False
        if any(key in self._known for key, _ in learned.known):
            return False
        self._known.update(learned.known)
        self._wrong = wrong
        return True

    def _explain_pass(self, answer: Answer, pending: Pending) -> Answer:
        if _is_wrong(answer) and self._is_late(answer.claim.blocks[0]):
            note = f"only the first {MOST_EXPLAINED} wrong results of a contour are explained; this is a later one"
            noted = (replace(each, notes=(*each.notes, note)) for each in answer.diagnostics)
            return replace(answer, diagnostics=tuple(noted))
        return super().explain(answer, pending)

    def _is_late(self, first: Block) -> bool:
        """Whether enough results of a contour, of which this is the first block, are explained; it is wrong again."""
        self._wrong[first.file, first.line] += 1
        self._wrong_here.append((first.file, first.line))
        self._is_alone = self._is_alone and self._wrong[first.file, first.line] <= MOST_EXPLAINED
        return self._wrong[first.file, first.line] > MOST_EXPLAINED


def _key_of_pass(found: ParsedContour, pending: Pending) -> object:
    behind = pending.view[pending.after : pending.after + NEAR]
    return found.before.known(), tuple(map(_key_of, (*found.blocks, *behind))), len(found.blocks)


def _key_of(block: Block) -> object:
    return block.line, block.text, block.file, block.callers, block.substituted
