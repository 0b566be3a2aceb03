"""Families in the formats of others; the packages for them are needed only here."""

from collections.abc import Mapping
from importlib import import_module
from typing import Any

from numpy.typing import NDArray


class MissingExtraError(ImportError):
    """A package of the extra `contoursolve[family]` is missing."""


def to_arrow(columns: Mapping[str, NDArray[Any]]) -> Any:
    """A pyarrow.Table."""
    return _need("pyarrow").table(dict(columns))


def to_parquet(columns: Mapping[str, NDArray[Any]], path: str) -> None:
    """A Parquet file."""
    _need("pyarrow.parquet").write_table(to_arrow(columns), path)


def to_xarray(axes: Mapping[str, NDArray[Any]], arrays: Mapping[str, NDArray[Any]], *, is_paired: bool) -> Any:
    """An xarray.Dataset: along the words of a grid, or along `row`."""
    dims = ("row",) if is_paired else tuple(axes)
    coordinates = {word: (("row",) if is_paired else (word,), values) for word, values in axes.items()}
    return _need("xarray").Dataset({name: (dims, each) for name, each in arrays.items()}, coordinates)


def parquet_writer(path: str, names: Mapping[str, Any]) -> Any:
    """A writer to which tables are given one after the other."""
    arrow, parquet = _need("pyarrow"), _need("pyarrow.parquet")
    fields = [(name, arrow.from_numpy_dtype(kind)) for name, kind in names.items()]
    return parquet.ParquetWriter(path, arrow.schema(fields))


def _need(package: str) -> Any:
    try:
        return import_module(package)
    except ImportError:
        name = package.partition(".")[0]
        raise MissingExtraError(f"this needs {name}: pip install 'contoursolve[family]'") from None
