"""The differences in one detour of two paths: their moves, the words that make them, and how large they are."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache
from math import inf, isfinite

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison.align import Detour, Pair, pair_up, unlike
from contoursolve.comparison.follow import ToolPath
from contoursolve.comparison.travel import Place, Step, Travel, Unfollowed, deviation, distance
from contoursolve.comparison.words import Change, Quote, changes_between, path_words

_LATER = 0.5
"""The fraction of an arc from which on where it begins is no matter."""
_NEAR = 60
"""Elements of the other path beside which an element without a partner is looked for."""


class Difference(Struct, frozen=True):
    """Moves in a row that are not the same in two programs, and the words that make them so.

    `old` and `new` are the moves with which it begins, one of them None where only one program has a move. `distance`
    is how far apart the paths are there at most, mm: ends of moves from the ends in their place, and what is between
    from what is between; None where it is no distance. The first and the last line are those of all moves.
    """

    reason: str
    old: Step | None
    new: Step | None
    distance: float | None
    changes: tuple[Change, ...]
    old_lines: tuple[int, int] | None
    new_lines: tuple[int, int] | None
    farthest: tuple[Step | None, Step | None]
    """The moves of OLD and of NEW that are so far apart."""
    steps: tuple[tuple[Step, ...], tuple[Step, ...]]
    """All its moves in OLD and in NEW."""


class _Found(Struct, frozen=True):
    """A pair of steps that are not the same."""

    pair: Pair
    reason: str
    distance: float | None
    changes: tuple[Change, ...]
    begins: bool
    """A difference may begin here: a word changes, and where the path leads with it."""


class DetourDifferences:
    """The differences in one detour; `modes` lists the codes that changed before steps of OLD."""

    def __init__(
        self,
        old: ToolPath,
        new: ToolPath,
        detour: Detour,
        tolerance: float,
        modes: Callable[[], Sequence[tuple[int, Change]]],
    ) -> None:
        self.old, self.new, self.detour, self.tolerance, self.modes = old, new, detour, tolerance, modes
        self.words = cache(self._words)
        self.keys = cache(lambda side, place: frozenset(each.key for each in self.words(side, place)))
        self.is_readable = old.control == new.control

    def differences(self) -> Iterator[Difference]:
        """The differences of the detour along the path."""
        pairs = [*pair_up(self.old.steps, self.new.steps, self.detour, self._say_the_same)]
        groups = list[list[_Found]]()
        for number in range(len(pairs)):
            found = self._found(pairs, number)
            if found is None:
                continue
            if not groups or self._begins(found, groups[-1]):
                groups.append([])
            groups[-1].append(found)
        for group in groups or [[_Found(pairs[0], "they are divided differently", None, (), begins=True)]]:
            yield self._difference(group)

    def _begins(self, found: _Found, group: Sequence[_Found]) -> bool:
        """Whether another difference begins with a pair: not by words that are told, with further moves that one
        program has, or in the way in which that before it is unlike, such as by compensation."""
        told = {change for each in group for change in each.changes}
        one, other = self._steps(found.pair)
        if not found.begins or (found.changes and told.issuperset(found.changes)):
            return False
        if isinstance(one, Travel) and isinstance(other, Travel):
            is_as_before = found.reason == group[-1].reason == unlike(one, other)
        else:
            is_as_before = None in found.pair and None in group[-1].pair
        # A word may move the end of the element before it in its contour.
        begun = self._steps(group[0].pair)[0]
        is_led_by_it = isinstance(begun, Travel) and begun.element and not any(each.begins for each in group)
        return not is_as_before and not is_led_by_it

    def _steps(self, pair: Pair) -> tuple[Step | None, Step | None]:
        first, second = pair
        return (
            self.old.steps[first] if first is not None else None,
            self.new.steps[second] if second is not None else None,
        )

    # Words ---------------------------------------------------------------------------------------------------

    def _words(self, side: int, place: int) -> tuple[Quote, ...]:
        """The words of the block of a step that say something of the path."""
        path = (self.old, self.new)[side]
        step = path.steps[place]
        if path.modes is None or step.number >= len(path.blocks):
            return ()
        return tuple(path_words(path.blocks[step.number], path.modes))

    def _say_the_same(self, first: int, second: int) -> bool:
        one, other = self.keys(0, first), self.keys(1, second)
        return bool(one) and one == other

    def _changes(self, pair: Pair, before: Pair | None) -> tuple[Change, ...]:
        """The words of two blocks that are not the same, with those of the blocks before them that move nothing."""
        if not self.is_readable:
            return ()
        sides = [
            [*self._between(side, at, before and before[side]), *(self.words(side, at) if at is not None else ())]
            for side, at in enumerate(pair)
        ]
        return tuple(changes_between(*sides))

    def _between(self, side: int, at: int | None, before: int | None) -> Iterator[Quote]:
        """The same of the blocks between two steps."""
        path = (self.old, self.new)[side]
        if at is None or path.modes is None:
            return
        last = at - 1 if before is None else before
        behind = path.steps[last].number + 1 if last >= 0 else 0
        for block in path.blocks[behind : path.steps[at].number]:
            yield from path_words(block, path.modes) if block.words else ()

    def _quoted(self, group: Sequence[_Found]) -> tuple[Change, ...]:
        """The words that make a difference: those that change in its blocks, or else the last code before them."""
        own = dict.fromkeys(change for each in group if None not in each.pair for change in _alike(each.changes))
        is_moved = all(isinstance(step, Travel) for each in group for step in self._steps(each.pair))
        if own or not self.is_readable or not is_moved or any(each.changes for each in group):
            return tuple(own)
        return tuple(change for place, change in self.modes() if place <= self.detour.old.start)[-1:]

    # Distances -----------------------------------------------------------------------------------------------

    def _found(self, pairs: Sequence[Pair], number: int) -> _Found | None:
        """The difference in a pair; None for two that are the same."""
        pair, before = pairs[number], pairs[number - 1] if number else None
        one, other = self._steps(pair)
        changes = self._changes(pair, before)
        if isinstance(one, Travel) and isinstance(other, Travel):
            found = self._between_travels(pairs, number, (one, other), is_changed=self._is_changed(changes))
            return found and replace(found, changes=changes)
        if one is not None and other is not None:
            is_same = isinstance(one, Unfollowed) and isinstance(other, Unfollowed) and one.words == other.words
            told = "blocks that diff does not follow are not the same"
            return None if is_same else _Found(pair, told, None, changes, begins=True)
        off = self._away(pairs, number)
        if off is not None and off <= self.tolerance:
            return None
        return _Found(pair, self._alone(pair), off, changes, begins=True)

    def _is_changed(self, changes: Sequence[Change]) -> bool:
        return bool(changes) or not self.is_readable or self.old.modes is None or self.new.modes is None

    def _between_travels(
        self, pairs: Sequence[Pair], number: int, travels: tuple[Travel, Travel], *, is_changed: bool
    ) -> _Found | None:
        """In what two moves are not the same, and how far they are apart."""
        one, other = travels
        kind, begin, end = unlike(one, other), distance(one.start, other.start), distance(one.end, other.end)
        if inf in (begin, end):
            known = max((each for each in (begin, end) if isfinite(each)), default=0.0)
            told = kind or "an axis is known in one program only"
            return _Found(pairs[number], told, known if known > self.tolerance else None, (), begins=is_changed)
        is_joined = not (number and None in pairs[number - 1])
        if is_joined:
            off = deviation(one, other, ((0.0, 1.0), (0.0, 1.0)))
        else:
            # Where they begin is no matter: the move before is in one program only.
            begin, ways = 0.0, [self._nearby(pairs, number, side) for side in (1, 0)]
            off = max(end, _away(one, ways[0]), _away(other, ways[1]))
        moved = max((abs(a - b) for a, b in zip(_step(one, other, 1), _step(one, other, 0), strict=True)), default=0.0)
        leads = bool(kind) or off > self.tolerance >= begin or min(moved, end) > self.tolerance
        begins = is_changed and leads
        if begins and number and is_joined and begin > self.tolerance:
            # How far apart they begin is told by the difference before.
            off = deviation(one, other, ((_LATER, 1.0), (_LATER, 1.0))) if one.bend and other.bend else end
        reasons = {
            kind: True,
            "they end apart": end > self.tolerance,
            "they start apart": begin > self.tolerance,
            "they end at the same point, and run apart between": off > self.tolerance,
        }
        reason = next((told for told, is_so in reasons.items() if told and is_so), "")
        if reason and one.unit is not other.unit:
            reason += f"; OLD is in {one.unit.value}, NEW in {other.unit.value}"
        return _Found(pairs[number], reason, off if off > self.tolerance else None, (), begins) if reason else None

    def _alone(self, pair: Pair) -> str:
        name = "OLD" if pair[1] is None else "NEW"
        step = next(each for each in self._steps(pair) if each is not None)
        if isinstance(step, Unfollowed):
            return f"only {name} has a block that diff does not follow"
        other, own = (self.new, self.detour.new) if name == "OLD" else (self.old, self.detour.old)
        return f"{name} goes on" if own.stop == own.start == len(other.steps) else f"only {name} has this move"

    def _away(self, pairs: Sequence[Pair], number: int) -> float | None:
        """The distance of a move that one program has from the path of the other, mm; None if that is not known."""
        side = 0 if pairs[number][0] is not None else 1
        step = self._steps(pairs[number])[side]
        if not isinstance(step, Travel):
            return None
        off = _away(step, self._nearby(pairs, number, 1 - side))
        return off if isfinite(off) else None

    def _nearby(self, pairs: Sequence[Pair], number: int, side: int) -> list[Travel | Place]:
        """The moves of one program beside a pair, and where the detour begins and ends there."""
        steps, span = (self.new.steps, self.detour.new) if side else (self.old.steps, self.detour.old)
        near = [each[side] for each in pairs[max(0, number - _NEAR) : number + _NEAR]]
        beside = [steps[at] for at in near if at is not None]
        first = steps[span.start - 1] if span.start else None
        behind = steps[span.stop] if span.stop < len(steps) else None
        places = (
            first.end if isinstance(first, Travel) else None,
            behind.start if isinstance(behind, Travel) else None,
        )
        return [*(each for each in beside if isinstance(each, Travel)), *(each for each in places if each)]

    # Groups --------------------------------------------------------------------------------------------------

    def _difference(self, group: Sequence[_Found]) -> Difference:
        root = next((each for each in group if each.begins), group[0])
        known = [each for each in group if each.distance is not None]
        worst = max(known, key=lambda each: each.distance or 0.0, default=root)
        if None in root.pair:
            pair = tuple(_first(each.pair[side] for each in group if None in each.pair) for side in (0, 1))
            old, new = self._steps((pair[0], pair[1]))
        else:
            old, new = self._steps(root.pair)
        both = [self._steps(each.pair) for each in group]
        steps = tuple(one for one, _ in both if one), tuple(other for _, other in both if other)
        return Difference(
            root.reason,
            old,
            new,
            worst.distance,
            self._quoted(group),
            _lines(steps[0]),
            _lines(steps[1]),
            self._steps(worst.pair),
            steps,
        )


def joined(differences: Iterable[Difference]) -> list[Difference]:
    """The differences along the path, those that the same words make as one: a line may run several times."""
    found = dict[object, Difference]()
    for place, each in enumerate(differences):
        key = each.changes or place
        one = found.get(key)
        if one is None:
            found[key] = each
            continue
        farthest = max((one, each), key=lambda this: this.distance or 0.0)
        steps = (*one.steps[0], *each.steps[0]), (*one.steps[1], *each.steps[1])
        lines = _lines(steps[0]), _lines(steps[1])
        told = {"steps": steps, "old_lines": lines[0], "new_lines": lines[1]}
        found[key] = replace(one, distance=farthest.distance, farthest=farthest.farthest, **told)
    return [*found.values()]


def _first(places: Iterable[int | None]) -> int | None:
    return next((each for each in places if each is not None), None)


def _lines(steps: Sequence[Step]) -> tuple[int, int] | None:
    lines = [step.line for step in steps]
    return (min(lines), max(lines)) if lines else None


def _alike(changes: Sequence[Change]) -> Sequence[Change]:
    """The changes of two blocks that have about the same words; none of blocks that are written in another way."""
    paired = sum(each.old is not None and each.new is not None for each in changes)
    return changes if len(changes) - paired <= max(1, paired) else ()


def _step(one: Travel, other: Travel, end: int) -> list[float]:
    """From a place on one move to the same on the other, by axes."""
    places = zip(one.at(end), other.at(end), strict=True)
    return [a - b if a is not None and b is not None else 0.0 for a, b in places]


def _away(step: Travel, ways: Sequence[Travel | Place]) -> float:
    """The largest distance of a move from some others, point by point, mm; infinite where there are none."""

    def nearest(at: Place) -> float:
        return min((each.away(at) if isinstance(each, Travel) else distance(each, at) for each in ways), default=inf)

    return max(nearest(step.at(part / step.samples)) for part in range(step.samples + 1))
