"""Fillets and chamfers at a virtual intersection, in closed form, with the residuals of their definitions.

The elements before and after are edges: each leaves the intersection along a line or along a circle. What is
sought on a circle follows from one quadratic equation whose root is the one that grows from 0 with the size. Where
the size is nearly the radius, small differences are taken first: rounding then moves a fillet, but makes none that
touches nothing.
"""

from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import CornerShape, cross, dot
from contoursolve.numeric import angle, is_zero, magnitude, sign, sqrt, where

Pair = tuple[Any, Any]


class Edge(Struct, frozen=True):
    """The passage of an element by the virtual intersection: its unit direction of travel there, and for an arc the
    vector from the centre to the intersection, the radius, and +1 if it turns to the left, -1 to the right."""

    direction: Pair
    spoke: Pair | None = None
    radius: Any = None
    turn: int = 0

    @property
    def left(self) -> Pair:
        """The unit vector to the left."""
        return -self.direction[1], self.direction[0]


class CornerPath(Struct, frozen=True):
    """The places where a corner leaves the element before (`setback_in` along it from the intersection) and joins the
    next.

    `center` is None for a chamfer. `turn` is the sine of the turn, positive to the left; `cosine` its
    cosine. `residuals` are those of the corner's definition, mm.
    """

    setback_in: Any
    setback_out: Any
    begin: Pair
    end: Pair
    center: Pair | None
    turn: Any
    cosine: Any
    residuals: tuple[Any, ...]


def build_corner(shape: CornerShape, at: Pair, before: Edge, after: Edge, size: Any, quadrant: Pair) -> CornerPath:
    """The corner of `size` at the point `at` between two edges.

    `quadrant` gives the signs of the 45 degree segment of a chamfer and is used by no other shape.
    """
    turn, cosine = cross(before.direction, after.direction), dot(before.direction, after.direction)
    center: Pair | None = None
    if shape is CornerShape.FILLET:
        from_center, begin, end = _fillet(before, after, size, sign(turn))
        center = _plus(at, from_center)
    elif shape.share:
        begin, end = _chamfer_45(before, after, _times(shape.share * size, quadrant), turn)
    else:
        leg = _leg(before, after, size) if shape is CornerShape.CHAMFER_FACE else size
        begin, end = _along(before, leg, -1), _along(after, leg, 1)
    residuals = (_off(before, begin), _off(after, end), *_misfit(shape, before, after, size, begin, end, center, at))
    return CornerPath(
        setback_in=_setback(before, begin, -1),
        setback_out=_setback(after, end, 1),
        begin=_plus(at, begin),
        end=_plus(at, end),
        center=center,
        turn=turn,
        cosine=cosine,
        residuals=residuals,
    )


def drop_straight(built: CornerPath, at: Pair, guard: float) -> CornerPath:
    """A corner, of no length at the point `at` where the path turns by no more than the sine `guard`."""
    # By signs, which the proof can tell of exact numbers and balls.
    is_straight = is_zero(sign(guard - magnitude(built.turn)) + sign(built.cosine) - 2)

    def sharp(pair: Pair) -> Pair:
        return where(is_straight, at[0], pair[0]), where(is_straight, at[1], pair[1])

    return replace(
        built,
        setback_in=where(is_straight, 0, built.setback_in),
        setback_out=where(is_straight, 0, built.setback_out),
        begin=sharp(built.begin),
        end=sharp(built.end),
        center=None if built.center is None else sharp(built.center),
        residuals=tuple(where(is_straight, 0, residual) for residual in built.residuals),
    )


def unit(vector: Pair) -> Pair:
    """The direction of a vector; NaN for the zero vector."""
    length = _norm(vector)
    return vector[0] / length, vector[1] / length


