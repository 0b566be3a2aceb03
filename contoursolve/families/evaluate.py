"""Solves a contour for many values of some of its words, with any executor, and tells why no row has a contour."""

import pickle
import threading
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace as replace_fields
from functools import lru_cache, partial
from typing import TypeVar, Unpack

import numpy
from msgspec import Struct, field
from msgspec.structs import replace
from numpy.typing import ArrayLike, NDArray

from contoursolve.controls import ControlName
from contoursolve.diagnostics import choice_of
from contoursolve.families.block_template import (
    BlockOptions,
    Branches,
    BranchesName,
    SweepSpec,
    Template,
    errors_of,
    message_of,
    spec_of,
)
from contoursolve.families.branch_rows import count_solutions
from contoursolve.families.compiled_sweep import CompiledSweep, Table, cases_of
from contoursolve.families.errors import FamilyError
from contoursolve.families.export import Family
from contoursolve.families.free_words import Examples, check_block, examples_of
from contoursolve.families.solutions_of_rows import names_of_solutions, without_defaults
from contoursolve.families.word_values import TOOL, Ranges, ranges_of, stretches
from contoursolve.numeric import Array
from contoursolve.program import Rules, Units
from contoursolve.reading import Control
from contoursolve.solving import REASONS, STATUSES, Status

STRETCH = 65_536
"""Rows that are evaluated, or written to a file, at once."""

AHEAD = 8
"""Stretches that an executor has under way at once, if `workers` does not say it."""


Result = TypeVar("Result")

THREADS = "contoursolve"
"""Prefix of the names of the threads."""


@contextmanager
def threads(count: int) -> Iterator[Executor | None]:
    """Threads as an executor; none for one. Whoever presses Ctrl-C does not wait for what they have under way, which
    may be minutes."""
    if count <= 1:
        yield None
        return
    executor = ThreadPoolExecutor(count, THREADS)
    is_waiting = True
    try:
        yield executor
    except KeyboardInterrupt:
        is_waiting = False
        raise
    finally:
        executor.shutdown(wait=is_waiting, cancel_futures=not is_waiting)


def in_order(tasks: Iterable[Callable[[], Result]], executor: Executor | None, ahead: int) -> Iterator[Result]:
    """The results of tasks in their order, of which at most one more than `ahead` are under way or waiting to be taken;
    without an executor, one after the other. An error of a task ends all of them, and is raised with its traceback."""
    if executor is None:
        yield from (task() for task in tasks)
        return
    waiting: deque[Future[Result]] = deque()
    try:
        for task in tasks:
            waiting.append(executor.submit(task))
            if len(waiting) > ahead:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        for future in waiting:
            future.cancel()


def sweep(
    block: str,
    *,
    vary: Mapping[str, ArrayLike],
    paired: bool = False,
    branches: Branches = Branches.CHOSEN,
    **options: Unpack[BlockOptions],
) -> CompiledSweep:
    """A family that is ready to be evaluated; arguments and errors as for `family`."""
    ranges = ranges_of(vary, is_paired=paired)
    return compile_sweep(spec_of(block, branches=branches, **options), ranges)


def compile_sweep(spec: SweepSpec, ranges: Ranges, before: CompiledSweep | None = None) -> CompiledSweep:
    """The sweep of a case over some values, whatever words it had free, with the functions of one `before` if that
    has them for all these values; errors as for `family`."""
    if before is not None and before.covers(ranges):
        return replace(before, ranges=ranges)
    template = replace(spec, names=tuple(ranges.values)).template()
    spec, ranges = replace(spec, names=tuple(template.words)), ranges.named(template.words)
    ready = _compiled(spec, examples_of(template, ranges), ranges, template)
    if all(case.status is not None for case in ready.cases):
        check_block(template, dict(zip(template.words, ready.examples.rows[0].values, strict=True)))
    return ready


def _compiled(spec: SweepSpec, examples: Examples, ranges: Ranges, template: Template) -> CompiledSweep:
    cases, numbers, by_row = cases_of(template, examples)
    if spec.branches is Branches.ALL:
        cases = tuple(map(without_defaults, cases))
    return CompiledSweep(spec, examples, ranges, template, cases, numbers, by_row)


