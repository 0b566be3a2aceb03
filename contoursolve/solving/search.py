"""Steps without a closed form: what a division into boxes has proven, and solutions found from where it has not."""

from collections.abc import Mapping, Sequence
from functools import lru_cache

from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.backends.rootfinder import RootFinder, finder_of
from contoursolve.solving.division import Division
from contoursolve.solving.elimination import Root
from contoursolve.solving.kernel import Kernel
from contoursolve.solving.krawczyk import keep, prove, refine

STARTS = 400
"""How many of the undecided boxes are used as starts for CasADi's root finder."""


def settle(kernel: Kernel, division: Division, inputs: Mapping[str, Number]) -> tuple[list[Root], bool]:
    """All solutions that are proven, and whether there are no others within reach."""
    found: list[list[Number]] = []
    for low, high in zip(division.proven.low.tolist(), division.proven.high.tolist(), strict=True):
        keep(refine(kernel, [ball.between(*ends) for ends in zip(low, high, strict=True)], inputs), found)
    middles = (division.undecided.low / 2 + division.undecided.high / 2).tolist()
    for middle in middles[:: max(1, len(middles) // STARTS)]:
        _search(kernel, middle, inputs, found)
    return [Root(dict(enumerate(box))) for box in found], not middles


def _search(kernel: Kernel, guess: Sequence[float], inputs: Mapping[str, Number], found: list[list[Number]]) -> None:
    """Add the solution that a guess leads to, if it can be proven to be one."""
    names = kernel.arguments[len(kernel.unknowns) :]
    root = _finder(kernel).quick(guess, [ball.middle(inputs[name]) for name in names])
    if root.is_found and root.is_regular:
        box = prove(kernel, root.values, inputs)
        if box is not None:
            keep(box, found)


@lru_cache(maxsize=256)
def _finder(kernel: Kernel) -> RootFinder:
    return finder_of(kernel.function, len(kernel.unknowns))
