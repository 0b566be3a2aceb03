"""Where a contour exists: every range of one word's values in which it is solved, and what ends each."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from itertools import pairwise
from math import copysign, inf, isfinite, sqrt

import numpy

from contoursolve.backends.intervals import Array
from contoursolve.dialects import Dialect
from contoursolve.examine import Answer
from contoursolve.families.branches import INSTEAD, Branch, branches_of
from contoursolve.families.case_classes import CaseClass, alike, case_of, check_block, limits_of, unit_of, value_of
from contoursolve.families.limit_reasons import NO_FAILURE, Reason, about_of, called, failure_of, phrase, same
from contoursolve.families.spec import FamilyError, NotClosedError, Template, first_error, read_limits, spec_of
from contoursolve.families.subdivision import SAMPLES, Stretch, find_stretches, section
from contoursolve.model import Unit
from contoursolve.shown import Shown
from contoursolve.solving import RefusalKind, RemarkKind
from contoursolve.solving.checks import Check
from contoursolve.tolerance import LARGEST, LENGTH
from contoursolve.wording import limit_text, value_text

ASIDE = (1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4)
"""Share of an end (at least of 1). How far beside it single solves are tried, until they tell its two sides apart."""


LEAST_GAP = 1e-4
"""mm or degrees: a tenth of the controls' least increment. What is narrower may be missed."""

REACH = 1_000.0
"""mm. How far a length is looked at where no range is given: as far as most machines travel. Twice the value that
a word has, if that is more."""

NARROW = 1e-7
"""Share of a value (at least of 1). What lies between two stretches with a contour and is no wider is one value."""

ROUNDING, REGULAR_ROUNDING = 1e-12, 1e-10
"""By how much a value may differ from a shorter number that it means; the second where what must not be zero is taken
for zero a little earlier."""

CLOSE = 1e-6
"""Share of a value (at least of 1) within which the zero of a margin lies from where the check begins to fail."""


Part = tuple[float, float, bool]
"""From one value to another, and whether all checks are passed there."""

TRIED = 0.382
"""Share of a piece at which a single solve must agree with the solutions in closed form."""

SMALL = 1e-4
"""Share of a value (at least of 1). In a piece that is no wider rounding may be too large."""

TOGETHER = 1e-9
"""Share of a value (at least of 1). Values this close at which two branches change are one."""


@dataclass(frozen=True, slots=True)
class RangePiece:
    """Values from `low` to `high` without these two, or one value: whether the contour is solved there. `case` is how
    the words are read; None for one value. `branch` is the only solution that is a contour there, if there is one."""

    low: float
    high: float
    is_solved: bool
    case: CaseClass | None
    branch: Branch | None = None

    @property
    def is_value(self) -> bool:
        """Whether it is one value."""
        return self.case is None


@dataclass(frozen=True, slots=True)
class Onset:
    """Where a check begins to fail: the check, the solution that it is about, and whether the value is a zero in closed
    form."""

    check: Check
    branch: Branch
    is_closed: bool

    @property
    def case(self) -> CaseClass:
        """How the words are read."""
        return self.branch.case


def usual_range(stated: float, scale: float, *, is_angle: bool) -> tuple[float, float]:
    """The range to look at where none is given: an angle turns once. `stated` is the value that the word has,
    `scale` mm for each unit of it."""
    if is_angle:
        return (0.0, 360.0) if stated >= 0 else (-360.0, 0.0)
    reach = max(REACH / scale, 2 * abs(stated))
    return -reach, reach


