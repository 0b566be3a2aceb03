"""The map of a family over two words: a field for each outcome with its name in it, and the boundaries between them."""

from itertools import pairwise
from math import floor, log10

import numpy
from numpy.typing import NDArray

from contoursolve.families import REASONS, Code, Family
from contoursolve.pictures.arrows import line
from contoursolve.pictures.metrics import shorten, wrap
from contoursolve.pictures.sheet import Anchor, Box, Item, Run, Shape, Sheet, Spot, Stroke, Text
from contoursolve.pictures.theme import Role
from contoursolve.pictures.wording import visible

_WIDTH, _WIDE, _HIGH = 760.0, 610.0, 400.0
"""Pixels of the page, and of the map itself."""

_LEFT, _TOP = 92.0, 56.0
COLUMNS, ROWS = 305, 200
"""Cells of a map; of more values, the one nearest to the middle of each cell is shown."""

_SIZE, _TITLE = 12.0, 14.0
_FIELDS = {Code.SOLVED: Role.SOLVED_FIELD, Code.OVERDETERMINED: Role.SOLVED_FIELD, Code.NO_SOLUTION: Role.REFUSED_FIELD}
_TICKS = 6
_MOST_RUNS = 9_000

Outcomes = NDArray[numpy.int64]
Mask = NDArray[numpy.bool_]


def map_title(family: Family, words: tuple[str, ...]) -> str:
    """What a map shows."""
    told = ", ".join(f"{number:,} {status.value}" for status, number in family.summary().items())
    return f"{' and '.join(words)}: {told}"


def lay_out_map(family: Family, words: tuple[str, ...], title: str) -> Sheet:
    """The page of a map. Raises ValueError where the words are not two words of a grid of two."""
    own = [word for word, values in family.ranges.values.items() if values.size > 1 or word in words]
    if family.ranges.is_paired or len(own) != 2 or sorted(words) != sorted(own):  # noqa: PLR2004 - a plane
        raise ValueError(f"a map needs a grid of two words; this family has {' and '.join(own)}, not {words!r}")
    across, up = (family.ranges.values[word] for word in words)
    outcomes = family["status"].astype(numpy.int64) * len(REASONS) + family["reason"]
    # The other words have one value each.
    outcomes = outcomes.reshape([family.ranges.values[word].size for word in own])
    outcomes = outcomes if own == list(words) else outcomes.T
    columns, rows = _picks(across, COLUMNS), _picks(up, ROWS)
    shown = outcomes[numpy.ix_(columns, rows)].T[::-1]
    items: list[Item] = [
        Text(
            (18.0, 26.0),
            (Run(shorten(visible(title), _WIDTH - 36.0, _TITLE, is_bold=True), Role.INK),),
            _TITLE,
            is_bold=True,
        )
    ]
    items += _fields(shown)
    items += _boundaries(shown)
    items += _axes(words, across[columns], up[rows])
    names, others = _names(shown)
    items += names
    height = _TOP + _HIGH + 56.0
    for told in wrap("too narrow to be named: " + "; ".join(others), _WIDTH - 36.0, _SIZE, 3) if others else ():
        items.append(Text((18.0, height + 4.0), (Run(told, Role.MUTED),), _SIZE))
        height += 17.0
    return Sheet(_WIDTH, height, Box(0.0, 0.0, _WIDTH, height), tuple(items))


def _picks(values: NDArray[numpy.float64], most: int) -> NDArray[numpy.int64]:
    """Which values are shown, in rising order."""
    order = numpy.argsort(values, kind="stable")
    if order.size <= most:
        return order
    return order[((numpy.arange(most) + 0.5) * order.size / most).astype(numpy.int64)]


def _cell(shown: Outcomes) -> tuple[float, float]:
    return _WIDE / shown.shape[1], _HIGH / shown.shape[0]


