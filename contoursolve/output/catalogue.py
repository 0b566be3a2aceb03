"""The catalogue of rules as text."""

from collections.abc import Iterable, Iterator

from contoursolve.diagnosis import tabulate
from contoursolve.dialects import Dialect
from contoursolve.output.layout import columns
from contoursolve.rules import Rule


def catalogue_lines(dialects: Iterable[Dialect]) -> list[str]:
    """One line a rule: code, severity, evidence, the control's alarm, message."""
    lines: list[str] = []
    for dialect in dialects:
        rows = [
            (rule.code, rule.severity.value, rule.source.evidence.value, _alarm(rule), rule.title)
            for rule in sorted(dialect.rules, key=lambda rule: rule.code)
        ]
        header = ("code", "severity", "evidence", "alarm", "message")
        lines += [f"{dialect.name}: {dialect.title}", *columns([header, *rows], left=(0, 1, 2, 3, 4)), ""]
        lines += _setting_lines(dialect)
    return lines


def _setting_lines(dialect: Dialect) -> Iterator[str]:
    """What the manual does not say: each setting with its values, the default one marked."""
    for setting in dialect.settings:
        name = f"{dialect.name}.{setting.name}"
        yield f"setting {name}: {setting.meaning} ({setting.source})"
        rows = [
            (f"--set {name}={value}", "default" if value == setting.default else "", meaning)
            for value, meaning in setting.values.items()
        ]
        yield from columns(rows, left=(0, 1, 2))
        if setting.bounds:
            yield setting.choices("").capitalize()
        yield ""
    for each in dialect.assumptions:
        yield f"assumption {dialect.name}.{each.name}: {each.meaning} ({each.source})"
    if dialect.assumptions:
        yield ""


def table_lines(dialects: Iterable[Dialect]) -> Iterator[str]:
    """Legality and determinacy of every set of words of every form."""
    for dialect in dialects:
        sampled = [form for form in dialect.forms if form.sample is not None]
        if not sampled:
            yield f"{dialect.name}: this control has no table of word sets, because none of its forms has a sample"
        for form in sampled:
            blocks = " / ".join(form.sample.blocks if form.sample else ())
            yield f"{dialect.name} {form.name}, {form.title}: words of {blocks} | the manual's rules | the equations"
            yield from (str(row) for row in tabulate(form, dialect))
            yield ""


def _alarm(rule: Rule) -> str:
    return f"{rule.alarm.number.split()[0]} ({rule.alarm.evidence.value})" if rule.alarm else "-"


def rule_lines(rule: Rule, controls: Iterable[str]) -> list[str]:
    """Everything about one rule: in words, a wrong block, a right one, the place in the manual."""
    lines = [f"{rule.code} ({rule.severity.value}): {rule.title}", ""]
    facts = [
        ("what to do", rule.advice),
        *([("good to know", rule.note)] if rule.note else []),
        ("source", str(rule.source)),
        ("control", f"alarm {rule.alarm.number} ({rule.alarm.evidence.value})" if rule.alarm else "no alarm known"),
        ("applies to", ", ".join(controls)),
    ]
    lines += columns(facts, left=(0, 1))
    for title, examples in (("wrong", rule.rejected), ("right", rule.accepted)):
        for example in examples:
            lines += ["", f"  {title}:", *(f"    {_short(line)}" for line in example.split("\n"))]
    return lines


def _short(line: str) -> str:
    return line if len(line) <= 100 else line[:96] + " ..."  # noqa: PLR2004 - a terminal's width
