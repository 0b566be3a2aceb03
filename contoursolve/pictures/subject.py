"""Subject of a picture: an answer with everything of it that can be drawn, its path, and the outcome of each word.

A contour that is solved has all its points. One that is refused is worked out as far as its equations go, for a
corner that does not fit has a place as well. What words leave free is put somewhere, and is said to be so.
"""

from collections.abc import Iterator, Mapping
from math import inf, isfinite
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import MOST_CHOICES, Answer, count_choices, word_keys
from contoursolve.diagnostics import Basis, Diagnostic, Severity, Span
from contoursolve.gcode import FACT
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Corner,
    Line,
    Profile,
    Turn,
    assemble,
    line_scalars,
    scalar,
)
from contoursolve.numeric import SIDE
from contoursolve.pictures.known_points import (
    Known,
    by_point,
    complete,
    in_chain,
    in_part,
    is_chosen,
    is_usable,
    known_of,
    start_of,
    with_facts,
)
from contoursolve.pictures.misread_words import counted, is_mended_by, unread
from contoursolve.pictures.page import ANYTHING, About
from contoursolve.pictures.scene import Trail, word_text
from contoursolve.pictures.theme import Role
from contoursolve.reading import ReadIssue
from contoursolve.solving import (
    SAME,
    ArcSegment,
    CornerSolution,
    LineSegment,
    NoteKind,
    Point,
    PointsAt,
    Refusal,
    RefusalKind,
    Segment,
    Status,
    Topic,
    analyse,
    compile_system,
    corner_of,
    direction,
    distance,
    inputs_of,
    is_closed,
    points_with_two_solutions,
    said_twice,
    solve,
)
from contoursolve.tolerance import LENGTH

if TYPE_CHECKING:
    from contoursolve.solving import Alternative


class PartialDrawing(Struct, frozen=True):
    """A drawing of which points are known, and its path as far as it is known."""

    profile: Profile
    known: Known
    trails: tuple[Trail, ...]

    @property
    def elements(self) -> dict[str, Segment]:
        """The drawn elements of the path, by name; of an element that is drawn in several ways, the first."""
        return {segment.name: segment for trail in self.trails[::-1] for segment in trail.segments[::-1]}

    def at(self, point: str) -> Point | None:
        """The coordinates of a point; None if they are not known."""
        return self.known.points.get(point)

    def value(self, given: str) -> float:
        """The value that a given states, mm or degrees."""
        return float(self.profile.givens[given].value)

    def ends(self, name: str) -> tuple[Point, Point] | None:
        """The ends of a line of the path; None if it has no length or is not known."""
        line = next((each for each in self.profile.figure.path if each.name == name), None)
        tail, head = (self.at(line.tail), self.at(line.head)) if isinstance(line, Line) else (None, None)
        return (tail, head) if tail is not None and head is not None and distance(tail, head) > SAME else None

    def ray(self, name: str) -> tuple[Point, Point] | None:
        """A place on a line, and its direction: of the path, or a whole line beside it."""
        ends, names = self.ends(name), line_scalars(name)
        if ends is not None or not self.known.scalars.keys() >= {*names}:
            return None if ends is None else (ends[0], direction(*ends))
        cosine, sine, offset = (self.known.scalars[name] for name in names)
        return (-sine * offset, cosine * offset), (cosine, sine)

    def circle(self, center: str, radius: str) -> tuple[Point, float] | None:
        """A circle of which both centre and radius are known."""
        at, size = self.at(center), self.known.radii.get(radius)
        return (at, size) if at is not None and size is not None else None

    def circles_through(self, point: str) -> list[tuple[Point, float]]:
        """The known circles on which a point must lie."""
        circles = (each for fact in self.profile.facts if (each := fact.circle) and each.point == point)
        found = (self.circle(each.center, each.radius) for each in circles)
        return list(dict.fromkeys(circle for circle in found if circle is not None))


def fitting(answer: Answer) -> list["Alternative"]:
    """The solutions of a contour that were listed and that its words leave."""
    if answer.alternatives is None:
        return []
    from contoursolve.solving import choose, numbers_of, pick  # noqa: PLC0415 - few contours need it

    paths = [each for each in choose(answer.alternatives, answer.profile.choices) if each.is_path]
    left = pick(paths, answer.profile)[0]
    if len(left) > 1 and answer.claim.form.free.picking:
        # As the control counts them.
        left.sort(key=lambda item: [each.number for each in numbers_of(item, paths, answer.profile)])
    return left


