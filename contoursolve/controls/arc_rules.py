"""The rows about arcs by themselves, for every control that reads them outside contours, and their settings."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from decimal import Decimal
from functools import partial
from typing import Any

from msgspec import Struct

from contoursolve.controls.control_settings import setting
from contoursolve.diagnostics import Alarm, Evidence, Severity, Source
from contoursolve.gcode import Block, Word
from contoursolve.reading import CENTRES, ArcIssue, ArcTable, Beyond, BothStated, Dialect, Rule, Setting
from contoursolve.tolerance import RADIUS_DIFFERENCE

_APART = "{words}: the centre is {radius} from the start of the arc and {distance} from its end; "
_TEXTS: Mapping[ArcIssue, tuple[str, str]] = {
    ArcIssue.RADII_DIFFER: (
        _APART + "that differs by {off}, allowed {limit}",
        "correct the centre or the end",
    ),
    ArcIssue.RADII_UNCORRECTED: (
        _APART + "under G164 that may differ by {limit}",
        "correct the centre or the end",
    ),
    ArcIssue.SPIRAL: (
        _APART + "the control cuts {path}",
        "correct the centre or the end, if an arc is meant",
    ),
    ArcIssue.CENTRE_MOVES: (
        _APART + "the control moves it by {off}, and cuts a radius of {actual}",
        "correct the centre or the end",
    ),
    ArcIssue.RADIUS_SMALL: (
        "{words}: the radius of {actual} is less than half the distance from the start to the end, {limit}",
        "write at least {limit}, or correct the end",
    ),
    ArcIssue.FULL_BY_RADIUS: (
        "{words}: the arc ends where it begins, and a radius does not say where its centre is",
        "state the centre of a full circle; or correct the end",
    ),
    ArcIssue.MOVES_NOTHING: (
        "{words}: the arc ends where it begins; by a radius the control moves nothing",
        "state the centre of a full circle; or correct the end",
    ),
    ArcIssue.UNDEFINED: (
        "the arc has neither a centre nor a radius",
        "add its centre or its radius; for a line write a line",
    ),
    ArcIssue.RUNS_LINE: (
        "the arc has neither a centre nor a radius; the control runs a straight line to its end",
        "add its centre or its radius; for a line write G01",
    ),
    ArcIssue.BOTH: (
        "{words}: the arc has both a centre and a radius",
        "keep one of them",
    ),
    ArcIssue.OUTSIDE_PLANE: (
        "{words}: an arc in {plane} has its centre by {center}",
        "write {center}, or select the plane before",
    ),
    ArcIssue.OVER_HALF: (
        "{words}: by a radius the control makes no arc of 180 deg or more",
        "state the centre, or cut two arcs",
    ),
    ArcIssue.PROFILE_ARC: (
        "the profile of {cycle} begins with an arc; its first block must be a line",
        "begin the profile with G00 or G01 to where the arc begins",
    ),
    ArcIssue.PROFILE_CODE: (
        "the first block of the profile of {cycle} has no G00 or G01; what was in force before does not count",
        "write G00 or G01 into it",
    ),
    ArcIssue.EMPTY: (
        "{words}: the arc has a radius of 0",
        "correct its centre or its radius",
    ),
    ArcIssue.OPENING: (
        "{words}: an opening angle is more than 0 deg and less than 360 deg",
        "write the angle by which the arc turns",
    ),
    ArcIssue.IN_LINE: (
        "{words}: the point between the ends lies in line with them, so that there is no arc",
        "correct the point between the ends",
    ),
}
_BOTH_DISAGREE = "{words}: the arc has a centre and a radius, and the centre is not that far from its start"
_WARNINGS = (ArcIssue.SPIRAL, ArcIssue.CENTRE_MOVES, ArcIssue.MOVES_NOTHING, ArcIssue.RUNS_LINE)


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
    """The rows of a control: for each issue that it can meet, its source and the alarm; and the words of examples."""

    issues: Mapping[ArcIssue, tuple[Source, Alarm | None]]
    examples: ArcExamples
    differs: float = 9
    """The first coordinate of a centre that is wrong for an end at 20."""
    options: Mapping[ArcIssue, str] = {}
    """Options of the examples of some issues."""
    before: Mapping[ArcIssue, str] = {}
    """A line before the arc of the wrong examples of some."""
    notes: Mapping[ArcIssue, str] = {}
    wrong: Mapping[ArcIssue, str] = {}
    """Arcs that are wrong, where those of most controls are contours."""
    warns_of: frozenset[ArcIssue] = frozenset()
    """Issues that are warned of, as no page tells of an alarm."""
    is_by_agreement: bool = False
    """Whether a centre may stand beside a radius that agrees."""

    def rules(self) -> Iterator[Rule]:
        """The rows."""
        for issue, (source, alarm) in self.issues.items():
            message, advice = _TEXTS[issue]
            if issue is ArcIssue.BOTH and self.is_by_agreement:
                message = _BOTH_DISAGREE
            right, wrong = self._programs(issue)
            wrong = (self.examples.begin + self.wrong[issue],) if issue in self.wrong else wrong
            yield Rule(
                issue.value,
                message,
                advice,
                source,
                accepted=right,
                rejected=wrong,
                about=issue,
                alarm=alarm,
                severity=Severity.WARNING if issue in (*_WARNINGS, *self.warns_of) else Severity.ERROR,
                note=self.notes.get(issue, ""),
                options=self.options.get(issue, ""),
            )

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


def radius_difference_setting(source: Source, default: float = RADIUS_DIFFERENCE, least: str = "0.001") -> Setting:
    """The setting of the difference of the radii that is allowed."""
    meaning = "by how much the radii where an arc begins and ends may differ"
    if not Decimal(least):
        meaning += "; 0 where the control does not look"
    return Setting(
        "radius-difference", meaning, {f"{default}": "mm"}, f"{default}", source, bounds=(Decimal(least), Decimal(10))
    )


def number_of_arcs(name: str, meaning: str, default: str, source: Source, most: str, unit: str = "mm") -> Setting:
    """The setting of another number about arcs."""
    return Setting(name, meaning, {default: unit}, default, source, bounds=(Decimal(0), Decimal(most)), unit=unit)


def with_arcs(**fields: Any) -> Callable[[Dialect], Dialect]:
    """The change to a control that reads arcs otherwise."""
    return partial(_with_fields, fields=fields)


def _with_fields(dialect: Dialect, *, fields: Mapping[str, Any]) -> Dialect:
    arcs = replace(dialect.modes.arcs or ArcTable(), **fields)
    return replace(dialect, modes=replace(dialect.modes, arcs=arcs))


def no_centre_setting(source: Source) -> Setting:
    """The setting of an arc without a centre and a radius."""
    return setting(
        "no-centre",
        "what the control makes of an arc without a centre and a radius",
        {"error": "it stops", "line": "it runs a straight line to the end"},
        source,
        {"line": with_arcs(runs_line=True)},
    )


def both_setting(source: Source) -> Setting:
    """The setting of a centre beside a radius, where no page tells."""
    return setting(
        "centre-and-radius",
        "what a centre beside a radius is",
        {
            "agree": "it may stand there if it agrees",
            "error": "it must not stand there",
            "radius": "it is left out: the radius counts",
        },
        source,
        {
            "error": with_arcs(both=BothStated.REFUSED),
            "radius": with_arcs(both=BothStated.RADIUS_COUNTS),
        },
    )


def negative_radius_setting(source: Source) -> Setting:
    """The setting of an arc of 180 degrees and more by its radius."""
    return setting(
        "negative-radius",
        "what a negative radius of an arc is",
        {"over_180": "an arc of more than 180 deg", "error": "refused: by a radius arcs are less than 180 deg"},
        source,
        {"error": with_arcs(refuses_negative=True)},
    )


def off_arc_setting(source: Source) -> Setting:
    """The setting of the path where radii differ and the control does not look."""
    return setting(
        "off-arc",
        "what the control cuts where the radii differ and it does not stop",
        {"spiral": "a spiral", "axis_line": "an arc, then a straight line along one axis"},
        source,
        {"axis_line": with_arcs(unchecked=Beyond.AXIS_LINE)},
    )


def centres_setting(source: Source) -> Setting:
    """The setting of from where the words of a centre count."""
    return setting(
        CENTRES,
        "from where I, J and K of an arc count",
        {"start": "from where the arc begins", "origin": "they are coordinates of the centre"},
        source,
        {"origin": with_arcs(counts_from_origin=True)},
    )


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


def printed(manual: str, place: str) -> Source:
    """The source of what a page prints."""
    return Source(manual, place, Evidence.PRINTED)


def assumed(manual: str, place: str) -> Source:
    """The source of what is recalled, or taken to be so."""
    return Source(manual, place, Evidence.ASSUMED)
