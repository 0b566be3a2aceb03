"""Every way to draw a sketch in one picture: what is given, facts as dimensions, and each solution by its number."""

from collections.abc import Iterator, Sequence
from math import cos, pi, sin

from contoursolve.geometry import Figure, Length, Profile, Unit, line_scalars
from contoursolve.numeric import trimmed
from contoursolve.pictures.dimensions import around, dimension_of
from contoursolve.pictures.known_points import Known, place_beside, place_of, start_of
from contoursolve.pictures.page import TextRun, visible
from contoursolve.pictures.scene import (
    Leader,
    Mark,
    MarkKind,
    Part,
    Ring,
    Scene,
    Thin,
    Trail,
    Weight,
    axis_names,
    coordinates,
    number,
    word_text,
)
from contoursolve.pictures.subject import PartialDrawing
from contoursolve.pictures.theme import Role
from contoursolve.solving import DIAGONAL, SAME, Drawing, Drawings, Point, Stated, along, distance, foot

MOST_DRAWN = 12
"""Drawings in one picture; of more, their number is told."""

MOST_FACTS = 8
"""Facts above a picture."""

_TURN = 2.4
"""Radians from the label of one solution to that of the next, so that they do not crowd."""

_ASIDE = 0.3
"""Share of the reach of what is given from the label of a line to that of the next solution."""


def compose_drawings(drawings: Drawings, title: str | None) -> Scene:
    """The scene of all drawings of a sketch."""
    return _scene(drawings, drawings.stated, title or f"sketch, {drawings.status.value}: {drawings.summary}")


def compose_drawn(drawn: Drawing, title: str | None) -> Scene:
    """The scene of one of them."""
    return _scene([drawn], drawn.stated, title or f"sketch: {drawn.name or 'only drawing'}")


def _scene(drawings: Sequence[Drawing], stated: Stated | None, title: str) -> Scene:
    if stated is None:
        raise ValueError("a drawing that was not made by a sketch has no picture")
    profile, shown = stated.profile, drawings[:MOST_DRAWN]
    parts: list[Part] = list(_given(profile))
    for place, drawn in enumerate(shown):
        parts += _solution(drawn, place if len(drawings) > 1 else None, profile)
    parts += _points(shown, profile, is_several=len(drawings) > 1)
    parts += _dimensions(shown[0], stated) if shown else ()
    facts = [text for text in stated.texts.values() if text.strip()]
    lines = [(TextRun(visible(text), Role.GIVEN),) for text in facts[:MOST_FACTS]]
    if len(facts) > MOST_FACTS:
        lines.append((TextRun(f"... and {len(facts) - MOST_FACTS} more facts", Role.MUTED),))
    return Scene(
        visible(title),
        axis_names(profile.plane),
        tuple(parts),
        tuple(lines),
        tuple(_remarks(drawings, len(shown))),
        is_one_contour=len(drawings) == 1,
    )


def _given(profile: Profile) -> Iterator[Part]:
    """The circles and the places that are stated, and where the path begins."""
    for each in profile.figure.circles:
        center, radius = place_of(profile, each.center), profile.givens.get(each.radius)
        if center is not None and radius is not None:
            size = float(radius.value)
            yield Ring(center, size, Role.GIVEN)
            yield Mark(center, MarkKind.CENTER)
            yield around(center, size, DIAGONAL, f"{each.name} R{number(size, Length.MM)}", Role.GIVEN)
    for fact in profile.facts:
        if (beside := place_beside(profile, fact)) is not None:
            yield Mark(beside, MarkKind.CENTER)
    if profile.figure.path:
        at = start_of(profile)
        yield Mark(at, MarkKind.START, (TextRun(f"{profile.figure.start}  {_place(profile, at)}", Role.GIVEN),))


def _place(profile: Profile, at: Point) -> str:
    return coordinates(at, profile.plane, Length.MM)


def _role(place: int | None) -> Role:
    """The colour role of a solution: the only one, or one of several."""
    return Role.INK if place is None else Role.CANDIDATE


