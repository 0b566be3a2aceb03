"""Rows of which each may have several solutions: those of the construction over all its signs, and a verdict on each.

A row that floats do not decide, close to a singular case or to two solutions that are one, is solved alone; so is each
row of a system without a closed form.
"""

from collections.abc import Container, Iterable, Mapping, Sequence
from functools import lru_cache
from itertools import product
from math import inf
from typing import Any

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.families.branches import side_margins
from contoursolve.families.case_classes import CaseClass, asked_of
from contoursolve.families.errors import NotClosedError
from contoursolve.families.word_values import Places, stretches
from contoursolve.geometry import FIRST, SECOND, Choice, Fact, System, Unit, Values, scalar
from contoursolve.numeric import (
    COSINE,
    ROWS,
    SIDE,
    SINE,
    Array,
    ColumnFunction,
    Columns,
    Tape,
    at_most,
    below,
    compile_columns,
    directions,
    larger,
    largest,
    magnitude,
    true,
)
from contoursolve.solving import (
    UNVERIFIED,
    Check,
    CheckOutputs,
    Enumeration,
    Need,
    NoClosedFormError,
    RowOutcome,
    Status,
    SystemSolution,
    add_checks,
    at_origin,
    basis_of,
    check_facts,
    check_path,
    check_range,
    check_residuals,
    choose,
    compile_branches,
    compile_path,
    enumerate_each,
    find_alternatives,
    input_values,
    measured_figure,
    reason_of,
    spare_of,
)

BLOCK = 32_768
"""Rows that are looked at together."""

TOGETHER = 256
"""Rows that are searched together."""

CLOSE = {Need.REGULAR: 1e-6, Need.REAL: 1e-5, Need.POSITIVE: 1e-6}
"""1, square mm, mm. So close to zero floats do not decide a condition of a construction: its row is solved alone."""

BESIDE = 1e-6
"""mm. The same of what tells on which side a point lies."""


Bits = NDArray[numpy.bool_]


class RowCandidates(Struct, eq=False):
    """Rows, each with one of its solutions: the unknowns (mm or cosines), and the sides at which it touches."""

    rows: Places
    is_chosen: Bits
    scalars: Mapping[str, Array]
    signs: Mapping[str, Array]


class RowSolutions(Struct, eq=False):
    """The verdict on rows: status and reason, and the scalars and sides of those that show a solution (0 for a side
    that is not known); `is_path` tells which of these are contours, and `again` has the rows that a single solve must
    decide."""

    status: NDArray[numpy.uint8]
    reason: NDArray[numpy.uint8]
    is_path: Bits
    is_shown: Bits
    scalars: dict[str, Array]
    signs: dict[str, Array]
    again: Bits


def count_solutions(case: CaseClass) -> int:
    """The number of solutions that each row of a class may have. Raises NotClosedError without a closed form."""
    if case.status is not None or case.is_closed or case.profile.picks:
        return 1
    branches = _compile(case.system, case.profile.choices)
    if branches is None:
        raise NotClosedError(
            "without a closed form the solutions of a row are no branches; solve row by row, and list its solutions"
        )
    return 1 << len(branches.signs)