def has_several(answer: Answer) -> bool:
    """Whether several contours fit a block and nothing chooses, whatever else keeps it from having one."""
    is_refused = answer.contour is None
    return answer.status is Status.AMBIGUOUS or (is_refused and len(fitting(answer)) > 1)


class Subject(PartialDrawing, frozen=True):
    """An answer with what is drawn of it, and the role of each given whose word is drawn."""

    answer: Answer
    roles: Mapping[str, Role]
    blamed: frozenset[Span]
    """The words and facts that errors are about."""
    named: Mapping[Span, About] = {}
    """Subjects of items that show a word or a fact, by its place."""
    counted: Mapping[Span, str] = {}
    """Values as which words without their decimal point are read, by their places."""

    def role(self, given: str) -> Role:
        """The colour role of a word: given, ignored, conflicting, free or worked out."""
        return self.roles.get(given, Role.GIVEN)

    @property
    def other(self) -> Role:
        """The colour role of other solutions; it is that of a candidate where nothing chooses between them."""
        if not has_several(self.answer):
            return Role.GHOST
        return Role.SEVERAL if self.is_chain else Role.CANDIDATE

    @property
    def is_chain(self) -> bool:
        """Whether it is drawn in the colours of a control that shows the elements of a chain by what is known."""
        return self.answer.claim.form.is_general

    def about(self, span: Span) -> About:
        """The subject of items that show the word or fact at a place."""
        return self.named.get(span, ANYTHING)

    def about_given(self, given: str) -> About:
        """The same by what the word states."""
        found = self.profile.givens.get(given)
        return self.about(found.word.span) if found is not None and found.word is not None else ANYTHING

    def word(self, given: str) -> str | None:
        """The text of the word of a given, of one that lacks its point with what it is read as; None without a word."""
        found = self.profile.givens.get(given)
        if found is None or found.word is None:
            return None
        told, value = word_text(found.word.text), self.counted.get(found.word.span)
        claim = self.answer.claim
        with_it = claim.words.get(claim.form.free.companions.get(given, ""))
        told += f" {word_text(with_it.text)}" if with_it is not None else ""
        return told if value is None else f"{told} = {value}"


def subject_of(answer: Answer) -> Subject:
    """All that a picture of a contour shows."""
    known, lacking = find_known(answer), counted(answer)
    is_slip = bool(lacking) and answer.contour is None and is_mended_by(answer, lacking)
    # A contour is made from it although other words say something else.
    is_doubted = any(each.about is ReadIssue.WORD_IGNORED for each in answer.diagnostics) and answer.contour is not None
    at_fault = lacking if is_slip or is_doubted else ()
    blamed = frozenset({*_blamed(answer, is_slip=is_slip), *unread(answer), *at_fault})
    return Subject(
        answer.profile,
        known,
        tuple(list_trails(answer, known)),
        answer,
        _roles(answer, blamed),
        blamed,
        named_words(answer),
        lacking,
    )


def shared_part(subject: Subject) -> Subject:
    """The subject with only what all contours share that fit; all of it where one is taken."""
    if not subject.known.variants:
        return subject
    trails = tuple(each for each in subject.trails if each.role is not Role.SEVERAL)
    return replace(subject, known=subject.known.shared(), trails=trails)


def named_words(answer: Answer) -> dict[Span, About]:
    """Subjects of words and facts, by place: the key of each, and the errors and warnings that point at it."""
    keys = word_keys(answer.claim.words.values())
    numbers: dict[Span, list[str]] = {}
    for number, finding in enumerate(answer.diagnostics, 1):
        for label in finding.labels if finding.severity is not Severity.INFO else ():
            numbers.setdefault(label.span, []).append(str(number))
    spans = dict.fromkeys([*keys, *numbers])
    return {span: About(keys.get(span, ""), finding=" ".join(dict.fromkeys(numbers.get(span, ())))) for span in spans}


# Words -------------------------------------------------------------------------------------------------------


def _roles(answer: Answer, blamed: frozenset[Span]) -> dict[str, Role]:
    """The colour role of each word, by the given that it states."""
    ignored = {fact.given for fact in answer.profile.ignored}
    roles: dict[str, Role] = {}
    for name, given in answer.profile.givens.items():
        if given.word is not None:
            is_blamed = given.word.span in blamed
            roles[name] = Role.IGNORED if name in ignored else Role.CONFLICTING if is_blamed else Role.GIVEN
    for asked in answer.asked:
        roles[asked.question.name] = Role.FREE if asked.value is None else Role.DERIVED
    return roles


