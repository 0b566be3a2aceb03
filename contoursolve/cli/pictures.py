"""The commands draw and report: pictures and pages as files."""

import sys
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from contoursolve import __version__
from contoursolve.cli.brief_help import LongCommand
from contoursolve.cli.options import (
    FILE,
    FOUND_ERRORS,
    CouldNotRunError,
    common_options,
    explain_option,
    follow,
    is_sketch,
    load,
    named_after,
    print_findings,
    tool_options,
)
from contoursolve.cli.printing import is_screen, say
from contoursolve.diagnosis import Answer, count
from contoursolve.diagnostics import importing
from contoursolve.gcode import Program, check_target, write_whole
from contoursolve.output import Collected, beside_of, summary_line
from contoursolve.pictures import Picture, Theme, draw_answer, draw_result
from contoursolve.program import Result

if TYPE_CHECKING:
    from contoursolve.tool_radius import ToolReport

SVG, PNG = ".svg", ".png"

theme_option = click.option(
    "--theme",
    type=click.Choice([Theme.LIGHT.value, Theme.DARK.value, Theme.PAGE.value]),
    default=Theme.LIGHT.value,
    show_default=True,
    help="Colours of a picture; page follows the page or the reader of an SVG.",
)


def bytes_of(picture: Picture, target: Path) -> bytes:
    """A picture as its name asks for. Raises MissingExtraError."""
    return picture.png() if target.suffix.lower() == PNG else picture.svg.encode()


def check_picture(target: Path, *, is_forced: bool) -> None:
    """Raise CouldNotRunError or CannotWriteError if a picture cannot be written there."""
    if target.suffix.lower() not in (SVG, PNG):
        raise CouldNotRunError(f"{target}: pictures end in .svg or .png")
    check_target(target, None, is_forced=is_forced)


def _may_replace(target: Path, output: Path | None, *, is_forced: bool) -> bool:
    """Whether a file may be replaced: one of the name that nobody chose, if it was written here before."""
    if is_forced or output is not None or not target.is_file():
        return is_forced
    with target.open("rb") as file:
        beginning = file.read(_BEGINNING)
    return any(mark in beginning for mark in _MARKS)


_BEGINNING = 1024
_MARKS = (b'<svg xmlns="http://www.w3.org/2000/svg" id="cs-', b'<meta name="generator" content="contoursolve ')
"""First bytes of drawings and pages of this tool."""

_DXF = ".dxf"

WrittenFile = tuple[Path, bytes, str]
"""A file, its bytes, and what is in it."""


