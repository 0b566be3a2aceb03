"""The profiles of turning cycles: from where a cycle begins, and whether it can cut them."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby, pairwise
from math import cos, dist, radians, sin

from msgspec import Struct

from contoursolve.diagnosis import Context, measured, report
from contoursolve.diagnostics import Basis, Diagnostic, Span
from contoursolve.gcode import Block, Caller
from contoursolve.geometry import Length, Plane
from contoursolve.program.solve_queue import Step
from contoursolve.reading import TURNS, ArcIssue, Modes, ReadIssue, Rule, State, apply_modes
from contoursolve.solving import ArcSegment, Point, Segment

ONE_WAY: Mapping[str, tuple[int, ...]] = {"G71": (0, 1), "G72": (1, 0)}
"""Along which axes of the plane (0: Z, 1: X) the profile of a cycle goes one way: always along the first, and along
the second where its first block does not program both axes (Fanuc's type I)."""

ROUGHING = (*ONE_WAY, "G73")
"""The cycles that cut a profile in several passes."""

_SLACK = 1e-3
"""mm that a profile may go back: what rounding does."""

_SAMPLES = 32
"""Chords of an arc."""


class CycleProfile(Struct, frozen=True):
    """The profile of a cycle: the block that calls it, where the tool is then, and its path, mm in the plane, each
    point with its line."""

    caller: Caller
    start: Point | None
    path: tuple[tuple[int, Point], ...]
    plane: Plane
    unit: Length
    is_free: bool
    """Whether its first block programs both axes."""
    has_contour: bool
    """Whether a contour belongs to it."""
    first: Block
    """Its first block."""
    motion: int | None
    """The motion in force in it."""


def profiles_of(steps: Sequence[Step], modes: Modes) -> Iterator[CycleProfile]:
    """The profiles that ran, in order."""
    numbered = list(enumerate(steps))
    for caller, group in groupby(numbered, lambda each: _cycle_of(each[1])):
        inside = list(group)
        if caller is None:
            continue
        first, last = inside[0][0], inside[-1][0]
        behind = steps[last].before
        begin = steps[first].before
        path = list[tuple[int, Point]]()
        for number, step in inside:
            path += _path_of(step, steps[number + 1].before if number + 1 < len(steps) else None)
        plane, block = behind.plane, steps[first].blocks[0]
        axes = {word.address for word in block.words}
        is_free = len(axes & {"X", "Z", "U", "W"}) > 1
        yield CycleProfile(
            caller,
            _place(begin),
            tuple(path),
            plane,
            behind.unit,
            is_free,
            any(step.answer is not None for _, step in inside),
            block,
            apply_modes(begin, block, modes).motion,
        )


def _cycle_of(step: Step) -> Caller | None:
    callers = step.blocks[0].callers if step.blocks else ()
    return callers[-1] if callers and callers[-1].cycle else None


def _path_of(step: Step, after: State | None) -> Iterator[tuple[int, Point]]:
    """The points to which a step leads."""
    answer = step.answer
    if answer is not None:
        for segment in answer.contour.elements if answer.contour else ():
            yield from ((step.blocks[0].line, at) for at in chords(segment))
    elif after is not None:
        place, before = _place(after), _place(step.before)
        if place is not None and place != before:
            yield step.blocks[0].line, place


def chords(segment: Segment) -> list[Point]:
    """The points of a segment behind its start; an arc as chords."""
    if not isinstance(segment, ArcSegment):
        return [segment.end]
    (cx, cy), (x, y) = segment.center, segment.start
    sweep = radians(segment.sweep) * segment.turn.sign
    turned = [sweep * number / _SAMPLES for number in range(1, _SAMPLES)]
    around = [(cx + (x - cx) * cos(a) - (y - cy) * sin(a), cy + (x - cx) * sin(a) + (y - cy) * cos(a)) for a in turned]
    return [*around, segment.end]


def _place(state: State) -> Point | None:
    first, second = state.start().values
    return None if first is None or second is None else (float(first), float(second))


def turns_back(profile: CycleProfile, rules: tuple[Rule, ...]) -> Iterator[Diagnostic]:
    """Findings where the profile of a cycle turns back along an axis along which the cycle goes one way."""
    axes = ONE_WAY.get(profile.caller.cycle, ()) if profile.has_contour else ()
    for axis in axes[:1] if profile.is_free else axes:
        values = [at[axis] for _, at in profile.path]
        if len(values) < 2:  # noqa: PLR2004 - a way has two ends
            continue
        sense = 1 if values[-1] >= values[0] else -1
        farthest = values[0]
        for (line, _), (_, at) in pairwise(profile.path):
            if (at[axis] - farthest) * sense < -_SLACK:
                place = Span(profile.caller.line, 1, len(profile.caller.text) + 1)
                context = Context(rules, profile.unit, place=place)
                row = context.row(ReadIssue.PROFILE_TURNS_BACK)
                yield report(
                    context,
                    row,
                    Basis.NUMERICAL,
                    [],
                    cycle=profile.caller.cycle,
                    axis=profile.plane.axes[axis],
                    line=line,
                    place=measured(at, profile.plane, profile.unit),
                )
                break
            farthest = max(farthest * sense, at[axis] * sense) * sense


_LINES = (0, 1)
"""The motions that the first block of a profile may state."""


def begins_wrongly(profile: CycleProfile, rules: tuple[Rule, ...]) -> Iterator[Diagnostic]:
    """The finding where the first block of a profile states no line: an arc is in force in it, or no code is there."""
    block = profile.first
    codes = [word for word in block.words if word.address == "G"]
    if profile.caller.cycle not in ROUGHING or any(word.number in _LINES for word in codes) or block.file:
        return
    issue = ArcIssue.PROFILE_ARC if profile.motion in TURNS else ArcIssue.PROFILE_CODE
    row = next((rule for rule in rules if rule.about is issue), None)
    if row is not None:
        context = Context(rules, profile.unit, place=block.span)
        words = [word for word in codes if word.number in TURNS]
        yield report(context, row, Basis.RULE, words, cycle=profile.caller.cycle)


def is_reached(profile: CycleProfile) -> bool:
    """Whether where the cycle begins is known, apart from where its profile begins."""
    return bool(profile.start and profile.path and dist(profile.start, profile.path[0][1]) > _SLACK)
