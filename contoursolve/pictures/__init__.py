"""Pictures: a contour with its words as dimensions, whatever its status; SVG, and PNG with the extra `picture`.

An answer or a family comes in, one page of shapes goes out. Begin with `compose`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
