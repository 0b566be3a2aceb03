"""Families, and what is asked about them, as HTML."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import htpy as h

from contoursolve.families import Family, Feasible, Found, Region, Sensitivity, Tolerances
from contoursolve.markup.answers import cut
from contoursolve.markup.figure import figure
from contoursolve.markup.tables import short, table
from contoursolve.notebook.text import SLOPES, family_rows, slope_rows, status_rows
from contoursolve.output.inverse import found_title, hit_row
from contoursolve.output.layout import count
from contoursolve.output.ranges import range_notes, range_rows, range_title, region_rows, region_title
from contoursolve.output.tolerances import effect_rows, spread_lines, tolerances_title

MAP_WORDS = 2
"""Free words of a family that a map shows."""


def _family(family: Family) -> Iterator[h.Node]:
    if not family.ranges.is_paired and len(family.ranges.values) == MAP_WORDS:
        yield figure(family)
    header, *rows = family_rows(family)
    yield table("Free words", header, rows, numbers=(1, 2, 3))
    header, *rows = status_rows(family)
    yield table("What becomes of them", header, rows, numbers=(1, 2))
    title = f"{count(len(family.names), 'array')} of shape {' x '.join(map(str, family.shape))}"
    yield h.details[h.summary[title], ", ".join(family.names)]


def _range(found: Feasible) -> Iterator[h.Node]:
    yield figure(found)
    yield h.p[short(range_title(found))]
    if found.intervals:
        header = ("range", "end", "value", "what ends it")
        yield table("Where the contour exists", header, cut(range_rows(found)), numbers=(2,))
    yield from (h.p[short(note.strip())] for note in range_notes(found))


def _region(found: Region) -> Iterator[h.Node]:
    yield figure(found)
    yield h.p[short(region_title(found))]
    if found.boundaries:
        header = ("line", "from and to", "points", "where there is no contour")
        yield table("The lines that bound it", header, cut(region_rows(found)), numbers=(2,))


def _found(found: Found) -> Iterator[h.Node]:
    yield h.p[short(found_title(found))]
    if found.remark:
        yield h.p[short(f"{found.remark}.")]
    if found.hits:
        header = (found.word, "the point is then at", "certificate", "the block", "what rounding does")
        rows = [hit_row(each, found) for each in found.hits]
        yield table("Values", header, cut(rows), numbers=(0,))


def _tolerances(found: Tolerances) -> Iterator[h.Node]:
    yield h.p[short(tolerances_title(found))]
    header, *rows = effect_rows(found)
    yield table("What each word does", header, cut(rows), numbers=range(1, len(header)))
    yield from (h.p[short(f"{line}.")] for line in spread_lines(found))


def _sensitivity(found: Sensitivity) -> h.Node:
    header, *rows = slope_rows(found)
    return table(SLOPES.capitalize(), header, cut(rows), numbers=range(1, len(header)))


FAMILY_PARTS: Mapping[type, Callable[[Any], h.Node]] = {
    Family: _family,
    Feasible: _range,
    Region: _region,
    Found: _found,
    Tolerances: _tolerances,
    Sensitivity: _sensitivity,
}
