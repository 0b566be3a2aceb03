"""Solves a contour for many values of some of its words."""

from collections import deque
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor

from numpy.typing import ArrayLike

from contoursolve import syntax
from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.examine import Policy
from contoursolve.families.prepared import Sweep, Table, prepare
from contoursolve.families.ranges import FamilyError, ranges_of, stretches
from contoursolve.families.result import Family
from contoursolve.families.template import Template, find_words
from contoursolve.model import Length
from contoursolve.pipeline import UnknownControlError, choose
from contoursolve.project import configure
from contoursolve.syntax import Program, Word

STRETCH = 65_536
"""Rows that are evaluated, or written to a file, at once."""


def sweep(
    block: str,
    *,
    vary: Mapping[str, ArrayLike],
    start: str | None = None,
    control: str | Dialect | None = None,
    paired: bool = False,
    units: str = "mm",
    rules: str = "enforce",
    settings: Mapping[str, str] | None = None,
) -> Sweep:
    """A family that is ready to be evaluated; arguments and errors as for `family`."""
    ranges = ranges_of(vary, is_paired=paired)
    template = template_of(
        block, start, control, units, rules, settings, lambda program: find_words(program, list(ranges.values))
    )
    return prepare(template, ranges)


def template_of(
    block: str,
    start: str | None,
    control: str | Dialect | None,
    units: str,
    rules: str,
    settings: Mapping[str, str] | None,
    free: Callable[[Program], Mapping[str, Word]],
) -> Template:
    """A block with those of its words free that are asked for; arguments and errors as for `family`."""
    program = syntax.parse(block, "<block>")
    dialect = choose(control, program)
    if dialect is None:
        raise UnknownControlError(f"the block does not tell its control; name it; choose from {', '.join(DIALECTS)}")
    dialect = (configure(settings, dialect) if settings else {}).get(dialect.name, dialect)
    beginning = syntax.parse(start, "<start>", first_line=0) if start is not None else None
    return Template(program, dialect, Length(units), Policy(rules), beginning, free(program))


def family(
    block: str,
    *,
    vary: Mapping[str, ArrayLike],
    start: str | None = None,
    control: str | Dialect | None = None,
    paired: bool = False,
    units: str = "mm",
    rules: str = "enforce",
    settings: Mapping[str, str] | None = None,
    workers: int = 1,
) -> Family:
    """Solve a contour for many values of some of its words.

    Args:
        block: the block, or the blocks of one contour; their words stand for one of the values.
        vary: the values of each free word, as written in the block: by its letter (`A`, `,A`), or with its line where
            several have it (`2:,A`).
        start: words that give the start point, such as `"X40. Z0."`, as the control reads them.
        control: `yasnac-lx3` or `nct-99m`, or a control of your own as its tables; found from the block where it is
            clear.
        paired: the values stand side by side, a row each; without it, every combination is a row.
        units: `mm` or `inch`, for numbers before any G20 or G21.
        rules: `enforce`, `warn` or `off` (see `Policy`).
        settings: conventions of the controls by `control.name`; the default ones without.
        workers: threads; the result is the same for any number.

    Every row has the status, the branch and the contour that `solve` gives the block with these values.

    Raises:
        FamilyError: a word is not there, the values are none, the blocks are no single contour with a known start, or
            their words need a search or leave a choice.
        UnknownControlError: the control is unknown, or the block does not tell it.

    >>> found = family("G111 X100. A180. K-30. B120. P5.", start="X40. Z0.", vary={"A": [180, 170], "P": [5, 20, 60]})
    >>> found["status"].tolist()
    [[0, 0, 6], [0, 0, 0]]
    >>> [f"{value:.4f}" for value in found["corner 1.end.X"][:, 0]]
    ['22.5000', '27.3090']
    """
    _check_workers(workers)
    ready = sweep(
        block, vary=vary, start=start, control=control, paired=paired, units=units, rules=rules, settings=settings
    )
    table = ready.empty(ready.ranges.count)

    def fill(stretch: tuple[int, int]) -> None:
        ready.evaluate(*stretch, {name: column[slice(*stretch)] for name, column in table.items()})

    parts = stretches(ready.ranges.count, STRETCH)
    if workers == 1 or len(parts) == 1:
        for part in parts:
            fill(part)
    else:
        with ThreadPoolExecutor(workers) as executor:
            for _ in executor.map(fill, parts):
                pass
    return Family(ready.ranges, table)


def pieces(ready: Sweep, workers: int = 1) -> Iterator[Table]:
    """The words and results of all rows in order, some thousands at a time, so that any number of rows takes no more
    memory than a few of these. Raises FamilyError for less than one worker."""
    _check_workers(workers)

    def fill(first: int, last: int) -> Table:
        table = ready.empty(last - first)
        ready.evaluate(first, last, table)
        return {**ready.words(first, last), **table}

    with ThreadPoolExecutor(workers) as executor:
        waiting: deque[Future[Table]] = deque()
        for part in stretches(ready.ranges.count, STRETCH):
            waiting.append(executor.submit(fill, *part))
            if len(waiting) > workers:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()


def _check_workers(workers: int) -> None:
    if workers < 1:
        raise FamilyError(f"workers is {workers}; it must be at least 1")
