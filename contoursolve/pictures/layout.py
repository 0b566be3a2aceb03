"""Lays a scene out on a page: how large it is drawn, what stands in its margins, head and foot."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from math import hypot

from contoursolve.contour import ArcSegment, LineSegment, Segment
from contoursolve.pictures.arrows import THICK, arc, head, line
from contoursolve.pictures.callouts import (
    away_from,
    draw_aligned,
    draw_angle,
    draw_leader,
    draw_point,
    draw_slide,
)
from contoursolve.pictures.canvas import FAINT_WEIGHT, PATH_WEIGHT, THIN_WEIGHT, Canvas
from contoursolve.pictures.frame import WIDTH, foot_of, head_of
from contoursolve.pictures.labels import clip
from contoursolve.pictures.margins import arrange, draw_margins
from contoursolve.pictures.rows import (
    is_nothing,
)
from contoursolve.pictures.scene import Aligned, Angle, Leader, Linear, Scene, Thin, Trail, Weight
from contoursolve.pictures.sheet import Box, Item, Run, Sheet, Spot, Stroke, Sweep, Text, shift
from contoursolve.pictures.theme import DASHES, Role
from contoursolve.pictures.vectors import middle, sweep_of
from contoursolve.pictures.view import View

_ARROWED = 34.0
"""Pixels of an element that is long enough for an arrow."""

_GAP = 0.5
_LEAST = 0.4
"""Pixels. Elements that are smaller are drawn with the next one."""

_MOST_LABELS = 40
"""Labels on one page. Of a larger drawing, the words that are simply given are not drawn: nobody could read them."""

_CORNER = 130.0
"""Pixels that the axes take of the width."""


def lay_out(scene: Scene) -> Sheet:
    """The page of one scene."""
    scene = _thinned(scene)
    top = list(head_of(scene))
    start = max((item.box.bottom for item in top), default=0.0) + 6.0
    plan = arrange(scene, start)
    canvas = Canvas(plan.view, plan.frame)
    _draw_path(canvas, scene)
    draw_margins(canvas, plan)
    _draw_labels(canvas, scene)
    # The axes stand beside the drawing's lower end where nothing else is.
    is_free = canvas.grid.cost(Box(plan.frame.left, plan.frame.bottom - 34.0, _CORNER, plan.frame.bottom)) == 0.0
    foot = list(foot_of(scene, canvas.homeless, plan.frame.bottom - (26.0 if is_free else -4.0)))
    height = max((_bottom(item) for item in foot), default=plan.frame.bottom) + 12.0
    return Sheet(WIDTH, round(height, 1), plan.frame, canvas.items, (*top, *foot))


def _thinned(scene: Scene) -> Scene:
    """The scene as far as it can be read: of a crowded one, words that are not simply given, and names."""
    if len(scene.dimensions) + sum(bool(mark.label) for mark in scene.marks) <= _MOST_LABELS:
        return scene
    special = tuple(each for each in scene.dimensions if each.role is not Role.GIVEN)[:_MOST_LABELS]
    left = max(_MOST_LABELS - len(special), 2)
    marks = tuple(
        replace(mark, label=mark.short if number < left else (), short=()) for number, mark in enumerate(scene.marks)
    )
    told = f"{len(scene.dimensions) - len(special)} words are not drawn: there is no room for so many"
    return replace(scene, dimensions=special, marks=marks, remarks=(*scene.remarks, (Run(told, Role.MUTED),)))


def _bottom(item: Item) -> float:
    return item.box.bottom if isinstance(item, Text) else 0.0


def _draw_path(canvas: Canvas, scene: Scene) -> None:
    """Construction, other contours, and the path over them."""
    view = canvas.view
    if scene.has_turning_axis and scene.trails:
        y = view.place((0.0, 0.0))[1]
        if canvas.frame.top + 4.0 < y < canvas.frame.bottom - 4.0:
            canvas.draw(line((canvas.frame.left, y), (canvas.frame.right, y), Role.MUTED, 0.9), FAINT_WEIGHT)
    for ring in scene.rings:
        radius = ring.radius * view.scale
        if radius < 20 * WIDTH:
            stroke = arc(view.place(ring.center), radius, 0.0, 6.283185307179586, ring.role)
            canvas.draw(stroke, FAINT_WEIGHT if ring.role is Role.MUTED else THIN_WEIGHT)
    for thin in scene.thins:
        ends = _ends_of(canvas, thin)
        if ends is not None:
            canvas.draw(line(*ends, thin.role, 1.0 if thin.role is Role.MUTED else 1.4))
    for trail in sorted(scene.trails, key=lambda each: each.weight is Weight.MAIN):
        is_main = trail.weight is Weight.MAIN
        width = (THICK if trail.role is Role.INK else THICK - 0.4) if is_main else 1.4
        dash = () if trail.role is Role.INK else DASHES.get(trail.role, ())
        for stroke in _strokes(canvas, trail, width, dash):
            canvas.draw(stroke, PATH_WEIGHT if is_main else THIN_WEIGHT)
    for trail in scene.trails:
        if trail.weight is Weight.MAIN:
            for segment in _pointed(trail.segments, view):
                at, way = middle(segment)
                tip, step = view.place(at), (way[0], -way[1])
                ahead = tip[0] + step[0] * 5.0, tip[1] + step[1] * 5.0
                canvas.fill(head(ahead, step, trail.role, 11.0, 4.6))


def _pointed(segments: tuple[Segment, ...], view: View) -> list[Segment]:
    """The elements that are long enough for an arrow, or the longest; corners have their size there."""
    others = [segment for segment in segments if not segment.name.startswith("corner")]
    long = [segment for segment in others if segment.length * view.scale > _ARROWED]
    return long or ([max(others, key=lambda each: each.length)] if others else [])


def _ends_of(canvas: Canvas, thin: Thin) -> tuple[Spot, Spot] | None:
    a, b = canvas.view.place(thin.start), canvas.view.place(thin.end)
    if not thin.is_endless:
        return a, b
    length = hypot(b[0] - a[0], b[1] - a[1])
    if length == 0:
        return None
    way, reach = ((b[0] - a[0]) / length, (b[1] - a[1]) / length), 4 * WIDTH
    return clip(
        (a[0] - way[0] * reach, a[1] - way[1] * reach), (a[0] + way[0] * reach, a[1] + way[1] * reach), canvas.frame
    )


def _strokes(canvas: Canvas, trail: Trail, width: float, dash: tuple[float, ...]) -> Iterator[Stroke]:
    """A path as strokes; one where it has no gap."""
    view = canvas.view
    steps: list[Spot | Sweep] = []
    begin: Spot | None = None
    last = None
    for segment in trail.segments:
        start = view.place(segment.start)
        if begin is None or (last is not None and hypot(start[0] - last[0], start[1] - last[1]) > _GAP):
            if begin is not None and steps:
                yield Stroke(begin, tuple(steps), trail.role, width, dash)
            begin, steps = start, []
        end = view.place(segment.end)
        last = end
        here = steps[-1].end if steps and isinstance(steps[-1], Sweep) else steps[-1] if steps else begin
        if isinstance(here, Sweep):
            here = here.end
        is_small = segment.length * view.scale < _LEAST and segment is not trail.segments[-1]
        if is_small:
            continue
        steps.append(_step(view, segment, end))
    if begin is not None and steps:
        yield Stroke(begin, tuple(steps), trail.role, width, dash)


def _step(view: View, segment: Segment, end: Spot) -> Spot | Sweep:
    if isinstance(segment, LineSegment):
        return end
    return Sweep(view.place(segment.center), segment.radius * view.scale, end, -sweep_of(segment))


def _draw_labels(canvas: Canvas, scene: Scene) -> None:
    """Everything that has a label in the drawing: first all lines, then the labels, those of words first."""
    wanted: list[tuple[Spot, list[tuple[Run, ...]], Spot, Role]] = []
    counts: dict[Spot, int] = {}
    for slide in scene.slides:
        draw_slide(canvas, slide)
    for mark in scene.marks:
        draw_point(canvas, mark)
    for dimension in scene.dimensions:
        if isinstance(dimension, Angle):
            at = canvas.view.place(dimension.at)
            counts[at] = counts.get(at, -1) + 1
            spot, away = draw_angle(canvas, dimension, counts[at])
        elif isinstance(dimension, Aligned):
            spot, away = draw_aligned(canvas, dimension)
        elif isinstance(dimension, Linear) and is_nothing(dimension):
            spot, away = canvas.view.place(dimension.start), (0.7, -0.7)
        else:
            continue
        wanted.append((spot, [(Run(dimension.text, dimension.role),)], away, dimension.role))
    for spot, runs, away, role in wanted:
        canvas.label(spot, runs, away, role)
    for dimension in scene.dimensions:
        if isinstance(dimension, Leader):
            draw_leader(canvas, dimension)
    directions = _directions(canvas, scene)
    for mark in scene.marks:
        if mark.label:
            at = canvas.view.place(mark.at)
            away = away_from(directions.get((round(at[0]), round(at[1])), []))
            canvas.label(at, [mark.label, mark.short], away, Role.MUTED)


def _directions(canvas: Canvas, scene: Scene) -> dict[tuple[int, int], list[Spot]]:
    """By place on the page, the directions in which lines leave it."""
    found: dict[tuple[int, int], list[Spot]] = {}

    def note(a: Spot, b: Spot) -> None:
        length = hypot(b[0] - a[0], b[1] - a[1])
        if length > 0:
            found.setdefault((round(a[0]), round(a[1])), []).append(((b[0] - a[0]) / length, (b[1] - a[1]) / length))

    pairs: Iterable[tuple[Segment | Thin, bool]] = (
        *((segment, True) for trail in scene.trails for segment in trail.segments),
        *((thin, False) for thin in scene.thins),
    )
    for item, _ in pairs:
        a, b = canvas.view.place(item.start), canvas.view.place(item.end)
        if isinstance(item, ArcSegment):
            sign = item.turn.sign
            for at, other, way in ((a, item.start, sign), (b, item.end, -sign)):
                spoke = other[0] - item.center[0], other[1] - item.center[1]
                note(at, (at[0] - spoke[1] * way, at[1] - spoke[0] * way))
        else:
            note(a, b)
            note(b, a)
    return found


def stack_sheets(sheets: list[Sheet]) -> Sheet:
    """Pages under each other as one."""
    drawing: list[Item] = []
    around: list[Item] = []
    height = 0.0
    for sheet in sheets:
        drawing += [shift(item, height) for item in sheet.drawing]
        around += [shift(item, height) for item in sheet.around]
        height += sheet.height
    frame = Box(4.0, sheets[0].frame.top, WIDTH - 4.0, height)
    return sheets[0] if len(sheets) == 1 else Sheet(WIDTH, round(height, 1), frame, tuple(drawing), tuple(around))
