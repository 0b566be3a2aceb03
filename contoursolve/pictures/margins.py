"""Size and surroundings of a drawing on its page: rows of distances, and coordinates at the edges."""

from collections.abc import Mapping, Sequence

from msgspec import Struct

from contoursolve.geometry import FIRST, SECOND
from contoursolve.pictures.labels import Canvas, Grip, LabelSpot
from contoursolve.pictures.page import SIZE, WIDTH, About, Anchor, Box, Spot, Text, TextRun, head, line, width_of
from contoursolve.pictures.scene import LinearDimension, Ordinate, Rectangle, Scene, Viewport, bounds_of
from contoursolve.pictures.theme import Role
from contoursolve.solving import along, direction, distance

_TALLEST, _LOWEST = 350.0, 110.0
"""Pixels of the drawing itself, without what stands in its margins."""

_MARGIN_X, _MARGIN_Y = 84.0, 40.0
"""Pixels around the drawing for labels of points."""

_FIRST_ROW, _PITCH = 33.0, 25.0
"""Pixels from the drawing to the first row, and from one row to the next."""

_COORDINATES = 18.0
"""Pixels that coordinates take beyond the rows."""

_NEAR = 22.0
"""Pixels from a drawing to coordinates with no rows between."""

_UNDER_AXIS = 16.0
"""Pixels under the axis about which the work turns, where all else stands above it."""

_GAP, _BEYOND = 4.0, 4.0
"""Pixels that an extension line keeps from its point, and goes past the dimension line."""

_SHORT = 22.0
"""Pixels. In a shorter distance the arrowheads stand outside."""


class DrawingEdge(Struct, frozen=True):
    """An edge of the drawing: the axis that runs along it, and whether it is the lower or left one (`sign` -1) or the
    upper or right one (+1), in mm."""

    axis: int
    sign: int

    @property
    def outward(self) -> int:
        """The way out on the page, where up is less."""
        return self.sign if self.axis != FIRST else -self.sign

    def spot(self, level: float, place: float) -> Spot:
        """The spot on the page at a distance `level` outwards and at a `place` along the edge."""
        return (place, level) if self.axis == FIRST else (level, place)


_SIDES = (DrawingEdge(FIRST, -1), DrawingEdge(FIRST, 1), DrawingEdge(SECOND, -1), DrawingEdge(SECOND, 1))

Row = tuple[LinearDimension, int]
"""A distance and the number of its row, from the drawing outwards."""


class Placement(Struct, frozen=True):
    """Layout of a drawing on its page, kept so that the next drawing of a moved contour looks alike. It has the visible
    part of the plane, the edges, the rows of distances, and the labels by what they show."""

    view: Viewport
    frame: Box
    outer: Mapping[DrawingEdge, float]
    rows: Mapping[About, tuple[DrawingEdge, int]]
    edges: Mapping[int, DrawingEdge]
    """At which edge the coordinates on an axis are written."""
    labels: Mapping[tuple[About, int], LabelSpot]
    """By what they show, and the number of the label of those that show the same."""
    grips: tuple[Grip, ...]
    foot: float
    height: float


class Arrangement(Struct, frozen=True):
    """Layout of the margins: the drawing, its rows of distances, and its coordinates with their edges.

    `outer` is where each edge of the drawing is on the page.
    """

    view: Viewport
    frame: Box
    rows: Mapping[DrawingEdge, Sequence[Row]]
    coordinates: Mapping[DrawingEdge, Sequence[Ordinate]]
    outer: Mapping[DrawingEdge, float]


