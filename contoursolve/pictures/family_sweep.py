"""What a picture of a sweep shows: the contours of a few values of one word, or the outcomes over two."""

from collections.abc import Sequence

import numpy

from contoursolve.backends.columns import Array
from contoursolve.examine import Answer
from contoursolve.families import CompiledSweep, Family, FamilyError
from contoursolve.families.evaluate import compile_sweep, solve_sweep
from contoursolve.families.spec import Ranges
from contoursolve.pictures.family_map import COLUMNS, ROWS

MOST_VALUES = 21
"""Values of one word whose contours are drawn."""

Fan = tuple[str, Sequence[float], Sequence[Answer]]
"""A word, some of its values, and the answer for each."""


def solve_shown(ready: CompiledSweep) -> Fan | Family:
    """What is drawn of a sweep, solved: no more values than there is room for, evenly chosen.

    Raises FamilyError where not one word or two vary, or where they are paired.
    """
    ranges = ready.ranges
    varying = [name for name, values in ranges.values.items() if values.size > 1]
    if ranges.is_paired or not 1 <= len(varying) <= 2:  # noqa: PLR2004 - a line or a plane
        told = "paired words" if ranges.is_paired else f"{len(varying)} words with several values"
        raise FamilyError(
            f"a picture shows one word or two, every value of one with every value of the other; not {told}"
        )
    if len(varying) == 1:
        (word,) = varying
        values = [float(value) for value in _chosen(ranges.values[word], MOST_VALUES)]
        fixed = {name: float(column[0]) for name, column in ranges.values.items()}
        return word, values, [ready.template.solve({**fixed, word: value}) for value in values]
    alone = {name: column for name, column in ranges.values.items() if name not in varying}
    shown = {name: _chosen(ranges.values[name], most) for name, most in zip(varying, (COLUMNS, ROWS), strict=True)}
    return solve_sweep(compile_sweep(ready.spec, Ranges({**alone, **shown}, is_paired=False)))


def _chosen(values: Array, most: int) -> Array:
    """At most so many of the values in rising order, the first and the last among them."""
    rising = numpy.unique(values)
    if rising.size <= most:
        return rising
    places = numpy.linspace(0, rising.size - 1, most).round().astype(numpy.int64)
    chosen: Array = rising[places]
    return chosen
