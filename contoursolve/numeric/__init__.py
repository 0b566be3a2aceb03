"""Numbers of every kind: the only room that knows CasADi, sympy and flint.

Expressions come in; functions of floats, columns, boxes and balls go out. Begin with `expressions`.
"""
