"""Signs in the drawing itself: angles, radii, gaps, points with their names, and free movements."""

from collections.abc import Iterator, Mapping
from math import cos, fmod, hypot, pi, radians, sin

from contoursolve.pictures.labels import FAINT_WEIGHT, Canvas, Grip
from contoursolve.pictures.page import THIN, Box, Dot, Spot, Stroke, TextRun, arc, head, line
from contoursolve.pictures.scene import (
    Aligned,
    Angle,
    Dimension,
    Leader,
    LinearDimension,
    Mark,
    MarkKind,
    Scene,
    Slide,
    Thin,
    Trail,
)
from contoursolve.pictures.theme import Role
from contoursolve.solving import ArcSegment, along, direction, distance, minus, unit

_RADIUS, _STEP = 34.0, 13.0
"""Pixels. Radius of the arc of an angle, and how much more each further one at the same place has."""

_SMALL = 4.0
"""Degrees. A smaller angle has no room for an arc."""

_SLIDE = 34.0
_BESIDE = 20.0
"""Pixels from a line to its dimension line."""

_SHORT = 22.0

_HALF = 4.2
"""Pixels of half the side of a square mark."""

_OFF, _CROSS = 9.0, 5.0
"""Pixels from a line to the arrow of an angle of 0, and of half a cross."""


def keep_signs(canvas: Canvas, scene: Scene) -> None:
    """No text stands on the cross of a centre or of a virtual intersection."""
    crosses = (m for m in scene.each(Mark) if scene.is_part or m.kind not in _DOTS or m.kind is MarkKind.TIP)
    canvas.signs += [Box(*at, *at).grow(_CROSS) for at in (canvas.view.place(mark.at) for mark in crosses)]


def draw_callouts(canvas: Canvas, scene: Scene) -> None:
    """Everything that has a label in the drawing: first all lines, then the labels, those of words first."""
    wanted: list[tuple[Spot, Dimension, Spot]] = []
    counts: dict[Spot, int] = {}
    for slide in scene.each(Slide):
        _draw_slide(canvas, slide)
    for mark in scene.each(Mark):
        with canvas.about(mark.about):
            _draw_point(canvas, mark)
    for dimension in scene.dimensions:
        with canvas.about(dimension.about):
            if isinstance(dimension, Angle):
                at = canvas.view.place(dimension.at)
                number = counts.get(at, 0)
                counts[at] = number + 1
                spot, away = _draw_angle(canvas, dimension, at, number)
            elif isinstance(dimension, Aligned):
                spot, away = _draw_aligned(canvas, dimension)
            elif isinstance(dimension, LinearDimension) and not dimension.length:
                spot, away = canvas.view.place(dimension.start), (0.7, -0.7)
            else:
                continue
        wanted.append((spot, dimension, away))
    for spot, dimension, away in wanted:
        with canvas.about(dimension.about):
            canvas.label(spot, [(TextRun(dimension.text, dimension.role),)], away, dimension.role)
    for leader in scene.each(Leader):
        with canvas.about(leader.about):
            _draw_leader(canvas, leader)
    ways = _ways(canvas, scene)
    for mark in scene.each(Mark):
        if mark.label:
            at = canvas.view.place(mark.at)
            away = _away_from(ways.get((round(at[0]), round(at[1])), []))
            with canvas.about(mark.about):
                canvas.label(at, [mark.label, mark.short], away, Role.MUTED)


