"""The moves of a program for the path of its tool: what each of its lines makes instead of what it states."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from math import nan
from operator import itemgetter

from msgspec.structs import replace

from contoursolve.comparison import Motion, Step, ToolPath, Travel, along
from contoursolve.solving import LineSegment, Segment
from contoursolve.tool_radius.findings import ToolReport, ToolRun
from contoursolve.tool_radius.runs import SIDES, CuttingRun, place_of, segment_of

Move = tuple[Segment, bool, Mapping[str, tuple[float, float]]]
"""An element, whether it is a rapid, and axes outside its plane: from where to where (mm) they move along."""


def moves_of(report: ToolReport) -> tuple[Mapping[int, tuple[Move, ...]], frozenset[int]]:
    """The moves of each line beside which the tool goes, and of those that lead there and away; and the lines behind
    which the tool is where the program has it."""
    found, moved, axes = dict[int, tuple[Move, ...]](), _by_travel(report), report.path.axes
    for step in report.path.steps:
        for each in moved.get(id(step), ()):
            move = segment_of(each, axes, nan), each.motion is Motion.RAPID, _beside(each, axes)
            found[step.line] = (*found.get(step.line, ()), move)
        if id(step) in moved:
            found.setdefault(step.line, ())
    leads = {id(each.run.lead) for each in report.runs if each.path is not None}
    leaving = [each.run.leaving for each in report.runs if each.run.leaving and id(each.run.leaving) not in leads]
    return found, frozenset(travel.line for travel in leaving)


def path_of_tool(report: ToolReport) -> ToolPath:
    """The path of a program with the path of the tool in the place of what it cuts with G41 or G42."""
    moved, axes, steps = _by_travel(report), report.path.axes, list[Step]()
    for each in report.path.steps:
        here, own = next((step for step in reversed(steps) if isinstance(step, Travel)), None), moved.get(id(each))
        if own is None and isinstance(each, Travel) and each.compensation in SIDES and each.plane and here is not None:
            # What moves outside the plane does so where the tool is.
            first, second = place_of(replace(here, plane=each.plane), axes, at_end=True)
            at = nan if first is None else first, nan if second is None else second
            own = (along(replace(each, compensation=40), LineSegment("", at, at), axes),)
        steps += own if own is not None else (each,)
    return replace(report.path, steps=tuple(steps))


def _by_travel(report: ToolReport) -> Mapping[int, tuple[Travel, ...]]:
    """The moves of the tool in the place of each one that leads to contours, along them and away, by its `id`. Axes
    outside their plane move along the element itself, not around its corners."""
    found, axes = dict[int, tuple[Travel, ...]](), report.path.axes
    runs = [(each, path) for each in report.runs if (path := each.path) is not None]
    starts = {id(each.run.leaving): path.end for each, path in runs}
    ends = {id(each.run.lead): path.start for each, path in runs}
    for each, path in runs:
        rows = [(piece.element, each.written(piece), piece.is_own) for piece in each.pieces]
        here, pieces = path.start, {number: [*own] for number, own in groupby(rows, key=itemgetter(0))}
        for number, travel in enumerate(each.run.travels):
            own, step = pieces.get(number, []), replace(travel, compensation=40)
            corner = replace(step, start=step.end)
            if not any(is_own for *_, is_own in own) and _beside(step, axes):
                own.insert(0, (number, LineSegment("", here, here), True))
            steps = [along(step if is_own else corner, segment, axes) for _, segment, is_own in own]
            if not number and each.run.lead is None:
                first = replace(step, end=step.start, motion=Motion.RAPID if each is report.runs[0] else Motion.FEED)
                steps.insert(0, along(first, LineSegment("", each.part.start, path.start), axes))
            here = own[-1][1].end if own else here
            found[id(travel)] = tuple(steps)
    for step in (step for each, _ in runs for step in (each.run.lead, each.run.leaving) if step is not None):
        (a, b), (c, d) = (place_of(step, axes, at_end=at_end) for at_end in (False, True))
        start, end = (nan if a is None else a, nan if b is None else b), (c or 0.0, d or 0.0)
        segment = LineSegment("", starts.get(id(step), start), ends.get(id(step), end))
        found[id(step)] = (along(replace(step, compensation=40), segment, axes),)
    return found


def _beside(step: Travel, axes: Sequence[str]) -> Mapping[str, tuple[float, float]]:
    """The axes outside the plane of a move that move along, mm; X as it is written."""
    ways = zip(axes, step.start, step.end, step.doubled, strict=True)
    return {
        axis: ((start or 0.0) * (1 + twice), end * (1 + twice))
        for axis, start, end, twice in ways
        if step.plane and axis not in step.plane.axes and end is not None and end != start
    }


def lines_of(own: CuttingRun) -> tuple[int, ...]:
    """The program lines of a run and of what leads there and away."""
    travels = filter(None, (own.lead, *own.travels, own.leaving))
    return tuple(dict.fromkeys(travel.line for travel in travels))


def title_of(each: ToolRun) -> str:
    """The tool for which a path holds."""
    return f"path of the {'tip' if each.run.is_lathe else 'centre'} for {each.title}"