def arrange(scene: Scene, top: float, held: Placement | None = None) -> Arrangement:
    """The margins of a drawing that begins at `top` on its page, or that stands as another one did."""
    if held is not None:
        return _arranged_as(scene, held)
    own = bounds_of(scene)
    span = _with_turning_axis(scene, own)
    linear = [each for each in scene.each(LinearDimension) if each.length]
    by_side = {side: [each for each in linear if _side_of(each, own) == side] for side in _SIDES}
    coordinates = _edges(scene.each(Ordinate), by_side, own)
    before, after = (_wide(by_side[side], coordinates[side]) for side in _SIDES if side.axis == SECOND)
    room = WIDTH - before - after
    sizes = zip((room, _TALLEST), span.size, strict=True)
    scale = min((most / size for most, size in sizes if size > 0), default=1.0)
    rows = {side: _stack(each, scale) for side, each in by_side.items()}
    under, over = (_high(rows[side], coordinates[side]) for side in _SIDES if side.axis == FIRST)
    # Above the axis there may be room for the rows below the path.
    is_above = (own.low[SECOND] - span.low[SECOND]) * scale >= under
    low = own.low[SECOND] if is_above else span.low[SECOND]
    tall = max(span.size[SECOND] * scale, _LOWEST) if scene.parts else 0.0
    view = Viewport(span.middle, scale, (before + room / 2, top + over + tall / 2))
    left, bottom = view.place((span.low[FIRST], low))
    right, upper = view.place(span.high)
    frame = Box(4.0, top, WIDTH - 4.0, top + over + tall + (_UNDER_AXIS if is_above else under))
    return Arrangement(view, frame, rows, coordinates, dict(zip(_SIDES, (bottom, upper, left, right), strict=True)))


def _arranged_as(scene: Scene, held: Placement) -> Arrangement:
    """The margins of a drawing that stands as another one did; a distance that is new is in the next row."""
    rows: dict[DrawingEdge, list[Row]] = {side: [] for side in _SIDES}
    own = bounds_of(scene)
    for each in (each for each in scene.each(LinearDimension) if each.length):
        side, row = held.rows.get(each.about, (_side_of(each, own), None))
        rows[side].append((each, _count(rows[side]) if row is None else row))
    coordinates: dict[DrawingEdge, list[Ordinate]] = {side: [] for side in _SIDES}
    for ordinate in scene.each(Ordinate):
        coordinates[held.edges.get(ordinate.axis, DrawingEdge(ordinate.axis, 1))].append(ordinate)
    return Arrangement(held.view, held.frame, rows, coordinates, held.outer)


def placement_of(margins: Arrangement, canvas: Canvas, foot: float, height: float) -> Placement:
    """The layout of a drawing, for the next one."""
    rows = {each.about: (side, row) for side, several in margins.rows.items() for each, row in several}
    edges = {side.axis: side for side, several in margins.coordinates.items() if several}
    grips = tuple(each for each in canvas.grips if each.word)
    return Placement(margins.view, margins.frame, margins.outer, rows, edges, canvas.labels, grips, foot, height)


def _with_turning_axis(scene: Scene, span: Rectangle) -> Rectangle:
    """The rectangle with the axis about which the work turns, where that is near."""
    is_near = 0 < span.low[SECOND] <= max(*span.size, 1e-9) * 0.3
    return Rectangle((span.low[FIRST], 0.0), span.high) if scene.has_turning_axis and is_near else span


def _side_of(dimension: LinearDimension, span: Rectangle) -> DrawingEdge:
    """The edge that is nearer to the points of a distance."""
    across = 1 - dimension.axis
    mean = (dimension.start[across] + dimension.end[across]) / 2
    return DrawingEdge(dimension.axis, 1 if mean > span.middle[across] else -1)


def _edges(
    ordinates: Sequence[Ordinate], by_side: Mapping[DrawingEdge, Sequence[LinearDimension]], span: Rectangle
) -> dict[DrawingEdge, list[Ordinate]]:
    """Coordinates by the edge at which they are written: where there are fewer distances, else where the points are."""
    found: dict[DrawingEdge, list[Ordinate]] = {side: [] for side in _SIDES}
    for axis in (FIRST, SECOND):
        own = [each for each in ordinates if each.axis == axis and not each.side]
        for each in (each for each in ordinates if each.axis == axis and each.side):
            found[DrawingEdge(axis, each.side)].append(each)
        less, more = (len(by_side[DrawingEdge(axis, sign)]) for sign in (-1, 1))
        mean = sum(each.at[1 - axis] for each in own) / len(own) if own else 0.0
        is_upper = mean > span.middle[1 - axis] if less == more else less > more
        found[DrawingEdge(axis, 1 if is_upper else -1)] += own
    return found


