"""Values of words on a page: the plane of two words, and the bar of one with the ranges in which a contour exists."""

from collections.abc import Iterator, Sequence
from math import floor, log10

import numpy
from msgspec import Struct

from contoursolve.diagnosis import limit_text, written
from contoursolve.families import End, FeasibleRange, Way
from contoursolve.numeric import Array
from contoursolve.pictures.page import (
    PAD,
    SIZE,
    TITLE,
    WIDTH,
    Anchor,
    Box,
    Dot,
    Item,
    Stroke,
    Text,
    TextRun,
    heading,
    line,
    visible,
    width_of,
    wrap,
)
from contoursolve.pictures.sheet import Sheet
from contoursolve.pictures.theme import Role

WIDE, HIGH = 610.0, 400.0
"""Pixels of a plane."""

LEFT, TOP, BELOW = 92.0, 56.0, 56.0
"""Pixels beside the plane: before it, above it with the title, below it with the values."""

MAP_BOX = LEFT, TOP, WIDE, HIGH
"""The plane on a page: its corner, and its size."""

_TICKS = 6
_NARROW = 36.0
"""Pixels for the name of the second word; a longer one is turned."""


class Scale(Struct, frozen=True, eq=False):
    """Map of a word's values to shares of the plane from 0 to 1: some values, rising, and linear between them."""

    values: Array
    shares: Array

    def ticks(self) -> list[tuple[float, float]]:
        """Round values, each with its share."""
        low, high = float(self.values[0]), float(self.values[-1])
        if not high > low:
            return [(low, 0.5)]
        rough = (high - low) / _TICKS
        power = 10.0 ** floor(log10(rough))
        step = next(each * power for each in (1.0, 2.0, 5.0, 10.0) if each * power >= rough)
        first = -floor(-low / step)
        ticks = [(first + number) * step for number in range(floor((high - first * step) / step + 1e-9) + 1)]
        return [(round(tick, 12), float(numpy.interp(tick, self.values, self.shares))) for tick in ticks]


def over_cells(values: Array) -> Scale:
    """The scale of values that have a cell each, all of one size."""
    return Scale(values, (numpy.arange(values.size) + 0.5) / values.size)


def over_range(low: float, high: float) -> Scale:
    """The scale of a whole range."""
    return Scale(numpy.array([low, high]), numpy.array([0.0, 1.0]))


def _values_across(scale: Scale, bottom: float) -> Iterator[Item]:
    """The values of a scale under what is drawn."""
    for value, share in scale.ticks():
        x = LEFT + share * WIDE
        yield line((x, bottom), (x, bottom + 5.0), Role.INK)
        yield Text((x, bottom + 19.0), (TextRun(f"{value:g}", Role.INK),), SIZE, Anchor.MIDDLE)


class ValuePlane(Struct, frozen=True):
    """A plane: what its two words are called, and their scales."""

    names: tuple[str, str]
    across: Scale
    up: Scale

    @property
    def box(self) -> Box:
        """The plane on the page."""
        return Box(LEFT, TOP, LEFT + WIDE, TOP + HIGH)

    def spots(self, points: Array) -> Array:
        """Places on the page, of shape (n, 2), for values of both words."""
        across = numpy.interp(points[:, 0], self.across.values, self.across.shares)
        up = numpy.interp(points[:, 1], self.up.values, self.up.shares)
        found: Array = numpy.stack([LEFT + WIDE * across, TOP + HIGH * (1 - up)], axis=1)
        return found

    def axes(self) -> list[Item]:
        """The frame with values of both words."""
        right, bottom = LEFT + WIDE, TOP + HIGH
        corners = ((right, TOP), (right, bottom), (LEFT, bottom), (LEFT, TOP))
        items: list[Item] = [Stroke((LEFT, TOP), corners, Role.INK, 1.2)]
        items += _values_across(self.across, bottom)
        for value, share in self.up.ticks():
            y = bottom - share * HIGH
            items.append(line((LEFT - 5.0, y), (LEFT, y), Role.INK))
            items.append(Text((LEFT - 9.0, y + 4.0), (TextRun(f"{value:g}", Role.INK),), SIZE, Anchor.END))
        first, second = ((TextRun(visible(name), Role.INK),) for name in self.names)
        items.append(Text((LEFT + WIDE / 2, bottom + 40.0), first, TITLE, Anchor.MIDDLE, is_bold=True))
        is_long = width_of(self.names[1], TITLE, is_bold=True) > _NARROW
        at = (24.0, TOP + HIGH / 2)
        items.append(Text(at, second, TITLE, Anchor.MIDDLE, is_bold=True, is_turned=is_long))
        return items


