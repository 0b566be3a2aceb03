"""The drawing: figures without values, facts, and profiles with the values of a block."""

from contoursolve.model.fact import Fact, Lookup, scalar
from contoursolve.model.figure import FIRST, SECOND, Arc, Corner, CornerShape, Figure, Line, Turn
from contoursolve.model.profile import Choice, Given, Layout, Length, Plane, Profile, Side, Start, Unit

__all__ = [
    "FIRST",
    "SECOND",
    "Arc",
    "Choice",
    "Corner",
    "CornerShape",
    "Fact",
    "Figure",
    "Given",
    "Layout",
    "Length",
    "Line",
    "Lookup",
    "Plane",
    "Profile",
    "Side",
    "Start",
    "Turn",
    "Unit",
    "scalar",
]
