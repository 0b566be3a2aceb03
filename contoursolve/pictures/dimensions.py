"""The words of a contour where they belong on its drawing: as dimensions, and beside the points that they state."""

from collections.abc import Iterator, Mapping, Sequence
from math import atan2, degrees, inf

from msgspec.structs import replace

from contoursolve.diagnosis import length_limit
from contoursolve.diagnostics import Span
from contoursolve.geometry import (
    Along,
    Arc,
    Chord,
    Clearance,
    CornerShape,
    Fact,
    Line,
    Placed,
    Tangent,
    Unit,
)
from contoursolve.numeric import trimmed
from contoursolve.pictures.known_points import place_of
from contoursolve.pictures.page import About, TextRun
from contoursolve.pictures.scene import (
    Aligned,
    Angle,
    Dimension,
    Leader,
    LinearDimension,
    Mark,
    MarkKind,
    Ordinate,
    coordinates,
    number,
    word_text,
)
from contoursolve.pictures.subject import PartialDrawing, Subject
from contoursolve.pictures.theme import Role
from contoursolve.solving import (
    DIAGONAL,
    SAME,
    ArcSegment,
    Point,
    Segment,
    along,
    direction,
    distance,
    foot,
    middle,
    on_arc,
    toward,
    with_coordinate,
)

_BESIDE_ARROW = (0.36, 0.64, 0.2, 0.8)
"""Of an arc, from its start: where its radius may be written, off the arrow in its middle."""

_OF_CORNER = (0.5, 0.3, 0.7)
"""The same of a rounding, which has no arrow."""

Noted = Mapping[str, Sequence[str]]
"""By the name of a point, the givens whose words state it in full and stand beside it."""


def list_dimensions(subject: Subject, noted: Noted) -> Iterator[Dimension]:
    """The dimensions of all words, and of the values that were asked for; without the coordinates that stand beside
    their points."""
    profile, elements = subject.profile, subject.elements
    beside = {given for givens in noted.values() for given in givens}
    done: set[tuple[str, type]] = set()
    measured: set[Span] = set()
    for fact in (*profile.facts, *profile.ignored):
        given = profile.givens.get(fact.given)
        if given is None or given.word is None or fact.given in beside or (fact.given, type(fact)) in done:
            continue
        if subject.is_chain and (given.word.span in measured or fact.given not in subject.answer.claim.words):
            continue  # what follows from a word that is drawn already
        text = (subject.word(fact.given) or "") + (" dia" if given.is_diameter else "")
        told = text, subject.role(fact.given), float(given.value)
        drawn = dimension_of(subject, fact, *told)
        drawn = in_chain(subject, fact, *told) if drawn is None and subject.is_chain else drawn
        if drawn is not None:
            done.add((fact.given, type(fact)))
            measured.add(given.word.span)
            yield replace(drawn, about=subject.about(given.word.span))
    yield from _corners(subject, elements, measured)
    for asked in subject.answer.asked:
        question = asked.question
        if asked.value is None:
            continue
        value = asked.value * (2 if question.is_diameter else 1)
        is_angle = question.unit is Unit.DEGREE
        shown = trimmed(value, 3) if is_angle else number(value, subject.answer.unit)
        text = f"{word_text(question.word.text).rstrip(' =?')} = {shown}"
        drawn = dimension_of(subject, question.fact, text, Role.DERIVED, asked.value)
        if drawn is not None:
            yield replace(drawn, about=subject.about(question.word.span))


