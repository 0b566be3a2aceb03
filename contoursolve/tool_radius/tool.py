"""A tool as it is stated: the radius of its nose or of the cutter, and the number of its imaginary tip."""

import re
from collections.abc import Mapping
from decimal import Decimal
from enum import Enum

from msgspec import Struct

from contoursolve.diagnostics import ProgramError
from contoursolve.gcode import late_pattern
from contoursolve.solving import Point

TIPS: Mapping[int, Point] = {
    0: (0.0, 0.0),
    1: (1.0, 1.0),
    2: (-1.0, 1.0),
    3: (-1.0, -1.0),
    4: (1.0, -1.0),
    5: (1.0, 0.0),
    6: (0.0, 1.0),
    7: (-1.0, 0.0),
    8: (0.0, -1.0),
    9: (0.0, 0.0),
}
"""Where the programmed point lies from the centre of the nose, in radii along Z and X, by the number of the tip
(printed for Haas: "imaginary tool tip and direction"; the same numbers on the other controls are assumed)."""


class ToolError(ProgramError, ValueError):
    """A tool that there cannot be, or that is not stated; the message says what to write."""


class ToolSide(Enum):
    """The side of the contour on which the tool runs, seen in the direction of travel."""

    LEFT = "left"
    RIGHT = "right"

    @property
    def sign(self) -> int:
        """+1 for left, -1 for right."""
        return 1 if self is ToolSide.LEFT else -1

    @property
    def code(self) -> int:
        """The G code that says it."""
        return 41 if self is ToolSide.LEFT else 42


class Outside(Enum):
    """The way of the tool around an outside corner."""

    ROLL = "roll"
    """An arc about the corner, which stays sharp."""
    INTERSECT = "intersect"
    """Straight on to where both offsets meet; over 90 degrees, the radius farther and across."""


class Tool(Struct, frozen=True):
    """A tool: its radius, in units of the program or in mm, and the number of its tip, None where nothing tells it."""

    radius: Decimal
    tip: int | None = None
    is_metric: bool = False
    """Whether the radius is in mm whatever the program's unit."""

    def vector(self) -> Point:
        """From the centre to the programmed point, in radii."""
        return TIPS[self.tip or 0]


_RADIUS = late_pattern(r"R?\s*+(?P<number>[-+]?(?:\d++\.?\d*+|\.\d++))", re.IGNORECASE)
_TIP = late_pattern(r"tip\s*+(?P<number>[-+]?\d++)", re.IGNORECASE)
_STATED = late_pattern(r"[(;]\s*+contoursolve\s++tool\s*+:(?P<stated>[^()\r\n]*+)", re.IGNORECASE)
"""A comment that states the tool of what follows."""


def read_tool(text: str, tip: int | None = None) -> Tool:
    """A tool from `R0.8` or `0.8`, with `tip 3` behind a comma where it has one. Raises ToolError.

    >>> read_tool("R0.8, tip 3").tip
    3
    """
    radius, *others = (part.strip() for part in text.split(","))
    found = _RADIUS.fullmatch(radius)
    if found is None:
        raise ToolError(f"{text.strip()!r} is no tool; write its radius, such as R0.8")
    for other in others:
        stated = _TIP.fullmatch(other)
        if stated is None:
            raise ToolError(f"{other!r} is not known of a tool; write its radius and its tip, such as R0.8, tip 3")
        tip = int(stated["number"]) if tip is None else tip
    return make_tool(Decimal(found["number"]), tip)


def make_tool(radius: Decimal, tip: int | None, *, is_metric: bool = False) -> Tool:
    """A tool that there can be. Raises ToolError."""
    if radius < 0 or not radius.is_finite():
        raise ToolError(f"the radius of the tool is R{radius}; it must not be less than 0")
    if tip is not None and tip not in TIPS:
        raise ToolError(f"there is no tip {tip}; the tips have the numbers 0 to 9")
    return Tool(radius, tip, is_metric)


def tool_in(line: str) -> Tool | None:
    """The tool that a comment in a line states, `(contoursolve tool: R0.8, tip 3)`. Raises ToolError."""
    comment = _STATED.search(line)
    return None if comment is None else read_tool(comment["stated"])
