"""The command that makes a page about a program."""

import sys
from pathlib import Path
from typing import Any

import click

from contoursolve import __version__
from contoursolve.cli.loading import examine, load, named_after
from contoursolve.cli.options import FOUND_ERRORS, CouldNotRunError, common_options
from contoursolve.cli.printing import print_lines, say, style_of_output
from contoursolve.extras import MissingExtraError, importing
from contoursolve.files import CannotWriteError, check_target, write_whole
from contoursolve.output.listing import lines_of_findings, summary_line


@click.command(short_help="Make a page about a program, to read, send and print.")
@click.argument("program", required=False)
@click.option(
    "-o",
    "--output",
    metavar="OUT.html",
    type=click.Path(path_type=Path),
    help="The page to write; without it, one with the name of PROGRAM in this folder.",
)
@click.option("--force", "is_forced", is_flag=True, help="Replace the page if it exists.")
@common_options
@click.pass_context
def report(
    context: click.Context,
    /,
    program: str | None,
    output: Path | None,
    is_forced: bool,
    blocks: tuple[str, ...],
    start: str | None,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Make one page of HTML about PROGRAM (a file, or - for standard input).

    Every contour with its picture, its elements and its findings with their fixes; the program's text, linked with
    them; and the manual's places with how well each is known. The page opens without a network, in light and dark,
    and prints. For a program without a contour none is written. Needs the extra contoursolve[report].

    \b
    contoursolve report shaft.nc
    contoursolve report --block "G111 X100. A180. K-30. B120. P5." --start "X40. Z0." -o block.html --force
    """
    loader = load([program] if program else [], blocks, start)[0]
    target = output if output is not None else named_after(program, ".html")
    if target.suffix.lower() not in (".html", ".htm"):
        raise CouldNotRunError(f"{target}: pages end in .html")
    try:
        with importing("report", "a report"):
            from contoursolve.output.report import report_page  # noqa: PLC0415 - needs an extra
        check_target(target, Path(program) if program else None, is_forced=is_forced)
        result = examine(loader(), start, assignments, options)
        if not result.answers:
            print_lines(lines_of_findings(result, result.diagnostics, style_of_output()))
            say(f"{summary_line([result])}\n{target}: not written")
            context.exit(FOUND_ERRORS)
        with click.progressbar(
            length=len(result.answers), label="drawing", file=sys.stderr, hidden=not sys.stderr.isatty()
        ) as bar:
            pieces = report_page(result, __version__, lambda: bar.update(1))
            write_whole(target, (piece.encode("utf-8", "replace") for piece in pieces), keeps_backup=False)
    except (CannotWriteError, MissingExtraError) as error:
        raise CouldNotRunError(str(error)) from None
    say(summary_line([result]))
    say(f"{target} written")
    context.exit(FOUND_ERRORS if result.has_errors else 0)