def _solution(drawn: Drawing, place: int | None, profile: Profile) -> Iterator[Part]:
    """The path, circles and lines of one drawing, each with its number and its name where these are several."""
    figure, role, prefix = profile.figure, _role(place), "" if place is None else f"{place + 1}: "
    angle = pi / 4 + (place or 0) * _TURN
    if drawn.contour is not None:
        yield Trail(drawn.contour.elements, role, Weight.MAIN)
    for each in figure.circles:
        center, radius = drawn.points.get(each.center), drawn.radii.get(each.radius)
        if center is not None and radius is not None:
            way = cos(angle), sin(angle)
            yield Ring(center, radius, role)
            yield Mark(center, MarkKind.CENTER)
            text = f"{prefix}{each.name} R{number(radius, Length.MM)}"
            yield around(center, radius, way, text, role)
    beside = [name for name in drawn.lines if name not in {each.name for each in figure.path}]
    middle, reach = _amid(profile)
    for name in beside:
        cosine, sine, offset = drawn.lines[name]
        way, on = (cosine, sine), (-sine * offset, cosine * offset)
        at = along(foot(middle, on, way), way, _ASIDE * reach * (place or 0))
        yield Thin(at, along(at, way, 1.0), role, is_endless=True)
        yield Leader(at, (-sine, cosine), f"{prefix}{name}", role)


def _amid(profile: Profile) -> tuple[Point, float]:
    """A place amid what is given, and how far that reaches from it."""
    centers = [at for each in profile.figure.circles if (at := place_of(profile, each.center)) is not None]
    places = centers or [start_of(profile)]
    middle = sum(x for x, _ in places) / len(places), sum(y for _, y in places) / len(places)
    return middle, max(distance(at, middle) for at in places)


def _points(shown: Sequence[Drawing], profile: Profile, *, is_several: bool) -> Iterator[Mark]:
    """The named points of the path: in the drawings in which they are elsewhere with their numbers."""
    figure = profile.figure
    names = dict.fromkeys(point for each in figure.path for point in (each.tail, each.head))
    for name in (name for name in names if name != figure.start):
        found: list[tuple[Point, list[int]]] = []
        for place, drawn in enumerate(shown, 1):
            at = drawn.points[name]
            same = next((numbers for there, numbers in found if distance(at, there) <= SAME), None)
            if same is None:
                found.append((at, [place]))
            else:
                same.append(place)
        for at, numbers in found:
            is_own = is_several and len(found) > 1
            told = f"{', '.join(map(str, numbers))}: {name}" if is_own else name
            role = Role.CANDIDATE if is_own else Role.INK
            label = (TextRun(told, role), TextRun(f"  {_place(profile, at)}", Role.DERIVED))
            yield Mark(at, MarkKind.PLACE, label, label[:1], role)


def _dimensions(drawn: Drawing, stated: Stated) -> Iterator[Part]:
    """The facts about one drawing that have a form as dimensions, and what is asked for."""
    figure: Figure = stated.profile.figure
    trails = (Trail(drawn.contour.elements, Role.INK),) if drawn.contour is not None else ()
    points = {**drawn.points, **({figure.start: start_of(stated.profile)} if figure.path else {})}
    lines = {
        scalar: value
        for name, values in drawn.lines.items()
        for scalar, value in zip(line_scalars(name), values, strict=True)
    }
    traced = PartialDrawing(stated.profile, Known(points, drawn.radii, scalars=lines), trails)
    for fact in stated.profile.facts:
        text = stated.texts.get(fact.given)
        if text is not None:
            value = traced.value(fact.given)
            yield from filter(None, [dimension_of(traced, fact, word_text(text), Role.GIVEN, value)])
    for (fact, unit), asked in zip(stated.questions.values(), drawn.asked, strict=True):
        if asked.value is not None:
            told = number(asked.value, Length.MM) if unit is Unit.MM else trimmed(asked.value, 3)
            text = f"{word_text(asked.fact.rstrip(' =?'))} = {told}"
            yield from filter(None, [dimension_of(traced, fact, text, Role.DERIVED, asked.value)])


def _remarks(drawings: Sequence[Drawing], count: int) -> Iterator[tuple[TextRun, ...]]:
    """Remarks that name each drawing and list the values that were asked for."""
    for place, drawn in enumerate(drawings[:count], 1):
        told = [each for each in (drawn.name, *map(str, drawn.asked)) if each]
        if told and (len(drawings) > 1 or drawn.asked):
            prefix = f"{place}: " if len(drawings) > 1 else ""
            yield (TextRun(visible(prefix + "; ".join(told)), _role(place if len(drawings) > 1 else None)),)
    if len(drawings) > count:
        yield (TextRun(f"... and {len(drawings) - count} more drawings, which are not drawn", Role.MUTED),)
