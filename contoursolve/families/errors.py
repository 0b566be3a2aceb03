"""Errors of families."""

from contoursolve.diagnostics import UserError


class FamilyError(UserError, ValueError):
    """A family that cannot be evaluated; the message says why, and what to do."""


class NotClosedError(FamilyError):
    """A question that needs a closed form, about a block that has none."""


class ByRowError(NotClosedError):
    """Each row alone tells how its block is read."""


class NotMovedError(FamilyError):
    """A word that does not move a point in the direction that is asked about."""