class Survey:
    """One word of one block."""

    def __init__(self, template: Template, word: str) -> None:
        self.template, self.word = template, word
        typed = template.words[word]
        answer = template.solve({})
        self.stated = value_of(typed, answer)
        scales, bounds = limits_of(template, {word: self.stated})
        self.scale = abs(scales[0])
        """mm or degrees for each unit of the word."""
        self._limits = [bound / scales[0] for bound in bounds[0]]
        kind = unit_of(typed, answer)
        if kind is Unit.SIGN:
            raise FamilyError(f"{typed.text} chooses between two places; it has no range")
        self.is_angle = kind is Unit.DEGREE
        self.unit = "deg" if self.is_angle else answer.unit.value
        self._answers: dict[float, Answer] = {self.stated: answer}
        self.onsets: dict[float, Onset] = {}
        """What fails beyond the ends of the pieces, by their values."""
        self.doubts: list[str] = []
        """Where a stretch that is wider than `LEAST_GAP` is not decided by proof, and why; empty if there is none."""

    def solve(self, value: float) -> Answer:
        """The single solve at a value."""
        if value not in self._answers:
            self._answers[value] = self.template.solve({self.word: value})
        return self._answers[value]

    def is_solved(self, value: float) -> bool:
        """Whether the single solve at a value has a contour."""
        return self.solve(value).contour is not None

    def doubt(self, low: float, high: float, why: str) -> None:
        """Remember that between two values something is not proven."""
        ends = [value_text(value, self.unit) for value in (low, high)]
        where = f"at {ends[0]}" if ends[0] == ends[1] else f"from {ends[0]} to {ends[1]}"
        self.doubts.append(f"{self.word} {where}: {why}")

    def range_of(self, within: tuple[float, float] | None) -> tuple[float, float]:
        """The range to look at. Raises FamilyError for one that is none."""
        if within is None:
            return usual_range(self.stated, self.scale, is_angle=self.is_angle)
        return read_limits(self.word, within, LARGEST / self.scale, self.unit)

    def pieces(self, low: float, high: float) -> list[RangePiece]:
        """The range in order: stretches, with the value between two of them wherever it may differ from both."""
        marks = [low, *(float(each) for each in self._limits if low < each < high), high]
        cases = [self._case_at(self._middle(*each)) for each in pairwise(marks)]
        found = [RangePiece(low, low, self.is_solved(low), None)]
        begin = low
        for number, (case, mark) in enumerate(zip(cases, marks[1:], strict=True)):
            if number + 1 < len(cases) and self._goes_on(mark, case, cases[number + 1]):
                continue
            found += self._stretches(case, begin, mark)
            found.append(RangePiece(mark, mark, self.is_solved(mark), None))
            begin = mark
        return list(self._closed(found))

    def _closed(self, pieces: Sequence[RangePiece]) -> Iterator[RangePiece]:
        """The pieces, with what is narrow and has no contour between others that do as one value."""
        number = 0
        while number < len(pieces):
            last = number
            while last + 1 < len(pieces) and not (pieces[number].is_solved or pieces[last + 1].is_solved):
                last += 1
            piece, width = pieces[number], pieces[last].high - pieces[number].low
            is_between = number > 0 and last + 1 < len(pieces) and not piece.is_solved
            if is_between and width <= NARROW * max(1.0, abs(piece.low)):
                value = short((piece.low + pieces[last].high) / 2, width)
                yield RangePiece(value, value, is_solved=False, case=None)
                number = last
            else:
                yield piece
            number += 1

    def _middle(self, first: float, last: float) -> float:
        return self.stated if first < self.stated < last else (first + last) / 2

    def _case_at(self, value: float) -> CaseClass:
        return case_of(self.template, {self.word: value}, self.solve(value))

    def _goes_on(self, limit: float, case: CaseClass, after: CaseClass) -> bool:
        """Whether a limit of some rule changes nothing for this word."""
        return alike(case, after) and alike(case, self._case_at(limit))

    def _stretches(self, case: CaseClass, low: float, high: float) -> Iterator[RangePiece]:
        if case.status is not None:
            yield RangePiece(low, high, is_solved=False, case=case)
            return
        branches = branches_of(case, [self.word], [low], [high])
        lines = [self._parts(branch, low, high) for branch in branches]
        if case.is_closed:
            yield from self._joined(branches[0], *lines[0])
            return
        for piece in self._together(case, branches, lines):
            at = piece.low + TRIED * (piece.high - piece.low)
            if self.is_solved(at) is piece.is_solved:
                yield piece
                continue
            if piece.high - piece.low > SMALL * max(1.0, abs(at)):
                raise NotClosedError(f"at {self.word} {value_text(at, self.unit)} the closed form fails; {INSTEAD}")
            # So close to a singular value rounding alone keeps the closed form from telling.
            self.doubt(piece.low, piece.high, "rounding is too large for the closed form")
            yield RangePiece(piece.low, piece.high, not piece.is_solved, case)

    def _parts(self, branch: Branch, low: float, high: float) -> tuple[list[Part], list[float]]:
        """Where the checks of one solution are passed, and single values that may differ from the parts."""
        parts: list[Part] = []
        holes: list[float] = []
        near = [self.stated] if low < self.stated < high else []
        stretches = find_stretches(branch, low, high, near=near)
        for before, stretch, after in zip([None, *stretches], stretches, [*stretches[1:], None], strict=False):
            if stretch.is_passed is not None:
                parts.append((stretch.low, stretch.high, stretch.is_passed))
                continue
            more, between = _Undecided(self, branch).decide(stretch, before, after)
            parts += more
            holes += between
        return parts, holes

    def _joined(self, branch: Branch, parts: Sequence[Part], holes: Sequence[float]) -> Iterator[RangePiece]:
        """Pieces of parts that go on without a break, apart from single values without a contour."""
        begin = parts[0][0]
        for (_, end, state), after in zip(parts, [*parts[1:], None], strict=False):
            if after is not None and after[2] is state:
                continue
            yield from self._parted(RangePiece(begin, end, state, branch.case, branch if state else None), holes)
            begin = end

    def _parted(self, piece: RangePiece, holes: Sequence[float]) -> Iterator[RangePiece]:
        """A piece, parted by the single values in it that differ from it."""
        begin = piece.low
        for hole in holes:
            if begin < hole < piece.high and piece.is_solved is not self.is_solved(hole):
                yield replace(piece, low=begin, high=hole)
                yield RangePiece(hole, hole, not piece.is_solved, None)
                begin = hole
        yield replace(piece, low=begin)

    def _together(
        self, case: CaseClass, branches: Sequence[Branch], lines: Sequence[tuple[Sequence[Part], Sequence[float]]]
    ) -> Iterator[RangePiece]:
        """Pieces of several solutions: there is a contour where one of them alone passes its checks."""
        holes = sorted({hole for _, own in lines for hole in own})
        changes = {one[1] for parts, _ in lines for one, other in pairwise(parts) if one[2] is not other[2]}
        low, high = lines[0][0][0][0], lines[0][0][-1][1]
        cuts = [low]
        for value in sorted(changes):
            if value - cuts[-1] > TOGETHER * max(1.0, abs(value)):
                cuts.append(value)
        cuts.append(high)
        found: list[tuple[float, tuple[int, ...]]] = []
        for begin, end in pairwise(cuts):
            middle = (begin + end) / 2
            passing = tuple(
                n for n, (parts, _) in enumerate(lines) if any(a <= middle <= b and ok for a, b, ok in parts)
            )
            if found and found[-1][1] == passing:
                found[-1] = end, passing
            else:
                found.append((end, passing))
        found = self._without_slivers(cuts[0], found)
        begin = cuts[0]
        for (end, passing), after in zip(found, [*found[1:], None], strict=False):
            branch = branches[passing[0]] if len(passing) == 1 else None
            # Where solutions part, they may be one; where another one takes over, there may be none, or both.
            is_alike = after is not None and (len(passing) == 1) is (len(after[1]) == 1)
            if is_alike:
                end = self._least_increment(end, is_solved=branch is not None)  # noqa: PLW2901
            yield from self._parted(RangePiece(begin, end, branch is not None, case, branch), holes)
            if is_alike:
                yield RangePiece(end, end, self.is_solved(end), None)
            begin = end

    def _without_slivers(
        self, low: float, found: Sequence[tuple[float, tuple[int, ...]]]
    ) -> list[tuple[float, tuple[int, ...]]]:
        """The stretches from `low` on, by their ends and the solutions that pass there, without those that rounding
        alone has made of a single value in thousandths."""
        left: list[tuple[float, tuple[int, ...]]] = []
        for number, (end, passing) in enumerate(found):
            begin, is_solved = found[number - 1][0] if number else low, len(passing) == 1
            if 0 < number < len(found) - 1 and end - begin <= LEAST_GAP:
                beside = [len(each) == 1 for _, each in (found[number - 1], found[number + 1])]
                value = self._least_increment((begin + end) / 2, is_solved=not is_solved)
                if is_solved not in beside and value == round(value, 3):
                    self.doubt(begin, end, "rounding keeps two solutions from being told apart")
                    left[-1] = value, left[-1][1]
                    continue
            left.append((end, passing))
        return left

    def _least_increment(self, value: float, *, is_solved: bool) -> float:
        """The value in thousandths close to one at which two solutions change, if that differs from what is beside."""
        near = round(value, 3) + 0.0
        return near if abs(near - value) <= LEAST_GAP and self.is_solved(near) is not is_solved else value

    def failing(self, branch: Branch, value: float) -> list[Check]:
        """The checks that fail at a value, in their order."""
        values = branch.at([numpy.array([value])])
        return [branch.margins.checks[number] for number in branch.margins.failing(values)[:, 0].nonzero()[0]]


