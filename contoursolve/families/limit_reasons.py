"""What ends a range of values, in the user's words."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from enum import Enum

from contoursolve.examine import Answer
from contoursolve.families.spec import errors_of
from contoursolve.model import Line, Profile
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
    return (Reason(error.message, error.code, error.message), error.about) if error is not None else NO_FAILURE


@dataclass(frozen=True, slots=True)
class About:
    """What a phrase may mention: the free words as their user calls them, by the values that follow them, and the
    drawing."""

    free: Mapping[str, str]
    profile: Profile

    def words(self, givens: Iterable[str]) -> str:
        """The words that state values, the free ones without their numbers."""
        texts = []
        for name in givens:
            given = self.profile.givens.get(name)
            if name in self.free:
                texts.append(self.free[name])
            elif given is not None and given.word is not None:
                texts.append(given.word.text)
        return join(list(dict.fromkeys(texts)))

    def sizes(self, check: Check) -> tuple[str, ...]:
        """The sizes of the corners that a check is about: of one corner, or of all on an element."""
        return tuple(
            corner.size
            for corner in self.profile.figure.corners
            if check.subject in (corner.name, corner.before, corner.after, corner.lands_on)
        )

    def lines(self, givens: tuple[str, ...]) -> list[str]:
        """The lines whose angles are among some values."""
        path = self.profile.figure.path
        return [each.name for each in path if isinstance(each, Line) and each.heading in givens]


def phrase(check: Check, kind: RefusalKind, about: About) -> str:
    """What fails where a check does not pass, without values."""
    return _PHRASES[kind](check, about)


def _parallel(check: Check, about: About) -> str:
    lines = about.lines(check.givens)
    if len(lines) > 1:
        return f"{join(lines)} are parallel"
    if lines:
        others = tuple(name for name in check.givens if name != about.profile.figure.line(lines[0]).heading)
        if others:
            return f"{lines[0]} is parallel to what {about.words(others)} states"
        point, _, axis = check.subject.partition(".")
        if not axis.isdigit():
            return f"{lines[0]} is parallel to the line that it must meet"
        letter = about.profile.plane.axes[int(axis)]
        return f"{lines[0]} runs along {letter}, so that nothing fixes {letter} of {point}"
    free = unknowns_text(check.subject.split(","), about.profile)
    return f"{about.words(check.givens) or 'the words'} leave {free} open"


def _too_large(check: Check, about: About) -> str:
    sizes = about.sizes(check)
    where = check.element or "its lines"
    # Of several corners on an element, the free ones are those to change.
    words = about.words([size for size in sizes if size in about.free] or sizes)
    return f"{words} too large for {where}" if words else f"{check.subject} does not fit on {where}"


def _reversed(check: Check, about: About) -> str:
    angle = about.words(tuple(filter(None, (about.profile.figure.line(check.element).heading,))))
    return f"{check.element} would run against {angle or 'its direction'}"


def _disagrees(check: Check, about: About) -> str:
    return f"{about.words((check.subject,))} disagrees with the other words"


def _apart(check: Check, about: About) -> str:
    words = about.words(check.givens) or "the words"
    return f"{words} {'cannot hold together' if len(check.givens) > 1 else 'does not hold'}"


def about_of(free: Mapping[str, tuple[str, object]], profile: Profile) -> About:
    """What a phrase may mention of a profile whose values follow free words."""
    return About({given: called(word) for given, (word, _) in free.items()}, profile)


def called(word: str) -> str:
    """The name of a word in a sentence."""
    line, _, address = word.rpartition(":")
    return f"{address} of block {line}" if line else address


def _always(text: str) -> Callable[[Check, About], str]:
    return lambda check, _: text.format(subject=check.subject)


_PHRASES: Mapping[RefusalKind, Callable[[Check, About], str]] = {
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
