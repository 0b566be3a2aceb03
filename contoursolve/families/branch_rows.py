"""Rows of which each may have several solutions: boxes that hold one each, and Newton's method from there.

The boxes are found for whole ranges of values at once, by the search of a single solve on ground that is a range. What
it proves there holds for every row whose values lie in it: so many solutions, each alone in a box of its own and on the
same side for all of them. A range in which something remains undecided is divided.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy
from numpy.typing import NDArray

from contoursolve.analysis import Group, judge, order
from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.backends.columns import ROWS, Array, Columns, columns_of, compile_columns, directions
from contoursolve.backends.inputs import COSINE, SIDE, SINE, lookup
from contoursolve.backends.numeric import Tape, largest
from contoursolve.constraints import Coordinate, Radius, System, Values
from contoursolve.families.case_classes import CaseClass, asked_of
from contoursolve.families.spec import Places, Ranges
from contoursolve.model import FIRST, SECOND, Fact, Unit, scalar
from contoursolve.solving import RefusalKind, Solution
from contoursolve.solving.alternatives import BOTH, sides_of
from contoursolve.solving.checks import (
    Source,
    add_checks,
    at_origin,
    check_facts,
    check_path,
    check_range,
    check_residuals,
)
from contoursolve.solving.compile import PathMachine, compile_path
from contoursolve.solving.elimination import Close
from contoursolve.solving.enumerate import DRAWING, Effort, Enumeration, Found, enumerate_many
from contoursolve.solving.ground import BALLS, Ground, ground_of
from contoursolve.solving.kernel import Kernel, make_kernel
from contoursolve.solving.verdict import Code, Verdict, code_of, reason_of
from contoursolve.tolerance import LENGTH

BLOCK = 8_192
"""Rows that are looked at together."""

STEPS = 20
"""Newton's steps; from the middle of a proven box five or six do."""

STIFF = 1e3
"""1. Where the inverse of the derivatives is larger, doubles may be off by more than 1e-12 of the coordinates."""

STANDING = 1e-12
"""1 (share of the coordinates). A last step that is longer has not arrived."""


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
    """Where a solution lies, alone: the bounds of every unknown, and the sides at which elements touch; and whether it
    lies on the sides that the words choose."""

    bounds: Mapping[str, tuple[float, float]]
    signs: Mapping[str, int]
    is_chosen: bool


@dataclass(frozen=True, slots=True, eq=False)
class Cell:
    """Rows with the same solutions, each proven to be alone in its box; None where a single solve must decide.
    `is_lost` tells that there is none because a search found none."""

    rows: Places
    solutions: tuple[Place, ...] | None = None
    is_lost: bool = False


def _is_near(found: Found, box: BoxGround, system: System) -> bool:
    """Whether a solution lies within the reach of the search of every single row."""
    reach = box.nearest.reach(system)
    bounds = {name: ball.bounds(value) for name, value in found.scalars.items()}
    return all(reach[name][0] <= low and high <= reach[name][1] for name, (low, high) in bounds.items())


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
    return BoxGround(scalars, amounts, lowest.angles, directions, lowest, highest, nearest)


Bits = NDArray[numpy.bool_]
Scalars = Mapping[str, Array]


@dataclass(slots=True, eq=False)
class Pairs:
    """Rows, each with one of its solutions: where it is sought (mm or cosines), and the sides at which it touches."""

    rows: Places
    is_chosen: Bits
    middles: Mapping[str, Array]
    radii: Mapping[str, Array]
    signs: Mapping[str, Array]


@dataclass(slots=True, eq=False)
class Settled:
    """What becomes of rows: status and reason, and the scalars and sides of those that show a solution (0 for a side
    that is not known); `is_path` tells which of these are contours, and `again` has the rows that a single solve must
    decide."""

    status: NDArray[numpy.uint8]
    reason: NDArray[numpy.uint8]
    is_path: Bits
    is_shown: Bits
    scalars: dict[str, Array]
    signs: dict[str, Array]
    again: Bits


