"""The rules that every control with lines and arcs in a row has: which words may stand in one block."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal

from contoursolve.controls.chain.language import (
    ARC,
    CORNER_ALONE,
    FOLLOWED,
    LAST,
    LEFT_OUT,
    LINE,
    LINE_LINE,
    OTHER_PLANE,
    OTHER_ZERO,
    OVER_LINE,
    RAPID,
    RAPID_CORNER,
    SMOOTH,
    STATED_CENTER,
    STATED_POINT,
)
from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.geometry_rules import ANGLE_RANGE, GENERAL, GEOMETRY_RULES, PLANE_CHANGES, ZERO_MOVES
from contoursolve.controls.own_words import G_CODES
from contoursolve.controls.rule_rows import Examples, row, with_rows
from contoursolve.diagnostics import Alarm, Evidence, Severity, Source
from contoursolve.reading import AnglesParallel, Rule, Value, all_of, some

ANY, LINES = (LINE, OVER_LINE, ARC), (LINE, OVER_LINE)
BESIDE = ("beside-X", "beside-Y", "beside-Z")
FIRST, SECOND, STEPS = ("first", "first-step"), ("second", "second-step"), ("first-step", "second-step")
_GUARD = Decimal("0.0001")


@dataclass(frozen=True, slots=True)
class ExampleWords:
    """The words of four right programs: with another word in the place of one of them, a program is wrong.

    The programs begin at `start`: a line by its angle; two lines by their angles, which meet; two lines with a corner
    between them; a line with a corner, and an arc.
    """

    angle: str
    """The begin of the word of an angle: ANG= or ,A."""
    corner: str
    """The begin of the word of a rounding."""
    radius: str
    """The word of an arc's radius."""
    before_arc: str
    """The block before the arc: a line with a corner."""
    start: str = "G17 G90 G0 X0 Y0\n"
    end: str = "X40"
    degrees: str = "30"
    opening: str = "70"
    """The angle of the first line of two that meet."""
    closing: str = "-30"
    """The angle of the second one, empty for none."""
    closing_end: str = "X80 Y25"
    before: str = "X30"
    """The end of the line with a corner."""
    size: str = "5"
    turn: str = "X40 Y40"
    """The block behind that."""
    arc_end: str = "X60 Y20"
    center: str = "I20 J0"
    line: str = "G1"
    arc_code: str = "G2"

    def angled(self, **words: str) -> str:
        """A line by its angle, but for some words."""
        each = replace(self, **words)
        return each.start + _block(each.line, each.end, each.angle + each.degrees)

    def vertex(self, **words: str) -> str:
        """Two lines by their angles, but for some words."""
        each = replace(self, **words)
        closing = _block(each.closing_end, each.closing and each.angle + each.closing)
        return f"{each.start}{each.line} {each.angle}{each.opening}\n{closing}"

    def cut(self, **words: str) -> str:
        """Two lines with a corner, but for some words."""
        each = replace(self, **words)
        return each.start + _block(each.line, each.before, each.corner + each.size) + f"\n{each.turn}"

    def arc(self, **words: str) -> str:
        """A line with a corner and an arc, but for some words."""
        each = replace(self, **words)
        return f"{each.start}{each.before_arc}\n" + _block(each.arc_code, each.arc_end, each.center)


def gaps_of(words: ExampleWords) -> dict[str, str]:
    """The gaps of examples of rules that all controls share (see `own_words`), with these words."""
    return {**G_CODES, **{name: getattr(words, name) for name in ExampleWords.__slots__}}


def _block(*words: str) -> str:
    return " ".join(filter(None, words))


@dataclass(frozen=True, slots=True)
class Manual:
    """The terms in which a control's rules are told: the start of their codes, its source, the words for an angle,
    chamfers, a rounding and an arc's radius, its alarms by the end of a rule's code; and the words of examples."""

    prefix: str
    source: Source
    angle: str
    chamfers: tuple[str, ...]
    rounding: str
    radius: str
    examples: ExampleWords
    alarms: Mapping[str, Alarm] = field(default_factory=dict)
    plane: str = ""
    """A further help where an axis is outside the plane."""
    sources: Mapping[str, Source] = field(default_factory=dict)
    """Those of single rows, by the end of their code."""

    @property
    def angled(self) -> str:
        """A line by its angle."""
        return self.examples.angled()

    @property
    def vertex(self) -> str:
        """Two lines that meet."""
        return self.examples.vertex()

    @property
    def cut(self) -> str:
        """Two lines with a corner."""
        return self.examples.cut()

    @property
    def arc(self) -> str:
        """A line with a corner before an arc."""
        return self.examples.arc()

    @property
    def assumed(self) -> Source:
        """Its source, of what no page prints."""
        return Source(self.source.manual, self.source.place, Evidence.ASSUMED)

    def told(self, rule: Rule) -> Rule:
        """A row of all such controls in its terms."""
        source, alarm = self.sources.get(rule.code, rule.source), self.alarms.get(rule.code)
        return row(f"{self.prefix}-{rule.code}", like=rule, source=source, alarm=alarm)


