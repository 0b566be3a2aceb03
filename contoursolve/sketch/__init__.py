"""Drawings stated freely, beside any control, and every way to draw them.

Calls come in, all drawings that satisfy them go out. Begin with `sketch`.
"""

from contoursolve.sketch.drawn import Drawings, Drawn, Stated
from contoursolve.sketch.sketch import Sketch

__all__ = ["Drawings", "Drawn", "Sketch", "Stated"]
