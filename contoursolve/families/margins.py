"""What must hold of a contour as numbers that depend on words: the margins of its checks, zero where one fails."""

from dataclasses import dataclass
from functools import lru_cache

import numpy
from numpy.typing import NDArray

from contoursolve.backends.chart import Bounds, Chart
from contoursolve.backends.intervals import Array
from contoursolve.constraints import System
from contoursolve.families.kinds import Follows
from contoursolve.solving.checks import Check, Role, Test, compile_checks
from contoursolve.solving.compile import compile_system

_ROLES = (Role.CONTOUR, Role.FACT)
"""Checks that tell whether there is a contour."""


@dataclass(frozen=True, slots=True, eq=False)
class Margins:
    """All checks of a system in their order, and their margins as functions of the free words."""

    checks: tuple[Check, ...]
    chart: Chart

    @property
    def limits(self) -> Array:
        """The limits by check, as a column."""
        return numpy.array([[each.limit] for each in self.checks])

    @property
    def is_apart(self) -> NDArray[numpy.bool_]:
        """Which checks are about being apart from zero, as a column."""
        return numpy.array([[each.test is Test.APART] for each in self.checks])

    def failing(self, values: Array) -> NDArray[numpy.bool_]:
        """Which checks fail, by (check, place). NaN fails, and a margin that is just at its limit passes, whatever the
        test says of these: ends are looked at by single solves."""
        size = numpy.where(self.is_apart, numpy.abs(values), values)
        return ~numpy.where(self.is_apart, size > self.limits, size >= self.limits)

    def first_failing(self, values: Array) -> NDArray[numpy.int64]:
        """The number of the first check that fails, place by place; -1 where none does."""
        fails = self.failing(values)
        found: NDArray[numpy.int64] = numpy.where(fails.any(axis=0), fails.argmax(axis=0), -1)
        return found

    def verdicts(
        self, bounds: Bounds, is_level: NDArray[numpy.bool_]
    ) -> tuple[NDArray[numpy.bool_], NDArray[numpy.bool_]]:
        """In which boxes all checks are passed for certain, and in which one of them fails everywhere; `is_level` are
        the margins that are zero everywhere."""
        limits, is_apart = self.limits, self.is_apart
        bounds.low[is_level], bounds.high[is_level] = 0.0, 0.0
        passes = bounds.low >= limits
        passes = numpy.where(is_apart, (bounds.low > limits) | (bounds.high < -limits), passes)
        fails = numpy.where(is_apart, numpy.maximum(-bounds.low, bounds.high) <= limits, bounds.high < limits)
        return passes.all(axis=0) & bounds.is_defined, fails.any(axis=0) | bounds.is_undefined


@lru_cache(maxsize=256)
def compile_margins(system: System, words: int, follows: Follows) -> Margins:
    """The margins of a system that has a closed form as functions of some words."""
    checked = compile_checks(system)
    kept = {number: check for number, check in enumerate(checked.checks) if check.role in _ROLES}
    outputs = {str(number): checked.margins[number] for number in kept}
    return Margins(tuple(kept.values()), Chart(checked.tape, outputs, words, dict(follows)))


@lru_cache(maxsize=256)
def compile_results(
    system: System, words: int, follows: Follows, names: tuple[str, ...], *, is_rate: bool = False
) -> Chart:
    """Some outputs of a system, or their derivatives by the first word, as functions of some words."""
    tape = compile_system(system).tape
    return Chart(tape, {name: tape.expression(name) for name in names}, words, dict(follows), is_rate=is_rate)
