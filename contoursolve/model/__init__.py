"""The drawing: figures without values, facts, and profiles with the values of a block."""

from contoursolve.model.fact import Fact, Lookup, line_scalars, scalar
from contoursolve.model.figure import FIRST, SECOND, Arc, Circle, Corner, CornerShape, Figure, Line, Turn
from contoursolve.model.profile import (
    INCREMENT_OF,
    Choice,
    Given,
    Layout,
    Length,
    Plane,
    Profile,
    Question,
    Side,
    Start,
    Unit,
    least_increments,
)
from contoursolve.model.role import Role

__all__ = [
    "FIRST",
    "INCREMENT_OF",
    "SECOND",
    "Arc",
    "Choice",
    "Circle",
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
    "Question",
    "Role",
    "Side",
    "Start",
    "Turn",
    "Unit",
    "least_increments",
    "line_scalars",
    "scalar",
]
