"""Reads a small program as its control does, and measures how far its contour is off the drawn one."""

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison import Motion, ToolPath, Travel, bend_of, compare, follow
from contoursolve.diagnosis import Depth
from contoursolve.gcode import parse
from contoursolve.geometry import Length
from contoursolve.postprocess.contour_drawing import ContourDrawing
from contoursolve.program import Request, run
from contoursolve.reading import Dialect, ReadIssue
from contoursolve.solving import ArcSegment, Point, Segment

SAME = 1e-6
"""mm. A contour whose words are exact is read back to within this."""

_UNITS_OFF = 2
"""A contour with rounded words is read back to within so many units of the last decimal of its control."""


class ReadBack(Struct, frozen=True):
    """A program read back: by how much its contour is off, mm, and where it ends; None and the line to blame where it
    is another contour, or has a finding."""

    deviation: float | None
    line: int = 0
    word: str = ""
    """The text to which a finding points."""
    end: Point = (0.0, 0.0)
    reason: str = ""
    """The reason why it is refused."""


def read_back(
    program: str,
    drawn: ContourDrawing,
    target: Dialect,
    *,
    is_exact: bool,
    motion: Motion = Motion.FEED,
    is_strict: bool = True,
    depth: Depth = Depth.VERDICT,
) -> ReadBack:
    """Read a program as its control does, and compare its cuts with a contour. It has no error; if this `is_strict`, no
    finding at all."""
    asked = Request(target, drawn.unit, depth=depth, is_strict=is_strict)
    result = run(parse(program, syntax=target.modes.syntax), asked)
    for finding in result.diagnostics:
        if finding.is_error or (is_strict and finding.about is not ReadIssue.NO_CONTOUR):
            span = finding.span
            text = program.split("\n")[span.line - 1] if span.line > 0 else ""
            word = text[span.column - 1 : span.end_column - 1]
            return ReadBack(None, span.line, word, reason=f"{finding.code}: {finding.message}")
    axes, numbers = drawn.plane.axes, target.modes.lexicon.numbers
    path = follow(result, target, drawn.unit, axes)
    # The first move leads to where the contour begins, from a place that is not known.
    steps = tuple(
        replace(each, compensation=_NO_SIDE) if isinstance(each, Travel) else each
        for each in path.steps
        if not (isinstance(each, Travel) and None in each.start)
    )
    unit = float(numbers.inch * drawn.unit.in_mm if drawn.unit is Length.INCH else numbers.mm)
    own = ToolPath("", "", axes, tuple(_travel(each, drawn, motion) for each in drawn.path))
    found = compare(own, replace(path, steps=steps), SAME if is_exact else _UNITS_OFF * unit)
    last = steps[-1] if steps else None
    if found.difference is None and isinstance(last, Travel):
        return ReadBack(found.deviation, 0, "", (last.end[0] or 0.0, last.end[1] or 0.0))
    blamed = (found.difference.new if found.difference else None) or last
    reason = found.difference.reason if found.difference else "no motion"
    return ReadBack(None, blamed.line if blamed else 0, reason=f"rounded numbers lead elsewhere: {reason}")


_NO_SIDE = 40


def _travel(segment: Segment, drawn: ContourDrawing, motion: Motion) -> Travel:
    bend = None
    if isinstance(segment, ArcSegment):
        bend = bend_of((0, 1), segment.center, segment.start, segment.end, segment.turn)
    return Travel(
        0,
        "",
        motion,
        segment.start,
        segment.end,
        bend,
        _NO_SIDE,
        is_skippable=False,
        unit=drawn.unit,
        doubled=(False, False),
    )
