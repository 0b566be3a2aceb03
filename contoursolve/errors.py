"""Errors that say what to do; all of them are a `UserError`."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub("contoursolve", __file__)
