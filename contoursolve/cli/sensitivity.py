"""The command that tells which word moves a point most."""

from math import isfinite
from typing import Any

import click

from contoursolve.cli.blocks import block_options, fact_option, format_option, print_json, read_options, usage
from contoursolve.cli.printing import print_lines
from contoursolve.families import tolerances
from contoursolve.output.families import tolerances_data, tolerances_lines


@click.command("sensitivity", short_help="Tell which word moves a point most, and what tolerances come to.")
@block_options
@format_option
@click.option(
    "--point", metavar="POINT", default="end", show_default=True, help="The point: end, V2, 'corner 1.center', ..."
)
@click.option(
    "--tolerance",
    "allowed",
    multiple=True,
    metavar="WORD=VALUE",
    help="By how much a word may be off to either side, as the number stands; may be repeated. A fact goes by what it "
    "gives the value of.",
)
@fact_option
def sensitivity(allowed: tuple[str, ...], point: str, facts: tuple[str, ...], format_: str, **options: Any) -> None:
    """Tell by how much each word moves a point of a contour: for each unit of it, by its tolerance, and by the rounding
    of the control to its least increment. What tolerances come to is told to first order, at worst and in the root of
    the sum of squares, and solved again at all combinations of their limits.

    Exit status: 0 told, 2 could not run, or the block has no contour.

    \b
    contoursolve sensitivity --block "G111 X100. A180. K-30. B120. P5. Q5." --start "X40. Z0." \\
      --tolerance A=0.1 --tolerance K=0.02
    """
    given: dict[str, float] = {}
    for name, number in map(_read_tolerance, allowed):
        if name in given:
            raise click.UsageError(f"--tolerance names {name} twice")
        given[name] = number
    with usage():
        found = tolerances(allowed=given, point=point, facts=facts, **read_options(options))
    if format_ == "json":
        print_json(tolerances_data(found))
    else:
        print_lines(tolerances_lines(found))


def _read_tolerance(text: str) -> tuple[str, float]:
    name, equals, value = text.rpartition("=")
    try:
        number = float(value)
    except ValueError:
        number = float("nan")
    if not equals or not isfinite(number):
        raise click.UsageError(f"--tolerance {text}: write WORD=VALUE, such as P=0.05")
    return name.strip(), number
