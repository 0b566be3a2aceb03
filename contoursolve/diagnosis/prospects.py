"""Slips that cannot be what is wrong, told by the words that they change before anything is read or solved again."""

from collections.abc import Collection, Iterable, Sequence

from msgspec import Struct

from contoursolve.diagnosis.edits import Edit, EditKind
from contoursolve.diagnosis.examine import Answer, problems
from contoursolve.diagnosis.explain import spans_of
from contoursolve.diagnosis.reach import Reach, is_of_codes
from contoursolve.diagnosis.slip_kinds import number_in
from contoursolve.diagnosis.slips_around import is_lasting, touches
from contoursolve.diagnostics import Diagnostic, Span
from contoursolve.gcode import Block
from contoursolve.geometry import Fact, assemble
from contoursolve.reading import ReadIssue, Rule
from contoursolve.solving import NoteKind, RefusalKind, Topic, analyse, refusals_about

_OF_WORDS = (
    ReadIssue.REPEATED_ADDRESS,
    ReadIssue.UNKNOWN_ADDRESS,
    ReadIssue.WORD_IGNORED,
    ReadIssue.WORD_UNUSED,
    ReadIssue.UNDERDETERMINED,
    ReadIssue.CORNER_NOWHERE,
    ReadIssue.CORNER_TWICE,
    ReadIssue.POSITION_UNKNOWN,
    ReadIssue.VARIABLE,
    NoteKind.SEVERAL,
)
"""Matters of a problem that rests on which words there are, whatever their numbers."""

_OF_A_BLOCK = (ReadIssue.REPEATED_ADDRESS, ReadIssue.UNKNOWN_ADDRESS, ReadIssue.VARIABLE)
"""Matters that only an edit of the words themselves, or a code in force, can mend."""

_TOO_LARGE = (RefusalKind.CORNER_TOO_LARGE, RefusalKind.CORNERS_OVERLAP)
"""Matters of corners that fit if they are smaller."""

_OF_RADII = refusals_about(Topic.RADII)
"""Matters of circles that miss their points."""

_BESIDE = 1
"""Blocks on either side of the one that a rule refuses that may have the word that it lacks."""


