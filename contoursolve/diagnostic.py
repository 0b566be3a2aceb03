"""One finding about a program, complete enough for a terminal, JSON and an editor."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from contoursolve.source import Evidence, Source, Span


class Severity(Enum):
    """How bad a finding is; only `ERROR` makes a command exit with 1."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


class Basis(Enum):
    """What kind of reasoning a finding rests on."""

    RULE = "rule"
    """Text or words alone: grammar, or a rule of the control's manual."""
    STRUCTURAL = "structural"
    """Which equation mentions which unknown."""
    SYMBOLIC = "symbolic"
    """The equations for all values of the words."""
    NUMERICAL = "numerical"
    """The equations at the values of this block."""


class Applicability(Enum):
    """What applying a fix does to the contour."""

    SAFE = "safe"
    CHANGES_CONTOUR = "changes-contour"
    PLACEHOLDER = "placeholder"


@dataclass(frozen=True, slots=True)
class Fix:
    """A whole new block to write instead."""

    description: str
    replacement: str
    applicability: Applicability


@dataclass(frozen=True, slots=True)
class Label:
    """A remark beside a stretch of the program."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Alarm:
    """The number (and name) with which the control itself would stop."""

    number: str
    evidence: Evidence


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding.

    `message` stands alone on one line; `labels` mark the words, the first one is the place of the
    finding; `notes` say why, `help` says what to do. `values` holds `limit`, `expected`, `actual`
    and `off_by_mm` as far as they apply (mm, X as radius; degrees for angles).
    """

    code: str
    severity: Severity
    basis: Basis
    span: Span
    message: str
    source: Source
    labels: tuple[Label, ...] = ()
    addresses: tuple[str, ...] = ()
    alarm: Alarm | None = None
    values: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    help: str = ""
    fixes: tuple[Fix, ...] = ()
