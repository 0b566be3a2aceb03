"""The command that compares two programs."""

from functools import partial
from pathlib import Path
from typing import Any

import click

from contoursolve.cli.brief_help import LongCommand
from contoursolve.cli.options import (
    FILE,
    FOUND_ERRORS,
    check_toolless,
    control_option,
    format_option,
    let_option,
    naming,
    path_option,
    print_findings,
    rules_option,
    settings_option,
    tool_options,
    units_option,
)
from contoursolve.cli.pictures import bytes_of, check_picture, theme_option
from contoursolve.cli.printing import print_lines, say
from contoursolve.comparing import ANY_CONTROL, compare_programs
from contoursolve.gcode import write_whole
from contoursolve.geometry import Length
from contoursolve.pictures import Theme
from contoursolve.program import SolveOptions, read_setting
from contoursolve.reading import Control


@click.command(cls=LongCommand, short_help="Tell whether two programs describe the same path.")
@click.argument("old", metavar="OLD", type=FILE)
@click.argument("new", metavar="NEW", type=FILE)
@click.option(
    "--tolerance",
    type=click.FloatRange(min=0, min_open=True, max=1),
    default=0.001,
    show_default=True,
    metavar="MM",
    help="How far apart the paths may be, in mm.",
)
@control_option("The control of OLD. Without it, found from OLD where that is clear.", names=ANY_CONTROL)
@control_option(
    "The control of NEW. Without it, that named for OLD, unless NEW has words of another; or found from NEW.",
    "--new-control",
    ANY_CONTROL,
)
@let_option
@path_option
@units_option
@click.option(
    "--new-units", type=click.Choice([unit.value for unit in Length]), help="The same for NEW. Without it, as for OLD."
)
@rules_option
@settings_option
@tool_options
@click.option(
    "--plot",
    "picture",
    metavar="FILE",
    type=click.Path(path_type=Path),
    help="Where to draw both paths, with their differences marked: FILE.svg or FILE.png.",
)
@theme_option
@click.option("--force", "is_forced", is_flag=True, help="Replace the picture if it exists.")
@format_option
@click.pass_context
def diff(
    context: click.Context,
    /,
    old: str,
    new: str,
    tolerance: float,
    control: str | Control | None,
    new_control: str | Control | None,
    variables: dict[str, float],
    folders: tuple[str, ...],
    units: str,
    new_units: str | None,
    rules: str,
    assignments: tuple[str, ...],
    format_: str,
    tool: str | None,
    picture: Path | None,
    theme: str,
    is_forced: bool,
    **stated: Any,
) -> None:
    """Tell whether OLD and NEW describe the same path, and if not, every difference, the largest first.

    diff solves the contours and follows all moves by G0 to G3, and the path functions of Klartext. It follows calls,
    jumps and variables, too. It reads either program as its own control does. Either program may divide a line or an
    arc. Cycles and other blocks that diff does not follow must be the same word by word. diff lists them.

    Each difference has its lines, the words that changed, and the largest distance of the paths there. A move that
    only one program has shifts nothing behind it. Compensation, work offset and plane count as path. What
    changed besides the path is listed apart: tools, D, H, feeds, leads, speeds, dwells, M functions and comments.

    With --tool, a program with G41 or G42 (RL or RR) stands for the path of the tool beside it. A program without
    them is the path of the tool itself. With --side, OLD is a contour, too.

    Exit status: 0 the same path, 1 not the same or not solved, 2 could not run.

    \b
    contoursolve diff shaft.nc shaft_by_hand.nc
    contoursolve diff shaft.nc shaft.ngc --new-control linuxcnc --tolerance 0.002
    contoursolve diff shaft.nc by_hand.nc --tool R0.8 --tip 3
    contoursolve diff shaft.nc shaft_b.nc --plot differences.svg
    """
    from contoursolve.comparison import NotComparedError  # noqa: PLC0415 - only here
    from contoursolve.output import differences  # noqa: PLC0415 - only here

    if old == new == "-":
        raise click.UsageError("only one of OLD and NEW can be standard input")
    if tool is None:
        check_toolless(stated)
    if picture is not None:
        check_picture(picture, is_forced=is_forced)
    settings = dict(map(read_setting, assignments))
    told = SolveOptions(
        control=control, units=units, rules=rules, settings=settings, variables=variables, folders=folders
    )
    try:
        comparison = compare_programs(
            Path(old),
            Path(new),
            told,
            partial(naming, options="--control or --new-control"),
            tolerance=tolerance,
            new_control=new_control,
            new_units=new_units,
            tool={"tool": tool, **stated},
        )
    except NotComparedError as error:
        if format_ == "json":
            click.echo(differences.refusal_to_json(error.results))
        else:
            for result, asked, path in zip(error.results, error.asked, (old, new), strict=True):
                print_findings(result, path, control=asked.control, units=asked.unit.value)
            say("not compared: a program that has errors has no path")
        context.exit(FOUND_ERRORS)
    if format_ == "json":
        click.echo(differences.to_json(comparison))
    else:
        print_lines(differences.comparison_lines(comparison))
    if picture is not None:
        from contoursolve.pictures import draw_comparison  # noqa: PLC0415 - only here

        drawn = bytes_of(draw_comparison(comparison, theme=Theme(theme)), picture)
        write_whole(picture, [drawn], keeps_backup=False)
        say(f"{picture} written", err=True)
    context.exit(0 if comparison.is_equal else FOUND_ERRORS)
