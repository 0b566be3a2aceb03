"""The rows about geometry for a control whose manual, or whose author, says nothing more about it.

They end the rules of a control: rows of its own about the same events stand before them, and win.
"""

from collections.abc import Iterator
from dataclasses import replace
from enum import Enum
from typing import TypedDict, Unpack

from contoursolve.controls.common import COMMON_RULES, about_event
from contoursolve.diagnostics import OWN, Alarm, Evidence, Severity, Source
from contoursolve.reading import ReadIssue, Rule
from contoursolve.solving import GeometricEventKind

_SOURCE = Source(OWN, "the geometry of lines, arcs and corners", Evidence.ASSUMED)

_MILL = "G17 G90 G0 X0 Y0\n"
_CUT = _MILL + "G1 X30 ,C10\nX40 Y40"
_LINES = "G17 G90 G41 G0 X90 Y10\nG1 ,A150\nG1 X10 Y20 ,A225"
_ARC = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\n"
_CENTERED = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 I-50 J0\n"
_LINE = "G1 X-50 Y42.857 ,A171.87 Q-1"
_SQUARE = "G00 X20. Z0.\nG01 Z-20. I5.\nX40.\nX60. ,A90."
_LATHE = "G00 X40. Z0.\nG111 X100. A180. K-30. B120. C5."


def _row(
    about: Enum, message: str, help_: str, accepted: str, rejected: str, severity: Severity = Severity.ERROR
) -> Rule:
    """A row; its examples are programs for the control that their words show."""
    return Rule(about.value, message, help_, _SOURCE, (accepted,), (rejected,), about=about, severity=severity)


COMMA_MISSING = _row(
    ReadIssue.COMMA_MISSING,
    "{words} has no comma, so the control does not read it as {meant}",
    "write {meant} if that is meant",
    _CUT,
    _CUT.replace(",C", "C") + " ,R5\nX80",
    Severity.WARNING,
)
PLANE_CHANGES = ("the plane changes inside the contour", "select the plane before its first block")
"""Message and help of a row about a plane that is selected in a contour."""

ANGLE_RANGE = (
    "{words} is more than a turn; it is taken as {within}, the same direction",
    "write {within} if that is meant",
)
"""The same of an angle of more than a turn."""

ANGLE_RAPID = "{words}: the control works out a line by its angle in G01, not in G00"
"""Message of a row about an angle in rapid traverse."""

GEOMETRY_RULES = (
    about_event("lines-parallel", _SOURCE, (_LINES,), (_LINES.replace(",A225", ",A150"),)),
    about_event("not-fixed", _SOURCE, (_MILL + "G1 X30 ,A45",), (_MILL + "G1 X0 ,A90",)),
    about_event(
        "point-is-start", _SOURCE, (_LINES.replace(",A150", "X50 Y33.094"),), (_LINES.replace(",A150", "X90 Y10"),)
    ),
    about_event("circle-missed", _SOURCE, (_ARC + _LINE,), (_ARC + "G1 X-50 Y80 ,A180 Q-1",)),
    about_event("radius-too-small", _SOURCE, (_ARC + _LINE,), (_ARC.replace("R50", "R40") + _LINE,)),
    about_event(
        "circles-apart",
        _SOURCE,
        (_CENTERED + "G3 X-40 Y60 I-40 J20 R40 Q-1",),
        (_CENTERED + "G3 X-40 Y60 I-40 J160 R40 Q-1",),
    ),
    about_event("circle-undefined", _SOURCE, (_ARC + _LINE,), (_ARC.replace("X-50", "X50") + _LINE,)),
    about_event("radius-difference", _SOURCE, (_CENTERED + _LINE,), (_CENTERED.replace("Y0 I", "Y2 I") + _LINE,)),
    about_event("line-reversed", _SOURCE, (_ARC + _LINE,), (_ARC + "G1 X-50 Y42.857 ,A-8.13 Q-1",)),
    about_event("line-backwards", _SOURCE, (_LINES,), (_LINES.replace("G1 ,A150", "G1 X130 Y-13.094"),)),
    about_event("corner-too-large", _SOURCE, (_CUT,), (_CUT.replace(",C10", ",C31"),)),
    about_event("corners-overlap", _SOURCE, (_CUT,), (_MILL + "G1 X30 ,C20\nY30 ,C20\nX60",)),
    about_event("corner-straight", _SOURCE, (_CUT,), (_CUT.replace("X40 Y40", "X60"),)),
    about_event("corner-reverses", _SOURCE, (_CUT,), (_CUT.replace("X40 Y40", "X10"),)),
    about_event("corner-sign", _SOURCE, (_SQUARE,), (_SQUARE.replace("I5.", "I-5."),)),
    about_event("bevel-outside", _SOURCE, (_LATHE,), (_LATHE.replace("B120.", "B60."),)),
    about_event(
        "bevel-in-band",
        _SOURCE,
        ("G00 X100. Z-50.\nG112 U0 I10. K-50. R30. C5. D5.",),
        ("G00 X100. Z-50.\nG112 U0 I28. K-50. R30. C1.",),
    ),
    about_event(
        "landing-unknown", _SOURCE, (_LATHE.replace("C5.", "Q5."),), ("G00 X40. Z0.\nG111 A90. I10. B90. X100. Q2.",)
    ),
    about_event("arc-empty", _SOURCE, (_ARC + _LINE,), (_ARC + "G1 X90 Y0 ,A0 Q1",)),
    about_event("touches", _SOURCE, (_ARC + _LINE,), (_ARC + "G1 X-50 Y50 ,A180 Q-1",)),
    about_event(
        "double",
        _SOURCE,
        (_ARC + _LINE,),
        ("G17 G90 G41 G0 X50 Y0\nG3 X? Y50 R50 (contoursolve: X of C = 0)\n" + _LINE,),
    ),
    about_event(
        "radius-differs", _SOURCE, (_CENTERED + _LINE,), (_CENTERED.replace("X-50 Y0", "X-49.995 Y0") + _LINE,)
    ),
    about_event("half-circle", _SOURCE, (_ARC + _LINE,), (_ARC.replace("R50", "R49.9995") + _LINE,)),
    _row(
        ReadIssue.ANGLE_OPPOSITE,
        "{words}: {subject} runs the other way, at {expected}; the control takes the angle of a line either way",
        "as the line runs, its angle is {expected}: check the signs of the angle and of the end",
        "G00 X0 Z0.\nG01 X60. ,A90.",
        "G00 X0 Z0.\nG01 X60. ,A-90.",
        Severity.WARNING,
    ),
    _row(
        ReadIssue.CORNER_DROPPED,
        "{words}: {subject} turns by {actual}; up to 1 deg the control leaves a corner out without an alarm",
        "delete {words}, or correct the elements if they are meant to turn",
        "G00 X20. Z0.\nG01 Z-20. ,R3.\nX60. ,A120.",
        "G00 X20. Z0.\nG01 Z-20. ,R3.\nZ-40. ,A179.5",
        Severity.WARNING,
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
