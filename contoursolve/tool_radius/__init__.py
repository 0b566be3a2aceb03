"""The tool that cuts a contour: whether its radius fits, and which way its centre or its tip goes.

The path of a program and a tool come in, runs of elements with their offset paths and faults go out: begin with
`findings`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
