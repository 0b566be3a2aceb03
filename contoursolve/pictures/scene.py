"""Content of a picture, in mm in the plane's axes: the path, its surroundings, every word, and the part that is shown.

Nothing here knows where a label finds room.
"""

from collections.abc import Iterable, Mapping
from enum import Enum
from typing import TypeVar

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.geometry import FIRST, SECOND, Length, Plane
from contoursolve.numeric import trimmed
from contoursolve.pictures.page import ANYTHING, About, Spot, TextRun, visible
from contoursolve.pictures.theme import Role
from contoursolve.solving import ALONG_AXIS, Point, Segment, along, extremes


class Weight(Enum):
    """Importance of a path in a picture."""

    MAIN = "main"
    """Drawn thick, with its direction."""
    BESIDE = "beside"
    """One of many."""
    GHOST = "ghost"
    """An alternative; drawn if it does not make the others small."""
    MIRRORED = "mirrored"
    """The other half of a turned part."""
    PASSING = "passing"
    """Drawn as far as the picture goes; lines only."""


class Trail(Struct, frozen=True):
    """A path, or a part of it."""

    segments: tuple[Segment, ...]
    role: Role
    weight: Weight = Weight.MAIN
    line: int = 0
    """The line on which the contour begins to which it belongs, among several; 0 for what is alone."""


class Thin(Struct, frozen=True):
    """A straight construction line; an endless one is drawn as far as the picture goes."""

    start: Point
    end: Point
    role: Role
    is_endless: bool = False
    is_dashed: bool = True


class Ring(Struct, frozen=True):
    """A whole circle as construction."""

    center: Point
    radius: float
    role: Role


class MarkKind(Enum):
    """Kind of mark at a point."""

    START = "start"
    END = "end"
    VIRTUAL = "virtual"
    PLACE = "place"
    CENTER = "center"
    TIP = "tip"
    """The place where a tool is programmed, off the path."""
    ROUND = "round"
    SQUARE = "square"
    """A place on what one of two solutions has alone."""
    OTHER = "other"
    """A place that one word gives to a point, other than the one that the others give."""


class Mark(Struct, frozen=True):
    """A point with a name and, in other roles, what is said about it."""

    at: Point
    kind: MarkKind
    label: tuple[TextRun, ...] = ()
    short: tuple[TextRun, ...] = ()
    """A shorter text for a label without room."""
    role: Role = Role.INK
    about: About = ANYTHING


class LinearDimension(Struct, frozen=True):
    """A distance along an axis between two points."""

    start: Point
    end: Point
    axis: int
    text: str
    role: Role
    about: About = ANYTHING

    @property
    def length(self) -> float:
        """mm; a distance of 0 has no two ends."""
        return abs(self.end[self.axis] - self.start[self.axis])


class Aligned(Struct, frozen=True):
    """A distance straight from one point to another; on the line between them, or beside it."""

    start: Point
    end: Point
    text: str
    role: Role
    is_beside: bool = False
    about: About = ANYTHING


class Ordinate(Struct, frozen=True):
    """The coordinate of a point on an axis: the line on which the point lies. `side` says at which edge it is written,
    -1 at the lower or left one, 1 at the other; 0 where there is room."""

    at: Point
    axis: int
    text: str
    role: Role
    about: About = ANYTHING
    side: int = 0


class Angle(Struct, frozen=True):
    """A direction at a point, as written, in degrees from the direction `base`, which is that of the first axis."""

    at: Point
    degrees: float
    text: str
    role: Role
    about: About = ANYTHING
    base: float = 0.0


class Leader(Struct, frozen=True):
    """A word that points at a place, from the side to which `away` leads.

    That of a radius has a `center`, and its line lies on a ray through it (ISO 129); `others` are further places of the
    arc at which it may point.
    """

    at: Point
    away: Point
    text: str
    role: Role
    about: About = ANYTHING
    center: Point | None = None
    others: tuple[Point, ...] = ()


