"""All solutions for whole boxes of values at once: the search of a single solve, on ground that is a range.

What the search proves there holds for every row whose values lie in the box: so many solutions, each alone in a box of
its own and on the same side for all of them. A box in which something remains undecided is divided.
"""

from collections.abc import Iterator, Mapping, Sequence
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
from contoursolve.solving.enumerate import DRAWING, Effort, Enumeration, Found, enumerate_many
from contoursolve.solving.ground import BALLS, Ground, ground_of

BOX, SMALL_BOX = Effort(4_000, 1_500), Effort(0, 0)
"""For a box of values before it is divided; what has a closed form for one row needs a smaller box, not a search."""

ROW = replace(DRAWING, is_guessing=False)
"""For one row; a row for which it does not suffice is solved by itself."""

FEW, FEW_SEARCHED = 2, 64
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
class Place:
    """Where a solution lies, alone: the bounds of every unknown, and the sides at which elements touch."""

    bounds: Mapping[str, tuple[float, float]]
    signs: Mapping[str, int]


@dataclass(frozen=True, slots=True, eq=False)
class Cell:
    """Rows with the same solutions, each proven to be alone in its box; None where a single solve must decide.

    `is_chosen` tells of each whether it lies on the sides that the words choose, `is_lost` that there is none because
    a search found none.
    """

    rows: Rows
    solutions: tuple[Place, ...] | None
    is_chosen: tuple[bool, ...] = ()
    is_lost: bool = False


def cells_of(kind: Kind, groups: tuple[Group, ...], values: Mapping[str, Array]) -> Iterator[Cell]:
    """The rows in cells, in an order that follows from the values alone."""
    words = sorted({word for word, _ in kind.free.values()} | {word for word, _, _ in kind.moves.values()})
    columns = numpy.array([values[word] for word in words])
    spread = numpy.ptp(columns, axis=1)
    spread[spread == 0] = 1.0
    first = dict(zip(words, columns[:, 0].tolist(), strict=True))
    is_searched = _is_searched(kind, groups, first)
    few = FEW_SEARCHED if is_searched else FEW
    pending, apart = [numpy.arange(columns.shape[1])], list[Rows]()
    while pending:
        rows = pending.pop()
        own = columns[:, rows]
        low, high = own.min(axis=1), own.max(axis=1)
        cell = Cell(rows, None)
        if rows.size > few:
            ends = [dict(zip(words, each.tolist(), strict=True)) for each in (low, high)]
            cell = _solve(kind, groups, rows, *ends, is_searched=is_searched)
        if cell.solutions is not None:
            yield cell
        elif rows.size <= few or (high == low).all():
            apart.append(rows)
        else:
            widest = int(((high - low) / spread).argmax())
            order = numpy.sort(own[widest])
            middle = order[order.size // 2] if order[order.size // 2] > order[0] else order[order > order[0]][0]
            is_low = own[widest] < middle
            pending += [rows[~is_low], rows[is_low]]
    if apart:
        rows = numpy.concatenate(apart)
        yield from _solve_each(
            kind, groups, rows, [dict(zip(words, each, strict=True)) for each in columns[:, rows].T.tolist()]
        )


def _solve_each(kind: Kind, groups: tuple[Group, ...], rows: Rows, values: Sequence[Mapping[str, float]]) -> list[Cell]:
    """A cell for each row; all rows are searched together."""
    with ball.precision(ball.WORKING):
        grounds = [ground_of(kind.at(each)) for each in values]
        enumerations = enumerate_many(grounds, kind.system, groups, Close.REFUSE, ROW)
        return [
            _cell(kind, row, ground, each) if isinstance(each, Enumeration) else Cell(row, None)
            for row, ground, each in zip(rows[:, None], grounds, enumerations, strict=True)
        ]


def _is_searched(kind: Kind, groups: tuple[Group, ...], values: Mapping[str, float]) -> bool:
    """Whether the row of these values has a step without a closed form, or cannot be told to have none."""
    with ball.precision(ball.WORKING):
        (found,) = enumerate_many([ground_of(kind.at(values))], kind.system, groups, Close.DOUBLE, BOX)
        return not isinstance(found, Enumeration) or found.is_searched


def _solve(
    kind: Kind,
    groups: tuple[Group, ...],
    rows: Rows,
    low: Mapping[str, float],
    high: Mapping[str, float],
    *,
    is_searched: bool,
) -> Cell:
    with ball.precision(ball.WORKING):
        box = _box(kind, low, high)
        effort = BOX if is_searched else SMALL_BOX
        (found,) = enumerate_many([box], kind.system, groups, Close.REFUSE, effort)
        if not isinstance(found, Enumeration):
            return Cell(rows, None)
        if found.is_searched and not all(_is_near(each, box, kind.system) for each in found.found):
            return Cell(rows, None)
        return _cell(kind, rows, box, found)


def _cell(kind: Kind, rows: Rows, ground: Ground, enumeration: Enumeration) -> Cell:
    """The cell of rows for all of which a search on a ground holds."""
    choices = kind.profile.choices
    points = {choice.point for choice in choices}
    if not enumeration.is_complete or any(each.doubles for each in enumeration.found):
        return Cell(rows, None)
    try:
        sides = [
            sides_of(kind.system, ground.values(each.scalars, each.signs, kind.system), points)
            for each in enumeration.found
        ]
    except (ArithmeticError, ValueError):
        return Cell(rows, None)
    if any(each.get(point) == BOTH for each in sides for point in points):
        return Cell(rows, None)
    items: list[Place] = []
    is_chosen: list[bool] = []
    for each, own in zip(enumeration.found, sides, strict=True):
        fits = {choice: own.get(choice.point) in (choice.side.value, None) for choice in choices}
        # What the form chooses by itself is no alternative.
        if all(fits[choice] for choice in choices if not choice.given):
            bounds = {name: ball.bounds(value) for name, value in each.scalars.items()}
            items.append(Place(bounds, each.signs))
            is_chosen.append(all(fits.values()))
    return Cell(rows, tuple(items), tuple(is_chosen), enumeration.is_lost)


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
