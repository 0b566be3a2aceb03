"""The command that solves one block for many values of some of its words."""

import sys
import time
from collections.abc import Iterator
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

import click
import numpy

from contoursolve.cli.blocks import block_options, fact_option, format_option, print_json, read_options, usage
from contoursolve.cli.cluster import open_cluster
from contoursolve.cli.pictured import bytes_of, check_picture, theme_option
from contoursolve.cli.varied import read_range
from contoursolve.extras import need
from contoursolve.families import (
    REASONS,
    WHOLE,
    Code,
    Parts,
    Sweep,
    csv_lines,
    others,
    parts_of,
    pieces,
    sweep,
    write_parquet,
)
from contoursolve.files import CannotWriteError, check_target, write_whole
from contoursolve.output.layout import columns
from contoursolve.pictures import Theme, draw_sweep


@click.command("sweep", short_help="Solve a block for many values of its words.")
@block_options
@click.option(
    "--vary",
    "varied",
    multiple=True,
    required=True,
    metavar="WORD=VALUES",
    help="A word of the block and its values: START:STOP:STEP with both ends, V1,V2,..., or @FILE:COLUMN, a column of "
    "a CSV or Parquet file; may be repeated. Where several blocks have the word, LINE:WORD, such as 2:,A=10:20:1; "
    "start.X is the X of --start, and 'length of line 1' the value of that --fact.",
)
@fact_option
@click.option("--paired", "is_paired", is_flag=True, help="Values side by side; without it, every combination.")
@click.option("-o", "--output", metavar="FILE", help="Where to write every row: FILE.parquet or FILE.csv.")
@click.option(
    "--plot",
    "picture",
    metavar="FILE",
    type=click.Path(path_type=Path),
    help="Where to draw the contours of one word that varies, or the outcomes over two: FILE.svg or FILE.png.",
)
@theme_option
@click.option("--force", "is_forced", is_flag=True, help="Replace FILE if it exists.")
@click.option("--workers", type=click.IntRange(1, 256), help="Threads (1 without it); not with --dask.")
@click.option("--dask", metavar="ADDRESS", help="Solve on the cluster of the Dask scheduler at this address.")
@format_option
def sweep_(
    varied: tuple[str, ...],
    facts: tuple[str, ...],
    is_paired: bool,
    output: str | None,
    picture: Path | None,
    theme: str,
    is_forced: bool,
    workers: int | None,
    dask: str | None,
    format_: str,
    **options: Any,
) -> None:
    """Solve one contour for many values of some of its words, and count what becomes of it.

    The words in --vary stand in the block with any value. FILE gets a row for each set of values: the words, status,
    reason, all points and corners (mm, X of a lathe as radius), the room left on each element, the largest residual.
    The same command goes on where it was stopped.

    Exit status: 0 all are told, whatever became of them, 2 could not run.

    \b
    contoursolve sweep --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." \\
      --vary A=170:190:0.1 --vary P=1,2,5 -o family.parquet
    """
    if workers is not None and dask is not None:
        raise click.UsageError("--workers are threads of this machine; with --dask, the cluster has its own workers")
    target = _target(output, is_forced)
    if picture is not None:
        check_picture(picture, is_forced=is_forced)
    with usage():
        vary: dict[str, Any] = {}
        for text in varied:
            name, values = read_range(text)
            if name in vary:
                raise click.UsageError(f"--vary names {name} twice")
            vary[name] = values
        ready = sweep(vary=vary, facts=facts, paired=is_paired, **read_options(options))
        drawn = bytes_of(draw_sweep(ready, theme=Theme(theme)), picture) if picture is not None else b""
        with open_cluster(dask) as executor:
            counts = _run(ready, workers, executor, target)
        if picture is not None:
            write_whole(picture, [drawn], keeps_backup=False)
    if format_ == "json":
        print_json(_summary_data(counts))
    else:
        click.echo("\n".join(_summary(counts)))
    for path in filter(None, (target, picture)):
        click.echo(f"{path} written", err=True)


