"""Contours and maps on axes of matplotlib, beside whatever else is drawn there."""

from collections.abc import Sequence
from itertools import cycle
from typing import Any

import numpy

from contoursolve.diagnostics import Shown, need
from contoursolve.families import Family, FeasibleRegion, is_contour
from contoursolve.pictures.maps import boundaries_in, plane_of, result_in
from contoursolve.pictures.theme import LEVELS, LIGHT_COLORS, Role
from contoursolve.solving import Contour

_TWO = 2

_DASHES = "-", "--", "-.", ":"
"""Of the lines around a region, so that a legend tells them apart."""


def plot_record(record: Shown, ax: Any, **options: Any) -> Any:
    """A contour, a region or a family on axes, or on the current ones without; see their `plot`."""
    pyplot = need("matplotlib.pyplot", "plot", "a plot on axes of matplotlib")
    axes = pyplot.gca() if ax is None else ax
    if not hasattr(axes, "plot"):
        raise TypeError(f"ax is axes of matplotlib, such as matplotlib.pyplot.gca(), not {type(ax).__name__}")
    if isinstance(record, Contour):
        return _plot_contour(record, axes, **options)
    if isinstance(record, Family | FeasibleRegion):
        return _plot_map(record, axes, **options)
    raise TypeError(f"{type(record).__name__} has no plot")


def _plot_contour(contour: Contour, ax: Any, *, chord_error: float, **style: Any) -> Any:
    """A path as one line, equal both ways; the numbers along a diameter are those of the machine."""
    points = numpy.array(contour.sample(chord_error))
    ax.plot(*points.T, **style)
    ax.set_aspect("equal")
    plane = contour.plane
    for name, is_diameter, own in zip(plane.axes, plane.diameters, (ax.xaxis, ax.yaxis), strict=True):
        own.set_label_text(f"{name} [mm, diameter]" if is_diameter else f"{name} [mm]")
        if is_diameter:
            own.set_major_formatter(lambda value, _: f"{2 * value:.6g}")
    return ax


def _plot_map(
    record: Family | FeasibleRegion, ax: Any, *, result: str | None = None, words: tuple[str, str] | None = None
) -> Any:
    """The values with a contour, or a result there; the lines around it, and the values of the block."""
    plane = plane_of(record, words)
    if min(plane.outcomes.shape) < _TWO:
        raise ValueError(f"a map needs two or more values of {' and of '.join(plane.words)}")
    field = None if result is None else result_in(record, plane, result)
    has_contour = is_contour(plane.outcomes)
    if field is not None and field.levels is not None:
        values = numpy.ma.masked_invalid(field.values.T)
        _fill(ax, plane.axes, values, [field.levels.low, *field.levels.values, field.levels.high])
        if field.levels.values:
            lines = ax.contour(*plane.axes, values, levels=list(field.levels.values), colors="black", linewidths=0.7)
            ax.clabel(lines, fmt=field.levels.text)
        ax.set_title(field.name)
    elif has_contour.any():
        ax.contourf(*plane.axes, has_contour.T, levels=[0.5, 1.5], colors=[LIGHT_COLORS[Role.SOLVED_FIELD]])
    for each, dash in zip(boundaries_in(record, plane), cycle(_DASHES), strict=False):
        ax.plot(*zip(*each.points, strict=True), color="black", linestyle=dash, label=each.reason.text)
    if isinstance(record, FeasibleRegion) and all(
        low <= value <= high for value, (low, high) in zip(record.stated, record.within, strict=True)
    ):
        ax.plot(*record.stated, "o", label="the block")
    first, second = plane.chart.names
    ax.set_xlabel(first)
    ax.set_ylabel(second)
    ax.set_xlim(float(plane.axes[0].min()), float(plane.axes[0].max()))
    ax.set_ylim(float(plane.axes[1].min()), float(plane.axes[1].max()))
    return ax


def _fill(ax: Any, axes: Sequence[Any], values: Any, levels: Sequence[float]) -> None:
    """The bands of a result, from the least to the largest value."""
    edges = sorted({*levels})
    if len(edges) < _TWO:
        edges = [edges[0] - 0.5, edges[0] + 0.5]
    count = len(edges) - 1
    colors = [LIGHT_COLORS[LEVELS[round(number * (len(LEVELS) - 1) / max(count - 1, 1))]] for number in range(count)]
    edges[0], edges[-1] = numpy.nextafter(edges[0], -numpy.inf), numpy.nextafter(edges[-1], numpy.inf)
    ax.contourf(*axes, values, levels=edges, colors=colors)
