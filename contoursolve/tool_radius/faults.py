"""Faults of a tool on a contour, and what it leaves: one row a kind."""

from enum import Enum
from typing import NamedTuple

from msgspec import Struct

from contoursolve.diagnostics import OWN, Evidence, Severity, Source
from contoursolve.reading import Rule
from contoursolve.solving import Point


class _Row(NamedTuple):
    """Message of a kind, and what to do."""

    message: str
    help: str
    severity: Severity = Severity.ERROR


class ToolFaultKind(Enum):
    """Kinds of what is told about a tool; the first five leave no path."""

    ARC_TOO_SMALL = _Row(
        "the inside arc of radius {radius} is {short} too small for the {tool}",
        "take a smaller tool or a larger radius",
    )
    EQUAL_RADIUS = _Row(
        "the inside arc of radius {radius} is no larger than the {tool}: it would be a point",
        "take a smaller tool or a larger radius",
    )
    ELEMENT_VANISHES = _Row(
        "the {element} is {length} long, the {tool} needs {needs} between its corners: {short} short",
        "take a smaller tool or make it longer",
    )
    NO_INTERSECTION = _Row(
        "the {tool} does not reach the corner at the end of this {element}", "take a smaller tool or a wider corner"
    )
    INTERFERENCE = _Row(
        "the {tool} cuts {short} into program line {wall} while it works on program line {line}",
        "take a smaller tool or make the gap wider",
    )
    NOT_VERIFIED = _Row("the path of the tool misses this {element} by {short}: it is not used", "report it")
    INTERRUPTED = _Row(
        "program line {broken}{why} interrupts the contour while {code} is in force: what follows is no longer known",
        "write {cancel} before it, or move it out of the contour",
    )
    OTHER_TOOL = _Row(
        "program line {broken} calls another tool in the midst of the contour",
        "write {cancel} and lead the tool away before it",
    )
    NO_OFFSET = _Row(
        "{void} is in force: {code} works with radius 0 ({grade}), and does not compensate the {tool}",
        "write {offset} for {void}",
    )
    NO_D = _Row(
        "no D stands before {code}: nobody knows with which radius the control works",
        "write D with the number of the tool beside {code}",
        Severity.WARNING,
    )
    NOT_FOLLOWED = _Row("{word} in program line {at} {meaning}: the path of the {tool} is not known", "{instead}")
    RADIUS_STATED = _Row("{word} in program line {at} {meaning}: here it is the {tool}", "{instead}", Severity.WARNING)
    RADIUS_ADDED = _Row(
        "{word} in program line {at} {meaning}: with it, this is the {tool}",
        "state the radius of the tool without it",
        Severity.INFO,
    )
    NO_RADIUS = _Row(
        "the tool has radius 0: its path is the contour itself", "state the radius of the tool", Severity.INFO
    )
    STILL_ON = _Row(
        "{code} is still in force at program line {still_on}",
        "write {cancel} in the move away from the contour, before that line",
        Severity.WARNING,
    )
    ENTRY_BY_ARC = _Row("compensation begins in an arc", "write {code} in a straight move before it")
    EXIT_BY_ARC = _Row("compensation ends in an arc", "write {cancel} in a straight move after it")
    ENTRY_TOO_SHORT = _Row(
        "the move to the contour is {length} long, {short} shorter than the radius of the {tool}",
        "begin farther away",
        Severity.WARNING,
    )
    ENTRY_THROUGH = _Row(
        "the move to the contour takes the {tool} through program line {line}",
        "begin on the side of the contour on which the tool runs",
        Severity.WARNING,
    )
    EXIT_THROUGH = _Row(
        "the move away takes the {tool} through program line {line}",
        "lead the tool away on the side of the contour on which it runs",
        Severity.WARNING,
    )
    TIP_AGAINST_SIDE = _Row(
        "tip {tip} points away from this {element}, with the tool {side} of it",
        "check the number of the tip, and {code}",
        Severity.WARNING,
    )
    BACK_FLANK = _Row(
        "this {element} needs a clearance of {needed} behind the nose; the tool has {stated}",
        "take a tool with more clearance",
    )
    FRONT_FLANK = _Row(
        "this {element} needs a clearance of {needed} before the nose; the tool has {stated}",
        "take a tool with more clearance",
    )
    UNCOMPENSATED = _Row(
        "without {code} this {comes_out}",
        "write {code}, or the path of the tool: contoursolve expand --tool",
        Severity.WARNING,
    )
    NOT_JUDGED = _Row(
        "program lines {lines} cut without {code}: whether that is meant is not judged",
        "write {code} before them if they are the contour itself",
        Severity.INFO,
    )
    STUB = _Row(
        "without {code} a stub of diameter {short} stands at X0",
        "write {code}, or go {short} farther in X",
        Severity.WARNING,
    )
    BY_HAND = _Row(
        "the path is made by hand for a {kind} of radius {made}: its arcs of this radius lead around corners",
        "program the part itself with {code}, and expand --tool writes the path of any tool",
        Severity.INFO,
    )
    OTHER_RADIUS = _Row(
        "the path is made by hand for radius {made}: with the {tool} this {comes_out}",
        "take a tool of radius {made}, or make the path anew",
        Severity.WARNING,
    )
    INSIDE_CORNER = _Row(
        "the inside corner after this {element} keeps the radius of the {tool}: {short} stays in it, {rest}",
        "a smaller tool leaves less",
        Severity.INFO,
    )
    FASTER_EDGE = _Row(
        "on this inside arc the edge is {times} times as fast as F says, for the centre of the {tool}",
        "a lower F in this block",
        Severity.INFO,
    )
    RUNS_CROSS = _Row(
        "program lines {wall} and {line}, the run-in and the run-off, cross at {cross}: what lies beyond counts as air",
        "let both lines end there if what lies beyond belongs to the contour",
        Severity.INFO,
    )
    LEFT_OUT = _Row(
        "the {tool} leaves out {left}: {short} stays there{beside}",
        "a smaller tool leaves less",
        Severity.WARNING,
    )
    SWITCHED = _Row(
        "the path of the tool begins anew here: the side or the plane changes without a move away",
        "lead the tool away from the contour before",
        Severity.WARNING,
    )
    APPROACH = _Row(
        "this block is taken to lead to the contour, which begins with program line {begin}",
        "write {code} into the block before it if it cuts the part",
        Severity.INFO,
    )

    @property
    def code(self) -> str:
        """The code of its findings."""
        return f"tool-{self.name.lower().replace('_', '-')}"

    @property
    def source(self) -> Source:
        """The source of what is said."""
        if self is ToolFaultKind.APPROACH:
            return Source(OWN, "where a contour begins without G41 and G42", Evidence.ASSUMED)
        return Source(OWN, "geometry of the tool's radius", Evidence.DERIVED)

    @property
    def rule(self) -> Rule:
        """Its row in a catalogue; no block alone shows it."""
        row = self.value
        return Rule(self.code, row.message, row.help, self.source, (), (), about=self, severity=row.severity)


class ToolFault(Struct, frozen=True):
    """A fault at an element (its number, from 0): by how much it misses (mm), the largest radius that fits (mm), the
    element on which the tool works, and where, mm."""

    kind: ToolFaultKind
    element: int
    short: float | None = None
    largest: float | None = None
    length: float = 0.0
    """Of the element, mm."""
    working: int | None = None
    at: Point | None = None
    rest: tuple[float, float] = (0.0, 0.0)
    """The lengths (mm) that stay uncut at both sides of a corner; the angle (deg) that a flank needs, and has."""
