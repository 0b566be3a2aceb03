"""Everything drawn around the path: construction lines and circles, places that facts name, free movement and
faults."""

from collections.abc import Callable, Iterator, Mapping

from contoursolve.geometry import (
    Arc,
    Fact,
    Line,
    Unit,
    line_scalars,
)
from contoursolve.pictures.known_points import place_beside, place_of
from contoursolve.pictures.scene import Aligned, Leader, Mark, MarkKind, Part, Ring, Slide, Thin, Trail, number
from contoursolve.pictures.subject import Subject
from contoursolve.pictures.theme import Role
from contoursolve.solving import (
    ALONG_AXIS,
    SAME,
    LineSegment,
    Point,
    Refusal,
    RefusalKind,
    Status,
    along,
    direction,
    distance,
    foot,
    toward,
    with_coordinate,
)

Ray = tuple[Point, Point]
"""A place on a line and its unit direction."""


def list_auxiliary(subject: Subject) -> Iterator[Part]:
    """Everything, in the order in which it is drawn."""
    yield from _cut_off(subject)
    yield from _tangents(subject)
    faults = [*_faults(subject)]
    broken = [(each.center, each.radius) for each in faults if isinstance(each, Ring)]
    yield from (ring for ring in _rings(subject) if (ring.center, ring.radius) not in broken)
    yield from faults
    yield from _places(subject)
    yield from _led(subject) if subject.is_chain else ()
    if subject.is_chain and subject.answer.contour is None:
        yield from _open_elements(subject)
    yield from _slides(subject)


def _cut_off(subject: Subject) -> Iterator[Thin]:
    """From the path to the virtual intersections that its corners cut off."""
    figure, elements = subject.profile.figure, subject.elements
    lines = {element.name for element in (*figure.path, *figure.lines) if isinstance(element, Line)}
    for corner in figure.corners:
        built, at = subject.known.corners.get(corner.name), subject.at(corner.at)
        if built is None or at is None or corner.name not in elements:
            continue
        if corner.before in lines:
            yield Thin(built.begin, at, Role.MUTED)
        if corner.after is None or corner.after in lines:
            yield Thin(at, built.end, Role.MUTED)


def _tangents(subject: Subject) -> Iterator[Thin]:
    """From where a line of the path ends to where it touches a circle beyond."""
    for fact in subject.profile.facts if subject.profile.is_extended else ():
        beside = fact.beside
        if beside is not None and beside.line and (ends := subject.ends(beside.line)) is not None:
            center = subject.known.points.get(beside.center, place_of(subject.profile, beside.center))
            if center is not None:
                yield from _extension(ends, foot(center, ends[0], direction(*ends)))


def _extension(ends: Ray, there: Point) -> Iterator[Thin]:
    """From the nearer end of a line to a place on it that lies beyond."""
    if max(distance(end, there) for end in ends) > distance(*ends) + SAME:
        yield Thin(min(ends, key=lambda end: distance(end, there)), there, Role.MUTED)


def _rings(subject: Subject) -> Iterator[Ring]:
    """The whole circles of arcs on which an intersection lies, and those that facts give."""
    profile = subject.profile
    chosen = {choice.point for choice in profile.choices if choice.given}
    for element in profile.figure.path:
        circle = subject.circle(element.center, element.radius) if isinstance(element, Arc) else None
        if circle is not None and (chosen & {element.tail, element.head} or subject.answer.contour is None):
            is_open = subject.is_chain and subject.answer.status is Status.UNDERDETERMINED
            is_open = is_open and element.name not in subject.elements
            yield Ring(*circle, Role.OPEN if is_open else Role.MUTED)
    for each in profile.figure.circles:
        center = place_of(profile, each.center)
        if center is not None and each.radius in profile.givens:
            yield Ring(center, subject.value(each.radius), Role.GIVEN)


