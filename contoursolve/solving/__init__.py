"""From a system and its values to a contour: plan, function, checks, proof.

A profile comes in, a solution or refusals go out. Begin with `solve`; what has several solutions or no closed form is
in `ambiguity`, `alternatives` and `enumerate`.
"""

from contoursolve.solving.compare import compare
from contoursolve.solving.numbers import lookup, scalars_of
from contoursolve.solving.plan import NoClosedFormError, Plan, is_closed, make_plan, points_with_two_solutions
from contoursolve.solving.solution import (
    BESIDE,
    CornerSolution,
    Note,
    NoteKind,
    Point,
    Refusal,
    RefusalKind,
    Solution,
    Status,
)
from contoursolve.solving.solve import solve

__all__ = [
    "BESIDE",
    "CornerSolution",
    "NoClosedFormError",
    "Note",
    "NoteKind",
    "Plan",
    "Point",
    "Refusal",
    "RefusalKind",
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
