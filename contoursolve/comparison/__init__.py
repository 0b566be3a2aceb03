"""Comparison of two programs by their paths.

Two programs come in, their first difference goes out. Begin with `compare`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
