"""What is wrong with a contour, drawn: both places of a point, the circle and the line that misses it, lines that never
meet, a line that would run backwards."""

from collections.abc import Iterator
from math import hypot

from contoursolve.constraints import Collinear, Coordinate, Heading, Offset, OnCircle
from contoursolve.examine import Answer
from contoursolve.model import FIRST, Fact, Line, Profile, Unit
from contoursolve.pictures.known import Known
from contoursolve.pictures.scene import Aligned, Kind, Mark, Ring, Thin
from contoursolve.pictures.theme import Role
from contoursolve.pictures.vectors import SAME, along, distance, foot, minus, toward, unit
from contoursolve.pictures.wording import number
from contoursolve.solving import Point, Refusal, RefusalKind

Drawn = Thin | Ring | Aligned | Mark

Ray = tuple[Point, Point]
"""A place on a line and its unit direction."""


def draw_faults(answer: Answer, known: Known) -> Iterator[Drawn]:
    """What speaks against a contour, and what words say that are ignored."""
    profile = answer.profile
    by_given = {fact.given: fact for fact in profile.facts if fact.given}
    for refusal in known.refusals:
        if refusal.kind is RefusalKind.WORDS_DISAGREE and refusal.subject in by_given:
            yield from _both_places(by_given[refusal.subject], profile, known, Role.CONFLICTING)
        elif refusal.kind is RefusalKind.CIRCLE_MISSED:
            yield from _missed(refusal, profile, known)
        elif refusal.kind is RefusalKind.CIRCLES_APART:
            yield from _apart(refusal, profile, known)
        elif refusal.kind is RefusalKind.LINES_PARALLEL:
            yield from _parallel(refusal, profile, known)
        elif refusal.kind is RefusalKind.RADIUS_DIFFERENCE:
            yield from _off_circle(refusal, profile, known)
        elif refusal.kind is RefusalKind.RADIUS_TOO_SMALL:
            yield from _too_small(refusal, profile, known)
        elif refusal.kind is RefusalKind.LINE_REVERSED:
            yield from _reversed(refusal, profile, known)
    for fact in profile.ignored:
        yield from _both_places(fact, profile, known, Role.IGNORED)


def _gap(one: Point, other: Point, profile: Profile, role: Role) -> Iterator[Drawn]:
    if distance(one, other) > SAME:
        yield Aligned(one, other, number(distance(one, other), profile.unit) + " off", role)


def _both_places(fact: Fact, profile: Profile, known: Known, role: Role) -> Iterator[Drawn]:
    """Where the other words put a point, where this one puts it, and the gap."""
    given = profile.givens[fact.given]
    if given.word is None:
        return
    if isinstance(fact, Heading):
        tail, head = known.points.get(fact.tail), known.points.get(fact.head)
        if tail is not None and head is not None and distance(tail, head) > SAME:
            way = toward(float(given.value))
            there = foot(head, tail, way)
            reach = distance(tail, head) * 1.15
            yield Thin(tail, along(tail, way, reach), role)
            yield from _gap(there, head, profile, role)
            yield Mark(there, Kind.OTHER, role=role)
    elif isinstance(fact, Coordinate | Offset) and given.unit is Unit.MM:
        at = known.points.get(fact.point)
        if at is None:
            return
        value = float(given.value)
        if isinstance(fact, Offset):
            origin = known.points.get(fact.origin)
            if origin is None:
                return
            value += origin[fact.axis]
        there = (value, at[1]) if fact.axis == FIRST else (at[0], value)
        way = (0.0, 1.0) if fact.axis == FIRST else (1.0, 0.0)
        yield Thin(there, along(there, way, 1.0), role, is_endless=True)
        yield from _gap(there, at, profile, role)
        if distance(there, at) > SAME:
            yield Mark(there, Kind.OTHER, role=role)


def _line_through(point: str, profile: Profile, known: Known) -> Ray | None:
    """The line of known place and direction on which a point must lie."""
    for fact in profile.facts:
        if isinstance(fact, Heading) and point in (fact.tail, fact.head):
            other = known.points.get(fact.head if fact.tail == point else fact.tail)
            if other is not None:
                return other, toward(float(profile.givens[fact.given].value))
        if isinstance(fact, Collinear) and point == fact.point:
            tail, through = known.points.get(fact.tail), known.points.get(fact.through)
            if tail is not None and through is not None and distance(tail, through) > 0:
                return tail, unit(minus(through, tail))
    return None


