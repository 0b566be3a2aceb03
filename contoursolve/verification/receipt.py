"""The receipt of a verification: what was checked against what, and the verdict, as records and as JSON."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

from contoursolve.data import json_text
from contoursolve.model import Length
from contoursolve.verification.claimed import Rules
from contoursolve.verification.document import Document
from contoursolve.verification.ledger import Check, Omission

SCHEMA = "contoursolve/verify/1"


class Verdict(Enum):
    """The answer; that nothing was checked is not the same as that nothing is wrong."""

    VERIFIED = "verified"
    """A path was checked, or why there is none, and everything that was checked is right."""
    FAILED = "failed"
    """Something is wrong."""
    NOTHING_CHECKED = "nothing-checked"
    """Nothing is wrong, but there was no path to check, and why there is none was not worked out."""


@dataclass(frozen=True, slots=True)
class ContourReceipt:
    """The checks of one contour; `status` is the claimed one, None where the result does not mention it."""

    line: int
    lines: tuple[int, ...]
    form: str
    status: str | None
    verdict: Verdict
    checks: tuple[Check, ...]
    omissions: tuple[Omission, ...]


@dataclass(frozen=True, slots=True)
class Receipt:
    """The verdict on a result, with the bytes that it is about; `control` is None where neither input tells.

    `rules` is the policy that the result names; `start` and `facts` are what was given apart from the program.
    """

    program: Document
    result: Document
    control: str | None
    unit: Length
    contours: tuple[ContourReceipt, ...]
    omissions: tuple[Omission, ...]
    rules: Rules | None = None
    start: str | None = None
    facts: tuple[str, ...] = ()
    settings: Mapping[str, str] = field(default_factory=dict)
    """Under which the program was read, as the result says, by `control.name`."""

    @property
    def verdict(self) -> Verdict:
        """The verdict on all contours together."""
        verdicts = [contour.verdict for contour in self.contours]
        for each in (Verdict.FAILED, Verdict.VERIFIED):
            if each in verdicts:
                return each
        return Verdict.NOTHING_CHECKED


def to_json(receipt: Receipt) -> str:
    """The receipt as JSON: the same bytes for the same inputs."""
    document = {
        "schema": SCHEMA,
        "verdict": receipt.verdict.value,
        "program": _document(receipt.program),
        "result": _document(receipt.result),
        "control": receipt.control,
        "units": receipt.unit.value,
        "rules": receipt.rules.value if receipt.rules else None,
        "settings": dict(receipt.settings),
        "start": receipt.start,
        "facts": list(receipt.facts),
        "contours": [_contour(each) for each in receipt.contours],
        "not_checked": [_omission(each) for each in receipt.omissions],
    }
    return json_text(document)


def _document(document: Document) -> dict[str, str]:
    return {"name": document.name, "sha256": document.checksum}


def _contour(contour: ContourReceipt) -> dict[str, Any]:
    return {
        "line": contour.line,
        "lines": list(contour.lines),
        "form": contour.form,
        "status": contour.status,
        "verdict": contour.verdict.value,
        "checks": [_check(each) for each in contour.checks],
        "not_checked": [_omission(each) for each in contour.omissions],
    }


def _check(check: Check) -> dict[str, Any]:
    return {
        "name": check.name,
        "words": list(check.words),
        "residual": _rounded(check.residual),
        "limit": _rounded(check.limit),
        "unit": check.unit or None,
        "passed": check.passed,
        "remark": check.remark,
    }


def _omission(omission: Omission) -> dict[str, str]:
    return {"what": omission.what, "why": omission.why}


def _rounded(value: float | None) -> float | None:
    """Three digits: more would be the noise of the machine's sine."""
    return None if value is None else float(f"{value:.3g}")
