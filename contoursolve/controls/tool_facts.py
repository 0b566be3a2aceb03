"""Facts about the controls and the radius of a tool: their alarms, and the moves that they look ahead."""

from collections.abc import Mapping
from enum import Enum

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Alarm, Evidence

_PRINTED, _DERIVED, _ASSUMED = Evidence.PRINTED, Evidence.DERIVED, Evidence.ASSUMED


class ToolEffect(Enum):
    """Effects of a word on the radius of a tool, or on compensation."""

    ADDS = "its number is added to the radius"
    STATES = "its number is the radius of a tool"
    STOPS = "the path is another one, which is not followed"
    TURNS = "the same, where the programmed point is an imaginary tip"
    BEHIND = "the same, where the way to the contour begins behind it, or the way away ends there"


class ToolWord(Struct, frozen=True):
    """A word that changes the radius of a tool, or the way of compensation."""

    pattern: str
    """Its way of writing, in capitals, with its `number`, and that of its `tool`."""
    ends: str | None
    """The text that ends it; None if it is for its own block alone, nothing if it is for the whole program."""
    meaning: str
    """The verb and the rest of a sentence about it."""
    help: str
    effect: ToolEffect = ToolEffect.STOPS
    calls: str = ""
    """The text that calls the `tool`."""
    evidence: Evidence = _ASSUMED


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
    splits_t: bool = False
    """Whether the last two digits of T choose the offset, so that T0100 has none (assumed)."""
    needs_d: bool = False
    """Whether D chooses the radius, so that nobody knows it without one (assumed)."""
    words: tuple[ToolWord, ...] = ()
    """The words that change the radius, or compensation."""


def _alarms(evidence: Evidence, **numbers: str) -> dict[str, Alarm]:
    return {kind: Alarm(number, evidence) for kind, number in numbers.items()}


def _code(numbers: str) -> str:
    """A text with one of some G codes."""
    return rf"(?<![A-Z\d.])G\s*0*(?:{numbers})(?![.\d])"


_ADDS, _STATES, _TURNS = ToolEffect.ADDS, ToolEffect.STATES, ToolEffect.TURNS
_NEVER, _NUMBER = r"(?!)", r"(?P<number>[-+]?(?:\d+\.?\d*|\.\d+))"
_OTHER = r"(?!\s*0*\.?0*\s*(?:[A-Z]|$))\S*"
"""A number other than 0."""
_ADDED, _SOFT = "adds to the radius", "leads to the contour, or away from it, along a path of its own"
_STATED = "states a radius", "state that one with --tool, or take it out", _STATES
_TAKE_OUT = "take it out, and put it back into the path that is written"
_UNSCALED = "scales the contour, but not the tool", "write the contour in its real size"
_ROUND = "changes the way of the tool around a corner", "write the contour without it"
_TURNED = "turns the contour, but not the imaginary tip", _TAKE_OUT, _TURNS
_FRAMES = r"\b(?:TRANS|ROTS?|SCALE|MIRROR)\b"
_CYCLE = r"\bCYCL DEF (?:11|26)\.1\b"
# fmt: off
_WORDS = (
    ToolWord(_code("51"), _code("50"), *_UNSCALED),
    ToolWord(_code(r"51\.1"), _code(r"50\.1"), *_TURNED),
    ToolWord(_code("3[89]"), None, *_ROUND),
    ToolWord(rf"(?=.*{_code('10')})(?!.*L\s*(?:2|20|50)(?!\d)).*R{_NUMBER}", _NEVER, *_STATED),
)
_OLD = ToolWord(_code("4[5-8]"), "", "makes a move longer or shorter by the radius", "write G41 or G42 in its place")
_SIEMENS_WORDS = (
    ToolWord(rf"\bOFFN\s*=\s*{_NUMBER}?", r"\bOFFN\s*=", _ADDED, "write a number once, before the contour", _ADDS),
    ToolWord(rf"\bTOFFR\s*={_OTHER}", r"\bTOFFR\s*=", _ADDED, "write TOFFR=0, and state the radius with it"),
    ToolWord(rf"\$TC_DP6\[\s*(?P<tool>\d+),.*?=\s*{_NUMBER}", _NEVER, *_STATED, r"\bT(?P<tool>\d+)"),
    ToolWord(r"\bA?SCALE\b(?!(?:\s*[XYZ]=?\s*1(?:\.0*)?)*\s*$)", _FRAMES, *_UNSCALED),
    ToolWord(r"\bA?(?:ROTS?|MIRROR)\b(?=\s+[A-Z])", _FRAMES, *_TURNED),
    ToolWord(r"\bCUTCONON\b", r"\bCUTCONOF\b", "suspends compensation", "write G40, and G41 or G42 after it"),
    ToolWord(r"\bKONT\b", r"\bNORM\b|\bKONT[CT]\b", "leads around the contour from behind it",
             "begin, and end, on the side of the tool", ToolEffect.BEHIND),
    ToolWord(r"\bKONT[CT]\b", r"\bNORM\b|\bKONT\b", _SOFT, "write NORM"),
    ToolWord(rf"\bDISC\s*={_OTHER}", r"\bDISC\s*=", *_ROUND),
    ToolWord(r"\bCUT(?:3D\w*|2DFD?)\b", r"\bCUT2D\b", "compensates in space", "write CUT2D"),
    ToolWord(_code("[123]4[78]"), None, _SOFT, "write G1 in its place, with G41, G42 or G40"),
)
_KLARTEXT_WORDS = (
    ToolWord(rf"\bTOOL CALL\b.*?\bDR(?!2\s*:?[-+])\s*:?\s*{_NUMBER}?", r"\bTOOL CALL\b(?:\s+[\dQ\"]|.*\bDR)",
             _ADDED, "write a number for it", _ADDS, evidence=_PRINTED),
    ToolWord(rf"\bTOOL DEF\s+(?P<tool>\d+).*?\bR{_NUMBER}", _NEVER, *_STATED, r"\bTOOL CALL\s+(?P<tool>\d+)"),
    ToolWord(r"\bFUNCTION CORRDATA\b(?!\s+RESET)", r"\bCORRDATA RESET\b", _ADDED, "state the radius with it"),
    ToolWord(rf"{_CYCLE}(?!\s*(?:(?:SCL|[XYZ])\s*\+?1(?:\.0*)?(?![\d.])\s*)+(?:CC|$))", _CYCLE, *_UNSCALED),
    ToolWord(r"\bTRANS SCALE\b(?!\s+RESET)", r"\bTRANS SCALE\b", *_UNSCALED),
    ToolWord(r"\bM9[78]\b", None, *_ROUND),
    ToolWord(r"(?<![A-Z])R[-+](?![\dQ.])", "", "compensates along one axis", "write the move of the centre, with R0"),
    ToolWord(r"\bAPPR\s+\w+", None, _SOFT, "write L with {G41} or {G42} in its place"),
    ToolWord(r"\bDEP\s+\w+", None, _SOFT, "write L with {G40} in its place"),
)
# fmt: on