def chain_rules(manual: Manual) -> tuple[Rule, ...]:
    """The rows that hold for all of them."""
    angle, corners, example = manual.angle, (*manual.chamfers, manual.rounding), manual.examples
    cut, arc, angled, vertex, assumed = manual.cut, manual.arc, manual.angled, manual.vertex, manual.assumed
    rows = (
        row("corner-without-next", "{words}: a corner needs an element after it, and none follows",
            "put the next cutting move right after it, or delete it", assumed,
            some(*corners) & some(LAST) & (~some(RAPID) | some(RAPID_CORNER)) & ~some(LEFT_OUT),
            (cut, example.cut(turn="M30"), example.cut(turn=f"G0 {example.turn}")), ANY),
        row("corner-rapid", "{words}: the control makes a corner in a cutting move, not in G0", "write G1", assumed,
            some(*corners) & some(RAPID) & ~some(RAPID_CORNER), (cut, example.cut(line="")), ANY),
        row("corner-negative", "{words}: a chamfer or a rounding has no sign",
            "delete the minus sign: the elements tell on which side the corner lies", assumed,
            Value(corners, least=Decimal(0)), (cut, example.cut(size=f"-{example.size}")), ANY),
        row("outside-plane", "{words} does not belong to the plane of the contour",
            "move that axis in a block of its own, or select its plane by G17, G18 or G19" + manual.plane, assumed,
            some(*BESIDE, "wrong-center"), (cut, example.cut(turn=f"{example.turn} Z-5")), ANY),
        row("plane-changes", *PLANE_CHANGES, assumed, some(OTHER_PLANE), (cut, example.cut(turn="G18 X40 Z40")), ANY),
        row("zero-moves", *ZERO_MOVES, assumed, some(OTHER_ZERO), (cut, example.cut(turn=f"G55 {example.turn}")), ANY),
        row("center-on-line", "{words}: a line has no centre and no radius",
            f"delete it; a rounding is {manual.rounding}", assumed, some(*STATED_CENTER, "R") & ~some(CORNER_ALONE),
            (cut, example.cut(turn=f"{example.turn} I5")), LINES),
        row("center-and-radius", "{words}: the arc has both a centre and a radius", "keep one of them", assumed,
            all_of(STATED_CENTER, "R"), (arc, example.arc(center=f"{example.center} {example.radius}")), (ARC,)),
        row("circle-undefined", "the arc has neither a centre nor a radius",
            f"add I, J or K of the plane, or {manual.radius}; for a line write G1", assumed,
            ~some(*STATED_CENTER, "R", SMOOTH), (arc, example.arc(center="")), (ARC,)),
        row("radius-without-end", "{words}: with a radius the arc needs its end",
            "add the coordinates of its end, or give the centre instead", assumed, some("R") & ~some(*STATED_POINT),
            (arc, example.arc(arc_end="", center=example.radius)), (ARC,)),
        row("angle-on-arc", "{words}: the control works out angles of lines, not of arcs",
            "write G1, or delete {words}", assumed, some(angle),
            (arc, example.arc(center=f"{example.center} {example.angle}{example.degrees}")), (ARC,)),
        row("end-missing", "{words} alone does not say where the line ends",
            f"add a coordinate; or let a line with both coordinates and {angle} follow, which it meets", assumed,
            some(angle) & ~some(*STATED_POINT, FOLLOWED), (vertex, example.vertex(closing_end="M30", closing="")),
            (LINE,)),
        row("closing-incomplete", "the line before has an angle and no end, so this block needs both coordinates and "
            f"{angle}: it lacks {{lacking}}", "add {lacking}", assumed, ~all_of(FIRST, SECOND, angle),
            (vertex, example.vertex(closing=""),
             example.vertex(closing_end=example.closing_end.rpartition(" ")[2])), (OVER_LINE,)),
        row("angles-parallel", "{words}: the two lines are parallel, so they have no vertex",
            "correct one of the angles", assumed, AnglesParallel((f"1:{angle}", f"2:{angle}"), _GUARD),
            (vertex, example.vertex(closing=example.opening)), (LINE_LINE,), is_about_geometry=True),
        row("angle-range", *ANGLE_RANGE, assumed, Value((angle,), least=Decimal(-360), most=Decimal(360)),
            (angled, example.angled(degrees="390.")), LINES, severity=Severity.WARNING),
    )  # fmt: skip
    return tuple(map(manual.told, rows))


def rules_of(
    manual: Manual, own: Iterable[Rule], examples: Mapping[str, Examples], common: Iterable[Rule] = ()
) -> tuple[Rule, ...]:
    """All rules of a control: those of every control, these of its kind, its own, and those about geometry.

    `examples` are its own ones of some of the latter, by the codes of their events. `common` are rows of every control
    as it tells them.
    """
    geometry = (
        row(f"{manual.prefix}-{code}", like=GENERAL, examples=programs, alarm=manual.alarms.get(code))
        for code, programs in examples.items()
    )
    return (*with_rows(COMMON_RULES, *common), *chain_rules(manual), *own, *geometry, *GEOMETRY_RULES)
