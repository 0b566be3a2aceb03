"""Ranges of one word's values in which a contour is solved, all of them, and what ends each."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from decimal import Decimal
from enum import Enum
from itertools import groupby
from math import inf
from typing import Unpack

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import (
    DECIMALS,
    Answer,
    called_in_program,
    element_text,
    join,
    limit_text,
    unknowns_text,
    value_text,
)
from contoursolve.diagnostics import Shown
from contoursolve.families.block_template import BlockOptions, called, errors_of, first_error, message_of, spec_of
from contoursolve.families.case_classes import CaseClass
from contoursolve.families.free_words import check_block
from contoursolve.families.range_pieces import RangePiece, RangeSearch
from contoursolve.geometry import Line
from contoursolve.numeric import Created
from contoursolve.program import takes
from contoursolve.reading import Premises
from contoursolve.solving import Check, NoteKind, RefusalKind, Topic, refusals_about, typed_limit

_ASIDE = (1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4)
"""Share of an end (at least of 1). How far beside it single solves are tried, until they tell its two sides apart."""


class Reason(Struct, frozen=True):
    """Reason against a contour beyond an end.

    `text` says it about the word, such as "P is too large for the second straight: P at most 6.340 mm"; `code` and
    `message` are those of the finding about a block just beyond the end (empty where that finding is only about
    rounding).
    """

    text: str
    code: str
    message: str


NO_FAILURE: tuple[Reason, Enum | None] = Reason("", "", ""), None


def failure_of(answer: Answer) -> tuple[Reason, Enum | None]:
    """The first error that a single solve finds, in its own words, and the event that it is about."""
    error = next(iter(errors_of(answer)), None)
    # Close to a singular case rounding alone keeps the equations from holding.
    if error is None or error.about in refusals_about(Topic.ARITHMETIC):
        return NO_FAILURE
    message = message_of(error, answer)
    return Reason(message, error.code, message), error.about


class Way(Enum):
    """Ways in which an end was found."""

    CLOSED_FORM = "closed form"
    """As a zero of a polynomial of degree 1 or 2 in the word."""
    BISECTION = "bisection"
    """By dividing a stretch outside of which it is proven that there is no end."""
    RULE = "rule"
    """A rule begins to refuse there, or the words are read in another way."""
    MOVED = "moved"
    """There a result has moved as far as it may (see `tolerance_for`)."""
    RANGE = "range"
    """The range that was asked about ends there; the contour goes on."""


class End(Struct, frozen=True):
    """One end of a range of values with a contour.

    `value` is as the word is written. `reason` says what fails beyond it; None where only the range that was asked
    about ends. At `inside` a single solve has the contour, at `outside` it has none; None where no values close to the
    end tell so. `is_included` tells whether the value itself has the contour. `typed` and `listed` are
    the limit with the decimals of a message and of a listing: typed in like that, it has the contour.
    """

    value: float
    way: Way
    reason: Reason | None
    is_included: bool
    inside: float | None
    outside: float | None
    typed: Decimal
    listed: Decimal

    @property
    def is_verified(self) -> bool:
        """Whether single solves agree on its two sides, as far as it has two."""
        return self.way is Way.RANGE or None not in (self.inside, self.outside)


class Interval(Struct, frozen=True):
    """A range of a word's values in all of which the contour is solved; both ends are the same for a single value."""

    low: End
    high: End

    def __contains__(self, value: float) -> bool:
        for end in (self.low, self.high):
            if value == end.value:
                return end.is_included
        return self.low.value < value < self.high.value


class FeasibleRange(Shown, Struct, frozen=True):
    """All values of a word, within a range, with which its block has a contour: a sequence of `intervals`.

    All values are as the word is written. Without `doubts`, it is proven that nothing wider than `LEAST_GAP` is
    missing; else these are some of the ranges.

    Attributes:
        word: the word by its name, such as `P`.
        unit: what it is written in: mm, inch or deg.
        stated: the value that the block has.
        within: the range that was searched, from one value to another.
        intervals: the ranges with a contour, in order; each end says what ends it.
        doubts: why more values may have a contour.
        refusal: the error of the block as it stands; empty if it has a contour.
        is_diameter: whether the values are diameters.
        is_open: whether it is a variable without a value; `stated` says nothing then.
        premises: what the contours assume besides the words.
        holds: the verb of a sentence about the ranges.
        warnings: warnings that no value of the word ends.
    """

    word: str
    unit: str
    stated: float
    within: tuple[float, float]
    intervals: tuple[Interval, ...]
    doubts: tuple[str, ...]
    refusal: str
    is_diameter: bool = False
    is_open: bool = False
    premises: Premises = Premises()
    holds: str = "with a contour"
    warnings: tuple[str, ...] = ()

    @property
    def is_complete(self) -> bool:
        """Whether these are proven to be all."""
        return not self.doubts

    @property
    def largest(self) -> float:
        """The value up to which all from the least one on have the contour; 0 where that one has none."""
        first = self.intervals[0] if self.intervals else None
        return first.high.value if first is not None and first.low.reason is None else 0.0

    def __contains__(self, value: float) -> bool:
        return any(value in each for each in self.intervals)

    def __len__(self) -> int:
        return len(self.intervals)

    def __iter__(self) -> Iterator[Interval]:
        return iter(self.intervals)

    def __getitem__(self, number: int) -> Interval:
        return self.intervals[number]


