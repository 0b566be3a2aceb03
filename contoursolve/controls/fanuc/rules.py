"""Fanuc and Haas: which words may be combined, and what has no solution."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from contoursolve.controls.chain.language import (
    ARC,
    BESIDE_ARC,
    FOLLOWED,
    LAST,
    LEAVES,
    LINE,
    LINE_LINE,
    OVER_LINE,
    RAPID,
    STATED_CENTER,
    STATED_POINT,
)
from contoursolve.controls.chain.rules import Manual, chain_rules
from contoursolve.controls.fanuc.language import (
    ALONG_ARC,
    COMPENSATION_CHANGES,
    GUARD,
    STRAIGHT_ONLY,
    STRICT_ANGLE,
    SUPPLEMENTARY,
    UNGUARDED,
    WRONG_PLANE,
)
from contoursolve.controls.fanuc.lexicon import CORNERS, DRAWING, HAAS
from contoursolve.controls.geometry_rules import COMMA_MISSING, GEOMETRY_RULES, Otherwise, told
from contoursolve.diagnostics.finding import Alarm
from contoursolve.diagnostics.source import Book, Evidence, Source
from contoursolve.reading import ReadIssue
from contoursolve.reading.rules import Along, Parallel, Rule, all_of, at_least, row, some
from contoursolve.solving import RefusalKind

_ANY = (LINE, OVER_LINE, ARC)
_CORNER = (",C", ",R")
_SIGNED = ("corner-first", "corner-second", "corner-R", "corner-C")
_CORNERS = (*_CORNER, *_SIGNED)
_FIRST, _SECOND = ("first", "first-step"), ("second", "second-step")
_STEPS = ("first-step", "second-step")
_ALARM_LIST = "alarm list"
_NOT_SQUARE = "052 (the block behind a corner is not G01, or not at a right angle)"


@dataclass(frozen=True, slots=True)
class _Machine:
    """Whose rules they are: the start of their codes, the manual, the angle's address, whether alarms are known; and
    for the examples a start, a line, and a line that turns off from it."""

    prefix: str
    manual: Book
    angle: str
    has_alarms: bool
    start: str
    line: str
    turn: str
    square: str = ""
    """A program with a corner by a word with a sign, if it has one."""

    @property
    def is_lathe(self) -> bool:
        """Whether it takes a line by its angle, as lathes do."""
        return bool(self.angle)

    @property
    def cut(self) -> str:
        """A program with a corner."""
        return f"{self.start}G01 {self.line} ,C5.\n{self.turn}"

    def source(self, place: str, evidence: Evidence = Evidence.PRINTED) -> Source:
        """A place of its manual; what is printed for Fanuc is assumed of a relative."""
        return Source(self.manual.title, place, evidence if self.has_alarms else Evidence.ASSUMED)

    def alarm(self, number: str, evidence: Evidence = Evidence.PRINTED) -> Alarm | None:
        """An alarm as older controls print it; newer ones print PS and four digits."""
        return Alarm(number, evidence) if self.has_alarms else None


_TURNING, _MILLING = "G00 X20. Z0.\n", "G17 G90 G00 X0 Y0\n"
_SQUARE, _MILLED_SQUARE = _TURNING + "G01 Z-20. I5.\nX40.", _MILLING + "G01 X30. J5.\nY40."
_FANUC_LATHE = _Machine("fanuc", DRAWING, ",A", True, _TURNING, "Z-20.", "X40. Z-30.", _SQUARE)
_FANUC_MILL = _Machine("fanuc", CORNERS, "", True, _MILLING, "X30.", "X40. Y40.", _MILLED_SQUARE)
_HAAS_LATHE = _Machine("haas", HAAS, "A", False, _TURNING, "Z-20.", "X40. Z-30.", _SQUARE)
_HAAS_MILL = _Machine("haas", HAAS, "", False, _MILLING, "X30.", "X40. Y40.")

_VERTEX = _TURNING + "G01 ,A180. ,R3.\nX60. Z-47. ,A120."
_ARC_BEHIND = _MILLING + "G01 X40. ,C6.\nG02 X60. Y20. I20. J0"
_MILLED_TWICE = tuple(_MILLING + f"G01 X30. ,C{size}.\nY30. ,C{size}.\nX60." for size in (10, 20))
_TURNED_TWICE = tuple(_TURNING + f"G01 Z-20. ,R{size}.\nX40. ,C2.\nZ-50." for size in (8, 9))
"""Two corners on one line that fit, and two that do not."""


def _corner_rules(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about ,C and ,R."""
    angle = (machine.angle,) if machine.angle else ()
    cut, two = machine.cut, Alarm("053 TOO MANY ADDRESS COMMANDS", Evidence.ASSUMED)
    return (
        row(f"{machine.prefix}-two-corners", "{words}: a block takes ,C or ,R, not both", "keep one of them",
            machine.source("not described", Evidence.ASSUMED), all_of(*_CORNER), cut, (",C5.", ",C5. ,R5."), roles=_ANY,
            alarm=two if machine.has_alarms else None),
        row(f"{machine.prefix}-corner-without-next", "{words}: a corner needs an element behind it, and none follows",
            "put the next cutting move right behind it, or delete it",
            machine.source(_ALARM_LIST), some(*_CORNERS) & some(LAST) & ~some(RAPID),
            (cut, cut.replace("\n" + machine.turn, "\nG04 P500\n" + machine.turn)),
            ("\n" + machine.turn, "\nM8\n" + machine.turn), ("5.\n", "5.\nG00 "), roles=_ANY,
            alarm=machine.alarm("051 or 052 (no move, or no cutting move, behind a corner)")),
        row(f"{machine.prefix}-corner-alone",
            "{words} stands in a block that moves nothing, so there is no line to cut",
            "write it behind the end of the line before",
            machine.source(_ALARM_LIST, Evidence.DERIVED),
            some(*_CORNERS) & ~some(*STATED_POINT, *angle, "beside-X", "beside-Y", "beside-Z") & ~some(LAST), cut,
            (" ,C5.", "\n,C5."), roles=(LINE,),
            alarm=machine.alarm("055 MISSING MOVE VALUE IN CHF/CNR", Evidence.DERIVED)),
        row(f"{machine.prefix}-corner-compensation", "{words}: a block that switches G40, G41 or G42 takes no corner",
            "switch the compensation in a block before",
            machine.source(_ALARM_LIST), some(*_CORNERS) & some(COMPENSATION_CHANGES),
            (cut, cut.replace("G00", "G42 G00")), ("G01", "G42 G01"), roles=_ANY,
            alarm=machine.alarm("039 CHF/CNR NOT ALLOWED IN NRC")),
        row(f"{machine.prefix}-center-on-line", "{words}: a line has no centre and no radius",
            "delete it; a rounding is ,R",
            machine.source("the function", Evidence.DERIVED), some(*STATED_CENTER, "wrong-center", "R"), cut,
            cut + (" J5." if machine.is_lathe else " R5."), roles=(LINE, OVER_LINE)),
    )  # fmt: skip