def axis_text(word: str, unit: str, *, is_diameter: bool) -> str:
    """The name of an axis on which the values of a word stand: whether they are diameters, and the unit in which
    they are written, if they have one."""
    named = f"{word} diameter" if is_diameter else word
    return visible(f"{named} [{'in' if unit == 'inch' else unit}]" if unit else named)


def page_of(
    title: str, items: Sequence[Item], remarks: Sequence[tuple[str, Role]], height: float, lead: float = 0.0
) -> Sheet:
    """The page whose drawing ends at a height, with remarks below it, each in as many lines as it takes, the first one
    farther down by `lead`."""
    lines = [(row, role) for told, role in remarks for row in wrap(told, WIDTH - 2 * PAD, SIZE)]
    texts = [
        Text((PAD, height + lead + _HIGHER * number), (TextRun(row, role),), SIZE)
        for number, (row, role) in enumerate(lines)
    ]
    height += _HIGHER * len(texts)
    return Sheet(title, height, Box(0.0, 0.0, WIDTH, height), (heading(title), *items, *texts))


_HIGHER = 17.0
"""Pixels from one line of text to the next."""

# The ranges of one word --------------------------------------------------------------------------------------

_BAR_TOP, _BAR_HIGH = 52.0, 26.0
"""Pixels above the bar, and of the bar."""

_MARGIN = 0.15
"""Share of what is shown that lies beyond the outermost ends."""

_MOST = 12
"""Ends that are told in words."""


def lay_out_range(found: FeasibleRange, title: str | None) -> Sheet:
    """The page of the ranges of a word: where the contour exists, what ends it, and which value the block has."""
    proof = "" if found.is_complete else " (that these are all is not proven)"
    low, high = _shown(found)
    bottom = _BAR_TOP + _BAR_HIGH

    def x_of(value: float) -> float:
        return LEFT + WIDE * (min(max(value, low), high) - low) / (high - low)

    items: list[Item] = [Box(LEFT, _BAR_TOP, LEFT + WIDE, bottom).filled(Role.REFUSED_FIELD)]
    for interval in found.intervals:
        begin = x_of(interval.low.value)
        end = max(x_of(interval.high.value), begin + 1.5)
        items.append(Box(begin, _BAR_TOP, end, bottom).filled(Role.SOLVED_FIELD))
    for each, _ in _ends(found):
        x = x_of(each.value)
        items.append(line((x, _BAR_TOP - 5.0), (x, bottom + 5.0), Role.INK, 1.6))
    items.append(line((LEFT, bottom), (LEFT + WIDE, bottom), Role.INK))
    items += _values_across(over_range(low, high), bottom)
    name = (TextRun(axis_text(found.word, found.unit, is_diameter=found.is_diameter), Role.INK),)
    items.append(Text((LEFT + WIDE / 2, bottom + 38.0), name, TITLE, Anchor.MIDDLE, is_bold=True))
    items.append(Dot((x_of(found.stated), _BAR_TOP + _BAR_HIGH / 2), 4.0, Role.GIVEN))
    told = title if title is not None else f"{found.word}: where the contour exists{proof}"
    return page_of(told, items, list(_remarks(found)), bottom + 62.0)


def _ends(found: FeasibleRange) -> Iterator[tuple[End, str]]:
    """Values at which the contour begins or ceases to exist, each with "from" or "to"."""
    for each in found.intervals:
        if each.low.way is not Way.RANGE:
            yield each.low, "from"
        if each.high.way is not Way.RANGE:
            yield each.high, "to"


def _shown(found: FeasibleRange) -> tuple[float, float]:
    """The range of values that is shown: all ends and the stated value, with a margin, within the range of the
    search."""
    values = [end.value for end, _ in _ends(found)] or list(found.within)
    low, high = min(*values, found.stated), max(*values, found.stated)
    margin = _MARGIN * (high - low) or max(1.0, abs(low))
    return max(low - margin, min(found.within[0], low)), min(high + margin, max(found.within[1], high))


def _remarks(found: FeasibleRange) -> Iterator[tuple[str, Role]]:
    """The value that the block has, and what fails beyond each end."""
    yield f"the block has {written(found.stated, found.unit)}", Role.GIVEN
    ends = list(_ends(found))
    for end, word in ends[:_MOST]:
        reason = f": {visible(end.reason.text)}" if end.reason is not None else ""
        yield f"{word} {limit_text(end.listed, found.unit)}{reason}", Role.INK
    if len(ends) > _MOST:
        yield f"and {len(ends) - _MOST} more ends", Role.MUTED
    if not found.intervals:
        yield "there is a contour for no value", Role.INK
    elif not ends:
        yield "every value searched makes a contour", Role.INK
