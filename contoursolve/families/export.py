"""Family as named arrays with a row for every set of values, their units, and the formats of other packages, which are
needed only here.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, NoReturn

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.diagnosis import Answer, join
from contoursolve.diagnostics import LateModule, Shown, from_above, need
from contoursolve.families.block_template import SweepSpec, Template, word_named
from contoursolve.families.case_classes import asked_of
from contoursolve.families.errors import FamilyError
from contoursolve.families.free_words import kind_of
from contoursolve.families.results import ResultNames, lengths_of
from contoursolve.families.versions import versions
from contoursolve.families.word_values import TOOL, Ranges, are_same
from contoursolve.gcode import Word, open_whole, write_whole
from contoursolve.geometry import Unit
from contoursolve.reading import Premises
from contoursolve.solving import REASONS, STATUSES, Contour, Status

if TYPE_CHECKING:
    import pyarrow
    import xarray
else:
    pyarrow, xarray = LateModule("pyarrow"), LateModule("xarray")

SOLUTION = "solution"
"""The axis of the solutions of each row."""


class Measure(Struct, frozen=True):
    """The unit of a column (mm, inch, deg; empty for one without), and where it matters whether it is the `radius` or
    the `diameter` that is meant."""

    unit: str
    measure: str = ""

    def attributes(self, unit: str = "unit") -> dict[str, str]:
        """As plain names and texts, where the unit goes by this name."""
        found = {unit: self.unit, "measure": self.measure}
        return {name: text for name, text in found.items() if text}


def measures_of(template: Template, ranges: Ranges, columns: Iterable[str]) -> dict[str, Measure]:
    """The measures of the words and of some columns."""
    answer = template.solve({word: float(ranges.values[word][0]) for word in template.words})
    plane = answer.plane
    diameters = {axis for axis, is_diameter in zip(plane.axes, plane.diameters, strict=True) if is_diameter}
    asked = asked_of(answer.profile)
    found: dict[str, Measure] = {}
    for name in (*ranges.values, *columns):
        axis = name.rpartition(" ")[2]
        if name in template.words:
            found[name] = measure_of_word(template.words[name], answer)
        elif name in ("status", "reason", "tool.fits", "tool.fault") or name.startswith("branch."):
            found[name] = Measure("")
        elif name == TOOL:
            found[name] = Measure(answer.unit.value)
        elif name in asked:
            is_angle = asked[name].unit is Unit.DEGREE
            found[name] = Measure("deg" if is_angle else "mm", "diameter" if asked[name].is_diameter else "")
        else:
            found[name] = Measure("mm", "diameter" if axis in diameters else "")
    return found


def measure_of_word(word: Word, answer: Answer) -> Measure:
    """The unit of a word of a block or of the start point, or of a fact; none for one that only chooses between two
    places, and where nothing tells."""
    try:
        kind, is_diameter = kind_of(word, answer)
    except FamilyError:
        return Measure("")
    if kind is not Unit.MM:
        return Measure("deg" if kind is Unit.DEGREE else "")
    return Measure(answer.unit.value, "diameter" if is_diameter else "")


@dataclass(frozen=True, slots=True, eq=False)
class Family(Shown):
    """Every contour of a family as named arrays.

    `family[name]` has the shape (rows,) for paired words, and one axis for each word, in their order, for a grid. The
    names of results, in mm with X of a lathe as diameter, whatever the unit of the block:

    * the free words, as written: in the unit of the block, X of a lathe as diameter (float64);
    * `status` (uint8, an index of `STATUSES`) and `reason` (uint8, an index of `REASONS`; 0 for none);
    * `branch.P1` (int8): the side that the block chooses: +1 farther or left, -1 nearer or right; 0 where there is no
      contour, or both are one;
    * `V1 Z`, `V1 X`: the points; `r`: radii; `corner 1.begin Z`, `.end`, `.center`: the corners (float64, NaN where
      there is no contour, or no such corner);
    * `asked.P`: what is asked for with `?`, mm (X as diameter) or degrees (float64, NaN where there is no contour);
    * `line 1.room` (float64): what the corners leave of an element, below 0 if they do not fit; it has a value wherever
      the points have one;
    * `residual` (float64): by how much the solved equations are off at most, the corners' among them.

    A result goes by each of its names: `end Z` and `corner 2.end Z`, `V1 Z` and `Z of V1` are also read.

    With all branches, each array has a last axis for the `solutions`, and `solution(name)` is the family of one alone.

    Attributes:
        ranges: the values of the free words, as they are written.
        columns: all other arrays by name, flat: (rows,), or (rows, solutions) with all branches.
        spec: plain data from which its block can be read again.
        premises: what its contours assume besides the words.
        remark: that rows are read one by one, and why; empty if they are not.
        solutions: the names of the solutions along the last axis, as `list_solutions` tells them apart; none without
            that axis. A row that lacks one has no points there, and the status `no-solution`.
    """

    ranges: Ranges
    columns: Mapping[str, NDArray[Any]]
    spec: SweepSpec = field(repr=False)
    premises: Premises = field(default=Premises(), repr=False)
    remark: str = field(default="", repr=False)
    solutions: tuple[str, ...] = ()

    def __eq__(self, other: object) -> bool:
        names = (each.name for each in fields(self))
        return isinstance(other, Family) and all(are_same(getattr(self, name), getattr(other, name)) for name in names)

    def __hash__(self) -> int:
        return hash((self.names, self.shape))

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of every array."""
        return (*self.ranges.shape, len(self.solutions)) if self.solutions else self.ranges.shape

    def solution(self, name: str) -> "Family":
        """The family of one of the solutions. Raises KeyError for a name that is none of theirs."""
        if name not in self.solutions:
            raise KeyError(f"{name}; there are {', '.join(self.solutions) or 'no solutions beside the chosen one'}")
        place = self.solutions.index(name)
        return replace(self, columns={key: each[:, place] for key, each in self.columns.items()}, solutions=())

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all arrays."""
        return (*self.ranges.values, *self.columns)

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name in self.columns:
            return self.columns[name].reshape(self.shape)
        word = name if name in self.ranges.values else self._word(name)
        if word is None:
            try:
                column = self._results.column(name)
            except FamilyError as error:
                raise KeyError(f"{error}; the arrays are {', '.join(self.names)}") from None
            return self.columns[column].reshape(self.shape) if column else self.result(name)
        name = word
        values = self.ranges.values[name][self.ranges.places(name, 0, self.ranges.count)]
        return values.repeat(len(self.solutions) or 1).reshape(self.shape)

    def __contains__(self, name: object) -> bool:
        try:
            self[name]  # type: ignore[index]
        except (KeyError, TypeError):
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def keys(self) -> tuple[str, ...]:
        """The names of all arrays: `dict(family)` has them with their arrays."""
        return self.names

    def __len__(self) -> int:
        return self.ranges.count

    def contour(self, values: Mapping[str, float] | None = None, /, **words: float) -> Contour:
        """The contour of some values of the free words, as they are written, whether a row has them or not:
        `family.contour(A=175, P=2)`, `family.contour({"2:X": 80})`. A word with a single value needs none.

        Raises FamilyError for words that are not free, for free ones without a value, and where there is no contour."""
        single = {name: at.item() for name, at in self.ranges.values.items() if at.size == 1}
        template, free = self.spec.template(), self.ranges.values.keys()
        told = {**single, **{self._word(name) or name: value for name, value in {**(values or {}), **words}.items()}}
        if told.keys() != free:
            raise FamilyError(f"the free words are {join(list(free))}; give each of them a value, and no other")
        answer = template.solve({name: float(told[name]) for name in free})
        if answer.contour is None:
            place = join([f"{name} = {told[name]:g}" for name in free])
            reasons = "; ".join(each.message for each in answer.diagnostics if each.is_error)
            raise FamilyError(f"there is no contour at {place}: {reasons or answer.status.value}")
        return answer.contour

    @property
    def origin(self) -> dict[str, str]:
        """The block, how it is read, and what its contours rest on; see `origin_of`."""
        return origin_of(self.spec, self.premises)

    @property
    def has_contour(self) -> NDArray[numpy.bool_]:
        """Mask of the rows with a contour: solved, or with words that agree; and nothing speaks against it."""
        is_solved = (self["status"] <= Status.OVERDETERMINED.code) & (self["reason"] == 0)
        return numpy.asarray(is_solved)

    @property
    def results(self) -> tuple[str, ...]:
        """The names that `result` takes."""
        return tuple(self._results.known)

    def result(self, name: str) -> NDArray[numpy.float64]:
        """One result of each contour, and NaN where there is none: `end Z`, `V1 X`, `corner 1.center Z`,
        `straight part of line 1`, and the `length` of the path; mm, X of a lathe as diameter. Raises FamilyError for a
        name that is none."""
        names = self._results
        column = names.column(name)
        values = self.columns[column] if column else lengths_of(self.columns, names.plane)
        return numpy.where(self.has_contour, values.reshape(self.shape), numpy.nan)

    def measure_of(self, name: str) -> Measure:
        """The unit of a result. Raises FamilyError for a name that is none."""
        column = self._results.column(name)
        return self.measures()[column] if column else Measure("mm")

    def full_name(self, name: str) -> str:
        """The name of a result as `results` has it. Raises FamilyError for a name that is none."""
        return self._results.printed(name)

    @property
    def _results(self) -> ResultNames:
        """The names of the results."""
        template = self.spec.template()
        answer = template.solve({word: float(self.ranges.values[word][0]) for word in template.words})
        return ResultNames(answer.profile, (name for name, each in self.columns.items() if each.dtype.kind == "f"))

    def _word(self, name: str) -> str | None:
        """The free word of a name; None for what is none."""
        try:
            return word_named(name, self.spec.template())
        except (FamilyError, TypeError):
            return None

    def summary(self) -> dict[Status, int]:
        """The number of rows with each status, without those that none has."""
        return summary_of(numpy.bincount(self.columns["status"].reshape(-1), minlength=len(STATUSES)))

    def measures(self) -> dict[str, Measure]:
        """The unit of each array, by name."""
        return measures_of(self.spec.template(), self.ranges, self.columns)

    def plot(self, ax: Any = None, *, words: tuple[str, str] | None = None, result: str | None = None) -> Any:
        """Draw the map of two words on `ax`, axes of matplotlib, or on the current ones, and return them; see `plot` of
        `FeasibleRegion`. Raises ValueError where these are not two words of a grid with two or more values each."""
        return from_above("plot_record", self, ax, words=words, result=result)

    def to_arrow(self) -> "pyarrow.Table":
        """A pyarrow.Table with a column for each array: `status` and `reason` in words, as dictionaries (no reason is
        null), and with each field its `unit` as metadata, for X of a lathe with the `measure` radius or diameter; its
        own metadata are `origin`. Raises MissingExtraError without pyarrow."""
        return to_arrow(self._table(), self.measures(), self.origin)

    def _table(self) -> dict[str, NDArray[Any]]:
        """The columns of a table: of several solutions, each in a row of its own, with its name."""
        found = {name: self[name].reshape(-1) for name in self.ranges.values}
        if self.solutions:
            found[SOLUTION] = numpy.array(self.solutions, object)[
                numpy.arange(self["status"].size) % len(self.solutions)
            ]
        return found | {name: self[name].reshape(-1) for name in self.columns}

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        """The same as a stream of Arrow, by which other packages take it: `polars.DataFrame(family)`,
        `pandas.DataFrame.from_arrow(family)`."""
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def __array__(self, *_: Any, **__: Any) -> NoReturn:
        """No array by itself: `pandas.DataFrame(family)` would take its names for values."""
        raise TypeError(
            "a family is no array, but has one for each name, such as family['status']; "
            "its table is pandas.DataFrame.from_arrow(family), and its axes are those of family.to_xarray()"
        )

    def to_parquet(self, path: str | Path) -> None:
        """Write that table to a Parquet file; errors as for `to_csv`. Raises MissingExtraError without pyarrow."""
        with open_whole(Path(path)) as whole:
            write_parquet(whole.file, [self._table()], self.measures(), self.origin)

    def to_csv(self, path: str | Path) -> None:
        """Write that table as comma-separated values, the names first; status and reason in words, nothing for NaN.
        Raises CannotWriteError where there can be no such file; one that is there stays as it is until all is
        written."""
        write_whole(Path(path), (line.encode() for line in csv_lines([self._table()])), keeps_backup=False)

    def to_xarray(self) -> "xarray.Dataset":
        """An xarray.Dataset whose dimensions are the free words, or `row`; every variable has its `units` as an
        attribute, `status` and `reason` the meanings of their numbers; its own are `origin`. Raises MissingExtraError
        without xarray."""
        arrays = {name: self[name] for name in self.columns}
        found = to_xarray(
            dict(self.ranges.values), arrays, self.measures(), self.solutions, is_paired=self.ranges.is_paired
        )
        found.attrs.update(self.origin)
        return found


def origin_of(spec: SweepSpec, premises: Premises) -> dict[str, str]:
    """A block with how it is read, what its contours rest on, and the versions of what computed them, as plain names
    and texts: they go with the tables and arrays of other packages."""
    found = {
        "block": spec.block,
        "start": spec.start or "",
        "control": premises.control or (spec.control if isinstance(spec.control, str) else ""),
        "units": spec.units,
        "rules": spec.rules,
        "facts": "; ".join(spec.facts),
        "settings": "; ".join(f"{each.setting.name}={each.value}" for each in premises.conventions),
        "assumptions": "; ".join(each.meaning for each in premises.assumptions),
        "versions": ", ".join(versions()),
    }
    return {name: text for name, text in found.items() if text}


def summary_of(counts: NDArray[Any]) -> dict[Status, int]:
    """The counts by the number of each status as counts by status."""
    return {status: int(counts[status.code]) for status in STATUSES if counts[status.code]}


_WORDS: Mapping[str, list[str | None]] = {
    "status": [status.value for status in STATUSES],
    "reason": [kind.value if kind else None for kind in REASONS],
}
"""Meanings of the numbers of two columns."""

Measures = Mapping[str, Measure]
"""Units of columns, by name."""


def to_arrow(
    columns: Mapping[str, NDArray[Any]], measures: Measures, origin: Mapping[str, str] | None = None
) -> "pyarrow.Table":
    """A pyarrow.Table: `status` and `reason` as dictionaries of words (null without a reason), and with each field its
    `unit`, and whether a radius or a diameter is meant, as metadata; `origin` is the metadata of the whole."""
    arrow = need("pyarrow", "family", "a family as an Arrow table")
    fields, arrays = [], []
    for name, values in columns.items():
        array = arrow.array(values)
        if name in _WORDS:
            array = _in_words(arrow, values, _WORDS[name])
        arrays.append(array)
        metadata = measures[name].attributes() if name in measures else {}
        fields.append(arrow.field(name, array.type, metadata=metadata or None))
    return arrow.Table.from_arrays(arrays, schema=arrow.schema(fields, metadata=origin or None))


def _in_words(arrow: Any, values: NDArray[Any], words: list[str | None]) -> Any:
    """Numbers as words; the indices have the type that Parquet gives back."""
    known = [word for word in words if word is not None]
    indices = values.astype(numpy.int32) - (len(words) - len(known))
    return arrow.DictionaryArray.from_arrays(arrow.array(indices, mask=indices < 0), arrow.array(known))


def to_xarray(
    axes: Mapping[str, NDArray[Any]],
    arrays: Mapping[str, NDArray[Any]],
    measures: Measures,
    solutions: Sequence[str] = (),
    *,
    is_paired: bool,
) -> "xarray.Dataset":
    """An xarray.Dataset: along the words of a grid, or along `row`, and along `solution` if there are several; with
    `units` and `measure` as attributes, and for `status` and `reason` what their numbers stand for, as the CF
    conventions name it."""
    dims = ("row",) if is_paired else tuple(axes)
    attributes: dict[str, dict[str, Any]] = {name: each.attributes("units") for name, each in measures.items()}
    for name, words in _WORDS.items():
        meanings = " ".join(word or "none" for word in words)
        attributes[name] = {"flag_values": numpy.arange(len(words), dtype=numpy.uint8), "flag_meanings": meanings}
    coordinates = {
        word: (("row",) if is_paired else (word,), values, attributes.get(word, {})) for word, values in axes.items()
    }
    if solutions:
        dims, coordinates[SOLUTION] = (*dims, SOLUTION), ((SOLUTION,), numpy.array(solutions), {})
    variables = {name: (dims, each, attributes.get(name, {})) for name, each in arrays.items()}
    found: xarray.Dataset = need("xarray", "family", "a family as labelled arrays").Dataset(variables, coordinates)
    return found


def write_parquet(
    path: str | Path | BinaryIO,
    tables: Iterable[Mapping[str, NDArray[Any]]],
    measures: Measures,
    origin: Mapping[str, str] | None = None,
) -> None:
    """A Parquet file with a row group for each table, and `origin` as its metadata."""
    parquet, writer = need("pyarrow.parquet", "family", "a Parquet file"), None
    try:
        for columns in tables:
            table = to_arrow(columns, measures, origin)
            writer = writer or parquet.ParquetWriter(path, table.schema)
            writer.write_table(table)
    finally:
        if writer is not None:
            writer.close()


def csv_lines(tables: Iterable[Mapping[str, NDArray[Any]]]) -> Iterator[str]:
    """Lines of comma-separated values, the names first; status and reason in words, and nothing for NaN."""
    is_first = True
    for columns in tables:
        if is_first:
            yield ",".join(columns) + "\n"
            is_first = False
        texts = [_cells(name, values.tolist()) for name, values in columns.items()]
        yield from (",".join(row) + "\n" for row in zip(*texts, strict=True))


def _cells(name: str, values: list[Any]) -> list[str]:
    if name in _WORDS:
        return [_WORDS[name][value] or "" for value in values]
    return ["" if value != value else value if isinstance(value, str) else repr(value) for value in values]
