"""Free contour programming: what a block must state together, and what has no solution."""

from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.geometry_rules import GEOMETRY_RULES

RULES = (*COMMON_RULES, *GEOMETRY_RULES)
