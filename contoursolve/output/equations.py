"""The system of equations of a contour as text: what each word says first, the formula behind it."""

from collections.abc import Iterator
from typing import Any

import htpy as h
from markupsafe import Markup

from contoursolve.diagnosis import Condition, Equation, EquationSystem, TiedWords, count, join
from contoursolve.numeric import symbolic
from contoursolve.output.html import table, table_of
from contoursolve.output.plain_text import Table, printable

NOBODY = "the form"
"""What states an equation that no word states."""


def system_lines(system: EquationSystem) -> Iterator[str]:
    """The lines of a system: its unknowns, its values, then what `equation_lines` has."""
    for rows in (unknown_table(system), value_table(system)):
        yield f"  {rows.caption[0].lower()}{rows.caption[1:]}:"
        yield from (*rows.lines("    ", is_headed=False), "")
    yield from equation_lines(system)


def equation_lines(system: EquationSystem) -> list[str]:
    """The equations, what they leave open, on which condition they determine the rest, what says the same, and the
    corners."""
    lines = [f"  {size_text(system)}:", *equation_table(system).lines("    ", is_headed=False)]
    lines += ["", f"  {open_line(system)}"] if system.free else []
    if system.conditions:
        lines += ["", "  it is determined on these conditions:"]
        lines += condition_table(system).lines("    ", is_headed=False)
    lines += (
        ["", "  these words say the same:", *tie_table(system).lines("    ", is_headed=False)] if system.ties else []
    )
    for corner, rows in zip(system.corners, corner_tables(system), strict=True):
        lines += ["", f"  {corner.name}:", *rows.lines("    ", is_headed=False)]
    return lines


def size_text(system: EquationSystem) -> str:
    """The number of equations and of unknowns, and the rank."""
    many = count(len(system.statements), "equation")
    found = f"{many} for {count(len(system.unknowns), 'unknown')}"
    return found if system.rank == len(system.statements) == len(system.unknowns) else f"{found}, rank {system.rank}"


def open_line(system: EquationSystem) -> str:
    """What nothing determines, and how many equations are missing."""
    meanings = [each.meaning for each in system.unknowns if each.symbol in system.free]
    missing = len(system.unknowns) - system.rank
    return f"still open: {join(meanings)}; {count(missing, 'equation')} {'is' if missing == 1 else 'are'} missing"


def unknown_table(system: EquationSystem) -> Table:
    """The unknowns, what each is, and its value where there is a contour."""
    rows = [
        (str(each.symbol), each.meaning, "" if each.value is None else f"{each.value:z.4f}", each.unit)
        for each in system.unknowns
    ]
    return Table("Unknowns", ("unknown", "meaning", "value", "unit"), rows, left=(0, 1, 3))


def value_table(system: EquationSystem) -> Table:
    """The values that words state, as the equations have them."""
    rows = [
        (
            str(each.symbol),
            printable(each.text),
            each.meaning,
            "not known" if each.number is None else f"{float(each.number):z.4f}",
            each.unit,
        )
        for each in system.words
    ]
    return Table("Values", ("symbol", "word", "meaning", "value", "unit"), rows, left=(0, 1, 2, 4))


def equation_table(system: EquationSystem) -> Table:
    """The equations, each with its word and what that says."""
    rows = [(*_stated(each), symbolic.text(each.equation)) for each in system.statements]
    return Table("Equations", ("word", "what it says", "equation"), rows, left=(0, 1, 2))


def _stated(each: Equation) -> tuple[str, str]:
    word = printable(each.word)
    return word or NOBODY, printable(each.meaning.removesuffix(f" ({each.word})"))


def condition_table(system: EquationSystem) -> Table:
    """The conditions, in words and as expressions that must not be zero, with their values."""
    rows = [(printable(each.meaning), symbolic.text(each.expression), _here(each)) for each in system.conditions]
    return Table("Conditions", ("what must hold", "must not be 0", "here"), rows, left=(0, 1, 2))


def _here(each: Condition) -> str:
    return "must not be 0" if each.value is None else f"is {each.value:.4g}, must not be 0"


def tie_table(system: EquationSystem) -> Table:
    """The sets of words that say the same, with the formula that ties them."""
    rows = [(printable(" ".join(each.words)), _formula(each)) for each in system.ties]
    return Table("What says the same", ("words", "formula"), rows, left=(0, 1))


def _formula(each: TiedWords) -> str:
    return "" if each.identity is None else symbolic.text(each.identity)


def corner_tables(system: EquationSystem) -> list[Table]:
    """The equations of each corner."""
    return [
        Table(
            f"Equations of {corner.name}",
            ("what it says", "equation"),
            [(each.meaning, symbolic.text(each.equation)) for each in corner.equations],
            left=(0, 1),
        )
        for corner in system.corners
    ]


# As maths -----------------------------------------------------------------------------------------------------


def system_element(system: EquationSystem) -> Iterator[h.Node]:
    """The same as HTML: each formula as MathML, which browsers draw and screen readers read out."""
    yield h.p[f"{size_text(system)}."]
    equations = [(*_stated(each), _math(each.equation)) for each in system.statements]
    yield table("Equations", ("word", "what it says", "equation"), equations)
    if system.free:
        yield h.p[f"{open_line(system).capitalize()}."]
    if system.conditions:
        rows = [(printable(each.meaning), _math(each.expression), _value(each)) for each in system.conditions]
        yield table("Conditions", ("what must hold", "must not be 0", "value here"), rows, numbers=(2,))
    if system.ties:
        ties = [(" ".join(each.words), "" if each.identity is None else _math(each.identity)) for each in system.ties]
        yield table("What says the same", ("words", "formula"), ties)
    yield h.details[h.summary["Unknowns and values"], table_of(unknown_table(system)), table_of(value_table(system))]
    for corner in system.corners:
        told = [(each.meaning, _math(each.equation)) for each in corner.equations]
        own = table(f"Equations of {corner.name}", ("what it says", "equation"), told)
        yield h.details[h.summary[corner.name.capitalize()], own]


def _math(expression: Any) -> h.Node:
    # Made by sympy of our own symbols: no text of a program.
    alternative = symbolic.text(expression)
    return h.math(xmlns="http://www.w3.org/1998/Math/MathML", alttext=alternative)[Markup(symbolic.mathml(expression))]


def _value(each: Condition) -> str:
    return "" if each.value is None else f"{each.value:.4g}"


def system_latex(system: EquationSystem) -> str:
    """The equations, and the condition, as LaTeX."""
    lines = [symbolic.latex(each.equation).replace("=", "&=", 1) for each in system.statements]
    lines += [f"{symbolic.latex(system.condition)} &\\neq 0"] if system.conditions else []
    rows = " \\\\\n".join(lines)
    return f"\\begin{{aligned}}\n{rows}\n\\end{{aligned}}"