class _Undecided:
    """A narrow stretch in which intervals cannot tell whether all checks are passed: there they begin to fail, or one
    is passed by rounding alone."""

    def __init__(self, survey: Survey, branch: Branch) -> None:
        self.survey, self.branch, self.margins = survey, branch, branch.margins

    def decide(self, stretch: Stretch, before: Stretch | None, after: Stretch | None) -> tuple[list[Part], list[float]]:
        """Its parts, as far as samples tell, and single values that may differ from them."""
        if stretch.high - stretch.low > LEAST_GAP:
            self.survey.doubt(stretch.low, stretch.high, "the search for a proof was given up")
        places = numpy.linspace(stretch.low, stretch.high, SAMPLES)
        values = self.branch.at([places])
        states = (self.margins.first_failing(values) < 0).tolist()
        if before is not None:
            states[0] = before.is_passed
        if after is not None:
            states[-1] = after.is_passed
        parts: list[Part] = []
        begin = stretch.low
        for number in range(1, SAMPLES):
            if states[number] is not states[number - 1]:
                end = self._crossing(float(places[number - 1]), float(places[number]), states[number - 1])
                parts.append((begin, end, states[number - 1]))
                begin = end
        parts.append((begin, stretch.high, states[-1]))
        if len(parts) > 1:
            return parts, []
        if not states[0]:
            half = (stretch.high - stretch.low) / 2
            return parts, [short(stretch.low + half, half)]
        rows = numpy.flatnonzero(self.margins.is_apart[:, 0]).tolist()
        zeros = [self._zero(places, values[row], row) for row in rows]
        return parts, sorted({short(each, REGULAR_ROUNDING) for each in zeros if each is not None})

    def _crossing(self, low: float, high: float, state: bool) -> float:
        """Where the verdict changes."""
        low, high = section(
            low, high, lambda places: (self.margins.first_failing(self.branch.at([places])) < 0) != state
        )
        outside = high if state else low
        number = int(self.margins.first_failing(self.branch.at([numpy.array([outside])]))[0])
        value, is_closed = self._exact(number, outside)
        value = short(value, REGULAR_ROUNDING if self.margins.is_apart[number, 0] else ROUNDING)
        if abs(round(value, 3) - value) <= 2 * LENGTH * max(1.0, abs(value)):
            # A length that counts as zero is not quite.
            value = round(value, 3) + 0.0
        self.survey.onsets[value] = Onset(self.margins.checks[number], self.branch, is_closed)
        return value

    def _exact(self, number: int, value: float) -> tuple[float, bool]:
        """The zero of a margin near a value, and whether it has a closed form: with that, about the value itself."""
        is_closed = self.margins.chart.is_quadratic[number]
        found = value
        for _ in range(1 if is_closed else 3):
            places = [numpy.array([found, found + 1.0])]
            at = float(self.branch.at(places)[number, 0])
            slope, next_slope = map(float, self.branch.slopes_at(places)[0, number])
            square = slope * slope - 2 * at * (next_slope - slope) if is_closed else slope * slope
            divisor = slope + copysign(sqrt(max(square, 0.0)), slope) if isfinite(square) else 0.0
            step = -2 * at / divisor if divisor else inf
            if not abs(step) <= CLOSE * max(1.0, abs(value)):  # true for NaN
                return value, False
            found += step
        return found, is_closed

    def _zero(self, places: Array, values: Array, row: int) -> float | None:
        """Where a margin that must not be zero changes its sign, by bisection; None where it does not."""
        changes = numpy.flatnonzero(numpy.sign(values[1:]) != numpy.sign(values[:-1]))
        if not changes.size:
            return None
        low, high = float(places[changes[0]]), float(places[changes[0] + 1])
        sign = numpy.sign(values[changes[0]])
        return section(low, high, lambda finer: numpy.sign(self.branch.at([finer])[row]) != sign)[1]


