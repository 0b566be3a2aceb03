"""The command `write`: a sketch as a small program for a control, or in the words of all controls."""

from pathlib import Path
from typing import Any

import click

from contoursolve.cli.expand import target_of
from contoursolve.cli.options import FOUND_ERRORS, CouldNotRunError, control_option, settings_option
from contoursolve.cli.printing import print_lines, say, style_of_output
from contoursolve.diagnostics import json_text, members
from contoursolve.gcode import STANDARD_INPUT, decode, read_bytes, write_whole
from contoursolve.output import Collected, Totals, stream_findings
from contoursolve.postprocess import Written
from contoursolve.program import find_settings, read_setting
from contoursolve.reading import Dialect
from contoursolve.sketches import (
    ContourSketch,
    UnfinishedError,
    candidate_lines,
    examine_sketch,
    read_sketch,
    table_lines,
    write as write_contour,
    write_for_all,
)


@click.command(short_help="Write a sketch as a program for a control.")
@click.argument("sketch", metavar="SKETCH")
@control_option("For which control. Without it, a table has the shortest words for each control.", "--to")
@settings_option
@click.option("--all", "shows_all", is_flag=True, help="List all candidates, each with what its numbers rest on.")
@click.option("-o", "--output", metavar="NEW", help="Where to write the program; without it, to standard output.")
@click.option("--force", "is_forced", is_flag=True, help="Replace NEW if it exists.")
@click.option(
    "--format", "format_", type=click.Choice(["text", "json"]), default="text", show_default=True, help="What to print."
)
@click.pass_context
def write(
    context: click.Context,
    /,
    sketch: str,
    to: str | Dialect | None,
    assignments: tuple[str, ...],
    shows_all: bool,
    output: str | None,
    is_forced: bool,
    format_: str,
) -> None:
    """Write SKETCH (a TOML or JSON file, or - for standard input) as a small program for a control.

    write looks for the fewest words that rest on the drawing's own numbers, then for round ones. Each candidate is read
    back as the control reads it, and is the same contour. What the control has no words for is written as G01, G02 and
    G03, and named. --all lists the candidates instead of the program.

    Exit status: 0 written, 1 the sketch is open or contradicts itself, 2 could not run.

    \b
    contoursolve write plate.toml --to fanuc-mill -o plate.nc
    contoursolve write plate.toml --to heidenhain --all
    contoursolve write plate.toml
    """
    if output is not None and (shows_all or to is None or format_ == "json"):
        raise click.UsageError("-o goes with --to, and without --all and --format json")
    if shows_all and to is None:
        raise click.UsageError("--all goes with --to")
    target = target_of(sketch, output, is_forced=is_forced)
    drawn = read_sketch(decode(read_bytes(sketch, "a sketch"), sketch))
    folder = Path() if sketch == STANDARD_INPUT else Path(sketch).parent
    settings = find_settings(folder) | dict(map(read_setting, assignments))
    try:
        if to is None:
            several = write_for_all(drawn, settings=settings)
        else:
            several = (write_contour(drawn, to, settings=settings),)
    except UnfinishedError:
        _report_findings(drawn)
        context.exit(FOUND_ERRORS)
    found = several[0]
    if format_ == "json":
        click.echo(json_text([_data(each) for each in several]))
    elif to is None:
        print_lines(table_lines(several))
    elif not found.candidates:
        raise CouldNotRunError(found.reason)
    elif shows_all:
        print_lines(line for each in found.candidates for line in candidate_lines(each))
        _report(found)
    elif target is None:
        click.echo(found.candidates[0].program, nl=False)
        _report(found)
    else:
        write_whole(target, (found.candidates[0].program.encode(),), keeps_backup=False)
        say(f"{target} written", err=True)
        _report(found)


def _report(found: Written) -> None:
    """Print on standard error how good the first candidate is."""
    first, *others = candidate_lines(found.candidates[0])
    said = [line.strip() for line in others if not line.startswith("    ")]
    print_lines((first, *said, *filter(None, (found.reason,))), err=True)


def _report_findings(sketch: ContourSketch) -> None:
    """Print why a sketch has no contour, as `check` does."""
    tally = Totals()
    print_lines(stream_findings(Collected(examine_sketch(sketch), is_strict=True), tally, style_of_output()))


def _data(found: Written) -> dict[str, Any]:
    return {
        **members(found, "control title reason"),
        "candidates": [
            members(each, "lines program deviation_mm=deviation is_plain written_out blocks")
            for each in found.candidates
        ],
    }
