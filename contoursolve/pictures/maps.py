"""Map of the outcomes of a block over two of its words: a named field for each outcome, and lines around existence."""

from collections.abc import Mapping, Sequence

import numpy
from numpy.typing import NDArray

from contoursolve.families import (
    Family,
    Outcomes,
    Ranges,
    Region,
    boundaries_of,
    compile_sweep,
    crossings_of,
    outcomes_of,
    solve_sweep,
)
from contoursolve.numeric import Array
from contoursolve.pictures.curves import Curve, curves_of, spots_of, strokes
from contoursolve.pictures.field_names import is_free, name_all
from contoursolve.pictures.fields import boundaries, paint
from contoursolve.pictures.page import SIZE, Anchor, Dot, Item, Text, TextRun, visible
from contoursolve.pictures.sheet import Sheet
from contoursolve.pictures.theme import Role
from contoursolve.pictures.value_axes import (
    BELOW,
    HIGH,
    TOP,
    ValuePlane,
    axis_text,
    over_cells,
    over_range,
    page_of,
)
from contoursolve.solving import Status

COLUMNS, ROWS = 305, 200
"""Cells of a map; of more values, the one nearest to the middle of each cell is shown."""

Remark = tuple[str, Role]
Places = NDArray[numpy.int64]


def map_title(statuses: Mapping[Status, int], words: Sequence[str]) -> str:
    """The title of a map: its words, and the count of each status."""
    told = ", ".join(f"{number:,} {status.value}" for status, number in statuses.items())
    return f"{' and '.join(words)}: {told}"


def lay_out_map(
    family: Family, chosen: tuple[str, str] | None, title: str | None, whole: Ranges | None = None
) -> Sheet:
    """The page of a map, of the words that vary unless others are chosen; `whole` has all values of a sweep of which
    the family has those that are shown. Raises ValueError where these are not two words of a grid of two."""
    ranges = whole if whole is not None else family.ranges
    several = [word for word, values in ranges.values.items() if values.size > 1]
    words = chosen if chosen is not None else tuple(several or ranges.values)[:2]
    own = [word for word, values in ranges.values.items() if values.size > 1 or word in words]
    if ranges.is_paired or len(own) != 2 or sorted(words) != sorted(own):  # noqa: PLR2004 - a plane
        raise ValueError(f"a map needs a grid of two words; this family has {' and '.join(own)}, not {words!r}")
    first, second = words
    # The other words have one value each.
    outcomes = outcomes_of(family["status"], family["reason"]).reshape(
        [family.ranges.values[word].size for word in own]
    )
    outcomes = outcomes if own == list(words) else outcomes.T
    columns, rows = picks(family.ranges.values[first], COLUMNS), picks(family.ranges.values[second], ROWS)
    drawn = outcomes[numpy.ix_(columns, rows)]
    shown = drawn.T[::-1]
    scales = (over_cells(numpy.sort(ranges.values[word])) for word in words)
    chart = ValuePlane(_axes(family, words), *scales)
    remarks: list[Remark] = []
    thinned = [
        f"{count:,} of {ranges.values[word].size:,} values of {word}"
        for word, count in zip(words, drawn.shape, strict=True)
        if count < ranges.values[word].size
    ]
    if thinned:
        remarks.append((f"drawn: {' and '.join(thinned)}; the title counts all contours", Role.MUTED))
    named = title if title is not None else map_title(family.summary(), words)
    return _page(named, chart, shown, _curves(family, (first, second), (columns, rows), drawn, chart), [], remarks)


def lay_out_region(region: Region, title: str | None) -> Sheet:
    """The page of a region."""
    first, second = (
        axis_text(word, unit, is_diameter=is_diameter)
        for word, unit, is_diameter in zip(region.words, region.units, region.diameters, strict=True)
    )
    chart = ValuePlane((first, second), *(over_range(low, high) for low, high in region.within))
    curves = curves_of(region.boundaries, chart)
    stated = _stated(region, chart, curves)
    remarks: list[Remark] = [(region.fineness, Role.MUTED)]
    told = title if title is not None else _region_title(region)
    return _page(told, chart, region.outcomes.T[::-1], curves, stated, remarks)


