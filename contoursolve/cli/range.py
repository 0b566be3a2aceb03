"""The command that tells for which values of a word a contour exists."""

from typing import Any

import click

from contoursolve.cli.blocks import block_options, print_json, read_options, read_within, usage
from contoursolve.cli.options import FOUND_ERRORS
from contoursolve.cli.printing import print_lines
from contoursolve.families import feasible
from contoursolve.output.ranges import range_data, range_lines


@click.command("range", short_help="Tell for which values of a word a contour exists.")
@block_options
@click.option("--word", required=True, metavar="WORD", help="A word of the block, such as P, or 2:,A for line 2.")
@click.option(
    "--within",
    metavar="LOW:HIGH",
    help="The range to look at; without it, one turn for an angle, and 10 m to either side for a length.",
)
@click.pass_context
def range_(context: click.Context, /, word: str, within: str | None, format_: str, **options: Any) -> None:
    """Tell for which values of WORD the contour of a block exists, and what ends each range of them.

    Every range is found: the values are divided until it is proven of each part that the contour exists there or does
    not. Each end is solved on both sides.

    Exit status: 0 the contour exists for some value, 1 for none, 2 could not run.

    \b
    contoursolve range --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." --word P
    """
    with usage():
        found = feasible(word=word, within=read_within(within), **read_options(options))
    if format_ == "json":
        print_json(range_data(found))
    else:
        print_lines(range_lines(found))
    context.exit(0 if found.intervals else FOUND_ERRORS)
