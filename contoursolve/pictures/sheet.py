"""What is on a page, in pixels with Y down: strokes, shapes and texts, and nothing that a painter must decide."""

from dataclasses import dataclass, field, replace
from enum import Enum
from math import pi
from typing import NamedTuple

from contoursolve.pictures.metrics import ASCENT, DESCENT, width_of
from contoursolve.pictures.theme import Role

Spot = tuple[float, float]
"""A place on the page, pixels from its top left corner."""


@dataclass(frozen=True, slots=True)
class Sweep:
    """An arc of a circle from where a stroke is; `angle` is travelled (radians, positive clockwise on the page)."""

    center: Spot
    radius: float
    end: Spot
    angle: float


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line that is drawn: from `start` through places and arcs."""

    start: Spot
    steps: tuple[Spot | Sweep, ...]
    role: Role
    width: float
    dash: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Shape:
    """A filled polygon."""

    corners: tuple[Spot, ...]
    role: Role


@dataclass(frozen=True, slots=True)
class Dot:
    """A disc, filled with its role or with paper."""

    at: Spot
    radius: float
    role: Role
    is_filled: bool = True


class Anchor(Enum):
    """Which place of a text its position is; the values are those of SVG."""

    START = "start"
    MIDDLE = "middle"
    END = "end"


@dataclass(frozen=True, slots=True)
class Run:
    """A stretch of a text in one role."""

    text: str
    role: Role


class Box(NamedTuple):
    """An upright rectangle; thousands are tried for each label."""

    left: float
    top: float
    right: float
    bottom: float

    def meets(self, other: "Box") -> bool:
        """Whether two boxes have more than an edge in common."""
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )

    def holds(self, other: "Box") -> bool:
        """Whether another box lies in this one."""
        return (
            self.left <= other.left
            and self.top <= other.top
            and self.right >= other.right
            and self.bottom >= other.bottom
        )

    def grow(self, by: float) -> "Box":
        """The box with a margin, pixels."""
        return Box(self.left - by, self.top - by, self.right + by, self.bottom + by)


@dataclass(frozen=True, slots=True)
class Text:
    """A text in one line; `at` is on its base line. A text that is turned reads from the right."""

    at: Spot
    runs: tuple[Run, ...]
    size: float
    anchor: Anchor = Anchor.START
    is_bold: bool = False
    is_mono: bool = False
    is_turned: bool = False

    @property
    def words(self) -> str:
        """The text without its roles."""
        return "".join(run.text for run in self.runs)

    @property
    def box(self) -> Box:
        """What it covers."""
        wide = width_of(self.words, self.size, is_bold=self.is_bold, is_mono=self.is_mono)
        before = {Anchor.START: 0.0, Anchor.MIDDLE: wide / 2, Anchor.END: wide}[self.anchor]
        up, down = ASCENT * self.size, DESCENT * self.size
        x, y = self.at
        if self.is_turned:
            return Box(x - up, y - (wide - before), x + down, y + before)
        return Box(x - before, y - up, x + wide - before, y + down)


Item = Stroke | Shape | Dot | Text


@dataclass(frozen=True, slots=True)
class Sheet:
    """A page: the drawing, which ends at its frame, and what stands around it, each as it is painted."""

    width: float
    height: float
    frame: Box
    drawing: tuple[Item, ...] = field(repr=False)
    around: tuple[Item, ...] = field(default=(), repr=False)

    @property
    def texts(self) -> tuple[Text, ...]:
        """All texts."""
        return tuple(item for item in (*self.drawing, *self.around) if isinstance(item, Text))


FULL_TURN = 2 * pi


def shift(item: Item, by: float) -> Item:
    """An item farther down the page."""
    if isinstance(item, Shape):
        return replace(item, corners=tuple(_down(corner, by) for corner in item.corners))
    if isinstance(item, Stroke):
        steps = (
            replace(step, center=_down(step.center, by), end=_down(step.end, by))
            if isinstance(step, Sweep)
            else _down(step, by)
            for step in item.steps
        )
        return replace(item, start=_down(item.start, by), steps=tuple(steps))
    return replace(item, at=_down(item.at, by))


def _down(spot: Spot, by: float) -> Spot:
    return spot[0], spot[1] + by