def short(value: float, give: float = ROUNDING) -> float:
    """The shortest decimal that a value means, if rounding alone may part them; else the value."""
    for decimals in range(13):
        rounded = round(value, decimals)
        if abs(rounded - value) <= give:
            return rounded + 0.0
    return value


__all__ = ["LEAST_GAP", "End", "Feasible", "Interval", "Way", "feasible"]


class Way(Enum):
    """How an end was found."""

    CLOSED_FORM = "closed form"
    """What ends there is a polynomial of degree 1 or 2 in the word."""
    BISECTION = "bisection"
    """By dividing a stretch outside of which it is proven that there is no end."""
    RULE = "rule"
    """A rule begins to refuse there, or the words are read in another way."""
    RANGE = "range"
    """The range that was asked about ends there; the contour goes on."""


@dataclass(frozen=True, slots=True)
class End:
    """One end of a range of values with a contour.

    `value` is as the word is written. `reason` says what fails beyond it; None where only the range that was asked
    about ends. At `inside` a single solve has the contour, at `outside` it has none; None where no values close to the
    end tell so. `is_included` tells whether the value itself has the contour.
    """

    value: float
    way: Way
    reason: Reason | None
    is_included: bool
    inside: float | None
    outside: float | None

    @property
    def is_verified(self) -> bool:
        """Whether single solves agree on its two sides, as far as it has two."""
        return self.way is Way.RANGE or None not in (self.inside, self.outside)


