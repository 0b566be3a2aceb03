"""The command that draws contours."""

from pathlib import Path
from typing import Any

import click

from contoursolve.cli.loading import examine, load
from contoursolve.cli.options import (
    FOUND_ERRORS,
    CouldNotRunError,
    common_options,
)
from contoursolve.cli.printing import print_lines, style_of_output
from contoursolve.files import CannotWriteError, check_target, write_whole
from contoursolve.output.layout import count
from contoursolve.output.listing import lines_of_findings, summary_line


@click.command(short_help="Draw the contours for CAD (DXF).")
@click.argument("program", required=False)
@click.option(
    "-o", "--output", required=True, metavar="OUT.dxf", type=click.Path(path_type=Path), help="The drawing to write."
)
@click.option("--force", "is_forced", is_flag=True, help="Replace the drawing if it exists.")
@common_options
@click.pass_context
def plot(
    context: click.Context,
    /,
    program: str | None,
    output: Path,
    is_forced: bool,
    blocks: tuple[str, ...],
    start: str | None,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Draw every solved contour of PROGRAM (a file, or - for standard input) into a DXF file.

    Lines and arcs in full precision, each element on a layer of its own; virtual and computed intersections on the
    layer construction. The drawing's X and Y are the plane's axes: on a lathe Z to the right and X up, as radius. It
    is in mm, or in inches if all contours are. Needs the extra contoursolve[dxf].

    \b
    contoursolve plot shaft.nc -o shaft.dxf
    contoursolve plot --block "G111 X100. A180. K-30. B120. P5." --start "X40. Z0." -o block.dxf --force
    """
    if output.suffix.lower() != ".dxf":
        raise CouldNotRunError(f"{output}: drawings end in .dxf; SVG and PNG are not made yet")
    loader = load([program] if program else [], blocks, start)[0]
    try:
        from contoursolve.output.drawing_dxf import to_dxf  # noqa: PLC0415 - needs an extra
    except ModuleNotFoundError as error:
        if error.name != "ezdxf":
            raise
        raise CouldNotRunError("a DXF drawing needs ezdxf; install it with: pip install 'contoursolve[dxf]'") from None
    try:
        check_target(output, Path(program) if program else None, is_forced=is_forced)
        result = examine(loader(), start, assignments, options)
        print_lines(lines_of_findings(result, result.diagnostics, style_of_output()))
        contours = [answer.contour for answer in result.answers if answer.contour]
        if contours:
            write_whole(output, [to_dxf(result.answers)], keeps_backup=False)
    except CannotWriteError as error:
        raise CouldNotRunError(str(error)) from None
    elements = count(sum(len(contour.elements) for contour in contours), "element")
    written = f"{output}: {elements} of {count(len(contours), 'contour')}" if contours else f"{output}: not written"
    click.echo(summary_line([result]))
    click.echo(written)
    context.exit(FOUND_ERRORS if result.has_errors or not contours else 0)
