"""Explanation of a contour on a page: its equations, its construction, and its calculation by hand."""

from collections.abc import Iterator

import htpy as h

from contoursolve.diagnosis import Answer
from contoursolve.output.construction import construction_lines
from contoursolve.output.contours import points_table
from contoursolve.output.derivation_html import derivation_element
from contoursolve.output.equations import system_view
from contoursolve.output.html import table_of, view_element


def equations_of_contour(answer: Answer) -> Iterator[h.Node]:
    """The equations of a contour as maths, and the steps in which it is constructed."""
    yield from view_element(system_view(answer.system))
    yield table_of(points_table(answer))
    heading, *steps = construction_lines(answer)
    yield h.h4["Construction"]
    yield h.pre["\n".join(line[2:] for line in steps)] if steps else h.p[f"{heading.strip().capitalize()}."]


def calculation_of_contour(answer: Answer) -> Iterator[h.Node]:
    """The calculation of a contour by hand; nothing where no contour is solved."""
    system = answer.system
    if system.solution:
        yield from derivation_element(system.derivation)
