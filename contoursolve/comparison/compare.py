"""Compares two paths from their starts: each element, or the part of it that the other path has in one piece."""

from collections.abc import Iterator, Sequence
from math import inf

from msgspec import Struct

from contoursolve.comparison.follow import ToolPath
from contoursolve.comparison.travel import Motion, Place, Step, Travel, Unfollowed, deviation, distance


class Difference(Struct, frozen=True):
    """The first place where two paths are not the same, and how far apart, mm; None where that is no distance.

    `old` or `new` is None where that path has ended.
    """

    reason: str
    old: Step | None
    new: Step | None
    distance: float | None


class Comparison(Struct, frozen=True):
    """Two paths that are the same to within `deviation` mm, at most at these lines, up to the difference if any."""

    old: ToolPath
    new: ToolPath
    tolerance: float
    difference: Difference | None
    deviation: float
    lines: tuple[int, int] | None
    """The lines of OLD and of NEW where the deviation is largest."""

    @property
    def is_equal(self) -> bool:
        """Whether there is no difference."""
        return self.difference is None


class _Match(Struct, frozen=True):
    """Up to which fraction of its way each element was found to be the same, and how far apart they are, mm."""

    old: float
    new: float
    deviation: float


class _Mismatch(Struct, frozen=True):
    reason: str
    distance: float | None = None


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


def compare(old: ToolPath, new: ToolPath, tolerance: float) -> Comparison:
    """Follow both paths as far as they are the same to within a tolerance, mm.

    It makes no difference into how many collinear lines or arcs of one circle a cut is divided.
    """
    one, other = _Cursor(old.steps), _Cursor(new.steps)
    largest, lines = 0.0, None
    while one.step is not None and other.step is not None:
        found = _match(one, other, tolerance)
        if isinstance(found, _Mismatch):
            short = _negligible(one, other, tolerance)
            if not short:
                difference = _blame(one, other, found)
                return Comparison(old, new, tolerance, difference, largest, lines)
            for cursor in short:
                cursor.go(1.0)
            continue
        if lines is None or found.deviation > largest:
            largest, lines = found.deviation, (one.step.line, other.step.line)
        one.go(found.old)
        other.go(found.new)
    while short := _negligible(one, other, tolerance):
        for cursor in short:
            cursor.go(1.0)
    if one.step is None and other.step is None:
        return Comparison(old, new, tolerance, None, largest, lines)
    difference = _blame(one, other, _Mismatch(f"{'OLD' if other.step is None else 'NEW'} goes on"))
    return Comparison(old, new, tolerance, difference, largest, lines)


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


def _match(one: _Cursor, other: _Cursor, tolerance: float) -> _Match | _Mismatch:
    old, new = one.step, other.step
    if not (isinstance(old, Travel) and isinstance(new, Travel)):
        if not (isinstance(old, Unfollowed) and isinstance(new, Unfollowed)):
            return _Mismatch(
                f"only {'OLD' if isinstance(old, Unfollowed) else 'NEW'} has a block that diff does not follow"
            )
        return (
            _Match(1, 1, 0)
            if old.words == new.words
            else _Mismatch("blocks that diff does not follow are not the same")
        )
    reason = _unlike(old, new)
    if reason:
        return _Mismatch(reason)
    begin = distance(old.at(one.done), new.at(other.done))
    if begin > tolerance:
        return _Mismatch("they start apart" if begin < inf else "an axis is known in one program only", begin)
    apart = distance(old.end, new.end)
    is_whole = not (old.is_divisible and new.is_divisible)
    if apart <= tolerance:
        # The whole of both comes first: what is left of one of them would be shorter than the tolerance.
        off = max(begin, apart) if is_whole else deviation(old, new, ((one.done, 1.0), (other.done, 1.0)))
        if off <= tolerance:
            return _Match(1, 1, off)
    found = [] if is_whole else list(_parts(one, other, old, new))
    best = min(found, key=lambda each: each.deviation, default=None)
    if best is not None and best.deviation <= tolerance:
        return best
    if apart == inf:
        return _Mismatch("an axis is known in one program only", apart)
    if apart <= tolerance:
        off = deviation(old, new, ((one.done, 1.0), (other.done, 1.0)))
        return _Mismatch("they end at the same point, and run apart between", off)
    return _Mismatch("they end apart", apart)


def _parts(one: _Cursor, other: _Cursor, old: Travel, new: Travel) -> Iterator[_Match]:
    """One element up to its end, and of the other what lies beside it."""
    for first, second in ((1.0, new.fraction(old.end)), (old.fraction(new.end), 1.0)):
        if one.done < first <= 1 and other.done < second <= 1:
            yield _Match(first, second, deviation(old, new, ((one.done, first), (other.done, second))))


def _unlike(old: Travel, new: Travel) -> str:
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
    return ""


def _shape(travel: Travel) -> str:
    return "a line" if travel.bend is None else "an arc"


def _blame(one: _Cursor, other: _Cursor, found: _Mismatch) -> Difference:
    """The elements that differ. Where one of them has begun before, its end may belong to the element before the
    other one: that whose end is nearer is named."""
    old, new = one.step, other.step
    for begun, fresh in ((one, other), (other, one)):
        step, before = begun.step, fresh.steps[fresh.index - 1] if fresh.index else None
        if not (begun.done and isinstance(step, Travel) and isinstance(before, Travel)):
            continue
        apart = distance(before.end, step.end)
        now = fresh.step
        if not isinstance(now, Travel) or apart < distance(now.end, step.end):
            pair = (step, before) if begun is one else (before, step)
            return Difference("they end apart", *pair, apart)
    return Difference(found.reason, old, new, found.distance)
