"""The calculation of a contour by hand on a page: formulas as maths, each triangle drawn."""

from collections.abc import Iterator

import htpy as h

from contoursolve.diagnosis import Calculation, Derivation
from contoursolve.output.derivation import numbers_text, value_text
from contoursolve.output.equations_html import maths
from contoursolve.output.html import table

WIDE, HIGH, EDGE = 220, 150, 30
"""Pixels of a triangle, and of the margin in which its names stand."""


def derivation_element(derivation: Derivation) -> Iterator[h.Node]:
    """The steps, each with its triangle and its lines."""
    yield h.p["Lengths in mm, X of a lathe as radius."]
    for number, step in enumerate(derivation.steps, 1):
        yield _triangle(step)
        rows = [
            (
                maths(line.symbol),
                "" if step.is_searched else maths(line.formula),
                "" if step.is_searched else numbers_text(line),
                value_text(line),
                line.meaning,
            )
            for line in step.lines
        ]
        header = ("what", "formula", "with numbers", "result", "meaning")
        yield table(f"{number}. {step.title}", header, rows, numbers=(3,))


def _triangle(step: Calculation) -> h.Node:
    """The triangle of a step to scale; nothing without one, or for one that is flat."""
    if not step.triangle:
        return None
    places = [at for _, at in step.triangle]
    low = [min(place[axis] for place in places) for axis in (0, 1)]
    size = [max(place[axis] for place in places) - low[axis] for axis in (0, 1)]
    if min(size) <= 0:
        return None
    scale = min((WIDE - 2 * EDGE) / size[0], (HIGH - 2 * EDGE) / size[1])
    points = [(EDGE + (x - low[0]) * scale, HIGH - EDGE - (y - low[1]) * scale) for x, y in places]
    middle = sum(x for x, _ in points) / 3, sum(y for _, y in points) / 3
    names = ", ".join(name for name, _ in step.triangle if name)
    return h.svg(
        viewBox=f"0 0 {WIDE} {HIGH}", width=str(WIDE), height=str(HIGH), role="img", aria_label=f"triangle {names}"
    )[
        h.polygon(
            points=" ".join(f"{x:.1f},{y:.1f}" for x, y in points),
            fill="currentColor",
            fill_opacity="0.08",
            stroke="currentColor",
        ),
        (
            h.text(
                x=f"{x + 0.18 * (x - middle[0]):.1f}",
                y=f"{y + 0.18 * (y - middle[1]) + 4:.1f}",
                text_anchor="middle",
                font_size="12",
                fill="currentColor",
            )[name]
            for (name, _), (x, y) in zip(step.triangle, points, strict=True)
        ),
    ]
