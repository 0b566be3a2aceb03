"""The rows about geometry for a control whose manual, or whose author, says nothing more about it.

They end the rules of a control: rows of its own about the same events stand before them, and win.
"""

from dataclasses import replace
from enum import Enum
from typing import TypedDict, Unpack

from contoursolve.controls.common import COMMON_RULES
from contoursolve.diagnostics import OWN, Alarm, Evidence, Severity, Source
from contoursolve.reading import ReadIssue, Rule
from contoursolve.solving import NoteKind, RefusalKind

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
GEOMETRY_RULES = (
    _row(
        RefusalKind.LINES_PARALLEL,
        "no {things} fits {words}: the lines are parallel and {off} apart",
        "change an angle or a point",
        _LINES,
        _LINES.replace(",A225", ",A150"),
    ),
    _row(
        RefusalKind.NOT_FIXED,
        "{words} {do} not fix {free}: at these values they state the same line",
        "replace one of them by a word that says where on the line the point is",
        _MILL + "G1 X30 ,A45",
        _MILL + "G1 X0 ,A90",
    ),
    _row(
        RefusalKind.POINT_IS_START,
        "{words}: this point of the line is the one where the line begins, so it gives no direction",
        "give another point of the line, or its angle",
        _LINES.replace(",A150", "X50 Y33.094"),
        _LINES.replace(",A150", "X90 Y10"),
    ),
    _row(
        RefusalKind.CIRCLE_MISSED,
        "the line misses the circle: it passes the centre at {actual}, the radius is {limit}, {off} too far",
        "change the line, or make the circle larger",
        _ARC + _LINE,
        _ARC + "G1 X-50 Y80 ,A180 Q-1",
    ),
    _row(
        RefusalKind.RADIUS_TOO_SMALL,
        "{words}: the radius of {actual} is less than half the distance between two points of the arc, {limit}",
        "write at least {limit}, or correct a point",
        _ARC + _LINE,
        _ARC.replace("R50", "R40") + _LINE,
    ),
    _row(
        RefusalKind.CIRCLES_APART,
        "the two circles do not meet: their centres are {actual} apart, and they meet at {limit}",
        "change a centre or a radius by {off}",
        _CENTERED + "G3 X-40 Y60 I-40 J20 R40 Q-1",
        _CENTERED + "G3 X-40 Y60 I-40 J160 R40 Q-1",
    ),
    _row(
        RefusalKind.CIRCLE_UNDEFINED,
        "{words} {define} no circle: the radius is 0, or two of its points are one",
        "give a centre or a point away from where the arc begins",
        _ARC + _LINE,
        _ARC.replace("X-50", "X50") + _LINE,
    ),
    _row(
        RefusalKind.RADIUS_DIFFERENCE,
        "{words}: two points of the arc differ in their distance from its centre by {off}, allowed {limit}",
        "correct the point, the centre or the radius",
        _CENTERED + _LINE,
        _CENTERED.replace("Y0 I", "Y2 I") + _LINE,
    ),
    _row(
        RefusalKind.LINE_REVERSED,
        "{words} points away from the end of {subject}, which lies {off} behind its start",
        "check the signs: as its ends lie, it would run at {expected}",
        _ARC + _LINE,
        _ARC + "G1 X-50 Y42.857 ,A-8.13 Q-1",
    ),
    _row(
        RefusalKind.LINE_BACKWARDS,
        "{subject} would run backwards: it ends {off} behind where it begins",
        "move the point that it runs to",
        _LINES,
        _LINES.replace("G1 ,A150", "G1 X130 Y-13.094"),
    ),
    _row(
        RefusalKind.CORNER_TOO_LARGE,
        "{subject} does not fit: {words} is {actual}, {fits} on {where}",
        "{smaller}, or make the elements longer",
        _CUT,
        _CUT.replace(",C10", ",C31"),
    ),
    _row(
        RefusalKind.CORNERS_OVERLAP,
        "{words} overlap on {subject}: they need {actual}, it has {limit}",
        "{smaller}",
        _CUT,
        _MILL + "G1 X30 ,C20\nY30 ,C20\nX60",
    ),
    _row(
        RefusalKind.CORNER_STRAIGHT,
        "{words}: {subject} joins two elements of the same direction, so it is no corner",
        "delete {words}",
        _CUT,
        _CUT.replace("X40 Y40", "X60"),
    ),
    _row(
        RefusalKind.CORNER_REVERSES,
        "{words}: {subject} turns back by 180 deg, where no corner can be made",
        "change the direction of one element",
        _CUT,
        _CUT.replace("X40 Y40", "X10"),
    ),
    _row(
        RefusalKind.CORNER_SIGN,
        "{words}: the sign says which way {subject} runs, and it runs the other way",
        "change the sign; plus is the positive direction of that axis",
        _SQUARE,
        _SQUARE.replace("I5.", "I-5."),
    ),
    _row(
        RefusalKind.BEVEL_OUTSIDE,
        "{words}: the virtual intersection lies {off} in {axis} outside the rectangle that its line spans",
        "use a rounding, or a sharp corner",
        _LATHE,
        _LATHE.replace("B120.", "B60."),
    ),
    _row(
        RefusalKind.BEVEL_IN_BAND,
        "{words}: no 45 deg segment joins the two elements of {subject}",
        "use a rounding, or a sharp corner",
        "G00 X100. Z-50.\nG112 U0 I10. K-50. R30. C5. D5.",
        "G00 X100. Z-50.\nG112 U0 I28. K-50. R30. C1.",
    ),
    _row(
        RefusalKind.LANDING_UNKNOWN,
        "{words}: no line advances along the line that {subject} would land on",
        "delete {words}",
        _LATHE.replace("C5.", "Q5."),
        "G00 X40. Z0.\nG111 A90. I10. B90. X100. Q2.",
    ),
    _row(
        RefusalKind.ARC_EMPTY,
        "{subject} ends where it begins: no arc, or a full circle, would be cut",
        "choose the other point, or drop the arc",
        _ARC + _LINE,
        _ARC + "G1 X90 Y0 ,A0 Q1",
    ),
    _row(
        NoteKind.TOUCHES,
        "{subject}: two elements only touch, so that both intersections are one point",
        "a value slightly different splits it in two or loses it: check that tangency is meant",
        _ARC + _LINE,
        _ARC + "G1 X-50 Y50 ,A180 Q-1",
        Severity.WARNING,
    ),
    _row(
        NoteKind.DOUBLE,
        "{subject}: two contours have become one, because an element just touches; a small change parts them",
        "check that it is meant to touch",
        _ARC + _LINE,
        "G17 G90 G41 G0 X50 Y0\nG3 X? Y50 R50 (contoursolve: X of C = 0)\n" + _LINE,
        Severity.WARNING,
    ),
    _row(
        NoteKind.RADIUS_DIFFERS,
        "{words}: two points of the arc differ in their distance from the centre by {off}, within the allowed {limit}",
        "correct the point, the centre or the radius",
        _CENTERED + _LINE,
        _CENTERED.replace("X-50 Y0", "X-49.995 Y0") + _LINE,
        Severity.INFO,
    ),
    _row(
        NoteKind.HALF_CIRCLE,
        "{words}: the ends are {limit} from their middle, {off} more than the radius, so it is a half circle",
        "within the least increments nothing is wrong; the arc ends where its words say",
        _ARC + _LINE,
        _ARC.replace("R50", "R49.9995") + _LINE,
        Severity.INFO,
    ),
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


_GENERAL = {rule.about: rule for rule in (*COMMON_RULES, *GEOMETRY_RULES)}


def told(
    code: str, about: Enum, good: str | tuple[str, ...], *bad: str | tuple[str, str], **otherwise: Unpack[Otherwise]
) -> Rule:
    """The general row about an event as a control tells it: with a code and examples of its own, and with what its
    manual says otherwise. Of the examples, `good` are right; what is wrong is a program, or two texts, of which the
    second stands for the first in the first right program."""
    accepted = (good,) if isinstance(good, str) else good
    rejected = tuple(each if isinstance(each, str) else accepted[0].replace(*each) for each in bad)
    return replace(_GENERAL[about], code=code, accepted=accepted, rejected=rejected, **otherwise)


def told_by(prefix: str, about: Enum, good: str, *bad: str | tuple[str, str], **otherwise: Unpack[Otherwise]) -> Rule:
    """The same for a control whose codes begin with a prefix."""
    return told(f"{prefix}-{_GENERAL[about].code}", about, good, *bad, **otherwise)
