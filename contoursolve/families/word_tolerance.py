"""The inverse of a tolerance: between which values of a word a result moves no farther than it may."""

from collections.abc import Sequence
from decimal import Decimal
from math import hypot, inf, isfinite, remainder
from typing import Unpack

import numpy
from msgspec import Struct

from contoursolve.diagnosis import Answer, AskedValue, fact_key, short_name, value_text
from contoursolve.diagnostics import Shown
from contoursolve.families.block_template import BlockOptions, first_error, spec_of
from contoursolve.families.branches import Branch
from contoursolve.families.case_classes import CaseClass, results_of
from contoursolve.families.errors import FamilyError, NotClosedError
from contoursolve.families.feasible_ranges import (
    End,
    Interval,
    Reason,
    Way,
    end_of_range,
    failure_of,
    limits_of,
    range_end,
    sides_of,
)
from contoursolve.families.free_words import check_block
from contoursolve.families.goals import CONSTANT, Goal, TargetCurve, outputs_at, place_of
from contoursolve.families.isolate import isolate
from contoursolve.families.range_pieces import LEAST_GAP, NARROW, REACH, RangePiece, RangeSearch, short
from contoursolve.families.results import ResultNames, base_name, check_text, factors_of
from contoursolve.gcode import FACT
from contoursolve.geometry import FIRST, PATH_END, SECOND, ResultName, StraightIs, Unit, write_result
from contoursolve.numeric import halve
from contoursolve.program import takes
from contoursolve.reading import Premises
from contoursolve.tolerance import LARGEST

TURN = 360.0
"""Degrees. An angle is looked at by half of it to each side."""

STEPS, FARTHEST, GROWTH, FEWEST = 16, 1 / 256, 1.25, 32
"""Without a closed form: the first step is the linear estimate by so much, or this share of all that is looked at; each
one is so much longer, but at least so many are made."""

BESIDE = 0.25
"""Share of what is between the ends that is looked at beside them when they are searched again."""

ROUNDING = 1e-9
"""Share of what a result may move by that the rounding of floats adds."""

PROBE, CLOSEST = 1e-4, 1e-11
"""Shares of a value (at least of 1): how far beside it the derivative is taken, and how closely an end is found."""


class ToleranceRange(Shown, Struct, frozen=True):
    """The values of a word around its own with which a result moves by `most` or less.

    X of a lathe counts as diameter; a point without an axis moves as it does on the drawing. Without `doubts`, nothing
    wider than `LEAST_GAP` was overlooked between the ends.

    Attributes:
        word: the word by its name, such as `A`.
        unit: what it is written in: mm, inch or deg.
        stated: its value.
        kept: the result.
        kept_unit: what the result is written in.
        most: by how much the result may move, in its unit.
        low: the lowest value, and what ends it: the result has moved so far (`Way.MOVED`), or why there is no contour
            beyond.
        high: the highest value, likewise.
        linear: the tolerance by the derivative alone; None where that is zero or does not exist.
        doubts: what may have been overlooked between the ends.
        is_diameter: whether the values are diameters.
        premises: what the contours assume besides the words.
    """

    word: str
    unit: str
    stated: float
    kept: str
    kept_unit: str
    most: float
    low: End
    high: End
    linear: float | None
    doubts: tuple[str, ...]
    is_diameter: bool = False
    premises: Premises = Premises()

    @property
    def minus(self) -> float:
        """The tolerance below the value of the word, as it is written."""
        return _difference(self.stated, self.low.value)

    @property
    def plus(self) -> float:
        """The tolerance above it."""
        return _difference(self.high.value, self.stated)

    @property
    def is_complete(self) -> bool:
        """Whether this is proven of all values between the ends."""
        return not self.doubts

    def __contains__(self, value: float) -> bool:
        return value in Interval(self.low, self.high)


def _difference(one: float, other: float) -> float:
    """A difference of two numbers as they are written."""
    return float(Decimal(repr(one)) - Decimal(repr(other)))


