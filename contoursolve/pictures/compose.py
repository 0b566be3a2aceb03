"""From the answer about a contour to the scene that a picture shows."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from contoursolve.contour import Contour, Segment, trace
from contoursolve.diagnostic import Diagnostic, Severity
from contoursolve.examine import Answer
from contoursolve.model import FIRST, SECOND, Length, Plane
from contoursolve.output.solutions import list_solutions
from contoursolve.pictures.construction import list_construction, list_rings, list_slides
from contoursolve.pictures.dimensions import list_dimensions
from contoursolve.pictures.faults import draw_faults
from contoursolve.pictures.finding import find_known
from contoursolve.pictures.known import Known
from contoursolve.pictures.marks import givens_at_points, list_marks
from contoursolve.pictures.places import list_places
from contoursolve.pictures.scene import Aligned, Leader, Mark, Ring, Scene, Thin, Trail, Weight
from contoursolve.pictures.sheet import Run
from contoursolve.pictures.theme import Role
from contoursolve.pictures.tracing import trace_known, trace_segments
from contoursolve.pictures.vectors import SAME, distance
from contoursolve.pictures.wording import visible
from contoursolve.reading import Trouble
from contoursolve.solving import Point, RefusalKind, RemarkKind
from contoursolve.source import Span
from contoursolve.syntax import FACT

MOST_LINES = 6
"""Lines of a program in a picture's head."""

MOST_REMARKS = 3
MOST_SOLUTIONS = 6
"""Other solutions that are drawn."""


def compose(answer: Answer, title: str | None = None) -> Scene:
    """The scene of one contour, whatever its status."""
    profile, plane = answer.profile, answer.plane
    known = find_known(answer)
    roles = roles_of(answer)
    main = main_trails(answer, known)
    elements = _elements(main)
    ghosts, places = _ghosts(answer, known)
    noted = {
        point: givens
        for point, givens in givens_at_points(profile).items()
        if len(givens) > 1 and point in known.points
    }
    noted_givens = frozenset(given for givens in noted.values() for given in givens)
    faults = list(draw_faults(answer, known))
    broken = [each for each in faults if isinstance(each, Ring)]
    circles = {(each.center, each.radius) for each in broken}
    places_stated = list(list_places(profile, known, roles))
    end = main[-1].segments[-1].end if main and _is_whole(answer, known, main[-1].segments[-1]) else None
    is_free = bool(main) and main[-1].role is Role.FREE
    marks = list_marks(answer, known, roles, noted, places, end, is_free)
    return Scene(
        title=title if title is not None else title_of(answer),
        axes=(axis_name(plane, FIRST, answer.unit), axis_name(plane, SECOND, answer.unit)),
        trails=(*ghosts, *main),
        thins=(
            *list_construction(profile, known, elements),
            *(each for each in (*faults, *places_stated) if isinstance(each, Thin)),
        ),
        rings=(*(each for each in list_rings(answer, known) if (each.center, each.radius) not in circles), *broken),
        marks=(*marks, *(each for each in (*faults, *places_stated) if isinstance(each, Mark))),
        dimensions=(
            *list_dimensions(answer, known, roles, elements, noted_givens),
            *(each for each in (*faults, *places_stated) if isinstance(each, Aligned | Leader)),
        ),
        slides=tuple(list_slides(answer, known)),
        lines=tuple(_lines(answer, roles)),
        remarks=tuple(remarks_of(answer.diagnostics)),
        meanings={Role.GHOST: "other values"} if known.others else {},
        has_turning_axis=plane.diameters[SECOND],
    )


def title_of(answer: Answer) -> str:
    """What a contour is, where it stands, and what became of it."""
    form = answer.claim.form
    lines = answer.lines
    where = f"line {lines[0]}" if len(lines) == 1 else f"lines {lines[0]} to {lines[-1]}"
    return f"{form.name} ({form.title}), {where}: {answer.status.value}"


def axis_name(plane: Plane, axis: int, unit: Length) -> str:
    """An axis as a drawing names it; a drawing that says no unit is in mm."""
    notes = [*(["diameter"] if plane.diameters[axis] else []), *(["inch"] if unit is Length.INCH else [])]
    return f"{plane.axes[axis]} ({', '.join(notes)})" if notes else plane.axes[axis]


def roles_of(answer: Answer) -> dict[str, Role]:
    """What became of each word, by the given that it states."""
    profile = answer.profile
    ignored = {fact.given for fact in profile.ignored}
    blamed = _blamed(answer)
    roles: dict[str, Role] = {}
    for name, given in profile.givens.items():
        if given.word is not None:
            roles[name] = Role.GIVEN
            if name in ignored:
                roles[name] = Role.IGNORED
            elif given.word.span in blamed:
                roles[name] = Role.CONFLICTING
    for asked in answer.answers:
        roles[asked.question.name] = Role.FREE if asked.value is None else Role.DERIVED
    return roles


def _blamed(answer: Answer) -> set[Span]:
    """The words and facts that errors are about; not those beside which a word is missing."""
    is_short = any(finding.about is Trouble.UNDERDETERMINED for finding in answer.diagnostics)
    claim = answer.claim
    words = {word.span: word.address for word in (*claim.words.values(), *claim.unknown, *claim.repeated)}
    words |= {directive.span: FACT for directive in claim.directives}
    return {
        label.span
        for finding in answer.diagnostics
        if finding.severity is Severity.ERROR
        and not isinstance(finding.about, RemarkKind)
        and (isinstance(finding.about, RefusalKind) or not (is_short and _misses_words(finding, answer)))
        for label in finding.labels
        if label.span in words and (isinstance(finding.about, RefusalKind) or words[label.span] in finding.addresses)
    }


