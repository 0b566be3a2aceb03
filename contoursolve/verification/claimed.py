"""A claimed result, read from JSON of schema contoursolve/solve/1 into records; unknown fields are left alone."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from contoursolve.model import Turn
from contoursolve.verification.document import Document
from contoursolve.verification.node import Coordinates, Node, read_json, shown

SCHEMA = "contoursolve/solve/1"


class ClaimedStatus(Enum):
    """What the result says became of a contour."""

    SOLVED = "solved"
    REJECTED = "rejected"
    UNDERDETERMINED = "underdetermined"
    OVERDETERMINED = "overdetermined"
    CONFLICTING = "conflicting"
    NO_SOLUTION = "no-solution"


class ElementKind(Enum):
    """What an element of a path is."""

    LINE = "line"
    ARC = "arc"


@dataclass(frozen=True, slots=True)
class ClaimedArc:
    """The circle of an arc and the sense in which it is travelled; radius in mm."""

    center: Coordinates
    radius: float
    turn: Turn


@dataclass(frozen=True, slots=True)
class ClaimedElement:
    """One element of a path; `arc` is None for a line."""

    start: Coordinates
    end: Coordinates
    arc: ClaimedArc | None

    @property
    def kind(self) -> ElementKind:
        """Line or arc."""
        return ElementKind.LINE if self.arc is None else ElementKind.ARC


@dataclass(frozen=True, slots=True)
class ClaimedCertificate:
    """How well the result says its points are known: `radius` in mm, None where it names none."""

    kind: str
    radius: float | None


@dataclass(frozen=True, slots=True)
class ClaimedContour:
    """One contour of the result; the coordinates of `start` are None where the result does not know them."""

    line: int
    lines: tuple[int, ...]
    form: str
    status: ClaimedStatus
    plane: tuple[str, ...]
    start: tuple[float | None, ...]
    end: Coordinates | None
    points: Mapping[str, Coordinates]
    elements: tuple[ClaimedElement, ...]
    branch: str | None
    certificate: ClaimedCertificate

    @property
    def is_empty(self) -> bool:
        """Whether nothing of a path is claimed."""
        return self.end is None and not self.points and not self.elements

    @property
    def has_path(self) -> bool:
        """Whether a path must be claimed. An overdetermined contour may have none: no-solution ranks after it."""
        is_over = self.status is ClaimedStatus.OVERDETERMINED
        return self.status is ClaimedStatus.SOLVED or (is_over and not self.is_empty)


@dataclass(frozen=True, slots=True)
class ClaimedResult:
    """Everything of a result that can be checked; `control` is None where it names none."""

    control: str | None
    contours: tuple[ClaimedContour, ...]


def read_result(document: Document) -> ClaimedResult:
    """The claims of a result. Raises CannotVerifyError, which names the field that is missing or mistyped."""
    root = read_json(document)
    schema = root.field("schema").text()
    if schema != SCHEMA:
        root.field("schema").refuse(f"{shown(schema)} where {SCHEMA!r} is read: write it by 'solve --format json'")
    control = root.field("control").optional()
    return ClaimedResult(
        control.text() if control else None,
        tuple(_contour(node) for node in root.field("contours").items()),
    )


def _contour(node: Node) -> ClaimedContour:
    end, branch = node.field("end").optional(), node.field("branch").optional()
    certificate = node.field("certificate")
    radius = certificate.field("radius").optional()
    starts = (each.optional() for each in node.field("start").pair())
    return ClaimedContour(
        line=node.field("line").integer(),
        lines=tuple(each.integer() for each in node.field("lines").items()),
        form=node.field("form").text(),
        status=ClaimedStatus(node.field("status").choice(tuple(each.value for each in ClaimedStatus))),
        plane=tuple(each.text() for each in node.field("plane").pair()),
        start=tuple(each.number() if each else None for each in starts),
        end=end.coordinates() if end else None,
        points={name: each.coordinates() for name, each in node.field("points").fields().items()},
        elements=tuple(_element(each) for each in node.field("elements").items()),
        branch=branch.text() if branch else None,
        certificate=ClaimedCertificate(certificate.field("kind").text(), radius.number() if radius else None),
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