def _square_rules(machine: _Machine, amount: str, own: str, line: str) -> tuple[Rule, ...]:
    """The rows about corners between a line along one axis and one along the other: `amount` is a right word, `own` one
    of the wrong axis, `line` a line along the other axis."""
    good, angle = machine.square, (machine.angle,) if machine.angle else ()
    lines = (LINE, OVER_LINE) if machine.is_lathe else _ANY
    (first, second), is_taper = LEAVES, all_of(_FIRST, _SECOND) | some(*angle)
    letters = "I, K or R" if machine.is_lathe else "I, J, K or C"
    rows = (
        ("two-amounts", "{words}: a block takes one corner word", "keep one of them", "053 TOO MANY ADDRESS COMMANDS",
         at_least(2, *_CORNERS) & some(*_SIGNED), lines[:2], ((amount, f"{amount} {own}"),)),
        ("corner-taper", f"{{words}}: a corner by {letters} stands behind a line along one axis", "write ,C or ,R",
         "054 (taper with a chamfer or a rounding)", some(*_SIGNED) & is_taper, lines[:2],
         ((amount, f"{line} {amount}"),)),
        ("chamfer-letter", "{words}: such a chamfer is stated along the axis of the next line",
         "write the letter of that axis: I for X, J for Y, K for Z", "",
         ((some("corner-first") & some(*_FIRST)) | (some("corner-second") & some(*_SECOND)))
         & ~is_taper & ~at_least(2, *_CORNERS), lines[:2], ((amount, own),)),
        ("corner-not-square", f"behind a corner by {letters} the next line must run along the other axis alone",
         "write ,C or ,R for another corner", _NOT_SQUARE,
         (some(first) & (~some(*_FIRST) | some(*_SECOND, *angle)))
         | (some(second) & (~some(*_SECOND) | some(*_FIRST, *angle))),
         lines, ((line, machine.turn), (line, machine.line.replace("0.", "5.")))),
    )  # fmt: skip
    own_rows = (
        row(f"{machine.prefix}-{code}", message, advice,
            machine.source(_ALARM_LIST) if alarm else machine.source("letters of each axis", Evidence.ASSUMED), when,
            good, *rejected, roles=roles, alarm=machine.alarm(alarm) if alarm else None)
        for code, message, advice, alarm, when, roles, rejected in rows
    )  # fmt: skip
    sign = told(f"{machine.prefix}-corner-sign", RefusalKind.CORNER_SIGN, good, (amount, f"{amount[0]}-{amount[1:]}"),
                source=machine.source(_ALARM_LIST, Evidence.DERIVED),
                alarm=machine.alarm(_NOT_SQUARE, Evidence.DERIVED))  # fmt: skip
    return (*own_rows, sign)


