"""The values of one word of a block in order: how they are read, and where the contour is solved."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import copysign, inf, isfinite, sqrt

import numpy

from contoursolve.backends.intervals import Array
from contoursolve.examine import Answer
from contoursolve.families.isolate import Stretch, divide
from contoursolve.families.kinds import Kind, alike, kind_in, kind_of, limits_of, value_of
from contoursolve.families.margins import Margins, compile_margins
from contoursolve.families.ranges import START, FamilyError, read_limits
from contoursolve.families.template import Template
from contoursolve.model import Unit
from contoursolve.solving.checks import Check
from contoursolve.tolerance import LARGEST, LENGTH

LEAST_GAP = 1e-4
"""mm or degrees: a tenth of the controls' least increment. What is narrower may be missed."""

SAMPLES, SECTIONS = 33, 12
"""Values at which a stretch that is not decided is looked at, and how often what lies between two is divided so."""

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


@dataclass(frozen=True, slots=True)
class Piece:
    """Values from `low` to `high` without these two, or one value: whether the contour is solved there. `kind` is how
    the words are read; None for one value."""

    low: float
    high: float
    is_solved: bool
    kind: Kind | None

    @property
    def is_value(self) -> bool:
        """Whether it is one value."""
        return self.kind is None


@dataclass(frozen=True, slots=True)
class Crossing:
    """Where a check begins to fail: the check, how the words are read, and whether the value is a zero in closed
    form."""

    check: Check
    kind: Kind
    is_closed: bool


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
        row = answer.claim.lexicon.addresses.get(typed.address)
        if row is None:
            raise FamilyError(f"{typed.text}: what a fact may say cannot be told; name a word of the block")
        if row.unit is Unit.SIGN:
            raise FamilyError(f"{typed.text} chooses between two places; it has no range")
        self.is_angle = row.unit is Unit.DEGREE
        self.unit = "deg" if self.is_angle else answer.unit.value
        self._answers: dict[float, Answer] = {self.stated: answer}
        self.crossings: dict[float, Crossing] = {}
        """What fails beyond the ends of the pieces, by their values."""
        self.is_complete = True
        """Whether every stretch that is wider than `LEAST_GAP` is decided by proof."""

    def solve(self, value: float) -> Answer:
        """The single solve at a value."""
        if value not in self._answers:
            self._answers[value] = self.template.solve({self.word: value})
        return self._answers[value]

    def is_solved(self, value: float) -> bool:
        """Whether the single solve at a value has a contour."""
        return self.solve(value).contour is not None

    def range_of(self, within: tuple[float, float] | None) -> tuple[float, float]:
        """The range to look at. Raises FamilyError for one that is none."""
        if within is None:
            return usual_range(self.stated, self.scale, is_angle=self.is_angle)
        return read_limits(self.word, within, LARGEST / self.scale, self.unit)

    def pieces(self, low: float, high: float) -> list[Piece]:
        """The range in order: stretches, with the value between two of them wherever it may differ from both."""
        marks = [low, *(float(each) for each in self._limits if low < each < high), high]
        kinds = [self._kind_at(self._middle(*each)) for each in pairwise(marks)]
        found = [Piece(low, low, self.is_solved(low), None)]
        begin = low
        for number, (kind, mark) in enumerate(zip(kinds, marks[1:], strict=True)):
            if number + 1 < len(kinds) and self._goes_on(mark, kind, kinds[number + 1]):
                continue
            found += self._stretches(kind, begin, mark)
            found.append(Piece(mark, mark, self.is_solved(mark), None))
            begin = mark
        return list(self._closed(found))

    def _closed(self, pieces: Sequence[Piece]) -> Iterator[Piece]:
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
                yield Piece(value, value, is_solved=False, kind=None)
                number = last
            else:
                yield piece
            number += 1

    def _middle(self, first: float, last: float) -> float:
        return self.stated if first < self.stated < last else (first + last) / 2

    def _kind_at(self, value: float) -> Kind:
        values = {self.word: value}
        if self.word.startswith(f"{START}."):
            kind = kind_of(self.template, values)
        else:
            kind = kind_in(self.solve(value), self.template.words, values)
        if kind.status is None and not kind.is_closed:
            raise FamilyError("the block has facts, ? or a choice that nothing makes; this needs a closed form")
        return kind

    def _goes_on(self, limit: float, kind: Kind, after: Kind) -> bool:
        """Whether a limit of some rule changes nothing for this word."""
        return alike(kind, after) and alike(kind, self._kind_at(limit))

    def _stretches(self, kind: Kind, low: float, high: float) -> Iterator[Piece]:
        if kind.status is not None:
            yield Piece(low, high, is_solved=False, kind=kind)
            return
        near = [self.stated] if low < self.stated < high else []
        margins = self.margins(kind)
        fixed = kind.fixed(margins.chart.fixed)
        parts: list[Part] = []
        holes: list[float] = []
        stretches = divide(margins, fixed, low, high, near=near)
        for before, stretch, after in zip([None, *stretches], stretches, [*stretches[1:], None], strict=False):
            if stretch.is_passed is not None:
                parts.append((stretch.low, stretch.high, stretch.is_passed))
                continue
            part = _Undecided(self, kind, margins, fixed)
            more, between = part.decide(stretch, before, after)
            parts += more
            holes += between
        yield from self._joined(kind, parts, holes)

    def _joined(self, kind: Kind, parts: Sequence[Part], holes: Sequence[float]) -> Iterator[Piece]:
        """Pieces of parts that go on without a break, apart from single values without a contour."""
        begin = parts[0][0]
        for (_, end, state), after in zip(parts, [*parts[1:], None], strict=False):
            if after is not None and after[2] is state:
                continue
            for hole in holes:
                if begin < hole < end and state is not self.is_solved(hole):
                    yield Piece(begin, hole, state, kind)
                    yield Piece(hole, hole, not state, None)
                    begin = hole
            yield Piece(begin, end, state, kind)
            begin = end

    def failing(self, kind: Kind, value: float) -> list[Check]:
        """The checks that fail at a value, in their order."""
        margins = self.margins(kind)
        values = margins.chart.at([numpy.array([value])], kind.fixed(margins.chart.fixed))
        return [margins.checks[number] for number in margins.failing(values)[:, 0].nonzero()[0]]

    def margins(self, kind: Kind) -> Margins:
        """What is checked of a kind of contour, by the word."""
        return compile_margins(kind.system, 1, kind.follows([self.word]))


