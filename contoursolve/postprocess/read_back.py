"""Reads a small program as its control does, and measures how far its contour is off the drawn one."""

from msgspec.structs import replace

from contoursolve.comparison import Motion, ToolPath, Travel, bend_of, compare, follow
from contoursolve.diagnosis import Depth
from contoursolve.gcode import parse
from contoursolve.geometry import Length
from contoursolve.postprocess.contour_drawing import ContourDrawing
from contoursolve.program import Request, run
from contoursolve.reading import Dialect, ReadIssue
from contoursolve.solving import ArcSegment, Segment

SAME = 1e-6
"""mm. A contour whose words are exact is read back to within this."""

_UNITS_OFF = 2
"""A contour with rounded words is read back to within so many units of the last decimal of its control."""


def read_back(program: str, drawn: ContourDrawing, target: Dialect, *, is_exact: bool) -> tuple[float | None, int]:
    """The distance by which the contour of a program is off a drawn one, mm; None and the line to blame where it is
    another one, or has a finding."""
    result = run(
        parse(program, syntax=target.modes.syntax), Request(target, drawn.unit, depth=Depth.VERDICT, is_strict=True)
    )
    for finding in result.diagnostics:
        if finding.about is not ReadIssue.NO_CONTOUR:
            return None, finding.span.line
    axes, numbers = drawn.plane.axes, target.modes.lexicon.numbers
    path = follow(result, target, drawn.unit, axes)
    steps = tuple(
        replace(each, compensation=_NO_SIDE) if isinstance(each, Travel) else each
        for each in path.steps
        if not (isinstance(each, Travel) and each.motion is Motion.RAPID)
    )
    unit = float(numbers.inch * drawn.unit.in_mm if drawn.unit is Length.INCH else numbers.mm)
    own = ToolPath("", "", axes, tuple(_travel(each, drawn) for each in drawn.path))
    found = compare(own, replace(path, steps=steps), SAME if is_exact else _UNITS_OFF * unit)
    if found.difference is None:
        return found.deviation, 0
    blamed = found.difference.new or (steps[-1] if steps else None)
    return None, blamed.line if blamed else 0


_NO_SIDE = 40


def _travel(segment: Segment, drawn: ContourDrawing) -> Travel:
    bend = None
    if isinstance(segment, ArcSegment):
        bend = bend_of((0, 1), segment.center, segment.start, segment.end, segment.turn)
    return Travel(
        0,
        "",
        Motion.FEED,
        segment.start,
        segment.end,
        bend,
        _NO_SIDE,
        is_skippable=False,
        unit=drawn.unit,
        doubled=(False, False),
    )
