"""The paths of two programs in one picture: what both have, what one of them has, and each difference by its number."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import PurePath

from msgspec.structs import replace

from contoursolve.comparison import Comparison, Difference, Motion, Step, Travel
from contoursolve.geometry import SECOND, Length, Plane
from contoursolve.pictures.overview import MOST_MOVES, flat_segment
from contoursolve.pictures.page import TextRun, visible
from contoursolve.pictures.scene import Closeup, Mark, MarkKind, Part, Scene, Trail, Weight, axis_names
from contoursolve.pictures.theme import Role
from contoursolve.solving import LineSegment, Point, distance
from contoursolve.tolerance import LENGTH

MOST_DIFFERENCES = 40
"""Differences that have a number in a picture."""

_OLD, _NEW = Role.CONFLICTING, Role.GIVEN
_READABLE = 60.0
"""Pixels of a difference that can be seen without a closeup."""
_PARTS = 16


def compose_comparison(comparison: Comparison, title: str | None = None) -> list[Scene]:
    """A scene for each plane in which one of the programs moves."""
    paths = comparison.old, comparison.new
    names = " and ".join(PurePath(path.name).name for path in paths)
    told = f"{names}: {_verdict(comparison)}"
    found = [plane for path in paths for each in path.steps if (plane := _plane_of_cut(each)) is not None]
    planes = {frozenset(each.axes): each for each in reversed(found)}
    scenes = [_scene(comparison, plane) for plane in dict.fromkeys(planes[frozenset(each.axes)] for each in found)]
    if not scenes:
        none = (TextRun("Neither program has a move at a feed that can be drawn.", Role.MUTED),)
        scenes = [Scene("", ("", ""), remarks=(none,))]
    first, *others = scenes
    return [replace(first, title=title if title is not None else told), *others]


def _verdict(comparison: Comparison) -> str:
    """The number of differences, and the size of the largest."""
    told = comparison.differences
    if not told:
        return f"the same path to within {comparison.tolerance:g} mm"
    largest = f", {'the largest ' if len(told) > 1 else ''}{told[0].distance:.4f} mm" if told[0].distance else ""
    return f"{len(told)} difference{'' if len(told) == 1 else 's'}{largest}"


def _plane_of_cut(step: Step) -> Plane | None:
    return step.plane if isinstance(step, Travel) and step.motion is not Motion.RAPID else None


def _scene(comparison: Comparison, plane: Plane) -> Scene:
    """The scene of both programs in a plane."""
    axes = comparison.old.axes
    numbered = [(number, each) for number, each in enumerate(comparison.differences, 1) if _is_in(each, plane)]
    sides = tuple({id(step) for each in comparison.differences for step in each.steps[side]} for side in (0, 1))
    both = [each for each in comparison.new.steps if id(each) not in sides[1]]
    shared = [*_trails(both, axes, plane, Role.INK)]
    own = [
        trail
        for side, role in enumerate((_OLD, _NEW))
        for _, each in numbered
        for trail in _trails(each.steps[side], axes, plane, role)
    ]
    parts = [*shared[:MOST_MOVES], *own[:MOST_MOVES]]
    places, closeups = list[Part](), list[Closeup]()
    for number, each in numbered[:MOST_DIFFERENCES]:
        ends = _farthest(each, axes, plane)
        if ends is None:
            continue
        role = _OLD if each.new is None else _NEW
        label = (TextRun(f"{number}", role),)
        places.append(Mark(ends[1], MarkKind.PLACE, label, label, role))
        closeups += [Closeup(f"{number}", (LineSegment("off", *ends),), _READABLE)] if distance(*ends) > LENGTH else []
    units = {step.unit for path in (comparison.old, comparison.new) for step in path.steps if isinstance(step, Travel)}
    return Scene(
        f"{plane.code}: {' and '.join(plane.axes)}",
        axis_names(plane),
        (*parts, *places),
        remarks=tuple(_remarks(numbered, len(shared) + len(own) - len(parts))),
        meanings={Role.INK: "both programs", _OLD: "OLD alone", _NEW: "NEW alone"},
        has_turning_axis=plane.diameters[SECOND],
        closeups=tuple(closeups),
        scale_unit=Length.INCH if units == {Length.INCH} else Length.MM,
    )


def _is_in(difference: Difference, plane: Plane) -> bool:
    """Whether a difference is drawn in a plane: one of moves without a plane is drawn in each."""
    planes = [step.plane for side in difference.steps for step in side if isinstance(step, Travel) and step.plane]
    return not planes or any({*each.axes} == {*plane.axes} for each in planes)


def _trails(steps: Iterable[Step], axes: tuple[str, ...], plane: Plane, role: Role) -> Iterator[Part]:
    """Moves as they are seen in a plane."""
    for step in steps:
        if not isinstance(step, Travel) or step.plane is None or {*step.plane.axes} != {*plane.axes}:
            continue
        segment = flat_segment(step, axes, plane.axes)
        if segment is None:
            continue
        is_rapid = step.motion is Motion.RAPID
        yield Trail(
            (segment,),
            Role.RAPID if is_rapid and role is Role.INK else role,
            Weight.PASSING if is_rapid else Weight.BESIDE,
        )


def _farthest(difference: Difference, axes: tuple[str, ...], plane: Plane) -> tuple[Point, Point] | None:
    """The places of OLD and NEW that are farthest apart in a difference, as it is seen in a plane."""
    found = [each for each in difference.farthest if isinstance(each, Travel)]
    if not found:
        return None
    one, other = found[0], found[-1]
    ways = [part / _PARTS for part in range(_PARTS, -1, -1)]
    pairs = [(_seen(one, at, axes, plane), _seen(other, at, axes, plane)) for at in ways]
    known = [(old, new) for old, new in pairs if old is not None and new is not None]
    return max(known, key=lambda pair: distance(*pair), default=None)


def _seen(step: Travel, at: float, axes: tuple[str, ...], plane: Plane) -> Point | None:
    place = step.at(at)
    first, second = (place[axes.index(axis)] for axis in plane.axes)
    return None if first is None or second is None else (first, second)


def _remarks(numbered: Sequence[tuple[int, Difference]], undrawn: int) -> Iterator[tuple[TextRun, ...]]:
    """Each difference by its number, with its lines, its words and its size; and how many moves are not drawn."""
    for number, each in numbered[:MOST_DIFFERENCES]:
        off = f", {each.distance:.4f} mm" if each.distance is not None else ""
        lines = [
            f"{name} program line {lines[0]}"
            for name, lines in (("OLD", each.old_lines), ("NEW", each.new_lines))
            if lines
        ]
        told = "; ".join(change.text for change in each.changes[:4]) or each.reason
        yield (TextRun(visible(f"{number}{off}, {', '.join(lines)}: {told}"), Role.INK),)
    if len(numbered) > MOST_DIFFERENCES:
        yield (TextRun(f"... and {len(numbered) - MOST_DIFFERENCES} more differences", Role.MUTED),)
    if undrawn:
        yield (TextRun(f"... and {undrawn} more moves, which are not drawn", Role.MUTED),)