def _circles_through(point: str, profile: Profile, known: Known) -> list[tuple[Point, float]]:
    """The known circles on which a point must lie."""
    found = []
    for fact in profile.facts:
        if isinstance(fact, OnCircle) and fact.point == point:
            center, radius = known.points.get(fact.center), known.radii.get(fact.radius)
            if center is not None and radius is not None and (center, radius) not in found:
                found.append((center, radius))
    return found


def _missed(refusal: Refusal, profile: Profile, known: Known) -> Iterator[Drawn]:
    ray, circles = _line_through(refusal.subject, profile, known), _circles_through(refusal.subject, profile, known)
    if ray is None or not circles:
        return
    (on, way), (center, radius) = ray, circles[0]
    near = foot(center, on, way)
    yield Ring(center, radius, Role.CONFLICTING)
    yield Thin(on, along(on, way, 1.0), Role.CONFLICTING, is_endless=True)
    yield from _gap(along(center, unit(minus(near, center)), radius), near, profile, Role.CONFLICTING)


def _apart(refusal: Refusal, profile: Profile, known: Known) -> Iterator[Drawn]:
    circles = _circles_through(refusal.subject, profile, known)
    for center, radius in circles:
        yield Ring(center, radius, Role.CONFLICTING)
    if len(circles) > 1:
        (one, first), (other, second) = circles[:2]
        way = unit(minus(other, one))
        if distance(one, other) >= max(first, second):
            yield from _gap(along(one, way, first), along(other, way, -second), profile, Role.CONFLICTING)
        elif first >= second:
            yield from _gap(along(one, way, first), along(other, way, second), profile, Role.CONFLICTING)
        else:
            yield from _gap(along(one, way, -first), along(other, way, -second), profile, Role.CONFLICTING)


def _parallel(refusal: Refusal, profile: Profile, known: Known) -> Iterator[Drawn]:
    """The lines that words make, and how far apart they are."""
    names = set(refusal.givens)
    rays: list[Ray] = []
    for fact in profile.facts:
        if fact.given not in names:
            continue
        if isinstance(fact, Heading):
            at = known.points.get(fact.tail, known.points.get(fact.head))
            if at is not None:
                rays.append((at, toward(float(profile.givens[fact.given].value))))
        elif isinstance(fact, Coordinate):
            start = known.points[profile.figure.start]
            value = float(profile.givens[fact.given].value)
            at = (value, start[1]) if fact.axis == FIRST else (start[0], value)
            rays.append((at, (0.0, 1.0) if fact.axis == FIRST else (1.0, 0.0)))
    shown: list[Ray] = []
    for on, way in rays:
        for other, direction in shown:
            is_same = abs(way[0] * direction[1] - way[1] * direction[0]) < SAME
            there = foot(on, other, direction)
            if is_same and distance(on, there) > SAME:
                yield Thin(other, along(other, direction, 1.0), Role.CONFLICTING, is_endless=True)
                yield Thin(on, along(on, way, 1.0), Role.CONFLICTING, is_endless=True)
                yield Aligned(there, on, number(distance(on, there), profile.unit) + " apart", Role.CONFLICTING)
                return
        shown.append((on, way))


def _off_circle(refusal: Refusal, profile: Profile, known: Known) -> Iterator[Drawn]:
    at = known.points.get(refusal.subject)
    for center, radius in _circles_through(refusal.subject, profile, known)[:1]:
        yield Ring(center, radius, Role.CONFLICTING)
        if at is not None and hypot(*minus(at, center)) > SAME:
            yield from _gap(along(center, unit(minus(at, center)), radius), at, profile, Role.CONFLICTING)


def _too_small(refusal: Refusal, profile: Profile, known: Known) -> Iterator[Drawn]:
    """The chord that is longer than the diameter."""
    ends = [fact.point for fact in profile.facts if isinstance(fact, OnCircle) and fact.center == refusal.subject]
    places = [known.points[name] for name in dict.fromkeys(ends) if name in known.points]
    if len(places) > 1:
        limit = number(2 * refusal.values.get("actual", 0.0), profile.unit)
        chord = number(distance(places[0], places[1]), profile.unit)
        yield Aligned(places[0], places[1], f"{chord}, the diameter is {limit}", Role.CONFLICTING)


def _reversed(refusal: Refusal, profile: Profile, known: Known) -> Iterator[Drawn]:
    """The way in which a line should run."""
    for element in profile.figure.path:
        heading = element.heading if isinstance(element, Line) else None
        if element.name == refusal.subject and heading is not None and heading in profile.givens:
            tail, head = known.points.get(element.tail), known.points.get(element.head)
            if tail is not None and head is not None:
                way = toward(float(profile.givens[heading].value))
                yield Thin(tail, along(tail, way, 0.4 * distance(tail, head)), Role.CONFLICTING)
