"""Proves that a box holds exactly one solution of the equations of a step, or of a whole system."""

from collections.abc import Mapping, Sequence
from enum import Enum
from functools import lru_cache

from contoursolve.geometry import System
from contoursolve.numeric import Number, ball, expressions
from contoursolve.solving.exact_inputs import Ground
from contoursolve.solving.partition import Group
from contoursolve.solving.step_equations import Kernel, Local, local_of, make_kernel


class Content(Enum):
    """The number of solutions that a box is proven to hold."""

    ONE = "exactly one solution"
    NONE = "no solution"
    UNKNOWN = "not decided"


def content_of(kernel: Kernel, box: Sequence[Number], inputs: Mapping[str, Number]) -> tuple[Content, list[Number]]:
    """The content of a box (a ball for each unknown), and a box that holds the same solutions, no larger.

    `inputs` gives the kernel's other arguments by name; solutions are counted for each value that they may have.
    """
    size = len(kernel.unknowns)
    others = [inputs[name] for name in kernel.arguments[size:]]
    middles = [ball.center(each) for each in box]
    residuals = kernel.equations([*middles, *others])[:size]
    at_box = kernel.equations([*box, *others])
    if any(ball.sign(each) for each in at_box[:size]):
        return Content.NONE, list(box)
    slopes = [at_box[size + row * size : size + (row + 1) * size] for row in range(size)]
    inverse = expressions.inverse([[ball.middle(each) for each in row] for row in slopes])
    if inverse is None:
        return Content.UNKNOWN, list(box)
    image: list[Number] = []
    for i in range(size):
        weights = [ball.exact(weight) for weight in inverse[i]]
        value = middles[i]
        for j in range(size):
            value = value - weights[j] * residuals[j]
        for k in range(size):
            entry = ball.exact(1.0 if i == k else 0.0)
            for j in range(size):
                entry = entry - weights[j] * slopes[j][k]
            value = value + entry * (box[k] - middles[k])
        image.append(value)
    if not all(ball.is_finite(each) for each in image):
        return Content.UNKNOWN, list(box)
    if all(ball.contains(outer, inner) for outer, inner in zip(box, image, strict=True)):
        return Content.ONE, image
    smaller = []
    for outer, inner in zip(box, image, strict=True):
        common = ball.common(outer, inner)
        if common is None:
            return Content.NONE, list(box)
        smaller.append(common)
    return Content.UNKNOWN, smaller


REFINEMENTS = 64
"""The number of times that a box is made smaller; each time doubles its digits, once it is small."""


def refine(kernel: Kernel, box: Sequence[Number], inputs: Mapping[str, Number]) -> list[Number]:
    """A box that is proven to hold one solution, shrunk as far as it goes; the solution stays in it."""
    current = list(box)
    for _ in range(REFINEMENTS):
        content, image = content_of(kernel, current, inputs)
        widths = [(ball.width(new), ball.width(old)) for new, old in zip(image, current, strict=True)]
        if content is Content.NONE or not any(new < old / 2 for new, old in widths):
            break
        current = image
    return current


def prove(kernel: Kernel, values: Sequence[float], inputs: Mapping[str, Number]) -> list[Number] | None:
    """A box about approximate values that is proven to hold exactly one solution; None if none could be proven."""
    scale = max(1.0, *map(abs, values))
    for share in (2.0**-46, 2.0**-40, 2.0**-34, 2.0**-28, 2.0**-22):
        content, box = content_of(kernel, [ball.around(value, share * scale) for value in values], inputs)
        if content is Content.ONE:
            return refine(kernel, box, inputs)
    return None


def keep(box: list[Number], found: list[list[Number]]) -> None:
    """Add a solution unless it is one that was found already."""
    for other in found:
        if all(ball.intersects(one, two) for one, two in zip(box, other, strict=True)):
            return
    found.append(box)


MARGIN = 2.0**-100
"""The distance by which the box that is tested reaches beyond a solution's ball, as a share of the coordinates."""


class Prover:
    """Proves solutions of one system on one ground; a step that solutions have in common is tested once."""

    def __init__(self, system: System, groups: Sequence[Group], ground: Ground) -> None:
        self.steps = [local_of(system, group) for group in groups]
        self.ground = ground

    def prove(self, scalars: Mapping[str, Number], signs: Mapping[str, int]) -> dict[str, Number] | None:
        """A box for every unknown that is proven to hold exactly one solution; None where none could be proven.

        The steps are tested one after the other, each for all values that the ones before may have: the product of
        their boxes then holds exactly one solution of all equations.
        """
        boxes: dict[str, Number] = {}
        for step in self.steps:
            kernel = make_kernel(step)
            values = (scalars[name] for name in kernel.unknowns)
            inputs = (self.ground.number(name, boxes, signs) for name in kernel.arguments[len(kernel.unknowns) :])
            found = _test(step, ball.SameNumbers([*values, *inputs]))
            if found is None:
                return None
            boxes.update(zip(kernel.unknowns, found, strict=True))
        return boxes


@lru_cache(maxsize=8192)
def _test(step: Local, numbers: ball.SameNumbers) -> Sequence[Number] | None:
    """A ball for each unknown of a step, which hold one solution, at the values of its unknowns and then of its other
    inputs."""
    kernel, size = make_kernel(step), len(step.group.unknowns)
    values, inputs = numbers.numbers[:size], dict(zip(kernel.arguments[size:], numbers.numbers[size:], strict=True))
    if all(map(ball.is_exact, numbers.numbers)):
        # Rational numbers are tried in the equations themselves.
        found = kernel.equations(numbers.numbers)[: len(kernel.facts)]
        if all(each == 0 for each in found):
            return values
    margin = MARGIN * max(1.0, *(abs(ball.middle(each)) for each in values))
    content, image = content_of(kernel, [ball.wider(each, margin) for each in values], inputs)
    return refine(kernel, image, inputs) if content is Content.ONE else None
