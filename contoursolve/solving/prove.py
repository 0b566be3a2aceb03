"""Proves that a box holds exactly one solution of all equations of a system."""

from collections.abc import Mapping, Sequence

from contoursolve.analysis import Group
from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.constraints import System
from contoursolve.solving.certificate import Proof, up_to_one_digit
from contoursolve.solving.ground import Ground
from contoursolve.solving.kernel import make_kernel
from contoursolve.solving.krawczyk import Content, content_of, refine

MARGIN = 2.0**-100
"""How far the box that is tested reaches beyond a solution's ball, as a share of the coordinates."""


def prove_found(
    system: System, groups: Sequence[Group], ground: Ground, scalars: Mapping[str, Number], signs: Mapping[str, int]
) -> tuple[Proof, dict[str, Number]]:
    """What is proven about a solution, and a box for every unknown that holds the exact solution.

    The steps are tested one after the other, each for all values that the ones before may have: the product of
    their boxes then holds exactly one solution of all equations.
    """
    boxes: dict[str, Number] = {}
    proof = Proof.EXACT
    for group in groups:
        kernel = make_kernel(system, group)
        names = kernel.arguments[len(kernel.unknowns) :]
        inputs = {name: ground.number(name, boxes, signs) for name in names}
        values = [scalars[name] for name in kernel.unknowns]
        if all(map(ball.is_exact, (*values, *inputs.values()))):
            # Rational numbers are tried in the equations themselves.
            found = kernel.equations([*values, *inputs.values()])[: len(kernel.facts)]
            if all(each == 0 for each in found):
                boxes.update(zip(kernel.unknowns, values, strict=True))
                continue
        proof = Proof.UNIQUE
        margin = MARGIN * max(1.0, *(abs(ball.middle(each)) for each in values))
        content, image = content_of(kernel, [ball.wider(each, margin) for each in values], inputs)
        if content is not Content.ONE:
            return Proof.UNKNOWN, dict(scalars)
        boxes.update(zip(kernel.unknowns, refine(kernel, image, inputs), strict=True))
    return proof, boxes


def radius_of(boxes: Mapping[str, Number], values: Mapping[str, float]) -> float:
    """The largest distance of an exact value from its float, rounded up to one digit, mm."""
    return up_to_one_digit(max((ball.distance(boxes[name], value) for name, value in values.items()), default=0.0))