def _blamed(answer: Answer, *, is_slip: bool) -> Iterator[Span]:
    """The words and facts that errors are about; not those beside which a word is missing, nor those that disagree only
    because others lack their points (`is_slip`)."""
    is_short = any(finding.about is ReadIssue.UNDERDETERMINED for finding in answer.diagnostics)
    claim = answer.claim
    words = {word.span: word.address for word in (*claim.words.values(), *claim.unknown, *claim.repeated)}
    words |= {directive.span: FACT for directive in claim.directives}
    for finding in answer.diagnostics:
        is_refusal = isinstance(finding.about, RefusalKind)
        if not finding.is_error or isinstance(finding.about, NoteKind):
            continue
        if is_slip and finding.basis is Basis.NUMERICAL:
            continue
        if is_refusal or not (is_short and _misses_words(finding, answer)):
            spans = (label.span for label in finding.labels if label.span in words)
            yield from (span for span in spans if is_refusal or words[span] in finding.addresses)


def _misses_words(finding: Diagnostic, answer: Answer) -> bool:
    """Whether a finding is mended by words beside all those that are there."""
    texts = [word.text for block in answer.claim.blocks for word in block.words]
    return any(all(text in fix.replacement for text in texts) for fix in finding.fixes)


# Points ------------------------------------------------------------------------------------------------------


def find_known(answer: Answer) -> Known:
    """All that can be drawn of a contour; nothing if its start is not known."""
    profile = answer.profile
    if not answer.start.is_known:
        return Known()
    system = assemble(profile)
    items = answer.alternatives.items if answer.alternatives is not None else ()
    if answer.contour is not None:
        if answer.alternatives is not None:
            solution = next((each.solution for each in fitting(answer)), None)
        else:
            solution = solve(profile, is_proven=False) if is_closed(system) else None
        if solution is not None and solution.points:
            return known_of(solution)
    if answer.claim.form.is_general:
        spans = {*_blamed(answer, is_slip=False)}
        words = (given.word for given in profile.givens.values() if given.word is not None)
        known = in_chain(profile, fitting(answer) or items, {word for word in words if word.span in spans})
        is_open = answer.status is Status.UNDERDETERMINED and not known.variants
        whole = complete(profile) if is_open else known
        return whole if whole.placed else known
    verdict = analyse(system)
    if profile.is_extended:
        # Of several solutions, among which nothing chooses, the first.
        first = next((item.solution for item in items if item.is_path), None)
        if first is not None:
            return known_of(first)
        is_asked = not verdict.is_determined and not answer.claim.directives  # and nothing gives what is asked for
        return complete(profile) if is_asked else in_part(profile)
    if verdict.is_determined:
        return _worked_out(profile) if is_closed(system) else in_part(profile)
    return _completed(profile)


def _completed(profile: Profile) -> Known:
    """A contour of which words leave something free, without those of them that contradict the others."""
    refusals = tuple(each for each in said_twice(profile) if isinstance(each, Refusal))
    against = {each.subject for each in refusals if each.kind.event.topic is Topic.WORD}
    part = with_facts(profile, (fact for fact in profile.facts if fact.given not in against)) if against else profile
    return replace(complete(part), refusals=refusals)


def _worked_out(profile: Profile) -> Known:
    """The points of a determined contour that is refused, as far as they exist, with its corners as large as stated."""
    system = assemble(profile)
    figure = system.figure
    # One of two places where nothing chooses.
    sides = {SIDE + point: 1.0 for point in points_with_two_solutions(system)}
    machine = compile_system(system)
    out = machine.function({**sides, **inputs_of(profile, system)})
    path = machine.path.read(out.__getitem__)
    origin = start_of(profile)

    def absolute(at: Point) -> Point:
        return origin[FIRST] + at[FIRST], origin[SECOND] + at[SECOND]

    values = {scalar(figure.start, axis): origin[axis] for axis in (FIRST, SECOND)}
    for name, axis in ((name, axis) for name in figure.points for axis in (FIRST, SECOND)):
        if is_usable(out.get(scalar(name, axis), inf)):
            values[scalar(name, axis)] = origin[axis] + out[scalar(name, axis)]
    points, rest = by_point((figure.start, *figure.points), values)
    radii = {name: out[name] for name in figure.radii if is_usable(out.get(name, inf)) and out[name] > 0}
    corners = {}
    for corner in figure.corners:
        if corner.size in profile.givens and profile.givens[corner.size].value > 0:
            built = corner_of(path.corners[corner.name], float(profile.givens[corner.size].value), absolute)
            places = (built.begin, built.end, *([built.center] if built.center else []))
            if all(is_usable(value) for place in places for value in place) and isfinite(built.turn):
                corners[corner.name] = built
    is_solvable = count_choices(profile) <= MOST_CHOICES and is_chosen(profile)
    refusals = solve(profile, is_proven=False).refusals if is_solvable else ()
    singular = next((refusal.subject for refusal in refusals if refusal.kind.status is Status.UNDERDETERMINED), "")
    if singular:
        found = complete(profile)
        if found.placed:
            return found
    if len(points) < len(figure.points) + 1:
        part = in_part(profile)
        points, radii, rest = {**part.points, **points}, {**part.radii, **radii}, {**part.scalars, **rest}
    return Known(points, radii, corners, refusals, scalars=rest)


