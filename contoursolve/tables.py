"""The tables of a control of your own; `Control` is the record that has them."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub("contoursolve", __file__)