def _misses_words(finding: Diagnostic, answer: Answer) -> bool:
    """Whether a finding is mended by words beside all those that are there."""
    texts = [word.text for block in answer.claim.blocks for word in block.words]
    return any(all(text in fix.replacement for text in texts) for fix in finding.fixes)


def main_trails(answer: Answer, known: Known) -> list[Trail]:
    """The path; in several roles where a part of it is refused or free."""
    if answer.contour is not None:
        return [Trail(answer.contour.elements, Role.INK)] if answer.contour.elements else []
    trails: list[Trail] = []
    for traced in trace_known(answer.profile, known):
        if trails and trails[-1].role is traced.role and trails[-1].segments[-1].end == traced.segment.start:
            trails[-1] = replace(trails[-1], segments=(*trails[-1].segments, traced.segment))
        else:
            trails.append(Trail((traced.segment,), traced.role))
    return trails


def _is_whole(answer: Answer, known: Known, last: Segment) -> bool:
    """Whether the path is drawn as far as its end."""
    figure = answer.profile.figure
    head = known.points.get(figure.path[-1].head)
    names = {figure.path[-1].name, *(corner.name for corner in figure.corners if corner.at == figure.path[-1].head)}
    return answer.contour is not None or last.name in names or (head is not None and distance(last.end, head) <= SAME)


def _elements(trails: list[Trail]) -> dict[str, Segment]:
    """What is drawn, by name."""
    return {segment.name: segment for trail in trails for segment in trail.segments}


def _ghosts(answer: Answer, known: Known) -> tuple[list[Trail], dict[str, list[tuple[Point, str]]]]:
    """Other contours, and where their computed intersections are with what selects each."""
    profile = answer.profile
    places: dict[str, list[tuple[Point, str]]] = {}
    others = (trace(profile, other).elements for other in known.others)
    drawn = answer.contour.elements if answer.contour else trace_segments(profile, known)
    trails = [Trail(elements, Role.GHOST, Weight.GHOST) for elements in others if elements and elements != drawn]
    listing = list_solutions(answer) if answer.alternatives is not None else None
    if listing is None:
        return trails, places
    shown = [each for each in listing.solutions if each.contour is not None and not each.is_chosen]
    first = known.points
    for each in shown[:MOST_SOLUTIONS]:
        if each.contour is None:
            continue
        selects = " ".join(each.selects)
        own = [name for name, at in each.contour.points.items() if name in first and distance(at, first[name]) > SAME]
        is_drawn = answer.contour is None and not own and _is_path(each.contour, known)
        if not is_drawn and each.contour.elements:
            trails.append(Trail(each.contour.elements, Role.GHOST, Weight.GHOST))
        for name in own or [name for name in each.contour.points if name.startswith("P")]:
            places.setdefault(name, []).append((each.contour.points[name], selects))
    return trails, places


def _is_path(contour: Contour, known: Known) -> bool:
    return all(name in known.points and distance(at, known.points[name]) <= SAME for name, at in contour.points.items())


def _lines(answer: Answer, roles: Mapping[str, Role]) -> Iterator[tuple[Run, ...]]:
    """The program's lines, each word in its role."""
    by_span = {
        given.word.span: roles[name]
        for name, given in answer.profile.givens.items()
        if given.word is not None and name in roles
    }
    by_span |= {
        asked.question.word.span: roles.get(asked.question.name, Role.FREE)
        for asked in answer.answers
        if asked.question.word.address != FACT
    }
    for span in _blamed(answer):
        by_span.setdefault(span, Role.CONFLICTING)
    blocks = answer.claim.blocks
    for block in blocks[:MOST_LINES]:
        spans = sorted((span for span in by_span if span.line == block.line), key=lambda span: span.column)
        runs, place, text = [], 0, block.text
        for span in spans:
            if span.column - 1 < place:
                continue
            runs.append(Run(text[place : span.column - 1], Role.MUTED))
            runs.append(Run(text[span.column - 1 : span.end_column - 1], by_span[span]))
            place = span.end_column - 1
        runs.append(Run(text[place:], Role.MUTED))
        yield tuple(_shown(run) for run in runs if run.text)
    if len(blocks) > MOST_LINES:
        yield (Run(f"... and {len(blocks) - MOST_LINES} more blocks", Role.MUTED),)
    for directive in answer.claim.directives:
        if directive.span.line < 0:
            yield (_shown(Run(f'--fact "{directive.text}"', by_span.get(directive.span, Role.GIVEN))),)


def _shown(run: Run) -> Run:
    """A run with nothing that cannot be seen."""
    return Run(visible(run.text), run.role)


def remarks_of(diagnostics: Sequence[Diagnostic]) -> Iterator[tuple[Run, ...]]:
    """The first findings."""
    findings = [finding for finding in diagnostics if finding.severity is not Severity.INFO]
    for finding in findings[:MOST_REMARKS]:
        role = Role.CONFLICTING if finding.severity is Severity.ERROR else Role.IGNORED
        yield (_shown(Run(f"{finding.severity.value}: {finding.message}", role)),)
    if len(findings) > MOST_REMARKS:
        yield (Run(f"... and {len(findings) - MOST_REMARKS} more findings", Role.MUTED),)
