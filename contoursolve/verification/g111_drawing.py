"""YASNAC LX3 G111 as a drawing: its two lines, and its corners in closed form (2.8.30).

Points count from the start point: real is Z, imaginary is X as radius.
"""

from dataclasses import dataclass
from math import atan2, tan

from contoursolve.model import Turn
from contoursolve.tolerance import REGULAR
from contoursolve.verification.case import Move
from contoursolve.verification.drawing import Bevel, Drawing, Round, Shape, Straight, UnmeasurableError
from contoursolve.verification.measure import cross, dot, sign

BEVELS = ("C", "D")

CORNERS = (("corner 1", "C", "P"), ("corner 2", "D", "Q"))
"""Each corner with the words for a bevel and for a rounding."""

Slots = dict[str, Move]
"""The claimed elements by their names: line 1, corner 1, line 2, corner 2."""

Sizes = dict[str, float]
"""The size of each corner that is made by its word, mm."""


@dataclass(frozen=True, slots=True)
class Meeting:
    """The line that corner 2 meets by a fact: its unit direction, and how far it goes from V2, mm; None: no end."""

    along: complex
    length: float | None
    label: str


@dataclass(frozen=True, slots=True)
class Lines:
    """The two virtual intersections, and the unit directions of both lines; an angle in use gives them exactly.

    `landing` is the unit vector of the axis that corner 2 lands along, in either sense; None if the words give
    no such line. `meeting` is the line that a fact states instead. `zero` is the size up to which a component of
    `first` counts as zero.
    """

    v1: complex
    v2: complex
    first: complex
    second: complex
    landing: complex | None
    zero: float
    meeting: Meeting | None = None
    is_setback: bool = False
    """Whether a bevel is set back equally along both lines, by the setting, and not at 45 degrees."""
    share: float = 1.0
    """How far a bevel at 45 degrees of size 1 extends along each axis, by the setting."""

    @property
    def onward(self) -> complex:
        """The signs with which a path goes on after V2: Tables 2.35 and 2.36, a component that line 2 lacks is
        taken from line 1. To a line that a fact states: those midway between line 2 and that line; a component in
        which the two cancel is taken from line 2."""
        if self.meeting is not None:
            middle = self.second + self.meeting.along
            return complex(
                sign(middle.real, REGULAR) or sign(self.second.real),
                sign(middle.imag, REGULAR) or sign(self.second.imag),
            )
        return complex(
            sign(self.second.real) or sign(self.first.real, self.zero),
            sign(self.second.imag) or sign(self.first.imag, self.zero),
        )

    @property
    def leaving(self) -> complex | None:
        """The direction in which corner 2 is left; None if there is no line to land on."""
        if self.meeting is not None:
            return self.meeting.along
        if self.landing is None:
            return None
        return complex(self.onward.real, 0) if self.landing == 1 else complex(0, self.onward.imag)

    @property
    def slack(self) -> float:
        """By how much an angle in use is off its line, mm: next to nothing, unless words only just agree."""
        return abs(cross(self.first, self.v1)) + abs(cross(self.second, self.v2 - self.v1))


def draw(lines: Lines, sizes: Sizes) -> Drawing:
    """The drawing with these lines and sizes: corners in closed form.

    Raises UnmeasurableError for a corner that does not exist.
    """
    ends, shapes = {"corner 1": (lines.v1, lines.v1), "corner 2": (lines.v2, lines.v2)}, {}
    for name, *words in CORNERS:
        for word in sizes.keys() & set(words):
            at, before = (lines.v1, lines.first) if name == "corner 1" else (lines.v2, lines.second)
            after, quadrant = (lines.second, _signs(lines.v2)) if name == "corner 1" else (lines.leaving, lines.onward)
            turn = cross(before, after) if after is not None else 0.0
            if after is None or not turn:
                raise UnmeasurableError(f"{name} joins no two lines")
            shape = _draw_corner(at, before, after, sizes[word], lines.share * quadrant if word in BEVELS else None)
            if word in BEVELS and lines.is_setback:
                shape = Bevel(at - sizes[word] * before, at + sizes[word] * after, sizes[word])
            ends[name], shapes[name] = (shape.begin, shape.end), shape
    straight = {
        "line 1": Straight(0j, lines.v1, 0j, ends["corner 1"][0], lines.first),
        "line 2": Straight(lines.v1, lines.v2, ends["corner 1"][1], ends["corner 2"][0], lines.second),
    }
    return Drawing({"S": 0j, "V1": lines.v1, "V2": lines.v2}, {**straight, **shapes}, ("line 1", "line 2"))


def _signs(way: complex) -> complex:
    return complex(sign(way.real), sign(way.imag))


def _draw_corner(at: complex, before: complex, after: complex, size: float, quadrant: complex | None) -> Round | Bevel:
    """A rounding, or a bevel whose extents have the signs of `quadrant`, which a bevel of size 1 extends."""
    turn = cross(before, after)
    if quadrant is not None:
        extent = size * quadrant
        return Bevel(at - cross(extent, after) / turn * before, at + cross(before, extent) / turn * after, size)
    back = size * tan(abs(atan2(turn, dot(before, after))) / 2)
    left = 1 if turn > 0 else -1
    begin = at - back * before
    return Round(begin, at + back * after, begin + left * size * 1j * before, size, Turn.CCW if turn > 0 else Turn.CW)


def drawn(lines: Lines, slots: Slots, sizes: Sizes) -> Drawing:
    """The drawing as it is claimed."""
    first = slots["line 1"].end if "line 1" in slots else 0j
    joined = slots["corner 1"].end if "corner 1" in slots else first
    second = slots["line 2"].end if "line 2" in slots else joined
    shapes: dict[str, Shape] = {
        "line 1": Straight(0j, lines.v1, 0j, first, lines.first),
        "line 2": Straight(lines.v1, lines.v2, joined, second, lines.second),
    }
    for name, *words in CORNERS:
        if name in slots:
            move = slots[name]
            size = next(sizes[word] for word in sizes if word in words)
            circle = move.circle
            shapes[name] = (
                Round(move.start, move.end, circle.center, circle.radius, circle.turn)
                if circle
                else Bevel(move.start, move.end, size)
            )
    return Drawing({"S": 0j, "V1": lines.v1, "V2": lines.v2}, shapes, ("line 1", "line 2"))
