"""The Krawczyk test: does a box hold exactly one solution of a step's equations, or none?

Krawczyk (1969), Computing 4, 187-201; Moore, Kearfott and Cloud (2009), Introduction to Interval Analysis, 8.2.
"""

from collections.abc import Mapping, Sequence
from enum import Enum

from contoursolve.backends import ball, numeric
from contoursolve.backends.ball import Number
from contoursolve.solving.kernel import Kernel


class Content(Enum):
    """What a box is proven to hold."""

    ONE = "exactly one solution"
    NONE = "no solution"
    UNKNOWN = "not decided"


def content_of(kernel: Kernel, box: Sequence[Number], inputs: Mapping[str, Number]) -> tuple[Content, list[Number]]:
    """What a box (a ball for each unknown) holds, and a box that holds the same solutions, no larger.

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
    inverse = numeric.inverse([[ball.middle(each) for each in row] for row in slopes])
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
"""How often a box is made smaller; each time doubles its digits, once it is small."""


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
