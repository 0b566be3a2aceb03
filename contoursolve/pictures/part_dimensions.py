"""The dimensions of a whole part, as a drawing office gives them: lengths from the face or from zero, diameters, radii,
chamfers, angles, the end of a taper. What the control works out stands in parentheses (ISO 129-1, auxiliary dimension).
"""

from collections.abc import Iterator, Sequence
from math import atan2, degrees

from msgspec import Struct

from contoursolve.diagnosis import Answer
from contoursolve.geometry import FIRST, SECOND, Length
from contoursolve.pictures.scene import Aligned, Angle, Closeup, Leader, Mark, MarkKind, Ordinate, Part, number
from contoursolve.pictures.theme import Role
from contoursolve.solving import ArcSegment, Point, Segment, distance, extremes, middle, minus, on_arc
from contoursolve.tolerance import LENGTH

_SMALL = 9.0
"""Pixels. A smaller corner is shown enlarged."""

_ON_ARC = (0.5, 0.3, 0.7)
_SQUARE = 90.0
_FACTOR = 1_000
"""Values are the same to a thousandth of a millimetre, or of a degree."""


def _key(value: float) -> int:
    return round(value * _FACTOR)


class _Stated:
    """The numbers that words say of some contours: coordinates by axis, radii and angles."""

    def __init__(self, answers: Sequence[Answer], moves: Sequence[Segment]) -> None:
        self.places: set[tuple[int, int]] = set()
        self.radii: set[int] = set()
        self.angles: set[int] = set()
        self._take_moves(moves)
        contours = [each.contour for each in answers if each.contour is not None]
        ends = {tuple(map(_key, each.end)) for each in contours}
        for answer in answers:
            contour = answer.contour
            if contour is None:
                continue
            if tuple(map(_key, contour.start)) not in ends:
                self._place(contour.start)
            for fact in answer.profile.facts:
                given = answer.profile.givens.get(fact.given)
                if given is None or given.word is None:
                    continue
                if fact.placed is not None and fact.placed.is_stepped and fact.placed.point in contour.places:
                    axis = fact.placed.axis
                    self.places.add((axis, _key(contour.places[fact.placed.point][axis])))
                if fact.sizes:
                    self.radii.add(_key(float(given.value)))
                if fact.heading is not None or fact.directed:
                    self.angles.add(_key(float(given.value) % 180))

    def _take_moves(self, moves: Sequence[Segment]) -> None:
        for each in moves:
            self._place(each.end)
            if isinstance(each, ArcSegment):
                self.radii.add(_key(each.radius))

    def _place(self, at: Point) -> None:
        self.places |= {(axis, _key(at[axis])) for axis in (FIRST, SECOND)}

    def told(self, text: str, *, is_given: bool) -> tuple[str, Role]:
        """A dimension as it is written, and its role."""
        return (text, Role.INK) if is_given else (f"({text})", Role.DERIVED)

    def coordinate(self, text: str, axis: int, value: float) -> tuple[str, Role]:
        """A coordinate as it is written, and its role."""
        return self.told(text, is_given=(axis, _key(value)) in self.places)


class PartDrawing(Struct, frozen=True):
    """The dimensions of a part, and its corners that may be too small to be read."""

    parts: tuple[Part, ...]
    closeups: tuple[Closeup, ...]


def dimension_part(
    answers: Sequence[Answer],
    moves: Sequence[Segment],
    shown: Sequence[Segment],
    unit: Length,
    *,
    is_turned: bool,
    is_whole: bool,
) -> PartDrawing:
    """The dimensions of solved contours in one plane, and of moves that cut beside them; `shown` is all that is drawn.

    `is_turned` says that the second axis is a diameter, `is_whole` that both halves are drawn. In the order in which
    they find room: diameters, lengths, corners, angles.
    """
    stated = _Stated(answers, moves)
    contours = [answer.contour for answer in answers if answer.contour is not None]
    segments = [*(each for contour in contours for each in contour.elements), *moves]
    if not segments:
        return PartDrawing((), ())
    plain = [each for each in segments if not each.name.startswith("corner")]
    points = [at for each in contours for at in (each.start, *each.points.values(), each.end)]
    points += [at for each in moves for at in (each.start, each.end)]
    across: list[Part]
    along: list[Part]
    if is_turned:
        across = [*_diameters(plain, points, stated, unit)] if is_whole else []
        along = [*_lengths(points, stated, unit, is_whole=is_whole)]
    else:
        along = [each for axis in (FIRST, SECOND) for each in _coordinates(points, plain, shown, axis, stated, unit)]
        across = [Mark(at, MarkKind.CENTER) for at in dict.fromkeys(_centers(plain))]
    corners = [*_corners(segments, stated, unit, is_turned=is_turned)]
    parts: tuple[Part, ...] = (
        *across,
        *along,
        *corners,
        *_arcs(plain, stated, unit),
        *_angles(plain, stated, is_turned=is_turned),
    )
    closeups = tuple(
        Closeup(leader.text, (segment,), _SMALL)
        for leader, segment in zip(corners, _named_corners(segments), strict=True)
    )
    return PartDrawing(parts, closeups)


