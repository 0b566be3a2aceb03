"""CasADi's root finder made trustworthy: whatever it reports, the original equations decide.

CasADi's `newton` reports success with NaN at a singular Jacobian, and with a point that is no root at a
redundant system. Its status is therefore never read. Each point that a search proposes is polished by
Newton's method, its residuals are computed anew, and it counts only if no residual exceeds what rounding
explains. CasADi's `kinsol` is not asked: it found no root of the classical systems that the others had
missed, and its line search never returns once a step is infinite, as from (1e-300, ..., 1e-300) for the
square root of a 2x2 Jordan block.

What rounding explains comes from running error analysis (Higham, Accuracy and Stability of Numerical
Algorithms, 2nd ed., SIAM 2002, section 3.3): the instructions of the residuals are replayed, and each
passes on the errors of its operands, times its slopes, plus its own rounding.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import Any

import casadi
import numpy
from numpy.typing import NDArray

Vector = NDArray[numpy.float64]
Matrix = NDArray[numpy.float64]

EPSILON = 2.0**-52
"""1. Relative distance of two doubles, twice the rounding of one operation."""

SAFETY = 4.0
"""1. Residuals up to this many times the running error bound count as zero. The bound is of first
order and takes elementary functions for correctly rounded; theirs are within 2 EPSILON."""

SIGNIFICANT = 1e-3
"""1. No residual above this share of its equation's size counts as zero, however large its rounding. The
size is the smaller of those near the values and near zero, a scale away. That keeps poles from passing
for roots (at x = 1e-16, one rounding of x changes 1/x - 5 by more than its value), and points so far
out that the equation's constants drown in rounding."""

NEARBY = (1.0, -1.0, 2.0**-6, -(2.0**-6))
"""1. How far away the size of an equation is sampled, in scales of the unknowns."""

GOLDEN = (5.0**0.5 - 1.0) / 2.0
"""1. Its multiples' fractions give the direction of those samples, one that no equation is made for."""

LARGEST_DAMPING = 1e100
"""1. Damping beyond which no step is left."""

SEARCH_STEPS = 500
"""1. Steps of our own searches; a singular root takes about 50, a curved valley up to 200."""

CURVE_STEPS = 200
"""1. Points of a curve: at the classical systems, no further ones lead to a root."""

CURVE_POLISH_STEPS = 20
"""1. Newton steps tried from each point of a curve, as long as they help."""

CORRECTIONS = 6
"""1. Newton steps from a tangent back to its curve; each is at most half as long as the one before."""

SHORTEST = 1e-8
"""1. Steps along a curve that must be shorter than this, in scales, end the search."""

TINY = 1e-300
"""1. Stands for zero in a divisor; an equation that is smaller all around vanishes by underflow only."""

POLISH_STEPS = 100
"""1. Newton steps at the end, as long as they help: two do at a regular root, 50 at a singular one."""

SETTINGS = {"line_search": True, "max_iter": 100, "error_on_fail": False, "show_eval_warnings": False}
"""Of CasADi's newton. It can neither abort nor print."""


@dataclass(frozen=True, slots=True)
class Root:
    """Where a search ended, and what the equations say of it."""

    values: tuple[float, ...]
    """The unknowns, in their own units; NaN if no finder left the numbers."""
    residual: float
    """Largest absolute residual of the original equations, in their units; infinite or NaN if one is."""
    is_regular: bool
    """Whether the Jacobian has full rank at the values and at all points that rounding cannot tell from
    them. A root that is not regular may be off by far more than its residual: by 1e-8 at a tangency."""
    is_found: bool
    """Whether the values are finite, and each residual is explained by rounding the unknowns to
    `EPSILON` of their size or scale, and by rounding in its evaluation."""


@dataclass(frozen=True, slots=True)
class _State:
    """The equations at one point."""

    values: Vector
    residuals: Vector
    tolerances: Vector
    jacobian: Matrix

    @property
    def excess(self) -> float:
        """Largest residual, counted in its tolerance; infinite if it is not a number."""
        shares = numpy.abs(self.residuals) / self.tolerances
        shares[(self.residuals == 0.0) & (self.tolerances == 0.0)] = 0.0
        worst = float(shares.max(initial=0.0))
        return float("inf") if numpy.isnan(worst) else worst

    @property
    def largest(self) -> float:
        """Largest absolute residual; NaN if one is."""
        return float(numpy.abs(self.residuals).max())

    @property
    def is_finite(self) -> bool:
        return bool(
            numpy.isfinite(self.values).all()
            and numpy.isfinite(self.residuals).all()
            and numpy.isfinite(self.jacobian).all()
        )


