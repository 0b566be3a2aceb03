"""Several contours in one picture: those of a program with the moves between them, and one block for several values."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from pathlib import PurePath

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison import Motion, Travel, follow
from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import Answer, statuses_text
from contoursolve.geometry import SECOND, Length, Plane, Turn
from contoursolve.pictures.compose import MOST_ELEMENTS, remarks_of
from contoursolve.pictures.page import TextRun, visible
from contoursolve.pictures.part_dimensions import dimension_part
from contoursolve.pictures.scene import Closeup, Mark, MarkKind, Part, Scene, ToolDrawing, Trail, Weight, axis_names
from contoursolve.pictures.subject import find_known, list_trails
from contoursolve.pictures.theme import Role
from contoursolve.pictures.turned_part import crosses_axis, cylinders_of, shows_both_halves, turn_part
from contoursolve.pictures.two_solutions import two_solutions
from contoursolve.program import CycleProfile, Result
from contoursolve.solving import (
    ArcSegment,
    LineSegment,
    Point,
    Segment,
    along,
    distance,
    foot_on,
    minus,
    on_arc,
    shifted,
)
from contoursolve.tolerance import LENGTH

MOST_CONTOURS = 400
"""Contours that are drawn; a picture of more says how many it leaves out."""

MOST_LABELED = 60

MOST_DIMENSIONS = 60
"""Dimensions and names in one drawing."""

MOST_MOVES = 2_000
"""Moves that are drawn."""

MOST_REFUSED = 12
"""Contours without a path of which the picture says what is wrong."""

_READABLE = 16.0
"""Pixels of the larger side of a contour that can be read."""

MOST_VALUES = 48
"""Contours of a fan."""

_LABELED = 7
"""Contours of a fan that are labelled, besides those beside which the outcome changes."""

_SHARES = tuple(number / 16 for number in range(16, 3, -1))
"""Shares of a path, from its end on, after which the contours of a fan may be labelled."""

_WIDE = 2.5
"""Heights of a label that it is wide."""


class DrawnContour(Struct, frozen=True):
    """A contour as it is drawn: its number, from 1, and its path; no trails where nothing of it is known."""

    number: int
    answer: Answer
    trails: tuple[Trail, ...]

    @property
    def start(self) -> Point:
        """The start of the path."""
        return self.trails[0].segments[0].start

    @property
    def end(self) -> Point:
        """The end of the path."""
        return self.trails[-1].segments[-1].end

    @property
    def segments(self) -> tuple[Segment, ...]:
        """Its elements."""
        return tuple(segment for trail in self.trails for segment in trail.segments)


class PlaneMove(Struct, frozen=True):
    """A move in a plane, whose axes it names, and whether it cuts the part: at a feed between two solved contours, or
    behind one where the tool is still compensated, or the work turns."""

    segment: Segment
    axes: tuple[str, str]
    is_rapid: bool
    is_cut: bool


def compose_overview(
    result: Result, title: str | None, *, is_whole: bool | None = None, beside: Sequence[ToolDrawing] = ()
) -> list[Scene]:
    """A scene for each plane in which the program has contours, or something is drawn beside them, in their order.
    `is_whole` shows turned parts with both halves; without it, where that leaves the contours half as large."""
    total = len(result.answers)
    told = statuses_text(Counter(answer.status for answer in result.answers))
    named = f"{PurePath(result.program.name).name}: {total} contour{'' if total == 1 else 's'}"
    shown = title if title is not None else named + (f" ({told})" if told else "")
    if not total and beside:
        shown = title if title is not None else f"{PurePath(result.program.name).name}: {beside[0].title}"
    elif not total:
        none = (TextRun("The program has no contour.", Role.MUTED),)
        return [Scene(shown, ("", ""), remarks=(none, *remarks_of(result.diagnostics)))]
    moves = _moves(result) if total else []
    everything: list[Answer | ToolDrawing] = [*result.answers, *beside]
    unit = Length.INCH if all(each.unit is Length.INCH for each in everything) else Length.MM
    scenes: list[Scene] = []
    for plane in dict.fromkeys(each.plane for each in everything):
        own = [(number, answer) for number, answer in enumerate(result.answers, 1) if answer.plane == plane]
        drawn = [
            DrawnContour(number, answer, tuple(_in_overview(each, answer) for each in _trails(answer)))
            for number, answer in own[:MOST_CONTOURS]
        ]
        told = shown if not scenes else f"{plane.code}: {' and '.join(plane.axes)}"
        near = [each for each in moves if each.axes == plane.axes]
        more = [each for each in beside if each.plane == plane]
        # Of what has no place on the axis across, it is not known how far from the turning axis it is.
        is_turned = plane.diameters[SECOND] and not any(answer.start.free[SECOND] for _, answer in own)
        cut = [move.segment for move in near if move.is_cut]
        solved = [answer for _, answer in own[:MOST_CONTOURS] if answer.contour and not answer.start.is_relative]
        paths = [each for one in drawn for each in one.segments]
        shown_whole = is_turned and shows_both_halves(paths, is_whole)
        part = dimension_part(solved, cut, paths, unit, is_turned=is_turned, is_whole=shown_whole)
        scene = Scene(
            told,
            axis_names(plane),  # it has no numbers, so that contours in mm and in inches may stand together
            (*_profile_parts(result.profiles, plane, near), *_move_trails(near), *_contour_parts(drawn), *part.parts),
            remarks=tuple(_remarks(drawn, len(own))),
            meanings={Role.CONFLICTING: "no contour", Role.DERIVED: "(worked out by the control)"},
            has_turning_axis=is_turned,
            closeups=(*_closeups(drawn), *part.closeups),
            is_part=True,
            most_labels=MOST_DIMENSIONS,
            scale_unit=unit,
        ).with_beside(more)
        known = {(segment.start, segment.end) for segment in cut}
        cut += [each for one in more for each in one.cut if (each.start, each.end) not in known]
        scenes.append(_turned(scene, drawn, cut, is_whole=shown_whole) if is_turned else scene)
    return scenes


def _turned(scene: Scene, drawn: Sequence[DrawnContour], cut: Iterable[Segment], *, is_whole: bool) -> Scene:
    """The scene of contours on a lathe: the part around its axis."""
    solved = [each for each in drawn if each.answer.contour is not None]
    cut = [*(segment for each in solved for segment in each.segments), *cut]
    cylinders = [each for one in solved for each in cylinders_of(one.segments, one.answer.unit)]
    told = [
        (TextRun(f"{each.number}, program line {each.answer.lines[0]}: the path crosses the turning axis", Role.INK),)
        for each in drawn
        if crosses_axis(each.segments)
    ]
    scene = replace(scene, remarks=(*scene.remarks, *told))
    return turn_part(scene, cut, cylinders, is_whole=is_whole)


def describe_overview(result: Result) -> str:
    """Description of the picture of a program in words: its contours with the status of each."""
    shown = result.answers[:MOST_ELEMENTS]
    sentences = []
    for number, answer in enumerate(shown, 1):
        fault = "" if answer.contour is not None else _fault(answer)
        sentences.append(
            f"Contour {number}, program line {answer.lines[0]}, {answer.claim.form.name}: {answer.state}{fault}."
        )
    if len(result.answers) > len(shown):
        sentences.append(f"And {len(result.answers) - len(shown)} more contours.")
    cycles = dict.fromkeys(_cycle(each) for each in result.profiles)
    sentences += [f"{cycle}: dashed lines lead to its profile and back." for cycle in cycles]
    return " ".join(sentences) or "There is no contour."


def _profile_parts(profiles: Sequence[CycleProfile], plane: Plane, moves: Sequence[PlaneMove]) -> Iterator[Part]:
    """The ways between the start of each cycle and the ends of its profile, and the cycles by their names and lines."""
    drawn = {(move.segment.start, move.segment.end) for move in moves}
    begun: dict[Point, list[str]] = {}
    for each in profiles:
        if each.start is None or not each.path or each.plane != plane:
            continue
        named = begun.setdefault(each.start, [])
        if _cycle(each) not in named:
            named.append(_cycle(each))
        for way in ((each.start, each.path[0][1]), (each.path[-1][1], each.start)):
            if way not in drawn and distance(*way) > LENGTH:
                drawn.add(way)
                yield Trail((LineSegment("way", *way),), Role.RAPID, Weight.PASSING)
    for start, named in list(begun.items())[:MOST_LABELED]:
        label = (TextRun("; ".join(named), Role.MUTED),)
        yield Mark(start, MarkKind.PLACE, label, label)


def _cycle(profile: CycleProfile) -> str:
    """The cycle that cuts a profile, and its line."""
    return f"{profile.caller.cycle}, program line {profile.caller.line}"


def _contour_parts(drawn: Sequence[DrawnContour]) -> Iterator[Part]:
    """The paths, with their numbers where they begin, and their ends."""
    named = [each for each in drawn[:MOST_LABELED] if each.trails]
    begun: dict[Point, list[DrawnContour]] = {}
    for each in named:
        begun.setdefault(each.start, []).append(each)
    for each in drawn:
        is_chain = each.answer.claim.form.is_general  # whose elements have colours of their own
        yield from each.trails if is_chain else (replace(trail, role=_role(each.answer)) for trail in each.trails)
    for each in named:
        here = begun.pop(each.start, None)
        if here:
            label = _label(here)
            yield Mark(each.start, MarkKind.START, label, label[:-1])
        yield Mark(each.end, MarkKind.END)


def _remarks(drawn: Sequence[DrawnContour], total: int) -> Iterator[tuple[TextRun, ...]]:
    """Remarks on the errors of contours without a path, and on contours that are not drawn."""
    placeless = [each for each in drawn if each.answer.start.is_relative]
    if placeless:
        axes = [axis for each in placeless for axis in _free_axes(each.answer)]
        told = " and ".join(dict.fromkeys(axes))
        numbers = ", ".join(str(each.number) for each in placeless[:MOST_REFUSED])
        more = f" and {len(placeless) - MOST_REFUSED} more" if len(placeless) > MOST_REFUSED else ""
        yield (TextRun(f"{numbers}{more}: the place on {told} is not known", Role.MUTED),)
    refused = [each for each in drawn if each.answer.contour is None]
    for each in refused[:MOST_REFUSED]:
        status = each.answer.state
        told = f"{each.number}, program line {each.answer.lines[0]}, {status}{_fault(each.answer)}"
        yield (TextRun(visible(told), Role.CONFLICTING),)
    if len(refused) > MOST_REFUSED:
        yield (TextRun(f"... and {len(refused) - MOST_REFUSED} more without a contour", Role.CONFLICTING),)
    if total > len(drawn):
        yield (TextRun(f"... and {total - len(drawn)} more contours, which are not drawn", Role.MUTED),)


def _fault(answer: Answer) -> str:
    """The first thing that is wrong with a contour."""
    found = next((each for each in answer.diagnostics if each.is_error), None)
    return f": {found.message}" if found is not None else ""


def _closeups(drawn: Sequence[DrawnContour]) -> Iterator[Closeup]:
    """The contours, each of which may be too small."""
    for each in drawn:
        if each.trails and each.answer.contour is not None:
            yield Closeup(f"{each.number}  program line {each.answer.lines[0]}", each.segments, _READABLE)


def _free_axes(answer: Answer) -> Iterator[str]:
    """The axes on which the place of a contour is not known."""
    return (axis for axis, is_free in zip(answer.plane.axes, answer.start.free, strict=True) if is_free)


def _in_overview(trail: Trail, answer: Answer) -> Trail:
    """A path of a contour as it lies to the others: one without a place is as far on as steps have led before it."""
    segments = tuple(shifted(each, answer.led) for each in trail.segments) if any(answer.led) else trail.segments
    return replace(trail, segments=segments, line=answer.lines[0])


def _trails(answer: Answer) -> list[Trail]:
    both = two_solutions(answer)
    if both is not None:
        return [*both.trails]
    return [*list_trails(answer, find_known(answer))]


def _label(here: Sequence[DrawnContour]) -> tuple[TextRun, ...]:
    """The numbers and the lines of the contours that begin at one place."""
    numbers = [TextRun(f"{', ' if place else ''}{each.number}", _role(each.answer)) for place, each in enumerate(here)]
    lines = ", ".join(str(each.answer.lines[0]) for each in here)
    return (*numbers, TextRun(f"  program line{'s' if len(here) > 1 else ''} {lines}", Role.MUTED))


def _role(answer: Answer, solved: Role = Role.INK) -> Role:
    return solved if answer.contour is not None else Role.CONFLICTING


# Moves -------------------------------------------------------------------------------------------------------


def _moves(result: Result) -> list[PlaneMove]:
    """The moves at a feed that are joined to a contour, before it or after it, in the plane of that contour, and the
    rapid moves that lead to these or away from them; nothing for a control that nobody has described."""
    control = CONTROLS.get(result.control or "")
    if control is None:
        return []
    axes = tuple(dict.fromkeys(axis for answer in result.answers for axis in answer.plane.axes))
    # Before any code that says it, the unit is that of the first contour.
    path = follow(result, control.configure(result.settings), result.answers[0].unit, axes)
    owners = {line: answer for answer in result.answers for line in answer.lines}
    found: dict[int, PlaneMove] = {}
    reached: Counter[int] = Counter()
    for is_forward, steps in ((True, list(enumerate(path.steps))), (False, list(enumerate(path.steps))[::-1])):
        owner: Answer | None = None
        is_rapid = False
        for number, step in steps:
            if step.line in owners and not step.file:
                owner, is_rapid = owners[step.line], False
                continue
            motion = step.motion if isinstance(step, Travel) else None
            if motion not in (Motion.FEED, Motion.RAPID) or (is_rapid and motion is Motion.FEED):
                owner = None
            if owner is None or not isinstance(step, Travel):
                continue
            is_rapid = motion is Motion.RAPID
            segment = flat_segment(step, axes, owner.plane.axes)
            if segment is not None:
                is_solved = owner.contour is not None and not is_rapid
                is_led = is_forward and bool(step.compensation or owner.plane.diameters[SECOND])
                # From both sides, or from one where it is known to cut.
                reached[number] += is_solved * (1 + is_led)
                found[number] = PlaneMove(segment, owner.plane.axes, is_rapid, reached[number] > 1)
    # What runs several times is drawn once.
    once = {(move.segment, move.is_rapid): move for _, move in sorted(found.items(), key=lambda each: each[0])}
    return list(once.values())[:MOST_MOVES]


def plain_trail(result: Result, like: Answer) -> list[Trail]:
    """The feed moves of a program as it is where a contour stood, which needs none any more."""
    control = CONTROLS.get(result.control or "")
    if control is None:
        return []
    axes = like.plane.axes
    steps = follow(result, control.configure(result.settings), like.unit, axes).steps
    moves = [step for step in steps if isinstance(step, Travel) and step.motion is Motion.FEED]
    segments = [flat_segment(step, axes, axes) for step in moves if like.lines[0] <= step.line <= like.lines[-1]]
    found = tuple(segment for segment in segments if segment is not None)
    return [Trail(found, Role.INK)] if found else []


def _move_trails(moves: Sequence[PlaneMove]) -> Iterator[Trail]:
    """Moves as they are drawn: what cuts as the part; all else thin, and straight moves as far as the picture goes."""
    for move in moves:
        role = Role.RAPID if move.is_rapid else Role.INK
        thin = Weight.BESIDE if isinstance(move.segment, ArcSegment) else Weight.PASSING
        weight = Weight.MAIN if move.is_cut else thin
        yield Trail((move.segment,), role, weight)


def flat_segment(travel: Travel, axes: tuple[str, ...], plane: tuple[str, str]) -> Segment | None:
    """A move as it is seen in a plane, if it is a line or an arc there."""
    first, second = (axes.index(axis) for axis in plane)
    (x, y), (u, v) = ((place[first], place[second]) for place in (travel.start, travel.end))
    bend = travel.bend
    if x is None or y is None or u is None or v is None:
        return None
    if bend is None:
        return LineSegment("move", (x, y), (u, v)) if distance((u, v), (x, y)) > LENGTH else None
    turn = Turn.CCW if bend.sweep > 0 else Turn.CW
    is_flat = bend.axes == (first, second)
    return ArcSegment("move", (x, y), (u, v), bend.center, bend.radii[0], turn) if is_flat else None


# Fans --------------------------------------------------------------------------------------------------------


def compose_fan(word: str, values: Sequence[float], answers: Sequence[Answer], title: str | None) -> Scene:
    """The contours of one block for several values of one word. Raises ValueError for none, or more than there is room
    for."""
    if not answers or len(answers) != len(values):
        raise ValueError(f"a fan needs a value for each of its contours: {len(values)} for {len(answers)}")
    if len(answers) > MOST_VALUES:
        raise ValueError(f"a fan of {len(answers)} contours cannot be read; draw at most {MOST_VALUES}")
    every = max(1, -(-len(answers) // _LABELED))
    parts: list[Part] = []
    labelled: list[tuple[tuple[TextRun, ...], list[Segment]]] = []
    for number, (value, answer) in enumerate(zip(values, answers, strict=True)):
        own, role, is_solved = _trails(answer), _role(answer, Role.GIVEN), answer.contour is not None
        is_edge = number and (answers[number - 1].contour is None) == is_solved
        is_named = bool(own) and (number % every == 0 or number == len(answers) - 1 or is_edge)
        weight = Weight.GHOST if not is_solved else Weight.MAIN if is_named else Weight.BESIDE
        parts += [replace(trail, role=role, weight=weight) for trail in own]
        if is_named:
            labelled.append(((TextRun(f"{word}{value:g}", role),), [each for trail in own for each in trail.segments]))
            parts.append(Mark(own[-1].segments[-1].end, MarkKind.END))
    places = _told_apart([path for _, path in labelled])
    parts += [Mark(at, MarkKind.PLACE, text, text) for (text, _), at in zip(labelled, places, strict=True)]
    start = next((part.segments[0].start for part in parts if isinstance(part, Trail)), None)
    parts += [Mark(start, MarkKind.START, (TextRun("start", Role.INK),))] if start is not None else []
    told = statuses_text(Counter(answer.status for answer in answers))
    named = f"{word} from {min(values):g} to {max(values):g}, {len(answers)} contours: {told}"
    return Scene(
        title if title is not None else named,
        axis_names(answers[0].plane, answers[0].unit),
        tuple(parts),
        meanings={Role.GIVEN: "solved", Role.CONFLICTING: "no contour"},
        has_turning_axis=answers[0].plane.diameters[SECOND],
    )


def _told_apart(paths: Sequence[Sequence[Segment]]) -> list[Point]:
    """A place on each path, after the same share of its length: where those in a row differ most."""
    rows = [[_after(share, path) for path in paths] for share in _SHARES]
    return max(rows, key=lambda row: _least_apart(row, paths)) if len(paths) > 1 else rows[0]


def _least_apart(places: Sequence[Point], paths: Sequence[Sequence[Segment]]) -> float:
    """The least distance of the places from the paths beside them, and from one another.

    A label is wide, so that places beside one another are nearer than those above one another.
    """
    found = []
    for (at, own), (other, beside) in pairwise(zip(places, paths, strict=True)):
        labels = max(abs(at[0] - other[0]) / _WIDE, abs(at[1] - other[1]))
        found.append(min(labels, *(distance(at, foot_on(each, at)) for each in beside)))
        found.append(min(distance(other, foot_on(each, other)) for each in own))
    return min(found)


def _after(share: float, path: Sequence[Segment]) -> Point:
    """The place after a share of the length of a path."""
    left = share * sum(each.length for each in path)
    for each in path:
        if left <= each.length:
            part = left / each.length if each.length else 0.0
            if isinstance(each, ArcSegment):
                return on_arc(each, part)[0]
            return along(each.start, minus(each.end, each.start), part)
        left -= each.length
    return path[-1].end
