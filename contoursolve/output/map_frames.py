"""A map that answers to a pointer: contours at values all over it as plain data, of a bounded size, and those at any
other values when somebody asks for them.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from math import ceil, floor, isfinite, log10
from typing import Any

import numpy
from msgspec import Struct

from contoursolve.diagnosis import Answer, typed_text, with_value
from contoursolve.families import (
    Branches,
    CompiledSweep,
    Family,
    FeasibleRegion,
    Ranges,
    Template,
    compile_sweep,
    first_error,
    outcomes_of,
    solve_sweep,
)
from contoursolve.numeric import Array, trimmed
from contoursolve.output.plain_text import printable
from contoursolve.pictures import (
    MAP_BOX,
    MapPlane,
    Picture,
    Theme,
    draw_family_map,
    draw_region,
    plane_of,
    words_of,
)
from contoursolve.solving import ArcSegment, Contour, Point, Segment, extremes

MOST_FRAMES, MOST_SLOW_FRAMES = 800, 250
"""Contours that a map has for a reader without Python; fewer where each is searched for."""

MOST_BYTES = 400_000
"""Of all of them, as JSON."""

_WIDE = 1.5
"""Frames across for each one up, as a map is wider than high."""

_FEWER = 0.8
"""Share of the frames that is tried next, where they take too many bytes."""

_STEPS = 4_000.0
"""Steps across the drawing of a contour; a screen shows fewer."""

_MARGIN = 0.06
"""Share of the drawing around the contours."""

Data = dict[str, Any]


class MapFrame(Struct, frozen=True, eq=False):
    """Content of a map at one place: the values of both words, a text, and the path, if there is one."""

    values: tuple[float, float]
    text: str
    contour: Contour | None


class LiveMap:
    """A family over two words, or a region, that is asked for the contour at any values of these words.

    Raises ValueError for a family that is no grid of two words, FamilyError for a result that is none.
    """

    def __init__(self, record: Family | FeasibleRegion, result: str | None = None) -> None:
        if not isinstance(record, Family | FeasibleRegion):
            raise TypeError(f"a map is of a family over two words or of a region, not of {type(record).__name__}")
        if record.spec.branches is not Branches.CHOSEN:
            raise ValueError(
                "a map to point at shows the solution that the words choose; "
                "write the word that chooses, or draw the map with draw_family_map"
            )
        self.plane: MapPlane = plane_of(record)
        self.spec = record.spec
        self.template: Template = record.spec.template()
        self._ready: CompiledSweep | None = None
        is_region = isinstance(record, FeasibleRegion)
        self.order = tuple(record.words) if isinstance(record, FeasibleRegion) else tuple(record.ranges.values)
        self.picture: Picture = (
            draw_region(record, result=result, theme=Theme.PAGE)
            if isinstance(record, FeasibleRegion)
            else draw_family_map(record, result=result, theme=Theme.PAGE)
        )
        grid = record.family() if isinstance(record, FeasibleRegion) else record
        measures = grid.measures()
        self.units = [measures[word].unit for word in self.plane.words]
        self.result, self.result_unit = "", ""
        if result is not None:
            measure = grid.measure_of(result)
            self.result, self.result_unit = (
                grid.full_name(result),
                " ".join(filter(None, (measure.unit, measure.measure))),
            )
        decimals = 4 if "inch" in self.units else 3
        self.axes = [_rounded(each, decimals) if is_region else each for each in self.plane.axes]
        """Values of both words that a reader can point at."""
        stated = [float(self.template.words[word].number or 0) for word in self.plane.words]
        self.stated = record.stated if isinstance(record, FeasibleRegion) else (stated[0], stated[1])

    def _family(self, columns: Mapping[str, Array], *, is_paired: bool = False) -> Family:
        """The family at some values of both words; the others have one."""
        count = len(next(iter(columns.values()))) if is_paired else 1
        fixed = {word: numpy.full(count, value) for word, value in self.plane.fixed.items()}
        values = {**columns, **fixed}
        ranges = Ranges({word: values[word] for word in self.order}, is_paired=is_paired)
        self._ready = compile_sweep(self.spec, ranges, self._ready)
        return solve_sweep(self._ready)

    def answer(self, values: Sequence[float]) -> Answer:
        """The answer of a single solve at values of both words."""
        return self.template.solve({**self.plane.fixed, **dict(zip(self.plane.words, map(float, values), strict=True))})

    def filled(self, values: Sequence[float]) -> Template:
        """The block with values of both words written in it."""
        own = {**self.plane.fixed, **dict(zip(self.plane.words, map(float, values), strict=True))}
        words, spelling = self.template.words, self.template.program.syntax.words
        return self.template.typed({name: with_value(words[name], _typed(at), spelling) for name, at in own.items()})

    def look(self, values: Sequence[float]) -> MapFrame:
        """The frame at values of both words, with what is wrong in the words of the first finding. Raises ValueError
        for values beyond the map."""
        for word, value, axis in zip(self.plane.words, values, self.plane.axes, strict=True):
            if not axis.min() <= value <= axis.max():
                raise ValueError(f"{word} {value:g} is not on the map, which has {axis.min():g} to {axis.max():g}")
        return self._frame(values)

    def _frame(self, values: Sequence[float]) -> MapFrame:
        """The frame at values of both words, on the map or beyond it: those of the block may lie there."""
        (frame,) = self.frames([values])
        if frame.contour is None:
            told = first_error(self.answer(values))
            return MapFrame(frame.values, printable(told) or frame.text, None)
        return frame

    def frames(self, places: Sequence[Sequence[float]]) -> Iterator[MapFrame]:
        """The frames at some values of both words."""
        columns = dict(zip(self.plane.words, numpy.array(places, float).T, strict=True))
        family = self._family(columns, is_paired=True)
        is_contour, outcomes = family.has_contour, outcomes_of(family["status"], family["reason"])
        results = family.result(self.result) if self.result and self.result in family.results else None
        for number, place in enumerate(places):
            own = float(place[0]), float(place[1])
            answer = self.answer(place) if is_contour[number] else None
            if answer is None or answer.contour is None:
                yield MapFrame(own, ": ".join(words_of(int(outcomes[number]))), None)
                continue
            text = f"{answer.state}, end {answer.end_text}"
            if results is not None:
                text += f"; {self.result} {results[number]:.3f} {self.result_unit}"
            yield MapFrame(own, text, answer.contour)

    def data(self) -> Data:
        """All that a page needs: the map, the values, and frames on a grid that is as fine as its bounds allow."""
        one = self._frame(self.stated)
        size = len(one.text) + (30 * len(one.contour.elements) if one.contour is not None else 0)
        most = min(MOST_FRAMES if self._is_quick() else MOST_SLOW_FRAMES, MOST_BYTES // size)
        while True:
            found = self._data(most)
            if most < 2 or len(json.dumps(found["frames"])) <= MOST_BYTES:  # noqa: PLR2004 - one is left
                return found
            most = int(most * _FEWER)

    def _is_quick(self) -> bool:
        """Whether one function solves all of them."""
        self._family(dict(zip(self.plane.words, (each[:1] for each in self.axes), strict=True)))
        ready = self._ready
        return ready is not None and not ready.by_row and all(case.is_closed for case in ready.cases)

    def _data(self, most: int) -> Data:
        up = max(1, min(self.axes[1].size, floor((most / _WIDE) ** 0.5)))
        across = max(1, min(self.axes[0].size, most // up))
        up = max(1, min(self.axes[1].size, most // across))
        columns, rows = (_spread(axis.size, count) for axis, count in zip(self.axes, (across, up), strict=True))
        places = [(float(self.axes[0][i]), float(self.axes[1][j])) for i in columns for j in rows]
        frames = list(self.frames(places))
        stated = self._frame(self.stated)
        view = _view_of([each.contour for each in frames if each.contour is not None], stated.contour)
        texts = list(dict.fromkeys(each.text for each in frames if each.contour is None))
        plane = self.answer(places[0]).plane
        return {
            "words": [
                {"name": printable(word), "unit": "in" if unit == "inch" else unit}
                for word, unit in zip(self.plane.words, self.units, strict=True)
            ],
            "box": list(MAP_BOX),
            "size": [self.picture.width, self.picture.height],
            "axes": [[float(f"{value:.10g}") for value in axis.tolist()] for axis in self.axes],
            "shares": [
                [round(each, 5) for each in self._shares(axis, number)] for number, axis in enumerate(self.axes)
            ],
            "columns": columns,
            "rows": rows,
            "texts": texts,
            "frames": [
                [each.text, map_path(each.contour, view)] if each.contour is not None else texts.index(each.text)
                for each in frames
            ],
            "stated": list(self.stated),
            "ghost": map_path(stated.contour, view) if stated.contour is not None else "",
            "view": [round(each, 6) for each in view],
            "axis_names": list(plane.axes),
            "diameters": list(plane.diameters),
            "note": _note(self.axes, columns, rows),
        }

    def _shares(self, axis: Array, number: int) -> list[float]:
        """The places of values in the plane, from 0 to 1."""
        scale = (self.plane.chart.across, self.plane.chart.up)[number]
        return [float(each) for each in numpy.interp(axis, scale.values, scale.shares)]


def _typed(value: float) -> str:
    """A number as it is typed, whole ones as `170.`."""
    return typed_text(value).removesuffix("0") if value == int(value) else typed_text(value)


def _note(axes: Sequence[Array], columns: Sequence[int], rows: Sequence[int]) -> str:
    """The places of the contours that a page holds, in words."""
    held = len(columns) * len(rows)
    if (len(columns), len(rows)) == (axes[0].size, axes[1].size):
        return f"This page holds the contours of all {held:,} values of the map."
    return (
        f"This page holds the contours of {len(columns)} by {len(rows)} values, the map has {axes[0].size} by "
        f"{axes[1].size}. You see the nearest one."
    )


def _rounded(values: Array, decimals: int) -> Array:
    """Values as they are typed, where they stay different."""
    found = numpy.round(values, decimals) + 0.0
    return found if numpy.unique(found).size == values.size else values


def _spread(size: int, count: int) -> list[int]:
    """Places evenly among so many, both ends among them."""
    if count <= 1:
        return [size // 2]
    return [int(each) for each in numpy.unique(numpy.linspace(0, size - 1, count).round())]


def _view_of(contours: Sequence[Contour], stated: Contour | None) -> tuple[float, float, float, float]:
    """The part of the plane that is drawn, with Y down: where three of four contours lie to each side, and the one of
    the block as it stands. The front end shows larger ones smaller."""
    spans = [_spanned(each) for each in contours]
    own = [_spanned(stated)] if stated is not None else []
    if not spans and not own:
        return 0.0, 0.0, 1.0, 1.0
    low, high = [], []
    for axis in (0, 1):
        least, most = ([pick(at[axis] for at in span) for span in spans or own] for pick in (min, max))
        low.append(min([float(numpy.percentile(least, 25)), *(min(at[axis] for at in span) for span in own)]))
        high.append(max([float(numpy.percentile(most, 75)), *(max(at[axis] for at in span) for span in own)]))
    size = max(high[0] - low[0], high[1] - low[1], 1e-6)
    wide, tall = (max(high[axis] - low[axis], size / 8) for axis in (0, 1))
    margin = _MARGIN * size
    return low[0] - margin, -high[1] - margin, wide + 2 * margin, tall + 2 * margin


def _spanned(contour: Contour) -> list[Point]:
    """Points that span the rectangle of a contour."""
    return [contour.start, *(at for each in contour.elements for at in extremes(each, 0, 1))]


def map_path(contour: Contour, view: Sequence[float]) -> str:
    """A contour as the data of a path of SVG, in mm with the second axis up."""
    decimals = max(0, ceil(-log10(max(view[2], view[3]) / _STEPS)))
    here = f"M{_place(contour.start, decimals)}"
    return here + "".join(_step(each, decimals) for each in contour.elements)


def _step(segment: Segment, decimals: int) -> str:
    end = _place(segment.end, decimals)
    if not isinstance(segment, ArcSegment) or not isfinite(segment.radius):
        return f"L{end}"
    radius, flag = trimmed(segment.radius, decimals), int(segment.turn.sign < 0)
    if segment.sweep > 359:  # noqa: PLR2004 - the end of an arc command may not be its beginning
        opposite = 2 * segment.center[0] - segment.start[0], 2 * segment.center[1] - segment.start[1]
        return f"A{radius} {radius} 0 0 {flag} {_place(opposite, decimals)}A{radius} {radius} 0 0 {flag} {end}"
    return f"A{radius} {radius} 0 {int(segment.sweep > 180)} {flag} {end}"  # noqa: PLR2004 - degrees


def _place(at: Point, decimals: int) -> str:
    return f"{trimmed(at[0], decimals)} {trimmed(-at[1], decimals)}"
