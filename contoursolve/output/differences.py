"""The comparison of two paths as text and as JSON: schema contoursolve/diff/1."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from math import degrees
from typing import Any

from contoursolve.comparison import (
    KEPT,
    Change,
    Comparison,
    Difference,
    Place,
    Quote,
    Step,
    ToolPath,
    Travel,
    Unfollowed,
    changes_beside,
)
from contoursolve.diagnosis import count, length_of
from contoursolve.diagnostics import json_text, members
from contoursolve.geometry import Length
from contoursolve.output.document import finding_data
from contoursolve.output.plain_text import printable
from contoursolve.program import Result

SCHEMA = "contoursolve/diff/1"

_SHOWN = 20
"""Blocks that are not followed, and differences with both moves, in a text for a person."""
_WORDS, _BESIDE = 6, 100
"""Words of a difference, and changes besides the path, in such a text."""
_WIDTH = 160
_DECIMALS = 6
_NONE = (None, None)


def comparison_lines(comparison: Comparison) -> Iterator[str]:
    """The verdict, every difference, what changed besides the path, and what was not followed."""
    differences = comparison.differences
    if not differences:
        yield f"equal: the same path to within {comparison.tolerance:g} mm"
    else:
        measured = [each for each in differences if each.distance is not None]
        told = count(len(differences), "difference")
        if measured:
            largest = " the largest" if len(differences) > 1 else ""
            told += f",{largest} {measured[0].distance:.4f} mm, {_where(_lines(measured[0].farthest))}"
        if measured and len(measured) < len(differences):
            told += f"; without a distance, at the end: {len(differences) - len(measured)}"
        yield f"different: {told}"
    for number, each in enumerate(differences, 1):
        yield ""
        yield from _difference_lines(comparison, each, number, is_whole=number <= _SHOWN)
    yield ""
    yield from _beside_lines(comparison)
    for name, path in _sides(comparison):
        yield f"  {name} {printable(path.name)} ({path.control}): {count(len(path.steps), 'element')}"
    if comparison.lines is not None:
        until = "" if not differences else " where the paths are the same"
        yield f"  largest deviation{until}: {comparison.deviation:.4f} mm, {_where(comparison.lines)}"
    yield from _unfollowed_lines(comparison)


def _difference_lines(comparison: Comparison, each: Difference, number: int, *, is_whole: bool) -> Iterator[str]:
    """A difference with its number and its words, and both moves with which it begins."""
    is_largest = number == 1 and len(comparison.differences) > 1 and each.distance is not None
    words = [printable(change.text) for change in each.changes[:_WORDS]]
    if len(each.changes) > len(words):
        words.append(f"and {count(len(each.changes) - len(words), 'more change')}")
    off = f"{each.distance:.4f} mm: " if each.distance is not None else ""
    yield f"{number}{' (the largest)' if is_largest else ''}. {off}{'; '.join(words) or each.reason}"
    told = [each.reason] if words else []
    told += [", ".join(_side_lines(comparison, each))]
    farthest = _lines(each.farthest)
    if each.distance is not None and farthest != _lines((each.old, each.new)):
        told.append(f"farthest apart in {_where(farthest)}")
    yield f"  {'; '.join(told)}"
    if is_whole:
        yield from _step_lines("OLD", comparison.old, each.old, has_ended=each.reason == "NEW goes on")
        yield from _step_lines("NEW", comparison.new, each.new, has_ended=each.reason == "OLD goes on")


def _side_lines(comparison: Comparison, each: Difference) -> Iterator[str]:
    """The lines of a difference in either program, as far as it has any there."""
    for (name, _), steps in zip(_sides(comparison), each.steps, strict=True):
        if steps:
            lines = [step.line for step in steps if step.file == steps[0].file]
            file = f"{printable(steps[0].file)} " if steps[0].file else ""
            first, last = min(lines), max(lines)
            yield f"{name} {file}program line{f' {first}' if first == last else f's {first} to {last}'}"


def _beside_lines(comparison: Comparison) -> Iterator[str]:
    """The changes besides the path, with both lines."""
    found = changes_beside(comparison)
    kept = [each for each in found if KEPT in {said.kind for said in (each.old, each.new) if said}]
    changes = [each for each in found if each not in kept]
    yield f"  besides the path: {count(len(changes), 'change') if changes else 'nothing changed'}"
    for name, comments in (("OLD", [each.old for each in kept]), ("NEW", [each.new for each in kept])):
        own = [each.line for each in comments if each is not None]
        if own:
            told = f"{count(len(own), 'block')} of the other program in comments, from program line {own[0]} on"
            yield f"    {name} keeps {told}"
    for change in changes[:_BESIDE]:
        lines = change.old.line if change.old else None, change.new.line if change.new else None
        yield f"    {_cut(change.text)}: {_where(lines)}"
    if len(changes) > _BESIDE:
        yield f"    and {len(changes) - _BESIDE} more; --format json lists them all"


def _lines(steps: tuple[Step | None, Step | None]) -> tuple[int | None, int | None]:
    old, new = steps
    return old.line if old else None, new.line if new else None


def _where(lines: tuple[int | None, int | None]) -> str:
    """Lines of both programs."""
    return ", ".join(f"{name} program line {line}" for name, line in zip(("OLD", "NEW"), lines, strict=True) if line)


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


def _step_lines(name: str, path: ToolPath, step: Step | None, *, has_ended: bool) -> Iterator[str]:
    if step is None:
        yield f"  {name} {printable(path.name)}: {'the path has ended' if has_ended else 'no such move'}"
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
            "difference": None if difference is None else _brief(difference),
            "differences": [_difference(each) for each in comparison.differences],
            "besides": [_change_data(each) for each in changes_beside(comparison)],
            "diagnostics": [],
        }
    )


def _brief(each: Difference) -> dict[str, Any]:
    return {
        "reason": each.reason,
        "distance_mm": _number(each.distance),
        "old": _step(each.old),
        "new": _step(each.new),
    }


def _difference(each: Difference) -> dict[str, Any]:
    """A difference with its words and the lines of all its moves, and where it is largest."""
    return {
        **_brief(each),
        "changes": [_change_data(change) for change in each.changes],
        **members(each, "old_lines new_lines"),
        **dict(zip(("old_line", "new_line"), _lines(each.farthest), strict=True)),
    }


def _change_data(change: Change) -> dict[str, Any]:
    """A change, with the amount in the unit of the word."""
    told = change.old or change.new
    return {
        "kind": told.kind if told is not None else None,
        **{name: _said(each) for name, each in (("old", change.old), ("new", change.new))},
        "by": float(change.by) if change.by is not None else None,
    }


def _said(said: Quote | None) -> dict[str, Any] | None:
    if said is None:
        return None
    return {**({"file": said.file} if said.file else {}), "line": said.line, "text": said.text}


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
