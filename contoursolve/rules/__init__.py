"""What the manuals allow, as rows."""

from contoursolve.rules.conditions import Condition, Stated, Value, all_of, at_least, at_most, some
from contoursolve.rules.rule import Offence, Rule, check, is_refused_by_values

__all__ = [
    "Condition",
    "Offence",
    "Rule",
    "Stated",
    "Value",
    "all_of",
    "at_least",
    "at_most",
    "check",
    "is_refused_by_values",
    "some",
]
