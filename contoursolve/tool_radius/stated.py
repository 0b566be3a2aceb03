"""The tool that a program, a project file or a caller states, and a program's result with what is said of it."""

from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from contoursolve.diagnosis import rank
from contoursolve.diagnostics import check_type, choice_of, did_you_mean
from contoursolve.program import Result, find_tool_table
from contoursolve.reading import ReadIssue
from contoursolve.tool_radius.findings import ToolReport
from contoursolve.tool_radius.runs import ToolRequest
from contoursolve.tool_radius.tool import OutsideCorner, Tool, ToolError, ToolSide, make_tool, read_tool

FROM_PROGRAM = "program"
"""In the place of a tool: what the program and the project file say."""


def result_beside_tool(result: Result, report: ToolReport) -> Result:
    """The result of a program with what is said of its tool."""
    is_cut = bool(report.runs)
    kept = [each for each in result.diagnostics if not (is_cut and each.about is ReadIssue.NO_CONTOUR)]
    return replace(result, diagnostics=tuple(sorted((*kept, *report.findings), key=rank)), tool=report)


def wanted_tool(
    program: str, tool: str | None = None, tip: int | None = None, side: str | None = None, outside: str | None = None
) -> ToolRequest:
    """The tool as it is asked for. Raises ToolError, SettingError."""
    if tool is not None:
        check_type("tool", tool, str, 'a text such as "R0.8, tip 3"')
    if tip is not None:
        check_type("tip", tip, int, "a number such as 3")
    folder = Path() if program.startswith("<") else Path(program).parent
    is_own = tool is None or tool.strip().lower() == FROM_PROGRAM
    make_tool(Decimal(0), tip)
    table, names = dict[tuple[str, Decimal], Tool](), dict[tuple[str, Decimal], str]()
    for name, row in (find_tool_table(folder, _tool_of) if is_own else {}).items():
        key = name[:1].upper(), Decimal(name[1:])
        if names.setdefault(key, name) != name:
            raise ToolError(f"{names[key]} and {name} in the table of tools name one tool; leave one out")
        table[key] = row
    return ToolRequest(
        None if is_own or tool is None else read_tool(tool, tip),
        tip,
        choice_of(ToolSide, side, "side") if side else None,
        choice_of(OutsideCorner, outside, "outside") if outside else None,
        table,
    )


def _tool_of(name: str, row: Mapping[str, Any]) -> Tool:
    """A tool of the table in the project file, in mm. Raises ToolError."""
    parts = ("radius", "tip", "back", "front")
    for each in row.keys() - {*parts}:
        told = did_you_mean(each, parts) or f"it has {', '.join(parts)}"
        raise ToolError(f"a tool has no {each!r}; {told.strip()}")
    radius, tip = row.get("radius"), row.get("tip")
    flanks = {each: row[each] for each in ("back", "front") if each in row}
    numbers = (radius, 0 if tip is None else tip, *flanks.values())
    are_numbers = all(isinstance(each, int | float) and not isinstance(each, bool) for each in numbers)
    is_named = name[:1].upper() in ("T", "D") and name[1:].isdecimal()
    if not are_numbers or not is_named or isinstance(tip, float):
        raise ToolError("it is no tool; write T0101 = {radius = 0.8, tip = 3} or D1 = {radius = 5.0}")
    return make_tool(Decimal(str(radius)), tip, is_metric=True, **flanks)
