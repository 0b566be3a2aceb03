"""The inverse question: which value of a word brings a point to a place, or as near to it as it gets."""

from collections.abc import Iterable, Iterator, Sequence
from decimal import ROUND_HALF_EVEN, Decimal
from math import ceil, floor, isfinite
from typing import Any, Unpack, overload

import numpy
from msgspec import Struct

from contoursolve.diagnosis import Answer, join, typed_text, value_text, with_value, write_word
from contoursolve.diagnostics import Shown, check_type
from contoursolve.families.block_template import BlockOptions, Template, first_error, spec_of
from contoursolve.families.branches import Branch
from contoursolve.families.case_classes import results_of
from contoursolve.families.errors import FamilyError, NotClosedError, NotMovedError
from contoursolve.families.free_words import check_block
from contoursolve.families.goals import (
    CONSTANT,
    Goal,
    TargetCurve,
    asked_values,
    asking_for,
    outputs_at,
    place_of,
    read_goal,
)
from contoursolve.families.isolate import Zero, isolate
from contoursolve.families.range_pieces import LEAST_GAP, NARROW, RangePiece, RangeSearch, short
from contoursolve.families.results import ResultNames, coordinate_name
from contoursolve.families.sensitivities import slopes_of
from contoursolve.gcode import FACT
from contoursolve.geometry import FIRST, SECOND, Length, Plane, Unit, assemble
from contoursolve.numeric import Intervals
from contoursolve.program import takes
from contoursolve.reading import Premises
from contoursolve.solving import Certificate, Contour, Point, Status, analyse

ARRIVED = 1e-9
"""mm. A point this close to the place where it is wanted is there."""

TURN = 360.0
"""Degrees."""

UNDECIDED = 1e-12
"""Share of a value (at least of 1). In a part that is no wider all numbers are alike: a single solve decides."""

BESIDE = 1e-5
"""Share of a value (at least of 1). How far beside it others are looked at, whether they are nearer to the goal."""


class Hit(Struct, frozen=True):
    """A value of the word that brings the point where it is wanted, or nearer than its neighbours do.

    `point` is where the point is then, `away` how far from the goal (mm). `certificate` is that of the single solve.
    `block` is the text with the value rounded to the control's least increment, which is `rounded` (for a word of the
    start point the words of that, and facts that stand beside the block on lines of their own), and
    `rounded_away` how far from the goal the point is then; None where the block with the rounded value has no contour.
    """

    value: float
    point: Point
    away: float
    certificate: Certificate | None
    rounded: float
    block: str
    rounded_away: float | None


class FoundValues(Shown, Struct, frozen=True):
    """All values of a word, within a range, that meet a goal, in order; for a goal of two coordinates, all that are
    nearer to it than their neighbours, the nearest first. Values that differ in the first nine digits are two.

    Attributes:
        word: the word by its name, such as `A`.
        unit: what it is written in: mm, inch or deg; so are all values here.
        stated: the value that the block has.
        goal: the point and where it is wanted, mm, X of a lathe as radius.
        plane: the axes of that place, first and second.
        length: the unit of the program.
        within: the range that was searched, from one value to another.
        hits: the values, each with where the point then is.
        doubts: why these are not proven to be all.
        remark: why there is no value: the word does not move the point, with the words that do; or the block as it
            stands has no contour. Else empty.
        premises: what the contours assume besides the words.
    """

    word: str
    unit: str
    stated: float
    goal: Goal
    plane: Plane
    length: Length
    within: tuple[float, float]
    hits: tuple[Hit, ...]
    doubts: tuple[str, ...]
    remark: str = ""
    premises: Premises = Premises()

    @property
    def is_complete(self) -> bool:
        """Whether these are proven to be all."""
        return not self.doubts


@overload
def find(
    block: str,
    word: str,
    goal: str,
    *,
    within: tuple[float, float] | None = None,
    **options: Unpack[BlockOptions],
) -> FoundValues: ...


@overload
def find(block: str, word: tuple[str, str], goal: str, **options: Unpack[BlockOptions]) -> Answer: ...


