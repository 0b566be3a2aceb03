"""A family of contours: one block, some words free, a row for every set of values."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy
from numpy.typing import ArrayLike, NDArray

from contoursolve import syntax
from contoursolve.dialects import DIALECTS
from contoursolve.examine import Policy
from contoursolve.families.export import to_arrow, to_parquet, to_xarray
from contoursolve.families.ranges import FamilyError, Ranges, ranges_of, stretches
from contoursolve.families.sweep import Sweep, prepare
from contoursolve.families.template import Template, find_words
from contoursolve.families.verdict import Code
from contoursolve.model import Length
from contoursolve.pipeline import UnknownControlError, recognise
from contoursolve.project import configure
from contoursolve.solving import Status

STRETCH = 65_536
"""Rows that are evaluated, or written to a file, at once."""


@dataclass(frozen=True, slots=True, eq=False)
class Family:
    """Every contour of a family as named arrays.

    `family[name]` has the shape (rows,) for paired words, and one axis for each word, in their order, for a grid. The
    names, in mm with X of a lathe as radius:

    * the free words, as written (float64);
    * `status` (uint8, see `Code`) and `reason` (uint8, an index of `REASONS`; 0 for none);
    * `branch.P1` (int8): the side that the block chooses, +1 farther or left, -1 nearer or right, 0 where there is no
      contour or both are one;
    * `V1.Z`, `V1.X`: the points; `r`: radii; `corner 1.begin.Z`, `.end`, `.center`: the corners (float64, NaN where
      there is no contour, or no such corner);
    * `line 1.room` (float64): what the corners leave of an element, below 0 if they do not fit; it has a value wherever
      the points have one;
    * `residual` (float64): the largest residual of the equations that were solved, the corners' among them.
    """

    ranges: Ranges
    columns: Mapping[str, NDArray[Any]]

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of every array."""
        return self.ranges.shape

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all arrays."""
        return (*self.ranges.values, *self.columns)

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name in self.columns:
            return self.columns[name].reshape(self.shape)
        if name not in self.ranges.values:
            raise KeyError(f"{name}; there are {', '.join(self.names)}")
        rows = numpy.arange(self.ranges.count)
        return self.ranges.values[name][self.ranges.places(name, rows)].reshape(self.shape)

    def __len__(self) -> int:
        return self.ranges.count

    def summary(self) -> dict[Status, int]:
        """How many rows have each status, without those that none has."""
        return summary_of(numpy.bincount(self.columns["status"], minlength=len(Code)))

    def to_arrow(self) -> Any:
        """A pyarrow.Table with a column for each array. Raises MissingExtraError without pyarrow."""
        return to_arrow({name: self[name].reshape(-1) for name in self.names})

    def to_parquet(self, path: str) -> None:
        """Write that table to a Parquet file. Raises MissingExtraError without pyarrow."""
        to_parquet({name: self[name].reshape(-1) for name in self.names}, path)

    def to_xarray(self) -> Any:
        """An xarray.Dataset whose dimensions are the free words, or `row`. Raises MissingExtraError without xarray."""
        arrays = {name: self[name] for name in self.columns}
        return to_xarray(dict(self.ranges.values), arrays, is_paired=self.ranges.is_paired)


def summary_of(counts: NDArray[Any]) -> dict[Status, int]:
    """The counts by `Code` as counts by status."""
    return {code.status: int(counts[code]) for code in Code if counts[code]}


def sweep(
    block: str,
    *,
    vary: Mapping[str, ArrayLike],
    start: str | None = None,
    control: str | None = None,
    paired: bool = False,
    units: str = "mm",
    rules: str = "enforce",
    settings: Mapping[str, str] | None = None,
) -> Sweep:
    """A family that is ready to be evaluated; arguments and errors as for `family`."""
    program = syntax.parse(block, "<block>")
    dialect = DIALECTS.get(control) if control else recognise(program)
    if dialect is None:
        told = f"unknown control {control!r}" if control else "the block does not tell its control; name it"
        raise UnknownControlError(f"{told}; choose from {', '.join(DIALECTS)}")
    dialect = (configure(settings) if settings else {}).get(dialect.name, dialect)
    beginning = syntax.parse(start, "<start>", first_line=0) if start is not None else None
    ranges = ranges_of(vary, is_paired=paired)
    words = find_words(program, list(ranges.values))
    return prepare(Template(program, dialect, Length(units), Policy(rules), beginning, words), ranges)


def family(
    block: str,
    *,
    vary: Mapping[str, ArrayLike],
    start: str | None = None,
    control: str | None = None,
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
        control: `yasnac-lx3` or `nct-99m`; found from the block where it is clear.
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
    if workers < 1:
        raise FamilyError(f"workers is {workers}; it must be at least 1")
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
