"""Handles on the picture of a contour: points, angles and sizes, each with the words that it moves.

A contour and its picture come in, handles in pixels of the picture go out, with how far each word moves what is drawn
(the derivatives of `sensitivity`). Begin with `handles_of`.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from math import hypot

from msgspec import Struct

from contoursolve.diagnosis import Answer, StatedWord
from contoursolve.families import FamilyError, slopes_of
from contoursolve.geometry import Arc, Corner, Line
from contoursolve.output import stated_words
from contoursolve.pictures import (
    Known,
    Picture,
    Viewport,
    corner_segment,
    find_known,
)
from contoursolve.solving import SAME, ArcSegment, LineSegment, Point, Segment, along, direction, distance, middle

LEAST = 1e-6
"""mm for each unit of a word. What a word moves by less it does not move."""

FINGER = 22.0
"""Pixels between two handles."""

APART = 0.2
"""Sine of the angle between the ways in which two words move a point, from which they move it anywhere."""

Slopes = Mapping[str, Point]
"""By the key of a word, how far one unit of it moves a place: in mm of the plane, or in pixels of a picture."""


class HandleKind(Enum):
    """Part of a contour that a handle moves."""

    POINT = "point"
    ANGLE = "angle"
    SIZE = "size"


class Handle(Struct, frozen=True):
    """Something to take hold of: where it is (pixels of the picture), and by how many pixels each unit of the words
    that it changes moves it. An angle turns about its `center` instead."""

    name: str
    kind: HandleKind
    at: Point
    moves: Slopes
    center: Point | None = None

    @property
    def keys(self) -> tuple[str, ...]:
        """The words that it changes."""
        return tuple(self.moves) or (self.name,)


class Moving(Struct, frozen=True):
    """An element of the path in pixels, and how words move its ends and its centre (none for a line)."""

    name: str
    places: tuple[Point, ...]
    slopes: tuple[Slopes, ...]
    turn: int = 0
    """1 clockwise on the page, -1 counter-clockwise, 0 for a line."""


class ContourDerivatives(Struct, frozen=True):
    """Derivatives of a solved contour's points and elements by its words, in mm for each unit as written."""

    answer: Answer
    slopes: Mapping[str, Mapping[str, float]]

    def of_point(self, name: str) -> Slopes:
        """The derivatives of a named point by words; words that move it too little are missing."""
        plane = self.answer.plane
        first, second = (self.slopes.get(f"{name} {axis}", {}) for axis in plane.axes)
        one, other = (1 + is_diameter for is_diameter in plane.diameters)
        found = {key: (first[key] / one, second[key] / other) for key in first}
        return {key: slope for key, slope in found.items() if hypot(*slope) > LEAST}

    def of_element(self, segment: Segment) -> tuple[Slopes, ...]:
        """The derivatives of the start, the end, and the centre of an element by words."""
        figure = self.answer.profile.figure
        corners = {corner.at: corner.name for corner in figure.corners}
        element = next((each for each in figure.path if each.name == segment.name), None)
        if element is None:
            names = [f"{segment.name}.{place}" for place in ("begin", "end", "center")]
        else:
            ends = (element.tail, "end"), (element.head, "begin")
            names = [f"{corners[at]}.{place}" if at in corners else at for at, place in ends]
            names += [element.center] if isinstance(element, Arc) else []
        return tuple(self.of_point(name) for name in names[: 3 if isinstance(segment, ArcSegment) else 2])


def derivatives_of(answer: Answer) -> ContourDerivatives | None:
    """The derivatives of a contour by its words; None if it has no path or no derivatives."""
    if answer.contour is None:
        return None
    try:
        return ContourDerivatives(answer, slopes_of(answer, is_twice_fine=answer.claim.form.is_general).slopes)
    except FamilyError:
        return None


def handles_of(
    answer: Answer,
    picture: Picture,
    motion: ContourDerivatives | None,
    pinned: Collection[str] = (),
    held: Mapping[str, Sequence[str]] | None = None,
) -> list[Handle]:
    """The handles of a contour, points first. What only words that are pinned would move has none; a handle that is
    `held` keeps the words that it had."""
    placement = picture.sheet.placement
    if placement is None:
        return []
    words = {each.key: each for each in stated_words(answer) if each.value is not None}
    free = {key: each for key, each in words.items() if key not in pinned and not each.is_ignored}
    found = [*_points(motion, placement.view, free, held or {})] if motion else []
    known = find_known(answer) if motion is None else None
    done: set[str] = set()
    for grip in placement.grips:
        word = free.get(grip.word)
        if word is None or grip.word in done:
            continue
        if grip.center is not None and _is_angle(word):
            found.append(Handle(grip.word, HandleKind.ANGLE, grip.at, {}, grip.center))
        else:
            slope = _size_slope(answer, word, motion, known)
            if slope is None:
                continue
            at = _clear_of(grip.at, [each.at for each in found])
            found.append(Handle(grip.word, HandleKind.SIZE, at, {grip.word: _on_page(slope, placement.view)}))
        done.add(grip.word)
    return found


def moving_of(motion: ContourDerivatives, picture: Picture, keys: Iterable[str]) -> list[Moving]:
    """The elements of the path as they are drawn, and how these words move them."""
    view = picture.sheet.placement.view if picture.sheet.placement else None
    contour, wanted = motion.answer.contour, set(keys)
    if view is None or contour is None:
        return []
    found = []
    for each in contour.elements:
        places = (each.start, each.end, each.center) if isinstance(each, ArcSegment) else (each.start, each.end)
        slopes = tuple(
            {key: _on_page(slope, view) for key, slope in slopes.items() if key in wanted}
            for slopes in motion.of_element(each)
        )
        turn = -each.turn.sign if isinstance(each, ArcSegment) else 0
        found.append(Moving(each.name, tuple(map(view.place, places)), slopes, turn))
    return found


