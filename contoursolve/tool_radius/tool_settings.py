"""The settings of a control about the radius of a tool, as the path of its centre reads them."""

from collections.abc import Callable, Mapping
from typing import Any

from msgspec import Struct

from contoursolve.reading import Dialect
from contoursolve.tool_radius.tool import OutsideCorner


class ToolSettings(Struct, frozen=True):
    """Values of the settings about a tool; each is explained beside its row in `controls`. Lengths are mm, angles
    deg."""

    outside: OutsideCorner = OutsideCorner.ROLL
    limit: float = 90.0
    leaves: bool = False
    refuses_point: bool = False
    refuses_corner: bool = False
    is_entry_offset: bool = False
    ends_at_tip: bool = False
    is_mirrored: bool = False
    is_diameter: bool = False
    is_tip_silent: bool = False
    tangent: float = 0.01
    least: float = 0.001
    noticed: float = 0.005


_READ: Mapping[str, tuple[str, Callable[[str], Any]]] = {
    "outside": ("outside", OutsideCorner),
    "intersect-limit": ("limit", float),
    "too-small": ("leaves", "leave".__eq__),
    "equal-radius": ("refuses_point", "error".__eq__),
    "inside-corner": ("refuses_corner", "error".__eq__),
    "entry": ("is_entry_offset", "square-entry".__eq__),
    "end": ("ends_at_tip", "tip".__eq__),
    "numbers": ("is_mirrored", "linuxcnc".__eq__),
    "radius": ("is_diameter", "diameter".__eq__),
    "tip-against-side": ("is_tip_silent", "off".__eq__),
    "tangent": ("tangent", float),
    "min-move": ("least", float),
    "noticed": ("noticed", float),
}
"""By the names of the settings: the field, and how its value is read."""


def settings_of(dialect: Dialect) -> ToolSettings:
    """The values that a control has."""
    own = {each.name.removeprefix("tool-"): each for each in dialect.settings if each.name.startswith("tool-")}
    values = {name: dialect.modes.convention(each).value for name, each in own.items()}
    return ToolSettings(**{_READ[name][0]: _READ[name][1](value) for name, value in values.items()})
