"""Fillets and chamfers at a virtual intersection, in closed form, with the residuals of their definitions."""

from dataclasses import dataclass
from typing import Any

from contoursolve.backends.numeric import magnitude, sign, sqrt
from contoursolve.model import CornerShape

Pair = tuple[Any, Any]


@dataclass(frozen=True, slots=True)
class CornerPath:
    """Where a corner leaves the line before (`setback_in` from the intersection) and joins the one after.

    `center` is None for a chamfer. `turn` is the sine of the turn, positive to the left; `cosine` its
    cosine. `residuals` are those of the corner's definition, mm.
    """

    setback_in: Any
    setback_out: Any
    begin: Pair
    end: Pair
    center: Pair | None
    turn: Any
    cosine: Any
    residuals: tuple[Any, ...]


def build_corner(shape: CornerShape, at: Pair, arriving: Pair, leaving: Pair, size: Any, quadrant: Pair) -> CornerPath:
    """The corner of `size` at the point `at` between two unit directions.

    `quadrant` gives the signs of the 45 degree segment of a chamfer and is not used by a fillet.
    """
    turn, cosine = _cross(arriving, leaving), _dot(arriving, leaving)
    if shape is CornerShape.FILLET:
        # |u - v| / |u + v| is tan(turn / 2) without cancellation at small and large turns.
        tangent = _norm(_minus(arriving, leaving)) / _norm(_plus(arriving, leaving))
        setback_in = setback_out = size * tangent
    else:
        # s * arriving + t * leaving = size * quadrant, by Cramer's rule.
        setback_in = size * _cross(quadrant, leaving) / turn
        setback_out = size * _cross(arriving, quadrant) / turn
    begin, end = _minus(at, _times(setback_in, arriving)), _plus(at, _times(setback_out, leaving))
    on_lines = (_cross(_minus(begin, at), arriving), _cross(_minus(end, at), leaving))
    if shape is CornerShape.FILLET:
        center = _plus(begin, _times(size * sign(turn), (-arriving[1], arriving[0])))
        to_begin, to_end = _minus(begin, center), _minus(end, center)
        residuals: tuple[Any, ...] = (
            *on_lines,
            _norm(to_begin) - size,
            _norm(to_end) - size,
            _dot(to_begin, arriving),
            _dot(to_end, leaving),
        )
        return CornerPath(setback_in, setback_out, begin, end, center, turn, cosine, residuals)
    extent = _minus(end, begin)
    residuals = (*on_lines, magnitude(extent[0]) - size, magnitude(extent[1]) - size)
    return CornerPath(setback_in, setback_out, begin, end, None, turn, cosine, residuals)


def unit(vector: Pair) -> Pair:
    """The direction of a vector; NaN for the zero vector."""
    length = _norm(vector)
    return vector[0] / length, vector[1] / length


def _cross(a: Pair, b: Pair) -> Any:
    return a[0] * b[1] - a[1] * b[0]


def _dot(a: Pair, b: Pair) -> Any:
    return a[0] * b[0] + a[1] * b[1]


def _norm(a: Pair) -> Any:
    return sqrt(a[0] * a[0] + a[1] * a[1])


def _plus(a: Pair, b: Pair) -> Pair:
    return a[0] + b[0], a[1] + b[1]


def _minus(a: Pair, b: Pair) -> Pair:
    return a[0] - b[0], a[1] - b[1]


def _times(factor: Any, a: Pair) -> Pair:
    return factor * a[0], factor * a[1]
