"""What a solver answers: values with their status and certificate, or the reasons why there are none."""

from collections.abc import Mapping
from enum import Enum
from math import floor, inf, log10

from msgspec import Struct, field


class Proof(Enum):
    """What is proven about a solution; the values are those of the JSON."""

    EXACT = "exact"
    """Its numbers satisfy the equations exactly, in rational arithmetic."""
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

    def __str__(self) -> str:
        match self.proof:
            case Proof.EXACT:
                known = "exact"
            case Proof.UNIQUE:
                known = f"the only solution within {self.radius:.0e} mm, proven"
            case Proof.VERIFIED:
                known = f"verified, known to {self.radius:.0e} mm"
            case Proof.UNKNOWN:
                known = f"unknown ({self.reason})"
        return f"double: touches; {known}" if self.is_double else known


def up_to_one_digit(value: float) -> float:
    """A bound rounded up to one significant digit."""
    if not 0 < value < inf:
        return value
    digit = 10.0 ** floor(log10(value))
    number = max(1, int(value / digit))
    while number * digit < value:
        number += 1
    return number * digit


class Status(Enum):
    """The verdict on one contour; the order is the order of precedence."""

    REJECTED = "rejected"
    """The control's rules refuse it, whatever the geometry: write what the rule asks for."""
    CONFLICTING = "conflicting"
    """More words than needed, and they disagree: drop or correct one."""
    UNDERDETERMINED = "underdetermined"
    """Words are missing: add one."""
    OVERDETERMINED = "overdetermined"
    """More words than needed that agree: drop one."""
    AMBIGUOUS = "ambiguous"
    """Several contours satisfy it, and nothing chooses: add the word or the fact that does."""
    NO_SOLUTION = "no-solution"
    """Determined, but the geometry does not exist or the control cannot make it: change a value."""
    UNDECIDED = "undecided"
    """Determined, but that there is no contour, or no other one than was found, is not proven: state simpler facts."""
    SOLVED = "solved"


class RefusalKind(Enum):
    """Why a determined system gives no contour at the values of this block."""

    LINES_PARALLEL = "lines-parallel"
    NOT_FIXED = "not-fixed"
    POINT_IS_START = "point-is-start"
    """A line through two points, which are one."""
    CIRCLE_MISSED = "circle-missed"
    RADIUS_TOO_SMALL = "radius-too-small"
    CIRCLES_APART = "circles-apart"
    CIRCLE_UNDEFINED = "circle-undefined"
    WORDS_DISAGREE = "words-disagree"
    FACT_DISAGREES = "fact-disagrees"
    """A fact without a value of its own is not true of what the others give."""
    RADIUS_DIFFERENCE = "radius-difference"
    LINE_REVERSED = "line-reversed"
    LINE_BACKWARDS = "line-backwards"
    CORNER_TOO_LARGE = "corner-too-large"
    CORNERS_OVERLAP = "corners-overlap"
    CORNER_STRAIGHT = "corner-straight"
    CORNER_REVERSES = "corner-reverses"
    BEVEL_OUTSIDE = "bevel-outside"
    BEVEL_IN_BAND = "bevel-in-band"
    LANDING_UNKNOWN = "landing-unknown"
    ARC_EMPTY = "arc-empty"
    NO_POINT = "no-point"
    SEARCH_UNFINISHED = "search-unfinished"
    COUNT_OPEN = "only-unproven"
    """One contour was found, no word has chosen it from others, and that there is no other one is not proven."""
    NOT_VERIFIED = "not-verified"
    OUT_OF_RANGE = "out-of-range"
    """A point lies farther from the start than any word reaches."""
    CORNER_SIGN = "corner-sign"
    """The sign of a corner word says that the next line runs the other way."""

    PICK_NONE = "pick-none"
    """A word chooses a solution that is not there."""

    @property
    def status(self) -> Status:
        """The status that this refusal gives a contour."""
        if self is RefusalKind.NOT_FIXED:
            return Status.UNDERDETERMINED
        if self in (RefusalKind.SEARCH_UNFINISHED, RefusalKind.COUNT_OPEN):
            return Status.UNDECIDED
        if self in (RefusalKind.WORDS_DISAGREE, RefusalKind.FACT_DISAGREES, RefusalKind.RADIUS_DIFFERENCE):
            return Status.CONFLICTING
        return Status.NO_SOLUTION


class NoteKind(Enum):
    """What a user should know about a contour that was solved."""

    TOUCHES = "touches"
    """The line touches the circle: both solutions are one."""
    DOUBLE = "double"
    """Two solutions have become one, and not because a line of the path touches a circle."""
    HALF_CIRCLE = "half-circle"
    """Half the distance of its ends is more than a radius, by as little as words are exact to."""
    SEVERAL = "several"
    """More than one contour satisfies the block."""
    COUNT_OPEN = "count-open"
    """Whether these are all contours is not proven."""
    SENSITIVE = "sensitive"
    """Rounding alone may move a point by more than a thousandth of the least increment."""
    LINE_VANISHES = "line-vanishes"
    PICK_OPEN = "pick-open"
    """A word chooses among solutions, and the other words leave one alone."""
    PICK_FIRST = "pick-first"
    """Nothing chooses, and a setting takes the first of several contours."""
    WORDS_AGREE = "words-agree"
    """A word that was not needed agrees."""
    RADIUS_DIFFERS = "radius-differs"
    """Two points of a circle differ in radius, by less than the control allows."""


BESIDE = ("limit_first", "limit_second")
"""For two corners that overlap: the largest size of either, mm, if the other one stays."""


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


class Solution(Struct, frozen=True):
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
