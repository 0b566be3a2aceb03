"""The command that writes a program for another control."""

import click

from contoursolve import api
from contoursolve.cli.expand import report_fixed, report_left, report_misread, report_told, target_of
from contoursolve.cli.options import (
    FILE,
    FOUND_ERRORS,
    control_option,
    naming,
    rules_option,
    settings_of,
    settings_option,
    units_option,
)
from contoursolve.cli.printing import print_bytes, say, style_of_output
from contoursolve.controls import CONTROLS, ChainFinder, ControlName
from contoursolve.diagnosis import count, join
from contoursolve.gcode import open_program_file, write_whole
from contoursolve.postprocess import Conversion, Post, post_of
from contoursolve.program import Rules, Units
from contoursolve.reading import Control

_TARGETS = tuple(name for name, control in CONTROLS.items() if isinstance(control.find, ChainFinder))


@click.command(short_help="Write a program's contours in another control's own words.")
@click.argument("program", metavar="OLD", type=FILE)
@control_option("For which control; convert writes nothing for yasnac-lx3, cnc-pilot and heidenhain.", "--to", _TARGETS)
@control_option("The control of OLD. Without it, found from OLD where that is clear.")
@units_option
@rules_option
@settings_option
@click.option("-o", "--output", metavar="NEW", help="Where to write; without it, or with -, to standard output.")
@click.option("--force", "is_forced", is_flag=True, help="Replace NEW if it exists.")
@click.option("--no-comments", is_flag=True, help="Do not keep the original blocks as comments.")
@click.pass_context
def convert(
    context: click.Context,
    /,
    program: str,
    to: ControlName | Control | None,
    control: ControlName | Control | None,
    units: Units,
    rules: Rules,
    assignments: tuple[str, ...],
    output: str | None,
    is_forced: bool,
    no_comments: bool,
) -> None:
    """Write OLD (a file, or - for standard input) for another control of the same kind of machine.

    Each contour is written in the words of the other control: lines by their ends or angles, corners by ,C and ,R. A
    contour that it has no words for is written out as G01, G02 and G03, and named. All other lines stay as they are.
    What the other control does not know in them is named, too.

    The new program is read again as the other control reads it. If its path is not that of OLD to within 0.002 mm,
    nothing is written.

    Exit status: 0 written, 1 nothing was written, 2 could not run.

    \b
    contoursolve convert shaft.nc --to fanuc-lathe -o shaft_fanuc.nc
    contoursolve convert plate.nc --control nct-99m --to fanuc-mill
    """
    if to is None:
        raise click.UsageError(f"say for which control: --to {'|'.join(_TARGETS)}")
    target = target_of(program, output, is_forced=is_forced)
    with open_program_file(program) as source, naming(source.name):
        found = api.convert(
            source.read(),
            to,
            comments=not no_comments,
            control=control,
            units=units,
            rules=rules,
            settings=settings_of(source, assignments),
            name=source.name,
        )
    if found.text is None:
        _report_failure(found, source.name, to)
        context.exit(FOUND_ERRORS)
    # In the encoding of the old program: what stays as it was does so byte for byte.
    pieces = (source.mark, source.encode(found.text))
    if target is None:
        print_bytes(pieces)
    else:
        write_whole(target, pieces, keeps_backup=False)
        say(f"{target} written", err=True)
    _report(found, to)


def _report_failure(found: Conversion, name: str, to: str | Control) -> None:
    """Print on standard error why nothing was written."""
    style = style_of_output()
    report_told(found.summary, _post(to))
    report_left(found.summary, name, style)
    report_misread(found.summary, _post(to), style, is_kept=False)
    difference = found.comparison.difference if found.comparison else None
    if difference is not None:
        lines = [
            f"program line {step.line} of {side}"
            for side, step in (("OLD", difference.old), ("NEW", difference.new))
            if step
        ]
        say(f"the new program is another path: {difference.reason} ({join(lines)})", err=True)
    say("nothing was written", err=True)


def _report(found: Conversion, to: str | Control) -> None:
    """Print on standard error what was converted, and how it was compared."""
    summary, post = found.summary, _post(to)
    report_fixed(summary, style_of_output())
    report_told(summary, post)
    if not summary.replaced:
        say("no contour block: nothing to convert", err=True)
        return
    done = f"{count(summary.in_words, 'contour')} in the words of {post.name}"
    if summary.written_out:
        lines = join([str(line) for line in summary.written_out])
        done += f", {len(summary.written_out)} written out (program line {lines})"
    assert found.comparison is not None
    say(f"{done}; the same path, at most {found.comparison.deviation:.1g} mm off", err=True)


def _post(to: str | Control) -> Post:
    return post_of(CONTROLS[to] if isinstance(to, str) else to)
