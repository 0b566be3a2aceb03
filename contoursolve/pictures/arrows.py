"""Arrowheads, dimension lines and crosses as strokes and shapes, in pixels."""

from math import cos, hypot, sin

from contoursolve.pictures.sheet import Shape, Spot, Stroke, Sweep
from contoursolve.pictures.theme import DASHES, Role

THIN, THICK = 1.0, 2.6
"""Pixels of thin lines, and of the path."""

_LENGTH, _HALF = 8.0, 2.5


def head(tip: Spot, way: Spot, role: Role, length: float = _LENGTH, half: float = _HALF) -> Shape:
    """An arrowhead whose tip is here, pointing along a unit direction."""
    back = tip[0] - way[0] * length, tip[1] - way[1] * length
    return Shape(
        (tip, (back[0] - way[1] * half, back[1] + way[0] * half), (back[0] + way[1] * half, back[1] - way[0] * half)),
        role,
    )


def line(a: Spot, b: Spot, role: Role, width: float = THIN, *, is_dashed: bool = True) -> Stroke:
    """A thin line in the dash of its role."""
    return Stroke(a, (b,), role, width, DASHES.get(role, ()) if is_dashed else ())


def cross(at: Spot, size: float, role: Role) -> list[Stroke]:
    """Two short lines through a place."""
    x, y = at
    return [
        Stroke((x - size, y), ((x + size, y),), role, THIN),
        Stroke((x, y - size), ((x, y + size),), role, THIN),
    ]


def arc(center: Spot, radius: float, start: float, sweep: float, role: Role, *, is_dashed: bool = True) -> Stroke:
    """An arc from an angle (radians, clockwise on the page)."""
    begin = center[0] + radius * cos(start), center[1] + radius * sin(start)
    end = center[0] + radius * cos(start + sweep), center[1] + radius * sin(start + sweep)
    return Stroke(begin, (Sweep(center, radius, end, sweep),), role, THIN, DASHES.get(role, ()) if is_dashed else ())


def direction(a: Spot, b: Spot) -> Spot:
    """The unit direction from one place to another; to the right if they are one."""
    length = hypot(b[0] - a[0], b[1] - a[1])
    return ((b[0] - a[0]) / length, (b[1] - a[1]) / length) if length > 0 else (1.0, 0.0)
