"""The moves of a program for the path of its tool: what each of its lines makes instead of what it states."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from math import isnan, nan

from msgspec.structs import replace

from contoursolve.comparison import Motion, Step, ToolPath, Travel, bend_of
from contoursolve.solving import ArcSegment, LineSegment, Point, Segment
from contoursolve.tool_radius.findings import ToolReport, ToolRun
from contoursolve.tool_radius.runs import CuttingRun, place_of

Moves = tuple[tuple[Segment, bool], ...]
"""Elements, each with whether it is a rapid."""


def moves_of(report: ToolReport) -> tuple[Mapping[int, Moves], frozenset[int]]:
    """The elements of each line beside which the tool goes, and of the moves that lead there and away; and the lines
    behind which the tool is where the program has it."""
    found: dict[int, list[tuple[Segment, bool]]] = {}
    for travel, moves in _by_travel(report):
        found.setdefault(travel.line, []).extend(moves)
    leads = {id(each.run.lead) for each in report.runs if each.path is not None}
    leaving = [each.run.leaving for each in report.runs if each.run.leaving and id(each.run.leaving) not in leads]
    return {line: tuple(moves) for line, moves in found.items()}, frozenset(travel.line for travel in leaving)


def path_of_tool(report: ToolReport) -> ToolPath:
    """The path of a program with the path of the tool in the place of what it cuts with G41 or G42."""
    moved = {id(travel): moves for travel, moves in _by_travel(report)}
    steps = (_moved(each, moved.get(id(each)), report.path.axes) for each in report.path.steps)
    return replace(report.path, steps=tuple(chain.from_iterable(steps)))


def _moved(step: Step, moves: Moves | None, axes: Sequence[str]) -> Iterator[Step]:
    """A move along other elements; what moves outside their plane does so in the last one."""
    if not isinstance(step, Travel) or step.plane is None or moves is None:
        yield step
        return
    first, second = (axes.index(axis) for axis in step.plane.axes)
    for number, (segment, is_rapid) in enumerate(moves):
        ends = [[*step.start], [*(step.end if number == len(moves) - 1 else step.start)]]
        for place, at in zip(ends, (segment.start, segment.end), strict=True):
            place[first], place[second] = (None if isnan(value) else value for value in at)
        bend = None
        if isinstance(segment, ArcSegment):
            bend = bend_of((first, second), segment.center, segment.start, segment.end, segment.turn)
        motion = Motion.RAPID if is_rapid else Motion.FEED
        yield replace(step, motion=motion, start=tuple(ends[0]), end=tuple(ends[1]), bend=bend, compensation=40)


def _by_travel(report: ToolReport) -> list[tuple[Travel, Moves]]:
    """The moves that lead to contours, along them and away, each with what the tool makes in its place."""
    starts, ends = dict[int, Point](), dict[int, Point]()
    """Where the tool really is before a move, and behind it."""
    for each in report.runs:
        if each.path is not None:
            ends |= {id(each.run.lead): each.path.start} if each.run.lead is not None else {}
            starts |= {id(each.run.leaving): each.path.end} if each.run.leaving is not None else {}
    found = dict[int, tuple[Travel, Moves]]()
    for each in report.runs:
        if each.path is None:
            continue
        pieces = dict[int, Moves]()
        for piece in each.offset.pieces or ():
            travel = each.run.travels[piece.element]
            moves = pieces.get(id(travel), ())
            pieces[id(travel)] = (*moves, (each.written(piece), travel.motion is Motion.RAPID))
        for travel in filter(None, (each.run.lead, *each.run.travels, each.run.leaving)):
            if id(travel) in found:
                continue
            if travel in (each.run.lead, each.run.leaving):
                start, end = (_known(travel, report, at_end=at_end) for at_end in (False, True))
                segment = LineSegment("", starts.get(id(travel), start), ends.get(id(travel), end))
                found[id(travel)] = travel, ((segment, travel.motion is Motion.RAPID),)
                continue
            moves = pieces.get(id(travel), ())
            if each.run.lead is None and travel is each.run.travels[0]:
                moves = ((LineSegment("", each.part.start, each.path.start), each is report.runs[0]), *moves)
            found[id(travel)] = travel, moves
    return [*found.values()]


def _known(travel: Travel, report: ToolReport, *, at_end: bool) -> Point:
    """The place where a move begins or ends; what is not known is no number, and is not needed."""
    first, second = place_of(travel, report.path.axes, at_end=at_end)
    return nan if first is None else first, nan if second is None else second


def lines_of(own: CuttingRun) -> tuple[int, ...]:
    """The program lines of a run and of what leads there and away."""
    travels = filter(None, (own.lead, *own.travels, own.leaving))
    return tuple(dict.fromkeys(travel.line for travel in travels))


def title_of(each: ToolRun) -> str:
    """The tool for which a path holds."""
    return f"path of the {'tip' if each.run.is_lathe else 'centre'} for {each.title}"
