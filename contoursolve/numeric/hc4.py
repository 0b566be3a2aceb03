"""Narrows boxes to what equations allow, forwards and backwards through a CasADi function, one or many at once."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import casadi
import numpy
from msgspec import Struct
from numpy.typing import NDArray

from contoursolve.numeric import intervals
from contoursolve.numeric.interpreter import Replay
from contoursolve.numeric.intervals import Intervals, constant, down, up
from contoursolve.numeric.linear_algebra import Array


class Narrower(Replay):
    """The instructions of a function, whose first `zeros` outputs must be zero and whose others not be negative."""

    def __init__(self, function: Any, zeros: int) -> None:
        super().__init__(function, intervals.FUNCTIONS, constant)
        self._zeros = zeros
        self._backwards = [
            (_OF_TWO if second not in (-1, first) else _OF_ONE).get(function.instruction_id(target))
            for _, first, second, target in self._steps
        ]

    def narrowed(self, inputs: Sequence[Intervals], count: int) -> tuple[list[Intervals], Any]:
        """The inputs narrowed to what may satisfy the equations, and which of the boxes are not proven to be empty."""
        work = self.values(inputs)
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
    """The intersection of intervals; a bound that is not a number is none."""
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
"""Inverses of operations: from a result to its operands; an operation without an entry tells nothing of them."""


EPSILON = 2.0**-52
"""1. Relative distance of two doubles, twice the rounding of one operation."""

TINY = 1e-290
"""Bound of what underflow can lose."""

OUTWARD = 2.0**-7
"""1. By how much of its width a box is inflated before the test: a solution on its edge, where it was divided, is
inside then."""

TILT = 2.0**-30
"""1. By how much a singular matrix is changed before it is inverted."""

ARRIVED = 2.0**-30
"""1. Newton's method has arrived where its last step is a smaller share of the coordinates."""

FAR, PLACES = 1e9, 6
"""mm, and the decimals to which two places where it arrived are the same."""


class Boxes(Struct, frozen=True):
    """Lower and upper bounds by box and unknown, and for each box the number of the case that it belongs to: systems
    of the same equations with other values for what is known."""

    low: Array
    high: Array
    case: NDArray[numpy.intp]

    def __len__(self) -> int:
        return len(self.low)

    def __getitem__(self, chosen: Any) -> "Boxes":
        return Boxes(self.low[chosen], self.high[chosen], self.case[chosen])

    @property
    def middle(self) -> "Boxes":
        """The points in the middle."""
        points = self.low / 2 + self.high / 2
        return Boxes(points, points, self.case)

    def inputs(self, known: Sequence[Intervals]) -> list[Intervals]:
        """The bounds of all boxes for each unknown, and then of what is known, which is given by case."""
        unknown = [Intervals(low, high) for low, high in zip(self.low.T, self.high.T, strict=True)]
        return unknown + [Intervals(each.low[self.case], each.high[self.case]) for each in known]


class Contraction(Struct, frozen=True):
    """Boxes that hold all solutions that there were, whether each is proven to hold exactly one, and how large the
    slopes are in it at most, by equation and unknown."""

    boxes: Boxes
    is_proven: Any
    slopes: Array


def stacked(columns: Sequence[Intervals], case: NDArray[numpy.intp]) -> Boxes:
    """Boxes from the bounds for each unknown."""
    low, high = (numpy.empty((len(case), len(columns))) for _ in range(2))
    for number, each in enumerate(columns):
        low[:, number], high[:, number] = each.low, each.high
    return Boxes(low, high, case)


def joined(parts: Sequence[Boxes]) -> Boxes:
    """All boxes together."""
    return Boxes(*(numpy.concatenate([getattr(each, name) for each in parts]) for name in ("low", "high", "case")))


def contract(equations: Replay, boxes: Boxes, known: Sequence[Intervals], margin: float) -> Contraction:
    """The boxes narrowed; those without a solution are left out.

    `equations` gives the equations and their derivatives row by row, at the unknowns and then what is `known`,
    each by case. The test is made with boxes that are larger by `margin`, a share of the coordinates.
    """
    count, size = boxes.low.shape
    size_of = numpy.maximum(1.0, numpy.maximum(numpy.abs(boxes.low), numpy.abs(boxes.high)))
    wider = OUTWARD * (boxes.high - boxes.low) + margin * size_of
    outer = Boxes(boxes.low - wider, boxes.high + wider, boxes.case)
    middle = outer.middle.low
    slopes = stacked(equations(outer.inputs(known))[size:], boxes.case)
    residuals = stacked(equations(outer.middle.inputs(known))[:size], boxes.case)
    at, off = _middle_and_radius(slopes.low, slopes.high)
    at, off = at.reshape(count, size, size), off.reshape(count, size, size)
    value, error = _middle_and_radius(residuals.low, residuals.high)
    usable: Any = numpy.isfinite(at + off).all(axis=(1, 2)) & numpy.isfinite(value + error).all(axis=1)
    at, off = numpy.where(usable[:, None, None], at, 0.0), numpy.where(usable[:, None, None], off, 0.0)
    value, error = numpy.where(usable[:, None], value, 0.0), numpy.where(usable[:, None], error, 0.0)
    weights = _inverses(at)
    matrix, spread = _product(weights, at, off)
    shift, doubt = (each[:, :, 0] for each in _product(weights, value[:, :, None], error[:, :, None]))
    reach = numpy.maximum(up(middle - outer.low), up(outer.high - middle))
    # Krawczyk: middle - Y f(middle) + (I - Y F'(box)) (box - middle).
    defect = numpy.abs(numpy.eye(size) - matrix) * (1 + 4 * EPSILON) + spread
    radius = ((defect @ reach[:, :, None])[:, :, 0] + doubt) * (1 + 8 * size * EPSILON)
    radius += 8 * EPSILON * (numpy.abs(shift) + numpy.abs(middle)) + TINY
    image = Boxes(middle - shift - radius, middle - shift + radius, boxes.case)
    is_proven: Any = usable & ((image.low > outer.low) & (image.high < outer.high)).all(axis=1)
    narrowed = _swept(boxes, middle, (matrix, spread), (shift, doubt))
    kept = (
        numpy.where(usable[:, None], narrowed.low, boxes.low),
        numpy.where(usable[:, None], narrowed.high, boxes.high),
    )
    low = numpy.where(is_proven[:, None], image.low, kept[0])
    high = numpy.where(is_proven[:, None], image.high, kept[1])
    meets: Any = ((kept[0] <= kept[1]) & (low <= boxes.high) & (high >= boxes.low)).all(axis=1)
    sizes = numpy.maximum(numpy.abs(slopes.low), numpy.abs(slopes.high)).reshape(count, size, size)
    return Contraction(Boxes(low, high, boxes.case)[meets], is_proven[meets], sizes[meets])