def family(
    block: str,
    *,
    vary: Mapping[str, ArrayLike],
    start: str | Mapping[str, float] | None = None,
    control: ControlName | Control | None = None,
    facts: Iterable[str] = (),
    paired: bool = False,
    units: Units = "mm",
    rules: Rules = "enforce",
    settings: Mapping[str, str] | None = None,
    variables: Mapping[str, float] | None = None,
    workers: int | None = None,
    executor: Executor | None = None,
    branches: BranchesName = "chosen",
) -> Family:
    """A contour solved for many values of some of its words; see `contoursolve.family`."""
    ready = sweep(
        block,
        vary=vary,
        start=start,
        control=control,
        facts=facts,
        paired=paired,
        units=units,
        rules=rules,
        settings=settings,
        variables=variables,
        branches=choice_of(Branches, branches, "branches"),
    )
    if ready.spec.branches is Branches.ALL:
        return _solve_all(ready, workers, executor)
    return solve_sweep(ready, workers, executor)


def _solve_all(ready: CompiledSweep, workers: int | None, executor: Executor | None) -> Family:
    """All rows of a sweep, each with all of its solutions."""
    count = max(map(count_solutions, ready.cases))
    found = [
        solve_sweep(replace(ready, only=number, local=threading.local()), workers, executor) for number in range(count)
    ]
    # Most signs of a root may belong to no contour.
    found = [each for each in found if each.has_contour.any()] or found[:1]
    names = names_of_solutions(ready, found)
    found = [each for _, each in sorted(zip(names, found, strict=True), key=lambda each: each[0])]
    columns = {name: numpy.stack([each.columns[name] for each in found], axis=-1) for name in found[0].columns}
    return replace_fields(found[0], columns=columns, solutions=tuple(name for _, name in sorted(names)))


def rows_of(ready: CompiledSweep) -> Iterator[tuple[int, int]]:
    """The rows of a sweep in stretches; however many, they take no memory."""
    return stretches(ready.ranges.count, STRETCH)


