"""Facts about a whole line or circle that hold beyond the part of it that is cut."""

from collections.abc import Iterator
from math import atan2, hypot, tau

from contoursolve.diagnosis.explain import Context, report
from contoursolve.diagnosis.wording import place_text
from contoursolve.diagnostics import Basis, Diagnostic
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    CornerShape,
    Fact,
    OnCircle,
    Profile,
    TangentCircles,
    TangentLine,
    Through,
    Values,
)
from contoursolve.reading import ReadIssue
from contoursolve.solving import Contour, LineSegment, Point, Segment, Solution, lookup, scalars_of
from contoursolve.tolerance import AGREEMENT


def explain_beyond(context: Context, profile: Profile, solution: Solution, contour: Contour) -> Iterator[Diagnostic]:
    """The facts that hold at a place of a line or a circle that the path does not reach."""
    at = lookup(profile, {**solution.scalars, **scalars_of(solution.points), **solution.radii})
    cut = {segment.name: segment for segment in contour.elements}
    fillets = (corner.name for corner in profile.figure.corners if corner.shape is CornerShape.FILLET)
    round_ones = {f"{name}.center": name for name in fillets}
    round_ones |= {arc.center: arc.name for arc in profile.figure.path if isinstance(arc, Arc)}
    ends = {point for element in profile.figure.path for point in (element.tail, element.head)}
    for fact in profile.facts:
        # How far a line is from another one holds of all of it, wherever the end of that lies.
        is_apart = (isinstance(fact, TangentLine) and fact.center in ends) or (
            isinstance(fact, Through) and fact.point in ends
        )
        if not fact.given or is_apart:
            continue
        for name, place in _places(fact, at):
            segment = cut.get(round_ones.get(name, name))
            if segment is not None and not _is_on(segment, place):
                word, shown = profile.givens[fact.given].word, place_text(profile, scalars_of({"": place}))
                whole, about = "line" if isinstance(segment, LineSegment) else "circle", ReadIssue.FACT_BEYOND
                yield report(context, about, Basis.NUMERICAL, [word], element=segment.name, whole=whole, place=shown)


def _places(fact: Fact, at: Values) -> Iterator[tuple[str, Point]]:
    """The lines (by name) and the circles (by center) that a fact is about, and where it holds."""
    match fact:
        case Through(line=line, point=point):
            yield line, _point(at, point)
        case OnCircle(point=point, center=center):
            yield center, _point(at, point)
        case TangentLine(line=line, center=center):
            (first, second), (cosine, sine, offset) = _point(at, center), at.line(line)
            left = cosine * second - sine * first - offset
            foot = first + left * sine, second - left * cosine
            yield line, foot
            yield center, foot
        case TangentCircles(first=(center, radius), second=(other, other_radius)):
            here, there = _point(at, center), _point(at, other)
            between = hypot(there[FIRST] - here[FIRST], there[SECOND] - here[SECOND])
            # Of two circles one in the other, the smaller one touches on the side away from the larger one's center.
            is_inner = at.radius(radius) < at.radius(other_radius) and between < at.radius(other_radius)
            way = float(at.radius(radius)) / between * (-1 if is_inner else 1)
            contact = tuple(a + way * (b - a) for a, b in zip(here, there, strict=True))
            yield center, (contact[FIRST], contact[SECOND])
            yield other, (contact[FIRST], contact[SECOND])


def _point(at: Values, name: str) -> Point:
    return float(at.coordinate(name, FIRST)), float(at.coordinate(name, SECOND))


def _is_on(segment: Segment, place: Point) -> bool:
    """Whether a place of the line or the circle of an element lies on the element, or within the least increment."""
    if isinstance(segment, LineSegment):
        along = [(end - start) / segment.length for start, end in zip(segment.start, segment.end, strict=True)]
        way = sum(part * (at - start) for part, at, start in zip(along, place, segment.start, strict=True))
        return -AGREEMENT <= way <= segment.length + AGREEMENT
    begin, angle = (
        atan2(each[SECOND] - segment.center[SECOND], each[FIRST] - segment.center[FIRST])
        for each in (segment.start, place)
    )
    way = ((angle - begin) * segment.turn.sign) % tau * segment.radius
    return way <= segment.length + AGREEMENT or tau * segment.radius - way <= AGREEMENT
