"""Adds to the findings of a contour why they are so, and what to write instead."""

from collections.abc import Iterator
from dataclasses import replace

from contoursolve.diagnosis.affine import AffineFacts, Circuit, affine_facts
from contoursolve.diagnosis.identities import identity
from contoursolve.diagnosis.layers import list_layers
from contoursolve.diagnosis.reasons import conflict_reasons, freedom_reasons, path_reasons, place_text
from contoursolve.diagnosis.repairs import Repair, find_repairs
from contoursolve.diagnostic import Diagnosis, Diagnostic, Fix, Severity, Tie
from contoursolve.dialects import Dialect
from contoursolve.examine import Answer, Policy
from contoursolve.model import scalar
from contoursolve.tolerance import AGREEMENT


def diagnose(answer: Answer, dialect: Dialect, policy: Policy) -> Answer:
    """The answer with a diagnosis; its findings with their reasons, the first one with the repairs."""
    profile = answer.profile
    affine = affine_facts(profile, (*profile.facts, *profile.ignored))
    is_readable = not any(block.faults for block in answer.claim.blocks)
    circuits = affine.circuits() if affine and is_readable else ()
    freedoms = affine.freedoms() if affine and is_readable else ()
    diagnosis = Diagnosis(
        layers=list_layers(answer, policy),
        freedoms=freedoms,
        ties=tuple(_tie(answer, circuit) for circuit in circuits),
        is_complete=affine is not None,
    )
    findings = [
        replace(finding, notes=(*finding.notes, *_reasons(answer, affine, circuits, diagnosis, finding)))
        for finding in answer.diagnostics
    ]
    main = next((index for index, finding in enumerate(findings) if finding.severity is not Severity.INFO), None)
    if main is not None:
        repairs = find_repairs(answer, dialect).repairs
        fixes = tuple(_fix(answer, repair) for repair in repairs)
        findings[main] = replace(findings[main], fixes=fixes)
    return replace(answer, diagnostics=tuple(findings), diagnosis=diagnosis)


def _tie(answer: Answer, circuit: Circuit) -> Tie:
    givens = answer.profile.givens
    words = (givens[fact.given].word for fact in circuit.facts if fact.given)
    return Tie(
        addresses=tuple(word.address for word in words if word),
        identity=identity(fact.given for fact in circuit.facts),
        off_by_mm=max(circuit.off),
        is_conflict=max(circuit.off) > AGREEMENT,
    )


def _reasons(
    answer: Answer,
    affine: AffineFacts | None,
    circuits: tuple[Circuit, ...],
    diagnosis: Diagnosis,
    finding: Diagnostic,
) -> Iterator[str]:
    profile = answer.profile
    if affine is not None and finding.code.endswith(_ABOUT_TIES):
        for circuit in circuits:
            words = (profile.givens[fact.given].word for fact in circuit.facts if fact.given)
            if any(word and word.address in finding.addresses for word in words):
                yield from conflict_reasons(profile, affine, circuit)
    if finding.code.endswith(_ABOUT_FREEDOM):
        yield from freedom_reasons(profile, diagnosis.freedoms)
    yield from path_reasons(profile, affine, finding)


_ABOUT_TIES = ("-conflict", "-redundant", "-ignored", "-parallel", "-not-fixed")
_ABOUT_FREEDOM = ("-missing", "-not-fixed")


def _fix(answer: Answer, repair: Repair) -> Fix:
    """A repair in words, with the place where the contour then ends or turns."""
    description = "; ".join(str(edit) for edit in repair.edits)
    if repair.contour:
        profile, contour = answer.profile, repair.contour
        name, at = "the contour ends", contour.end
        if answer.contour is None and len(answer.lines) > 1:
            name, at = "P1 is", contour.points["P1"]
        place = place_text(profile, {scalar("", axis): value for axis, value in enumerate(at)})
        description += f" -> {name} at {place}"
    return Fix(description, repair.replacement, repair.applicability)
