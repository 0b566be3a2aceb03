"""Aligns two paths: what both have, however it is divided, and the detours between where they are not the same."""

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from itertools import takewhile
from math import hypot, inf

from msgspec import Struct

from contoursolve.comparison.travel import Motion, Place, Step, Travel, Unfollowed, deviation, distance

_ALONG = (1.0, 0.7548776662, 0.5698402910)
"""The direction along which starts are sorted; two that differ on a part seldom lie at one place along it."""
_WIDEST = 300_000
"""Pairs of moves that are weighed in one detour at most."""
_BAND = 32
_GAP = 1.0


class Detour(Struct, frozen=True):
    """Steps of either path, from where both begin together to where both go on together."""

    old: range
    new: range


class Alignment(Struct, frozen=True):
    """The parts that two paths have in common, and the detours between."""

    detours: tuple[Detour, ...]
    """The parts that are not the same."""
    shared: tuple[tuple[int, int], ...]
    """Steps of OLD and of NEW that begin together, in order, and behind them the ends of both."""
    deviation: float
    """mm. How far apart they are at most, where they are the same."""
    lines: tuple[int, int] | None
    """The lines of OLD and of NEW there."""


class _Match(Struct, frozen=True):
    """Up to which fraction of its way each element was found to be the same, and how far apart they are, mm."""

    old: float
    new: float
    deviation: float


class _Cursor(Struct):
    """A place on a path: an element, and the fraction of its way that is done."""

    steps: Sequence[Step]
    index: int = 0
    done: float = 0.0

    @property
    def step(self) -> Step | None:
        return self.steps[self.index] if self.index < len(self.steps) else None

    def go(self, done: float) -> None:
        self.index, self.done = (self.index + 1, 0.0) if done >= 1 else (self.index, done)

    def place(self) -> Place | None:
        """The position of the tool; None if it is not known."""
        step = self.step
        if isinstance(step, Travel):
            return step.at(self.done)
        before = self.steps[self.index - 1] if self.index else None
        return before.end if isinstance(before, Travel) else None


def align(old: Sequence[Step], new: Sequence[Step], tolerance: float) -> Alignment:
    """Follow both paths, to within a tolerance (mm), over each detour where they are not the same to the nearest
    place from which they are.

    It makes no difference into how many collinear lines or arcs of one circle a cut is divided.
    """
    one, other = _Cursor(old), _Cursor(new)
    index = _Starts(old, new, tolerance)
    detours, shared, together = list[Detour](), list[tuple[int, int]](), (0, 0)
    largest, lines = 0.0, None
    while one.step is not None or other.step is not None:
        if not (one.done or other.done):
            together = one.index, other.index
            shared.append(together)
        found = _match(one, other, tolerance)
        if found is not None and one.step is not None and other.step is not None:
            if lines is None or found.deviation > largest:
                largest, lines = found.deviation, (one.step.line, other.step.line)
            one.go(found.old)
            other.go(found.new)
        elif short := _negligible(one, other, tolerance):
            for cursor in short:
                cursor.go(1.0)
        else:
            first, second = index.nearest(one, other)
            detours.append(Detour(range(together[0], first), range(together[1], second)))
            one, other = _Cursor(old, first), _Cursor(new, second)
    return Alignment(tuple(detours), (*shared, (len(old), len(new))), largest, lines)


