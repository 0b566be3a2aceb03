"""Where a contour exists in two words: the lines that bound the region, each with what fails beyond it."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from typing import TypeVar, Unpack

import numpy
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve.diagnosis import join, value_text
from contoursolve.diagnostics import Shown
from contoursolve.families.boundary_tracing import BISECTIONS, NODES, BoundaryTrace, Field, GridLines, edge_of, gaps_of
from contoursolve.families.branches import branches_of
from contoursolve.families.case_classes import INSTEAD, CaseClass, FreeWords
from contoursolve.families.errors import ByRowError, FamilyError
from contoursolve.families.feasible_ranges import ASIDE, NO_FAILURE, Reason, Way, failure_of, phrase, refused, same
from contoursolve.families.free_words import are_compared, check_block
from contoursolve.families.sampled_regions import SampledField
from contoursolve.families.spec import BlockOptions, Ranges, SweepSpec, Template, called, spec_of
from contoursolve.families.subdivision import bisect
from contoursolve.geometry import Unit
from contoursolve.numeric import Array
from contoursolve.reading import Premises
from contoursolve.solving import NoteKind, Point, RefusalKind
from contoursolve.tolerance import LENGTH

T = TypeVar("T")


class Boundary(Struct, frozen=True):
    """A line that bounds the region, or a gap in it.

    `points` are values of both words, each a zero of what fails on the other side, to rounding; the first and the last
    are the same for a closed line. Where two lines meet at a point that Newton's method does not find, they end within
    a cell of it. `reason` says what fails beyond the line. `inside` and `outside` are values beside its middle with and
    without the contour; for a gap (`is_gap`), a line on which alone there is none, they are those on its two sides.
    `unverified` counts the points, but for the ends, at which single solves on both sides do not tell so.
    """

    points: tuple[Point, ...]
    reason: Reason
    way: Way
    inside: Point | None
    outside: Point | None
    is_gap: bool
    unverified: int


class Region(Shown, Struct, frozen=True):
    """Where a block has a contour, by two of its words within a box: the lines that bound these values.

    `units` are what the words are written in. Without `doubts`, no line is missing, with proof, and no part wider than
    a cell of `cell` (by word); else they say why. `spec` is the block, and `fixed` has the values
    of its other free words.
    """

    words: tuple[str, str]
    units: tuple[str, str]
    stated: Point
    within: tuple[Point, Point]
    boundaries: tuple[Boundary, ...]
    cell: Point
    doubts: tuple[str, ...]
    exists: bool
    """Whether the contour exists anywhere in the box, as far as was looked."""
    spec: SweepSpec
    fixed: Mapping[str, float]
    resting: Premises = Premises()
    """What its contours rest on beside the words."""

    @property
    def is_complete(self) -> bool:
        """Whether these lines are proven to be all."""
        return not self.doubts


def region(
    block: str,
    words: tuple[str, str],
    within: tuple[Point, Point],
    **options: Unpack[BlockOptions],
) -> Region:
    """The region of two words' values, as they are written, in which the contour is solved.

    Args:
        block: the block, or the blocks of one contour.
        words: the two words, words of the start point, or facts, as for `feasible`.
        within: the range of each, lower value first.
        options: as for `feasible`, with the same errors.

    A grid lies over the box. A search along its lines finds where the contour begins to fail; cell by cell it joins
    these points, each brought onto the zero of what fails. Interval arithmetic proves that each other cell is alike
    in all of it.

    >>> found = region("G111 X100. A180. K-30. B120. P5. Q5.", ("A", "P"), ((150, 210), (1, 60)), start="X40. Z0.")
    >>> [each.reason.text for each in found.boundaries]
    ['P is too large for line 1', 'P is too large for line 2']
    """
    if isinstance(words, str) or len(words) != 2 or len(within) != 2:  # noqa: PLR2004 - axes of a map
        raise FamilyError("name two words, and a range for each of them")
    spec = spec_of(block, words, **options)
    template = spec.template()
    check_block(template)
    return _region(_RegionSearch(template, within), spec, {})


def region_of(spec: SweepSpec, ranges: Ranges, words: tuple[str, str]) -> Region:
    """The region of two words of a sweep, between the least and the largest of the values that they have in it.

    Raises FamilyError as `region`, and where one of the other words has several values.
    """
    values = ranges.values
    others = {name: column for name, column in values.items() if name not in words}
    several = next((name for name, column in others.items() if column.size > 1), None)
    if several is not None or any(word not in values for word in words):
        raise FamilyError(f"{' and '.join(words)} are not the only words that vary")
    fixed = {name: float(column[0]) for name, column in others.items()}
    template = spec.template().filled(fixed).with_words(words)
    first, second = ((float(values[word].min()), float(values[word].max())) for word in words)
    return _region(_RegionSearch(template, (first, second)), spec, fixed)


def _region(search: "_RegionSearch", spec: SweepSpec, fixed: Mapping[str, float]) -> Region:
    """By closed forms, or where only each row tells how it is read, by rows on a grid."""
    try:
        return search.run(spec, fixed)
    except ByRowError:
        return search.sample(spec, fixed)


class _RegionSearch(FreeWords):
    """Two words of one block."""

    def __init__(self, template: Template, within: Sequence[tuple[float, float]]) -> None:
        super().__init__(template)
        if len(self.names) == 1:
            raise FamilyError(f"{self.names[0]} is named twice")
        for word, kind in zip(self.names, self.kinds, strict=True):
            if kind is Unit.SIGN:
                raise FamilyError(f"{template.words[word].text} has no range; name words that state lengths or angles")
        self.within = [self.limits_within(axis, each) for axis, each in enumerate(within)]
        self.ticks: list[list[float]] = []
        self.cases: dict[tuple[int, int], CaseClass] = {}

    def run(self, spec: SweepSpec, fixed: Mapping[str, float]) -> Region:
        """The region, of a block that is read by these. Raises ByRowError where only each row tells how."""
        names = join([called(name) for name in self.names])
        if are_compared(self.template, self.answer.claim):
            raise ByRowError(f"the control compares {names} with each other; {INSTEAD}")
        self.ticks = self.marks(self.within)
        for place in product(*(range(len(marks) - 1) for marks in self.ticks)):
            middle = [(self.ticks[axis][place[axis]] + self.ticks[axis][place[axis] + 1]) / 2 for axis in (0, 1)]
            self.cases[place[0], place[1]] = self.case_at(*middle)
        for axis in (0, 1):
            self._merge(axis)
        boundaries: list[Boundary] = []
        fields = {place: self._field(place, case) for place, case in self.cases.items() if case.status is None}
        for place, field in fields.items():
            case = self.cases[place]
            edge, gaps = edge_of(field), list(gaps_of(field))
            boundaries += [
                self._boundary(field, case, trace, is_gap=False) for trace in edge.traces() if _has_extent(field, trace)
            ]
            cells = [*edge.cells]
            for lines in gaps:
                for trace in lines.traces():
                    margins = numpy.abs(field.values(trace.points)[trace.check])
                    if _is_zero(margins):
                        boundaries.append(self._boundary(field, case, trace, is_gap=True))
                    elif not margins.min() > LENGTH:  # nor does it jump there
                        self.doubts.append("there may be a line on which something is zero that must not be")
                cells += lines.cells
            if not field.is_proven(cells):
                self.doubts.append("some part could not be proven to be alike, however finely it was divided")
        boundaries += self._limit_lines(fields)
        first, second = ((high - low) / (NODES - 1) for low, high in self.within)
        return Region(
            words=_two(self.names),
            units=_two(self.units),
            stated=_two(self.values),
            within=_two(self.within),
            boundaries=tuple(boundaries),
            cell=(first, second),
            doubts=tuple(dict.fromkeys(self.doubts)),
            exists=any(field.is_inside.any() for field in fields.values()),
            spec=spec,
            fixed=fixed,
            resting=self.resting,
        )

    def sample(self, spec: SweepSpec, fixed: Mapping[str, float]) -> Region:
        """The region, as far as rows on a grid tell it."""
        field = SampledField(spec, self.names, self.within, fixed)
        everywhere = numpy.ones_like(field.is_inside)
        lines = GridLines(field, field.is_inside, lambda points: field.failing(points) < 0, field.failing, everywhere)
        cell = field.size / (field.count - 1)
        boundaries = [self._sampled(trace, 2 * cell / 2**field.bisections) for trace in lines.traces()]
        names, (first, second) = join([called(name) for name in self.names]), cell.tolist()
        doubt = f"each value of {names} decides how the block is read, and {field.solved:,} of them were solved"
        return Region(
            words=_two(self.names),
            units=_two(self.units),
            stated=_two(self.values),
            within=_two(self.within),
            boundaries=tuple(boundaries),
            cell=(first, second),
            doubts=(doubt,),
            exists=bool(field.is_inside.any()),
            spec=spec,
            fixed=fixed,
            resting=self.resting,
        )

    def _sampled(self, trace: BoundaryTrace, step: Array) -> Boundary:
        """A line between rows with and without a contour, of which points are told apart by steps along the words."""
        point = trace.points[len(trace.points) // 2]
        places = [point, *(point + way * step * (numpy.arange(2) == axis) for axis in (0, 1) for way in (-1, 1))]
        sides = [(float(each[0]), float(each[1])) for each in places]
        inside = next((side for side in sides if self.is_solved(*side)), None)
        outside = next((side for side in sides if not self.is_solved(*side)), None)
        failure = failure_of(self.answer_at(*outside))[0] if outside is not None else NO_FAILURE[0]
        failure = replace(failure, text=failure.message or "there is no contour")
        points = tuple((float(first), float(second)) for first, second in trace.points)
        return Boundary(points, failure, Way.BISECTION, inside, outside, is_gap=False, unverified=0)

    def _merge(self, axis: int) -> None:
        """Leave out the limits of rules that change nothing for these words."""
        mark = 1
        while mark < len(self.ticks[axis]) - 1:
            others = range(len(self.ticks[1 - axis]) - 1)
            if all(self.cases[_pair(axis, mark - 1, n)].is_like(self.cases[_pair(axis, mark, n)]) for n in others):
                del self.ticks[axis][mark]
                self.cases = {
                    _pair(axis, each[axis] - (each[axis] >= mark), each[1 - axis]): case
                    for each, case in self.cases.items()
                }
            else:
                mark += 1

    def _field(self, place: tuple[int, int], case: CaseClass) -> Field:
        low, high = ([self.ticks[axis][place[axis] + side] for axis in (0, 1)] for side in (0, 1))
        return Field(branches_of(case, self.names, low, high), low, high)

    def _boundary(self, field: Field, case: CaseClass, trace: BoundaryTrace, *, is_gap: bool) -> Boundary:
        """A line with what fails beyond it, solved on both sides of its points."""
        ways = _normals(trace.points / field.size) * field.size
        found = [self._beside(case, point, way, is_gap) for point, way in zip(trace.points, ways, strict=True)]
        middle = len(found) // 2
        inside, outside = found[middle]
        unverified = sum(pair == (None, None) for pair in found[1:-1])
        there = outside if outside is not None else tuple(trace.points[middle].tolist())
        reason = self._reason(field, case, trace.check, (there[0], there[1]), is_gap=is_gap)
        points = tuple((float(first), float(second)) for first, second in trace.points)
        return Boundary(points, reason, Way.BISECTION, inside, outside, is_gap, unverified)

    def _beside(self, case: CaseClass, point: Array, way: Array, is_gap: bool) -> tuple[Point | None, Point | None]:
        """Values close to a point on both sides of its line, with and without the contour."""
        for share in ASIDE:
            sides = [(float(each[0]), float(each[1])) for each in (point + share * way, point - share * way)]
            states = [bool(case.solve(self.at(side)).points) for side in sides]
            if is_gap and all(states):
                return sides[0], sides[1]
            if not is_gap and states[0] is not states[1]:
                return (sides[0], sides[1]) if states[0] else (sides[1], sides[0])
        return None, None

    def _reason(self, field: Field, case: CaseClass, number: int, there: Point, *, is_gap: bool) -> Reason:
        """What fails beyond a line, at values there."""
        failure, event = failure_of(self.answer_at(*there)) if not is_gap else NO_FAILURE
        if event is NoteKind.SEVERAL:
            return failure
        check, checks, refusal = field.checks[number], field.checks, event if isinstance(event, RefusalKind) else None
        if refusal is not None and not same(check.kind, refusal):
            fails = field.fails(numpy.array([there]))[:, 0]
            check = next((checks[each] for each in numpy.flatnonzero(fails) if same(checks[each].kind, refusal)), check)
        text = phrase(check, refusal or check.kind, case)
        return replace(failure, text=text)

    def _limit_lines(self, fields: Mapping[tuple[int, int], Field]) -> Iterator[Boundary]:
        """The parts of the limits of rules beyond which there is no contour."""
        for place, field in fields.items():
            for axis, way in product((0, 1), (-1, 1)):
                other = _pair(axis, place[axis] + way, place[1 - axis])
                if other not in self.cases:
                    continue
                value = float((field.high if way > 0 else field.low)[axis])
                neighbour = fields.get(other)

                def is_edge(
                    points: Array, own: Field = field, neighbour: Field | None = neighbour
                ) -> NDArray[numpy.bool_]:
                    found: NDArray[numpy.bool_] = own.failing(points) < 0
                    return found if neighbour is None else found & (neighbour.failing(points) >= 0)

                step = way * ASIDE[0] * max(1.0, abs(value))
                for span in _runs(is_edge, field, axis, value):
                    yield self._limit(axis, value, step, span)

    def _limit(self, axis: int, value: float, step: float, span: Point) -> Boundary:
        """A part of the limit of a rule."""
        middle = (span[0] + span[1]) / 2
        inside, outside = (_pair(axis, value + side, middle) for side in (-step, step))
        answer = self.answer_at(*outside)
        (failure, event), where = failure_of(answer), "above" if step > 0 else "below"
        values = f"{called(self.names[axis])} {where} {value_text(value, self.units[axis])}"
        is_rule = failure.code and event is None
        text = refused(failure.code, event, values) if is_rule else f"there is no contour for {values}"
        is_told = answer.contour is None and self.is_solved(*inside)
        points = tuple(_pair(axis, value, end) for end in span)
        unverified = 0 if is_told else 1
        return Boundary(
            points, replace(failure, text=text), Way.RULE, inside, outside, is_gap=False, unverified=unverified
        )


def _has_extent(field: Field, trace: BoundaryTrace) -> bool:
    """Whether a line is more than what a length that counts as zero leaves of the edge of the box."""
    near = ASIDE[2] * field.size
    away = numpy.minimum(trace.points - field.low, field.high - trace.points)
    is_along_edge = bool((away <= near).all(axis=0).any())
    return not is_along_edge and bool((numpy.ptp(trace.points, axis=0) > near).any())


def _normals(points: Array) -> Array:
    """Unit vectors across a line at its points, by (point, word)."""
    ways = numpy.gradient(points, axis=0)
    sizes = numpy.sqrt((ways**2).sum(axis=1))
    sizes[sizes == 0] = 1.0
    found: Array = numpy.stack([-ways[:, 1] / sizes, ways[:, 0] / sizes], axis=1)
    return found


def _is_zero(margins: Array) -> bool:
    """Whether margins are zero on a line, and do not jump there."""
    return bool(margins.max() <= LENGTH)


def _runs(tell: Callable[[Array], NDArray[numpy.bool_]], field: Field, axis: int, value: float) -> Iterator[Point]:
    """The parts of an edge of the box for which something holds, by the values of the other word."""
    along = field.axes[1 - axis]

    def points(values: Array) -> Array:
        both = [numpy.full(values.size, value), values]
        return numpy.stack(both if axis == 0 else both[::-1], axis=1)

    states = tell(points(along))
    changes = numpy.flatnonzero(states[1:] != states[:-1])
    before = states[changes]
    ends, begins = bisect(along[changes], along[changes + 1], lambda middle: tell(points(middle)) == before, BISECTIONS)
    lows = [*([along[0]] if states[0] else []), *begins[~before]]
    highs = [*ends[before], *([along[-1]] if states[-1] else [])]
    yield from ((float(low), float(high)) for low, high in zip(lows, highs, strict=True))


def _two(values: Sequence[T]) -> tuple[T, T]:
    """What concerns the two words."""
    first, second = values
    return first, second


def _pair(axis: int, own: T, other: T) -> tuple[T, T]:
    """What concerns a word and the other one, in their order."""
    return (own, other) if axis == 0 else (other, own)
