"""The words that a reader of the explorer has changed, and the fixes in the order that this gives them."""

from collections import Counter
from collections.abc import Iterable
from math import inf

from msgspec import Struct

from contoursolve.diagnostics import Applicability, Diagnostic, Fix, Severity
from contoursolve.gcode import Word, parse
from contoursolve.notebook.exploration import Exploration
from contoursolve.program import changes_of

NEAR = 4
"""Fixes of a finding that are hardly less plausible than the first."""

MOST_FIXES = 8


class ReaderEdits(Struct, frozen=True):
    """The contour when nothing was found about it, and whether the last word was pulled by a slider or a handle: such a
    number is no slip of a typist."""

    calm: Exploration
    is_pulled: bool = False


class ArrangedFix(Struct, frozen=True):
    """A fix with its number in the finding, and the words that it changes although the reader left them alone."""

    number: int
    fix: Fix
    alone: tuple[str, ...] = ()


def is_calm(exploration: Exploration) -> bool:
    """Whether a contour is solved, and neither an error nor a warning is found."""
    answer = exploration.answer
    is_solved = answer is not None and answer.contour is not None
    return is_solved and all(each.severity is Severity.INFO for _, each in exploration.findings)


def arranged(exploration: Exploration, finding: Diagnostic, edits: ReaderEdits | None) -> list[ArrangedFix]:
    """The first fixes of a finding. One comes first that changes only what the reader has changed, if it is among the
    first ones: one that takes it back before others; where a word was pulled, any that moves it least."""
    fixes = finding.fixes[:MOST_FIXES]
    if edits is None:
        return [ArrangedFix(number, fix) for number, fix in enumerate(fixes)]
    # Where lines came in or went, the text alone tells words apart.
    is_by_line = len(edits.calm.result.program.blocks) == len(exploration.result.program.blocks)

    def marks(words: Iterable[tuple[int, Word]]) -> set[tuple[int, str]]:
        return {(line if is_by_line else 0, word.text) for line, word in words}

    old = marks(_words(edits.calm))
    is_edited = not marks(_words(exploration)) <= old
    shown, own = list[ArrangedFix](), list[tuple[float, int]]()
    for number, fix in enumerate(fixes):
        taken, written = _changed_by(exploration, finding, fix) if is_edited else ([], [])
        alone = tuple(word.text for line, word in taken if marks([(line, word)]) <= old)
        shown.append(ArrangedFix(number, fix, alone))
        is_whole = len(taken) == len(written) > 0 and fix.applicability is not Applicability.PLACEHOLDER
        if is_whole and not alone and edits.is_pulled:
            own.append((_distance(taken, written), number))
        elif is_whole and not alone and number < NEAR:
            own.append((float(not marks(written) <= old), number))
    if own and fixes[0].applicability is not Applicability.SAFE:
        shown.insert(0, shown.pop(min(own)[1]))
    return shown


def _words(exploration: Exploration) -> list[tuple[int, Word]]:
    return [(block.line, word) for block in exploration.result.program.blocks for word in block.words]


def _changed_by(
    exploration: Exploration, finding: Diagnostic, fix: Fix
) -> tuple[list[tuple[int, Word]], list[tuple[int, Word]]]:
    """The words that a fix takes out, and those that it writes, each with its line."""
    result = exploration.result
    old = {block.line: block.text for block in result.program.blocks}
    syntax, taken, written = result.program.syntax, list[tuple[int, Word]](), list[tuple[int, Word]]()
    for line, new in changes_of(fix, result.lines_of(finding), old).items():
        before, after = (
            [word for block in parse(text, syntax=syntax).blocks for word in block.words]
            for text in (old[line], new or "")
        )
        taken += [(line, word) for word in _without(before, after)]
        written += [(line, word) for word in _without(after, before)]
    return taken, written


def _without(words: Iterable[Word], others: Iterable[Word]) -> list[Word]:
    """Words without as many of the same text as there are among others."""
    left, kept = Counter(word.text for word in others), list[Word]()
    for word in words:
        if left[word.text]:
            left[word.text] -= 1
        else:
            kept.append(word)
    return kept


def _distance(taken: Iterable[tuple[int, Word]], written: Iterable[tuple[int, Word]]) -> float:
    """By how much numbers change; more than anything where other words are written."""
    total = 0.0
    for (_, one), (_, other) in zip(taken, written, strict=True):
        if one.address != other.address or one.number is None or other.number is None:
            return inf
        total += abs(float(one.number) - float(other.number))
    return total
