"""A turned part around its axis: the programmed half, closed to the axis, the other half, and diameters."""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import islice, pairwise

from msgspec.structs import replace

from contoursolve.geometry import FIRST, SECOND, Length, Turn
from contoursolve.pictures.scene import Leader, Part, Rectangle, Scene, Thin, Trail, Weight, number
from contoursolve.pictures.theme import Role
from contoursolve.solving import ArcSegment, Point, Segment, distance, extremes, middle, on_arc
from contoursolve.tolerance import LENGTH

MOST_EDGES = 60
"""Edges that are drawn across a part."""

MOST_DIAMETERS = 8
"""Diameters that have labels: those of the longest cylinders."""

_NEAR = 0.3
"""1. The axis is near a half if it is no farther than this share of the half's larger side."""

_PAGE = 592.0 / 350.0
"""1. How much wider than tall a drawing can be."""

_WORTH = 0.5
"""1. How large contours must stay for the sake of the other half."""

_LONG = 0.02
"""1. The share of the larger side that a cylinder with a label has at least."""

_ASIDE = 0.25
"""1. Where a diameter points at a cylinder whose middle has an arrow."""

Cylinder = tuple[Segment, str]
"""A line along the axis, and its diameter as it is written."""


def turn_part(
    scene: Scene,
    segments: Sequence[Segment],
    cylinders: Sequence[Cylinder],
    *,
    is_whole: bool,
) -> Scene:
    """The scene of turned contours with what their part looks like: `segments` is what is cut of it. `is_whole` draws
    both halves."""
    if not segments:
        return scene
    shown = [each for trail in scene.each(Trail) if trail.weight is not Weight.PASSING for each in trail.segments]
    span = _span_of(shown)
    parts: list[Part] = []
    if is_whole:
        parts += [Trail(tuple(map(_mirrored, segments)), Role.MUTED, Weight.MIRRORED)]
    if is_whole or 0 <= span.low[SECOND] <= max(*span.size) * _NEAR:
        parts += [
            Thin(at, (at[0], -at[1] if is_whole else 0.0), Role.MUTED, is_dashed=False)
            for at in [*_ends(segments), *(islice(_edges(segments), MOST_EDGES) if is_whole else ())]
        ]
    if not is_whole:
        parts += _diameters([each for each in cylinders if each[0].length >= _LONG * max(*span.size)])
    return replace(scene, parts=(*parts, *scene.parts))


def cylinders_of(segments: Sequence[Segment], unit: Length) -> Iterator[Cylinder]:
    """The lines along the axis, each with its diameter."""
    for segment in segments:
        is_along = abs(segment.end[SECOND] - segment.start[SECOND]) <= LENGTH
        if not isinstance(segment, ArcSegment) and is_along and abs(segment.end[SECOND]) > LENGTH:
            yield segment, f"Ø{number(abs(segment.end[SECOND]) * 2, unit)}"


def crosses_axis(segments: Sequence[Segment]) -> bool:
    """Whether a path runs on both sides of the turning axis."""
    if not segments:
        return False
    span = _span_of(segments)
    return span.low[SECOND] < -LENGTH and span.high[SECOND] > LENGTH


def _span_of(segments: Sequence[Segment]) -> Rectangle:
    across, up = zip(*(at for segment in segments for at in extremes(segment, 0, 1)), strict=True)
    return Rectangle((min(across), min(up)), (max(across), max(up)))


def shows_both_halves(segments: Sequence[Segment], is_whole: bool | None) -> bool:
    """Whether both halves are drawn: as wanted, else where the contours stay at least half as large."""
    return is_whole if is_whole is not None else bool(segments) and _is_worth(_span_of(segments))


def _is_worth(span: Rectangle) -> bool:
    """Whether the contours stay large enough with both halves on a page."""
    wide, tall = span.size
    reach = max(abs(span.low[SECOND]), abs(span.high[SECOND]))
    alone = max(wide, tall * _PAGE)
    return alone >= _WORTH * max(wide, 2 * reach * _PAGE)


def _mirrored(segment: Segment) -> Segment:
    """An element on the other side of the axis."""

    def across(at: Point) -> Point:
        return at[0], -at[1]

    turned = replace(segment, start=across(segment.start), end=across(segment.end))
    if not isinstance(turned, ArcSegment):
        return turned
    return replace(turned, center=across(turned.center), turn=Turn.CW if turned.turn is Turn.CCW else Turn.CCW)


def _ends(segments: Sequence[Segment]) -> list[Point]:
    """The ends of what is cut: the places at which an odd number of elements meet, off the axis."""
    places: dict[tuple[int, int], Point] = {}
    met: Counter[tuple[int, int]] = Counter()
    for segment in segments:
        for at in (segment.start, segment.end):
            key = round(at[0] / _SAME), round(at[1] / _SAME)
            places.setdefault(key, at)
            met[key] += 1
    return [places[key] for key, times in met.items() if times % 2 and abs(places[key][1]) > LENGTH]


def _edges(segments: Sequence[Segment]) -> Iterator[Point]:
    """The places at which neighbours do not go on smoothly: circles that are seen from the side."""
    for before, after in pairwise(segments):
        if distance(before.end, after.start) > _SAME or abs(after.start[SECOND]) <= LENGTH:
            continue
        out, on = _way(before, 1.0), _way(after, 0.0)
        if abs(out[0] * on[1] - out[1] * on[0]) > _SHARP:
            yield after.start


def _way(segment: Segment, share: float) -> Point:
    """The direction of travel after a share of an element."""
    return (on_arc(segment, share) if isinstance(segment, ArcSegment) else middle(segment))[1]


_SHARP = 1e-3
"""1 (a sine). Less is no edge."""

_SAME = 0.001
"""mm. Ends that are nearer to each other are joined."""


def _diameters(cylinders: Sequence[Cylinder]) -> Iterator[Leader]:
    """The labels of the longest cylinders, one for each diameter, at the longest line that has it."""
    longest: dict[str, Segment] = {}
    for segment, told in cylinders:
        if told not in longest or segment.length > longest[told].length + LENGTH:
            longest[told] = segment
    chosen = sorted(longest.items(), key=lambda each: (-round(each[1].length, 6), each[0]))[:MOST_DIAMETERS]
    for told, segment in chosen:
        across = segment.start[FIRST] + _ASIDE * (segment.end[FIRST] - segment.start[FIRST])
        yield Leader((across, segment.end[SECOND]), (0.0, -1.0), told, Role.INK)
