"""Families: one block with some words free, a million contours at once.

A block with free words comes in; rows, ranges, regions and sensitivities go out. Begin with `block_template`, then
`compiled_sweep`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
