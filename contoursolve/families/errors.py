"""Why a family cannot be evaluated."""

from contoursolve.diagnostics import UserError


class FamilyError(UserError, ValueError):
    """A family that cannot be evaluated; the message says why, and what to do."""


class NotClosedError(FamilyError):
    """What needs a closed form is asked about a block that has none."""


class ByRowError(NotClosedError):
    """Each row alone tells how its block is read."""


class NotMovedError(FamilyError):
    """A word that does not move a point in the direction that is asked about."""
