"""Fanuc and Haas: which words may be combined, and what has no solution."""

from collections.abc import Iterator, Mapping
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
from contoursolve.controls.geometry_rules import ANGLE_RAPID, COMMA_MISSING, GEOMETRY_RULES, Otherwise, told
from contoursolve.controls.rule_rows import with_pages
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
        Rule(
            code=f"{machine.prefix}-two-corners",
            message="{words}: a block takes ,C or ,R, not both",
            help="keep one of them",
            source=machine.source("not described", Evidence.ASSUMED),
            alarm=two if machine.has_alarms else None,
            roles=_ANY,
            when=all_of(*_CORNER),
            accepted=(cut,),
            rejected=(cut.replace(",C5.", ",C5. ,R5."),),
        ),
        Rule(
            code=f"{machine.prefix}-corner-without-next",
            message="{words}: a corner needs an element after it, and none follows",
            help="put the next cutting move right after it, or delete it",
            source=machine.source(_ALARM_LIST),
            alarm=machine.alarm("051 or 052 (no move, or no cutting move, after a corner)"),
            roles=_ANY,
            when=some(*_CORNERS) & some(LAST) & ~some(RAPID, THREAD),
            accepted=(cut, cut.replace("\n" + machine.turn, "\nG04 P500\n" + machine.turn)),
            rejected=(cut.replace("\n" + machine.turn, "\nM8\n" + machine.turn), cut.replace("5.\n", "5.\nG00 ")),
        ),
        Rule(
            code=f"{machine.prefix}-thread",
            message="{words}: in a thread the control makes no corner, and no line by its angle",
            help="write the corner in a block of its own with G01, or delete it",
            source=machine.source(_ALARM_LIST),
            alarm=machine.alarm("050 (a corner in a thread block)"),
            roles=_ANY,
            when=some(*angle, *_CORNER) & some(THREAD),
            accepted=(cut,),
            rejected=(cut.replace("G01", f"G{machine.thread} F1."),),
        ),
        Rule(
            code=f"{machine.prefix}-corner-alone",
            message="{words} stands in a block that moves nothing, so there is no line to cut",
            help="write it after the end of the line before",
            source=machine.source(_ALARM_LIST, Evidence.DERIVED),
            alarm=machine.alarm("055 MISSING MOVE VALUE IN CHF/CNR", Evidence.DERIVED),
            roles=(LINE,),
            when=some(*_CORNERS) & ~some(*STATED_POINT, *angle, "beside-X", "beside-Y", "beside-Z") & ~some(LAST),
            accepted=(cut,),
            rejected=(cut.replace(" ,C5.", "\n,C5."),),
        ),
        Rule(
            code=f"{machine.prefix}-corner-compensation",
            message="{words}: a block that switches G40, G41 or G42 takes no corner",
            help="switch the compensation in a block before",
            source=machine.source(_ALARM_LIST),
            alarm=machine.alarm("039 CHF/CNR NOT ALLOWED IN NRC"),
            roles=_ANY,
            when=some(*_CORNERS) & some(COMPENSATION_CHANGES),
            accepted=(cut, cut.replace("G00", "G42 G00")),
            rejected=(cut.replace("G01", "G42 G01"),),
        ),
        Rule(
            code=f"{machine.prefix}-center-on-line",
            message="{words}: a line has no centre and no radius",
            help="delete it; a rounding is ,R",
            source=machine.source("the function", Evidence.DERIVED),
            roles=(LINE, OVER_LINE),
            when=some(*STATED_CENTER, "wrong-center", "R"),
            accepted=(cut,),
            rejected=(cut + (" J5." if machine.start == _TURNING else " R5."),),
        ),
    )


