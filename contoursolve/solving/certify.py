"""Certifies a contour that was solved in closed form: the same steps once more, in exact numbers and balls."""

from collections.abc import Mapping

from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.backends.inputs import COSINE, SINE
from contoursolve.constraints import Coordinate, System
from contoursolve.model import FIRST, SECOND, Profile, Unit, scalar
from contoursolve.solving.certificate import Certificate, Proof, up_to_one_digit
from contoursolve.solving.compile import compile_proof

BITS = 128
"""Bits of the balls: enough for a radius far below the rounding of the floats that are certified."""

_SIGNS = {"determinant": (-1, 1), "discriminant": (0, 1), "radius": (1,)}
"""A discriminant that is exactly zero leaves one solution, too."""


def certify(profile: Profile, system: System, values: Mapping[str, float], bound: float) -> Certificate:
    """The certificate of values (mm; unknowns and corner points by name).

    Every step has one solution on the branch that its side names, if its determinant is not zero and its
    discriminant is positive; the ball about it is computed with outward rounding, and the equations are tried on it.
    `bound` is what is known of the error otherwise, mm.
    """
    machine = compile_proof(system)
    with ball.precision(BITS):
        start = [ball.exact(each) for each in profile.start.values if each is not None]
        inputs = _inputs(profile, system)
        try:
            results = machine.replay([inputs[name] for name in machine.inputs])
        except (ArithmeticError, ValueError):
            return Certificate(Proof.VERIFIED, bound, "a step cannot be decided in interval arithmetic")
        radius, is_exact = 0.0, True
        for name, value in zip(machine.outputs, results, strict=True):
            kind = name.partition(":")[0]
            if kind in _SIGNS:
                if ball.sign(value) not in _SIGNS[kind]:
                    return Certificate(Proof.VERIFIED, bound, "two solutions are too close to be told apart")
            elif kind == "residual":
                if ball.sign(value):
                    # A fact that was not needed agrees as well as words do; another has been compared before.
                    is_exact = False
            elif name in values:
                axis = name.rpartition(".")[2]
                value = value + start[int(axis)] if axis.isdigit() else value  # noqa: PLW2901 - from the start
                radius = max(radius, ball.distance(value, values[name]))
                is_exact = is_exact and ball.is_exact(value)
    if is_exact and radius == 0:
        return Certificate(Proof.EXACT, 0.0)
    return Certificate(Proof.UNIQUE, up_to_one_digit(radius))


def _inputs(profile: Profile, system: System) -> dict[str, Number]:
    """All inputs, as in `solve`: coordinates are counted from the start point."""
    start = [ball.exact(value) for value in profile.start.values if value is not None]
    inputs: dict[str, Number] = {scalar(system.figure.start, axis): ball.exact(0) for axis in (FIRST, SECOND)}
    absolute = {fact.given: fact.axis for fact in system.facts if isinstance(fact, Coordinate)}
    for name, given in profile.givens.items():
        if given.unit is Unit.DEGREE:
            inputs[name + COSINE], inputs[name + SINE] = ball.direction(given.value)
        else:
            value = ball.exact(given.value)
            inputs[name] = value - start[absolute[name]] if name in absolute else value
    for choice in profile.choices:
        inputs[f"side:{choice.point}"] = ball.exact(choice.side.sign)
    return inputs
