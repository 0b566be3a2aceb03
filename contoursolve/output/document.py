"""Results as plain data for JSON: schema contoursolve/solve/1."""

import json
from collections.abc import Sequence
from typing import Any

from contoursolve.contour import ArcSegment, Segment
from contoursolve.diagnostic import Diagnosis, Diagnostic
from contoursolve.examine import Answer
from contoursolve.pipeline import Result
from contoursolve.solving import Point

DECIMALS = 12
"""Decimals of coordinates in mm: below the rounding of the arithmetic, so that nothing is lost."""


def to_json(result: Result) -> str:
    """The contours and findings of one program; lengths in mm, X of a lathe as radius, angles in degrees."""
    return _dump(
        {
            "schema": "contoursolve/solve/1",
            "program": result.program.name,
            "control": result.control,
            "contours": [_contour(answer) for answer in result.answers],
            "diagnostics": [finding_data(each) for each in result.diagnostics],
        }
    )


def findings_to_json(results: Sequence[Result]) -> str:
    """The findings of several programs; each finding names its program."""
    return _dump(
        {
            "schema": "contoursolve/check/1",
            "programs": [
                {"program": each.program.name, "control": each.control, "contours": len(each.answers)}
                for each in results
            ],
            "diagnostics": [
                {"program": result.program.name, **finding_data(each)}
                for result in results
                for each in result.diagnostics
            ],
        }
    )


def _dump(document: dict[str, Any]) -> str:
    return json.dumps(document, indent=1, ensure_ascii=True, allow_nan=False)


def finding_data(finding: Diagnostic) -> dict[str, Any]:
    """One finding as plain data."""
    return {
        "code": finding.code,
        "severity": finding.severity.value,
        "line": finding.span.line,
        "column": finding.span.column,
        "end_column": finding.span.end_column,
        "message": finding.message,
        "help": finding.help,
        "notes": list(finding.notes),
        "labels": [
            {
                "line": label.span.line,
                "column": label.span.column,
                "end_column": label.span.end_column,
                "text": label.text,
            }
            for label in finding.labels
        ],
        "addresses": list(finding.addresses),
        "basis": finding.basis.value,
        "source": {
            "manual": finding.source.manual,
            "place": finding.source.place,
            "evidence": finding.source.evidence.value,
        },
        "alarm": {"number": finding.alarm.number, "evidence": finding.alarm.evidence.value} if finding.alarm else None,
        "values": {name: _finite(value) for name, value in finding.values.items()},
        "fixes": [
            {
                "description": fix.description,
                "replacement": fix.replacement,
                "applicability": fix.applicability.value,
            }
            for fix in finding.fixes
        ],
    }


def _contour(answer: Answer) -> dict[str, Any]:
    contour = answer.contour
    return {
        "line": answer.lines[0],
        "lines": list(answer.lines),
        "form": answer.form,
        "status": answer.status.value,
        "plane": list(answer.plane.axes),
        "start": [None if value is None else _number(float(value)) for value in answer.start.values],
        "end": _point(contour.end) if contour else None,
        "points": {name: _point(at) for name, at in contour.points.items()} if contour else {},
        "elements": [_element(element) for element in contour.elements] if contour else [],
        "branch": answer.side.value if answer.side else None,
        "certificate": {"kind": "verified", "radius": _finite(answer.error_bound)}
        if contour
        else {"kind": "unknown", "radius": None},
        "diagnosis": _diagnosis(answer.diagnosis) if answer.diagnosis else None,
    }


def _diagnosis(diagnosis: Diagnosis) -> dict[str, Any]:
    return {
        "layers": [
            {"name": layer.name, "verdict": layer.verdict.value, "remark": layer.remark} for layer in diagnosis.layers
        ],
        "freedoms": [
            {"point": each.point, "direction": list(each.direction) if each.direction else None, "angle": each.angle}
            for each in diagnosis.freedoms
        ],
        "ties": [
            {
                "addresses": list(tie.addresses),
                "identity": tie.identity,
                "off_by_mm": tie.off_by_mm,
                "is_conflict": tie.is_conflict,
            }
            for tie in diagnosis.ties
        ],
        "ties_complete": diagnosis.ties_complete,
        "repairs_complete": diagnosis.repairs_complete,
    }


def _element(element: Segment) -> dict[str, Any]:
    data: dict[str, Any] = {"kind": "line", "start": _point(element.start), "end": _point(element.end)}
    if isinstance(element, ArcSegment):
        data["kind"] = "arc"
        data["center"] = _point(element.center)
        data["radius"] = _number(element.radius)
        data["turn"] = element.turn.value
    return data


def _point(at: Point) -> list[float]:
    return [_number(at[0]), _number(at[1])]


def _number(value: float) -> float:
    return round(value, DECIMALS) + 0.0


def _finite(value: float) -> float | None:
    """Infinity, which JSON cannot hold, as null."""
    return value if abs(value) < float("inf") else None