_FANUC = ToolFacts(
    # The numbers are printed in its list of alarms; which of them comes for an element that reverses is derived.
    _alarms(_DERIVED, arc_too_small="41", element_vanishes="41", interference="41", no_intersection="33")
    | _alarms(_PRINTED, entry_by_arc="34", exit_by_arc="34"),
    "the control looks two moves ahead (printed)",
    2,
    splits_t=True,
    words=_WORDS,
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
    ),
    splits_t=True,
    words=_WORDS,
)
_SIEMENS = ToolFacts(
    _alarms(_PRINTED, no_intersection="10751", interference="10751")
    | _alarms(_DERIVED, arc_too_small="10751", element_vanishes="10751")
    | _alarms(_ASSUMED, no_offset="10750"),
    "the control checks the next blocks, by default 3 (printed)",
    3,
    {"G450": "roll", "G451": "intersect"},
    keeps_d=True,
    words=_SIEMENS_WORDS,
)
_NAMED = "Tool radius too large"
TOOL_FACTS: Mapping[str, ToolFacts] = {
    "fanuc-lathe": _FANUC,
    "fanuc-mill": replace(_FANUC, splits_t=False, needs_d=True, words=(*_WORDS, _OLD)),
    "haas-lathe": _HAAS,
    "haas-mill": replace(_HAAS, splits_t=False, needs_d=True),
    "siemens-840d": _SIEMENS,
    "siemens-808d": _SIEMENS,
    "heidenhain": ToolFacts(
        _alarms(_PRINTED, element_vanishes=_NAMED) | _alarms(_DERIVED, arc_too_small=_NAMED, no_intersection=_NAMED),
        words=_KLARTEXT_WORDS,
    ),
    "isg": ToolFacts(
        _alarms(_PRINTED, arc_too_small="90017", equal_radius="90017", entry_too_short="90123", entry_by_arc="90008"),
        "the control looks at this block and two more, and not farther (printed)",
        2,
        {"G25": "intersect", "G26": "roll"},
        needs_entry=True,
        keeps_d=True,
        words=(ToolWord(rf"V\.G\.WZ_AKT\.R\s*=\s*{_NUMBER}", _NEVER, *_STATED),),
    ),
    "mitsubishi": ToolFacts(
        _alarms(_ASSUMED, no_intersection="P152", interference="P153", entry_by_arc="P151"),
        "the control looks five blocks ahead, three of them moves, and not farther (printed)",
        3,
        words=(*_WORDS, _OLD),
    ),
    "nct-99m": ToolFacts(
        _alarms(_ASSUMED, interference="3048"), no_offset=_PRINTED, needs_d=True, words=(*_WORDS, _OLD)
    ),
    "linuxcnc": ToolFacts(notice="the control looks at the next move (measured)", ahead=1, needs_entry=True),
    "yasnac-lx3": ToolFacts(splits_t=True),
}
"""By the names of the controls. No number is known of YASNAC."""