class RootFinder:
    """Searches a root of n equations in n unknowns, compiled once; the same guess gives the same root.

    The order of attempts: CasADi's newton with line search, Levenberg-Marquardt, a continuation from the
    guess, and Newton's method at full length. The first that ends in a root is taken; if none does, the
    point with the smallest of the largest residuals.

    >>> x, y = casadi.SX.sym("x"), casadi.SX.sym("y")
    >>> root = RootFinder([x**2 + y**2 - 25.0, x - y - 1.0], [x, y])([10.0, 1.0])
    >>> root.values, root.is_regular, root.is_found
    ((4.0, 3.0), True, True)
    """

    def __init__(
        self,
        residuals: Sequence[Any],
        unknowns: Sequence[Any],
        parameters: Sequence[Any] = (),
        scale: float | Sequence[float] = 1.0,
    ) -> None:
        """Residuals are SX expressions of unknowns and parameters (SX symbols).

        `scale` is the typical size of the unknowns, or of each, in their units: an unknown is not told
        from zero below `EPSILON` times its scale. ValueError if the system is not square.
        """
        if len(residuals) != len(unknowns) or not unknowns:
            raise ValueError(f"{len(residuals)} residuals for {len(unknowns)} unknowns; as many are needed")
        self._scale = numpy.broadcast_to(numpy.asarray(scale, dtype=float), (len(unknowns),))
        if not (numpy.isfinite(self._scale).all() and (self._scale > 0.0).all()):
            raise ValueError(f"scale {scale} is not positive")
        self._parameter_count = len(parameters)
        x, p = casadi.vertcat(*unknowns), casadi.vertcat(casadi.SX(0, 1), *parameters)
        r = casadi.densify(casadi.vertcat(*residuals))
        rounding = casadi.SX.sym("rounding", len(unknowns))
        function = casadi.Function("residuals", [x, p], [r])
        errors = casadi.densify(_running_errors(function, x, p, rounding))
        self._residuals = function
        self._all = casadi.Function("all", [x, p, rounding], [r, errors, casadi.densify(casadi.jacobian(r, x))])
        self._newton = None
        if casadi.sprank(casadi.jacobian(r, x)) == len(unknowns):  # CasADi refuses others
            self._newton = casadi.rootfinder("newton", "newton", {"x": x, "p": p, "g": r}, SETTINGS)

    def quick(self, guess: Sequence[float], parameters: Sequence[float] = ()) -> Root:
        """The root that CasADi's Newton method alone ends in, or where it came, not found; for many guesses."""
        return self._from(guess, parameters, 1)

    def __call__(self, guess: Sequence[float], parameters: Sequence[float] = ()) -> Root:
        """The root that the search from a guess ends in, or where it came closest, not found.

        ValueError if guess or parameters have the wrong length; a search that fails raises nothing.
        """
        return self._from(guess, parameters, None)

    def _from(self, guess: Sequence[float], parameters: Sequence[float], attempts: int | None) -> Root:
        if len(guess) != len(self._scale) or len(parameters) != self._parameter_count:
            raise ValueError(
                f"{len(guess)} numbers guessed for {len(self._scale)} unknowns, "
                f"{len(parameters)} given for {self._parameter_count} parameters"
            )
        system = _System(self._residuals, self._all, self._scale, numpy.asarray(parameters, dtype=float))
        with numpy.errstate(all="ignore"):  # what overflows is not finite, and so not found
            best = system.at(numpy.asarray(guess, dtype=float))
            for state in islice(self._searched(system, best), attempts):
                if state.excess <= 1.0:
                    best = state
                    break
                if state.is_finite and not best.largest <= state.largest:
                    best = state
            return Root(
                values=tuple(best.values.tolist()),
                residual=best.largest,
                is_regular=system.is_regular(best),
                is_found=bool(
                    numpy.isfinite(best.values).all() and (numpy.abs(best.residuals) <= best.tolerances).all()
                ),
            )

    def _searched(self, system: "_System", guess: _State) -> Iterator[_State]:
        """Where each search ends, polished."""
        start = system.start(guess)
        searches: list[Callable[[Vector], Vector]] = [system.levenberg_marquardt, system.continuation, system.newton]
        if self._newton is not None:
            searches.insert(0, partial(system.proposed, self._newton))
        for search in searches:
            try:
                yield system.polished(search(start))
            except (RuntimeError, numpy.linalg.LinAlgError):  # CasADi's, numpy's
                continue  # a failed search is no error: others follow


