"""What a verification writes down: every check with its residual and limit, and what it did not check."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from math import isfinite


@dataclass(frozen=True, slots=True)
class Check:
    """One check of a claim against the words that it rests on.

    `residual` says by how much the claim is off and `limit` how much is allowed, in `unit` (mm or deg); both
    are None where the answer is yes or no. `remark` says what was found where the check failed.
    """

    name: str
    words: tuple[str, ...]
    passed: bool
    residual: float | None = None
    limit: float | None = None
    unit: str = ""
    remark: str = ""


@dataclass(frozen=True, slots=True)
class Omission:
    """Something that was not checked, and why."""

    what: str
    why: str


@dataclass(slots=True)
class Ledger:
    """The checks and omissions of one contour, in the order in which they were made."""

    checks: list[Check] = field(default_factory=list)
    omissions: list[Omission] = field(default_factory=list)

    def measure(self, name: str, words: Iterable[str], residual: float, limit: float, unit: str = "mm") -> bool:
        """Write down a residual, which must not be larger than the limit; whether it is not."""
        size = abs(residual)
        passed = size <= limit  # false for NaN
        self.checks.append(Check(name, tuple(words), passed, size if isfinite(size) else None, limit, unit))
        return passed

    def require(self, name: str, words: Iterable[str], passed: bool, remark: str = "") -> bool:
        """Write down a question of yes or no; the remark is kept where the answer is no."""
        self.checks.append(Check(name, tuple(words), passed, remark="" if passed else remark))
        return passed

    def omit(self, what: str, why: str) -> None:
        """Write down what was not checked."""
        self.omissions.append(Omission(what, why))

    def add(self, other: "Ledger") -> None:
        """Append what another ledger holds."""
        self.checks += other.checks
        self.omissions += other.omissions

    @property
    def failures(self) -> list[Check]:
        """The checks that failed."""
        return [check for check in self.checks if not check.passed]


def fewest(attempts: Iterable[Callable[[], Ledger]]) -> Ledger:
    """The first of several attempts that finds no fault, or else the one that finds the fewest."""
    found: list[Ledger] = []
    for attempt in attempts:
        found.append(attempt())
        if not found[-1].failures:
            return found[-1]
    return min(found, key=lambda each: len(each.failures))