def dimension_of(subject: PartialDrawing, fact: Fact, text: str, role: Role, value: float) -> Dimension | None:
    """The dimension that shows a fact with a value; None for points that are not known, and for facts without a
    dimension."""
    if fact.placed is not None and fact.placed.is_stepped:
        return _along_axis(subject, fact.placed, text, role)
    if fact.heading is not None:
        tail, head = fact.heading
        at, given = subject.known.points.get(tail, subject.at(head)), subject.profile.givens.get(fact.given)
        base = float((given and given.clockwise_from) or 0)
        return Angle(at, value - base, text, role, base=base) if at is not None else None
    if fact.sizes:
        return _radius(subject, fact.sizes, text, role)
    if fact.span is not None:
        one, other = map(subject.at, fact.span)
        return Aligned(one, other, text, role, is_beside=True) if one is not None and other is not None else None
    if fact.directed:
        lines = (*subject.profile.figure.path, *subject.profile.figure.lines)
        at = next((subject.at(line.tail) for line in lines if line.name == fact.directed), None)
        return Angle(at, value, text, role) if at is not None else None
    return _apart(subject, fact.beside, text, role) if fact.beside is not None else None


def _along_axis(subject: PartialDrawing, placed: Placed, text: str, role: Role) -> Dimension | None:
    """A coordinate, or how far along an axis a point is from another one."""
    coordinate = subject.known.coordinate(placed.point, placed.axis)
    at, origin = subject.at(placed.point), subject.at(placed.origin or subject.profile.figure.start)
    if at is None and coordinate is not None and origin is not None:
        at = with_coordinate(origin, placed.axis, coordinate)
    if at is None or (placed.origin and origin is None):
        return None
    if placed.origin and origin is not None:
        return LinearDimension(origin, at, placed.axis, text, role)
    return Ordinate(at, placed.axis, text, role)


def in_chain(subject: PartialDrawing, fact: Fact, text: str, role: Role, value: float) -> Dimension | None:
    """The same of facts that words state of chains of lines and arcs alone."""
    if fact.vertex:
        at = subject.at(fact.vertex)
        return Angle(at, value, text, role) if at is not None else None
    if fact.turn_between is not None:
        first, second = fact.turn_between
        base, at = _way(subject, first), _begin(subject, second)
        is_angle = subject.profile.givens[fact.given].unit is Unit.DEGREE
        return Angle(at, value, text, role, base=base) if is_angle and at is not None and base is not None else None
    if fact.radius_step is not None:
        radius, origin = fact.radius_step
        circle = next(each for one in subject.profile.facts if (each := one.circle) and each.radius == radius)
        pole, at, size = subject.at(circle.center), subject.at(circle.point), subject.known.radii.get(origin)
        if size is None or pole is None or at is None:
            return None
        return Aligned(along(pole, direction(pole, at), size), at, text, role)
    if fact.sizes:
        # The distance of what a line or an arc passes.
        for other in subject.profile.facts:
            if other.beside is not None and fact.sizes in other.reads():
                return _beside(subject, other.beside, text, role)
    if fact.parallel is not None:
        line = subject.elements.get(fact.parallel[1])
        if line is None:
            return None
        way = direction(line.start, line.end)
        # Off the arrow in its middle.
        return Leader(along(line.start, way, line.length * _BESIDE_ARROW[0]), (-way[1], way[0]), text, role)
    if fact.placed is not None and not fact.placed.is_stepped:
        at = subject.at(fact.placed.origin)
        return Leader(at, (-1.0, 1.0), text, role) if at is not None else None
    return None


def _way(subject: PartialDrawing, of: Along | Tangent | Chord) -> float | None:
    """The direction of an element or of a chord where it ends, degrees."""
    if isinstance(of, Chord):
        tail, head = subject.at(of.tail), subject.at(of.head)
        return None if tail is None or head is None else _degrees(direction(tail, head))
    if isinstance(of, Tangent):
        center, at = subject.at(of.center), subject.at(of.point)
        if center is None or at is None:
            return None
        return _degrees(direction(center, at)) + 90.0 * of.turn.sign
    line = next((each for each in subject.profile.figure.path if each.name == of.line), None)
    if not isinstance(line, Line):
        return None
    if line.heading is not None:
        return subject.value(line.heading)
    ends = subject.at(line.tail), subject.at(line.head)
    return _degrees(direction(ends[0], ends[1])) if ends[0] is not None and ends[1] is not None else None


