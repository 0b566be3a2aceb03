"""The rows about arcs by themselves, for every control that reads them outside contours, and their settings."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from decimal import Decimal
from functools import partial
from typing import Any

from msgspec import Struct

from contoursolve.controls.control_settings import setting
from contoursolve.controls.rule_rows import GEOMETRY, row
from contoursolve.diagnostics import Severity, Source
from contoursolve.gcode import Block, Word
from contoursolve.reading import CENTRES, ArcIssue, ArcTable, Beyond, BothStated, Control, Rule, Setting
from contoursolve.tolerance import RADIUS_DIFFERENCE

_APART = "{words}: the centre is {radius} from the start of the arc and {distance} from its end; "
ARCS = {
    rule.code: rule
    for rule in (
        row("arc-radii-differ", _APART + "that differs by {off}, allowed {limit}", "correct the centre or the end",
            GEOMETRY, ArcIssue.RADII_DIFFER),
        row("arc-radii-uncorrected", _APART + "under G164 that may differ by {limit}", "correct the centre or the end",
            GEOMETRY, ArcIssue.RADII_UNCORRECTED),
        row("arc-spiral", _APART + "the control cuts {path}", "correct the centre or the end, if an arc is meant",
            GEOMETRY, ArcIssue.SPIRAL, severity=Severity.WARNING),
        row("arc-centre-moves", _APART + "the control moves it by {off}, and cuts a radius of {actual}",
            "correct the centre or the end", GEOMETRY, ArcIssue.CENTRE_MOVES, severity=Severity.WARNING),
        row("arc-radius-small",
            "{words}: the radius of {actual} is less than half the distance from the start to the end, {limit}",
            "write at least {limit}, or correct the end", GEOMETRY, ArcIssue.RADIUS_SMALL),
        row("arc-full-by-radius",
            "{words}: the arc ends where it begins, and a radius does not say where its centre is",
            "state the centre of a full circle; or correct the end", GEOMETRY, ArcIssue.FULL_BY_RADIUS),
        row("arc-moves-nothing", "{words}: the arc ends where it begins; by a radius the control moves nothing",
            "state the centre of a full circle; or correct the end", GEOMETRY, ArcIssue.MOVES_NOTHING,
            severity=Severity.WARNING),
        row("arc-undefined", "the arc has neither a centre nor a radius",
            "add its centre or its radius; for a line write a line", GEOMETRY, ArcIssue.UNDEFINED),
        row("arc-runs-line", "the arc has neither a centre nor a radius; the control runs a straight line to its end",
            "add its centre or its radius; for a line write G01", GEOMETRY, ArcIssue.RUNS_LINE,
            severity=Severity.WARNING),
        row("arc-both", "{words}: the arc has both a centre and a radius", "keep one of them", GEOMETRY, ArcIssue.BOTH),
        row("arc-outside-plane", "{words}: an arc in {plane} has its centre by {center}",
            "write {center}, or select the plane before", GEOMETRY, ArcIssue.OUTSIDE_PLANE),
        row("arc-over-half", "{words}: by a radius the control makes no arc of 180 deg or more",
            "state the centre, or cut two arcs", GEOMETRY, ArcIssue.OVER_HALF),
        row("profile-begins-with-arc", "the profile of {cycle} begins with an arc; its first block must be a line",
            "begin the profile with G00 or G01 to where the arc begins", GEOMETRY, ArcIssue.PROFILE_ARC),
        row("profile-begins-without-code",
            "the first block of the profile of {cycle} has no G00 or G01; what was in force before does not count",
            "write G00 or G01 into it", GEOMETRY, ArcIssue.PROFILE_CODE),
        row("arc-empty-circle", "{words}: the arc has a radius of 0", "correct its centre or its radius", GEOMETRY,
            ArcIssue.EMPTY),
        row("arc-opening-angle", "{words}: an opening angle is more than 0 deg and less than 360 deg",
            "write the angle by which the arc turns", GEOMETRY, ArcIssue.OPENING),
        row("arc-in-line", "{words}: the point between the ends lies in line with them, so that there is no arc",
            "correct the point between the ends", GEOMETRY, ArcIssue.IN_LINE),
    )
}  # fmt: skip
"""The rows about arcs, by their codes."""

_BOTH_DISAGREE = "{words}: the arc has a centre and a radius, and the centre is not that far from its start"


class ArcExamples(Struct, frozen=True):
    """The words of a control for examples: how a program begins, at the origin of the plane, and from an end there, a
    centre, a radius and further words to an arc. Lengths are counted from where it begins."""

    begin: str
    arc: Callable[[float, float, tuple[float, float] | None, float | None, str], str]
    outside: str = "K0"
    """A word of a centre for an axis outside the plane."""

    def program(
        self,
        first: float = 20,
        second: float = 0,
        center: tuple[float, float] | None = None,
        radius: float | None = None,
        more: str = "",
    ) -> str:
        """A program with one arc."""
        return self.begin + self.arc(first, second, center, radius, more)


def in_codes(
    begin: str, axes: str, centers: str, radius: str = "R", at: tuple[float, float] = (0, 0), halved: int = 1
) -> ArcExamples:
    """Examples in G codes: arcs from a place, the values of whose axes and centres are these; the second coordinate
    counts so many times."""

    def arc(first: float, second: float, center: tuple[float, float] | None, size: float | None, more: str) -> str:
        words = [f"{axes[0]}{_number(at[0] + first)}", f"{axes[1]}{_number(at[1] + halved * second)}"]
        if center is not None:
            words += [f"{name}{_number(value)}" for name, value in zip(centers, center, strict=True)]
        words += [f"{radius}{_number(size)}"] if size is not None else []
        return " ".join(["G02", *words, *([more] if more else [])])

    return ArcExamples(begin, arc, "K0" if "K" not in centers else "J0")


def _number(value: float) -> str:
    return f"{value:.4f}".rstrip("0")


class ArcRows(Struct, frozen=True):
    """The rows of a control, one for each issue that it can meet; and the words of their examples."""

    rows: tuple[Rule, ...]
    examples: ArcExamples
    differs: float = 9
    """The first coordinate of a centre that is wrong for an end at 20."""
    before: Mapping[ArcIssue, str] = {}
    """A line before the arc of the wrong examples of some."""
    wrong: Mapping[ArcIssue, str] = {}
    """Arcs that are wrong, where those of most controls are contours."""
    is_by_agreement: bool = False
    """Whether a centre may stand beside a radius that agrees."""

    def rules(self) -> Iterator[Rule]:
        """The rows with their examples."""
        for rule in self.rows:
            issue = ArcIssue(rule.code)
            right, wrong = self._programs(issue)
            if issue in self.wrong:
                wrong = (self.examples.begin + self.wrong[issue],)
            message = _BOTH_DISAGREE if issue is ArcIssue.BOTH and self.is_by_agreement else ""
            yield row(rule.code, message, like=rule, examples=(right, *wrong))

    def _programs(self, issue: ArcIssue) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Right and wrong examples of a row."""
        program, examples = self.examples.program, self.examples
        centered, by_radius = program(center=(10, 0)), program(radius=12)
        wrong: tuple[str, ...]
        match issue:
            case ArcIssue.RADIUS_SMALL:
                return (by_radius, program(radius=10), program(radius=9.9996)), (program(radius=8),)
            case ArcIssue.FULL_BY_RADIUS | ArcIssue.MOVES_NOTHING:
                return (by_radius,), (program(0, 0, radius=12),)
            case ArcIssue.UNDEFINED | ArcIssue.RUNS_LINE:
                return (centered, by_radius), (program(),)
            case ArcIssue.BOTH:
                return (centered, by_radius), (program(center=(10, 0), radius=12),)
            case ArcIssue.OUTSIDE_PLANE:
                return (centered,), (program(center=(10, 0), more=examples.outside),)
            case ArcIssue.OVER_HALF:
                return (by_radius,), (program(radius=-12),)
            case ArcIssue.EMPTY:
                return (program(0, 0, center=(10, 0)),), (program(0, 0, center=(0, 0)),)
            case ArcIssue.PROFILE_ARC:
                return _profiles("G00", "G03 X20. Z-1. R1.")
            case ArcIssue.PROFILE_CODE:
                return _profiles("G01", "X18. Z-1.")
            case ArcIssue.CENTRE_MOVES:
                wrong = (program(center=(10.5, 0)),)
            case _:
                wrong = (program(center=(self.differs, 0)),)
        wrong = tuple(examples.begin + self.before.get(issue, "") + each.removeprefix(examples.begin) for each in wrong)
        return (centered, program(center=(10.004, 0)), program(0, 0, center=(10, 0))), wrong


