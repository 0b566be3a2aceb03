"""Facts about the controls and the radius of a tool: their alarms, and the moves that they look ahead."""

from collections.abc import Mapping

from msgspec import Struct

from contoursolve.diagnostics import Alarm, Evidence

_PRINTED, _DERIVED, _ASSUMED = Evidence.PRINTED, Evidence.DERIVED, Evidence.ASSUMED


class ToolFacts(Struct, frozen=True):
    """Facts about the compensation of one control."""

    alarms: Mapping[str, Alarm] = {}
    """Its alarms, with their grades, by the kinds of `ToolFaultKind`."""
    notice: str = ""
    """The moves among which it notices that the tool cuts into another element, and the grade."""
    ahead: int = 0
    """The number of these moves."""
    corners: Mapping[str, str] = {}
    """The words that say the way around an outside corner, `roll` or `intersect` (printed)."""
    needs_entry: bool = False
    """Whether it refuses a move to the contour that is no longer than the radius."""
    keeps_d: bool = False
    """Whether D chooses the lengths of a tool, too, so that it stays without G41 and G42 (assumed)."""
    no_offset: Evidence = _ASSUMED
    """The grade of what D0 does: G41 stays, with radius 0."""


def _alarms(evidence: Evidence, **numbers: str) -> dict[str, Alarm]:
    return {kind: Alarm(number, evidence) for kind, number in numbers.items()}


_FANUC = ToolFacts(
    # The numbers are printed in its list of alarms; which of them comes for an element that reverses is derived.
    _alarms(_DERIVED, arc_too_small="41", element_vanishes="41", interference="41", no_intersection="33")
    | _alarms(_PRINTED, entry_by_arc="34", exit_by_arc="34"),
    "the control looks two moves ahead (printed)",
    2,
)
_HAAS = ToolFacts(
    # From a table that names the manual.
    _alarms(
        _ASSUMED,
        arc_too_small="342",
        element_vanishes="342",
        no_intersection="342",
        entry_by_arc="340",
        exit_by_arc="341",
    )
)
_SIEMENS = ToolFacts(
    _alarms(_PRINTED, no_intersection="10751", interference="10751")
    | _alarms(_DERIVED, arc_too_small="10751", element_vanishes="10751")
    | _alarms(_ASSUMED, no_offset="10750"),
    "the control checks the next blocks, by default 3 (printed)",
    3,
    {"G450": "roll", "G451": "intersect"},
    keeps_d=True,
)
_NAMED = "Tool radius too large"
TOOL_FACTS: Mapping[str, ToolFacts] = {
    "fanuc-lathe": _FANUC,
    "fanuc-mill": _FANUC,
    "haas-lathe": _HAAS,
    "haas-mill": _HAAS,
    "siemens-840d": _SIEMENS,
    "siemens-808d": _SIEMENS,
    "heidenhain": ToolFacts(
        _alarms(_PRINTED, element_vanishes=_NAMED) | _alarms(_DERIVED, arc_too_small=_NAMED, no_intersection=_NAMED)
    ),
    "isg": ToolFacts(
        _alarms(_PRINTED, arc_too_small="90017", equal_radius="90017", entry_too_short="90123", entry_by_arc="90008"),
        "the control looks at this block and two more, and not farther (printed)",
        2,
        {"G25": "intersect", "G26": "roll"},
        needs_entry=True,
        keeps_d=True,
    ),
    "mitsubishi": ToolFacts(
        _alarms(_ASSUMED, no_intersection="P152", interference="P153", entry_by_arc="P151"),
        "the control looks five blocks ahead, of which three move, and not farther (printed)",
        3,
    ),
    "nct-99m": ToolFacts(_alarms(_ASSUMED, interference="3048"), no_offset=_PRINTED),
    "linuxcnc": ToolFacts(notice="the control looks at the next move (measured)", ahead=1, needs_entry=True),
}
"""By the names of the controls. No number is known of YASNAC."""
