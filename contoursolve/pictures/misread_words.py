"""Words that are not read as they are meant: those that lack their decimal point, and those that are read in part."""

from collections.abc import Iterator, Mapping

from msgspec.structs import replace

from contoursolve.diagnosis import MOST_CHOICES, Answer, angle_text, count_choices, length_text
from contoursolve.diagnostics import Span
from contoursolve.gcode import FaultKind, Word
from contoursolve.geometry import Given, Unit, assemble
from contoursolve.pictures.known_points import is_chosen
from contoursolve.reading import ReadIssue
from contoursolve.solving import Status, analyse, is_closed, solve


def counted(answer: Answer) -> dict[Span, str]:
    """The words that lack their decimal point, by place: each with the value that it is read as."""
    lacking = {
        label.span for each in answer.diagnostics if each.about is ReadIssue.POINT_MISSING for label in each.labels
    }
    return {
        word.span: _reading(given, answer)
        for given in answer.profile.givens.values()
        if (word := given.word) is not None and word.span in lacking
    }


def _reading(given: Given, answer: Answer) -> str:
    value = given.as_typed(float(given.value))
    return length_text(value, answer.unit) if given.unit is Unit.MM else angle_text(value)


def is_mended_by(answer: Answer, lacking: Mapping[Span, str]) -> bool:
    """Whether a contour that is refused would be one if these words had their points."""
    profile, lexicon = answer.profile, answer.claim.lexicon
    if not answer.start.is_known:
        return False

    def pointed(given: Given) -> Given:
        word = given.word
        if word is None or word.span not in lacking or word.address not in lexicon.addresses:
            return given
        value = lexicon.value(replace(word, has_point=True), answer.unit)
        return replace(given, value=value if value is not None else given.value)

    meant = replace(profile, givens={name: pointed(given) for name, given in profile.givens.items()})
    system = assemble(meant)
    if not analyse(system).is_determined or not is_closed(system):
        return False
    if count_choices(meant) > MOST_CHOICES or not is_chosen(meant):
        return False
    return solve(meant, is_proven=False).status in (Status.SOLVED, Status.OVERDETERMINED)


def unread(answer: Answer) -> Iterator[Span]:
    """The stretches that cannot be read, each with the word whose end it should be, where findings point at them."""
    marked = {
        label.span
        for each in answer.diagnostics
        if each.is_error and isinstance(each.about, FaultKind)
        for label in each.labels
    }
    for block in answer.claim.blocks:
        for fault in block.faults:
            if any(_meet(fault.span, span) for span in marked):
                yield fault.span
                yield from (word.span for word in block.words if _is_torn(word, fault.span))


def _meet(one: Span, other: Span) -> bool:
    is_apart = one.end_column <= other.column or other.end_column <= one.column
    return one.line == other.line and not is_apart


def _is_torn(word: Word, fault: Span) -> bool:
    return word.span.end_column == fault.column