class Slide(Struct, frozen=True):
    """A free movement: both ways along a direction, or anywhere without one."""

    at: Point
    direction: Point | None


class Closeup(Struct, frozen=True):
    """A part of the path that is shown enlarged, too, where it would be smaller than `least` pixels."""

    name: str
    segments: tuple[Segment, ...]
    least: float


Dimension = LinearDimension | Aligned | Ordinate | Angle | Leader
Part = Trail | Thin | Ring | Mark | Slide | Dimension
"""Parts of a drawing."""


class ToolDrawing(Struct, frozen=True):
    """The drawing of a tool beside contours, in their plane; `cut` is what of the part is in no contour."""

    plane: Plane
    unit: Length
    title: str
    parts: tuple[Part, ...]
    cut: tuple[Segment, ...] = ()
    remarks: tuple[tuple[TextRun, ...], ...] = ()
    meanings: Mapping[Role, str] = field(default_factory=dict)
    closeups: tuple[Closeup, ...] = ()


_Kind = TypeVar("_Kind", bound=Part)


class Scene(Struct, frozen=True):
    """One drawing. `lines` are the program's lines in their roles, `remarks` what is said below the drawing."""

    title: str
    axes: tuple[str, str]
    """The names of the axes to the right and up."""
    parts: tuple[Part, ...] = ()
    """Of one kind, each is drawn over those before it."""
    lines: tuple[tuple[TextRun, ...], ...] = ()
    remarks: tuple[tuple[TextRun, ...], ...] = ()
    meanings: Mapping[Role, str] = field(default_factory=dict)
    """Legend texts of roles that differ from those for the words of a contour."""
    has_turning_axis: bool = False
    """Whether the second axis begins at the axis about which the work turns."""
    is_one_contour: bool = False
    """Whether names of elements mean one thing only."""
    closeups: tuple[Closeup, ...] = ()
    most_labels: int = 40
    """Labels on one page. Of a larger drawing, the words that are simply given are not drawn: who could read them?"""
    is_part: bool = False
    """Whether it is the drawing of a whole part: it has the part's dimensions and no directions of travel. A text
    stands on no line of the path and on no arrow, and what a detail tells is told there alone."""
    scale_unit: Length | None = None
    """The unit of the bar that shows how large the drawing is; no bar without one."""

    def each(self, kind: type[_Kind]) -> list[_Kind]:
        """The parts of one kind."""
        return [part for part in self.parts if isinstance(part, kind)]

    def with_beside(self, beside: "Iterable[ToolDrawing]") -> "Scene":
        """The scene with what is drawn beside it."""
        scene = self
        for each in beside:
            lists = {name: (*getattr(scene, name), *getattr(each, name)) for name in ("parts", "remarks", "closeups")}
            scene = replace(scene, meanings={**scene.meanings, **each.meanings}, **lists)
        return scene

    @property
    def dimensions(self) -> list[Dimension]:
        """The parts that are dimensions."""
        return [part for part in self.parts if isinstance(part, Dimension)]


# From mm to pixels ------------------------------------------------------------------------------------------

MOST_TIMES = 3.0
"""Largest factor by which surroundings may enlarge a picture beyond its subject."""

MOST_TIMES_WRONG = 12.0
"""The same for the sake of what is wrong, which is what such a picture is about."""

_ROUNDING = 1.001


class Viewport(Struct, frozen=True):
    """The rectangle of the plane that is shown (mm), pixels in a mm, and where its middle is on the page."""

    middle: Point
    scale: float
    spot: Spot

    def place(self, at: Point) -> Spot:
        """The spot of a point on the page."""
        return (
            self.spot[0] + (at[0] - self.middle[0]) * self.scale,
            self.spot[1] - (at[1] - self.middle[1]) * self.scale,
        )


