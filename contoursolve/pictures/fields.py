"""The outcomes over two words as fields of a plane: what each is painted as, and the boundaries between them."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from math import floor

import numpy
from numpy.typing import NDArray

from contoursolve.diagnosis import state_of, status_text
from contoursolve.families import Outcomes, is_contour
from contoursolve.pictures.curves import Curve, near
from contoursolve.pictures.levels import Levels
from contoursolve.pictures.page import Box, Item, Shape, Spot, Stroke
from contoursolve.pictures.theme import Role
from contoursolve.pictures.value_axes import HIGH, LEFT, TOP, WIDE
from contoursolve.solving import REASONS, STATUSES, Status

Mask = NDArray[numpy.bool_]

_FIELDS = {
    Status.SOLVED: Role.SOLVED_FIELD,
    Status.OVERDETERMINED: Role.SOLVED_FIELD,
    Status.NO_SOLUTION: Role.REFUSED_FIELD,
}
"""Colour role of an outcome without a reason against it; with a reason there is no contour."""

_OVER = 0.6
"""Pixels by which a field reaches under the next, so that the paper does not shine through between them."""

_MOST_RUNS = 9_000


def words_of(outcome: int) -> list[str]:
    """An outcome in words: its state, and the reason if there is one."""
    status, reason = STATUSES[outcome // len(REASONS)], REASONS[outcome % len(REASONS)]
    if reason is not None:
        return [state_of(status, has_path=False).value, reason.value.replace("-", " ")]
    return [status_text(status), *(["one word too many"] if status is Status.OVERDETERMINED else [])]


def role_of(outcome: int) -> Role:
    """The colour role of an outcome."""
    code, reason = divmod(outcome, len(REASONS))
    role = _FIELDS.get(STATUSES[code], Role.OTHER_FIELD)
    return Role.REFUSED_FIELD if reason and role is Role.SOLVED_FIELD else role


def cell_size(shown: Outcomes | Mask) -> tuple[float, float]:
    """Pixels of a cell across and up."""
    return WIDE / shown.shape[1], HIGH / shown.shape[0]


def cell_at(shown: Outcomes | Mask, spot: Spot) -> tuple[int, int]:
    """The row and the column of the cell at a place in the plane; beyond the last ones outside of it."""
    wide, high = cell_size(shown)
    return floor((spot[1] - TOP) / high), floor((spot[0] - LEFT) / wide)


def holds(mask: Mask, box: Box) -> bool:
    """Whether a box lies in a field."""
    (top, left), (bottom, right) = cell_at(mask, (box.left, box.top)), cell_at(mask, (box.right, box.bottom))
    is_inside = left >= 0 and top >= 0 and right < mask.shape[1] and bottom < mask.shape[0]
    return is_inside and bool(mask[top : bottom + 1, left : right + 1].all())


def paint(shown: Outcomes, levels: Levels | None = None, bands: Outcomes | None = None) -> list[Item]:
    """A rectangle for each run of outcomes of one colour in a row, of several rows where these are alike; where there
    is a contour, the colours are those of bands of a result if there are any (-1 for none)."""
    roles = list(Role)
    colors = numpy.zeros_like(shown)
    for outcome in numpy.unique(shown):
        colors[shown == outcome] = roles.index(role_of(int(outcome)))
    if levels is not None and bands is not None:
        for band in numpy.unique(bands[bands >= 0]):
            colors[bands == band] = roles.index(levels.role(int(band)))
    wide, high = cell_size(shown)
    items: list[Item] = []
    begin = 0
    for row in range(1, shown.shape[0] + 1):
        if row < shown.shape[0] and (colors[row] == colors[begin]).all():
            continue
        cuts = [0, *(numpy.flatnonzero(numpy.diff(colors[begin])) + 1).tolist(), shown.shape[1]]
        top, bottom = TOP + begin * high, min(TOP + row * high + _OVER, TOP + HIGH)
        for first, last in pairwise(cuts):
            left, right = LEFT + first * wide, min(LEFT + last * wide + _OVER, LEFT + WIDE)
            items.append(Box(left, top, right, bottom).filled(roles[colors[begin, first]]))
        begin = row
    return items


def smoothed(shown: Outcomes, curves: Sequence[Curve], *, has_values: bool) -> list[Item]:
    """Bands along both sides of each curve in the colours of the fields there, which cover the steps of the cells;
    where the contour's values are shown, beyond it alone."""
    reach, items = _REACH * max(*cell_size(shown)), list[Item]()
    for curve in curves:
        middle = len(curve.spots) // 2
        for sign in (1.0,) if has_values else (-1.0, 1.0):
            cell = cell_at(shown, _at(curve.spots[middle] + sign * reach * curve.ways[middle]))
            if not (0 <= cell[0] < shown.shape[0] and 0 <= cell[1] < shown.shape[1]):
                continue
            role = role_of(int(shown[cell]))
            if (role is Role.SOLVED_FIELD) is (sign > 0):
                continue
            aside = curve.spots + sign * reach * curve.ways
            edge = numpy.concatenate([curve.spots[::_EVERY], curve.spots[-1:], aside[-1:], aside[::-1][::_EVERY]])
            edge = numpy.clip(edge, (LEFT, TOP), (LEFT + WIDE, TOP + HIGH))
            items.append(Shape(tuple(map(_at, edge)), role))
    return items


