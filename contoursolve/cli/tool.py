"""The tool that a command, a program or a project file states, and what is said of it."""

from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from contoursolve.api import follow_program
from contoursolve.cli.options import check_toolless, naming
from contoursolve.diagnosis import rank
from contoursolve.execution import needs_running
from contoursolve.gcode import Program
from contoursolve.output import Collected
from contoursolve.postprocess import Left, MovedProgram
from contoursolve.program import Result, Run, find_tools
from contoursolve.reading import ReadIssue
from contoursolve.tool_radius import (
    Outside,
    Tool,
    ToolError,
    ToolReport,
    ToolRequest,
    ToolRun,
    ToolSide,
    lines_of,
    look_at_tool,
    make_tool,
    moves_of,
    read_tool,
    title_of,
    tool_in,
)

FROM_PROGRAM = "program"
"""The value of `--tool` that leaves it to the program and the project file."""


def beside_tool(
    run: Run, tool: str | None, tip: int | None, side: str | None, outside: str = "roll"
) -> Run | Collected:
    """The result of a run with the findings about its tool; the run itself where nothing states one."""
    name = run.frame.program.name
    with naming(name):
        wanted = wanted_tool(name, tool, tip, side, outside)
        if tool is None and not any(tool_in(block.text) for block in run.frame.program.blocks):
            check_toolless({"tip": tip, "side": side})
            return run
        report = report_on(run, result := run.collect(), wanted)
    is_cut = bool(report.runs)
    kept = [each for each in result.diagnostics if not (is_cut and each.about is ReadIssue.NO_CONTOUR)]
    found = tuple(sorted((*kept, *report.findings), key=rank))
    return Collected(replace(result, diagnostics=found), run.is_strict, tool=report)


def moved_program(
    program: Program, start: str | None, tool: Mapping[str, Any], options: dict[str, Any]
) -> MovedProgram:
    """A program along the path of its tool. Raises ToolError."""
    run = follow_program(program, start=start, **options)
    report = report_on(run, result := run.collect(), wanted_tool(program.name, **tool))
    dialect = run.asked.dialect
    if dialect is not None and needs_running((block.text for block in program.blocks), dialect.modes.language):
        raise ToolError("a program with calls, jumps or variables has no one path; expand --inline writes it out first")
    if dialect is not None and dialect.writing is not None:
        raise ToolError("expand --tool reads G codes; write the program with expand --post fanuc first")
    is_solved = all(answer.contour is not None for answer in result.answers)
    if not report.runs and is_solved:
        raise ToolError("no cutting move goes beside a contour; there is nothing to write")
    texts = {block.line: block.text for block in program.blocks}
    left, kept, remarks = dict[int, Left](), set[int](), dict[int, str]()
    good = list[ToolRun]()
    for each in report.runs:
        lines = lines_of(each.run)
        errors = tuple(finding for finding in report.findings if finding.is_error and finding.span.line in lines)
        is_skipped = len({travel.is_skippable for travel in each.run.travels}) > 1
        if errors or is_skipped:
            sources = {line: texts[line] for line in lines}
            told = "some of its blocks begin with / and some do not: with them skipped, it is another contour"
            reason = f"{errors[0].code}: {errors[0].message}" if errors else told
            left[lines[0]] = Left(lines, reason, errors, sources)
            kept |= {*lines}
        else:
            remarks[lines[0]] = title_of(each)
            good.append(each)
    # Beside a contour that stays, compensation stays, too.
    kept |= set() if is_solved else {*texts}
    moves, leaving = moves_of(replace(report, runs=tuple(good)))
    return MovedProgram(moves, left, kept, remarks, leaving)


def wanted_tool(program: str, tool: str | None, tip: int | None, side: str | None, outside: str) -> ToolRequest:
    """The tool as it is asked for. Raises ToolError, SettingError."""
    folder = Path() if program.startswith("<") else Path(program).parent
    is_own = tool is None or tool.strip().lower() == FROM_PROGRAM
    make_tool(Decimal(0), tip)
    return ToolRequest(
        None if is_own or tool is None else read_tool(tool, tip),
        tip,
        ToolSide(side) if side else None,
        Outside(outside),
        {name: _tool_of(name, row) for name, row in find_tools(folder).items()} if is_own else {},
    )


def report_on(run: Run, result: Result, wanted: ToolRequest) -> ToolReport:
    """What is said of a tool. Raises ToolError."""
    if run.asked.dialect is None:
        raise ToolError("no block shows the control, which says how moves are read; say which with --control")
    return look_at_tool(result, run.asked.dialect, run.asked, wanted)


def _tool_of(name: str, row: Mapping[str, Any]) -> Tool:
    """A tool of the table in the project file, in mm. Raises ToolError."""
    radius, tip = row.get("radius"), row.get("tip")
    flanks = {each: row[each] for each in ("back", "front") if each in row}
    numbers = (radius, 0 if tip is None else tip, *flanks.values())
    are_numbers = all(isinstance(each, int | float) and not isinstance(each, bool) for each in numbers)
    is_named = name[:1].upper() in ("T", "D") and name[1:].isdecimal()
    if row.keys() - {"radius", "tip", "back", "front"} or not are_numbers or not is_named or isinstance(tip, float):
        raise ToolError(f"tools.{name} is no tool; write T0101 = {{radius = 0.8, tip = 3}} or D1 = {{radius = 5.0}}")
    return make_tool(Decimal(str(radius)), tip, is_metric=True, **flanks)
