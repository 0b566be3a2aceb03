"""A finding as text, in the layout that compilers use: the place, the words marked, why, and what to do."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from contoursolve.diagnosis import count, join
from contoursolve.diagnostics import DRAWN, Applicability, Diagnostic, Fix, Label, Severity
from contoursolve.gcode import FaultKind
from contoursolve.output.plain_text import cells, printable
from contoursolve.reading import ReadIssue

WIDTH = 100
"""Characters of a program line shown around the place."""

SHOWN_NOTES, SHOWN_FIXES = 2, 2
"""Reasons and fixes shown where nobody asks for all."""

EXPLAINING = "contoursolve check --explain"

APPLICABILITY = {
    Applicability.SAFE: "same contour",
    Applicability.CHANGES_CONTOUR: "changes the contour",
    Applicability.PLACEHOLDER: "fill in",
}
"""Effect of a fix, as text."""


def effect_of(fix: Fix, finding: Diagnostic) -> str:
    """The effect of a fix as text; a fix of text that is no word is a typing error, for it changes no contour."""
    if fix.effect:
        return fix.effect
    is_unread = isinstance(finding.about, FaultKind) or finding.about is ReadIssue.UNKNOWN_ADDRESS
    if is_unread and fix.applicability is Applicability.CHANGES_CONTOUR:
        return "typing error"
    return APPLICABILITY[fix.applicability]


_CONCLUDED = (ReadIssue.CONTROL_ALIKE, ReadIssue.CONTROL_CALLED, ReadIssue.MACHINE_TAKEN)

Piece = tuple[str, str]
"""A text and its role: error, warning, info, frame, bold, place (line and column of the program), or none."""

Style = Callable[[str, str], str]
"""(text, role) to styled text."""


def plain(text: str, _role: str) -> str:
    """No style."""
    return text


def words_of(finding: Diagnostic) -> tuple[Severity, str, object]:
    """The words of a finding about a place, equal to those of others that say the same; fixes hold for one place."""
    own = finding.span if finding.fixes or finding.span.line <= 0 else None
    return finding.severity, finding.code, (finding.message, finding.notes, finding.help, own)


def alike(findings: Iterable[Diagnostic]) -> list[list[Diagnostic]]:
    """Findings in the same words together, in the order of the first ones."""
    found: dict[object, list[Diagnostic]] = {}
    for each in findings:
        found.setdefault(words_of(each), []).append(each)
    return [*found.values()]


MOST_LINES = 12
"""Lines that are named where several findings say the same."""


def lines_text(lines: Sequence[int]) -> str:
    """The lines of a program in which the same is found: `program lines 3, 5 and 7`."""
    more = [f"{len(lines) - MOST_LINES:,} more"] if len(lines) > MOST_LINES else []
    return f"program line{'s' * (len(lines) > 1)} {join([*map(str, lines[:MOST_LINES]), *more])}"


def finding_lines(
    finding: Diagnostic,
    name: str,
    sources: Mapping[int, str],
    style: Style = plain,
    *,
    is_explained: bool = False,
    explaining: str = EXPLAINING,
    following: str = "",
) -> list[str]:
    """The lines of one finding, explained with all that is known about it; `sources` are the texts of the program's
    lines by number, as far as they are known, `explaining` the command that explains it; `following` says what follows
    from it."""
    lines = finding_pieces(
        finding, name, sources, is_explained=is_explained, explaining=explaining, following=following
    )
    return ["".join(style(text, role) if role else text for text, role in line) for line in lines]


def finding_pieces(
    finding: Diagnostic,
    name: str,
    sources: Mapping[int, str],
    *,
    is_explained: bool = True,
    explaining: str = EXPLAINING,
    following: str = "",
) -> list[list[Piece]]:
    """The same lines, each as the pieces that a style may set apart."""
    role = finding.severity.value
    heading: list[Piece] = [(f"{role}[{finding.code}]", role), (f": {finding.message}", "bold")]
    if finding.about in _CONCLUDED and not is_explained:
        # It is about no place in the program.
        return [[(printable(text), kind) for text, kind in heading], []]
    gutter = max((len(_margin(label.span.line)) for label in finding.labels), default=1)
    bar: list[Piece] = [(" " * (gutter + 1), ""), ("|", "frame")]
    place = f"{printable(name)}:{finding.span.line}:{finding.span.column}"
    if finding.span.line <= 0:
        place = f"{_margin(finding.span.line)}:{finding.span.column}"
    lines: list[list[Piece]] = [
        heading,
        [(" " * gutter, ""), ("-->", "frame"), (" ", ""), (place, "place")],
        bar,
    ]
    by_line: dict[int, list[Label]] = {}
    for label in finding.labels:
        by_line.setdefault(label.span.line, []).append(label)
    for number in sorted(by_line):
        if number not in sources:
            places = (f"{_margin(number)}:{each.span.column}: {each.text}" for each in by_line[number] if each.text)
            lines += [[*bar, (f" {place}", "")] for place in places]
            continue
        text, labels, shift = _window(sources[number], by_line[number])
        lines.append([(f"{_margin(number):>{gutter}} |", "frame"), (f" {text}", "")])
        primary = finding.labels[0]
        lines += [[*bar, (" ", ""), *marks] for marks in _marks(labels, shift, primary, text, role)]
    foot: list[Piece] = [(" " * (gutter + 1), ""), ("=", "frame")]
    notes = finding.notes if is_explained else finding.notes[:SHOWN_NOTES]
    fixes = finding.fixes if is_explained else finding.fixes[:SHOWN_FIXES]
    lines += [[*foot, (f" {note}", "")] for note in notes]
    # A fix says what the help says, with its number; a help that the message says already says nothing.
    is_said = finding.message.endswith(finding.help) or bool(fixes if not is_explained else ())
    if finding.help and not is_said and not any(fix.applicability is Applicability.SAFE for fix in fixes):
        lines.append([*foot, (f" help: {finding.help}", "")])
    for fix in fixes:
        lines.append([*foot, (f" fix [{effect_of(fix, finding)}]: {fix.description}", "")])
        if fix.applicability is not Applicability.PLACEHOLDER:
            lines += [[(f"{' ' * (gutter + 4)} {line}", "")] for line in _written(fix, finding, name)]
    if len(finding.fixes) > len(fixes):
        more = len(finding.fixes) - len(fixes)
        lines.append([*foot, (f" {count(more, 'more fix', 'more fixes')}: {explaining} lists all", "")])
    if is_explained or finding.source.is_of_manual:
        lines.append([*foot, (f" source: {finding.source}", "")])
    alarm = finding.alarm and f"control: alarm {finding.alarm.number} ({finding.alarm.evidence.value})"
    lines += [[*foot, (f" {text}", "")] for text in (alarm, following) if text]
    # A message may quote what a fact says.
    return [*([(printable(text), kind) for text, kind in line] for line in lines), []]


def _written(fix: Fix, finding: Diagnostic, name: str) -> Iterator[str]:
    """The lines that a fix writes: those of the contour that it changes, or all if their number changes; then those
    beside with their numbers, as they are and as they become."""
    if not fix.beside or fix.replacement != fix.replaced:
        new, old = fix.replacement.split("\n"), fix.replaced.split("\n")
        changed = (
            [text for text, before in zip(new, old, strict=True) if text != before] if len(new) == len(old) else new
        )
        yield from map(_line, changed)
    for each in fix.beside:
        yield f"line {each.span.line} of {name}:" if finding.source == DRAWN else f"program line {each.span.line}:"
        texts = each.text.split("\n")
        yield f"  {_line(each.old)}" if each.old in texts else f"- {_line(each.old)}"
        yield from (f"+ {_line(text)}" for text in texts if text and text != each.old)


def _line(text: str) -> str:
    return printable(text.strip())[:WIDTH]


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


def _marks(labels: list[Label], shift: int, primary: Label, text: str, role: str) -> list[list[Piece]]:
    """Underlines of all labels on one line, then their texts from the last to the first."""
    ordered = sorted(labels, key=lambda label: label.span)
    marks: list[Piece] = []
    column = 0
    for label in ordered:
        begin = max(label.span.column - 1 - shift, column)
        end = begin + max(1, min(label.span.end_column - 1 - shift, len(text)) - begin)
        is_primary = label == primary
        marks += [
            (" " * cells(text, column, begin), ""),
            (("^" if is_primary else "-") * max(1, cells(text, begin, end)), role if is_primary else "frame"),
        ]
        column = end
    texts = [label for label in reversed(ordered) if label.text]
    if texts and texts[0] is ordered[-1]:
        marks.append((f" {texts.pop(0).text}", ""))
    return [marks, *([(" " * cells(text, 0, label.span.column - 1 - shift) + label.text, "")] for label in texts)]
