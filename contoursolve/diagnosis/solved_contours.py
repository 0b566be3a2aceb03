"""Slips in contours that are solved, and whose path is hardly meant: it crosses the spindle axis, or the block behind
does not go on along it."""

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from contoursolve.diagnosis.attempt import Repair, Trial
from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.explain import spans_of
from contoursolve.diagnosis.fix_text import with_fixes
from contoursolve.diagnosis.ranking import choose_repairs
from contoursolve.diagnosis.window import Window
from contoursolve.diagnostics import Diagnostic, Severity, Span
from contoursolve.reading import ReadIssue


def mend_crossing(answer: Answer, window: Window) -> Answer:
    """An answer whose path crosses the spindle axis, with what was meant if that was not."""
    findings = []
    for each in answer.diagnostics:
        if each.about is ReadIssue.AXIS_CROSSED and not each.fixes:
            stated = frozenset(word.span for word in answer.claim.words.values())
            found = [repair for repair in _repairs(answer, window, stated, each.message) if _stays(repair)]
            each = with_fixes(each, answer, found)  # noqa: PLW2901
        findings.append(each)
    return replace(answer, diagnostics=tuple(findings))


def _stays(repair: Repair) -> bool:
    """Whether the path stays on its side of the spindle axis."""
    return repair.contour is not None and repair.contour.crossing is None


def mend_behind(answer: Answer, findings: Sequence[Diagnostic], window: Window) -> Iterator[Diagnostic]:
    """The findings about the block behind a contour, those that have no fix with what was meant there, or in the
    contour; the block is one of the window's own."""
    for each in findings:
        is_open = answer.contour is not None and each.severity is not Severity.INFO and not each.fixes
        # The contour leads there.
        marked = frozenset({*spans_of([each]), answer.claim.blocks[-1].words[0].span})
        # A habit of a program, which a rule warns of at each contour, costs little.
        found = _repairs(answer, window, marked, each.message, is_frequent=True) if is_open else ()
        yield with_fixes(each, answer, found) if found else each


def _repairs(
    answer: Answer, window: Window, marked: frozenset[Span], told: str, *, is_frequent: bool = False
) -> tuple[Repair, ...]:
    """The slips that explain a finding about a contour that is solved, the most plausible first."""
    trial = Trial(answer, window.control, window, about=(marked, told), is_frequent=is_frequent)
    return choose_repairs(trial, ()).repairs
