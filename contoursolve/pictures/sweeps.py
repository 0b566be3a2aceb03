"""Selection of values for the picture of a sweep: the fan of contours of one word, or the map of two."""

from collections.abc import Mapping, Sequence

import numpy

from contoursolve.diagnosis import Answer, statuses_text
from contoursolve.families import (
    TOOL,
    CompiledSweep,
    Family,
    FamilyError,
    Ranges,
    Tally,
    Template,
    compile_sweep,
    pieces,
    solve_sweep,
    summary_of,
)
from contoursolve.numeric import Array
from contoursolve.pictures.maps import COLUMNS, ROWS, map_title, picks
from contoursolve.solving import Status

MOST_VALUES = 21
"""Values of one word whose contours are drawn."""

Fan = tuple[str, Sequence[float], Sequence[Answer]]
"""A word, some of its values, and the answer for each."""


def solve_shown(ready: CompiledSweep) -> Fan | Family:
    """The solved values of a sweep that are drawn: no more than there is room for, evenly chosen.

    Raises FamilyError where not one word or two vary, or where they are paired.
    """
    ranges = ready.ranges
    varying = [name for name, values in ranges.values.items() if values.size > 1]
    if ranges.is_paired or not 1 <= len(varying) <= 2:  # noqa: PLR2004 - a line or a plane
        told = "paired words" if ranges.is_paired else f"{len(varying)} words with several values"
        raise FamilyError(f"a picture takes one word, or every combination of two; this family has {told}")
    if len(varying) == 1:
        return fan_of(ready.template, ranges, varying[0])
    alone = {name: column for name, column in ranges.values.items() if name not in varying}
    sizes = dict(zip(varying, (COLUMNS, ROWS), strict=True))
    shown = {name: ranges.values[name][picks(ranges.values[name], most)] for name, most in sizes.items()}
    return solve_sweep(compile_sweep(ready.spec, Ranges({**alone, **shown}, is_paired=False)))


def fan_of(template: Template, ranges: Ranges, word: str) -> Fan:
    """The answers for the values of the word that varies, at most as many as are drawn."""
    values = [float(value) for value in _chosen(ranges.values[word], MOST_VALUES)]
    fixed = {name: float(column[0]) for name, column in ranges.values.items()}
    return word, values, [template.solve({**fixed, word: value}) for value in values]


def fan_of_family(family: Family) -> Fan | None:
    """The fan of a family in which one word alone varies; None for another one, and for one of tools."""
    varying = [name for name, values in family.ranges.values.items() if values.size > 1]
    is_fan = len(varying) == 1 and not family.ranges.is_paired and TOOL not in family.ranges.values
    return fan_of(family.spec.template(), family.ranges, varying[0]) if is_fan else None


def count_statuses(ready: CompiledSweep) -> dict[Status, int]:
    """The number of rows of a sweep with each status; solves them all."""
    tally = Tally(tuple(ready.ranges.values))
    for part in pieces(ready):
        tally.add(part)
    return summary_of(tally.counts.sum(axis=1))


def sweep_title(ranges: Ranges, statuses: Mapping[Status, int]) -> str:
    """The title of the picture of a sweep: its values, and the statuses of all its rows, drawn or not."""
    varying = {name: numpy.unique(values) for name, values in ranges.values.items() if values.size > 1}
    if len(varying) > 1:
        return map_title(statuses, tuple(varying))
    ((word, values),) = varying.items()
    drawn = f" ({MOST_VALUES} drawn)" if values.size > MOST_VALUES else ""
    span = f"{word} from {values[0]:g} to {values[-1]:g}, {ranges.count:,} contours{drawn}"
    return f"{span}: {statuses_text(statuses)}"


def _chosen(values: Array, most: int) -> Array:
    """At most so many of the values in rising order, the first and the last among them."""
    rising = numpy.unique(values)
    if rising.size <= most:
        return rising
    places = numpy.linspace(0, rising.size - 1, most).round().astype(numpy.int64)
    chosen: Array = rising[places]
    return chosen
