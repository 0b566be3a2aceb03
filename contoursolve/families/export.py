"""Families in the formats of others; the packages for them are needed only here."""

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy
from numpy.typing import NDArray

from contoursolve.extras import need
from contoursolve.families.measures import Measure
from contoursolve.solving.verdict import REASONS, Code

_WORDS: Mapping[str, list[str | None]] = {
    "status": [code.status.value for code in Code],
    "reason": [kind.value if kind else None for kind in REASONS],
}
"""What the numbers of two columns stand for."""

Measures = Mapping[str, Measure]
"""What columns are measured in, by name."""


def to_arrow(columns: Mapping[str, NDArray[Any]], measures: Measures) -> Any:
    """A pyarrow.Table: `status` and `reason` as dictionaries of words (null without a reason), and with each field its
    `unit`, and whether a radius or a diameter is meant, as metadata."""
    arrow = need("pyarrow", "family", "a family as an Arrow table")
    fields, arrays = [], []
    for name, values in columns.items():
        array = arrow.array(values)
        if name in _WORDS:
            array = _in_words(arrow, values, _WORDS[name])
        arrays.append(array)
        metadata = measures[name].attributes() if name in measures else {}
        fields.append(arrow.field(name, array.type, metadata=metadata or None))
    return arrow.Table.from_arrays(arrays, schema=arrow.schema(fields))


def _in_words(arrow: Any, values: NDArray[Any], words: list[str | None]) -> Any:
    """Numbers as words; the indices have the type that Parquet gives back."""
    known = [word for word in words if word is not None]
    indices = values.astype(numpy.int32) - (len(words) - len(known))
    return arrow.DictionaryArray.from_arrays(arrow.array(indices, mask=indices < 0), arrow.array(known))


def to_parquet(columns: Mapping[str, NDArray[Any]], measures: Measures, path: str | Path) -> None:
    """A Parquet file."""
    need("pyarrow.parquet", "family", "a Parquet file").write_table(to_arrow(columns, measures), path)


def to_xarray(
    axes: Mapping[str, NDArray[Any]], arrays: Mapping[str, NDArray[Any]], measures: Measures, *, is_paired: bool
) -> Any:
    """An xarray.Dataset: along the words of a grid, or along `row`; with `units` and `measure` as attributes, and for
    `status` and `reason` what their numbers stand for, as the CF conventions name it."""
    dims = ("row",) if is_paired else tuple(axes)
    attributes: dict[str, dict[str, Any]] = {name: each.attributes("units") for name, each in measures.items()}
    for name, words in _WORDS.items():
        meanings = " ".join(word or "none" for word in words)
        attributes[name] = {"flag_values": numpy.arange(len(words), dtype=numpy.uint8), "flag_meanings": meanings}
    coordinates = {
        word: (("row",) if is_paired else (word,), values, attributes.get(word, {})) for word, values in axes.items()
    }
    variables = {name: (dims, each, attributes.get(name, {})) for name, each in arrays.items()}
    return need("xarray", "family", "a family as labelled arrays").Dataset(variables, coordinates)


def write_parquet(
    path: str | Path | BinaryIO, tables: Iterable[Mapping[str, NDArray[Any]]], measures: Measures
) -> None:
    """A Parquet file with a row group for each table."""
    parquet, writer = need("pyarrow.parquet", "family", "a Parquet file"), None
    try:
        for columns in tables:
            table = to_arrow(columns, measures)
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
    return ["" if value != value else repr(value) for value in values]
