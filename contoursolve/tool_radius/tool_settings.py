"""The settings of a control about the radius of a tool, as the path of its centre reads them."""

from msgspec import Struct

from contoursolve.reading import Control
from contoursolve.tool_radius.tool import OutsideCorner


class ToolSettings(Struct, frozen=True):
    """Values of the settings about a tool; each is explained beside its row in `controls`. The limit is in deg."""

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


_CHOSEN = {
    ("too-small", "leave"): "leaves",
    ("equal-radius", "error"): "refuses_point",
    ("inside-corner", "error"): "refuses_corner",
    ("entry", "square-entry"): "is_entry_offset",
    ("end", "tip"): "ends_at_tip",
    ("numbers", "linuxcnc"): "is_mirrored",
    ("radius", "diameter"): "is_diameter",
    ("tip-against-side", "off"): "is_tip_silent",
}
"""The field of what is not usual, by the name of a setting and its value."""


def settings_of(control: Control) -> ToolSettings:
    """The values that a control has."""
    names = {each.name.removeprefix("tool-"): each for each in control.settings if each.name.startswith("tool-")}
    own = {name: control.modes.convention(each).value for name, each in names.items()}
    chosen = {field: own[name] == value for (name, value), field in _CHOSEN.items()}
    return ToolSettings(OutsideCorner(own["outside"]), float(own["intersect-limit"]), **chosen)