@takes(BlockOptions)
def feasible(
    block: str,
    word: str,
    *,
    within: tuple[float, float] | None = None,
    **options: Unpack[BlockOptions],
) -> FeasibleRange:
    """Every range of a word's values, as it is written, in which the contour is solved; see `contoursolve.ranges`.

    The search divides the range into stretches. In each of them intervals bound all checks of a contour, so that it
    overlooks no part. It computes each end, and solves the block on both sides.
    """
    spec = spec_of(block, (word,), **options)
    template = spec.template()
    is_open = bool(template.variables.keys() - dict(spec.variables).keys())
    check_block(template)
    search = RangeSearch(template)
    low, high = search.range_of(within)
    pieces, intervals = search.pieces(low, high), list[Interval]()
    for is_solved, group in groupby(range(len(pieces)), key=lambda number: pieces[number].is_solved):
        first, *rest = group
        if is_solved:
            last = rest[-1] if rest else first
            intervals.append(
                Interval(end_of_range(search, pieces, first, last, -1), end_of_range(search, pieces, last, first, +1))
            )
    refusal = "" if is_open else first_error(search.answer)
    about = (search.word, search.unit, search.stated, (low, high))
    doubts = tuple(search.doubts)
    return FeasibleRange(*about, tuple(intervals), doubts, refusal, search.diameters[0], is_open, search.premises)


def end_of_range(search: RangeSearch, pieces: Sequence[RangePiece], number: int, other: int, way: int) -> End:
    """The lower (-1) or upper (+1) end of a range from one piece to another, of which `number` is at this end."""
    far, value = (pieces[min(number, other)].low, pieces[max(number, other)].high)[::way]
    if not 0 <= number + way < len(pieces):
        return range_end(value, far, search.unit)
    beyond, width = pieces[number + way], abs(value - far)
    inside, outside = sides_of(search.is_solved, value, way, width, (beyond.high - beyond.low) / 2)
    onset, limits = search.onsets.get(value), limits_of(value, far, search.unit, search.is_solved)
    reason, is_rule = _reason(search, value, way, outside, (beyond, pieces[number]), limits[0])
    how = Way.CLOSED_FORM if onset is not None and onset.is_closed else Way.BISECTION
    return End(value, Way.RULE if is_rule else how, reason, search.is_solved(value), inside, outside, *limits)


def range_end(value: float, inside: float, unit: str) -> End:
    """An end of the range that was asked about, and a value inside."""
    limits = limits_of(value, inside, unit, lambda each: min(value, inside) <= each <= max(value, inside))
    return End(value, Way.RANGE, None, True, None, None, *limits)


def limits_of(value: float, inside: float, unit: str, holds: Callable[[float], bool]) -> tuple[Decimal, Decimal]:
    """A limit with the decimals of a message and of a listing, on the way from a value inside: such that it holds."""
    few, many = (typed_limit(inside, value, DECIMALS[unit] + more, holds) for more in (0, 1))
    return few, many


def sides_of(
    holds: Callable[[float], bool], value: float, way: int, width: float, beyond: float = inf
) -> tuple[float, float] | tuple[None, None]:
    """Values close to an end on its two sides that single solves tell apart, within the range, which is so wide, and no
    farther `beyond` it."""
    for share in _ASIDE:
        step = share * max(1.0, abs(value))
        inside, outside = value - way * min(step, width), value + way * min(step, beyond)
        if holds(inside) and not holds(outside):
            return inside, outside
    return None, None


