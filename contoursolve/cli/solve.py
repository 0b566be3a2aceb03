"""The commands that examine contours: solve and check."""

import sys
from typing import Any

import click

from contoursolve import __version__
from contoursolve.cli.options import (
    COULD_NOT_RUN,
    FOUND_ERRORS,
    CouldNotRunError,
    common_options,
    explain_option,
    files_named,
    follow,
    load,
)
from contoursolve.cli.printing import print_lines, print_pieces, say, style_of_output
from contoursolve.diagnostics import Severity, UserError
from contoursolve.output import (
    MOST_ALIKE,
    Findings,
    Shelf,
    Totals,
    closing_lines,
    stream_findings,
    stream_json,
    stream_listing,
    table_lines,
)
from contoursolve.program import Result
from contoursolve.reading import Dialect


@click.command(short_help="Solve every contour block of a program.")
@click.argument("program", required=False)
@common_options
@click.option(
    "--format",
    "format_",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="What to print; json is in mm, with X as radius.",
)
@explain_option("the construction, the checks, every reason and every fix")
@click.pass_context
def solve(
    context: click.Context,
    /,
    program: str | None,
    blocks: tuple[str, ...],
    start: str | None,
    format_: str,
    is_explained: bool,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Solve every contour block of PROGRAM (a file, or - for standard input).

    solve prints what was given, the virtual intersections, and every element of the path, with what is proven of it.
    Where several contours fit a block, it prints all. It works out a word with ? for its value, such as P?, from the
    other words and from facts.

    Exit status: 0 no error, 1 an error is found, 2 nothing could be examined.

    \b
    contoursolve solve shaft.nc
    contoursolve solve --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0."
    contoursolve solve --start "X40. Z0." --fact "length of line 1 = 30" --block "G111 X100. A180. B120. K?"
    """
    options["strict"], tally = bool(blocks), Totals()
    run = follow(load([program] if program else [], blocks)[0](), start, assignments, options)
    if format_ == "json":
        print_pieces(stream_json(run, tally))
    else:
        print_lines(stream_listing(run, tally, style_of_output(), is_explained=is_explained))
        if run.is_strict or is_explained or tally.has_something:
            print_lines(closing_lines(run.frame, tally))
    context.exit(_status(tally, tally.severities[Severity.ERROR]))


def _status(tally: Totals, found: int) -> int:
    """The exit status where so many findings count."""
    return COULD_NOT_RUN if tally.unexamined else FOUND_ERRORS if found else 0


@click.command(short_help="Report findings only, for any number of programs.")
@click.argument("programs", nargs=-1, metavar="PROGRAM...")
@common_options
@click.option(
    "--format",
    "format_",
    type=click.Choice(["text", "json", "sarif", "github"]),
    default="text",
    show_default=True,
    help="What to print: text, one JSON document, SARIF 2.1.0, or GitHub's annotations.",
)
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning", "never"]),
    default="error",
    show_default=True,
    help="The least finding that makes the exit status 1.",
)
@explain_option("every reason and every fix")
@click.option("--strict", "is_strict", is_flag=True, help="Also report what no contour depends on, in every line.")
@click.option("--all", "shows_all", is_flag=True, help=f"Show more than {MOST_ALIKE} findings of a kind in a program.")
@click.pass_context
def check(
    context: click.Context,
    /,
    programs: tuple[str, ...],
    blocks: tuple[str, ...],
    start: str | None,
    format_: str,
    fail_on: str,
    is_explained: bool,
    is_strict: bool,
    shows_all: bool,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Report the findings about each PROGRAM (files, or - for standard input), without the contours.

    Outside contours, check reports what a contour depends on: the position, the plane, the units, the mode, the value
    of a word. --strict reports on every line. Each finding has two reasons and two fixes at most; --explain shows all.
    Several programs end with a table, the worst first. A name may have wildcards: * ? [ ].

    Exit status: 0 no error, 1 an error is found (see --fail-on), 2 a program could not be examined.

    \b
    contoursolve check shaft.nc flange.nc
    contoursolve check *.nc
    contoursolve check --control yasnac-lx3 - < shaft.nc
    """
    # A bar among the lines of a terminal would be torn.
    names = [name for program in programs for name in files_named(program)]
    loaders, style, is_alone = load(names, blocks), style_of_output(), len(names) <= 1
    options["strict"], most = is_strict or bool(blocks), None if shows_all else MOST_ALIKE
    is_shown = not is_alone and sys.stderr.isatty() and not (format_ == "text" and sys.stdout.isatty())
    tally, document = Totals(), Findings(context.with_resource(Shelf()))
    results, rows = list[Result](), list[tuple[str, Totals | None]]()
    with click.progressbar(loaders, label="checking", file=sys.stderr, hidden=not is_shown) as loaded:
        for name, loader in zip(names or [""], loaded, strict=True):
            try:
                run = follow(loader(), start, assignments, options)
            except UserError as error:
                CouldNotRunError(str(error)).show()
                rows.append((name, None))
                continue
            own = Totals()
            rows.append((name, own))
            if format_ == "text":
                print_lines(stream_findings(run, own, style, is_explained=is_explained, is_alone=is_alone, most=most))
            elif format_ == "json":
                document.add(run, own)
            else:
                results.append(run.collect())
                for finding in results[-1].diagnostics:
                    own.count(finding)
            tally.add(own)
    done, failed = sum(each is not None for _, each in rows), any(each is None for _, each in rows)
    if failed and is_alone:
        context.exit(COULD_NOT_RUN)
    match format_:
        case "json":
            print_pieces(document.pieces())
        case "sarif":
            from contoursolve.output import to_sarif  # noqa: PLC0415 - only here

            control = options["control"]
            click.echo(to_sarif(results, __version__, control if isinstance(control, Dialect) else None))
        case "github":
            from contoursolve.output import to_github  # noqa: PLC0415 - only here

            click.echo(to_github(results))
        case _ if not is_alone:
            print_lines(table_lines(rows))
            say(tally.line(done))
        case _ if options["strict"] or is_explained or tally.has_something:
            say(tally.line(done))
    failing = {"error": (Severity.ERROR,), "warning": (Severity.ERROR, Severity.WARNING), "never": ()}[fail_on]
    found = sum(tally.severities[each] for each in failing)
    context.exit(COULD_NOT_RUN if failed else _status(tally, found))
