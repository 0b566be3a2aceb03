"""The command that checks a claimed answer."""

from typing import Any

import click

from contoursolve.cli.options import (
    COULD_NOT_RUN,
    FILE,
    FOUND_ERRORS,
    apart_options,
    control_option,
    units_option,
)
from contoursolve.cli.printing import print_lines


@click.command(short_help="Check a claimed answer, independently.")
@click.argument("inputs", nargs=-1, metavar="PROGRAM RESULT.json", type=FILE)
@apart_options
@control_option("The control. Without it, the one that the result names.")
@units_option
@click.option(
    "--format",
    "format_",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="What to print: text, or a receipt with every check, how far it is off, and its limit.",
)
@click.pass_context
def verify(
    context: click.Context,
    /,
    inputs: tuple[str, ...],
    blocks: tuple[str, ...],
    start: str | None,
    format_: str,
    **options: Any,
) -> None:
    """Check RESULT.json against the words of PROGRAM (one of them may be -), without the solver.

    RESULT.json is what solve printed with --format json. verify measures the value of each word at the points and
    elements of the result: joints, tangency, senses, sizes, planes, and each answer to a ?. The status follows from how
    many unknowns the equations fix there. verify solves nothing. It shares with solve which contours a program has and
    what their words state. It also names what it did not check. It reads the program with the settings that RESULT.json
    names. Give --block, --start, --fact, --variable and --path as you gave them to solve.

    Exit status: 0 what was checked is right, 1 something is wrong, 2 could not run, or nothing could be checked.

    \b
    contoursolve solve shaft.nc --format json > shaft.json
    contoursolve verify shaft.nc shaft.json
    contoursolve verify --block "G111 X100. A180. K-30. B120." --start "X40. Z0." block.json
    """
    from contoursolve import comparison  # noqa: PLC0415 - only here
    from contoursolve.output import receipt_json, receipt_lines  # noqa: PLC0415 - only here

    if inputs.count("-") > 1:
        raise click.UsageError("only one of PROGRAM and RESULT.json can be standard input")
    if blocks and len(inputs) != 1:
        raise click.UsageError("with --block, name RESULT.json and no PROGRAM")
    if not blocks and len(inputs) != 2:  # noqa: PLR2004 - the two that the usage names
        raise click.UsageError("name PROGRAM and RESULT.json, or --block and RESULT.json")
    program = comparison.Document.of_blocks(blocks) if blocks else comparison.read_document(inputs[0])
    receipt = comparison.verify(program, comparison.read_document(inputs[-1]), start=start, **options)
    if format_ == "json":
        click.echo(receipt_json(receipt))
    else:
        print_lines(receipt_lines(receipt))
    verdict = comparison.ReceiptVerdict
    context.exit({verdict.FAILED: FOUND_ERRORS, verdict.NOTHING_CHECKED: COULD_NOT_RUN}.get(receipt.verdict, 0))
