"""A case that is ready to be evaluated, any stretch of its rows at a time."""

import threading
from collections.abc import Mapping, Sequence
from functools import lru_cache
from math import nan
from typing import Any

import numpy
from msgspec import Struct, field
from numpy.typing import NDArray

from contoursolve.diagnosis import join
from contoursolve.families.block_template import SweepSpec, Template, called
from contoursolve.families.branch_rows import BLOCK, BranchRows, count_solutions
from contoursolve.families.case_classes import (
    ORIGIN,
    ByRow,
    CaseClass,
    Input,
    Results,
    ShownOutput,
    asked_of,
    case_alone,
    case_of,
    fill_row,
    names_of,
    premises_of,
    results_of,
    shown_as,
    sides_of_choice,
)
from contoursolve.families.export import Measure, measures_of
from contoursolve.families.free_words import Examples
from contoursolve.families.results import RESIDUAL, ROOM
from contoursolve.families.traced_reading import place_of_contour, read_alone
from contoursolve.families.word_values import Places, Ranges, stretches
from contoursolve.geometry import System
from contoursolve.numeric import ROWS, Array, ColumnFunction, Columns, compile_columns, where
from contoursolve.reading import Premises
from contoursolve.solving import (
    RowOutcome,
    Status,
    compile_checks,
)

Table = dict[str, NDArray[Any]]
Target = slice | Places
Bits = NDArray[numpy.bool_]


class CompiledSweep(Struct, eq=False):
    """A case that is read, the classes of its rows, and how to evaluate them; every thread has functions of its own."""

    spec: SweepSpec
    """Plain data from which, with the examples, the same can be made elsewhere."""
    examples: Examples
    ranges: Ranges
    template: Template
    cases: tuple[CaseClass, ...]
    numbers: NDArray[numpy.int64]
    """The class of each example."""
    by_row: Mapping[int, ByRow] = {}
    """The way in which rows are read one by one, by their key."""
    only: int | None = None
    """Of several solutions of each row, the one that counts; what words choose without it."""
    tool: Any = None
    """The question about tools besides the contours; the results depend on it, too."""
    local: threading.local = field(default_factory=threading.local)

    @property
    def is_one_function(self) -> bool:
        """Whether one function answers all rows."""
        case = self.cases[0]
        return len(self.cases) == 1 and case.status is None and case.is_closed and not (self.by_row or self.only)

    @property
    def premises(self) -> Premises:
        """Premises of its contours beside the words."""
        return premises_of(self.cases, self.template)

    @property
    def remark(self) -> str:
        """That rows are read one by one, and why; empty if they are not."""
        if not self.by_row:
            return ""
        return f"each value of {join([called(word) for word in self.template.words])} decides how its row is read"

    def covers(self, ranges: Ranges) -> bool:
        """Whether it has an example for each row of other values, and reads none of them by itself."""
        known = [each.key for each in self.examples.rows]
        return not self.by_row and bool(numpy.isin(self.examples.keys_of(ranges), known).all())

    def columns(self) -> dict[str, type[numpy.generic]]:
        """The names and types of all results, in order."""
        found: dict[str, type[numpy.generic]] = {"status": numpy.uint8, "reason": numpy.uint8}
        for case in self.cases:
            if case.status is None:
                found |= {f"branch.{point}": numpy.int8 for point in sides_of_choice(case)}
        for case in self.cases:
            if case.status is None:
                found |= dict.fromkeys((*results_of(case), *asked_of(case.profile)), numpy.float64)
        return {**found, RESIDUAL: numpy.float64}

    def empty(self, rows: int) -> Table:
        """Room for the results of so many rows; NaN and 0 where not every class has all of them."""
        kinds = self.columns()
        numbers = [name for name, kind in kinds.items() if kind is numpy.float64]
        # In one piece: the system hands out large pieces in large pages, a twentieth of the time of a family.
        block = numpy.empty((len(numbers), rows))
        if not self.is_one_function:
            block.fill(numpy.nan)
        found = dict(zip(numbers, block, strict=True))
        return {name: found[name] if name in found else numpy.zeros(rows, kind) for name, kind in kinds.items()}

    def measures(self) -> dict[str, Measure]:
        """The units of the words and of the results."""
        return measures_of(self.template, self.ranges, self.columns())

    def evaluate(self, first: int, last: int, table: Results) -> None:
        """Fill in the results of the rows from `first` to before `last`."""
        ranges = self.ranges
        if ranges.is_long:
            ranges, first, last = ranges.rows(first, last), 0, last - first
        places = {word: ranges.places(word, first, last) for word in ranges.values}
        number, alone = numpy.zeros(last - first, numpy.int64), dict[int, list[tuple[int, Mapping[str, float]]]]()
        if len(self.cases) > 1 or self.by_row:
            key = self.examples.key(list(ranges.values.values()), list(places.values()))
            number = self.numbers[numpy.searchsorted([each.key for each in self.examples.rows], key)]
            for row in numpy.flatnonzero(numpy.isin(key, [*self.by_row])).tolist() if self.by_row else ():
                by_row = self.by_row[int(key[row])]
                reading = read_alone(self.template, ranges.row(places, row), by_row.like)
                number[row] = NO_CLASS
                alone.setdefault(by_row.classes[reading.kind], []).append((row, reading.values))
        classes: list[_ClassRows] = self.local.__dict__.setdefault("classes", [])
        if not classes:
            classes += [_ClassRows(case, self.only) for case in self.cases]
        for each, rows in enumerate(classes):
            # Where one function answers all rows, results are written in place.
            own = None if self.is_one_function else numpy.flatnonzero(number == each)
            if rows.status is not None:
                table["status"][own] = rows.status.code
                continue
            for begin, end in stretches(last - first if own is None else own.size, rows.most):
                target = slice(begin, end) if own is None else own[begin:end]
                part = {word: place[target] for word, place in places.items()}
                rows.solve(ranges, part, target, table)
        for each, read in sorted(alone.items()):
            self._solve_alone(classes[each], read, table)

    def _solve_alone(self, rows: "_ClassRows", read: Sequence[tuple[int, Mapping[str, float]]], table: Results) -> None:
        """Fill in the results of rows of one class that were read one by one."""
        target = numpy.array([row for row, _ in read])
        if rows.status is not None:
            table["status"][target] = rows.status.code
            return
        for begin, end in stretches(target.size, rows.most):
            part = {name: numpy.array([values[name] for _, values in read[begin:end]]) for name in read[0][1]}
            places = dict.fromkeys(part, numpy.arange(end - begin))
            rows.solve(Ranges(part, is_paired=True), places, target[begin:end], table)


