"""What a system of facts determines, before any number is put in."""

from contoursolve.analysis.partition import Group, Parts, decompose, match, order
from contoursolve.analysis.verdict import Verdict, derive, judge

__all__ = ["Group", "Parts", "Verdict", "decompose", "derive", "judge", "match", "order"]
