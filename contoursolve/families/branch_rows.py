"""Rows of which each may have several solutions: Newton's method from the boxes that hold one each, and a verdict."""

from collections.abc import Container, Iterable, Mapping, Sequence
from typing import Any

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.families.case_classes import CaseClass, asked_of
from contoursolve.families.row_boxes import RowBoxes, SolutionBox
from contoursolve.families.spec import Places, stretches
from contoursolve.geometry import FIRST, SECOND, Fact, System, Unit, Values, scalar
from contoursolve.numeric import (
    COSINE,
    ROWS,
    SIDE,
    SINE,
    Array,
    Columns,
    Tape,
    columns_of,
    compile_columns,
    directions,
    largest,
)
from contoursolve.solving import (
    NO_POINT,
    UNVERIFIED,
    Check,
    Kernel,
    RowOutcome,
    StatusCode,
    add_checks,
    at_origin,
    basis_of,
    check_facts,
    check_path,
    check_range,
    check_residuals,
    code_of,
    compile_path,
    input_values,
    make_kernel,
    measured_figure,
    reason_of,
    spare_of,
)
from contoursolve.tolerance import LENGTH

BLOCK = 8_192
"""Rows that are looked at together."""

STEPS = 20
"""Newton's steps; from the middle of a proven box five or six do."""

STIFF = 1e3
"""1. Where the inverse of the derivatives is larger, doubles may be off by more than 1e-12 of the coordinates."""

STANDING = 1e-12
"""1 (share of the coordinates). A last step that is longer has not arrived."""


Bits = NDArray[numpy.bool_]


class RowCandidates(Struct, eq=False):
    """Rows, each with one of its solutions: where it is sought (mm or cosines), and the sides at which it touches."""

    rows: Places
    is_chosen: Bits
    middles: Mapping[str, Array]
    radii: Mapping[str, Array]
    signs: Mapping[str, Array]


