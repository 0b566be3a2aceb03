"""The command that solves one block for many values of some of its words."""

import os
import sys
from collections.abc import Iterator
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Any

import click
import numpy

from contoursolve.cli.loading import settings_of
from contoursolve.cli.options import CouldNotRunError, rules_option, settings_option, units_option
from contoursolve.dialects import DIALECTS
from contoursolve.families import (
    REASONS,
    Code,
    FamilyError,
    MissingExtraError,
    Sweep,
    csv_lines,
    need,
    pieces,
    sweep,
    write_parquet,
)
from contoursolve.files import CannotWriteError, check_target, write_whole
from contoursolve.output.layout import columns
from contoursolve.pipeline import UnknownControlError
from contoursolve.project import SettingError

MOST = 10_000_000
"""Values of one word."""


@click.command("sweep", short_help="Solve a block for many values of its words.")
@click.option("--block", "blocks", multiple=True, required=True, metavar="TEXT", help="The block; may be repeated.")
@click.option("--start", metavar="WORDS", help='The start point, such as "X40. Z0.".')
@click.option(
    "--vary",
    "varied",
    multiple=True,
    required=True,
    metavar="WORD=VALUES",
    help="A word of the block and its values: START:STOP:STEP with both ends, or V1,V2,...; may be repeated. Where "
    "several blocks have the word, LINE:WORD, such as 2:,A=10:20:1.",
)
@click.option("--paired", "is_paired", is_flag=True, help="Values side by side; without it, every combination.")
@click.option("-o", "--output", metavar="FILE", help="Where to write every row: FILE.parquet or FILE.csv.")
@click.option("--force", "is_forced", is_flag=True, help="Replace FILE if it exists.")
@click.option("--workers", type=click.IntRange(1, 256), default=1, show_default=True, help="Threads.")
@click.option("--control", type=click.Choice(list(DIALECTS)), help="The control; found from the block without it.")
@units_option
@rules_option
@settings_option
def sweep_(
    blocks: tuple[str, ...],
    start: str | None,
    varied: tuple[str, ...],
    is_paired: bool,
    output: str | None,
    is_forced: bool,
    workers: int,
    control: str | None,
    units: str,
    rules: str,
    assignments: tuple[str, ...],
) -> None:
    """Solve one contour for many values of some of its words, and count what becomes of it.

    The words in --vary stand in the block with any value. FILE gets a row for each set of values: the words, status,
    reason, all points and corners (mm, X of a lathe as radius), the room left on each element, the largest residual.

    \b
    contoursolve sweep --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." \\
      --vary A=170:190:0.1 --vary P=1,2,5 -o family.parquet
    """
    target = _target(output, is_forced)
    try:
        vary: dict[str, Any] = {}
        for text in varied:
            name, values = read_range(text)
            if name in vary:
                raise click.UsageError(f"--vary names {name} twice")
            vary[name] = values
        ready = sweep(
            "\n".join(blocks),
            vary=vary,
            start=start,
            control=control,
            paired=is_paired,
            units=units,
            rules=rules,
            settings=settings_of(Path(), assignments),
        )
        counts = _run(ready, workers, target)
    except (FamilyError, SettingError, MissingExtraError, CannotWriteError) as error:
        raise CouldNotRunError(str(error)) from None
    except UnknownControlError as error:
        raise CouldNotRunError(f"{error}; say which with --control {'|'.join(DIALECTS)}") from None
    click.echo("\n".join(_summary(counts)))
    if target is not None:
        click.echo(f"{target} written", err=True)


def read_range(text: str) -> tuple[str, list[float]]:
    """A word and its values from `A=170:190:0.01` or `P=1,2,5`; steps are counted in decimals, so that no rounding adds
    up, and both ends belong to it. Raises click.UsageError."""
    name, equals, values = text.partition("=")
    word = name.strip().upper()
    if not equals or not word:
        raise click.UsageError(f"--vary {text}: write WORD=START:STOP:STEP or WORD=V1,V2,...")
    try:
        numbers = [Decimal(each.strip()) for each in values.replace(":", ",").split(",")]
    except InvalidOperation:
        raise click.UsageError(f"--vary {text}: {values} is neither START:STOP:STEP nor a list of numbers") from None
    if not all(number.is_finite() for number in numbers):
        raise click.UsageError(f"--vary {text}: values must be finite numbers")
    if ":" not in values:
        return word, [float(number) for number in numbers]
    if values.count(":") != 2 or "," in values:  # noqa: PLR2004 - between three numbers
        raise click.UsageError(f"--vary {text}: a range has three numbers, START:STOP:STEP")
    first, last, step = numbers
    if not step or (last - first) * step < 0:
        raise click.UsageError(f"--vary {text}: steps of {step} do not lead from {first} to {last}")
    count = int((last - first) / step) + 1
    if count > MOST:
        raise click.UsageError(f"--vary {text}: {count:,} values are more than {MOST:,}")
    return word, [float(first + number * step) for number in range(count)]


def _target(output: str | None, is_forced: bool) -> Path | None:
    """The file to write, whose kind its name tells."""
    if output is None:
        return None
    target = Path(output)
    if target.suffix.lower() not in (".parquet", ".csv"):
        raise click.UsageError(f"{target}: name a file that ends with .parquet or .csv")
    try:
        if target.suffix.lower() == ".parquet":
            need("pyarrow")
        check_target(target, None, is_forced=is_forced)
    except (CannotWriteError, MissingExtraError) as error:
        raise CouldNotRunError(str(error)) from None
    return target


def _run(ready: Sweep, workers: int, target: Path | None) -> Any:
    """Evaluate and write all rows; the number of rows by status and reason."""
    counts = numpy.zeros((len(Code), len(REASONS)), numpy.int64)
    with click.progressbar(
        length=ready.ranges.count, label="solving", file=sys.stderr, hidden=not sys.stderr.isatty(), show_pos=True
    ) as bar:

        def tables() -> Iterator[dict[str, Any]]:
            for table in pieces(ready, workers):
                numpy.add.at(counts, (table["status"], table["reason"]), 1)
                yield table
                bar.update(table["status"].size)

        if target is None:
            for _ in tables():
                pass
        elif target.suffix.lower() == ".csv":
            write_whole(target, (line.encode() for line in csv_lines(tables())), keeps_backup=False)
        else:
            _write_parquet(target, tables())
    return counts


def _write_parquet(target: Path, tables: Iterator[dict[str, Any]]) -> None:
    """The whole file, or none."""
    temporary = target.with_name(f".{target.name}.{os.urandom(4).hex()}.tmp")
    try:
        write_parquet(temporary, tables)
        temporary.replace(target)
    except OSError as error:
        raise CannotWriteError(f"{target} cannot be written: {error.strerror}") from None
    finally:
        temporary.unlink(missing_ok=True)


def _summary(counts: Any) -> list[str]:
    """How many contours have each status, and why."""
    rows = [(f"{counts.sum():,}", "contours")]
    for code in Code:
        if not counts[code].sum():
            continue
        rows.append((f"{counts[code].sum():,}", code.status.value))
        for number in sorted(range(1, len(REASONS)), key=lambda each: -counts[code, each]):
            kind = REASONS[number]
            if counts[code, number] and kind is not None:
                rows.append((f"{counts[code, number]:,}", f"  {kind.value}"))
    return columns(rows, left=(1,), indent="")