def _pool(ready: CompiledSweep, workers: int) -> AbstractContextManager[Executor | None]:
    return threads(min(workers, -(-ready.ranges.count // STRETCH)))


def solve_sweep(ready: CompiledSweep, workers: int | None = None, executor: Executor | None = None) -> Family:
    """All rows of a sweep; errors as for `family`."""
    count = _check_workers(workers)
    try:
        table = ready.empty(ready.ranges.count)
    except MemoryError as error:
        told = "take fewer values, or write them to a file with `contoursolve family`"
        raise FamilyError(f"{ready.ranges.count:,} rows do not fit into memory ({error}); {told}") from None

    def fill(first: int, last: int) -> None:
        ready.evaluate(first, last, {name: column[first:last] for name, column in table.items()})

    if executor is not None:
        for (first, last), part in zip(
            rows_of(ready), solve_parts(ready, rows_of(ready), workers, executor), strict=True
        ):
            for name, column in table.items():
                column[first:last] = part[name]
        return Family(ready.ranges, table, ready.spec, ready.premises, ready.remark)
    with _pool(ready, count) as pool:
        for _ in in_order((partial(fill, *part) for part in rows_of(ready)), pool, count):
            pass
    return Family(ready.ranges, table, ready.spec, ready.premises, ready.remark)


def pieces(ready: CompiledSweep, workers: int | None = None, executor: Executor | None = None) -> Iterator[Table]:
    """The words and results of all rows in order, some thousands at a time, so that any number of rows takes no more
    memory than a few of these. Raises FamilyError for less than one worker."""
    for rows, part in zip(rows_of(ready), solve_parts(ready, rows_of(ready), workers, executor), strict=True):
        yield {**ready.ranges.rows(*rows).values, **part}


def solve_parts(
    ready: CompiledSweep,
    parts: Iterable[tuple[int, int]],
    workers: int | None = None,
    executor: Executor | None = None,
) -> Iterator[Table]:
    """The results of some stretches of rows, in order. Raises FamilyError for less than one worker."""
    count = _check_workers(workers)
    if executor is not None:
        packed = _pack(ready)
        tasks = (partial(solve_rows, packed, dict(ready.ranges.rows(*part).values)) for part in parts)
        yield from in_order(tasks, executor, AHEAD if workers is None else count)
        return
    with _pool(ready, count) as pool:
        yield from in_order((partial(_solve, ready, *part) for part in parts), pool, count)


def _pack(ready: CompiledSweep) -> bytes:
    """The data from which a family is made; functions of CasADi cannot be sent. Raises FamilyError."""
    try:
        return pickle.dumps((ready.spec, ready.examples, ready.only))
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise FamilyError(
            f"this control cannot be sent to an executor ({error}); its functions must stand in a module, by name"
        ) from None


def solve_rows(packed: bytes, values: dict[str, Array]) -> Table:
    """The results of some rows of a family, from plain data alone: what a worker is asked for."""
    ranges = Ranges(values, is_paired=True)
    return _solve(replace(_unpack(packed), ranges=ranges), 0, ranges.count)


@lru_cache(maxsize=16)
def _unpack(packed: bytes) -> CompiledSweep:
    """A packed sweep, with no values."""
    spec, examples, only = pickle.loads(packed)
    return replace(_compiled(spec, examples, Ranges({}, is_paired=True), spec.template()), only=only)


def _solve(ready: CompiledSweep, first: int, last: int) -> Table:
    table = ready.empty(last - first)
    ready.evaluate(first, last, table)
    return table


def _check_workers(workers: int | None) -> int:
    if workers is not None and workers < 1:
        raise FamilyError(f"workers is {workers}; it must be at least 1")
    return workers or 1


class FailureSummary(Struct, frozen=True):
    """The most frequent failure of a family: how many rows have it, and an example row, with its values as written and
    the first error that `solve` finds in it."""

    count: int
    values: Mapping[str, float]
    code: str
    message: str


CUT = "cut"
"""The name under which a contour is counted that a tool cuts, among what stops it."""


class Tally(Struct):
    """The number of rows with each status and reason, and the values of the first of each; where tools vary, too, those
    of contours, and for each radius how many it cuts, and how many it does not, by what stops it."""

    words: tuple[str, ...]
    counts: NDArray[numpy.int64] = field(
        default_factory=lambda: numpy.zeros((len(STATUSES), len(REASONS)), numpy.int64)
    )
    firsts: dict[tuple[int, int], dict[str, float]] = field(default_factory=dict)
    many: int = 1
    """Rows of each contour, one after the other."""
    rows: int = 0
    tools: dict[float, Counter[str]] = field(default_factory=dict)

    def add(self, table: Table) -> None:
        """Count some rows, in their order."""
        if TOOL in table:
            told = numpy.where(table["tool.fits"], CUT, table["tool.fault"])
            for (radius, kind), count in Counter(zip(table[TOOL].tolist(), told.tolist(), strict=True)).items():
                self.tools.setdefault(radius, Counter()).update({kind: count} if kind else {})
            firsts = numpy.arange(self.rows, self.rows + told.size) % self.many == 0
            self.rows, table = self.rows + told.size, {name: column[firsts] for name, column in table.items()}
        status, reason = table["status"], table["reason"]
        known = self.counts > 0
        numpy.add.at(self.counts, (status, reason), 1)
        for code, number in numpy.argwhere((self.counts > 0) & ~known).tolist():
            row = int(numpy.argmax((status == code) & (reason == number)))
            self.firsts[code, number] = {word: float(table[word][row]) for word in self.words}


def failure_summary(ready: CompiledSweep, tally: Tally) -> FailureSummary | None:
    """The most frequent failure; None where rows have different statuses, or a contour."""
    totals = tally.counts.sum(axis=1)
    code = int(totals.argmax())
    if totals[code] != totals.sum() or STATUSES[code] in (Status.SOLVED, Status.OVERDETERMINED):
        return None
    if all(case.status is not None for case in ready.cases):
        return _by_kinds(ready)
    number = int(tally.counts[code].argmax())
    values = tally.firsts[code, number]
    return FailureSummary(int(tally.counts[code, number]), values, *_error(ready, values))


def _by_kinds(ready: CompiledSweep) -> FailureSummary:
    """The same where rules tell of all rows: `reason` does not say which."""
    counts, firsts = dict[str, int](), dict[str, tuple[dict[str, float], str]]()
    for row in ready.examples.rows:
        values = dict(zip(ready.ranges.values, row.values, strict=True))
        code, message = _error(ready, values)
        counts[code] = counts.get(code, 0) + row.count
        firsts.setdefault(code, (values, message))
    most = max(counts, key=lambda code: counts[code])
    return FailureSummary(counts[most], firsts[most][0], most, firsts[most][1])


def _error(ready: CompiledSweep, values: Mapping[str, float]) -> tuple[str, str]:
    answer = ready.template.solve(values)
    errors = errors_of(answer)
    return (errors[0].code, message_of(errors[0], answer)) if errors else ("", "")