def _wide(distances: Sequence[LinearDimension], coordinates: Sequence[Ordinate]) -> float:
    """Pixels to the left or right of a drawing."""
    columns = _PITCH * len(distances)
    texts = [width_of(each.text, SIZE) for each in coordinates]
    beyond = max(texts, default=0.0) + 10.0 + _edge(len(distances))
    return max(_MARGIN_X + (columns + 16.0 if columns else 0.0), beyond)


def _edge(rows: int) -> float:
    """Pixels from a drawing to the coordinates at its edge."""
    return _FIRST_ROW + _PITCH * rows if rows else _NEAR


def _high(rows: Sequence[Row], coordinates: Sequence[Ordinate]) -> float:
    """Pixels above or below a drawing."""
    high = max(_MARGIN_Y, _FIRST_ROW + _PITCH * _count(rows) + 4.0)
    return high + (_COORDINATES if coordinates else 0.0)


def _count(rows: Sequence[Row]) -> int:
    return max((row for _, row in rows), default=-1) + 1


def _stack(dimensions: Sequence[LinearDimension], scale: float) -> list[Row]:
    """Distances along one edge, each with its row: shorter ones nearer to the drawing, none over another."""
    rows: list[list[tuple[float, float]]] = []
    found = []
    for dimension in sorted(dimensions, key=lambda each: (each.length, each.text)):
        ends = sorted(at[dimension.axis] * scale for at in (dimension.start, dimension.end))
        middle, half = sum(ends) / 2, width_of(dimension.text, SIZE) / 2 + 10.0
        low, high = min(ends[0] - 12.0, middle - half), max(ends[1] + 12.0, middle + half)
        row = next((n for n, taken in enumerate(rows) if all(high < a or b < low for a, b in taken)), len(rows))
        if row == len(rows):
            rows.append([])
        rows[row].append((low, high))
        found.append((dimension, row))
    return found


# Distances ---------------------------------------------------------------------------------------------------


def draw_margins(canvas: Canvas, margins: Arrangement) -> None:
    """Distances and coordinates along all edges."""
    for side in _SIDES:
        _draw_distances(canvas, margins.rows[side], side, margins.outer[side])
    for side in _SIDES:
        level = margins.outer[side] + side.outward * _edge(_count(margins.rows[side]))
        _draw_coordinates(canvas, margins.coordinates[side], side, level)


def _draw_distances(canvas: Canvas, rows: Sequence[Row], side: DrawingEdge, edge: float) -> None:
    """Distances along one edge, which is at `edge` on the page; lines first, and then their texts."""
    texts: list[tuple[LinearDimension, Spot, Spot]] = []
    for dimension, row in rows:
        a, b = canvas.view.place(dimension.start), canvas.view.place(dimension.end)
        level = edge + side.outward * (_FIRST_ROW + row * _PITCH)
        c, d = side.spot(level, a[side.axis]), side.spot(level, b[side.axis])
        with canvas.about(dimension.about):
            for at, end in ((a, c), (b, d)):
                if distance(at, end) > _GAP:
                    way = direction(at, end)
                    extension = line(along(at, way, _GAP), along(end, way, _BEYOND), Role.MUTED, 0.7, is_dashed=False)
                    canvas.draw(extension, 0.6)
            _measure(canvas, c, d, dimension.role)
        texts.append((dimension, c, d))
    for dimension, c, d in texts:
        with canvas.about(dimension.about):
            _write(canvas, dimension, ((c[0] + d[0]) / 2, (c[1] + d[1]) / 2))


