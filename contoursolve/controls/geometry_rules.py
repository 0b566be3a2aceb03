"""The rows about geometry for a control whose manual, or whose author, says nothing more about it.

They end the rules of a control: rows of its own about the same events stand before them, and win.
"""

from collections.abc import Iterator

from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.rule_rows import EVENTS, GEOMETRY, row
from contoursolve.diagnostics import Severity
from contoursolve.reading import ReadIssue, Rule
from contoursolve.solving import GeometricEventKind

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
    row("lines-parallel", like=EVENTS,
        examples={"contour": "{vertex_blocks}", "closing": "{opening}", "options": "--rules off"}),
    row("not-fixed", like=EVENTS,
        examples={"contour": "{angled_block}", "end": "{at_start}", "degrees": "{across_end}",
         "options": "--rules off"}),
    row("point-is-start", like=EVENTS),
    row("circle-missed", like=EVENTS),
    row("radius-too-small", like=EVENTS, examples={"contour": "{arc_blocks}", "center": "{small_radius}"}),
    row("circles-apart", like=EVENTS),
    row("circle-undefined", like=EVENTS,
        examples={"contour": "{arc_blocks}", "arc_end": "", "center": "{radius}", "options": "--rules off"}),
    row("radius-difference", like=EVENTS,
        examples={"contour": "{arc_blocks}", "center": "{center_off}", "options": "--rules off"}),
    row("line-reversed", like=EVENTS,
        examples={
            "contour": "{angled_block}", "degrees": "{opposite}", "options": "--setting CONTROL.angle-sense=ray"}),
    row("line-backwards", like=EVENTS),
    row("corner-too-large", like=EVENTS, examples={"size": "99."}),
    row("corners-overlap", like=EVENTS, examples={"contour": "{twice}", "each": "28."}),
    row("corner-straight", like=EVENTS, examples={"turn": "{straight_on}"}),
    row("corner-reverses", like=EVENTS, examples={"turn": "{turned_back}"}),
    row("corner-sign", like=EVENTS),
    row("bevel-outside", like=EVENTS),
    row("bevel-in-band", like=EVENTS),
    row("landing-unknown", like=EVENTS),
    row("arc-empty", like=EVENTS),
    row("touches", like=EVENTS),
    row("double", like=EVENTS),
    row("radius-differs", like=EVENTS),
    row("half-circle", like=EVENTS,
        examples={"contour": "{arc_blocks}", "arc_end": "{opposite_end}", "center": "{half_radius}"}),
    row("angle-opposite",
        "{words}: {subject} runs the other way, at {expected}; the control takes the angle of a line either way",
        "as the line runs, its angle is {expected}: check the signs of the angle and of the end", GEOMETRY,
        ReadIssue.ANGLE_OPPOSITE, {"contour": "{angled_block}", "degrees": "{opposite}"}, severity=Severity.WARNING),
    row("corner-dropped",
        "{words}: {subject} turns by {actual}; up to 1 deg the control leaves a corner out without an alarm",
        "delete {words}, or correct the elements if they are meant to turn", GEOMETRY,
        ReadIssue.CORNER_DROPPED, {"turn": "{hardly_turned}"}, severity=Severity.WARNING),
    row("comma-missing", "{words} has no comma, so the control does not read it as {meant}",
        "write {meant} if that is meant", GEOMETRY, ReadIssue.COMMA_MISSING, {"corner": "{comma_lost}"},
        severity=Severity.WARNING),
)  # fmt: skip


def _ends_of(rule: Rule) -> Iterator[str]:
    """Ends of the codes of rules that are about the same as a general one."""
    yield rule.code
    if isinstance(rule.about, GeometricEventKind):
        yield from rule.about.event.codes


GENERAL = {end: rule for rule in (*COMMON_RULES, *GEOMETRY_RULES) for end in _ends_of(rule)}
"""The rows that a control may tell with what its manual says otherwise, by the end of a code."""
