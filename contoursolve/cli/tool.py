"""The tool that a command, a program or a project file states, and what is said of it."""

from collections.abc import Mapping
from typing import Any

from msgspec.structs import replace

from contoursolve.api import follow_program
from contoursolve.diagnostics import Diagnostic
from contoursolve.execution import needs_running
from contoursolve.gcode import Program
from contoursolve.output import Collected
from contoursolve.postprocess import Left, MovedProgram
from contoursolve.program import Run
from contoursolve.tool_radius import (
    ToolError,
    ToolFaultKind,
    ToolRun,
    lines_of,
    moves_of,
    report_on,
    result_beside_tool,
    title_of,
    tool_in,
    wanted_tool,
)


def beside_tool(
    run: Run, tool: str | None, tip: int | None, side: str | None, outside: str = "roll"
) -> Run | Collected:
    """The result of a run with the findings about its tool; the run itself where nothing states one."""
    wanted = wanted_tool(run.frame.program.name, tool, tip, side, outside)
    if tool is None and not any(tool_in(block.text) for block in run.frame.program.blocks):
        return run
    result, report = result_beside_tool(run, wanted)
    return Collected(result, run.is_strict, tool=report)


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
        raise ToolError(
            "expand --tool reads G codes; write the program with expand --post fanuc first, and say --control "
            "fanuc-mill of what that writes"
        )
    is_solved = all(answer.contour is not None for answer in result.answers)
    texts = {block.line: block.text for block in program.blocks}
    left, kept, remarks, behind = dict[int, Left](), set[int](), dict[int, str](), 0
    warnings = dict[int, tuple[Diagnostic, ...]]()
    good = list[ToolRun]()
    for each in report.runs:
        lines = lines_of(each.run)
        own = [finding for finding in report.findings if finding.span.line in (*lines, each.run.broken)]
        errors = tuple(finding for finding in own if finding.is_error)
        reason = f"{errors[0].code}: {errors[0].message}" if errors else ""
        if not reason and len({travel.is_skippable for travel in each.run.travels}) > 1:
            reason = "some of its blocks begin with / and some do not: with them skipped, it is another contour"
        if not reason and each.path is None:
            reason = "the tool does not fit"
        if not reason and not is_solved:
            reason = "another contour is not solved, so that nobody knows where compensation has to stay"
        if reason:
            # What interrupts one contour stands before the next one.
            told = {id(finding) for other in left.values() for finding in other.diagnostics}
            news = tuple(finding for finding in errors if id(finding) not in told)
            sources = {line: texts[line] for line in (*lines, each.run.broken) if line in texts}
            left[lines[0]] = Left(lines, reason, news, sources)
            # Where a contour stays, the words of compensation before it stay, too.
            kept |= {*range(behind + 1, max(lines) + 1)}
        else:
            remarks[lines[0]] = title_of(each)
            # Without compensation, it is the path that is written that comes out.
            warnings[lines[0]] = tuple(finding for finding in own if finding.about is not ToolFaultKind.UNCOMPENSATED)
            good.append(each)
        behind = max(lines)
    kept |= set() if is_solved else {*texts}
    moves, leaving = moves_of(replace(report, runs=tuple(good)))
    return MovedProgram(moves, left, kept, remarks, warnings, leaving)
