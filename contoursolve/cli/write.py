"""The command `write`: a sketch as a small program for a control, or in the words of all controls."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from contoursolve import gcode
from contoursolve.cli.brief_help import LongCommand
from contoursolve.cli.drawing import drawing_options, read_drawn
from contoursolve.cli.expand import target_of
from contoursolve.cli.options import (
    COULD_NOT_RUN,
    FILE,
    FOUND_ERRORS,
    CouldNotRunError,
    control_option,
    format_option,
    is_sketch,
    print_findings,
    settings_option,
)
from contoursolve.cli.printing import print_json, print_lines, say
from contoursolve.controls import ControlName
from contoursolve.diagnosis import count
from contoursolve.diagnostics import members
from contoursolve.gcode import STANDARD_INPUT, decode, read_bytes, write_whole
from contoursolve.postprocess import NumberGround, WrittenContour, WrittenContours, WrittenWord
from contoursolve.program import find_settings, read_setting
from contoursolve.reading import Control
from contoursolve.sketches import (
    UnfinishedError,
    read_sketch_file,
    sketch_result,
    write as write_contour,
    write_sketch,
)

SCHEMA = "contoursolve/write/1"


@click.command(cls=LongCommand, short_help="Write a sketch as a program for a control.")
@click.argument("sketch", metavar="SKETCH", type=FILE)
@control_option("For which control. Without it, a table has the shortest words for each control.", "--to")
@settings_option
@click.option("--all", "shows_all", is_flag=True, help="List all candidates, and where their numbers come from.")
@click.option("-o", "--output", metavar="NEW", help="Where to write the program; without it, to standard output.")
@click.option("--force", "is_forced", is_flag=True, help="Replace NEW if it exists.")
@format_option
@drawing_options
@click.pass_context
def write(
    context: click.Context,
    /,
    sketch: str,
    to: ControlName | Control | None,
    assignments: tuple[str, ...],
    shows_all: bool,
    output: str | None,
    is_forced: bool,
    format_: str,
    drawing: Mapping[str, Any],
) -> None:
    """Write SKETCH (a TOML or JSON file, or - for standard input) as a small program for a control.

    SKETCH may be a DXF drawing, too: a chain of its lines and arcs. The numbers of its dimensions are the given ones,
    else its coordinates. --sketch keeps them as a sketch, to change what is given. Needs the extra contoursolve[dxf].

    write looks for the fewest words with the drawing's own numbers, then for round ones. Each candidate is read
    back as the control reads it, and is the same contour. What the control has no words for is written as G01, G02 and
    G03, and named. --all lists the candidates instead of the program.

    Exit status: 0 written, 1 the sketch is open or contradicts itself, 2 could not run.

    \b
    contoursolve write plate.toml --to fanuc-mill -o plate.nc
    contoursolve write plate.toml --to heidenhain --all
    contoursolve write plate.toml
    contoursolve write part.dxf --to fanuc-lathe --layer contour
    """
    if output is not None and (shows_all or to is None or format_ == "json"):
        raise click.UsageError("-o goes with --to, and without --all and --format json")
    if shows_all and to is None:
        raise click.UsageError("--all goes with --to")
    target = target_of(sketch, output, is_forced=is_forced)
    drawn = read_drawn(sketch, to, drawing)
    folder = Path() if sketch == STANDARD_INPUT else Path(sketch).parent
    settings = find_settings(folder) | dict(map(read_setting, assignments))
    try:
        several = (write_contour(drawn, to, settings=settings),) if to else write_contour(drawn, settings=settings)
    except UnfinishedError:
        text = decode(read_bytes(sketch), sketch) if is_sketch(sketch) else write_sketch(drawn)
        result = sketch_result(read_sketch_file(gcode.parse(text, sketch if is_sketch(sketch) else "sketch")))[1]
        print_findings(result, sketch if is_sketch(sketch) else None)
        context.exit(FOUND_ERRORS)
    found = several[0]
    if format_ == "json":
        print_json({"schema": SCHEMA, "written": [_data(each) for each in several]})
        context.exit(0 if to is None or found.candidates else COULD_NOT_RUN)
    elif to is None:
        print_lines(_table_lines(several))
    elif not found.candidates:
        raise CouldNotRunError(found.reason)
    elif shows_all:
        print_lines(line for each in found.candidates for line in _candidate_lines(each))
        print_lines(filter(None, (found.reason,)), err=True)
    elif target is None:
        click.echo(found.candidates[0].program, nl=False)
        _report(found)
    else:
        write_whole(target, (found.candidates[0].program.encode(),), keeps_backup=False)
        say(f"{target} written", err=True)
        _report(found)


def _report(found: WrittenContours) -> None:
    """Print on standard error how good the first candidate is."""
    first, *others = _candidate_lines(found.candidates[0])
    said = [line.strip() for line in others if not line.startswith("    ")]
    reason = found.reason
    if reason and found.candidates[0].is_plain and not all(each.is_plain for each in found.candidates):
        reason += " (--all lists them)"
    print_lines((first, *said, *filter(None, (reason,))), err=True)


def _candidate_lines(candidate: WrittenContour) -> Iterator[str]:
    """The number of words of a candidate, its blocks, and on what its numbers rest."""
    yield f"{count(candidate.cost.words, 'word')} in {count(len(candidate.blocks), 'block')}, {_ground(candidate)}"
    yield from (f"    {line}" for line in candidate.lines)
    for ground in (NumberGround.COMPUTED, NumberGround.ROUND):
        told = [_told(word) for word in candidate.words(ground)]
        if told:
            yield f"  {ground.value}: {', '.join(told)}"


def _ground(candidate: WrittenContour) -> str:
    """On what a candidate rests, in a few words."""
    computed = len(candidate.words(NumberGround.COMPUTED))
    if computed:
        return f"{computed} computed: at most {candidate.deviation:.1g} mm off"
    return "with round numbers" if candidate.words(NumberGround.ROUND) else "all numbers those of the drawing"


def _told(word: WrittenWord) -> str:
    return f"{word.text} (off by {word.off:.1g} {word.unit.value})" if word.off else word.text


def _table_lines(several: Sequence[WrittenContours]) -> Iterator[str]:
    """The first candidate for each control, a line for each block."""
    width = max(len(each.control) for each in several)
    for each in several:
        said = each.candidates[0].lines if each.candidates else ()
        ground = f"{_ground(each.candidates[0])}" if each.candidates else ""
        yield f"{each.control:{width}}  {'; '.join(filter(None, (ground, each.reason)))}"
        yield from (f"{'':{width}}    {line}" for line in said)


def _data(found: WrittenContours) -> dict[str, Any]:
    return {
        **members(found, "control title reason"),
        "candidates": [
            members(each, "lines program deviation_mm=deviation is_plain written_out blocks")
            for each in found.candidates
        ],
    }
