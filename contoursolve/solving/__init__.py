"""From a system and its values to a contour: construction, function, checks, proof.

A profile comes in, a solution or refusals go out. Begin with `solve`; what has several solutions or no closed form is
in `ambiguity`, `alternatives` and `enumerate`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
