"""The rules that every control with lines and arcs in a row has: which words may stand in one block."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal
from typing import Any

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
from contoursolve.controls.geometry_rules import ANGLE_RANGE, GEOMETRY_RULES, PLANE_CHANGES, ZERO_MOVES, told
from contoursolve.controls.own_words import G_CODES
from contoursolve.controls.rule_rows import rule_row
from contoursolve.diagnostics import Alarm, Evidence, Severity, Source
from contoursolve.gcode import FaultKind
from contoursolve.reading import AnglesParallel, Condition, Rule, Value, all_of, some

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

    def row(
        self,
        code: str,
        message: str,
        help_: str,
        when: Condition,
        roles: tuple[str, ...],
        good: str,
        *bad: tuple[str, str] | str,
        evidence: Evidence = Evidence.ASSUMED,
        **more: Any,
    ) -> Rule:
        """A row; what is wrong is a program, or two texts of which the second stands for the first in the right one."""
        source = self.sources.get(code, Source(self.source.manual, self.source.place, evidence))
        alarm = self.alarms.get(code)
        return rule_row(self.prefix, code, message, help_, source, when, roles, good, *bad, alarm=alarm, **more)


def chain_rules(manual: Manual) -> Iterator[Rule]:
    """The rows that hold for all of them."""
    row, angle, corners, example = manual.row, manual.angle, (*manual.chamfers, manual.rounding), manual.examples
    cut, arc, angled, vertex = manual.cut, manual.arc, manual.angled, manual.vertex
    yield row(
        "corner-without-next",
        "{words}: a corner needs an element after it, and none follows",
        "put the next cutting move right after it, or delete it",
        some(*corners) & some(LAST) & (~some(RAPID) | some(RAPID_CORNER)) & ~some(LEFT_OUT),
        ANY,
        cut,
        example.cut(turn="M30"),
        example.cut(turn=f"G0 {example.turn}"),
    )
    yield row(
        "corner-rapid",
        "{words}: the control makes a corner in a cutting move, not in G0",
        "write G1",
        some(*corners) & some(RAPID) & ~some(RAPID_CORNER),
        ANY,
        cut,
        example.cut(line=""),
    )
    yield row(
        "corner-negative",
        "{words}: a chamfer or a rounding has no sign",
        "delete the minus sign: the elements tell on which side the corner lies",
        Value(corners, least=Decimal(0)),
        ANY,
        cut,
        example.cut(size=f"-{example.size}"),
    )
    yield row(
        "outside-plane",
        "{words} does not belong to the plane of the contour",
        "move that axis in a block of its own, or select its plane by G17, G18 or G19" + manual.plane,
        some(*BESIDE, "wrong-center"),
        ANY,
        cut,
        example.cut(turn=f"{example.turn} Z-5"),
    )
    yield row(
        "plane-changes",
        *PLANE_CHANGES,
        some(OTHER_PLANE),
        ANY,
        cut,
        example.cut(turn="G18 X40 Z40"),
    )
    yield row(
        "zero-moves",
        *ZERO_MOVES,
        some(OTHER_ZERO),
        ANY,
        cut,
        example.cut(turn=f"G55 {example.turn}"),
    )
    yield row(
        "center-on-line",
        "{words}: a line has no centre and no radius",
        f"delete it; a rounding is {manual.rounding}",
        some(*STATED_CENTER, "R") & ~some(CORNER_ALONE),
        LINES,
        cut,
        example.cut(turn=f"{example.turn} I5"),
    )
    yield row(
        "center-and-radius",
        "{words}: the arc has both a centre and a radius",
        "keep one of them",
        all_of(STATED_CENTER, "R"),
        (ARC,),
        arc,
        example.arc(center=f"{example.center} {example.radius}"),
    )
    yield row(
        "circle-undefined",
        "the arc has neither a centre nor a radius",
        f"add I, J or K of the plane, or {manual.radius}; for a line write G1",
        ~some(*STATED_CENTER, "R", SMOOTH),
        (ARC,),
        arc,
        example.arc(center=""),
    )
    yield row(
        "radius-without-end",
        "{words}: with a radius the arc needs its end",
        "add the coordinates of its end, or give the centre instead",
        some("R") & ~some(*STATED_POINT),
        (ARC,),
        arc,
        example.arc(arc_end="", center=example.radius),
    )
    yield row(
        "angle-on-arc",
        "{words}: the control works out angles of lines, not of arcs",
        "write G1, or delete {words}",
        some(angle),
        (ARC,),
        arc,
        example.arc(center=f"{example.center} {example.angle}{example.degrees}"),
    )
    yield row(
        "end-missing",
        "{words} alone does not say where the line ends",
        f"add a coordinate; or let a line with both coordinates and {angle} follow, which it meets",
        some(angle) & ~some(*STATED_POINT, FOLLOWED),
        (LINE,),
        vertex,
        example.vertex(closing_end="M30", closing=""),
    )
    yield row(
        "closing-incomplete",
        f"the line before has an angle and no end, so this block needs both coordinates and {angle}: "
        "it lacks {lacking}",
        "add {lacking}",
        ~all_of(FIRST, SECOND, angle),
        (OVER_LINE,),
        vertex,
        example.vertex(closing=""),
        example.vertex(closing_end=example.closing_end.rpartition(" ")[2]),
    )
    yield row(
        "angles-parallel",
        "{words}: the two lines are parallel, so they have no vertex",
        "correct one of the angles",
        AnglesParallel((f"1:{angle}", f"2:{angle}"), _GUARD),
        (LINE_LINE,),
        vertex,
        example.vertex(closing=example.opening),
        is_about_geometry=True,
    )
    yield row(
        "angle-range",
        *ANGLE_RANGE,
        Value((angle,), least=Decimal(-360), most=Decimal(360)),
        LINES,
        angled,
        example.angled(degrees="390."),
        severity=Severity.WARNING,
    )


def rules_of(
    manual: Manual,
    own: Iterable[Rule],
    examples: Mapping[str, tuple[str, str]],
    helps: Mapping[FaultKind, tuple[str, str]] | None = None,
) -> tuple[Rule, ...]:
    """All rules of a control: those of every control, these of its kind, its own, and those about geometry.

    `examples` are right and wrong ones of its own for some of the latter, by the codes of their events, `helps` what to
    do about characters that cannot be read, with a wrong example.
    """
    geometry = (
        told(f"{manual.prefix}-{code}", good, bad, alarm=manual.alarms.get(code))
        for code, (good, bad) in examples.items()
    )
    return (*_common(manual, helps or {}), *chain_rules(manual), *own, *geometry, *GEOMETRY_RULES)


def _common(manual: Manual, helps: Mapping[FaultKind, tuple[str, str]]) -> Iterator[Rule]:
    """The rows of every control, with what helps on this one."""
    for rule in COMMON_RULES:
        if isinstance(rule.about, FaultKind) and rule.about in helps:
            advice, wrong = helps[rule.about]
            yield replace(rule, help=advice, accepted=(manual.cut,), rejected=(wrong,))
        else:
            yield rule