@takes(BlockOptions)
def tolerance_for(
    block: str,
    word: str,
    *,
    keep: str,
    within: float,
    **options: Unpack[BlockOptions],
) -> ToleranceRange:
    """The values of a word around its own with which a result moves by at most `within`; see
    `contoursolve.tolerances`."""
    if isinstance(within, bool) or not isinstance(within, (int, float)) or not 0 < within < inf:
        raise FamilyError(f"within is how far {keep} may move, a number above 0, not {within!r}")
    check_text("result", keep)
    spec = spec_of(block, (word,), **options)
    template = spec.template()
    check_block(template)
    search = RangeSearch(template)
    kept = _read_kept(keep, search.answer)
    if isinstance(kept, ResultName):
        # What a fact would give the value of is asked for beside the words.
        keep = write_result(kept, search.answer.plane)
        options["facts"] = (*spec.facts, f"{keep} = ?")
        search = RangeSearch(spec_of(block, (word,), **options).template())
        kept = _read_kept(keep, search.answer)
    if isinstance(kept, ResultName):
        raise FamilyError(f"the contour has no value of {keep}")
    found = _ToleranceSearch(search, kept, float(within), _all_of(search))
    low, high = found.ends()
    if search.doubts:
        # What could not be proven of all values may be proven of those between the ends.
        beside = (high.value - low.value) * BESIDE
        near = max(low.value - beside, found.range[0]), min(high.value + beside, found.range[1])
        search = RangeSearch(search.template)
        found = _ToleranceSearch(search, kept, float(within), near)
        low, high = found.ends()
    about = (search.word, search.unit, search.stated, kept.text, kept.unit, float(within))
    doubts = tuple(dict.fromkeys((*search.doubts, *found.doubts)))
    return ToleranceRange(*about, low, high, found.linear, doubts, search.diameters[0], search.premises)


class _Kept(Struct, frozen=True):
    """The result that is kept: its name, its unit, and its value in the block as it stands, as written; of a point
    with both coordinates these, mm. `goal` is the same in mm, `scale` the mm of one unit; None of what is no point."""

    text: str
    unit: str
    value: tuple[float, ...]
    goal: Goal | None = None
    scale: float = 1.0
    result: ResultName | None = None
    """A length that is measured in the contour itself."""

    def moved(self, answer: Answer) -> float:
        """By how much it is off in another contour; infinite where there is none, or it is not there."""
        if self.goal is not None:
            at = place_of(self.goal.point, answer.contour)
            return inf if at is None else self.goal.away(at) / self.scale
        there = _asked_value(self.text, answer) if self.result is None else _measured(self.result, answer)
        if there is None:
            return inf
        off = there - self.value[0]
        return abs(remainder(off, TURN) if self.unit == "deg" else off)


def _read_kept(text: str, answer: Answer) -> _Kept | ResultName:
    """The result that a text names, in the block as it stands; its name alone where a fact gives the value of it.

    Raises FamilyError without a contour, and for a result that is not there."""
    if answer.contour is None:
        raise FamilyError(f"as it stands, the block has no contour to keep: {first_error(answer)}")
    asked, value, unit = _asked(text, answer), _asked_value(text, answer), answer.unit
    if asked is not None and value is not None:
        return _Kept(text, "deg" if asked.question.unit is Unit.DEGREE else unit.value, (value,))
    names = ResultNames(answer.profile, results_of(CaseClass(answer.profile, None, {}, is_closed=False)))
    read = names.read(text)
    told = names.written(read)
    if read.point is None:
        if read.quantity is not None and not isinstance(read.quantity, StraightIs):
            return read
        measured = _measured(read, answer)
        if measured is None:
            raise FamilyError(f"{told} is of no length here; name another result")
        return _Kept(told, unit.value, (measured,), result=read)
    point = read.point.text if read.point == PATH_END else base_name(read.point, answer.profile.figure)
    at, axis = place_of(point, answer.contour), read.axis
    if at is None:
        raise FamilyError(f"{told} is on an element of no length; name another result")
    scale = float(unit.in_mm) / (factors_of(answer.plane)[axis] if axis is not None else 1)
    place = (at[FIRST] if axis != SECOND else None, at[SECOND] if axis != FIRST else None)
    return _Kept(told, unit.value, at, Goal(point, place), scale)


def _measured(read: ResultName, answer: Answer) -> float | None:
    """The length of a path, or of what the corners leave of an element, as it is written; None where it is not
    there."""
    if answer.contour is None:
        return None
    own = read.quantity.line if isinstance(read.quantity, StraightIs) else ""
    lengths = [each.length for each in answer.contour.elements if each.name == own or not own]
    return sum(lengths) / float(answer.unit.in_mm) if lengths else None


def _asked(text: str, answer: Answer) -> AskedValue | None:
    """The value that a word or a fact of this name asks for."""
    name = fact_key(text).removeprefix("asked.")
    for each in answer.asked:
        word = each.question.word
        if name == (fact_key(word.text) if word.address == FACT else word.address.lower()):
            return each
    return None


