"""Edits that repairs of every kind are made of: words dropped and changed, characters corrected, points added."""

import dataclasses
from collections.abc import Iterable, Iterator, Mapping
from decimal import Decimal
from itertools import product
from math import copysign

from contoursolve.diagnosis.edits import AT_MOST, Edit, EditKind, Why, change, drop, mend, write_word
from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.explain import spans_of
from contoursolve.diagnosis.spelling import meant_words, respelled, unanswerable, with_comma
from contoursolve.diagnostics import Diagnostic, Span
from contoursolve.gcode import FACT, FaultKind, Word, lookalike_at
from contoursolve.reading import ParsedContour
from contoursolve.solving import RefusalKind
from contoursolve.tolerance import INCREMENT


def commas(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """Words that an error is about, with the comma that their address lacks or without the one that it has not: all
    and each alone."""
    claim = answer.claim
    blamed = spans_of(each for each in answer.diagnostics if each.is_error)
    meant = meant_words(claim)
    unknown = [word for word in claim.unknown if not lookalike_at(meant, word.span)]
    others = [(word, with_comma(word, claim)) for word in claim.words.values() if word not in unknown]
    found = [*((word, respelled(word, claim)) for word in unknown), *others]
    found = [(word, text) for word, text in found if word.span in blamed]
    edits = [change(word, text) for word, text in found if text]
    if edits:
        yield tuple(edits)
    if len(edits) > 1:
        yield from ((edit,) for edit in edits)


def marked(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """Comments that look like facts with the mark that they lack."""
    for block in answer.claim.blocks:
        for each in block.unmarked:
            old = block.text[each.span.column - 1 : each.span.end_column - 1]
            yield (change(Word(FACT, None, False, old, each.span), each.text),)


OF_CORNERS = tuple(kind for kind in RefusalKind if kind.event.limits)
"""The events that a smaller corner mends."""


def fitting(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """Corners that do not fit with the largest size that does: each alone if the others stay, all of these, and those
    that leave each other no room with what is left for all."""
    claim = answer.claim
    findings = [each for each in answer.diagnostics if each.about in OF_CORNERS]
    if not findings or has_faults(claim):
        return
    limits = [dict(zip((label.span for label in each.labels), _limits(each), strict=False)) for each in findings]
    full = [each for each in findings if "together" in each.values]
    together = [{label.span: each.values["together"] for label in each.labels} for each in full]
    alone, shared = (list(_written(answer, sizes)) for sizes in (limits, together))
    yield from ((edit,) for edit in alone)
    for edits in (alone, shared):
        if len(edits) > 1:
            yield tuple(edits)


def _limits(finding: Diagnostic) -> list[float]:
    """The largest sizes of the corners that a finding is about, in the order of its labels, mm."""
    keys = finding.about.event.limits if isinstance(finding.about, RefusalKind) else ()
    return [finding.values[key] for key in keys if key in finding.values]


def _written(answer: Answer, sizes: Iterable[Mapping[Span, float]]) -> Iterator[Edit]:
    """The words with the smaller of the sizes (mm) that go with their places, where anything is left of them."""
    claim, unit = answer.claim, answer.claim.after.unit
    for name, word in claim.words.items():
        given = claim.givens.get(name)
        size = min((each[word.span] for each in sizes if word.span in each), default=None)
        if given is None or size is None or size >= abs(given.value):
            continue
        # A control may tell a chamfer from a rounding by the sign, which is none of the size's.
        signed = copysign(size, given.value if word.number is None else word.number)
        text = write_word(word.address, signed, claim.lexicon, unit, AT_MOST)
        if Decimal(claim.lexicon.number_of(text, word.address)):
            is_rounded = float(abs(given.value)) - size < _ROUNDED
            yield change(word, text, Why.ROUNDED if is_rounded else Why.FITS)


_ROUNDED = 2 * INCREMENT
"""mm. What rounding both ends of a line and the corner to the least increment may take from the corner."""


def moving(claim: ParsedContour, drafts: Iterable[tuple[Edit, ...]]) -> Iterator[tuple[Edit, ...]]:
    """Drafts, each that drops words which have nothing to do with the contour after the same one that moves them into
    blocks of their own. Between the blocks of a chain there is no place for them."""
    for edits in drafts:
        if len(claim.blocks) == 1:
            moved = tuple(dataclasses.replace(edit, kind=EditKind.MOVE) if _is_moved(edit) else edit for edit in edits)
            if moved != edits:
                # A block may have several of one letter, such as M08 and M30.
                spans = {edit.span for edit in edits}
                letters = {edit.address for edit in moved if edit.kind is EditKind.MOVE}
                more = (drop(word) for word in claim.blocks[0].words if word.address in letters)
                others = (each for each in more if each.span not in spans and _is_moved(each))
                yield (*moved, *(dataclasses.replace(each, kind=EditKind.MOVE) for each in others))
        yield edits


def _is_moved(edit: Edit) -> bool:
    return edit.kind is EditKind.DROP and edit.errand is not None and edit.errand.side is not None


def has_faults(claim: ParsedContour) -> bool:
    """Whether some characters are no word, so that it is not known which words the block has."""
    return any(fault.kind is not FaultKind.COMMENT_NOT_CLOSED for block in claim.blocks for fault in block.faults)


def unreadable(claim: ParsedContour) -> Iterator[tuple[Edit, ...]]:
    """Mistakes that every repair must take out or correct: characters, addresses without a meaning, repetitions. Of an
    address that is given twice, either word may be the one that is meant. Letters for digits become these."""
    meant = meant_words(claim)
    edits = [mend(each) for each in meant]
    unknown = [word for word in claim.unknown if not lookalike_at(meant, word.span)]
    edits += [drop(word) for word in (*unknown, *unanswerable(claim))]
    for block in claim.blocks:
        for fault in block.faults:
            if fault.kind is FaultKind.COMMENT_NOT_CLOSED or lookalike_at(meant, fault.span):
                continue
            edits.append(Edit(EditKind.DROP, fault.address, fault.span, fault.text))
    either = [
        [drop(word), *(drop(first) for first in claim.words.values() if _is_same(first, word))]
        for word in claim.repeated
    ]
    for choice in product(*either):
        yield (*edits, *choice)


def _is_same(first: Word, word: Word) -> bool:
    return first.address == word.address and first.span.line == word.span.line and first.number != word.number
