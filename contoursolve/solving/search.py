"""Steps without a closed form: solutions by CasADi's root finder, each proven by the Krawczyk test."""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from random import Random

from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.backends.rootfinder import RootFinder, finder_of
from contoursolve.solving.elimination import Root
from contoursolve.solving.kernel import Kernel
from contoursolve.solving.krawczyk import keep, prove

STARTS = 200
"""How many points are tried where nothing tells where solutions are."""


def search(kernel: Kernel, guess: Sequence[float], inputs: Mapping[str, Number], found: list[list[Number]]) -> None:
    """Add the solution that a guess leads to, if it can be proven to be one."""
    names = kernel.arguments[len(kernel.unknowns) :]
    root = _finder(kernel).quick(guess, [ball.middle(inputs[name]) for name in names])
    if root.is_found and root.is_regular:
        box = prove(kernel, root.values, inputs)
        if box is not None:
            keep(box, found)


def search_everywhere(
    kernel: Kernel, inputs: Mapping[str, Number], reach: Mapping[str, tuple[float, float]]
) -> list[Root]:
    """Solutions from points drawn all over the range of the unknowns; there may be others."""
    draw = Random(1)
    found: list[list[Number]] = []
    for _ in range(STARTS):
        search(kernel, [draw.uniform(*reach[name]) for name in kernel.unknowns], inputs, found)
    return [Root(dict(enumerate(box))) for box in found]


@lru_cache(maxsize=256)
def _finder(kernel: Kernel) -> RootFinder:
    return finder_of(kernel.function, len(kernel.unknowns))
