"""Which kinds of rows a family has, by one example of each."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from math import prod

import numpy
from numpy.typing import NDArray

from contoursolve.backends.columns import Array
from contoursolve.families.kinds import Kind, alike, intervals_of, kind_of, limits_of
from contoursolve.families.ranges import FamilyError, Places, Ranges
from contoursolve.families.template import Template


@dataclass(frozen=True, slots=True)
class Examples:
    """One row of each kind that the rules may tell apart, as plain data.

    Each word has a scale and bounds: its values, scaled, lie between two bounds or on one, which gives a number;
    `rows` are the numbers of all words, with values that have them.
    """

    scales: tuple[float, ...]
    bounds: tuple[tuple[float, ...], ...]
    rows: tuple[tuple[tuple[int, ...], tuple[float, ...]], ...]

    def key(self, values: Sequence[Array], places: Sequence[Places]) -> NDArray[numpy.int64]:
        """The numbers of all words as one, row by row."""
        key = numpy.zeros(places[0].size, numpy.int64)
        for each, at, scale, bounds in zip(values, places, self.scales, self.bounds, strict=True):
            key = key * (2 * len(bounds) + 1) + intervals_of(each * scale, bounds)[at]
        return key


@dataclass(frozen=True, slots=True, eq=False)
class Kinds:
    """The kinds of rows of a family; `keys`, in order, are the keys of `Examples`, and `numbers` the kind of each."""

    template: Template
    items: tuple[Kind, ...]
    keys: NDArray[numpy.int64]
    numbers: NDArray[numpy.int64]


def examples_of(template: Template, ranges: Ranges) -> Examples:
    """A row for each set of intervals in which the values lie. Raises FamilyError."""
    scales, bounds = limits_of(template, {name: float(values[0]) for name, values in ranges.values.items()})
    if prod(2 * len(limits) + 1 for limits in bounds) >= 2**63:
        raise FamilyError(f"{len(bounds)} words are too many to vary at once")
    columns = [
        intervals_of(values * scale, limits)
        for values, scale, limits in zip(ranges.values.values(), scales, bounds, strict=True)
    ]
    rows: list[tuple[tuple[int, ...], tuple[float, ...]]] = []
    words = list(ranges.values.values())
    if ranges.is_paired:
        keys, firsts = numpy.unique(numpy.stack(columns, axis=1), axis=0, return_index=True)
        for key, row in zip(keys.tolist(), firsts.tolist(), strict=True):
            rows.append((tuple(key), tuple(float(values[row]) for values in words)))
    else:
        found = [
            zip(*(part.tolist() for part in numpy.unique(each, return_index=True)), strict=True) for each in columns
        ]
        for choice in product(*found):
            places = zip(words, (place for _, place in choice), strict=True)
            rows.append((tuple(int(number) for number, _ in choice), tuple(float(each[at]) for each, at in places)))
    return Examples(tuple(scales), tuple(bounds), tuple(rows))


def kinds_of(template: Template, examples: Examples) -> Kinds:
    """The kinds of the example rows. Raises FamilyError."""
    items: list[Kind] = []
    numbers: dict[int, int] = {}
    for parts, values in examples.rows:
        kind = kind_of(template, dict(zip(template.words, values, strict=True)))
        same = next((number for number, each in enumerate(items) if alike(each, kind)), None)
        key = 0
        for part, bounds in zip(parts, examples.bounds, strict=True):
            key = key * (2 * len(bounds) + 1) + part
        numbers[key] = len(items) if same is None else same
        if same is None:
            items.append(kind)
    ordered = sorted(numbers.items())
    return Kinds(
        template,
        tuple(items),
        numpy.array([key for key, _ in ordered], numpy.int64),
        numpy.array([number for _, number in ordered], numpy.int64),
    )


def weights_of(examples: Examples, ranges: Ranges) -> list[int]:
    """How many rows of a family are like each of the examples."""
    words = zip(ranges.values.values(), examples.scales, examples.bounds, strict=True)
    columns = [intervals_of(values * scale, bounds) for values, scale, bounds in words]
    if ranges.is_paired:
        counts: list[int] = numpy.unique(numpy.stack(columns, axis=1), axis=0, return_counts=True)[1].tolist()
        return counts
    many = [numpy.bincount(column).tolist() for column in columns]
    return [prod(each[part] for each, part in zip(many, parts, strict=True)) for parts, _ in examples.rows]
