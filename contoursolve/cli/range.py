"""The command that tells for which values of a word a contour exists."""

from typing import Any

import click

from contoursolve.cli.blocks import (
    block_options,
    fact_option,
    format_option,
    print_json,
    read_options,
    read_within,
    usage,
)
from contoursolve.cli.options import FOUND_ERRORS
from contoursolve.cli.printing import print_lines
from contoursolve.families import feasible, region
from contoursolve.output.families import range_data, range_lines, region_data, region_lines


@click.command("range", short_help="Tell for which values of a word, or of two, a contour exists.")
@block_options
@format_option
@click.option(
    "--word",
    "words",
    multiple=True,
    required=True,
    metavar="WORD",
    help="A word of the block, such as P, or 2:,A for line 2; start.X of the start point; a fact, by what it "
    "gives the value of. Given twice, the region of both.",
)
@click.option(
    "--within",
    multiple=True,
    metavar="LOW:HIGH",
    help="The range to look at, for each word in turn, as it stands; without it, one turn for an angle, and 1 m to "
    "either side for a length.",
)
@fact_option
@click.pass_context
def range_(
    context: click.Context,
    /,
    words: tuple[str, ...],
    within: tuple[str, ...],
    facts: tuple[str, ...],
    format_: str,
    **options: Any,
) -> None:
    """Tell for which values of WORD the contour of a block exists, and what ends each range of them.

    Every range is found: the values are divided until it is proven of each part that the contour exists there or does
    not. Each end is solved on both sides. For two words, the lines that bound the region are found, each with what
    fails beyond it; --format json has their points. With facts or ?, all solutions are followed, and the contour
    exists where one alone can be made; where they leave no closed form, sweep solves the block value by value.

    Exit status: 0 the contour exists for some value, 1 for none, 2 could not run.

    \b
    contoursolve range --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." --word P
    """
    ranges = [read_within(each) for each in within]
    if len(words) > 2 or (len(words) == 2 and len(ranges) != 2) or len(ranges) > len(words):  # noqa: PLR2004
        raise click.UsageError("name one --word, or two with a --within LOW:HIGH for each")
    with usage():
        about = {"facts": facts, **read_options(options)}
        if len(words) == 1:
            found = feasible(word=words[0], within=ranges[0] if ranges else None, **about)
            exists, lines, document = bool(found.intervals), range_lines(found), range_data(found)
        else:
            both = region(words=(words[0], words[1]), within=(ranges[0], ranges[1]), **about)
            exists, lines, document = both.exists, region_lines(both), region_data(both)
    if format_ == "json":
        print_json(document)
    else:
        print_lines(lines)
    context.exit(0 if exists else FOUND_ERRORS)
