"""What stands in the drawing itself: angles, radii, gaps, points with their names, and what can still slide."""

from math import cos, fmod, hypot, pi, radians, sin

from contoursolve.pictures.arrows import arc, cross, direction, head, line
from contoursolve.pictures.canvas import FAINT_WEIGHT, Canvas
from contoursolve.pictures.scene import Aligned, Angle, Kind, Leader, Mark, Slide
from contoursolve.pictures.sheet import Box, Dot, Run, Spot
from contoursolve.pictures.theme import Role

_RADIUS, _STEP = 34.0, 13.0
"""Pixels. Radius of the arc of an angle, and how much more each further one at the same place has."""

_SMALL = 4.0
"""Degrees. A smaller angle has no room for an arc."""

_SLIDE = 34.0
_BESIDE = 20.0
"""Pixels from a line to its dimension line."""

_SHORT = 22.0


def draw_angle(canvas: Canvas, angle: Angle, number: int) -> tuple[Spot, Spot]:
    """The arc from the reference line to the direction; where its label belongs, and to which side."""
    at = canvas.view.place(angle.at)
    radius = _RADIUS + number * _STEP
    turn = fmod(angle.degrees, 360.0)
    reference = at[0] + radius + 14.0, at[1]
    canvas.draw(line((at[0] + 5.0, at[1]), reference, Role.MUTED, 0.8), FAINT_WEIGHT)
    if abs(turn) < _SMALL:
        return (at[0] + radius, at[1]), (0.4, -0.9)
    sweep = -radians(turn)
    canvas.draw(arc(at, radius, 0.0, sweep, angle.role))
    tip = at[0] + radius * cos(sweep), at[1] + radius * sin(sweep)
    sign = 1.0 if sweep > 0 else -1.0
    # The head is a chord of the arc, so that it does not stand off it.
    lean = sweep - sign * 4.0 / radius
    canvas.fill(head(tip, (-sin(lean) * sign, cos(lean) * sign), angle.role))
    middle = sweep / 2
    return (at[0] + radius * cos(middle), at[1] + radius * sin(middle)), (cos(middle), sin(middle))


def draw_aligned(canvas: Canvas, aligned: Aligned) -> tuple[Spot, Spot]:
    """A distance straight between two points; where its label belongs, and to which side."""
    a, b = canvas.view.place(aligned.start), canvas.view.place(aligned.end)
    way = direction(a, b)
    length = hypot(b[0] - a[0], b[1] - a[1])
    side = (-way[1], way[0]) if way[0] < 0 or (way[0] == 0 and way[1] > 0) else (way[1], -way[0])
    if aligned.is_beside:
        beside = _emptier(canvas, a, b, side)
        side = beside
        ends = [(at[0] + beside[0] * _BESIDE, at[1] + beside[1] * _BESIDE) for at in (a, b)]
        for at, end in zip((a, b), ends, strict=True):
            begin = at[0] + beside[0] * 4.0, at[1] + beside[1] * 4.0
            stop = end[0] + beside[0] * 4.0, end[1] + beside[1] * 4.0
            canvas.draw(line(begin, stop, Role.MUTED, 0.7, is_dashed=False), FAINT_WEIGHT)
        a, b = ends
    canvas.draw(line(a, b, aligned.role, 1.3))
    if length >= _SHORT:
        canvas.fill(head(a, (-way[0], -way[1]), aligned.role))
        canvas.fill(head(b, way, aligned.role))
    else:
        for tip, sign in ((a, 1.0), (b, -1.0)):
            tail = tip[0] - sign * way[0] * 16.0, tip[1] - sign * way[1] * 16.0
            canvas.draw(line(tail, tip, aligned.role, 1.3, is_dashed=False))
            canvas.fill(head(tip, (way[0] * sign, way[1] * sign), aligned.role))
    return ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), side


def _emptier(canvas: Canvas, a: Spot, b: Spot, side: Spot) -> Spot:
    """The side of a line on which less is drawn."""

    def cost(way: Spot) -> float:
        shares = (0.1, 0.3, 0.5, 0.7, 0.9)
        places = (
            (a[0] + (b[0] - a[0]) * share + way[0] * _BESIDE, a[1] + (b[1] - a[1]) * share + way[1] * _BESIDE)
            for share in shares
        )
        return sum(canvas.grid.cost(Box(x - 3.0, y - 3.0, x + 3.0, y + 3.0)) for x, y in places)

    other = -side[0], -side[1]
    return side if cost(side) <= cost(other) else other


def draw_leader(canvas: Canvas, leader: Leader) -> None:
    """A word that points at a place, with an arrowhead there."""
    at = canvas.view.place(leader.at)
    away = leader.away[0], -leader.away[1]
    box = canvas.label(at, [(Run(leader.text, leader.role),)], away, leader.role, leads=True)
    if box is not None:
        middle = (box.left + box.right) / 2, (box.top + box.bottom) / 2
        canvas.fill(head(at, direction(middle, at), leader.role, 7.0, 2.3))


def draw_point(canvas: Canvas, mark: Mark) -> None:
    """The sign of a point."""
    at, role = canvas.view.place(mark.at), mark.role
    if mark.kind is Kind.START:
        canvas.thick.append(Dot(at, 4.2, role, is_filled=False))
    elif mark.kind is Kind.OTHER:
        canvas.thick.append(Dot(at, 3.2, role, is_filled=False))
    elif mark.kind is Kind.END:
        canvas.thick.append(Dot(at, 4.0, role))
    elif mark.kind is Kind.PLACE:
        canvas.thick.append(Dot(at, 2.8, role))
    else:
        for stroke in cross(at, 5.0, Role.MUTED):
            canvas.thick.append(stroke)


def draw_slide(canvas: Canvas, slide: Slide) -> None:
    """Arrows both ways along what is free; four ways where everything is."""
    x, y = canvas.view.place(slide.at)
    ways = [slide.direction] if slide.direction is not None else [(1.0, 0.0), (0.0, 1.0)]
    for way in ways:
        for sign in (1.0, -1.0):
            step = way[0] * sign, -way[1] * sign
            begin, tip = (
                (x + step[0] * 8.0, y + step[1] * 8.0),
                (x + step[0] * _SLIDE, y + step[1] * _SLIDE),
            )
            canvas.draw(line(begin, tip, Role.FREE, 2.0, is_dashed=False))
            canvas.fill(head(tip, step, Role.FREE, 10.0, 4.5))


def away_from(directions: list[Spot]) -> Spot:
    """The direction that is farthest from the lines that meet here."""
    if not directions:
        return 0.7, -0.7
    return max(
        ((cos(number * pi / 8), sin(number * pi / 8)) for number in range(16)),
        key=lambda way: (
            round(min(1.0 - (way[0] * each[0] + way[1] * each[1]) for each in directions), 6),
            -round(way[1], 6),
            round(way[0], 6),
        ),
    )
