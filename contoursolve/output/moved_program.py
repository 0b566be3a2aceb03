"""A program that is written along the path of its tool, and what is told of it, by the lines that it had."""

from collections.abc import Callable, Mapping
from io import BytesIO
from typing import IO

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls import TOOL_FACTS, ToolFacts
from contoursolve.diagnostics import Diagnostic, Span
from contoursolve.gcode import Block, OpenFile, Program, parse
from contoursolve.postprocess import POSTS, ExpansionOptions, Left, MovedProgram, Rewritten, Summary, rewrite
from contoursolve.program import Result, Run, SolveOptions, renumbered
from contoursolve.reading import Control
from contoursolve.tool_radius import (
    ToolError,
    ToolFaultKind,
    ToolReport,
    ToolRequest,
    ToolRun,
    lines_of,
    look_at_tool,
    moves_of,
    title_of,
    written_out,
)


def rewrite_beside_tool(
    source: OpenFile,
    body: IO[bytes],
    wish: ExpansionOptions,
    asked: SolveOptions,
    tool: ToolRequest,
    follow: Callable[[Program, SolveOptions], Run],
    progress: Callable[[float], None] = lambda _: None,
) -> Rewritten:
    """Write a program along the path of a tool into `body`; `follow` reads it. Raises ToolError, and as `rewrite`."""
    beside = _open_beside_tool(source, tool, asked, follow, is_inline=wish.is_inline)
    control = beside.control
    if control is not None and control.writing is not None and wish.post is not POSTS["same"]:
        raise ToolError(
            f"the path of a tool is written in the words of {control.name} itself: write that first, then expand it "
            f"for {wish.post.name}"
        )
    told = asked.request(source.name)
    made, settings = beside.source, asked.settings
    found = rewrite(made, body, wish, told, control=control, settings=settings, progress=progress, writer=beside.writer)
    beside.say_at_home(found.summary)
    return found


class BesideTool(Struct, frozen=True):
    """A program that is written along the path of its tool: its file, without calls where it had some, and the block
    as it stands in the old one, by line; its control, and what is written."""

    source: OpenFile
    blocks: Mapping[int, Block]
    control: Control | None
    writer: MovedProgram

    def say_at_home(self, summary: Summary) -> None:
        """Put the lines of the old program into what is told."""
        if self.blocks:
            summary.left = [self._left(each) for each in summary.left]
            summary.warned = [self._finding(each) for each in summary.warned]
            summary.unfamiliar = [replace(each, line=self.line(each.line)) for each in summary.unfamiliar]

    def line(self, line: int) -> int:
        """The line of the old program, or the one that calls it from there."""
        block = self.blocks.get(line)
        return line if block is None else block.callers[0].line if block.file else block.line

    def place(self, span: Span) -> Span:
        """The place in the old program."""
        block = self.blocks.get(span.line)
        is_other = block is not None and bool(block.file)
        return Span(self.line(span.line), 1, 2) if is_other else span._replace(line=self.line(span.line))

    def _left(self, left: Left) -> Left:
        own = {line: self.blocks[line] for line in left.sources}
        return Left(
            tuple(map(self.line, left.lines)),
            renumbered(left.reason, self),
            tuple(map(self._finding, left.diagnostics)),
            {self.line(line): each.callers[0].text if each.file else each.text for line, each in own.items()},
            left.is_end,
        )

    def _finding(self, finding: Diagnostic) -> Diagnostic:
        block, told = self.blocks.get(finding.span.line), finding.message
        if block is not None and block.file:
            told = f"{told} (program line {block.line} of {block.file})"
        found: Diagnostic = renumbered(replace(finding, message=told), self)
        return found


def _open_beside_tool(
    source: OpenFile,
    tool: ToolRequest,
    asked: SolveOptions,
    follow: Callable[[Program, SolveOptions], Run],
    *,
    is_inline: bool,
) -> BesideTool:
    program, blocks = parse(source.read(), source.name), dict[int, Block]()
    run = follow(program, asked)
    control = run.asked.control
    if control is not None:
        blocks = dict(enumerate(written_out(run, control, is_inline=is_inline), 1))
    if blocks:
        end = "\r\n" if "\r\n" in program.text else "\n"
        data = source.mark + source.encode("".join(each.text + end for each in blocks.values()))
        source = replace(source, data=BytesIO(data), size=len(data), stamp=None)
        program = parse(source.read(), source.name)
        run = follow(program, replace(asked, control=control))
    report = look_at_tool(result := run.collect(), run.asked, tool)
    return BesideTool(source, blocks, control, _moved_program(program, result, report))


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
