"""Can the control make the path? Direction of travel, and the room for each corner."""

from collections.abc import Callable, Mapping, Sequence
from math import hypot, inf, isfinite

from contoursolve.model import FIRST, SECOND, Arc, Corner, Figure, Line, Profile
from contoursolve.solving.solution import BESIDE, Point, Refusal, RefusalKind, Remark, RemarkKind
from contoursolve.tolerance import LENGTH, REGULAR, RESIDUAL

Outputs = Mapping[str, float]


def check_path(
    profile: Profile,
    corner_residuals: Sequence[str],
    points: Mapping[str, Point],
    out: Outputs,
    sizes: Mapping[str, float],
    resize: Callable[[Mapping[str, float]], Outputs],
) -> tuple[list[Refusal], list[Remark]]:
    """Everything that speaks against the path between points that satisfy the equations.

    `out` are the outputs of a compiled path, `sizes` the sizes of its corners by the words that state them, mm;
    `resize` gives the outputs for other sizes.
    """
    figure = profile.figure
    refusals: list[Refusal] = []
    remarks: list[Remark] = []
    for element in figure.path:
        if isinstance(element, Arc):
            if hypot(*_difference(points[element.tail], points[element.head])) <= LENGTH:
                refusals.append(Refusal(RefusalKind.ARC_EMPTY, element.name))
        else:
            refusals += _check_direction(element, out, profile)
            if abs(out[f"length:{element.name}"]) <= LENGTH:
                remarks.append(Remark(RemarkKind.LINE_VANISHES, element.name))
    if not refusals:
        for corner in figure.corners:
            refusals += _check_corner(corner, figure, points, out, sizes[corner.size])
    if not refusals:
        refusals += _check_room(figure, out, sizes, resize)
    if not refusals:
        # The definitions of the corners; checked last, because a corner that does not fit may be huge.
        residuals = [abs(out[name]) for name in corner_residuals]
        if not all(residual <= RESIDUAL for residual in residuals):  # true for NaN
            refusals.append(Refusal(RefusalKind.NOT_VERIFIED, "", (), {"limit": RESIDUAL, "actual": max(residuals)}))
    return refusals, remarks


def _check_direction(line: Line, out: Outputs, profile: Profile) -> list[Refusal]:
    length = out[f"length:{line.name}"]
    if length >= -LENGTH:
        return []
    if line.heading is None:
        return [Refusal(RefusalKind.LINE_BACKWARDS, line.name, (), {"off_by_mm": -length})]
    if profile.givens[line.heading].word is None:
        return [Refusal(RefusalKind.LINE_REVERSED, line.name, (), {"off_by_mm": -length})]
    angle = float(profile.givens[line.heading].value)
    values = {"actual": angle, "expected": angle - 180 if angle > 0 else angle + 180, "off_by_mm": -length}
    return [Refusal(RefusalKind.LINE_REVERSED, line.name, (line.heading,), values)]


def _check_corner(
    corner: Corner, figure: Figure, points: Mapping[str, Point], out: Outputs, size: float
) -> list[Refusal]:
    def refuse(kind: RefusalKind, **values: float) -> list[Refusal]:
        return [Refusal(kind, corner.name, (corner.size,), values)]

    for name in _elements(corner, out):
        if out[f"length:{name}"] <= LENGTH:
            return refuse(RefusalKind.CORNER_TOO_LARGE, limit=0.0, actual=size)
    if out.get(f"landing:{corner.name}") == 0:
        return refuse(RefusalKind.LANDING_UNKNOWN)
    if abs(out[f"turn:{corner.name}"]) <= REGULAR:
        straight = out[f"cosine:{corner.name}"] > 0
        return refuse(RefusalKind.CORNER_STRAIGHT if straight else RefusalKind.CORNER_REVERSES)
    if corner.shape.share:
        outside = _outside_rectangle(corner, figure, points)
        if outside > LENGTH:
            return refuse(RefusalKind.BEVEL_OUTSIDE, off_by_mm=outside)
        # Not a number is a bevel that is too large for its arc.
        negative = [each for way in ("in", "out") if (each := out[f"setback-{way}:{corner.name}"]) < -LENGTH]
        if negative:
            return refuse(RefusalKind.BEVEL_IN_BAND, actual=min(negative))
    return []


