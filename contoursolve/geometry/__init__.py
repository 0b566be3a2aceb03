"""The drawing: figures without values, facts as equations, profiles with the values of a block.

What a block states comes in as facts, a system of equations goes out. Begin with `figure`, then `system`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