def _begin(subject: PartialDrawing, of: Along | Tangent | Chord) -> Point | None:
    """The point at which a line, a tangent or a chord begins to run in its direction."""
    if isinstance(of, Along):
        return next((subject.at(each.tail) for each in subject.profile.figure.path if each.name == of.line), None)
    return subject.at(of.tail if isinstance(of, Chord) else of.point)


def _degrees(way: Point) -> float:
    return degrees(atan2(way[1], way[0]))


def _apart(subject: PartialDrawing, beside: Clearance, text: str, role: Role) -> Dimension | None:
    """The distance between a centre that is not drawn and a line or circle that touches its circle."""
    figure = subject.profile.figure
    at = subject.known.points.get(beside.center, place_of(subject.profile, beside.center))
    if at is None or beside.radius not in figure.known_radii or beside.radius in {one.radius for one in figure.circles}:
        return None
    # Of a fact that is too long to stand on a drawing, the distance counts.
    text = number(subject.value(beside.radius), subject.profile.unit) if text.endswith("…") else text
    return _beside(subject, beside, text, role)


def _beside(subject: PartialDrawing, beside: Clearance, text: str, role: Role) -> Dimension | None:
    """The distance of a place from a line or a circle."""
    at = subject.known.points.get(beside.center, place_of(subject.profile, beside.center))
    if at is None:
        return None
    if beside.line:
        ray = subject.ray(beside.line)
        return Aligned(at, foot(at, *ray), text, role) if ray is not None else None
    circle = subject.circle(*beside.circle)
    return Aligned(at, along(circle[0], direction(circle[0], at), circle[1]), text, role) if circle else None


def _radius(subject: PartialDrawing, name: str, text: str, role: Role) -> Dimension | None:
    """The radius of an arc of the path, of a circle, or of a rounding."""
    elements = subject.elements
    for each in subject.profile.figure.circles:
        found = subject.circle(each.center, each.radius) if each.radius == name else None
        if found is not None:
            return around(*found, DIAGONAL, text, role)
    for element in subject.profile.figure.path:
        if isinstance(element, Arc) and element.radius == name:
            drawn, circle = elements.get(element.name), subject.circle(element.center, name)
            if isinstance(drawn, ArcSegment):
                return _pointing(drawn, text, role)
            if circle is not None:
                tail = subject.at(element.tail)
                way = direction(circle[0], tail if tail is not None else along(circle[0], (1, 1), 1))
                return Leader(along(circle[0], way, circle[1]), way, text, role, center=circle[0])
    corner = elements.get(name.rpartition(".")[0])
    return _pointing(corner, text, role) if corner is not None else None


def _pointing(segment: Segment, text: str, role: Role) -> Leader:
    """A word that points at the middle of an element; at an arc from outside."""
    at, way = middle(segment)
    if not isinstance(segment, ArcSegment):
        return Leader(at, (-way[1], way[0]), text, role)
    first, *others = _OF_CORNER if segment.name.startswith("corner") else _BESIDE_ARROW
    at, rest = on_arc(segment, first)[0], tuple(on_arc(segment, share)[0] for share in others)
    return Leader(at, direction(segment.center, at), text, role, center=segment.center, others=rest)


def around(center: Point, radius: float, way: Point, text: str, role: Role) -> Leader:
    """A word that points at a whole circle, in a direction from its centre if there is room."""
    spokes = [
        (way[0] * x - way[1] * y, way[0] * y + way[1] * x) for x, y in map(toward, (45, -45, 90, -90, 135, -135, 180))
    ]
    others = tuple(along(center, spoke, radius) for spoke in spokes)
    return Leader(along(center, way, radius), way, text, role, center=center, others=others)


