"""The command family: every contour of a family into a file, here or on a Dask cluster."""

import logging
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError, Executor, Future, wait
from contextlib import contextmanager
from io import TextIOWrapper
from pathlib import Path
from shutil import disk_usage
from typing import Any

import click

from contoursolve.cli.block_options import (
    block_options,
    fact_option,
    is_about_tool,
    read_options,
    read_range,
    usage,
)
from contoursolve.cli.brief_help import LongCommand
from contoursolve.cli.options import CouldNotRunError, check_toolless, format_option, side_options
from contoursolve.cli.pictures import bytes_of, check_picture, theme_option
from contoursolve.cli.printing import print_json, say
from contoursolve.cli.progress import STOPPED, duration, leave_threads, progress, stoppable
from contoursolve.diagnosis import state_of, states_in
from contoursolve.diagnostics import need
from contoursolve.families import (
    CUT,
    MOST_ROWS,
    Checkpoints,
    CompiledSweep,
    FailureSummary,
    Tally,
    csv_lines,
    failure_summary,
    origin_of,
    others,
    parts_of,
    pieces,
    room_of,
    seconds_of,
    summary_of,
    sweep,
    write_parquet,
)
from contoursolve.gcode import CannotWriteError, check_target, open_whole, write_whole
from contoursolve.output import columns, premise_data, rest_lines
from contoursolve.pictures import Theme, draw_sweep, sweep_title
from contoursolve.solving import REASONS, STATUSES, Status
from contoursolve.tool_radius import ToolSweep, sweep_tools

PATIENCE = 1.0
"""Seconds between two looks at whether the scheduler is still there."""


@contextmanager
def open_cluster(address: str | None) -> Iterator[Executor | None]:
    """The executor of a Dask cluster; None without an address. Raises CouldNotRunError, MissingExtraError."""
    if address is None:
        yield None
        return
    distributed = need("distributed", "dask", "solving on a cluster")
    for name in ("distributed.client", "tornado.application"):
        # They log the traceback of a lost connection, which is told here in one line.
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        client = distributed.Client(address, timeout="10s", set_as_default=False)
    except (OSError, ValueError) as error:
        raise CouldNotRunError(f"no Dask scheduler answers at {address}: {error}") from None
    with client:
        try:
            yield _Cluster(client, address)
        except distributed.scheduler.KilledWorker as error:
            raise CouldNotRunError(f"workers of the Dask cluster at {address} were killed: {error}") from None
        except ImportError as error:
            if not isinstance(error, ModuleNotFoundError) or not (error.name or "").startswith("contoursolve"):
                raise
            told = f"a worker of the Dask cluster at {address} has no {error.name}; install contoursolve for it, too"
            raise CouldNotRunError(told) from None