def _fillet(before: Edge, after: Edge, size: Any, side: Any) -> tuple[Pair, Pair, Pair]:
    """The centre and both contacts, from the intersection: the centre is at `size` to the same side of both."""
    if before.spoke is None and after.spoke is None:
        # |u - v| / |u + v| is tan(turn / 2) without cancellation at small and large turns.
        u, v = before.direction, after.direction
        setback = size * _norm(_minus(u, v)) / _norm(_plus(u, v))
        begin = _times(-setback, u)
        return _plus(begin, _times(size * side, before.left)), begin, _times(setback, v)
    if before.spoke is not None and after.spoke is not None:
        center = _beside_circles(before, after, size, side)
    else:
        line, arc = (before, after) if before.spoke is None else (after, before)
        center = _beside_line_and_circle(line, arc, size, side)
    return center, _contact(before, center, size, side), _contact(after, center, size, side)


def _beside_line_and_circle(line: Edge, arc: Edge, size: Any, side: Any) -> Pair:
    """`size` to the side of the line, and of the circle: |spoke + side size n + x u| = R - turn side size."""
    aside = _times(side * size, line.left)
    spoke = _plus(_spoke(arc), aside)
    half = dot(spoke, line.direction)
    x = sign(half) * _cathetus(_reach(arc, size, side), cross(line.direction, spoke)) - half
    return _plus(aside, _times(x, line.direction))


def _beside_circles(before: Edge, after: Edge, size: Any, side: Any) -> Pair:
    """`size` to the side of both circles; the difference of the two equations is a line across the centres."""
    first, second = _spoke(before), _spoke(after)
    between = _minus(first, second)
    along, distance = unit(between), _norm(between)
    across = -along[1], along[0]
    reaches = [_reach(edge, size, side) for edge in (before, after)]
    shift = ((reaches[0] - reaches[1]) * (reaches[0] + reaches[1]) / distance + distance) / 2
    height = sign(dot(first, across)) * _cathetus(reaches[0], shift)
    return _minus(_plus(_times(shift, along), _times(height, across)), first)


def _reach(arc: Edge, size: Any, side: Any) -> Any:
    """The distance of the centre of a fillet from that of a circle; negative where the fillet is the larger one, around
    it."""
    return arc.radius - arc.turn * side * size


def _cathetus(hypotenuse: Any, other: Any) -> Any:
    """The side of a right triangle, without cancellation where the other two are nearly the same."""
    return sqrt((hypotenuse - other) * (hypotenuse + other))


def _contact(edge: Edge, center: Pair, size: Any, side: Any) -> Pair:
    """The point of an edge that is touched by the circle about `center` that lies to its side."""
    if edge.spoke is None:
        return _times(dot(center, edge.direction), edge.direction)
    from_center = _plus(edge.spoke, center)
    # On the circle itself, however near both centres are.
    share = sign(_reach(edge, size, side)) * edge.radius / _norm(from_center)
    return _minus(_times(share, from_center), edge.spoke)


def _chamfer_45(before: Edge, after: Edge, extent: Pair, turn: Any) -> tuple[Pair, Pair]:
    """Both ends of the segment, from the intersection: end - begin = extent."""
    if before.spoke is None and after.spoke is None:
        # s * before + t * after = extent, by Cramer's rule.
        setback_in = cross(extent, after.direction) / turn
        setback_out = cross(before.direction, extent) / turn
        return _times(-setback_in, before.direction), _times(setback_out, after.direction)
    if before.spoke is None:
        begin = _times(_chord(before.direction, after, extent), before.direction)
        return begin, _plus(begin, extent)
    if after.spoke is None:
        end = _times(_chord(after.direction, before, _times(-1, extent)), after.direction)
        return _minus(end, extent), end
    raise ValueError("no control makes a 45 degree chamfer between two arcs")


def _chord(direction: Pair, arc: Edge, extent: Pair) -> Any:
    """The place along a line where `extent` begins so that it ends on the circle: |spoke + x u + extent| = R."""
    spoke = _spoke(arc)
    half = dot(direction, _plus(spoke, extent))
    constant = dot(extent, _plus(_times(2, spoke), extent))
    return _rooted(half, constant, sign(dot(direction, spoke)))


def _rooted(half: Any, constant: Any, way: Any) -> Any:
    """The root of x**2 + 2 half x + constant that is continuous with 0, where `way` is the sign of half there."""
    return -half + way * sqrt(half * half - constant)


