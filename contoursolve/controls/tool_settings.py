"""Settings about the radius of a tool: what changes its path, or what is said of it; one row each."""

from collections.abc import Mapping
from decimal import Decimal

from contoursolve.diagnostics import OWN, Evidence, Source
from contoursolve.reading import Setting

_ASSUMED, _DERIVED = (
    Source(OWN, "the radius of a tool", evidence) for evidence in (Evidence.ASSUMED, Evidence.DERIVED)
)
_RECALLED = Source(OWN, "as other controls have it; no page of a manual was seen", Evidence.ASSUMED)


def _choice(name: str, meaning: str, values: Mapping[str, str], source: Source = _ASSUMED) -> Setting:
    """One whose first value is in force unless told otherwise."""
    return Setting(f"tool-{name}", meaning, values, next(iter(values)), source)


TOOL_SETTINGS = (
    _choice(
        "outside",
        "the way of a tool around an outside corner, where neither the program nor --outside says it",
        {"roll": "an arc about the corner", "intersect": "straight on to where both ways meet"},
        _RECALLED,
    ),
    Setting(
        "tool-intersect-limit",
        "up to which turn the way goes straight on to where both ways meet",
        {"90": "deg"},
        "90",
        _ASSUMED,
        bounds=(Decimal(0), Decimal(179)),
        unit="deg",
    ),
    _choice(
        "too-small",
        "what becomes of an element that the tool does not reach",
        {"report": "an error: no path", "leave": "it is left out, with a warning of the rest"},
    ),
    _choice(
        "equal-radius",
        "an inside arc of the radius of the tool",
        {"allow": "the tool stands there, and the arc is no move", "error": "it is refused"},
    ),
    _choice(
        "inside-corner",
        "a sharp inside corner, which keeps the radius of the tool",
        {"note": "it may stay", "error": "it is refused"},
        _DERIVED,
    ),
    _choice(
        "entry",
        "where the move to the contour ends",
        {
            "square-next": "square to the first element",
            "square-entry": "as if it were an element itself, beside which the tool goes",
        },
        _RECALLED,
    ),
    _choice(
        "end",
        "where the path ends",
        {
            "contact": "where the tool touches the end of the contour",
            "tip": "where the programmed point is at the end of the contour, if it would run past it",
        },
        _DERIVED,
    ),
    _choice(
        "numbers",
        "the numbers of imaginary tips",
        {"fanuc": "3 lies towards the axis and the chuck", "linuxcnc": "2 lies there: mirrored in X"},
        _RECALLED,
    ),
    _choice(
        "radius",
        "the number after R of a tool, and in the table of tools",
        {"radius": "its radius", "diameter": "its diameter"},
    ),
    _choice(
        "tip-against-side",
        "a tip that points away from the surface",
        {"warn": "a warning", "off": "nothing is said"},
        _DERIVED,
    ),
)
"""Those of every control."""
