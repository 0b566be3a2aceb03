"""Numbers of a contour as functions of one word: at many values at once, their derivatives, and bounds that hold for
whole ranges of values."""

from collections.abc import Mapping, Sequence
from math import pi
from typing import Any

import casadi
import numpy
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve.numeric.columns import ROW_FUNCTIONS
from contoursolve.numeric.expressions import Tape, cosine, sine, symbol
from contoursolve.numeric.given_angle import COSINE, SINE
from contoursolve.numeric.interpreter import Replay, run_steps
from contoursolve.numeric.intervals import FUNCTIONS as INTERVALS, Intervals, constant, down, up
from contoursolve.numeric.linear_algebra import Array

NO_ROOT = -1e-10
"""mm squared. A root's operand above this has a root: what touches by construction is off by rounding."""


class Following(Struct, frozen=True):
    """A value that is linear in the word: the mm or degrees for each unit of it."""

    factor: float
    is_angle: bool


class Bounds(Struct, frozen=True, eq=False):
    """Bounds of outputs over many cells, by (output, cell). The masks tell the cells in which every root, or no root,
    has a value for certain."""

    low: Array
    high: Array
    is_defined: NDArray[numpy.bool_]
    is_undefined: NDArray[numpy.bool_]
    is_smooth: NDArray[numpy.bool_]
    """Mask of the cells in which no output jumps."""

    def __getitem__(self, cells: NDArray[numpy.bool_]) -> "Bounds":
        rest = (self.is_defined[cells], self.is_undefined[cells], self.is_smooth[cells])
        return Bounds(self.low[:, cells], self.high[:, cells], *rest)


_JUMPING = (casadi.OP_SIGN, casadi.OP_EQ, casadi.OP_LE, casadi.OP_LT)
"""Instructions whose results are steps."""


_FLOATS = replace(ROW_FUNCTIONS, larger=numpy.maximum)
"""Of plain arrays; what has no value is NaN."""


class _Enclosure(Replay):
    """The instructions on intervals, and what roots are taken of."""

    def __init__(self, function: Any) -> None:
        super().__init__(function, INTERVALS, constant)
        kinds = {target: function.instruction_id(target) for *_, target in self._steps}
        self._roots = [first for _, first, _, target in self._steps if kinds[target] == casadi.OP_SQRT]
        self._jumps = [target for target, kind in kinds.items() if kind in _JUMPING]
        self._angles = [each[1:] for each in self._steps if kinds[each[3]] == casadi.OP_ATAN2]
        self._torn: list[tuple[int, int, int]] = []
        """What follows from results that may jump, these themselves included: operands and result."""
        torn = {*self._jumps, *(target for *_, target in self._angles)}
        for _, first, second, target in self._steps:
            if not torn.isdisjoint((first, second, target)):
                torn.add(target)
                self._torn.append((first, second, target))
        moving = {target for source, target in self._inputs if source == WORD}
        for _, first, second, target in self._steps:
            if first in moving or second in moving:
                moving.add(target)
        self._moving = [step for step in self._steps if step[3] in moving]
        self._still = [step for step in self._steps if step[3] not in moving]
        self._known: tuple[tuple[float, ...], list[Any]] = ((), [])
        """The inputs that stay, as they were last, and all that follows from them alone."""

    def bounds(self, cells: Intervals, fixed: Sequence[float]) -> Bounds:
        """Bounds of the outputs."""
        count = cells.low.size
        with numpy.errstate(all="ignore"):
            work = self._prepared(tuple(fixed)).copy()
            for source, target in self._inputs:
                if source == WORD:
                    work[target] = cells
            run_steps(self._moving, work)
        low, high = numpy.zeros((self._count, count)), numpy.zeros((self._count, count))
        for source, target in self._outputs:
            low[target], high[target] = work[source].low, work[source].high
        is_defined, is_undefined = numpy.ones(count, bool), numpy.zeros(count, bool)
        for place in self._roots:
            is_defined &= work[place].low >= NO_ROOT
            is_undefined |= work[place].high < NO_ROOT
        return Bounds(low, high, is_defined, is_undefined, is_defined & ~self._is_torn(work, count))

    def _is_torn(self, work: Sequence[Any], count: int) -> NDArray[numpy.bool_]:
        """Mask of the cells in which an output may jump: what is one number all the same, as a choice that is not
        taken, does not hand on the jump of what it follows from."""
        torn: dict[int, Any] = {place: work[place].low != work[place].high for place in self._jumps}
        for first, second, target in self._angles:
            torn[target] = ~((work[first].low > 0) | (work[first].high < 0) | (work[second].low > 0))
        found = numpy.zeros(count, bool)
        if not any(numpy.any(each) for each in torn.values()):
            return found
        for first, second, target in self._torn:
            own = torn.get(target, False) | torn.get(first, False) | torn.get(second, False)
            torn[target] = own & (work[target].low != work[target].high)
        for source, _ in self._outputs:
            found |= torn.get(source, False)
        return found

    def _prepared(self, fixed: tuple[float, ...]) -> list[Any]:
        """The places of all values, with those that follow from the inputs that stay."""
        known, work = self._known
        if known != fixed or not work:
            work = self._constants.copy()
            for source, target in self._inputs:
                if source != WORD:
                    work[target] = constant(fixed[source - 1])
            run_steps(self._still, work)
            self._known = fixed, work
        return work


