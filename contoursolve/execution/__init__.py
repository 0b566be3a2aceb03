"""Programs as a control runs them: variables, jumps, loops, subprograms and the profiles of cycles."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