def _led(subject: Subject) -> Iterator[Thin]:
    """The radius of an arc to where a word states its direction, and lines as far as the points on them."""
    for fact in subject.profile.facts:
        if fact.passes is not None:
            at, ends = subject.at(fact.passes[1]), subject.ends(fact.passes[0])
            yield from _extension(ends, at) if at is not None and ends is not None else ()
        elif fact.spoke is not None and subject.word(fact.given):
            center, at = map(subject.at, fact.spoke)
            if center is not None and at is not None:
                yield Thin(center, at, Role.MUTED)


def _open_elements(subject: Subject) -> Iterator[Part]:
    """The known parts of elements that have too few data: a line through a known point, or the chord of an arc. Circles
    of arcs are drawn as circles."""
    reach = _reach(subject)
    role = Role.OPEN if subject.answer.status is Status.UNDERDETERMINED else Role.CONFLICTING
    for element in subject.profile.figure.path:
        if element.name in subject.elements:
            continue
        tail, head = subject.at(element.tail), subject.at(element.head)
        if isinstance(element, Arc):
            if tail is not None and head is not None:
                yield Thin(tail, head, role)
            continue
        way = _way_of(subject, element)
        if way is None:
            continue
        if tail is not None or head is not None:
            begin = tail if tail is not None else along(head or (0.0, 0.0), way, -reach)
            yield Trail((LineSegment(element.name, begin, along(begin, way, reach)),), role)
        elif line_scalars(element.name)[2] in subject.known.scalars:
            offset = subject.known.scalars[line_scalars(element.name)[2]]
            on = -way[1] * offset, way[0] * offset
            yield _endless(on, way, role)


def _way_of(subject: Subject, line: Line) -> Point | None:
    """The direction of a line, if it is stated or known."""
    if line.heading is not None:
        return toward(subject.value(line.heading)) if line.heading in subject.profile.givens else None
    cosine, sine = (subject.known.scalars.get(name) for name in line_scalars(line.name)[:2])
    return (cosine, sine) if cosine is not None and sine is not None else None


def _reach(subject: Subject) -> float:
    """Length to which open lines are drawn, mm: half the extent of what is known."""
    known = [*subject.known.points.values()]
    for each in subject.profile.figure.path:
        circle = subject.circle(each.center, each.radius) if isinstance(each, Arc) else None
        known += [along(circle[0], way, circle[1]) for way in ALONG_AXIS] if circle is not None else []
    spans = [max(values) - min(values) for values in zip(*known, strict=True)]
    return max(spans, default=0.0) / 2 or _ALONE


_ALONE = 10.0
"""mm of an open line where nothing else is known."""


def _slides(subject: Subject) -> Iterator[Slide]:
    """The points that can still move, each with its direction, or None if it moves freely."""
    profile, known = subject.profile, subject.known
    if subject.answer.contour is not None or not known.placed:
        return
    shown = {*profile.intersections, *(point for each in profile.figure.path for point in (each.tail, each.head))}
    yield from (Slide(at, known.ways.get(name)) for name, at in known.points.items() if name in known.placed & shown)


def _places(subject: Subject) -> Iterator[Part]:
    """Each place with its fact, the line or circle as far as that, and the gap where they miss each other."""
    for fact in subject.profile.facts:
        if (beside := place_beside(subject.profile, fact)) is not None:
            yield Mark(beside, MarkKind.CENTER)
        passes, on = fact.passes, fact.circle
        point = on.point if on is not None else passes[1] if passes is not None else ""
        if point not in subject.profile.figure.places:
            continue
        text, at = subject.word(fact.given), place_of(subject.profile, point)
        if text is None or at is None:
            continue
        role, there = subject.role(fact.given), None
        yield Mark(at, MarkKind.CENTER)
        yield Leader(at, (1.0, 1.0), text, role)
        if on is not None:
            circle = subject.circle(on.center, on.radius)
            there = _on_circle(*circle, at) if circle is not None and distance(at, circle[0]) > SAME else None
        elif passes is not None and (ends := subject.ends(passes[0])) is not None:
            there = foot(at, ends[0], direction(*ends))
            yield from _extension(ends, there)
        if there is not None and role is Role.CONFLICTING:
            yield from _gap(subject, there, at)


