"""The command that writes a program for another control."""

from collections.abc import Mapping, Sequence

import click

from contoursolve import api
from contoursolve.cli.expand import target_of
from contoursolve.cli.options import (
    FILE,
    FOUND_ERRORS,
    control_option,
    let_option,
    naming,
    path_option,
    rules_option,
    settings_of,
    settings_option,
    units_option,
)
from contoursolve.cli.printing import print_bytes, say, style_of_output
from contoursolve.controls import CONTROLS, ChainFinder, ControlName
from contoursolve.diagnosis import count, join
from contoursolve.gcode import open_program_file, write_whole
from contoursolve.postprocess import Conversion, words_of_control
from contoursolve.program import Rules, Units
from contoursolve.reading import Control

_TARGETS = tuple(name for name, control in CONTROLS.items() if isinstance(control.find, ChainFinder) or control.writing)


@click.command(short_help="Write a program in another control's own words.")
@click.argument("program", metavar="OLD", required=False, type=FILE)
@control_option("For which control; convert writes nothing for yasnac-lx3 and cnc-pilot.", "--to", _TARGETS)
@control_option("The control of OLD. Without it, found from OLD where that is clear.")
@units_option
@rules_option
@settings_option
@let_option
@path_option
@click.option("-o", "--output", metavar="NEW", help="Where to write; without it, or with -, to standard output.")
@click.option("--force", "is_forced", is_flag=True, help="Replace NEW if it exists.")
@click.option(
    "--no-comments", is_flag=True, help="Do not keep the blocks of contours that are written out as comments."
)
@click.option(
    "--words",
    "is_table",
    is_flag=True,
    help="Print the words of the control of --to for tools, feeds, offsets and the rest, with where each stands.",
)
@click.pass_context
def convert(
    context: click.Context,
    /,
    program: str | None,
    to: ControlName | Control | None,
    control: ControlName | Control | None,
    units: Units,
    rules: Rules,
    assignments: tuple[str, ...],
    variables: Mapping[str, float],
    folders: Sequence[str],
    output: str | None,
    is_forced: bool,
    no_comments: bool,
    is_table: bool,
) -> None:
    """Write OLD (a file, or - for standard input) for another control of the same kind of machine.

    Each contour is written in the words of the other control: lines by their ends or angles, corners as its corner
    words. A contour that it has no words for is written out as lines and arcs, and named. Head, end, feeds, speeds,
    tools, offsets and comments are written as that control writes them. Calls, jumps and variables stay where the other
    control reads them alike. For others they are written out, with the values that they have; a subprogram of another
    file stands where it is called.

    What has no counterpart stands in its place as a comment, NOT CONVERTED, and is listed with its line. The new
    program is read again as the other control reads it. If its path is not that of OLD to within 0.002 mm, but for what
    is listed, nothing is written.

    Exit status: 0 all of it is converted, 1 something is not, or nothing was written, 2 could not run.

    \b
    contoursolve convert shaft.nc --to fanuc-lathe -o shaft_fanuc.nc
    contoursolve convert plate.nc --control nct-99m --to fanuc-mill
    contoursolve convert --to isg --words
    """
    if to is None:
        raise click.UsageError(f"say for which control: --to {'|'.join(_TARGETS)}")
    if is_table:
        say("\n".join(words_of_control(CONTROLS[to] if isinstance(to, str) else to)))
        return
    if program is None:
        raise click.UsageError("name a program (- for standard input)")
    target = target_of(program, output, is_forced=is_forced)
    with open_program_file(program) as source, naming(source.name):
        found = api.convert(
            source.read(),
            to,
            comments=not no_comments,
            variables=variables,
            folders=folders,
            control=control,
            units=units,
            rules=rules,
            settings=settings_of(source, assignments),
            name=source.name,
        )
    if found.text is None:
        _report_failure(found)
        context.exit(FOUND_ERRORS)
    # In the encoding of the old program: what stays as it was does so byte for byte.
    pieces = (source.mark, source.encode(found.text))
    if target is None:
        print_bytes(pieces)
    else:
        write_whole(target, pieces, keeps_backup=False)
        say(f"{target} written", err=True)
    _report(found)
    context.exit(FOUND_ERRORS if found.not_converted else 0)


def _report_failure(found: Conversion) -> None:
    """Print on standard error why nothing was written."""
    difference = found.comparison.difference if found.comparison else None
    if difference is not None:
        lines = [
            f"program line {step.line} of {side}"
            for side, step in (("OLD", difference.old), ("NEW", difference.new))
            if step
        ]
        say(f"the new program is another path: {difference.reason} ({join(lines)})", err=True)
    say("nothing was written", err=True)


def _report(found: Conversion) -> None:
    """Print on standard error what was converted, and how it was compared."""
    style, summary = style_of_output(), found.summary
    for each in found.not_converted:
        say(f"program line {each.line}: {style('warning', 'warning')}: {each.sentence}", err=True)
    for note in found.notes:
        say(f"{style('info', 'info')}: {note}", err=True)
    done = f"{count(summary.in_words, 'contour')} in the words of {found.to}"
    if summary.written_out:
        out = join([str(line) for line in summary.written_out])
        done += f", {len(summary.written_out)} written out (program line {out})"
    assert found.comparison is not None
    left = [str(line) for line in dict.fromkeys(each.line for each in found.not_converted)]
    lines = "lines" if len(left) > 1 else "line"
    but = f" but for what is not converted (program {lines} {join(left)})" if left else ""
    say(f"{done}; the same path{but}, at most {found.comparison.deviation:.1g} mm off", err=True)
