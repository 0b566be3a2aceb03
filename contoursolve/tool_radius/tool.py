"""A tool as it is stated: the radius of its nose or of the cutter, and the number of its imaginary tip."""

import re
from collections.abc import Mapping
from decimal import Decimal
from difflib import get_close_matches
from enum import Enum
from typing import Any, Literal

from msgspec import Struct

from contoursolve.diagnostics import ProgramError
from contoursolve.gcode import Block, late_pattern
from contoursolve.solving import Point
from contoursolve.tolerance import LARGEST

SideName = Literal["left", "right"]
OutsideName = Literal["roll", "intersect"]
"""The values of `ToolSide` and `OutsideCorner`, as users write them."""

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
"""The programmed point from the centre of the nose, in radii along Z and X, by the number of the tip
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


class OutsideCorner(Enum):
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
    back: float | None = None
    """Angle (deg) by which a contour may fall behind a tip 1 to 4 before its flank cuts into it, if stated."""
    front: float | None = None
    """The same of a face that leans over before the tip."""

    is_mirrored: bool = False
    """Whether its tip is numbered as on LinuxCNC: mirrored in X."""

    def vector(self) -> Point:
        """From the centre to the programmed point, in radii."""
        first, second = TIPS[self.tip or 0]
        return first, -second if self.is_mirrored else second


_RADIUS = late_pattern(r"R?\s*+(?P<number>[-+]?(?:\d++\.?\d*+|\.\d++))", re.IGNORECASE | re.ASCII)
_MORE = late_pattern(r"(?P<name>tip|back|front)\s*+(?P<number>-?\d{1,9}(?:\.\d{0,9})?)", re.IGNORECASE | re.ASCII)
_STATED = late_pattern(r"[(;\[]\s*+contoursolve\s++tool\s*+:(?P<stated>[^()\[\]\r\n]*+)", re.IGNORECASE)
"""A comment that states the tool of what follows."""


_ALIKE = late_pattern(r"[(;\[]\s*+contoursolve\s++(?P<word>[a-z]{1,20}+)\b\s*+(?P<colon>:?)", re.IGNORECASE)
"""A comment that may be meant to."""
_MEANT = late_pattern(r"R?\s*+(\d{1,6}+)(?:[.,](\d{1,6}+))?(?:\D*+(\d))?\D*+", re.IGNORECASE | re.ASCII)
"""A radius and perhaps a tip, however they are written."""


def read_tool(text: str, tip: int | None = None) -> Tool:
    """A tool from `R0.8` or `0.8`, behind commas with `tip 3` where it has one, and its flanks, such as `back 32`.
    Raises ToolError.

    >>> read_tool("R0.8, tip 3").tip
    3
    """
    radius, *others = (part.strip() for part in text.split(","))
    found, rows = _RADIUS.fullmatch(radius), [_MORE.fullmatch(other) for other in others]
    if found is None or any(row is None or (row["name"].lower() == "tip" and "." in row["number"]) for row in rows):
        raise ToolError(f"{text.strip()!r} is no tool; write {_meant(text.strip())}")
    stated = [(row["name"].lower(), float(row["number"])) for row in rows if row is not None]
    stated += [("tip", float(tip))] if tip is not None else []
    more: dict[str, Any] = {}
    for name, number in stated:
        if more.setdefault(name, number) != number:
            raise ToolError(f"the tool has {name} {more[name]:g} and {name} {number:g}; leave one out")
    tip = int(more.pop("tip")) if "tip" in more else None
    return make_tool(Decimal(found["number"]), tip, **more)


def _meant(text: str) -> str:
    """The tool for which a text is meant."""
    found = _MEANT.fullmatch(text)
    if found is None:
        return "its radius and, on a lathe, its tip, such as R0.8, tip 3"
    whole, part, tip = found.groups()
    return f"R{whole}{(part and '.' + part) or ''}{(tip and ', tip ' + tip) or ''}"


def make_tool(
    radius: Decimal, tip: int | None, *, is_metric: bool = False, back: float | None = None, front: float | None = None
) -> Tool:
    """A tool that there can be. Raises ToolError."""
    for name, angle in (("back", back), ("front", front)):
        if angle is not None and not 0 <= angle < 180:  # noqa: PLR2004 - half a turn
            raise ToolError(f"the {name} angle of the tool is {angle:g} deg; it must be 0 to less than 180 deg")
    if not radius.is_finite() or not 0 <= radius <= Decimal(LARGEST):
        told = "be less than 0" if radius.is_signed() else f"be more than {LARGEST:,.0f}"
        raise ToolError(f"the radius of the tool is R{radius}; it must not {told}")
    if tip is not None and tip not in TIPS:
        raise ToolError(f"there is no tip {tip}; the tips have the numbers 0 to 9")
    return Tool(radius, tip, is_metric, back, front)


def radius_in(line: str) -> tuple[int, int] | None:
    """The place of the radius in a comment that states a tool: its first column and the one behind, from 1.

    >>> radius_in("N5 (contoursolve tool: R0.8, tip 3)")
    (25, 28)
    """
    comment = _STATED.search(line)
    found = _RADIUS.search(comment["stated"]) if comment is not None else None
    if comment is None or found is None:
        return None
    first, last = (comment.start("stated") + 1 + each for each in found.span("number"))
    return first, last


def tool_in(line: str) -> Tool | None:
    """The tool that a comment in a line states, `(contoursolve tool: R0.8, tip 3)`. Raises ToolError."""
    comment = _STATED.search(line)
    alike = _ALIKE.search(line) if comment is None else None
    word = alike["word"].lower() if alike is not None else ""
    # In prose, no colon stands behind the word.
    is_near = alike is not None and alike["colon"] and get_close_matches(word, ("tool", "control"))[:1] == ["tool"]
    if is_near or word in ("tool", "tools"):
        raise ToolError(f"{line.strip()!r} states no tool; write (contoursolve tool: R0.8, tip 3)")
    return None if comment is None else read_tool(comment["stated"])


def tool_of(block: Block) -> Tool | None:
    """The same of a block. Raises ToolError, naming its line."""
    try:
        return tool_in(block.text)
    except ToolError as error:
        raise ToolError(f"program line {block.line}: {error}") from None