def _corners(subject: Subject, elements: Mapping[str, Segment], measured: set[Span]) -> Iterator[Dimension]:
    """The sizes of corners, but for those that a distance shows."""
    profile = subject.profile
    for corner in profile.figure.corners:
        given = profile.givens.get(corner.size)
        if given is None or given.word is None or given.word.span in measured:
            continue
        text = subject.word(corner.size) or ""
        text += " x 45°" if corner.shape is CornerShape.CHAMFER_AXIS_45 else ""
        role, about = subject.role(corner.size), subject.about(given.word.span)
        limits = [
            refusal.values.get("limit", 0) for refusal in subject.known.refusals if refusal.subject == corner.name
        ]
        for limit in [limit for limit in limits if 0 < limit < inf][:1]:
            largest = length_limit(limit, profile.unit)
            text += f" (max {number(float(largest * profile.unit.in_mm), profile.unit)})"
        drawn, at = elements.get(corner.name), subject.at(corner.at)
        if drawn is not None:
            pointed = _pointing(drawn, text, role)
            if at is not None and not isinstance(drawn, ArcSegment):
                # From the side of the virtual intersection.
                pointed = Leader(pointed.at, direction(pointed.at, at), text, role)
            yield replace(pointed, about=about)
        elif at is not None:
            yield Leader(at, (1.0, 1.0), text, role, about)


# Points ------------------------------------------------------------------------------------------------------

BETWEEN = "  "
"""Separator of the pieces of a label."""

Others = Mapping[str, Sequence[tuple[Point, str]]]
"""By the name of a point, where it is in other solutions, with the words that select each."""


def noted_points(subject: Subject) -> Noted:
    """The points of which words state both coordinates, first axis first."""
    profile = subject.profile
    found: dict[str, dict[int, str]] = {}
    for fact in (*profile.facts, *profile.ignored):
        placed = fact.placed
        if placed is not None and not placed.origin and subject.word(fact.given) is not None:
            found.setdefault(placed.point, {}).setdefault(placed.axis, fact.given)
    return {
        point: tuple(given for _, given in sorted(givens.items()))
        for point, givens in found.items()
        if len(givens) > 1 and subject.at(point) is not None
    }


def list_marks(subject: Subject, noted: Noted, others: Others) -> Iterator[Mark]:
    """The start, the end, the named points, the points that words state in full (`noted`), and centres."""
    start, end = subject.at(subject.profile.figure.start), _end(subject)
    if start is None:
        return
    ranks = {"start": start, **({"end": end} if end is not None else {})}

    def rank(at: Point) -> str:
        return next((name for name, there in ranks.items() if distance(at, there) <= SAME), "")

    spots = _spots(subject)
    if end is not None and all(distance(at, end) > SAME for at, _ in spots):
        spots.append((end, ()))
    for at, names in sorted(spots, key=lambda spot: ("start", "end", "").index(rank(spot[0]))):
        yield from _mark(subject, noted, others, at, names, rank(at))
    for name, places in others.items():
        for at, selects in places:
            if all(distance(at, there) > SAME for there, _ in spots):
                told = (name, selects) if not subject.is_chain else (selects,)
                runs = [TextRun(each, subject.other) for each in told if each]
                label = _joined([*runs, *([] if subject.is_chain else [_computed(subject, at)])])
                yield Mark(at, MarkKind.PLACE, label, _joined(runs), subject.other, About(point=name))


def _end(subject: Subject) -> Point | None:
    """The end of the path with its corner; None if the path is not drawn that far."""
    figure, known = subject.profile.figure, subject.known
    if not subject.trails:
        return None
    last, final = subject.trails[-1].segments[-1], figure.path[-1]
    if subject.answer.contour is not None:
        return last.end
    corners, head = {corner.name for corner in figure.corners if corner.at == final.head}, subject.at(final.head)
    is_whole = last.name in {final.name, *corners} or (head is not None and distance(last.end, head) <= SAME)
    has_corner = known.refusals or corners <= known.corners.keys()
    return last.end if is_whole and has_corner else None


