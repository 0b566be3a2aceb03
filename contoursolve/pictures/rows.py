"""Dimensions beside the drawing: distances in rows and columns, coordinates at its edges."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from contoursolve.model import FIRST
from contoursolve.pictures.arrows import head, line
from contoursolve.pictures.canvas import SIZE, Canvas
from contoursolve.pictures.metrics import width_of
from contoursolve.pictures.scene import Linear, Ordinate
from contoursolve.pictures.sheet import Anchor, Run, Spot, Text
from contoursolve.pictures.theme import Role
from contoursolve.pictures.view import Span, View

PITCH = 25.0
"""Pixels from one row to the next."""

FIRST_ROW = 33.0
"""Pixels from the drawing to the first row."""

_GAP, _BEYOND = 4.0, 4.0
"""Pixels that an extension line keeps from its point, and goes past the dimension line."""

_SHORT = 22.0
"""Pixels. In a shorter distance the arrowheads stand outside."""


@dataclass(frozen=True, slots=True)
class Side:
    """An edge of the drawing: the axis that runs along it, and whether it is the lower or left one (`sign` -1) or the
    upper or right one (+1), in mm."""

    axis: int
    sign: int


def is_nothing(dimension: Linear) -> bool:
    """Whether it is a distance of 0, which has no two ends."""
    return dimension.start[dimension.axis] == dimension.end[dimension.axis]


def side_of(dimension: Linear, span: Span) -> Side:
    """The edge that is nearer to the points of a distance."""
    across = 1 - dimension.axis
    mean = (dimension.start[across] + dimension.end[across]) / 2
    return Side(dimension.axis, 1 if mean > span.middle[across] else -1)


def stack(dimensions: Sequence[Linear], view: View) -> list[tuple[Linear, int]]:
    """Distances along one edge, each with its row: shorter ones nearer to the drawing, none over another."""
    rows: list[list[tuple[float, float]]] = []
    found = []
    for dimension in sorted(dimensions, key=lambda each: (_length(each), each.text)):
        low, high = _interval(dimension, view)
        row = next((n for n, taken in enumerate(rows) if all(high < a or b < low for a, b in taken)), len(rows))
        if row == len(rows):
            rows.append([])
        rows[row].append((low, high))
        found.append((dimension, row))
    return found


def _length(dimension: Linear) -> float:
    return abs(dimension.end[dimension.axis] - dimension.start[dimension.axis])


def _interval(dimension: Linear, view: View) -> tuple[float, float]:
    """What a distance takes of its row, pixels along the axis."""
    ends = sorted(at[dimension.axis] * view.scale for at in (dimension.start, dimension.end))
    middle, half = sum(ends) / 2, width_of(dimension.text, SIZE) / 2 + 10.0
    return min(ends[0] - 12.0, middle - half), max(ends[1] + 12.0, middle + half)


def draw_distances(canvas: Canvas, stacked: Iterable[tuple[Linear, int]], side: Side, edge: float) -> None:
    """Distances along one edge, which is at `edge` on the page; lines first, and then their texts."""
    texts: list[tuple[Linear, Spot, Spot]] = []
    for dimension, row in stacked:
        a, b = canvas.view.place(dimension.start), canvas.view.place(dimension.end)
        # Up on the page is less.
        outward = side.sign if side.axis != FIRST else -side.sign
        level = edge + outward * (FIRST_ROW + row * PITCH)
        c, d = ((a[0], level), (b[0], level)) if side.axis == FIRST else ((level, a[1]), (level, b[1]))
        for at, end in ((a, c), (b, d)):
            _extend(canvas, at, end)
        _measure(canvas, c, d, dimension.role)
        texts.append((dimension, c, d))
    for dimension, c, d in texts:
        _write(canvas, dimension, c, d)


def _extend(canvas: Canvas, at: Spot, end: Spot) -> None:
    """A thin line from a point to its dimension line and a little farther."""
    step = end[0] - at[0], end[1] - at[1]
    length = abs(step[0]) + abs(step[1])
    if length > _GAP:
        way = step[0] / length, step[1] / length
        begin = at[0] + way[0] * _GAP, at[1] + way[1] * _GAP
        stop = end[0] + way[0] * _BEYOND, end[1] + way[1] * _BEYOND
        canvas.draw(line(begin, stop, Role.MUTED, 0.7, is_dashed=False), 0.6)


def _measure(canvas: Canvas, c: Spot, d: Spot, role: Role) -> None:
    """A dimension line with its arrowheads."""
    step = d[0] - c[0], d[1] - c[1]
    length = abs(step[0]) + abs(step[1])
    way = (step[0] / length, step[1] / length) if length > 0 else (1.0, 0.0)
    if length >= _SHORT:
        canvas.draw(line(c, d, role))
        canvas.fill(head(c, (-way[0], -way[1]), role))
        canvas.fill(head(d, way, role))
        return
    before = c[0] - way[0] * 16.0, c[1] - way[1] * 16.0
    after = d[0] + way[0] * 16.0, d[1] + way[1] * 16.0
    canvas.draw(line(before, c, role))
    canvas.draw(line(d, after, role))
    canvas.draw(line(c, d, role))
    canvas.fill(head(c, way, role))
    canvas.fill(head(d, (-way[0], -way[1]), role))


def _write(canvas: Canvas, dimension: Linear, c: Spot, d: Spot) -> None:
    """The text over the middle of its line, or where there is room."""
    runs = (Run(dimension.text, dimension.role),)
    is_turned = dimension.axis != FIRST
    middle = (c[0] + d[0]) / 2, (c[1] + d[1]) / 2
    half = width_of(dimension.text, SIZE) / 2
    for shift in (0.0, half + 14.0, -half - 14.0, 2 * half + 20.0, -2 * half - 20.0):
        at = (middle[0] - 4.0, middle[1] - shift) if is_turned else (middle[0] + shift, middle[1] - 4.0)
        if canvas.write(Text(at, runs, SIZE, Anchor.MIDDLE, is_turned=is_turned)):
            return
    canvas.label(middle, [runs], (-1.0, 0.0) if is_turned else (0.0, -1.0), dimension.role)


def draw_coordinates(canvas: Canvas, ordinates: Sequence[Ordinate], axis: int, sign: int, edge: float) -> None:
    """Coordinates on an axis, written at the edge on which their lines end; moved apart where they are close."""
    along = 1 if axis != FIRST else 0
    entries = sorted(ordinates, key=lambda each: (canvas.view.place(each.at)[along], each.text))
    wanted = [canvas.view.place(each.at)[along] for each in entries]
    sizes = [SIZE + 5.0 if along else width_of(each.text, SIZE) + 10.0 for each in entries]
    places = _apart(wanted, sizes)
    for ordinate, at, place in zip(entries, wanted, places, strict=True):
        _coordinate(canvas, ordinate, along, sign if along else -sign, edge, at, place)


def _coordinate(
    canvas: Canvas, ordinate: Ordinate, along: int, outward: int, edge: float, at: float, place: float
) -> None:
    spot, runs = canvas.view.place(ordinate.at), (Run(ordinate.text, ordinate.role),)
    knee, end = edge - outward * 8.0, edge

    def pair(out: float, way: float) -> Spot:
        return (out, way) if along else (way, out)

    begin = pair(spot[1 - along] + outward * _GAP, at)
    if (knee - begin[1 - along]) * outward > 0:
        canvas.draw(line(begin, pair(knee, at), ordinate.role, 0.8), 0.6)
    canvas.draw(line(pair(knee, at), pair(end, place), ordinate.role, 0.8, is_dashed=False), 0.6)
    if along:
        anchor = Anchor.START if outward > 0 else Anchor.END
        text = Text((end + outward * 4.0, place + 4.2), runs, SIZE, anchor)
    else:
        text = Text((place, end + (13.0 if outward > 0 else -5.0)), runs, SIZE, Anchor.MIDDLE)
    if not canvas.write(text):
        canvas.label(pair(end, place), [runs], pair(float(outward), 0.0), ordinate.role)


def _apart(wanted: Sequence[float], sizes: Sequence[float]) -> list[float]:
    """Places near the wanted ones, in their order, each as far from the next as both are large."""
    places: list[float] = []
    groups: list[tuple[list[int], float]] = []
    for index in range(len(wanted)):
        groups.append(([index], wanted[index]))
        while len(groups) > 1 and _end(groups[-2], sizes) > _begin(groups[-1], sizes):
            (second, there), (first, here) = groups.pop(), groups.pop()
            middle = (here * len(first) + there * len(second)) / (len(first) + len(second))
            groups.append(([*first, *second], middle))
    for members, middle in groups:
        place = middle - sum(sizes[member] for member in members) / 2
        for member in members:
            places.append(place + sizes[member] / 2)
            place += sizes[member]
    return places


def _begin(group: tuple[list[int], float], sizes: Sequence[float]) -> float:
    return group[1] - sum(sizes[member] for member in group[0]) / 2


def _end(group: tuple[list[int], float], sizes: Sequence[float]) -> float:
    return group[1] + sum(sizes[member] for member in group[0]) / 2
