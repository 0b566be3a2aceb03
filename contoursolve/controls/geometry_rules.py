"""The rows about geometry for a control whose manual, or whose author, says nothing more about it.

They end the rules of a control: rows of its own about the same events stand before them, and win.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from enum import Enum
from typing import TypedDict, Unpack

from contoursolve.controls.common import COMMON_RULES, about_event
from contoursolve.diagnostics import OWN, Alarm, Evidence, Severity, Source
from contoursolve.reading import ReadIssue, Rule
from contoursolve.solving import GeometricEventKind

_SOURCE = Source(OWN, "the geometry of lines, arcs and corners", Evidence.ASSUMED)


def _row(about: Enum, message: str, help_: str, slip: Mapping[str, str]) -> Rule:
    return Rule(about.value, message, help_, _SOURCE, about=about, severity=Severity.WARNING, slip=slip)


COMMA_MISSING = _row(
    ReadIssue.COMMA_MISSING,
    "{words} has no comma, so the control does not read it as {meant}",
    "write {meant} if that is meant",
    {"corner": "{comma_lost}"},
)
PLANE_CHANGES = ("the plane changes inside the contour", "select the plane before its first block")
"""Message and help of a row about a plane that is selected in a contour."""

ZERO_MOVES = (
    "the coordinate system moves between two blocks of the contour",
    "select offsets and shift axes before its first block",
)
"""The same of an offset, a shift or a tool that is selected in a contour."""

ANGLE_RANGE = (
    "{words} is more than a turn; it is taken as {within}, the same direction",
    "write {within} if that is meant",
)
"""The same of an angle of more than a turn."""

ANGLE_RAPID = "{words}: the control works out a line by its angle in G01, not in G00"
"""Message of a row about an angle in rapid traverse."""

GEOMETRY_RULES = (
    about_event(
        "lines-parallel", _SOURCE, {"contour": "{vertex_blocks}", "closing": "{opening}", "options": "--rules off"}
    ),
    about_event(
        "not-fixed",
        _SOURCE,
        {"contour": "{angled_block}", "end": "{at_start}", "degrees": "{across_end}", "options": "--rules off"},
    ),
    about_event("point-is-start", _SOURCE),
    about_event("circle-missed", _SOURCE),
    about_event("radius-too-small", _SOURCE, {"contour": "{arc_blocks}", "center": "{small_radius}"}),
    about_event("circles-apart", _SOURCE),
    about_event(
        "circle-undefined",
        _SOURCE,
        {"contour": "{arc_blocks}", "arc_end": "", "center": "{radius}", "options": "--rules off"},
    ),
    about_event(
        "radius-difference", _SOURCE, {"contour": "{arc_blocks}", "center": "{center_off}", "options": "--rules off"}
    ),
    about_event(
        "line-reversed",
        _SOURCE,
        {"contour": "{angled_block}", "degrees": "{opposite}", "options": "--set CONTROL.angle-sense=ray"},
    ),
    about_event("line-backwards", _SOURCE),
    about_event("corner-too-large", _SOURCE, {"size": "99."}),
    about_event("corners-overlap", _SOURCE, {"contour": "{twice}", "each": "28."}),
    about_event("corner-straight", _SOURCE, {"turn": "{straight_on}"}),
    about_event("corner-reverses", _SOURCE, {"turn": "{turned_back}"}),
    about_event("corner-sign", _SOURCE),
    about_event("bevel-outside", _SOURCE),
    about_event("bevel-in-band", _SOURCE),
    about_event("landing-unknown", _SOURCE),
    about_event("arc-empty", _SOURCE),
    about_event("touches", _SOURCE),
    about_event("double", _SOURCE),
    about_event("radius-differs", _SOURCE),
    about_event(
        "half-circle", _SOURCE, {"contour": "{arc_blocks}", "arc_end": "{opposite_end}", "center": "{half_radius}"}
    ),
    _row(
        ReadIssue.ANGLE_OPPOSITE,
        "{words}: {subject} runs the other way, at {expected}; the control takes the angle of a line either way",
        "as the line runs, its angle is {expected}: check the signs of the angle and of the end",
        {"contour": "{angled_block}", "degrees": "{opposite}"},
    ),
    _row(
        ReadIssue.CORNER_DROPPED,
        "{words}: {subject} turns by {actual}; up to 1 deg the control leaves a corner out without an alarm",
        "delete {words}, or correct the elements if they are meant to turn",
        {"turn": "{hardly_turned}"},
    ),
    COMMA_MISSING,
)


class Otherwise(TypedDict, total=False):
    """The fields that a control may state otherwise, or besides."""

    message: str
    help: str
    source: Source
    roles: tuple[str, ...]
    alarm: Alarm | None
    severity: Severity
    note: str


def _ends_of(rule: Rule) -> Iterator[str]:
    """Ends of the codes of rules that are about the same as a general one."""
    yield rule.code
    if isinstance(rule.about, GeometricEventKind):
        yield from rule.about.event.codes


_GENERAL = {end: rule for rule in (*COMMON_RULES, *GEOMETRY_RULES) for end in _ends_of(rule)}


def told(
    code: str, good: str | tuple[str, ...], *bad: str | tuple[str, str], as_: str = "", **otherwise: Unpack[Otherwise]
) -> Rule:
    """The general row that the end of a code names, or `as_`, as a control tells it: with that code and examples of its
    own, and with what its manual says otherwise. Of the examples, `good` are right; what is wrong is a program, or two
    texts, of which the second stands for the first in the first right program."""
    accepted = (good,) if isinstance(good, str) else good
    rejected = tuple(each if isinstance(each, str) else accepted[0].replace(*each) for each in bad)
    parts = (as_ or code).split("-")
    ends = ("-".join(parts[number:]) for number in range(len(parts)))
    row = next(_GENERAL[end] for end in ends if end in _GENERAL)
    return replace(row, code=code, accepted=accepted, rejected=rejected, **otherwise)