def _spots(subject: Subject) -> list[tuple[Point, tuple[str, ...]]]:
    """Every place with the names of all points there."""
    found: list[tuple[Point, tuple[str, ...]]] = []
    for name, at in subject.known.points.items():
        index = next((n for n, (there, _) in enumerate(found) if distance(there, at) <= SAME), None)
        if index is None:
            found.append((at, (name,)))
        else:
            found[index] = found[index][0], (*found[index][1], name)
    return found


def _mark(subject: Subject, noted: Noted, others: Others, at: Point, spot: Sequence[str], rank: str) -> Iterator[Mark]:
    """The mark of one place, if anything is to be said of it."""
    profile, known = subject.profile, subject.known
    shown = [name for name in spot if name in profile.intersections]
    centers = {element.center for element in profile.figure.path if isinstance(element, Arc)}
    is_center = not centers.isdisjoint(spot) and not shown
    givens = [given for name in spot for given in noted.get(name, ())]
    words = [TextRun(subject.word(given) or "", subject.role(given), subject.about_given(given)) for given in givens]
    is_pole = not set(subject.answer.claim.form.free.poles).isdisjoint(spot)
    if not (rank or shown or words or is_pole):
        if is_center:
            yield Mark(at, MarkKind.CENTER, about=About(point=" ".join(spot)))
        return
    # A corner at the end moves with its size.
    is_end_free = rank == "end" and subject.trails[-1].role is Role.FREE and profile.figure.path[-1].head not in spot
    is_free = not known.placed.isdisjoint(spot) or is_end_free
    # Where the path ends at a virtual intersection, it is the end that counts.
    names = [*([rank] if rank else []), *(name for name in shown if not rank or not name.startswith("V"))]
    if is_free and rank == "end":
        names[0] = "end (free)"
    if is_pole:
        names.append("pole")
    is_several = not known.several.isdisjoint(spot)
    is_candidate = is_several or (subject.other is not Role.GHOST and any(name in others for name in spot))
    several = Role.SEVERAL if subject.is_chain else Role.CANDIDATE
    role = Role.FREE if is_free else several if is_candidate else Role.INK
    short = [TextRun(name, role) for name in names]
    short += _choosing(subject, others, at, spot)
    about = words
    if not words and (rank == "start" or is_pole):
        about = [TextRun(coordinates(at, subject.answer.plane, subject.answer.unit), Role.MUTED)]
    elif names and not words and not is_free and not (is_candidate and subject.is_chain):
        about = [_computed(subject, at)]
    is_cut = not {corner.at for corner in profile.figure.corners}.isdisjoint(spot)
    is_center = is_center or is_pole
    kind = MarkKind(rank) if rank else MarkKind.CENTER if is_center else MarkKind.VIRTUAL if is_cut else MarkKind.PLACE
    named = About(point=" ".join(dict.fromkeys([*([rank] if rank else []), *spot])))
    yield Mark(at, kind, _joined([*short, *about]), _joined(short), role, named)


def _choosing(subject: Subject, others: Others, at: Point, spot: Sequence[str]) -> Iterator[TextRun]:
    """The words that choose this place, or would."""
    for choice in subject.profile.choices:
        word = subject.word(choice.given)
        # The sign of a radius chooses a centre, and is shown with the radius.
        if choice.point in spot and choice.point in subject.profile.intersections and word is not None:
            yield TextRun(word, subject.role(choice.given), subject.about_given(choice.given))
    for name in spot:
        texts = (text for there, text in others.get(name, ()) if distance(there, at) <= SAME)
        yield from [TextRun(text, subject.other) for text in texts if text][:1]


def _computed(subject: Subject, at: Point) -> TextRun:
    return TextRun(coordinates(at, subject.answer.plane, subject.answer.unit), Role.DERIVED)


def _joined(runs: Sequence[TextRun]) -> tuple[TextRun, ...]:
    """Runs with what parts them."""
    return tuple(replace(run, text=(BETWEEN if number else "") + run.text) for number, run in enumerate(runs))
