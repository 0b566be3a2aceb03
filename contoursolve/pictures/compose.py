"""From the answer about a contour to the scene that a picture shows."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from contoursolve.contour import Contour, Segment, trace
from contoursolve.diagnostic import Severity
from contoursolve.examine import Answer
from contoursolve.model import FIRST, SECOND, Arc, Line, Plane, Profile
from contoursolve.output.solutions import list_solutions
from contoursolve.pictures.dimensions import list_dimensions, words_at_points
from contoursolve.pictures.faults import draw_faults
from contoursolve.pictures.known import Known, find_known
from contoursolve.pictures.scene import Aligned, Kind, Mark, Ring, Scene, Slide, Thin, Trail
from contoursolve.pictures.sheet import Run
from contoursolve.pictures.theme import Role
from contoursolve.pictures.tracing import corner_segment, trace_known
from contoursolve.pictures.vectors import distance
from contoursolve.pictures.wording import coordinate, word_text
from contoursolve.reading import Trouble
from contoursolve.solving import Point, RefusalKind, RemarkKind
from contoursolve.source import Span
from contoursolve.syntax import FACT

MOST_LINES = 6
"""Lines of a program in a picture's head."""

MOST_REMARKS = 3
MOST_SOLUTIONS = 6
"""Other solutions that are drawn."""

_SAME = 1e-6
"""mm. Points nearer to each other get one label."""


def compose(answer: Answer, title: str | None = None) -> Scene:
    """The scene of one contour, whatever its status."""
    profile, plane = answer.profile, answer.plane
    known = find_known(answer)
    roles = roles_of(answer)
    main = main_trails(answer, known)
    elements = _elements(answer, known, main)
    ghosts, labels = _ghosts(answer, known)
    facts = (*profile.facts, *profile.ignored)
    noted = {
        point: words
        for point, words in words_at_points(profile, facts).items()
        if len(words) > 1 and point in known.points
    }
    noted_givens = frozenset(given for words in noted.values() for _, given in words.values())
    faults = list(draw_faults(answer, known))
    broken = [each for each in faults if isinstance(each, Ring)]
    circles = {(each.center, each.radius) for each in broken}
    ends = [segment.end for trail in main for segment in trail.segments]
    marks = _marks(answer, known, roles, noted, labels, ends[-1] if ends else None)
    return Scene(
        title=title if title is not None else title_of(answer),
        axes=(axis_name(plane, FIRST), axis_name(plane, SECOND)),
        trails=(*ghosts, *main),
        thins=(
            *_construction(profile, known),
            *(each for each in faults if isinstance(each, Thin)),
        ),
        rings=(*(each for each in _rings(answer, known) if (each.center, each.radius) not in circles), *broken),
        marks=tuple(marks),
        dimensions=(
            *list_dimensions(answer, known, roles, elements, noted_givens),
            *(each for each in faults if isinstance(each, Aligned)),
        ),
        slides=tuple(_slides(answer, known)),
        lines=tuple(_lines(answer, roles)),
        remarks=tuple(_remarks(answer)),
        has_turning_axis=plane.diameters[SECOND],
    )


def title_of(answer: Answer) -> str:
    """What a contour is, where it stands, and what became of it."""
    form = answer.claim.form
    lines = answer.lines
    where = f"line {lines[0]}" if len(lines) == 1 else f"lines {lines[0]} to {lines[-1]}"
    return f"{form.name} ({form.title}), {where}: {answer.status.value}"


def axis_name(plane: Plane, axis: int) -> str:
    """An axis as a drawing names it."""
    return f"{plane.axes[axis]} (diameter)" if plane.diameters[axis] else plane.axes[axis]


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
    """The words that errors are about; not those beside which a word is missing."""
    is_short = any(finding.about is Trouble.UNDERDETERMINED for finding in answer.diagnostics)
    claim = answer.claim
    words = {word.span: word for word in (*claim.words.values(), *claim.unknown, *claim.repeated)}
    return {
        label.span
        for finding in answer.diagnostics
        if finding.severity is Severity.ERROR
        and not isinstance(finding.about, RemarkKind)
        and (isinstance(finding.about, RefusalKind) or not is_short)
        for label in finding.labels
        if label.span in words
        and (isinstance(finding.about, RefusalKind) or words[label.span].address in finding.addresses)
    }