def _reason(
    search: RangeSearch, value: float, way: int, outside: float | None, near: Sequence[RangePiece], typed: Decimal
) -> tuple[Reason, bool]:
    """The reason against a contour beyond an end, and whether it is a rule or the reading of the words; `near` are the
    pieces on its two sides, the one beyond it first, `typed` is the limit."""
    name, at, onset = called(search.word), value_text(value, search.unit), search.onsets.get(value)
    most = f"{'most' if way > 0 else 'least'} {limit_text(typed, search.unit)}"
    limit = f"{name} at {at if near[0].is_value else most}"
    beyond = "at" if near[0].is_value else "above" if way > 0 else "below"
    there = outside if outside is not None else (near[0].low + near[0].high) / 2
    failure, event = failure_of(search.answer_at(there))
    if event is NoteKind.SEVERAL:
        # Another solution becomes a contour, too.
        return replace(failure, text=f"{failure.message}: {limit}"), False
    kind = event if isinstance(event, RefusalKind) else None
    read_as = onset.case if onset is not None else next((each.case for each in near if each.case), None)
    if kind is None and failure.code:
        return replace(failure, text=refused(failure.code, event, f"{name} {beyond} {at}")), onset is None
    unnamed = replace(failure, text=f"{failure.message or 'there is no contour'}: {limit}")
    if read_as is None:
        return unnamed, True
    branch = onset.branch if onset is not None else near[1].branch
    failing = search.failing(branch, there) if branch is not None else []
    if onset is not None:
        failing.insert(0, onset.check)
    check = next((each for each in failing if kind is None or same(each.kind, kind)), None)
    if check is None:
        return unnamed, onset is None
    text = phrase(check, kind or check.kind, read_as)
    is_singular = onset is not None and onset.check.kind.event.topic is Topic.SINGULAR
    if onset is not None and is_singular and not same(onset.check.kind, check.kind):
        text, limit = f"{phrase(onset.check, onset.check.kind, read_as)}: {limit}", f"beyond it {text}"
        return replace(failure, text=f"{text}; {limit}"), False
    return replace(failure, text=f"{text}: {limit}"), onset is None and not near[0].is_value


def refused(code: str, event: Enum | None, values: str) -> str:
    """That a rule refuses some values, or that something else is found for them."""
    return f"{'contoursolve' if event else 'the control'} refuses {values}; `contoursolve explain {code}` says why"


def phrase(check: Check, kind: RefusalKind, case: CaseClass) -> str:
    """The failure of a check in words, without values."""
    told = kind.event.phrase.format_map(Created(lambda field: _FIELDS[field](check, case)))
    return called_in_program(case.profile, has_values=False)(told)


def _parallel(check: Check, case: CaseClass) -> str:
    figure = case.profile.figure
    lines = [each.name for each in figure.path if isinstance(each, Line) and each.heading in check.givens]
    if len(lines) > 1:
        return f"{join(lines)} are parallel"
    if lines:
        others = tuple(name for name in check.givens if name != figure.line(lines[0]).heading)
        if others:
            return f"{element_text(lines[0])} never reaches {case.words(others)}"
        point, _, axis = check.subject.partition(".")
        if not axis.isdigit():
            return f"{element_text(lines[0])} is parallel to the line that it must meet"
        letter = case.profile.plane.axes[int(axis)]
        return f"{element_text(lines[0])} runs along {letter}, so {letter} of {point} stays open"
    free = unknowns_text(check.subject.split(","), case.profile)
    return f"{case.words(check.givens) or 'the words'} {'leaves' if len(check.givens) == 1 else 'leave'} {free} open"


def _too_large(check: Check, case: CaseClass) -> str:
    """Of one corner, or of all on an element."""
    sizes = [
        corner.size
        for corner in case.profile.figure.corners
        if check.subject in (corner.name, corner.before, corner.after, corner.lands_on)
    ]
    where = element_text(check.element) if check.element else "its lines"
    # Of several corners on an element, the free ones are those to change.
    sizes = [size for size in sizes if size in case.free] or sizes
    words = case.words(sizes)
    if not words:
        return f"{check.subject} does not fit on {where}"
    return f"{words} {'is' if len(sizes) == 1 else 'are'} too large for {where}"


def _reversed(check: Check, case: CaseClass) -> str:
    angle = case.words(tuple(filter(None, (case.profile.figure.line(check.element).heading,))))
    element = element_text(check.element)
    return f"{angle} points away from the end of {element}" if angle else f"{element} would run backwards"


def _apart(check: Check, case: CaseClass) -> str:
    words = case.words(check.givens) or "the words"
    return f"{words} {'cannot hold together' if len(check.givens) > 1 else 'does not hold'}"


_FIELDS: Mapping[str, Callable[[Check, CaseClass], str]] = {
    "subject": lambda check, _: element_text(check.subject),
    "parallel": _parallel,
    "large": _too_large,
    "reversed": _reversed,
    "disagreeing": lambda check, case: case.words((check.subject,)),
    "apart": _apart,
}
"""Subjects of the phrases of events (see `GeometricEvent`)."""


def same(one: RefusalKind, other: RefusalKind) -> bool:
    """Whether two kinds are told by one check."""
    return one is other or any({one, other} <= kinds for kinds in _TOGETHER)


_TOGETHER = (refusals_about(Topic.NO_CORNER), refusals_about(Topic.SINGULAR))