@takes(BlockOptions)
def find(
    block: str,
    word: str | tuple[str, str],
    goal: str,
    *,
    within: tuple[float, float] | None = None,
    **options: Unpack[BlockOptions],
) -> Any:
    """Every value of a word, as it is written, that brings a point of the contour where it is wanted; or of two words.

    Args:
        block: the block, or the blocks of one contour; the word stands in it with any value.
        word: the word by its letter (`A`, `,A`), or with its line where several have it (`2:,A`); a word of the start
            point as `start X`; a fact by what it gives the value of (`length of line 1`).
        goal: a point and where it is wanted, in words as the control reads them: `end Z-50.`, `V1 X44.`,
            `corner 1.center Z-30.`. With both coordinates, such as `end Z-50. X100.`, it finds the values at which
            the point is nearest to there.
        within: and the options as for `contoursolve.ranges`, with the same errors; also raises FamilyError for a point
            that the contour does not have. Where the word does not move the point, `remark` names the words that do;
            there is no value then, or that of the word if the point is there already.

    Where the contour exists, interval arithmetic isolates every zero; each is solved and certified by itself. `doubts`
    say what it could not decide. Where facts or `?` leave no closed form, it asks for the word as `solve` does: the
    goal is one fact more.

    Two words bring both coordinates of a point to their places. `find` gives the `Answer` of the block that asks for
    both then: `asked` has their values (mm, X of a lathe as radius, or degrees), `solutions` all that there are.

    >>> two = find("G111 X100. A180. K-30. B120. P5. Q5.", ("K", "A"), "V1 Z-20. X44.", start="X40. Z0.")
    >>> [(each.word.address, round(each.value, 4)) for each in two.asked]
    [('K', -20.0), ('A', 174.2894)]
    >>> found = find("G111 X100. A180. K-30. B120. P5. Q5.", "B", "end Z-50.", start="X40. Z0.")
    >>> [(round(each.value, 4), each.block) for each in found.hits]
    [(119.6749, 'G111 X100. A180. K-30. B119.675 P5. Q5.')]
    """
    words = (word,) if isinstance(word, str) else word
    check_type("word", words, Sequence, "a word, such as 'P', or two, such as ('A', 'P')")
    template = spec_of(block, words, **options).template()
    check_block(template)
    answer = template.solve({})
    wanted = read_goal(goal, answer)
    if not isinstance(word, str):
        if len(words) != 2 or within is not None:  # noqa: PLR2004 - two coordinates
            raise FamilyError("find takes one word, with or without `within`, or two words without it")
        return asking_for(template, wanted, answer)
    _check_open(answer)
    search = RangeSearch(template)
    low, high = search.range_of(within)
    target = _TargetSearch(search, wanted)
    about = (search.word, search.unit, search.stated, wanted, answer.plane, answer.unit, (low, high))
    remark = first_error(answer)
    remark = f"as it stands, the block has no contour: {remark}" if remark else ""
    try:
        hits = target.hits(search.pieces(low, high))
    except NotClosedError:
        if template.words[search.word].span.line not in _lines(template):
            raise
        try:
            hits = target.hits_by_asking(answer, (low, high))
        except NotMovedError as error:
            hits, remark = target.there(), _moved_by(answer, wanted, error)
        return FoundValues(*about, tuple(hits), tuple(target.doubts), "" if hits else remark, search.premises)
    except NotMovedError as error:
        moved = _moved_by(answer, wanted, error)
        return FoundValues(*about, tuple(target.there()), target.all_doubts, moved, search.premises)
    if wanted.is_nearest:
        hits.sort(key=lambda each: each.away)
    return FoundValues(*about, tuple(hits), target.all_doubts, "" if hits else remark, search.premises)


def _moved_by(answer: Answer, goal: Goal, error: NotMovedError) -> str:
    """The text of an error, with the words that move the point, as far as derivatives tell."""
    axes = answer.plane.axes
    try:
        slopes = slopes_of(answer).slopes
    except FamilyError:
        return str(error)
    names = [coordinate_name(goal.point, axes[axis]) for axis in (FIRST, SECOND) if goal.place[axis] is not None]
    words = {word for name in names for word, slope in slopes[name].items() if not abs(slope) <= CONSTANT}
    moving = [word for word in next(iter(slopes.values()), {}) if word in words]
    return f"{error}; {join(moving)} {'does' if len(moving) == 1 else 'do'}" if moving else str(error)


def _check_open(answer: Answer) -> None:
    """Raise FamilyError where further facts cannot be used, or leave something open, whatever the values."""
    if answer.profile.is_extended and answer.contour is None:
        is_open = not analyse(assemble(answer.profile)).is_determined
        error = first_error(answer)
        if error and (is_open or answer.status is Status.REJECTED):
            raise FamilyError(error)


def _lines(template: Template) -> set[int]:
    """The lines of the block, and those of the facts beside it."""
    return {block.line for block in template.program.blocks} | {fact.span.line for fact in template.asked.facts}


def _is_one(value: float, other: float) -> bool:
    """Whether two values count as one."""
    return abs(value - other) <= ARRIVED * max(1.0, abs(value))


def _turned(angle: float, low: float, high: float) -> list[float]:
    """The angles of the same direction between two others, degrees."""
    first, last = ceil((low - angle) / TURN), floor((high - angle) / TURN)
    return [angle + number * TURN for number in range(first, last + 1)]


