"""One contour examined: every check in order, why it is refused, and what to write instead.

A parsed contour comes in, an answer with findings goes out. Begin with `examine`, then `diagnose`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
