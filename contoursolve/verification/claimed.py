"""A claimed result as records. What older results do not have is None."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from contoursolve.model import Turn
from contoursolve.verification.node import Coordinates


class ClaimedStatus(Enum):
    """What the result says became of a contour."""

    SOLVED = "solved"
    REJECTED = "rejected"
    UNDERDETERMINED = "underdetermined"
    OVERDETERMINED = "overdetermined"
    CONFLICTING = "conflicting"
    AMBIGUOUS = "ambiguous"
    NO_SOLUTION = "no-solution"
    UNDECIDED = "undecided"


class Rules(Enum):
    """What the rules of the manual did to a block that they refuse: it was not solved; it was, with a warning; they
    were not applied."""

    ENFORCE = "enforce"
    WARN = "warn"
    OFF = "off"


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
    """How well the result says its points are known: `radius` in mm, None where it names none.

    `reason` says why there is no better one. `double` tells that two solutions have become one; None where the
    result does not tell. `gap` (mm) is then how far they are from that.
    """

    kind: str
    radius: float | None
    reason: str | None = None
    double: bool | None = None
    gap: float | None = None


@dataclass(frozen=True, slots=True)
class ClaimedPath:
    """Where a path ends, its named points and its elements; all empty where there is none."""

    end: Coordinates | None
    points: Mapping[str, Coordinates]
    elements: tuple[ClaimedElement, ...]

    @property
    def is_empty(self) -> bool:
        """Whether nothing of a path is claimed."""
        return self.end is None and not self.points and not self.elements


@dataclass(frozen=True, slots=True)
class ClaimedAsked:
    """A value that was asked for: mm (radius) or degrees, as `unit` says; None where nothing determines it."""

    word: str
    line: int
    unit: str
    value: float | None


@dataclass(frozen=True, slots=True)
class ClaimedFilled:
    """The blocks with the values that were asked for, and how far their contour is from the claimed one, mm."""

    blocks: tuple[str, ...]
    deviation: float


@dataclass(frozen=True, slots=True)
class ClaimedSolution:
    """One solution of the equations; `path` is empty where the control cannot make it."""

    name: str
    is_chosen: bool
    selects: tuple[str, ...]
    is_path: bool
    reasons: tuple[str, ...]
    path: ClaimedPath
    certificate: ClaimedCertificate
    asked: tuple[ClaimedAsked, ...] | None = None


@dataclass(frozen=True, slots=True)
class ClaimedCount:
    """How many solutions there are said to be, and how many of them are paths."""

    solutions: int
    contours: int
    is_complete: bool
    doubts: tuple[str, ...]
    chosen_by: str


@dataclass(frozen=True, slots=True)
class ClaimedFreedom:
    """A point that can move: along a unit vector and at an angle in degrees, or anywhere if both are None."""

    point: str
    direction: Coordinates | None
    angle: float | None


@dataclass(frozen=True, slots=True)
class ClaimedTie:
    """Words that say the same, by their addresses, and by how much they disagree, mm."""

    addresses: tuple[str, ...]
    off_by_mm: float
    is_conflict: bool


@dataclass(frozen=True, slots=True)
class ClaimedDiagnosis:
    """What can still move, and which words say the same; `ties_complete` tells that all of these are named."""

    freedoms: tuple[ClaimedFreedom, ...]
    ties: tuple[ClaimedTie, ...]
    ties_complete: bool


@dataclass(frozen=True, slots=True)
class ClaimedContour:
    """One contour of the result; the coordinates of `start` are None where the result does not know them."""

    line: int
    lines: tuple[int, ...]
    form: str
    status: ClaimedStatus
    plane: tuple[str, ...]
    start: tuple[float | None, ...]
    path: ClaimedPath
    branch: str | None
    certificate: ClaimedCertificate
    facts: tuple[str, ...] | None = None
    asked: tuple[ClaimedAsked, ...] | None = None
    filled: ClaimedFilled | None = None
    solutions: tuple[ClaimedSolution, ...] | None = None
    count: ClaimedCount | None = None
    diagnosis: ClaimedDiagnosis | None = None
    branches: Mapping[str, str] | None = None
    """The branch of each intersection, by its point."""
    conventions: tuple[tuple[str, str], ...] | None = None
    """Settings, with their values, on which the contour is said to rest."""

    @property
    def has_path(self) -> bool:
        """Whether a path must be claimed. An overdetermined contour may have none: no-solution ranks after it."""
        is_over = self.status is ClaimedStatus.OVERDETERMINED
        return self.status is ClaimedStatus.SOLVED or (is_over and not self.path.is_empty)


@dataclass(frozen=True, slots=True)
class ClaimedResult:
    """Everything of a result that can be checked; `control` is None where it names none, `rules` where it does not
    say under which policy it was made, `settings` (by `control.name`) where it does not say under which conventions.
    `findings` is how many findings it has, which are not looked at."""

    control: str | None
    rules: Rules | None
    settings: Mapping[str, str] | None
    findings: int
    contours: tuple[ClaimedContour, ...]
