"""A program with every contour written as plain G00, G01, G02 and G03, for the same control or for another one.

Steps come in from `program`, lines of text go out. Begin with `expansion`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