def _diameters(plain: Sequence[Segment], points: Sequence[Point], stated: _Stated, unit: Length) -> Iterator[Aligned]:
    """One of each diameter, with both arrows: at its longest cylinder, else at the end of a taper or an arc."""
    longest: dict[int, Segment] = {}
    for each in plain:
        size = _key(abs(each.end[SECOND]))
        is_along = not isinstance(each, ArcSegment) and _key(each.start[SECOND]) == _key(each.end[SECOND])
        if is_along and size and (size not in longest or each.length > longest[size].length + LENGTH):
            longest[size] = each
    where = {size: (each.start[FIRST] + each.end[FIRST]) / 2 for size, each in longest.items()}
    tapers = (at for each in plain if not _is_along_axis(each) for at in (each.start, each.end))
    ends = {_key(at[SECOND]): at[FIRST] for at in points}
    for at in tapers:
        size = _key(abs(at[SECOND]))
        if size and size not in where and size in ends:
            where[size] = at[FIRST]
    for size, place in sorted(where.items(), key=lambda each: (each[1], each[0])):
        radius = size / _FACTOR
        text, role = stated.coordinate(f"Ø{number(2 * radius, unit)}", SECOND, radius)
        yield Aligned((place, radius), (place, -radius), text, role)


def _lengths(points: Sequence[Point], stated: _Stated, unit: Length, *, is_whole: bool) -> Iterator[Ordinate]:
    """The lengths from the face, in a row: below the part where both halves are drawn. Where most of the part lies
    behind zero, the face is there, and what is in front of it is negative."""
    ends = [at[FIRST] for at in points]
    face = 0.0 if min(ends) <= 0 <= max(ends) <= -min(ends) else max(ends)
    sign = -1 if is_whole else 1
    # The extension line begins at the outermost point of a place.
    outermost = {_key(at[FIRST]): at for at in sorted(points, key=lambda at: abs(at[SECOND]))}
    for _, at in sorted(outermost.items()):
        text, role = stated.coordinate(number(face - at[FIRST], unit), FIRST, at[FIRST])
        yield Ordinate((at[FIRST], sign * abs(at[SECOND])), FIRST, text, role, side=sign)


def _coordinates(
    points: Sequence[Point],
    plain: Sequence[Segment],
    shown: Sequence[Segment],
    axis: int,
    stated: _Stated,
    unit: Length,
) -> Iterator[Ordinate]:
    """Coordinates on an axis from the zero point, each once, on the side where its points lie."""
    other = 1 - axis
    centers = [each.center for each in plain if isinstance(each, ArcSegment)]
    amid = _amid([*shown, *plain])[other]
    found: dict[int, Point] = {}
    for at in (*points, *centers):
        key = _key(at[axis])
        if key not in found or abs(at[other] - amid) > abs(found[key][other] - amid):
            found[key] = at
    for _, at in sorted(found.items()):
        text, role = stated.coordinate(number(at[axis], unit), axis, at[axis])
        if at in centers and (axis, _key(at[axis])) not in stated.places:
            continue  # the radius tells it
        yield Ordinate(at, axis, text, role, side=1 if at[other] >= amid else -1)


def _centers(plain: Sequence[Segment]) -> Iterator[Point]:
    yield from (each.center for each in plain if isinstance(each, ArcSegment))


