"""The commands `solve` and `system`."""

from typing import Any

import click

from contoursolve.cli.brief_help import LongCommand
from contoursolve.cli.options import (
    FILE,
    CouldNotRunError,
    common_options,
    explain_option,
    follow,
    is_sketch,
    load,
    named_options,
    status_of,
    tool_options,
)
from contoursolve.cli.printing import print_lines, print_pieces, style_of_output
from contoursolve.diagnostics import Severity
from contoursolve.output import Collected, Totals, closing_lines, stream_listing, tool_lines


@click.command(cls=LongCommand, short_help="Solve every contour block of a program.")
@click.argument("program", required=False, type=FILE)
@common_options
@named_options
@tool_options
@click.option(
    "--format",
    "format_",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="What to print; json is in mm, with X as radius.",
)
@click.option("--derivation", "is_derived", is_flag=True, help="Also print the calculation by hand.")
@click.option("--full", "is_full", is_flag=True, help="Of a program with several contours, print all of each.")
@explain_option("the equations, the construction, the checks, every reason and every fix")
@click.pass_context
def solve(
    context: click.Context,
    /,
    program: str | None,
    blocks: tuple[str, ...],
    start: str | None,
    format_: str,
    is_derived: bool,
    is_full: bool,
    is_explained: bool,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Solve every contour block of PROGRAM (a file, or - for standard input).

    Of one contour, solve prints what was given, the virtual intersections, and every element of the path. It says what
    is proven. The paths of several contours are one table; --full prints all of each. Where several contours fit a
    block, it prints all. It works out a word with ? for its value, such as P?, from the
    other words and from facts.

    PROGRAM may be a sketch (a .toml file): solve prints what is known of it, and what is missing.

    Exit status: 0 no error, 1 an error is found, 2 nothing could be examined.

    \b
    contoursolve solve shaft.nc
    contoursolve solve --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0."
    contoursolve solve --start "X40. Z0." --fact "length of line 1 = 30" --block "G111 X100. A180. B120. K?"
    """
    loader = load([program] if program else [], blocks)[0]
    if is_sketch(program):
        from contoursolve.cli.sketched import refuse_options, solve_sketched  # noqa: PLC0415 - most runs have programs

        refuse_options(context)
        tally = solve_sketched(loader(), format_, is_explained=is_explained)
        context.exit(status_of(tally, tally.severities[Severity.ERROR]))
    options["strict"], tally = bool(blocks), Totals()
    run = follow(loader(), start, assignments, options)
    if format_ == "json":
        from contoursolve.output import stream_json  # noqa: PLC0415 - most runs print text

        print_pieces(stream_json(run, tally))
    else:
        shown = {"is_explained": is_explained, "is_derived": is_derived}
        is_brief = program is not None and not (is_full or is_explained or is_derived)
        print_lines(stream_listing(run, tally, style_of_output(), is_brief=is_brief, **shown))
        if isinstance(run, Collected) and run.tool is not None:
            tally.statuses.update(run.moves())
            print_lines(tool_lines(run.tool, run.frame))
        if run.is_strict or is_explained or tally.has_something:
            print_lines(closing_lines(run.frame, tally))
    context.exit(status_of(tally, tally.severities[Severity.ERROR]))


@click.command(short_help="Print the system of equations of a contour.")
@click.argument("program", required=False, type=FILE)
@click.option("--line", type=click.IntRange(1), help="The contour that this line of PROGRAM belongs to.")
@common_options
def system(
    program: str | None,
    blocks: tuple[str, ...],
    start: str | None,
    line: int | None,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Print the equations of the only contour of PROGRAM (a file, or - for standard input), or of the one on a line.

    It says what each unknown and each value is, which word states which equation, what is still open, which conditions
    must hold, and which words say the same.

    Exit status: 0 done, 2 could not run, or there is no such contour.

    \b
    contoursolve system --block "G111 X100. A180. K-30. B120. P5." --start "X40. Z0."
    contoursolve system shaft.nc --line 71
    """
    read = load([program] if program else [], blocks)[0]()
    result = follow(read, start, assignments, {**options, "depth": "verdict"}).collect()
    try:
        answer = result.answer if line is None else result.contour_at(line)
    except ValueError as error:
        told = str(error).partition(";")[0] + ("; name one with --line" if len(result.answers) > 1 else "")
        raise CouldNotRunError(told) from None
    from contoursolve.output import system_view  # noqa: PLC0415 - sympy is slow to import

    print_lines(system_view(answer.system).lines())
