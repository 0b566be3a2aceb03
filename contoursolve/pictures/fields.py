"""The outcomes over two words as fields of a plane: what each is painted as, and the boundaries between them."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import floor

import numpy
from numpy.typing import NDArray

from contoursolve.diagnosis import state_of, status_text
from contoursolve.families import Outcomes, is_contour
from contoursolve.pictures.curves import Curve, near
from contoursolve.pictures.levels import Levels
from contoursolve.pictures.page import Box, Item, Spot, Stroke
from contoursolve.pictures.theme import Role
from contoursolve.pictures.value_axes import HIGH, LEFT, TOP, WIDE
from contoursolve.solving import REASONS, StatusCode

Mask = NDArray[numpy.bool_]

_FIELDS = {
    StatusCode.SOLVED: Role.SOLVED_FIELD,
    StatusCode.OVERDETERMINED: Role.SOLVED_FIELD,
    StatusCode.NO_SOLUTION: Role.REFUSED_FIELD,
}
"""Colour role of an outcome without a reason against it; with a reason there is no contour."""

_OVER = 0.6
"""Pixels by which a field reaches under the next, so that the paper does not shine through between them."""

_MOST_RUNS = 9_000


def words_of(outcome: int) -> list[str]:
    """An outcome in words: its state, and the reason if there is one."""
    code, reason = StatusCode(outcome // len(REASONS)), REASONS[outcome % len(REASONS)]
    if reason is not None:
        return [state_of(code.status, has_path=False).value, reason.value.replace("-", " ")]
    return [status_text(code.status), *(["one word too many"] if code is StatusCode.OVERDETERMINED else [])]


def role_of(outcome: int) -> Role:
    """The colour role of an outcome."""
    code, reason = divmod(outcome, len(REASONS))
    role = _FIELDS.get(StatusCode(code), Role.OTHER_FIELD)
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


def boundaries(shown: Outcomes, curves: Sequence[Curve]) -> list[Stroke]:
    """Lines between fields, each as long as it is straight; where a curve says the same, only that."""
    wide, high = cell_size(shown)
    close = near(curves, *shown.shape)
    has_contour = is_contour(shown)
    role, width = (Role.MUTED, 1.0) if curves else (Role.INK, 1.4)
    items: list[Stroke] = []
    for row, first, last in _edges(shown, close, has_contour):
        y = TOP + (row + 1) * high
        items.append(Stroke((LEFT + first * wide, y), ((LEFT + last * wide, y),), role, width))
    for column, first, last in _edges(shown.T, close.T, has_contour.T):
        x = LEFT + (column + 1) * wide
        items.append(Stroke((x, TOP + first * high), ((x, TOP + last * high),), role, width))
    return items[:_MOST_RUNS]


def _edges(shown: Outcomes, close: Mask, has_contour: Mask) -> Iterator[tuple[int, int, int]]:
    """Between each row of cells and the next one, from where to where they differ and no curve is close that parts
    cells with a contour from others."""
    is_drawn = (close[1:] | close[:-1]) & (has_contour[1:] != has_contour[:-1])
    for row, edges in enumerate((shown[1:] != shown[:-1]) & ~is_drawn):
        ends = numpy.flatnonzero(numpy.diff(edges.astype(numpy.int8), prepend=0, append=0)).tolist()
        yield from ((row, first, last) for first, last in zip(ends[::2], ends[1::2], strict=True))