_REACH = 0.8
"""1. How far beside a curve, in cells, the steps of cells are covered."""

_EVERY = 6
"""Pixels from one corner of such a band to the next."""


def _at(place: NDArray[numpy.float64]) -> Spot:
    return float(place[0]), float(place[1])


def boundaries(shown: Outcomes, curves: Sequence[Curve]) -> list[Stroke]:
    """Lines between fields, through the middles of the steps of cells; where a curve says the same, only that."""
    wide, high = cell_size(shown)
    close = near(curves, *shown.shape)
    has_contour = is_contour(shown)
    role, width = (Role.MUTED, 1.0) if curves else (Role.INK, 1.4)
    rows = ((at + 1, first, at + 1, last) for at, first, last in _edges(shown, close, has_contour))
    columns = ((first, at + 1, last, at + 1) for at, first, last in _edges(shown.T, close.T, has_contour.T))
    items: list[Stroke] = []
    for places in _paths([*rows, *columns]):
        first, *others = [(LEFT + column * wide, TOP + row * high) for row, column in places]
        items.append(Stroke(first, tuple(others), role, width))
    return items[:_MOST_RUNS]


_Run = tuple[int, int, int, int]
_Node = tuple[int, int]
_LONG = 2
"""Cells. Two longer runs meet in a corner; shorter ones are steps of a line."""


def _paths(runs: Sequence[_Run]) -> Iterator[list[tuple[float, float]]]:
    """Straight runs between corners of cells, by rows and columns, as lines through the middles of their steps."""
    at: dict[_Node, list[_Run]] = {}
    for run in runs:
        for node in (run[:2], run[2:]):
            at.setdefault(node, []).append(run)
    left = dict.fromkeys(runs)
    begins = [node for node, own in at.items() if len(own) != 2]  # noqa: PLR2004 - where a line ends, or several meet
    for node in [*begins, *at]:
        for run in at[node]:
            if run in left:
                yield _smooth(_path(node, run, at, left))


def _path(here: _Node, run: _Run, at: Mapping[_Node, Sequence[_Run]], left: dict[_Run, None]) -> list[_Node]:
    """The corners along a line from one of its ends, until it ends, branches, or is closed."""
    nodes = [here]
    while True:
        del left[run]
        here = run[2:] if run[:2] == here else run[:2]
        nodes.append(here)
        following = [each for each in at[here] if each in left]
        if len(at[here]) != 2 or not following:  # noqa: PLR2004 - as above
            return nodes
        run = following[0]


def _smooth(nodes: Sequence[_Node]) -> list[tuple[float, float]]:
    """The line through the middles of the runs between corners, and through corners of long ones."""
    places: list[tuple[float, float]] = []
    is_closed = nodes[0] == nodes[-1]
    lengths = [abs(b[0] - a[0]) + abs(b[1] - a[1]) for a, b in pairwise(nodes)]
    for number, (a, b) in enumerate(pairwise(nodes)):
        places.append(((a[0] + b[0]) / 2, (a[1] + b[1]) / 2))
        if number + 1 < len(lengths) and min(lengths[number : number + 2]) > _LONG:
            places.append(b)
    return [*places, places[0]] if is_closed else [nodes[0], *places, nodes[-1]]


def _edges(shown: Outcomes, close: Mask, has_contour: Mask) -> Iterator[tuple[int, int, int]]:
    """Between each row of cells and the next one, from where to where they differ and no curve is close that parts
    cells with a contour from others."""
    is_drawn = (close[1:] | close[:-1]) & (has_contour[1:] != has_contour[:-1])
    for row, edges in enumerate((shown[1:] != shown[:-1]) & ~is_drawn):
        ends = numpy.flatnonzero(numpy.diff(edges.astype(numpy.int8), prepend=0, append=0)).tolist()
        yield from ((row, first, last) for first, last in zip(ends[::2], ends[1::2], strict=True))