def _fields(shown: Outcomes) -> list[Item]:
    """A rectangle for each run of equal outcomes in a row, of several rows where these are alike."""
    wide, high = _cell(shown)
    items: list[Item] = []
    begin = 0
    for row in range(1, shown.shape[0] + 1):
        if row < shown.shape[0] and (shown[row] == shown[begin]).all():
            continue
        cuts = [0, *(numpy.flatnonzero(numpy.diff(shown[begin])) + 1).tolist(), shown.shape[1]]
        top, bottom = _TOP + begin * high, _TOP + row * high
        for first, last in pairwise(cuts):
            role = _FIELDS.get(Code(int(shown[begin, first]) // len(REASONS)), Role.OTHER_FIELD)
            left, right = _LEFT + first * wide, _LEFT + last * wide
            items.append(Shape(((left, top), (right, top), (right, bottom), (left, bottom)), role))
        begin = row
    return items


def _boundaries(shown: Outcomes) -> list[Item]:
    """Lines between fields, each as long as it is straight."""
    wide, high = _cell(shown)
    items: list[Item] = []
    for row, column in zip(*_starts(shown[1:] != shown[:-1]), strict=True):
        length = _run((shown[1:] != shown[:-1])[row, column:])
        y = _TOP + (row + 1) * high
        items.append(Stroke((_LEFT + column * wide, y), ((_LEFT + (column + length) * wide, y),), Role.INK, 1.4))
    for column, row in zip(*_starts((shown[:, 1:] != shown[:, :-1]).T), strict=True):
        length = _run((shown[:, 1:] != shown[:, :-1])[row:, column])
        x = _LEFT + (column + 1) * wide
        items.append(Stroke((x, _TOP + row * high), ((x, _TOP + (row + length) * high),), Role.INK, 1.4))
    return items[:_MOST_RUNS]


def _starts(mask: NDArray[numpy.bool_]) -> tuple[list[int], list[int]]:
    """Where runs of true values begin, row by row."""
    before = numpy.zeros_like(mask)
    before[:, 1:] = mask[:, :-1]
    rows, columns = numpy.nonzero(mask & ~before)
    return rows.tolist(), columns.tolist()


def _run(values: NDArray[numpy.bool_]) -> int:
    """How many values are true before the first that is not."""
    stops = numpy.flatnonzero(~values)
    return int(stops[0]) if stops.size else int(values.size)


def _names(shown: Outcomes) -> tuple[list[Item], list[str]]:
    """The name of each field in it, where there is room, and the names of the others."""
    items: list[Item] = []
    others: list[str] = []
    counts = {int(each): int((shown == each).sum()) for each in numpy.unique(shown)}
    for outcome in sorted(counts, key=lambda each: -counts[each]):
        code, reason = Code(outcome // len(REASONS)), REASONS[outcome % len(REASONS)]
        words = [code.status.value.replace("-", " "), *([reason.value.replace("-", " ")] if reason is not None else [])]
        found = _fitting(words, shown == outcome, shown.shape)
        items += found
        if not found:
            others.append(f"{', '.join(words)} ({counts[outcome] / shown.size:.1%})")
    return items, others


def _fitting(words: list[str], mask: Mask, shape: tuple[int, ...]) -> list[Item]:
    """A name as texts that lie in their field: in lines, or turned in one line; nothing where neither does."""
    wide, high = _WIDE / shape[1], _HIGH / shape[0]
    for is_turned in (False, True):
        x, y = _deepest(mask, (1, 4) if is_turned else (4, 1), wide, high)
        if is_turned:
            runs = (Run(", ".join(words), Role.INK),)
            texts = [Text((x + 4.0, y), runs, _SIZE, Anchor.MIDDLE, is_turned=True)]
        else:
            first = y + 4.0 - 7.5 * (len(words) - 1)
            texts = [
                Text((x, first + 15.0 * number), (Run(word, Role.INK),), _SIZE, Anchor.MIDDLE)
                for number, word in enumerate(words)
            ]
        if all(_holds(mask, text.box, wide, high) for text in texts):
            return list(texts)
    return []


def _holds(mask: Mask, box: Box, wide: float, high: float) -> bool:
    """Whether a box lies in a field."""
    left, right = floor((box.left - _LEFT) / wide), floor((box.right - _LEFT) / wide)
    top, bottom = floor((box.top - _TOP) / high), floor((box.bottom - _TOP) / high)
    is_inside = left >= 0 and top >= 0 and right < mask.shape[1] and bottom < mask.shape[0]
    return is_inside and bool(mask[top : bottom + 1, left : right + 1].all())


def _deepest(mask: Mask, shape: tuple[int, int], wide: float, high: float) -> Spot:
    """The middle of the place that is farthest from all other fields, where being far counts in a ratio across and
    up, for a text is longer one way."""
    across, up = shape
    inner, last = mask, mask
    while inner.any():
        last = inner
        wider = numpy.pad(inner, ((up, up), (across, across)))
        inner = (
            inner
            & wider[: -2 * up, across:-across]
            & wider[2 * up :, across:-across]
            & wider[up:-up, : -2 * across]
            & wider[up:-up, 2 * across :]
        )
    rows, columns = numpy.nonzero(last)
    pick = len(rows) // 2
    return _LEFT + (int(columns[pick]) + 0.5) * wide, _TOP + (int(rows[pick]) + 0.5) * high


def _axes(words: tuple[str, ...], across: NDArray[numpy.float64], up: NDArray[numpy.float64]) -> list[Item]:
    """The frame with values of both words."""
    right, bottom = _LEFT + _WIDE, _TOP + _HIGH
    corners = ((right, _TOP), (right, bottom), (_LEFT, bottom), (_LEFT, _TOP))
    items: list[Item] = [Stroke((_LEFT, _TOP), corners, Role.INK, 1.2)]
    for value, share in _ticks(across):
        x = _LEFT + share * _WIDE
        items.append(line((x, bottom), (x, bottom + 5.0), Role.INK))
        items.append(Text((x, bottom + 19.0), (Run(f"{value:g}", Role.INK),), _SIZE, Anchor.MIDDLE))
    for value, share in _ticks(up):
        y = bottom - share * _HIGH
        items.append(line((_LEFT - 5.0, y), (_LEFT, y), Role.INK))
        items.append(Text((_LEFT - 9.0, y + 4.0), (Run(f"{value:g}", Role.INK),), _SIZE, Anchor.END))
    items.append(
        Text((_LEFT + _WIDE / 2, bottom + 40.0), (Run(words[0], Role.INK),), _TITLE, Anchor.MIDDLE, is_bold=True)
    )
    items.append(Text((24.0, _TOP + _HIGH / 2), (Run(words[1], Role.INK),), _TITLE, Anchor.MIDDLE, is_bold=True))
    return items


def _ticks(values: NDArray[numpy.float64]) -> list[tuple[float, float]]:
    """Round values in a range of cells, each with its place from 0 to 1."""
    if values.size == 1:
        return [(float(values[0]), 0.5)]
    positions = (numpy.arange(values.size) + 0.5) / values.size
    low, high = float(values[0]), float(values[-1])
    if not high > low:
        return [(low, 0.5)]
    rough = (high - low) / _TICKS
    power = 10.0 ** floor(log10(rough))
    step = next(each * power for each in (1.0, 2.0, 5.0, 10.0) if each * power >= rough)
    first = -floor(-low / step)
    ticks = [(first + number) * step for number in range(floor((high - first * step) / step + 1e-9) + 1)]
    return [(round(tick, 12), float(numpy.interp(tick, values, positions))) for tick in ticks]
