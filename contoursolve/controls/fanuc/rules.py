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
    THREAD,
)
from contoursolve.controls.chain.rules import ExampleWords, Manual, chain_rules
from contoursolve.controls.fanuc.language import (
    ALONG_ARC,
    COMPENSATION_CHANGED,
    COMPENSATION_CHANGES,
    GUARD,
    STRAIGHT_ONLY,
    STRICT_ANGLE,
    SUPPLEMENTARY,
    UNGUARDED,
    WRONG_PLANE,
)
from contoursolve.controls.fanuc.lexicon import CORNERS, DRAWING, HAAS
from contoursolve.controls.geometry_rules import ANGLE_RAPID, GENERAL, GEOMETRY_RULES
from contoursolve.controls.rule_rows import row, with_pages
from contoursolve.diagnostics import Alarm, Book, Evidence, Severity, Source
from contoursolve.reading import AngleAlong, AnglesParallel, Rule, all_of, at_least, some

_ANY = (LINE, OVER_LINE, ARC)
_CORNER = (",C", ",R")
_SIGNED = ("corner-first", "corner-second", "corner-R", "corner-C")
_CORNERS = (*_CORNER, *_SIGNED)
_FIRST, _SECOND = ("first", "first-step"), ("second", "second-step")
_STEPS = ("first-step", "second-step")
_ALARM_LIST = "alarm list"
_NOT_SQUARE = "052 (the block after a corner is not G01, or not at a right angle)"


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
    thread: int = 32
    """The code of a thread."""

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
_FANUC_MILL = _Machine("fanuc", CORNERS, "", True, _MILLING, "X30.", "X40. Y40.", _MILLED_SQUARE, 33)
_HAAS_LATHE = _Machine("haas", HAAS, "A", False, _TURNING, "Z-20.", "X40. Z-30.", _SQUARE)
_HAAS_MILL = _Machine("haas", HAAS, "", False, _MILLING, "X30.", "X40. Y40.", thread=33)

_MILLED_ON_LATHE = "G17 G00 X60. Y-10.\nG01 Y10. ,R3.\nX20. ,C2.\nY-10."
_VERTEX = _TURNING + "G01 ,A180. ,R3.\nX60. Z-47. ,A120."
_ARC_BEHIND = _MILLING + "G01 X40. ,C6.\nG02 X60. Y20. I20. J0"


