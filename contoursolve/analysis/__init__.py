"""What a system of facts determines, before any number is put in."""

from contoursolve.analysis.partition import Group, match, order
from contoursolve.analysis.verdict import Verdict, derive, judge

__all__ = ["Group", "Verdict", "derive", "judge", "match", "order"]