def _profiles(code: str, wrong: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """A right profile of a lathe's cycle, whose first block states a code, and one with another first block."""
    before = "G00 X62. Z0.\nG71 U2. R0.5\nG71 P10 Q20 U0.4 W0.1 F0.25\n"
    behind = "\nG01 X20. Z-20.\nN20 X62.\nG70 P10 Q20\nM30"
    return (f"{before}N10 {code} X18. Z0.{behind}",), (f"{before}N10 {wrong}{behind}",)


# Settings --------------------------------------------------------------------------------------------------------


def number_of_arcs(name: str, meaning: str, default: str, source: Source, most: str, unit: str = "mm") -> Setting:
    """The setting of another number about arcs."""
    return Setting(name, meaning, {default: unit}, default, source, bounds=(Decimal(0), Decimal(most)), unit=unit)


def with_arcs(**fields: Any) -> Callable[[Control], Control]:
    """The change to a control that reads arcs otherwise."""
    return partial(_with_fields, fields=fields)


def _with_fields(control: Control, *, fields: Mapping[str, Any]) -> Control:
    arcs = replace(control.modes.arcs or ArcTable(), **fields)
    return replace(control, modes=replace(control.modes, arcs=arcs))


ARC_SETTINGS = {
    each.name: each
    for each in (
        Setting("radius-difference", "by how much the radii where an arc begins and ends may differ",
                {f"{RADIUS_DIFFERENCE}": "mm"}, f"{RADIUS_DIFFERENCE}", GEOMETRY, (Decimal("0.001"), Decimal(10))),
        setting("no-centre", "what the control makes of an arc without a centre and a radius",
                {"error": "it stops", "line": "it runs a straight line to the end"}, GEOMETRY,
                {"line": with_arcs(runs_line=True)}),
        setting("centre-and-radius", "what a centre beside a radius is",
                {"agree": "it may stand there if it agrees", "error": "it must not stand there",
                 "radius": "it is left out: the radius counts"}, GEOMETRY,
                {"error": with_arcs(both=BothStated.REFUSED), "radius": with_arcs(both=BothStated.RADIUS_COUNTS)}),
        setting("negative-radius", "what a negative radius of an arc is",
                {"over_180": "an arc of more than 180 deg", "error": "refused: by a radius arcs are less than 180 deg"},
                GEOMETRY, {"error": with_arcs(refuses_negative=True)}),
        setting("off-arc", "what the control cuts where the radii differ and it does not stop",
                {"spiral": "a spiral", "axis_line": "an arc, then a straight line along one axis"}, GEOMETRY,
                {"axis_line": with_arcs(unchecked=Beyond.AXIS_LINE)}),
        setting(CENTRES, "from where I, J and K of an arc count",
                {"start": "from where the arc begins", "origin": "they are coordinates of the centre"}, GEOMETRY,
                {"origin": with_arcs(counts_from_origin=True)}),
    )
}  # fmt: skip
"""The settings of arcs, by their names."""


def arc_setting(name: str, source: Source, **otherwise: Any) -> Setting:
    """A setting of arcs as a control has it, with what is otherwise."""
    return replace(ARC_SETTINGS[name], source=source, **otherwise)


# Words that stay in force ----------------------------------------------------------------------------------------

POLAR = "polar"
"""The name of what stays in force where words of axes are no coordinates of the plane."""
_BEGIN, _END = (Decimal(16), *map(Decimal, ("12.1", "7.1", "16.1", "16.2"))), (Decimal(15), Decimal("13.1"))


def remember_polar(memory: Mapping[str, Word], block: Block) -> Mapping[str, Word]:
    """Polar coordinates, and paths on another surface, which stay in force until they end."""
    for word in block.words:
        if word.address == "G" and word.number is not None:
            if word.number in _BEGIN:
                memory = {**memory, POLAR: Word(POLAR, None, False, word.text.strip(), word.span)}
            elif POLAR in memory and word.number in _END:
                memory = {name: kept for name, kept in memory.items() if name != POLAR}
    return memory
