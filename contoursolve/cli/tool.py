"""The tool that a command, a program or a project file states."""

from contoursolve.output import Collected
from contoursolve.program import Run
from contoursolve.tool_radius import look_at_tool, result_beside_tool, tool_of, wanted_tool


def beside_tool(
    run: Run, tool: str | None, tip: int | None, side: str | None, outside: str | None = None
) -> Run | Collected:
    """The result of a run with the findings about its tool; the run itself where nothing states one."""
    wanted = wanted_tool(run.frame.program.name, tool, tip, side, outside)
    if tool is None and not any(tool_of(block) for block in run.frame.program.blocks):
        return run
    report = look_at_tool(result := run.collect(), run.asked, wanted)
    return Collected(result_beside_tool(result, report), run.is_strict, tool=report)