class BranchRows:
    """The functions of a class whose rows may have several solutions, for one thread. With `only`, each row has this
    one of them or none, whatever else there is."""

    def __init__(self, case: CaseClass, only: int | None = None) -> None:
        self.case = case
        self.only = only
        self.system: System = case.system
        self.branches = _compile(self.system, case.profile.choices)
        self.construction = Columns(self.branches.function) if self.branches is not None else None
        sizes = {corner.size for corner in self.system.figure.corners}
        self.verdict = _compile_verdict(self.system, frozenset(sizes.intersection(case.profile.givens)))
        self.function = Columns(self.verdict.function)

    def solve(self, values: Mapping[str, Array], rows: int) -> RowSolutions:
        """The verdict on so many rows with these values of the words; where only a tool varies, there is no word."""
        settled = RowSolutions(
            numpy.zeros(rows, numpy.uint8),
            numpy.zeros(rows, numpy.uint8),
            numpy.zeros(rows, bool),
            numpy.zeros(rows, bool),
            {name: numpy.full(rows, numpy.nan) for name in self.system.unknowns},
            {SIDE + side: numpy.zeros(rows) for fact in self.system.facts for side in fact.sides()},
            numpy.zeros(rows, bool),
        )
        given = self._given(values)
        if self.branches is None or self.construction is None:
            settled.again[:] = True
        elif (pairs := self._candidates(self.branches, self.construction, values, given, settled)).rows.size:
            self._decide(pairs, given, settled)
        alone = numpy.flatnonzero(settled.again)
        for first, last in stretches(alone.size, TOGETHER):
            rows_of = [{word: float(each[row]) for word, each in values.items()} for row in alone[first:last]]
            found = enumerate_each([self.case.at(each) for each in rows_of], self.system)
            for row, own, enumeration in zip(alone[first:last], rows_of, found, strict=True):
                self._settle(self._solve_alone(own, enumeration), [row], settled)
        return settled

    def _solve_alone(self, values: Mapping[str, float], enumeration: Enumeration | None = None) -> SystemSolution:
        """The single solve of a row; where one solution alone counts, that of all which lies nearest to it in floats
        and to no other one nearer."""
        if self.only is None:
            return self.case.solve(values, enumeration)
        profile = self.case.at(values)
        items = choose(find_alternatives(profile, enumeration), profile.choices)
        places = self._places_of(values)
        apart = [
            (off, number, place)
            for number, at in enumerate(places)
            for place, item in enumerate(items)
            if (off := max((abs(at[name] - item.scalars[name]) for name in at), default=0.0)) < inf
        ]
        taken: dict[int, int] = {}
        for _, number, place in sorted(apart):
            if number not in taken and place not in taken.values():
                taken[number] = place
        if self.only in taken:
            return items[taken[self.only]].solution
        none = self.case.solve(values, enumeration) if not items else None
        return none if none is not None and not none.scalars else SystemSolution(Status.NO_SOLUTION)

    def _places_of(self, values: Mapping[str, float]) -> list[dict[str, float]]:
        """The unknowns in each of the solutions of a row, as floats have them."""
        if self.branches is None or self.construction is None:
            return []
        given = self._given({word: numpy.array([value]) for word, value in values.items()})
        found = []
        for signs in self.branches.ways(None):
            out = _run(self.construction, {**given, **signs}, 1)
            found.append({name: float(out[name][0]) for name in self.system.unknowns})
        return found

    def _given(self, values: Mapping[str, Array]) -> dict[str, Array]:
        """All that is known, row by row or as one number, by the names of the inputs."""
        case, found = self.case, dict[str, Array]()
        for name, given in case.profile.givens.items():
            value = case.free[name].column(values) if name in case.free else numpy.array([float(given.value)])
            if given.unit is Unit.DEGREE:
                found[name + COSINE], found[name + SINE] = directions(value)
            else:
                found[name] = value
        for axis, origin in enumerate(case.origin(values)):
            found[scalar(self.system.figure.start, axis)] = numpy.atleast_1d(origin)
        found |= {name: numpy.array([value]) for name, value in case.profile.increments.items()}
        return found

    def _candidates(
        self,
        branches: "_Branches",
        function: Columns,
        values: Mapping[str, Array],
        given: Mapping[str, Array],
        settled: RowSolutions,
    ) -> RowCandidates:
        """Every row with each of its solutions; rows without any that may be chosen are settled."""
        rows, found, ways = settled.status.size, list[RowCandidates](), list[Array]()
        is_chosen = numpy.zeros(rows, bool)
        for signs in branches.ways(self.only):
            out = _run(function, {**given, **signs}, rows)
            settled.again |= out[_OPEN] > 0
            ways.append((2 * out[_PASSED] + out[_CHOSEN]).astype(numpy.int64))
            own = numpy.flatnonzero(out[_PASSED] == branches.count)
            chosen = out[_CHOSEN][own] > 0
            is_chosen[own[chosen]] = True
            sides = {name: numpy.repeat(sign, own.size) for name, sign in signs.items() if name in settled.signs}
            found.append(RowCandidates(own, chosen, {name: out[name][own] for name in self.system.unknowns}, sides))
        # Why there is none is the same for all rows whose solutions fail in the same way.
        rest = numpy.flatnonzero(~is_chosen & ~settled.again)
        kinds = numpy.zeros(rest.size, numpy.int64)
        for way in ways:
            kinds = numpy.unique(kinds * 2 * (branches.count + 1) + way[rest], return_inverse=True)[1]
        for kind in range(kinds.max(initial=-1) + 1):
            alike = rest[kinds == kind]
            middle = {word: float(each[alike[alike.size // 2]]) for word, each in values.items()}
            solution = self._solve_alone(middle)
            if solution.scalars:
                # Other facts were taken for those that are singular, or disagree: each row has points of its own.
                settled.again[alike] = True
            else:
                self._settle(solution, alike, settled)

        def joined(columns: Iterable[Array]) -> Array:
            return numpy.concatenate(list(columns))

        return RowCandidates(
            numpy.concatenate([each.rows for each in found]),
            numpy.concatenate([each.is_chosen for each in found]),
            {name: joined(each.scalars[name] for each in found) for name in self.system.unknowns},
            {name: joined(each.signs[name] for each in found) for name in found[0].signs},
        )

    def _decide(self, pairs: RowCandidates, given: Mapping[str, Array], settled: RowSolutions) -> None:
        """Settle which of the solutions of each row is the contour."""
        rows = settled.status.size

        def count(which: Bits) -> Places:
            """The number of these pairs in each row."""
            return numpy.bincount(pairs.rows[which], minlength=rows)

        known = {name: each if each.size == 1 else each[pairs.rows] for name, each in given.items()} | {**pairs.signs}
        size, scalars = pairs.rows.size, pairs.scalars
        verdict = RowOutcome(self.verdict.outputs, _run(self.function, {**known, **scalars}, size), size)
        status, reason = verdict.status, verdict.reason
        settled.again |= count(verdict.again | (reason == UNVERIFIED)) > 0
        status[(status == Status.OVERDETERMINED.code) & (reason != 0)] = Status.NO_SOLUTION.code
        is_path = (reason == 0) & (status <= Status.OVERDETERMINED.code) & pairs.is_chosen
        # A word that tells a solution from another one is needed after all.
        agrees = numpy.zeros(pairs.rows.size, bool)
        for name, mask in verdict.agreeing.items():
            agrees |= mask & (count(verdict.differing[name]) == 0)[pairs.rows]
        status[is_path] = numpy.where(agrees[is_path], Status.OVERDETERMINED.code, Status.SOLVED.code)
        # Later pairs first, so that the first of several counts.
        for mask in (pairs.is_chosen, is_path):
            at = numpy.flatnonzero(mask)[::-1]
            settled.status[pairs.rows[at]], settled.reason[pairs.rows[at]] = status[at], reason[at]
        paths, chosen = count(is_path), count(pairs.is_chosen)
        is_other = (status != settled.status[pairs.rows]) | (reason != settled.reason[pairs.rows])
        differs = count(pairs.is_chosen & is_other) > 0
        settled.again |= differs & (paths == 0)
        if self.case.profile.picks:
            # Which of several a number chooses is counted for each row by itself.
            settled.again |= paths > 1
        settled.status[paths > 1] = Status.AMBIGUOUS.code
        settled.reason[paths > 1] = 0
        is_only = (paths == 1) | ((paths == 0) & (chosen == 1))
        shown = is_path | (pairs.is_chosen & (paths[pairs.rows] == 0))
        at = numpy.flatnonzero(shown & is_only[pairs.rows])
        for into, columns in ((settled.scalars, scalars), (settled.signs, pairs.signs)):
            for name, column in columns.items():
                into[name][pairs.rows[at]] = column[at]
        settled.is_shown[pairs.rows[at]] = True
        settled.is_path[pairs.rows[at]] = is_path[at]

    def _settle(self, solution: SystemSolution, rows: Sequence[int] | Places, settled: RowSolutions) -> None:
        """Note what the single solve of a row says, for all of some rows."""
        settled.status[rows] = solution.status.code
        settled.reason[rows] = reason_of(solution.refusals[0].kind if solution.refusals else None)
        settled.is_path[rows] = settled.is_shown[rows] = bool(solution.scalars)
        for name in self.system.unknowns:
            settled.scalars[name][rows] = solution.scalars.get(name, numpy.nan)
        for sides in settled.signs.values():
            sides[rows] = 0.0

    def path_of(
        self, settled: RowSolutions, rows: Places, values: Mapping[str, Array]
    ) -> tuple[dict[str, Array], Array]:
        """The path of the solutions that some rows show, whose words have these values, in coordinates counted from the
        start point, and their largest residuals."""
        known = {**self._given(values), **{name: each[rows] for name, each in settled.scalars.items()}}
        # A side that is not known is the one on which the equation is true.
        tried: list[list[Array]] = []
        for sign in (1.0, -1.0)[: 1 + bool(settled.signs)]:
            signs = {name: numpy.where(each[rows] == 0, sign, each[rows]) for name, each in settled.signs.items()}
            out = _run(self.function, {**known, **signs}, rows.size)
            tried.append([numpy.abs(out[name]) for name in self.verdict.solved])
        worst = numpy.maximum.reduce(
            [numpy.zeros(rows.size), *(numpy.abs(out[name]) for name in self.verdict.outputs.path.residuals)]
        )
        for each in zip(*tried, strict=True):
            numpy.maximum(worst, numpy.minimum.reduce(each), out=worst)
        asked = asked_of(self.case.profile).items()
        return {**known, **out} | {name: self._ask(each.fact, known, rows.size) for name, each in asked}, worst

    def _ask(self, fact: Fact, known: Mapping[str, Array], rows: int) -> Array:
        """The values that a fact would state, row by row: mm or degrees."""
        if fact.sizes:
            return known[fact.sizes]
        if fact.placed and not fact.placed.origin:
            return known[scalar(*fact.placed[:2])]
        found = numpy.full(rows, numpy.nan)
        columns = {name: numpy.broadcast_to(each, rows).tolist() for name, each in known.items()}
        angles = [given.name for given in self.case.profile.givens.values() if given.unit is Unit.DEGREE]
        for row in range(rows):
            numbers = {name: each[row] for name, each in columns.items()}
            pairs = {name: (numbers[name + COSINE], numbers[name + SINE]) for name in angles}
            value = fact.implied(Values(numbers, numbers, pairs, self.system.headed))
            found[row] = numpy.nan if value is None else value
        return found


def add_path(tape: Tape, system: System, givens: Container[str]) -> list[tuple[Check, Any]]:
    """Declare the path through the points of a system, as they are inputs; its checks with their margins. `givens` tell
    which sizes of corners are stated."""
    figure, machine = system.figure, compile_path(system)
    path = machine.tape.copy()
    measured = measured_figure(system, path, at_origin(figure), machine.path)
    checks = [check_range(measured), *check_path(measured), check_residuals(largest(measured.path.residuals))]
    radii = {each.size: f"{each.name}.radius" for each in figure.corners if each.size not in givens}
    inputs: dict[str, Any] = {name: tape.input(radii.get(name, name)) for name in path.inputs}
    # Inside a path counts from its start point.
    for axis in (FIRST, SECOND):
        start = tape.input(scalar(figure.start, axis))
        for point in (*figure.points, *figure.places):
            inputs[scalar(point, axis)] = tape.input(scalar(point, axis)) - start
            path.output(scalar(point, axis), path.input(scalar(point, axis)))
        inputs[scalar(figure.start, axis)] = 0.0
    for number, (_, margin) in enumerate(checks):
        path.output(f"path:{number}", margin)
    outputs = {name: path.expression(name) for name in path.outputs}
    for name, expression in zip(outputs, path.replaced(inputs, outputs)[1], strict=True):
        tape.output(name, expression)
    return [(check, tape.expression(f"path:{number}")) for number, (check, _) in enumerate(checks)]


class _Verdict(Struct, frozen=True, eq=False):
    """The checks of a system at given points, and the names of the residuals of the equations that are solved."""

    function: ColumnFunction
    outputs: CheckOutputs
    solved: tuple[str, ...]


@lru_cache(maxsize=64)
def _compile_verdict(system: System, sizes: frozenset[str]) -> _Verdict:
    """The checks of a system; `sizes` are those of corners that are stated."""
    basis, spare, tape = basis_of(system), spare_of(system), Tape()
    at = input_values(system.headed, tape, {})
    residuals = {f"residual:{number}": fact.residual(at) for number, fact in enumerate(basis)}
    for name, residual in residuals.items():
        tape.output(name, residual)
    equations, path = check_residuals(largest(residuals.values())), compile_path(system).path
    stated = check_facts(measured_figure(system, tape, {}), spare, [fact.residual(at) for fact in spare])
    outputs, _ = add_checks(tape, [equations, *stated, *add_path(tape, system, sizes)], path)
    return _Verdict(compile_columns(tape, tape.inputs), outputs, tuple(residuals))


_OPEN, _PASSED, _CHOSEN = "open", "passed", "chosen"
"""Outputs about a solution: floats do not decide it; the number of conditions that hold in their order; and it lies on
the sides that words choose."""


class _Branches(Struct, frozen=True, eq=False):
    """The solutions of a system in closed form, one for each choice of the signs, and how many conditions each has."""

    function: ColumnFunction
    signs: tuple[str, ...]
    count: int

    def ways(self, only: int | None) -> list[dict[str, Array]]:
        """The signs of each solution, or of one alone."""
        ways = [*product((1.0, -1.0), repeat=len(self.signs))]
        chosen = ways if only is None else ways[only : only + 1]
        return [{name: numpy.array([sign]) for name, sign in zip(self.signs, way, strict=True)} for way in chosen]


@lru_cache(maxsize=64)
def _compile(system: System, choices: tuple[Choice, ...]) -> _Branches | None:
    """The solutions of a system; None without a closed form."""
    try:
        form = compile_branches(system)
    except NoClosedFormError:
        return None
    tape = form.tape.copy()

    def decide(margins: Iterable[tuple[Any, float]]) -> tuple[Any, Any]:
        """The number of margins above zero in their order, and whether the next one may be."""
        is_alive, is_open, passed = true(), 0 * true(), 0 * true()
        for margin, close in margins:
            passes = below(close, margin)
            is_open = larger(is_open, is_alive * (1 - passes - below(margin, -close)))
            is_alive *= passes
            passed += is_alive
        return passed, is_open

    # A conic on a line counts along a direction of this length.
    unit = {each.discriminant: tape.expression(each.determinant) for each in form.measures if each.determinant}
    needed = list[tuple[Any, float]]()
    for each in form.conditions:
        margin = tape.expression(each.output)
        margin *= unit[each.output] ** 2 if each.output in unit else 1.0
        needed.append((magnitude(margin) if each.need is Need.REGULAR else margin, CLOSE[each.need]))
    sides = {choice: (margin, BESIDE) for choice, margin in side_margins(form, choices)}
    # What the form chooses by itself is no alternative.
    needed += [each for choice, each in sides.items() if not choice.given]
    stated = [each for choice, each in sides.items() if choice.given]
    passed, is_open = decide(needed)
    chosen, is_beside = decide(stated)
    is_found = at_most(len(needed), passed)
    tape.output(_PASSED, passed)
    tape.output(_CHOSEN, is_found * at_most(len(stated), chosen))
    tape.output(_OPEN, larger(is_open, is_found * is_beside))
    kept = tape.keep([_PASSED, _CHOSEN, _OPEN, *system.unknowns])
    return _Branches(compile_columns(kept, kept.inputs), form.signs, len(needed))


def _run(function: Columns, values: Mapping[str, Array], rows: int) -> dict[str, Array]:
    """The outputs at these columns; true until the next call where one call is enough."""
    parts: list[dict[str, Array]] = []
    for first, last in stretches(rows, ROWS):
        for place, name in enumerate(function.compiled.varied):
            column = values[name]
            function.inputs[place, : last - first] = column if column.size == 1 else column[first:last]
        found = function.evaluate(last - first)
        parts.append({name: numpy.broadcast_to(each, last - first) for name, each in found.items()})
        if rows > ROWS:
            parts[-1] = {name: each.copy() for name, each in parts[-1].items()}
    return (
        parts[0] if len(parts) == 1 else {name: numpy.concatenate([each[name] for each in parts]) for name in parts[0]}
    )