def _measure(canvas: Canvas, c: Spot, d: Spot, role: Role) -> None:
    """A dimension line with its arrowheads."""
    way = direction(c, d)
    back = -way[0], -way[1]
    is_short = distance(c, d) < _SHORT
    if is_short:
        canvas.draw(line(along(c, way, -16.0), c, role))
        canvas.draw(line(d, along(d, way, 16.0), role))
    canvas.draw(line(c, d, role))
    canvas.fill(head(c, way if is_short else back, role))
    canvas.fill(head(d, back if is_short else way, role))


def _write(canvas: Canvas, dimension: LinearDimension, middle: Spot) -> None:
    """The text over the middle of its line, or where there is room."""
    runs = (TextRun(dimension.text, dimension.role),)
    is_turned = dimension.axis != FIRST
    half = width_of(dimension.text, SIZE) / 2
    for shift in (0.0, half + 14.0, -half - 14.0, 2 * half + 20.0, -2 * half - 20.0):
        at = (middle[0] - 4.0, middle[1] - shift) if is_turned else (middle[0] + shift, middle[1] - 4.0)
        if canvas.write(Text(at, runs, SIZE, Anchor.MIDDLE, is_turned=is_turned)):
            return
    canvas.label(middle, [runs], (-1.0, 0.0) if is_turned else (0.0, -1.0), dimension.role)


# Coordinates -------------------------------------------------------------------------------------------------


def _draw_coordinates(canvas: Canvas, ordinates: Sequence[Ordinate], side: DrawingEdge, edge: float) -> None:
    """Coordinates on an axis, written at the edge on which their lines end; moved apart where they are close."""
    entries = sorted(ordinates, key=lambda each: (canvas.view.place(each.at)[side.axis], each.text))
    wanted = [canvas.view.place(each.at)[side.axis] for each in entries]
    sizes = [width_of(each.text, SIZE) + 10.0 if side.axis == FIRST else SIZE + 5.0 for each in entries]
    places = _apart(wanted, sizes)
    for ordinate, at, place in zip(entries, wanted, places, strict=True):
        with canvas.about(ordinate.about):
            _coordinate(canvas, ordinate, side, edge, at, place)


def _coordinate(canvas: Canvas, ordinate: Ordinate, side: DrawingEdge, edge: float, at: float, place: float) -> None:
    """A coordinate, its line from its point at `at` along the edge, and its text at `place`."""
    role, outward = ordinate.role, side.outward
    begin, knee = canvas.view.place(ordinate.at)[1 - side.axis] + outward * _GAP, edge - outward * 8.0
    if (knee - begin) * outward > 0:
        canvas.draw(line(side.spot(begin, at), side.spot(knee, at), role, 0.8), 0.6)
    canvas.draw(line(side.spot(knee, at), side.spot(edge, place), role, 0.8, is_dashed=False), 0.6)
    runs = (TextRun(ordinate.text, role),)
    if side.axis == FIRST:
        text = Text((place, edge + (13.0 if outward > 0 else -5.0)), runs, SIZE, Anchor.MIDDLE)
    else:
        anchor = Anchor.START if outward > 0 else Anchor.END
        text = Text((edge + outward * 4.0, place + 4.2), runs, SIZE, anchor)
    if not canvas.write(text):
        canvas.label(side.spot(edge, place), [runs], side.spot(float(outward), 0.0), role)


def _apart(wanted: Sequence[float], sizes: Sequence[float]) -> list[float]:
    """Places near the wanted ones, in their order, each as far from the next as both are large."""
    groups: list[tuple[list[float], float]] = []
    for size, at in zip(sizes, wanted, strict=True):
        groups.append(([size], at))
        while len(groups) > 1 and groups[-2][1] + sum(groups[-2][0]) / 2 > groups[-1][1] - sum(groups[-1][0]) / 2:
            (second, there), (first, here) = groups.pop(), groups.pop()
            middle = (here * len(first) + there * len(second)) / (len(first) + len(second))
            groups.append(([*first, *second], middle))
    places: list[float] = []
    for members, middle in groups:
        place = middle - sum(members) / 2
        for size in members:
            places.append(place + size / 2)
            place += size
    return places