# Faults ------------------------------------------------------------------------------------------------------


def _faults(subject: Subject) -> Iterator[Part]:
    """Drawings of the refusals, and of the facts that are ignored."""
    for refusal in subject.known.refusals:
        if refusal.kind in _OF_REFUSALS:
            yield from _OF_REFUSALS[refusal.kind](subject, refusal)
    for fact in subject.profile.ignored:
        yield from _both_places(subject, fact, Role.IGNORED)


def _gap(
    subject: Subject, one: Point, other: Point, role: Role = Role.CONFLICTING, told: str = "off", times: int = 1
) -> Iterator[Aligned]:
    """The gap between two places, if they are not one; `times` is 2 along an axis of diameters."""
    if distance(one, other) > SAME:
        yield Aligned(one, other, f"{number(times * distance(one, other), subject.profile.unit)} {told}", role)


def _endless(on: Point, way: Point, role: Role = Role.CONFLICTING) -> Thin:
    return Thin(on, along(on, way, 1.0), role, is_endless=True)


def _on_circle(center: Point, radius: float, near: Point) -> Point:
    """The place of a circle that is nearest to another one."""
    return along(center, direction(center, near), radius)


def _disagreeing(subject: Subject, refusal: Refusal) -> Iterator[Part]:
    by_given = {fact.given: fact for fact in subject.profile.facts if fact.given}
    if refusal.subject in by_given:
        yield from _both_places(subject, by_given[refusal.subject], Role.CONFLICTING)


def _both_places(subject: Subject, fact: Fact, role: Role) -> Iterator[Part]:
    """The point as the other words put it, the point as this word puts it, and the gap."""
    given = subject.profile.givens[fact.given]
    if given.word is None:
        return
    if fact.heading is not None:
        tail, head = map(subject.at, fact.heading)
        if tail is not None and head is not None and distance(tail, head) > SAME:
            way = toward(float(given.value))
            there = foot(head, tail, way)
            yield Thin(tail, along(tail, way, distance(tail, head) * 1.15), role)
            yield from _gap(subject, there, head, role)
            yield Mark(there, MarkKind.OTHER, role=role)
    elif fact.placed is not None and given.unit is Unit.MM:
        placed = fact.placed
        at, origin = subject.at(placed.point), subject.at(placed.origin) if placed.origin else (0.0, 0.0)
        if at is None or origin is None:
            return
        there = with_coordinate(at, placed.axis, float(given.value) + origin[placed.axis])
        yield _endless(there, ALONG_AXIS[1 - placed.axis], role)
        yield from _gap(subject, there, at, role, times=1 + given.is_diameter)
        if distance(there, at) > SAME:
            yield Mark(there, MarkKind.OTHER, role=role)


def _missed(subject: Subject, refusal: Refusal) -> Iterator[Part]:
    """A circle, and the line that misses it."""
    ray, circles = _line_through(subject, refusal.subject), subject.circles_through(refusal.subject)
    if ray is None or not circles:
        return
    near = foot(circles[0][0], *ray)
    yield Ring(*circles[0], Role.CONFLICTING)
    yield _endless(*ray)
    yield from _gap(subject, _on_circle(*circles[0], near), near)


def _line_through(subject: Subject, point: str) -> Ray | None:
    """The line of known place and direction on which a point must lie."""
    for fact in subject.profile.facts:
        if fact.heading is not None and point in fact.heading:
            tail, head = fact.heading
            other = subject.at(head if tail == point else tail)
            if other is not None:
                return other, toward(subject.value(fact.given))
        if fact.collinear is not None and point == fact.collinear[2]:
            begin, through = map(subject.at, fact.collinear[:2])
            if begin is not None and through is not None and distance(begin, through) > 0:
                return begin, direction(begin, through)
    return None


