"""Results as plain data for JSON: schema contoursolve/solve/1."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from contoursolve.contour import ArcSegment, Contour, Segment
from contoursolve.data import json_text
from contoursolve.diagnostic import Diagnosis, Diagnostic
from contoursolve.examine import Answer, AskedValue
from contoursolve.output.solutions import DECIMALS, decimals_of, list_solutions, printed_certificate
from contoursolve.pipeline import Result
from contoursolve.solving import Point
from contoursolve.solving.certificate import Certificate, Proof
from contoursolve.source import Source, Span


def to_json(result: Result) -> str:
    """The contours and findings of one program; lengths in mm, X of a lathe as radius, angles in degrees."""
    return _document(
        {
            "schema": "contoursolve/solve/1",
            "program": result.program.name,
            "control": result.control,
            "rules": result.policy.value,
            "settings": {f"{result.control}.{name}": value for name, value in sorted(result.settings.items())},
        },
        contours=map(_contour, result.answers),
        diagnostics=(finding_data(each, result) for each in result.diagnostics),
    )


def findings_to_json(results: Sequence[Result]) -> str:
    """The findings of several programs; each finding names its program."""
    return _document(
        {"schema": "contoursolve/check/1"},
        programs=(
            {"program": each.program.name, "control": each.control, "contours": len(each.answers)} for each in results
        ),
        diagnostics=(
            {"program": result.program.name, **finding_data(each, result)}
            for result in results
            for each in result.diagnostics
        ),
    )


def _document(head: Mapping[str, Any], **lists: Iterable[Any]) -> str:
    """An object of texts and lists; each row becomes text by itself, for the data of all would fill the memory."""
    members = [f"{json_text(name)}: {_indented(value)}" for name, value in head.items()]
    for name, values in lists.items():
        rows = ",\n  ".join(_indented(value, 2) for value in values)
        members.append(f"{json_text(name)}: " + (f"[\n  {rows}\n ]" if rows else "[]"))
    return "{\n " + ",\n ".join(members) + "\n}"


def _indented(data: Any, depth: int = 1) -> str:
    return json_text(data).replace("\n", "\n" + " " * depth)


def finding_data(finding: Diagnostic, result: Result) -> dict[str, Any]:
    """One finding as plain data. What is about a fact or a start point stated apart stands at the block, with the place
    in the fact or the start point."""
    return {
        "code": finding.code,
        "severity": finding.severity.value,
        **_place(finding.span, result),
        "message": finding.message,
        "help": finding.help,
        "notes": list(finding.notes),
        "labels": [{**_place(label.span, result), "text": label.text} for label in finding.labels],
        "addresses": list(finding.addresses),
        "basis": finding.basis.value,
        "source": _source(finding.source),
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


def _source(source: Source) -> dict[str, str]:
    return {"manual": source.manual, "place": source.place, "evidence": source.evidence.value}


def _place(span: Span, result: Result) -> dict[str, Any]:
    shown, columns = result.place(span), {"column": span.column, "end_column": span.end_column}
    apart: dict[str, Any] = {}
    if span.line <= 0:
        apart = {"fact": {"number": -span.line, **columns}} if span.line else {"start": columns}
    return {"line": shown.line, "column": shown.column, "end_column": shown.end_column, **apart}


def _contour(answer: Answer) -> dict[str, Any]:
    contour, certificate = answer.contour, answer.certificate
    decimals = decimals_of(certificate)
    return {
        "line": answer.lines[0],
        "lines": list(answer.lines),
        "form": answer.form,
        "status": answer.status.value,
        "plane": list(answer.plane.axes),
        "start": [None if value is None else _number(float(value)) for value in answer.start.values],
        **_path(contour, decimals),
        "branch": ", ".join(side.value for side in answer.sides.values()) or None,
        "branches": {point: side.value for point, side in answer.sides.items()},
        "certificate": _certificate(certificate),
        "conventions": [
            {
                "setting": each.setting.name,
                "value": each.value,
                "meaning": each.meaning,
                "evidence": each.evidence.value,
            }
            for each in answer.claim.conventions
        ],
        "assumptions": [
            {"name": each.name, "meaning": each.meaning, "source": _source(each.source)} for each in answer.assumptions
        ],
        "facts": [directive.text for directive in answer.claim.directives],
        "asked": [_asked(each, answer) for each in answer.answers],
        "filled": {"blocks": list(answer.filled.blocks), "deviation_mm": _number(answer.filled.deviation)}
        if answer.filled
        else None,
        **_solutions(answer),
        "diagnosis": _diagnosis(answer.diagnosis) if answer.diagnosis else None,
    }


def _path(contour: Contour | None, decimals: int) -> dict[str, Any]:
    return {
        "end": _point(contour.end, decimals) if contour else None,
        "points": {name: _point(at, decimals) for name, at in contour.points.items()} if contour else {},
        "elements": [_element(element, decimals) for element in contour.elements] if contour else [],
    }


def _certificate(certificate: Certificate | None) -> dict[str, Any]:
    printed = printed_certificate(certificate)
    if printed is None:
        return {"kind": Proof.UNKNOWN.value, "radius": None, "reason": "there is no contour", "double": None}
    return {
        "kind": printed.proof.value,
        "radius": _finite(printed.radius),
        "reason": printed.reason,
        "double": {"gap_mm": _finite(printed.gap)} if printed.gap is not None else None,
    }


def _asked(asked: AskedValue, answer: Answer) -> dict[str, Any]:
    """A value that was asked for, in mm (X of a lathe as radius) or degrees."""
    question = asked.question
    return {
        "word": question.word.text,
        "line": question.word.span.line,
        "unit": question.unit.value,
        "value": None if asked.value is None else round(asked.value, decimals_of(answer.certificate)) + 0.0,
    }


def _solutions(answer: Answer) -> dict[str, Any]:
    """Every solution of the equations, and whether these are proven to be all."""
    listing = list_solutions(answer)
    if listing is None:
        return {"solutions": [], "count": None}
    solutions = [
        {
            "name": each.name,
            "is_chosen": each.is_chosen,
            "selects": list(each.selects),
            "is_path": each.contour is not None,
            "reasons": list(each.reasons),
            "asked": [_asked(value, answer) for value in each.asked],
            **_path(each.contour, decimals_of(each.certificate)),
            "certificate": _certificate(each.certificate),
        }
        for each in listing.solutions
    ]
    count = {
        "solutions": len(solutions),
        "contours": sum(each.contour is not None for each in listing.solutions),
        "is_complete": listing.is_complete,
        "method": listing.method,
        "doubts": list(listing.doubts),
        "chosen_by": listing.chosen_by,
    }
    return {"solutions": solutions, "count": count}


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


def _element(element: Segment, decimals: int) -> dict[str, Any]:
    start, end = _point(element.start, decimals), _point(element.end, decimals)
    data: dict[str, Any] = {"kind": "line", "start": start, "end": end}
    if isinstance(element, ArcSegment):
        data["kind"] = "arc"
        data["center"] = _point(element.center, decimals)
        data["radius"] = _number(element.radius, decimals)
        data["turn"] = element.turn.value
    return data


def _point(at: Point, decimals: int) -> list[float]:
    return [_number(at[0], decimals), _number(at[1], decimals)]


def _number(value: float, decimals: int = DECIMALS) -> float:
    return round(value, decimals) + 0.0


def _finite(value: float) -> float | None:
    """Infinity, which JSON cannot hold, as null."""
    return value if abs(value) < float("inf") else None
