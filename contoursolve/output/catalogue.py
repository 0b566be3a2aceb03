"""The catalogue as text: the rules of each control, and the further facts that can be stated about a contour."""

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from msgspec import Struct

from contoursolve.diagnosis import tabulate
from contoursolve.diagnostics import Alarm, Source, check_type, members
from contoursolve.output.plain_text import Excerpt, RecordView, Table, columns
from contoursolve.reading import THIS_CONTROL, Control, Rule, ZeroMove, ZeroRow


def catalogue_lines(controls: Iterable[Control]) -> list[str]:
    """One line a rule: code, severity, evidence, the control's alarm, message."""
    lines: list[str] = []
    for control in controls:
        rows = [
            (rule.code, rule.severity.value, rule.source.evidence.value, _alarm(rule), rule.title)
            for rule in sorted(control.catalogue, key=lambda rule: rule.code)
        ]
        header = ("code", "severity", "evidence", "alarm", "message")
        lines += [f"{control.name}: {control.title}", *columns([header, *rows], left=(0, 1, 2, 3, 4)), ""]
        lines += _zero_lines(control)
        lines += _setting_lines(control)
    return lines


def catalogue_data(controls: Iterable[Control]) -> dict[str, Any]:
    """The same as plain data for JSON, with the advice and the examples of each rule: schema contoursolve/rules/1."""
    told = [
        {
            **members(control, "name title"),
            "rules": [
                {**members(rule, _FIELDS), "options": rule.options.replace(THIS_CONTROL, control.name)}
                for rule in sorted(control.catalogue, key=lambda rule: rule.code)
            ],
            "zero": [members(each, "names move source") for each in _moves_of_zero(control)],
            "settings": [members(each, "name meaning values default bounds unit source") for each in control.settings],
            "assumptions": [members(each, "name meaning source") for each in control.assumptions],
        }
        for control in controls
    ]
    return {"schema": "contoursolve/rules/1", "controls": told}


_FIELDS = "code severity message=title advice note source alarm wrong=rejected right=accepted"


def _zero_lines(control: Control) -> Iterator[str]:
    """Lines about what moves the coordinate system."""
    for row in _moves_of_zero(control):
        yield f"zero {control.name}: {row.names}: {row.move.value} ({row.source})"
    yield ""


def _moves_of_zero(control: Control) -> Iterator[ZeroRow]:
    """The moves of the coordinate system, rows that are alike as one: of codes in a row, the first and the last one."""
    table, names = control.modes.zero, dict[tuple[ZeroMove, Source], list[str]]()
    for name, row in table.names.items():
        names.setdefault((row.move, row.source), []).append(name)
    for row in table.beside:
        names.setdefault((row.move, row.source), []).extend(row.names.split(", "))
    for (move, source), each in names.items():
        parts = list[list[str]]()
        for name in each:
            here, before = _NUMBERED.fullmatch(name), _NUMBERED.fullmatch(parts[-1][-1] if parts else "")
            if here and before and here[1] == before[1] and int(here[2]) == int(before[2]) + 1:
                parts[-1].append(name)
            else:
                parts.append([name])
        told = (one[0] if len(one) == 1 else f"{one[0]} to {one[-1]}" for one in parts)
        yield ZeroRow(", ".join(told), move, source)


_NUMBERED = re.compile(r"(.*?)(\d+)")


def _setting_lines(control: Control) -> Iterator[str]:
    """Lines of the settings, for what the manual leaves open: each with its values, the default one marked."""
    for setting in control.settings:
        name = f"{control.name}.{setting.name}"
        yield f"setting {name}: {setting.meaning} ({setting.source})"
        rows = [
            (f"--setting {name}={value}", "default" if value == setting.default else "", meaning)
            for value, meaning in setting.values.items()
        ]
        yield from columns(rows, left=(0, 1, 2))
        if setting.bounds or setting.names:
            yield setting.choices("").capitalize()
        yield ""
    for each in control.assumptions:
        yield f"assumption {control.name}.{each.name}: {each.meaning} ({each.source})"
    if control.assumptions:
        yield ""


