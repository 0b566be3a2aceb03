"""Findings about a block outside contours, with what it was probably meant to be."""

from collections.abc import Iterator, Sequence, Set

from msgspec.structs import replace

from contoursolve.diagnosis.edits import signed
from contoursolve.diagnosis.examine import SUSPICIONS
from contoursolve.diagnosis.explain import Context, report, spans_of
from contoursolve.diagnosis.fix_text import told
from contoursolve.diagnosis.plausibility import oddities, total
from contoursolve.diagnosis.slip_kinds import FEW, LETTER_ALIKE, SlipKind
from contoursolve.diagnosis.slips_around import MOST_TRIED, Candidate, Marked, drafts_around, is_lasting, touches
from contoursolve.diagnosis.window import Seen, Window
from contoursolve.diagnosis.wording import MOST_FIXES
from contoursolve.diagnostics import Applicability, Basis, Diagnostic, Fix, Severity, Span
from contoursolve.gcode import Word
from contoursolve.reading import ReadIssue, doubtful_words


def mend_line(context: Context, findings: Sequence[Diagnostic], window: Window) -> Iterator[Diagnostic]:
    """The findings about one block, the only one of its window's own; the first that has no fix with what was probably
    meant. Of a block of which nothing is said, a code that the control has not, or a number with a point where none
    belongs, if with another one it is part of a contour that is solved."""
    block = window.own[0]
    open_ = next((each for each in findings if each.severity is not Severity.INFO and not each.fixes), None)
    if any(each.fixes for each in findings) or (open_ and open_.about is ReadIssue.LETTER_FOR_DIGIT):
        # With the digit it would be a contour, which has a slip more.
        open_ = None
    for each in findings:
        yield _mended(context, each, findings, window) if each is open_ else each
    if findings:
        return
    is_quiet = window.control.modes.settings.get(SUSPICIONS) == "off"
    for word, reason in doubtful_words(block, window.control.modes):
        if reason and is_quiet:
            continue
        marked = Marked(frozenset({word.span}), frozenset({block.line}))
        fixes = [fix for fix, seen in _tried(window, marked, (LETTER_ALIKE,), word) if _is_joined(window, seen)]
        if fixes:
            about = ReadIssue.SUSPECTED if reason else ReadIssue.CODE_MISTYPED
            meant = fixes[0].description.split()[1]
            finding = report(context, about, Basis.RULE, [word], meant=meant, reason=reason)
            yield replace(finding, fixes=tuple(fixes[:MOST_FIXES]))


def _is_joined(window: Window, seen: Seen) -> bool:
    """Whether the block is part of a contour that is solved then, and was none before."""
    line = window.own[0].line
    return any(line in answer.lines and answer.contour is not None for answer in seen.answers)


def _mended(context: Context, finding: Diagnostic, findings: Sequence[Diagnostic], window: Window) -> Diagnostic:
    """A finding with what was meant; of a code that the control has not, that it is another one, with which the block
    draws something."""
    own = window.own[0]
    spans = frozenset(spans_of([finding]))
    torn = {each.span for each in own.faults}
    marked = Marked(frozenset(spans_of(findings)) | spans, frozenset({own.line}))
    found = _tried(window, marked, FEW, None, torn)
    words = [word for word in own.words if finding.about is ReadIssue.CODE_UNKNOWN and word.span == finding.span]
    joined = [fix for fix, seen in found if _is_joined(window, seen)] if words else []
    if joined:
        meant = joined[0].description.split()[1]
        told = report(context, ReadIssue.CODE_MISTYPED, Basis.RULE, words, meant=meant)
        return replace(told, severity=finding.severity, fixes=tuple(joined[:MOST_FIXES]))
    return replace(finding, fixes=tuple(fix for fix, _ in found[:MOST_FIXES]))


def _tried(
    window: Window, marked: Marked, kinds: tuple[SlipKind, ...], word: Word | None, torn: Set[Span] = frozenset()
) -> list[tuple[Fix, Seen]]:
    """The fixes of a block that leave nothing wrong, the most plausible first."""
    own, found = window.own[0], list[tuple[float, Fix, Seen]]()
    for draft in drafts_around(window, marked, None, kinds)[:MOST_TRIED]:
        lines = {edit.span.line if edit.span else edit.line for edit in draft.edits}
        if lines != {own.line} or (word is not None and not all(edit.span == word.span for edit in draft.edits)):
            continue
        if not all(any(touches(edit, span) for edit in draft.edits) for span in torn):
            continue
        if not any(touches(edit, span) for edit in draft.edits for span in marked.spans):
            continue
        seen = window.after(draft.edits)
        if any(map(is_lasting, draft.edits)) and (seen is None or not _is_joined(window, seen)):
            # In another plane, much is right that nobody meant.
            continue
        if seen is not None and window.mends(seen):
            # What draws a contour that is solved is meant rather than what draws none.
            cost = draft.cost + total(oddities(seen.moves).items()) - 2 * _is_joined(window, seen) - _gain(window, seen)
            found.append((round(cost, 6), _fix(window, draft), seen))
    found.sort(key=lambda each: (each[0], each[1].description))
    return [(fix, seen) for _, fix, seen in found]


def _gain(window: Window, seen: Seen) -> float:
    """The number of problems behind it that a block would mend, as a cost below zero would count."""
    return min(len(window.before.keys - seen.keys), 3) * 1.0


def _fix(window: Window, draft: Candidate) -> Fix:
    own, edits = window.own[0], signed(draft.edits, window.blocks)
    # In a program that runs, a line may be there in several passes.
    text = next(each.text for each in window.changes(edits) if (each.span, each.old) == (own.span, own.text))
    return Fix(told(edits, draft.slips, [own]), text, Applicability.CHANGES_CONTOUR, replaced=own.text)
