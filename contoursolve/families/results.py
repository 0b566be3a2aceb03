"""The results of a kind of row: which there are, what they are called, and those of a single solve."""

from collections.abc import Mapping
from math import isfinite, nan
from typing import Any

from numpy.typing import NDArray

from contoursolve.families.kinds import Kind
from contoursolve.model import FIRST, SECOND, CornerShape, scalar
from contoursolve.solving import RemarkKind
from contoursolve.solving.verdict import code_of, reason_of

Results = Mapping[str, NDArray[Any]]
"""Columns by name."""

Behind = tuple[str, int | None]
"""The output behind a result, and the axis of a coordinate: inside they count from the start point."""


def shown_as(output: str) -> str:
    """The output that has the results."""
    return f"shown:{output}"


def names_of(kind: Kind) -> dict[str, str]:
    """The names of the results, by the outputs that have them."""
    return {"worst": "residual"} | {shown_as(output): name for name, (output, _) in results_of(kind).items()}


def sides_of_choice(kind: Kind) -> dict[str, int]:
    """The sides that the words choose, by the point: +1 farther or left, -1 nearer or right."""
    shown = kind.profile.intersections
    return {choice.point: choice.side.sign for choice in kind.profile.choices if choice.given and choice.point in shown}


def results_of(kind: Kind) -> dict[str, Behind]:
    """The output behind each result, and the axis of a coordinate: inside they count from the start point."""
    figure = kind.system.figure
    axes = list(zip((FIRST, SECOND), kind.profile.plane.axes, strict=True))
    found: dict[str, tuple[str, int | None]] = {}
    for point in figure.points:
        found |= {f"{point}.{letter}": (scalar(point, axis), axis) for axis, letter in axes}
    found |= {f"{radius}": (radius, None) for radius in figure.radii}
    for corner in figure.corners:
        for place in ("begin", "end", *(("center",) if corner.shape is CornerShape.FILLET else ())):
            for axis, letter in axes:
                found[f"{corner.name}.{place}.{letter}"] = f"{place}:{corner.name}.{axis}", axis
    return found | {f"{element.name}.room": (f"room:{element.name}", None) for element in figure.path}


def fill_row(kind: Kind, values: Mapping[str, float], row: int, table: Results) -> None:
    """The results of a single solve in a row."""
    solution = kind.solve(values)
    table["status"][row] = code_of(solution.status)
    table["reason"][row] = reason_of(solution.refusals[0].kind if solution.refusals else None)
    if not solution.points:
        for name in (*(name for name in table if name.endswith(".room")), "residual"):
            # A room without points is none.
            table[name][row] = table[name][row] if isfinite(table[name][row]) else nan
        return
    letters = kind.profile.plane.axes
    for radius, value in solution.radii.items():
        table[radius][row] = value
    pairs = dict(solution.points)
    del pairs[kind.system.figure.start]
    for name, corner in solution.corners.items():
        pairs |= {f"{name}.begin": corner.begin, f"{name}.end": corner.end}
        pairs |= {f"{name}.center": corner.center} if corner.center is not None else {}
    for name, pair in pairs.items():
        for letter, value in zip(letters, pair, strict=True):
            table[f"{name}.{letter}"][row] = value
    touching = {remark.subject for remark in solution.remarks if remark.kind is RemarkKind.TOUCHES}
    for point, side in sides_of_choice(kind).items():
        table[f"branch.{point}"][row] = 0 if point in touching else side
