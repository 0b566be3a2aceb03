"""Map of the outcomes of a block over two of its words: a named field for each outcome, and lines around existence."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.diagnosis import statuses_text
from contoursolve.families import (
    Boundary,
    Family,
    FeasibleRegion,
    Outcomes,
    Ranges,
    boundaries_of,
    compile_sweep,
    crossings_of,
    outcomes_of,
    solve_sweep,
)
from contoursolve.numeric import Array
from contoursolve.pictures.curves import Curve, PageLine, curves_of, is_free, spots_of, strokes
from contoursolve.pictures.field_names import name_all, number_fields
from contoursolve.pictures.fields import boundaries, paint, smoothed
from contoursolve.pictures.levels import Levels, level_lines, levels_of, names_of, strokes_of
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

T = TypeVar("T")
Number = TypeVar("Number", bound=numpy.generic)
Remark = tuple[str, Role]
Places = NDArray[numpy.int64]


def map_title(statuses: Mapping[Status, int], words: Sequence[str], field: "ResultField | None" = None) -> str:
    """The title of a map: its words, its result if it shows one, and the count of each state."""
    named = " and ".join(words) + (f": {field.name}" if field is not None else "")
    return f"{named}: {statuses_text(statuses)}"


class MapPlane(Struct, frozen=True, eq=False):
    """Content of a map: its words, the plane on the page, the rising values of each word that are drawn, and the
    outcomes there, by (first word, second word); `fixed` are words with one value each."""

    words: tuple[str, str]
    chart: ValuePlane
    axes: tuple[Array, Array]
    outcomes: Outcomes
    fixed: Mapping[str, float] = {}


class ResultField(Struct, frozen=True, eq=False):
    """A result in a plane: its name with its unit, its values, NaN without a contour, and their levels."""

    name: str
    values: Array
    levels: Levels | None


def plane_of(
    record: Family | FeasibleRegion, chosen: tuple[str, str] | None = None, whole: Ranges | None = None
) -> MapPlane:
    """The plane of a map of a family or a region. Raises ValueError for a family that is no grid of two words."""
    if isinstance(record, FeasibleRegion):
        axes = tuple(
            numpy.linspace(*ends, count) for ends, count in zip(record.within, record.outcomes.shape, strict=True)
        )
        texts = (
            axis_text(word, unit, is_diameter=is_diameter)
            for word, unit, is_diameter in zip(record.words, record.units, record.diameters, strict=True)
        )
        chart = ValuePlane(_pair(texts), *(over_range(low, high) for low, high in record.within))
        return MapPlane(record.words, chart, _pair(axes), record.outcomes)
    if record.solutions:
        raise ValueError(f"a map shows one solution; draw family.solution({record.solutions[0]!r})")
    values, ranges = record.ranges.values, whole if whole is not None else record.ranges
    several = [word for word, each in ranges.values.items() if each.size > 1]
    words = chosen if chosen is not None else tuple(several or ranges.values)[:2]
    own = [word for word, each in ranges.values.items() if each.size > 1 or word in words]
    if ranges.is_paired or len(own) != 2 or sorted(words) != sorted(own):  # noqa: PLR2004 - a plane
        how = "has columns side by side" if ranges.is_paired else f"varies {', '.join(own)}"
        asked = f", not {' and '.join(words)}" if chosen is not None else ""
        raise ValueError(f"a map needs a grid of two words; this family {how}{asked}")
    chart = ValuePlane(_axes(record, words), *(over_cells(numpy.sort(ranges.values[word])) for word in words))
    outcomes = _drawn(record, words, outcomes_of(record["status"], record["reason"]))
    axes = tuple(values[word][each] for word, each in zip(words, _places(record, words), strict=True))
    fixed = {word: float(column[0]) for word, column in values.items() if word not in words}
    return MapPlane(_pair(words), chart, _pair(axes), outcomes, fixed)


def _pair(values: Iterable[T]) -> tuple[T, T]:
    first, second = values
    return first, second


def _places(family: Family, words: Sequence[str]) -> tuple[Places, Places]:
    """The places of the values that are drawn among those of a family."""
    first, second = words
    return picks(family.ranges.values[first], COLUMNS), picks(family.ranges.values[second], ROWS)


def _drawn(family: Family, words: Sequence[str], values: NDArray[Number]) -> NDArray[Number]:
    """An array of a family at the values that are drawn, by (first word, second word). Other words have one value."""
    own = [word for word in family.ranges.values if word in words]
    grid = values.reshape([family.ranges.values[word].size for word in own])
    return (grid if own == list(words) else grid.T)[numpy.ix_(*_places(family, words))]


def result_in(record: Family | FeasibleRegion, plane: MapPlane, name: str) -> ResultField:
    """A result of a family or a region in its plane. Raises FamilyError for a name that is none."""
    if isinstance(record, FeasibleRegion):
        family = record.family()
        values = family.result(name)
    else:
        family = record
        values = _drawn(family, plane.words, family.result(name))
    measure, named = family.measure_of(name), family.full_name(name)
    unit = ", ".join(filter(None, (measure.unit, measure.measure)))
    return ResultField(f"{named} [{unit}]" if unit else named, values, levels_of(values))


def lay_out_map(
    family: Family,
    chosen: tuple[str, str] | None,
    title: str | None,
    whole: Ranges | None = None,
    result: str | None = None,
) -> Sheet:
    """The page of a map, of the words that vary unless others are chosen, and of a result if one is named; `whole` has
    all values of a sweep of which the family has those that are shown. Raises ValueError where these are not two words
    of a grid of two, FamilyError for a result that is none."""
    plane, ranges = plane_of(family, chosen, whole), whole if whole is not None else family.ranges
    field = None if result is None else result_in(family, plane, result)
    remarks: list[Remark] = []
    thinned = [
        f"{count:,} of {ranges.values[word].size:,} values of {word}"
        for word, count in zip(plane.words, plane.outcomes.shape, strict=True)
        if count < ranges.values[word].size
    ]
    if thinned:
        remarks.append((f"drawn: {' and '.join(thinned)}; the title counts all contours", Role.MUTED))
    named = title if title is not None else map_title(family.summary(), plane.words, field)
    curves = curves_of(boundaries_in(family, plane), plane.chart)
    return _page(named, plane, curves, [], remarks, field)


def lay_out_region(region: FeasibleRegion, title: str | None, result: str | None = None) -> Sheet:
    """The page of a region, with a result if one is named. Raises FamilyError for one that is none."""
    plane = plane_of(region)
    field = None if result is None else result_in(region, plane, result)
    curves = curves_of(boundaries_in(region, plane), plane.chart)
    remarks: list[Remark] = [(region.fineness, Role.MUTED)]
    told = title if title is not None else _region_title(region, field)
    return _page(told, plane, curves, _stated(region, plane.chart, curves), remarks, field)


def _region_title(region: FeasibleRegion, field: ResultField | None) -> str:
    """The title of a region: its words, and its result or where a contour exists."""
    words = " and ".join(region.words)
    if not region.boundaries:
        return f"{words}: {'a' if region.exists else 'no'} contour at every value sampled"
    return f"{words}: {field.name if field is not None else 'where the contour exists'}"


def _axes(family: Family, words: Sequence[str]) -> tuple[str, str]:
    """The names of both axes."""
    measures = family.measures()
    return _pair(
        axis_text(word, measures[word].unit, is_diameter=measures[word].measure == "diameter") for word in words
    )


def _page(
    title: str,
    plane: MapPlane,
    curves: Sequence[Curve],
    marks: Sequence[Item],
    remarks: Sequence[Remark],
    field: ResultField | None,
) -> Sheet:
    """The page of a plane with its outcomes, its result, and what is marked in it."""
    shown, chart = plane.outcomes.T[::-1], plane.chart
    taken = [each.box for each in marks if isinstance(each, Text)]
    levels = field.levels if field is not None else None
    bands, lines, values = None, list[tuple[float, PageLine]](), list[Item]()
    if field is not None and levels is not None:
        bands = levels.bands(field.values).T[::-1]
        lines = level_lines(plane.axes, field.values, levels, chart)
        values = list(names_of(lines, levels, chart, taken, spots_of(curves)))
    taken += [each.box for each in values if isinstance(each, Text)]
    names, narrow, unnamed = name_all(shown, curves, taken, has_values=levels is not None)
    numbers, keys = number_fields(shown, narrow, [*taken, *(each.box.grow(1.0) for each in names)])
    told = (*keys, *(f"lines without room for a name: {'; '.join(unnamed)}" for _ in unnamed[:1]))
    steps = smoothed(shown, curves, has_values=levels is not None)
    fields = [*paint(shown, levels, bands), *steps, *boundaries(shown, curves)]
    items = [*fields, *strokes_of(lines), *strokes(curves), *chart.axes(), *values, *marks, *names, *numbers]
    more = [(each, Role.MUTED) for each in told]
    about = [(_range_told(field), Role.MUTED)] if field is not None else []
    return page_of(title, items, [*about, *remarks, *more], TOP + HIGH + BELOW, 4.0)


def _range_told(field: ResultField) -> str:
    """The least and the largest value of a result, and what its lines are."""
    levels = field.levels
    if levels is None:
        return f"{field.name}: there is no value, for there is no contour"
    low, high = (levels.text(each, 2) for each in (levels.low, levels.high))
    if not levels.values:
        return f"{field.name}: {levels.text(levels.low)} wherever there is a contour"
    step = levels.values[1] - levels.values[0] if len(levels.values) > 1 else None
    every = f"every {levels.text(step)}" if step is not None else f"at {levels.text(levels.values[0])}"
    first, last = levels.text(levels.values[0]), levels.text(levels.values[-1])
    between = f", from {first} to {last}" if step is not None else ""
    return f"{field.name}: from {low} to {high}; lines of equal value {every}{between}"


def boundaries_in(record: Family | FeasibleRegion, plane: MapPlane) -> Sequence[Boundary]:
    """The lines between the values that are drawn with a contour and without."""
    if isinstance(record, FeasibleRegion):
        return record.boundaries
    family, words, fixed, values = record, plane.words, plane.fixed, record.ranges.values
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

    crossings = crossings_of(plane.axes, plane.outcomes, solve if is_quick else None)
    return list(boundaries_of(template, plane.outcomes, crossings))


def picks(values: Array, most: int) -> Places:
    """Indices of the values to be shown, in rising order; of too many, the one in the middle of each cell."""
    order = numpy.argsort(values, kind="stable")
    if order.size <= most:
        return order
    return order[((numpy.arange(most) + 0.5) * order.size / most).astype(numpy.int64)]


def _stated(region: FeasibleRegion, chart: ValuePlane, curves: Sequence[Curve]) -> list[Item]:
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
