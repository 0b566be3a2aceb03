"""Two slips at once: where none alone explains what is wrong, one that takes some of it away, and one that mends what
is left then."""

from collections.abc import Iterator
from itertools import islice

from contoursolve.diagnosis.attempt import SHORT, Trial
from contoursolve.diagnosis.edits import Edit
from contoursolve.diagnosis.explain import spans_of
from contoursolve.diagnosis.plausibility import Feature
from contoursolve.diagnosis.reach import is_of_codes
from contoursolve.diagnosis.slip_kinds import FEW
from contoursolve.diagnosis.slips_around import Candidate, Marked, drafts_around, touches
from contoursolve.diagnosis.window import Seen
from contoursolve.diagnostics import Diagnostic

MOST_FIRST, MOST_PAIRS = 16, 40
"""Slips of which each is looked at alone, and pairs that are tried; the corpus of pairs gains nothing by more."""

MOST_LACKING = 2
"""Facts that may be missing: each slip hides one word at most, unless it is of a code."""

SECOND = 1.0
"""The cost of a second slip besides that of its kind: two are less likely than one."""


def two_slips(trial: Trial) -> list[Candidate]:
    """Pairs of slips around a contour, the most plausible first; none of a long one, whose every trial takes longer, of
    one of which facts are stated or words are asked, or of one with the finding of the contour before: that has one
    cause."""
    if len(trial.claim.blocks) > SHORT or trial.claim.directives or trial.answer.profile.questions:
        return []
    first_line = trial.window.lines[0]
    ahead = {each.code for each in trial.window.before.problems if each.span.line < first_line}
    if any(each.code in ahead for each in _own(trial, trial.window.before)):
        return []
    found = dict[frozenset[Edit], Candidate]()
    drafts = dict[frozenset[tuple[str, int]], list[Candidate]]()
    is_lacking = trial.prospects is not None and trial.prospects.lacking > MOST_LACKING
    # What cannot be read is an error until an edit touches it.
    torn = {each.span for block in trial.window.own for each in block.faults}
    for first in islice(_drafts(trial, trial.marked), MOST_FIRST):
        if torn and not any(touches(edit, span) for edit in first.edits for span in torn):
            continue
        if is_lacking and not any(map(is_of_codes, first.edits)):
            continue
        left = _left(trial, first.edits)
        if not left:
            continue
        key = frozenset((each.code, each.span.line) for each in left)
        if key not in drafts:
            spans = frozenset(spans_of(left))
            marked = Marked(spans, frozenset(span.line for span in spans), " ".join(each.message for each in left))
            drafts[key] = [*islice(_drafts(trial, marked), MOST_FIRST)]
        for second in drafts[key]:
            if not any(_meet(one, two) for one in first.edits for two in second.edits):
                found.setdefault(frozenset({*first.edits, *second.edits}), both(first, second))
    pairs = sorted(found.values(), key=lambda each: round(each.cost, 6))[:MOST_PAIRS]
    prospects = trial.prospects
    return [each for each in pairs if prospects is None or prospects.has(each.edits, is_double=True)]


def _drafts(trial: Trial, marked: Marked) -> Iterator[Candidate]:
    """The slips of few texts around what is marked, each in one block, the most plausible first."""
    drafts = drafts_around(trial.window, marked, trial.claim, FEW)
    return (each for each in drafts if len({edit.place for edit in each.edits}) == 1)


def _left(trial: Trial, edits: tuple[Edit, ...]) -> list[Diagnostic]:
    """The findings that are left with edits that take some of what is wrong away, or that change what it is about; none
    where they do neither."""
    window, seen = trial.window, trial.window.after(edits)
    if seen is None:
        return []
    old, new = (_own(trial, each) for each in (window.before, seen))
    gone = {(each.code, each.span.line) for each in old} - {(each.code, each.span.line) for each in new}
    is_about = all(edit.span in trial.marked.spans for edit in edits)
    return window.left(seen) if gone or is_about else []


def _own(trial: Trial, seen: Seen) -> list[Diagnostic]:
    return [each for each in seen.problems if each.span.line in trial.window.lines]


def _meet(one: Edit, two: Edit) -> bool:
    """Whether two edits change the same place."""
    if one.span is None or two.span is None:
        return one.place == two.place and one.address == two.address
    return touches(one, two.span)


def both(first: Candidate, second: Candidate) -> Candidate:
    """Both as one, in the order of the text."""
    parts = sorted((first, second), key=lambda each: min(edit.place for edit in each.edits))
    amounts = dict.fromkeys(Feature, 0.0)
    for feature, amount in (*first.evidence, *second.evidence, (Feature.KIND, SECOND)):
        amounts[feature] += amount
    evidence = tuple((feature, amount) for feature, amount in amounts.items() if amount)
    edits = tuple(edit for each in parts for edit in each.edits)
    slips = tuple(slip for each in parts for slip in each.slips)
    return Candidate(edits, slips, evidence)
