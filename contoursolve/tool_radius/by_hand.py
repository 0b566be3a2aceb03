"""The radius for which the path of a tool was made by hand: the one with which the part has round numbers."""

from collections.abc import Sequence
from itertools import pairwise
from math import radians, tan

from msgspec.structs import replace

from contoursolve.geometry import Length
from contoursolve.solving import ArcSegment, Point, Segment, along, shifted
from contoursolve.tool_radius.joint import TANGENT, direction, turn_of
from contoursolve.tool_radius.offset import OffsetPath
from contoursolve.tool_radius.runs import CuttingRun
from contoursolve.tool_radius.tool import OutsideCorner
from contoursolve.tool_radius.tool_settings import ToolSettings

_ROUNDED = 0.002
"""mm. By so much words move an arc when they are rounded."""

_HALF_TURN = 180

_ENOUGH = 2
"""Round numbers that are no chance."""

_STEPS = {Length.MM: 0.05, Length.INCH: 0.005}
"""Numbers of a drawing are multiples of this (assumed)."""


def part_of(own: CuttingRun, radius: float, outside: OutsideCorner = OutsideCorner.INTERSECT) -> tuple[Segment, ...]:
    """The part that a tool of a radius (mm) makes where the programmed point itself runs along the moves; empty where
    it is not simple. An arc of its radius around an outside corner makes that corner."""
    first, second = own.tip
    found, stretch, corner = list[Segment](), list[Segment](), None
    for each in (*own.elements, None):
        way = shifted(each, (-radius * first, -radius * second)) if each is not None else None
        if way is not None and not is_around(way, radius, own):
            stretch.append(way)
            continue
        pieces = OffsetPath(stretch, radius, -own.side.sign, ToolSettings(outside=outside)).pieces if stretch else ()
        if pieces is None:
            return ()
        own_pieces = [each.segment for each in pieces]
        if own_pieces and corner is not None:
            own_pieces[0] = replace(own_pieces[0], start=corner)
        corner = way.center if isinstance(way, ArcSegment) else None
        if own_pieces and corner is not None:
            own_pieces[-1] = replace(own_pieces[-1], end=corner)
        found, stretch = [*found, *own_pieces], []
    return tuple(found)


def made_for(own: CuttingRun) -> tuple[float, int, int] | None:
    """The radius (mm) for which the moves were made by hand, and the first of these moves and the one behind the last:
    a line may lead there, and away. None where the moves are a contour themselves."""
    rows, last = list[tuple[int, tuple[float, int, int]]](), len(own.elements)
    for begin, end in ((0, last), (1, last), (0, last - 1), (1, last - 1)):
        ways = [*own.elements[:begin], *own.elements[end:]]
        if end - begin < _ENOUGH or any(isinstance(each, ArcSegment) for each in ways):
            continue
        piece = within(own, begin, end)
        radius = _radius_of(piece)
        if radius is not None and (part := part_of(piece, radius)):
            ends = [own.elements[0].start] * begin + [own.elements[-1].end] * (last - end)
            odd = _odd_ones(part, own) + sum(2 - _round_ones(at, own) for at in ends)
            rows.append((odd, (radius, begin, end)))
    return min(rows, key=lambda row: row[0], default=(0, None))[1]


def within(own: CuttingRun, begin: int, end: int) -> CuttingRun:
    """A run of some of its moves."""
    near = slice(begin, end)
    return replace(own, elements=own.elements[near], travels=own.travels[near], levels=own.levels[near])


def _radius_of(own: CuttingRun) -> float | None:
    """The radius (mm) for which the moves were made by hand: arcs of it lead around corners that have round numbers,
    and are no roundings of such corners."""
    first, second = own.tip
    counts, scale = dict[float, int](), float(own.unit.in_mm)
    for each in own.elements:
        if not isinstance(each, ArcSegment) or each.sweep >= _HALF_TURN:
            continue
        radius = round(each.radius / scale, 2 if own.unit is Length.MM else 4) * scale
        if is_around(each, radius, own):
            rolled = each.center[0] - radius * first, each.center[1] - radius * second
            rounded = along(each.start, direction(each, at_end=False), each.radius * tan(radians(each.sweep) / 2))
            counts[radius] = counts.get(radius, 0) + _round_ones(rolled, own) - _round_ones(rounded, own)
    best = max(counts, key=lambda radius: counts[radius], default=0.0)
    if counts.get(best, 0) >= _ENOUGH:
        return best
    part = part_of(own, best) if counts.get(best, 0) > 0 else ()
    # A contour of which all outside corners are rounded by just the tool would come out with none of them.
    if not part and counts.get(own.radius, -1) == 0 and _is_rolled(own):
        return own.radius
    # One arc tells little: then all of the part has rounder numbers than the moves.
    return best if part and _odd_ones(own.elements, own) - _odd_ones(part, own) >= _ENOUGH else None


def _is_rolled(own: CuttingRun) -> bool:
    """Whether moves go around all outside corners by arcs of the tool that no corner word makes."""
    sharp = any(own.side.sign * turn_of(one, two) < -TANGENT for one, two in pairwise(own.elements))
    small = any(
        isinstance(each, ArcSegment) and each.turn.sign != own.side.sign and each.radius < own.radius - _ROUNDED
        for each in own.elements
    )
    ways = zip(own.elements, own.travels, strict=True)
    return not sharp and not small and not any(is_around(each, own.radius, own) and way.element for each, way in ways)


def _odd_ones(segments: Sequence[Segment], own: CuttingRun) -> int:
    """The number of coordinates, of the ends of segments, that are not round."""
    places = [segments[0].start, *(each.end for each in segments)]
    return sum(2 - _round_ones(at, own) for at in places)


def is_around(segment: Segment, radius: float, own: CuttingRun) -> bool:
    """Whether it is an arc by which a tool of a radius rolls around an outside corner."""
    if not isinstance(segment, ArcSegment) or segment.turn.sign == own.side.sign:
        return False
    return abs(segment.radius - radius) <= _ROUNDED


def _round_ones(at: Point, own: CuttingRun) -> int:
    """The number of coordinates of a place that are round, as they are written."""
    step, scale = _STEPS[own.unit], float(own.unit.in_mm)
    numbers = (value * (1 + is_diameter) / scale for value, is_diameter in zip(at, own.plane.diameters, strict=True))
    return sum(abs(each / step - round(each / step)) * step * scale <= _ROUNDED for each in numbers)
