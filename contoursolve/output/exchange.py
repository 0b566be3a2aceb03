"""Findings for other tools: SARIF 2.1.0 for editors and code scanning, GitHub's annotations, GitLab's code quality, and
JUnit's XML for servers that show tests."""

import hashlib
import os
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path, PurePath
from typing import Any
from urllib.parse import quote
from xml.etree import ElementTree

from contoursolve.controls import DIALECTS
from contoursolve.diagnostics import Applicability, Diagnostic, Fix, Severity, json_text
from contoursolve.output.baseline import subjects_of
from contoursolve.program import Result, changes_of
from contoursolve.reading import Dialect, Rule

_LEVEL = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}
_COMMAND = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


def to_sarif(results: Sequence[Result], version: str, own: Dialect | None = None) -> str:
    """One SARIF log (OASIS SARIF 2.1.0): every rule of the catalogue declared, every finding a result. `own` is a
    control that is not built in.

    A result's fingerprint is made of the rule, the text of the line and how often both have occurred
    before, so that it stays the same when lines are inserted elsewhere.
    """
    from contoursolve.tool_radius import ToolFaultKind  # noqa: PLC0415 - only here

    controls = [*DIALECTS.values(), *([own] if own else [])]
    known = {rule.code: rule for dialect in controls for rule in dialect.rules}
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
            message = _escape(_told(finding), "")
            lines.append(f"::{_COMMAND[finding.severity]} {properties}::{message}")
    return "\n".join(lines)


def _told(finding: Diagnostic) -> str:
    """A finding in words: what is wrong, why, and the first fix."""
    return "\n".join((finding.message, *finding.notes, *(f"fix: {fix.description}" for fix in finding.fixes[:1])))


def _escape(text: str, more: str) -> str:
    for character in "%\r\n" + more:
        text = text.replace(character, f"%{ord(character):02X}")
    return text


_QUALITY = {Severity.ERROR: "major", Severity.WARNING: "minor", Severity.INFO: "info"}


def to_gitlab(results: Iterable[Result]) -> str:
    """One code quality report of GitLab: a JSON list of findings. Paths are relative to the repository, which is
    `CI_PROJECT_DIR`, or else the current folder. A fingerprint stays the same when lines are inserted elsewhere; a
    program that is named twice has its findings once."""
    rows: dict[str, dict[str, Any]] = {}
    for result in results:
        path = _in_repository(result.program.name)
        for finding, subject in subjects_of(result):
            fingerprint = _fingerprint(path, *subject)
            rows[fingerprint] = {
                "description": finding.message,
                "check_name": finding.code,
                "fingerprint": fingerprint,
                "severity": _QUALITY[finding.severity],
                "location": {"path": path, "lines": {"begin": max(result.place(finding.span).line, 1)}},
            }
    return json_text([*rows.values()])


def _in_repository(name: str) -> str:
    """The name of a file from the repository on; of a file elsewhere the whole one."""
    if name.startswith("<"):
        return name
    path = PurePath(os.path.normpath(Path.cwd() / name))
    root = PurePath(os.environ.get("CI_PROJECT_DIR") or Path.cwd())
    return (path.relative_to(root) if path.is_relative_to(root) else path).as_posix()


def to_junit(results: Iterable[Result], failing: Collection[Severity], unexamined: Mapping[str, str]) -> str:
    """One document of JUnit's XML: a suite for each program, in it a test for each finding, or one that passes where
    there is none. A finding of a severity in `failing` is a failure; others pass, and their text is their output.
    `unexamined` has the reasons of programs that could not be examined, by their names; each is an error."""
    root = ElementTree.Element("testsuites", name="contoursolve")
    for result in results:
        suite = _suite(root, result.program.name)
        for finding in result.diagnostics:
            span = result.place(finding.span)
            case = _case(suite, f"{finding.code}, line {max(span.line, 1)}, column {span.column}")
            place = f"{result.program.name}:{max(span.line, 1)}:{span.column}"
            fails = finding.severity in failing
            about = {"message": _in_xml(finding.message), "type": finding.code} if fails else {}
            outcome = ElementTree.SubElement(case, "failure" if fails else "system-out", about)
            outcome.text = _in_xml(f"{place}: {finding.severity.value}: {_told(finding)}")
        if not result.diagnostics:
            _case(suite, "no findings")
    for name, reason in unexamined.items():
        case = _case(_suite(root, name), "examination")
        ElementTree.SubElement(case, "error", message=_in_xml(reason), type="not-examined").text = _in_xml(reason)
    for each in (*root, root):
        for counted, kind in (("tests", "testcase"), ("failures", "failure"), ("errors", "error")):
            each.set(counted, str(sum(1 for _ in each.iter(kind))))
    ElementTree.indent(root)
    document: bytes = ElementTree.tostring(root, "us-ascii")
    return document.decode("ascii")


def _suite(root: ElementTree.Element, name: str) -> ElementTree.Element:
    return ElementTree.SubElement(root, "testsuite", name=_in_xml(name))


def _case(suite: ElementTree.Element, name: str) -> ElementTree.Element:
    program = str(PurePath(suite.get("name", "")).with_suffix("").as_posix())
    return ElementTree.SubElement(suite, "testcase", name=name, classname=program)


def _in_xml(text: str) -> str:
    """The text without characters that no document of XML may have."""
    return _NOT_IN_XML.sub("\ufffd", text)


_NOT_IN_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