def main_trails(answer: Answer, known: Known) -> list[Trail]:
    """The path; in several roles where a part of it is refused or free."""
    if answer.contour is not None:
        return [Trail(answer.contour.elements, Role.INK)]
    trails: list[Trail] = []
    for traced in trace_known(answer.profile, known):
        if trails and trails[-1].role is traced.role and trails[-1].segments[-1].end == traced.segment.start:
            trails[-1] = replace(trails[-1], segments=(*trails[-1].segments, traced.segment))
        else:
            trails.append(Trail((traced.segment,), traced.role))
    return trails


def _elements(answer: Answer, known: Known, trails: list[Trail]) -> dict[str, Segment]:
    """What is drawn, by name."""
    found = {
        corner.name: corner_segment(corner, known.corners[corner.name])
        for corner in answer.profile.figure.corners
        if corner.name in known.corners
    }
    return found | {segment.name: segment for trail in trails for segment in trail.segments}


def _ghosts(answer: Answer, known: Known) -> tuple[list[Trail], dict[str, list[tuple[Point, str]]]]:
    """Other contours, and where their computed intersections are with what selects each."""
    profile = answer.profile
    places: dict[str, list[tuple[Point, str]]] = {}
    trails = [Trail(trace(profile, other).elements, Role.GHOST, is_main=False) for other in known.others]
    listing = list_solutions(answer) if answer.alternatives is not None else None
    if listing is None:
        return trails, places
    shown = [each for each in listing.solutions if each.contour is not None and not each.is_chosen]
    first = known.points
    for each in shown[:MOST_SOLUTIONS]:
        if each.contour is None:
            continue
        selects = " ".join(each.selects)
        own = [name for name, at in each.contour.points.items() if name in first and distance(at, first[name]) > _SAME]
        is_drawn = answer.contour is None and not own and _is_path(each.contour, known)
        if not is_drawn:
            trails.append(Trail(each.contour.elements, Role.GHOST, selects, is_main=False))
        for name in own or [name for name in each.contour.points if name.startswith("P")]:
            places.setdefault(name, []).append((each.contour.points[name], selects))
    return trails, places


def _is_path(contour: Contour, known: Known) -> bool:
    return all(
        name in known.points and distance(at, known.points[name]) <= _SAME for name, at in contour.points.items()
    )


