"""How a contour of words alone stands: whether they fix its points and agree, and all its solutions."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from contoursolve.model import FIRST, SECOND, Turn
from contoursolve.verification.claimed import ClaimedArc, ClaimedElement, ClaimedPath
from contoursolve.verification.node import Coordinates
from contoursolve.verification.path import SHORTEST
from contoursolve.verification.quantity import Origin


@dataclass(frozen=True, slots=True)
class Candidate:
    """A solution of what the words say: its path, and the signs of the words that choose it.

    Whether the control can make it is for the checks of the form to say. `path` is None where they cannot even be
    asked: a corner that joins no two lines.
    """

    path: ClaimedPath | None
    signs: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Standing:
    """`disagrees` says which words do not agree, `is_twice` that this is so whatever their values are; `is_loose` that
    they leave a point free, `is_over` that they say more
    than they need to, and agree; `candidates` are all solutions, None where no closed form gives them."""

    disagrees: str = ""
    is_twice: bool = False
    is_loose: bool = False
    is_over: bool = False
    candidates: tuple[Candidate, ...] | None = ()
    is_all: bool = True
    """Whether these are all; otherwise they are what the signs of the words choose."""


@dataclass(frozen=True, slots=True)
class Leg:
    """An element of a path, from the start point; `arc` holds its centre, radius (mm) and turn."""

    end: complex
    arc: tuple[complex, float, Turn] | None = None


def path_of(legs: list[Leg], points: Mapping[str, complex], origin: Origin) -> ClaimedPath:
    """A path as a result would claim it; elements of no length are left out."""

    def place(at: complex) -> Coordinates:
        return at.real + float(origin[FIRST]), at.imag + float(origin[SECOND])

    elements, here = [], 0j
    for leg in legs:
        if abs(leg.end - here) >= SHORTEST:
            arc = ClaimedArc(place(leg.arc[0]), leg.arc[1], leg.arc[2]) if leg.arc else None
            elements.append(ClaimedElement(place(here), place(leg.end), arc))
            here = leg.end
    return ClaimedPath(place(here), {name: place(at) for name, at in points.items()}, tuple(elements))
