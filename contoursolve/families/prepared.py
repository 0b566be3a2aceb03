"""A family that is ready to be evaluated, any stretch of its rows at a time."""

import threading
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import product
from typing import Any

import numpy
from numpy.typing import NDArray

from contoursolve.backends.columns import ROWS, Array, ColumnFunction, Columns, compile_columns
from contoursolve.constraints import System
from contoursolve.families.kinds import Kind, alike, classify, kind_of
from contoursolve.families.ranges import Ranges, stretches
from contoursolve.families.template import Template
from contoursolve.families.verdict import Code, Verdict, code_of, reason_of
from contoursolve.model import FIRST, SECOND, CornerShape, scalar
from contoursolve.solving import RemarkKind, Solution
from contoursolve.solving.compile import compile_system

Table = dict[str, NDArray[Any]]
Results = Mapping[str, NDArray[Any]]
Rows = NDArray[numpy.int64]
Target = slice | Rows
_Ready = tuple[Columns, Mapping[str, tuple[str, Array]], Mapping[str, tuple[str, float]]]

_OUTPUTS = (
    "determinant:", "offset:", "radius:", "scale:", "distance:", "residual:", "length:", "turn:", "cosine:",
    "setback-in:", "setback-out:", "landing:", "begin:", "end:", "center:", "corner-residual:", "room:",
)  # fmt: skip
"""What the verdict and the result read."""


@dataclass(slots=True, eq=False)
class Sweep:
    """The kinds of rows of a family, and how to evaluate them; every thread has functions of its own."""

    template: Template
    ranges: Ranges
    kinds: tuple[Kind, ...]
    codes: Mapping[str, NDArray[numpy.uint8]]
    """The interval in which each value of a word lies, by the word."""
    by_code: NDArray[numpy.int64]
    """The number of the kind by the intervals of all words."""
    local: threading.local = field(default_factory=threading.local)

    def columns(self) -> dict[str, type[numpy.generic]]:
        """The names and types of all results, in order."""
        found: dict[str, type[numpy.generic]] = {"status": numpy.uint8, "reason": numpy.uint8}
        for kind in self.kinds:
            if kind.status is None:
                found |= {f"branch.{point}": numpy.int8 for point in _branches(kind)}
        for kind in self.kinds:
            if kind.status is None:
                found |= dict.fromkeys(results_of(kind), numpy.float64)
        return {**found, "residual": numpy.float64}

    def empty(self, rows: int) -> Table:
        """Room for the results of so many rows; NaN and 0 where not every kind has all of them."""
        if len(self.kinds) == 1 and self.kinds[0].status is None:
            return {name: numpy.empty(rows, kind) for name, kind in self.columns().items()}
        return {
            name: numpy.full(rows, numpy.nan) if kind is numpy.float64 else numpy.zeros(rows, kind)
            for name, kind in self.columns().items()
        }

    def words(self, first: int, last: int) -> dict[str, Array]:
        """The values of the free words in these rows."""
        return {word: values[self.ranges.places(word, first, last)] for word, values in self.ranges.values.items()}

    def evaluate(self, first: int, last: int, table: Results) -> None:
        """Fill in the results of the rows from `first` to before `last`."""
        places = {word: self.ranges.places(word, first, last) for word in self.ranges.values}
        number = numpy.zeros(last - first, numpy.int64)
        if len(self.kinds) > 1:
            number = self.by_code[tuple(codes[places[word]] for word, codes in self.codes.items())]
        for each, kind in enumerate(self.kinds):
            is_all = len(self.kinds) == 1
            own = numpy.arange(last - first) if is_all else numpy.flatnonzero(number == each)
            if kind.status is not None:
                table["status"][own] = code_of(kind.status)
                continue
            for begin, end in stretches(own.size, ROWS):
                target: Target = slice(begin, end) if is_all else own[begin:end]
                part = {word: place[target] for word, place in places.items()}
                self._evaluate(each, kind, part, target, end - begin, table)

    def _evaluate(
        self,
        number: int,
        kind: Kind,
        places: Mapping[str, Rows],
        target: Target,
        rows: int,
        table: Results,
    ) -> None:
        function, inputs, results = self._function(number, kind)
        cosines: dict[str, Array] = {
            name: function.numbers[place : place + 1] for place, name in enumerate(function.compiled.fixed)
        }
        for place, name in enumerate(function.compiled.varied):
            word, values = inputs[name]
            numpy.take(values, places[word], out=function.inputs[place, :rows], mode="clip")
            cosines[name] = function.inputs[place, :rows]
        out = function.evaluate(rows)
        machine, figure = kind.machine, kind.system.figure
        verdict = Verdict(figure, machine.plan, machine.corner_residuals, cosines, out, rows)
        status, reason = verdict.status, verdict.reason
        again = numpy.flatnonzero(verdict.again)
        is_path = (status <= Code.OVERDETERMINED) & (reason == 0) & ~verdict.again
        without = numpy.flatnonzero(~is_path)
        for name, (output, offset) in results.items():
            if name.endswith(".room"):
                table[name][target] = out[output]
                continue
            if isinstance(target, slice):
                values = table[name][target]
                numpy.add(out[output], offset, out=values)
                values[without] = numpy.nan
            else:
                values = numpy.broadcast_to(out[output], rows) + offset
                values[without] = numpy.nan
                table[name][target] = values
        table["residual"][target] = verdict.worst
        for point, side in _branches(kind).items():
            table[f"branch.{point}"][target] = numpy.where(is_path, side, 0)
        table["status"][target] = status
        table["reason"][target] = reason
        at = numpy.arange(rows)[again] + target.start if isinstance(target, slice) else target[again]
        for row, place in zip(again.tolist(), at.tolist(), strict=True):
            single = {word: float(self.ranges.values[word][each[row]]) for word, each in places.items()}
            _fill(kind, kind.solve(single), place, table)

    def _function(self, number: int, kind: Kind) -> _Ready:
        """The function of a kind for this thread."""
        made = self.local.__dict__.setdefault("functions", {})
        if number not in made:
            inputs = kind.columns(self.ranges)
            function = Columns(_compile(kind.system, frozenset(inputs)))
            numbers = kind.numbers()
            function.numbers[:] = [numbers[name] for name in function.compiled.fixed]
            made[number] = function, inputs, results_of(kind)
        found: _Ready = made[number]
        return found


