"""A sketch as a page shows it: all that is known of it as plain data, and its picture."""

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

from contoursolve.diagnosis import length_text, status_text
from contoursolve.diagnostics import checked, members, plain
from contoursolve.geometry import Length
from contoursolve.pictures import (
    Mark,
    MarkKind,
    Part,
    Picture,
    Role,
    TextRun,
    Theme,
    Trail,
    Weight,
    draw_sketched,
)
from contoursolve.sketches.known_part import PartState, SketchAnswer, SketchFix, SketchPart, solve_sketch
from contoursolve.sketches.sketch import ContourSketch
from contoursolve.sketches.sketch_file import plain_element
from contoursolve.sketches.terms import entry_text
from contoursolve.solving import ArcSegment, LineSegment, Segment, middle

_STATES = {
    PartState.KNOWN: (Role.INK, "known"),
    PartState.SLIDING: (Role.FREE, "can still slide"),
    PartState.CONTRADICTING: (Role.CONFLICTING, "contradicts the rest"),
    PartState.GUESSED: (Role.GUESSED, "chosen by your guess"),
    PartState.UNKNOWN: (Role.MUTED, "open"),
}
"""The colour role of each state, and its name: the same in a picture, its legend and a list."""

_MEANINGS: Mapping[Role, str] = {
    Role.SEVERAL: "one of several contours",
    Role.GHOST: "another contour",
    **{role: name for role, name in _STATES.values() if role not in (Role.INK, Role.MUTED)},
}


@checked
def draw_sketch(found: SketchAnswer, *, theme: Theme = Theme.LIGHT) -> Picture | None:
    """The picture of what is known of a sketch; None where nothing is.

    What is known is solid; what slides is dashed, with its way. What contradicts has its amount, and what a guess has
    chosen is dotted.
    """
    if found.answer is None:
        return None
    told = " ".join(_told(found))
    return draw_sketched(
        found.answer, [*_drawn(found)], _title(found), told, spell=entry_text, meanings=_MEANINGS, theme=theme
    )


def _title(found: SketchAnswer) -> str:
    """Its state, or the entry that is missing: a title has no room for a finding."""
    if found.missing or found.is_finished:
        return found.said
    is_wrong = any(each.state is PartState.CONTRADICTING for each in found.elements)
    return "some entries contradict the rest" if is_wrong else f"no contour: {status_text(found.status)}"


def _drawn(found: SketchAnswer) -> Iterator[Part]:
    assert found.answer is not None
    for each in found.elements:
        role, _ = _STATES[each.state]
        for number, way in enumerate(each.ways):
            pieces = (LineSegment(f"way {number}", *ends) for ends in pairwise(way))
            yield Trail(tuple(pieces), role, Weight.GHOST)
        if each.segment is not None:
            yield Trail((each.segment,), role)
        if each.segment is not None and each.off_mm is not None:
            text = f"off by {length_text(each.off_mm, found.answer.unit)}"
            yield Mark(middle(each.segment)[0], MarkKind.OTHER, (TextRun(text, role),), role=role)
    yield from _others(found)


def _others(found: SketchAnswer) -> Iterator[Part]:
    """All contours that fit and are not chosen, thin, each with its name where it ends an element as no other does."""
    shared = {each.name for each in found.elements if each.state is PartState.KNOWN}
    is_chosen = any(each.is_chosen for each in found.solutions)
    role, weight = (Role.GHOST, Weight.GHOST) if is_chosen else (Role.SEVERAL, Weight.BESIDE)
    for each in (each for each in found.solutions if not each.is_chosen):
        own = tuple(segment for segment in each.segments if segment.name not in shared)
        yield Trail(own, role, weight)
        number, place = each.guess
        name = found.sketch.name_of(number)
        at = next((segment.end for segment in own if segment.name == name), own[-1].end)
        written = " ".join(f"{axis}{value.normalize():f}" for axis, value in place.items())
        runs = TextRun(each.name, role), *([] if is_chosen else [TextRun(f"  {written}", Role.DERIVED)])
        kind = MarkKind.OTHER if is_chosen else MarkKind.PLACE
        yield Mark(at, kind, runs, runs[:1], role)


def state_text(part: SketchPart, found: SketchAnswer) -> str:
    """The state of an element or a corner, with the amount by which it contradicts the rest."""
    unit = found.answer.unit if found.answer is not None else Length.MM
    off = f", off by {length_text(part.off_mm, unit)}" if part.off_mm is not None else ""
    return f"{_STATES[part.state][1]}{off}"


def _told(found: SketchAnswer) -> Iterator[str]:
    yield from (f"{each.name}: {state_text(each, found)}." for each in found.elements)
    yield from (f"{each[0].upper()}{each[1:]}." for each in (found.missing, *found.remarks) if each)


@checked
def sketch_view(sketch: ContourSketch, *, with_ranges: bool = False, theme: Theme = Theme.PAGE) -> dict[str, Any]:
    """All that is known of a sketch, and its picture as SVG, as plain data; numbers of fields are texts."""
    found = solve_sketch(sketch, with_ranges=with_ranges)
    picture = draw_sketch(found, theme=theme)
    return {
        **members(found, "status is_finished missing said remarks entries"),
        "axes": [*sketch.axes],
        "diameters": [*sketch.control.plane.diameters],
        **members(found.program, "program=text start"),
        "elements": [
            plain(each) | {"segment": each.segment and _segment(each.segment), "told": _STATES[each.state][1]}
            for each in found.elements
        ],
        "asked": [{"number": n, "field": name, "value": plain(each)} for (n, name), each in found.asked.items()],
        "findings": [plain(each) | {"fixes": [*map(_fix, each.fixes)]} for each in found.findings],
        "solutions": [
            plain(each)
            | {
                "segments": [*map(_segment, each.segments)],
                "guess": dict(zip(("number", "place"), plain(each.guess), strict=True)),
            }
            for each in found.solutions
        ],
        "picture": {"svg": picture.svg, "frame": picture.frame} if picture is not None else None,
    }


def _fix(fix: SketchFix) -> dict[str, Any]:
    return {"title": fix.title, "elements": {str(n): plain(plain_element(now)) for n, now in fix.elements.items()}}


def _segment(segment: Segment) -> dict[str, Any]:
    """A line or an arc; places in mm, X as radius."""
    told: dict[str, Any] = plain(segment)
    return told | {"kind": "arc" if isinstance(segment, ArcSegment) else "line"}