def _square_rules(machine: _Machine, amount: str, own: str, line: str) -> tuple[Rule, ...]:
    """The rows about corners between a line along one axis and one along the other: `amount` is a right word, `own` one
    of the wrong axis, `line` a line along the other axis."""
    good, angle = machine.square, (machine.angle,) if machine.angle else ()
    lines = (LINE, OVER_LINE) if machine.start == _TURNING else _ANY
    (first, second), is_taper = LEAVES, all_of(_FIRST, _SECOND) | some(*angle)
    letters = "I, K or R" if machine.start == _TURNING else "I, J, K or C"
    rows = (
        (
            "two-amounts",
            "{words}: a block takes one corner word",
            "keep one of them",
            "053 TOO MANY ADDRESS COMMANDS",
            at_least(2, *_CORNERS) & some(*_SIGNED),
            lines[:2],
            (good.replace(amount, f"{amount} {own}"),),
        ),
        (
            "corner-taper",
            f"{{words}}: a corner by {letters} stands after a line along one axis",
            "write ,C or ,R",
            "054 (taper with a chamfer or a rounding)",
            some(*_SIGNED) & is_taper,
            lines[:2],
            (good.replace(amount, f"{line} {amount}"),),
        ),
        (
            "chamfer-letter",
            "{words}: such a chamfer is stated along the axis of the next line",
            "write the letter of that axis: I for X, J for Y, K for Z",
            "",
            ((some("corner-first") & some(*_FIRST)) | (some("corner-second") & some(*_SECOND)))
            & ~is_taper
            & ~at_least(2, *_CORNERS),
            lines[:2],
            (good.replace(amount, own),),
        ),
        (
            "corner-not-square",
            f"after a corner by {letters} the next line must run along the other axis alone",
            "write ,C or ,R for another corner",
            _NOT_SQUARE,
            (some(first) & (~some(*_FIRST) | some(*_SECOND, *angle)))
            | (some(second) & (~some(*_SECOND) | some(*_FIRST, *angle))),
            lines,
            (good.replace(line, machine.turn), good.replace(line, machine.line.replace("0.", "5."))),
        ),
    )
    own_rows = (
        Rule(
            code=f"{machine.prefix}-{code}",
            message=message,
            help=advice,
            source=machine.source(_ALARM_LIST) if alarm else machine.source("letters of each axis", Evidence.ASSUMED),
            alarm=machine.alarm(alarm) if alarm else None,
            roles=roles,
            when=when,
            accepted=(good,),
            rejected=rejected,
        )
        for code, message, advice, alarm, when, roles, rejected in rows
    )
    sign = told(
        f"{machine.prefix}-corner-sign",
        good,
        (amount, f"{amount[0]}-{amount[1:]}"),
        source=machine.source(_ALARM_LIST, Evidence.DERIVED),
        alarm=machine.alarm(_NOT_SQUARE, Evidence.DERIVED),
    )
    return (*own_rows, sign)


def _start_up(machine: _Machine) -> Rule:
    """The row about a corner in the first move behind a block with G40, G41 or G42 alone."""
    switched = machine.cut.replace("G01", "G42\nG01")
    short = machine.line.replace("20.", "5.").replace("30.", "5.")
    return Rule(
        code=f"{machine.prefix}-corner-start-up",
        message="{words}: this is the first move since G40, G41 or G42, and the move that switches takes no corner",
        help="put a move without a corner between them",
        source=machine.source(
            "alarm 039 is printed; that the next move starts or ends it is recalled", Evidence.ASSUMED
        ),
        alarm=machine.alarm("039 CHF/CNR NOT ALLOWED IN NRC", Evidence.ASSUMED),
        roles=_ANY,
        when=some(*_CORNERS) & some(COMPENSATION_CHANGED),
        accepted=(machine.cut, switched.replace("G01 ", f"G01 {short}\n")),
        rejected=(
            switched,
            switched.replace("G42", "G42\nM8"),
            switched.replace("G00", "G42 G00").replace("\nG42", "\nG40"),
        ),
    )


_RADIUS_WINS = "printed for lathes: 16/18-C p. 67"
_ARC_ROWS = (
    *(
        Rule(
            code=f"fanuc-{order}-centre-ignored",
            message="{words} is ignored: R says where the centre is{comparison}",
            help="delete {words}, or delete R",
            source=_FANUC_MILL.source(_RADIUS_WINS, Evidence.DERIVED),
            severity=Severity.WARNING,
            roles=(ARC,),
            when=some(word) & some("R") & some(*STATED_POINT),
            ignores=word,
            accepted=(_ARC_BEHIND, _ARC_BEHIND.replace("I20. J0", "R20.")),
            rejected=(_ARC_BEHIND.replace("J0", "J0 R20."), _ARC_BEHIND.replace(other, "R20.")),
        )
        for order, word, other in (("first", "center-first", " J0"), ("second", "center-second", "I20."))
    ),
    Rule(
        code="fanuc-radius-without-end",
        message="{words}: without an end the arc moves nothing, and a corner needs a move on both sides",
        help="add the coordinates of its end, or give the centre instead",
        source=_FANUC_MILL.source(f"{_RADIUS_WINS}; alarm list", Evidence.DERIVED),
        alarm=_FANUC_MILL.alarm("051 (no move after a corner) or 055 (no move before it)", Evidence.DERIVED),
        roles=(ARC,),
        when=some("R") & ~some(*STATED_POINT),
        accepted=(_ARC_BEHIND,),
        rejected=(_ARC_BEHIND.replace("X60. Y20. I20. J0", "R20."),),
    ),
)
_ALONG_ARC = (
    Rule(
        code="fanuc-chamfer-along-arc",
        message="{words}: a chamfer that is measured along an arc is not computed",
        help="set chamfer-on-arc=chord, or write the chamfer out",
        source=_FANUC_MILL.source("not described", Evidence.ASSUMED),
        roles=_ANY,
        when=some(",C") & some(ALONG_ARC) & some(BESIDE_ARC),
        accepted=(_FANUC_MILL.cut,),
        rejected=(),
    ),
)


