"""Sketches: a contour as its drawing gives it, what is known of it, and its words for a control.

A sketch is written as a program of the control `drawing`, and examined as every program is. Begin with `sketch`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
