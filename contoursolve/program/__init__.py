"""A whole program: followed line by line, its contours solved one by one or many together.

Blocks come in from `gcode`, steps with answers and findings go out. Begin with `pipeline`; `examination` is the walk.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