class Prospects(Struct, frozen=True):
    """The places that edits must touch to undo what is wrong with a contour."""

    is_of_words: bool
    """Whether something is wrong that no other number mends."""
    is_of_choice: bool
    """Whether all that is wrong is that no word chooses."""
    lines: tuple[frozenset[int], ...]
    """Of the lines of each, one has to be changed, unless a code in force is."""
    words: tuple[frozenset[Span], ...]
    """Of the words of each, one has to be changed, unless a code in force is."""
    conflicts: tuple[frozenset[Span], ...]
    """The words of each contradiction."""
    values: tuple[frozenset[Span], ...]
    """The words whose values a rule refuses."""
    sizes: frozenset[Span]
    """Words of corners that are too large to fit."""
    idle: frozenset[Span]
    """Words of corners, where all that is wrong is that circles miss their points."""
    own: frozenset[int]
    """The lines of the contour."""
    lacking: int
    """The number of facts that are missing."""
    reach: Reach | None

    @classmethod
    def of(
        cls,
        answer: Answer,
        rules: Iterable[Rule],
        conflicts: Iterable[Sequence[Fact]] = (),
        reach: Reach | None = None,
        blocks: Sequence[Block] = (),
    ) -> "Prospects":
        """Those of a contour, with the facts of each contradiction in it; `blocks` are those around it."""
        claim = answer.claim
        rules = tuple(rules)
        by_values = {rule.code for rule in rules if rule.when is not None and rule.when.reads_values}
        of_geometry = by_values | {rule.code for rule in rules if rule.is_about_geometry}
        found = problems(answer)
        of_words = [each for each in found if _is_of_words(each, of_geometry)]
        is_open = any(each.about is ReadIssue.UNDERDETERMINED for each in answer.diagnostics)
        is_round = all(each.about in _OF_RADII for each in found)
        order = [block.line for block in blocks or claim.blocks]
        words = claim.words
        spans = (frozenset(words[fact.given].span for fact in facts if fact.given in words) for facts in conflicts)
        return cls(
            bool(of_words) or is_open,
            bool(found) and all(each.about is NoteKind.SEVERAL for each in found),
            # A rule about a chain may mind a word anywhere in it.
            tuple(_lines_of(each, order) for each in of_words if each.about is None and not claim.form.is_general),
            tuple(frozenset(spans_of([each])) for each in of_words if each.about in _OF_A_BLOCK),
            tuple(filter(None, spans)),
            tuple(frozenset(spans_of([each])) for each in found if each.about is None and each.code in by_values),
            frozenset(each.span for each in found if each.about in _TOO_LARGE),
            frozenset(words[name].span for name in claim.form.outline.shapes if name in words and is_round),
            frozenset(block.line for block in claim.blocks),
            _lacking(answer),
            reach,
        )

    def has(self, edits: tuple[Edit, ...], *, is_double: bool = False) -> bool:
        """Whether the edits may undo all that is wrong, as one slip or as two."""
        touched = {edit.span.line if edit.span else edit.line for edit in edits}
        is_of_code = any(edit.address == "G" for edit in edits)
        is_everywhere = any(map(is_lasting, edits))
        is_of_numbers = not is_of_code and all(map(keeps_address, edits))
        if is_of_numbers and not self._is_number(edits):
            return False
        if self.is_of_choice and not is_of_code and all(edit.kind is not EditKind.ADD for edit in edits):
            return False
        if self.lacking > _MOST_FACTS * len(edits) and not any(map(is_of_codes, edits)):
            return False
        for spans in () if is_everywhere else self.words:
            # Elsewhere, it means nothing either.
            if (len(touched) > 1 and not is_double) or not touched & {span.line for span in spans}:
                return False
            if not is_of_code and not any(touches(edit, span) for edit in edits for span in spans):
                return False
        if not is_of_code and not all(touched & lines for lines in self.lines):
            return False
        if self.reach is not None and self.reach.leaves_a_problem(edits, parts=True):
            return False
        if is_of_code or not touched <= self.own:
            return True
        return all(_is_about(edits, spans, is_of_numbers=is_of_numbers) for spans in self.conflicts)

    def is_in_vain(self, span: Span) -> bool:
        """Whether no other word in place of one undoes all that is wrong."""
        return self.reach is not None and self.reach.is_in_vain(span)

    def _is_number(self, edits: tuple[Edit, ...]) -> bool:
        """Whether other numbers of these words may undo all that is wrong."""
        is_in_each = all(any(edit.span in spans for edit in edits) for spans in self.values)
        is_idle = all(edit.span in self.idle for edit in edits)
        is_larger = all(edit.span in self.sizes for edit in edits) and not any(map(_is_less, edits))
        return not self.is_of_words and is_in_each and not is_idle and not is_larger


def _lacking(answer: Answer) -> int:
    system = assemble(answer.profile)
    return len(system.unknowns) - analyse(system).rank


_MOST_FACTS = 3
"""Facts that one word, or the code of a block of Klartext, states at most: the centre and the radius of a circle."""


def _is_of_words(finding: Diagnostic, of_geometry: Collection[str]) -> bool:
    return finding.about in _OF_WORDS or (finding.about is None and finding.code not in of_geometry)


def _lines_of(finding: Diagnostic, order: list[int]) -> frozenset[int]:
    lines = {finding.span.line, *(label.span.line for label in finding.labels)}
    places = [at for at, line in enumerate(order) if line in lines]
    near = {each for at in places for each in range(at - _BESIDE, at + _BESIDE + 1)}
    return frozenset(line for at, line in enumerate(order) if at in near)


def _is_about(edits: tuple[Edit, ...], spans: frozenset[Span], *, is_of_numbers: bool) -> bool:
    """Whether edits change a word of a contradiction; where they change more than numbers, something of its blocks."""
    if is_of_numbers:
        return any(edit.span in spans for edit in edits)
    lines = {span.line for span in spans}
    return any((edit.span.line if edit.span else edit.line) in lines for edit in edits)


def keeps_address(edit: Edit) -> bool:
    """Whether a word keeps its address, and gets another number."""
    return edit.kind is EditKind.CHANGE and edit.old.strip().rstrip(_NUMBER) == edit.text.strip().rstrip(_NUMBER)


def _is_less(edit: Edit) -> bool:
    new, old = (number_in(text) for text in (edit.text, edit.old))
    return not new or not old or float(new) < float(old)


_NUMBER = "+-.0123456789"
