"""The path of a contour that is refused, element by element, as far as its points are known."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot

from contoursolve.contour import ArcSegment, LineSegment, Segment
from contoursolve.model import Arc, Corner, Line, Profile, Turn
from contoursolve.pictures.known import Known
from contoursolve.pictures.theme import Role
from contoursolve.solving import Point, RefusalKind
from contoursolve.solving.solution import CornerSolution
from contoursolve.tolerance import LENGTH

_CORNERS = (
    RefusalKind.CORNER_TOO_LARGE,
    RefusalKind.CORNERS_OVERLAP,
    RefusalKind.CORNER_STRAIGHT,
    RefusalKind.CORNER_REVERSES,
    RefusalKind.BEVEL_OUTSIDE,
    RefusalKind.BEVEL_IN_BAND,
    RefusalKind.LANDING_UNKNOWN,
)
"""Refusals after which the lines of the path are as they should be, without their corners."""


@dataclass(frozen=True, slots=True)
class Traced:
    """An element, and whether it is as stated (`INK`), refused or still free."""

    segment: Segment
    role: Role


def trace_known(profile: Profile, known: Known) -> list[Traced]:
    """The elements between known points. Corners that do not fit are not cut: they stand beside the path, refused."""
    return list(_traced(profile, known))


def trace_segments(profile: Profile, known: Known) -> tuple[Segment, ...]:
    """The same without roles."""
    return tuple(traced.segment for traced in _traced(profile, known))


def _traced(profile: Profile, known: Known) -> Iterator[Traced]:
    corners = {corner.at: corner for corner in profile.figure.corners}
    refused = {refusal.subject for refusal in known.refusals}
    is_uncut = any(refusal.kind in _CORNERS for refusal in known.refusals)
    here: Point | None = known.points.get(profile.figure.start)
    for element in profile.figure.path:
        corner = corners.get(element.head)
        built = known.corners.get(corner.name) if corner else None
        is_cut = built is not None and not is_uncut and not known.refusals
        tail, head = here, known.points.get(element.head)
        end = built.begin if built is not None and is_cut else head
        if tail is not None and end is not None:
            segment = _segment(element, tail, end, known)
            if segment is not None:
                role = Role.INK
                if known.placed & {element.head, element.tail}:
                    role = Role.FREE
                if element.name in refused:
                    role = Role.CONFLICTING
                yield Traced(segment, role)
        here = head
        if corner is not None and built is not None:
            cut = corner_segment(corner, built)
            if is_cut:
                yield Traced(cut, Role.FREE if element.head in known.placed else Role.INK)
                here = built.end
            elif is_uncut and (corner.name in refused or element.name in refused or corner.after in refused):
                yield Traced(cut, Role.CONFLICTING)


def _segment(element: Line | Arc, tail: Point, head: Point, known: Known) -> Segment | None:
    if hypot(head[0] - tail[0], head[1] - tail[1]) <= LENGTH:
        return None
    if isinstance(element, Line):
        return LineSegment(element.name, tail, head)
    center, radius = known.points.get(element.center), known.radii.get(element.radius)
    if center is None or radius is None:
        return None
    return ArcSegment(element.name, tail, head, center, radius, element.turn)


def corner_segment(corner: Corner, built: CornerSolution) -> Segment:
    """A corner as an element of a path."""
    if built.center is None:
        return LineSegment(corner.name, built.begin, built.end)
    turn = Turn.CCW if built.turn > 0 else Turn.CW
    return ArcSegment(corner.name, built.begin, built.end, built.center, built.radius, turn)