def _clear_of(at: Point, others: Sequence[Point]) -> Point:
    """A place on the page that a finger tells from the nearest of others."""
    near = min(others, key=lambda other: distance(at, other), default=None)
    if near is None or distance(at, near) >= FINGER:
        return at
    return along(near, direction(near, at), FINGER)


def _is_angle(word: StatedWord) -> bool:
    return word.unit == "deg"


def _on_page(slope: Point, view: Viewport) -> Point:
    return slope[0] * view.scale, -slope[1] * view.scale


# Points ------------------------------------------------------------------------------------------------------


def _points(
    motion: ContourDerivatives, view: Viewport, words: Mapping[str, StatedWord], held: Mapping[str, Sequence[str]]
) -> Iterator[Handle]:
    """A handle for each named point, the end, and each centre that a word moves; one where several coincide."""
    seen: list[Point] = []
    for name, at, slopes in _places(motion):
        if all(distance(at, other) > SAME for other in seen):
            kept = [key for key in held.get(name, ()) if key in slopes]
            moves = {key: _on_page(slopes[key], view) for key in kept or _chosen(name, slopes, words)}
            if moves:
                seen.append(at)
                yield Handle(name, HandleKind.POINT, view.place(at), moves)


def _places(motion: ContourDerivatives) -> Iterator[tuple[str, Point, Slopes]]:
    answer = motion.answer
    contour, figure = answer.contour, answer.profile.figure
    if contour is None or not contour.elements:
        return
    yield "end", contour.end, motion.of_element(contour.elements[-1])[1]
    for name, at in contour.points.items():
        yield name, at, motion.of_point(name)
    centers = {each.name: each.center for each in figure.path if isinstance(each, Arc)}
    for segment in contour.elements:
        if isinstance(segment, ArcSegment) and segment.name in centers:
            yield centers[segment.name], segment.center, motion.of_point(centers[segment.name])


def _chosen(name: str, slopes: Slopes, words: Mapping[str, StatedWord]) -> Sequence[str]:
    """The word or the two words that a drag of a point changes: first those that state it, then other lengths; angles
    and the sizes of corners only where nothing else moves it."""

    def rank(key: str) -> int:
        word = words[key]
        if any(each.startswith("corner") for each in word.fixes):
            return 3
        return 2 if _is_angle(word) else 1 if name not in word.fixes else 0

    ranked = sorted((rank(key), -hypot(*slopes[key]), key) for key in slopes if key in words)
    if not ranked:
        return ()
    (first, _, one), *others = ranked
    for second, _, other in others:
        (a, b), (c, d) = slopes[one], slopes[other]
        if second <= max(first, 1) and abs(a * d - b * c) > APART * hypot(a, b) * hypot(c, d):
            return one, other
    return (one,)


# Sizes -------------------------------------------------------------------------------------------------------


def _size_slope(
    answer: Answer, word: StatedWord, motion: ContourDerivatives | None, known: Known | None
) -> Point | None:
    """The movement of an element's middle for one unit of the word that states its size, at the arrow's tip. For a
    refused contour it comes from the points that are known."""
    figure = answer.profile.figure
    corners = [corner for corner in figure.corners if corner.name in word.fixes]
    names = [each.name for each in (*corners, *figure.path) if each in corners or _is_arc_of(each, word)]
    if motion is None:
        return _refused_slope(known, corners[0], word) if corners and known is not None else None
    segments = {each.name: each for each in answer.contour.elements} if answer.contour is not None else {}
    segment = next((segments[name] for name in names if name in segments), None)
    if segment is None:
        return None
    slopes = [each.get(word.key, (0.0, 0.0)) for each in motion.of_element(segment)]
    step = SAME
    places = (segment.start, segment.end, *((segment.center,) if isinstance(segment, ArcSegment) else ()))
    moved = [(at[0] + slope[0] * step, at[1] + slope[1] * step) for at, slope in zip(places, slopes, strict=True)]
    if isinstance(segment, ArcSegment):
        radius = distance(moved[2], moved[0])
        there: Segment = ArcSegment(segment.name, moved[0], moved[1], moved[2], radius, segment.turn)
    else:
        there = LineSegment(segment.name, moved[0], moved[1])
    (here, _), (after, _) = middle(segment), middle(there)
    slope = (after[0] - here[0]) / step, (after[1] - here[1]) / step
    return slope if hypot(*slope) > LEAST else None


def _is_arc_of(element: Corner | Line | Arc, word: StatedWord) -> bool:
    """Whether a word states the radius of an arc of the path."""
    return isinstance(element, Arc) and element.radius in word.fixes


def _refused_slope(known: Known, corner: Corner, word: StatedWord) -> Point | None:
    """The same for a corner that does not fit: it grows in proportion to its size, from its virtual intersection."""
    built, at = known.corners.get(corner.name), known.points.get(corner.at)
    if built is None or at is None or not word.value:
        return None
    here, _ = middle(corner_segment(corner, built))
    slope = (here[0] - at[0]) / word.value, (here[1] - at[1]) / word.value
    return slope if hypot(*slope) > LEAST else None
