"""Notebooks: how records show themselves, and a contour to move.

Records come in, what Jupyter displays goes out. Begin with `records`, then `exploration`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
