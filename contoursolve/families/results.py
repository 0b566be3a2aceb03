"""One result of a family as an array: by the name of its column, the end of the path, or its length."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy
from numpy.typing import NDArray

from contoursolve.diagnostics import did_you_mean
from contoursolve.families.block_template import Template
from contoursolve.families.errors import FamilyError
from contoursolve.families.goals import end_name
from contoursolve.families.word_values import Ranges
from contoursolve.numeric import Array

LENGTH, END = "length", "end"
"""Names of results that are no columns: the length of the path, and its end, `end.Z`."""

Columns = Mapping[str, NDArray[Any]]


def names_of_results(template: Template, ranges: Ranges, columns: Columns) -> dict[str, str]:
    """The names of all results that are numbers, each with the column that has it; empty for the length."""
    answer = template.solve({word: float(values[0]) for word, values in ranges.values.items()})
    found = {name: name for name, column in columns.items() if column.dtype.kind == "f"}
    end = end_name(answer.profile.figure) if answer.profile.figure.path else ""
    ends = {f"{END}.{axis}": f"{end}.{axis}" for axis in answer.plane.axes}
    return {name: column for name, column in ends.items() if column in columns} | found | {LENGTH: ""}


def find_result(name: str, known: Iterable[str]) -> str:
    """A result by its name, however it is spaced or capitalised. Raises FamilyError, which names those that are like
    it, or all."""
    by_key = {_key(each): each for each in known}
    if not isinstance(name, str) or not name.strip():
        raise FamilyError(f"a result has a name, such as {', '.join(list(by_key.values())[:3])}")
    if _key(name) in by_key:
        return by_key[_key(name)]
    hint = did_you_mean(_key(name), by_key.values())
    raise FamilyError(f"there is no result {name}; {hint}the results are {', '.join(by_key.values())}")


def _key(name: str) -> str:
    return "".join(name.split()).lower()


def lengths_of(columns: Columns) -> Array:
    """The lengths of paths, mm, in the shape of the columns: what the corners leave of each element, and the corners,
    each chord or arc of which is less than half a turn."""
    total = numpy.zeros(next(iter(columns.values())).shape)
    for name, column in columns.items():
        if name.endswith(".room"):
            total += _without_gaps(column)
        elif name.startswith("corner ") and ".begin." in name:
            corner, _, axis = name.partition(".begin.")
            others = [each.partition(".begin.")[2] for each in columns if each.startswith(f"{corner}.begin.")]
            if axis == others[0]:
                total += _without_gaps(_corner_length(columns, corner, others))
    return total


def _corner_length(columns: Columns, corner: str, axes: Iterable[str]) -> Array:
    def apart(one: str, other: str) -> Array:
        steps = [columns[f"{corner}.{one}.{axis}"] - columns[f"{corner}.{other}.{axis}"] for axis in axes]
        found: Array = numpy.hypot(*steps)
        return found

    chord = apart("begin", "end")
    if not any(name.startswith(f"{corner}.center.") for name in columns):
        return chord
    radius = apart("begin", "center")
    with numpy.errstate(invalid="ignore", divide="ignore"):
        arc = 2 * radius * numpy.arcsin(numpy.minimum(chord / (2 * radius), 1.0))
    # A corner that is left out has no radius; of several kinds of rows, a chamfer has no centre.
    return numpy.where(radius > 0, arc, chord)


def _without_gaps(column: Array) -> Array:
    """A column with 0 for what a row does not have."""
    return numpy.where(numpy.isnan(column), 0.0, column)
