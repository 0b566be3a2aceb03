"""Numbers of every kind: the only room that knows CasADi, sympy and flint.

Expressions come in; functions of floats, columns, boxes and balls go out. Begin with `expressions`.
"""

from lazy_loader import attach_stub

__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