def _along(edge: Edge, distance: Any, way: int) -> Pair:
    """The point of an edge at a distance from the intersection, after it (`way` +1) or before it (-1)."""
    if edge.spoke is None:
        return _times(way * distance, edge.direction)
    half = distance / (2 * edge.radius)
    # Turned by twice asin(half), minus the spoke itself.
    inward = _times(-2 * half * half, edge.spoke)
    return _plus(inward, _times(way * distance * sqrt(1 - half * half), edge.direction))


_STEPS = 8
"""Steps of Newton's method from the chamfer of two lines to that of circles: each doubles the digits that are right."""


def _leg(before: Edge, after: Edge, face: Any) -> Any:
    """The setback of both ends of a chamfer whose face has a length. Between two lines the face
    spans their directions, each as long as that."""
    leg = face / _norm(_plus(before.direction, after.direction))
    if before.spoke is None and after.spoke is None:
        return leg
    for _ in range(_STEPS):
        across = _minus(_along(after, leg, 1), _along(before, leg, -1))
        grown = _minus(_growth(after, leg, 1), _growth(before, leg, -1))
        leg = leg - (dot(across, across) - face * face) / (2 * dot(across, grown))
    return leg


def _growth(edge: Edge, distance: Any, way: int) -> Pair:
    """By how much the point of an edge at a distance from the intersection moves with that distance."""
    if edge.spoke is None:
        return _times(way, edge.direction)
    half = distance / (2 * edge.radius)
    rest = sqrt(1 - half * half)
    inward = _times(-2 * half / edge.radius, edge.spoke)
    return _plus(inward, _times(way * (rest - half * half / rest), edge.direction))


def _setback(edge: Edge, point: Pair, way: int) -> Any:
    """The way along an edge to a point of it after (+1) or before (-1) the intersection, mm."""
    if edge.spoke is None:
        return way * dot(point, edge.direction)
    spoke = _plus(edge.spoke, point)
    return way * edge.turn * edge.radius * angle(cross(edge.spoke, spoke), dot(edge.spoke, spoke))


def _off(edge: Edge, point: Pair) -> Any:
    """The distance of a point from an edge's line or circle, mm."""
    if edge.spoke is None:
        return cross(point, edge.direction)
    return _norm(_plus(edge.spoke, point)) - edge.radius


def _misfit(
    shape: CornerShape, before: Edge, after: Edge, size: Any, begin: Pair, end: Pair, center: Pair | None, at: Pair
) -> tuple[Any, ...]:
    """The residuals of the definition of a shape, mm, besides that its ends lie on the edges."""
    if shape is CornerShape.CHAMFER_SETBACK:
        return _norm(begin) - size, _norm(end) - size
    if shape is CornerShape.CHAMFER_FACE:
        return _norm(_minus(end, begin)) - size, _norm(begin) - _norm(end)
    if center is None:
        extent = _minus(end, begin)
        return magnitude(extent[0]) - shape.share * size, magnitude(extent[1]) - shape.share * size
    spokes = [_minus(point, _minus(center, at)) for point in (begin, end)]
    travels = [_travel(edge, point) for edge, point in ((before, begin), (after, end))]
    return (
        *(_norm(spoke) - size for spoke in spokes),
        *(dot(spoke, travel) for spoke, travel in zip(spokes, travels, strict=True)),
    )


def _travel(edge: Edge, point: Pair) -> Pair:
    """The direction of an edge at a point of it."""
    if edge.spoke is None:
        return edge.direction
    spoke = _plus(edge.spoke, point)
    return -edge.turn * spoke[1] / edge.radius, edge.turn * spoke[0] / edge.radius


def _spoke(edge: Edge) -> Pair:
    if edge.spoke is None:
        raise TypeError("a line has no centre")
    return edge.spoke


def _norm(a: Pair) -> Any:
    return sqrt(a[0] * a[0] + a[1] * a[1])


def _plus(a: Pair, b: Pair) -> Pair:
    return a[0] + b[0], a[1] + b[1]


def _minus(a: Pair, b: Pair) -> Pair:
    return a[0] - b[0], a[1] - b[1]


def _times(factor: Any, a: Pair) -> Pair:
    return factor * a[0], factor * a[1]