class _Starts:
    """The steps of NEW by where they begin."""

    def __init__(self, old: Sequence[Step], new: Sequence[Step], tolerance: float) -> None:
        self.old, self.new, self.tolerance = old, new, tolerance

    @cached_property
    def _sorted(self) -> list[tuple[float, int]]:
        return sorted((_along(step), place) for place, step in enumerate(self.new))

    def _beginning_with(self, step: Step) -> list[int]:
        """The steps of NEW that may begin where a step of OLD does, in their order."""
        at, reach = _along(step), self.tolerance * hypot(*_ALONG)
        low, high = bisect_left(self._sorted, (at - reach, -1)), bisect_right(self._sorted, (at + reach, len(self.new)))
        return sorted(place for _, place in self._sorted[low:high])

    def nearest(self, one: _Cursor, other: _Cursor) -> tuple[int, int]:
        """The first steps from which both are the same again, with the fewest steps before them; else both ends."""
        found, least = (len(self.old), len(self.new)), inf
        for first in range(one.index + (one.done > 0), len(self.old)):
            skipped = first - one.index
            if skipped >= least:
                break
            candidates = self._beginning_with(self.old[first])
            for second in candidates[bisect_left(candidates, other.index + (other.done > 0)) :]:
                if skipped + second - other.index >= least:
                    break
                if _match(_Cursor(self.old, first), _Cursor(self.new, second), self.tolerance) is not None:
                    found, least = (first, second), skipped + second - other.index
                    break
        return found


def _along(step: Step) -> float:
    """The start of a step along one direction; infinite for what is not followed."""
    if isinstance(step, Unfollowed):
        return inf
    return sum((at or 0.0) * way for at, way in zip(step.start, _ALONG, strict=False))


def _negligible(one: _Cursor, other: _Cursor, tolerance: float) -> list[_Cursor]:
    """The elements that need not be in the other path: what is left of them is too short to tell, and leads to where
    the other path is."""
    found = []
    for cursor, beside in ((one, other.place()), (other, one.place())):
        step = cursor.step
        if isinstance(step, Travel) and step.is_bounded and step.motion is not Motion.PRESET and beside is not None:
            is_short = step.length(cursor.done) <= tolerance
            if is_short and max(distance(step.end, beside), distance(step.at(cursor.done), beside)) <= tolerance:
                found.append(cursor)
    return found


def _match(one: _Cursor, other: _Cursor, tolerance: float) -> _Match | None:
    """The parts of two elements that are the same from here on; None if they have none."""
    old, new = one.step, other.step
    if not (isinstance(old, Travel) and isinstance(new, Travel)):
        is_same = isinstance(old, Unfollowed) and isinstance(new, Unfollowed) and old.words == new.words
        return _Match(1, 1, 0) if is_same else None
    begin = distance(old.at(one.done), new.at(other.done))
    if begin > tolerance or unlike(old, new):
        return None
    is_whole = not (old.is_divisible and new.is_divisible)
    if distance(old.end, new.end) <= tolerance:
        # The whole of both comes first: what is left of one of them would be shorter than the tolerance.
        ways = (one.done, 1.0), (other.done, 1.0)
        off = max(begin, distance(old.end, new.end)) if is_whole else deviation(old, new, ways)
        if off <= tolerance:
            return _Match(1, 1, off)
    found = [] if is_whole else list(_parts(one, other, old, new))
    best = min(found, key=lambda each: each.deviation, default=None)
    return best if best is not None and best.deviation <= tolerance else None


def _parts(one: _Cursor, other: _Cursor, old: Travel, new: Travel) -> Iterator[_Match]:
    """One element up to its end, and of the other what lies beside it."""
    for first, second in ((1.0, new.fraction(old.end)), (old.fraction(new.end), 1.0)):
        if one.done < first <= 1 and other.done < second <= 1:
            yield _Match(first, second, deviation(old, new, ((one.done, first), (other.done, second))))