def word_set_lines(controls: Iterable[Control]) -> Iterator[str]:
    """Legality and determinacy of every set of words of every form."""
    for control in controls:
        sampled = [form for form in control.forms if form.table.sample is not None]
        if not sampled:
            yield f"{control.name}: this control has no table of word sets, because none of its forms has a sample"
        for form in sampled:
            blocks = " / ".join(form.table.sample.blocks if form.table.sample else ())
            yield f"{control.name} {form.name}, {form.title}: words of {blocks} | the manual's rules | the equations"
            yield from (str(row) for row in tabulate(form, control))
            yield ""


def _alarm(rule: Rule) -> str:
    return f"{rule.alarm.number.split()[0]} ({rule.alarm.evidence.value})" if rule.alarm else "-"


def rule_view(rule: Rule, controls: Sequence[str]) -> RecordView:
    """Everything about one rule: in words, a wrong block, a right one, the place in the manual; where several controls
    have it, it is the row of the first one."""
    rule = rule.told
    facts = [
        ("what to do", rule.advice),
        *([("good to know", rule.note)] if rule.note else []),
        ("source", str(rule.source)),
        ("control", f"alarm {rule.alarm.number} ({rule.alarm.evidence.value})" if rule.alarm else "no alarm known"),
        ("applies to", ", ".join(controls)),
        *([("examples", f"as {controls[0]} has them; --control NAME shows another's")] if controls[1:] else []),
        *([("not met", f"here, because {rule.absent}")] if rule.absent else []),
    ]
    parts: list[str | Table | Excerpt] = ["", Table("The rule", ("", ""), facts, left=(0, 1), is_headed=False)]
    told = f", with {rule.options.replace(THIS_CONTROL, controls[0])}" if rule.options else ""
    for title, examples in ((f"wrong{told}", rule.rejected), ("right", rule.accepted)):
        parts += [Excerpt(title, "\n".join(map(_short, each.split("\n")))) for each in examples]
    if rule.file:
        name, _, text = rule.file.partition("\n")
        parts.append(Excerpt(f"the file {name} beside it", text))
    return RecordView(f"{rule.code} ({rule.severity.value}): {rule.title}", parts)


def rule_page(code: str, controls: Iterable[Control]) -> str:
    """A page of Markdown about a rule: what is wrong and what to do, with blocks that are wrong and right.

    It names the place in the manual of each control that has the rule. Raises LookupError if none has it.
    """
    check_type("code", code, str)
    found = [(each, rule) for each in controls for rule in each.catalogue if rule.code == code]
    if not found:
        raise LookupError(f"no rule has the code {code!r}")
    alike: dict[tuple[str, ...], list[tuple[Control, Rule]]] = {}
    for control, rule in found:
        alike.setdefault((rule.title, rule.advice, *rule.rejected), []).append((control, rule))
    pages = []
    for rows in alike.values():
        titles, rule = ", ".join(each.title for each, _ in rows), rows[0][1]
        told = (f"{rule.title}.", f"What to do: {rule.advice}.", rule.note and f"Good to know: {rule.note}.")
        alarm = f"Alarm of the control: {rule.alarm.number} ({rule.alarm.evidence.value})." if rule.alarm else ""
        source = f"Source: {rule.source}."
        pages += [f"## {titles}", *filter(None, told), *filter(None, (alarm, source))]
        for title, examples in (("Wrong:", rule.rejected), ("Right:", rule.accepted)):
            pages += [line for each in examples for line in (title, f"```gcode\n{each}\n```")]
    return "\n\n".join((f"# {code}", *pages)) + "\n"


class AlarmRow(Struct, frozen=True):
    """An alarm of a control, and the rule that tells what it is about."""

    alarm: Alarm
    control: str
    rule: Rule

    @property
    def numbers(self) -> tuple[str, ...]:
        """Its numbers: the first word, and in `051 or 052` the third one, too; of a name without one, all of it."""
        words = self.alarm.number.split()
        found = words[: 3 if words[1:2] == ["or"] else 1 : 2]
        return tuple(found) if found[0][-1].isdigit() else (self.alarm.number,)

    def is_called(self, number: str) -> bool:
        """Whether a number means it: 55 is 055 of older controls and PS0055 of newer ones."""
        return _plainly(number) in map(_plainly, self.numbers)


def _plainly(number: str) -> str:
    return number.strip().lower().removeprefix("ps").lstrip("0")