def _mill_rules(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about planes and arcs."""
    cut = machine.cut
    beside = "Y5." if machine.start == _TURNING else "Z-5."
    return (
        *(_ALONG_ARC if machine.has_alarms else ()),
        Rule(
            code=f"{machine.prefix}-corner-outside-plane",
            message="{words} moves an axis outside the plane of the contour",
            help="move that axis in a block of its own, or select its plane by G17, G18 or G19",
            source=machine.source("only in the selected plane"),
            roles=_ANY,
            when=some("beside-X", "beside-Y", "beside-Z"),
            accepted=(cut,),
            rejected=(cut.replace(machine.line, f"{machine.line} {beside}"),),
        ),
    )


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
            yield replace(rule, when=rule.when & ~some(STRAIGHT_ONLY), accepted=(machine.cut,), rejected=())
        elif code == "plane-changes" and is_haas_lathe:
            yield replace(rule, rejected=(_MILLED_ON_LATHE.replace("X20.", "G18 X20."),))
        elif code in wanted:
            yield rule


def _straight_only(machine: _Machine) -> Rule:
    """The row that forbids corners beside arcs."""
    is_lathe = machine.start == _TURNING
    arc = "G02 X40. Z-30. R10." if is_lathe else "G02 X40. Y10. R10."
    return Rule(
        code=f"{machine.prefix}-arc",
        message="{words}: this control makes corners between lines alone, and this is an arc",
        help="end the contour before the arc, or write its lines and corners out"
        + ("; for a classic control, set haas-mill.generation=classic" if machine is _HAAS_MILL else ""),
        source=machine.source("block patterns; alarm list" if is_lathe else "corners between two lines"),
        alarm=machine.alarm("052 (the block after a corner is not G01)"),
        roles=(ARC,),
        when=some(*STATED_POINT, *STATED_CENTER, "R", *_CORNER) & some(STRAIGHT_ONLY),
        accepted=(machine.cut,),
        rejected=(machine.cut.replace(machine.turn, arc),),
    )


def _angle_rules(machine: _Machine) -> tuple[Rule, ...]:
    """The rows about a line by its angle and one coordinate, on a lathe."""
    angle = machine.angle
    good = f"{machine.start}G01 X40. {angle}150."
    return (
        Rule(
            code=f"{machine.prefix}-plane",
            message="the contour is not in the plane of Z and X"
            if machine.has_alarms
            else "{words}: the control works out lines by angles in the plane of Z and X alone",
            help="write G18 before it",
            source=machine.source(_ALARM_LIST),
            alarm=machine.alarm("212 ILLEGAL PLANE SELECT"),
            roles=_ANY,
            when=some(WRONG_PLANE) if machine.has_alarms else some(WRONG_PLANE) & some(angle),
            accepted=(good, "G18 " + good) if machine.has_alarms else (good, "G18 " + good, _MILLED_ON_LATHE),
            rejected=("G17 " + good,),
        ),
        Rule(
            code=f"{machine.prefix}-angle-rapid",
            message=ANGLE_RAPID,
            help="write G01",
            source=machine.source("block patterns", Evidence.DERIVED),
            roles=(LINE, OVER_LINE),
            when=some(angle) & some(RAPID),
            accepted=(good,),
            rejected=(good.replace("G01 ", ""),),
        ),
        Rule(
            code=f"{machine.prefix}-angle-along-z",
            message="{words}: the line runs along Z to within 1 deg, so X does not say where it ends",
            help="give its end by Z",
            source=machine.source("alarm list; the 1 deg is recalled", Evidence.ASSUMED),
            alarm=machine.alarm("057 NO SOLUTION OF BLOCK END"),
            roles=(LINE,),
            is_about_geometry=True,
            when=some(*_SECOND) & ~some(*_FIRST) & AngleAlong((angle,), 0, GUARD) & ~some(UNGUARDED),
            accepted=(good,),
            rejected=(good.replace("150.", "180."), good.replace("150.", "179.5")),
        ),
        Rule(
            code=f"{machine.prefix}-angle-along-x",
            message="{words}: the line runs along X to within 1 deg, so Z does not say where it ends",
            help="give its end by X",
            source=machine.source("alarm list; the 1 deg is recalled", Evidence.ASSUMED),
            alarm=machine.alarm("057 NO SOLUTION OF BLOCK END"),
            roles=(LINE,),
            is_about_geometry=True,
            when=some(*_FIRST) & ~some(*_SECOND) & AngleAlong((angle,), 90, GUARD) & ~some(UNGUARDED),
            accepted=(good,),
            rejected=(f"{machine.start}G01 Z-20. {angle}90.",),
        ),
    )


_ANGLED = _TURNING + "G01 X40. ,A150."

_VERTEX_RULES = (
    Rule(
        code="fanuc-angle-supplementary",
        message="{words}: with angle=supplementary it stands for 180 deg minus itself, which is not computed",
        help="write 180 minus the number, and leave the setting at normal",
        source=_FANUC_LATHE.source("another bit of parameter 3405, recalled", Evidence.ASSUMED),
        roles=(LINE, OVER_LINE),
        when=some(",A") & some(SUPPLEMENTARY),
        accepted=(_VERTEX,),
        rejected=(),
    ),
    Rule(
        code="fanuc-closing-incomplete",
        message="the line before has an angle and no end, so this block needs X, Z and ,A: it lacks {lacking}",
        help="add {lacking}",
        source=_FANUC_LATHE.source("block patterns 2 to 8"),
        alarm=_FANUC_LATHE.alarm("056 (no end point, or no angle, after a line by its angle alone)"),
        roles=(OVER_LINE,),
        when=~all_of("first", "second", ",A") & ~some(*_STEPS),
        accepted=(_VERTEX,),
        rejected=tuple(_VERTEX.replace(word, "") for word in (" ,A120.", " Z-47.", "X60. ")),
    ),
    Rule(
        code="fanuc-closing-increment",
        message="{words}: after a line by its angle alone, X and Z give the end, not U and W",
        help="give the end of this line by X and Z",
        source=_FANUC_LATHE.source("block patterns 2 to 8: X and Z are absolute"),
        alarm=_FANUC_LATHE.alarm("056 (no end point after a line by its angle alone)"),
        roles=(OVER_LINE,),
        when=some(*_STEPS),
        accepted=(_VERTEX,),
        rejected=(_VERTEX.replace("Z-47.", "W-47."), _VERTEX.replace("X60. Z-47.", "U40. W-47.")),
    ),
    Rule(
        code="fanuc-end-missing",
        message="{words} alone does not say where the line ends",
        help="add X or Z; or let a line with X, Z and ,A follow, which it meets",
        source=_FANUC_LATHE.source("block patterns 1 and 2"),
        alarm=_FANUC_LATHE.alarm("056 (no end point after a line by its angle alone)"),
        roles=(LINE,),
        when=some(",A") & ~some(*STATED_POINT) & ~some(FOLLOWED),
        accepted=(_VERTEX, _ANGLED),
        rejected=(_TURNING + "G01 ,A150.\nM8", _TURNING + "G01 ,A150.\nG02 X40. Z-30. R10."),
    ),
    Rule(
        code="fanuc-angles-parallel",
        message="{words}: the two lines are parallel to within 1 deg, so the control computes no vertex",
        help="correct one of the angles",
        source=_FANUC_LATHE.source("alarm list; the 1 deg is recalled", Evidence.ASSUMED),
        alarm=_FANUC_LATHE.alarm("058 END POINT NOT FOUND"),
        roles=(LINE_LINE,),
        is_about_geometry=True,
        when=AnglesParallel(("1:,A", "2:,A"), GUARD) & ~some("1:" + UNGUARDED),
        accepted=(_VERTEX,),
        rejected=(_VERTEX.replace("120.", "180."), _VERTEX.replace("120.", "0.5")),
    ),
    Rule(
        code="fanuc-angle-redundant",
        message="{words}: the line has both its end and an angle, and the line before has an end",
        help="delete the angle",
        source=_FANUC_LATHE.source("not described", Evidence.ASSUMED),
        roles=(LINE,),
        when=all_of(_FIRST, _SECOND, ",A") & some(STRICT_ANGLE),
        accepted=(_ANGLED,),
        rejected=(),
    ),
)

_NO_VERTEX = Rule(
    code="haas-end-missing",
    message="{words} alone does not say where the line ends; this control meets no two lines by their angles",
    help="add X or Z",
    source=_HAAS_LATHE.source("not described"),
    roles=(LINE,),
    when=some("A") & ~some(*STATED_POINT),
    accepted=(_TURNING + "G01 X40. A150.",),
    rejected=(_TURNING + "G01 A150.\nX60. Z-47. A120.", _TURNING + "G01 A150.\nM8"),
)


def _geometry(machine: _Machine, examples: Mapping[str, tuple[str, str]]) -> tuple[Rule, ...]:
    """The rows about geometry with a control's alarm and with examples of its own, by the ends of their codes."""
    dropped = told(
        f"{machine.prefix}-corner-dropped",
        machine.cut,
        (machine.turn, "Z-40. X20.2" if machine.angle else "X60. Y0.3"),
        source=machine.source("printed for a sibling", Evidence.ASSUMED),
    )
    straight = told(
        f"{machine.prefix}-corner-straight",
        machine.cut,
        message="{words}: at {subject} the path goes on, or turns by less than 1 deg, so it is no corner",
        source=machine.source("not described", Evidence.ASSUMED),
    )
    meant = "is a rounding between two axes" if machine.start == _TURNING else "belongs to an arc"
    axes = "A and C are axes" if machine.angle.startswith(",") else "C is an axis"
    comma = told(
        f"{machine.prefix}-comma-missing",
        machine.cut,
        (",C", "C"),
        help=f"{COMMA_MISSING.help}; without a comma, {axes} and R {meant}",
        source=machine.source("the function"),
    )
    own = {
        "corner-too-large": (machine.cut, machine.cut.replace(",C5.", ",C31.")),
        "corner-reverses": (machine.cut, machine.cut.replace(machine.turn, machine.line.replace("0.", "."))),
        **examples,
    }
    no_room: Otherwise = {
        "source": machine.source(_ALARM_LIST),
        "alarm": machine.alarm("055 MISSING MOVE VALUE IN CHF/CNR"),
    }
    rows = (
        told(f"{machine.prefix}-{code}", good, bad, **(no_room if code in _WITHOUT_ROOM else {}))
        for code, (good, bad) in own.items()
    )
    return (dropped, straight, comma, *rows)


_WITHOUT_ROOM = ("corner-too-large", "corners-overlap")
_MILLED_TWICE = _MILLING + "G01 X30. ,C20.\nY30. ,C20.\nX60."
_TURNED_TWICE = _TURNING + "G01 Z-20. ,R9.\nX40. ,C2.\nZ-50."
_MILL_EXAMPLES: dict[str, tuple[str, str]] = {
    "corners-overlap": (_MILLED_TWICE.replace("20.", "10."), _MILLED_TWICE),
    "radius-too-small": (_ARC_BEHIND, _ARC_BEHIND.replace("I20. J0", "R10.")),
    "radius-difference": (_ARC_BEHIND, _ARC_BEHIND.replace("I20.", "I18.")),
}


def _lathe_examples(machine: _Machine) -> dict[str, tuple[str, str]]:
    angled = f"{_TURNING}G01 X40. {machine.angle}150."
    return {
        "corners-overlap": (_TURNED_TWICE.replace("R9.", "R8."), _TURNED_TWICE),
        "angle-opposite": (angled, angled.replace("150.", "-30.")),
    }


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
        *_geometry(_FANUC_LATHE, _lathe_examples(_FANUC_LATHE)),
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
        *_geometry(_FANUC_MILL, _MILL_EXAMPLES),
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
        *_geometry(_HAAS_LATHE, _lathe_examples(_HAAS_LATHE)),
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
        *_geometry(_HAAS_MILL, {"corners-overlap": _MILL_EXAMPLES["corners-overlap"]}),
        *GEOMETRY_RULES,
    ),
    HAAS,
    _HAAS_MILL_PAGES,
)