def _outside_rectangle(corner: Corner, figure: Figure, points: Mapping[str, Point]) -> float:
    """How far the corner lies outside the rectangle spanned by the ends of its two lines, mm."""
    path = {element.name: element for element in figure.path}
    before, after = path[corner.before], path.get(corner.after or "")
    if not isinstance(before, Line) or not isinstance(after, Line):
        return 0.0
    ends = points[before.tail], points[after.head]
    return max(
        excess
        for axis in (FIRST, SECOND)
        for low, high in (sorted((ends[0][axis], ends[1][axis])),)
        for excess in (low - points[corner.at][axis], points[corner.at][axis] - high)
    )


def _check_room(
    figure: Figure, out: Outputs, sizes: Mapping[str, float], resize: Callable[[Mapping[str, float]], Outputs]
) -> list[Refusal]:
    """Each element must be as long as the setbacks of the corners at its two ends."""
    refusals: list[Refusal] = []
    refused: set[str] = set()
    for corner in figure.corners:
        short = _short_of(corner, out)
        if short is not None:
            refused.add(corner.name)
            size = sizes[corner.size]
            values = {"limit": _largest(corner, figure, out, size, resize), "actual": size}
            values |= {"needed": _setbacks(corner, out)[short], "available": out[f"length:{short}"]}
            known = {name: value for name, value in values.items() if value == value}
            refusals.append(Refusal(RefusalKind.CORNER_TOO_LARGE, corner.name, (corner.size,), known))
    for element in figure.path:
        corners = [corner for corner in figure.corners if element.name in _setbacks(corner, out)]
        room = out[f"room:{element.name}"]
        if room < -LENGTH and not refused & {corner.name for corner in corners}:
            length = out[f"length:{element.name}"]
            values = {"limit": length, "actual": length - room, "off_by_mm": -room}
            largest = [_largest(corner, figure, out, sizes[corner.size], resize) for corner in corners]
            values |= {key: limit for key, limit in zip(BESIDE, largest, strict=False) if isfinite(limit)}
            givens = tuple(corner.size for corner in corners)
            refusals.append(Refusal(RefusalKind.CORNERS_OVERLAP, element.name, givens, values))
    return refusals


def _short_of(corner: Corner, out: Outputs, reserved: Mapping[str, float] | None = None) -> str | None:
    """The element on which a corner has no room; `reserved` is what others take of the elements, mm.

    A setback on an arc that is not a number belongs to a corner that cannot touch the arc at all; a negative one
    would leave the arc beyond its end.
    """
    for name, setback in _setbacks(corner, out).items():
        room = out[f"length:{name}"] - (reserved or {}).get(name, 0.0)
        if not -LENGTH <= setback <= room + LENGTH:
            return name
    return None


def _largest(
    corner: Corner, figure: Figure, out: Outputs, size: float, resize: Callable[[Mapping[str, float]], Outputs]
) -> float:
    """The largest size of a corner that fits beside its neighbours."""
    taken: dict[str, float] = {}
    for name in _setbacks(corner, out):
        others = sum(_setbacks(other, out).get(name, 0.0) for other in figure.corners if other is not corner)
        taken[name] = others if others < out[f"length:{name}"] else 0.0
    arcs = {element.name for element in figure.path if isinstance(element, Arc)}
    if not arcs & taken.keys():
        # Setbacks on lines are proportional to the size.
        setbacks = _setbacks(corner, out).items()
        rooms = ((out[f"length:{name}"] - taken[name], setback) for name, setback in setbacks if setback > 0)
        return min((size * room / setback for room, setback in rooms), default=inf)
    low, high = 0.0, size
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        changed = resize({corner.size: middle})
        fits = _short_of(corner, changed, taken) is None and changed[f"setback-out:{corner.name}"] >= -LENGTH
        low, high = (middle, high) if fits else (low, middle)
    return low


BISECTIONS = 50
"""From any size to below the rounding of a coordinate."""


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
