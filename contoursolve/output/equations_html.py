"""The system of equations of a contour as maths: MathML on a page, and LaTeX."""

from collections.abc import Iterator
from typing import Any

import htpy as h
from markupsafe import Markup

from contoursolve.diagnosis import EquationSystem, SystemCondition, called_in_program, word_keys
from contoursolve.gcode import FACT
from contoursolve.numeric import symbolic
from contoursolve.output.equations import (
    large_lines,
    motion_table,
    open_line,
    size_text,
    stated_pair,
    tie_fails,
    unknown_table,
    value_table,
)
from contoursolve.output.html import table, table_of
from contoursolve.output.plain_text import NAMELESS, printable


def system_element(system: EquationSystem) -> Iterator[h.Node]:
    """The same as HTML: each formula as MathML, which browsers draw and screen readers read out."""
    yield h.p[f"{size_text(system)}."]
    equations = [(*stated_pair(each), maths(each.equation)) for each in system.statements]
    keys = word_keys(system.claim.words.values())
    names = [
        NAMELESS if word is None or word.address == FACT or word.span not in keys else ("word", keys[word.span])
        for word in (each.source for each in system.statements)
    ]
    yield table("Equations", ("word", "what it says", "equation"), equations, names=names)
    if system.free:
        yield h.p[f"{open_line(system).capitalize()}."]
        yield from [table_of(motion_table(system))] if system.null_space else []
    if system.conditions:
        rows = [(maths(each.expression), printable(each.meaning), _value(each)) for each in system.conditions]
        yield table("Conditions", ("must not be 0", "what must hold", "value here"), rows, numbers=(2,))
    yield from (h.p[f"{line.capitalize()}."] for line in large_lines(system))
    if system.ties:
        ties = [
            (
                ", ".join(filter(None, (" ".join(each.words), tie_fails(each)))),
                "" if each.identity is None else maths(each.identity),
            )
            for each in system.ties
        ]
        yield table("What says the same", ("words", "formula"), ties)
    yield h.details[h.summary["Unknowns and values"], table_of(unknown_table(system)), table_of(value_table(system))]
    called = called_in_program(system.profile)
    for corner in system.corners:
        told = [(each.meaning, maths(each.equation)) for each in corner.equations]
        own = table(f"Equations of {called(corner.name)}", ("what it says", "equation"), told)
        yield h.details[h.summary[called(corner.name)], own]


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


def _value(each: SystemCondition) -> str:
    return "" if each.value is None else f"{each.value:.4g}"


def system_latex(system: EquationSystem) -> str:
    """The equations, and the condition, as LaTeX."""
    lines = [symbolic.latex(each.equation).replace("=", "&=", 1) for each in system.statements]
    lines += [f"{symbolic.latex(system.condition)} &\\neq 0"] if system.conditions else []
    rows = " \\\\\n".join(lines)
    return f"\\begin{{aligned}}\n{rows}\n\\end{{aligned}}"
