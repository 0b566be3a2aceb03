"""A result over two words as bands of a plane, and the lines of equal value between them, each with its value."""

from collections.abc import Iterator, Sequence
from math import ceil, floor, log10

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.families import level_line
from contoursolve.numeric import Array
from contoursolve.pictures.curves import PageLine, is_free, line_on_page, spots_of
from contoursolve.pictures.page import SIZE, Anchor, Box, Item, Shape, Stroke, Text, TextRun
from contoursolve.pictures.theme import LEVELS, Role
from contoursolve.pictures.value_axes import ValuePlane

_LINE = 1.2
"""Pixels of a line of equal value."""

_LEAST = 46.0
"""Pixels of a line that gets its value written on it."""

_SHARES = (0.5, 0.35, 0.65, 0.2, 0.8, 0.1, 0.9)
"""Shares of a line at which its value is tried."""

_FENCE = 1.5
"""Times the middle half of all values that levels reach beyond it (Tukey, Exploratory Data Analysis, 1977)."""

_SAME = 1e-9
"""Share of its size by which a result varies if it is the same everywhere."""


Level = tuple[float, PageLine]
"""A line of equal value with that value."""


class Levels(Struct, frozen=True, eq=False):
    """Round values of a result between its least and its largest, rising, and the decimals to write them with."""

    low: float
    high: float
    values: tuple[float, ...]
    decimals: int

    def text(self, value: float, more: int = 0) -> str:
        """A level as it is written, or a value with more decimals."""
        decimals = self.decimals + more
        return f"{round(value, decimals) + 0.0:.{decimals}f}"

    def bands(self, values: Array) -> NDArray[numpy.int64]:
        """The number of levels that are less than each value; -1 for NaN."""
        found = numpy.searchsorted(numpy.array(self.values), values, side="right").astype(numpy.int64)
        return numpy.where(numpy.isnan(values), -1, found)

    def role(self, band: int) -> Role:
        """The colour role of a band; few bands are spread over all roles."""
        return LEVELS[round(band * (len(LEVELS) - 1) / len(self.values))] if self.values else LEVELS[0]


def levels_of(values: Array) -> Levels | None:
    """The levels of a result, one less than there are roles for bands at most; None if it has no value.

    A result may grow without bounds where a contour nearly ceases to exist. The levels lie within Tukey's fences: the
    middle half of all values, and one and a half times as much to both sides.
    """
    known = values[numpy.isfinite(values)]
    if not known.size:
        return None
    low, high = float(known.min()), float(known.max())
    first, third = (float(each) for each in numpy.percentile(known, (25, 75)))
    reach = _FENCE * (third - first)
    inner = max(low, first - reach), min(high, third + reach)
    inner = inner if _differ(*inner) else (low, high)
    if not _differ(*inner):
        return Levels(low, high, (), 3)
    rough = (inner[1] - inner[0]) / len(LEVELS)
    power = 10.0 ** floor(log10(rough))
    for step in (each * power for each in (1.0, 2.0, 2.5, 5.0, 10.0, 20.0)):
        begin, end = ceil(inner[0] / step + 1e-9), ceil(inner[1] / step - 1e-9)
        if step >= rough * (1 - 1e-9) and end - begin < len(LEVELS):
            break
    digits = next(number for number in range(20) if abs(round(step, number) - step) <= _SAME * step)
    return Levels(low, high, tuple(round(number * step, 12) for number in range(begin, end)), digits)


def _differ(low: float, high: float) -> bool:
    return high - low > _SAME * max(abs(low), abs(high), 1.0)


def level_lines(axes: Sequence[Array], values: Array, levels: Levels, chart: ValuePlane) -> list[Level]:
    """Lines of equal value as they run on the page, each with its value; `values` by (first word, second word)."""
    found = []
    for level in levels.values:
        lines = (line_on_page(points, chart) for points in level_line(axes, values, level))
        found += [(level, line) for line in lines if line.length > 1.0]
    return found


def strokes_of(lines: Sequence[Level]) -> list[Stroke]:
    """The lines, thin."""
    return [line.stroke(Role.MUTED, _LINE) for _, line in lines]


def names_of(
    lines: Sequence[Level], levels: Levels, chart: ValuePlane, taken: Sequence[Box], spots: Array
) -> Iterator[Item]:
    """The values of lines on them, where they are clear of what is taken and of other lines; the longest line of each
    value first."""
    boxes = list(taken)
    for level, line in sorted(lines, key=lambda each: -each[1].length):
        if line.length < _LEAST:
            continue
        others = numpy.concatenate([spots, spots_of([each for _, each in lines if each is not line])])
        told = (TextRun(levels.text(level), Role.INK),)
        for share in _SHARES:
            x, y = (float(each) for each in line.spots[int(share * (len(line.spots) - 1))])
            text = Text((x, y + 4.0), told, SIZE, Anchor.MIDDLE)
            if chart.box.holds(text.box.grow(2.0)) and is_free([text], boxes, others):
                boxes.append(text.box)
                yield _plate(text)
                yield text
                break


def _plate(text: Text) -> Shape:
    """The paper on which a value is written, so that its line does not strike it out."""
    return text.box.grow(1.5).filled(Role.PAPER)
