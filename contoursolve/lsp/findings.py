"""Findings as a client shows them, and their fixes as edits."""

from collections.abc import Iterator

from lsprotocol import types

from contoursolve import Diagnostic, Severity
from contoursolve.lsp.opened import Opened
from contoursolve.lsp.positions import edits

_SEVERITY = {
    Severity.ERROR: types.DiagnosticSeverity.Error,
    Severity.WARNING: types.DiagnosticSeverity.Warning,
    Severity.INFO: types.DiagnosticSeverity.Information,
}

SOURCE = "contoursolve"
CONTROL_UNKNOWN, MORE = "control-unknown", "more-findings"
SAFE = "safe"

_ADVICE = "; choose one in the editor's settings, or name it in a comment: (contoursolve control: NAME)"
LONGEST_TITLE = 160

MOST_FINDINGS = 500
"""Of one program. A program for another control may have some in every line, and no editor shows them all."""


def diagnostics_of(opened: Opened) -> list[types.Diagnostic]:
    """All findings about an open program."""
    place, warns = opened.places.whole(1, 1), types.DiagnosticSeverity.Warning
    asked = opened.program.trouble if opened.program.is_ambiguous else ""
    told = (f"{each}{_ADVICE if each == asked else ''}" for each in opened.troubles)
    troubles = [types.Diagnostic(place, each, warns, CONTROL_UNKNOWN, source=SOURCE) for each in told]
    if opened.program.trouble:
        return troubles
    findings = opened.program.diagnostics
    shown = [_diagnostic(opened, finding) for finding in findings[:MOST_FINDINGS]]
    if len(findings) > MOST_FINDINGS:
        more = f"{len(findings) - MOST_FINDINGS:,} more findings from here on"
        message = f"{more}: fix the first ones, or run `contoursolve check` for all"
        place = _range(opened, findings[MOST_FINDINGS].span)
        shown.append(types.Diagnostic(place, message, warns, MORE, source=SOURCE))
    return [*troubles, *shown]


def _diagnostic(opened: Opened, finding: Diagnostic) -> types.Diagnostic:
    page = opened.pages.uri(finding.code, opened.program.dialect)
    related = [
        types.DiagnosticRelatedInformation(types.Location(opened.uri, _range(opened, label.span)), label.text)
        for label in finding.labels
        if label.text and label.span != finding.span and label.span.line > 0
    ]
    return types.Diagnostic(
        range=_range(opened, finding.span),
        message=_message(finding),
        severity=_SEVERITY[finding.severity],
        code=finding.code,
        code_description=types.CodeDescription(page) if page else None,
        source=SOURCE,
        related_information=related if opened.tells_related else None,
    )


def _message(finding: Diagnostic) -> str:
    lines = [finding.message, *finding.notes]
    if finding.help and not finding.fixes and not finding.message.endswith(finding.help):
        lines.append(f"help: {finding.help}")
    if finding.source.is_of_manual:
        lines.append(f"source: {finding.source}")
    if finding.alarm:
        lines.append(f"control: alarm {finding.alarm.number} ({finding.alarm.evidence.value})")
    return "\n".join(lines)


def _range(opened: Opened, span: tuple[int, int, int]) -> types.Range:
    line, column, end_column = span
    if line < 1:
        return opened.places.range(1, 1, 2)
    return opened.places.range(line, column, max(end_column, column + 1))


def actions_of(opened: Opened, wanted: types.Range) -> Iterator[types.CodeAction]:
    """The fixes of all findings in a range, those first that keep the contour; and the explanation of each."""
    explanations = {}
    for finding, lines in opened.program.found():
        place = _range(opened, finding.span)
        if place.start.line > wanted.end.line or place.end.line < wanted.start.line:
            continue
        if not _meets(place, wanted):
            continue
        shown = _diagnostic(opened, finding)
        for fix in finding.fixes:
            changes = edits(opened.places, [*fix.by_line(lines).items()], opened.line_end)
            title = fix.description
            yield types.CodeAction(
                title=title if len(title) <= LONGEST_TITLE else f"{title[: LONGEST_TITLE - 3]}...",
                kind=types.CodeActionKind.QuickFix,
                diagnostics=[shown],
                is_preferred=fix.applicability.value == SAFE,
                edit=opened.workspace_edit(changes),
            )
        if finding.code not in explanations and opened.program.dialect is not None:
            arguments = [finding.code, opened.program.dialect.name]
            command = types.Command(f"Explain {finding.code}", "contoursolve.explain", arguments=arguments)
            explanations[finding.code] = types.CodeAction(
                command.title, kind=types.CodeActionKind.QuickFix, diagnostics=[shown], command=command
            )
    yield from explanations.values()


def _meets(one: types.Range, other: types.Range) -> bool:
    """Whether two ranges have a place in common; where one ends the other may begin."""
    return (one.start.line, one.start.character) <= (other.end.line, other.end.character) and (
        other.start.line,
        other.start.character,
    ) <= (one.end.line, one.end.character)