class RowSolutions(Struct, eq=False):
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
        basis, spare = basis_of(self.system), spare_of(self.system)
        self.boxes = RowBoxes(case)
        self.steps = [_step(make_kernel(self.system, group)) for group in self.boxes.groups]
        tape = Tape()
        at = input_values(self.system, tape, {})
        residuals = {f"residual:{number}": fact.residual(at) for number, fact in enumerate(basis)}
        for name, residual in residuals.items():
            tape.output(name, residual)
        self.solved = [*residuals]
        """The outputs of the equations that are solved."""
        equations = check_residuals(largest(residuals.values()))
        stated = check_facts(measured_figure(self.system, tape, {}), spare, [fact.residual(at) for fact in spare])
        self.path = compile_path(self.system).path
        """The names of the outputs of the path."""
        checks = [equations, *stated, *add_path(tape, self.system, case.profile.givens)]
        self.outputs, _ = add_checks(tape, checks, self.path)
        self.function = Columns(compile_columns(tape, tape.inputs))

    def solve(self, values: Mapping[str, Array]) -> RowSolutions:
        """What becomes of rows with these values of the words."""
        rows = next(iter(values.values())).size
        settled = RowSolutions(
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
            self._decide(pairs, self._given(values), settled)
        for row in numpy.flatnonzero(settled.again).tolist():
            self._solve_alone(values, row, [row], settled)
        return settled

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

    def _pairs(self, values: Mapping[str, Array], settled: RowSolutions) -> RowCandidates:
        """Every row with each of its solutions; rows without any are settled."""
        found: list[tuple[Places, SolutionBox]] = []
        for cell in self.boxes.cells(values):
            if cell.solutions is None:
                settled.again[cell.rows] = True
                continue
            if cell.is_lost:
                settled.status[cell.rows] = StatusCode.NO_SOLUTION
                settled.reason[cell.rows] = NO_POINT
                continue
            if not any(place.is_chosen for place in cell.solutions):
                # Why there is none is the same for all of them.
                self._solve_alone(values, int(cell.rows[cell.rows.size // 2]), cell.rows, settled)
                continue
            found += [(cell.rows, place) for place in cell.solutions]
        places = [place for _, place in found]
        sizes = numpy.array([rows.size for rows, _ in found], numpy.int64)

        def spread(values: Iterable[float]) -> Array:
            return numpy.repeat(numpy.array(list(values), float), sizes)

        bounds = {name: [place.bounds[name] for place in places] for name in self.system.unknowns}
        sides = places[0].signs if places else ()
        return RowCandidates(
            numpy.concatenate([numpy.zeros(0, numpy.int64), *(rows for rows, _ in found)]),
            numpy.repeat(numpy.array([place.is_chosen for place in places], bool), sizes),
            {name: spread((low + high) / 2 for low, high in each) for name, each in bounds.items()},
            {name: spread((high - low) / 2 for low, high in each) for name, each in bounds.items()},
            {SIDE + side: spread(place.signs[side] for place in places) for side in sides},
        )

    def _decide(self, pairs: RowCandidates, given: Mapping[str, Array], settled: RowSolutions) -> None:
        """Which of the solutions of each row is the contour."""
        rows = settled.status.size

        def count(which: Bits) -> Places:
            """How many of these pairs each row has."""
            return numpy.bincount(pairs.rows[which], minlength=rows)

        known = {name: each if each.size == 1 else each[pairs.rows] for name, each in given.items()} | {**pairs.signs}
        scalars, is_bad = self._follow(pairs, known)
        size = pairs.rows.size
        verdict = RowOutcome(self.outputs, _run(self.function, {**known, **scalars}, size), size)
        status, reason = verdict.status, verdict.reason
        settled.again |= count(is_bad | verdict.again | (reason == UNVERIFIED)) > 0
        status[(status == StatusCode.OVERDETERMINED) & (reason != 0)] = StatusCode.NO_SOLUTION
        is_path = (reason == 0) & (status <= StatusCode.OVERDETERMINED) & pairs.is_chosen
        # A word that tells a solution from another one is needed after all.
        agrees = numpy.zeros(pairs.rows.size, bool)
        for name, mask in verdict.agreeing.items():
            agrees |= mask & (count(verdict.differing[name]) == 0)[pairs.rows]
        status[is_path] = numpy.where(agrees[is_path], StatusCode.OVERDETERMINED, StatusCode.SOLVED)
        # Later pairs first, so that the first of several counts.
        for mask in (pairs.is_chosen, is_path):
            at = numpy.flatnonzero(mask)[::-1]
            settled.status[pairs.rows[at]], settled.reason[pairs.rows[at]] = status[at], reason[at]
        paths, chosen = count(is_path), count(pairs.is_chosen)
        differs = count(pairs.is_chosen & (status != settled.status[pairs.rows])) > 0
        settled.again |= differs & (paths == 0)
        if self.case.profile.picks:
            # Which of several a number chooses is counted for each row by itself.
            settled.again |= paths > 1
        settled.status[paths > 1] = StatusCode.AMBIGUOUS
        settled.reason[paths > 1] = 0
        is_only = (paths == 1) | ((paths == 0) & (chosen == 1))
        shown = is_path | (pairs.is_chosen & (paths[pairs.rows] == 0))
        at = numpy.flatnonzero(shown & is_only[pairs.rows])
        for into, columns in ((settled.scalars, scalars), (settled.signs, pairs.signs)):
            for name, column in columns.items():
                into[name][pairs.rows[at]] = column[at]
        settled.is_shown[pairs.rows[at]] = True
        settled.is_path[pairs.rows[at]] = is_path[at]

    def _follow(self, pairs: RowCandidates, given: Mapping[str, Array]) -> tuple[dict[str, Array], Bits]:
        """The solutions of all pairs, step by step; and where they did not end in their boxes, or may be inexact."""
        rows = pairs.rows.size
        known, is_bad = dict(given), numpy.zeros(rows, bool)
        with numpy.errstate(all="ignore"):
            for kernel, function in self.steps:
                size = len(kernel.unknowns)
                at = numpy.stack([pairs.middles[name] for name in kernel.unknowns], axis=1)
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
                is_bad |= ~(numpy.abs(step).max(axis=1) <= STANDING * largest)
                is_bad |= ~(numpy.abs(inverse).sum(axis=2).max(axis=1) <= STIFF)
                for column, name in enumerate(kernel.unknowns):
                    known[name] = at[:, column]
                    is_bad |= ~(numpy.abs(known[name] - pairs.middles[name]) <= pairs.radii[name] + LENGTH)
        return {name: known[name] for name in self.system.unknowns}, is_bad

    def _solve_alone(
        self, values: Mapping[str, Array], row: int, rows: Sequence[int] | Places, settled: RowSolutions
    ) -> None:
        """What a single solve of one row says, for all of some rows."""
        solution = self.case.solve({word: float(each[row]) for word, each in values.items()})
        settled.status[rows] = code_of(solution.status)
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
        for sign in (1.0, -1.0):
            signs = {name: numpy.where(each[rows] == 0, sign, each[rows]) for name, each in settled.signs.items()}
            out = _run(self.function, {**known, **signs}, rows.size)
            tried.append([numpy.abs(out[name]) for name in self.solved])
        worst = numpy.maximum.reduce([numpy.zeros(rows.size), *(numpy.abs(out[name]) for name in self.path.residuals)])
        for one, other in zip(*tried, strict=True):
            numpy.maximum(worst, numpy.minimum(one, other), out=worst)
        asked = asked_of(self.case.profile).items()
        return {**known, **out} | {name: self._ask(each.fact, known, rows.size) for name, each in asked}, worst

    def _ask(self, fact: Fact, known: Mapping[str, Array], rows: int) -> Array:
        """What a fact would state, row by row: mm or degrees."""
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


def _step(kernel: Kernel) -> tuple[Kernel, Columns]:
    outputs = [str(number) for number in range(kernel.function.nnz_out(0))]
    return kernel, Columns(columns_of(kernel.function, kernel.arguments, outputs, kernel.arguments))


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


def _inverse(matrices: Array) -> Array:
    """The inverses of square matrices; of one that is singular, NaN."""
    is_regular = (numpy.abs(numpy.linalg.det(matrices)) > 0)[:, None, None]
    found: Array = numpy.linalg.inv(numpy.where(is_regular, matrices, numpy.eye(matrices.shape[1])))
    return numpy.where(is_regular, found, numpy.nan)