def unlike(old: Travel, new: Travel) -> str:
    """In what two elements are of another kind; empty if in nothing."""
    if old.motion is not new.motion:
        return f"OLD is a {old.motion.value}, NEW is a {new.motion.value}"
    if old.free != new.free:
        return f"where it is on {' and '.join(sorted({*old.free} ^ {*new.free}))} is known in one program only"
    if old.is_skippable != new.is_skippable:
        return f"only {'OLD' if old.is_skippable else 'NEW'} can be skipped with /"
    if old.compensation != new.compensation:
        return f"OLD is compensated by G{old.compensation}, NEW by G{new.compensation}"
    if (old.bend is None) != (new.bend is None):
        return f"OLD is {_shape(old)}, NEW is {_shape(new)}"
    if old.bend and new.bend:
        if old.bend.axes != new.bend.axes:
            return "the arcs lie in different planes"
        if (old.bend.sweep > 0) != (new.bend.sweep > 0):
            return "the arcs turn in opposite directions"
    planes = old.plane, new.plane
    if old.motion is not Motion.RAPID and planes[0] and planes[1] and {*planes[0].axes} != {*planes[1].axes}:
        return f"OLD is in the plane {planes[0].code}, NEW in {planes[1].code}"
    return ""


def _shape(travel: Travel) -> str:
    return "a line" if travel.bend is None else "an arc"


# Pairs of a detour ------------------------------------------------------------------------------------------

Pair = tuple[int | None, int | None]
"""A step of OLD and the one of NEW in its place; None where the other path has none."""


def pair_up(
    old: Sequence[Step], new: Sequence[Step], detour: Detour, said: Callable[[int, int], bool]
) -> Iterator[Pair]:
    """The steps of a detour in pairs with the least change in all, in order; `said` tells whether the blocks of two
    steps say the same of the path. What says the same at both ends is not weighed."""
    first, second = detour.old, detour.new
    before = next((n for n, pair in enumerate(zip(first, second, strict=False)) if not said(*pair)), None)
    if before is None:
        before = min(len(first), len(second))
    rest = zip(first[before:][::-1], second[before:][::-1], strict=False)
    ends = [*takewhile(lambda pair: said(*pair), rest)]
    yield from zip(first[:before], second[:before], strict=True)
    middle = (each[before : len(each) - len(ends)] for each in (first, second))
    yield from _weigh(old, new, Detour(*middle), said)
    yield from reversed(ends)


def _weigh(
    old: Sequence[Step], new: Sequence[Step], detour: Detour, said: Callable[[int, int], bool]
) -> Iterator[Pair]:
    rows, columns = len(detour.old), len(detour.new)
    width = max(_BAND, abs(rows - columns) + _BAND)
    if rows * min(columns, 2 * width) > _WIDEST:
        width = max(columns // rows + 1, _WIDEST // (2 * rows))
    costs = {(0, 0): 0.0}
    ways = dict[tuple[int, int], tuple[int, int]]()
    for row in range(rows + 1):
        middle = row * columns // max(rows, 1)
        for column in range(max(0, middle - width), min(columns, middle + width) + 1):
            best = (inf, (0, 0))
            if row and column and (row - 1, column - 1) in costs:
                first, second = detour.old[row - 1], detour.new[column - 1]
                change = _change(old[first], new[second], is_said=said(first, second))
                best = costs[row - 1, column - 1] + change, (1, 1)
            for step in ((1, 0), (0, 1)):
                alone = costs.get((row - step[0], column - step[1]), inf) + _GAP
                best = (alone, step) if alone < best[0] else best
            if row or column:
                costs[row, column], ways[row, column] = best
    pairs, at = list[Pair](), (rows, columns)
    while at != (0, 0):
        down, right = ways[at]
        at = at[0] - down, at[1] - right
        pairs.append((detour.old[at[0]] if down else None, detour.new[at[1]] if right else None))
    return reversed(pairs)


def _change(old: Step, new: Step, *, is_said: bool) -> float:
    """The amount of change from one step to another, from 0 to more than two gaps."""
    if not (isinstance(old, Travel) and isinstance(new, Travel)):
        return (0.0 if is_said else _GAP) if type(old) is type(new) else 3 * _GAP
    apart, long = distance(old.end, new.end), max(old.length(), new.length())
    far = 1.0 if inf in (apart, long) or not apart else apart / (apart + long)
    return (0.0 if is_said else 0.5) + (0.5 if unlike(old, new) else 0.0) + (0.8 * far if apart else 0.0)
