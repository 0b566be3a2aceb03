"""In which parts of one word's range a block is solved: what intervals prove, what samples tell of the rest, and the
values at which one part ends.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import groupby, pairwise
from math import copysign, inf, isfinite, sqrt

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import value_text
from contoursolve.families.block_template import Template
from contoursolve.families.branches import Bits, Branch, LeastMargin, branches_of
from contoursolve.families.case_classes import INSTEAD, CaseClass, FreeWords
from contoursolve.families.errors import FamilyError, NotClosedError
from contoursolve.families.isolate import SAMPLES, Piece, Zero, isolate
from contoursolve.families.traced_reading import Alike, place_of_contour, read_alone, trace_reading
from contoursolve.geometry import Unit
from contoursolve.numeric import Array, halve, section
from contoursolve.solving import Check
from contoursolve.tolerance import LENGTH

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

READ = 64
"""Values that are read by themselves between two limits, where each value decides how the block is read."""

TRIED = 0.382
"""Share of a piece at which a single solve must agree with the solutions in closed form."""

SMALL = 1e-4
"""Share of a value (at least of 1). In a piece that is no wider rounding may be too large."""

TOGETHER = 1e-9
"""Share of a value (at least of 1). Values this close at which two branches change are one."""


class RangePiece(Struct, frozen=True):
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


class Onset(Struct, frozen=True):
    """Value at which a check begins to fail: the check, the solution that it is about, and whether the value is a zero
    in closed form."""

    check: Check
    branch: Branch
    is_closed: bool

    @property
    def case(self) -> CaseClass:
        """The class of the rows there."""
        return self.branch.case


class _Passing(Struct, frozen=True):
    """Part of a range, and which of several solutions pass their checks there."""

    low: float
    high: float
    passing: tuple[int, ...]

    @property
    def is_solved(self) -> bool:
        """Whether one solution alone passes."""
        return len(self.passing) == 1


def _passing(lines: Sequence[Sequence[Piece]]) -> list[_Passing]:
    """The parts in order, from those of each solution."""
    low, high = lines[0][0].low, lines[0][-1].high
    changes = {one.high for parts in lines for one, other in pairwise(parts) if one.sign != other.sign}
    cuts = [low]
    for value in sorted(changes):
        if value - cuts[-1] > TOGETHER * max(1.0, abs(value)):
            cuts.append(value)
    found: list[_Passing] = []
    for begin, end in pairwise([*cuts, high]):
        middle = (begin + end) / 2
        passing = tuple(
            number
            for number, parts in enumerate(lines)
            if any(part.low <= middle <= part.high and part.sign > 0 for part in parts)
        )
        if found and found[-1].passing == passing:
            found[-1] = replace(found[-1], high=end)
        else:
            found.append(_Passing(begin, end, passing))
    return found


def _changes(kind: Callable[[float], Alike], low: float, high: float) -> Iterator[float]:
    """The values between two others at which the kind changes, each to the last digit of a double."""
    last, begin = kind(high), low
    for _ in range(READ):
        if kind(begin) == last:
            return
        _, begin = halve(begin, high, kind)
        yield begin


class RangeSearch(FreeWords):
    """One word of one block."""

    def __init__(self, template: Template) -> None:
        super().__init__(template)
        (self.word,), (self.stated,), (self.unit,), (self.scale,) = self.names, self.values, self.units, self.scales
        if Unit.SIGN in self.kinds:
            raise FamilyError(f"{template.words[self.word].text} chooses between two places; it has no range")
        self.is_angle = Unit.DEGREE in self.kinds
        self.onsets: dict[float, Onset] = {}
        """What fails beyond the ends of the pieces, by their values."""

    def doubt(self, low: float, high: float, why: str) -> None:
        """Remember that between two values something is not proven."""
        ends = [value_text(value, self.unit) for value in (low, high)]
        where = f"at {ends[0]}" if ends[0] == ends[1] else f"from {ends[0]} to {ends[1]}"
        self.doubts.append(f"{self.word} {where}: {why}")

    def range_of(self, within: tuple[float, float] | None) -> tuple[float, float]:
        """The range to look at; where none is given an angle turns once. Raises FamilyError for one that is none."""
        if within is not None:
            return self.limits_within(0, within)
        if self.is_angle:
            return (0.0, 360.0) if self.stated >= 0 else (-360.0, 0.0)
        reach = max(REACH / self.scale, 2 * abs(self.stated))
        return -reach, reach

    def pieces(self, low: float, high: float) -> list[RangePiece]:
        """The range in order: stretches, with the value between two of them wherever it may differ from both."""
        (limits,) = self.marks([(low, high)])
        marks = [low, *(mark for a, b in pairwise(limits) for mark in (*self._turns(a, b), b))]
        cases = [self.case_at(self.stated if a < self.stated < b else (a + b) / 2) for a, b in pairwise(marks)]
        found = [self._value(low)]
        begin = low
        for case, after, mark in zip(cases, [*cases[1:], None], marks[1:], strict=True):
            if after is not None and case.is_like(after) and case.is_like(self.case_at(mark)):
                continue  # the limit of a rule that changes nothing for this word
            found += [*self._stretches(case, begin, mark), self._value(mark)]
            begin = mark
        return list(self._closed(found))

    def _turns(self, low: float, high: float) -> list[float]:
        """The values between two limits at which the block begins to be read in another way, where each value decides
        how; found between values that are read by themselves."""
        middle = self.at([(low + high) / 2])
        reading = trace_reading(self.template, middle, self.answer_at(*middle.values()))
        if not reading.is_by_row:
            return []
        like = place_of_contour(self.template, middle)

        def kind(value: float) -> Alike:
            return read_alone(self.template, self.at([value]), like).kind

        found = list[float]()
        places = self._read_at(low, high)
        for each in (change for ends in pairwise(places) for change in _changes(kind, *ends)):
            if found and each - found[-1] <= LEAST_GAP:
                found[-1] = (found[-1] + each) / 2
            else:
                found.append(each)
        for begin, end in pairwise([low, *found, high]):
            ends = [self.at([begin + share * (end - begin)]) for share in (0.25, 0.5, 0.75)]
            own_reading = trace_reading(self.template, ends[1], self.answer_at(*ends[1].values()))
            if not all(own_reading.holds(self.template, each) for each in ends):
                return []
        self.is_sampled = True
        self.doubt(low, high, f"each value decides how the block is read, and it was read at {len(places)} of them")
        return found

    def _read_at(self, low: float, high: float) -> list[float]:
        """The values of a range at which the block is read: all over it up to its ends, where a rule may change, and
        closer the nearer to the stated value, where the other words put what changes."""
        edge = (high - low) * TOGETHER
        even = numpy.linspace(low + edge, high - edge, READ)
        steps = numpy.geomspace(1e-3, 1.0, READ // 2) * (high - low)
        near = numpy.concatenate([self.stated - steps, self.stated + steps])
        found: list[float] = numpy.unique(numpy.concatenate([even, near[(low < near) & (near < high)]])).tolist()
        return found

    def _value(self, value: float) -> RangePiece:
        return RangePiece(value, value, self.is_solved(value), None)

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

    def _stretches(self, case: CaseClass, low: float, high: float) -> Iterator[RangePiece]:
        if case.status is not None:
            yield RangePiece(low, high, is_solved=False, case=case)
            return
        branches = branches_of(case, low, high)
        lines = [self._parts(branch, low, high) for branch in branches]
        if case.is_closed:
            ((parts, holes),) = lines
            for is_passed, group in groupby(parts, key=lambda part: part.sign > 0):
                own = list(group)
                branch = branches[0] if is_passed else None
                piece = RangePiece(own[0].low, own[-1].high, branch is not None, case, branch)
                at = piece.low + TRIED * (piece.high - piece.low)
                if self.is_sampled and self.is_solved(at) is not piece.is_solved:
                    raise NotClosedError(f"at {self.word} {value_text(at, self.unit)} the closed form fails; {INSTEAD}")
                yield from self._parted(piece, holes)
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

    def _parts(self, branch: Branch, low: float, high: float) -> tuple[list[Piece], list[float]]:
        """Pieces in which the checks of one solution are passed or not, as far as samples tell where nothing is proven,
        and single values that may differ from them."""
        found = isolate(LeastMargin(branch, low, high), low, high, near=[self.stated])
        parts, holes = list[Piece](), list[float]()
        for before, piece, after in zip([None, *found.pieces], found.pieces, [*found.pieces[1:], None], strict=False):
            if piece.sign:
                parts.append(piece)
                continue
            if piece.high - piece.low > LEAST_GAP:
                self.doubt(piece.low, piece.high, "the search for a proof was given up")
            own = [each for each in found.zeros if piece.low <= each.value <= piece.high]
            begin = piece.low
            for zero in (each for each in own if each.way):
                end = self._onset(branch, zero)
                parts.append(Piece(begin, end, -zero.way))
                begin = end
            beside = before or after
            sign = own[-1].way or (beside.sign if beside is not None else -1 if self.failing(branch, piece.low) else 1)
            parts.append(Piece(begin, piece.high, sign))
            if not own[-1].way and sign > 0:
                holes += _zeros_apart(branch, piece)
            elif not own[-1].way:
                half = (piece.high - piece.low) / 2
                holes.append(short(piece.low + half, half))
        return parts, holes

    def _onset(self, branch: Branch, zero: Zero) -> float:
        """The value at which a check begins to fail, which is noted."""
        outside, margins = zero.before if zero.way > 0 else zero.after, branch.margins
        number = int(margins.first_failing(branch.at(numpy.array([outside])))[0])
        value, is_closed = _exact(branch, number, outside)
        value = short(value, REGULAR_ROUNDING if margins.is_apart[number, 0] else ROUNDING)
        if abs(round(value, 3) - value) <= 2 * LENGTH * max(1.0, abs(value)):
            # A length that counts as zero is not quite.
            value = round(value, 3) + 0.0
        self.onsets[value] = Onset(margins.checks[number], branch, is_closed)
        return value

    def _parted(self, piece: RangePiece, holes: Sequence[float]) -> Iterator[RangePiece]:
        """A piece, parted by the single values in it that differ from it."""
        begin = piece.low
        for hole in holes:
            if begin < hole < piece.high and piece.is_solved is not self.is_solved(hole):
                yield replace(piece, low=begin, high=hole)
                yield self._value(hole)
                begin = hole
        yield replace(piece, low=begin)

    def _together(
        self, case: CaseClass, branches: Sequence[Branch], lines: Sequence[tuple[Sequence[Piece], Sequence[float]]]
    ) -> Iterator[RangePiece]:
        """Pieces of several solutions: there is a contour where one of them alone passes its checks."""
        holes = sorted({hole for _, own in lines for hole in own})
        found = self._without_slivers(_passing([parts for parts, _ in lines]))
        begin = found[0].low
        for part, after in zip(found, [*found[1:], None], strict=False):
            branch, end = branches[part.passing[0]] if part.is_solved else None, part.high
            # Where solutions part, they may be one; where another one takes over, there may be none, or both.
            is_alike = after is not None and part.is_solved is after.is_solved
            if is_alike:
                end = self._least_increment(end, is_solved=part.is_solved)
            yield from self._parted(RangePiece(begin, end, part.is_solved, case, branch), holes)
            if is_alike:
                yield self._value(end)
            begin = end

    def _without_slivers(self, parts: Sequence[_Passing]) -> list[_Passing]:
        """The parts without those that rounding alone has made of a single value in thousandths."""
        left: list[_Passing] = []
        for number, part in enumerate(parts):
            if 0 < number < len(parts) - 1 and part.high - part.low <= LEAST_GAP:
                value = self._least_increment((part.low + part.high) / 2, is_solved=not part.is_solved)
                is_alone = part.is_solved not in (parts[number - 1].is_solved, parts[number + 1].is_solved)
                if is_alone and value == round(value, 3):
                    self.doubt(part.low, part.high, "rounding keeps two solutions from being told apart")
                    left[-1] = replace(left[-1], high=value)
                    continue
            left.append(part)
        return left

    def _least_increment(self, value: float, *, is_solved: bool) -> float:
        """The value in thousandths close to one at which two solutions change, if that differs from what is beside."""
        near = round(value, 3) + 0.0
        return near if abs(near - value) <= LEAST_GAP and self.is_solved(near) is not is_solved else value

    def failing(self, branch: Branch, value: float) -> list[Check]:
        """The checks that fail at a value, in their order."""
        values = branch.at(numpy.array([value]))
        return [branch.margins.checks[number] for number in branch.margins.failing(values)[:, 0].nonzero()[0]]


def _exact(branch: Branch, number: int, value: float) -> tuple[float, bool]:
    """The zero of a margin near a value, and whether it has a closed form: with that, about the value itself."""
    is_closed = branch.margins.chart.is_quadratic[number]
    found = value
    for _ in range(1 if is_closed else 3):
        places = numpy.array([found, found + 1.0])
        at = float(branch.at(places)[number, 0])
        slope, next_slope = map(float, branch.slopes_at(places)[number])
        square = slope * slope - 2 * at * (next_slope - slope) if is_closed else slope * slope
        divisor = slope + copysign(sqrt(max(square, 0.0)), slope) if isfinite(square) else 0.0
        step = -2 * at / divisor if divisor else inf
        if not abs(step) <= CLOSE * max(1.0, abs(value)):  # true for NaN
            return value, False
        found += step
    return found, is_closed


def _zeros_apart(branch: Branch, piece: Piece) -> list[float]:
    """Values of a piece at which a margin that must not be zero changes its sign, in order."""
    places = numpy.linspace(piece.low, piece.high, SAMPLES)
    values, found = branch.at(places), set[float]()
    for row in numpy.flatnonzero(branch.margins.is_apart[:, 0]).tolist():
        signs = numpy.sign(values[row])
        for first in numpy.flatnonzero(signs[1:] != signs[:-1])[:1]:

            def is_beyond(finer: Array, row: int = row, sign: float = signs[first]) -> Bits:
                return numpy.asarray(numpy.sign(branch.at(finer)[row]) != sign)

            found.add(short(section(places[first], places[first + 1], is_beyond)[1], REGULAR_ROUNDING))
    return sorted(found)


def short(value: float, give: float = ROUNDING) -> float:
    """The shortest decimal that a value means, if rounding alone may part them; else the value."""
    for decimals in range(13):
        rounded = round(value, decimals)
        if abs(rounded - value) <= give:
            return rounded + 0.0
    return value
