"""Can the control make the path? Direction of travel, and the room for each corner."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import hypot, nan

from msgspec.structs import replace

from contoursolve.geometry import FIRST, SECOND, Arc, Corner, Figure, Line, Profile
from contoursolve.solving.compare import increments_of
from contoursolve.solving.solution import BESIDE, Note, NoteKind, Point, Refusal, RefusalKind
from contoursolve.tolerance import LARGEST, LENGTH, REGULAR, RESIDUAL

Outputs = Mapping[str, float]


def check_path(
    profile: Profile,
    corner_residuals: Sequence[str],
    points: Mapping[str, Point],
    out: Outputs,
    sizes: Mapping[str, float],
    resize: Callable[[Mapping[str, float]], Outputs],
) -> tuple[list[Refusal], list[Note]]:
    """Everything that speaks against the path between points that satisfy the equations.

    `out` are the outputs of a compiled path, `sizes` the sizes of its corners by the words that state them, mm;
    `resize` gives the outputs for other sizes.
    """
    figure = profile.figure
    refusals = check_range(figure, points)
    remarks: list[Note] = []
    for element in figure.path if not refusals else ():
        if isinstance(element, Arc):
            is_closed = hypot(*_difference(points[element.tail], points[element.head])) <= LENGTH
            if is_closed and not element.may_be_full:
                refusals.append(Refusal(RefusalKind.ARC_EMPTY, element.name))
        else:
            refusals += _check_direction(element, out, profile)
            if abs(out[f"length:{element.name}"]) <= LENGTH:
                remarks.append(Note(NoteKind.LINE_VANISHES, element.name))
    if not refusals:
        for corner in figure.corners:
            for refusal in _check_corner(corner, profile, points, out, sizes[corner.size]):
                values = dict(refusal.values)
                if refusal.kind is RefusalKind.BEVEL_IN_BAND and _touches_arc(corner, figure, out):
                    # Between two lines no size has a bevel; on an arc a smaller one may.
                    limit, *_ = _largest(corner, figure, out, sizes[corner.size], resize)
                    values |= {"limit": limit} if limit >= LEAST else {}
                refusals.append(replace(refusal, values=values))
    if not refusals:
        refusals += _check_room(figure, out, sizes, resize)
    if not refusals:
        # The definitions of the corners; checked last, because a corner that does not fit may be huge.
        residuals = [abs(out[name]) for name in corner_residuals]
        if not all(residual <= RESIDUAL for residual in residuals):  # true for NaN
            refusals.append(Refusal(RefusalKind.NOT_VERIFIED, "", (), {"limit": RESIDUAL, "actual": max(residuals)}))
    return refusals, remarks


def check_range(figure: Figure, points: Mapping[str, Point]) -> list[Refusal]:
    """The point of a path that lies farthest from the start, if no word reaches it."""
    if not figure.path:
        return []
    start = points[figure.start]
    far = [(abs(at), name) for name in figure.points for at in _difference(start, points[name])]
    away, name = max(far, default=(0.0, ""))
    values = {"limit": LARGEST, "actual": away}
    return [Refusal(RefusalKind.OUT_OF_RANGE, name, (), values)] if away > LARGEST else []


def _check_direction(line: Line, out: Outputs, profile: Profile) -> list[Refusal]:
    length = out[f"length:{line.name}"]
    if length >= -LENGTH:
        return []
    if line.heading is None:
        return [Refusal(RefusalKind.LINE_BACKWARDS, line.name, (), {"off_by_mm": -length})]
    if line.is_signed:
        sizes = tuple(corner.size for corner in profile.figure.corners if corner.at == line.tail)
        return [Refusal(RefusalKind.CORNER_SIGN, line.name, sizes, {"off_by_mm": -length})]
    if profile.givens[line.heading].word is None:
        return [Refusal(RefusalKind.LINE_REVERSED, line.name, (), {"off_by_mm": -length})]
    angle = float(profile.givens[line.heading].value)
    values = {"actual": angle, "expected": angle - 180 if angle > 0 else angle + 180, "off_by_mm": -length}
    return [Refusal(RefusalKind.LINE_REVERSED, line.name, (line.heading,), values)]


def _check_corner(
    corner: Corner, profile: Profile, points: Mapping[str, Point], out: Outputs, size: float
) -> list[Refusal]:
    def refuse(kind: RefusalKind, **values: float) -> list[Refusal]:
        return [Refusal(kind, corner.name, (corner.size,), values)]

    for name in _elements(corner, out):
        if out[f"length:{name}"] <= LENGTH:
            values = {"limit": 0.0, "actual": size}
            return [Refusal(RefusalKind.CORNER_TOO_LARGE, corner.name, (corner.size,), values, (), (name, name))]
    if out.get(f"landing:{corner.name}") == 0:
        return refuse(RefusalKind.LANDING_UNKNOWN)
    straight = out[f"cosine:{corner.name}"] > 0
    turn, least = abs(out[f"turn:{corner.name}"]), corner.least if straight else 0.0
    if turn <= max(REGULAR, least) and not (straight and corner.guard):
        return refuse(RefusalKind.CORNER_STRAIGHT if straight else RefusalKind.CORNER_REVERSES)
    if corner.shape.share:
        sides = _outside_rectangle(corner, profile, points)
        outside = [(excess, axis) for excess, give, axis in sides if excess > give + LENGTH]
        if outside:
            off, axis = max(outside)
            values = {"off_by_mm": off}
            return [Refusal(RefusalKind.BEVEL_OUTSIDE, corner.name, (corner.size,), values, (), (axis,))]
        # Not a number is a bevel that is too large for its arc.
        negative = [each for way in ("in", "out") if (each := out[f"setback-{way}:{corner.name}"]) < -LENGTH]
        if negative:
            return refuse(RefusalKind.BEVEL_IN_BAND, actual=min(negative))
    return []


def _outside_rectangle(
    corner: Corner, profile: Profile, points: Mapping[str, Point]
) -> Iterator[tuple[float, float, str]]:
    """How far the corner lies outside the rectangle spanned by the ends of its two lines, mm, on each side, how far it
    may, as both coordinates that are compared are exact to half their increment, and along which axis."""
    path = {element.name: element for element in profile.figure.path}
    before, after = path[corner.before], path.get(corner.after or "")
    if not isinstance(before, Line) or not isinstance(after, Line):
        return
    increment, ends = increments_of(profile), (points[before.tail], points[after.head])
    for axis in (FIRST, SECOND):
        low, high = sorted((ends[0][axis], ends[1][axis]))
        give, letter = increment(str(axis)), profile.plane.axes[axis]
        yield low - points[corner.at][axis], give, letter
        yield points[corner.at][axis] - high, give, letter


def _check_room(
    figure: Figure, out: Outputs, sizes: Mapping[str, float], resize: Callable[[Mapping[str, float]], Outputs]
) -> list[Refusal]:
    """Each element must be as long as the setbacks of the corners at its two ends."""
    found: list[tuple[RefusalKind, str, list[Corner], dict[str, float], tuple[str, ...]]] = []
    alone = {corner.name: _short_of(corner, out) for corner in figure.corners}
    for corner in figure.corners:
        for short in alone[corner.name][:1]:
            values = {"actual": sizes[corner.size], "needed": _setbacks(corner, out)[short]}
            values |= {"available": out[f"length:{short}"]}
            found.append((RefusalKind.CORNER_TOO_LARGE, corner.name, [corner], values, (short,)))
    refused = {name for names in alone.values() for name in names}
    for element in figure.path:
        room, length = out[f"room:{element.name}"], out[f"length:{element.name}"]
        if room < -LENGTH and element.name not in refused:
            corners = [corner for corner in figure.corners if element.name in _setbacks(corner, out)]
            values = {"limit": length, "actual": length - room, "off_by_mm": -room}
            found.append((RefusalKind.CORNERS_OVERLAP, element.name, corners, values, ()))
    blamed = {corner.name: corner for _, _, corners, *_ in found for corner in corners}
    limits = {name: _largest(corner, figure, out, sizes[corner.size], resize) for name, corner in blamed.items()}
    together: dict[str, float] = {}
    full = {size for limit, beside, _ in limits.values() if limit < LEAST for size in beside}
    if full:
        crowd = [corner for corner in figure.corners if corner.name in blamed or corner.size in full]
        together = {"together": _largest_together(crowd, figure, sizes, resize)}
    refusals = []
    for kind, subject, corners, values, blocked in found:
        largest, givens = [limits[corner.name] for corner in corners], tuple(corner.size for corner in corners)
        beside = largest[0][1] if kind is RefusalKind.CORNER_TOO_LARGE else ()
        keys = ("limit",) if kind is RefusalKind.CORNER_TOO_LARGE else BESIDE
        # What fits beside a corner that cannot stay as it is tells nothing.
        told = (
            nan if len(corners) > 1 and any(alone[other.name] for other in corners if other is not corner) else limit
            for corner, (limit, *_) in zip(corners, largest, strict=True)
        )
        every = {**values, **dict(zip(keys, told, strict=False)), **together}
        known = {name: value for name, value in every.items() if value == value}
        elements = (*blocked, largest[0][2] or blocked[0]) if blocked else ()
        refusals.append(Refusal(kind, subject, givens, known, beside, elements))
    return refusals


def _short_of(corner: Corner, out: Outputs) -> list[str]:
    """The elements on which a corner alone has no room.

    A setback on an arc that is not a number belongs to a corner that cannot touch the arc at all; a negative one
    would leave the arc beyond its end.
    """
    setbacks = _setbacks(corner, out).items()
    return [name for name, setback in setbacks if not -LENGTH <= setback <= out[f"length:{name}"] + LENGTH]


def _crowded(corner: Corner, out: Outputs) -> str | None:
    """The element on which a corner has no room beside its neighbours, or is not what its definition says."""
    if not out[f"setback-out:{corner.name}"] >= -LENGTH:
        return corner.before
    full = [name for name in _setbacks(corner, out) if not out.get(f"room:{name}", 0.0) >= -LENGTH]
    return next(iter((*_short_of(corner, out), *full)), None)


def _largest(
    corner: Corner, figure: Figure, out: Outputs, size: float, resize: Callable[[Mapping[str, float]], Outputs]
) -> tuple[float, tuple[str, ...], str | None]:
    """The largest size of a corner that passes the checks while its neighbours stay as they are (mm; 0 if none does),
    the sizes of the neighbours that limit it, and the element on which they do."""

    def crowded(each: float) -> str | None:
        return _crowded(corner, resize({corner.size: each}))

    high = size
    if not _touches_arc(corner, figure, out):
        # Setbacks on lines are proportional to the size.
        for name, setback in _setbacks(corner, out).items():
            room = out.get(f"room:{name}", out[f"length:{name}"] - setback) + setback
            high = min(high, size * room / setback) if setback > 0 else high
    limit = _bisect(lambda each: crowded(each) is None, size, near=high)
    element = crowded(limit + max(NEAR, NEAR * limit))
    others = (other for other in figure.corners if other is not corner and element in _elements(other, out))
    return limit, tuple(other.size for other in others), element


def _touches_arc(corner: Corner, figure: Figure, out: Outputs) -> bool:
    return any(isinstance(each, Arc) and each.name in _elements(corner, out) for each in figure.path)


def _largest_together(
    corners: Sequence[Corner],
    figure: Figure,
    sizes: Mapping[str, float],
    resize: Callable[[Mapping[str, float]], Outputs],
) -> float:
    """The size (mm) to which the larger ones of some corners must come down for all to fit; 0 if none is so small."""

    def fits(each: float) -> bool:
        out = resize({corner.size: min(sizes[corner.size], each) for corner in corners})
        return all(_crowded(corner, out) is None for corner in figure.corners)

    return _bisect(fits, max(sizes[corner.size] for corner in corners))


def _bisect(fits: Callable[[float], bool], high: float, near: float | None = None) -> float:
    """The largest size (mm) that fits, below one that does not; `near` is where it is expected."""
    low = 0.0
    if near is not None:
        low, high = max(low, near - NEAR), max(min(high, near + NEAR), TINY)
        low = low if fits(low) else 0.0
    while high - low > TINY * max(1.0, high):
        middle = (low + high) / 2
        low, high = (middle, high) if fits(middle) else (low, middle)
    # What is a decimal but for rounding is that decimal, if it fits.
    decimal = round(low, DECIMALS)
    return decimal if abs(decimal - low) <= NEAR and fits(decimal) else low


TINY, NEAR, DECIMALS = 1e-14, 1e-8, 6
"""mm. To which a size is found, within which it is expected, and the decimals that a size in mm or inch has."""

LEAST = 0.00254
"""mm. The least increment of an inch program, the larger one: where no more is left, there is no room."""


def _setbacks(corner: Corner, out: Outputs) -> dict[str, float]:
    """The length that a corner takes of each element that has two ends, mm."""
    setbacks = out[f"setback-in:{corner.name}"], out[f"setback-out:{corner.name}"]
    return dict(zip(_elements(corner, out), setbacks, strict=False))


def _elements(corner: Corner, out: Outputs) -> list[str]:
    """The elements that a corner joins, as far as they have two ends."""
    after = corner.after or corner.lands_on
    return [corner.before, *([after] if after and f"length:{after}" in out else [])]


def _difference(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1]
