"""The command line: arguments in, text or JSON out, exit status 0 (no error found), 1 (errors found), 2."""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
