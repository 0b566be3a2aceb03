"""Options that the commands about one block share, and the values of a free word as they are written."""

import csv
import re
from array import array
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Any

import click
import numpy
from numpy.typing import NDArray

from contoursolve.api import solve
from contoursolve.cli.options import (
    CouldNotRunError,
    control_option,
    let_option,
    naming,
    print_findings,
    rules_option,
    settings_of,
    settings_option,
    together,
    units_option,
)
from contoursolve.cli.printing import say
from contoursolve.diagnostics import need
from contoursolve.families import TOOL, FamilyError, RefusedError, name_of
from contoursolve.gcode import open_regular, parse
from contoursolve.reading import ReadIssue
from contoursolve.tolerance import LARGEST


def _about_block(*, is_required: bool) -> Callable[[Callable[..., None]], Callable[..., None]]:
    told = "The block; may be repeated."
    return click.option("--block", "blocks", multiple=True, required=is_required, metavar="TEXT", help=told)


_reading_options = together(
    click.option(
        "--start",
        metavar="WORDS",
        help='The start point, such as "X40. Z0.", in words as the control reads them.',
    ),
    let_option,
    control_option("The control; found from the block without it."),
    units_option,
    rules_option,
    settings_option,
)

block_options = together(_about_block(is_required=True), _reading_options)
"""The options that say which block is meant, and how it is read."""

program_options = together(_about_block(is_required=False), _reading_options)
"""The same for a command that takes a program, too."""

fact_option = click.option(
    "--fact", "facts", multiple=True, metavar="FACT", help="A further fact, as for solve; may be repeated."
)


def read_options(options: dict[str, Any]) -> dict[str, Any]:
    """The arguments of a function about a block, from the options of a command, after a warning on standard error if
    its start point may be meant otherwise."""
    rest = {name: options[name] for name in ("start", "control", "units", "rules", "variables")}
    block = "\n".join(options["blocks"])
    rest["settings"] = settings_of(parse(block, "<block>"), options["assignments"])
    for finding in solve(block, **rest, depth="verdict").diagnostics:
        if finding.about is ReadIssue.START_IN_INCREMENTS:
            say(f"{finding.severity.value}: {finding.message}; {finding.help}", err=True)
    return {"block": block, **rest}


@contextmanager
def usage(program: str = "") -> Iterator[None]:
    """Errors about a block, or a program, as one line and exit status 2; before it, the findings about a block that is
    refused whatever the values."""
    try:
        with naming(program):
            yield
    except RefusedError as error:
        print_findings(error.result, err=True)
        raise CouldNotRunError("the control refuses the block for every value; nothing is computed") from None


def is_about_tool(words: Iterable[str]) -> bool:
    """Whether the radius of the tool is among some words."""
    return TOOL in map(name_of, words)


def read_within(text: str) -> tuple[float, float]:
    """The range of `--within LOW:HIGH`."""
    low, _, high = text.partition(":")
    try:
        return float(low), float(high)
    except ValueError:
        raise click.UsageError(f"--within {text}: write LOW:HIGH, such as 0.1:50") from None


MOST = 10_000_000
"""Values of one word."""

_SMALLEST = -30
"""Decimals of the smallest step; doubles near 1 have 16."""

_FILE = re.compile(r"@(?P<file>.+?\.(?P<kind>csv|parquet))(?::(?P<column>.+))?", re.IGNORECASE)


Numbers = NDArray[numpy.float64]


