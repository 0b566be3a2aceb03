"""The comparison of two paths as text and as JSON: schema contoursolve/diff/1."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from math import degrees, isfinite
from typing import Any

from contoursolve.comparison import Comparison, Place, Step, ToolPath, Travel, Unfollowed
from contoursolve.diagnosis import count, length_of
from contoursolve.diagnostics import json_text, members
from contoursolve.geometry import Length
from contoursolve.output.document import finding_data
from contoursolve.output.plain_text import printable
from contoursolve.program import Result

SCHEMA = "contoursolve/diff/1"

_SHOWN = 20
"""Blocks that are not followed, in a text for a person."""
_WIDTH = 160
_DECIMALS = 6
_NONE = (None, None)


def comparison_lines(comparison: Comparison) -> Iterator[str]:
    """The verdict, with both places where the paths differ first, and what was not followed."""
    difference, lines = comparison.difference, comparison.lines
    if difference is None:
        yield f"equal: the same path to within {comparison.tolerance:g} mm"
    else:
        off = f", {difference.distance:.4f} mm" if _is_shown(difference.distance) else ""
        yield f"different: {difference.reason}{off}"
        yield from _step_lines("OLD", comparison.old, difference.old)
        yield from _step_lines("NEW", comparison.new, difference.new)
    yield ""
    for name, path in _sides(comparison):
        yield f"  {name} {printable(path.name)} ({path.control}): {count(len(path.steps), 'element')}"
    if lines is not None:
        until = "" if difference is None else " before the difference"
        where = f"OLD program line {lines[0]}, NEW program line {lines[1]}"
        yield f"  largest deviation{until}: {comparison.deviation:.4f} mm, {where}"
    yield from _unfollowed_lines(comparison)
    yield "  not compared: feeds, leads of threads, speeds, tools, offsets, dwells, M functions"


def _unfollowed_lines(comparison: Comparison) -> Iterator[str]:
    """The blocks that are not followed: those that both programs have once, and then the others of each program."""
    old, new = comparison.old.unfollowed, comparison.new.unfollowed
    shared = Counter(each.words for each in old) & Counter(each.words for each in new)
    same, only_old = _divide(old, shared)
    only_new = _divide(new, shared)[1]
    for title, blocks in (
        ("not followed, but the same word by word in both", same),
        ("not followed, only in OLD", only_old),
        ("not followed, only in NEW", only_new),
    ):
        if blocks:
            name = "NEW" if blocks is only_new else "OLD"
            rows = [f"    {name} {row}" for row in _runs(blocks)]
            yield f"  {title}: {count(len(blocks), 'block')}"
            yield from rows[:_SHOWN]
            if len(rows) > _SHOWN:
                yield "    and more; --format json lists them all"


def _divide(
    blocks: Sequence[Unfollowed], shared: Mapping[tuple[str, ...], int]
) -> tuple[list[Unfollowed], list[Unfollowed]]:
    """The blocks that the other program has as well, and those that it has not, or not so often."""
    rest = dict(shared)
    same: list[Unfollowed] = []
    own: list[Unfollowed] = []
    for block in blocks:
        is_shared = rest.get(block.words, 0) > 0
        (same if is_shared else own).append(block)
        rest[block.words] = rest.get(block.words, 0) - 1
    return same, own


def _runs(blocks: Sequence[Unfollowed]) -> Iterator[str]:
    """One row for the blocks in a row with the same reason."""
    for (reason, _), run in groupby(blocks, key=lambda each: (each.reason, each.file)):
        first, *more = run
        until = f", and {len(more)} more up to program line {more[-1].line}" if more else ""
        file = f"{printable(first.file)} " if first.file else ""
        yield f"{file}program line {first.line}: {_cut(first.text)} ({reason}){until}"


def _step_lines(name: str, path: ToolPath, step: Step | None) -> Iterator[str]:
    if step is None:
        yield f"  {name} {printable(path.name)}: the path has ended"
        return
    yield f"  {name} {printable(step.file or path.name)}:{step.line}: {_cut(step.text)}"
    if isinstance(step, Unfollowed):
        yield f"      not followed: {step.reason}"
        return
    is_diameter = any(step.doubled)
    unit = ("in" if step.unit is Length.INCH else "mm") + (", X as diameter" if is_diameter else "")
    unit += f", {' and '.join(step.free)} from an unknown place" if step.free else ""
    shape = "line" if step.bend is None else f"arc {_turn(step)}"
    yield f"      {step.motion.value}, {shape} [{unit}]"
    shown = {
        axis for axis, ends in zip(path.axes, zip(step.start, step.end, strict=True), strict=True) if ends != _NONE
    }
    yield f"      from {_place(step, step.start, path.axes, shown)}"
    yield f"      to   {_place(step, step.end, path.axes, shown)}"
    if step.bend:
        center: list[float | None] = [None] * len(path.axes)
        for axis, value in zip(step.bend.axes, step.bend.center, strict=True):
            center[axis] = value
        shown = {path.axes[axis] for axis in step.bend.axes}
        radius = length_of(step.bend.radii[0], step.unit)
        yield f"      centre {_place(step, tuple(center), path.axes, shown)}, radius {radius}"


def _place(step: Travel, place: Place, axes: tuple[str, ...], shown: set[str]) -> str:
    """The coordinates of a point in the terms of its program."""
    return " ".join(
        f"{axis} unknown" if value is None else f"{axis}{length_of(value * (2 if is_diameter else 1), step.unit)}"
        for axis, value, is_diameter in zip(axes, place, step.doubled, strict=True)
        if axis in shown
    )


def _cut(text: str) -> str:
    return printable(text)[:_WIDTH]


def _turn(step: Travel) -> str:
    return "ccw" if step.bend and step.bend.sweep > 0 else "cw"


def _is_shown(distance: float | None) -> bool:
    return distance is not None and isfinite(distance)


def _sides(comparison: Comparison) -> tuple[tuple[str, ToolPath], tuple[str, ToolPath]]:
    return ("OLD", comparison.old), ("NEW", comparison.new)


def to_json(comparison: Comparison) -> str:
    """The comparison as one document; lengths in mm, X of a lathe as radius, angles in degrees."""
    difference, lines = comparison.difference, comparison.lines
    return json_text(
        {
            "schema": SCHEMA,
            "verdict": "equal" if difference is None else "different",
            "tolerance_mm": comparison.tolerance,
            "axes": list(comparison.old.axes),
            **{name.lower(): _path(path) for name, path in _sides(comparison)},
            "largest_deviation": None
            if lines is None
            else {"mm": _number(comparison.deviation), "old_line": lines[0], "new_line": lines[1]},
            "difference": None
            if difference is None
            else {
                "reason": difference.reason,
                "distance_mm": _number(difference.distance) if _is_shown(difference.distance) else None,
                "old": _step(difference.old),
                "new": _step(difference.new),
            },
            "diagnostics": [],
        }
    )


def refusal_to_json(results: Sequence[Result]) -> str:
    """The findings about programs that have errors, and no path to compare."""
    return json_text(
        {
            "schema": SCHEMA,
            "verdict": "not-compared",
            "diagnostics": [
                {"program": result.program.name, **finding_data(finding, result)}
                for result in results
                for finding in result.diagnostics
            ],
        }
    )


def _path(path: ToolPath) -> dict[str, Any]:
    return {
        "program": path.name,
        "control": path.control,
        "elements": len(path.steps),
        "not_followed": [_step(each) for each in path.unfollowed],
    }


def _step(step: Step | None) -> dict[str, Any] | None:
    if step is None:
        return None
    data: dict[str, Any] = {**({"file": step.file} if step.file else {}), "line": step.line, "text": step.text}
    if isinstance(step, Unfollowed):
        return {**data, "kind": "not-followed", "reason": step.reason}
    data |= {
        "kind": "line" if step.bend is None else "arc",
        "motion": step.motion.value,
        "start": [_number(value) for value in step.start],
        "end": [_number(value) for value in step.end],
        **members(step, "compensation is_skippable"),
        **({"relative": list(step.free)} if step.free else {}),
    }
    if step.bend:
        data |= {
            "center": [_number(value) for value in step.bend.center],
            "center_axes": list(step.bend.axes),
            "radius": _number(step.bend.radii[0]),
            "turn": _turn(step),
            "sweep": _number(abs(degrees(step.bend.sweep))),
        }
    return data


def _number(value: float | None) -> float | None:
    return None if value is None else round(value, _DECIMALS) + 0.0
