"""Findings for other tools: SARIF 2.1.0 for editors and code scanning, and GitHub's annotations."""

import hashlib
from collections.abc import Iterable, Sequence
from pathlib import PurePath
from typing import Any
from urllib.parse import quote

from contoursolve.controls import CONTROLS
from contoursolve.diagnostics import Applicability, Diagnostic, Fix, Severity, json_text
from contoursolve.output.baseline import subjects_of
from contoursolve.program import Result, changes_of
from contoursolve.reading import Control, Rule

_LEVEL = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}
_COMMAND = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


def to_sarif(results: Sequence[Result], version: str, own: Control | None = None) -> str:
    """One SARIF log (OASIS SARIF 2.1.0): every rule of the catalogue declared, every finding a result. `own` is a
    control that is not built in.

    A result's fingerprint is made of the rule, the text of the line and how often both have occurred
    before, so that it stays the same when lines are inserted elsewhere.
    """
    from contoursolve.tool_radius import ToolFaultKind  # noqa: PLC0415 - only here

    controls = [*CONTROLS.values(), *([own] if own else [])]
    known = {rule.code: rule for control in controls for rule in control.rules}
    told = {finding.code for result in results for finding in result.diagnostics}
    rules = sorted((known | {kind.code: kind.rule for kind in ToolFaultKind if kind.code in told}).items())
    index = {code: number for number, (code, _) in enumerate(rules)}
    run = {
        "tool": {"driver": {"name": "contoursolve", "version": version, "rules": [_rule(rule) for _, rule in rules]}},
        "columnKind": "unicodeCodePoints",
        "results": [each for result in results for each in _results(result, index)],
    }
    log = {"$schema": "https://json.schemastore.org/sarif-2.1.0.json", "version": "2.1.0", "runs": [run]}
    return json_text(log)


def _rule(rule: Rule) -> dict[str, Any]:
    return {
        "id": rule.code,
        "shortDescription": {"text": rule.title},
        "fullDescription": {"text": f"{rule.title}. {rule.source}."},
        "help": {"text": rule.advice},
        "defaultConfiguration": {"level": _LEVEL[rule.severity]},
        "properties": {"evidence": rule.source.evidence.value, "alarm": rule.alarm.number if rule.alarm else None},
    }


def _results(result: Result, index: dict[str, int]) -> Iterable[dict[str, Any]]:
    for finding, subject in subjects_of(result):
        data: dict[str, Any] = {
            "ruleId": finding.code,
            "ruleIndex": index[finding.code],
            "level": _LEVEL[finding.severity],
            "message": {"text": "\n".join((finding.message, *finding.notes))},
            "locations": [_location(result, finding)],
            "partialFingerprints": {"contoursolve/v1": _fingerprint(*subject)},
            "properties": {"basis": finding.basis.value, "values": _finite(finding)},
        }
        fixes = [
            _fix(result, finding, fix) for fix in finding.fixes if fix.applicability is not Applicability.PLACEHOLDER
        ]
        if fixes:
            data["fixes"] = fixes
        yield data


def _fingerprint(*parts: object) -> str:
    return hashlib.sha256("\n".join(map(str, parts)).encode(errors="backslashreplace")).hexdigest()


def _finite(finding: Diagnostic) -> dict[str, float]:
    return {name: value for name, value in finding.values.items() if abs(value) < float("inf")}


def _uri(result: Result) -> dict[str, str]:
    """The file as a relative or absolute URI (RFC 3986)."""
    path = PurePath(result.program.name)
    return {"uri": path.as_uri() if path.is_absolute() else quote(path.as_posix(), errors="surrogateescape")}


def _location(result: Result, finding: Diagnostic) -> dict[str, Any]:
    span = result.place(finding.span)
    region = {"startLine": max(span.line, 1), "startColumn": span.column, "endColumn": span.end_column}
    return {"physicalLocation": {"artifactLocation": _uri(result), "region": region}}


def _fix(result: Result, finding: Diagnostic, fix: Fix) -> dict[str, Any]:
    texts = {block.line: block.text for block in result.program.blocks}
    changes = []
    for line, text in changes_of(fix, result.lines_of(finding), texts).items():
        region = {"startLine": line, "startColumn": 1, "endColumn": len(texts[line]) + 1}
        if text is None and line + 1 in texts:
            region = {"startLine": line, "startColumn": 1, "endLine": line + 1, "endColumn": 1}
        changes.append({"deletedRegion": region, "insertedContent": {"text": text or ""}})
    return {
        "description": {"text": fix.description},
        "artifactChanges": [{"artifactLocation": _uri(result), "replacements": changes}],
    }


def to_github(results: Iterable[Result]) -> str:
    """One workflow command a finding, which GitHub shows beside the line (Actions, workflow commands)."""
    lines = []
    for result in results:
        for finding in result.diagnostics:
            span = result.place(finding.span)
            place = {
                "file": PurePath(result.program.name).as_posix(),
                "line": max(span.line, 1),
                "col": span.column,
                "endColumn": span.end_column,
                "title": finding.code,
            }
            properties = ",".join(f"{name}={_escape(str(value), ':,')}" for name, value in place.items())
            parts = (finding.message, *finding.notes, *(f"fix: {fix.description}" for fix in finding.fixes[:1]))
            message = _escape("\n".join(parts), "")
            lines.append(f"::{_COMMAND[finding.severity]} {properties}::{message}")
    return "\n".join(lines)


def _escape(text: str, more: str) -> str:
    for character in "%\r\n" + more:
        text = text.replace(character, f"%{ord(character):02X}")
    return text
