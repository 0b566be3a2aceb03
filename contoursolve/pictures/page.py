"""A page in pixels with Y down: strokes, shapes and texts, how wide texts are, arrowheads and lines."""

from collections.abc import Iterator
from enum import Enum
from math import cos, sin
from typing import NamedTuple

from msgspec import Struct

from contoursolve.pictures.theme import DASHES, Role
from contoursolve.solving import along

Spot = tuple[float, float]
"""A place on the page, pixels from its top left corner."""

THIN, THICK = 1.0, 2.6
"""Pixels of thin lines, and of the path."""

SIZE, TITLE = 12.0, 14.0
"""Pixels. Font sizes of labels, and of titles."""

WIDTH, PAD = 760.0, 18.0
"""Pixels of a page, and between its edge and its texts."""


class Sweep(Struct, frozen=True):
    """An arc of a circle from where a stroke is; `angle` is travelled (radians, positive clockwise on the page)."""

    center: Spot
    radius: float
    end: Spot
    angle: float

    def spots(self, here: Spot, pieces: int) -> Iterator[Spot]:
        """Places on the arc that starts here, its end the last."""
        first, second = here[0] - self.center[0], here[1] - self.center[1]
        for number in range(1, pieces):
            turned = self.angle * number / pieces
            yield (
                self.center[0] + first * cos(turned) - second * sin(turned),
                self.center[1] + first * sin(turned) + second * cos(turned),
            )
        yield self.end


class About(Struct, frozen=True):
    """Subject of an item, by which a page finds it: a word's key, an element's or points' names, numbers of findings,
    the line on which one of several contours begins. Findings count in the contour, from 1; several names are separated
    by blanks."""

    word: str = ""
    point: str = ""
    element: str = ""
    finding: str = ""
    line: str = ""


ANYTHING = About()
"""Subject of an item that shows nothing with a name."""


class Stroke(Struct, frozen=True):
    """A line that is drawn: from `start` through places and arcs."""

    start: Spot
    steps: tuple[Spot | Sweep, ...]
    role: Role
    width: float
    dash: tuple[float, ...] = ()
    about: About = ANYTHING


class Shape(Struct, frozen=True):
    """A filled polygon."""

    corners: tuple[Spot, ...]
    role: Role
    about: About = ANYTHING


class Dot(Struct, frozen=True):
    """A disc, filled with its role or with paper."""

    at: Spot
    radius: float
    role: Role
    is_filled: bool = True
    about: About = ANYTHING


class Anchor(Enum):
    """Part of a text that lies at its position; the values are those of SVG."""

    START = "start"
    MIDDLE = "middle"
    END = "end"


class TextRun(Struct, frozen=True):
    """A stretch of a text in one role."""

    text: str
    role: Role
    about: About = ANYTHING
    is_underlined: bool = False
    """As words at fault are, so that they are known without colour."""


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

    def filled(self, role: Role) -> Shape:
        """The box as a shape."""
        left, top, right, bottom = self
        return Shape(((left, top), (right, top), (right, bottom), (left, bottom)), role)


class Text(Struct, frozen=True):
    """A text in one line; `at` is on its base line. A text that is turned reads from the right."""

    at: Spot
    runs: tuple[TextRun, ...]
    size: float = SIZE
    anchor: Anchor = Anchor.START
    is_bold: bool = False
    is_mono: bool = False
    is_turned: bool = False
    about: About = ANYTHING

    @property
    def words(self) -> str:
        """The text without its roles."""
        return "".join(run.text for run in self.runs)

    @property
    def box(self) -> Box:
        """The box that the text covers."""
        wide = width_of(self.words, self.size, is_bold=self.is_bold, is_mono=self.is_mono)
        before = {Anchor.START: 0.0, Anchor.MIDDLE: wide / 2, Anchor.END: wide}[self.anchor]
        up, down = ASCENT * self.size, DESCENT * self.size
        x, y = self.at
        if self.is_turned:
            return Box(x - up, y - (wide - before), x + down, y + before)
        return Box(x - before, y - up, x + wide - before, y + down)


Item = Stroke | Shape | Dot | Text


