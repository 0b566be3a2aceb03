"""Narrows boxes to what equations allow, by running the instructions of a CasADi function forwards and backwards.

Hull consistency: Benhamou, Goualard, Granvilliers and Puget (1999), Revising Hull and Box Consistency, ICLP.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import casadi
import numpy

from contoursolve.backends import intervals
from contoursolve.backends.intervals import Array, Intervals, constant, down, up
from contoursolve.backends.replay import Replay


class Narrower(Replay):
    """The instructions of a function, whose first `zeros` outputs must be zero and whose others not be negative."""

    def __init__(self, function: Any, zeros: int) -> None:
        super().__init__(function, intervals, constant)
        self._zeros = zeros
        self._backwards = [
            (_OF_TWO if second not in (-1, first) else _OF_ONE).get(function.instruction_id(target))
            for _, first, second, target in self._steps
        ]

    def narrowed(self, inputs: Sequence[Intervals], count: int) -> tuple[list[Intervals], Any]:
        """The inputs narrowed to what may satisfy the equations, and which of the boxes are not proven to be empty."""
        work = self._constants.copy()
        for source, target in self._inputs:
            work[target] = inputs[source]
        for operation, first, second, target in self._steps:
            work[target] = operation(work[first], work[second]) if second >= 0 else operation(work[first])
        is_empty = numpy.zeros(count, dtype=bool)
        for source, number in self._outputs:
            value = work[source]
            high = numpy.minimum(value.high, 0.0) if number < self._zeros else value.high
            work[source] = Intervals(numpy.maximum(value.low, 0.0), high)
            is_empty |= work[source].low > work[source].high
        for (_, first, second, target), backwards in zip(reversed(self._steps), reversed(self._backwards), strict=True):
            if backwards is None:
                continue
            if second not in (-1, first):
                work[first], work[second] = backwards(work[target], work[first], work[second])
            else:
                work[first] = backwards(work[target], work[first])
        found = list(inputs)
        for source, target in self._inputs:
            found[source] = work[target]
            is_empty |= found[source].low > found[source].high
        return found, ~is_empty


def _meet(a: Intervals, b: Intervals) -> Intervals:
    """What both allow; a bound that is not a number is none."""
    return Intervals(numpy.fmax(a.low, b.low), numpy.fmin(a.high, b.high))


def _add(z: Intervals, x: Intervals, y: Intervals) -> tuple[Intervals, Intervals]:
    return _meet(x, z - y), _meet(y, z - x)


def _subtract(z: Intervals, x: Intervals, y: Intervals) -> tuple[Intervals, Intervals]:
    return _meet(x, z + y), _meet(y, x - z)


def _multiply(z: Intervals, x: Intervals, y: Intervals) -> tuple[Intervals, Intervals]:
    return _quotient(x, z, y), _quotient(y, z, x)


def _divide(z: Intervals, x: Intervals, y: Intervals) -> tuple[Intervals, Intervals]:
    return _meet(x, z * y), _quotient(y, x, z)


def _quotient(x: Intervals, z: Intervals, y: Intervals) -> Intervals:
    """The part of x for which x * y = z may hold."""
    found = _meet(x, z * intervals.inverse(y))
    apart = (y.low < 0) & (y.high > 0) & ((z.low > 0) | (z.high < 0))
    if not apart.any():
        return found
    # Two half lines: from the larger of the negative quotients down, from the smaller of the positive ones up.
    nearest: Array = numpy.where(z.low > 0, z.low, z.high)
    below, above = nearest / y.low, nearest / y.high
    left, right = up(numpy.minimum(below, above)), down(numpy.maximum(below, above))
    low = numpy.where(apart & (x.low > left), numpy.fmax(x.low, right), found.low)
    high = numpy.where(apart & (x.high < right), numpy.fmin(x.high, left), found.high)
    return Intervals(low, high)


def _square(z: Intervals, x: Intervals) -> Intervals:
    outer, inner = up(numpy.sqrt(z.high)), numpy.maximum(down(numpy.sqrt(numpy.maximum(z.low, 0.0))), 0.0)
    low = numpy.fmax(x.low, numpy.where(x.low > -inner, inner, -outer))
    high = numpy.fmin(x.high, numpy.where(x.high < inner, -inner, outer))
    return Intervals(low, high)


def _negate(z: Intervals, x: Intervals) -> Intervals:
    return _meet(x, -z)


def _twice(z: Intervals, x: Intervals) -> Intervals:
    return _meet(x, Intervals(z.low / 2, z.high / 2))


def _invert(z: Intervals, x: Intervals) -> Intervals:
    return _meet(x, intervals.inverse(z))


_OF_TWO: Mapping[int, Callable[..., Any]] = {
    casadi.OP_ADD: _add,
    casadi.OP_SUB: _subtract,
    casadi.OP_MUL: _multiply,
    casadi.OP_DIV: _divide,
}
_OF_ONE: Mapping[int, Callable[..., Any]] = {
    casadi.OP_SQ: _square,
    casadi.OP_NEG: _negate,
    casadi.OP_TWICE: _twice,
    casadi.OP_INV: _invert,
}
"""What a result tells of its operands; an operation without an entry tells nothing."""