def finder_of(function: Any, size: int) -> RootFinder:
    """A finder for a CasADi function of one vector, whose first `size` inputs are the unknowns, the others
    parameters, and whose first `size` outputs are the residuals."""
    symbols = [casadi.SX.sym(f"x{number}") for number in range(function.numel_in(0))]
    outputs = function(casadi.vertcat(*symbols))
    return RootFinder([outputs[row] for row in range(size)], symbols[:size], symbols[size:])


class _System:
    """The equations with their parameters, and the searches that CasADi lacks."""

    def __init__(self, residuals: Any, everything: Any, scale: Vector, parameters: Vector) -> None:
        self._residuals = residuals
        self._all = everything
        self.scale = scale
        self.parameters = parameters
        order = numpy.arange(1, len(scale) + 1)
        self._direction = scale * (0.5 + order * GOLDEN % 1.0) * (-1.0) ** order
        usual = self._sizes(numpy.zeros(len(scale)))
        self._usual_sizes = numpy.where(usual == 0.0, numpy.inf, usual)

    def _sizes(self, values: Vector) -> Vector:
        """Largest absolute residual of each equation in samples near the values; zero where none is finite."""
        sizes = numpy.zeros(len(values))
        for step in NEARBY:
            near = self._residuals(values + step * self._direction, self.parameters).full().ravel()
            sizes = numpy.fmax(sizes, numpy.where(numpy.isfinite(near), numpy.abs(near), 0.0))
        return sizes

    def at(self, values: Vector) -> _State:
        """Residuals, tolerances and Jacobian at the values."""
        rounding = EPSILON * numpy.maximum(numpy.abs(values), self.scale)
        residuals, errors, jacobian = (part.full() for part in self._all(values, self.parameters, rounding))
        sizes = self._sizes(values)
        explained = numpy.where(numpy.isnan(errors), 0.0, SAFETY * errors).ravel()
        tolerances = numpy.minimum(explained, SIGNIFICANT * numpy.minimum(sizes, self._usual_sizes))
        tolerances[sizes < TINY] = numpy.nan  # underflow: exp(x) has no root at x = -1000
        return _State(values, residuals.ravel(), tolerances, jacobian)

    def start(self, state: _State) -> Vector:
        """The values, or the closest sample near them where the equations have finite values and slopes."""
        for step in (0.0, *sorted(NEARBY, key=abs)):
            near: Vector = state.values + step * self._direction
            if self.at(near).is_finite:
                return near
        return state.values

    def step(self, state: _State) -> Vector:
        """Newton's step, the shortest one where it is not unique, in the unknowns' units."""
        rows = _row_sizes(state.jacobian * self.scale)
        matrix = state.jacobian * self.scale / rows[:, None]
        step: Vector = -self.scale * numpy.linalg.lstsq(matrix, state.residuals / rows, rcond=None)[0]
        return step

    def polished(self, values: Vector, steps: int = POLISH_STEPS) -> _State:
        """The state at the values, after Newton steps for as long as they bring the residuals down."""
        state = self.at(values)
        for _ in range(steps):
            if not state.is_finite or state.excess == 0.0:
                break
            following = self.at(state.values + self.step(state))
            if not following.excess < state.excess:
                break
            state = following
        return state

    def proposed(self, finder: Any, start: Vector) -> Vector:
        """Where a finder of CasADi ends."""
        return numpy.asarray(finder(start, self.parameters), dtype=float).ravel()

    def levenberg_marquardt(self, start: Vector) -> Vector:
        """Damped Gauss-Newton steps on the sum of squares.

        The damping follows H. B. Nielsen, Damping Parameter in Marquardt's Method, IMM-REP-1999-05
        (1999); the unknowns are scaled as in J. J. More, The Levenberg-Marquardt Algorithm:
        Implementation and Theory, LNM 630 (1978), the rows by their size at the start.
        """
        state = self.at(start)
        if not state.is_finite:
            return start
        rows = _row_sizes(state.jacobian * self.scale)
        columns = numpy.zeros(len(start))
        damping, growth = 1e-3, 2.0
        for _ in range(SEARCH_STEPS):
            if state.excess <= 1.0:
                break
            matrix, wanted = state.jacobian / rows[:, None], state.residuals / rows
            columns = numpy.maximum(columns, numpy.linalg.norm(matrix, axis=0))
            columns[columns == 0.0] = 1.0
            damped = numpy.vstack([matrix / columns, numpy.sqrt(damping) * numpy.eye(len(start))])
            step = numpy.linalg.lstsq(damped, numpy.concatenate([-wanted, 0.0 * wanted]), rcond=None)[0]
            trial = self.at(state.values + step / columns)
            cost = float(wanted @ wanted)
            predicted = cost - float(numpy.sum((matrix / columns @ step + wanted) ** 2))
            gained = cost - float(numpy.sum((trial.residuals / rows) ** 2)) if trial.is_finite else -numpy.inf
            if gained > 0.0 and predicted > 0.0:
                damping *= max(1.0 / 3.0, 1.0 - (2.0 * gained / predicted - 1.0) ** 3)
                state, growth = trial, 2.0
            else:
                damping, growth = damping * growth, growth * 2.0
            if damping > LARGEST_DAMPING:
                break
        return state.values

    def newton(self, start: Vector) -> Vector:
        """Full Newton steps, uphill too: they leave local minima that no descent leaves."""
        state = self.at(start)
        for _ in range(SEARCH_STEPS):
            if not state.is_finite or state.excess <= 1.0:
                break
            state = self.at(state.values + self.step(state))
        return state.values

    def continuation(self, start: Vector) -> Vector:
        """Follows the curve on which the residuals keep their ratios, around its folds, past local minima.

        Global Newton method with a predictor along the tangent and a corrector by the shortest Newton
        steps (E. L. Allgower and K. Georg, Numerical Continuation Methods, Springer 1990, chapter 3). Newton's
        method is tried from every point of the curve.
        """
        state = self.at(start)
        size = float(numpy.linalg.norm(state.residuals))
        if not state.is_finite or size == 0.0:
            return start
        ratios, length = state.residuals / size, 1.0 / 8.0
        heading = numpy.zeros(len(start) + 1)
        heading[-1] = -1.0  # towards smaller residuals
        for _ in range(CURVE_STEPS):
            scales = numpy.append(numpy.maximum(numpy.abs(state.values), self.scale), max(abs(size), TINY))
            tangent = numpy.linalg.svd(self._along(state, ratios, scales)[0])[2][-1]
            tangent *= numpy.copysign(1.0, tangent @ (heading / scales))
            reached = self._corrected(state.values, size, scales * tangent * length, ratios, scales)
            if reached is None:
                length /= 2.0
                if length < SHORTEST:
                    break
                continue
            state, size = reached
            heading = scales * tangent
            length = min(2.0 * length, 1.0)
            root = self.polished(state.values, steps=CURVE_POLISH_STEPS)
            if root.excess <= 1.0:
                return root.values
        return state.values

    @staticmethod
    def _along(state: _State, ratios: Vector, scales: Vector) -> tuple[Matrix, Vector]:
        """Derivative of residuals - size * ratios by the unknowns and the size, in scales, and its rows' sizes."""
        matrix = numpy.column_stack([state.jacobian, -ratios]) * scales
        rows = _row_sizes(matrix)
        return matrix / rows[:, None], rows

    def _corrected(
        self, values: Vector, size: float, step: Vector, ratios: Vector, scales: Vector
    ) -> tuple[_State, float] | None:
        """The point of the curve near the end of a step, and the size of its residuals; None if too far."""
        values, size = values + step[:-1], size + float(step[-1])
        allowed = float(numpy.linalg.norm(step / scales)) / 2.0
        for _ in range(CORRECTIONS):
            state = self.at(values)
            if not state.is_finite:
                return None
            matrix, rows = self._along(state, ratios, scales)
            change = -numpy.linalg.lstsq(matrix, (state.residuals - size * ratios) / rows, rcond=None)[0]
            moved = float(numpy.linalg.norm(change))
            if not moved <= allowed:
                return None
            values, size = values + scales[:-1] * change[:-1], size + float(scales[-1] * change[-1])
            allowed = moved / 2.0
            if moved < SHORTEST:
                break
        state = self.at(values)
        return (state, size) if state.is_finite else None

    def is_regular(self, state: _State) -> bool:
        """Whether the Jacobian has full rank throughout the region that the tolerances leave open.

        Rows are counted in tolerances and columns in scales, so that 1/(smallest singular value) is how
        far, in scales, the unknowns can move unnoticed along its vector. There the Jacobian must
        still be closer to that at the values than half the way to a singular one.
        """
        if not state.is_finite or not (state.tolerances > 0.0).all():
            return False
        matrix = state.jacobian * self.scale / state.tolerances[:, None]
        if not numpy.isfinite(matrix).all():
            return False
        left, sizes, right = numpy.linalg.svd(matrix)
        if not sizes[-1] > len(sizes):  # no farther than a scale; also what rounding leaves of an exact zero
            return False
        reach = right[-1] * self.scale * numpy.sqrt(len(sizes)) / sizes[-1]
        for moved in (self.at(state.values + reach), self.at(state.values - reach)):
            change = (moved.jacobian - state.jacobian) * self.scale / state.tolerances[:, None]
            share = numpy.linalg.norm((left.T @ change) / sizes[:, None]) if moved.is_finite else numpy.inf
            if not share < 1.0 / 2.0:
                return False
        return True