def _apart(subject: Subject, refusal: Refusal) -> Iterator[Part]:
    """Circles that do not meet."""
    circles = subject.circles_through(refusal.subject)
    yield from (Ring(*circle, Role.CONFLICTING) for circle in circles)
    if len(circles) > 1:
        (one, first), (other, second) = circles[:2]
        way, is_outside = direction(one, other), distance(one, other) >= max(first, second)
        near = along(one, way, first if is_outside or first >= second else -first)
        far = along(other, way, second if not is_outside and first >= second else -second)
        yield from _gap(subject, near, far)


def _parallel(subject: Subject, refusal: Refusal) -> Iterator[Part]:
    """The lines that words make, and how far apart they are."""
    shown: list[Ray] = []
    for fact in (fact for fact in subject.profile.facts if fact.given in set(refusal.givens)):
        placed = fact.placed
        if fact.heading is not None:
            tail, head = fact.heading
            at, way = subject.known.points.get(tail, subject.at(head)), toward(subject.value(fact.given))
        elif placed is not None and not placed.origin:
            start = subject.known.points[subject.profile.figure.start]
            at, way = with_coordinate(start, placed.axis, subject.value(fact.given)), ALONG_AXIS[1 - placed.axis]
        else:
            continue
        if at is None:
            continue
        for other, direct in shown:
            there = foot(at, other, direct)
            if abs(way[0] * direct[1] - way[1] * direct[0]) < SAME and distance(at, there) > SAME:
                yield _endless(other, direct)
                yield _endless(at, way)
                yield from _gap(subject, there, at, told="apart")
                return
        shown.append((at, way))


def _off_circle(subject: Subject, refusal: Refusal) -> Iterator[Part]:
    """A point beside the circle on which it must lie."""
    at = subject.at(refusal.subject)
    for center, radius in subject.circles_through(refusal.subject)[:1]:
        yield Ring(center, radius, Role.CONFLICTING)
        if at is not None and distance(at, center) > SAME:
            yield from _gap(subject, _on_circle(center, radius, at), at)


def _too_small(subject: Subject, refusal: Refusal) -> Iterator[Part]:
    """The chord that is longer than the diameter."""
    facts = (each for fact in subject.profile.facts if (each := fact.circle) and each.center == refusal.subject)
    places = [at for name in dict.fromkeys(fact.point for fact in facts) if (at := subject.at(name)) is not None]
    if len(places) > 1:
        limit = number(2 * refusal.values.get("actual", 0.0), subject.profile.unit)
        chord = number(distance(places[0], places[1]), subject.profile.unit)
        yield Aligned(places[0], places[1], f"{chord}, the diameter is {limit}", Role.CONFLICTING)


def _reversed(subject: Subject, refusal: Refusal) -> Iterator[Part]:
    """The way in which a line should run."""
    for element in subject.profile.figure.path:
        heading = element.heading if isinstance(element, Line) else None
        if element.name == refusal.subject and heading is not None and heading in subject.profile.givens:
            tail, head = subject.at(element.tail), subject.at(element.head)
            if tail is not None and head is not None:
                way = toward(subject.value(heading))
                yield Thin(tail, along(tail, way, 0.4 * distance(tail, head)), Role.CONFLICTING)


_OF_REFUSALS: Mapping[RefusalKind, Callable[[Subject, Refusal], Iterator[Part]]] = {
    RefusalKind.WORDS_DISAGREE: _disagreeing,
    RefusalKind.CIRCLE_MISSED: _missed,
    RefusalKind.CIRCLES_APART: _apart,
    RefusalKind.LINES_PARALLEL: _parallel,
    RefusalKind.RADIUS_DIFFERENCE: _off_circle,
    RefusalKind.RADIUS_TOO_SMALL: _too_small,
    RefusalKind.LINE_REVERSED: _reversed,
    RefusalKind.CORNER_SIGN: _reversed,
}
"""Drawing of each refusal; the other refusals have nothing to be shown."""