class Rectangle(Struct, frozen=True):
    """An upright rectangle in mm."""

    low: Point
    high: Point

    @property
    def size(self) -> Point:
        """Width and height."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]

    @property
    def middle(self) -> Point:
        """Its middle."""
        return (self.low[0] + self.high[0]) / 2, (self.low[1] + self.high[1]) / 2


def bounds_of(scene: Scene) -> Rectangle:
    """The rectangle that a picture must show: the path and its points, and as much else as does not make the path
    small."""
    must: list[Point] = []
    more: list[Point] = []
    wrong: list[Point] = []
    for part in scene.parts:
        if isinstance(part, Trail) and part.weight is Weight.PASSING:
            continue
        if isinstance(part, Trail):
            points = [at for segment in part.segments for at in extremes(segment, 0, 1)]
            (more if part.weight is Weight.GHOST else must).extend(points)
        elif isinstance(part, Mark):
            (more if part.kind in (MarkKind.CENTER, MarkKind.OTHER) else must).append(part.at)
        elif isinstance(part, Ring):
            ends = (along(part.center, way, sign * part.radius) for way in ALONG_AXIS for sign in (1, -1))
            {Role.CONFLICTING: wrong, Role.OPEN: must}.get(part.role, more).extend(ends)
        elif isinstance(part, Thin | LinearDimension | Aligned):
            more += [part.start] if isinstance(part, Thin) and part.is_endless else [part.start, part.end]
            if isinstance(part, Aligned) and part.role is Role.CONFLICTING:
                wrong += [part.start, part.end]
        elif not isinstance(part, Slide):
            more.append(part.at)
    everything = [*must, *more, *wrong] or [(0.0, 0.0)]
    own = _around(must or more or everything)
    reach = max(*(own if max(own.size) > 0 else _around(everything)).size, 1e-9)
    near = [*_near(more, own, reach, MOST_TIMES), *_near(wrong, own, reach, MOST_TIMES_WRONG)]
    return _around([*must, *near] or [(0.0, 0.0)])


def _near(points: Iterable[Point], own: Rectangle, reach: float, times: float) -> list[Point]:
    """The points in a rectangle that is so many times as large."""
    room = reach * (times - 1) / 2 * _ROUNDING
    return [at for at in points if all(own.low[n] - room <= at[n] <= own.high[n] + room for n in (0, 1))]


def _around(points: Iterable[Point]) -> Rectangle:
    across, up = zip(*points, strict=True)
    return Rectangle((min(across), min(up)), (max(across), max(up)))


# Words and numbers as a picture shows them ------------------------------------------------------------------

LONGEST = 28
"""Characters of a word on a drawing."""

_DECIMALS = {Length.MM: 3, Length.INCH: 4}


def number(mm: float, unit: Length) -> str:
    """A length in the unit of a program, to the least increment; without zeros at its end, or a negative zero.

    >>> number(-47.32051, Length.MM), number(30.0, Length.MM), number(-0.0001, Length.MM)
    ('-47.321', '30', '0')
    """
    return trimmed(mm / float(unit.in_mm), _DECIMALS[unit])


def coordinates(at: Point, plane: Plane, unit: Length) -> str:
    """Both coordinates as words, a diameter as one."""
    return " ".join(
        plane.axes[axis] + number(at[axis] * (2 if plane.diameters[axis] else 1), unit) for axis in (FIRST, SECOND)
    )


def word_text(text: str) -> str:
    """A word as it is shown: without blanks around, not too long, and with nothing that cannot be seen."""
    shown = visible(" ".join(text.split()))
    return shown if len(shown) <= LONGEST else shown[: LONGEST - 1] + "…"


def axis_names(plane: Plane, unit: Length = Length.MM) -> tuple[str, str]:
    """The axes as a drawing names them; a drawing that says no unit is in mm."""
    more = ["inch"] if unit is Length.INCH else []
    notes = [[*(["diameter"] if is_diameter else []), *more] for is_diameter in plane.diameters]
    first, second = (f"{axis} ({', '.join(n)})" if n else axis for axis, n in zip(plane.axes, notes, strict=True))
    return first, second
