"""The thin lines of a drawing, from which its points come: virtual intersections, whole circles, what can slide."""

from collections.abc import Iterator, Mapping

from contoursolve.contour import Segment
from contoursolve.examine import Answer
from contoursolve.model import Arc, Line, Profile
from contoursolve.pictures.known import Known, place_of
from contoursolve.pictures.scene import Ring, Slide, Thin
from contoursolve.pictures.theme import Role
from contoursolve.pictures.vectors import SAME, distance, foot, minus, unit
from contoursolve.solving.affine import affine_facts


def list_construction(profile: Profile, known: Known, elements: Mapping[str, Segment]) -> Iterator[Thin]:
    """From the path to the virtual intersections that its corners cut off."""
    lines = {element.name for element in (*profile.figure.path, *profile.figure.lines) if isinstance(element, Line)}
    for corner in profile.figure.corners:
        built, at = known.corners.get(corner.name), known.points.get(corner.at)
        if built is None or at is None or corner.name not in elements:
            continue
        if corner.before in lines:
            yield Thin(built.begin, at, Role.MUTED)
        if corner.after is None or corner.after in lines:
            yield Thin(at, built.end, Role.MUTED)
    if profile.is_extended:
        yield from _tangents(profile, known)


def _tangents(profile: Profile, known: Known) -> Iterator[Thin]:
    """From where a line of the path ends to where it touches a circle beyond."""
    from contoursolve.constraints import TangentLine  # noqa: PLC0415 - see `constraints`

    for fact in profile.facts:
        if not isinstance(fact, TangentLine):
            continue
        line = next((each for each in profile.figure.path if each.name == fact.line), None)
        if line is None or not {line.tail, line.head} <= known.points.keys():
            continue
        tail, head = known.points[line.tail], known.points[line.head]
        center = known.points.get(fact.center, place_of(profile, fact.center))
        if center is None or distance(tail, head) <= SAME:
            continue
        there = foot(center, tail, unit(minus(head, tail)))
        near = min((tail, head), key=lambda end: distance(end, there))
        if max(distance(tail, there), distance(head, there)) > distance(tail, head) + SAME:
            yield Thin(near, there, Role.MUTED)


def list_rings(answer: Answer, known: Known) -> Iterator[Ring]:
    """The whole circles of arcs on which an intersection lies."""
    profile = answer.profile
    chosen = {choice.point for choice in profile.choices if choice.given}
    for element in profile.figure.path:
        if not isinstance(element, Arc):
            continue
        center, radius = known.points.get(element.center), known.radii.get(element.radius)
        is_wanted = chosen & {element.tail, element.head} or answer.contour is None
        if center is not None and radius is not None and is_wanted:
            yield Ring(center, radius, Role.MUTED)
    for circle in profile.figure.circles:
        center, size = place_of(profile, circle.center), profile.givens.get(circle.radius)
        if center is not None and size is not None:
            yield Ring(center, float(size.value), Role.GIVEN)


def list_slides(answer: Answer, known: Known) -> Iterator[Slide]:
    """What can still move, and how."""
    profile = answer.profile
    if answer.contour is not None or not known.placed:
        return
    affine = affine_facts(profile, profile.facts)
    ways = {freedom.point: freedom.direction for freedom in (affine.freedoms() if affine is not None else ())}
    shown = {*profile.intersections, *(point for each in profile.figure.path for point in (each.tail, each.head))}
    for name, at in known.points.items():
        if name in known.placed & shown:
            yield Slide(at, ways.get(name))
