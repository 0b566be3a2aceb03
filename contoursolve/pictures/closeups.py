"""Enlarged details below a drawing: of what would be too small to be read, each with how much larger it is."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import atan2, cos, sin, sqrt, tau

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import FIRST, SECOND
from contoursolve.pictures.callouts import draw_callouts, keep_signs
from contoursolve.pictures.labels import FAINT_WEIGHT, PATH_WEIGHT, Canvas, clip
from contoursolve.pictures.page import (
    ANYTHING,
    PAD,
    SIZE,
    THICK,
    WIDTH,
    About,
    Box,
    Item,
    Spot,
    Stroke,
    Sweep,
    Text,
    TextRun,
    shorten,
)
from contoursolve.pictures.scene import Closeup, Leader, Mark, Scene, Trail, Viewport, Weight
from contoursolve.pictures.theme import DASHES, Role
from contoursolve.solving import ArcSegment, Segment, distance, extremes, sweep_of

MOST_DETAILS = 4
"""Details below one drawing, in one row."""

MOST_SMALL = 12
"""Small parts of one drawing that are shown enlarged; of more, details would be as crowded."""

_GAP, _TITLE = 12.0, 20.0
_WIDE = (WIDTH - 2 * PAD - (MOST_DETAILS - 1) * _GAP) / MOST_DETAILS
_HIGH = 124.0
"""Pixels between details, of a title, and of a detail."""

ROW = _TITLE + _HIGH + _GAP
"""Pixels that a row of details takes."""

_SMALL = SIZE - 1.0
"""Pixels of the font of what stands at a detail."""

_SHARE = 0.4
"""1. How much of a detail its subject takes."""

_TIMES = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0)
"""Round magnifications of a detail; ten times, a hundred times ... as much as well."""

_LEAST = 2.0
"""Least magnification for which a detail is worth its room."""

_LARGEST = 100_000
_CLEAR = 7.0
"""Pixels around a place in the drawing that its sign keeps clear."""


class Detail(Struct, frozen=True):
    """An enlarged part of a drawing: its names, its box on the drawing, and its magnification."""

    names: tuple[str, ...]
    box: Box
    times: float

    @property
    def middle(self) -> Spot:
        """The middle of it on the drawing."""
        return (self.box.left + self.box.right) / 2, (self.box.top + self.box.bottom) / 2


def choose_details(closeups: Iterable[Closeup], view: Viewport) -> tuple[list[Detail], list[str]]:
    """The details for all closeups that are too small, neighbours in one detail. Also the names of those without
    room."""
    small: list[tuple[tuple[str, ...], Box]] = []
    boxes = [(each, _box_of(each.segments, view)) for each in closeups]
    tiny = [(each, box) for each, box in boxes if max(box.right - box.left, box.bottom - box.top) < each.least]
    if len(tiny) > MOST_SMALL:
        return [], [*dict.fromkeys(each.name for each, _ in tiny)]
    for closeup, own in tiny:
        names: tuple[str, ...] = (closeup.name,)
        box = own
        near = next((each for each in small if each[1].grow(_CLEAR).meets(own)), None)
        if near is not None and near[1].right - near[1].left + near[1].bottom - near[1].top < 2 * closeup.least:
            small.remove(near)
            names, box = tuple(dict.fromkeys((*near[0], *names))), _around(near[1], own)
        small.append((names, box))
    found = [Detail(names, box, _times(box)) for names, box in small]
    worth = [each for each in found if each.times >= _LEAST]
    return worth[:MOST_DETAILS], [*dict.fromkeys(name for each in worth[MOST_DETAILS:] for name in each.names)]


def _box_of(segments: Sequence[Segment], view: Viewport) -> Box:
    spots = [view.place(at) for segment in segments for at in extremes(segment, 0, 1)]
    across, down = zip(*spots, strict=True)
    return Box(min(across), min(down), max(across), max(down))


def _around(one: Box, other: Box) -> Box:
    return Box(
        min(one.left, other.left),
        min(one.top, other.top),
        max(one.right, other.right),
        max(one.bottom, other.bottom),
    )


def _times(box: Box) -> float:
    """Largest round magnification at which a box fits a detail."""
    sizes = ((_WIDE, box.right - box.left), (_HIGH, box.bottom - box.top))
    most = min((room * _SHARE / size for room, size in sizes if size > 0), default=1.0)
    power, best = 1.0, 1.0
    while power * _TIMES[0] <= min(most, _LARGEST):
        best = max(power * each for each in _TIMES if power * each <= most)
        power *= 10.0
    return best


def mark_details(canvas: Canvas, details: Sequence[Detail]) -> None:
    """A frame with a letter around each place that is shown enlarged."""
    for letter, detail in zip(_LETTERS, details, strict=False):
        box = detail.box.grow(_CLEAR)
        canvas.draw(_edges(box), FAINT_WEIGHT)
        canvas.label((box.right, box.top), [(TextRun(letter, Role.INK),)], (0.7, -0.7), Role.MUTED)


_LETTERS = "ABCD"


def draw_details(scene: Scene, view: Viewport, details: Sequence[Detail], top: float) -> Iterator[Item]:
    """The details side by side, from `top` on their page down."""
    for number, (letter, detail) in enumerate(zip(_LETTERS, details, strict=False)):
        left = PAD + number * (_WIDE + _GAP)
        frame = Box(left, top + _TITLE, left + _WIDE, top + _TITLE + _HIGH)
        named = shorten(f"{letter}: {', '.join(detail.names)}", _WIDE, _SMALL)
        yield Text((left, top + 13.0), (TextRun(named, Role.INK),), _SMALL)
        size = TextRun(f"{detail.times:g} times as large", Role.MUTED)
        yield Text((left + 6.0, frame.bottom - 6.0), (size,), _SMALL)
        yield _edges(frame)
        inner = Box(frame.left, frame.top, frame.right, frame.bottom - 18.0)
        yield from _drawn(scene, view, detail, inner)


def _edges(box: Box) -> Stroke:
    corners = ((box.right, box.top), (box.right, box.bottom), (box.left, box.bottom), (box.left, box.top))
    return Stroke((box.left, box.top), corners, Role.MUTED, 0.9)


def _drawn(scene: Scene, view: Viewport, detail: Detail, frame: Box) -> tuple[Item, ...]:
    """A part of a scene, enlarged in a frame, with the words and the points there."""
    at = detail.middle
    middle = (
        view.middle[FIRST] + (at[0] - view.spot[0]) / view.scale,
        view.middle[SECOND] - (at[1] - view.spot[1]) / view.scale,
    )
    spot = (frame.left + frame.right) / 2, (frame.top + frame.bottom) / 2
    large = Viewport(middle, view.scale * detail.times, spot)
    canvas = Canvas(large, frame)
    if scene.is_part:
        canvas.keep_clear()
    trails = [each for each in scene.each(Trail) if each.weight in (Weight.MAIN, Weight.BESIDE)]
    for trail in trails:
        is_main, is_ink = trail.weight is Weight.MAIN, trail.role is Role.INK
        for segment in trail.segments:
            with canvas.about(About(element=segment.name) if scene.is_one_contour and is_main else ANYTHING):
                for start, step in _within(segment, large, frame):
                    dash = () if is_ink else DASHES.get(trail.role, ())
                    canvas.draw(Stroke(start, (step,), trail.role, THICK if is_main else 1.4, dash), PATH_WEIGHT)
    named = [replace(each, label=each.short or each.label) for each in scene.each(Mark)]
    pointing: list[Mark | Leader] = [*named, *scene.each(Leader)]
    inside = [each for each in pointing if _holds(frame.grow(-6.0), large.place(each.at))]
    within = replace(scene, parts=(*trails, *inside))
    keep_signs(canvas, within)
    draw_callouts(canvas, within)
    return canvas.items


def _holds(frame: Box, spot: Spot) -> bool:
    return frame.holds(Box(*spot, *spot))


def _within(segment: Segment, view: Viewport, frame: Box) -> Iterator[tuple[Spot, Spot | Sweep]]:
    """The parts of an element that lie in a frame: where each begins, and the step to its end."""
    a, b = view.place(segment.start), view.place(segment.end)
    if not isinstance(segment, ArcSegment):
        ends = clip(a, b, frame)
        if ends is not None and distance(*ends) > 0:
            yield ends
        return
    center, radius, sweep = view.place(segment.center), segment.radius * view.scale, -sweep_of(segment)
    begin = atan2(a[1] - center[1], a[0] - center[0])

    def at(turned: float) -> Spot:
        return center[0] + radius * cos(begin + turned), center[1] + radius * sin(begin + turned)

    turns = sorted({0.0, abs(sweep), *_crossings(center, radius, begin, sweep, frame)})
    for low, high in pairwise(turns):
        sign = 1.0 if sweep > 0 else -1.0
        spot = at(sign * (low + high) / 2)
        if high - low > 0 and _holds(frame, spot):
            end = at(sign * high)
            yield at(sign * low), Sweep(center, radius, end, sign * (high - low))


def _crossings(center: Spot, radius: float, begin: float, sweep: float, frame: Box) -> Iterator[float]:
    """Turned angles (radians, without sign) at which an arc meets the lines of a frame's edges."""
    sign = 1.0 if sweep > 0 else -1.0
    for axis, level in ((0, frame.left), (0, frame.right), (1, frame.top), (1, frame.bottom)):
        off = level - center[axis]
        if abs(off) >= radius:
            continue
        other = sqrt(radius * radius - off * off)
        for rest in (other, -other):
            angle = atan2(rest, off) if axis == 0 else atan2(off, rest)
            turned = ((angle - begin) * sign) % tau
            if 0 < turned < abs(sweep):
                yield turned