_ALONG_ARC = (
    row("fanuc-chamfer-along-arc", "{words}: a chamfer that is measured along an arc is not computed",
        "set chamfer-on-arc=chord, or write the chamfer out",
        _FANUC_MILL.source("not described", Evidence.ASSUMED), some(",C") & some(ALONG_ARC) & some(BESIDE_ARC),
        _FANUC_MILL.cut, roles=_ANY),
)  # fmt: skip


def _mill_rules(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about planes and arcs."""
    cut = machine.cut
    return (
        *(_ALONG_ARC if machine.has_alarms else ()),
        row(f"{machine.prefix}-corner-outside-plane", "{words} moves an axis outside the plane of the contour",
            "move that axis in a block of its own, or select its plane by G17, G18 or G19",
            machine.source("only in the selected plane"), some("beside-X", "beside-Y", "beside-Z"), cut,
            ("X30.", "X30. Z-5."), roles=_ANY),
    )  # fmt: skip


def _shared_rules(machine: _Machine) -> Iterator[Rule]:
    """The rows that controls share."""
    manual = machine.source("arcs", Evidence.ASSUMED)
    sources = {
        "corner-rapid": machine.source("the function", Evidence.DERIVED),
        "corner-negative": machine.source("not described", Evidence.ASSUMED),
        "plane-changes": machine.source("not behind a plane change"),
        "angle-range": machine.source("not described", Evidence.ASSUMED),
    }
    shared = Manual(
        prefix=machine.prefix,
        source=manual,
        angle=machine.angle,
        chamfers=(",C",),
        rounding=",R",
        radius="R20.",
        angled=f"{machine.start}G1 X40. {machine.angle}150.",
        vertex=_VERTEX,
        cut=f"{machine.start}G1 {machine.line} ,R5.\n{machine.turn}",
        arc=_ARC_BEHIND,
        sources=sources,
        equals="",
    )
    arcs = ("center-and-radius", "circle-undefined", "radius-without-end")
    wanted = ("corner-rapid", "corner-negative", *(("angle-range",) if machine.is_lathe else ("plane-changes", *arcs)))
    for rule in chain_rules(shared):
        code = rule.code.removeprefix(f"{machine.prefix}-")
        if code in wanted and code in arcs and rule.when is not None and not machine.has_alarms:
            # A setting allows corners beside arcs.
            yield replace(rule, when=rule.when & ~some(STRAIGHT_ONLY), accepted=(machine.cut,), rejected=())
        elif code in wanted:
            yield rule


def _straight_only(machine: _Machine) -> Rule:
    """The row that forbids corners beside arcs."""
    arc = "G02 X40. Z-30. R10." if machine.is_lathe else "G02 X40. Y10. R10."
    return row(f"{machine.prefix}-arc", "{words}: this control makes corners between lines alone, and this is an arc",
               "end the contour before the arc, or write its lines and corners out",
               machine.source("block patterns; alarm list" if machine.is_lathe else "corners between two lines"),
               some(*STATED_POINT, *STATED_CENTER, "R", *_CORNER) & some(STRAIGHT_ONLY),
               machine.cut, (machine.turn, arc), roles=(ARC,),
               alarm=machine.alarm("052 (the block behind a corner is not G01)"))  # fmt: skip


def _angle_rules(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about a line by its angle and one coordinate, on a lathe."""
    angle = machine.angle
    good = f"{machine.start}G01 X40. {angle}150."
    return (
        row(f"{machine.prefix}-plane", "the contour is not in the plane of Z and X", "write G18 before it",
            machine.source(_ALARM_LIST), some(WRONG_PLANE), (good, "G18 " + good), "G17 " + good, roles=_ANY,
            alarm=machine.alarm("212 ILLEGAL PLANE SELECT")),
        row(f"{machine.prefix}-angle-rapid", "{words}: the control works out a line by its angle in G01, not in G00",
            "write G01",
            machine.source("block patterns", Evidence.DERIVED), some(angle) & some(RAPID), good, ("G01 ", ""),
            roles=(LINE, OVER_LINE)),
        row(f"{machine.prefix}-angle-along-z",
            "{words}: the line runs along Z to within 1 deg, so X does not say where it ends", "give its end by Z",
            machine.source("alarm list; the 1 deg is recalled", Evidence.ASSUMED),
            some(*_SECOND) & ~some(*_FIRST) & Along((angle,), 0, GUARD) & ~some(UNGUARDED), good, ("150.", "180."),
            ("150.", "179.5"), roles=(LINE,), alarm=machine.alarm("057 (the end of the block is not found)"),
            is_about_geometry=True),
        row(f"{machine.prefix}-angle-along-x",
            "{words}: the line runs along X to within 1 deg, so Z does not say where it ends", "give its end by X",
            machine.source("alarm list; the 1 deg is recalled", Evidence.ASSUMED),
            some(*_FIRST) & ~some(*_SECOND) & Along((angle,), 90, GUARD) & ~some(UNGUARDED), good,
            f"{machine.start}G01 Z-20. {angle}90.", roles=(LINE,),
            alarm=machine.alarm("057 (the end of the block is not found)"), is_about_geometry=True),
    )  # fmt: skip


_ANGLED = _TURNING + "G01 X40. ,A150."

_VERTEX_RULES = (
    row("fanuc-angle-supplementary",
        "{words}: with angle=supplementary it stands for 180 deg minus itself, which is not computed",
        "write 180 minus the number, and leave the setting at normal",
        _FANUC_LATHE.source("another bit of parameter 3405, recalled", Evidence.ASSUMED),
        some(",A") & some(SUPPLEMENTARY), _VERTEX, roles=(LINE, OVER_LINE)),
    row("fanuc-closing-incomplete",
        "the line before has an angle and no end, so this block needs X, Z and ,A: it lacks {lacking}", "add {lacking}",
        _FANUC_LATHE.source("block patterns 2 to 8"), ~all_of("first", "second", ",A") & ~some(*_STEPS), _VERTEX,
        *((word, "") for word in (" ,A120.", " Z-47.", "X60. ")), roles=(OVER_LINE,),
        alarm=_FANUC_LATHE.alarm("056 (no end point, or no angle, behind a line by its angle alone)")),
    row("fanuc-closing-increment", "{words}: behind a line by its angle alone, X and Z give the end, not U and W",
        "give the end of this line by X and Z",
        _FANUC_LATHE.source("block patterns 2 to 8: X and Z are absolute"), some(*_STEPS), _VERTEX, ("Z-47.", "W-47."),
        ("X60. Z-47.", "U40. W-47."), roles=(OVER_LINE,),
        alarm=_FANUC_LATHE.alarm("056 (no end point behind a line by its angle alone)")),
    row("fanuc-end-missing", "{words} alone does not say where the line ends",
        "add X or Z; or let a line with X, Z and ,A follow, which it meets",
        _FANUC_LATHE.source("block patterns 1 and 2"), some(",A") & ~some(*STATED_POINT) & ~some(FOLLOWED),
        (_VERTEX, _ANGLED), _TURNING + "G01 ,A150.\nM8", _TURNING + "G01 ,A150.\nG02 X40. Z-30. R10.", roles=(LINE,),
        alarm=_FANUC_LATHE.alarm("056 (no end point behind a line by its angle alone)")),
    row("fanuc-angles-parallel",
        "{words}: the two lines are parallel to within 1 deg, so the control computes no vertex",
        "correct one of the angles",
        _FANUC_LATHE.source("alarm list; the 1 deg is recalled", Evidence.ASSUMED),
        Parallel(("1:,A", "2:,A"), GUARD) & ~some("1:" + UNGUARDED), _VERTEX, ("120.", "180."), ("120.", "0.5"),
        roles=(LINE_LINE,), alarm=_FANUC_LATHE.alarm("058 (the end of the block is not found)"),
        is_about_geometry=True),
    row("fanuc-angle-redundant", "{words}: the line has both its end and an angle, and the line before has an end",
        "delete the angle",
        _FANUC_LATHE.source("not described", Evidence.ASSUMED), all_of(_FIRST, _SECOND, ",A") & some(STRICT_ANGLE),
        _ANGLED, roles=(LINE,)),
)  # fmt: skip

_NO_VERTEX = row(
    "haas-end-missing",
    "{words} alone does not say where the line ends; this control meets no two lines by their angles", "add X or Z",
    _HAAS_LATHE.source("not described"), some("A") & ~some(*STATED_POINT), _TURNING + "G01 X40. A150.",
    _TURNING + "G01 A150.\nX60. Z-47. A120.", _TURNING + "G01 A150.\nM8", roles=(LINE,),
)  # fmt: skip


def _geometry(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about geometry with a control's alarm and with examples of its own."""
    prefix, cut, turn = machine.prefix, machine.cut, machine.turn
    large: Otherwise = {
        "source": machine.source(_ALARM_LIST), "alarm": machine.alarm("055 MISSING MOVE VALUE IN CHF/CNR"),
    }  # fmt: skip
    meant = "is a rounding between two axes" if machine.is_lathe else "belongs to an arc"
    axes = "A and C are axes" if machine.angle.startswith(",") else "C is an axis"
    angled = f"{_TURNING}G01 X40. {machine.angle}150."
    opposite = told(f"{prefix}-angle-opposite", ReadIssue.ANGLE_OPPOSITE, angled, ("150.", "-30."))
    return (
        told(f"{prefix}-corner-dropped", ReadIssue.CORNER_DROPPED, cut,
             (turn, "Z-40. X20.2" if machine.angle else "X60. Y0.3"),
             source=machine.source("printed for a sibling", Evidence.ASSUMED)),
        told(f"{prefix}-corner-straight", RefusalKind.CORNER_STRAIGHT, cut,
             message="{words}: at {subject} the path goes on, or turns by less than 1 deg, so it is no corner",
             source=machine.source("not described", Evidence.ASSUMED)),
        told(f"{prefix}-comma-missing", ReadIssue.COMMA_MISSING, cut, (",C", "C"),
             help=f"{COMMA_MISSING.help}; without a comma, {axes} and R {meant}",
             source=machine.source("the function")),
        told(f"{prefix}-corner-too-large", RefusalKind.CORNER_TOO_LARGE, cut, (",C5.", ",C31."), **large),
        told(f"{prefix}-corner-reverses", RefusalKind.CORNER_REVERSES, cut, (turn, machine.line.replace("0.", "."))),
        told(f"{prefix}-corners-overlap", RefusalKind.CORNERS_OVERLAP,
             *(_TURNED_TWICE if machine.is_lathe else _MILLED_TWICE), **large),
        *((opposite,) if machine.is_lathe else ()),
    )  # fmt: skip


_ARC_GEOMETRY = (
    told("fanuc-radius-too-small", RefusalKind.RADIUS_TOO_SMALL, _ARC_BEHIND, ("I20. J0", "R10.")),
    told("fanuc-radius-difference", RefusalKind.RADIUS_DIFFERENCE, _ARC_BEHIND, ("I20.", "I18.")),
)

FANUC_LATHE_RULES = (
    *_corner_rules(_FANUC_LATHE),
    *_square_rules(_FANUC_LATHE, "I5.", "K5.", "X40."),
    _straight_only(_FANUC_LATHE),
    *_angle_rules(_FANUC_LATHE),
    *_shared_rules(_FANUC_LATHE),
    *_VERTEX_RULES,
    *_geometry(_FANUC_LATHE),
    *GEOMETRY_RULES,
)
FANUC_MILL_RULES = (
    *_corner_rules(_FANUC_MILL),
    *_square_rules(_FANUC_MILL, "J5.", "I5.", "Y40."),
    *_mill_rules(_FANUC_MILL),
    *_shared_rules(_FANUC_MILL),
    *_geometry(_FANUC_MILL),
    *_ARC_GEOMETRY,
    *GEOMETRY_RULES,
)
HAAS_LATHE_RULES = (
    *_corner_rules(_HAAS_LATHE),
    *_square_rules(_HAAS_LATHE, "I5.", "K5.", "X40."),
    _straight_only(_HAAS_LATHE),
    *_angle_rules(_HAAS_LATHE),
    *_shared_rules(_HAAS_LATHE),
    _NO_VERTEX,
    *_geometry(_HAAS_LATHE),
    *GEOMETRY_RULES,
)
HAAS_MILL_RULES = (
    *_corner_rules(_HAAS_MILL),
    *_mill_rules(_HAAS_MILL),
    *_shared_rules(_HAAS_MILL),
    _straight_only(_HAAS_MILL),
    *_geometry(_HAAS_MILL),
    *GEOMETRY_RULES,
)