def approach(equations: Replay, starts: Boxes, known: Sequence[Intervals], steps: int) -> Boxes:
    """Limits of Newton's method from many points at once, where it converges: each once, nothing proven."""
    if not len(starts):
        return starts
    size = starts.low.shape[1]
    points, moved = starts.low, numpy.full_like(starts.low, numpy.inf)
    for _ in range(steps):
        found = stacked(equations(Boxes(points, points, starts.case).inputs(known)), starts.case)
        values = numpy.where(numpy.isfinite(found.low), found.low, 0.0)
        inverses = _inverses(values[:, size:].reshape(-1, size, size))
        moved = (inverses @ values[:, :size, None])[:, :, 0]
        points = points - moved
    has_arrived: Any = numpy.abs(moved) < ARRIVED * numpy.maximum(1.0, numpy.abs(points))
    has_arrived = has_arrived.all(axis=1) & (numpy.abs(points) < FAR).all(axis=1)
    ends = Boxes(points, points, starts.case)[has_arrived]
    places = numpy.column_stack([numpy.round(ends.low, PLACES), ends.case])
    return ends[numpy.sort(numpy.unique(places, axis=0, return_index=True)[1])]


def _swept(boxes: Boxes, middle: Array, matrix: tuple[Array, Array], shift: tuple[Array, Array]) -> Boxes:
    """The boxes narrowed by each equation in turn: shift + matrix (x - middle) = 0, each a middle and a radius."""
    low, high = boxes.low.copy(), boxes.high.copy()
    for number in range(low.shape[1]):
        about, reach = _middle_and_radius(down(low - middle), up(high - middle))
        row, spread = matrix[0][:, number].copy(), matrix[1][:, number].copy()
        lead, give = row[:, number].copy(), spread[:, number].copy()
        row[:, number] = spread[:, number] = 0.0
        total = shift[0][:, number] + (row * about).sum(axis=1)
        radius = shift[1][:, number] + (numpy.abs(row) * reach + spread * (numpy.abs(about) + reach)).sum(axis=1)
        size = numpy.abs(shift[0][:, number]) + radius + (numpy.abs(row) * numpy.abs(about)).sum(axis=1)
        radius += 4 * (low.shape[1] + 3) * EPSILON * size + TINY
        divisor = Intervals(down(lead - give), up(lead + give))
        step = Intervals(down(total - radius), up(total + radius)) / divisor
        there = Intervals(middle[:, number], middle[:, number]) - step
        low[:, number] = numpy.maximum(low[:, number], there.low)
        high[:, number] = numpy.minimum(high[:, number], there.high)
    return Boxes(low, high, boxes.case)


def _middle_and_radius(low: Array, high: Array) -> tuple[Array, Array]:
    middle = low / 2 + high / 2
    return middle, numpy.maximum(up(middle - low), up(high - middle))


def _product(weights: Array, middle: Array, radius: Array) -> tuple[Array, Array]:
    """Middle and radius of a product of matrices, with what rounding may add."""
    magnitude = numpy.abs(weights)
    rounding = 4 * (weights.shape[-1] + 2) * EPSILON * (magnitude @ (numpy.abs(middle) + radius))
    return weights @ middle, magnitude @ radius + rounding + TINY


def _inverses(matrices: Array) -> Array:
    """Something near the inverse of each matrix; any numbers are good enough for a proof."""
    size = matrices.shape[-1]
    largest = numpy.maximum(numpy.abs(matrices).max(axis=(1, 2), keepdims=True), TINY)
    pattern = numpy.sin(1.0 + numpy.arange(size * size)).reshape(size, size)
    for tilted in (matrices, matrices + TILT * largest * pattern):
        try:
            found = numpy.linalg.inv(tilted)
        except numpy.linalg.LinAlgError:
            continue
        return numpy.where(numpy.isfinite(found).all(axis=(1, 2), keepdims=True), found, 0.0)
    return numpy.zeros_like(matrices)
