"""The solved path: lines and arcs with all their numbers, checked once more as a path."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import acos, asin, atan2, ceil, cos, degrees, dist, fsum, hypot, pi, radians, sin, sqrt, tau
from typing import Any, NamedTuple

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Shown, from_above, need
from contoursolve.geometry import Corner, Line, Plane, Profile, Turn
from contoursolve.solving.solution import Point, SystemSolution
from contoursolve.tolerance import AGREEMENT, LENGTH


class LineSegment(Struct, frozen=True):
    """A straight element of a path.

    Attributes:
        name: its name on the drawing, such as `line 1` or `corner 1`.
        start: where it begins: two coordinates in the plane's axes, mm, X of a lathe as radius.
        end: where it ends, likewise.
    """

    name: str
    start: Point
    end: Point

    @property
    def length(self) -> float:
        """Length, mm."""
        return hypot(self.end[0] - self.start[0], self.end[1] - self.start[1])

    @property
    def angle(self) -> float:
        """Direction of travel, degrees, counter-clockwise from the plane's first axis."""
        return degrees(atan2(self.end[1] - self.start[1], self.end[0] - self.start[0]))


class ArcSegment(Struct, frozen=True):
    """A circular element of a path; seen with the plane's first axis to the right and its second axis up.

    Attributes:
        name: its name on the drawing, such as `arc 1` or `corner 1`.
        start: where it begins: two coordinates in the plane's axes, mm, X of a lathe as radius.
        end: where it ends, likewise.
        center: its centre, likewise.
        radius: its radius, mm.
        turn: the sense in which it is travelled.
    """

    name: str
    start: Point
    end: Point
    center: Point
    radius: float
    turn: Turn

    @property
    def sweep(self) -> float:
        """Angle travelled, degrees, more than 0: a full circle where it ends as it begins."""
        if hypot(self.end[0] - self.start[0], self.end[1] - self.start[1]) <= LENGTH:
            return 360.0
        begin = atan2(self.start[1] - self.center[1], self.start[0] - self.center[0])
        end = atan2(self.end[1] - self.center[1], self.end[0] - self.center[0])
        return degrees(((end - begin) * self.turn.sign) % tau)

    @property
    def length(self) -> float:
        """Length along the arc, mm."""
        return self.radius * self.sweep / degrees(1)


Segment = LineSegment | ArcSegment


def swept_area(segment: Segment, origin: Point) -> float:
    """The area between a line or an arc and a point, mm2, counter-clockwise positive."""
    (x, y), (u, v) = ((at[0] - origin[0], at[1] - origin[1]) for at in (segment.start, segment.end))
    straight = (x * v - y * u) / 2
    if isinstance(segment, LineSegment):
        return straight
    angle = radians(segment.sweep)
    return straight + segment.turn.sign * segment.radius**2 * (angle - sin(angle)) / 2


class NamedPoints(dict[str, Point]):
    """The named points of a path. `start` and `end` can be asked for like them, and are not listed."""

    def __init__(self, points: Mapping[str, Point], start: Point, end: Point) -> None:
        super().__init__(points)
        self._ends = {"start": start, "end": end}

    def __missing__(self, name: str) -> Point:
        if name in self._ends:
            return self._ends[name]
        raise KeyError(f"the contour has no point {name}; there are {', '.join((*self._ends, *self))}")


class Crossing(NamedTuple):
    """The first element that goes across the spindle axis from where the path begins, and its farthest place there."""

    element: Segment
    at: Point


