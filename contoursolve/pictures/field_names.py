"""The names of fields and of the lines that bound them: each in the field that it names, or in a remark."""

from collections.abc import Iterator, Sequence
from itertools import product
from math import cos, pi, sin

import numpy

from contoursolve.families import Outcomes, is_contour
from contoursolve.pictures.curves import Curve, is_free, near, spots_of
from contoursolve.pictures.fields import Mask, cell_at, cell_size, holds, role_of, words_of
from contoursolve.pictures.page import SIZE, Anchor, Box, Dot, Item, Spot, Text, TextRun, line, visible, width_of, wrap
from contoursolve.pictures.theme import Role
from contoursolve.pictures.value_axes import HIGH, LEFT, TOP, WIDE
from contoursolve.solving import along, direction, distance

_ASIDE = 4.0
"""Pixels between a line and its name."""

_MARGIN = 1.0
"""Pixels around a name."""

_ALONG = (0.5, 0.35, 0.65, 0.2, 0.8, 0.08, 0.92)
"""Shares of a line at which its name is tried."""

_HIGHER = 15.0
"""Pixels from one line of a name to the next."""

_LEAST = 40.0
"""Pixels. A shorter line goes without a name where another of that name has one."""


Named = tuple[list[Text], list[str]]
"""Names where they stand, and those for which there is no room."""

NamedFields = tuple[list[Text], list[int]]
"""The same of fields, by their outcomes."""


def name_all(
    shown: Outcomes, curves: Sequence[Curve], taken: Sequence[Box], *, has_values: bool = False
) -> tuple[list[Text], list[int], list[str]]:
    """The names of fields and of lines where there is room beside what is taken, then the fields and the lines
    for which there is none. Fields come first, or lines where more names have room then. Where there is a contour, the
    field needs no name if its values stand there."""
    off_lines = ~near(curves, *shown.shape)
    named = numpy.where(is_contour(shown), -1, shown) if has_values else shown
    fields = _name_fields(named, off_lines, taken)
    lines = _name_lines(curves, shown, [*taken, *_boxes(fields)])
    if lines[1]:
        first = _name_lines(curves, shown, taken)
        then = _name_fields(named, off_lines, [*taken, *_boxes(first)])
        if len(first[1]) + len(then[1]) < len(lines[1]) + len(fields[1]):
            fields, lines = then, first
    return [*fields[0], *lines[0]], fields[1], lines[1]


def _boxes(named: Named | NamedFields) -> list[Box]:
    """Boxes that the texts of a name cover, with a margin."""
    return [each.box.grow(_MARGIN) for each in named[0]]


def _name_fields(shown: Outcomes, off_lines: Mask, taken: Sequence[Box]) -> NamedFields:
    """The name of each field in cells of it that are off every line; of one in several parts, in each that has room."""
    items: list[Text] = []
    others: list[int] = []
    counts = {int(each): int((shown == each).sum()) for each in numpy.unique(shown) if each >= 0}
    for outcome in sorted(counts, key=lambda each: -counts[each]):
        words, mask = words_of(outcome), shown == outcome
        free = mask & off_lines
        for box in taken:
            (top, left), (bottom, right) = (cell_at(mask, at) for at in ((box.left, box.top), (box.right, box.bottom)))
            free[max(top, 0) : max(bottom + 1, 0), max(left, 0) : max(right + 1, 0)] = False
        found = _fitting(words, free)
        if not found:
            others.append(outcome)
        while found:
            items += found
            free &= ~_part(mask, cell_at(mask, found[0].at))
            found = _fitting(words, free)
    return items, others


def number_fields(shown: Outcomes, narrow: Sequence[int], taken: Sequence[Box]) -> tuple[list[Item], list[str]]:
    """Numbers for fields without room for their names, each in its field or beside it with a line to it, and their key:
    what each number stands for, and its share."""
    items, keys, boxes = list[Item](), list[str](), [*taken]
    plane = Box(LEFT, TOP, LEFT + WIDE, TOP + HIGH)
    for number, outcome in enumerate(narrow, 1):
        mask = shown == outcome
        at = _deepest(mask, 1, 1)
        texts = [
            Text((at[0] + far * cos(turn), at[1] + 4.0 + far * sin(turn)), (TextRun(str(number), Role.INK),), SIZE,
                 Anchor.MIDDLE)
            for far in _NUMBERED
            for turn in ([step * pi / 8 for step in range(16)] if far else [0.0])
        ]  # fmt: skip
        free = (each for each in texts if plane.holds(each.box) and not any(map(each.box.meets, boxes)))
        text = next((each for each in free if each is not texts[0] or holds(mask, each.box)), texts[0])
        middle = (text.box.left + text.box.right) / 2, (text.box.top + text.box.bottom) / 2
        if distance(middle, at) > _NUMBERED[1] / 2:
            items += [line(at, along(middle, direction(middle, at), 7.0), Role.INK), Dot(at, 2.0, Role.INK)]
        items.append(text)
        boxes.append(text.box.grow(_MARGIN))
        keys.append(f"{number}: {', '.join(words_of(outcome))} ({mask.mean():.1%})")
    return items, keys


