"""Places through which facts lead a line or a circle, with how far it passes them by."""

from collections.abc import Iterator, Mapping
from math import hypot

from contoursolve.constraints import OnCircle, Through
from contoursolve.model import Fact, Line, Profile
from contoursolve.pictures.known import Known, place_of
from contoursolve.pictures.scene import Aligned, Kind, Leader, Mark, Thin
from contoursolve.pictures.theme import Role
from contoursolve.pictures.vectors import SAME, along, distance, foot, minus, unit
from contoursolve.pictures.wording import number, word_text
from contoursolve.solving import Point

Drawn = Mark | Leader | Thin | Aligned


def list_places(profile: Profile, known: Known, roles: Mapping[str, Role]) -> Iterator[Drawn]:
    """Each place with its fact, the line or circle as far as that, and the gap where they miss each other."""
    for fact in profile.facts:
        given = profile.givens.get(fact.given)
        if not isinstance(fact, Through | OnCircle) or fact.point not in profile.figure.places:
            continue
        at = place_of(profile, fact.point)
        if given is None or given.word is None or at is None:
            continue
        role = roles.get(fact.given, Role.GIVEN)
        yield Mark(at, Kind.CENTER)
        yield Leader(at, (1.0, 1.0), word_text(given.word.text), role)
        there = _nearest(fact, at, profile, known)
        if there is None:
            continue
        yield from _extension(fact, there, profile, known)
        if role is Role.CONFLICTING and distance(there, at) > SAME:
            yield Aligned(there, at, f"{number(distance(there, at), profile.unit)} off", role)


def _nearest(fact: Fact, at: Point, profile: Profile, known: Known) -> Point | None:
    """The point of the line or the circle that is nearest to a place."""
    if isinstance(fact, OnCircle):
        center, radius = known.points.get(fact.center), known.radii.get(fact.radius)
        if center is None or radius is None or hypot(*minus(at, center)) <= SAME:
            return None
        return along(center, unit(minus(at, center)), radius)
    ends = _ends(fact, profile, known)
    return foot(at, ends[0], unit(minus(ends[1], ends[0]))) if ends is not None else None


def _ends(fact: Fact, profile: Profile, known: Known) -> tuple[Point, Point] | None:
    """Where the line of a fact begins and ends."""
    if not isinstance(fact, Through):
        return None
    line = next((each for each in profile.figure.path if isinstance(each, Line) and each.name == fact.line), None)
    if line is None or not {line.tail, line.head} <= known.points.keys():
        return None
    tail, head = known.points[line.tail], known.points[line.head]
    return (tail, head) if distance(tail, head) > SAME else None


def _extension(fact: Fact, there: Point, profile: Profile, known: Known) -> Iterator[Thin]:
    """From where a line ends to where it passes a place beyond."""
    ends = _ends(fact, profile, known)
    if ends is not None and max(distance(end, there) for end in ends) > distance(*ends) + SAME:
        yield Thin(min(ends, key=lambda end: distance(end, there)), there, Role.MUTED)