# The path ----------------------------------------------------------------------------------------------------


def list_trails(answer: Answer, known: Known) -> Iterator[Trail]:
    """The path; in several roles where a part of it is refused or free."""
    is_chain = answer.claim.form.is_general
    if answer.contour is not None:
        # A solved chain is blue as well: that is what its programmer waits for, on whose control colours are states.
        role = Role.DETERMINED if is_chain else Role.INK
        yield from [Trail(answer.contour.elements, role)] if answer.contour.elements else []
        return
    trail: Trail | None = None
    for segment, role in _chain_traced(answer, known) if is_chain else _traced(answer, known):
        if trail is not None and trail.role is role and trail.segments[-1].end == segment.start:
            trail = replace(trail, segments=(*trail.segments, segment))
            continue
        yield from [trail] if trail is not None else []
        trail = Trail((segment,), role)
    yield from [trail] if trail is not None else []


def _traced(answer: Answer, known: Known) -> Iterator[tuple[Segment, Role]]:
    """The elements of a contour that is not solved, each with what it is."""
    stated = Role.CANDIDATE if has_several(answer) else Role.INK
    yield from ((s, stated if state is Role.INK else state) for s, state in trace_known(answer.profile, known))


def _chain_traced(answer: Answer, known: Known) -> Iterator[tuple[Segment, Role]]:
    """The same of a chain, first as it is in one way, then what differs in the others."""
    ways = [list(trace_known(answer.profile, each)) for each in (known, *known.variants)]
    shared = [segment for segment, _ in ways[0] if all(any(_is_same(segment, s) for s, _ in way) for way in ways[1:])]
    for number, way in enumerate(ways):
        for segment, state in way:
            is_shared = any(_is_same(segment, each) for each in shared)
            if not (is_shared and number):
                role = Role.DETERMINED if is_shared else Role.SEVERAL
                yield segment, role if state is Role.INK else state


def _is_same(one: Segment, other: Segment) -> bool:
    """Whether two elements run alike."""
    places = [
        (each.start, each.end, each.center if isinstance(each, ArcSegment) else each.end) for each in (one, other)
    ]
    return one.name == other.name and all(distance(*pair) <= LENGTH for pair in zip(*places, strict=True))


def trace_known(profile: Profile, known: Known) -> Iterator[tuple[Segment, Role]]:
    """The elements between known points, each as stated (`INK`), refused or still free. Corners that do not fit are not
    cut: they stand beside the path, refused."""
    corners = {corner.at: corner for corner in profile.figure.corners}
    refused = {refusal.subject for refusal in known.refusals}
    # The lines of the path are as they should be then, without their corners.
    is_uncut = any(refusal.kind.event.points_at is PointsAt.CORNER for refusal in known.refusals)
    here: Point | None = known.points.get(profile.figure.start)
    for element in profile.figure.path:
        corner = corners.get(element.head)
        built = known.corners.get(corner.name) if corner else None
        is_cut = built is not None and not is_uncut and not known.refusals
        tail, head = here, known.points.get(element.head)
        end = built.begin if built is not None and is_cut else head
        segment = _segment(element, tail, end, known) if tail is not None and end is not None else None
        if segment is not None:
            is_free = known.placed & {element.head, element.tail}
            yield segment, Role.CONFLICTING if element.name in refused else Role.FREE if is_free else Role.INK
        here = head
        if corner is not None and built is not None:
            cut = corner_segment(corner, built)
            if is_cut:
                yield cut, Role.FREE if known.placed & {element.head, corner.name} else Role.INK
                here = built.end
            elif is_uncut and (corner.name in refused or element.name in refused or corner.after in refused):
                yield cut, Role.CONFLICTING


def _segment(element: Line | Arc, tail: Point, head: Point, known: Known) -> Segment | None:
    if distance(head, tail) <= LENGTH and not (isinstance(element, Arc) and element.may_be_full):
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