def _width_in(zero: Zero, piece: RangePiece) -> float:
    """The width of what is not decided about a zero; of what lies at the end of a piece, nothing that is one value."""
    low, high = max(zero.before, piece.low), min(zero.after, piece.high)
    is_at_end = (zero.before, zero.after) != (low, high)
    return 0.0 if is_at_end and high - low <= NARROW * max(1.0, abs(zero.value)) else zero.width


class _Candidate(Struct, frozen=True):
    """A value that may meet the goal, how far from it the point may be all the same (mm), and why the list is not
    complete if it does not; empty where the value alone is in question, which a single solve decides."""

    value: float
    give: float = ARRIVED
    doubt: str = ""


class _TargetSearch:
    """One goal for one word."""

    def __init__(self, search: RangeSearch, goal: Goal) -> None:
        self.search, self.goal = search, goal
        self.doubts: list[str] = []

    def hits(self, pieces: Sequence[RangePiece]) -> list[Hit]:
        """The values that meet the goal, in order. What may be one and is not found to be is a doubt."""
        tried = [(each, self.hit(each.value, each.give)) for each in self._candidates(pieces)]
        found: list[Hit] = []
        for hit in sorted((hit for _, hit in tried if hit is not None), key=lambda each: each.value):
            if not found or not _is_one(found[-1].value, hit.value):
                found.append(hit)
            elif hit.away < found[-1].away:
                found[-1] = hit
        for each in (each for each, hit in tried if hit is None):
            if each.doubt and not any(_is_one(each.value, other.value) for other in found):
                self.doubt(each.value, each.doubt)
        return found

    def there(self) -> list[Hit]:
        """The value that the word has, if the point is where it is wanted, which no other value changes."""
        hit = self.hit(self.search.stated) if not self.goal.is_nearest else None
        if hit is not None and not self.doubts:
            self.doubt(hit.value, f"all values near it leave {self.goal.point} where it is")
        return [hit] if hit is not None else []

    def hits_by_asking(self, answer: Answer, within: tuple[float, float]) -> list[Hit]:
        """The same where there is no closed form: every solution of the equations is looked for."""
        low, high = within
        values, doubts = asked_values(self.search.template, self.search.word, self.goal, answer)
        self.doubts += doubts
        values = [short(value) for value in values]
        if self.search.is_angle:
            values = [each for value in values for each in _turned(value, low, high)]
        found = []
        for value in sorted(value for value in values if low <= value <= high):
            hit = self.hit(value)
            if hit is not None:
                found.append(hit)
            else:
                self.doubt(value, "there is a value, and single solves do not confirm it")
        return found

    @property
    def all_doubts(self) -> tuple[str, ...]:
        """The reasons for which the values that were found are not proven to be all."""
        return tuple(dict.fromkeys((*self.search.doubts, *self.doubts)))

    def doubt(self, value: float, why: str) -> None:
        """Remember that it is not proven what is at a value."""
        self.doubts.append(f"{self.search.word} {value_text(value, self.search.unit)}: {why}")

    def _candidates(self, pieces: Sequence[RangePiece]) -> list[_Candidate]:
        """The values that may meet the goal."""
        found: list[_Candidate] = []
        ends = pieces[0].low, pieces[-1].high
        moves = is_there = False
        for piece in pieces:
            if piece.branch is None:
                found += [_Candidate(piece.low)] if piece.is_value and piece.is_solved else []
                continue
            curve = self._curve(piece.branch, (piece.low, piece.high))
            if curve is None:
                continue
            is_there = True
            if curve.is_constant():
                found += self._level(curve, piece)
                continue
            moves = True
            # A piece may end a little before the contour does; what is beyond it is decided by single solves.
            low, high = max(ends[0], piece.low - LEAST_GAP), min(ends[1], piece.high + LEAST_GAP)
            for zero in isolate(curve, low, high).zeros:
                found += self._of_zero(zero, curve, piece)
            found += [_Candidate(value) for value in self._ends(curve, piece)]
        if not is_there and any(piece.is_solved and not piece.is_value for piece in pieces):
            have = ", ".join(ResultNames(self.search.answer.profile, self._results(pieces)).points)
            raise FamilyError(f"the contour has no point {self.goal.point}; there are {have}")
        if is_there and not moves:
            raise NotMovedError(f"{self.search.word} does not move {self.goal.point} in this direction")
        return found

    def _of_zero(self, zero: Zero, curve: TargetCurve, piece: RangePiece) -> Iterator[_Candidate]:
        """The candidate at a zero of the curve."""
        is_proven = not zero.width
        if self.goal.is_nearest and is_proven and zero.way < 0:
            return  # farther than its neighbours
        is_inside, doubt = piece.low < zero.value < piece.high, ""
        if is_proven and is_inside:
            doubt = "there is a value, and single solves do not confirm it"
        elif is_inside and _width_in(zero, piece) > UNDECIDED * max(1.0, abs(zero.value)):
            doubt = f"{self.goal.point} may be there, or comes as near as rounding can tell"
        give = ARRIVED
        if is_proven and not self.goal.is_nearest:
            # Where the point moves fast, no number of 16 digits brings it nearer.
            slope = curve.slopes(Intervals(numpy.array([zero.value]), numpy.array([zero.value])))
            steepest = float(max(-slope.low[0], slope.high[0]))
            give = max(ARRIVED, 2 * steepest * float(numpy.spacing(abs(zero.value)))) if isfinite(steepest) else ARRIVED
        yield _Candidate(zero.value, give, doubt)

    def _level(self, curve: TargetCurve, piece: RangePiece) -> Iterator[_Candidate]:
        """A value of a piece in which the word does not move the point, if that is where it is wanted."""
        stated = self.search.stated
        value = stated if piece.low < stated < piece.high else (piece.low + piece.high) / 2
        if not self.goal.is_nearest and abs(float(curve.at(numpy.array([value]))[0])) <= ARRIVED:
            self.doubt(value, f"all values near it leave {self.goal.point} where it is")
            yield _Candidate(value)

    def _ends(self, curve: TargetCurve, piece: RangePiece) -> Iterator[float]:
        """Ends of a piece that may meet the goal."""
        step = ARRIVED * max(1.0, abs(piece.low), abs(piece.high))
        inner = numpy.array([piece.low + step, piece.high - step])
        low, high = curve.at(inner)
        for value, rises in ((piece.low, low), (piece.high, -high)):
            if not self.goal.is_nearest or not rises < 0:  # true for NaN
                yield value

    def _results(self, pieces: Sequence[RangePiece]) -> Iterable[str]:
        """The names of the results of the contour."""
        return results_of(next(piece.case for piece in pieces if piece.case and piece.is_solved))

    def _curve(self, branch: Branch, within: tuple[float, float]) -> TargetCurve | None:
        """The curve of a solution; None where it has no such point."""
        goals = outputs_at(self.goal, branch)
        return TargetCurve(branch, goals, within) if goals is not None else None

    def hit(self, value: float, give: float = ARRIVED) -> Hit | None:
        """The hit at a value by its single solve, as a shorter number where rounding alone parts the two; None if it
        does not meet the goal."""
        return next(
            (hit for each in dict.fromkeys((short(value), value)) if (hit := self._hit(each, give)) is not None), None
        )

    def _hit(self, value: float, give: float) -> Hit | None:
        answer = self.search.answer_at(value)
        at = place_of(self.goal.point, answer.contour)
        if at is None:
            return None
        away = self.goal.away(at)
        if not (self._is_least(value, away) if self.goal.is_nearest else away <= give):
            return None
        rounded, block, there = self._rounded(value)
        reached = place_of(self.goal.point, there)
        return Hit(value, at, away, answer.certificate, rounded, block, self.goal.away(reached) if reached else None)

    def _is_least(self, value: float, away: float) -> bool:
        """Whether the point is no nearer to the goal at values beside this one."""
        step = BESIDE * max(1.0, abs(value))
        places = [place_of(self.goal.point, self.search.answer_at(value + way * step).contour) for way in (-1, 1)]
        return all(away <= self.goal.away(at) + ARRIVED for at in places if at is not None)

    def _rounded(self, value: float) -> tuple[float, str, Contour | None]:
        """The value in least increments of the control, the block with it, and its contour; rounded to the other side
        if only that has one."""
        search, answer = self.search, self.search.answer_at(self.search.stated)
        step = answer.claim.lexicon.numbers.step(Unit.DEGREE if search.is_angle else Unit.MM, answer.unit)
        nearest = Decimal(repr(value)).quantize(step, ROUND_HALF_EVEN)
        numbers = [float(nearest), float(nearest + (step if nearest < Decimal(repr(value)) else -step))]
        chosen = next((each for each in numbers if search.is_solved(each)), numbers[0])
        return chosen, self._text(chosen, answer), search.answer_at(chosen).contour

    def _text(self, value: float, answer: Answer) -> str:
        """The block with a value, and the facts beside it; for a word of the start point, the words of that."""
        template, word = self.search.template, self.search.word
        typed = template.words[word]
        if typed.address == FACT:
            texts = {word: with_value(typed, typed_text(value), template.program.syntax.words)}
        else:
            lexicon, unit = answer.claim.lexicon, answer.unit
            texts = {word: write_word(typed.address, value * self.search.scale, lexicon, unit)}
        if template.asked.start is not None and typed.span.line not in _lines(template):
            return "\n".join(template.lines(template.asked.start, texts))
        facts = template.typed(texts).asked.facts
        return "\n".join([*template.lines(template.program, texts), *(fact.text for fact in facts)])
