"""Every word as a dimension where it belongs on the drawing."""

from collections.abc import Iterator, Mapping
from math import atan2, degrees, inf

from contoursolve.constraints import Coordinate, Heading, Offset, Radius
from contoursolve.contour import ArcSegment, Segment
from contoursolve.examine import Answer
from contoursolve.model import FIRST, SECOND, Arc, CornerShape, Fact, Profile, Unit
from contoursolve.pictures.known import Known
from contoursolve.pictures.scene import Aligned, Angle, Dimension, Leader, Linear, Ordinate
from contoursolve.pictures.theme import Role
from contoursolve.pictures.vectors import along, distance, middle, minus, on_arc, unit
from contoursolve.pictures.wording import number, word_text
from contoursolve.source import Span
from contoursolve.wording import length_limit

_BESIDE_ARROW = 0.36
"""Of an arc, from its start: where its radius is written, off the arrow in its middle."""


def list_dimensions(
    answer: Answer, known: Known, roles: Mapping[str, Role], elements: Mapping[str, Segment], noted: frozenset[str]
) -> Iterator[Dimension]:
    """The dimensions of all words, and of the values that were asked for; without the coordinates that stand beside
    their points (`noted`)."""
    profile = answer.profile
    seen: set[tuple[str, type]] = set()
    measured: set[Span] = set()
    for fact in (*profile.facts, *profile.ignored):
        given = profile.givens.get(fact.given)
        if given is None or given.word is None or fact.given in noted or (fact.given, type(fact)) in seen:
            continue
        text = word_text(given.word.text) + (" dia" if given.is_diameter else "")
        drawn = dimension_of(fact, profile, known, elements, text, roles.get(fact.given, Role.GIVEN))
        if drawn is not None:
            seen.add((fact.given, type(fact)))
            measured.add(given.word.span)
            yield drawn
    yield from _corners(profile, known, roles, elements, measured)
    for asked in answer.answers:
        question = asked.question
        if asked.value is None:
            continue
        value = asked.value * (2 if question.is_diameter else 1)
        shown = f"{value:.3f}".rstrip("0").rstrip(".") if question.unit is Unit.DEGREE else number(value, answer.unit)
        text = f"{word_text(question.word.text).rstrip(' =?')} = {shown}"
        drawn = dimension_of(question.fact, profile, known, elements, text, Role.DERIVED, asked.value)
        if drawn is not None:
            yield drawn


def dimension_of(
    fact: Fact,
    profile: Profile,
    known: Known,
    elements: Mapping[str, Segment],
    text: str,
    role: Role,
    value: float | None = None,
) -> Dimension | None:
    """How a fact stands on a drawing; None where its points are not known, or where it has no such form."""
    points = known.points
    if isinstance(fact, Coordinate):
        at = known.coordinate(fact.point, fact.axis)
        if fact.point in points:
            return Ordinate(points[fact.point], fact.axis, text, role)
        start = points.get(profile.figure.start)
        if at is None or start is None:
            return None
        return Ordinate((at, start[SECOND]) if fact.axis == FIRST else (start[FIRST], at), fact.axis, text, role)
    if isinstance(fact, Offset):
        origin, end = points.get(fact.origin), points.get(fact.point)
        coordinate = known.coordinate(fact.point, fact.axis)
        if origin is not None and end is None and coordinate is not None:
            end = (coordinate, origin[SECOND]) if fact.axis == FIRST else (origin[FIRST], coordinate)
        return Linear(origin, end, fact.axis, text, role) if origin is not None and end is not None else None
    if isinstance(fact, Heading):
        at_point = points.get(fact.tail, points.get(fact.head))
        angle = float(profile.givens[fact.given].value) if fact.given in profile.givens else value
        return Angle(at_point, angle, text, role) if at_point is not None and angle is not None else None
    if isinstance(fact, Radius):
        return _radius(fact.radius, profile, known, elements, text, role)
    return _further(fact, profile, known, text, role, value)


def _radius(
    name: str, profile: Profile, known: Known, elements: Mapping[str, Segment], text: str, role: Role
) -> Dimension | None:
    """The radius of an arc of the path, or of a rounding."""
    for element in profile.figure.path:
        if isinstance(element, Arc) and element.radius == name:
            drawn = elements.get(element.name)
            if isinstance(drawn, ArcSegment):
                return pointing_at(drawn, text, role)
            center, radius = known.points.get(element.center), known.radii.get(name)
            if center is not None and radius is not None:
                way = unit(minus(known.points.get(element.tail, (center[0] + 1, center[1] + 1)), center))
                return Leader(along(center, way, radius), way, text, role)
    corner = elements.get(name.rpartition(".")[0])
    return pointing_at(corner, text, role) if corner is not None else None


def pointing_at(segment: Segment, text: str, role: Role) -> Leader:
    """A word that points at the middle of an element; at an arc from outside."""
    at, way = middle(segment)
    if isinstance(segment, ArcSegment):
        if not segment.name.startswith("corner"):
            at, way = on_arc(segment, _BESIDE_ARROW)
        return Leader(at, unit(minus(at, segment.center)), text, role)
    return Leader(at, (-way[1], way[0]), text, role)


def _corners(
    profile: Profile, known: Known, roles: Mapping[str, Role], elements: Mapping[str, Segment], shown: set[Span]
) -> Iterator[Dimension]:
    """The sizes of corners, but for those that a distance shows."""
    for corner in profile.figure.corners:
        given = profile.givens.get(corner.size)
        if given is None or given.word is None or given.word.span in shown:
            continue
        text = word_text(given.word.text)
        text += " x 45°" if corner.shape is CornerShape.CHAMFER_AXIS_45 else ""
        role = roles.get(corner.size, Role.GIVEN)
        limit = _limit(known, corner.name)
        if limit is not None:
            largest = length_limit(limit, profile.unit)
            text += f" (max {number(float(largest * profile.unit.in_mm), profile.unit)})"
        drawn, at = elements.get(corner.name), known.points.get(corner.at)
        if drawn is not None:
            pointed = pointing_at(drawn, text, role)
            if at is not None and not isinstance(drawn, ArcSegment):
                # From the side of the virtual intersection.
                pointed = Leader(pointed.at, unit(minus(at, pointed.at)), text, role)
            yield pointed
        elif at is not None:
            yield Leader(at, (1.0, 1.0), text, role)


def _limit(known: Known, corner: str) -> float | None:
    """The largest size of a corner that is too large."""
    for refusal in known.refusals:
        if refusal.subject == corner and 0 < refusal.values.get("limit", 0) < inf:
            return refusal.values["limit"]
    return None


def _further(
    fact: Fact, profile: Profile, known: Known, text: str, role: Role, value: float | None
) -> Dimension | None:
    """Facts that no word of a control states."""
    from contoursolve.constraints import Directed, Distance, Extent  # noqa: PLC0415 - see `constraints`

    points = known.points
    if isinstance(fact, Distance | Extent):
        tail, head = points.get(fact.tail), points.get(fact.head)
        return Aligned(tail, head, text, role, is_beside=True) if tail is not None and head is not None else None
    if isinstance(fact, Directed):
        try:
            line = profile.figure.line(fact.line)
        except KeyError:
            return None
        tail, head = points.get(line.tail), points.get(line.head)
        if tail is None:
            return None
        given = profile.givens.get(fact.given)
        angle = float(given.value) if given else value
        if angle is None and head is not None and distance(tail, head) > 0:
            angle = degrees(atan2(head[1] - tail[1], head[0] - tail[0]))
        return Angle(tail, angle, text, role) if angle is not None else None
    return None