_NUMBERED = (0.0, 16.0, 26.0, 40.0, 60.0)
"""Pixels from a field to its number."""


def _part(mask: Mask, cell: tuple[int, int]) -> Mask:
    """The part of a field that hangs together with a cell of it."""
    part, count = numpy.zeros_like(mask), 0
    part[cell] = True
    while (size := int(part.sum())) > count:
        count = size
        # Whole runs of a row, then of a column, so that a few rounds are enough.
        for grid, own in ((part, mask), (part.T, mask.T)):
            runs = numpy.cumsum(numpy.diff(own.astype(numpy.int8), axis=1, prepend=0) != 0, axis=1)
            runs += numpy.arange(len(own))[:, None] * (own.shape[1] + 1)
            numpy.logical_or(grid, own & numpy.isin(runs, runs[grid]), out=grid)
    return part


def _fitting(words: list[str], mask: Mask) -> list[Text]:
    """A name as texts that lie in their field: in lines, or turned in one line; nothing where neither does."""
    for is_turned in (False, True):
        middle = _deepest(mask, *((1, 4) if is_turned else (4, 1)))
        texts = _turned(middle, ", ".join(words)) if is_turned else _stacked(middle, words)
        if all(holds(mask, text.box.grow(_MARGIN)) for text in texts):
            return texts
    return []


def _stacked(middle: Spot, lines: Sequence[str]) -> list[Text]:
    """Lines of text around a place."""
    first = middle[1] + 4.0 - _HIGHER / 2 * (len(lines) - 1)
    return [
        Text((middle[0], first + _HIGHER * number), (TextRun(told, Role.INK),), SIZE, Anchor.MIDDLE)
        for number, told in enumerate(lines)
    ]


def _turned(middle: Spot, told: str) -> list[Text]:
    """A line of text around a place that reads from the right."""
    return [Text((middle[0] + 4.0, middle[1]), (TextRun(told, Role.INK),), SIZE, Anchor.MIDDLE, is_turned=True)]


def _deepest(mask: Mask, across: int, up: int) -> Spot:
    """The middle of the place that is farthest from all other fields, where being far counts in a ratio across and
    up, for a text is longer one way."""
    wide, high = cell_size(mask)
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
    if not len(rows):
        return LEFT, TOP
    return LEFT + (int(columns[pick]) + 0.5) * wide, TOP + (int(rows[pick]) + 0.5) * high


# Lines -------------------------------------------------------------------------------------------------------


def _name_lines(curves: Sequence[Curve], shown: Outcomes, taken: Sequence[Box]) -> Named:
    """The names of lines beside them, each in the field beyond its line."""
    spots = spots_of(curves)
    texts: list[Text] = []
    boxes, named = list(taken), set[str]()
    missing: list[str] = []
    for curve in curves:
        name = visible(curve.boundary.reason.text)
        if name in named and curve.length < _LEAST:
            continue
        found = next((each for each in _beyond(curve, name, shown) if is_free(each, boxes, spots)), None)
        if found is None:
            missing.append(name)
            continue
        named.add(name)
        texts += found
        boxes += [each.box for each in found]
    return texts, list(dict.fromkeys(missing))


def _beyond(curve: Curve, name: str, shown: Outcomes) -> Iterator[list[Text]]:
    """The name of a line in the field that is right beyond it, in one line, in two, or turned, at several places."""
    halves = wrap(name, 0.6 * width_of(name, SIZE), SIZE, 2)
    fields = {share: _field_beyond(curve, share, shown) for share in _ALONG}
    shapes = (([name], False), (halves, False), ([name], True))
    for (lines, is_turned), farther, share in product(shapes, (0.0, _HIGHER, 2 * _HIGHER), _ALONG):
        field = fields[share]
        if field is None:
            continue
        size = max(width_of(each, SIZE) for each in lines), _HIGHER * len(lines)
        wide, high = size[::-1] if is_turned else size
        place = int(share * (len(curve.spots) - 1))
        way = curve.ways[place]
        off = abs(way[0]) * wide / 2 + abs(way[1]) * high / 2 + _ASIDE + farther
        x, y = (float(each) for each in curve.spots[place] + off * way)
        texts = _turned((x, y), name) if is_turned else _stacked((x, y), lines)
        if all(holds(field, text.box) for text in texts):
            yield texts


def _field_beyond(curve: Curve, share: float, shown: Outcomes) -> Mask | None:
    """The field right beyond a place of a line; None where no cell without a contour is that near."""
    place = int(share * (len(curve.spots) - 1))
    step = max(_ASIDE, *cell_size(shown))
    x, y = curve.spots[place] + step * curve.ways[place]
    row, column = cell_at(shown, (float(x), float(y)))
    if not (0 <= row < shown.shape[0] and 0 <= column < shown.shape[1]):
        return None
    outcome = int(shown[row, column])
    return None if role_of(outcome) is Role.SOLVED_FIELD else shown == outcome
