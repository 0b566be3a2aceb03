"""A finding as text, in the layout that compilers use: the place, the words marked, why, and what to do."""

from collections.abc import Callable, Mapping

from contoursolve.diagnostic import Applicability, Diagnostic, Label
from contoursolve.output.layout import printable

WIDTH = 100
"""Characters of a program line shown around the place."""

SHOWN_FIXES = 4
"""Fixes shown in text."""

_APPLICABILITY = {
    Applicability.SAFE: "same contour",
    Applicability.CHANGES_CONTOUR: "changes the contour",
    Applicability.PLACEHOLDER: "needs a number",
}

Style = Callable[[str, str], str]
"""(text, role) to styled text; roles are error, warning, info, frame and bold."""


def plain(text: str, _role: str) -> str:
    """No style."""
    return text


def finding_lines(finding: Diagnostic, name: str, sources: Mapping[int, str], style: Style = plain) -> list[str]:
    """The lines of one finding; `sources` are the texts of the program's lines by number."""
    role = finding.severity.value
    title = style(f"{role}[{finding.code}]", role) + style(f": {finding.message}", "bold")
    gutter = max((len(_margin(label.span.line)) for label in finding.labels), default=1)
    bar = " " * (gutter + 1) + style("|", "frame")
    place = f"{name}:{finding.span.line}:{finding.span.column}"
    if finding.span.line <= 0:
        place = f"{_margin(finding.span.line)}:{finding.span.column}"
    lines = [title, " " * gutter + style("-->", "frame") + f" {place}", bar]
    by_line: dict[int, list[Label]] = {}
    for label in finding.labels:
        by_line.setdefault(label.span.line, []).append(label)
    for number in sorted(by_line):
        text, labels, shift = _window(sources.get(number, ""), by_line[number])
        lines.append(style(f"{_margin(number):>{gutter}} |", "frame") + f" {text}")
        primary = finding.labels[0]
        lines += [f"{bar} {line}" for line in _marks(labels, shift, primary, len(text), style, role)]
    foot = " " * (gutter + 1) + style("=", "frame")
    lines += [f"{foot} {note}" for note in finding.notes]
    if finding.help and not any(fix.applicability is Applicability.SAFE for fix in finding.fixes):
        lines.append(f"{foot} help: {finding.help}")
    for fix in finding.fixes[:SHOWN_FIXES]:
        lines.append(f"{foot} fix [{_APPLICABILITY[fix.applicability]}]: {fix.description}")
        if fix.applicability is not Applicability.PLACEHOLDER:
            lines += [f"{' ' * (gutter + 4)} {printable(line.strip())[:WIDTH]}" for line in fix.replacement.split("\n")]
    if len(finding.fixes) > SHOWN_FIXES:
        lines.append(f"{foot} and {len(finding.fixes) - SHOWN_FIXES} more fixes (--format json lists all)")
    lines.append(f"{foot} source: {finding.source}")
    if finding.alarm:
        lines.append(f"{foot} control: alarm {finding.alarm.number} ({finding.alarm.evidence.value})")
    return [*lines, ""]


def _margin(line: int) -> str:
    """A line of the program, or what was stated apart from it."""
    if line > 0:
        return str(line)
    return f"--fact {-line}" if line else "--start"


def _window(text: str, labels: list[Label]) -> tuple[str, list[Label], int]:
    """The part of a long line around its first mark, and how far it is shifted to the left."""
    shown = printable(text)
    if len(shown) <= WIDTH:
        return shown, labels, 0
    start = max(0, min(label.span.column for label in labels) - 1 - WIDTH // 3)
    visible = [label for label in labels if label.span.column - 1 < start + WIDTH]
    part = shown[start : start + WIDTH]
    head = "..." if start else ""
    return head + part + ("..." if start + WIDTH < len(shown) else ""), visible, start - len(head)


def _marks(labels: list[Label], shift: int, primary: Label, width: int, style: Style, role: str) -> list[str]:
    """Underlines of all labels on one line, then their texts from the last to the first."""
    ordered = sorted(labels, key=lambda label: label.span)
    marks, column = "", 0
    for label in ordered:
        begin = max(label.span.column - 1 - shift, column)
        length = max(1, min(label.span.end_column - 1 - shift, width) - begin)
        mark = ("^" if label == primary else "-") * length
        marks += " " * (begin - column) + style(mark, role if label == primary else "frame")
        column = begin + length
    texts = [label for label in reversed(ordered) if label.text]
    if texts and texts[0] is ordered[-1]:
        marks += f" {texts.pop(0).text}"
    return [marks, *(" " * max(label.span.column - 1 - shift, 0) + label.text for label in texts)]
