"""Steps without a closed form: what a division into boxes has proven, and solutions found from where it has not."""

from collections.abc import Mapping, Sequence
from functools import lru_cache

from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.backends.rootfinder import Finder, finder_of
from contoursolve.solving.division import Division
from contoursolve.solving.elimination import Root
from contoursolve.solving.kernel import Kernel
from contoursolve.solving.krawczyk import keep, prove, refine

NARROW = 2.0**-60
"""1 (share of the coordinates). A box that is wider is tried to be enclosed otherwise."""


def settle(kernel: Kernel, division: Division, inputs: Mapping[str, Number]) -> list[Root]:
    """All solutions that are proven."""
    found: list[list[Number]] = []
    for low, high in zip(division.proven.low.tolist(), division.proven.high.tolist(), strict=True):
        keep(_pinned(kernel, [ball.between(*ends) for ends in zip(low, high, strict=True)], inputs), found)
    for point in division.likely:
        box = search(kernel, point, inputs)
        if box is not None:
            keep(box, found)
    return [Root(dict(enumerate(box))) for box in found]


def search(kernel: Kernel, guess: Sequence[float], inputs: Mapping[str, Number]) -> list[Number] | None:
    """A box about the solution that a guess leads to, if it can be proven to be one."""
    names = kernel.arguments[len(kernel.unknowns) :]
    finder = _finder(kernel)
    found = finder(guess, [ball.middle(inputs[name]) for name in names]) if finder else None
    return prove(kernel, found, inputs) if found else None


def _pinned(kernel: Kernel, box: list[Number], inputs: Mapping[str, Number]) -> list[Number]:
    """The solution in a box that is proven to hold exactly one, as narrowly as it can be enclosed."""
    narrow = refine(kernel, box, inputs)
    if all(ball.width(each) <= NARROW * max(1.0, abs(ball.middle(each))) for each in narrow):
        return narrow
    near = search(kernel, [ball.middle(each) for each in narrow], inputs)
    if near is not None and all(ball.contains(outer, inner) for outer, inner in zip(narrow, near, strict=True)):
        return near
    return narrow


@lru_cache(maxsize=256)
def _finder(kernel: Kernel) -> Finder | None:
    return finder_of(kernel.function, len(kernel.unknowns))
