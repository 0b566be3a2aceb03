"""The definition of a corner as polynomial equations for where it begins, where it ends, and its centre."""

from collections.abc import Iterator
from typing import Any

from contoursolve.geometry import FIRST, SECOND, Arc, Corner, CornerShape, Figure, Line, Lookup, cross

Pair = tuple[Any, Any]


def corner_equations(
    corner: Corner, figure: Figure, at: Lookup, size: Any, begin: Pair, end: Pair, center: Pair
) -> Iterator[tuple[str, Any]]:
    """The equations of a corner: in words, and as an expression that is zero, polynomial in the places `begin`, `end`
    and `center`, in points and directions.

    A fillet has six of them for three places, any other shape four for two. `size` is that of the corner, mm.
    """
    vertex = at.coordinate(corner.at, FIRST), at.coordinate(corner.at, SECOND)
    places = {element.name: element for element in figure.path}
    edges = [_Edge(places[corner.before], vertex, at), _after(corner, figure, vertex, at)]
    names = corner.before, corner.after or corner.lands_on or "the line that it lands on"
    yield f"it begins on {names[0]}", edges[0].off(begin)
    yield f"it ends on {names[1]}", edges[1].off(end)
    if corner.shape is CornerShape.FILLET:
        for name, edge, point in zip(names, edges, (begin, end), strict=True):
            yield f"its radius reaches {name}", _square(point, center) - size**2
            yield f"it is tangent to {name}", edge.across(point, center)
    elif corner.shape.share:
        # Twice the square of the extent of a segment whose own length is given is that of the length.
        factor = round(1 / corner.shape.share**2)
        for axis in (FIRST, SECOND):
            yield "it runs at 45 degrees", factor * (end[axis] - begin[axis]) ** 2 - size**2
    elif corner.shape is CornerShape.CHAMFER_FACE:
        yield "its face has the length", _square(begin, end) - size**2
        yield "both ends are as far from the intersection", _square(begin, vertex) - _square(end, vertex)
    else:
        yield f"it begins so far before the end of {names[0]}", _square(begin, vertex) - size**2
        yield f"it ends so far after the begin of {names[1]}", _square(end, vertex) - size**2


def ends_somewhere(corner: Corner, figure: Figure) -> bool:
    """Whether there is something behind a corner on which it can end."""
    lines = {line.name for line in (*figure.path, *figure.lines)}
    return corner.after is not None or corner.lands_on in lines or corner.lands_parallel_to is not None


class _Edge:
    """An element that passes a virtual intersection: a line along a direction, or a circle."""

    def __init__(self, element: Line | Arc, vertex: Pair, at: Lookup, direction: Pair | None = None) -> None:
        self.vertex, self.center, self.radius = vertex, None, None
        if isinstance(element, Arc):
            self.center = at.coordinate(element.center, FIRST), at.coordinate(element.center, SECOND)
            self.radius = at.radius(element.radius)
        else:
            self.direction = direction or _direction(element, at)

    def off(self, point: Pair) -> Any:
        """Zero for a point of it."""
        if self.center is not None and self.radius is not None:
            return _square(point, self.center) - self.radius**2
        return cross(_step(self.vertex, point), self.direction)

    def across(self, point: Pair, center: Pair) -> Any:
        """Zero where the way from a point of it to a centre is perpendicular to it."""
        if self.center is not None:
            return cross(_step(self.center, point), _step(self.center, center))
        way = _step(point, center)
        return way[0] * self.direction[0] + way[1] * self.direction[1]


def _after(corner: Corner, figure: Figure, vertex: Pair, at: Lookup) -> _Edge:
    """The edge behind a corner: an element of the path, a line beside it, or one that is parallel to an axis."""
    if corner.after is not None:
        return _Edge(next(each for each in figure.path if each.name == corner.after), vertex, at)
    if corner.lands_on is not None:
        return _Edge(figure.line(corner.lands_on), vertex, at)
    parallel = (1, 0) if corner.lands_parallel_to == FIRST else (0, 1)
    return _Edge(Line("", corner.at, corner.at), vertex, at, parallel)


def _direction(line: Line, at: Lookup) -> Pair:
    """A vector along a line, of any length."""
    if line.heading is not None:
        return at.direction(line.heading)
    points = [
        (at.coordinate(name, FIRST), at.coordinate(name, SECOND)) for name in (line.tail, line.toward or line.head)
    ]
    return _step(*points)


def _step(one: Pair, other: Pair) -> Pair:
    return other[0] - one[0], other[1] - one[1]


def _square(one: Pair, other: Pair) -> Any:
    first, second = _step(one, other)
    return first**2 + second**2