def _target(output: str | None, is_forced: bool) -> Path | None:
    """The file to write, whose kind its name tells."""
    if output is None:
        return None
    target = Path(output)
    if target.suffix.lower() not in (".parquet", ".csv"):
        raise click.UsageError(f"{target}: name a file that ends with .parquet or .csv")
    with usage():
        if target.suffix.lower() == ".parquet":
            need("pyarrow", "family", "a Parquet file")
        check_target(target, None, is_forced=is_forced)
    return target


def _run(ready: Sweep, workers: int | None, executor: Executor | None, target: Path | None) -> Any:
    """Evaluate and write all rows; the number of rows by status and reason."""
    counts = numpy.zeros((len(Code), len(REASONS)), numpy.int64)
    parts = parts_of(target, ready) if target is not None else None
    if parts is not None and target is not None:
        _tell(parts, target)
    begin, done = time.monotonic(), 0
    with click.progressbar(
        length=ready.ranges.count,
        label="solving",
        file=sys.stderr,
        hidden=not sys.stderr.isatty(),
        show_pos=True,
        show_eta=True,
        item_show_func=lambda rate: rate,
    ) as bar:

        def tables() -> Iterator[dict[str, Any]]:
            nonlocal done
            for table in parts.tables(workers, executor) if parts is not None else pieces(ready, workers, executor):
                numpy.add.at(counts, (table["status"], table["reason"]), 1)
                yield table
                done += table["status"].size
                rate = done / max(time.monotonic() - begin, 1e-9)
                bar.update(table["status"].size, f"{rate:,.0f} a second")

        if parts is None or target is None:
            for _ in tables():
                pass
        else:
            _write(target, parts, tables())
    return counts


def _tell(parts: Parts, target: Path) -> None:
    """What is left of sweeps that were not finished."""
    if parts.rows_done:
        click.echo(f"going on after {parts.rows_done:,} of {parts.ready.ranges.count:,} contours", err=True)
    for folder in others(parts, target):
        click.echo(f"{folder} is left of another sweep that was not finished; it may be deleted", err=True)


def _write(target: Path, parts: Parts, tables: Iterator[dict[str, Any]]) -> None:
    """The whole file, or none; what is finished stays beside it until then."""
    whole = parts.folder / WHOLE
    try:
        parts.folder.mkdir(exist_ok=True)
        if target.suffix.lower() == ".csv":
            with whole.open("w", encoding="utf-8", newline="") as file:
                file.writelines(csv_lines(tables))
        else:
            write_parquet(whole, tables, parts.ready.measures())
        whole.replace(target)
    except OSError as error:
        raise CannotWriteError(f"{target} cannot be written: {error.strerror or error}") from None
    parts.remove()


def _summary(counts: Any) -> list[str]:
    """How many contours have each status, and why."""
    rows = [(f"{counts.sum():,}", "contour" if counts.sum() == 1 else "contours")]
    for status, count, reasons in _counted(counts):
        rows.append((f"{count:,}", status))
        rows += [(f"{many:,}", f"  {reason}") for reason, many in reasons.items()]
    return columns(rows, left=(1,), indent="")


def _summary_data(counts: Any) -> dict[str, Any]:
    """The same for JSON."""
    statuses = [{"status": each, "count": count, "reasons": reasons} for each, count, reasons in _counted(counts)]
    return {"schema": "contoursolve/sweep/1", "contours": int(counts.sum()), "statuses": statuses}


def _counted(counts: Any) -> Iterator[tuple[str, int, dict[str, int]]]:
    """Each status that there is, how often, and how often for each reason, the most frequent first."""
    for code in Code:
        if counts[code].sum():
            numbers = sorted(range(1, len(REASONS)), key=lambda each: -counts[code, each])
            kinds = [(REASONS[number], int(counts[code, number])) for number in numbers if counts[code, number]]
            reasons = {kind.value: count for kind, count in kinds if kind is not None}
            yield code.status.value, int(counts[code].sum()), reasons