class BranchRows:
    """The functions of a class whose rows may have several solutions, for one thread."""

    def __init__(self, case: CaseClass) -> None:
        self.case = case
        self.system: System = case.system
        verdict = judge(self.system)
        self.basis = tuple(self.system.facts[index] for index in verdict.basis)
        checks = tuple(fact for index, fact in enumerate(self.system.facts) if index not in verdict.basis)
        self.groups: tuple[Group, ...] = order(self.system, self.basis)
        self.steps = [_step(make_kernel(self.system, group)) for group in self.groups]
        tape = Tape()
        at = lookup(self.system, tape, {})
        for number, fact in enumerate((*self.basis, *checks)):
            tape.output(f"residual:{number}", fact.residual(at))
        self.solved = [f"residual:{number}" for number in range(len(self.basis))]
        """The outputs of the equations that are solved."""
        equations = check_residuals(largest(tape.expression(name) for name in self.solved))
        facts = [equations, *check_facts(Source(self.system.figure, tape, at), checks, len(self.basis))]
        add_checks(tape, facts)
        self.residuals = Columns(compile_columns(tape, tape.inputs))
        self.machine: PathMachine = compile_path(self.system)
        relative = self.machine.tape.copy()
        origin = lookup(self.system, relative, at_origin(self.system.figure))
        corners = largest(relative.expression(name) for name in self.machine.corner_residuals)
        source = Source(self.system.figure, relative, origin)
        path = [check_range(source), *check_path(source), check_residuals(corners)]
        add_checks(relative, path, len(facts))
        self.path = Columns(compile_columns(relative, relative.inputs))
        self.before_path = len(facts)
        """The number of checks that do not concern the path."""
        self.checks = tuple(check for check, _ in (*facts, *path))

    def solve(self, ranges: Ranges, places: Mapping[str, Places]) -> Settled:
        """What becomes of some rows."""
        values = {word: ranges.values[word][place] for word, place in places.items()}
        rows = next(iter(places.values())).size
        given = self._given(ranges, places)
        settled = Settled(
            numpy.zeros(rows, numpy.uint8),
            numpy.zeros(rows, numpy.uint8),
            numpy.zeros(rows, bool),
            numpy.zeros(rows, bool),
            {name: numpy.full(rows, numpy.nan) for name in self.system.unknowns},
            {SIDE + side: numpy.zeros(rows) for fact in self.system.facts for side in fact.sides()},
            numpy.zeros(rows, bool),
        )
        pairs = self._pairs(values, settled)
        if pairs.rows.size:
            self._decide(pairs, given, settled)
        for row in numpy.flatnonzero(settled.again).tolist():
            self._solve_alone({word: float(each[row]) for word, each in values.items()}, [row], settled)
        return settled

    def _given(self, ranges: Ranges, places: Mapping[str, Places]) -> dict[str, Array]:
        """All that is known, row by row or as one number, by the names of the inputs."""
        case, found = self.case, dict[str, Array]()
        for name, given in case.profile.givens.items():
            value = numpy.array([float(given.value)])
            if name in case.free:
                value = case.free[name].column({word: column[places[word]] for word, column in ranges.values.items()})
            if given.unit is Unit.DEGREE:
                found[name + COSINE], found[name + SINE] = directions(value)
            else:
                found[name] = value
        for axis, origin in enumerate(case.origin(ranges, places)):
            found[scalar(self.system.figure.start, axis)] = numpy.atleast_1d(origin)
        found |= {name: numpy.array([value]) for name, value in case.profile.increments.items()}
        return found

    def _cells(self, values: Mapping[str, Array]) -> Iterator[Cell]:
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
            return not isinstance(found, Enumeration) or found.is_searched

    def _solve_box(self, rows: Places, low: Mapping[str, float], high: Mapping[str, float], effort: Effort) -> Cell:
        """The cell of all rows whose words lie between two values."""
        with ball.precision(ball.WORKING):
            box = _box(self.case, low, high)
            (found,) = enumerate_many([box], self.system, self.groups, Close.REFUSE, effort)
            if not isinstance(found, Enumeration):
                return Cell(rows)
            if found.is_searched and not all(_is_near(each, box, self.system) for each in found.found):
                return Cell(rows)
            return self._cell(rows, box, found)

    def _cell(self, rows: Places, ground: Ground, enumeration: Enumeration) -> Cell:
        """The cell of rows for all of which a search on a ground holds."""
        choices = self.case.profile.choices
        points = {choice.point for choice in choices}
        if not enumeration.is_complete or any(each.doubles for each in enumeration.found):
            return Cell(rows)
        items: list[Place] = []
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
                items.append(Place(bounds, each.signs, all(fits.values())))
        return Cell(rows, tuple(items), enumeration.is_lost)

    def _pairs(self, values: Mapping[str, Array], settled: Settled) -> Pairs:
        """Every row with each of its solutions; rows without any are settled."""
        found: list[tuple[Places, Place]] = []
        for cell in self._cells(values):
            if cell.solutions is None:
                settled.again[cell.rows] = True
                continue
            if cell.is_lost:
                settled.status[cell.rows] = Code.NO_SOLUTION
                settled.reason[cell.rows] = reason_of(RefusalKind.NO_POINT)
                continue
            if not any(place.is_chosen for place in cell.solutions):
                # Why there is none is the same for all of them.
                middle = cell.rows[cell.rows.size // 2]
                self._solve_alone({word: float(each[middle]) for word, each in values.items()}, cell.rows, settled)
                continue
            found += [(cell.rows, place) for place in cell.solutions]
        places = [place for _, place in found]
        sizes = numpy.array([rows.size for rows, _ in found], numpy.int64)

        def spread(values: Iterable[float]) -> Array:
            return numpy.repeat(numpy.array(list(values), float), sizes)

        bounds = {name: [place.bounds[name] for place in places] for name in self.system.unknowns}
        sides = places[0].signs if places else ()
        return Pairs(
            numpy.concatenate([numpy.zeros(0, numpy.int64), *(rows for rows, _ in found)]),
            numpy.repeat(numpy.array([place.is_chosen for place in places], bool), sizes),
            {name: spread((low + high) / 2 for low, high in each) for name, each in bounds.items()},
            {name: spread((high - low) / 2 for low, high in each) for name, each in bounds.items()},
            {SIDE + side: spread(place.signs[side] for place in places) for side in sides},
        )

    def _decide(self, pairs: Pairs, given: Mapping[str, Array], settled: Settled) -> None:
        """Which of the solutions of each row is the contour."""
        size, rows = pairs.rows.size, settled.status.size
        status, reason = numpy.zeros(size, numpy.uint8), numpy.zeros(size, numpy.uint8)
        is_bad, scalars = numpy.zeros(size, bool), {name: numpy.zeros(size) for name in self.system.unknowns}
        agreeing, differing = dict[str, Bits](), dict[str, Bits]()
        for first in range(0, size, ROWS):
            part = slice(first, min(first + ROWS, size))
            here = {name: each if each.size == 1 else each[pairs.rows[part]] for name, each in given.items()}
            here |= {name: each[part] for name, each in pairs.signs.items()}
            is_bad[part] = self._follow(pairs, part, here, scalars)
            verdict = self._judge(here, {name: each[part] for name, each in scalars.items()}, part.stop - part.start)
            status[part], reason[part] = verdict.status, verdict.reason
            is_bad[part] |= verdict.again | (verdict.reason == reason_of(RefusalKind.NOT_VERIFIED))
            for masks, found in ((agreeing, verdict.agreeing), (differing, verdict.differing)):
                for name, mask in found.items():
                    masks.setdefault(name, numpy.zeros(size, bool))[part] = mask
        status[(status == Code.OVERDETERMINED) & (reason != 0)] = Code.NO_SOLUTION
        is_path = (reason == 0) & (status <= Code.OVERDETERMINED) & pairs.is_chosen
        # A word that tells a solution from another one is needed after all.
        agrees = numpy.zeros(size, bool)
        for name, mask in agreeing.items():
            selects = numpy.bincount(pairs.rows[differing[name]], minlength=rows) > 0
            agrees |= mask & ~selects[pairs.rows]
        status[is_path] = numpy.where(agrees[is_path], Code.OVERDETERMINED, Code.SOLVED)
        paths = numpy.bincount(pairs.rows[is_path], minlength=rows)
        chosen = numpy.bincount(pairs.rows[pairs.is_chosen], minlength=rows)
        settled.again |= numpy.bincount(pairs.rows[is_bad], minlength=rows) > 0
        # Later pairs first, so that the first of several counts.
        for mask in (pairs.is_chosen, is_path):
            at = numpy.flatnonzero(mask)[::-1]
            settled.status[pairs.rows[at]], settled.reason[pairs.rows[at]] = status[at], reason[at]
        differ = numpy.zeros(rows, bool)
        at = numpy.flatnonzero(pairs.is_chosen)
        differ[pairs.rows[at]] = status[at] != settled.status[pairs.rows[at]]
        numpy.logical_or.at(differ, pairs.rows[at], status[at] != settled.status[pairs.rows[at]])
        settled.again |= differ & (paths == 0)
        settled.status[paths > 1] = Code.AMBIGUOUS
        settled.reason[paths > 1] = 0
        is_only = (paths == 1) | ((paths == 0) & (chosen == 1))
        shown = is_path | (pairs.is_chosen & (paths[pairs.rows] == 0))
        at = numpy.flatnonzero(shown & is_only[pairs.rows])
        for name, values in scalars.items():
            settled.scalars[name][pairs.rows[at]] = values[at]
        for name, values in pairs.signs.items():
            settled.signs[name][pairs.rows[at]] = values[at]
        settled.is_shown[pairs.rows[at]] = True
        settled.is_path[pairs.rows[at]] = is_path[at]

    def _follow(self, pairs: Pairs, part: slice, here: Mapping[str, Array], scalars: Scalars) -> Bits:
        """The solutions of some pairs, step by step; where they did not end in their boxes, or may be inexact."""
        rows = part.stop - part.start
        known = dict(here)
        is_bad = numpy.zeros(rows, bool)
        with numpy.errstate(all="ignore"):
            for kernel, function in self.steps:
                size = len(kernel.unknowns)
                at = numpy.stack([pairs.middles[name][part] for name in kernel.unknowns], axis=1)
                step, inverse = numpy.zeros((rows, size)), numpy.zeros((rows, size, size))
                for _ in range(STEPS):
                    known |= {name: at[:, column] for column, name in enumerate(kernel.unknowns)}
                    out = _run(function, known, rows)
                    residuals = numpy.stack([out[str(row)] for row in range(size)], axis=1)
                    slopes = numpy.stack([out[str(size + entry)] for entry in range(size * size)], axis=1)
                    inverse = _inverse(slopes.reshape(rows, size, size))
                    step = (inverse @ residuals[:, :, None])[:, :, 0]
                    at = at - step
                    largest = numpy.maximum(1.0, numpy.abs(at).max(axis=1))
                    if not (numpy.abs(step).max(axis=1) > STANDING / 8 * largest).any():
                        break
                known |= {name: at[:, column] for column, name in enumerate(kernel.unknowns)}
                is_bad |= ~(numpy.abs(step).max(axis=1) <= STANDING * largest)
                is_bad |= ~(numpy.abs(inverse).sum(axis=2).max(axis=1) <= STIFF)
                for column, name in enumerate(kernel.unknowns):
                    away = numpy.abs(at[:, column] - pairs.middles[name][part])
                    is_bad |= ~(away <= pairs.radii[name][part] + LENGTH)
                    scalars[name][part] = at[:, column]
        return is_bad

    def _judge(self, here: Mapping[str, Array], scalars: Scalars, rows: int) -> Verdict:
        """What speaks against each of some solutions."""
        known = {**here, **scalars}
        relative = self._relative(known)
        out = {**relative, **_run(self.path, relative, rows)}
        found = _run(self.residuals, known, rows)
        # The checks of the path come after those of the facts.
        passed = numpy.where(found["passed"] == self.before_path, found["passed"] + out["passed"], found["passed"])
        return Verdict(self.checks, {**out, **found, "passed": passed}, rows)

    def _relative(self, known: Mapping[str, Array]) -> dict[str, Array]:
        """The inputs of the path: coordinates counted from the start, and the sizes of all corners."""
        figure, found = self.system.figure, dict(known)
        for axis in (FIRST, SECOND):
            start = known[scalar(figure.start, axis)]
            for point in (*figure.points, *figure.places):
                found[scalar(point, axis)] = known[scalar(point, axis)] - start
            found[scalar(figure.start, axis)] = numpy.zeros(1)
        for corner in figure.corners:
            if corner.size not in known:
                found[corner.size] = known[f"{corner.name}.radius"]
        return found

    def _solve_alone(self, values: Mapping[str, float], rows: Sequence[int] | Places, settled: Settled) -> None:
        """What a single solve says, for all of some rows."""
        solution: Solution = self.case.solve(values)
        settled.status[rows] = code_of(solution.status)
        settled.reason[rows] = reason_of(solution.refusals[0].kind if solution.refusals else None)
        settled.is_path[rows] = settled.is_shown[rows] = bool(solution.scalars)
        for name in self.system.unknowns:
            settled.scalars[name][rows] = solution.scalars.get(name, numpy.nan)
        for sides in settled.signs.values():
            sides[rows] = 0.0

    def path_of(
        self, settled: Settled, rows: Places, ranges: Ranges, places: Mapping[str, Places]
    ) -> tuple[dict[str, Array], Array]:
        """The path of the solutions that some rows show, in coordinates counted from the start, and their largest
        residuals."""
        given = self._given(ranges, {word: place[rows] for word, place in places.items()})
        known = {**given, **{name: each[rows] for name, each in settled.scalars.items()}}
        relative = self._relative(known)
        found = {**relative, **_run_apart(self.path, relative, rows.size)}
        found |= {
            name: self._ask(question.fact, known, rows.size) for name, question in asked_of(self.case.profile).items()
        }
        worst = numpy.maximum.reduce(
            [numpy.zeros(rows.size), *(numpy.abs(found[name]) for name in self.machine.corner_residuals)]
        )
        # A side that is not known is the one on which the equation is true.
        both = [
            {name: numpy.where(each[rows] == 0, sign, each[rows]) for name, each in settled.signs.items()}
            for sign in (1.0, -1.0)
        ]
        tried = [_run_apart(self.residuals, {**known, **signs}, rows.size) for signs in both]
        for name in self.solved:
            numpy.maximum(worst, numpy.minimum(*(numpy.abs(out[name]) for out in tried)), out=worst)
        return found, worst

    def _ask(self, fact: Fact, known: Mapping[str, Array], rows: int) -> Array:
        """What a fact would state, row by row: mm or degrees."""
        if isinstance(fact, Radius):
            return known[fact.radius]
        if isinstance(fact, Coordinate):
            return known[scalar(fact.point, fact.axis)]
        found = numpy.full(rows, numpy.nan)
        columns = {name: numpy.broadcast_to(each, rows).tolist() for name, each in known.items()}
        angles = [given.name for given in self.case.profile.givens.values() if given.unit is Unit.DEGREE]
        for row in range(rows):
            numbers = {name: each[row] for name, each in columns.items()}
            pairs = {name: (numbers[name + COSINE], numbers[name + SINE]) for name in angles}
            value = fact.implied(Values(numbers, numbers, pairs, self.system.headed))
            found[row] = numpy.nan if value is None else value
        return found


def _step(kernel: Kernel) -> tuple[Kernel, Columns]:
    outputs = [str(number) for number in range(kernel.function.nnz_out(0))]
    return kernel, Columns(columns_of(kernel.function, kernel.arguments, outputs, kernel.arguments))


def _run(function: Columns, values: Mapping[str, Array], rows: int) -> dict[str, Array]:
    """The outputs at these columns."""
    for place, name in enumerate(function.compiled.varied):
        function.inputs[place, :rows] = values[name]
    return {name: numpy.broadcast_to(each, rows) for name, each in function.evaluate(rows).items()}


def _run_apart(function: Columns, values: Mapping[str, Array], rows: int) -> dict[str, Array]:
    return {name: each.copy() for name, each in _run(function, values, rows).items()}


def _inverse(matrices: Array) -> Array:
    """The inverses of square matrices; of one that is singular, NaN."""
    is_regular = (numpy.abs(numpy.linalg.det(matrices)) > 0)[:, None, None]
    found: Array = numpy.linalg.inv(numpy.where(is_regular, matrices, numpy.eye(matrices.shape[1])))
    return numpy.where(is_regular, found, numpy.nan)