@dataclass(frozen=True, slots=True)
class Interval:
    """A range of a word's values in all of which the contour is solved; both ends are the same for a single value."""

    low: End
    high: End

    def __contains__(self, value: float) -> bool:
        for end in (self.low, self.high):
            if value == end.value:
                return end.is_included
        return self.low.value < value < self.high.value


@dataclass(frozen=True, slots=True)
class Feasible(Shown):
    """All values of a word, within a range, with which its block has a contour.

    `unit` is what the word is written in (mm, inch or deg), `stated` the value that the block has. Without `doubts`, it
    is proven that nothing wider than `LEAST_GAP` is missing; else these are some of the ranges, and they say why.
    """

    word: str
    unit: str
    stated: float
    within: tuple[float, float]
    intervals: tuple[Interval, ...]
    doubts: tuple[str, ...]
    refusal: str
    """Why the block as it stands has no contour; empty if it has."""

    @property
    def is_complete(self) -> bool:
        """Whether these are proven to be all."""
        return not self.doubts

    def __contains__(self, value: float) -> bool:
        return any(value in each for each in self.intervals)


def feasible(
    block: str,
    word: str,
    *,
    start: str | None = None,
    within: tuple[float, float] | None = None,
    control: str | Dialect | None = None,
    facts: Iterable[str] = (),
    units: str = "mm",
    rules: str = "enforce",
    settings: Mapping[str, str] | None = None,
) -> Feasible:
    """Every range of a word's values, as it is written, in which the contour is solved.

    Args:
        block: the block, or the blocks of one contour.
        word: the word by its letter (`P`, `,A`), or with its line where several have it (`2:,A`); a word of the start
            point as `start.X`; a fact by what it gives the value of (`length of line 1`).
        within: the range to look at; without it, an angle turns once (0 to 360, or -360 to 0 for a negative one), and
            a length is looked at for 1 m to either side.
        start: and all others as for `family`, with the same errors; also raises FamilyError where facts or `?` leave no
            closed form, and names them: `family` solves such a block value by value.

    The range is divided into stretches in each of which all that is checked of a contour is bounded by intervals, so
    that no part with or without a contour is overlooked. Each end is computed, and solved on both sides. Where facts,
    `?` or a choice that nothing makes leave several solutions, all are followed; the contour exists where one alone
    can be made.

    >>> found = feasible("G111 X100. A180. K-30. B120. P5. Q5.", "P", start="X40. Z0.")
    >>> [(round(each.low.value, 4), round(each.high.value, 4)) for each in found.intervals]
    [(0.0, 51.9615)]
    >>> found.intervals[0].high.reason.text
    'P too large for line 1: 51.961 mm at most'
    """
    template = spec_of(
        block, (word,), start=start, control=control, facts=facts, units=units, rules=rules, settings=settings
    ).template()
    check_block(template)
    name = next(iter(template.words))
    survey = Survey(template, name)
    low, high = survey.range_of(within)
    pieces = survey.pieces(low, high)
    intervals = tuple(
        Interval(_end(survey, pieces, first, last, -1), _end(survey, pieces, last, first, +1))
        for first, last in _runs(pieces)
    )
    refusal = first_error(survey.solve(survey.stated))
    return Feasible(name, survey.unit, survey.stated, (low, high), intervals, tuple(survey.doubts), refusal)


