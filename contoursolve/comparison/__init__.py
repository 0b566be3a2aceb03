"""Comparison of two programs by their paths, and of a claimed result with its program.

Two programs come in, their differences go out: begin with `compare`. A program and a result come in, a receipt
goes out: begin with `verify`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
