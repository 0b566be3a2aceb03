"""A region over two words: the lines that bound it, with teeth where there is no contour, and where the block is."""

from collections.abc import Sequence

import numpy

from contoursolve.families import Region
from contoursolve.pictures.chart import BELOW, HIGH, SIZE, TOP, WIDTH, Chart, heading, over_range
from contoursolve.pictures.family_curves import Curve, curves_of, is_free, names_of, spots_of, strokes, teeth
from contoursolve.pictures.metrics import wrap
from contoursolve.pictures.sheet import Anchor, Box, Dot, Item, Run, Sheet, Text
from contoursolve.pictures.theme import Role
from contoursolve.pictures.wording import axis_text, visible

_LINE = 2.0
"""Pixels of a line that bounds the region."""


def region_title(region: Region) -> str:
    """What a region shows."""
    words = " and ".join(region.words)
    if not region.boundaries:
        return f"{words}: {'a' if region.exists else 'no'} contour everywhere"
    proof = "" if region.is_complete else " (that these are all lines is not proven)"
    return f"{words}: where the contour exists{proof}"


def lay_out_region(region: Region, title: str) -> Sheet:
    """The page of a region."""
    first, second = map(axis_text, region.words, region.units)
    chart = Chart((first, second), *(over_range(low, high) for low, high in region.within))
    curves = curves_of(region, chart)
    rough = teeth(curves)
    stated = _stated(region, chart, curves)
    names, missing = names_of(curves, chart, [each.box for each in stated if isinstance(each, Text)], rough)
    items: list[Item] = [heading(title), *strokes(curves, _LINE), *rough, *chart.axes(), *stated, *names]
    height = TOP + HIGH + BELOW
    remarks = ["teeth: there is no contour on this side"] if any(not each.is_gap for each in curves) else []
    if any(each.is_gap for each in curves):
        remarks.append("dotted: there is none on the line alone")
    if missing:
        remarks.append(f"lines without room for a name: {', '.join(missing)}")
    for told in wrap("; ".join(remarks), WIDTH - 36.0, SIZE, 3):
        items.append(Text((18.0, height + 4.0), (Run(told, Role.MUTED),), SIZE))
        height += 17.0
    return Sheet(WIDTH, height, Box(0.0, 0.0, WIDTH, height), tuple(items))


def _stated(region: Region, chart: Chart, curves: Sequence[Curve]) -> list[Item]:
    """The values that the block has, where they are in the plane."""
    if not all(low <= value <= high for value, (low, high) in zip(region.stated, region.within, strict=True)):
        return []
    ((x, y),) = chart.spots(numpy.array([region.stated])).tolist()
    told = (
        Run(
            visible(" ".join(f"{w}{value:g}" for w, value in zip(region.words, region.stated, strict=True))), Role.GIVEN
        ),
    )
    places = [
        Text((x + side, y + down), told, SIZE, anchor)
        for down in (-7.0, 16.0)
        for side, anchor in ((7.0, Anchor.START), (-7.0, Anchor.END))
    ]
    spots = spots_of(curves)
    label = next((each for each in places if is_free([each], chart, (), spots)), places[0])
    return [Dot((x, y), 4.0, Role.GIVEN), label]
