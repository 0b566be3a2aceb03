"""Certifies contours: how far the exact places may be from the floats, and whether they are what is printed. Of one
that was solved in closed form, the same steps are done once more in exact numbers and balls."""

from collections.abc import Iterable, Mapping
from decimal import Decimal

from contoursolve.geometry import INCREMENT_OF, Profile, System
from contoursolve.numeric import Number, ball
from contoursolve.solving.compile import ExactFunction, compile_decision, compile_proof
from contoursolve.solving.numbers import inputs_as
from contoursolve.solving.solution import DECIMALS, Certificate, Proof, up_to_one_digit

BITS = 128
"""Bits of the balls: enough for a radius far below the rounding of the floats that are certified."""


def certify(profile: Profile, system: System, out: Mapping[str, float], bound: float) -> Certificate:
    """The certificate of the points, radii and corners among the outputs of a compiled system, as they are printed.

    Every step has one solution on the branch that its side names, if its determinant is not zero and its
    discriminant is positive; the ball about it is computed with outward rounding, and the equations are tried on it.
    `bound` is what is known of the error otherwise, mm.
    """
    proof = compile_proof(system)
    with ball.precision(BITS):
        start = [(ball.exact(value), float(value)) for value in profile.start.values if value is not None]
        try:
            results = _run(proof.function, profile, system)
        except (ArithmeticError, ValueError):
            return Certificate(Proof.VERIFIED, bound, "interval arithmetic cannot decide a step")
        if any(ball.sign(results[index]) not in signs for index, signs in proof.signs):
            return Certificate(Proof.VERIFIED, bound, "two solutions are too close to be told apart")
        places = [(results[index], out[name]) for index, name in proof.radii]
        for index, name, axis in proof.coordinates:
            exact, rounded = start[axis]
            places.append((results[index] + exact, out[name] + rounded))
        return certificate_of(places, (results[index] for index in proof.residuals))


def certificate_of(
    places: Iterable[tuple[Number, float]], residuals: Iterable[Number] = (), gap: float | None = None
) -> Certificate:
    """The certificate of a solution that is proven to be the only one in its box, by whatever way it was found.

    `places` are its coordinates and radii, each in a ball with the float that stands for it; `residuals` are what the
    equations leave. It is exact if all numbers that are printed of it are the rational ones that solve every equation.
    """
    places = tuple(places)
    is_exact = all(map(_is_printed, places)) and not any(map(ball.sign, residuals))
    radius = up_to_one_digit(ball.largest_distance(places))
    return Certificate(Proof.EXACT if is_exact else Proof.UNIQUE, radius, "", gap)


def _is_printed(place: tuple[Number, float]) -> bool:
    """Whether a number is the very decimal that is printed for its float."""
    exact, value = place
    return ball.is_exact(exact) and bool(exact == ball.exact(Decimal(repr(round(value, DECIMALS)))))


DECISION = 256
"""Bits of the balls that decide whether two elements meet; numbers that agree in all of them are the same."""


def decide_meeting(profile: Profile, system: System, number: int) -> tuple[int, float]:
    """The way in which the elements of a step of the construction miss each other (-1), touch (0) or meet twice (1), on
    the exact words; and the discriminant, mm**2."""
    decision = compile_decision(system, number)
    with ball.precision(DECISION):
        try:
            (found,) = _run(decision, profile, system)
        except (ArithmeticError, ValueError):
            return 0, 0.0
        return ball.sign(found) or 0, ball.middle(found)


def _run(function: ExactFunction, profile: Profile, system: System) -> list[Number]:
    """The outputs at the exact words, with the inputs as in `solve`."""
    inputs = inputs_as(_exact, ball.direction, profile, system)
    if any(name.startswith(INCREMENT_OF) for name in function.inputs):
        inputs |= {name: ball.exact(value) for name, value in profile.increments.items()}
    return function.replay([inputs[name] for name in function.inputs])


def _exact(value: Decimal | float, less: Decimal) -> Number:
    return ball.exact(value) - ball.exact(less) if less else ball.exact(value)
