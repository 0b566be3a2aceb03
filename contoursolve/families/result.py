"""What a family comes to: named arrays with a row for every set of values."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from contoursolve.families.export import to_arrow, to_parquet, to_xarray
from contoursolve.families.measures import Measure, measures_of
from contoursolve.families.ranges import Ranges
from contoursolve.families.recipe import Recipe
from contoursolve.shown import Shown
from contoursolve.solving import Status
from contoursolve.solving.verdict import Code


@dataclass(frozen=True, slots=True, eq=False)
class Family(Shown):
    """Every contour of a family as named arrays.

    `family[name]` has the shape (rows,) for paired words, and one axis for each word, in their order, for a grid. The
    names, in mm with X of a lathe as radius, whatever the unit of the block:

    * the free words, as written: in the unit of the block, X of a lathe as diameter (float64);
    * `status` (uint8, see `Code`) and `reason` (uint8, an index of `REASONS`; 0 for none);
    * `branch.P1` (int8): the side that the block chooses, +1 farther or left, -1 nearer or right, 0 where there is no
      contour or both are one;
    * `V1.Z`, `V1.X`: the points; `r`: radii; `corner 1.begin.Z`, `.end`, `.center`: the corners (float64, NaN where
      there is no contour, or no such corner);
    * `asked.P`: what is asked for with `?`, mm (radius) or degrees (float64, NaN where there is no contour);
    * `line 1.room` (float64): what the corners leave of an element, below 0 if they do not fit; it has a value wherever
      the points have one;
    * `residual` (float64): the largest residual of the equations that were solved, the corners' among them.
    """

    ranges: Ranges
    columns: Mapping[str, NDArray[Any]]
    recipe: Recipe | None = field(default=None, repr=False)
    """Plain data from which its block can be read again."""

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
        places = self.ranges.places(name, 0, self.ranges.count)
        return self.ranges.values[name][places].reshape(self.shape)

    def __len__(self) -> int:
        return self.ranges.count

    @property
    def has_contour(self) -> NDArray[numpy.bool_]:
        """Where there is a contour: solved, or with words that agree; and nothing speaks against it."""
        is_solved = (self["status"] <= Code.OVERDETERMINED) & (self["reason"] == 0)
        return numpy.asarray(is_solved)

    def summary(self) -> dict[Status, int]:
        """How many rows have each status, without those that none has."""
        return summary_of(numpy.bincount(self.columns["status"], minlength=len(Code)))

    def measures(self) -> dict[str, Measure]:
        """What each array is measured in, by name; empty where it is not known from what block they come."""
        if self.recipe is None:
            return {}
        row = {word: float(values[0]) for word, values in self.ranges.values.items()}
        return measures_of(self.recipe.template(), row, self.names)

    def to_arrow(self) -> Any:
        """A pyarrow.Table with a column for each array: `status` and `reason` in words, as dictionaries (no reason is
        null), and with each field its `unit` as metadata, for X of a lathe with the `measure` radius or diameter.
        Raises MissingExtraError without pyarrow."""
        return to_arrow({name: self[name].reshape(-1) for name in self.names}, self.measures())

    def to_parquet(self, path: str | Path) -> None:
        """Write that table to a Parquet file. Raises MissingExtraError without pyarrow."""
        to_parquet({name: self[name].reshape(-1) for name in self.names}, self.measures(), path)

    def to_xarray(self) -> Any:
        """An xarray.Dataset whose dimensions are the free words, or `row`; every variable has its `units` as an
        attribute, `status` and `reason` the meanings of their numbers. Raises MissingExtraError without xarray."""
        arrays = {name: self[name] for name in self.columns}
        return to_xarray(dict(self.ranges.values), arrays, self.measures(), is_paired=self.ranges.is_paired)


def summary_of(counts: NDArray[Any]) -> dict[Status, int]:
    """The counts by `Code` as counts by status."""
    return {code.status: int(counts[code]) for code in Code if counts[code]}
