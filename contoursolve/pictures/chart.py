"""The plane of two words: its frame with values of both, and where each value is on the page."""

from dataclasses import dataclass
from math import floor, log10

import numpy

from contoursolve.backends.columns import Array
from contoursolve.pictures.arrows import line
from contoursolve.pictures.metrics import shorten, width_of
from contoursolve.pictures.sheet import Anchor, Box, Item, Run, Stroke, Text
from contoursolve.pictures.theme import Role
from contoursolve.pictures.wording import visible

WIDTH, WIDE, HIGH = 760.0, 610.0, 400.0
"""Pixels of the page, and of the plane itself."""

LEFT, TOP, BELOW = 92.0, 56.0, 56.0
"""Pixels beside the plane: before it, above it with the title, below it with the values."""

SIZE, TITLE = 12.0, 14.0
_TICKS = 6
_NARROW = 36.0
"""Pixels for the name of the second word; a longer one is turned."""


@dataclass(frozen=True, slots=True, eq=False)
class Scale:
    """Where the values of a word are in the plane, from 0 to 1: of some of them, rising, and straight between."""

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


@dataclass(frozen=True, slots=True)
class Chart:
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
        for value, share in self.across.ticks():
            x = LEFT + share * WIDE
            items.append(line((x, bottom), (x, bottom + 5.0), Role.INK))
            items.append(Text((x, bottom + 19.0), (Run(f"{value:g}", Role.INK),), SIZE, Anchor.MIDDLE))
        for value, share in self.up.ticks():
            y = bottom - share * HIGH
            items.append(line((LEFT - 5.0, y), (LEFT, y), Role.INK))
            items.append(Text((LEFT - 9.0, y + 4.0), (Run(f"{value:g}", Role.INK),), SIZE, Anchor.END))
        first, second = ((Run(visible(name), Role.INK),) for name in self.names)
        items.append(Text((LEFT + WIDE / 2, bottom + 40.0), first, TITLE, Anchor.MIDDLE, is_bold=True))
        is_long = width_of(self.names[1], TITLE, is_bold=True) > _NARROW
        at = (24.0, TOP + HIGH / 2)
        items.append(Text(at, second, TITLE, Anchor.MIDDLE, is_bold=True, is_turned=is_long))
        return items


def heading(title: str) -> Text:
    """The title of a page, as much of it as fits."""
    told = shorten(visible(title), WIDTH - 36.0, TITLE, is_bold=True)
    return Text((18.0, 26.0), (Run(told, Role.INK),), TITLE, is_bold=True)
