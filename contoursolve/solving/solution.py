"""The answer of a solver: values with their status and certificate, or the reasons why there are none."""

from collections.abc import Mapping
from enum import Enum
from math import floor, inf, log10

from msgspec import Struct, field

from contoursolve.solving.events import NoteKind, RefusalKind, Status
from contoursolve.tolerance import ERROR_BOUND_WARNING

DECIMALS = 12
"""Decimals of coordinates in mm: below the rounding of the arithmetic, so that nothing is lost."""


class Proof(Enum):
    """The grades of what is proven about a solution; the values are those of the JSON."""

    EXACT = "exact"
    """Its numbers, as they are printed, satisfy the equations exactly, in rational arithmetic."""
    UNIQUE = "unique"
    """A box about it holds exactly one solution of the equations, by interval arithmetic."""
    VERIFIED = "verified"
    """Its residuals are as small as rounding; the radius is a bound of first order."""
    UNKNOWN = "unknown"


class Certificate(Struct, frozen=True):
    """A proof, and the radius in mm of a box about the points in which the exact ones lie.

    `reason` says why there is no better one. `gap` is given for a double solution, where an element touches: how
    far, in mm, it is from where the two solutions part (positive) or vanish (negative); 0 where it touches exactly.
    """

    proof: Proof
    radius: float
    reason: str = ""
    gap: float | None = None

    @property
    def is_double(self) -> bool:
        """Whether two solutions have become one."""
        return self.gap is not None

    @property
    def is_usual(self) -> bool:
        """Whether the solution is proven to be the only one near it, and known far better than words are exact to."""
        return self.proof in _PROVEN and not self.is_double and self.radius <= ERROR_BOUND_WARNING

    def __str__(self) -> str:
        why = f": {self.reason}" if self.reason else ""
        match self.proof:
            case Proof.EXACT:
                known = "exact"
            case Proof.UNIQUE:
                known = f"the only solution within {self.radius:.0e} mm, proven"
            case Proof.VERIFIED:
                known = f"checked to {self.radius:.0e} mm, not proven{why}"
            case Proof.UNKNOWN:
                known = f"not proven{why}"
        return f"{known} (an element only touches)" if self.is_double else known


_PROVEN = (Proof.EXACT, Proof.UNIQUE)


def up_to_one_digit(value: float) -> float:
    """A bound rounded up to one significant digit."""
    if not 0 < value < inf:
        return value
    digit = 10.0 ** floor(log10(value))
    number = max(1, int(value / digit))
    while number * digit < value:
        number += 1
    return number * digit


class Refusal(Struct, frozen=True):
    """One reason against a contour: the element or corner, the givens involved, the values compared.

    `values` may hold limit, expected, actual (mm or degrees) and off_by_mm, and those of `BESIDE`.
    """

    kind: RefusalKind
    subject: str
    givens: tuple[str, ...] = ()
    values: Mapping[str, float] = field(default_factory=dict)
    beside: tuple[str, ...] = ()
    """Givens that are not to blame, but leave no more room than the limit."""
    elements: tuple[str, ...] = ()
    """For a corner that is too large: the element that is too short for it, and the one that limits what fits. For a
    bevel outside its lines: the axis along which it is farthest."""


class Note(Struct, frozen=True):
    """One remark about a solved contour, in the same terms as a refusal."""

    kind: NoteKind
    subject: str
    givens: tuple[str, ...] = ()
    values: Mapping[str, float] = field(default_factory=dict)


Point = tuple[float, float]


class CornerSolution(Struct, frozen=True):
    """A corner in numbers: it replaces the path from `begin` to `end`; no centre for a chamfer."""

    begin: Point
    end: Point
    center: Point | None
    radius: float
    turn: float
    """Sine of the turn; positive to the left."""


class SystemSolution(Struct, frozen=True):
    """Values of all unknowns (mm), or the refusals that leave none.

    `points` and `radii` go by name, `corners` by the corner's name. `error_bound` (mm) bounds the
    distance of every point from the exact one to first order: the residuals and the rounding of the
    coordinates, times the norm of the inverse Jacobian.
    """

    status: Status
    points: Mapping[str, Point] = field(default_factory=dict)
    radii: Mapping[str, float] = field(default_factory=dict)
    corners: Mapping[str, CornerSolution] = field(default_factory=dict)
    refusals: tuple[Refusal, ...] = ()
    remarks: tuple[Note, ...] = ()
    error_bound: float = 0.0
    certificate: Certificate | None = None
    scalars: Mapping[str, float] = field(default_factory=dict)
    """Other unknowns: directions and places of lines."""


class Obstacle(Enum):
    """The reasons why a step could not be solved in closed form."""

    SINGULAR = "at these values its equations do not fix it"
    UNDECIDED = "whether its equations have one solution is too close to decide"
    TOUCHING = "whether it has two solutions or none is too close to decide"
    NO_CLOSED_FORM = "no closed form is known for it"
    UNFINISHED = "the search was given up before all of its range was decided"
    FARTHER = "the search was given up before all that lies farther away was decided"


class Doubt(Struct, frozen=True):
    """A part of the search that could not be decided: the unknowns of the step, and why."""

    unknowns: tuple[str, ...]
    obstacle: Obstacle


class Alternative(Struct, frozen=True):
    """One solution of the equations, as a path or with what speaks against it.

    `scalars` holds every unknown in mm. `sides` are the branches by the point or the elements that they are about;
    `name` tells it from the others.
    """

    solution: SystemSolution
    scalars: Mapping[str, float]
    sides: Mapping[str, str]
    certificate: Certificate
    name: str = ""

    @property
    def is_path(self) -> bool:
        """Whether the control could make it."""
        return self.solution.status in (Status.SOLVED, Status.OVERDETERMINED)


class Alternatives(Struct, frozen=True):
    """All solutions of a profile's equations; the list is complete, with proof, if there is no doubt.

    `reach` is how far from the start point there is no other one, mm, where they were searched for, and `boxes` the
    number of boxes that were looked at; None and 0 where the closed form gives all.
    """

    items: tuple[Alternative, ...]
    doubts: tuple[Doubt, ...]
    reach: float | None
    boxes: int

    @property
    def is_complete(self) -> bool:
        """Whether these are proven to be all."""
        return not self.doubts

    @property
    def paths(self) -> tuple[Alternative, ...]:
        """The solutions that the control could make."""
        return tuple(item for item in self.items if item.is_path)