def _draw_angle(canvas: Canvas, angle: Angle, at: Spot, number: int) -> tuple[Spot, Spot]:
    """The arc from the reference line to the direction; where its label belongs, and to which side."""
    radius = _RADIUS + number * _STEP
    turn, base = fmod(angle.degrees, 360.0), -radians(angle.base)
    way = cos(base), sin(base)
    canvas.draw(line(along(at, way, 5.0), along(at, way, radius + 14.0), Role.MUTED, 0.8), FAINT_WEIGHT)
    sweep = -radians(turn)
    end = base + sweep
    canvas.grips.append(Grip(angle.about.word, along(at, (cos(end), sin(end)), radius), at))
    if abs(turn) < _SMALL:
        return _draw_straight(canvas, angle, at, (cos(end), sin(end)), number)
    canvas.draw(arc(at, radius, sweep, angle.role, base))
    sign = 1.0 if sweep > 0 else -1.0
    # The head is a chord of the arc, so that it does not stand off it.
    lean = end - sign * 4.0 / radius
    tip = along(at, (cos(end), sin(end)), radius)
    canvas.fill(head(tip, (-sin(lean) * sign, cos(lean) * sign), angle.role))
    middle = cos(base + sweep / 2), sin(base + sweep / 2)
    return along(at, middle, radius), middle


def _draw_straight(canvas: Canvas, angle: Angle, at: Spot, way: Spot, number: int) -> tuple[Spot, Spot]:
    """A direction that is hardly turned: an arrow beside the reference line, off the path that may lie on it."""
    a, b = along(at, way, 8.0), along(at, way, _RADIUS)
    side = _emptier(canvas, a, b, (way[1], -way[0]))
    aside = _OFF + number * _STEP
    tail, tip = along(a, side, aside), along(b, side, aside)
    canvas.draw(line(tail, tip, angle.role))
    canvas.fill(head(tip, way, angle.role))
    return ((tail[0] + tip[0]) / 2, (tail[1] + tip[1]) / 2), side


def _draw_aligned(canvas: Canvas, aligned: Aligned) -> tuple[Spot, Spot]:
    """A distance straight between two points; where its label belongs, and to which side."""
    a, b = canvas.view.place(aligned.start), canvas.view.place(aligned.end)
    way, role, is_short = direction(a, b), aligned.role, distance(a, b) < _SHORT
    back = -way[0], -way[1]
    side = (-way[1], way[0]) if way[0] < 0 or (way[0] == 0 and way[1] > 0) else (way[1], -way[0])
    if aligned.is_beside:
        side = _emptier(canvas, a, b, side)
        ends = [along(at, side, _BESIDE) for at in (a, b)]
        for at, end in zip((a, b), ends, strict=True):
            extension = line(along(at, side, 4.0), along(end, side, 4.0), Role.MUTED, 0.7, is_dashed=False)
            canvas.draw(extension, FAINT_WEIGHT)
        a, b = ends
    canvas.draw(line(a, b, role, 1.3))
    for tip, to in ((a, way if is_short else back), (b, back if is_short else way)):
        if is_short:
            canvas.draw(line(along(tip, to, -16.0), tip, role, 1.3, is_dashed=False))
        canvas.fill(head(tip, to, role))
    return ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), side


def _emptier(canvas: Canvas, a: Spot, b: Spot, side: Spot) -> Spot:
    """The side of a line on which less is drawn."""

    def cost(way: Spot) -> float:
        places = (along(along(a, minus(b, a), share), way, _BESIDE) for share in (0.1, 0.3, 0.5, 0.7, 0.9))
        return sum(canvas.cost(Box(x - 3.0, y - 3.0, x + 3.0, y + 3.0)) for x, y in places)

    other = -side[0], -side[1]
    return side if cost(side) <= cost(other) else other


def _draw_leader(canvas: Canvas, leader: Leader) -> None:
    """A word that points at a place, with an arrowhead there."""
    at = canvas.view.place(leader.at)
    told = TextRun(leader.text, leader.role)
    if leader.center is not None:
        center = canvas.view.place(leader.center)
        places = [canvas.view.place(each) for each in (leader.at, *leader.others)]
        found = canvas.point([(each, direction(center, each)) for each in places], told)
        canvas.grips.append(Grip(leader.about.word, found[1] if found else at))
        if found is not None:
            _tip(canvas, found[0], found[1], leader.role, direction(center, found[1]))
        return
    canvas.grips.append(Grip(leader.about.word, at))
    away = leader.away[0], -leader.away[1]
    box = canvas.label(at, [(told,)], away, leader.role, leads=True)
    if box is not None:
        _tip(canvas, box, at, leader.role)


