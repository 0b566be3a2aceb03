"""What ends a range of values, in the user's words."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from enum import Enum

from contoursolve.examine import Answer
from contoursolve.families.case_classes import CaseClass
from contoursolve.families.spec import errors_of
from contoursolve.model import Line
from contoursolve.solving import RefusalKind
from contoursolve.solving.checks import Check
from contoursolve.wording import join, unknowns_text


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a contour does not exist beyond an end.

    `text` says it about the word, such as "P too large for line 2: 6.340 mm at most"; `code` and `message` are those
    of the finding about a block just beyond the end (empty where that finding is only about rounding).
    """

    text: str
    code: str
    message: str


NO_FAILURE: tuple[Reason, Enum | None] = Reason("", "", ""), None


def failure_of(answer: Answer) -> tuple[Reason, Enum | None]:
    """The first error that a single solve finds, in its own words, and the event that it is about."""
    error = next(iter(errors_of(answer)), None)
    # Close to a singular case rounding alone keeps the equations from holding.
    if error is None or error.about is RefusalKind.NOT_VERIFIED:
        return NO_FAILURE
    return Reason(error.message, error.code, error.message), error.about


def words_of(case: CaseClass, givens: Iterable[str]) -> str:
    """The words that state values, the free ones without their numbers."""
    texts = []
    for name in givens:
        given = case.profile.givens.get(name)
        if name in case.free:
            texts.append(called(case.free[name].word))
        elif given is not None and given.word is not None:
            texts.append(given.word.text)
    return join(list(dict.fromkeys(texts)))


def phrase(check: Check, kind: RefusalKind, case: CaseClass) -> str:
    """What fails where a check does not pass, without values."""
    return _PHRASES[kind](check, case)


def _parallel(check: Check, case: CaseClass) -> str:
    figure = case.profile.figure
    lines = [each.name for each in figure.path if isinstance(each, Line) and each.heading in check.givens]
    if len(lines) > 1:
        return f"{join(lines)} are parallel"
    if lines:
        others = tuple(name for name in check.givens if name != figure.line(lines[0]).heading)
        if others:
            return f"{lines[0]} is parallel to what {words_of(case, others)} states"
        point, _, axis = check.subject.partition(".")
        if not axis.isdigit():
            return f"{lines[0]} is parallel to the line that it must meet"
        letter = case.profile.plane.axes[int(axis)]
        return f"{lines[0]} runs along {letter}, so that nothing fixes {letter} of {point}"
    free = unknowns_text(check.subject.split(","), case.profile)
    return f"{words_of(case, check.givens) or 'the words'} leave {free} open"


def _too_large(check: Check, case: CaseClass) -> str:
    """Of one corner, or of all on an element."""
    sizes = [
        corner.size
        for corner in case.profile.figure.corners
        if check.subject in (corner.name, corner.before, corner.after, corner.lands_on)
    ]
    where = check.element or "its lines"
    # Of several corners on an element, the free ones are those to change.
    words = words_of(case, [size for size in sizes if size in case.free] or sizes)
    return f"{words} too large for {where}" if words else f"{check.subject} does not fit on {where}"


def _reversed(check: Check, case: CaseClass) -> str:
    angle = words_of(case, tuple(filter(None, (case.profile.figure.line(check.element).heading,))))
    return f"{check.element} would run against {angle or 'its direction'}"


def _disagrees(check: Check, case: CaseClass) -> str:
    return f"{words_of(case, (check.subject,))} disagrees with the other words"


def _apart(check: Check, case: CaseClass) -> str:
    words = words_of(case, check.givens) or "the words"
    return f"{words} {'cannot hold together' if len(check.givens) > 1 else 'does not hold'}"


def called(word: str) -> str:
    """The name of a word in a sentence."""
    line, _, address = word.rpartition(":")
    return f"{address} of block {line}" if line else address


def _always(text: str) -> Callable[[Check, CaseClass], str]:
    return lambda check, _: text.format(subject=check.subject)


_PHRASES: Mapping[RefusalKind, Callable[[Check, CaseClass], str]] = {
    RefusalKind.LINES_PARALLEL: _parallel,
    RefusalKind.NOT_FIXED: _parallel,
    RefusalKind.POINT_IS_START: _always("the point of the line is its start point"),
    RefusalKind.CIRCLE_MISSED: _always("the line misses the circle"),
    RefusalKind.RADIUS_TOO_SMALL: _always("the radius is smaller than half the way between its two points"),
    RefusalKind.CIRCLES_APART: _always("the circles do not meet"),
    RefusalKind.CIRCLE_UNDEFINED: _always("the circle has no radius"),
    RefusalKind.WORDS_DISAGREE: _disagrees,
    RefusalKind.FACT_DISAGREES: _always("the words disagree about {subject}"),
    RefusalKind.RADIUS_DIFFERENCE: _always("the points of the circle differ in radius"),
    RefusalKind.LINE_REVERSED: _reversed,
    RefusalKind.LINE_BACKWARDS: _always("{subject} would run backwards"),
    RefusalKind.CORNER_TOO_LARGE: _too_large,
    RefusalKind.CORNERS_OVERLAP: _too_large,
    RefusalKind.CORNER_STRAIGHT: _always("{subject} joins two lines of one direction"),
    RefusalKind.CORNER_REVERSES: _always("{subject} turns back by 180 deg"),
    RefusalKind.BEVEL_OUTSIDE: _always("the bevel of {subject} lies outside the rectangle of its lines"),
    RefusalKind.BEVEL_IN_BAND: _always("no 45 deg bevel joins the lines of {subject}"),
    RefusalKind.LANDING_UNKNOWN: _always("no line advances along the line that {subject} lands on"),
    RefusalKind.NO_POINT: _apart,
    RefusalKind.ARC_EMPTY: _always("{subject} ends where it begins"),
    RefusalKind.OUT_OF_RANGE: _always("a point lies farther away than words reach"),
}


def same(one: RefusalKind, other: RefusalKind) -> bool:
    """Whether two kinds are told by one check."""
    return one is other or any({one, other} <= kinds for kinds in _TOGETHER)


_TOGETHER = (
    {RefusalKind.CORNER_STRAIGHT, RefusalKind.CORNER_REVERSES},
    {RefusalKind.LINES_PARALLEL, RefusalKind.NOT_FIXED},
)