def _runs(pieces: Sequence[RangePiece]) -> list[tuple[int, int]]:
    """The first and the last of the pieces of each range with a contour."""
    runs: list[tuple[int, int]] = []
    for number, piece in enumerate(pieces):
        if piece.is_solved and runs and runs[-1][1] == number - 1:
            runs[-1] = runs[-1][0], number
        elif piece.is_solved:
            runs.append((number, number))
    return runs


def _end(survey: Survey, pieces: Sequence[RangePiece], number: int, other: int, way: int) -> End:
    """The lower (-1) or upper (+1) end of a range from one piece to another, of which `number` is at this end."""
    value = pieces[number].low if way < 0 else pieces[number].high
    if not 0 <= number + way < len(pieces):
        return End(value, Way.RANGE, None, True, None, None)
    beyond = pieces[number + way]
    width = abs(value - (pieces[other].high if way < 0 else pieces[other].low))
    inside, outside = _sides(survey, value, way, beyond, width)
    onset = survey.onsets.get(value)
    reason, is_rule = _reason(survey, value, way, outside, onset, (beyond, pieces[number]))
    how = Way.CLOSED_FORM if onset is not None and onset.is_closed else Way.BISECTION
    return End(value, Way.RULE if is_rule else how, reason, survey.is_solved(value), inside, outside)


def _sides(
    survey: Survey, value: float, way: int, beyond: RangePiece, width: float
) -> tuple[float | None, float | None]:
    """Values close to an end on its two sides that single solves tell apart, within the range, which is so wide, and
    within what lies beyond it."""
    for share in ASIDE:
        step = share * max(1.0, abs(value))
        inside = value - way * min(step, width)
        outside = value + way * min(step, (beyond.high - beyond.low) / 2)
        if survey.is_solved(inside) and not survey.is_solved(outside):
            return inside, outside
    return None, None


def _reason(
    survey: Survey, value: float, way: int, outside: float | None, onset: Onset | None, near: Sequence[RangePiece]
) -> tuple[Reason, bool]:
    """What fails beyond an end, and whether it is a rule or the reading of the words; `near` are the pieces on its two
    sides, the one beyond it first."""
    at, limit = value_text(value, survey.unit), limit_text(value, survey.unit, way, is_included=survey.is_solved(value))
    limit = f"at {at}" if near[0].is_value else f"{limit} at {'most' if way > 0 else 'least'}"
    beyond = "at" if near[0].is_value else "above" if way > 0 else "below"
    there = outside if outside is not None else (near[0].low + near[0].high) / 2
    failure, event = failure_of(survey.solve(there))
    if event is RefusalKind.NOT_VERIFIED:
        # Close to a singular case rounding alone keeps the equations from holding.
        failure, event = NO_FAILURE
    if event is RemarkKind.SEVERAL:
        # Another solution becomes a contour, too.
        return replace(failure, text=f"{failure.message}: {limit}"), False
    kind = event if isinstance(event, RefusalKind) else None
    read_as = onset.case if onset is not None else next((each.case for each in near if each.case), None)
    if kind is None and failure.code:
        says = f"rule {failure.code} refuses" if event is None else f"{failure.code} is found for"
        return replace(failure, text=f"{says} {called(survey.word)} {beyond} {at}"), onset is None
    unnamed = replace(failure, text=f"{failure.message or 'there is no contour'}: {limit}")
    if read_as is None:
        return unnamed, True
    about = about_of(read_as.free, read_as.profile)
    branch = onset.branch if onset is not None else near[1].branch
    failing = survey.failing(branch, there) if branch is not None else []
    if onset is not None:
        failing.insert(0, onset.check)
    check = next((each for each in failing if kind is None or same(each.kind, kind)), None)
    if check is None:
        return unnamed, onset is None
    text = phrase(check, kind or check.kind, about)
    is_singular = onset is not None and onset.check.kind is RefusalKind.LINES_PARALLEL
    if onset is not None and is_singular and not same(onset.check.kind, check.kind):
        text, limit = f"{phrase(onset.check, onset.check.kind, about)}: {limit}", f"beyond it {text}"
        return replace(failure, text=f"{text}; {limit}"), False
    return replace(failure, text=f"{text}: {limit}"), onset is None and not near[0].is_value