NO_CLASS = -1
"""The class of a row that is read by itself."""


class _ClassRows:
    """The rows of one class, and its functions, for one thread."""

    def __init__(self, case: CaseClass, only: int | None) -> None:
        self.case, self.only = case, only
        self.status = case.status if not only or only < count_solutions(case) else Status.NO_SOLUTION
        self.ranges, self.inputs = Ranges({}, is_paired=True), dict[str, Input]()
        """The inputs that vary, and the values that they are for."""
        self.function: Columns | None = None
        self.branches: BranchRows | None = None
        self.most = ROWS if case.is_closed else BLOCK
        """How many rows are solved at once."""

    def solve(self, ranges: Ranges, places: Mapping[str, Places], target: Target, table: Results) -> None:
        """Fill in the results of some rows: those at these places of the values, as `target` of a table."""
        if isinstance(target, slice) or self.case.is_closed:
            self._solve_closed(ranges, places, target, table)
        else:
            self._solve_several(ranges.at(places), target, table)

    def _solve_closed(self, ranges: Ranges, places: Mapping[str, Places], target: Target, table: Results) -> None:
        """The rows of a class with one function for all of them."""
        rows = target.stop - target.start if isinstance(target, slice) else target.size
        function, names = self._function(ranges, places, rows), names_of(self.case)
        into = {output: table[name][target] for output, name in names.items()} if isinstance(target, slice) else {}
        out = function.evaluate(rows, into)
        if not isinstance(target, slice):
            for output, name in names.items():
                table[name][target] = out[output]
        verdict = RowOutcome(self.case.checked.outputs, out, rows)
        self._note(verdict.is_clear, verdict.status, verdict.reason, target, table)
        again = numpy.flatnonzero(verdict.again)
        at = again + target.start if isinstance(target, slice) else target[again]
        for row, place in zip(again.tolist(), at.tolist(), strict=True):
            fill_row(self.case, ranges.row(places, row), place, table)

    def _solve_several(self, values: Mapping[str, Array], target: Places, table: Results) -> None:
        """The rows of a class without one function for all of them."""
        self.branches = self.branches or BranchRows(self.case, None if self.case.profile.picks else self.only)
        settled = self.branches.solve(values, target.size)
        self._note(settled.is_path, settled.status, settled.reason, target, table)
        asked = asked_of(self.case.profile).items()
        results = results_of(self.case) | {name: ShownOutput(name, factor=1 + each.is_diameter) for name, each in asked}
        rows = numpy.flatnonzero(settled.is_shown)
        if not rows.size:
            return
        own = {word: column[rows] for word, column in values.items()}
        out, worst = self.branches.path_of(settled, rows, own)
        origin, is_path = self.case.origin(own), settled.is_path[rows]
        for name, (output, axis, factor) in results.items():
            column = (out[output] + (0.0 if axis is None else origin[axis])) * factor
            is_measure = name.endswith(ROOM)
            table[name][target[rows]] = column if is_measure else numpy.where(is_path, column, numpy.nan)
        table[RESIDUAL][target[rows]] = worst

    def _function(self, ranges: Ranges, places: Mapping[str, Places], rows: int) -> Columns:
        """The function, with the values of some rows as its inputs."""
        case = self.case
        if self.ranges is not ranges:
            self.ranges, self.inputs = ranges, case.columns(ranges)
        if self.function is None:
            shown, varied = tuple(results_of(case).values()), frozenset(self.inputs)
            self.function = Columns(_compile(case.system, varied, shown))
            fixed = case.numbers()
            self.function.fix(slice(None), [fixed[name] for name in self.function.compiled.fixed])
        for place, name in enumerate(self.function.compiled.varied):
            self.inputs[name].fill(places, self.function.inputs[place, :rows])
        return self.function

    def _note(self, is_path: Bits, status: NDArray[Any], reason: NDArray[Any], target: Target, table: Results) -> None:
        """The status, the reason and the sides of some rows; `is_path` tells which of them have a contour."""
        table["status"][target], table["reason"][target] = status, reason
        for point, side in sides_of_choice(self.case).items():
            table[f"branch.{point}"][target] = is_path.view(numpy.int8) * numpy.int8(side)