WORD = 0
"""The place of the word among the inputs."""


class Chart:
    """Some outputs as functions of one word, at fixed values of the other inputs.

    `fixed` names those inputs; one that follows the word is what is added to it. With `is_rate` it is about the
    derivatives of the outputs in place of the outputs.
    """

    def __init__(
        self,
        tape: Tape,
        outputs: Mapping[str, Any],
        follows: Mapping[str, Following],
        *,
        is_rate: bool = False,
    ) -> None:
        word = symbol("word")
        added, inputs = dict[str, Any](), dict[str, Any]()
        for given, each in follows.items():
            added[given] = symbol(given)
            value = word * each.factor + added[given]
            if each.is_angle:
                turned = value * (pi / 180)
                inputs |= {given + COSINE: cosine(turned), given + SINE: sine(turned)}
            else:
                inputs[given] = value
        stay, expressions = tape.replaced(inputs, outputs)
        self.outputs = tuple(outputs)
        self.fixed = (*added, *(name for name in tape.inputs if name not in inputs))
        arguments = casadi.vertcat(*(each.sx for each in (word, *added.values(), *stay)))
        values = casadi.SX(casadi.vertcat(*(each.sx for each in expressions)))
        if is_rate:
            values = casadi.SX(casadi.densify(casadi.jacobian(values, word.sx)))
        slopes = casadi.densify(casadi.jacobian(values, word.sx))
        self._function = casadi.Function("chart", [arguments], [casadi.cse(casadi.densify(values))])
        self._derivative = casadi.Function("slopes", [arguments], [casadi.cse(slopes)])
        self.is_quadratic = [not each for each in casadi.which_depends(slopes, word.sx, 2, True)]
        """Outputs that are polynomials of degree 2 at most in the word."""
        self._values = Replay(self._function, _FLOATS, numpy.float64)
        self._slopes = Replay(self._derivative, _FLOATS, numpy.float64)
        self._enclosure = _Enclosure(self._function)
        self._steepness: _Enclosure | None = None

    def at(self, word: Array, fixed: Sequence[float]) -> Array:
        """The outputs at these values of the word, by (output, place)."""
        return _run(self._values, word, fixed)

    def slopes_at(self, word: Array, fixed: Sequence[float]) -> Array:
        """The derivatives of the outputs by the word, by (output, place)."""
        return _run(self._slopes, word, fixed)

    def between(self, cells: Intervals, fixed: Sequence[float]) -> Bounds:
        """Bounds of the outputs in cells of the word."""
        return self._enclosure.bounds(cells, fixed)

    def narrowed(self, bounds: Bounds, cells: Intervals, fixed: Sequence[float]) -> Bounds:
        """The bounds narrowed by the mean value theorem, where nothing jumps: about the middle of each cell, by the
        derivatives in it. It takes twice as long as the bounds themselves."""
        middle = cells.low / 2 + cells.high / 2
        center, slopes = self.between(Intervals(middle, middle), fixed), self.slopes_between(cells, fixed)
        with numpy.errstate(all="ignore"):
            away = Intervals(down(cells.low - middle), up(cells.high - middle))
            found = Intervals(center.low, center.high) + Intervals(slopes.low, slopes.high) * away
        usable = bounds.is_smooth & numpy.isfinite(found.low) & numpy.isfinite(found.high)
        low = numpy.where(usable, numpy.fmax(bounds.low, found.low), bounds.low)
        high = numpy.where(usable, numpy.fmin(bounds.high, found.high), bounds.high)
        return Bounds(low, high, bounds.is_defined, bounds.is_undefined, bounds.is_smooth)

    def slopes_between(self, cells: Intervals, fixed: Sequence[float]) -> Bounds:
        """Bounds of the derivatives, by (output, cell)."""
        if self._steepness is None:
            self._steepness = _Enclosure(self._derivative)
        return self._steepness.bounds(cells, fixed)


def _run(replay: Replay, word: Array, fixed: Sequence[float]) -> Array:
    with numpy.errstate(all="ignore"):
        found = replay([word, *map(numpy.float64, fixed)])
    return numpy.stack([numpy.broadcast_to(numpy.asarray(each, dtype=float), word.size) for each in found])