def _named_corners(segments: Sequence[Segment]) -> list[Segment]:
    return [each for each in segments if each.name.startswith("corner")]


def _corners(segments: Sequence[Segment], stated: _Stated, unit: Length, *, is_turned: bool) -> Iterator[Leader]:
    """Roundings as R, chamfers as 1x45 or C."""
    amid = _amid(segments)
    for each in _named_corners(segments):
        if isinstance(each, ArcSegment):
            yield _radius(each, stated, unit, is_corner=True)
            continue
        at, way = middle(each)
        across = abs(each.end[FIRST] - each.start[FIRST]), abs(each.end[SECOND] - each.start[SECOND])
        is_45 = abs(across[0] - across[1]) <= LENGTH
        text = (
            f"{number(across[0], unit)}\N{MULTIPLICATION SIGN}45°"
            if is_turned and is_45
            else f"C{number(_setback(each, segments), unit)}"
        )
        normal = _outward((-way[1], way[0]), (0.0, 1.0) if is_turned else minus(at, amid))
        yield Leader(at, normal, text, Role.INK)


def _amid(segments: Sequence[Segment]) -> Point:
    """The middle of the rectangle around some elements."""
    across, up = zip(*(at for each in segments for at in extremes(each, 0, 1)), strict=True)
    return (min(across) + max(across)) / 2, (min(up) + max(up)) / 2


def _outward(way: Point, side: Point) -> Point:
    """A direction, or the opposite one, that leads to a side."""
    return way if way[0] * side[0] + way[1] * side[1] >= 0 else (-way[0], -way[1])


def _setback(chamfer: Segment, segments: Sequence[Segment]) -> float:
    """The distance of a chamfer's ends from the corner that it cuts, by the angle at which it meets its neighbour."""
    place = segments.index(chamfer)
    before = segments[place - 1] if place else chamfer
    way, own = middle(before)[1], middle(chamfer)[1]
    cosine = abs(way[0] * own[0] + way[1] * own[1])
    is_neighbour = place and not isinstance(before, ArcSegment) and distance(before.end, chamfer.start) <= LENGTH
    return chamfer.length / (2 * cosine) if is_neighbour and cosine > LENGTH else chamfer.length


def _radius(arc: ArcSegment, stated: _Stated, unit: Length, *, is_corner: bool) -> Leader:
    text = f"R{number(arc.radius, unit)}"
    told, role = stated.told(text, is_given=is_corner or _key(arc.radius) in stated.radii)
    first, *others = (on_arc(arc, share)[0] for share in _ON_ARC)
    return Leader(first, (first[0] - arc.center[0], first[1] - arc.center[1]), told, role, center=arc.center,
                  others=tuple(others))  # fmt: skip


def _arcs(plain: Sequence[Segment], stated: _Stated, unit: Length) -> Iterator[Leader]:
    """The radii of arcs that are no corners, each circle once."""
    done = set[tuple[int, ...]]()
    for each in plain:
        if isinstance(each, ArcSegment):
            key = _key(each.center[0]), _key(each.center[1]), _key(each.radius)
            if key not in done:
                done.add(key)
                yield _radius(each, stated, unit, is_corner=False)


def _is_along_axis(segment: Segment) -> bool:
    return not isinstance(segment, ArcSegment) and any(
        _key(segment.start[axis]) == _key(segment.end[axis]) for axis in (FIRST, SECOND)
    )


def _angles(plain: Sequence[Segment], stated: _Stated, *, is_turned: bool) -> Iterator[Angle]:
    """Angles that words give, of lines along no axis: of a turned part to its axis, else from the first axis."""
    for each in plain:
        if isinstance(each, ArcSegment) or _is_along_axis(each) or _key(_angle(each) % 180) not in stated.angles:
            continue
        turned = (_angle(each) + 180) % 360 - 180
        base = 0.0
        if is_turned and abs(turned) > _SQUARE:
            base = 180.0
            turned = (turned - 180 + 180) % 360 - 180
        yield Angle(each.start, turned, f"{abs(turned):.3f}".rstrip("0").rstrip(".") + "°", Role.INK, base=base)


def _angle(line: Segment) -> float:
    _, way = middle(line)
    return degrees(atan2(way[1], way[0])) % 360
