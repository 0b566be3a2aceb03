"""The command that finds the value of a word with which a point lies where it is wanted."""

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
from contoursolve.families import find_word
from contoursolve.output.families import found_data, found_lines


@click.command("find", short_help="Find the value of a word that brings a point where it is wanted.")
@block_options
@format_option
@click.option(
    "--word",
    required=True,
    metavar="WORD",
    help="A word of the block, such as A, or 2:,A for line 2; start.X of the start point; a fact, by what it "
    "gives the value of.",
)
@click.option(
    "--bring",
    "goal",
    required=True,
    metavar="GOAL",
    help="A point and where it is wanted, in words as the control reads them: 'end Z-50.', 'V1 X44.', "
    "'corner 1.center Z-20.'. With both coordinates, what comes nearest is found.",
)
@click.option(
    "--within",
    metavar="LOW:HIGH",
    help="The values to look at, as they stand; without it, one turn for an angle, and 1 m to either side for a "
    "length.",
)
@fact_option
@click.pass_context
def find(
    context: click.Context,
    /,
    word: str,
    goal: str,
    within: str | None,
    facts: tuple[str, ...],
    format_: str,
    **options: Any,
) -> None:
    """Find every value of WORD with which a point of the contour lies where it is wanted.

    Each value is solved and certified by itself, and given once more rounded to the control's least increment, as the
    block to write and how far the point is off then.

    Exit status: 0 found, 1 no such value, 2 could not run.

    \b
    contoursolve find --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." --word A --bring "end Z-50."
    """
    with usage():
        limits = read_within(within) if within else None
        found = find_word(word=word, goal=goal, within=limits, facts=facts, **read_options(options))
    if format_ == "json":
        print_json(found_data(found))
    else:
        print_lines(found_lines(found))
    context.exit(0 if found.hits else FOUND_ERRORS)
