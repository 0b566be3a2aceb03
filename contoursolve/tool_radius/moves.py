"""The moves of a program for the path of its tool: what each of its lines makes instead of what it states."""

from collections.abc import Mapping
from math import nan

from contoursolve.comparison import Motion, Travel
from contoursolve.solving import LineSegment, Point, Segment
from contoursolve.tool_radius.findings import ToolReport, ToolRun
from contoursolve.tool_radius.runs import Run, place_of

Moves = tuple[tuple[Segment, bool], ...]
"""Elements, each with whether it is a rapid."""


def moves_of(report: ToolReport) -> tuple[Mapping[int, Moves], frozenset[int]]:
    """The elements of each line beside which the tool goes, and of the moves that lead there and away; and the lines
    behind which the tool is where the program has it."""
    found, ends = dict[int, list[tuple[Segment, bool]]](), dict[int, Point]()
    """Where the tool really is behind a move, and before it."""
    starts = dict[int, Point]()
    for each in report.runs:
        if each.path is not None:
            ends |= {id(each.run.lead): each.path.start} if each.run.lead is not None else {}
            starts |= {id(each.run.leaving): each.path.end} if each.run.leaving is not None else {}
    told, pieces = set[int](), dict[int, list[tuple[Segment, bool]]]()
    for each in report.runs:
        if each.path is None:
            continue
        for piece in each.offset.pieces or ():
            travel = each.run.travels[piece.element]
            pieces.setdefault(id(travel), []).append((each.written(piece), travel.motion is Motion.RAPID))
        for travel in filter(None, (each.run.lead, *each.run.travels, each.run.leaving)):
            line = found.setdefault(travel.line, [])
            if id(travel) in told:
                continue
            told.add(id(travel))
            if travel in (each.run.lead, each.run.leaving):
                start, end = (_known(travel, report, at_end=at_end) for at_end in (False, True))
                segment = LineSegment("", starts.get(id(travel), start), ends.get(id(travel), end))
                line.append((segment, travel.motion is Motion.RAPID))
                continue
            if each.run.lead is None and travel is each.run.travels[0]:
                line.append((LineSegment("", each.part.start, each.path.start), each is report.runs[0]))
            line += pieces.get(id(travel), ())
    leaving = {each.run.leaving for each in report.runs if each.run.leaving and id(each.run.leaving) not in ends}
    return {line: tuple(moves) for line, moves in found.items()}, frozenset(travel.line for travel in leaving)


def _known(travel: Travel, report: ToolReport, *, at_end: bool) -> Point:
    """Where a move begins or ends; what is not known is no number, and is not needed."""
    first, second = place_of(travel, report.axes, at_end=at_end)
    return nan if first is None else first, nan if second is None else second


def lines_of(own: Run) -> tuple[int, ...]:
    """The program lines of a run and of what leads there and away."""
    travels = filter(None, (own.lead, *own.travels, own.leaving))
    return tuple(dict.fromkeys(travel.line for travel in travels))


def title_of(each: ToolRun) -> str:
    """The tool for which a path holds."""
    return f"path of the {'tip' if each.run.is_lathe else 'centre'} for {each.title}"
