"""Reads JSON of schema contoursolve/solve/1 into claims; unknown fields are left alone, newer ones may be missing."""

from contoursolve.model import Turn
from contoursolve.verification.claimed import (
    ClaimedArc,
    ClaimedAsked,
    ClaimedCertificate,
    ClaimedContour,
    ClaimedCount,
    ClaimedDiagnosis,
    ClaimedElement,
    ClaimedFilled,
    ClaimedFreedom,
    ClaimedPath,
    ClaimedResult,
    ClaimedSolution,
    ClaimedStatus,
    ClaimedTie,
    ElementKind,
    Rules,
)
from contoursolve.verification.document import Document
from contoursolve.verification.node import Node, read_json, shown

SCHEMA = "contoursolve/solve/1"

UNITS = ("mm", "deg", "sign")
"""What a value that is asked for is counted in."""


def read_result(document: Document) -> ClaimedResult:
    """The claims of a result. Raises CannotVerifyError, which names the field that is missing or mistyped."""
    root = read_json(document)
    schema = root.field("schema").text()
    if schema != SCHEMA:
        root.field("schema").refuse(f"{shown(schema)} where {SCHEMA!r} is read: write it by 'solve --format json'")
    control, rules, findings = root.field("control").optional(), root.maybe("rules"), root.maybe("diagnostics")
    settings = root.maybe("settings")
    return ClaimedResult(
        control.text() if control else None,
        Rules(rules.choice(tuple(each.value for each in Rules))) if rules else None,
        _named(settings) if settings else None,
        len(list(findings.items())) if findings else 0,
        tuple(_contour(node) for node in root.field("contours").items()),
    )


def _contour(node: Node) -> ClaimedContour:
    branch = node.field("branch").optional()
    starts = (each.optional() for each in node.field("start").pair())
    facts, asked, filled = node.maybe("facts"), node.maybe("asked"), node.maybe("filled")
    branches, conventions = node.maybe("branches"), node.maybe("conventions")
    solutions, count, diagnosis = node.maybe("solutions"), node.maybe("count"), node.maybe("diagnosis")
    return ClaimedContour(
        line=node.field("line").integer(),
        lines=tuple(each.integer() for each in node.field("lines").items()),
        form=node.field("form").text(),
        status=ClaimedStatus(node.field("status").choice(tuple(each.value for each in ClaimedStatus))),
        plane=tuple(each.text() for each in node.field("plane").pair()),
        start=tuple(each.number() if each else None for each in starts),
        path=_path(node),
        branch=branch.text() if branch else None,
        certificate=_certificate(node.field("certificate")),
        facts=_texts(facts) if facts else None,
        asked=tuple(_asked(each) for each in asked.items()) if asked else None,
        filled=_filled(filled) if filled else None,
        solutions=tuple(_solution(each) for each in solutions.items()) if solutions else None,
        count=_count(count) if count else None,
        diagnosis=_diagnosis(diagnosis) if diagnosis else None,
        branches=_named(branches) if branches else None,
        conventions=tuple(map(_convention, conventions.items())) if conventions else None,
    )


def _named(node: Node) -> dict[str, str]:
    return {name: each.text() for name, each in node.fields().items()}


def _convention(node: Node) -> tuple[str, str]:
    return node.field("setting").text(), node.field("value").text()


def _diagnosis(node: Node) -> ClaimedDiagnosis:
    return ClaimedDiagnosis(
        freedoms=tuple(_freedom(each) for each in node.field("freedoms").items()),
        ties=tuple(
            ClaimedTie(
                _texts(each.field("addresses")),
                each.field("off_by_mm").number(),
                each.field("is_conflict").boolean(),
            )
            for each in node.field("ties").items()
        ),
        ties_complete=node.field("ties_complete").boolean(),
    )


def _freedom(node: Node) -> ClaimedFreedom:
    direction, angle = node.field("direction").optional(), node.field("angle").optional()
    return ClaimedFreedom(
        point=node.field("point").text(),
        direction=direction.coordinates() if direction else None,
        angle=angle.number() if angle else None,
    )


def _path(node: Node) -> ClaimedPath:
    end = node.field("end").optional()
    return ClaimedPath(
        end=end.coordinates() if end else None,
        points={name: each.coordinates() for name, each in node.field("points").fields().items()},
        elements=tuple(_element(each) for each in node.field("elements").items()),
    )


def _certificate(node: Node) -> ClaimedCertificate:
    radius, reason = node.field("radius").optional(), node.maybe("reason")
    double = node.maybe("double")
    gap = double.field("gap_mm").optional() if double else None
    return ClaimedCertificate(
        kind=node.field("kind").text(),
        radius=radius.number() if radius else None,
        reason=reason.text() if reason else None,
        double=double is not None if "double" in node.fields() else None,
        gap=gap.number() if gap else None,
    )


def _texts(node: Node) -> tuple[str, ...]:
    return tuple(each.text() for each in node.items())


def _asked(node: Node) -> ClaimedAsked:
    value = node.field("value").optional()
    return ClaimedAsked(
        word=node.field("word").text(),
        line=node.field("line").whole(),
        unit=node.field("unit").choice(UNITS),
        value=value.number() if value else None,
    )


def _filled(node: Node) -> ClaimedFilled:
    return ClaimedFilled(_texts(node.field("blocks")), node.field("deviation_mm").number())


def _solution(node: Node) -> ClaimedSolution:
    asked = node.maybe("asked")
    return ClaimedSolution(
        name=node.field("name").text(),
        is_chosen=node.field("is_chosen").boolean(),
        selects=_texts(node.field("selects")),
        is_path=node.field("is_path").boolean(),
        reasons=_texts(node.field("reasons")),
        path=_path(node),
        certificate=_certificate(node.field("certificate")),
        asked=tuple(_asked(each) for each in asked.items()) if asked else None,
    )


def _count(node: Node) -> ClaimedCount:
    return ClaimedCount(
        solutions=node.field("solutions").integer(),
        contours=node.field("contours").integer(),
        is_complete=node.field("is_complete").boolean(),
        doubts=_texts(node.field("doubts")),
        chosen_by=node.field("chosen_by").text(),
    )


def _element(node: Node) -> ClaimedElement:
    kind = ElementKind(node.field("kind").choice(tuple(each.value for each in ElementKind)))
    return ClaimedElement(
        start=node.field("start").coordinates(),
        end=node.field("end").coordinates(),
        arc=_arc(node) if kind is ElementKind.ARC else None,
    )


def _arc(node: Node) -> ClaimedArc:
    turn = Turn(node.field("turn").choice(tuple(each.value for each in Turn)))
    return ClaimedArc(node.field("center").coordinates(), node.field("radius").number(), turn)