@click.command(cls=LongCommand, short_help="Draw the contours (SVG, PNG), or write them for CAD (DXF).")
@click.argument("program", required=False, type=FILE)
@click.option(
    "-o",
    "--output",
    metavar="OUT.svg|.png|.dxf",
    type=click.Path(path_type=Path),
    help="The drawing to write; without it, an SVG with the name of PROGRAM in this folder.",
)
@click.option("--line", type=click.IntRange(1), help="Draw the contour that this line of PROGRAM belongs to, alone.")
@click.option("--each", "is_each", is_flag=True, help="Draw every contour in a file of its own: OUT-LINE.svg.")
@click.option(
    "--whole/--half",
    "is_whole",
    default=None,
    help="Draw turned parts with both halves, or the programmed half alone; without either, with both where the "
    "contours stay at least half as large.",
)
@theme_option
@click.option(
    "--force", "is_forced", is_flag=True, help="Replace drawings that exist; without -o, its own are replaced anyway."
)
@common_options
@tool_options
@click.pass_context
def draw(
    context: click.Context,
    /,
    program: str | None,
    output: Path | None,
    line: int | None,
    is_each: bool,
    is_whole: bool | None,
    theme: str,
    is_forced: bool,
    blocks: tuple[str, ...],
    start: str | None,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Draw the contours of PROGRAM (a file, or - for standard input).

    SVG and PNG show a contour with every word as a dimension: given, worked out, ignored, conflicting or still free.
    They show a refused contour, too: what is missing, both places of a point, the line that misses its circle. A
    program with several contours makes one drawing, each contour with its number and line; --line and --each draw them
    one by one. PNG needs the extra contoursolve[picture].

    Of a sketch (a .toml file), the drawing shows what is known, what can still slide, and what contradicts.

    DXF is for CAD and needs the extra contoursolve[dxf]: every solved contour in full precision, each element on a
    layer of its own; virtual and computed intersections on the layer construction. The drawing's X and Y are the
    plane's axes: on a lathe Z to the right and X up, as radius. It is in mm, or in inches if all contours are.

    \b
    contoursolve draw shaft.nc
    contoursolve draw shaft.nc --line 71 -o journal.png
    contoursolve draw --block "G111 X100. A180. K-30. B120. P5." --start "X40. Z0." -o block.dxf
    """
    loader = load([program] if program else [], blocks)[0]
    target = output if output is not None else named_after(program, SVG)
    kind = target.suffix.lower()
    if kind not in (SVG, PNG, _DXF):
        raise CouldNotRunError(f"{target}: drawings end in .svg, .png or .dxf")
    if kind == _DXF and (line is not None or is_each):
        raise click.UsageError("a DXF drawing has every contour on layers of its own: leave out --line and --each")
    if line is not None and is_each:
        raise click.UsageError("give either --line or --each, not both")
    if is_whole is not None and (kind == _DXF or line is not None or is_each):
        raise click.UsageError("--whole and --half are for a picture of all contours: leave out --line, --each and DXF")
    source = Path(program) if program else None
    if not is_each:
        check_target(target, source, is_forced=_may_replace(target, output, is_forced=is_forced))
    if is_sketch(program):
        _draw_sketched(context, loader(), target, Theme(theme))
    run = follow(loader(), start, assignments, options)
    result, tool = run.collect(), run.tool if isinstance(run, Collected) else None
    print_findings(result, program)
    if kind == _DXF:
        files = _drawings_for_cad(result, target, tool)
    else:
        files = list(_pictures(result, target, line, Theme(theme), tool, is_each=is_each, is_whole=is_whole))
    for path, _, _ in files if is_each else ():
        check_target(path, source, is_forced=_may_replace(path, output, is_forced=is_forced))
    for path, data, _ in files:
        write_whole(path, [data], keeps_backup=False)
    say(summary_line(result, tool=tool))
    for path, _, content in files:
        say(f"{path}: {content}")
    if not files:
        say(f"{target}: not written")
    context.exit(FOUND_ERRORS if result.has_errors or not files else 0)


def _draw_sketched(context: click.Context, program: Program, target: Path, theme: Theme) -> None:
    """Draw what is known of a sketch, say what is missing, and end the command."""
    if target.suffix.lower() == _DXF:
        raise CouldNotRunError(f"{target}: a drawing for CAD is made of a program; `contoursolve write` makes one")
    from contoursolve.cli.sketched import picture_of, refuse_options  # noqa: PLC0415 - most runs have programs

    refuse_options(context)
    picture, result = picture_of(program, theme)
    print_findings(result, program.name)
    if picture is None:
        say(f"{target}: not written, for nothing is known where it begins")
    else:
        write_whole(target, [bytes_of(picture, target)], keeps_backup=False)
        say(f"{target}: {picture.title}")
    context.exit(FOUND_ERRORS if result.has_errors or picture is None else 0)


def _pictures(
    result: Result,
    target: Path,
    line: int | None,
    theme: Theme,
    tool: "ToolReport | None",
    *,
    is_each: bool,
    is_whole: bool | None,
) -> Iterator[WrittenFile]:
    """The pictures that are asked for."""

    def of_one(answer: Answer) -> bytes:
        return bytes_of(draw_answer(answer, theme=theme, beside=beside_of(tool, answer)), target)

    beside = beside_of(tool)
    if not result.answers and not beside:
        return
    if is_each:
        for answer in result.answers:
            yield target.with_name(f"{target.stem}-{answer.lines[0]}{target.suffix}"), of_one(answer), _about(answer)
        return
    if line is not None:
        try:
            answer = result.contour_at(line)
        except ValueError as error:
            raise CouldNotRunError(str(error)) from error
        yield target, of_one(answer), _about(answer)
        return
    picture = draw_result(result, theme=theme, is_whole=is_whole, beside=beside)
    told = count(len(result.answers) or len(beside), "contour") + (" with the tool" if beside else "")
    yield target, bytes_of(picture, target), told


def _about(answer: Answer) -> str:
    return f"program line {answer.lines[0]}, {answer.state}"


def _drawings_for_cad(result: Result, target: Path, tool: "ToolReport | None") -> list[WrittenFile]:
    """The DXF drawing, if anything is solved."""
    with importing("dxf", "a DXF drawing"):
        from contoursolve.output import drawing_for_cad  # noqa: PLC0415 - needs an extra

        drawn = drawing_for_cad(result, tool)
    return [] if drawn is None else [(target, *drawn)]


def _date_of(program: str | None) -> str:
    """The day on which a file was changed, in UTC; empty for what is no file."""
    if program is None or not Path(program).is_file():
        return ""
    return datetime.fromtimestamp(Path(program).stat().st_mtime, UTC).date().isoformat()


@click.command(cls=LongCommand, short_help="Make a page about a program, to read, send and print.")
@click.argument("program", required=False, type=FILE)
@click.option(
    "-o",
    "--output",
    metavar="OUT.html",
    type=click.Path(path_type=Path),
    help="The page to write; without it, one with the name of PROGRAM in this folder.",
)
@click.option(
    "--force", "is_forced", is_flag=True, help="Replace the page if it exists; without -o, its own is replaced anyway."
)
@explain_option("the equations and the construction of each contour")
@common_options
@tool_options
@click.pass_context
def report(
    context: click.Context,
    /,
    program: str | None,
    output: Path | None,
    is_forced: bool,
    is_explained: bool,
    blocks: tuple[str, ...],
    start: str | None,
    assignments: tuple[str, ...],
    **options: Any,
) -> None:
    """Make one page of HTML about PROGRAM (a file, or - for standard input).

    First the title block, the drawing, all points and the findings, those that say the same as one: one sheet of paper
    for a program of 30 lines. Then each contour that has errors with its picture (with --explain each contour), and
    the program's text. The manual's places stand last, with how well each is known. The page opens without a network,
    in light and dark, and prints. report writes none for a program without a contour.

    \b
    contoursolve report shaft.nc
    contoursolve report --block "G111 X100. A180. K-30. B120. P5." --start "X40. Z0." -o block.html --force
    """
    loader = load([program] if program else [], blocks)[0]
    target = output if output is not None else named_after(program, ".html")
    if target.suffix.lower() not in (".html", ".htm"):
        raise CouldNotRunError(f"{target}: pages end in .html")
    from contoursolve.output import report_page  # noqa: PLC0415 - htpy is slow to import

    may_replace = _may_replace(target, output, is_forced=is_forced)
    check_target(target, Path(program) if program else None, is_forced=may_replace)
    run = follow(loader(), start, assignments, options)
    result, tool = run.collect(), run.tool if isinstance(run, Collected) else None
    if not result.answers and (tool is None or not tool.runs):
        print_findings(result, program)
        say(f"{summary_line(result)}\n{target}: not written")
        context.exit(FOUND_ERRORS)
    with click.progressbar(
        length=len(result.answers), label="drawing", file=sys.stderr, hidden=not is_screen(sys.stderr)
    ) as bar:
        options = {"is_explained": is_explained, "tool": tool, "date": _date_of(program)}
        pieces = report_page(result, __version__, lambda: bar.update(1), **options)
        write_whole(target, (piece.encode("utf-8", "replace") for piece in pieces), keeps_backup=False)
    say(summary_line(result, is_explained=True, tool=tool))
    say(f"{target} written")
    context.exit(FOUND_ERRORS if result.has_errors else 0)
