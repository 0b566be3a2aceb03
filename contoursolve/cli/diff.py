"""The command that compares two programs."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from contoursolve.api import read_program
from contoursolve.cli.options import (
    FILE,
    FOUND_ERRORS,
    CouldNotRunError,
    check_toolless,
    control_option,
    format_option,
    let_option,
    naming,
    path_option,
    print_findings,
    rules_option,
    settings_of,
    settings_option,
    tool_options,
    units_option,
)
from contoursolve.cli.pictures import bytes_of, check_picture, theme_option
from contoursolve.cli.printing import print_lines, say
from contoursolve.controls import CONTROLS, PLAIN
from contoursolve.gcode import Program, write_whole
from contoursolve.geometry import Length
from contoursolve.pictures import Theme
from contoursolve.program import CONTROL, Request, Result, SolveOptions, choose_alike, configure, run
from contoursolve.reading import Control, ReadIssue

if TYPE_CHECKING:
    from contoursolve.comparison import ToolPath

_ANY_CONTROL = (*CONTROLS, *PLAIN)


@click.command(short_help="Tell whether two programs describe the same path.")
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
@control_option("The control of OLD. Without it, found from OLD where that is clear.", names=_ANY_CONTROL)
@control_option(
    "The control of NEW. Without it, that named for OLD, unless NEW has words of another; or found from NEW.",
    "--new-control",
    _ANY_CONTROL,
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
    from contoursolve.comparison import compare, follow  # noqa: PLC0415 - only here
    from contoursolve.output import differences  # noqa: PLC0415 - only here

    if old == new == "-":
        raise click.UsageError("only one of OLD and NEW can be standard input")
    if tool is None:
        check_toolless(stated)
    if picture is not None:
        check_picture(picture, is_forced=is_forced)
    sides: list[tuple[Result, Control, Request]] = []
    for path, own, unit in ((old, control, units), (new, new_control, new_units or units)):
        program = read_program(path)
        before = sides[0][1] if sides else None
        is_kept = control is not None and before is not None and _reads_what_shows_others(before, program)
        chosen = _control_of(program, own or (before if is_kept else None), before, assignments, folders)
        told = SolveOptions(units=unit, rules=rules, variables=variables, folders=folders, strict=True)
        asked = told.request(program.name, chosen)
        sides.append((run(program, asked), chosen, asked))
    results = [result for result, _, _ in sides]
    if any(map(_has_no_path, results)):
        if format_ == "json":
            click.echo(differences.refusal_to_json(results))
        else:
            for (result, chosen, asked), path in zip(sides, (old, new), strict=True):
                print_findings(result, path, control=chosen, units=asked.unit.value)
            say("not compared: a program that has errors has no path")
        context.exit(FOUND_ERRORS)
    axes = tuple(sorted({axis for _, chosen, _ in sides for axis in chosen.modes.axes}))
    finishes = tool is not None
    one, other = (follow(result, chosen, asked.unit, axes, finishes=finishes) for result, chosen, asked in sides)
    if tool is not None:
        one, other = _beside_tool(sides, (one, other), tool, stated)
    comparison = compare(one, other, tolerance)
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


def _beside_tool(
    sides: Sequence[tuple[Result, Control, Request]],
    paths: "Sequence[ToolPath]",
    tool: str,
    stated: dict[str, Any],
) -> "list[ToolPath]":
    """The paths of the tool beside contours, and those that are paths of it already. Raises CouldNotRunError."""
    from contoursolve.tool_radius import is_compensated, look_at_tool, path_of_tool, wanted_tool  # noqa: PLC0415

    found: list[ToolPath] = []
    for (result, _, asked), path in zip(sides, paths, strict=True):
        own = stated if not found else {**stated, "side": None}
        if not is_compensated(path) and own["side"] is None:
            found.append(path)
            continue
        name = result.program.name
        with naming(name):
            report = look_at_tool(result, asked, wanted_tool(name, tool, **own), path.axes)
        error = next((each for each in report.findings if each.is_error), None)
        if error is not None:
            told = f"{error.message}; contoursolve check {name} --tool {tool} tells more"
            raise CouldNotRunError(f"{name}: program line {error.span.line}: {told}")
        found.append(path_of_tool(report))
    if all(one is other for one, other in zip(found, paths, strict=True)):
        raise CouldNotRunError("neither program has G41 or G42 (RL or RR); say --side left or right of OLD")
    return found


def _reads_what_shows_others(control: Control, program: Program) -> bool:
    """Whether a control has every word by which a program shows another one, so that it need not be for that one."""
    others = [other for other in CONTROLS.values() if other.name != control.name]
    shown = [word for other in others for block in program.blocks for word in other.signs(block)]
    addresses, codes = control.modes.lexicon.addresses, control.modes.codes
    return all(word.number in codes if word.address == "G" else word.address in addresses for word in shown)


def _control_of(
    program: Program,
    control: str | Control | None,
    otherwise: Control | None,
    assignments: Sequence[str],
    folders: Sequence[str],
) -> Control:
    """The control of a program: the one that is named, or that it shows, or another."""
    with naming(program.name, "--control or --new-control"):
        settings = settings_of(program, assignments)
        name = control or settings.get(CONTROL)
        named = {**CONTROLS, **PLAIN}[name] if isinstance(name, str) else name
        shown = (
            None
            if named
            else choose_alike(None, program, SolveOptions(folders=folders).request(program.name), settings)
        )
        chosen = named or shown or otherwise
        if chosen is not None:
            return shown or configure(chosen, settings)
    choices = "|".join(_ANY_CONTROL)
    raise CouldNotRunError(f"{program.name}: no block shows the control; say which with --control {choices}")


def _has_no_path(result: Result) -> bool:
    """Whether a program has errors; that it has no contour is none here."""
    errors = (each for each in result.diagnostics if each.is_error)
    return any(each.about is not ReadIssue.NO_CONTOUR for each in errors)