def read_range(text: str) -> tuple[str, Numbers]:
    """A word and its values from `A=170:190:0.01`, `P=1,2,5` or `A=@FILE:COLUMN`; steps are counted in decimals, so
    that no rounding adds up, and both ends belong to it. Raises click.UsageError, FamilyError."""
    name, equals, values = text.partition("=")
    if not equals or not name.strip():
        raise click.UsageError(f"--vary {text}: write WORD=START:STOP:STEP, WORD=V1,V2,... or WORD=@FILE:COLUMN")
    word = name_of(name)
    if values.strip().startswith("@"):
        return word, _read_column(word, values.strip())
    try:
        numbers = [Decimal(each.strip()) for each in values.replace(":", ",").split(",")]
    except InvalidOperation:
        told = "neither START:STOP:STEP, nor a list of numbers, nor @FILE:COLUMN"
        raise click.UsageError(f"--vary {text}: {values} is {told}") from None
    if not all(number.is_finite() for number in numbers):
        raise click.UsageError(f"--vary {text}: values must be finite numbers")
    beyond = next((number for number in numbers if number.copy_abs() > LARGEST), None)
    if beyond is not None:
        raise click.UsageError(f"--vary {text}: {beyond} is beyond all travel; values go up to {LARGEST:,.0f}")
    if any(number and number.adjusted() < _SMALLEST for number in numbers):
        raise click.UsageError(f"--vary {text}: values and steps have at most {-_SMALLEST} decimals")
    if ":" not in values:
        return word, numpy.array([float(number) for number in numbers])
    if values.count(":") != 2 or "," in values:  # noqa: PLR2004 - between three numbers
        raise click.UsageError(f"--vary {text}: a range has three numbers, START:STOP:STEP")
    first, last, step = numbers
    if not step or (last - first) * step < 0:
        told = f"; write {last}:{first}:{step}, or a step of {-step}" if step else "; write a step that is not 0"
        raise click.UsageError(f"--vary {text}: steps of {step} do not lead from {first} to {last}{told}")
    count = int((last - first) / step) + 1
    if count > MOST:
        raise click.UsageError(f"--vary {text}: {count:,} values are more than {MOST:,}")
    return word, numpy.fromiter((float(first + number * step) for number in range(count)), float, count)


_MOST_BYTES = 1_000_000_000
"""Bytes of a file with values: more than the most values take as text."""


def _read_column(word: str, text: str) -> Numbers:
    match = _FILE.fullmatch(text)
    if match is None:
        raise click.UsageError(f"--vary {word}={text}: name a file that ends with .csv or .parquet, @FILE:COLUMN")
    file, column = Path(match["file"]), match["column"] or word
    try:
        open_regular(file, _MOST_BYTES).close()
        found = (_from_csv if match["kind"].lower() == "csv" else _from_parquet)(file, column)
    except FileNotFoundError:
        raise FamilyError(f"{file}: no such file") from None
    except FamilyError:
        raise
    except (OSError, ValueError, csv.Error) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise FamilyError(f"{file} cannot be read: {reason}") from None
    if not found.size:
        raise FamilyError(f"{file}, column {column}: there are no numbers")
    return found


def _from_csv(file: Path, column: str) -> Numbers:
    with file.open(encoding="utf-8-sig", newline="") as text:
        head = text.readline()
        text.seek(0)
        rows = csv.reader(text, delimiter=";" if ";" in head and "," not in head else ",")
        names = [each.strip() for each in next(rows, [])]
        at = _find(file, column, names)
        found = array("d")
        for row in rows:
            if not row:
                continue
            if any(cell.strip() for cell in row[len(names) :]):
                told = f"line {rows.line_num} has {len(row)} columns, the first line {len(names)}"
                raise FamilyError(f"{file}: {told}; numbers have a decimal point, no comma")
            try:
                found.append(float(row[at]))
            except (IndexError, ValueError):
                cell = row[at] if at < len(row) else ""
                told = f"{cell!r} is no number" if cell.strip() else "there is no number"
                raise FamilyError(f"{file}, line {rows.line_num}, column {column}: {told}") from None
    return numpy.array(found)


def _from_parquet(file: Path, column: str) -> Numbers:
    arrow = need("pyarrow", "family", "a Parquet file")
    try:
        table = need("pyarrow.parquet", "family", "a Parquet file").ParquetFile(file)
        name = table.schema_arrow.names[_find(file, column, table.schema_arrow.names)]
        found = table.read([name])[name].cast(arrow.float64())
        table.close()
    except arrow.ArrowException as error:
        raise FamilyError(f"{file}, column {column}: {error}") from None
    if found.null_count:
        row = int(numpy.argmax(found.is_null().to_numpy())) + 1
        raise FamilyError(f"{file}, column {column}, row {row:,}: there is no number")
    numbers: Numbers = found.to_numpy()
    return numbers


def _find(file: Path, column: str, names: list[str]) -> int:
    if column not in names:
        raise FamilyError(f"{file} has no column {column}; there are {', '.join(names) or 'none'}")
    if names.count(column) > 1:
        raise FamilyError(f"{file} has {names.count(column)} columns {column}; give one of them another name")
    return names.index(column)