@lru_cache(maxsize=64)
def _compile(system: System, varied: frozenset[str]) -> ColumnFunction:
    """The function of a system for columns."""
    return compile_columns(compile_system(system).tape.keep(_OUTPUTS, system.unknowns), varied)


def prepare(template: Template, ranges: Ranges) -> Sweep:
    """The sweep of a block over ranges of its words. Raises FamilyError."""
    codes = classify(template, ranges)
    sizes = tuple(int(each.max()) + 1 for each in codes.values())
    by_code = numpy.full(sizes, -1, numpy.int64)
    kinds: list[Kind] = []
    for key, values in _examples(ranges, codes):
        kind = kind_of(template, values)
        same = next((number for number, each in enumerate(kinds) if alike(each, kind)), None)
        by_code[key] = len(kinds) if same is None else same
        if same is None:
            kinds.append(kind)
    return Sweep(template, ranges, tuple(kinds), codes, by_code)


def _examples(
    ranges: Ranges, codes: Mapping[str, NDArray[numpy.uint8]]
) -> Iterator[tuple[tuple[int, ...], dict[str, float]]]:
    """One row for each set of intervals."""
    if ranges.is_paired:
        keys, firsts = numpy.unique(numpy.stack(list(codes.values()), axis=1), axis=0, return_index=True)
        for key, row in zip(keys.tolist(), firsts.tolist(), strict=True):
            yield tuple(key), {word: float(values[row]) for word, values in ranges.values.items()}
        return
    found = [
        zip(*(part.tolist() for part in numpy.unique(each, return_index=True)), strict=True) for each in codes.values()
    ]
    for choice in product(*found):
        key = tuple(code for code, _ in choice)
        pairs = zip(ranges.values.items(), choice, strict=True)
        yield key, {word: float(values[place]) for (word, values), (_, place) in pairs}


def _branches(kind: Kind) -> dict[str, int]:
    """The sides that the words choose, by the point: +1 farther or left, -1 nearer or right."""
    shown = kind.profile.intersections
    return {choice.point: choice.side.sign for choice in kind.profile.choices if choice.given and choice.point in shown}


def results_of(kind: Kind) -> dict[str, tuple[str, float]]:
    """The output behind each result, and what is added to it: coordinates count from the start point inside."""
    profile, figure = kind.profile, kind.system.figure
    origin = [float(value or 0) for value in profile.start.values]
    axes = list(zip((FIRST, SECOND), profile.plane.axes, origin, strict=True))
    found: dict[str, tuple[str, float]] = {}
    for point in figure.points:
        found |= {f"{point}.{letter}": (scalar(point, axis), offset) for axis, letter, offset in axes}
    found |= {f"{radius}": (radius, 0.0) for radius in figure.radii}
    for corner in figure.corners:
        for place in ("begin", "end", *(("center",) if corner.shape is CornerShape.FILLET else ())):
            for axis, letter, offset in axes:
                found[f"{corner.name}.{place}.{letter}"] = f"{place}:{corner.name}.{axis}", offset
    return found | {f"{element.name}.room": (f"room:{element.name}", 0.0) for element in figure.path}


def _fill(kind: Kind, solution: Solution, row: int, table: Results) -> None:
    """The results of a single solve in a row."""
    table["status"][row] = code_of(solution.status)
    table["reason"][row] = reason_of(solution.refusals[0].kind if solution.refusals else None)
    if not solution.points:
        return
    letters = kind.profile.plane.axes
    for radius, value in solution.radii.items():
        table[radius][row] = value
    pairs = dict(solution.points)
    del pairs[kind.system.figure.start]
    for name, corner in solution.corners.items():
        pairs |= {f"{name}.begin": corner.begin, f"{name}.end": corner.end}
        pairs |= {f"{name}.center": corner.center} if corner.center is not None else {}
    for name, pair in pairs.items():
        for letter, value in zip(letters, pair, strict=True):
            table[f"{name}.{letter}"][row] = value
    touching = {remark.subject for remark in solution.remarks if remark.kind is RemarkKind.TOUCHES}
    for point, side in _branches(kind).items():
        table[f"branch.{point}"][row] = 0 if point in touching else side
