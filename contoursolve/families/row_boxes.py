"""Boxes that hold one solution each, for whole ranges of values at once.

The search of a single solve runs on inputs that are ranges. What it proves there holds for every row whose values lie
in it: so many solutions, each alone in a box of its own and on the same side for all of them. A range in which
something remains undecided is divided.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.families.case_classes import CaseClass
from contoursolve.families.spec import Places
from contoursolve.geometry import FIRST, SECOND, System, Unit, Values, scalar
from contoursolve.numeric import COSINE, Array, Number, ball
from contoursolve.solving import (
    BALLS,
    BOTH,
    DRAWING,
    Close,
    Effort,
    Enumeration,
    Ground,
    enumerate_many,
    ground_of,
    groups_of,
    sides_of,
)

BOX, SMALL_BOX = Effort(4_000, 1_500), Effort(0, 0)
"""For a box of values before it is divided; what has a closed form for one row needs a smaller box, not a search."""

ROW = replace(DRAWING, is_guessing=False)
"""For one row; a row for which it does not suffice is solved by itself."""

FEW, FEW_SEARCHED = 2, 64
"""Rows that are solved one by one sooner than in a box; and where a step has no closed form, so that a box of values
costs several times as much as one row if it remains undecided."""


def _vanishes(value: Number) -> bool:
    sign = ball.sign(value)
    if sign is None:
        raise ArithmeticError("for some rows it may be zero, for others not")
    return sign == 0


BOXES = replace(BALLS, vanishes=_vanishes)
"""The functions of balls that stand for a whole box."""


@dataclass(frozen=True, slots=True)
class BoxGround(Ground):
    """The ground for all rows of a box. `nearest` is the ground for the value of each that is nearest to zero."""

    directions: Mapping[str, tuple[Number, Number]]
    lowest: Ground
    highest: Ground
    nearest: Ground

    def values(self, scalars: Mapping[str, Number], signs: Mapping[str, int], system: System) -> Values:
        return Values({**self.scalars, **scalars}, self.amounts, self.directions, system.headed, signs, BOXES)

    def nearby(self, system: System) -> float:
        return max(self.lowest.nearby(system), self.highest.nearby(system))

    def reach(self, system: System, far: float) -> dict[str, tuple[float, float]]:
        ranges = self.lowest.reach(system, far), self.highest.reach(system, far)
        return {name: (min(r[name][0] for r in ranges), max(r[name][1] for r in ranges)) for name in ranges[0]}

    def number(self, name: str, scalars: Mapping[str, Number], signs: Mapping[str, int]) -> Number:
        given, _, part = name.rpartition(":")
        if given in self.directions and name not in scalars:
            return self.directions[given][0 if f":{part}" == COSINE else 1]
        # A frozen class with slots is made anew, which `super` alone does not know.
        return Ground.number(self, name, scalars, signs)


class SolutionBox(Struct, frozen=True, eq=False):
    """Where a solution lies, alone: the bounds of every unknown, and the sides at which elements touch; and whether it
    lies on the sides that the words choose."""

    bounds: Mapping[str, tuple[float, float]]
    signs: Mapping[str, int]
    is_chosen: bool


class Cell(Struct, frozen=True, eq=False):
    """Rows with the same solutions, each proven to be alone in its box; None where a single solve must decide.
    `is_lost` tells that there is none because a search found none."""

    rows: Places
    solutions: tuple[SolutionBox, ...] | None = None
    is_lost: bool = False


def _box(case: CaseClass, low: Mapping[str, float], high: Mapping[str, float]) -> BoxGround:
    """The ground of all rows whose words lie between two values."""
    ends = case.at(low), case.at(high)
    closest = case.at({word: min(max(0.0, low[word]), high[word]) for word in low})
    lowest, highest, nearest = (ground_of(profile) for profile in (*ends, closest))
    amounts, directions = {}, {}
    for name, given in ends[0].givens.items():
        one, other = sorted((given.value, ends[1].givens[name].value))
        if given.unit is Unit.DEGREE:
            directions[name] = ball.directions(one, other)
        else:
            amounts[name] = ball.hull(one, other)
    starts = zip((FIRST, SECOND), ends[0].start.values, ends[1].start.values, strict=True)
    scalars = {
        scalar(case.profile.figure.start, axis): ball.hull(*sorted((one, other)))
        for axis, one, other in starts
        if one is not None and other is not None
    }
    return BoxGround(scalars, amounts, lowest.angles, lowest.travel, directions, lowest, highest, nearest)


class RowBoxes:
    """The search for all solutions of the rows of a class."""

    def __init__(self, case: CaseClass) -> None:
        self.case, self.system = case, case.system
        self.groups = groups_of(self.system)

    def cells(self, values: Mapping[str, Array]) -> Iterator[Cell]:
        """The rows in cells, in an order that follows from the values alone."""
        case = self.case
        words = sorted({each.word for each in (*case.free.values(), *case.moves.values())})
        columns = numpy.array([values[word] for word in words])
        spread = numpy.ptp(columns, axis=1)
        spread[spread == 0] = 1.0

        def named(column: Array) -> dict[str, float]:
            return dict(zip(words, column.tolist(), strict=True))

        is_searched = self._is_searched(named(columns[:, 0]))
        few = FEW_SEARCHED if is_searched else FEW
        pending, apart = [numpy.arange(columns.shape[1])], list[Places]()
        while pending:
            rows = pending.pop()
            own = columns[:, rows]
            low, high = own.min(axis=1), own.max(axis=1)
            cell = Cell(rows)
            if rows.size > few:
                cell = self._solve_box(rows, named(low), named(high), BOX if is_searched else SMALL_BOX)
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
            yield from self._solve_each(rows, [named(each) for each in columns[:, rows].T])

    def _solve_each(self, rows: Places, values: Sequence[Mapping[str, float]]) -> list[Cell]:
        """A cell for each row; all rows are searched together."""
        with ball.precision(ball.WORKING):
            grounds = [ground_of(self.case.at(each)) for each in values]
            enumerations = enumerate_many(grounds, self.system, self.groups, Close.REFUSE, ROW)
            return [
                self._cell(row, ground, each) if isinstance(each, Enumeration) else Cell(row)
                for row, ground, each in zip(rows[:, None], grounds, enumerations, strict=True)
            ]

    def _is_searched(self, values: Mapping[str, float]) -> bool:
        """Whether the row of these values has a step without a closed form, or cannot be told to have none."""
        with ball.precision(ball.WORKING):
            ground = ground_of(self.case.at(values))
            (found,) = enumerate_many([ground], self.system, self.groups, Close.DOUBLE, BOX)
            return not isinstance(found, Enumeration) or found.within is not None

    def _solve_box(self, rows: Places, low: Mapping[str, float], high: Mapping[str, float], effort: Effort) -> Cell:
        """The cell of all rows whose words lie between two values."""
        with ball.precision(ball.WORKING):
            box = _box(self.case, low, high)
            (found,) = enumerate_many([box], self.system, self.groups, Close.REFUSE, effort)
            if not isinstance(found, Enumeration):
                return Cell(rows)
            if found.within is not None:
                # The search of a single row reaches so far.
                reach = box.nearest.reach(self.system, box.nearest.farthest(self.system))
                places = [(reach[name], ball.bounds(at)) for each in found.found for name, at in each.scalars.items()]
                if not all(outer[0] <= inner[0] and inner[1] <= outer[1] for outer, inner in places):
                    return Cell(rows)
            return self._cell(rows, box, found)

    def _cell(self, rows: Places, ground: Ground, enumeration: Enumeration) -> Cell:
        """The cell of rows for all of which a search on a ground holds."""
        choices = self.case.profile.choices
        points = {choice.point for choice in choices}
        if not enumeration.is_complete or any(each.doubles for each in enumeration.found):
            return Cell(rows)
        items: list[SolutionBox] = []
        for each in enumeration.found:
            try:
                sides = sides_of(self.system, ground.values(each.scalars, each.signs, self.system), points)
            except (ArithmeticError, ValueError):
                return Cell(rows)
            if any(sides.get(point) == BOTH for point in points):
                return Cell(rows)
            fits = {choice: sides.get(choice.point) in (choice.side.value, None) for choice in choices}
            # What the form chooses by itself is no alternative.
            if all(fits[choice] for choice in choices if not choice.given):
                bounds = {name: ball.bounds(value) for name, value in each.scalars.items()}
                items.append(SolutionBox(bounds, each.signs, all(fits.values())))
        return Cell(rows, tuple(items), enumeration.is_lost)
