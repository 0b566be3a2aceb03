"""The system of equations of a contour as maths: MathML on a page, and LaTeX."""

from typing import Any

import htpy as h
from markupsafe import Markup

from contoursolve.diagnosis import EquationSystem
from contoursolve.numeric import symbolic


def maths(expression: Any) -> h.Node:
    """An expression as MathML with its text as the alternative; an equation as two, so that a narrow page breaks it."""
    if hasattr(expression, "rhs"):
        return h.fragment[maths(expression.lhs), " ", _formula(expression.rhs, "=")]
    return _formula(expression)


def _formula(expression: Any, before: str = "") -> h.Element:
    """One formula, which no page breaks, with a sign before it."""
    alternative = " ".join(filter(None, (before, symbolic.text(expression))))
    sign = f"<mo>{before}</mo>" if before else ""
    # Made by sympy of our own symbols: no text of a program.
    formula = Markup(sign + symbolic.mathml(expression))
    return h.math(xmlns="http://www.w3.org/1998/Math/MathML", alttext=alternative)[formula]


def system_latex(system: EquationSystem) -> str:
    """The equations, and the condition, as LaTeX."""
    lines = [symbolic.latex(each.equation).replace("=", "&=", 1) for each in system.statements]
    lines += [f"{symbolic.latex(system.condition)} &\\neq 0"] if system.conditions else []
    rows = " \\\\\n".join(lines)
    return f"\\begin{{aligned}}\n{rows}\n\\end{{aligned}}"
