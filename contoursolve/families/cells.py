"""All solutions for whole boxes of values at once: the search of a single solve, on ground that is a range.

What the search proves there holds for every row whose values lie in the box: so many solutions, each alone in a box of
its own and on the same side for all of them. A box in which something remains undecided is divided.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy
from numpy.typing import NDArray

from contoursolve.analysis import Group
from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.backends.columns import Array
from contoursolve.backends.inputs import COSINE
from contoursolve.constraints import System, Values
from contoursolve.families.kinds import Kind
from contoursolve.model import FIRST, SECOND, Profile, Unit, scalar
from contoursolve.solving.alternatives import BOTH, sides_of
from contoursolve.solving.elimination import Close
from contoursolve.solving.enumerate import Found, enumerate_on
from contoursolve.solving.ground import BALLS, Ground, ground_of

BUDGET, LEAST = 4_000, 1_500
"""How many intervals are looked at for one box, and for each step of it, before it is divided."""

FEW, FEW_SEARCHED = 2, 16
"""Rows that are solved one by one sooner than in a box; and where a step has no closed form, so that a box of values
costs several times as much as one row if it remains undecided."""

Rows = NDArray[numpy.int64]


def _vanishes(value: Number) -> bool:
    sign = ball.sign(value)
    if sign is None:
        raise ArithmeticError("for some rows it may be zero, for others not")
    return sign == 0


BOXES = replace(BALLS, vanishes=_vanishes)
"""The functions of balls that stand for a whole box."""


@dataclass(frozen=True, slots=True)
class Box(Ground):
    """The ground for all rows of a box. `nearest` is the ground for the value of each that is nearest to zero."""

    directions: Mapping[str, tuple[Number, Number]]
    lowest: Ground
    highest: Ground
    nearest: Ground

    def values(self, scalars: Mapping[str, Number], signs: Mapping[str, int], system: System) -> Values:
        return Values({**self.scalars, **scalars}, self.amounts, self.directions, system.headed, signs, BOXES)

    def reach(self, system: System) -> dict[str, tuple[float, float]]:
        ranges = self.lowest.reach(system), self.highest.reach(system)
        return {name: (min(r[name][0] for r in ranges), max(r[name][1] for r in ranges)) for name in ranges[0]}

    def number(self, name: str, scalars: Mapping[str, Number], signs: Mapping[str, int]) -> Number:
        given, _, part = name.rpartition(":")
        if given in self.directions and name not in scalars:
            return self.directions[given][0 if f":{part}" == COSINE else 1]
        # A frozen class with slots is made anew, which `super` alone does not know.
        return Ground.number(self, name, scalars, signs)


@dataclass(frozen=True, slots=True, eq=False)
class Cell:
    """Rows with the same solutions, each proven to be alone in its box; None where a single solve must decide.

    `is_chosen` tells of each whether it lies on the sides that the words choose.
    """

    rows: Rows
    solutions: tuple[Found, ...] | None
    is_chosen: tuple[bool, ...] = ()


def cells_of(kind: Kind, groups: tuple[Group, ...], values: Mapping[str, Array]) -> Iterator[Cell]:
    """The rows in cells, in an order that follows from the values alone."""
    words = sorted({word for word, _ in kind.free.values()} | {word for word, _, _ in kind.moves.values()})
    columns = numpy.array([values[word] for word in words])
    spread = numpy.ptp(columns, axis=1)
    spread[spread == 0] = 1.0
    first = dict(zip(words, columns[:, 0].tolist(), strict=True))
    is_searched = _is_searched(kind, groups, first)
    few = FEW_SEARCHED if is_searched else FEW
    pending = [numpy.arange(columns.shape[1])]
    while pending:
        rows = pending.pop()
        own = columns[:, rows]
        low, high = own.min(axis=1), own.max(axis=1)
        cell = Cell(rows, None)
        if rows.size > few:
            ends = [dict(zip(words, each.tolist(), strict=True)) for each in (low, high)]
            cell = _solve(kind, groups, rows, *ends, is_searched=is_searched)
        if cell.solutions is not None or rows.size <= few or (high == low).all():
            yield cell
            continue
        widest = int(((high - low) / spread).argmax())
        order = numpy.sort(own[widest])
        middle = order[order.size // 2] if order[order.size // 2] > order[0] else order[order > order[0]][0]
        is_low = own[widest] < middle
        pending += [rows[~is_low], rows[is_low]]


def _is_searched(kind: Kind, groups: tuple[Group, ...], values: Mapping[str, float]) -> bool:
    """Whether the row of these values has a step without a closed form."""
    with ball.precision(ball.WORKING):
        return enumerate_on(ground_of(kind.at(values)), kind.system, groups, Close.DOUBLE, BUDGET, LEAST).is_searched


def _solve(
    kind: Kind,
    groups: tuple[Group, ...],
    rows: Rows,
    low: Mapping[str, float],
    high: Mapping[str, float],
    *,
    is_searched: bool,
) -> Cell:
    system, undecided = kind.system, Cell(rows, None)
    with ball.precision(ball.WORKING):
        box = _box(kind, low, high)
        try:
            # What has a closed form for one row needs a smaller box, not a search.
            limits = (BUDGET, LEAST) if is_searched else (0, 0)
            enumeration = enumerate_on(box, system, groups, Close.REFUSE, *limits)
            if not enumeration.is_complete or any(each.doubles for each in enumeration.found):
                return undecided
            if enumeration.is_searched and not all(_is_near(each, box, system) for each in enumeration.found):
                return undecided
            choices = kind.profile.choices
            sides = [
                sides_of(system, box.values(each.scalars, each.signs, system), {choice.point for choice in choices})
                for each in enumeration.found
            ]
        except (ArithmeticError, ValueError):
            return undecided
    if any(each.get(choice.point) == BOTH for each in sides for choice in choices):
        return undecided
    items: list[Found] = []
    is_chosen: list[bool] = []
    for each, own in zip(enumeration.found, sides, strict=True):
        fits = {choice: own.get(choice.point) in (choice.side.value, None) for choice in choices}
        # What the form chooses by itself is no alternative.
        if all(fits[choice] for choice in choices if not choice.given):
            items.append(each)
            is_chosen.append(all(fits.values()))
    return Cell(rows, tuple(items), tuple(is_chosen))


def _is_near(found: Found, box: Box, system: System) -> bool:
    """Whether a solution lies within the reach of the search of every single row."""
    reach = box.nearest.reach(system)
    bounds = {name: ball.bounds(value) for name, value in found.scalars.items()}
    return all(reach[name][0] <= low and high <= reach[name][1] for name, (low, high) in bounds.items())


def _box(kind: Kind, low: Mapping[str, float], high: Mapping[str, float]) -> Box:
    """The ground of all rows whose words lie between two values."""
    ends = kind.at(low), kind.at(high)
    lowest, highest, nearest = (ground_of(profile) for profile in (*ends, _nearest(kind, low, high)))
    amounts, directions = {}, {}
    for name, given in ends[0].givens.items():
        one, other = sorted((given.value, ends[1].givens[name].value))
        if given.unit is Unit.DEGREE:
            directions[name] = ball.directions(one, other)
        else:
            amounts[name] = ball.hull(one, other)
    starts = zip((FIRST, SECOND), ends[0].start.values, ends[1].start.values, strict=True)
    scalars = {
        scalar(kind.profile.figure.start, axis): ball.hull(*sorted((one, other)))
        for axis, one, other in starts
        if one is not None and other is not None
    }
    return Box(scalars, amounts, lowest.angles, directions, lowest, highest, nearest)


def _nearest(kind: Kind, low: Mapping[str, float], high: Mapping[str, float]) -> Profile:
    """The profile with the values that are nearest to zero."""
    return kind.at({word: min(max(0.0, low[word]), high[word]) for word in low})