class _Undecided:
    """A narrow stretch in which intervals cannot tell whether all checks are passed: there they begin to fail, or one
    is passed by rounding alone."""

    def __init__(self, survey: Survey, kind: Kind, margins: Margins, fixed: Sequence[float]) -> None:
        self.survey, self.kind, self.margins, self.fixed = survey, kind, margins, fixed

    def decide(self, stretch: Stretch, before: Stretch | None, after: Stretch | None) -> tuple[list[Part], list[float]]:
        """Its parts, as far as samples tell, and single values that may differ from them."""
        if stretch.high - stretch.low > LEAST_GAP:
            self.survey.is_complete = False
        places = numpy.linspace(stretch.low, stretch.high, SAMPLES)
        values = self._values(places)
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

    def _values(self, places: Array) -> Array:
        return self.margins.chart.at([places], self.fixed)

    def _crossing(self, low: float, high: float, state: bool) -> float:
        """Where the verdict changes."""
        for _ in range(SECTIONS):
            places = numpy.linspace(low, high, SAMPLES)
            changed = (self.margins.first_failing(self._values(places)) < 0) != state
            changed[0], changed[-1] = False, True
            number = int(changed.argmax())
            low, high = float(places[number - 1]), float(places[number])
            if high - low <= 4 * numpy.spacing(max(abs(low), abs(high))):
                break
        outside = high if state else low
        number = int(self.margins.first_failing(self._values(numpy.array([outside])))[0])
        value, is_closed = self._exact(number, outside)
        value = short(value, REGULAR_ROUNDING if self.margins.is_apart[number, 0] else ROUNDING)
        if abs(round(value, 3) - value) <= 2 * LENGTH * max(1.0, abs(value)):
            # A length that counts as zero is not quite.
            value = round(value, 3) + 0.0
        self.survey.crossings[value] = Crossing(self.margins.checks[number], self.kind, is_closed)
        return value

    def _exact(self, number: int, value: float) -> tuple[float, bool]:
        """The zero of a margin near a value, and whether it has a closed form: with that, about the value itself."""
        is_closed = self.margins.chart.is_quadratic[number]
        found = value
        for _ in range(1 if is_closed else 3):
            places = [numpy.array([found, found + 1.0])]
            at = float(self._values(places[0])[number, 0])
            slope, next_slope = map(float, self.margins.chart.slopes_at(places, self.fixed)[0, number])
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
        for _ in range(SECTIONS):
            finer = numpy.linspace(low, high, SAMPLES)
            changed = numpy.sign(self._values(finer)[row]) != sign
            changed[0], changed[-1] = False, True
            number = int(changed.argmax())
            low, high = float(finer[number - 1]), float(finer[number])
        return high


def short(value: float, give: float = ROUNDING) -> float:
    """The shortest decimal that a value means, if rounding alone may part them; else the value."""
    for decimals in range(13):
        rounded = round(value, decimals)
        if abs(rounded - value) <= give:
            return rounded + 0.0
    return value
