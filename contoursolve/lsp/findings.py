"""Findings as a client shows them, and their fixes as edits."""

from collections.abc import Iterator, Mapping, Sequence

from lsprotocol import types

from contoursolve import Diagnostic, Fix, Severity
from contoursolve.editing import changes_of, likely_fixes, mend_open, safe_fixes
from contoursolve.lsp.opened import FIX_ALL, Opened
from contoursolve.lsp.positions import edits, edits_to

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
    page = opened.pages.uri(finding.code, opened.program.control)
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


_CODE, _WAY, _URI = "code", "way", "uri"
_WAYS = {SAFE: safe_fixes, "likely": likely_fixes}
"""The fixes of one kind of finding that an action applies."""


def actions_of(opened: Opened, wanted: types.Range) -> Iterator[types.CodeAction]:
    """The fixes of all findings in a range, those first that keep the contour; then fixes for all findings of their
    kinds, and the explanation of each."""
    codes, control = dict[str, types.Diagnostic](), opened.program.control
    for finding, lines in opened.program.found():
        place = _range(opened, finding.span)
        if place.start.line > wanted.end.line or place.end.line < wanted.start.line:
            continue
        if not _meets(place, wanted):
            continue
        shown = _diagnostic(opened, finding)
        codes.setdefault(finding.code, shown)
        old = {line: opened.places.text(line) for line in lines}
        for fix in finding.fixes:
            changes = edits(opened.places, changes_of(fix, lines, old))
            title = fix.description
            yield types.CodeAction(
                title=title if len(title) <= LONGEST_TITLE else f"{title[: LONGEST_TITLE - 3]}...",
                kind=types.CodeActionKind.QuickFix,
                diagnostics=[shown],
                is_preferred=fix.applicability.value == SAFE,
                edit=opened.workspace_edit(changes),
            )
    for code, shown in codes.items():
        yield from _fixes_of_kind(opened, code, shown)
    if control is not None:
        for code, shown in codes.items():
            command = types.Command(f"Explain {code}", "contoursolve.explain", arguments=[code, control.name])
            yield types.CodeAction(command.title, types.CodeActionKind.QuickFix, [shown], command=command)


def _fixes_of_kind(opened: Opened, code: str, shown: types.Diagnostic) -> Iterator[types.CodeAction]:
    """The actions that fix all findings of a code, if there are several; their edits are made when one is chosen."""
    alike = [finding for finding, _ in opened.program.found() if finding.code == code]
    safe, likely = (sum(bool(way(each)) for each in alike) for way in _WAYS.values())
    is_other = any([*likely_fixes(each)[:1]] != [*safe_fixes(each)[:1]] for each in alike)
    for way, count, effect in ((SAFE, safe, "same contour"), ("likely", likely, "by the first fix of each")):
        if count > 1 and (way == SAFE or is_other):
            title, data = f"Fix all {count} {code} ({effect})", {_URI: opened.uri, _CODE: code, _WAY: way}
            yield types.CodeAction(title, types.CodeActionKind.QuickFix, diagnostics=[shown], data=data)


def fix_all(opened: Opened) -> Iterator[types.CodeAction]:
    """The action that applies all fixes that keep the contour, if there is one; its edit is made when it is chosen."""
    if any(safe_fixes(finding) for finding, _ in opened.program.found()):
        yield types.CodeAction("Fix all that keep the contour", FIX_ALL, data={_URI: opened.uri, _WAY: SAFE})


def uri_of(action: types.CodeAction) -> str:
    """The program that an action is about; empty if it does not tell."""
    data = action.data if isinstance(action.data, Mapping) else {}
    return str(data.get(_URI, ""))


def with_edit(opened: Opened, action: types.CodeAction) -> types.CodeAction:
    """An action that fixes several findings with its edit: each fix is checked in the whole program."""
    data = action.data if isinstance(action.data, Mapping) else {}
    way, code = _WAYS.get(data.get(_WAY, "")), data.get(_CODE)
    if way is None:
        return action

    def wanted(finding: Diagnostic) -> Sequence[Fix]:
        return way(finding) if code in (None, finding.code) else ()

    mended = mend_open(opened.program, wanted)
    edit = opened.workspace_edit(edits_to(opened.places, mended.text))
    return types.CodeAction(action.title, action.kind, action.diagnostics, edit=edit, data=action.data)


def _meets(one: types.Range, other: types.Range) -> bool:
    """Whether two ranges have a place in common; where one ends the other may begin."""
    return (one.start.line, one.start.character) <= (other.end.line, other.end.character) and (
        other.start.line,
        other.start.character,
    ) <= (one.end.line, one.end.character)