def _corner_rules(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about ,C and ,R."""
    angle = (machine.angle,) if machine.angle else ()
    cut, two = machine.cut, Alarm("053 TOO MANY ADDRESS COMMANDS", Evidence.ASSUMED)
    return (
        row(f"{machine.prefix}-two-corners", "{words}: a block takes ,C or ,R, not both", "keep one of them",
            machine.source("not described", Evidence.ASSUMED), all_of(*_CORNER), (cut, (",C5.", ",C5. ,R5.")), _ANY,
            alarm=two if machine.has_alarms else None),
        row(f"{machine.prefix}-corner-without-next", "{words}: a corner needs an element after it, and none follows",
            "put the next cutting move right after it, or delete it", machine.source(_ALARM_LIST),
            some(*_CORNERS) & some(LAST) & ~some(RAPID, THREAD),
            ((cut, cut.replace("\n" + machine.turn, "\nG04 P500\n" + machine.turn)),
             ("\n" + machine.turn, "\nM8\n" + machine.turn), ("5.\n", "5.\nG00 ")), _ANY,
            alarm=machine.alarm("051 or 052 (no move, or no cutting move, after a corner)")),
        row(f"{machine.prefix}-thread", "{words}: in a thread the control makes no corner, and no line by its angle",
            "write the corner in a block of its own with G01, or delete it", machine.source(_ALARM_LIST),
            some(*angle, *_CORNER) & some(THREAD), (cut, ("G01", f"G{machine.thread} F1.")), _ANY,
            alarm=machine.alarm("050 (a corner in a thread block)")),
        row(f"{machine.prefix}-corner-alone",
            "{words} stands in a block that moves nothing, so there is no line to cut",
            "write it after the end of the line before", machine.source(_ALARM_LIST, Evidence.DERIVED),
            some(*_CORNERS) & ~some(*STATED_POINT, *angle, "beside-X", "beside-Y", "beside-Z") & ~some(LAST),
            (cut, (" ,C5.", "\n,C5.")), (LINE,),
            alarm=machine.alarm("055 MISSING MOVE VALUE IN CHF/CNR", Evidence.DERIVED)),
        row(f"{machine.prefix}-corner-compensation", "{words}: a block that switches G40, G41 or G42 takes no corner",
            "switch the compensation in a block before", machine.source(_ALARM_LIST),
            some(*_CORNERS) & some(COMPENSATION_CHANGES), ((cut, cut.replace("G00", "G42 G00")), ("G01", "G42 G01")),
            _ANY, alarm=machine.alarm("039 CHF/CNR NOT ALLOWED IN NRC")),
        row(f"{machine.prefix}-center-on-line", "{words}: a line has no centre and no radius",
            "delete it; a rounding is ,R", machine.source("the function", Evidence.DERIVED),
            some(*STATED_CENTER, "wrong-center", "R"), (cut, cut + (" J5." if machine.start == _TURNING else " R5.")),
            (LINE, OVER_LINE)),
    )  # fmt: skip


def _square_rules(machine: _Machine, amount: str, own: str, line: str) -> tuple[Rule, ...]:
    """The rows about corners between a line along one axis and one along the other: `amount` is a right word, `own` one
    of the wrong axis, `line` a line along the other axis."""
    good, angle = machine.square, (machine.angle,) if machine.angle else ()
    lines = (LINE, OVER_LINE) if machine.start == _TURNING else _ANY
    (first, second), is_taper = LEAVES, all_of(_FIRST, _SECOND) | some(*angle)
    letters = "I, K or R" if machine.start == _TURNING else "I, J, K or C"
    listed, prefix = machine.source(_ALARM_LIST), machine.prefix
    return (
        row(f"{prefix}-two-amounts", "{words}: a block takes one corner word", "keep one of them", listed,
            at_least(2, *_CORNERS) & some(*_SIGNED), (good, (amount, f"{amount} {own}")), lines[:2],
            alarm=machine.alarm("053 TOO MANY ADDRESS COMMANDS")),
        row(f"{prefix}-corner-taper", f"{{words}}: a corner by {letters} stands after a line along one axis",
            "write ,C or ,R", listed, some(*_SIGNED) & is_taper, (good, (amount, f"{line} {amount}")), lines[:2],
            alarm=machine.alarm("054 (taper with a chamfer or a rounding)")),
        row(f"{prefix}-chamfer-letter", "{words}: such a chamfer is stated along the axis of the next line",
            "write the letter of that axis: I for X, J for Y, K for Z",
            machine.source("letters of each axis", Evidence.ASSUMED),
            ((some("corner-first") & some(*_FIRST)) | (some("corner-second") & some(*_SECOND)))
            & ~is_taper & ~at_least(2, *_CORNERS), (good, (amount, own)), lines[:2]),
        row(f"{prefix}-corner-not-square",
            f"after a corner by {letters} the next line must run along the other axis alone",
            "write ,C or ,R for another corner", listed,
            (some(first) & (~some(*_FIRST) | some(*_SECOND, *angle)))
            | (some(second) & (~some(*_SECOND) | some(*_FIRST, *angle))),
            (good, (line, machine.turn), (line, machine.line.replace("0.", "5."))), lines,
            alarm=machine.alarm(_NOT_SQUARE)),
        row(f"{prefix}-corner-sign", like=GENERAL, source=machine.source(_ALARM_LIST, Evidence.DERIVED),
            examples=(good, (amount, f"{amount[0]}-{amount[1:]}")),
            alarm=machine.alarm(_NOT_SQUARE, Evidence.DERIVED)),
    )  # fmt: skip


def _start_up(machine: _Machine) -> Rule:
    """The row about a corner in the first move behind a block with G40, G41 or G42 alone."""
    switched = machine.cut.replace("G01", "G42\nG01")
    short = machine.line.replace("20.", "5.").replace("30.", "5.")
    return row(
        f"{machine.prefix}-corner-start-up",
        "{words}: this is the first move since G40, G41 or G42, and the move that switches takes no corner",
        "put a move without a corner between them",
        machine.source("alarm 039 is printed; that the next move starts or ends it is recalled", Evidence.ASSUMED),
        some(*_CORNERS) & some(COMPENSATION_CHANGED),
        (
            (machine.cut, switched.replace("G01 ", f"G01 {short}\n")),
            switched,
            switched.replace("G42", "G42\nM8"),
            switched.replace("G00", "G42 G00").replace("\nG42", "\nG40"),
        ),
        _ANY,
        alarm=machine.alarm("039 CHF/CNR NOT ALLOWED IN NRC", Evidence.ASSUMED),
    )


_RADIUS_WINS = "printed for lathes: 16/18-C p. 67"
_ARC_ROWS = (
    *(
        row(f"fanuc-{order}-centre-ignored", "{words} is ignored: R says where the centre is{comparison}",
            "delete {words}, or delete R", _FANUC_MILL.source(_RADIUS_WINS, Evidence.DERIVED),
            some(word) & some("R") & some(*STATED_POINT),
            ((_ARC_BEHIND, _ARC_BEHIND.replace("I20. J0", "R20.")), ("J0", "J0 R20."), (other, "R20.")), (ARC,),
            severity=Severity.WARNING, ignores=word)
        for order, word, other in (("first", "center-first", " J0"), ("second", "center-second", "I20."))
    ),
    row("fanuc-radius-without-end",
        "{words}: without an end the arc moves nothing, and a corner needs a move on both sides",
        "add the coordinates of its end, or give the centre instead",
        _FANUC_MILL.source(f"{_RADIUS_WINS}; alarm list", Evidence.DERIVED), some("R") & ~some(*STATED_POINT),
        (_ARC_BEHIND, ("X60. Y20. I20. J0", "R20.")), (ARC,),
        alarm=_FANUC_MILL.alarm("051 (no move after a corner) or 055 (no move before it)", Evidence.DERIVED)),
)  # fmt: skip
_ALONG_ARC = (
    row("fanuc-chamfer-along-arc", "{words}: a chamfer that is measured along an arc is not computed",
        "set chamfer-on-arc=chord, or write the chamfer out", _FANUC_MILL.source("not described", Evidence.ASSUMED),
        some(",C") & some(ALONG_ARC) & some(BESIDE_ARC), _FANUC_MILL.cut, _ANY),
)  # fmt: skip


def _mill_rules(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about planes and arcs."""
    cut = machine.cut
    beside = "Y5." if machine.start == _TURNING else "Z-5."
    return (
        *(_ALONG_ARC if machine.has_alarms else ()),
        row(f"{machine.prefix}-corner-outside-plane", "{words} moves an axis outside the plane of the contour",
            "move that axis in a block of its own, or select its plane by G17, G18 or G19",
            machine.source("only in the selected plane"), some("beside-X", "beside-Y", "beside-Z"),
            (cut, (machine.line, f"{machine.line} {beside}")), _ANY),
    )  # fmt: skip


def _shared_rules(machine: _Machine) -> Iterator[Rule]:
    """The rows that controls share."""
    is_lathe, is_haas_lathe = machine.start == _TURNING, machine is _HAAS_LATHE
    manual = machine.source("arcs", Evidence.ASSUMED)
    sources = {
        "corner-rapid": machine.source("the function", Evidence.DERIVED),
        "corner-negative": machine.source("not described", Evidence.ASSUMED),
        "plane-changes": machine.source("not after a plane change"),
        "angle-range": machine.source("not described", Evidence.ASSUMED),
        "zero-moves": machine.source("not after a change of the coordinate system", Evidence.ASSUMED),
    }
    shared = Manual(
        prefix=machine.prefix,
        source=manual,
        angle=machine.angle,
        chamfers=(",C",),
        rounding=",R",
        radius="R",
        examples=ExampleWords(
            start=machine.start,
            angle=machine.angle,
            corner=",R",
            end="X40.",
            degrees="150.",
            opening="180.",
            closing="120.",
            closing_end="X60. Z-47.",
            before=machine.line,
            turn=machine.turn,
            before_arc="G01 X40. ,C6.",
            arc_end="X60. Y20.",
            center="I20. J0",
            radius="R20.",
            size="5.",
            arc_code="G02",
        ),
        sources=sources,
        alarms={"circle-undefined": Alarm("022 R OR I,J,K COMMAND NOT FOUND", Evidence.PRINTED)}
        if machine.has_alarms
        else {},
    )
    clash = ("center-and-radius", "radius-without-end")
    arcs = ("circle-undefined", *(() if machine.has_alarms else clash))
    wanted = (
        "corner-rapid",
        "corner-negative",
        "zero-moves",
        *(("angle-range",) if is_lathe else ("plane-changes", *arcs)),
        *(("plane-changes",) if is_haas_lathe else ()),
    )
    for rule in chain_rules(shared):
        code = rule.code.removeprefix(f"{machine.prefix}-")
        if code in wanted and code in arcs and rule.when is not None and not machine.has_alarms:
            # A setting allows corners beside arcs.
            yield row(rule.code, like=rule, finds=rule.when & ~some(STRAIGHT_ONLY), examples=machine.cut)
        elif code == "plane-changes" and is_haas_lathe:
            yield replace(rule, rejected=(_MILLED_ON_LATHE.replace("X20.", "G18 X20."),))
        elif code in wanted:
            yield rule


def _straight_only(machine: _Machine) -> Rule:
    """The row that forbids corners beside arcs."""
    is_lathe = machine.start == _TURNING
    arc = "G02 X40. Z-30. R10." if is_lathe else "G02 X40. Y10. R10."
    return row(
        f"{machine.prefix}-arc",
        "{words}: this control makes corners between lines alone, and this is an arc",
        "end the contour before the arc, or write its lines and corners out"
        + ("; for a classic control, set haas-mill.generation=classic" if machine is _HAAS_MILL else ""),
        machine.source("block patterns; alarm list" if is_lathe else "corners between two lines"),
        some(*STATED_POINT, *STATED_CENTER, "R", *_CORNER) & some(STRAIGHT_ONLY),
        (machine.cut, (machine.turn, arc)),
        (ARC,),
        alarm=machine.alarm("052 (the block after a corner is not G01)"),
    )


def _angle_rules(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about a line by its angle and one coordinate, on a lathe."""
    angle = machine.angle
    good = f"{machine.start}G01 X40. {angle}150."
    message, when = "the contour is not in the plane of Z and X", some(WRONG_PLANE)
    others: tuple[str, ...] = ()
    if not machine.has_alarms:
        message = "{words}: the control works out lines by angles in the plane of Z and X alone"
        when, others = when & some(angle), (_MILLED_ON_LATHE,)
    return (
        row(f"{machine.prefix}-plane", message, "write G18 before it", machine.source(_ALARM_LIST), when,
            ((good, "G18 " + good, *others), "G17 " + good), _ANY, alarm=machine.alarm("212 ILLEGAL PLANE SELECT")),
        row(f"{machine.prefix}-angle-rapid", ANGLE_RAPID, "write G01",
            machine.source("block patterns", Evidence.DERIVED), some(angle) & some(RAPID), (good, ("G01 ", "")),
            (LINE, OVER_LINE)),
        row(f"{machine.prefix}-angle-along-z",
            "{words}: the line runs along Z to within 1 deg, so X does not say where it ends", "give its end by Z",
            machine.source("alarm list; the 1 deg is recalled", Evidence.ASSUMED),
            some(*_SECOND) & ~some(*_FIRST) & AngleAlong((angle,), 0, GUARD) & ~some(UNGUARDED),
            (good, ("150.", "180."), ("150.", "179.5")), (LINE,), alarm=machine.alarm("057 NO SOLUTION OF BLOCK END"),
            is_about_geometry=True),
        row(f"{machine.prefix}-angle-along-x",
            "{words}: the line runs along X to within 1 deg, so Z does not say where it ends", "give its end by X",
            machine.source("alarm list; the 1 deg is recalled", Evidence.ASSUMED),
            some(*_FIRST) & ~some(*_SECOND) & AngleAlong((angle,), 90, GUARD) & ~some(UNGUARDED),
            (good, f"{machine.start}G01 Z-20. {angle}90."), (LINE,),
            alarm=machine.alarm("057 NO SOLUTION OF BLOCK END"), is_about_geometry=True),
    )  # fmt: skip


_ANGLED = _TURNING + "G01 X40. ,A150."

_VERTEX_RULES = (
    row("fanuc-angle-supplementary",
        "{words}: with angle=supplementary it stands for 180 deg minus itself, which is not computed",
        "write 180 minus the number, and leave the setting at normal",
        _FANUC_LATHE.source("another bit of parameter 3405, recalled", Evidence.ASSUMED),
        some(",A") & some(SUPPLEMENTARY), _VERTEX, (LINE, OVER_LINE)),
    row("fanuc-closing-incomplete",
        "the line before has an angle and no end, so this block needs X, Z and ,A: it lacks {lacking}", "add {lacking}",
        _FANUC_LATHE.source("block patterns 2 to 8"), ~all_of("first", "second", ",A") & ~some(*_STEPS),
        (_VERTEX, *((word, "") for word in (" ,A120.", " Z-47.", "X60. "))), (OVER_LINE,),
        alarm=_FANUC_LATHE.alarm("056 (no end point, or no angle, after a line by its angle alone)")),
    row("fanuc-closing-increment", "{words}: after a line by its angle alone, X and Z give the end, not U and W",
        "give the end of this line by X and Z", _FANUC_LATHE.source("block patterns 2 to 8: X and Z are absolute"),
        some(*_STEPS), (_VERTEX, ("Z-47.", "W-47."), ("X60. Z-47.", "U40. W-47.")), (OVER_LINE,),
        alarm=_FANUC_LATHE.alarm("056 (no end point after a line by its angle alone)")),
    row("fanuc-end-missing", "{words} alone does not say where the line ends",
        "add X or Z; or let a line with X, Z and ,A follow, which it meets",
        _FANUC_LATHE.source("block patterns 1 and 2"), some(",A") & ~some(*STATED_POINT) & ~some(FOLLOWED),
        ((_VERTEX, _ANGLED), _TURNING + "G01 ,A150.\nM8", _TURNING + "G01 ,A150.\nG02 X40. Z-30. R10."), (LINE,),
        alarm=_FANUC_LATHE.alarm("056 (no end point after a line by its angle alone)")),
    row("fanuc-angles-parallel",
        "{words}: the two lines are parallel to within 1 deg, so the control computes no vertex",
        "correct one of the angles", _FANUC_LATHE.source("alarm list; the 1 deg is recalled", Evidence.ASSUMED),
        AnglesParallel(("1:,A", "2:,A"), GUARD) & ~some("1:" + UNGUARDED), (_VERTEX, ("120.", "180."), ("120.", "0.5")),
        (LINE_LINE,), alarm=_FANUC_LATHE.alarm("058 END POINT NOT FOUND"), is_about_geometry=True),
    row("fanuc-angle-redundant", "{words}: the line has both its end and an angle, and the line before has an end",
        "delete the angle", _FANUC_LATHE.source("not described", Evidence.ASSUMED),
        all_of(_FIRST, _SECOND, ",A") & some(STRICT_ANGLE), _ANGLED, (LINE,)),
)  # fmt: skip

_NO_VERTEX = row(
    "haas-end-missing",
    "{words} alone does not say where the line ends; this control meets no two lines by their angles",
    "add X or Z",
    _HAAS_LATHE.source("not described"),
    some("A") & ~some(*STATED_POINT),
    (_TURNING + "G01 X40. A150.", _TURNING + "G01 A150.\nX60. Z-47. A120.", _TURNING + "G01 A150.\nM8"),
    (LINE,),
)


def _geometry(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about geometry with a control's alarm and with examples of its own."""
    prefix, cut, is_lathe = machine.prefix, machine.cut, machine.start == _TURNING
    listed, no_room = machine.source(_ALARM_LIST), machine.alarm("055 MISSING MOVE VALUE IN CHF/CNR")
    meant = "is a rounding between two axes" if is_lathe else "belongs to an arc"
    axes = "A and C are axes" if machine.angle.startswith(",") else "C is an axis"
    twice = _TURNED_TWICE if is_lathe else _MILLED_TWICE
    rows = (
        row(f"{prefix}-corner-dropped", like=GENERAL, source=machine.source("printed for a sibling", Evidence.ASSUMED),
            examples=(cut, (machine.turn, "Z-40. X20.2" if is_lathe else "X60. Y0.3"))),
        row(f"{prefix}-corner-straight", like=GENERAL,
            message="{words}: at {subject} the path goes on, or turns by less than 1 deg, so it is no corner",
            source=machine.source("not described", Evidence.ASSUMED), examples=cut),
        row(f"{prefix}-comma-missing", like=GENERAL,
            help=f"{GENERAL['comma-missing'].help}; without a comma, {axes} and R {meant}",
            source=machine.source("the function"), examples=(cut, (",C", "C"))),
        row(f"{prefix}-corner-too-large", like=GENERAL, source=listed, examples=(cut, (",C5.", ",C31.")),
            alarm=no_room),
        row(f"{prefix}-corner-reverses", like=GENERAL,
            examples=(cut, (machine.turn, machine.line.replace("0.", ".")))),
        row(f"{prefix}-corners-overlap", like=GENERAL, source=listed, examples=twice, alarm=no_room),
    )  # fmt: skip
    angled = f"{_TURNING}G01 X40. {machine.angle}150."
    opposite = row(f"{prefix}-angle-opposite", like=GENERAL, examples=(angled, ("150.", "-30.")))
    return (*rows, opposite) if is_lathe else rows


_MILLED_TWICE = (_MILLING + "G01 X30. ,C10.\nY30. ,C10.\nX60.", ("10.", "20."))
_TURNED_TWICE = (_TURNING + "G01 Z-20. ,R8.\nX40. ,C2.\nZ-50.", ("R8.", "R9."))
_MILLED_ARCS = (
    row("fanuc-radius-too-small", like=GENERAL, examples=(_ARC_BEHIND, ("I20. J0", "R10."))),
    row("fanuc-radius-difference", like=GENERAL, examples=(_ARC_BEHIND, ("I20.", "I18."))),
)

_30I = "30i/31i/32i B-63944EN-1/02 p. 118"
_FANUC_LATHE_PAGES = {"fanuc-chamfer-letter": _30I}
_FANUC_MILL_PAGES = {"fanuc-chamfer-letter": _30I, "fanuc-circle-undefined": "alarm list: 22"}
_HAAS_LATHE_PAGES = dict.fromkeys(
    ("haas-comma-missing", "haas-corner-without-next"), "classic lathe, corner rounding and chamfering example"
)
_HAAS_MILL_PAGES = {
    "haas-arc": "mill NGC (2017) p. 250",
    "haas-corner-outside-plane": "mill NGC (2017) p. 251",
    "haas-corner-without-next": "mill NGC (2017) p. 250",
    "haas-comma-missing": "mill NGC (2017) p. 249",
}
"""The sentence of a page, by the codes of rules."""

FANUC_LATHE_RULES = with_pages(
    (
        *_corner_rules(_FANUC_LATHE),
        _start_up(_FANUC_LATHE),
        *_square_rules(_FANUC_LATHE, "I5.", "K5.", "X40."),
        _straight_only(_FANUC_LATHE),
        *_angle_rules(_FANUC_LATHE),
        *_shared_rules(_FANUC_LATHE),
        *_VERTEX_RULES,
        *_geometry(_FANUC_LATHE),
        *GEOMETRY_RULES,
    ),
    DRAWING,
    _FANUC_LATHE_PAGES,
)
FANUC_MILL_RULES = with_pages(
    (
        *_corner_rules(_FANUC_MILL),
        _start_up(_FANUC_MILL),
        *_square_rules(_FANUC_MILL, "J5.", "I5.", "Y40."),
        *_mill_rules(_FANUC_MILL),
        *_ARC_ROWS,
        *_shared_rules(_FANUC_MILL),
        *_geometry(_FANUC_MILL),
        *_MILLED_ARCS,
        *GEOMETRY_RULES,
    ),
    CORNERS,
    _FANUC_MILL_PAGES,
)
HAAS_LATHE_RULES = with_pages(
    (
        *_corner_rules(_HAAS_LATHE),
        *_square_rules(_HAAS_LATHE, "I5.", "K5.", "X40."),
        _straight_only(_HAAS_LATHE),
        *_mill_rules(_HAAS_LATHE),
        *_angle_rules(_HAAS_LATHE),
        *_shared_rules(_HAAS_LATHE),
        _NO_VERTEX,
        *_geometry(_HAAS_LATHE),
        *GEOMETRY_RULES,
    ),
    HAAS,
    _HAAS_LATHE_PAGES,
)
HAAS_MILL_RULES = with_pages(
    (
        *_corner_rules(_HAAS_MILL),
        *_mill_rules(_HAAS_MILL),
        *_shared_rules(_HAAS_MILL),
        _straight_only(_HAAS_MILL),
        *_geometry(_HAAS_MILL),
        *GEOMETRY_RULES,
    ),
    HAAS,
    _HAAS_MILL_PAGES,
)