def _row_sizes(matrix: Matrix) -> Vector:
    """Largest absolute entry of each row; 1 for a row of zeros."""
    sizes: Vector = numpy.abs(matrix).max(axis=1)
    return numpy.where(sizes == 0.0, 1.0, sizes)


def _running_errors(function: Any, x: Any, p: Any, rounding: Any) -> Any:
    """First-order bounds of the errors of a function's results, if x is off by `rounding` (each symbols)."""
    steps: dict[int, Any] = {}
    values: dict[int, Any] = {}
    errors: dict[int, Any] = {}
    results = [casadi.SX(0)] * function.numel_out(0)
    for index in range(function.n_instructions()):
        code = function.instruction_id(index)
        operands, targets = function.instruction_input(index), function.instruction_output(index)
        if code == casadi.OP_OUTPUT:
            results[targets[1]] = errors[operands[0]]
        elif code == casadi.OP_INPUT:
            argument, element = operands
            values[targets[0]] = (x, p)[argument][element]
            errors[targets[0]] = casadi.SX(0) if argument else rounding[element]
        elif code == casadi.OP_CONST:
            values[targets[0]] = casadi.SX(function.instruction_constant(index))
            errors[targets[0]] = casadi.SX(0)
        else:
            if code not in steps:
                steps[code] = _step_with_error(code, len(operands))
            known = [part[operand] for operand in operands for part in (values, errors)]
            values[targets[0]], errors[targets[0]] = steps[code](*known)
    return casadi.vertcat(*results)


def _step_with_error(code: int, count: int) -> Any:
    """One instruction as a function of each operand and its error; gives the result and its error."""
    operands = [casadi.SX.sym("operand") for _ in range(count)]
    errors = [casadi.SX.sym("error") for _ in range(count)]
    value = (casadi.SX.unary if count == 1 else casadi.SX.binary)(code, *operands)
    bound = casadi.fabs(value) * (0.0 if code in (casadi.OP_NEG, casadi.OP_TWICE) else EPSILON)
    for operand, error in zip(operands, errors, strict=True):
        first_order = casadi.fabs(casadi.jacobian(value, operand)) * error
        ends = [casadi.fabs(casadi.substitute(value, operand, operand + sign * error) - value) for sign in (1.0, -1.0)]
        # A slope knows nothing of jumps, the ends nothing of infinite slopes: the root of zero is off by
        # the root of its operand's error. fmin and fmax leave out the end that has no value.
        bound += casadi.if_else(error == 0.0, 0.0, casadi.fmin(first_order, casadi.fmax(*ends)))
    known = [symbol for pair in zip(operands, errors, strict=True) for symbol in pair]
    return casadi.Function("step", known, [value, bound])
