"""Drawings over that of a program: the moves of the tool, one after the other, and the ways that a contour with several
may take."""

from collections.abc import Iterator, Sequence

from contoursolve.comparison import Motion, Travel, follow
from contoursolve.diagnostics import Fix
from contoursolve.pictures import Picture
from contoursolve.program import Result
from contoursolve.solving import ArcSegment, Segment, sweep_of
from contoursolve.workbench.fields import Data
from contoursolve.workbench.open_view import LETTERS, ProgramView, is_choice

MOST_MOVES = 5_000
"""Moves that are played."""

MOST_WAYS = 12
"""Ways of all contours with several that are drawn."""


def over_drawing(view: ProgramView, result: Result, picture: Picture) -> Data:
    """The frame of a drawing of a program, the moves in its plane, and the ways of its contours with several."""
    frame, control = picture.frame, view.program.control
    placement = picture.sheet.placement
    if not frame or placement is None or control is None or not result.answers:
        return {"frame": None, "axes": [], "moves": [], "left_out": 0, "ways": []}
    plane, unit = result.answers[0].plane, result.answers[0].unit
    axes = plane.axes
    path = follow(result, control, unit, axes)
    doubled = next((each.doubled for each in path.steps if isinstance(each, Travel)), (False, False))
    moves = [move for step in path.steps if isinstance(step, Travel) and (move := _move(step))]
    box = placement.frame
    return {
        "frame": {**frame, "box": [box.left, box.top, box.right, box.bottom]},
        "axes": [*axes],
        "isDiameter": [*doubled],
        "unit": unit.value,
        "moves": moves[:MOST_MOVES],
        "left_out": max(len(moves) - MOST_MOVES, 0),
        "ways": [*_ways(view)],
    }


def _move(step: Travel) -> Data | None:
    """A move as it is seen in the plane; None where it is not known, stays, or is an arc of another plane."""
    if step.motion is Motion.PRESET or None in (*step.start, *step.end) or step.file:
        return None
    bend = step.bend
    if bend is not None and bend.axes != (0, 1):
        return None
    if bend is None and step.start == step.end:
        return None
    kind = "rapid" if step.motion is Motion.RAPID else "feed"
    told = {"line": step.line, "kind": kind, "start": [*step.start], "end": [*step.end]}
    return told if bend is None else {**told, "center": [*bend.center], "sweep": bend.sweep}


def _ways(view: ProgramView) -> Iterator[Data]:
    left = MOST_WAYS
    for finding, lines in view.program.found():
        if not is_choice(finding) or left < len(finding.fixes):
            continue
        left -= len(finding.fixes)
        found = [_contour_by(view, fix, lines) for fix in finding.fixes]
        # What all have in common is drawn as it is.
        own = [{_rounded(each) for each in segments} for segments in found if segments]
        for letter, segments in zip(LETTERS, found, strict=False):
            alone = [each for each in segments if not all(_rounded(each) in others for others in own)]
            yield {"letter": letter, "line": lines[0], "pieces": [_piece(each) for each in alone]}


def _contour_by(view: ProgramView, fix: Fix, lines: Sequence[int]) -> Sequence[Segment]:
    """The contour on some lines as a fix makes it; empty where that is none."""
    tried = view.program.copy()
    for begin, end, new in sorted(tried.edits_of(view.changes_of(fix, lines)), reverse=True):
        tried.edit(begin, end, new)
    last = lines[-1] + len(fix.replacement.split("\n")) - len(lines)
    tried.look(lines[0], last)
    while not tried.is_examined(lines[0], last) and not tried.check(1):
        pass
    answer = tried.contour_at(lines[0])
    return answer.contour.elements if answer is not None and answer.contour is not None else ()


def _rounded(segment: Segment) -> tuple[float, ...]:
    center = segment.center if isinstance(segment, ArcSegment) else ()
    return tuple(round(each, 6) for each in (*segment.start, *segment.end, *center))


def _piece(segment: Segment) -> Data:
    told: Data = {"start": [*segment.start], "end": [*segment.end]}
    return told | {"center": [*segment.center], "sweep": sweep_of(segment)} if isinstance(segment, ArcSegment) else told
