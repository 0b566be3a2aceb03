"""Families in the formats of others; the packages for them are needed only here."""

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from contoursolve.extras import need
from contoursolve.solving.verdict import REASONS, Code


def to_arrow(columns: Mapping[str, NDArray[Any]]) -> Any:
    """A pyarrow.Table that says what the numbers of `status` and `reason` stand for."""
    arrow = need("pyarrow", "family", "a family as an Arrow table")
    table = arrow.table(dict(columns))
    meanings = {
        "status": ", ".join(f"{code.value} {code.status.value}" for code in Code),
        "reason": ", ".join(f"{number} {kind.value if kind else 'none'}" for number, kind in enumerate(REASONS)),
    }
    return table.replace_schema_metadata(meanings)


def to_parquet(columns: Mapping[str, NDArray[Any]], path: str | Path) -> None:
    """A Parquet file."""
    need("pyarrow.parquet", "family", "a Parquet file").write_table(to_arrow(columns), path)


def to_xarray(axes: Mapping[str, NDArray[Any]], arrays: Mapping[str, NDArray[Any]], *, is_paired: bool) -> Any:
    """An xarray.Dataset: along the words of a grid, or along `row`."""
    dims = ("row",) if is_paired else tuple(axes)
    coordinates = {word: (("row",) if is_paired else (word,), values) for word, values in axes.items()}
    xarray = need("xarray", "family", "a family as labelled arrays")
    return xarray.Dataset({name: (dims, each) for name, each in arrays.items()}, coordinates)


def write_parquet(path: str | Path, tables: Iterable[Mapping[str, NDArray[Any]]]) -> None:
    """A Parquet file with a row group for each table."""
    parquet, writer = need("pyarrow.parquet", "family", "a Parquet file"), None
    try:
        for columns in tables:
            table = to_arrow(columns)
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
    if name == "status":
        return [Code(value).status.value for value in values]
    if name == "reason":
        return [kind.value if kind else "" for kind in (REASONS[value] for value in values)]
    return ["" if value != value else repr(value) for value in values]