def _region_title(region: Region) -> str:
    """The title of a region: its words, and where a contour exists."""
    words = " and ".join(region.words)
    if not region.boundaries:
        return f"{words}: {'a' if region.exists else 'no'} contour at every value sampled"
    return f"{words}: where the contour exists"


def _axes(family: Family, words: Sequence[str]) -> tuple[str, str]:
    """The names of both axes."""
    measures = family.measures()
    first, second = (
        axis_text(word, measures[word].unit, is_diameter=measures[word].measure == "diameter") for word in words
    )
    return first, second


def _page(
    title: str,
    chart: ValuePlane,
    shown: Outcomes,
    curves: Sequence[Curve],
    marks: Sequence[Item],
    remarks: Sequence[Remark],
) -> Sheet:
    """The page of a plane with its outcomes, and of what is marked in it."""
    taken = [each.box for each in marks if isinstance(each, Text)]
    names, narrow, unnamed = name_all(shown, curves, taken)
    told = (("too narrow to be named", narrow), ("lines without room for a name", unnamed))
    items = [*paint(shown), *boundaries(shown, curves), *strokes(curves), *chart.axes(), *marks, *names]
    more = [(f"{what}: {'; '.join(names)}", Role.MUTED) for what, names in told if names]
    return page_of(title, items, [*remarks, *more], TOP + HIGH + BELOW, 4.0)


def _curves(
    family: Family, words: tuple[str, str], places: Sequence[Places], drawn: Outcomes, chart: ValuePlane
) -> list[Curve]:
    """The lines between the values that are drawn with a contour and without; `places` are theirs in the family."""
    values = family.ranges.values
    axes = [values[word][each] for word, each in zip(words, places, strict=True)]
    fixed = {word: float(column[0]) for word, column in values.items() if word not in words}
    template = family.spec.template().filled(fixed).with_words(words)

    # Rows that are read one by one, or searched, take a thousand times as long.
    ready = compile_sweep(family.spec, family.ranges) if not family.remark else None
    is_quick = ready is not None and all(case.is_closed for case in ready.cases)

    def solve(points: Array) -> Outcomes:
        columns = dict(zip(words, points.T, strict=True)) | {
            word: numpy.full(len(points), value) for word, value in fixed.items()
        }
        ranges = Ranges({word: columns[word] for word in values}, is_paired=True)
        found = solve_sweep(compile_sweep(family.spec, ranges, ready))
        return outcomes_of(found["status"], found["reason"])

    return curves_of(boundaries_of(template, drawn, crossings_of(axes, drawn, solve if is_quick else None)), chart)


def picks(values: Array, most: int) -> Places:
    """Indices of the values to be shown, in rising order; of too many, the one in the middle of each cell."""
    order = numpy.argsort(values, kind="stable")
    if order.size <= most:
        return order
    return order[((numpy.arange(most) + 0.5) * order.size / most).astype(numpy.int64)]


def _stated(region: Region, chart: ValuePlane, curves: Sequence[Curve]) -> list[Item]:
    """The values that the block has, where they are in the plane."""
    if not all(low <= value <= high for value, (low, high) in zip(region.stated, region.within, strict=True)):
        return []
    ((x, y),) = chart.spots(numpy.array([region.stated])).tolist()
    words = " ".join(f"{word}{value:g}" for word, value in zip(region.words, region.stated, strict=True))
    told = (TextRun(visible(words), Role.GIVEN),)
    places = [
        Text((x + side, y + down), told, SIZE, anchor)
        for down in (-7.0, 16.0)
        for side, anchor in ((7.0, Anchor.START), (-7.0, Anchor.END))
    ]
    spots = spots_of(curves)
    label = next((each for each in places if chart.box.holds(each.box) and is_free([each], (), spots)), places[0])
    return [Dot((x, y), 4.0, Role.GIVEN), label]
