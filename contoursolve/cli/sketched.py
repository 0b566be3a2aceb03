"""Sketches for the commands of programs: `check`, `solve` and `draw` take a TOML or JSON file of one."""

from collections.abc import Iterator

import click
from click.core import ParameterSource

from contoursolve.cli.printing import print_json, print_lines, style_of_output
from contoursolve.gcode import Program
from contoursolve.output import (
    Collected,
    Totals,
    closing_lines,
    harmless,
    lines_of_findings,
    path_table,
    short_findings,
)
from contoursolve.pictures import Picture, Theme
from contoursolve.program import Result
from contoursolve.sketches import (
    SketchAnswer,
    draw_sketch,
    read_sketch_file,
    sketch_result,
    sketch_view,
    state_text,
)

SCHEMA = "contoursolve/sketch/1"

_ONLY_PROGRAMS = (
    *("blocks", "start", "facts", "trust", "reference", "variables", "folders", "control", "units", "assignments"),
    *("tool", "tip", "side", "outside", "line", "is_each", "is_derived"),
)
"""Parameters that a sketch has no use for."""


def refuse_options(context: click.Context, *, is_fixing: bool = False) -> None:
    """Raise UsageError for an option that says nothing of a sketch."""
    if is_fixing:
        raise click.UsageError("fixes of a sketch are typed in: leave out --fix and --diff")
    for option in context.command.params:
        source = context.get_parameter_source(option.name or "")
        if option.name in _ONLY_PROGRAMS and source is ParameterSource.COMMANDLINE:
            raise click.UsageError(f"{option.opts[0]} is for programs, and a sketch says it itself, or has none")


def examined_sketch(program: Program) -> Collected:
    """The findings about a sketch as those of a program, in the lines of its file. Raises SketchError."""
    return Collected(sketch_result(read_sketch_file(program))[1], is_strict=False)


def solve_sketched(program: Program, format_: str, *, is_explained: bool) -> Totals:
    """Print all that is known of a sketch, and its findings."""
    file, tally = read_sketch_file(program), Totals()
    found, result = sketch_result(file)
    for answer in result.answers:
        tally.count(answer)
    for finding in () if result.answers else result.diagnostics:
        tally.count(finding)
    if format_ == "json":
        told = {name: value for name, value in sketch_view(file.sketch, with_ranges=True).items() if name != "picture"}
        print_json({"schema": SCHEMA, **told})
    else:
        print_lines(_lines(program.name, found))
        findings = result.diagnostics if is_explained else short_findings(result)
        print_lines(lines_of_findings(result, findings, style_of_output(), is_explained=is_explained))
        print_lines([*closing_lines(result, tally)][-1:])
    return tally


def _lines(name: str, found: SketchAnswer) -> Iterator[str]:
    yield f"{harmless(name)}: drawing of a {found.sketch.part} part: {found.said}"
    yield ""
    contour = found.answer.contour if found.answer is not None else None
    if contour is not None and found.answer is not None:
        yield from path_table(contour, found.answer.unit).lines()
        yield ""
    yield from (f"  {each.name:10} {state_text(each, found)}" for each in found.elements if not found.is_finished)
    for (number, field), value in found.asked.items():
        yield f"  {field} of {found.sketch.name_of(number)} = {'not known' if value is None else value}"
    yield from (f"  {remark}" for remark in found.remarks)
    yield f"  contoursolve draw {harmless(name)} shows it"
    yield ""


def picture_of(program: Program, theme: Theme) -> tuple[Picture | None, Result]:
    """The picture of what is known of a sketch, None where nothing is; and its findings."""
    found, result = sketch_result(read_sketch_file(program))
    return draw_sketch(found, theme=theme), result
