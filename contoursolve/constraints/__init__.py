"""Facts as equations, and the system that they make together.

The facts that no control's form states by itself are imported when they are first used: to make a record class
takes half a millisecond, and there are many.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from contoursolve.constraints.circles import OnCircle, Radius
from contoursolve.constraints.points import Collinear, Coordinate, Heading, Level, Offset
from contoursolve.constraints.system import System, assemble, build_system
from contoursolve.constraints.values import FLOATS, Functions, Values, headed_lines

if TYPE_CHECKING:
    from contoursolve.constraints.corners import ArcContact, ChordSetback, Setback, TangentArc
    from contoursolve.constraints.distances import Distance, EqualDistances
    from contoursolve.constraints.lines import (
        Along,
        ChamferLeg,
        Directed,
        Extent,
        Foot,
        Parallel,
        Tangent,
        TangentLine,
        Through,
        TurnBetween,
        UnitDirection,
    )
    from contoursolve.constraints.touching import ArcLength, Contact, EqualRadii, TangentCircles

__all__ = [
    "FLOATS",
    "Along",
    "ArcContact",
    "ArcLength",
    "ChamferLeg",
    "ChordSetback",
    "Collinear",
    "Contact",
    "Coordinate",
    "Directed",
    "Distance",
    "EqualDistances",
    "EqualRadii",
    "Extent",
    "Foot",
    "Functions",
    "Heading",
    "Level",
    "Offset",
    "OnCircle",
    "Parallel",
    "Radius",
    "Setback",
    "System",
    "Tangent",
    "TangentArc",
    "TangentCircles",
    "TangentLine",
    "Through",
    "TurnBetween",
    "UnitDirection",
    "Values",
    "assemble",
    "build_system",
    "headed_lines",
]

_ROOMS = {
    "corners": ("ArcContact", "ChordSetback", "Setback", "TangentArc"),
    "distances": ("Distance", "EqualDistances"),
    "touching": ("ArcLength", "Contact", "EqualRadii", "TangentCircles"),
}
"""Where the facts live that are imported late; the others are in `lines`."""


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    room = next((room for room, names in _ROOMS.items() if name in names), "lines")
    return getattr(import_module(f"{__name__}.{room}"), name)
