"""One contour to check: what the program says, what the result claims, in coordinates from the start point."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from math import floor, log10

from contoursolve.model import FIRST, INCREMENT_OF, SECOND, Turn, least_increments
from contoursolve.reading import Claim
from contoursolve.tolerance import ERROR_BOUND_WARNING, RADIUS_DIFFERENCE, RESIDUAL
from contoursolve.verification.claimed import ClaimedContour, ClaimedElement, Rules
from contoursolve.verification.facts import StatedFact
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import EPSILON, PRINTED, ROUNDING
from contoursolve.verification.node import Coordinates
from contoursolve.verification.quantity import Origin

CERTIFIED = 4
"""1. A residual that compares a point with three others may be off by the error of all four of them."""


@dataclass(frozen=True, slots=True)
class Circle:
    """The circle of an arc, from the start point; radius in mm."""

    center: complex
    radius: float
    turn: Turn


@dataclass(frozen=True, slots=True)
class Move:
    """A claimed element, from the start point; `circle` is None for a line."""

    start: complex
    end: complex
    circle: Circle | None


@dataclass(frozen=True, slots=True)
class Case:
    """A contour with a claimed path.

    All points are counted from the program's start point, the difference taken in decimals. `limit` (mm) is
    what a residual may be: 1e-9 and the rounding of the coordinates. `reach` is the largest number counted from
    the start point, `size` the largest coordinate of the program's own, both mm. `start_error` (mm) is how far
    the start point may be from the one that was solved from.

    `choices` are the signs of the words that choose between solutions; a solution that is listed beside the
    contour has those that select it, and tells no branch (`is_listed`). `selecting` is how many words
    that are not needed to fix the points select them from other solutions. `grain` (mm) is what the numbers lost
    when they were written with as many decimals as the certificate's radius leaves a meaning. `next_end` is where
    the line of the next block ends, if the program tells it. `rules` is the policy that the result names, if it does.
    """

    claim: Claim
    claimed: ClaimedContour
    origin: Origin
    end: complex | None
    points: Mapping[str, complex]
    moves: tuple[Move, ...]
    size: float
    reach: float
    start_error: float
    facts: tuple[StatedFact, ...] = ()
    choices: Mapping[str, int] = field(default_factory=dict)
    is_listed: bool = False
    selecting: int = 0
    grain: float = 0.0
    next_end: complex | None = None
    rules: Rules | None = None

    @property
    def limit(self) -> float:
        """What a residual may be, mm."""
        return RESIDUAL + ROUNDING * self.size + 2 * self.grain

    @property
    def slack(self) -> float:
        """By how much the radii at two points of an arc may differ, mm."""
        set_here = [each.value for each in self.claim.conventions if each.setting.name == "radius-difference"]
        return float(set_here[0]) if set_here else RADIUS_DIFFERENCE

    @property
    def is_extended(self) -> bool:
        """Whether the program states or asks for more than the words of its form."""
        return bool(self.claim.directives or self.asked)

    @property
    def asked(self) -> tuple[str, ...]:
        """The givens whose values are asked for."""
        return tuple(name for name, word in self.claim.words.items() if word.is_asked)

    def texts(self, *names: str) -> tuple[str, ...]:
        """The words that state these givens, as typed."""
        return tuple(self.claim.words[name].text for name in names if name in self.claim.words)

    def states(self, *names: str) -> tuple[str, ...]:
        """Those of these givens that the program states, or the control supplies."""
        return tuple(name for name in names if name in self.claim.givens)

    def value(self, name: str) -> Decimal:
        """A given, mm or degrees, as stated."""
        return self.claim.givens[name].value

    def amount(self, name: str) -> float:
        """A given length or increment, mm."""
        return float(self.value(name))

    def coordinate(self, name: str, axis: int) -> float:
        """A given absolute coordinate, counted from the start point, mm."""
        return float(self.value(name) - self.origin[axis])

    def increment(self, name: str) -> float:
        """The least increment of a given by its name, or of a coordinate by its axis, mm or degrees."""
        after = self.claim.after
        return least_increments(after.unit, after.plane, self.claim.givens)[INCREMENT_OF + name]

    def place(self, at: tuple[Decimal, Decimal]) -> complex:
        """An absolute place, mm, counted from the start point."""
        return complex(float(at[FIRST] - self.origin[FIRST]), float(at[SECOND] - self.origin[SECOND]))

    def compare(self, ledger: Ledger, name: str, words: Iterable[str], gap: float, unsure: float) -> None:
        """A gap (mm) between a claimed point and the same point worked out here, which is `unsure` (mm) itself.

        The claimed certificate must not promise more than that.
        """
        stated, certificate = tuple(words), self.claimed.certificate
        ledger.measure(name, stated, gap, self.limit + unsure)
        if certificate.radius is not None:
            allowed = CERTIFIED * max(0.0, certificate.radius) + PRINTED + ROUNDING * self.size + unsure
            ledger.measure(f"the certificate's radius covers that {name}", stated, gap, allowed)


def make_case(claim: Claim, claimed: ClaimedContour, origin: Origin, start_error: float) -> Case:
    """The claimed numbers of a contour, counted from its start point."""
    path = claimed.path

    def place(at: Coordinates) -> complex:
        return complex(
            float(Decimal(at[FIRST]) - origin[FIRST]),
            float(Decimal(at[SECOND]) - origin[SECOND]),
        )

    def move(element: ClaimedElement) -> Move:
        arc = element.arc
        circle = Circle(place(arc.center), arc.radius, arc.turn) if arc else None
        return Move(place(element.start), place(element.end), circle)

    moves = tuple(map(move, path.elements))
    points = {name: place(at) for name, at in path.points.items()}
    end = None if path.end is None else place(path.end)
    circles = [each.circle for each in moves if each.circle]
    near = [abs(each.end) for each in moves]
    near += [abs(each.center) for each in circles] + [abs(each.radius) for each in circles]
    near += map(abs, points.values())
    reach = max([1.0, *near, *(abs(float(given.value)) for given in claim.givens.values())])
    size = reach + max(abs(float(value)) for value in origin)
    # The solver went on from an end of its own, of which the result has 12 decimals.
    inherited = start_error + EPSILON * size if start_error else 0.0
    return Case(claim, claimed, origin, end, points, moves, size, reach, inherited, grain=_grain(claimed))


def _grain(claimed: ClaimedContour) -> float:
    """Half of the last decimal, mm, if the numbers have only as many as the certificate's radius leaves a meaning."""
    radius = claimed.certificate.radius
    if not radius or not PRINTED < radius <= ERROR_BOUND_WARNING:
        return 0.0
    decimals, path = floor(-log10(radius)), claimed.path
    numbers = [value for at in path.points.values() for value in at]
    for each in path.elements:
        numbers += [*each.start, *each.end, *((*each.arc.center, each.arc.radius) if each.arc else ())]
    is_rounded = all(round(value, decimals) == value for value in numbers)
    return 0.5 * 10.0**-decimals if is_rounded else 0.0
