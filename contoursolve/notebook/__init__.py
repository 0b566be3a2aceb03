"""Notebooks: how records show themselves, a contour to move, and exercises.

Records come in, what Jupyter displays goes out. Begin with `records`, then `exploration`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
