"""Facts as equations, and the system that they make together."""

from contoursolve.constraints.facts import Coordinate, Heading, Offset, OnCircle, Radius
from contoursolve.constraints.system import System, assemble, build_system
from contoursolve.constraints.values import Values

__all__ = ["Coordinate", "Heading", "Offset", "OnCircle", "Radius", "System", "Values", "assemble", "build_system"]
