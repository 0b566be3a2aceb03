"""Names for editors: programs and sketches that change."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub("contoursolve", __file__)