class _Cluster(Executor):
    """The executor of a client, without which a task would be waited for forever when the scheduler is gone."""

    def __init__(self, client: Any, address: str) -> None:
        self.client, self.address, self.inner = client, address, client.get_executor()
        self.is_told = False
        """Whether it has been told that there are no workers."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        return _Task(self, self.inner.submit(fn, *args, **kwargs))

    def check(self) -> None:
        """Raise CouldNotRunError if the client has given up its connection; tell that there are no workers."""
        if self.client.status in ("closing", "closed"):
            raise self.lost()
        if not self.is_told and self.client.status == "running" and not self._has_workers():
            told = "has no workers; waiting for one (it needs contoursolve in this version)"
            say(f"the Dask scheduler at {self.address} {told}", err=True)
            self.is_told = True

    def _has_workers(self) -> bool:
        try:
            return bool(self.client.nthreads())
        except OSError:  # the connection was lost just now, which its status tells soon
            return True

    def lost(self) -> CouldNotRunError:
        """The error of a cluster that is gone."""
        return CouldNotRunError(f"the Dask scheduler at {self.address} does not answer any more")


class _Task(Future[Any]):
    """One task of a cluster."""

    def __init__(self, cluster: _Cluster, inner: "Future[Any]") -> None:
        super().__init__()
        self.cluster, self.inner = cluster, inner

    def result(self, timeout: float | None = None) -> Any:
        """The result of the task; `timeout` is not needed here."""
        while not wait([self.inner], PATIENCE).done:
            self.cluster.check()
        try:
            return self.inner.result(timeout)
        except CancelledError:
            raise self.cluster.lost() from None

    def cancel(self) -> bool:
        return self.inner.cancel()


def check_extent(ready: CompiledSweep, parts: Checkpoints | None, target: Path | None, *, is_forced: bool) -> None:
    """Raise CouldNotRunError for more contours than are begun at a word, or a file that the disk has no room for."""
    rows = ready.ranges.count
    if rows > sys.maxsize:
        raise CouldNotRunError(f"{rows:.1e} contours cannot be counted; vary fewer words, or take larger steps")
    if is_forced:
        return
    told = []
    if rows > MOST_ROWS:
        took = duration(seconds_of(ready))
        told.append(f"{rows:,} contours are more than {MOST_ROWS:,}: about {took} on one thread, by the first ones")
    if parts is not None and target is not None:
        room, free = room_of(parts, is_text=target.suffix.lower() == ".csv"), disk_usage(target.parent).free
        if room > free:
            told.append(
                f"{target}, with the rows that are kept beside it until it is whole, may need {size(room)}, where "
                f"{size(free)} are free"
            )
    if told:
        raise CouldNotRunError(f"{'; '.join(told)}; take larger steps, or give --force")


def size(count: float) -> str:
    """A number of bytes in the unit that fits: `3.1 GB`."""
    for unit in ("bytes", "kB", "MB", "GB"):
        if count < 1000:  # noqa: PLR2004 - decimal prefixes
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:,.1f} TB"


@click.command("family", cls=LongCommand, short_help="Solve a block for many values of its words.")
@block_options
@click.option(
    "--vary",
    "varied",
    multiple=True,
    required=True,
    metavar="WORD=VALUES",
    help="A word of the block and its values, as they stand: START:STOP:STEP with both ends, V1,V2,..., or "
    "@FILE:COLUMN, a column of a CSV or Parquet file; may be repeated. Where several blocks have the word, LINE:WORD, "
    "such as 2:,A=10:20:1; 'start X' is the X of --start, and 'length of line 1' the value of that --fact. 'tool' is "
    "the radius of a tool: for each contour, whether that one cuts it.",
)
@side_options
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
@click.option(
    "--result",
    metavar="NAME",
    help="With --plot, colour the map of two words by a result, with lines of equal value: a coordinate such as "
    "'V2 Z' or 'end X', 'straight part of line 1', or the length of the path.",
)
@theme_option
@click.option(
    "--force",
    "is_forced",
    is_flag=True,
    help=f"Replace FILE if it exists; begin with more than {MOST_ROWS:,} contours, or with "
    "more than the disk has room for.",
)
@click.option("--workers", type=click.IntRange(1, 256), help="Threads (1 without it); not with --dask.")
@click.option("--dask", metavar="ADDRESS", help="Solve on the cluster of the Dask scheduler at this address.")
@click.option("--quiet", "is_quiet", is_flag=True, help="Do not show progress.")
@format_option
@click.pass_context
def family(
    context: click.Context,
    /,
    varied: tuple[str, ...],
    tip: int | None,
    side: str | None,
    outside: str | None,
    facts: tuple[str, ...],
    is_paired: bool,
    output: str | None,
    picture: Path | None,
    result: str | None,
    theme: str,
    is_forced: bool,
    workers: int | None,
    dask: str | None,
    is_quiet: bool,
    format_: str,
    **options: Any,
) -> None:
    """Solve one contour for many values of some of its words, and count what becomes of it.

    The words in --vary stand in the block with any value. FILE gets a row for each set of values: the words, status,
    reason, all points and corners. The words are as written, in the unit of the block. The row also has the room left
    on each element, and by how much the equations are off at most. All else is in mm. X of a lathe is a diameter in
    both. Where the control refuses the block for any value, family prints its findings as solve does, and no rows.

    Until FILE is whole, family keeps finished rows beside it, in a folder .FILE.NUMBER.parts. After Ctrl-C, SIGTERM or
    a crash the same command goes on where it stopped. It names the folders that other families have left.

    With tool=VALUES it also tells for each contour which of these tools cut it, in four columns: tool, tool.fits,
    tool.largest and tool.fault. tool.largest is the largest of these tools that fits, in mm. tool.fault is what stops
    the tool, or a warning about it. The contour keeps its status.

    Exit status: 0 done, whatever became of the contours, 2 could not run, 130 stopped by Ctrl-C or SIGTERM.

    \b
    contoursolve family --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." \\
      --vary A=170:190:0.1 --vary P=1,2,5 -o family.parquet
    contoursolve family --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." \\
      --vary P=0.5:5:0.5 --vary tool=0.2:1.2:0.2 --side right --tip 3
    """
    if workers is not None and dask is not None:
        raise click.UsageError("--workers are threads of this machine; with --dask, the cluster has its own workers")
    if result is not None and picture is None:
        raise click.UsageError("--result colours a map; name its file with --plot")
    vary, stated = _read_varied(varied), dict[str, Any](tip=tip, side=side, outside=outside)
    is_tool = is_about_tool(vary)
    if not is_tool:
        check_toolless(stated, "--vary tool=VALUES")
    elif picture is not None or dask is not None:
        option, does = ("--plot", "draws") if picture is not None else ("--dask", "solves")
        raise click.UsageError(f"{option} {does} contours, not tools; leave out {option}, or --vary tool")
    target = _target(output, is_forced)
    if picture is not None:
        check_picture(picture, is_forced=is_forced)
    parts, tally = None, None
    try:
        with usage(), stoppable():
            about = {"vary": vary, "facts": facts, "paired": is_paired, **read_options(options)}
            ready = sweep_tools(**about, **stated) if is_tool else sweep(**about)
            contours = ready.contours if isinstance(ready, ToolSweep) else ready
            tally = Tally(tuple(contours.ranges.values), many=ready.ranges.count // contours.ranges.count)
            parts = parts_of(target, ready) if target is not None else None
            check_extent(ready, parts, target, is_forced=is_forced)
            if picture is not None:
                # What cannot be drawn is told before anything else is done.
                bytes_of(draw_sweep(ready, result=result, theme=Theme(theme), title="not solved yet"), picture)
            with open_cluster(dask) as executor, progress(ready.ranges.count, is_quiet=is_quiet) as advance:
                _run(_tables(ready, parts, (workers, executor), tally, advance), parts, target, is_forced=is_forced)
            if picture is not None:
                title = sweep_title(ready.ranges, summary_of(tally.counts.sum(axis=1)))
                drawn = bytes_of(draw_sweep(ready, result=result, theme=Theme(theme), title=title), picture)
                write_whole(picture, [drawn], keeps_backup=False)
            failures = failure_summary(contours, tally)
    except KeyboardInterrupt:
        say(_stopped(parts, tally), err=True)
        leave_threads(STOPPED)
        context.exit(STOPPED)
    if format_ == "json":
        told = {"remark": ready.remark or None, **premise_data(ready.premises)}
        if is_tool:
            told["tools"] = [{"radius": radius, "contours": own} for radius, own in sorted(tally.tools.items())]
        print_json({**_summary_data(tally.counts, failures), **told})
    else:
        notes = filter(None, (ready.remark, *rest_lines(ready)))
        say("\n".join([*_summary(tally.counts, failures), *_tools(tally), *notes]))
    for path in filter(None, (target, picture)):
        say(f"{path} written", err=True)


def _read_varied(varied: Sequence[str]) -> dict[str, Any]:
    """The words that vary, with their values."""
    vary: dict[str, Any] = {}
    for text in varied:
        name, values = read_range(text)
        if name in vary:
            raise click.UsageError(f"--vary names {name} twice")
        vary[name] = values
    return vary


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


def _tables(
    ready: CompiledSweep,
    parts: Checkpoints | None,
    workers: tuple[int | None, Executor | None],
    tally: Tally,
    advance: Callable[[int], None],
) -> Iterator[dict[str, Any]]:
    """The rows in order, counted."""
    for table in parts.tables(*workers) if parts is not None else pieces(ready, *workers):
        tally.add(table)
        yield table
        advance(table["status"].size)


def _run(tables: Iterator[dict[str, Any]], parts: Checkpoints | None, target: Path | None, *, is_forced: bool) -> None:
    """Evaluate all rows, and write them."""
    if parts is None or target is None:
        for _ in tables:
            pass
    else:
        _tell(parts, target)
        _write(target, parts, tables, is_forced=is_forced)


def _stopped(parts: Checkpoints | None, tally: Tally | None) -> str:
    """The message about a sweep that was told to stop, with the finished contours that are kept."""
    if parts is None:
        done = int(tally.counts.sum()) if tally is not None else 0
        return f"stopped after {done:,} contours; nothing is kept without -o FILE"
    if not parts.rows_done:
        parts.remove()
        return "stopped; there are no finished contours to go on from"
    kept = f"{parts.rows_done:,} of {parts.ready.ranges.count:,} contours, which are kept in {parts.folder}"
    return f"stopped after {kept}: the same command goes on there; delete that folder to give up"


def _tell(parts: Checkpoints, target: Path) -> None:
    """Print the parts that are left of unfinished sweeps."""
    if parts.rows_done:
        say(f"going on after {parts.rows_done:,} of {parts.ready.ranges.count:,} contours", err=True)
    for folder in others(parts, target):
        say(f"{folder} is left of another family that was not finished; it may be deleted", err=True)


def _write(target: Path, parts: Checkpoints, tables: Iterator[dict[str, Any]], *, is_forced: bool) -> None:
    """The whole file, or none; what is finished stays beside it until then."""
    try:
        ready, temporary = parts.ready, parts.temporary("whole")
        with open_whole(target, temporary=temporary) as whole:
            if target.suffix.lower() == ".csv":
                text = TextIOWrapper(whole.file, encoding="utf-8", newline="")
                text.writelines(csv_lines(tables))
                text.detach()
            else:
                write_parquet(whole.file, tables, ready.measures(), origin_of(ready.spec, ready.premises))
            if temporary.exists():
                check_target(target, None, is_forced=is_forced)
    except CannotWriteError as error:
        if not (isinstance(error.__cause__, FileNotFoundError) and target.exists()):
            raise CannotWriteError(f"{error}{_kept(parts)}") from error
        # The same sweep has ended elsewhere in the meantime, with the same file.
    except OSError as error:
        raise CannotWriteError(f"{target} cannot be written: {error.strerror or error}{_kept(parts)}") from error
    parts.remove()


def _kept(parts: Checkpoints) -> str:
    """The message about finished contours that are kept although the file cannot be written; empty without any."""
    if not parts.rows_done:
        parts.remove()
        return ""
    rows = f"{parts.rows_done:,} of {parts.ready.ranges.count:,} contours"
    return f"; {rows} are kept in {parts.folder}: the same command goes on there, or delete it"


def _summary(counts: Any, failures: FailureSummary | None) -> list[str]:
    """Lines with the number of contours in each state, and the reasons."""
    rows = [(f"{counts.sum():,}", "contour" if counts.sum() == 1 else "contours")]
    counted = [(state_of(status), count, reasons) for status, count, reasons in _counted(counts)]
    for state, number in states_in({Status(status): count for status, count, _ in _counted(counts)}).items():
        rows.append((f"{number:,}", state.value))
        reasons = sum((Counter(each) for its, _, each in counted if its is state), Counter())
        rows += [(f"{many:,}", f"  {reason}") for reason, many in reasons.most_common()]
    lines = columns(rows, left=(1,), indent="")
    if failures is not None:
        values = ", ".join(f"{word}={value!r}" for word, value in failures.values.items())
        lines.append(f"{failures.count:,} of them, such as {values}: {failures.message}")
    return lines


def _tools(tally: Tally) -> list[str]:
    """A line for each tool: how many contours it cuts, and what stops it at the others."""
    rows = []
    for radius, told in sorted(tally.tools.items()):
        others = ", ".join(f"{count:,} ({kind.replace('_', ' ')})" for kind, count in told.most_common() if kind != CUT)
        rows.append((f"{told[CUT]:,}", f"cut by the tool R{radius:g}{others and '; not '}{others}"))
    return columns(rows, left=(1,), indent="") if rows else []


def _summary_data(counts: Any, failures: FailureSummary | None) -> dict[str, Any]:
    """The same for JSON."""
    statuses = [{"status": each, "count": count, "reasons": reasons} for each, count, reasons in _counted(counts)]
    example = None
    if failures is not None:
        about = {"count": failures.count, "values": dict(failures.values)}
        example = {**about, "code": failures.code or None, "message": failures.message or None}
    return {
        "schema": "contoursolve/sweep/1",
        "contours": int(counts.sum()),
        "statuses": statuses,
        "example": example,
    }


def _counted(counts: Any) -> Iterator[tuple[str, int, dict[str, int]]]:
    """Each status that there is, how often, and how often for each reason, the most frequent first."""
    for code, status in enumerate(STATUSES):
        if counts[code].sum():
            numbers = sorted(range(1, len(REASONS)), key=lambda each: -counts[code, each])
            kinds = [(REASONS[number], int(counts[code, number])) for number in numbers if counts[code, number]]
            reasons = {kind.value: count for kind, count in kinds if kind is not None}
            yield status.value, int(counts[code].sum()), reasons