@lru_cache(maxsize=64)
def _compile(system: System, varied: frozenset[str], shown: tuple[ShownOutput, ...]) -> ColumnFunction:
    """The function of a system for columns: what the verdict reads, and the results as they are shown."""
    checked = compile_checks(system)
    tape, path, outputs = checked.tape, checked.outputs.path, checked.outputs
    needed = [outputs.passed, *outputs.margins.values(), checked.worst]
    needed += [corner.cosine for corner in path.corners.values()]
    kept = tape.keep(needed)
    gap, rooms = where(checked.is_clear, 0.0, nan), set(path.rooms.values())
    for output, axis, factor in shown:
        value = tape.expression(output)
        if output not in rooms:
            value += gap if axis is None else kept.input(f"{ORIGIN}{axis}") + gap
        value = value * factor if factor > 1 else value
        kept.output(shown_as(output), value)
    return compile_columns(kept, varied)


def cases_of(
    template: Template, examples: Examples
) -> tuple[tuple[CaseClass, ...], NDArray[numpy.int64], dict[int, ByRow]]:
    """The classes of the example rows, each once, the number of the class of each example, and how the rows are read
    that are read one by one. Raises FamilyError."""
    items, numbers, by_row = list[CaseClass](), list[int](), dict[int, ByRow]()
    for row in examples.rows:
        values = dict(zip(template.words, row.values, strict=True))
        case = (case_alone if row.is_by_row else case_of)(template, values)
        numbers.append(next((number for number, each in enumerate(items) if case.is_like(each)), len(items)))
        items += [case] if numbers[-1] == len(items) else []
        if row.is_by_row:
            like = None if row.is_compared else place_of_contour(template, values)
            own = by_row.setdefault(row.key, ByRow(like, {}))
            own.classes[read_alone(template, values, own.like, is_kept=True).kind] = numbers[-1]
    return tuple(items), numpy.array(numbers, numpy.int64), by_row