def alarm_rows(controls: Iterable[Control]) -> Iterator[AlarmRow]:
    """The alarms of controls: those of their rules, and those about the radius of a tool."""
    from contoursolve.controls import TOOL_FACTS  # noqa: PLC0415 - few ask for alarms
    from contoursolve.tool_radius import ToolFaultKind  # noqa: PLC0415 - the same

    for control in controls:
        yield from (AlarmRow(rule.alarm, control.name, rule) for rule in control.catalogue if rule.alarm)
        facts = TOOL_FACTS.get(control.name)
        for kind, alarm in facts.alarms.items() if facts else ():
            yield AlarmRow(alarm, control.name, ToolFaultKind[kind.upper()].rule)


def _short(line: str) -> str:
    return line if len(line) <= 100 else line[:96] + " ..."  # noqa: PLR2004 - a terminal's width


# Facts -------------------------------------------------------------------------------------------------------

_FACTS = (
    ("length of line 1 = 30", "the length of a line between its virtual intersections; of an arc"),
    ("straight part of line 2 = 12.5", "what the corners at its ends leave of a line"),
    ("direction of line 2 = 135", "the direction of travel, as an angle word states it"),
    ("angle from line 1 to line 2 = -60", "the change of direction of travel, counter-clockwise positive"),
    ("line 2 passes through (Z-40. X80.)", "a place on the whole line, or on the whole circle of an arc or a rounding"),
    ("line 2 passes beside (Z-40. X80.) at 5", "or a place beside it, at a distance, on either side"),
    ("end of line 2 lies on line 1", "the begin, end or center of an element is on the whole of another one"),
    ("end of line 2 lies on line (Z0. X30. A180.)", "or on a given line or circle: as far as that"),
    ("line 3 parallel to line 1", "two lines run in the same direction, or against each other"),
    ("line 3 parallel to line 1 at 10", "and at a distance, on either side; at 0 both lie on one line"),
    ("chord of corner 1 = 6", "straight from the begin to the end of an arc or a rounding"),
    ("polar angle of arc = 90", "the angle from the plane's first axis to where an arc ends, seen from its center"),
    ("polar angle of begin of arc = 0", "or to where it begins"),
    ("corner 2.end Z = -50.2", "a coordinate of where an element begins or ends, or of its center"),
    ("Z of end of corner 2 = -50.2", "the same"),
    ("V1 X = 44", "a coordinate of a point; `end` is the end of the path"),
    ("radius of corner 1 = 5", "the radius of an arc or a rounding, the size of a chamfer"),
    ("line tangent to arc", "neighbours go on smoothly; others touch"),
    ("line 2 tangent to circle (Z-40. X120. R10.)", "an element touches a given circle"),
    ("corner 1 tangent to line (Z0. X30. A180.)", "an arc or a rounding touches a given line, by a place and an angle"),
    ("length of line 1 = length of line 2", "two lines are equally long"),
    ("radius of corner 1 = radius of corner 2", "two arcs or corners have the same radius"),
    ("corner 2 meets next line", "the last corner joins the line to where the next block ends"),
    ("corner 2 meets line to (Z-60. X130.)", "or a line to a place"),
    ("corner 2 meets line at 135", "or a line at an angle"),
    ("length of line 1 = ?", "asks for a value instead of stating it; so does ? in a word: P?"),
)


def vocabulary_lines() -> Iterator[str]:
    """Every kind of fact, with an example."""
    yield "Facts about a contour, stated with --fact, or in the program as a comment that controls ignore:"
    yield "  G111 X100. A180. K-30. B120. P? (contoursolve: straight part of line 2 = 30)"
    yield "  8 FL AN+80 X? ; contoursolve: length of line 8 = 50"
    yield ""
    yield from columns(_FACTS, left=(0, 1))
    yield ""
    yield "Elements: G111 has line 1, line 2, corner 1, corner 2 and the points S, V1, V2; an NCT circular-linear"
    yield "pair has arc, line and the points S, C (center), N1 (point on the circle), P1 (intersection), N2 (end)."
    yield "A free contour FK has line 8, arc 9 and corner 10 by the numbers of its blocks; points S, P8, C9 (center)."
    yield "A line begins and ends at its virtual intersections; where corners cut it off, it is the corner that begins"
    yield "or ends: `end of line 1` is V1, and `begin of corner 1` is where the rounding leaves line 1."
    yield "Numbers are in the unit of the program and mean what they say, with or without a decimal point; X is a"
    yield "diameter on a lathe. Capitals do not matter. Inside a comment in ( ) write places with [ ], because the"
    yield "first ) ends the comment. Separate facts by semicolons."