@dataclass(frozen=True, slots=True)
class Contour(Shown):
    """The path of one contour from `start` to `end` without gaps, and its named points. Contours with the same numbers
    are equal, whatever their plane.

    A point is two coordinates in the axes of `plane`, mm, X of a lathe as radius.

    Attributes:
        start: where it begins.
        end: where it ends.
        points: the points that the control computes, by name.
        elements: its lines and arcs, in the order of travel.
        plane: the axes, first and second.
        places: all points of its drawing, such as the centres of arcs and the virtual intersections at corners.
        free: the axes on which its coordinates count from its start, as its place is not known.
    """

    start: Point
    end: Point
    points: Mapping[str, Point]
    """Its named points, such as `V1`; `start` and `end` as well, which are not listed."""
    elements: tuple[Segment, ...]
    plane: Plane = field(compare=False)
    places: Mapping[str, Point] = field(default_factory=dict, compare=False, repr=False)
    free: tuple[bool, bool] = field(default=(False, False), compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", NamedPoints(self.points, self.start, self.end))

    def __hash__(self) -> int:
        return hash((self.start, self.end, self.elements))

    @property
    def length(self) -> float:
        """The length of the path, mm."""
        return sum(element.length for element in self.elements)

    @property
    def area(self) -> float:
        """The area that a closed path goes around, mm2, where it does not cross itself; exact for its lines and arcs.
        Raises ValueError for a path that is open by more than the least increment."""
        gap = dist(self.start, self.end)
        if gap > AGREEMENT or not self.elements:
            raise ValueError(
                f"the contour is open: its end is {gap:.4f} mm from its start; only a closed one has an area"
            )
        parts = [swept_area(element, self.start) for element in self.elements]
        return abs(fsum((*parts, swept_area(LineSegment("", self.end, self.start), self.start))))

    def to_shapely(self, chord_error: float = 0.01) -> Any:
        """The path as a `LineString` of shapely through the points of `sample`; `shapely.Polygon` takes a closed one.

        Raises MissingExtraError without the package of `contoursolve[geometry]`, ValueError for a chord error that is
        not positive.
        """
        shapely = need("shapely", "geometry", "a contour for shapely")
        return shapely.LineString(self.sample(chord_error))

    def table(self) -> list[dict[str, str | float | None]]:
        """A row for each element, as `pandas.DataFrame` takes them; None for what an element does not have.

        The names of the columns have the axes of the plane and the units: `end_Z_mm`, `end_X_radius_mm`, `radius_mm`,
        `angle_deg` (the direction of a line, counter-clockwise from the plane's first axis), `sweep_deg` (the angle
        that an arc travels).
        """
        return [_row(element, self.plane) for element in self.elements]

    def sample(self, chord_error: float = 0.01) -> list[Point]:
        """Points along the path, mm, from its start to its end: the ends of lines, and on arcs so many more that no
        chord between two of them is farther from its arc than `chord_error` (mm). Raises ValueError unless that is
        positive."""
        if not chord_error > 0:
            raise ValueError(f"a chord error is more than 0 mm, not {chord_error}")
        found = [self.start]
        for element in self.elements:
            found += _along(element, chord_error) if isinstance(element, ArcSegment) else ()
            found.append(element.end)
        return found

    def plot(self, ax: Any = None, *, chord_error: float = 0.01, **style: Any) -> Any:
        """Draw the path on `ax`, axes of matplotlib, or on the current ones, and return them.

        The path is one line through the points of `sample`; `style` goes to `Axes.plot`, such as `label="A170"`. Places
        on the axes are mm with X of a lathe as radius, like everything here; the numbers along X are diameters, as the
        machine has them. The aspect becomes equal. Raises MissingExtraError without the package of
        `contoursolve[plot]`, ValueError for a chord error that is not positive.
        """
        return from_above("plot_record", self, ax, chord_error=chord_error, **style)

    def is_alike(self, other: "Contour") -> bool:
        """Whether the elements of two paths are of the same kinds and turn the same way, one by one."""
        return [_kind(each) for each in self.elements] == [_kind(each) for each in other.elements]

    def deviation(self, other: "Contour") -> float:
        """The largest distance (mm) of the end and the named points of two paths, and of the ends, centres and radii of
        their elements, where these are alike."""
        pairs = [
            (self.end, other.end),
            *((self.points[name], other.points[name]) for name in self.points.keys() & other.points.keys()),
        ]
        off = 0.0
        if self.is_alike(other):
            for one, two in zip(self.elements, other.elements, strict=True):
                pairs += [(one.start, two.start), (one.end, two.end)]
                if isinstance(one, ArcSegment) and isinstance(two, ArcSegment):
                    pairs.append((one.center, two.center))
                    off = max(off, abs(one.radius - two.radius))
        return max(off, *(hypot(a[0] - b[0], a[1] - b[1]) for a, b in pairs))

    @property
    def crossing(self) -> Crossing | None:
        """The place where the path goes across the spindle axis, by more than the least increment; None where it does
        not, or the machine is no lathe. A path may begin on either side."""
        axis = next((number for number, is_diameter in enumerate(self.plane.diameters) if is_diameter), None)
        if axis is None or self.free[axis] or self._keeps_one_side(axis):
            return None
        side, across = 0.0, None
        for element in self.elements:
            for at in extremes(element, axis):
                if abs(at[axis]) > AGREEMENT:
                    side = side or at[axis]
                    if at[axis] * side < 0 and (across is None or abs(at[axis]) > abs(across.at[axis])):
                        across = Crossing(element, at)
            if across is not None:
                break
        return across

    def _keeps_one_side(self, axis: int) -> bool:
        """Whether the squares around the circles of the arcs, and the ends of lines, lie on one side of the spindle
        axis: then it is not crossed, and where an arc turns back need not be known."""
        low = high = self.start[axis]
        for element in self.elements:
            if isinstance(element, ArcSegment):
                low = min(low, element.center[axis] - element.radius)
                high = max(high, element.center[axis] + element.radius)
            low, high = min(low, element.end[axis]), max(high, element.end[axis])
        return low >= 0 or high <= 0


def _along(arc: ArcSegment, chord_error: float) -> Iterator[Point]:
    """The points of an arc between its ends."""
    # The sagitta of a chord over the angle 2 a is r (1 - cos a); of half a turn it is the radius.
    half = acos(max(1 - chord_error / arc.radius, 0.0)) if arc.radius > 0 else pi
    count = max(ceil(radians(arc.sweep) / (2 * half)), 1)
    begin = atan2(arc.start[1] - arc.center[1], arc.start[0] - arc.center[0])
    for number in range(1, count):
        angle = begin + arc.turn.sign * radians(arc.sweep) * number / count
        yield arc.center[0] + arc.radius * cos(angle), arc.center[1] + arc.radius * sin(angle)


def _kind(segment: Segment) -> Turn | None:
    """The sense in which an arc turns; None for a line."""
    return segment.turn if isinstance(segment, ArcSegment) else None


def extremes(segment: Segment, *axes: int) -> list[Point]:
    """The ends of an element, and where an arc turns back along axes (0 and 1), in the order of travel."""
    if isinstance(segment, LineSegment):
        return [segment.start, segment.end]
    begin = atan2(segment.start[1] - segment.center[1], segment.start[0] - segment.center[0])
    quarters = (radians(90 * axis) + half for axis in axes for half in (0.0, pi))
    ways = {((angle - begin) * segment.turn.sign) % tau: angle for angle in quarters}
    turning = [
        (segment.center[0] + segment.radius * cos(ways[way]), segment.center[1] + segment.radius * sin(ways[way]))
        for way in sorted(ways)
        if way < radians(segment.sweep)
    ]
    return [segment.start, *turning, segment.end]


_TURN = 1e-12
"""rad. By so much an angle may lie before the start of an arc and count as there: the rounding of arctangents."""


def way_to(segment: Segment, at: Point) -> float:
    """The way along the line or the circle of an element to a place of it, mm; around a circle from its start on."""
    if isinstance(segment, LineSegment):
        (a, b), (c, d), length = segment.start, segment.end, segment.length
        # What has no length is only where it is.
        return ((c - a) * (at[0] - a) + (d - b) * (at[1] - b)) / length if length else dist(segment.start, at)
    begin, angle = (atan2(here[1] - segment.center[1], here[0] - segment.center[0]) for here in (segment.start, at))
    return (((angle - begin) * segment.turn.sign + _TURN) % tau - _TURN) * segment.radius


def is_on(segment: Segment, at: Point, slack: float = 0.0) -> bool:
    """Whether a place of the line or the circle of an element lies on the element, or not more than some mm beyond its
    ends."""
    way = way_to(segment, at)
    if isinstance(segment, LineSegment):
        # Every place has the same way along a point.
        return -slack <= way <= segment.length + slack and (segment.length > 0 or dist(segment.start, at) <= slack)
    slack += _TURN * segment.radius
    return way <= segment.length + slack or tau * segment.radius - way <= slack


def _row(element: Segment, plane: Plane) -> dict[str, str | float | None]:
    def place(name: str, at: Point | None) -> dict[str, float | None]:
        return {
            f"{name}_{axis}{'_radius' if is_diameter else ''}_mm": at[number] if at else None
            for number, (axis, is_diameter) in enumerate(zip(plane.axes, plane.diameters, strict=True))
        }

    arc = element if isinstance(element, ArcSegment) else None
    return {
        "name": element.name,
        "kind": "arc" if arc else "line",
        **place("start", element.start),
        **place("end", element.end),
        **place("center", arc.center if arc else None),
        "radius_mm": arc.radius if arc else None,
        "turn": arc.turn.value if arc else None,
        "angle_deg": element.angle if isinstance(element, LineSegment) else None,
        "sweep_deg": arc.sweep if arc else None,
        "length_mm": element.length,
    }


def trace(profile: Profile, solution: SystemSolution) -> Contour:
    """The path of a solved profile. Elements of no length are left out.

    Raises ValueError if the solution has no values.
    """
    points, corners = solution.points, {corner.at: corner for corner in profile.figure.corners}
    if not points:
        raise ValueError(f"there is no path: {solution.status.value}")
    start = here = points[profile.figure.start]
    elements: list[Segment] = []

    def add(segment: Segment, *, is_full: bool = False) -> Point:
        if hypot(segment.end[0] - here[0], segment.end[1] - here[1]) <= LENGTH and not is_full:
            return here
        elements.append(segment)
        return segment.end

    for element in profile.figure.path:
        corner = corners.get(element.head)
        built = solution.corners[corner.name] if corner else None
        end = built.begin if built else points[element.head]
        if isinstance(element, Line):
            here = add(LineSegment(element.name, here, end))
        else:
            center, radius = points[element.center], solution.radii[element.radius]
            is_full = element.may_be_full and all(
                dist(at, points[element.tail]) <= LENGTH for at in (here, end, points[element.head])
            )
            here = add(ArcSegment(element.name, here, end, center, radius, element.turn), is_full=is_full)
        if corner and built:
            if built.center is None:
                here = add(LineSegment(corner.name, here, built.end))
            else:
                turn = Turn.CCW if built.turn > 0 else Turn.CW
                here = add(ArcSegment(corner.name, here, built.end, built.center, built.radius, turn))
    shown = {name: points[name] for name in profile.figure.points if name in profile.intersections}
    return Contour(start, here, shown, tuple(elements), profile.plane, points, profile.start.free)


def dropped_corners(profile: Profile, solution: SystemSolution) -> Iterator[tuple[Corner, float]]:
    """The corners that the control leaves out, each with the angle by which the path turns there, degrees."""
    for corner in profile.figure.corners:
        built = solution.corners.get(corner.name)
        if built is not None and built.begin == built.end:
            yield corner, degrees(asin(built.turn))


def against_angles(profile: Profile, contour: Contour) -> Iterator[tuple[str, LineSegment]]:
    """The givens of angles that are no direction of travel, each with the line that runs against it."""
    path = {(each.tail, each.head): each for each in profile.figure.path if isinstance(each, Line)}
    segments = {each.name: each for each in contour.elements if isinstance(each, LineSegment)}
    for fact in profile.facts:
        line = path.get(fact.heading) if fact.heading else None
        segment = segments.get(line.name) if line is not None and line.heading is None else None
        if segment is not None and cos(radians(segment.angle - float(profile.givens[fact.given].value))) < 0:
            yield fact.given, segment


def center_by_radius(start: Point, end: Point, radius: float, turn: Turn, slack: float) -> Point | None:
    """The centre of an arc by its radius, negative for more than half a turn, which may be too small by so much (mm);
    None if there is none."""
    chord = end[0] - start[0], end[1] - start[1]
    half = hypot(*chord) / 2
    if half <= LENGTH or half > abs(radius) + slack:
        return None
    height = sqrt(max(radius**2 - half**2, 0.0)) * turn.sign * (1 if radius > 0 else -1) / (2 * half)
    return (start[0] + end[0]) / 2 - chord[1] * height, (start[1] + end[1]) / 2 + chord[0] * height


def shifted(segment: Segment, by: Point) -> Segment:
    """A segment moved by a vector."""
    places = {name: getattr(segment, name) for name in ("start", "end", "center") if hasattr(segment, name)}
    return replace(segment, **{name: (at[0] + by[0], at[1] + by[1]) for name, at in places.items()})
