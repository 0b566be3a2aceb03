"""The tool that a command, a program or a project file states, and what is said of it."""

import re
from collections.abc import Mapping
from io import BytesIO
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.api import follow_program
from contoursolve.controls import TOOL_FACTS, ToolFacts
from contoursolve.diagnostics import Diagnostic, Fix, Label, LineChange, Span
from contoursolve.gcode import Block, OpenFile, Program, parse
from contoursolve.output import Collected
from contoursolve.postprocess import Left, MovedProgram, Summary
from contoursolve.program import Result, Run
from contoursolve.reading import Dialect
from contoursolve.tool_radius import (
    ToolFaultKind,
    ToolReport,
    ToolRun,
    lines_of,
    look_at_tool,
    moves_of,
    result_beside_tool,
    title_of,
    tool_of,
    wanted_tool,
    written_out,
)


def beside_tool(
    run: Run, tool: str | None, tip: int | None, side: str | None, outside: str | None = None
) -> Run | Collected:
    """The result of a run with the findings about its tool; the run itself where nothing states one."""
    wanted = wanted_tool(run.frame.program.name, tool, tip, side, outside)
    if tool is None and not any(tool_of(block) for block in run.frame.program.blocks):
        return run
    result, report = result_beside_tool(run, wanted)
    return Collected(result, run.is_strict, tool=report)


class BesideTool(Struct):
    """A program that is written along the path of its tool: its file, without calls where it had some, and the block
    as it stands in the old one, by line; its control, and what is written."""

    source: OpenFile
    blocks: Mapping[int, Block]
    dialect: Dialect | None
    writer: MovedProgram

    def say_at_home(self, summary: Summary) -> None:
        """Put the lines of the old program into what is told."""
        if self.blocks:
            summary.left = [self._at_home(each) for each in summary.left]
            summary.warned = [self._at_home(each) for each in summary.warned]
            summary.unfamiliar = [replace(each, line=self._line(each.line)) for each in summary.unfamiliar]

    def _line(self, line: int) -> int:
        block = self.blocks.get(line)
        return line if block is None else block.callers[0].line if block.file else block.line

    def _at_home(self, value: Any) -> Any:
        if isinstance(value, str):
            return _LINES.sub(lambda found: f"program line {self._line(int(found[1]))}", value)
        if isinstance(value, Span):
            block = self.blocks.get(value.line)
            is_other = block is not None and bool(block.file)
            return Span(self._line(value.line), 1, 2) if is_other else value._replace(line=self._line(value.line))
        if isinstance(value, tuple):
            return tuple(map(self._at_home, value))
        if isinstance(value, Left):
            own = {line: self.blocks[line] for line in value.sources}
            sources = {self._line(n): each.callers[0].text if each.file else each.text for n, each in own.items()}
            value = replace(value, lines=tuple(map(self._line, value.lines)), sources=sources)
        block = self.blocks.get(value.span.line) if isinstance(value, Diagnostic) else None
        if block is not None and block.file and isinstance(value, Diagnostic):
            value = replace(value, message=f"{value.message} ({block.file}, line {block.line})")
        if isinstance(value, Left | Diagnostic | Label | Fix | LineChange):
            return replace(value, **{each: self._at_home(getattr(value, each)) for each in value.__struct_fields__})
        return value


_LINES = re.compile(r"program line (\d+)")


def open_beside_tool(
    source: OpenFile, start: str | None, tool: Mapping[str, Any], options: dict[str, Any], *, is_inline: bool
) -> BesideTool:
    """A program along the path of its tool. Raises ToolError."""
    program, blocks = parse(source.read(), source.name), dict[int, Block]()
    run = follow_program(program, start=start, **options)
    dialect = run.asked.dialect
    if dialect is not None:
        blocks = dict(enumerate(written_out(run, dialect, is_inline=is_inline), 1))
    if blocks:
        end = "\r\n" if "\r\n" in program.text else "\n"
        data = source.mark + source.encode("".join(each.text + end for each in blocks.values()))
        source = replace(source, data=BytesIO(data), size=len(data), stamp=None)
        program, options = parse(source.read(), source.name), {**options, "control": dialect}
        run = follow_program(program, start=start, **options)
    report = look_at_tool(result := run.collect(), run.asked, wanted_tool(program.name, **tool))
    return BesideTool(source, blocks, dialect, _moved_program(program, result, report))


def _moved_program(program: Program, result: Result, report: ToolReport) -> MovedProgram:
    """The moves that are written, and what stays as it is."""
    is_solved = all(answer.contour is not None for answer in result.answers)
    texts = {block.line: block.text for block in program.blocks}
    left, kept, remarks, behind = dict[int, Left](), set[int](), dict[int, str](), 0
    warnings = dict[int, tuple[Diagnostic, ...]]()
    good = list[ToolRun]()
    for each in report.runs:
        lines = lines_of(each.run)
        if each.run.is_plain:
            continue
        void = (each.run.void.span.line,) if each.run.void is not None else ()
        places = (*lines, *void, each.run.broken, *(word.line for word in each.run.words))
        own = [finding for finding in report.findings if finding.span.line in places]
        errors = tuple(finding for finding in own if finding.is_error)
        reason = f"{errors[0].code}: {errors[0].message}" if errors else ""
        if not reason and len({travel.is_skippable for travel in each.run.travels}) > 1:
            reason = "some of its blocks begin with / and some do not: with them skipped, it is another contour"
        if not reason and not is_solved:
            reason = "another contour has errors: mend it first"
        if not reason and each.path is None:
            reason = "the tool does not fit"
        if reason:
            # What interrupts one contour stands before the next one.
            told = {id(finding) for other in left.values() for finding in other.diagnostics}
            news = tuple(finding for finding in errors if id(finding) not in told)
            sources = {line: texts[line] for line in places if line in texts}
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
    keeps_d = TOOL_FACTS.get(result.control or "", ToolFacts()).keeps_d
    return MovedProgram(moves, left, kept, remarks, warnings, leaving, keeps_d)
