"""Numbers without a decimal point: the control counts them in least increments, which is seldom what was meant."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal

from msgspec.structs import replace

from contoursolve.diagnosis.explain import Context, report, spans_of
from contoursolve.diagnosis.spelling import meant_words
from contoursolve.diagnosis.wording import angle_text, join, length_text
from contoursolve.diagnostics.finding import Basis, Diagnostic, Severity
from contoursolve.diagnostics.source import Span
from contoursolve.gcode import Word, lookalike_at, spell
from contoursolve.geometry import Given, Length, Unit
from contoursolve.reading import Lexicon, ParsedContour, Position, ReadIssue, WithoutPoint

_FULL_TURN, _MANY_INCREMENTS = 360, 1_000
"""A number that is no larger says a direction in degrees, or a length under 1 mm in least increments."""


def without_point(context: Context, claim: ParsedContour, findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Words that are read in least increments because they have no decimal point: each where others have one, and all
    together where none has and the values are hardly meant like this."""
    counted = _counted(context, claim)
    words = list(counted)
    about = ReadIssue.POINT_MISSING
    if any(given.word and given.word.number and given.word.has_point for given in claim.givens.values()):
        for word, value in counted.items():
            yield report(context, about, Basis.RULE, [word], actual=value)
    elif words and _is_slip(claim, words, has_error=any(each.severity is Severity.ERROR for each in findings)):
        yield report(context, about, Basis.RULE, words, actual=join(list(counted.values())))


def start_without_point(context: Context, claim: ParsedContour, findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """The words before a contour that put its start less than 1 mm from zero because they have no decimal point, where
    other words have one, or those of the contour are hardly meant like this, either."""
    places = [claim.before.axes[axis] for axis in claim.before.plane.axes]
    words = {each.word.span: each.word for each in places if each.word and is_counted_start(each, claim.lexicon)}
    if not words or any(each.value is None for each in places):
        return
    stated = (*(given.word for given in claim.givens.values()), *(each.word for each in places))
    is_suspected = any(each.about is ReadIssue.POINT_MISSING for each in findings)
    if is_suspected or any(word.has_point for word in stated if word):
        yield _start_counted(context, claim, [words[span] for span in sorted(words)])


def is_counted_start(position: Position, lexicon: Lexicon) -> bool:
    """Whether a coordinate was set by so few least increments that the number may be meant as it stands."""
    return position.word is not None and counts_few(position.word, lexicon)


def counts_few(word: Word, lexicon: Lexicon) -> bool:
    """Whether the number of a length counts so few least increments that it may be meant as it stands."""
    if word.has_point or not word.number or abs(word.number) > _MANY_INCREMENTS:
        return False
    return lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS


def readings(word: Word, lexicon: Lexicon, unit: Length) -> tuple[str, str, str]:
    """A length that counts least increments: its value, the value that it has with a point, and the word with a point
    for the first."""
    number, step = word.number or Decimal(0), lexicon.numbers.step(Unit.MM, unit)
    actual, expected = (length_text(float(number * scale * unit.in_mm), unit) for scale in (step, 1))
    return actual, expected, spell(word.address, f"{number * step:f}".rstrip("0"))


def _start_counted(context: Context, claim: ParsedContour, words: Sequence[Word]) -> Diagnostic:
    """That words of the start point count least increments."""
    actual, expected, same = zip(*(readings(word, claim.lexicon, claim.before.unit) for word in words), strict=True)
    return report(
        context,
        ReadIssue.START_IN_INCREMENTS,
        Basis.RULE,
        words,
        actual=join(actual),
        expected=join(expected),
        meant=join([f"{word.text.strip()}." for word in words]),
        same=join(same),
    )


def tell_points(context: Context, claim: ParsedContour, findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Findings, the errors about a word that lacks its point with how it was read, before what else may be done."""
    findings = list(findings)
    lacking = spans_of(findings, ReadIssue.POINT_MISSING)
    counted = (
        {word: value for word, value in _counted(context, claim).items() if word.span in lacking} if lacking else {}
    )
    for finding in findings:
        spans = spans_of([finding])
        blamed = {word: value for word, value in counted.items() if word.span in spans}
        if not blamed or finding.severity is Severity.INFO or finding.basis is not Basis.NUMERICAL:
            yield finding
            continue
        notes = tuple(f"{word.text} is read as {value}: it has no decimal point" for word, value in blamed.items())
        meant = join([f"{word.text}." for word in blamed])
        yield replace(finding, notes=notes + finding.notes, help=f"write {meant} if that is meant; else {finding.help}")


def _counted(context: Context, claim: ParsedContour) -> Mapping[Word, str]:
    """The words of a contour that count least increments, each with its value in the order of the block."""
    counted = {}
    pointless = [each for each in claim.givens.values() if each.word and not each.word.has_point]
    # Such as A18 in A18O.
    torn = meant_words(claim) if pointless else ()
    for given in sorted(pointless, key=_place):
        word = given.word
        if word is None or not word.number or given.unit is Unit.SIGN or lookalike_at(torn, word.span):
            continue
        typed = given.value * 2 if given.is_diameter else given.value
        if abs(typed) < abs(word.number):
            is_length = given.unit is Unit.MM
            counted[word] = length_text(float(typed), context.unit) if is_length else angle_text(float(typed))
    return counted


def _place(given: Given) -> Span:
    return given.word.span if given.word else Span(0, 0, 0)


def _is_slip(claim: ParsedContour, words: Sequence[Word], *, has_error: bool) -> bool:
    """Whether words without any point mean what they say: their angles would be directions in degrees, or without
    an angle a block that is refused would have no length of 1 mm."""
    angles = [word for word in words if claim.lexicon.addresses[word.address].unit is Unit.DEGREE]
    most = _FULL_TURN if angles else _MANY_INCREMENTS
    return (bool(angles) or has_error) and all(
        word.number is None or abs(word.number) <= most for word in angles or words
    )
