"""Facts as equations, and the system that they make together."""

from contoursolve.constraints.circles import ArcLength, Contact, EqualRadii, OnCircle, Radius, TangentCircles
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
from contoursolve.constraints.points import Coordinate, Distance, EqualDistances, Heading, Offset
from contoursolve.constraints.system import System, assemble, build_system
from contoursolve.constraints.values import FLOATS, Functions, Values, headed_lines

__all__ = [
    "FLOATS",
    "Along",
    "ArcLength",
    "ChamferLeg",
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
    "Offset",
    "OnCircle",
    "Parallel",
    "Radius",
    "System",
    "Tangent",
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
