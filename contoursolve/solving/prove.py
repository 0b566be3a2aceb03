"""Proves that a box holds exactly one solution of all equations of a system."""

from collections.abc import Mapping, Sequence

from contoursolve.analysis import Group
from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.constraints import System
from contoursolve.solving.certificate import Proof, up_to_one_digit
from contoursolve.solving.ground import Ground
from contoursolve.solving.kernel import Kernel, make_kernel
from contoursolve.solving.krawczyk import Content, content_of, refine

MARGIN = 2.0**-100
"""How far the box that is tested reaches beyond a solution's ball, as a share of the coordinates."""


Box = tuple[Proof, Sequence[Number]]
"""What is proven of a step's solution, and a ball for each of its unknowns."""


class Prover:
    """Proves solutions of one system on one ground; a step that several of them have in common is tested once."""

    def __init__(self, system: System, groups: Sequence[Group], ground: Ground) -> None:
        self.kernels = [make_kernel(system, group) for group in groups]
        self.ground = ground
        self.tested: dict[tuple[int, ...], tuple[Sequence[Number], Box]] = {}
        """By step and the identities of its numbers, which are kept with it: balls have no equality, and solutions that
        have a step in common have its numbers."""

    def prove(self, scalars: Mapping[str, Number], signs: Mapping[str, int]) -> tuple[Proof, dict[str, Number]]:
        """What is proven about a solution, and a box for every unknown that holds the exact solution.

        The steps are tested one after the other, each for all values that the ones before may have: the product of
        their boxes then holds exactly one solution of all equations.
        """
        boxes: dict[str, Number] = {}
        proof = Proof.EXACT
        for number, kernel in enumerate(self.kernels):
            values = [scalars[name] for name in kernel.unknowns]
            names = kernel.arguments[len(kernel.unknowns) :]
            inputs = [self.ground.number(name, boxes, signs) for name in names]
            numbers = (*values, *inputs)
            key = (number, *map(id, numbers))
            if key not in self.tested:
                self.tested[key] = numbers, _test(kernel, values, dict(zip(names, inputs, strict=True)))
            own, found = self.tested[key][1]
            if own is Proof.UNKNOWN:
                return Proof.UNKNOWN, dict(scalars)
            if own is not Proof.EXACT:
                proof = own
            boxes.update(zip(kernel.unknowns, found, strict=True))
        return proof, boxes


def _test(kernel: Kernel, values: Sequence[Number], inputs: Mapping[str, Number]) -> Box:
    if all(map(ball.is_exact, (*values, *inputs.values()))):
        # Rational numbers are tried in the equations themselves.
        found = kernel.equations([*values, *inputs.values()])[: len(kernel.facts)]
        if all(each == 0 for each in found):
            return Proof.EXACT, values
    margin = MARGIN * max(1.0, *(abs(ball.middle(each)) for each in values))
    content, image = content_of(kernel, [ball.wider(each, margin) for each in values], inputs)
    return (Proof.UNIQUE, refine(kernel, image, inputs)) if content is Content.ONE else (Proof.UNKNOWN, values)


def radius_of(boxes: Mapping[str, Number], values: Mapping[str, float]) -> float:
    """The largest distance of an exact value from its float, rounded up to one digit, mm."""
    return up_to_one_digit(max((ball.distance(boxes[name], value) for name, value in values.items()), default=0.0))
