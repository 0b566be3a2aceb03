"""Drawings stated freely, beside any control, and every way to draw them."""

from contoursolve.sketch.drawn import Drawings, Drawn
from contoursolve.sketch.sketch import Sketch

__all__ = ["Drawings", "Drawn", "Sketch"]