def _marks(
    answer: Answer,
    known: Known,
    roles: Mapping[str, Role],
    noted: Mapping[str, Mapping[int, tuple[object, str]]],
    others: Mapping[str, list[tuple[Point, str]]],
    end: Point | None,
) -> Iterator[Mark]:
    profile, plane, unit = answer.profile, answer.plane, answer.unit
    choices = {choice.point: choice.given for choice in profile.choices if choice.given}

    def computed(at: Point) -> Run:
        return Run("  " + " ".join(coordinate(at, axis, plane, unit) for axis in (FIRST, SECOND)), Role.DERIVED)

    def stated(name: str) -> list[Run]:
        words = noted.get(name, {})
        return [
            Run("  " + word_text(profile.givens[given].word.text), roles.get(given, Role.GIVEN))  # type: ignore[union-attr]
            for _, (_, given) in sorted(words.items())
        ]

    start = known.points.get(profile.figure.start)
    if start is None:
        return
    places = " ".join(coordinate(start, axis, plane, unit) for axis in (FIRST, SECOND))
    yield Mark(start, Kind.START, (Run("start", Role.INK), Run("  " + places, Role.MUTED)), (Run("start", Role.INK),))
    done = [start]
    final = next((name for name in reversed(list(known.points)) if end is not None and known.points[name] == end), "")
    if end is not None:
        is_free = bool(known.placed)
        about = stated(final) or ([] if is_free else [computed(end)])
        label, role = ("end (free)", Role.FREE) if is_free else ("end", Role.INK)
        yield Mark(end, Kind.END, (Run(label, role), *about), (Run(label, role),))
        done.append(end)
    cut = {corner.at for corner in profile.figure.corners}
    for name, at in known.points.items():
        if any(distance(at, other) <= _SAME for other in done):
            continue
        is_shown = name in profile.intersections
        words = stated(name)
        if not is_shown and not words:
            continue
        runs = [Run(name, Role.INK if name not in known.placed else Role.FREE)] if is_shown else []
        if name in choices and choices[name] in profile.givens:
            word = profile.givens[choices[name]].word
            runs += [Run("  " + word_text(word.text), roles.get(choices[name], Role.GIVEN))] if word else []
        selects = next((text for place, text in others.get(name, []) if distance(place, at) <= _SAME), "")
        runs += [Run("  " + selects, Role.GIVEN)] if selects else []
        short = tuple(runs)
        runs += words or ([computed(at)] if name not in known.placed else [])
        kind = Kind.VIRTUAL if name in cut else Kind.PLACE
        is_center = not is_shown and any(isinstance(each, Arc) and each.center == name for each in profile.figure.path)
        yield Mark(at, Kind.CENTER if is_center else kind, _trimmed(runs), _trimmed(short))
        done.append(at)
    for name, places_of in others.items():
        for at, selects in places_of:
            if name in known.points and distance(at, known.points[name]) <= _SAME:
                continue
            runs = [Run(name, Role.GHOST), *([Run("  " + selects, Role.GHOST)] if selects else []), computed(at)]
            yield Mark(at, Kind.PLACE, tuple(runs), tuple(runs[:-1]))
    for element in profile.figure.path:
        center = known.points.get(element.center) if isinstance(element, Arc) else None
        if center is not None and all(distance(center, other) > _SAME for other in done):
            yield Mark(center, Kind.CENTER)
            done.append(center)


def _trimmed(runs: list[Run] | tuple[Run, ...]) -> tuple[Run, ...]:
    if not runs:
        return ()
    return (Run(runs[0].text.lstrip(), runs[0].role), *runs[1:])


def _construction(profile: Profile, known: Known) -> Iterator[Thin]:
    """From the path to the virtual intersections that its corners cut off."""
    lines = {element.name for element in (*profile.figure.path, *profile.figure.lines) if isinstance(element, Line)}
    for corner in profile.figure.corners:
        built, at = known.corners.get(corner.name), known.points.get(corner.at)
        if built is None or at is None:
            continue
        if corner.before in lines:
            yield Thin(built.begin, at, Role.MUTED)
        if corner.after is None or corner.after in lines:
            yield Thin(at, built.end, Role.MUTED)


def _rings(answer: Answer, known: Known) -> Iterator[Ring]:
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
        given = [profile.givens.get(name) for name in (f"{circle.center}.0", f"{circle.center}.1", circle.radius)]
        values = [float(each.value) for each in given if each is not None]
        if len(values) == len(given):
            yield Ring((values[0], values[1]), values[2], Role.GIVEN)


def _slides(answer: Answer, known: Known) -> Iterator[Slide]:
    """What can still move, and how."""
    freedoms = answer.diagnosis.freedoms if answer.diagnosis else ()
    if answer.contour is not None:
        return
    for freedom in freedoms:
        at = known.points.get(freedom.point)
        if at is not None:
            yield Slide(at, freedom.direction, freedom.point)
    if not freedoms:
        for name in sorted(known.placed):
            if name in known.points:
                yield Slide(known.points[name], None, name)


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
    return Run("".join(each if each.isprintable() else (" " if each == "\t" else "·") for each in run.text), run.role)


def _remarks(answer: Answer) -> Iterator[tuple[Run, ...]]:
    """The first findings."""
    findings = [finding for finding in answer.diagnostics if finding.severity is not Severity.INFO]
    for finding in findings[:MOST_REMARKS]:
        role = Role.CONFLICTING if finding.severity is Severity.ERROR else Role.IGNORED
        yield (_shown(Run(f"{finding.severity.value}: {finding.message}", role)),)
    if len(findings) > MOST_REMARKS:
        yield (Run(f"... and {len(findings) - MOST_REMARKS} more findings", Role.MUTED),)
