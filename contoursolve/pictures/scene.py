"""What a picture shows, in mm in the plane's axes: the path, what holds it, and every word where it belongs.

Nothing here knows how large the picture is, or where a label finds room.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from contoursolve.contour import Segment
from contoursolve.pictures.sheet import Run
from contoursolve.pictures.theme import Role
from contoursolve.solving import Point


class Weight(Enum):
    """How much a picture is about a path."""

    MAIN = "main"
    """Drawn thick, with its direction."""
    BESIDE = "beside"
    """One of many."""
    GHOST = "ghost"
    """What might be instead; drawn where it does not make the others small."""


@dataclass(frozen=True, slots=True)
class Trail:
    """A path, or a part of it."""

    segments: tuple[Segment, ...]
    role: Role
    weight: Weight = Weight.MAIN


@dataclass(frozen=True, slots=True)
class Thin:
    """A straight construction line; an endless one is drawn as far as the picture goes."""

    start: Point
    end: Point
    role: Role
    is_endless: bool = False


@dataclass(frozen=True, slots=True)
class Ring:
    """A whole circle as construction."""

    center: Point
    radius: float
    role: Role


class Kind(Enum):
    """How a point is marked."""

    START = "start"
    END = "end"
    VIRTUAL = "virtual"
    PLACE = "place"
    CENTER = "center"
    OTHER = "other"
    """Where a word puts a point that others put elsewhere."""


@dataclass(frozen=True, slots=True)
class Mark:
    """A point with a name and, in other roles, what is said about it."""

    at: Point
    kind: Kind
    label: tuple[Run, ...] = ()
    short: tuple[Run, ...] = ()
    """What may stand there where the label finds no room."""
    role: Role = Role.INK


@dataclass(frozen=True, slots=True)
class Linear:
    """A distance along an axis between two points."""

    start: Point
    end: Point
    axis: int
    text: str
    role: Role


@dataclass(frozen=True, slots=True)
class Aligned:
    """A distance straight from one point to another; on the line between them, or beside it."""

    start: Point
    end: Point
    text: str
    role: Role
    is_beside: bool = False


@dataclass(frozen=True, slots=True)
class Ordinate:
    """The coordinate of a point on an axis: the line on which the point lies."""

    at: Point
    axis: int
    text: str
    role: Role


@dataclass(frozen=True, slots=True)
class Angle:
    """A direction at a point, as written, in degrees from the plane's first axis."""

    at: Point
    degrees: float
    text: str
    role: Role


@dataclass(frozen=True, slots=True)
class Leader:
    """A word that points at a place, from the side to which `away` leads; `is_radius` for one that measures from the
    centre."""

    at: Point
    away: Point
    text: str
    role: Role
    center: Point | None = None


@dataclass(frozen=True, slots=True)
class Slide:
    """What can still move: both ways along a direction, or anywhere without one."""

    at: Point
    direction: Point | None
    text: str


Dimension = Linear | Aligned | Ordinate | Angle | Leader


@dataclass(frozen=True, slots=True)
class Scene:
    """One drawing. `lines` are the program's lines in their roles, `remarks` what is said below the drawing."""

    title: str
    axes: tuple[str, str]
    """The names of the axes to the right and up."""
    trails: tuple[Trail, ...] = ()
    thins: tuple[Thin, ...] = ()
    rings: tuple[Ring, ...] = ()
    marks: tuple[Mark, ...] = ()
    dimensions: tuple[Dimension, ...] = ()
    slides: tuple[Slide, ...] = ()
    lines: tuple[tuple[Run, ...], ...] = ()
    remarks: tuple[tuple[Run, ...], ...] = ()
    meanings: Mapping[Role, str] = field(default_factory=dict)
    """What the legend says of a role, where that is not what it says of a contour's words."""
    has_turning_axis: bool = False
    """Whether the second axis begins at the axis about which the work turns."""
