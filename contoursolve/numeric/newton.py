"""CasADi's root finder, whose word is not taken: what it proposes is polished, and the caller proves it or drops it."""

from collections.abc import Callable, Sequence
from typing import Any

import casadi
import numpy

from contoursolve.numeric.linear_algebra import shortest_solution

SETTINGS = {"line_search": True, "max_iter": 100, "error_on_fail": False, "show_eval_warnings": False}
"""Of CasADi's newton. It can neither abort nor print. Its status is not read: it reports success with NaN at a singular
Jacobian, and with a point that is no root of a redundant system."""

POLISH_STEPS = 20
"""1. Newton steps at the end, as long as they help: two do at a root that can be proven."""

Finder = Callable[[Sequence[float], Sequence[float]], list[float] | None]
"""From a guess and parameters: the point where no Newton step makes the largest residual smaller; None if there is no
such point."""


def finder_of(function: Any, size: int) -> Finder | None:
    """A finder for a CasADi function of one vector, whose first `size` inputs are the unknowns, the others parameters,
    and whose first `size` outputs are the residuals. None for equations that CasADi refuses."""
    symbols = casadi.SX.sym("x", function.numel_in(0))
    unknowns, parameters = symbols[:size], symbols[size:]
    residuals = function(symbols)[:size]
    slopes = casadi.jacobian(residuals, unknowns)
    if casadi.sprank(slopes) < size:  # some cannot be solved for an unknown
        return None
    newton = casadi.rootfinder("newton", "newton", {"x": unknowns, "p": parameters, "g": residuals}, SETTINGS)
    values_of = casadi.Function("values", [unknowns, parameters], [casadi.densify(residuals), casadi.densify(slopes)])

    def find(guess: Sequence[float], given: Sequence[float]) -> list[float] | None:
        try:
            point = newton(guess, given).full().ravel()
            with numpy.errstate(all="ignore"):  # what overflows is not finite, and no root
                return _polished(point, lambda at: [part.full() for part in values_of(at, given)])
        except (RuntimeError, numpy.linalg.LinAlgError):  # CasADi's, NumPy's
            return None

    return find


def _polished(point: Any, values_of: Callable[[Any], list[Any]]) -> list[float] | None:
    """A point after Newton steps for as long as they bring the largest residual down; None if it is not finite."""
    residuals, slopes = values_of(point)
    for _ in range(POLISH_STEPS):
        following = point - shortest_solution(slopes, residuals).ravel()
        nearer, steeper = values_of(following)
        if not abs(nearer).max() < abs(residuals).max():
            break
        point, residuals, slopes = following, nearer, steeper
    return [float(each) for each in point] if numpy.isfinite(point).all() else None