# Lines and arrowheads ----------------------------------------------------------------------------------------


def line(a: Spot, b: Spot, role: Role, width: float = THIN, *, is_dashed: bool = True) -> Stroke:
    """A thin line in the dash of its role."""
    return Stroke(a, (b,), role, width, DASHES.get(role, ()) if is_dashed else ())


def arc(center: Spot, radius: float, sweep: float, role: Role, base: float = 0.0) -> Stroke:
    """An arc from the right of its centre, or from another direction (radians, clockwise on the page)."""
    begin, end = (along(center, (cos(angle), sin(angle)), radius) for angle in (base, base + sweep))
    return Stroke(begin, (Sweep(center, radius, end, sweep),), role, THIN, DASHES.get(role, ()))


def head(tip: Spot, way: Spot, role: Role, length: float = 8.0, half: float = 2.5) -> Shape:
    """An arrowhead whose tip is here, pointing along a unit direction."""
    back, across = along(tip, way, -length), (-way[1], way[0])
    return Shape((tip, along(back, across, half), along(back, across, -half)), role)


# Texts -------------------------------------------------------------------------------------------------------

ASCENT, DESCENT = 0.78, 0.22
"""1 (share of the font size). What a line of capitals, digits and lower case letters takes above and below its base."""

MONO = 0.602
"""1 (share of the font size). Width of every character of DejaVu Sans Mono."""

# fmt: off
_WIDTHS = (
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337, 636, 636, 636, 636, 636, 636, 636,
    636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863,
    748, 787, 603, 787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635,
    615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636,
    337, 636, 838,
)
# fmt: on
"""Advance widths of DejaVu Sans from the blank to the tilde, thousandths of the font size. Most other fonts are
narrower, so that texts fit there."""

_FIRST, _OTHER, _BOLD = 32, 1000, 1.11


def width_of(text: str, size: float, *, is_bold: bool = False, is_mono: bool = False) -> float:
    """The width of a text, pixels; characters outside ASCII count as the widest."""
    if is_mono:
        return sum(MONO if ord(each) < 0x2E80 else 1.0 for each in text) * size  # noqa: PLR2004 - East Asian ones begin here
    total = sum(_width(ord(each) - _FIRST) for each in text)
    return total / 1000 * size * (_BOLD if is_bold else 1.0)


def _width(place: int) -> int:
    return _WIDTHS[place] if 0 <= place < len(_WIDTHS) else _OTHER


def shorten(text: str, width: float, size: float, *, is_bold: bool = False, is_mono: bool = False) -> str:
    """The text, or as much of its beginning as fits the width (pixels), with an ellipsis."""
    if width_of(text, size, is_bold=is_bold, is_mono=is_mono) <= width:
        return text
    kept = text
    while kept and width_of(kept + "…", size, is_bold=is_bold, is_mono=is_mono) > width:
        kept = kept[: max(len(kept) * 9 // 10, len(kept) - 8, 0)] if len(kept) > 80 else kept[:-1]  # noqa: PLR2004
    return kept.rstrip() + "…"


def wrap(text: str, width: float, size: float, most: int | None = None) -> list[str]:
    """The text in lines of this width; of at most so many, the last one is shortened."""
    found: list[str] = []
    rest = text.split()
    while rest and (most is None or len(found) < most - 1):
        count = 1
        while count < len(rest) and width_of(" ".join(rest[: count + 1]), size) <= width:
            count += 1
        found.append(shorten(" ".join(rest[:count]), width, size))
        rest = rest[count:]
    return [*found, shorten(" ".join(rest), width, size)] if rest else found


def heading(title: str, y: float = 26.0) -> Text:
    """The title of a page, as much of it as fits."""
    told = shorten(visible(title), WIDTH - 2 * PAD, TITLE, is_bold=True)
    return Text((PAD, y), (TextRun(told, Role.INK),), TITLE, is_bold=True)


def visible(text: str) -> str:
    """The text with what cannot be seen as dots, tabs as blanks: one character each."""
    return "".join(each if each.isprintable() else (" " if each == "\t" else "·") for each in text)