def _asked_value(text: str, answer: Answer) -> float | None:
    """Its value as it is written; None without one."""
    asked = _asked(text, answer) if answer.contour is not None else None
    if asked is None or asked.value is None or asked.question.unit is Unit.DEGREE:
        return asked.value if asked is not None else None
    return asked.value * (2 if asked.question.is_diameter else 1) / float(answer.unit.in_mm)


def _all_of(search: RangeSearch) -> tuple[float, float]:
    """All values that are looked at: a turn of an angle, and as much of a length as elsewhere, to each side."""
    reach = TURN / 2 if search.is_angle else max(REACH / search.scale, 2 * abs(search.stated))
    largest = LARGEST / search.scale
    return max(search.stated - reach, -largest), min(search.stated + reach, largest)


class _ToleranceSearch:
    """One word, and what is kept."""

    def __init__(self, search: RangeSearch, kept: _Kept, most: float, within: tuple[float, float]) -> None:
        self.search, self.kept, self.most, self.range = search, kept, most, within
        self.doubts: list[str] = []
        self.linear: float | None = None

    def ends(self) -> tuple[End, End]:
        """The lower and the upper end."""
        try:
            pieces = self.search.pieces(*self.range)
        except NotClosedError:
            pieces = []
        number = _piece_at(pieces, self.search.stated)
        self.linear = self._by_derivative(pieces[max(number - 1, 0) : number + 2]) if number is not None else None
        self.linear = self.linear or self._by_differences()
        if number is None:
            return self._searched(-1), self._searched(1)
        return self._end(pieces, number, -1), self._end(pieces, number, 1)

    def moved(self, value: float) -> float:
        """By how much what is kept is off with a value of the word, by the single solve."""
        return self.kept.moved(self.search.answer_at(value))

    def doubt(self, low: float, high: float, why: str) -> None:
        """Remember that between two values something is not proven."""
        ends = " to ".join(value_text(value, self.search.unit) for value in sorted((low, high)))
        self.doubts.append(f"{self.search.word} from {ends}: {why}")

    def _end(self, pieces: Sequence[RangePiece], number: int, way: int) -> End:
        """The lower (-1) or upper (1) end, from the piece on in which the word is as it stands."""
        place, first = self.search.stated, number
        while True:
            piece = pieces[number]
            value = self._leaving(piece, place, way)
            if value is not None:
                return self._moved_end(value, way)
            place = piece.high if way > 0 else piece.low
            number += way
            if not 0 <= number < len(pieces):
                return range_end(place, self.search.stated, self.search.unit)
            if not pieces[number].is_solved:
                return end_of_range(self.search, pieces, number - way, first, way)
            if self.moved(_beside(place, way, pieces[number])) > self.most:
                return self._moved_end(place, way)

    def _searched(self, way: int) -> End:
        """An end where there are no pieces, for there is no closed form."""
        value, limit = self._marched(self.search.stated, self.range[way > 0], way), self.range[way > 0]
        if value is None:
            return range_end(limit, self.search.stated, self.search.unit)
        return self._moved_end(value, way)

    def _leaving(self, piece: RangePiece, place: float, way: int) -> float | None:
        """The first value of a piece, from a place on, beyond which what is kept has moved too far."""
        low, high = (place, piece.high) if way > 0 else (piece.low, place)
        curve = self._curve(piece)
        if not low < high or (curve is not None and curve.is_constant()):
            return None
        if curve is None:
            return self._marched(place, piece.high if way > 0 else piece.low, way)
        for zero in sorted(isolate(curve, low, high).zeros, key=lambda each: way * each.value):
            if zero.way == way:
                return short(zero.value)
            if not zero.way and zero.width > NARROW * max(1.0, abs(zero.value)):
                self.doubt(zero.before, zero.after, f"{self.kept.text} may be farther off, or rounding is too large")
        return None

    def _curve(self, piece: RangePiece) -> TargetCurve | None:
        """The curve that is above zero where what is kept has moved too far; None where there is no closed form."""
        goals = outputs_at(self.kept.goal, piece.branch) if self.kept.goal and piece.branch else None
        if goals is None or piece.branch is None:
            return None
        return TargetCurve(piece.branch, goals, (piece.low, piece.high), most=self.most * self.kept.scale)

    def _marched(self, place: float, limit: float, way: int) -> float | None:
        """The last value, from a place to a limit, before one with which what is kept has moved too far, of those that
        are solved farther and farther from the place; None if it has not."""
        width = abs(limit - place)
        reach = step = min(self.linear / STEPS if self.linear else inf, width * FARTHEST)
        inside, outside, count = place, place, 0
        while inside != limit and self.moved(outside := place + way * min(reach, width)) <= self.most:
            inside, count = outside, count + 1
            step = min(step * GROWTH, width / FEWEST)
            reach += step
            if reach >= width - LEAST_GAP:
                # The limit itself is the end of the piece, where another one tells.
                outside = limit
                break
        self.doubt(place, outside, f"{count + 1} values were solved, and nothing is proven between them")
        if outside == limit and self.moved(limit - way * min(LEAST_GAP, width / 2)) <= self.most:
            return None
        width = CLOSEST * max(1.0, abs(outside))
        return short(halve(inside, outside, lambda value: self.moved(value) <= self.most, width)[0], CLOSEST)

    def _by_derivative(self, pieces: Sequence[RangePiece]) -> float | None:
        """The tolerance to first order, of what has a closed form."""
        curve = next(filter(None, map(self._curve, pieces)), None)
        if curve is None:
            return None
        slopes = (_slope(curve.branch, name, goal, self.search.stated) for name, goal in curve.goals.items())
        return _tolerance(self.most * self.kept.scale, hypot(*slopes))

    def _by_differences(self) -> float | None:
        """The same from values on both sides."""
        step = PROBE * max(1.0, abs(self.search.stated))
        slopes = [self.moved(self.search.stated + way * step) / step for way in (-1, 1)]
        return _tolerance(self.most, max((each for each in slopes if isfinite(each)), default=0.0))

    def _moved_end(self, value: float, way: int) -> End:
        """An end beyond which what is kept has moved too far, which single solves confirm."""
        stated, search = self.search.stated, self.search
        limits = limits_of(value, stated, search.unit, lambda each: self.moved(each) <= self.most * (1 + ROUNDING))
        inside, outside = sides_of(lambda each: self.moved(each) <= self.most, value, way, abs(value - stated))
        how, is_included = Way.MOVED, True
        if inside is None or outside is None:
            return End(value, how, self._reason(self.most), is_included, None, None, *limits)
        beyond = self.moved(outside)
        is_jump = beyond - self.moved(inside) > max(self.most, JUMP)
        reason = self._reason(beyond if is_jump else self.most, is_jump=is_jump)
        if is_jump:
            is_included = self.moved(value) <= self.most
        if beyond == inf and any(self.moved(each) == inf and search.is_solved(each) for each in (value, outside)):
            how, reason = Way.RULE, Reason(f"{self.kept.text} is not there", "", "")
        elif beyond == inf:
            how, reason = Way.BISECTION, self._failure(outside)
        return End(value, how, reason, is_included, inside, outside, *limits)

    def _reason(self, moved: float, *, is_jump: bool = False) -> Reason:
        by = f"{self.kept.text} moves by {moved:.6g} {short_name(self.kept.unit)}"
        return Reason(f"{by} at once, where another solution takes over" if is_jump else by, "", "")

    def _failure(self, outside: float) -> Reason:
        reason, _ = failure_of(self.search.answer_at(outside))
        return reason if reason.text else Reason("there is no contour", "", "")


JUMP = 1e-3
"""mm or degrees. What moves by more between two neighbours has jumped."""


def _piece_at(pieces: Sequence[RangePiece], value: float) -> int | None:
    """The piece in which a value is, a stretch if it is at the end of one."""
    inside = (number for number, each in enumerate(pieces) if each.low < value < each.high)
    touching = (number for number, each in enumerate(pieces) if each.is_solved and each.low <= value <= each.high)
    return next(inside, next(touching, None))


def _beside(place: float, way: int, piece: RangePiece) -> float:
    """The value of a piece of one value, or a value of a stretch close to where it begins."""
    return place + way * min(NARROW * max(1.0, abs(place)), (piece.high - piece.low) / 2)


def _slope(branch: Branch, name: str, goal: tuple[int, float], value: float) -> float:
    """The derivative of a coordinate by the word."""
    curve = TargetCurve(branch, {name: goal}, (value, value))
    return float(curve.chart.slopes_at(numpy.array([value]), curve.fixed)[0][0])


def _tolerance(most: float, slope: float) -> float | None:
    return most / slope if isfinite(slope) and slope > CONSTANT else None
