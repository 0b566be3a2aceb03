"""How well a solution is known: exactly, as the only one in a box, by its residual alone, or not at all."""

from dataclasses import dataclass
from enum import Enum
from math import floor, inf, log10


class Proof(Enum):
    """What is proven about a solution; the values are those of the JSON."""

    EXACT = "exact"
    """Its numbers satisfy the equations exactly, in rational arithmetic."""
    UNIQUE = "unique"
    """A box about it holds exactly one solution of the equations, by interval arithmetic."""
    VERIFIED = "verified"
    """Its residuals are as small as rounding; the radius is a bound of first order."""
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Certificate:
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
