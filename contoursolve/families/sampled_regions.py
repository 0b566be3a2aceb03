"""The region of two words where each row alone tells how its block is read: rows on a grid are solved one by one, and
the lines between those with and without a contour are closed in on."""

from collections.abc import Mapping, Sequence

import numpy
from numpy.typing import NDArray

from contoursolve.families.evaluate import compile_sweep
from contoursolve.families.spec import Ranges, RefusedError, SweepSpec
from contoursolve.numeric import Array
from contoursolve.solving import Point, StatusCode

COUNT, BISECTIONS = 33, 16
"""Nodes of the grid along each word, and how often the way between two of them is halved: to a two-millionth of the
range. Some seconds."""

_REASONS = 256
"""More than there are reasons why a row has no contour."""


class SampledField:
    """Whether rows on a grid over a box of two words have a contour, and why not, each solved by itself: what
    `boundary_tracing.GridLines` needs of a field. `fixed` are the values of other words."""

    count, bisections = COUNT, BISECTIONS

    def __init__(
        self, spec: SweepSpec, words: Sequence[str], within: Sequence[Point], fixed: Mapping[str, float]
    ) -> None:
        self.spec, self.words, self.fixed = spec, words, fixed
        self.low, self.high = (numpy.array([each[side] for each in within]) for side in (0, 1))
        self.size = self.high - self.low
        self.axes = [numpy.linspace(low, high, self.count) for low, high in within]
        grid = numpy.meshgrid(*self.axes, indexing="ij")
        self.nodes = numpy.stack([each.ravel() for each in grid], axis=1)
        self.solved = 0
        """How many rows were solved."""
        self.is_inside = (self.failing(self.nodes) < 0).reshape(self.count, self.count)

    def failing(self, points: Array) -> NDArray[numpy.int64]:
        """A number of why each row has no contour; -1 where it has one."""
        if not len(points):
            return numpy.zeros(0, numpy.int64)
        self.solved += len(points)
        values = {name: numpy.full(len(points), value) for name, value in self.fixed.items()}
        ranges = Ranges(values | dict(zip(self.words, points.T, strict=True)), is_paired=True)
        try:
            ready = compile_sweep(self.spec, ranges)
        except RefusedError:
            return numpy.zeros(len(points), numpy.int64)
        table = ready.empty(len(points))
        ready.evaluate(0, len(points), table)
        status = table["status"].astype(numpy.int64)
        is_path = numpy.isin(status, (StatusCode.SOLVED, StatusCode.OVERDETERMINED))
        return numpy.where(is_path, -1, status * _REASONS + table["reason"])

    def onto(self, points: Array, _checks: NDArray[numpy.int64]) -> Array:
        """Nothing is known of zeros."""
        return numpy.full_like(points, numpy.nan)

    def corner(self, _start: Array, _one: int, _other: int) -> Array | None:
        """Nor of where two of them meet."""
        return None

    def share(self, vectors: Array) -> Array:
        """The length of vectors by (point, word) in shares of the box."""
        found: Array = (numpy.abs(vectors) / self.size).max(axis=1)
        return found
