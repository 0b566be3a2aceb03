"""Matrix decompositions, for finite numbers alone.

LAPACK prints on standard output, or never returns, where an iteration of its meets NaN or infinity. Everything that
iterates is called here, and nowhere else; what eliminates (`solve`, `inv`, `det`) takes any number.
"""

from typing import Any

import numpy
from numpy.typing import NDArray

Array = NDArray[numpy.float64]


def svd(matrix: Array, *, full_matrices: bool = True) -> tuple[Array, Array, Array]:
    """Left vectors, singular values and right vectors of a matrix or of several. Raises LinAlgError for a number that
    is not finite."""
    left, values, right = numpy.linalg.svd(_finite(matrix), full_matrices=full_matrices)
    return left, values, right


def pinv(matrix: Array, **settings: Any) -> Array:
    """The pseudo-inverse, as NumPy's. Raises LinAlgError for a number that is not finite."""
    return numpy.asarray(numpy.linalg.pinv(_finite(matrix), **settings), numpy.float64)


def shortest_solution(matrix: Array, right: Array) -> Array:
    """The shortest vector that solves linear equations as nearly as they can be. Raises LinAlgError for a number that
    is not finite."""
    return numpy.asarray(numpy.linalg.lstsq(_finite(matrix), _finite(right), rcond=None)[0], numpy.float64)


def condition(matrix: Array) -> float:
    """The largest singular value in shares of the smallest; infinite for a number that is not finite."""
    return float(numpy.linalg.cond(matrix)) if numpy.isfinite(matrix).all() else numpy.inf


def _finite(numbers: Array) -> Array:
    if not numpy.isfinite(numbers).all():
        raise numpy.linalg.LinAlgError("a number is not finite")
    return numbers
