"""From a system to values: plan, function, solution."""

from contoursolve.solving.compare import compare
from contoursolve.solving.numbers import lookup, scalars_of
from contoursolve.solving.plan import NoClosedFormError, Plan, is_closed, make_plan, points_with_two_solutions
from contoursolve.solving.solution import (
    BESIDE,
    CornerSolution,
    Point,
    Refusal,
    RefusalKind,
    Remark,
    RemarkKind,
    Solution,
    Status,
)
from contoursolve.solving.solve import solve

__all__ = [
    "BESIDE",
    "CornerSolution",
    "NoClosedFormError",
    "Plan",
    "Point",
    "Refusal",
    "RefusalKind",
    "Remark",
    "RemarkKind",
    "Solution",
    "Status",
    "compare",
    "is_closed",
    "lookup",
    "make_plan",
    "points_with_two_solutions",
    "scalars_of",
    "solve",
]