def _tip(canvas: Canvas, box: Box, at: Spot, role: Role, ray: Spot | None = None) -> None:
    """The arrowhead of a leader from a label to a place; along a ray if it lies on one."""
    way = direction(((box.left + box.right) / 2, (box.top + box.bottom) / 2), at)
    if ray is not None:
        way = ray if way[0] * ray[0] + way[1] * ray[1] > 0 else (-ray[0], -ray[1])
    canvas.fill(head(at, way, role, 7.0, 2.3))


_DOTS: Mapping[MarkKind, tuple[float, bool]] = {
    MarkKind.START: (4.2, False),
    MarkKind.OTHER: (3.2, False),
    MarkKind.END: (4.0, True),
    MarkKind.ROUND: (4.6, True),
    MarkKind.SQUARE: (4.2, True),
    MarkKind.PLACE: (2.8, True),
    MarkKind.TIP: (2.8, True),
}
"""Pixels of the radius of a point's sign, and whether it is filled; the others are crosses."""


def _draw_point(canvas: Canvas, mark: Mark) -> None:
    """The sign of a point."""
    at = canvas.view.place(mark.at)
    if mark.kind is MarkKind.SQUARE:
        canvas.thick.append(Box(*at, *at).grow(_HALF).filled(mark.role))
        return
    if mark.kind in _DOTS:
        radius, is_filled = _DOTS[mark.kind]
        canvas.thick.append(Dot(at, radius, mark.role, is_filled, mark.about))
        return
    (x, y), size = at, _CROSS
    canvas.thick.append(Stroke((x - size, y), ((x + size, y),), Role.MUTED, THIN, about=mark.about))
    canvas.thick.append(Stroke((x, y - size), ((x, y + size),), Role.MUTED, THIN, about=mark.about))


def _draw_slide(canvas: Canvas, slide: Slide) -> None:
    """Arrows both ways along what is free; four ways where everything is."""
    at = canvas.view.place(slide.at)
    for way in [slide.direction] if slide.direction is not None else [(1.0, 0.0), (0.0, 1.0)]:
        for sign in (1.0, -1.0):
            step = way[0] * sign, -way[1] * sign
            tip = along(at, step, _SLIDE)
            canvas.draw(line(along(at, step, 8.0), tip, Role.FREE, 2.0, is_dashed=False))
            canvas.fill(head(tip, step, Role.FREE, 10.0, 4.5))


def _away_from(ways: list[Spot]) -> Spot:
    """The direction that is farthest from the lines that meet here."""
    if not ways:
        return 0.7, -0.7
    return max(
        ((cos(number * pi / 8), sin(number * pi / 8)) for number in range(16)),
        key=lambda way: (
            round(min(1.0 - (way[0] * each[0] + way[1] * each[1]) for each in ways), 6),
            -round(way[1], 6),
            round(way[0], 6),
        ),
    )


def _ways(canvas: Canvas, scene: Scene) -> dict[tuple[int, int], list[Spot]]:
    """By place on the page, the directions in which lines leave it."""
    found: dict[tuple[int, int], list[Spot]] = {}
    for at, step in _steps(canvas, scene):
        if hypot(*step) > 0:
            found.setdefault((round(at[0]), round(at[1])), []).append(unit(step))
    return found


def _steps(canvas: Canvas, scene: Scene) -> Iterator[tuple[Spot, Spot]]:
    """The ends of all lines and arcs, each with a step along what begins there."""
    segments = (segment for trail in scene.each(Trail) for segment in trail.segments)
    for item in (*segments, *scene.each(Thin)):
        a, b = canvas.view.place(item.start), canvas.view.place(item.end)
        if isinstance(item, ArcSegment):
            sign = item.turn.sign
            for at, other, way in ((a, item.start, sign), (b, item.end, -sign)):
                spoke = minus(other, item.center)
                yield at, minus((at[0] - spoke[1] * way, at[1] - spoke[0] * way), at)
        else:
            yield from ((a, minus(b, a)), (b, minus(a, b)))
